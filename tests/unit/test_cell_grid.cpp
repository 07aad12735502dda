// SPDX-License-Identifier: GPL-2.0-or-later
// Areas of grains and lengths of lines in the cells of a grid: closed forms.
#include "core/cell_grid.h"
#include "core/grain_shape.h"

#include <gtest/gtest.h>

#include <map>

namespace {

using cdem::CellGrid;
using cdem::GrainShape;
using cdem::Outline;
using cdem::Point;
using cdem::Rectangle;

constexpr double FAR = 100;

Outline disc(double x, double y, double r) { return {{x, y, r, -M_PI, M_PI}}; }

// Of a disc of radius 1, beyond a chord at distance d from its centre.
double segment(double d) { return std::acos(d) - d * std::sqrt(1 - d * d); }

TEST(AreaWithin, Disc) {
  const Outline d = disc(0.3, -0.2, 1);
  EXPECT_NEAR(cdem::area_within(d, {-FAR, FAR, -FAR, FAR}), M_PI, 1e-12);
  EXPECT_NEAR(cdem::area_within(d, {0.3, FAR, -0.2, FAR}), M_PI / 4, 1e-12);
  for (double c : {-0.9, -0.3, 0.0, 0.4, 0.99}) {
    EXPECT_NEAR(cdem::area_within(d, {0.3 + c, FAR, -FAR, FAR}), segment(c), 1e-12);
    EXPECT_NEAR(cdem::area_within(d, {-FAR, 0.3 - c, -FAR, FAR}), segment(c), 1e-12);
    EXPECT_NEAR(cdem::area_within(d, {-FAR, FAR, -0.2 + c, FAR}), segment(c), 1e-12);
    EXPECT_NEAR(cdem::area_within(d, {-FAR, FAR, -FAR, -0.2 - c}), segment(c), 1e-12);
  }
  EXPECT_NEAR(cdem::area_within(d, {0.1, 0.4, -0.5, 0.3}), 0.3 * 0.8, 1e-14); // a cell that is all grain
  EXPECT_EQ(cdem::area_within(d, {2, 3, -1, 1}), 0);
}

// A side that touches the disc, and arcs that begin anywhere: what round-off makes of them must not matter.
TEST(AreaWithin, ArcsMayBeginAnywhere) {
  for (double from : {-10.0, -M_PI, -M_PI / 2, 0.0, 1.0, M_PI / 2, 100.0}) {
    const Outline two{{0, 0, 1, from, from + 2}, {0, 0, 1, from + 2, from + 2 * M_PI}};
    EXPECT_NEAR(cdem::area_within(two, {0, 1, 0, 1}), M_PI / 4, 1e-12);
    EXPECT_NEAR(cdem::area_within(two, {-1, 1, -1, 1}), M_PI, 1e-12);
    EXPECT_NEAR(cdem::area_within(two, {-1, 0.5, -1, 1}), M_PI - segment(0.5), 1e-12);
  }
}

// Two discs of radius 1 with centres 1 apart: what they share counts once.
TEST(AreaWithin, OverlappingDiscs) {
  const GrainShape shape({{0, 0, 1}, {1, 0, 1}});
  const double r = 1 / 1.5; // discs of the scaled shape
  const double lens = 2 * segment(0.5) * r * r;
  EXPECT_NEAR(cdem::area_within(shape.outline(), {-FAR, FAR, -FAR, FAR}), 2 * M_PI * r * r - lens, 1e-12);
  EXPECT_NEAR(cdem::area_within(shape.outline(), {0, FAR, -FAR, 0}), (2 * M_PI * r * r - lens) / 4, 1e-12);
}

TEST(CellGrid, AreasOfCellsAddUp) {
  const CellGrid grid({-1.3, 1.7, -1.1, 1.2}, 7, 5);
  for (const GrainShape &shape : {GrainShape::single(), GrainShape::triple()}) {
    double sum = 0;
    int cells = 0;
    grid.share_area(shape.outline(), {0, 0}, 1, shape.area(), [&](int k, double area) {
      const Rectangle c = grid.cell(k);
      EXPECT_LE(area, (c.xhi - c.xlo) * (c.yhi - c.ylo) * (1 + 1e-12));
      sum += area;
      cells++;
    });
    EXPECT_NEAR(sum, shape.area(), 1e-12);
    EXPECT_GT(cells, 10);
  }
}

TEST(CellGrid, SharesOfALine) {
  const CellGrid grid({0, 4, 0, 2}, 4, 2);
  std::map<int, double> seen;
  const auto share = [&](Point from, Point to) {
    seen.clear();
    grid.share_line(from, to, [&](int k, double part) { seen[k] += part; });
  };
  share({0.25, 0.5}, {2.25, 0.5});
  EXPECT_EQ(seen, (std::map<int, double>{{0, 0.375}, {1, 0.5}, {2, 0.125}}));
  share({0.5, 0.25}, {0.5, 1.25});
  EXPECT_EQ(seen, (std::map<int, double>{{0, 0.75}, {4, 0.25}}));
  share({-1, 0.5}, {1, 0.5}); // half of it is outside
  EXPECT_EQ(seen, (std::map<int, double>{{0, 0.5}}));
  share({1.5, 1.5}, {0.5, 0.5}); // through a corner
  EXPECT_EQ(seen, (std::map<int, double>{{0, 0.5}, {5, 0.5}}));
  share({1, 0.25}, {1, 0.75}); // along an edge: once
  EXPECT_EQ(seen, (std::map<int, double>{{1, 1.0}}));
  share({1.25, 0.75}, {1.75, 0.25}); // within a cell
  EXPECT_EQ(seen, (std::map<int, double>{{1, 1.0}}));
  share({5, 5}, {6, 6});
  EXPECT_TRUE(seen.empty());
}

} // namespace
