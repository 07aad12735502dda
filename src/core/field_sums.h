// SPDX-License-Identifier: GPL-2.0-or-later
// Means of grains and contacts over the cells of a grid: stress, fabric, velocity and so on, from sums that do not
// depend on the order of their terms.
//
// A grain has the share s of its area in a cell. A branch is the line l from a grain's centre to one of its contacts;
// it has the share w of its length in a cell. So a grain and a contact count once, whatever the cells. With f the force
// on the grain, A the area of the cell and V its mean velocity:
//
//   stress    -1/A sum w l f, pressure positive: the limit of Goldhirsch's (2010) for a kernel that is the cell
//   kinetic   1/A sum s m (v - V)(v - V)
//   velocity  V = sum s m v / sum s m; its gradient is that of the linear field that is closest to the grains' (least
//             squares, with weights s m)
//   fabric    sum w n n / sum w; of the forces: sum w fn n n / sum w fn, and sum w ft (t n + n t)/2 / sum w fn
//
// If the forces on each grain cancel, the sum of -l f over all branches is that of x f over the points x where the
// grains press on walls with f (Love, Weber).
#pragma once

#include "cell_grid.h"
#include "exact_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace cdem {

// Mean values of a cell; 0 where there is nothing to take a mean of.
struct CellMeans {
  struct Tensor {
    double xx = 0, yy = 0, xy = 0, yx = 0;
  };
  Point centre;                      // of the cell (m)
  double solid;                      // share of the area that is grain
  double grains;                     // number of grains
  double mass = 0, coordination = 0; // of a grain (kg); contacts of a grain
  Tensor stress, kinetic;            // N/m; first index: place, or normal of the plane; second: force
  Point velocity{0, 0};              // m/s
  double spin = 0;                   // rad/s
  Tensor gradient;                   // 1/s; xy is d(velocity in x)/dy
  Tensor fabric, normal, tangential;
};

class FieldSums {
public:
  struct Grain {
    Point centre, velocity;
    double radius, area, mass, spin;
    int contacts;
  };
  struct Branch {
    Point from, to, force, normal;
    double fn, ft; // of the force, along the normal and the normal turned by +90 degrees
  };
  // The largest values that are to come, of speed and force along either axis, for the resolution of the sums (m, kg,
  // m/s, rad/s, N).
  struct Largest {
    double radius, mass, speed, spin, force;
  };

  FieldSums(const Rectangle &all, int nx, int ny, const Largest &most) : grid(all, nx, ny), sums(grid.cells()) {
    const double r = binade(most.radius), m = binade(most.mass), v = binade(most.speed), f = binade(most.force),
                 c = binade(std::max((all.xhi - all.xlo) / nx, (all.yhi - all.ylo) / ny));
    unit.fill(1);
    unit[AREA] = r * r;
    unit[SPIN] = binade(most.spin);
    unit[M] = m;
    unit[MX] = unit[MY] = m * c;
    unit[MXX] = unit[MYY] = unit[MXY] = m * c * c;
    unit[MU] = unit[MV] = m * v;
    unit[MUU] = unit[MVV] = unit[MUV] = m * v * v;
    unit[MUX] = unit[MUY] = unit[MVX] = unit[MVY] = m * v * c;
    unit[STRESS_XX] = unit[STRESS_YY] = unit[STRESS_XY] = unit[STRESS_YX] = r * f;
    for (int q = FN; q < QUANTITIES; q++)
      unit[q] = f;
    for (int q = 0; q < QUANTITIES; q++)
      per_unit[q] = 1 / unit[q];
  }

  void add(const Grain &g, const Outline &outline) {
    grid.share_area(outline, g.centre, g.radius, g.area, [&](int k, double area) {
      const Rectangle cell = grid.cell(k);
      const double s = area / g.area, m = s * g.mass, u = g.velocity.x, v = g.velocity.y;
      const double x = g.centre.x - (cell.xlo + cell.xhi) / 2, y = g.centre.y - (cell.ylo + cell.yhi) / 2;
      add(k, {{AREA, area}, {GRAINS, s}, {CONTACTS, s * g.contacts}, {SPIN, s * g.spin}});
      add(k, {{M, m}, {MX, m * x}, {MY, m * y}, {MXX, m * x * x}, {MYY, m * y * y}, {MXY, m * x * y}});
      add(k, {{MU, m * u}, {MV, m * v}, {MUU, m * u * u}, {MVV, m * v * v}, {MUV, m * u * v}});
      add(k, {{MUX, m * u * x}, {MUY, m * u * y}, {MVX, m * v * x}, {MVY, m * v * y}});
    });
  }

  void add(const Branch &b) {
    const double x = b.to.x - b.from.x, y = b.to.y - b.from.y, nx = b.normal.x, ny = b.normal.y;
    grid.share_line(b.from, b.to, [&](int k, double w) {
      add(k, {{STRESS_XX, -w * x * b.force.x}, {STRESS_YY, -w * y * b.force.y}});
      add(k, {{STRESS_XY, -w * x * b.force.y}, {STRESS_YX, -w * y * b.force.x}});
      add(k, {{BRANCHES, w}, {FABRIC_XX, w * nx * nx}, {FABRIC_YY, w * ny * ny}, {FABRIC_XY, w * nx * ny}});
      const double fn = w * b.fn, ft = w * b.ft;
      add(k, {{FN, fn}, {NORMAL_XX, fn * nx * nx}, {NORMAL_YY, fn * ny * ny}, {NORMAL_XY, fn * nx * ny}});
      add(k, {{TANGENTIAL_XX, -ft * nx * ny}, {TANGENTIAL_XY, ft * (nx * nx - ny * ny) / 2}});
    });
  }

  // The sums as integers, which add over ranks.
  std::vector<std::int64_t> words() const {
    std::vector<std::int64_t> all;
    for (const Cell &cell : sums)
      for (const ExactSum &s : cell)
        for (std::int64_t word : s.words())
          all.push_back(word);
    return all;
  }
  void set_words(const std::vector<std::int64_t> &all) {
    const std::int64_t *word = all.data();
    for (Cell &cell : sums)
      for (ExactSum &s : cell) {
        ExactSum::Words of_sum;
        std::copy_n(word, of_sum.size(), of_sum.begin());
        s = ExactSum(of_sum);
        word += of_sum.size();
      }
  }

  int cells() const { return grid.cells(); }
  CellMeans means(int k) const {
    const Rectangle cell = grid.cell(k);
    const double area = (cell.xhi - cell.xlo) * (cell.yhi - cell.ylo);
    const auto of = [&](Quantity q) { return sum(k, q); };
    CellMeans means;
    means.centre = {(cell.xlo + cell.xhi) / 2, (cell.ylo + cell.yhi) / 2};
    means.solid = of(AREA) / area;
    means.grains = of(GRAINS);
    means.stress = {of(STRESS_XX) / area, of(STRESS_YY) / area, of(STRESS_XY) / area, of(STRESS_YX) / area};
    if (const double m = of(M); m > 0) {
      means.mass = m / of(GRAINS);
      means.coordination = of(CONTACTS) / of(GRAINS);
      means.spin = of(SPIN) / of(GRAINS);
      means.velocity = {of(MU) / m, of(MV) / m};
      const double xy = about_mean(k, MUV, MU, MV) / area;
      means.kinetic = {about_mean(k, MUU, MU, MU) / area, about_mean(k, MVV, MV, MV) / area, xy, xy};
      means.gradient = gradient(k);
    }
    if (const double b = of(BRANCHES); b > 0)
      means.fabric = {of(FABRIC_XX) / b, of(FABRIC_YY) / b, of(FABRIC_XY) / b, of(FABRIC_XY) / b};
    if (const double f = of(FN); f > 0) {
      means.normal = {of(NORMAL_XX) / f, of(NORMAL_YY) / f, of(NORMAL_XY) / f, of(NORMAL_XY) / f};
      means.tangential = {of(TANGENTIAL_XX) / f, -of(TANGENTIAL_XX) / f, of(TANGENTIAL_XY) / f, of(TANGENTIAL_XY) / f};
    }
    return means;
  }

private:
  // M...: sums of s m times X and Y, from the centre of the cell, and the velocity (U, V).
  // clang-format off
  enum Quantity {
    AREA, GRAINS, CONTACTS, SPIN,
    M, MX, MY, MXX, MYY, MXY, MU, MV, MUU, MVV, MUV, MUX, MUY, MVX, MVY,
    STRESS_XX, STRESS_YY, STRESS_XY, STRESS_YX,
    BRANCHES, FABRIC_XX, FABRIC_YY, FABRIC_XY,
    FN, NORMAL_XX, NORMAL_YY, NORMAL_XY, TANGENTIAL_XX, TANGENTIAL_XY,
    QUANTITIES
  };
  // clang-format on
  using Cell = std::array<ExactSum, QUANTITIES>;
  struct Term {
    Quantity quantity;
    double value;
  };

  void add(int k, std::initializer_list<Term> terms) {
    for (const auto &[quantity, value] : terms)
      sums[k][quantity].add(value * per_unit[quantity]);
  }
  double sum(int k, Quantity q) const { return sums[k][q].value() * unit[q]; }
  // Of the deviations of two quantities from their means.
  double about_mean(int k, Quantity product, Quantity a, Quantity b) const {
    return sum(k, product) - sum(k, a) * sum(k, b) / sum(k, M);
  }

  CellMeans::Tensor gradient(int k) const {
    constexpr double IN_LINE = 1e-9; // round-off of grains in a line is less
    const double xx = about_mean(k, MXX, MX, MX), yy = about_mean(k, MYY, MY, MY), xy = about_mean(k, MXY, MX, MY);
    const double ux = about_mean(k, MUX, MU, MX), uy = about_mean(k, MUY, MU, MY);
    const double vx = about_mean(k, MVX, MV, MX), vy = about_mean(k, MVY, MV, MY);
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > IN_LINE * (xx + yy) * (xx + yy)))
      return {};
    return {(ux * yy - uy * xy) / determinant, (vy * xx - vx * xy) / determinant, (uy * xx - ux * xy) / determinant,
            (vx * yy - vy * xy) / determinant};
  }

  CellGrid grid;
  std::array<double, QUANTITIES> unit, per_unit; // of each sum; powers of 2, by which nothing is rounded
  std::vector<Cell> sums;
};

} // namespace cdem
