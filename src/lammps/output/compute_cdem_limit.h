// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID all cdem/limit
//
// The largest time step that is stable with the contacts of this step (s). The value is no more than 0.2 %
// above the true limit, to which that was measured, and at most some 13 % below it, or 40 % with rolling resistance;
// the scalar of fix cdem/integrate is the limit of the worst possible packing. Contacts that slide or roll count as if
// they stuck; the motion of the lid is not considered. Without any contact the value is infinite. It costs as much as
// some hundred steps.
//
// For example, to output it during a run:
//
//   compute limit all cdem/limit
//   thermo_style custom step dt c_limit
//
// fix cdem/integrate dt contacts takes 0.8 of it when its first run begins.
//
// Scalar: the limit (s), with the same bits for any number of ranks. The group must be all. Source:
// core/contact_network.h.
#pragma once

#include "compute.h"

namespace LAMMPS_NS {

class ComputeCDEMLimit : public Compute {
public:
  ComputeCDEMLimit(LAMMPS *, int, char **);
  void init() override;
  double compute_scalar() override;
};

} // namespace LAMMPS_NS
