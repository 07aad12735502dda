// SPDX-License-Identifier: GPL-2.0-or-later
// The state that a fix keeps in restart files, with a mark, its version and its length in front. A file of another
// version is refused with the name of the style, and never misread. Every State has a constant VERSION: to be raised
// when fields are added, removed, or get another meaning.
#pragma once

#include "atom.h"
#include "error.h"
#include "fmt/format.h"
#include "lammps.h"
#include "lmptype.h"

#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>

namespace Shearbox {

struct StateHead {
  static constexpr int MARK = 0x53426f78; // "SBox"; no block of a version without heads begins with it
  int mark, version, length;
};

template <class State> void write_state(FILE *file, const State &state) {
  static_assert(std::is_trivially_copyable_v<State>);
  const StateHead head{StateHead::MARK, State::VERSION, int(sizeof(State))};
  const int size = int(sizeof(head) + sizeof(state)); // LAMMPS needs it in front
  fwrite(&size, sizeof(size), 1, file);
  fwrite(&head, sizeof(head), 1, file);
  fwrite(&state, sizeof(state), 1, file);
}

[[noreturn]] inline void refuse_state(LAMMPS_NS::LAMMPS *lmp, const std::string &style, const std::string &there) {
  const std::string message = "Fix " + style + ": the restart file holds " + there +
                              ": it was written by another version of Shearbox; go on with that one, or run from the "
                              "start with this one";
  lmp->error->all(FLERR, message);
}

template <class State> State read_state(LAMMPS_NS::LAMMPS *lmp, const char *style, const char *block) {
  StateHead head{0, 0, 0};
  memcpy(&head.mark, block, sizeof(head.mark)); // no block is shorter than this
  if (head.mark != StateHead::MARK)
    refuse_state(lmp, style, "a state without a version");
  memcpy(&head, block, sizeof(head));
  if (head.version != State::VERSION || head.length != int(sizeof(State)))
    refuse_state(lmp, style,
                 fmt::format("version {} of its state, {} bytes, where version {}, {} bytes, is needed", head.version,
                             head.length, int(State::VERSION), sizeof(State)));
  State state;
  memcpy(&state, block + sizeof(head), sizeof(state));
  return state;
}

// What a fix keeps of an atom in restart files: how many numbers there are, as LAMMPS needs it, the id of the atom, and
// the numbers. After read_restart LAMMPS holds the blocks by index, apart from the atoms, until the fixes are there;
// commands that delete or add atoms meanwhile leave them to others.
constexpr int HEAD_OF_ATOM = 2;

inline double *begin_atom(double *block, LAMMPS_NS::tagint tag, int count) {
  block[0] = HEAD_OF_ATOM + count;
  block[1] = LAMMPS_NS::ubuf(tag).d;
  return block + HEAD_OF_ATOM;
}

// LAMMPS passes the blocks of all fixes one after the other; `nth` is the place of this fix. `count` tells from the
// numbers how many there should be.
template <class Count>
const double *state_of_atom(LAMMPS_NS::LAMMPS *lmp, const char *style, int i, int nth, Count count) {
  const double *block = lmp->atom->extra[i];
  for (int skip = 0; skip < nth && int(*block) >= HEAD_OF_ATOM; skip++)
    block += int(*block);
  const double *const numbers = block + HEAD_OF_ATOM;
  if (int(*block) < HEAD_OF_ATOM || int(*block) != HEAD_OF_ATOM + count(numbers))
    lmp->error->one(FLERR,
                    "Fix {}: the restart file has no state of atom {} that this version of Shearbox knows: it was "
                    "written by another version, or atoms were added after read_restart: put 'run 0' before adding "
                    "them",
                    style, lmp->atom->tag[i]);
  if (LAMMPS_NS::tagint(LAMMPS_NS::ubuf(block[1]).i) != lmp->atom->tag[i])
    lmp->error->one(FLERR,
                    "Fix {}: atom {} has the state of atom {} from the restart file: atoms were deleted, or numbered "
                    "anew, since read_restart: put 'run 0' before that",
                    style, lmp->atom->tag[i], LAMMPS_NS::tagint(LAMMPS_NS::ubuf(block[1]).i));
  return numbers;
}

} // namespace Shearbox
