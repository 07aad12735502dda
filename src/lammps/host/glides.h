// SPDX-License-Identifier: GPL-2.0-or-later
// What run_style verlet/cdem asks of a fix before it leaves LAMMPS's arrays alone. While it glides, steps are made on
// the rows of the pair style, and LAMMPS's calls of fixes within a step are left out. A fix that acts within a step and
// is not one of these ends gliding, whatever its name: all steps are then those of run_style verlet.
#pragma once

namespace cdem {
struct Travel;
}

namespace LAMMPS_NS {

class GrainRows;

// A fix that may be left out of glided steps.
class Glides {
public:
  virtual ~Glides() = default;
  // Whether it wants LAMMPS's calls in every step of this run all the same.
  virtual bool needs_every_step() const { return false; }
};

// One that sums what every grain does in every step: it is told of glided steps.
class SumsSteps : public Glides {
public:
  virtual cdem::Travel *travel() = 0;      // by atom, for the loop that moves the grains
  virtual void add(const GrainRows &) = 0; // the same, in a loop of its own
};

} // namespace LAMMPS_NS
