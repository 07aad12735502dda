// SPDX-License-Identifier: GPL-2.0-or-later
// The words of a command in an input deck, read one after the other. If one is missing, the error names it.
#pragma once

#include "error.h"
#include "lammps.h"
#include "utils.h"

#include <climits>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

namespace Shearbox {

class DeckWords {
public:
  // Reads from arg[next] on. `who` begins all error messages: the command, or the style with its ID.
  DeckWords(LAMMPS_NS::LAMMPS *lmp, std::string who, int narg, char **arg, int next = 0)
      : lmp(lmp), who(std::move(who)), narg(narg), arg(arg), next(next) {}

  bool done() const { return next >= narg; }
  int read() const { return next; } // index of the next word in arg
  int left() const { return narg - next; }

  std::string word(const std::string &what) {
    if (done())
      lmp->error->all(FLERR, "{}: {} is missing", who, what);
    return arg[next++];
  }

  // The word after a keyword. If there is none it is "nothing", for the error message of the caller.
  std::string choice() { return done() ? "nothing" : arg[next++]; }

  // If the next word is `keyword`, takes it and returns true.
  bool take(const std::string &keyword) {
    if (done() || keyword != arg[next])
      return false;
    next++;
    return true;
  }
  void keyword(const char *name) {
    const std::string w = word(name);
    if (w != name)
      lmp->error->all(FLERR, "{}: {} where {} is expected", who, w, name);
  }

  bool number_follows() const { return !done() && LAMMPS_NS::utils::is_double(arg[next]); }
  // Infinite if the word is beyond the range of double: the caller has to refuse it.
  double number(const std::string &what) {
    const std::string w = value(what);
    if (!LAMMPS_NS::utils::is_double(w))
      lmp->error->all(FLERR, "{}: {} is {}, must be a number", who, what, w);
    return std::strtod(w.c_str(), nullptr);
  }
  double finite(const std::string &what) {
    const double x = number(what);
    if (!std::isfinite(x))
      lmp->error->all(FLERR, "{}: {} {}: must be a finite number", who, what, x);
    return x;
  }
  double positive(const std::string &what) {
    const double x = number(what);
    if (!(x > 0 && std::isfinite(x)))
      lmp->error->all(FLERR, "{}: {} {}: must be positive", who, what, x);
    return x;
  }
  int integer(const std::string &what) {
    const std::string w = value(what);
    const long long value = LAMMPS_NS::utils::is_integer(w) ? std::strtoll(w.c_str(), nullptr, 10) : LLONG_MAX;
    if (value < INT_MIN || value > INT_MAX)
      lmp->error->all(FLERR, "{}: {} is {}, must be an integer from {} to {}", who, what, w, INT_MIN, INT_MAX);
    return int(value);
  }
  int count(const std::string &what) {
    const int n = integer(what);
    if (n < 1)
      lmp->error->all(FLERR, "{}: {} {}: must be 1 or more", who, what, n);
    return n;
  }

  void end() const {
    if (!done())
      lmp->error->all(FLERR, "{}: unexpected {}", who, arg[next]);
  }

  LAMMPS_NS::LAMMPS *const lmp;
  const std::string who;

private:
  std::string value(const std::string &what) {
    if (done())
      lmp->error->all(FLERR, "{}: {} has no value", who, what);
    return arg[next++];
  }

  const int narg;
  char **const arg;
  int next;
};

} // namespace Shearbox
