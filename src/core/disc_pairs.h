// SPDX-License-Identifier: GPL-2.0-or-later
// The pairs of discs that may touch before the next rebuild, with all that is constant for a pair and what the contact
// remembers beside it. Forces are written per pair and summed per disc afterwards, so that no two pairs ever write to
// one place and the order of every sum is fixed by the ids of the grains, not by where they are in memory.
#pragma once

#include "contact_law.h"

#include <vector>

namespace cdem {

struct DiscPairs {
  // Consecutive pairs of the same two materials.
  struct Segment {
    Material material;
    int begin, end;
  };

  std::vector<Segment> segments;
  std::vector<int> a, b; // rows of the two discs; a belongs to the grain of the lower id
  std::vector<double> radius_sum, radius_difference, root_mass;
  std::vector<double> es, en;
  std::vector<Forces<double>> force;

  int size() const { return int(a.size()); }

  void resize(int n) {
    a.resize(n);
    b.resize(n);
    for (auto *column : {&radius_sum, &radius_difference, &root_mass, &es, &en})
      column->resize(n);
    force.resize(n);
  }
};

template <Law law, bool limit_damping>
void compute_forces(const Disc<double> *discs, DiscPairs &p, double dt, double dt_history) {
  for (const auto &segment : p.segments)
    for (int k = segment.begin; k < segment.end; k++) {
      const Pair<double> pair{p.radius_sum[k], p.radius_difference[k], p.root_mass[k]};
      History<double> history{p.es[k], p.en[k]};
      p.force[k] = contact_force<law, limit_damping, double>(discs[p.a[k]], discs[p.b[k]], pair, segment.material, dt,
                                                             dt_history, history);
      p.es[k] = history.es;
      if constexpr (law == Law::incremental)
        p.en[k] = history.en;
    }
}

inline void compute_forces(Law law, bool limit_damping, const Disc<double> *discs, DiscPairs &pairs, double dt,
                           double dt_history) {
  const auto compute =
      law == Law::direct
          ? (limit_damping ? compute_forces<Law::direct, true> : compute_forces<Law::direct, false>)
          : (limit_damping ? compute_forces<Law::incremental, true> : compute_forces<Law::incremental, false>);
  compute(discs, pairs, dt, dt_history);
}

} // namespace cdem
