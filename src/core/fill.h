// SPDX-License-Identifier: GPL-2.0-or-later
// Discs that command cdem/create makes: in a row, or N grains whose diameters follow a power law, without overlap in a
// rectangle. The same input gives the same bits on every machine: the C++ standard fixes the generator, but not its
// distributions and std::shuffle, which are therefore not used.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace cdem {

class Random {
public:
  explicit Random(std::uint64_t seed) : engine(seed) {}

  double uniform() { return static_cast<double>(engine() >> 11) * 0x1p-53; } // in [0, 1)

  template <class T> void shuffle(std::vector<T> &items) {
    for (std::size_t n = items.size(); n > 1; --n)
      std::swap(items[n - 1], items[engine() % n]);
  }

private:
  std::mt19937_64 engine;
};

// The q-quantile of number density n(d) ~ d^power on [smallest, largest]: the inverse of its integral.
inline double power_law_quantile(double q, double smallest, double largest, double power) {
  const double p = power + 1, ratio = largest / smallest;
  const double d = std::fabs(p) < 1e-12 ? std::pow(ratio, q) : std::pow(1 + q * (std::pow(ratio, p) - 1), 1 / p);
  return std::clamp(smallest * d, smallest, largest);
}

// The law is divided into n equal shares, and each gives the diameter in its middle. So the law is met for any n, with
// the same diameters for any seed: only their order depends on the seed.
inline std::vector<double> power_law_diameters(int n, double smallest, double largest, double power, Random &random) {
  std::vector<double> diameters(n);
  for (int i = 0; i < n; ++i)
    diameters[i] = power_law_quantile((i + 0.5) / n, smallest, largest, power);
  random.shuffle(diameters);
  return diameters;
}

struct Place {
  double x, y;
};

// Positions of discs side by side in rows, from the bottom of a width x height box upward, in the given order. A row is
// as high as its largest disc. The width that a row leaves free, and the height that all rows leave free, are divided
// at random into gaps, so that no disc overlaps another or the box. `needed` returns the height of all rows; if that is
// more than `height`, no positions are returned.
inline std::vector<Place> rows_of_discs(const std::vector<double> &diameters, double width, double height,
                                        Random &random, double &needed) {
  struct Row {
    std::size_t first, end;
    double length, height;
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < diameters.size(); ++i) {
    if (rows.empty() || rows.back().length + diameters[i] > width)
      rows.push_back({i, i, 0, 0});
    Row &row = rows.back();
    row.end = i + 1;
    row.length += diameters[i];
    row.height = std::max(row.height, diameters[i]);
  }
  needed = 0;
  for (const Row &row : rows)
    needed += row.height;

  std::vector<Place> places;
  if (needed > height)
    return places;
  double y = 0;
  const double space = (height - needed) / static_cast<double>(rows.size()); // above each row, for the jitter in y
  for (const Row &row : rows) {
    std::vector<double> gaps(row.end - row.first);
    double total = random.uniform(); // the gap after the last disc
    for (double &gap : gaps)
      total += gap = random.uniform();
    double x = 0;
    for (std::size_t i = row.first; i < row.end; ++i) {
      const double d = diameters[i];
      x += (width - row.length) * gaps[i - row.first] / total;
      places.push_back({x + 0.5 * d, y + 0.5 * d + (row.height + space - d) * random.uniform()});
      x += d;
    }
    y += row.height + space;
  }
  return places;
}

struct PlacedDisc {
  double x, y, diameter; // of the centre, m
};

// n discs, their centres evenly spaced from one place to the other, both included.
inline std::vector<PlacedDisc> discs_in_a_row(Place from, Place to, int n, double diameter) {
  std::vector<PlacedDisc> discs;
  for (int i = 0; i < n; i++) {
    const double share = n > 1 ? double(i) / (n - 1) : 0;
    discs.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), diameter});
  }
  return discs;
}

// n grains in a rectangle. Throws std::invalid_argument, which says what is wrong.
struct Filling {
  int n;
  double xlo, xhi, ylo, yhi, smallest, largest, power;

  std::vector<PlacedDisc> discs(int seed) const {
    check();
    Random random(seed);
    const auto diameters = power_law_diameters(n, smallest, largest, power, random);
    double needed;
    const auto places = rows_of_discs(diameters, xhi - xlo, yhi - ylo, random, needed);
    if (places.empty())
      refuse(n, " grains of diameter ", smallest, " to ", largest, " fill a height of ", needed, " in the width ",
             xhi - xlo, "; the region has ", yhi - ylo);
    std::vector<PlacedDisc> discs;
    for (int i = 0; i < n; i++)
      discs.push_back({xlo + places[i].x, ylo + places[i].y, diameters[i]});
    return discs;
  }

private:
  void check() const {
    if (!(xlo < xhi && ylo < yhi && std::isfinite(xhi - xlo) && std::isfinite(yhi - ylo)))
      refuse("region ", xlo, " ", xhi, " ", ylo, " ", yhi, ": must be XLO < XHI, YLO < YHI");
    if (!(smallest <= largest))
      refuse("diameter ", smallest, " ", largest, ": must be DMIN <= DMAX");
    if (largest > xhi - xlo)
      refuse("grains of diameter ", largest, " do not fit in the width ", xhi - xlo, " of the region");
    if (!std::isfinite(power))
      refuse("power ", power, ": must be a number");
  }

  template <class... Words> [[noreturn]] static void refuse(const Words &...words) {
    std::ostringstream message;
    (message << ... << words);
    throw std::invalid_argument(message.str());
  }
};

} // namespace cdem
