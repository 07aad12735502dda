// SPDX-License-Identifier: GPL-2.0-or-later
// Cosine and sine of angles; the motion of discs from that of their grain, and the force on a grain from those on its
// discs.
#include "core/clump_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace cdem;

TEST(Rotation, IsCosineAndSine) {
  std::mt19937 random(1);
  for (double largest : {1e-8, 1.0, 10.0, 1e4, 1e6}) {
    std::uniform_real_distribution<double> angle(-largest, largest);
    for (int k = 0; k < 20000; k++) {
      const double a = angle(random);
      const Rotation turn = rotation(a);
      EXPECT_NEAR(turn.cosine, std::cos(a), 3e-16) << a;
      EXPECT_NEAR(turn.sine, std::sin(a), 3e-16) << a;
    }
  }
}

TEST(Rotation, OfNothingIsExact) {
  EXPECT_EQ(rotation(0).cosine, 1);
  EXPECT_EQ(rotation(0).sine, 0);
}

namespace {

// A grain of two discs (rows 0 and 1) and one of a single disc (row 2), in motion.
struct Grains {
  std::vector<Disc<double>> grains{{0.1, 0.2, 3, -4, 3.5, -4.5, 70, 80}, {-0.3, 0.1, 1, 2, 1.5, 2.5, 5, 6}};
  std::vector<Body> bodies{{0.7, 1, 1, 1}, {-2, 1, 1, 1}};
  std::vector<int> first_row{0, 2, 3};
  std::vector<Disc<double>> discs = std::vector<Disc<double>>(3);
  std::vector<Offset> offsets{{1e-3, 2e-3}, {-2e-3, 1e-3}, {0, 0}};
  std::vector<Forces<double>> sums{{1, 2, 3, 0}, {-4, 5, -6, 0}, {7, 8, 9, 0}};

  ClumpColumns columns() {
    return {grains.data(), bodies.data(), first_row.data(), discs.data(), offsets.data(), sums.data(), 0};
  }
};

} // namespace

TEST(ClumpMotion, DiscsMoveAsARigidBody) {
  Grains g;
  const double half_step = 1e-4;
  expand(g.columns(), 0, 2, half_step);
  for (int row = 0; row < 2; row++) {
    const double c = std::cos(0.7), s = std::sin(0.7), x = g.offsets[row].x, y = g.offsets[row].y;
    const double ox = c * x - s * y, oy = s * x + c * y;
    const Disc<double> &d = g.discs[row];
    EXPECT_NEAR(d.x, 0.1 + ox, 1e-16);
    EXPECT_NEAR(d.y, 0.2 + oy, 1e-16);
    EXPECT_NEAR(d.vx, 3.5 - 80 * oy, 1e-14);
    EXPECT_NEAR(d.vy, -4.5 + 80 * ox, 1e-14);
    // omega x (o - half_step omega x o)
    EXPECT_NEAR(d.vx_half, 3 - 70 * (oy - half_step * 70 * ox), 1e-14);
    EXPECT_NEAR(d.vy_half, -4 + 70 * (ox + half_step * 70 * oy), 1e-14);
    EXPECT_EQ(d.omega, 80);
    EXPECT_EQ(d.omega_half, 70);
  }
}

TEST(ClumpMotion, AGrainOfOneDiscIsThatDisc) {
  Grains g;
  expand(g.columns(), 0, 2, 1e-4);
  EXPECT_EQ(g.discs[2].x, g.grains[1].x);
  EXPECT_EQ(g.discs[2].vy_half, g.grains[1].vy_half);
  const Four force = force_on(g.columns(), 1);
  EXPECT_EQ(force[0], 7);
  EXPECT_EQ(force[1], 8);
  EXPECT_EQ(force[2], 9);
}

TEST(ClumpMotion, TorqueIsThatAboutTheCentreOfTheGrain) {
  Grains g;
  expand(g.columns(), 0, 2, 0);
  const Four force = force_on(g.columns(), 0);
  double torque = 3 - 6;
  for (int row = 0; row < 2; row++)
    torque += (g.discs[row].x - 0.1) * g.sums[row].fy - (g.discs[row].y - 0.2) * g.sums[row].fx;
  EXPECT_DOUBLE_EQ(force[0], -3);
  EXPECT_DOUBLE_EQ(force[1], 7);
  EXPECT_NEAR(force[2], torque, 1e-16);
}
