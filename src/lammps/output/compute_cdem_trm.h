// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/trm
//
// Rotation rate of motion of each grain, over all steps since the compute was made (Matsunae, Seguro, Yoshida 2012,
// eq. 6):
//
//   TRM = sum r |d theta| / sum sqrt(dx^2 + dy^2)
//
// r is the radius of the grain, the circumscribed one if it has several discs. A disc that rolls has TRM = 1; above 1
// it spins, below 1 it slides. d theta, dx, dy are the exact increments of each step, so the result does not depend on
// how often it is output.
//
// Per-atom vector: TRM of the grain (no unit); 0 outside the group, for walls, and for a grain that never moved. In
// a variable of style atom it is C_ID; c_ID is the scalar there, as for all computes of LAMMPS that have both.
// Scalar: its mean over the grains of the group that have moved, with the same bits for any number of ranks.
// The sums are in restart files: after read_restart, make the compute with the same ID before the first run, and the
// sums continue. To begin anew, use uncompute and make it again. Needs atom_style sphere and fix cdem/integrate.
#pragma once

#include "compute.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains;
class FixCDEMTRM;

class ComputeCDEMTRM : public Compute {
public:
  ComputeCDEMTRM(LAMMPS *, int, char **);
  ~ComputeCDEMTRM() override;

  void init() override;
  double compute_scalar() override;
  void compute_peratom() override;
  double memory_usage() override;

private:
  bool counts(int i) const; // whether it is a grain of the group that has moved
  double ratio(int i) const;

  const std::string fix_id;
  FixCDEMTRM *sums = nullptr;
  const FixCDEMGrains *grains = nullptr;
  std::vector<double> ratios; // per atom
};

} // namespace LAMMPS_NS
