// SPDX-License-Identifier: GPL-2.0-or-later
// The largest time step that is stable with the contacts of the present step; core/contact_network.h has the formulas.
#pragma once

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class Fix;

class ContactLimit : protected Pointers {
public:
  // `fix` sends the weights of own grains to their ghosts, by pack() and unpack().
  ContactLimit(LAMMPS *lmp, Fix *fix) : Pointers(lmp), carrier(fix) {}

  // All ranks together, at a time when the pair style's rows are those of the last forces. Begins with a guess, and
  // stops before its best bound when that is `enough` (both in s).
  double find(double guess, double enough);

  int pack(int n, const int *list, double *buf) const;
  void unpack(int n, int first, const double *buf);

private:
  Fix *carrier;
  std::vector<double> weights;
};

} // namespace LAMMPS_NS
