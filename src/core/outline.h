// SPDX-License-Identifier: GPL-2.0-or-later
// The outline of a grain, and the area that it encloses inside a rectangle.
//
// By Green's theorem the area of U inside the rectangle is the integral of P(x) dy over the outline of U, where it is
// between ylo and yhi; P(x) = 0 left of the rectangle, x - xlo in it, xhi - xlo right of it. Arcs are cut where they
// cross a side, so each integrand is a polynomial in cos and sin of the arc's angle: exact to round-off.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cdem {

struct Rectangle {
  double xlo, xhi, ylo, yhi;
};

// Part of a circle about (x, y), from one angle to a larger one, counterclockwise.
struct CircleArc {
  double x, y, r, from, to;
};

// Arcs that enclose an area, which lies to their left.
using Outline = std::vector<CircleArc>;

// Integral of P(x) dy over an arc that crosses no side of the rectangle.
inline double area_left_of(const CircleArc &arc, const Rectangle &in) {
  const double middle = (arc.from + arc.to) / 2;
  const double x = arc.x + arc.r * std::cos(middle), y = arc.y + arc.r * std::sin(middle);
  if (y <= in.ylo || y >= in.yhi || x <= in.xlo)
    return 0;
  const double rise = arc.r * (std::sin(arc.to) - std::sin(arc.from));
  if (x >= in.xhi)
    return (in.xhi - in.xlo) * rise;
  const double squares = (arc.to - arc.from) / 2 + (std::sin(2 * arc.to) - std::sin(2 * arc.from)) / 4;
  return (arc.x - in.xlo) * rise + arc.r * arc.r * squares;
}

// Angles at which the arc crosses a side of the rectangle, with its two ends, in ascending order.
class Cuts {
public:
  Cuts(const CircleArc &arc, const Rectangle &in) {
    add(arc.from);
    for (double side : {in.xlo, in.xhi})
      if (const double c = (side - arc.x) / arc.r; std::fabs(c) < 1)
        add_within(arc, {std::acos(c), -std::acos(c)});
    for (double side : {in.ylo, in.yhi})
      if (const double s = (side - arc.y) / arc.r; std::fabs(s) < 1)
        add_within(arc, {std::asin(s), M_PI - std::asin(s)});
    add(arc.to);
    std::sort(begin(), end());
  }

  double *begin() { return angles.data(); }
  double *end() { return angles.data() + n; }

private:
  void add(double angle) { angles[n++] = angle; }
  void add_within(const CircleArc &arc, std::array<double, 2> both) {
    for (double angle : both) {
      const double from_start = std::fmod(angle - arc.from, 2 * M_PI);
      const double at = arc.from + (from_start < 0 ? from_start + 2 * M_PI : from_start);
      if (at < arc.to)
        add(at);
    }
  }

  std::array<double, 10> angles; // two ends, and two for each side
  int n = 0;
};

inline double area_within(const Outline &outline, const Rectangle &in) {
  double sum = 0;
  for (const CircleArc &arc : outline) {
    Cuts cuts(arc, in);
    for (const double *cut = cuts.begin(); cut + 1 != cuts.end(); ++cut)
      sum += area_left_of({arc.x, arc.y, arc.r, cut[0], cut[1]}, in);
  }
  return sum;
}

} // namespace cdem
