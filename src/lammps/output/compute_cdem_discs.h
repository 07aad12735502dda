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
//   z       0, for programs that cannot do without
//
// For example, discs that OVITO and others draw like any atoms:
//
//   compute d all cdem/discs id type x y z radius
//   dump d all cdem/local 1000 discs.dump c_d[*]
//   dump_modify d format float %.9g label ATOMS
//
// Needs pair_style cdem.
#pragma once

#include "host/local_array.h"
#include "host/named_columns.h"
#include "output/named_fields.h"

#include "compute.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains;
class PairCDEM;

class ComputeCDEMDiscs : public Compute, public Shearbox::NamedColumns {
public:
  ComputeCDEMDiscs(LAMMPS *, int, char **);

  void init() override;
  void compute_local() override;
  double memory_usage() override;
  std::vector<std::string> column_names() const override { return Shearbox::names_of(fields); }

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
