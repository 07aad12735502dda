// SPDX-License-Identifier: GPL-2.0-or-later
// A rectangle divided into equal cells, and which part of a line or of a grain lies in which cell.
#pragma once

#include "outline.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cdem {

struct Point {
  double x, y;
};

class CellGrid {
public:
  CellGrid(const Rectangle &all, int nx, int ny) : xs{all.xlo, all.xhi, nx}, ys{all.ylo, all.yhi, ny} {}

  int cells() const { return xs.n * ys.n; }
  // Cells are numbered along x first.
  Rectangle cell(int k) const {
    const int i = k % xs.n, j = k / xs.n;
    return {xs.edge(i), xs.edge(i + 1), ys.edge(j), ys.edge(j + 1)};
  }

  // Calls visit(cell, share of the line) for the cells that a straight line passes. A line along the edge between two
  // cells is in the upper or right one.
  template <class Visit> void share_line(Point from, Point to, Visit visit) const {
    if (xs.misses(from.x, to.x) || ys.misses(from.y, to.y))
      return;
    if (const int i = xs.index(from.x), j = ys.index(from.y);
        xs.has(i) && ys.has(j) && i == xs.index(to.x) && j == ys.index(to.y)) {
      visit(j * xs.n + i, 1.0);
      return;
    }
    std::vector<double> cuts{0, 1};
    xs.cut(from.x, to.x, cuts);
    ys.cut(from.y, to.y, cuts);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); k++) {
      const double middle = (cuts[k] + cuts[k + 1]) / 2, share = cuts[k + 1] - cuts[k];
      const int i = xs.index(from.x + middle * (to.x - from.x)), j = ys.index(from.y + middle * (to.y - from.y));
      if (share > 0 && xs.has(i) && ys.has(j))
        visit(j * xs.n + i, share);
    }
  }

  // Calls visit(cell, area) for the cells that have a part of a grain: its outline, the circle around it, its area.
  template <class Visit>
  void share_area(const Outline &outline, Point centre, double radius, double area, Visit visit) const {
    const int left = xs.index(centre.x - radius), right = xs.index(centre.x + radius);
    const int bottom = ys.index(centre.y - radius), top = ys.index(centre.y + radius);
    if (left == right && bottom == top) {
      if (xs.has(left) && ys.has(bottom))
        visit(bottom * xs.n + left, area);
      return;
    }
    for (int j = std::max(bottom, 0); j <= std::min(top, ys.n - 1); j++)
      for (int i = std::max(left, 0); i <= std::min(right, xs.n - 1); i++)
        if (const double part = area_within(outline, cell(j * xs.n + i)); part > 0)
          visit(j * xs.n + i, part);
  }

private:
  struct Axis {
    double lo, hi;
    int n;

    double edge(int i) const { return i == n ? hi : lo + (hi - lo) * i / n; }
    bool has(int i) const { return i >= 0 && i < n; }
    // -1 below, n above.
    int index(double at) const {
      if (at < lo)
        return -1;
      return at < hi ? std::min(int((at - lo) / (hi - lo) * n), n - 1) : n;
    }
    bool misses(double a, double b) const { return std::max(a, b) < lo || std::min(a, b) >= hi; }
    // Adds the shares of the way from a to b after which it crosses an edge.
    void cut(double a, double b, std::vector<double> &cuts) const {
      for (int i = std::max(index(std::min(a, b)), 0); i <= std::min(index(std::max(a, b)) + 1, n); i++)
        if (const double at = (edge(i) - a) / (b - a); at > 0 && at < 1)
          cuts.push_back(at);
    }
  };

  Axis xs, ys;
};

} // namespace cdem
