// SPDX-License-Identifier: GPL-2.0-or-later
// The contacts of the last step, for output. Reads the list of pairs and changes nothing.
#pragma once

#include "contacts/disc_pair_list.h"

#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {

class ContactReport : protected Pointers {
public:
  ContactReport(LAMMPS *lmp, const DiscPairList &of) : Pointers(lmp), list(of) {}

  // A contact of the last step (m, N). t = n turned by +90 degrees; the force on disc a is fn n + ft t. A contact that
  // opened within the step is included, with the part of its forces that still acts and an overlap below zero.
  struct Contact {
    tagint tag_a, tag_b;
    int grain_a, grain_b; // of this rank's atoms, own or ghost
    int disc_a, disc_b;
    double x, y;   // contact point
    double fn, ft; // with dashpots; fn > 0 repels
    double nx, ny; // from b to a
    double overlap;
    bool sliding;
    bool mine;                                             // whether this rank counts it, as exactly one does
    std::array<double, 1 + cdem::MOST_NUMBERS> remembered; // see LawTable::remembered
  };
  std::vector<Contact> contacts() const;

  // A disc of one of this rank's own grains, at the end of the last step.
  struct DiscPlace {
    int atom, disc;
    double x, y, radius;
  };
  std::vector<DiscPlace> discs() const;

  // Energy of the contacts that this rank counts (J).
  cdem::LawTable::Energy energy() const;

  // Sums over the contacts of own grain i with grain j, or with an image of j: energy (J), forces (N); `pull` is fn
  // over the distance of the discs (N/m).
  struct OfPair {
    double energy, pull, fn, ft, es;
  };
  OfPair of_pair(int i, int j) const;

private:
  Contact contact(int k) const;

  const DiscPairList &list;
};

} // namespace LAMMPS_NS
