// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/energy
//
// Global vector (J):
//
//   1 translation  sum of m v^2/2 over the group
//   2 rotation     sum of I omega^2/2 over the group, I = m r^2/2 for a disc, or as fix cdem/shape has it
//   3 springs      sum of e_n^2/(2 k_n) + e_s^2/(2 k_s) over all contacts, whatever the group
//
// Scalar: the sum of the three. It is constant without damping and sliding, and while no wall moves, as far as the time
// step allows.
#pragma once

#include "compute.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {

class PairCDEM;

class ComputeCDEMEnergy : public Compute {
public:
  ComputeCDEMEnergy(LAMMPS *, int, char **);

  void init() override;
  double compute_scalar() override;
  void compute_vector() override;

private:
  enum Part { TRANSLATION, ROTATION, SPRINGS, NPARTS };

  const PairCDEM *pair = nullptr;
  std::vector<double> inertia; // over mass radius^2, by type
  std::array<double, NPARTS> energy{};
};

} // namespace LAMMPS_NS
