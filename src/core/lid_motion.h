// SPDX-License-Identifier: GPL-2.0-or-later
// Velocity Verlet of a lid along its normal, with a largest speed inward. All is counted outward.
#pragma once

namespace cdem {

struct LidMotion {
  double velocity = 0, acceleration = 0; // m/s, m/s^2
  double capped_steps = 0;               // in which the speed was limited
  bool capped = false;                   // in this step

  // The first half of the kick, before the lid moves by dt * velocity.
  void begin_step(double dt, double fastest) {
    velocity += 0.5 * dt * acceleration;
    capped = cap(fastest);
  }

  // The second half, by the acceleration at the new place.
  void end_step(double dt, double fastest) {
    velocity += 0.5 * dt * acceleration;
    if (cap(fastest)) {
      capped = true;
      acceleration = 0; // at its cap the lid moves uniformly
    }
    capped_steps += capped;
  }

private:
  // Limits the speed inward; true if it was higher.
  bool cap(double fastest) {
    if (velocity >= -fastest)
      return false;
    velocity = -fastest;
    return true;
  }
};

} // namespace cdem
