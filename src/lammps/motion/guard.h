// SPDX-License-Identifier: GPL-2.0-or-later
// Stops a run that blows up, before its grains are lost, and names the grain.
//
// Unstable motion doubles within some steps until a grain moves by a tenth of the smallest disc's radius in one step.
// No impact that is resolved in time is that fast: with a step of 0.9 of the limit, grains that meet at this speed
// overlap by a fifth of their radius, and with a smaller step by more. Slower grains may still fly out of the box. A
// weak instability ends before, when contacts open and close in turn; that is for ContactLimit to find.
#pragma once

#include "motion/rescue.h"

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class Guard : protected Pointers {
public:
  explicit Guard(LAMMPS *lmp) : Pointers(lmp), rescue(lmp) {}

  // The file to write on failure; empty: none, and no copies are kept. Without this call, small runs have one.
  void set_file(const std::string &name) {
    file = name;
    automatic = false;
  }

  // At the start of a run, with the smallest radius of a disc, and the stability limit of the scene for messages (s).
  void begin(double smallest_radius, double step_limit);
  // Whether a grain that moved so far in a step (m), or an unknown distance, is to be looked for.
  bool suspects(double moved) const { return !(moved <= allowed); }
  // Whether grains are to be looked at in this step whatever their speed: a NaN never compares as too fast.
  bool is_due() const;
  // Looks at all grains; all ranks together. Ends the run if one is too fast or its position, velocity or force is not
  // a finite number.
  void check();
  // Before LAMMPS deletes what is outside of the box, which is an error unless thermo_modify has it otherwise.
  void check_box();
  // Looks at all grains, and copies the state if all is well.
  void keep();

  double bytes() const { return rescue.bytes(); }

private:
  double moved(int i) const;
  bool outside(int i) const;
  [[noreturn]] void fail(int owner, std::string what);
  std::string cause() const;

  std::string file = "rescue.restart";
  bool automatic = true;
  double allowed = 0; // way of a grain in a step (m)
  double limit = 0;   // of the time step (s)
  Rescue rescue;
};

} // namespace LAMMPS_NS
