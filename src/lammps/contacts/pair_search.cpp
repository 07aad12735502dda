// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/pair_search.h"

#include "core/force_slots.h"
#include "core/list_skin.h"
#include "grains/fix_cdem_grains.h"

#include "atom.h"
#include "error.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// A pair that opens in a step must stay in the list for the next one, in which part of its forces may still act. The
// bits of the forces do not depend on the skin.
double PairSearch::cheapest_skin(const NeighList &neighbours, double step, double speed) const {
  constexpr double LEAST = 0.01, SAFETY = 8;
  constexpr int LOOKED_AT = 256; // grains, enough for an estimate
  const double largest = neighbor->skin;
  const int every = std::max(1, neighbours.inum / LOOKED_AT);
  double touching = 0, near = 0;
  for (int ii = 0; ii < neighbours.inum; ii += every)
    for_each_candidate(neighbours, neighbours.ilist[ii], largest, [&](int p, int q, double square) {
      (std::sqrt(square) < rows.radius(p) + rows.radius(q) ? touching : near) += every;
    });
  const double cheapest =
      cdem::cheapest_skin(rows.rows_of(atom->nlocal), touching, near / largest, speed < 0 ? step : speed);
  return std::min(std::max({cheapest, LEAST * largest, SAFETY * step}), largest);
}

// Calls visit(row, row, square of their distance) for all pairs of discs of grain i and of its neighbours in LAMMPS's
// list with a gap up to the skin.
template <class Visit>
void PairSearch::for_each_candidate(const NeighList &neighbours, int i, double skin, Visit visit) const {
  for (int jj = 0; jj < neighbours.numneigh[i]; jj++) {
    const int j = neighbours.firstneigh[i][jj] & NEIGHMASK;
    if (!grains->is_free(i) && !grains->is_free(j))
      continue;
    for (int p = rows.rows_of(i); p < rows.rows_of(i + 1); p++)
      for (int q = rows.rows_of(j); q < rows.rows_of(j + 1); q++) {
        const double square = square_distance(p, q), reach = rows.radius(p) + rows.radius(q) + skin;
        if (square < reach * reach)
          visit(p, q, square);
      }
  }
}

// Of two discs, or of a disc and the axis of a piece of a line.
double PairSearch::square_distance(int p, int q) const {
  if (rows.has_lines()) {
    if (rows.is_line(p))
      return cdem::square_distance(rows[q], rows[p], rows.line(p));
    if (rows.is_line(q))
      return cdem::square_distance(rows[p], rows[q], rows.line(q));
  }
  const double dx = rows[p].x - rows[q].x, dy = rows[p].y - rows[q].y;
  return dx * dx + dy * dy;
}

void PairSearch::find(const NeighList &neighbours, double skin, const std::vector<int> &starts,
                      const std::vector<cdem::Material> &by_types, const cdem::DiscPairs::Width &width,
                      cdem::DiscPairs &pairs) const {
  const int types = atom->ntypes + 1;
  int lower = -1, block = 0; // of the pair before
  auto segment_of = [&](int i, int j) {
    if (std::min(i, j) != lower)
      block = cdem::block_of(starts, lower = std::min(i, j));
    const auto [low, high] = std::minmax(atom->type[i], atom->type[j]);
    return (block * types + low) * types + high;
  };

  std::vector<int> sizes(by_types.size() * (starts.size() - 1), 0), next(sizes.size(), 0);
  struct Found {
    int p, q, segment; // rows; p is of the grain of the lower id
  };
  std::vector<Found> found;
  std::size_t most = 0; // of atoms that are in LAMMPS's list: neigh_modify include leaves out others
  for (int ii = 0; ii < neighbours.inum; ii++)
    most += neighbours.numneigh[neighbours.ilist[ii]];
  found.reserve(most);
  for (int ii = 0; ii < neighbours.inum; ii++)
    for_each_candidate(neighbours, neighbours.ilist[ii], skin, [&](int p, int q, double square) {
      const int i = rows.grain(p), j = rows.grain(q), segment = segment_of(i, j);
      if (square == 0)
        refuse_same_centre(p, q);
      const bool p_first = atom->tag[i] < atom->tag[j];
      found.push_back({p_first ? p : q, p_first ? q : p, segment});
      sizes[segment]++;
    });
  pairs.lay_out(by_types, sizes, width);
  auto segment = pairs.segments.begin();
  for (std::size_t m = 0; m < sizes.size(); m++)
    if (sizes[m])
      next[m] = (segment++)->begin;
  for (const auto &[p, q, segment] : found)
    pairs.set_discs(next[segment]++, p, q);
}

void PairSearch::refuse_same_centre(int p, int q) const {
  error->one(FLERR,
             "Pair style cdem: discs of atoms {} and {} have the same centre ({}, {}): no direction to push them apart",
             atom->tag[rows.grain(p)], atom->tag[rows.grain(q)], rows[p].x, rows[p].y);
}
