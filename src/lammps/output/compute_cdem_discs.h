// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/discs
//
// The discs of the grains and walls of the group, to draw them.
//
// Local array: one row per disc, with columns
//
//   1 id      of the grain
//   2 disc    number of the disc within its grain, from 0
//   3, 4 x y  centre of the disc (m)
//   5 radius  of the disc (m)
//   6 angle   by which the grain has turned so far (rad, counterclockwise; not reduced to a full turn)
//   7 type    of the grain
//
// For example:  compute d all cdem/discs
//               dump d all local 1000 discs.dump c_d[*]
//               dump_modify d format float %.9g
#pragma once

#include "host/local_array.h"

#include "compute.h"

namespace LAMMPS_NS {

class FixCDEMGrains;
class PairCDEM;

class ComputeCDEMDiscs : public Compute {
public:
  ComputeCDEMDiscs(LAMMPS *, int, char **);

  void init() override;
  void compute_local() override;
  double memory_usage() override;

private:
  const PairCDEM *pair = nullptr;
  const FixCDEMGrains *grains = nullptr;
  Shearbox::LocalArray discs;
};

} // namespace LAMMPS_NS
