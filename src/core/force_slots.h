// SPDX-License-Identifier: GPL-2.0-or-later
// Where the force of each pair goes, and in what order it is summed. Every pair has a slot of its own for either disc,
// so that no two pairs ever write to one place; the slots of a disc are side by side, in an order that depends on the
// ids of its partners alone. Within a block of discs those with equally many slots follow each other: then the
// processor foresees the end of every sum.
#pragma once

#include "column.h"
#include "contact_law.h"
#include "disc_pairs.h"

#include <algorithm>
#include <vector>

namespace cdem {

// Discs order[begin] ... order[end-1], which have `count` slots each.
struct SlotRun {
  int count, begin, end;
};

// The sums of a block of discs; `slots` is its first.
struct SlotBlock {
  const Forces<double> *slots;
  const int *order;
  const SlotRun *begin, *end;
};

// The discs of one run; with a count that the compiler knows there is no loop left.
template <int known_count, class Visit>
[[gnu::always_inline]] inline const double *for_each_sum(const SlotRun &run, const int *order, const double *slot,
                                                         Visit visit) {
  const int count = known_count >= 0 ? known_count : run.count;
  for (int d = run.begin; d < run.end; d++) {
    Four sum{};
    for (int s = 0; s < count; s++, slot += 4)
      sum += load_raw<Four>(slot);
    visit(order[d], sum);
  }
  return slot;
}

// Calls visit(disc, sum of its forces) for the discs of a block.
template <class Visit> [[gnu::always_inline]] inline void for_each_sum(const SlotBlock &block, Visit visit) {
  const double *slot = &block.slots->fx;
  const int *const order = block.order;
  for (const SlotRun *run = block.begin; run != block.end; ++run)
    switch (run->count) { // discs of similar size in two dimensions have no more than six contacts
    case 2:
      slot = for_each_sum<2>(*run, order, slot, visit);
      break;
    case 3:
      slot = for_each_sum<3>(*run, order, slot, visit);
      break;
    case 4:
      slot = for_each_sum<4>(*run, order, slot, visit);
      break;
    case 5:
      slot = for_each_sum<5>(*run, order, slot, visit);
      break;
    case 6:
      slot = for_each_sum<6>(*run, order, slot, visit);
      break;
    default:
      slot = for_each_sum<-1>(*run, order, slot, visit);
    }
}

class ForceSlots {
public:
  // Rows starts[k] ... starts[k+1]-1 are block k. before(p, q) orders the pairs of a disc by the disc on the other
  // side.
  template <class Before> void build(DiscPairs &pairs, const std::vector<int> &starts, Before before) {
    const int n = starts.back(), total = sort_by_count(pairs, starts);
    pair_of_slot.resize(total);
    slots.reset(total + 1);
    std::vector<int> next = first;
    pairs.for_each([&](int k, const Material &) {
      for (int row : {pairs.a[k], pairs.b[k]})
        if (row < n)
          pair_of_slot[next[row]++] = k;
    });
    std::fill(pairs.slot_a.begin(), pairs.slot_a.end(), total);
    std::fill(pairs.slot_b.begin(), pairs.slot_b.end(), total);
    for (int row = 0; row < n; row++) {
      auto partner = [&](int k) { return pairs.a[k] == row ? pairs.b[k] : pairs.a[k]; };
      std::sort(pair_of_slot.begin() + first[row], pair_of_slot.begin() + next[row],
                [&](int k, int l) { return before(partner(k), partner(l)); });
      for (int s = first[row]; s < next[row]; s++)
        (pairs.a[pair_of_slot[s]] == row ? pairs.slot_a : pairs.slot_b)[pair_of_slot[s]] = s;
    }
  }

  int blocks() const { return int(first_run.size()) - 1; }
  SlotBlock block(int k) const {
    const SlotRun *const run = runs.data();
    return {&slots[first_slot[k]], order.data(), run + first_run[k], run + first_run[k + 1]};
  }

  // Calls visit(k) for every pair k of a disc.
  template <class Visit> void for_each(int row, Visit visit) const {
    const auto begin = pair_of_slot.begin() + first[row];
    std::for_each(begin, begin + counts[row], visit);
  }

  // The sum of one disc, to the bits of for_each_sum.
  Four sum(int row) const {
    Four sum{};
    for (int s = first[row]; s < first[row] + counts[row]; s++)
      sum += load_raw<Four>(&slots[s].fx);
    return sum;
  }

  // The force on disc a of pair k.
  Forces<double> of_pair(const DiscPairs &pairs, int k) const {
    const bool of_a = pairs.slot_a[k] != int(slots.size()) - 1; // the row of a is summed here
    return of_a ? slots[pairs.slot_a[k]] : opposite(slots[pairs.slot_b[k]]);
  }

  double bytes() const {
    return double(order.capacity() + first.capacity() + counts.capacity() + pair_of_slot.capacity()) * sizeof(int) +
           double(runs.capacity() * sizeof(SlotRun) + slots.capacity() * sizeof(slots[0]));
  }

  Column<Forces<double>> slots; // the last one is for what nobody sums

private:
  // Returns the number of slots.
  int sort_by_count(const DiscPairs &pairs, const std::vector<int> &starts) {
    const int n = starts.back();
    counts.assign(n, 0);
    pairs.for_each([&](int k, const Material &) {
      for (int row : {pairs.a[k], pairs.b[k]})
        if (row < n)
          counts[row]++;
    });
    order.resize(n);
    first.resize(n);
    runs.clear();
    first_run.assign(1, 0);
    first_slot.clear();
    int slot = 0;
    for (std::size_t k = 0; k + 1 < starts.size(); k++) {
      first_slot.push_back(slot);
      for (int row = starts[k]; row < starts[k + 1]; row++)
        order[row] = row;
      std::stable_sort(order.begin() + starts[k], order.begin() + starts[k + 1],
                       [&](int p, int q) { return counts[p] < counts[q]; });
      for (int d = starts[k]; d < starts[k + 1]; d++) {
        const int row = order[d];
        if (d == starts[k] || runs.back().count != counts[row])
          runs.push_back({counts[row], d, d});
        runs.back().end++;
        first[row] = slot;
        slot += counts[row];
      }
      first_run.push_back(int(runs.size()));
    }
    return slot;
  }

  std::vector<int> order;
  std::vector<int> first, counts, pair_of_slot; // of each disc the first slot and their number; of each slot the pair
  std::vector<SlotRun> runs;
  std::vector<int> first_run, first_slot; // of each block
};

} // namespace cdem
