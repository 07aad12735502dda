// SPDX-License-Identifier: GPL-2.0-or-later
// The few operations that the contact law needs beside arithmetic, for a plain double. A vector type that offers the
// same names (found by argument-dependent lookup) runs the same law on several pairs at a time.
#pragma once

#include <cmath>

namespace cdem {

inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline double square_root(double x) { return std::sqrt(x); }
inline double magnitude(double x) { return std::fabs(x); }
inline double with_sign_of(double size, double sign) { return std::copysign(size, sign); }
inline bool any(bool condition) { return condition; }

} // namespace cdem
