// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using cdem::ExactSum;

namespace {

double sum(const std::vector<double> &terms) {
  ExactSum s;
  for (double x : terms)
    s.add(x);
  return s.value();
}

std::vector<double> forces(int n) {
  std::mt19937_64 random(1);
  std::vector<double> terms(n);
  for (double &x : terms)
    x = std::ldexp(std::uniform_real_distribution<>(-1, 1)(random), std::uniform_int_distribution<>(-40, 30)(random));
  return terms;
}

TEST(ExactSum, EmptyIsZero) { EXPECT_EQ(ExactSum().value(), 0.0); }

TEST(ExactSum, OneTermComesBack) {
  for (double x : {0.0, 1.0, -1.0, 0.1, -1234.56789, 0x1p49, -0x1p-60, 3e-7})
    EXPECT_NEAR(sum({x}), x, 0x1p-61);
  EXPECT_EQ(sum({0x1p-60}), 0x1p-60);
  EXPECT_EQ(sum({-123.25}), -123.25);
}

TEST(ExactSum, OrderDoesNotMatter) {
  auto terms = forces(10000);
  const double expected = sum(terms);
  std::mt19937_64 random(2);
  for (int k = 0; k < 20; ++k) {
    std::shuffle(terms.begin(), terms.end(), random);
    EXPECT_EQ(sum(terms), expected);
  }
}

TEST(ExactSum, SplitOverRanksDoesNotMatter) {
  const auto terms = forces(1000);
  for (int ranks : {1, 2, 3, 4, 64, 1000}) {
    std::vector<ExactSum> parts(ranks);
    for (size_t i = 0; i < terms.size(); ++i)
      parts[i * 7919 % ranks].add(terms[i]);
    ExactSum::Words all{};
    for (const auto &part : parts)
      for (size_t w = 0; w < all.size(); ++w)
        all[w] += part.words()[w];
    EXPECT_EQ(ExactSum(all).value(), sum(terms)) << ranks << " ranks";
  }
}

TEST(ExactSum, CancelsExactly) { EXPECT_EQ(sum({1e12, 1e-9, -1e12}), sum({1e-9})); }

TEST(ExactSum, LowWordNeverRunsOver) {
  ExactSum s;
  const double x = 0x1p-10 - 0x1p-60; // the largest number that goes to the low word alone
  const int n = 1 << 20;
  for (int i = 0; i < n; ++i)
    s.add(x);
  EXPECT_EQ(s.value(), n * x);
}

TEST(ExactSum, BrokenTermShows) {
  const double inf = std::numeric_limits<double>::infinity();
  for (double x : {std::numeric_limits<double>::quiet_NaN(), inf, -inf, 0x1p50})
    EXPECT_TRUE(std::isnan(sum({1.0, x, 2.0}))) << x;
}

} // namespace
