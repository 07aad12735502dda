// SPDX-License-Identifier: GPL-2.0-or-later
// The pairs of discs that may touch before the next rebuild of their list: for each pair its constants and, next to
// them, what its contact remembers from step to step.
#pragma once

#include "column.h"
#include "kinematics.h"
#include "material.h"
#include "rules.h"

#include <array>
#include <vector>

namespace cdem {

// Eight pairs, with the eight values of each quantity side by side. All that a step of the direct law reads and writes
// for them is in one piece of memory, reached from one address.
struct alignas(64) PairGroup {
  static constexpr int SIZE = 8;
  static constexpr int ROW = sizeof(Disc<double>) / sizeof(double), SLOT = sizeof(Forces<double>) / sizeof(double);

  // Where the rows of the two discs (struct Disc) begin, and the slots for their forces (force_slots.h). Counted in
  // doubles: the processor multiplies an index by 8 in the address itself.
  int a[SIZE], b[SIZE], slot_a[SIZE], slot_b[SIZE];
  double radius_sum[SIZE], half_difference[SIZE], dashpot_scale[SIZE];
  double es[SIZE]; // the tangential spring (N); 0 only apart, see step_events.h
};

// What the loop over the pairs of a block prefetches, a part with every group: the rows that later blocks will read
// first, and the bodies (struct Body) of the block's own grains. It also prefetches later groups. Null: it prefetches
// nothing. A scene larger than the second-level cache would otherwise wait for memory; a smaller one gains nothing.
struct Ahead {
  const void *rows = nullptr, *bodies = nullptr;
};

// The pairs as the kernels see them. A column is an array with one entry per pair.
struct PairColumns {
  PairGroup *groups; // the loop may read one group past the end
  Forces<double> *slots;
  double *const *memories;        // what the law remembers in addition to the tangential spring
  const double *const *constants; // of the law, in addition to PairConstants
  double *friction, *dashpots;    // energy lost (J), see Losses
  // Forces of the dashpots at the beginning of the step: along n and t, then those of the law's additions.
  double *const *last_dashpots;
  Ahead ahead{};
};

// Force on disc a of a pair (N).
struct PairForce {
  double fx, fy;
};

class DiscPairs {
public:
  // Pairs begin ... end-1 of one block of discs (force_slots.h) that have the same material. A segment begins with a
  // new group; what is left over of its last group is not used.
  struct Segment {
    Material material;
    int begin, end;
  };

  std::vector<Segment> segments; // block k has segments first_segment[k] ... first_segment[k+1]-1
  std::vector<int> first_segment;
  Column<double> friction, dashpots; // J, see Losses; empty without an energy audit
  Column<PairForce> force; // of the last step whose pair forces were kept, see ForceSlots::of_pair; may be empty

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

  PairConstants<double> constants(int k) const {
    const PairGroup &g = group(k);
    return {g.radius_sum[k % SIZE], g.half_difference[k % SIZE], g.dashpot_scale[k % SIZE]};
  }
  void set_constants(int k, const PairConstants<double> &pair) {
    group(k).radius_sum[k % SIZE] = pair.radius_sum;
    group(k).half_difference[k % SIZE] = pair.half_difference;
    group(k).dashpot_scale[k % SIZE] = pair.dashpot_scale;
  }
  // What the contact remembers: the tangential spring (N), then the numbers that the law adds.
  std::array<double, 1 + MOST_NUMBERS> remembered(int k) const {
    std::array<double, 1 + MOST_NUMBERS> all{es(k)};
    for (std::size_t m = 0; m < memories.size(); m++)
      all[1 + m] = memories[m][k];
    return all;
  }
  void set_remembered(int k, const double *all) {
    group(k).es[k % SIZE] = all[0];
    for (std::size_t m = 0; m < memories.size(); m++)
      memories[m][k] = all[1 + m];
  }
  double es(int k) const { return group(k).es[k % SIZE]; }
  void set_es(int k, double spring) { group(k).es[k % SIZE] = spring; }
  // Constants of the law.
  std::array<double, MOST_NUMBERS> law_constants(int k) const {
    std::array<double, MOST_NUMBERS> all{};
    for (std::size_t c = 0; c < law_columns.size(); c++)
      all[c] = law_columns[c][k];
    return all;
  }
  void set_law_constants(int k, const double *all) {
    for (std::size_t c = 0; c < law_columns.size(); c++)
      law_columns[c][k] = all[c];
  }
  bool has_books() const { return !last_dashpots.empty(); }
  std::array<double, 2 + MOST_NUMBERS> last_dashpots_of(int k) const {
    std::array<double, 2 + MOST_NUMBERS> all{};
    for (std::size_t d = 0; d < last_dashpots.size(); d++)
      all[d] = last_dashpots[d][k];
    return all;
  }
  void set_last_dashpots(int k, const double *all) {
    for (std::size_t d = 0; d < last_dashpots.size(); d++)
      last_dashpots[d][k] = all[d];
  }

  // How many numbers per pair the law adds.
  struct Width {
    int memories = 0, constants = 0, last_dashpots = 0; // last_dashpots: 0 without an energy audit
    bool force = true;                                  // whether forces of single pairs are kept
  };
  // Makes room for segments of these sizes, in the order of blocks and within a block of materials. All entries are
  // zero.
  void lay_out(const std::vector<Material> &materials, const std::vector<int> &sizes, const Width &width) {
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
    memories.lay_out(width.memories, next);
    law_columns.lay_out(width.constants, next);
    last_dashpots.lay_out(width.last_dashpots, next);
    for (auto *column : {&friction, &dashpots})
      column->reset(has_books() ? next : 0);
    force.reset(width.force ? next : 0);
  }

  int entries() const { return int(groups.size() - 1) * SIZE; } // including those not used

  // Calls visit(k) for every pair, or for those of a block.
  template <class Visit> void for_each(Visit visit) const {
    for (std::size_t block = 0; block + 1 < first_segment.size(); block++)
      for_each_of_block(int(block), visit);
  }
  template <class Visit> void for_each_of_block(int block, Visit &&visit) const {
    for (int s = first_segment[block]; s < first_segment[block + 1]; s++)
      for (int k = segments[s].begin; k < segments[s].end; k++)
        visit(k);
  }

  PairColumns columns(Forces<double> *slots) {
    return {groups.data(),   slots,           memories.data(),     law_columns.data(),
            friction.data(), dashpots.data(), last_dashpots.data()};
  }

  double bytes() const {
    return double(groups.capacity()) * sizeof(PairGroup) + double(2 * friction.capacity()) * sizeof(double) +
           memories.bytes() + law_columns.bytes() + last_dashpots.bytes() +
           double(force.capacity()) * sizeof(PairForce);
  }

private:
  static constexpr int SIZE = PairGroup::SIZE, ROW = PairGroup::ROW, SLOT = PairGroup::SLOT;

  const PairGroup &group(int k) const { return groups[k / SIZE]; }
  PairGroup &group(int k) { return groups[k / SIZE]; }

  // Several columns, and pointers to their beginnings.
  class Columns {
  public:
    void lay_out(int count, int entries) {
      columns.resize(count);
      begins.clear();
      for (Column<double> &column : columns) {
        column.reset(entries);
        begins.push_back(column.data());
      }
    }
    std::size_t size() const { return columns.size(); }
    bool empty() const { return columns.empty(); }
    Column<double> &operator[](std::size_t k) { return columns[k]; }
    const Column<double> &operator[](std::size_t k) const { return columns[k]; }
    double *const *data() const { return begins.data(); }
    double bytes() const {
      double sum = 0;
      for (const Column<double> &column : columns)
        sum += double(column.capacity()) * sizeof(double);
      return sum;
    }

  private:
    std::vector<Column<double>> columns;
    std::vector<double *> begins;
  };

  Column<PairGroup> groups;
  Columns memories, law_columns, last_dashpots;
};

} // namespace cdem
