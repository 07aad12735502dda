// SPDX-License-Identifier: GPL-2.0-or-later
// The prescribed displacement s of a wall, t after its beginning:
//
//   t < T:   ds/dt = V/2 (1 - cos(pi t/T)),   s = V/2 (t - T/pi sin(pi t/T))
//   t >= T:  ds/dt = V,                       s = V (t - T/2)
//   |s| reaches S: the wall stops at once, at s = S (or -S if V < 0)
//
// s is rounded to a multiple of 2^-50 m. This is not finer than the last bit of a coordinate below 8 m, so increments
// add up without rounding errors, and the discs of a wall keep their distances.
#pragma once

#include <cmath>

namespace cdem {

struct RampedMotion {
  double speed = 0, ramp = 0, stop = 0; // V (m/s), T (s), S (m); stop 0: none

  struct State {
    double s, speed, acceleration;
  };

  State at(double t) const {
    constexpr double RESOLUTION = 0x1p-50; // m
    State m{speed * (t - 0.5 * ramp), speed, 0};
    if (t < ramp) {
      const double phase = M_PI * t / ramp;
      m = {0.5 * speed * (t - ramp / M_PI * std::sin(phase)), 0.5 * speed * (1 - std::cos(phase)),
           0.5 * speed * M_PI / ramp * std::sin(phase)};
    }
    if (stop > 0 && std::fabs(m.s) >= stop)
      m = {std::copysign(stop, speed), 0, 0};
    m.s = std::nearbyint(m.s / RESOLUTION) * RESOLUTION;
    return m;
  }
};

// The time of a motion is start + steps dt: not a sum of small numbers, and it goes on with another dt. In s.
struct MotionClock {
  double start = 0, steps = 0, dt = 0;

  double time() const { return start + steps * dt; }
  void take_step_of(double next) {
    if (dt != next)
      *this = {time(), 0, next};
  }
};

// What restart files have of the motion of a wall.
struct KeptMotion {
  MotionClock clock;
  double s; // m
  bool along_y;

  // Whether the wall is where another motion would have brought it by now, so that this one can go on with it.
  bool is_on(const RampedMotion &path, bool path_along_y) const {
    const double there = path.at(clock.time()).s;
    return there == s && (there == 0 || path_along_y == along_y);
  }
};

} // namespace cdem
