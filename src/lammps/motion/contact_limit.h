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

  // The stable step (s); INFINITY without contacts. To be called by all ranks together, while the pair style's rows are
  // those of the last forces. Improves a first `guess` (s), and stops early once it has found `enough` (s).
  double find(double guess, double enough);

  int pack(int n, const int *list, double *buf) const;
  void unpack(int n, int first, const double *buf);

private:
  Fix *carrier;
  std::vector<double> weights;
};

} // namespace LAMMPS_NS
