// SPDX-License-Identifier: GPL-2.0-or-later
// The pairs of discs that may touch, drawn from LAMMPS's list of grain pairs, and the steps that are made on them. Each
// rank draws its own list anew, without any communication, when discs may have come within reach that are not in it.
#pragma once

#include "contacts/fix_cdem_history.h"
#include "core/disc_pairs.h"
#include "core/force_kernel.h"
#include "core/law_table.h"
#include "grains/grain_rows.h"

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMAudit;
class FixCDEMGrains;
class NeighList;
class Pair;

class DiscPairList : protected Pointers, public ContactList {
public:
  // `pair` sends the rows of own grains to their ghosts, by rows.pack() and rows.unpack().
  DiscPairList(LAMMPS *lmp, Pair *pair) : Pointers(lmp), rows(lmp), carrier(pair) {}

  // By the types of two atoms; row 0 and column 0 have no meaning.
  using ByTypes = std::vector<std::vector<cdem::Coefficients>>;
  void init(const cdem::LawTable &, const ByTypes &, const std::string &instructions, FixCDEMHistory *);

  void exchange_ghosts(); // the rows of ghosts, from their owners
  // LAMMPS has a new list, and the rows are filled.
  void rebuild(const NeighList *);
  // To be called before the forces if rows have moved, no point of a grain by more than this since the last call (m).
  void refresh(double moved);
  void refresh() { refresh(room_left); }
  // To be called when the time step has changed: the dashpots go with it.
  void renew_constants();

  // Adds to f and torque of own grains.
  void forces();
  // The same, but moves the rows of own grains; f of these own walls only. Adds to what they have travelled, unless
  // null.
  void forces_and_advance(const cdem::StepRule &, const std::vector<int> &felt, cdem::Fastest &, cdem::Travel *);

  // How far any grain may still move before LAMMPS's list misses a pair of grains (m); less than 0: it may miss one
  // now.
  double room() const;
  double largest_reach() const; // of a disc's centre from that of its grain

  void copy_history_to_grains() override;
  void move_history_to_grains() override;
  void close_list() override;

  // Losses of the contacts that this rank counts, to fix cdem/audit if there is one.
  void book_losses();
  bool keeps_books() const { return booking; }

  // --- of pair k, for all that looks at single contacts ---
  double mass(int k) const; // the reduced one of the two grains, or that of the grain that meets a wall
  double overlap(int k) const;
  bool acts(int k) const;   // also in the step after it opened, in which its forces may have a share left
  bool counts(int k) const; // whether this rank is the one that counts it
  const cdem::Material &material(int k) const;
  cdem::LawTable::Energy energy(int k, const cdem::Material &) const;
  cdem::Resistance resistance(int k) const;

  GrainRows rows;
  cdem::DiscPairs pairs;
  cdem::ForceSlots slots;
  cdem::LawTable law;

  double bytes() const {
    return rows.bytes() + double(found.capacity() * sizeof(Found)) + pairs.bytes() + slots.bytes();
  }

private:
  void build();
  void choose_skin();
  void divide_into_blocks();
  template <class Visit> void for_each_candidate(int i, Visit) const;
  void find_pairs();
  void refuse_same_centre(int p, int q) const;
  void set_constants();
  void set_law_constants(int k);
  cdem::TwoGrains::Grain grain_of(int row) const;
  void recall_history(int k);
  int most_pairs() const;
  void pair_forces(int block);
  void keep_forces(int block);
  void finish_step_in_books();

  // Where a grain was when LAMMPS's list of grain pairs was built, and this list of disc pairs. The latter has a
  // smaller skin and also ages when a grain turns.
  struct Place {
    double x, y;
    double moved(const cdem::Disc<double> &) const;
  };
  double most_moved() const;

  Pair *const carrier;
  FixCDEMAudit *audit = nullptr;
  FixCDEMGrains *grains = nullptr;
  FixCDEMHistory *history = nullptr;
  const NeighList *neighbours = nullptr;
  const ByTypes *coefficients = nullptr;
  std::string instructions;
  bool booking = false; // whether the list was built for an audit

  std::vector<Place> neighbours_built_at; // of own grains
  std::vector<Place> discs_built_at;      // of all grains
  std::vector<double> angle_built_at;     // of all grains, empty unless clumps
  double skin = 0;                        // discs no further apart than this are in the list (m)
  double room_left = 0;                   // at least so far may any point of a grain still move (m)
  double speed = -1;                      // at which the farthest got away from the last list (m a step), -1: unknown
  bigint built_in_step = 0;               // the list
  bool is_of_run = false;                 // whether it was built in this run

  std::vector<tagint> listed;    // ids of all grains, ghosts too, when the list of disc pairs was built
  std::vector<int> block_starts; // grains block_starts[k] ... block_starts[k+1]-1 are block k
  struct Found {
    int p, q, segment;
  };
  std::vector<Found> found; // pairs of rows for the list, those of the lower id first
  cdem::Kernels kernels{};
  bool fetches_ahead = false; // see core/disc_pairs.h
  bool has_history = false;   // whether the histories are here
};

} // namespace LAMMPS_NS
