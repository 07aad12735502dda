// SPDX-License-Identifier: GPL-2.0-or-later
// The pairs of discs that may touch before the next rebuild, with all that is constant for a pair and what the contact
// remembers beside it.
#pragma once

#include "column.h"
#include "contact_law.h"

#include <vector>

namespace cdem {

// The columns as the kernels see them, one entry a pair.
struct PairColumns {
  const int *a, *b;
  const int *slot_a, *slot_b;
  const double *radius_sum, *half_difference, *root_mass;
  double *es, *en;
  Forces<double> *slots;
  double *friction, *dashpots, *dashpot_n, *dashpot_t; // see Losses
};

struct DiscPairs {
  // So many pairs are computed at a time: whole groups of them, aligned, may be read and written.
  static constexpr int LANES = 8;

  // Pairs of the same two materials: begin ... end-1. Segments begin at multiples of LANES; the entries between two
  // segments are of no meaning.
  struct Segment {
    Material material;
    int begin, end;
  };

  std::vector<Segment> segments; // those of block k of the discs: first_segment[k] ... first_segment[k+1]-1
  std::vector<int> first_segment;
  Column<int> a, b;           // rows of the two discs; a belongs to the grain of the lower id
  Column<int> slot_a, slot_b; // where their forces go, see force_slots.h
  Column<double> radius_sum, half_difference, root_mass;
  Column<double> es, en;                                   // en: of the incremental law only
  Column<double> friction, dashpots, dashpot_n, dashpot_t; // see Losses; empty unless there are books
  Column<Forces<double>> force;                            // of the last step that was kept, see ForceSlots::of_pair

  // Makes room for segments of these sizes, by block and material, all entries zero.
  void lay_out(const std::vector<Material> &materials, const std::vector<int> &sizes, Law law, bool books = false) {
    segments.clear();
    first_segment.assign(1, 0);
    int next = 0;
    for (std::size_t m = 0; m < sizes.size(); m++) {
      if (sizes[m] > 0) {
        segments.push_back({materials[m % materials.size()], next, next + sizes[m]});
        next = (next + sizes[m] + LANES - 1) / LANES * LANES;
      }
      if ((m + 1) % materials.size() == 0)
        first_segment.push_back(int(segments.size()));
    }
    for (auto *column : {&a, &b, &slot_a, &slot_b})
      column->reset(next);
    for (auto *column : {&radius_sum, &half_difference, &root_mass, &es})
      column->reset(next);
    en.reset(law == Law::incremental ? next : 0);
    for (auto *column : {&friction, &dashpots, &dashpot_n, &dashpot_t})
      column->reset(books ? next : 0);
    force.reset(next);
  }

  // Calls visit(k, material) for every pair.
  template <class Visit> void for_each(Visit visit) const {
    for (const Segment &segment : segments)
      for (int k = segment.begin; k < segment.end; k++)
        visit(k, segment.material);
  }

  PairColumns columns(Forces<double> *slots) {
    return {a.data(),         b.data(),        slot_a.data(), slot_b.data(), radius_sum.data(), half_difference.data(),
            root_mass.data(), es.data(),       en.data(),     slots,         friction.data(),   dashpots.data(),
            dashpot_n.data(), dashpot_t.data()};
  }

  double bytes() const {
    return double(a.capacity()) * 4 * sizeof(int) + double(es.capacity()) * 4 * sizeof(double) +
           double(en.capacity() + 4 * friction.capacity()) * sizeof(double) +
           double(force.capacity()) * sizeof(Forces<double>);
  }
};

} // namespace cdem
