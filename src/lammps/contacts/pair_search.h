// SPDX-License-Identifier: GPL-2.0-or-later
// Finds the pairs of discs that may touch before their list is drawn anew: discs of grains that are neighbours in
// LAMMPS's list, with a gap up to a skin. Walls have no pairs with each other.
#pragma once

#include "core/disc_pairs.h"
#include "grains/grain_rows.h"

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains;
class NeighList;

class PairSearch : protected Pointers {
public:
  PairSearch(LAMMPS *lmp, const GrainRows &of_grains) : Pointers(lmp), rows(of_grains) {}

  void init(const FixCDEMGrains *fix) { grains = fix; }

  // The skin (m) with which a list costs least, see core/list_skin.h. `step`: no point of a grain moves further in a
  // step now (m); `speed`: the same as it was seen to be (m a step), -1 if that is unknown.
  double cheapest_skin(const NeighList &, double step, double speed) const;
  // Lays out all pairs with a gap up to the skin. Segments are in the order of blocks, and within a block in that of
  // materials, which are by two atom types; grains starts[k] ... starts[k+1]-1 are block k.
  void find(const NeighList &, double skin, const std::vector<int> &starts, const std::vector<cdem::Material> &,
            const cdem::DiscPairs::Width &, cdem::DiscPairs &) const;

private:
  template <class Visit> void for_each_candidate(const NeighList &, int i, double skin, Visit) const;
  double square_distance(int p, int q) const;
  void refuse_same_centre(int p, int q) const;

  const GrainRows &rows;
  const FixCDEMGrains *grains = nullptr;
};

} // namespace LAMMPS_NS
