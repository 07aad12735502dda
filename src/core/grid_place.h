// SPDX-License-Identifier: GPL-2.0-or-later
// A place on a fine grid, modulo 2^32 of its steps, to measure how far something has moved from it: half the memory of
// a place in double precision. The distance is exact but for rounding to the grid, for moves of less than 2^31 steps.
#pragma once

#include <cmath>
#include <cstdint>

namespace cdem {

class GridPlace {
public:
  // The step of a grid that is fine enough to measure parts of a skin (m): moves of up to 2^15 skins.
  static double step_for(double skin) { return std::ldexp(skin, -16); }

  GridPlace() = default;
  GridPlace(double px, double py, double step) : x(index(px, step)), y(index(py, step)) {}

  // A bound on the distance to (px, py), at most three steps too large (m); INFINITY if that is not finite.
  double moved_to(double px, double py, double step) const {
    if (!std::isfinite(px) || !std::isfinite(py))
      return INFINITY;
    const double dx = double(std::int32_t(index(px, step) - x)), dy = double(std::int32_t(index(py, step) - y));
    return (std::sqrt(dx * dx + dy * dy) + ROUNDING) * step;
  }

private:
  static constexpr double ROUNDING = 1.5; // either place is off by up to half a step along x and y

  static std::uint32_t index(double p, double step) { return std::uint32_t(std::llrint(p / step)); }

  std::uint32_t x = 0, y = 0;
};

} // namespace cdem
