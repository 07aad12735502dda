// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid_place.h"

#include <gtest/gtest.h>

#include <cmath>

using cdem::GridPlace;

// Against distances in double precision: never below, and no more than three steps above, near and far from the origin,
// on both sides of it and of where the index wraps.
TEST(GridPlace, BoundsTheDistance) {
  const double skin = 2e-4, step = GridPlace::step_for(skin), wrap = std::ldexp(step, 32);
  for (const double x : {0.0, -0.3, 12.3456789, -987.654321, wrap, wrap / 2, -wrap / 2})
    for (const double length : {0.0, 1e-3 * skin, 0.5 * skin, skin, 1000 * skin})
      for (double angle = 0.1; angle < 6.3; angle += 0.3) {
        const double y = 0.7 * x, nx = x + length * std::cos(angle), ny = y + length * std::sin(angle);
        const double exact = std::hypot(nx - x, ny - y), moved = GridPlace(x, y, step).moved_to(nx, ny, step);
        EXPECT_GE(moved, exact);
        EXPECT_LE(moved, exact + 3 * step);
      }
}

TEST(GridPlace, WhatIsNoPlaceIsFarAway) {
  EXPECT_EQ(GridPlace(1, 2, 1e-9).moved_to(NAN, 2, 1e-9), INFINITY);
  EXPECT_EQ(GridPlace(1, 2, 1e-9).moved_to(1, -INFINITY, 1e-9), INFINITY);
}
