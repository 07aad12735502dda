// SPDX-License-Identifier: GPL-2.0-or-later
// What is left of a run that fails: two copies of its state in memory, taken in turn, of which the older can be written
// as a restart file. The older, since a run that is about to fail may have been ill when the newer one was taken.
//
// A copy has all that LAMMPS moves between ranks with an atom, contacts and their history with it, and what fixes write
// into restart files.
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
  // Makes the older copy the state of the run and writes it; returns its step. All ranks together. The run can't go on.
  bigint write(const std::string &file);

  double bytes() const;

private:
  struct Copy {
    bigint step = -1; // -1: none
    int natoms = 0;
    double low[3] = {}, high[3] = {}; // the box
    std::vector<double> atoms;
    std::map<std::string, std::string> fixes; // what they write into restart files, by id; on the first rank
  };

  void restore_box(const Copy &);
  void pack_atoms(Copy &);
  void unpack_atoms(Copy &);
  void ask_fixes(Copy &);
  void tell_fixes(const Copy &);

  Copy copies[2]; // the older, the newer
};

} // namespace LAMMPS_NS
