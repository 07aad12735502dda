// SPDX-License-Identifier: GPL-2.0-or-later
// What command cdem/create is asked for after its type: the same words in LAMMPS and in LIGGGHTS. `Words` reads the
// words of a command in turn (host/deck_words.h, liggghts/host.h), and ends the run with a message if one is missing or
// wrong.
#pragma once

#include "fill.h"

namespace cdem {

struct Creation {
  std::vector<PlacedDisc> discs;
  double density; // kg/m^2
};

template <class Words> double read_density(Words &words) {
  words.keyword("density");
  return words.positive("density");
}

// After the word row.
template <class Words> Creation read_row(Words &words) {
  const double x1 = words.number("X1"), y1 = words.number("Y1");
  const double x2 = words.number("X2"), y2 = words.number("Y2");
  const int n = words.count("number of discs");
  words.keyword("diameter");
  const double diameter = words.positive("diameter");
  const double density = read_density(words);
  return {discs_in_a_row({x1, y1}, {x2, y2}, n, diameter), density};
}

// After the word fill. Throws std::invalid_argument, which says what is wrong, if there are no such grains.
template <class Words> Creation read_fill(Words &words) {
  Filling grains{};
  grains.n = words.count("number of grains");
  words.keyword("region");
  grains.xlo = words.number("XLO"), grains.xhi = words.number("XHI");
  grains.ylo = words.number("YLO"), grains.yhi = words.number("YHI");
  words.keyword("diameter");
  grains.smallest = words.positive("DMIN"), grains.largest = words.positive("DMAX");
  words.keyword("power");
  grains.power = words.number("power");
  const double density = read_density(words);
  words.keyword("seed");
  return {grains.discs(words.count("seed")), density};
}

} // namespace cdem
