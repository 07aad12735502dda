// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group cdem/move speed V [dir x|y] [ramp T] [stop S]
//
// Moves the discs of the group as one rigid wall by the prescribed displacement of core/ramped_motion.h, along x
// (default) or y. With V = 0 the wall is at rest, and the fix only gives its force.
//
//   V  speed, may be negative (m/s)      T  ramp, >= 0 (s, default 0: full speed at once)
//   S  distance at which to stop, > 0 (m, default: none)
//
// Global vector: 1 displacement s (m), 2 speed (m/s), 3 and 4 force f_x and f_y that the grains exert on the wall (N).
// The time is in restart files: a fix of the same ID goes on. A motion by which the wall would be elsewhere by now is
// refused: one with another V, T or direction, or with another S after the wall has stopped.
#pragma once

#include "core/ramped_motion.h"
#include "liggghts/wall_body.h"

namespace Liggghts {

class FixMove : public WallBody {
public:
  FixMove(LAMMPS *, int, char **);

  void init() override;
  void reset_dt() override;
  void setup(int) override { apply(); }
  void initial_integrate(int) override;
  void final_integrate() override { apply(); }
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

private:
  enum Output { DISPLACEMENT, SPEED, FORCE_X, FORCE_Y, NOUTPUTS };

  cdem::RampedMotion::State at_present() const { return path.at(clock.time()); }
  Vector along(double amount) const { return vertical ? Vector{0, amount} : Vector{amount, 0}; }
  void apply() const { set_motion(along(now.speed), along(now.acceleration)); }

  cdem::RampedMotion path;
  bool vertical = false;
  cdem::MotionClock clock;
  cdem::RampedMotion::State now{0, 0, 0};
};

} // namespace Liggghts
