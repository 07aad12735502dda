// SPDX-License-Identifier: GPL-2.0-or-later
// The pairs of discs that may touch before the next rebuild, with all that is constant for a pair and what the contact
// remembers beside it.
#pragma once

#include "column.h"
#include "contact_law.h"

#include <vector>

namespace cdem {

// Eight pairs, one beside the other in each value. All that a step of the direct law reads and writes of them is in one
// piece of memory, found by one address.
struct alignas(64) PairGroup {
  static constexpr int SIZE = 8;
  static constexpr int ROW = sizeof(Disc<double>) / sizeof(double), SLOT = sizeof(Forces<double>) / sizeof(double);

  // Where the rows of the two discs, and the slots for their forces, begin: counted in doubles, which the processor's
  // addressing scales by itself.
  int a[SIZE], b[SIZE], slot_a[SIZE], slot_b[SIZE];
  double radius_sum[SIZE], half_difference[SIZE], root_mass[SIZE];
  double es[SIZE];
};

// What will be needed soon after the pairs of a block: the rows that no block has read yet, and the bodies of the
// block's grains. The loop over the pairs fetches some of both with every group, and of the groups to come, unless
// these are null: a scene that does not fit into the second cache would wait for memory, one that does is in no need of
// it.
struct Ahead {
  const void *rows = nullptr, *bodies = nullptr;
};

// The pairs as the kernels see them. Columns have one entry a pair.
struct PairColumns {
  PairGroup *groups; // one more may be read than there are
  Forces<double> *slots;
  double *en;                                          // of the incremental law
  double *friction, *dashpots, *dashpot_n, *dashpot_t; // see Losses
  Ahead ahead{};
};

// On the first disc of a pair (N).
struct PairForce {
  double fx, fy;
};

class DiscPairs {
public:
  // Pairs of the same two materials: begin ... end-1. Each segment begins with a group; what is left of its last one is
  // of no meaning.
  struct Segment {
    Material material;
    int begin, end;
  };

  std::vector<Segment> segments; // those of block k of the discs: first_segment[k] ... first_segment[k+1]-1
  std::vector<int> first_segment;
  Column<double> en;                                       // of the incremental law only
  Column<double> friction, dashpots, dashpot_n, dashpot_t; // see Losses; empty unless there are books
  Column<PairForce> force;                                 // of the last step that was kept, see ForceSlots::of_pair

  // Rows of the two discs of pair k; a belongs to the grain of the lower id.
  int a(int k) const { return group(k).a[k % SIZE] / ROW; }
  int b(int k) const { return group(k).b[k % SIZE] / ROW; }
  void set_discs(int k, int row_a, int row_b) {
    group(k).a[k % SIZE] = row_a * ROW;
    group(k).b[k % SIZE] = row_b * ROW;
  }
  // Where their forces go, see force_slots.h.
  int slot_a(int k) const { return group(k).slot_a[k % SIZE] / SLOT; }
  int slot_b(int k) const { return group(k).slot_b[k % SIZE] / SLOT; }
  void set_slot_a(int k, int slot) { group(k).slot_a[k % SIZE] = slot * SLOT; }
  void set_slot_b(int k, int slot) { group(k).slot_b[k % SIZE] = slot * SLOT; }

  Pair<double> constants(int k) const {
    const PairGroup &g = group(k);
    return {g.radius_sum[k % SIZE], g.half_difference[k % SIZE], g.root_mass[k % SIZE]};
  }
  void set_constants(int k, const Pair<double> &pair) {
    group(k).radius_sum[k % SIZE] = pair.radius_sum;
    group(k).half_difference[k % SIZE] = pair.half_difference;
    group(k).root_mass[k % SIZE] = pair.root_mass;
  }
  double es(int k) const { return group(k).es[k % SIZE]; }
  void set_es(int k, double es) { group(k).es[k % SIZE] = es; }

  // Makes room for segments of these sizes, by block and material, all entries zero.
  void lay_out(const std::vector<Material> &materials, const std::vector<int> &sizes, Law law, bool books = false) {
    segments.clear();
    first_segment.assign(1, 0);
    int next = 0;
    for (std::size_t m = 0; m < sizes.size(); m++) {
      if (sizes[m] > 0) {
        segments.push_back({materials[m % materials.size()], next, next + sizes[m]});
        next = (next + sizes[m] + SIZE - 1) / SIZE * SIZE;
      }
      if ((m + 1) % materials.size() == 0)
        first_segment.push_back(int(segments.size()));
    }
    groups.reset(next / SIZE + 1);
    en.reset(law == Law::incremental ? next : 0);
    for (auto *column : {&friction, &dashpots, &dashpot_n, &dashpot_t})
      column->reset(books ? next : 0);
    force.reset(next);
  }

  int entries() const { return int(groups.size() - 1) * SIZE; } // with those of no meaning

  // Calls visit(k, material) for every pair.
  template <class Visit> void for_each(Visit visit) const {
    for (const Segment &segment : segments)
      for (int k = segment.begin; k < segment.end; k++)
        visit(k, segment.material);
  }

  PairColumns columns(Forces<double> *slots) {
    return {groups.data(), slots, en.data(), friction.data(), dashpots.data(), dashpot_n.data(), dashpot_t.data()};
  }

  double bytes() const {
    return double(groups.capacity()) * sizeof(PairGroup) +
           double(en.capacity() + 4 * friction.capacity()) * sizeof(double) +
           double(force.capacity()) * sizeof(PairForce);
  }

private:
  static constexpr int SIZE = PairGroup::SIZE, ROW = PairGroup::ROW, SLOT = PairGroup::SLOT;

  const PairGroup &group(int k) const { return groups[k / SIZE]; }
  PairGroup &group(int k) { return groups[k / SIZE]; }

  Column<PairGroup> groups;
};

} // namespace cdem
