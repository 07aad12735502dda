// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/within.h"

#include "domain.h"
#include "error.h"
#include "input.h"
#include "variable.h"

using namespace LAMMPS_NS;

Within::Within(LAMMPS *lmp, const std::string &who, Shearbox::DeckWords &words) : Pointers(lmp), who(who) {
  if (!words.take("within"))
    return;
  for (Side &side : sides) {
    if (words.number_follows()) {
      side.word = "";
      side.value = words.finite("within");
      continue;
    }
    side.word = words.word("a side of within");
    if (side.word != "EDGE" && !side.is_variable())
      error->all(FLERR, "{}: within {}: must be a number, EDGE or v_NAME", who, side.word);
  }
}

void Within::init() {
  for (Side &side : sides) {
    if (!side.is_variable())
      continue;
    const std::string name = side.word.substr(2);
    side.variable = input->variable->find(name.c_str());
    if (side.variable < 0 || !input->variable->equalstyle(side.variable))
      error->all(FLERR, "{}: within {}: there is no equal-style variable {}", who, side.word, name);
  }
}

double Within::at(const Side &side, double edge) const {
  if (side.is_variable())
    return input->variable->compute_equal(side.variable);
  return side.word == "EDGE" ? edge : side.value;
}

cdem::Rectangle Within::rectangle() const {
  const cdem::Rectangle in{at(sides[0], domain->boxlo[0]), at(sides[1], domain->boxhi[0]),
                           at(sides[2], domain->boxlo[1]), at(sides[3], domain->boxhi[1])};
  check("x", in.xlo, in.xhi, domain->xperiodic ? domain->xprd : 0);
  check("y", in.ylo, in.yhi, domain->yperiodic ? domain->yprd : 0);
  return in;
}

void Within::check(const char *axis, double lo, double hi, double period) const {
  if (!(lo < hi))
    error->all(FLERR, "{}: within {} and {} in {}: the first must be below the second", who, lo, hi, axis);
  if (period > 0 && hi - lo > period * (1 + 1e-9))
    error->all(FLERR, "{}: within {} and {} in {}: longer than the period of the box, {}", who, lo, hi, axis, period);
}
