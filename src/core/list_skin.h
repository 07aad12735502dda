// SPDX-License-Identifier: GPL-2.0-or-later
// The skin of a list of pairs: pairs with a gap below it are in the list. A larger skin puts more pairs that do not
// touch into every step; with a smaller one the list is rebuilt more often.
#pragma once

#include <cmath>
#include <limits>

namespace cdem {

// With `touching` pairs, `per_metre` more for each metre of the skin s, and discs that move away from where they were
// at the last rebuild at `speed` (m per step), a step costs
//
//   touching + per_metre s + rebuild 2 speed/s
//
// times the cost of a pair. Returns the s (m) at which this is least. A rebuild costs as much as A_DISC pairs in a step
// for every disc, and A_PAIR for every pair that touches: measured with 500 falling discs and a bed of 1500 in motion.
inline double cheapest_skin(double discs, double touching, double per_metre, double speed) {
  constexpr double A_DISC = 10, A_PAIR = 16;
  if (per_metre == 0)
    return std::numeric_limits<double>::infinity();
  return std::sqrt(2 * (A_DISC * discs + A_PAIR * touching) * speed / per_metre);
}

} // namespace cdem
