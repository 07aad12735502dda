// SPDX-License-Identifier: GPL-2.0-or-later
// Velocity Verlet of a disc or a grain, on its row (struct Disc), which the force loop reads: the second half of a step
// with the force that has just been summed, then the first half of the next step.
#pragma once

#include "kinematics.h"

#include <algorithm>

namespace cdem {

// What the motion needs in addition to the row: angle (rad), mass (kg), 1/mass and 1/inertia, which are 0 for walls.
struct alignas(4 * sizeof(double)) Body {
  double angle, mass;
  double inverse_mass, inverse_inertia;
};

// How a step is made; see stability.h for `forward`.
struct StepRule {
  double dt;
  double forward;        // by this time the dashpots' velocity is carried forward from the half step (s)
  double gx = 0, gy = 0; // gravity (m/s^2)
  double drag = 0;       // deceleration over the velocity of the half step (1/s)
  double damping = 0;    // local damping: share of the force that opposes the motion

  bool has_body_forces() const { return gx != 0 || gy != 0 || drag != 0 || damping != 0; }
};

// A force as large as this one, against the velocity; 0 at rest. Local damping is a share of it (Cundall 1987).
template <class T> [[gnu::always_inline]] inline T opposing(T force, T velocity) {
  const T zero{}, size = force < zero ? -force : force;
  return velocity > zero ? -size : velocity < zero ? size : zero;
}

// Length of the path of a grain (m), and the sum of the amounts of its rotations (rad), over many steps.
struct alignas(2 * sizeof(double)) Travel {
  double path = 0, turned = 0;

  // Adds a step with these velocities.
  [[gnu::always_inline]] void add(double vx, double vy, double omega, double dt) {
    const Two squares{vx * vx + vy * vy, omega * omega};
    store_raw(&path, load_raw<Two>(&path) + dt * square_root(squares));
  }
};

struct DiscForce {
  double fx, fy, torque;
};

// The largest squares of the velocity components and of the angular velocity among some grains, each by itself.
struct Fastest {
  double vx2 = 0, vy2 = 0, omega2 = 0;

  [[gnu::always_inline]] void see(const Four &squares) {
    vx2 = std::max(vx2, squares[0]);
    vy2 = std::max(vy2, squares[1]);
    omega2 = std::max(omega2, squares[2]);
  }
  // Upper bound on the speed of all points within the distance `reach` of the centre of their grain (m/s).
  double speed(double reach) const { return std::sqrt(vx2 + vy2) + reach * std::sqrt(omega2); }
};

// `sum`: fx, fy, torque, and one unused value. body_forces: whether there is gravity, drag or local damping. `fastest`
// is raised to the squares of the new velocities. `travel` may be null.
template <bool body_forces>
[[gnu::always_inline]] inline void advance(Disc<double> &disc, Body &body, Four sum, const StepRule &step,
                                           Four &fastest, Travel *travel) {
  const double half = 0.5 * step.dt;
  const Four place = load_raw<Four>(&disc.x), motion = load_raw<Four>(&disc.vx), of_body = load_raw<Four>(&body.angle);

  Four v = __builtin_shufflevector(place, motion, 2, 3, 6, 7); // vx, vy, omega of the half step, and one unused value
  if constexpr (body_forces) {
    sum += body.mass * (Four{step.gx, step.gy, 0, 0} - Four{step.drag, step.drag, 0, 0} * v);
    sum += step.damping * opposing(sum, v);
  }
  const Four acceleration = sum * __builtin_shufflevector(of_body, of_body, 2, 2, 3, 3);
  v += half * acceleration;
  v += half * acceleration;
  const Four x = __builtin_shufflevector(place, of_body, 0, 1, 4, 5) + step.dt * v;
  const Four ahead = v + step.forward * acceleration;

  store_raw(&disc.x, __builtin_shufflevector(x, v, 0, 1, 4, 5));
  store_raw(&disc.vx, __builtin_shufflevector(ahead, v, 0, 1, 6, 2));
  body.angle = x[2];
  const Four squares = v * v;
  fastest = fastest > squares ? fastest : squares;
  if (travel)
    travel->add(v[0], v[1], v[2], step.dt);
}

} // namespace cdem
