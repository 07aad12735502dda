// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/force part ...
//
// Forces on parts of the group, such as the loads on floor and sides of a box. A part is the atoms of the group that
// are in the LAMMPS group of that name; parts may overlap. Unlike compute reduce, it has the same bits for any number
// of ranks. Unlike fix cdem/move with speed 0, it does not claim the atoms, which may belong to a wall that moves.
//
// Global vector, extensive: 1 and 2 f_x and f_y of the first part (N), 3 and 4 of the second, ...: of contacts, and of
// fixes that add to f.
#pragma once

#include "compute.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class ComputeCDEMForce : public Compute {
public:
  ComputeCDEMForce(LAMMPS *, int, char **);

  void init() override { find_parts(); }
  void compute_vector() override;

private:
  void find_parts();

  std::vector<std::string> names;
  std::vector<int> parts; // bits of the groups
  std::vector<double> forces;
};

} // namespace LAMMPS_NS
