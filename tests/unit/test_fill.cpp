// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace cdem;

namespace {

TEST(FillSizes, EqualDiametersStayEqual) {
  Random random(1);
  for (double d : power_law_diameters(10, 2, 2, -3, random))
    EXPECT_EQ(d, 2);
}

// The share of diameters below d, for n(d) ~ d^p from a to b: (d^(p+1) - a^(p+1))/(b^(p+1) - a^(p+1)), or for p = -1
// log(d/a)/log(b/a).
TEST(FillSizes, LawIsMetToOneGrain) {
  for (double p : {-3.0, -1.0, 0.0, 2.0}) {
    Random random(7);
    const int n = 1000;
    auto d = power_law_diameters(n, 4, 8, p, random);
    std::sort(d.begin(), d.end());
    for (int i = 0; i < n; i += 37) {
      const double share =
          p == -1 ? std::log(d[i] / 4) / std::log(2.0)
                  : (std::pow(d[i], p + 1) - std::pow(4, p + 1)) / (std::pow(8, p + 1) - std::pow(4, p + 1));
      EXPECT_NEAR(share, (i + 0.5) / n, 1e-12) << "power " << p;
    }
  }
}

TEST(FillSizes, SeedOnlyShuffles) {
  Random one(1), again(1), two(2);
  auto a = power_law_diameters(350, 4, 8, -3, one), b = power_law_diameters(350, 4, 8, -3, two);
  EXPECT_EQ(a, power_law_diameters(350, 4, 8, -3, again));
  EXPECT_NE(a, b);
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  EXPECT_EQ(a, b);
}

TEST(FillRows, NoOverlapAndInside) {
  for (int seed = 1; seed < 6; ++seed) {
    Random random(seed);
    const auto d = power_law_diameters(350, 4, 8, -3, random);
    double needed;
    const auto p = rows_of_discs(d, 100, 180, random, needed);
    ASSERT_EQ(p.size(), d.size()) << "needs " << needed;
    for (size_t i = 0; i < p.size(); ++i) {
      EXPECT_GE(std::min({p[i].x, p[i].y, 100 - p[i].x, 180 - p[i].y}), 0.5 * d[i] * (1 - 1e-12));
      for (size_t j = 0; j < i; ++j)
        EXPECT_GE(std::hypot(p[i].x - p[j].x, p[i].y - p[j].y), 0.5 * (d[i] + d[j]) * (1 - 1e-12));
    }
  }
}

TEST(FillRows, SaysWhatItNeeds) {
  Random random(1);
  double needed;
  EXPECT_TRUE(rows_of_discs(std::vector<double>(10, 2.0), 10, 3.9, random, needed).empty());
  EXPECT_EQ(needed, 4);
  EXPECT_EQ(rows_of_discs(std::vector<double>(10, 2.0), 10, 4, random, needed).size(), 10u);
}

} // namespace
