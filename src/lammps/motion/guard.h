// SPDX-License-Identifier: GPL-2.0-or-later
// Stops a run that blows up, before its grains are lost, and names the grain.
//
// Unstable motion doubles every few steps, until a grain moves by a tenth of the smallest disc's radius in one step.
// Impacts that the time step resolves are never that fast: with a step of 0.9 of the limit, grains that meet at this
// speed overlap by a fifth of their radius, and with a smaller step by more. Slower grains may still fly out of the
// box. A weak instability does not grow to this speed, since contacts open and close in turn: ContactLimit has to find
// it.
#pragma once

#include "motion/rescue.h"

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class Guard : protected Pointers {
public:
  explicit Guard(LAMMPS *lmp) : Pointers(lmp), rescue(lmp) {}

  // The file to write on failure. Empty: none, and no copies are kept. Without this call, runs of up to 100000 atoms
  // per rank have one.
  void set_file(const std::string &name) {
    file = name;
    automatic = false;
  }

  // Smallest radius of a disc (m), and for messages the stability limit of the scene (s).
  void set_limits(double smallest_radius, double step_limit);
  // At the start of a run.
  void begin(double smallest_radius, double step_limit);
  // Whether grains that moved by up to `moved` in a step (m) have to be checked; true if it is NaN.
  bool suspects(double moved) const { return !(moved <= allowed); }
  // Whether grains are to be looked at in this step whatever their speed: a NaN never compares as too fast.
  bool is_due() const;
  // Looks at all grains; all ranks together. Ends the run if one is too fast or its position, velocity or force is not
  // a finite number.
  void check();
  // Ends the run if a grain is outside of the box, unless thermo_modify says that lost atoms are no error. To be called
  // before LAMMPS deletes them.
  void check_box();
  // Looks at all grains, and keeps a copy of the state if all is well.
  void keep();

  double bytes() const { return rescue.bytes(); }

private:
  void check_folder();
  double moved(int i) const;
  bool outside(int i) const;
  [[noreturn]] void fail(int owner, std::string what);
  std::string cause() const;

  std::string file = "rescue.restart";
  bool automatic = true;
  double allowed = 0; // largest motion of a grain in a step (m)
  double limit = 0;   // stability limit of the time step (s)
  Rescue rescue;
};

} // namespace LAMMPS_NS
