// SPDX-License-Identifier: GPL-2.0-or-later
// A sum that does not depend on the order of its terms, so a force on a wall has the same bits for any number of ranks.
//
// A term is rounded to a multiple of 2^-60 and kept in two integers, x = high 2^-10 + low 2^-60. Integers add exactly
// in any order. In newtons the resolution is 1e-18 N, and terms may be up to 2^50 = 1e15 N, far beyond any force here.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cdem {

// The largest power of 2 that is not above |x|; 1 if x is 0 or not finite. Division by it loses no bit.
inline double binade(double x) {
  x = std::fabs(x);
  return x > 0 && std::isfinite(x) ? std::ldexp(1, std::ilogb(x)) : 1;
}

// What to divide terms by that are all small, none larger than this, so that their sum has 40 bits or more.
inline double unit_for(double largest) { return largest < 0x1p-20 ? binade(largest) : 1; }

class ExactSum {
public:
  // high, low, and the number of terms that were not finite or too large. The words of a total over ranks are the sums
  // of their words.
  using Words = std::array<std::int64_t, 3>;

  ExactSum() = default;
  explicit ExactSum(const Words &words) : high(words[0]), low(words[1]), bad(words[2]) {}

  void add(double x) {
    if (x == 0) // most discs of a wall touch nothing
      return;
    if (!(std::fabs(x) < max_term)) {
      ++bad;
      return;
    }
    const auto coarse = static_cast<std::int64_t>(x * coarse_scale);
    high += coarse;
    low += nearest((x - static_cast<double>(coarse) / coarse_scale) * fine_scale);
    carry();
  }

  Words words() const { return {high, low, bad}; }

  // NaN if a term was not finite, or too large: a broken force must not look like a valid one.
  double value() const {
    if (bad)
      return std::numeric_limits<double>::quiet_NaN();
    ExactSum s = *this;
    s.carry();
    return static_cast<double>(s.high) / coarse_scale + static_cast<double>(s.low) / fine_scale;
  }

private:
  static constexpr double max_term = 0x1p50, coarse_scale = 0x1p10, fine_scale = 0x1p60;
  static constexpr std::int64_t unit = std::int64_t{1} << 50; // low units in a high one

  // Of |x| < 2^51, half to even: the place of the last digit of x + 1.5 2^52 is that of 1. std::nearbyint is a call of
  // a function wherever the instruction for it cannot be taken for granted.
  static std::int64_t nearest(double x) { return static_cast<std::int64_t>((x + 0x1.8p52) - 0x1.8p52); }

  // Brings low into [-unit/2, unit/2): it never overflows, and equal values have equal words.
  void carry() {
    const std::int64_t shifted = low + unit / 2;
    const std::int64_t whole = (shifted >= 0 ? shifted : shifted - unit + 1) / unit;
    high += whole;
    low -= whole * unit;
  }

  std::int64_t high = 0, low = 0, bad = 0;
};

} // namespace cdem
