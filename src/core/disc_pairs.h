// SPDX-License-Identifier: GPL-2.0-or-later
// The pairs of discs that may touch before the next rebuild, with all that is constant for a pair and what the contact
// remembers beside it. Forces are written per pair and summed per disc afterwards, so that no two pairs ever write to
// one place and the order of every sum is fixed by the ids of the grains, not by where they are in memory.
#pragma once

#include "column.h"
#include "contact_law.h"
#include "force_kernel.h"

#include <vector>

namespace cdem {

struct DiscPairs {
  // Pairs of the same two materials: begin ... end-1. Segments begin at multiples of the kernel's lanes; the entries
  // between two segments are of no meaning.
  struct Segment {
    Material material;
    int begin, end;
  };

  std::vector<Segment> segments;
  Column<int> a, b; // rows of the two discs; a belongs to the grain of the lower id
  Column<double> radius_sum, radius_difference, root_mass;
  Column<double> es, en;
  Column<Forces<double>> force;

  // Makes room for segments of these sizes, all entries zero.
  void lay_out(const std::vector<Material> &materials, const std::vector<int> &sizes) {
    segments.clear();
    int next = 0;
    for (std::size_t m = 0; m < sizes.size(); m++) {
      if (sizes[m] == 0)
        continue;
      segments.push_back({materials[m], next, next + sizes[m]});
      next = (next + sizes[m] + PairColumns::LANES - 1) / PairColumns::LANES * PairColumns::LANES;
    }
    a.reset(next);
    b.reset(next);
    for (auto *column : {&radius_sum, &radius_difference, &root_mass, &es, &en})
      column->reset(next);
    force.reset(next);
  }

  // Calls visit(k, material) for every pair.
  template <class Visit> void for_each(Visit visit) const {
    for (const Segment &segment : segments)
      for (int k = segment.begin; k < segment.end; k++)
        visit(k, segment.material);
  }

  void compute_forces(ForceKernel kernel, const Disc<double> *discs, double dt) {
    const PairColumns columns{a.data(),         b.data(),  radius_sum.data(), radius_difference.data(),
                              root_mass.data(), es.data(), en.data(),         force.data()};
    for (const Segment &s : segments)
      kernel(discs, columns, s.material, s.begin, s.end, dt);
  }

  double bytes() const { return double(a.size()) * (2 * sizeof(int) + 5 * sizeof(double) + sizeof(Forces<double>)); }
};

} // namespace cdem
