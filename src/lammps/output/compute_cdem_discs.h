// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/discs [field ...]
//
// The discs of the grains and walls of the group, to draw them. A piece of a line is shown by discs at its two ends.
//
// Local array: one row per disc, one column per field, in the order given; by default all of these:
//
//   id      of the grain
//   disc    number of the disc within its grain, from 0
//   x y     centre of the disc (m)
//   radius  of the disc (m)
//   angle   by which the grain has turned so far (rad, counterclockwise; not reduced to a full turn)
//   type    of the grain
//
// For example:  compute d all cdem/discs id x y radius
//               dump d all local 1000 discs.dump c_d[*]
//               dump_modify d format float %.9g
//
// Needs pair_style cdem.
#pragma once

#include "host/local_array.h"
#include "output/named_fields.h"

#include "compute.h"

#include <vector>

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
  struct Disc {
    tagint id;
    int number;
    double x, y, radius, angle;
    int type;
  };
  using Field = Shearbox::Field<Disc>;
  static const std::vector<Field> all_fields;

  std::vector<Field> fields;
  const PairCDEM *pair = nullptr;
  const FixCDEMGrains *grains = nullptr;
  Shearbox::LocalArray discs;
};

} // namespace LAMMPS_NS
