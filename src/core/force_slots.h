// SPDX-License-Identifier: GPL-2.0-or-later
// Where the force of each pair is stored, and in what order the forces are summed. Every pair has two slots of its own,
// one for the force on each of its discs, so no two pairs write to the same place. The slots of a disc are contiguous,
// in an order that depends only on the ids of the other discs. Discs are computed in blocks of some hundred. Within a
// block, discs with the same number of slots follow each other: then the processor predicts the end of every sum.
#pragma once

#include "column.h"
#include "disc_pairs.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace cdem {

// Discs order[begin] ... order[end-1], which have `count` slots each.
struct SlotRun {
  int count, begin, end;
};

// What the sums over a block of discs need; walls come last. `slots` is the first slot of the block.
struct SlotBlock {
  const Forces<double> *slots;
  const int *order;
  const SlotRun *begin, *end_of_grains, *end;
};

// The sums of one run. With a count that is known at compile time there is no inner loop left.
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

// Calls visit(disc, sum of its forces) for the discs of a block up to `end`: end_of_grains or end of the block.
template <class Visit>
[[gnu::always_inline]] inline void for_each_sum(const SlotBlock &block, const SlotRun *end, Visit visit) {
  const double *slot = &block.slots->fx;
  const int *const order = block.order;
  for (const SlotRun *run = block.begin; run != end; ++run)
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

// The block k to which a row belongs: starts[k] <= row < starts[k+1].
inline int block_of(const std::vector<int> &starts, int row) {
  return int(std::upper_bound(starts.begin(), starts.end(), row) - starts.begin()) - 1;
}

// The pairs of each disc of blocks. Made where it is needed, and not kept: a step does without.
class PairsOfDiscs {
public:
  // Of rows 0 ... n-1, in the order of the pairs.
  PairsOfDiscs(const DiscPairs &pairs, int n) : first(n + 1, 0) {
    auto for_each_side = [&](auto visit) {
      pairs.for_each([&](int k) {
        for (int row : {pairs.a(k), pairs.b(k)})
          if (row < n)
            visit(row, k);
      });
    };
    for_each_side([&](int row, int) { first[row + 1]++; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    all.resize(first.back());
    std::vector<int> next(first.begin(), first.end() - 1);
    for_each_side([&](int row, int k) { all[next[row]++] = k; });
  }

  int total() const { return int(all.size()); }
  int count(int row) const { return first[row + 1] - first[row]; }
  int *begin(int row) { return all.data() + first[row]; }
  int *end(int row) { return all.data() + first[row + 1]; }
  // Calls visit(k) for every pair k of a disc.
  template <class Visit> void for_each(int row, Visit visit) const {
    std::for_each(all.data() + first[row], all.data() + first[row + 1], visit);
  }

private:
  std::vector<int> first, all;
};

class ForceSlots {
public:
  // Rows starts[k] ... starts[k+1]-1 are block k. The forces on a disc are summed in ascending rank(row of the other
  // disc).
  template <class Rank, class IsWall>
  void build(DiscPairs &pairs, const std::vector<int> &starts, Rank rank, IsWall is_wall) {
    const int n = starts.back();
    PairsOfDiscs of_discs(pairs, n);
    counts.resize(n);
    for (int row = 0; row < n; row++)
      counts[row] = of_discs.count(row);
    make_runs(starts, is_wall);
    assign_slots(pairs, starts, of_discs.total());
    for (int k = 0; k < pairs.entries(); k++) {
      pairs.set_slot_a(k, unsummed());
      pairs.set_slot_b(k, unsummed());
    }
    struct Side {
      decltype(rank(0)) partner;
      int pair;
      bool is_a;
    };
    std::vector<Side> sides;
    for (int row = 0; row < n; row++) {
      sides.clear();
      of_discs.for_each(row, [&](int pair) {
        const bool is_a = pairs.a(pair) == row;
        sides.push_back({rank(is_a ? pairs.b(pair) : pairs.a(pair)), pair, is_a});
      });
      std::sort(sides.begin(), sides.end(), [](const Side &s, const Side &t) { return s.partner < t.partner; });
      int slot = first_slot[row];
      for (const auto &[partner, pair, is_a] : sides)
        is_a ? pairs.set_slot_a(pair, slot++) : pairs.set_slot_b(pair, slot++);
    }
  }

  // The pairs of each disc, in the order in which its forces are summed.
  PairsOfDiscs by_disc(const DiscPairs &pairs) const {
    PairsOfDiscs of_discs(pairs, int(counts.size()));
    for (int row = 0; row < int(counts.size()); row++) {
      auto slot = [&](int k) { return pairs.a(k) == row ? pairs.slot_a(k) : pairs.slot_b(k); };
      std::sort(of_discs.begin(row), of_discs.end(row), [&](int k, int l) { return slot(k) < slot(l); });
    }
    return of_discs;
  }

  // The sum of the forces on one disc, with the same bits as for_each_sum; valid until the next block is computed.
  Four sum(int row) const {
    Four sum{};
    for (int s = first_slot[row]; s < first_slot[row] + counts[row]; s++)
      sum += load_raw<Four>(&slots[s].fx);
    return sum;
  }

  // The force on disc a of pair k; valid until the next block is computed.
  PairForce of_pair(const DiscPairs &pairs, int k) const {
    const bool a_is_summed = pairs.slot_a(k) != unsummed();
    const Forces<double> &f = slots[a_is_summed ? pairs.slot_a(k) : pairs.slot_b(k)];
    return a_is_summed ? PairForce{f.fx, f.fy} : PairForce{-f.fx, -f.fy};
  }

  // One past the last row that pairs of blocks 0 ... k read, ghosts excepted.
  int read_end(int k) const { return read_ends[k]; }

  int blocks() const { return int(first_run.size()) - 1; }
  SlotBlock block(int k) const {
    const SlotRun *const run = runs.data();
    return {&slots[block_slot[k]], order.data(), run + first_run[k], run + first_wall_run[k], run + first_run[k + 1]};
  }
  Forces<double> *data() { return slots.data(); }

  double bytes() const {
    return double(order.capacity() + first_slot.capacity() + counts.capacity()) * sizeof(int) +
           double(runs.capacity() * sizeof(SlotRun) + slots.capacity() * sizeof(slots[0]));
  }

private:
  int unsummed() const { return int(slots.size()) - 1; } // of all forces that are not summed: on ghosts

  // In each block, grains come before walls, and discs with the same number of slots follow each other.
  template <class IsWall> void make_runs(const std::vector<int> &starts, IsWall is_wall) {
    order.resize(starts.back());
    for (std::size_t row = 0; row < order.size(); row++)
      order[row] = int(row);
    runs.clear();
    first_run.assign(1, 0);
    first_wall_run.clear();
    for (std::size_t k = 0; k + 1 < starts.size(); k++) {
      const auto begin = order.begin() + starts[k], end = order.begin() + starts[k + 1];
      const auto walls = std::stable_partition(begin, end, [&](int row) { return !is_wall(row); });
      add_runs(int(begin - order.begin()), int(walls - order.begin()));
      first_wall_run.push_back(int(runs.size()));
      add_runs(int(walls - order.begin()), int(end - order.begin()));
      first_run.push_back(int(runs.size()));
    }
  }

  void add_runs(int begin, int end) {
    std::stable_sort(order.begin() + begin, order.begin() + end, [&](int p, int q) { return counts[p] < counts[q]; });
    for (int d = begin; d < end; d++) {
      if (d == begin || runs.back().count != counts[order[d]])
        runs.push_back({counts[order[d]], d, d});
      runs.back().end++;
    }
  }

  // Blocks are computed and summed in turn. A pair may write to slots of a later block, so a block's slots are in use
  // from the first block with such a pair until its own sum. After that later blocks reuse the memory, so that all
  // slots in use stay in the cache.
  // `total`: forces to be summed in a step; there are fewer slots, since blocks reuse them.
  void assign_slots(const DiscPairs &pairs, const std::vector<int> &starts, int total) {
    const int blocks = int(starts.size()) - 1;
    std::vector<int> end(blocks + 1, 0); // end[k]: number of slots of the blocks before k
    read_ends.assign(blocks, 0);
    for (int k = 0; k < blocks; k++) {
      end[k + 1] = end[k];
      for (int row = starts[k]; row < starts[k + 1]; row++)
        end[k + 1] += counts[row];
      read_ends[k] = std::max(starts[k + 1], k ? read_ends[k - 1] : 0);
      pairs.for_each_of_block(k, [&](int p) {
        if (const int row = std::max(pairs.a(p), pairs.b(p)); row < starts.back())
          read_ends[k] = std::max(read_ends[k], row + 1);
      });
    }
    int in_use = 0, largest = 0;
    for (int k = 0; k < blocks; k++) {
      in_use = std::max(in_use, end[block_of(starts, read_ends[k] - 1) + 1] - end[k]);
      largest = std::max(largest, end[k + 1] - end[k]);
    }
    const int room = std::min(total, in_use + largest); // a block that does not fit at the end goes to the beginning
    slots.reset(room + 1);
    block_slot.assign(blocks, 0);
    first_slot.resize(starts.back());
    for (int k = 0, next = 0; k < blocks; k++) {
      if (next + end[k + 1] - end[k] > room)
        next = 0;
      block_slot[k] = next;
      for (int d = starts[k]; d < starts[k + 1]; d++) {
        first_slot[order[d]] = next;
        next += counts[order[d]];
      }
    }
  }

  Column<Forces<double>> slots;
  std::vector<int> order;
  std::vector<int> first_slot, counts; // of each disc
  std::vector<SlotRun> runs;
  std::vector<int> first_run, first_wall_run, block_slot, read_ends; // of each block
};

} // namespace cdem
