// SPDX-License-Identifier: GPL-2.0-or-later
// The list of disc pairs that may touch, made from LAMMPS's list of grain pairs, and the forces of these pairs. Each
// rank rebuilds its own list, without any communication, when discs that are not in it may have come within reach.
#pragma once

#include "contacts/line_feet.h"
#include "contacts/list_history.h"
#include "contacts/pair_search.h"
#include "contacts/pair_values.h"
#include "core/disc_pairs.h"
#include "core/force_kernel.h"
#include "core/grid_place.h"
#include "core/law_table.h"
#include "grains/grain_rows.h"

#include "pointers.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains;
class NeighList;
class Pair;

class DiscPairList : protected Pointers {
public:
  // `pair` sends rows to ghosts, see GrainRows.
  DiscPairList(LAMMPS *lmp, Pair *pair)
      : Pointers(lmp), rows(lmp, pair), values(lmp, rows, pairs, law), history(lmp, rows, pairs, feet, law, values),
        search(lmp, rows), feet(lmp, rows) {}

  void init(const cdem::LawTable &, const PairValues::ByTypes &, const std::string &instructions, FixCDEMHistory *,
            bool keeps_forces);

  // To be called when LAMMPS has rebuilt its list and the rows are filled.
  void rebuild(const NeighList *);
  // To be called before the forces if rows have moved: rebuilds the list if necessary. `moved`: no point of a grain has
  // moved further since the last call (m); without it, the motion is measured.
  void refresh(double moved);
  void refresh() { refresh(room_left); }
  // To be called when atoms may have been moved since the last step: takes their places to the rows, and the next
  // refresh() measures how far they are.
  void take_places();
  // To be called when the time step has changed: the scale of the dashpots depends on it.
  void renew_constants();

  // Computes the contact forces and adds them to f and torque of own grains. Calls visit(k, force on disc a) for every
  // pair that acts, if there is anything to call.
  using LookAtForce = std::function<void(int, const cdem::PairForce &)>;
  void forces(const LookAtForce &visit = {});
  // Computes the contact forces and moves the rows of own grains by a step. Sets f of the own walls in `felt` only.
  // Adds to the path of each grain, unless the last argument is null.
  void forces_and_advance(const cdem::StepRule &, const std::vector<int> &felt, cdem::Fastest &, cdem::Travel *);

  // How far any grain may still move before LAMMPS's list misses a pair of grains (m); less than 0: it may miss one
  // now.
  double room() const;
  double largest_reach() const; // the largest distance between disc and grain centre, of own grains (m)

  // The pairs of each disc, in the order of the sums; made when they are first asked for, and kept until the next list.
  const cdem::PairsOfDiscs &by_disc() const;

  GrainRows rows;
  cdem::DiscPairs pairs;
  cdem::ForceSlots slots;
  cdem::LawTable law;
  PairValues values;
  ListHistory history;

  double bytes() const {
    return rows.bytes() + pairs.bytes() + slots.bytes() +
           double((neighbours_built_at.capacity() + discs_built_at.capacity()) * sizeof(cdem::GridPlace) +
                  angle_built_at.capacity() * sizeof(double)) +
           history.bytes();
  }

private:
  void build();
  void divide_into_blocks();
  void find_pairs();
  void set_constants();
  void set_law_constants(int k);
  cdem::TwoGrains::Grain grain_of(int row) const;
  void pair_forces(int block);
  void look_at_forces(int block, const LookAtForce &);
  double most_moved() const;

  PairSearch search;
  LineFeet feet;
  FixCDEMGrains *grains = nullptr;
  const NeighList *neighbours = nullptr;
  const PairValues::ByTypes *coefficients = nullptr;
  std::string instructions;
  bool keeps_forces = true; // of single pairs, for those who look at them

  // Where grains were when a list was built: LAMMPS's list of grain pairs, or this list of disc pairs, which has a
  // smaller skin and must also be rebuilt when grains turn.
  std::vector<cdem::GridPlace> neighbours_built_at; // of own grains
  std::vector<cdem::GridPlace> discs_built_at;      // of all grains
  std::vector<double> angle_built_at;               // of all grains; empty if all are single discs
  double skin = 0;                                  // pairs with a gap up to this are in the list (m)
  double room_left = 0;                             // any point of a grain may still move at least so far (m)
  double speed = -1;        // largest distance from the last list, over its steps (m); -1: unknown
  bigint built_in_step = 0; // when the list was built
  bool is_of_run = false;   // whether it was built in this run

  std::vector<int> block_starts; // grains block_starts[k] ... block_starts[k+1]-1 are block k
  mutable std::optional<cdem::PairsOfDiscs> pairs_of_discs;
  cdem::Kernels kernels{};
  bool fetches_ahead = false; // see Ahead in core/disc_pairs.h
};

} // namespace LAMMPS_NS
