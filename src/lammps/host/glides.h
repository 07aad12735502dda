// SPDX-License-Identifier: GPL-2.0-or-later
// Which fixes may be left out while run_style verlet/cdem glides. To glide is to make steps on the rows of the pair
// style alone (grains/grain_rows.h): LAMMPS's arrays stay as they are, and fixes are not called within the step. A fix
// that acts within a step and has none of these interfaces prevents it: all steps are then those of run_style verlet.
#pragma once

namespace cdem {
struct Travel;
}

namespace LAMMPS_NS {

class GrainRows;

// A fix that need not be called in glided steps.
class Glides {
public:
  // Whether it must be called in every step of this run nevertheless: then nothing glides.
  virtual bool needs_every_step() const { return false; }

protected:
  ~Glides() = default;
};

// A fix that sums up the motion of every grain in every step: it gets glided steps too, in one of two ways.
class SumsSteps : public Glides {
public:
  virtual cdem::Travel *travel() = 0;      // its sums by atom: the loop that moves the grains adds to them
  virtual void add(const GrainRows &) = 0; // adds a step, in a loop of its own

protected:
  ~SumsSteps() = default;
};

} // namespace LAMMPS_NS
