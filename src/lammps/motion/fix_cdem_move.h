// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group cdem/move speed V [dir x|y] [ramp T] [stop S]
//
// Moves the discs of the group as one rigid wall by a prescribed displacement s along x (default) or y. With V = 0 the
// wall is at rest, and the fix only gives its force. With t the time since the first run of the fix:
//
//   t < T:   ds/dt = V/2 (1 - cos(pi t/T)),   s = V/2 (t - T/pi sin(pi t/T))
//   t >= T:  ds/dt = V,                       s = V (t - T/2)
//   |s| reaches S: the wall stops at once, at s = S (or -S if V < 0)
//
//   V  speed, may be negative (m/s)      T  ramp, >= 0 (s, default 0: full speed at once)
//   S  distance at which to stop, > 0 (m, default: none)
//
// The discs of the group must not be in the group of fix cdem/integrate, nor in that of any other fix
// that moves atoms. Needs dimension 2 and atom_style sphere.
//
// Global vector: 1 displacement s (m), 2 speed (m/s), 3 and 4 force f_x and f_y that the grains exert on the wall (N).
// s follows the closed form, not a sum of steps. It is rounded to a multiple of 2^-50 m. This is not finer than the
// last bit of a coordinate below 8 m, so increments add up without rounding errors, and the discs keep their distances.
// Runs continued from restart files give the same bits. The fix must have the ID that it had then: a wall that moves
// under another ID, while the state of such a fix is left in the file, is refused when the run begins. So is, at once,
// a motion by which the wall would be elsewhere by now: one with another V, T or direction, or with another S after the
// wall has stopped.
#pragma once

#include "core/ramped_motion.h"
#include "motion/wall_body.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMMove : public WallBody {
public:
  FixCDEMMove(LAMMPS *, int, char **);

  void post_constructor() override;
  void init() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void reset_dt() override;
  double compute_vector(int) override;
  void setup(int) override;
  bool follows_forces() const override { return is_audited() && path.speed != 0; }
  void write_restart(FILE *) override;
  void restart(char *) override;

private:
  void refuse_other_id() const;

  using Motion = cdem::RampedMotion::State;
  enum Output { DISPLACEMENT, SPEED, FORCE_X, FORCE_Y, NOUTPUTS };

  struct Saved {
    static constexpr int VERSION = 3;
    cdem::KeptMotion motion;
    Booked booked;
  };

  Motion motion() const;
  void apply();
  Vector along(double amount) const;
  Vector force() const; // along the motion

  cdem::RampedMotion path;
  bool vertical = false;
  cdem::MotionClock clock;
  Motion now{0, 0, 0};
  std::vector<std::string> left; // ids of such fixes in the restart file, when this one was made
};

} // namespace LAMMPS_NS
