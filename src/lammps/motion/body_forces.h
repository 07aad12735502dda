// SPDX-License-Identifier: GPL-2.0-or-later
// Gravity, drag and local damping of the grains, as the page of fix cdem/integrate has them, and the energy that drag
// and damping take out. In steps made on the rows, core/disc_motion.h adds the forces.
#pragma once

#include "host/deck_words.h"

#include "pointers.h"

namespace LAMMPS_NS {

class FixCDEMAudit;
class FixCDEMGrains;
class GrainRows;

class BodyForces : protected Pointers {
public:
  explicit BodyForces(LAMMPS *lmp) : Pointers(lmp) {}

  static constexpr const char *WORDS = "gravity GX GY, drag T, damping A";

  // If the next word is one of the keywords, reads it with its values and returns true.
  bool parse(Shearbox::DeckWords &);
  // Makes them part of the rule by which fix cdem/grains has steps made.
  void tell_grains();
  void init(); // when a run is prepared

  // What damping takes out is booked from the forces, which only a step on the atoms has.
  bool books_forces() const;
  // Adds them to the forces of the contacts; in a step, books what they take out if there is an audit.
  void add();
  // Books what drag takes out in a step made on the rows, if there is an audit.
  void book_drag(const GrainRows &);

private:
  void read_drag(Shearbox::DeckWords &);
  void damp();
  void damp(double &force, double velocity, double inverse_mass, double &lost) const;
  template <class Velocity> void book_drag_at(Velocity);

  double gravity[2] = {0, 0}, drag = 0, damping = 0; // m/s^2, 1/s, share of the force
  FixCDEMGrains *grains = nullptr;
  FixCDEMAudit *audit = nullptr;
};

} // namespace LAMMPS_NS
