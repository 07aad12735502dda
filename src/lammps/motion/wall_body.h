// SPDX-License-Identifier: GPL-2.0-or-later
// What fixes cdem/lid and cdem/move share: a rigid set of wall discs that moves in translation, without rotation.
//
// The discs of the group follow the motion that the fix prescribes or computes; contact forces act on the body as a
// whole. A disc belongs to one such body at most, and never to the grains that fix cdem/integrate moves.
#pragma once

#include "grains/grain_rows.h"
#include "host/deck_words.h"
#include "host/glides.h"

#include "fix.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMAudit;
class FixCDEMGrains;

class WallBody : public Fix, public Glides {
public:
  WallBody(LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void setup_pre_neighbor() override;
  void pre_neighbor() override;

  virtual bool follows_forces() const = 0; // whether it needs the forces in every step

  const std::vector<int> &own_discs() const { return discs; }

  bool is_audited() const { return audit; }

  // From now on the rows of the discs are moved instead of the atoms; null: the atoms again.
  void move_rows(GrainRows *);
  // Speed in the step that was begun last (m/s).
  double speed() const;

protected:
  using Vector = GrainRows::Vector;
  enum Axis { X, Y };

  bool in_group(int i) const;
  double angle(int i) const; // of a disc, or of a clump as part of a wall (rad)

  // The words of the fix after its style.
  Shearbox::DeckWords words_of(int narg, char **arg) const;

  // Sums over the discs (N, kg m/s, kg), with the same bits for any number of ranks. The force is that of the contacts
  // and of all else that writes f.
  double total_force(Axis) const;
  double force_unit = 1; // in which they are summed, N; see core/exact_sum.h
  double momentum(Axis) const;
  double total_mass() const;

  // Sets the velocity of all discs (m/s), and the acceleration (m/s^2) with which the velocity of the contacts'
  // dashpots is carried forward (see core/stability.h).
  void set_motion(Vector velocity, Vector acceleration);
  // Moves the discs by the displacement of a step (m), which was made at this mean velocity (m/s).
  void shift(Vector displacement, Vector velocity);
  // Takes the force on the body (N), at the end of a step or at setup, and books the work it did in the step if there
  // is an audit.
  void book_work(Vector force);
  void book_start(Vector force);

  // The force that was booked last, for restart files: at setup the dashpots take other velocities than at the end of
  // a step, so the work of a continued run would begin with another force.
  struct Booked {
    Vector force{0, 0};
    double step = -1; // at whose end it was taken; -1: never
  };
  Booked booked;

private:
  template <class Term> double sum(Term term, double unit = 1) const;
  template <class Term> double sum_of_small(Term term) const;
  void refuse_other_movers() const;
  bigint count_also_in(int other_groupbit) const;

  FixCDEMGrains *grains = nullptr;
  FixCDEMAudit *audit = nullptr;
  GrainRows *rows = nullptr; // null: the atoms themselves
  Vector displacement_of_step{0, 0}, velocity_of_step{0, 0}, acceleration_now{0, 0};
  std::vector<int> discs; // own atoms of the group, valid between rebuilds of the neighbour list
};

} // namespace LAMMPS_NS
