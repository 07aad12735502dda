// SPDX-License-Identifier: GPL-2.0-or-later
// The feet of discs on the lines of walls (core/wall_line.h). A pair of a disc and a piece of a line has a row of its
// own in place of the row of the piece. Before the forces of a step are computed it is placed where the disc's foot is,
// and then the pair is one of two discs like any other. Where two pieces meet, the one that is closer to the disc acts,
// and around a corner, whose round end is that of both, the one with the lower id; the foot on the other is placed far
// away, on the same normal, and remembers ELSEWHERE in place of its spring, which friction would need. So no event
// (step_events.h) is seen when a disc goes from one piece to the next: the foot that is left forgets the contact, and
// the one that takes over takes from the velocities of the step whether the disc touched the wall one step ago. The
// former piece is not asked: a rank that has the pair as a ghost's need not know it.
#pragma once

#include "core/disc_pairs.h"
#include "core/step_events.h"
#include "grains/grain_rows.h"

#include "pointers.h"

#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

class LineFeet : protected Pointers {
public:
  LineFeet(LAMMPS *lmp, GrainRows &of_grains) : Pointers(lmp), rows(of_grains) {}

  // To be called when LAMMPS has rebuilt its list and the rows are filled: finds which pieces may meet.
  void find_joints();
  // Gives every pair of a disc and a piece of a line a row for its foot. To be called last when a list of pairs is
  // made.
  void take_over(cdem::DiscPairs &);
  // Places the feet of the pairs of a block.
  void place(int block);
  void place_all();
  // To be called before and after the forces of a block, whose feet are placed: what its contacts remember. `dt`:
  // length of the step just made (s).
  void take_over_contacts(int block, cdem::DiscPairs &, double dt) const;
  void remember_elsewhere(int block, cdem::DiscPairs &) const;

private:
  // On the piece of row `piece`, of a disc, for a pair. `beside`: rows of the pieces that may meet it at one of its
  // ends before LAMMPS's next list.
  struct Foot {
    int disc, piece, pair;
    cdem::WallLine line;
    const std::vector<int> *beside;
    bool acts;
  };
  static constexpr double ELSEWHERE = 0.5 * cdem::TOUCHING; // N; no contact of a smooth wall remembers such a spring

  // The point of a piece's axis that is so far along it from its centre (m).
  GrainRows::Vector point_of(int row, const cdem::WallLine &, double along) const;
  // Whether the piece of this row has one of its ends within so far of a place (m).
  bool ends_at(int row, GrainRows::Vector place, double tolerance) const;
  bool acts(const Foot &, double along) const;
  double overlap_before(const cdem::DiscPairs &, int k, double dt) const;

  GrainRows &rows;
  std::vector<Foot> feet;
  std::vector<int> first_of_block; // the feet of block k are first_of_block[k] ... first_of_block[k+1]-1
  std::unordered_map<int, std::vector<int>> beside; // by row of a piece, ghosts too
};

} // namespace LAMMPS_NS
