// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/grid NX NY [within XLO XHI YLO YHI] [field ...]
//
// The fields of compute cdem/average in each of NX times NY equal cells of the rectangle, at most 100000.
//
// Local array, for dump local, and global array with the same values, for fix ave/time mode vector: one row per cell,
// along x first, and one column per field, in the order given; by default all of these:
//
//   x y  centre of the cell (m)
//
// and then the fields of compute cdem/average. The cells may be smaller than grains.
//
// For example, stress and rotation in cells of 1 cm, for each frame of the other dumps:
//
//   compute cells grains cdem/grid 10 10 within 0 0.1 0 0.1 x y solid stress_xx stress_yy stress_xy spin
//   dump    cells all cdem/local 1000 cells.dump c_cells[*]
//   dump_modify cells format float %.9g
//
// The same bits for any number of ranks. Needs pair_style cdem.
#pragma once

#include "host/local_array.h"
#include "host/named_columns.h"
#include "output/cell_fields.h"

#include "compute.h"

namespace LAMMPS_NS {

class ComputeCDEMGrid : public Compute, public Shearbox::NamedColumns {
public:
  ComputeCDEMGrid(LAMMPS *, int, char **);

  void init() override;
  void compute_local() override;
  void compute_array() override;
  double memory_usage() override;
  std::vector<std::string> column_names() const override { return fields.names(); }

private:
  ComputeCDEMGrid(LAMMPS *, int, char **, Shearbox::DeckWords);
  void take_rows(Shearbox::LocalArray &);

  int nx, ny;
  CellFields fields;
  Shearbox::LocalArray local, global;
};

} // namespace LAMMPS_NS
