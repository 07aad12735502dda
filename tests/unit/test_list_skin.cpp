// SPDX-License-Identifier: GPL-2.0-or-later
// The cheapest skin, compared with other skins in the formula of the header.
#include "core/list_skin.h"

#include <gtest/gtest.h>

#include <cmath>

using cdem::cheapest_skin;

namespace {

// The cost of a step in units of one pair: a rebuild costs as much as 10 pairs for every disc and 16 for every pair
// that touches.
double cost(double discs, double touching, double per_metre, double speed, double skin) {
  return touching + per_metre * skin + (10 * discs + 16 * touching) * 2 * speed / skin;
}

TEST(ListSkin, NoOtherSkinCostsLess) {
  for (double speed : {1e-12, 1e-9, 1e-6})
    for (double per_metre : {1e5, 1e7})
      for (double touching : {0.0, 1000.0}) {
        const double skin = cheapest_skin(600, touching, per_metre, speed);
        const double least = cost(600, touching, per_metre, speed, skin);
        for (double factor : {0.5, 0.9, 1.1, 2.0})
          EXPECT_GT(cost(600, touching, per_metre, speed, factor * skin), least);
      }
}

TEST(ListSkin, NothingMoves) { EXPECT_EQ(cheapest_skin(600, 1000, 1e6, 0), 0); }

TEST(ListSkin, NothingElseIsNear) { EXPECT_TRUE(std::isinf(cheapest_skin(600, 1000, 0, 1e-9))); }

} // namespace
