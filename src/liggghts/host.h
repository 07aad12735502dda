// SPDX-License-Identifier: GPL-2.0-or-later
// What all styles need of LIGGGHTS: registration, words of decks, errors, sums over ranks.
#pragma once

#include "core/exact_sum.h"

#include "fix.h"
#include "lammps.h"
#include "modify.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace Liggghts {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;

// LIGGGHTS keeps what its commands make in maps from names to creators, which are private. They are filled when a
// LIGGGHTS is made, before any library can be called; so ours are added when the first of our contact models is made.
using FixCreator = Fix *(*)(LAMMPS *, int, char **);
using CommandCreator = void (*)(LAMMPS *, int, char **);
std::map<std::string, FixCreator> &fix_styles(LAMMPS *);
std::map<std::string, CommandCreator> &commands(LAMMPS *);

// Ends the run with these words, one after the other; all ranks must call it.
[[noreturn]] void stop(LAMMPS *, const std::string &message);
template <class... Words> [[noreturn]] void stop(LAMMPS *lmp, const Words &...words) {
  std::ostringstream message;
  message.precision(4);
  (message << ... << words);
  stop(lmp, message.str());
}
// Writes a line to screen and log.
void tell(LAMMPS *, const std::string &line);

// The words of a command, from the first that is its own; `who` begins the error messages.
class Words {
public:
  Words(LAMMPS *lmp, std::string who, int narg, char **arg, int first)
      : lmp(lmp), who(std::move(who)), given(arg + first, arg + std::max(first, narg)) {}

  bool done() const { return next == given.size(); }
  int taken() const { return int(next); }
  std::string word(const char *what);
  double number(const char *what);
  double positive(const char *what);
  double not_negative(const char *what);
  int count(const char *what);
  void keyword(const char *expected);
  bool number_follows() const;

private:
  LAMMPS *lmp;
  std::string who;
  std::vector<std::string> given;
  std::size_t next = 0;
};

// The only fix of this class, or null.
template <class Style> Style *find_fix(LAMMPS *lmp) {
  for (int k = 0; k < lmp->modify->nfix; k++)
    if (auto *fix = dynamic_cast<Style *>(lmp->modify->fix[k]))
      return fix;
  return nullptr;
}

// The sum of all ranks' terms, with the same bits for any number of them.
double over_ranks(LAMMPS *, const cdem::ExactSum &mine);
double smallest_of_ranks(LAMMPS *, double mine);

} // namespace Liggghts
