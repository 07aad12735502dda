// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group cdem/lid stress SIGMA width W thickness T [vmax V]
//
// A rigid, horizontal lid under a constant normal stress. The discs of the group form one body that only moves
// vertically: its mass M is the sum of theirs, and M dv/dt = sum of contact f_y - F, with F = SIGMA W T downward. The
// applied stress is exact; the felt stress differs from it by the inertia of the lid, and while the speed is limited.
//
//   SIGMA  normal stress, >= 0 (Pa)      W, T  width and thickness on which it acts, > 0 (m)
//   V      largest speed of the lid downward, > 0 (m/s). Default: F/sqrt(n kn M) with n discs and the largest normal
//          stiffness kn: then an impact on a rigid bed is never more than F itself
//
// Global vector: 1 applied stress (Pa), 2 felt stress = sum of f_y/(W T) (Pa), 3 height of the lower face (m), that is
// of the lowest point of its discs, 4 velocity (m/s), 5 number of steps in which V limited the velocity, 6 horizontal
// force of the grains on the lid (N).
#pragma once

#include "core/lid_motion.h"
#include "liggghts/wall_body.h"

namespace Liggghts {

class FixLid : public WallBody {
public:
  FixLid(LAMMPS *, int, char **);

  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  double compute_vector(int) override;

private:
  enum Output { APPLIED, FELT, HEIGHT, VELOCITY, CAPPED_STEPS, FORCE_X, NOUTPUTS };

  double largest_stiffness() const;
  double lower_face() const;
  void take_acceleration();

  double stress = 0, width = 0, thickness = 0, given_cap = 0; // 0: the default
  double mass = 0, fastest = 0, felt_force = 0;
  cdem::LidMotion motion; // upward
};

} // namespace Liggghts
