// SPDX-License-Identifier: GPL-2.0-or-later
// A rectangle in a deck, `within XLO XHI YLO YHI`: each side is a number, EDGE (of the box), or v_NAME, an equal-style
// variable that is evaluated when the rectangle is needed.
#pragma once

#include "core/outline.h"
#include "host/deck_words.h"

#include "pointers.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

class Within : protected Pointers {
public:
  // Without the keyword, all sides are EDGE. `who` begins error messages.
  Within(LAMMPS *lmp, const std::string &who, Shearbox::DeckWords &words);

  void init(); // finds the variables
  cdem::Rectangle rectangle() const;

private:
  struct Side {
    std::string word = "EDGE";
    double value = 0;
    int variable = -1;
    bool is_variable() const { return word.rfind("v_", 0) == 0; }
  };
  double at(const Side &, double edge) const;
  void check(const char *axis, double lo, double hi, double period) const; // period: 0 if there is none

  const std::string who;
  std::array<Side, 4> sides; // xlo, xhi, ylo, yhi
};

} // namespace LAMMPS_NS
