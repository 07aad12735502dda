// SPDX-License-Identifier: GPL-2.0-or-later
// The largest time step that is stable with the contacts of the present step; core/contact_network.h has the formulas.
#pragma once

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMIntegrate;

class ContactLimit : protected Pointers {
public:
  ContactLimit(LAMMPS *lmp, FixCDEMIntegrate *fix) : Pointers(lmp), integrate(fix) {}

  // All ranks together, at a time when the pair style's rows are those of the last forces. The search stops before its
  // best bound when it is `enough` (s).
  double find(double enough);

  // For the fix, which sends the weights of own grains to their ghosts.
  int pack(int n, const int *list, double *buf) const;
  void unpack(int n, int first, const double *buf);

private:
  FixCDEMIntegrate *integrate;
  std::vector<double> weights;
};

} // namespace LAMMPS_NS
