// SPDX-License-Identifier: GPL-2.0-or-later
// Saves the state of a run that fails: two copies of it are kept in memory, taken in turn, and the older one (or the
// only one) can be written as a restart file. The older, since a run that is about to fail may have been damaged
// already when the newer one was taken.
//
// A copy has all that LAMMPS sends to another rank with an atom, including contacts and their history, and what fixes
// write into restart files.
#pragma once

#include "lmptype.h"
#include "pointers.h"

#include <map>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class Rescue : protected Pointers {
public:
  explicit Rescue(LAMMPS *lmp) : Pointers(lmp) {}

  // Forgets all copies.
  void clear() { copies[0] = copies[1] = {}; }
  void take();
  // Makes the older copy the state of the run and writes it; returns its step, -1 if there is no copy. To be called by
  // all ranks together. The run cannot be continued.
  bigint write(const std::string &file);

  double bytes() const;

private:
  struct Copy {
    bigint step = -1; // -1: none
    int natoms = 0;
    double low[3] = {}, high[3] = {}, tilt = 0; // the box
    std::vector<double> atoms;
    std::map<std::string, std::string> fixes; // what each writes into restart files, by its id; on the first rank only
  };

  void restore_box(const Copy &);
  void wrap_atoms();
  void pack_atoms(Copy &);
  void unpack_atoms(Copy &);
  void ask_fixes(Copy &);
  void tell_fixes(const Copy &);

  Copy copies[2]; // the older, the newer
};

} // namespace LAMMPS_NS
