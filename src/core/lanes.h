// SPDX-License-Identifier: GPL-2.0-or-later
// The few operations that the contact law needs beside arithmetic, for one pair at a time (double) and for several at a
// time (std::experimental::simd, where the standard library has it).
#pragma once

#include <cmath>

#if __has_include(<experimental/simd>)
#include <experimental/simd>
#define CDEM_HAS_SIMD
#endif

namespace cdem {

inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline double square_root(double x) { return std::sqrt(x); }
inline double magnitude(double x) { return std::fabs(x); }
inline double with_sign_of(double size, double sign) { return std::copysign(size, sign); }
inline bool any(bool condition) { return condition; }

#ifdef CDEM_HAS_SIMD
namespace stdx = std::experimental;

template <class Abi> using Lanes = stdx::simd<double, Abi>;
template <class Abi> using LaneMask = stdx::simd_mask<double, Abi>;

template <class Abi> inline Lanes<Abi> select(LaneMask<Abi> condition, Lanes<Abi> yes, Lanes<Abi> no) {
  stdx::where(condition, no) = yes;
  return no;
}
template <class Abi> inline Lanes<Abi> square_root(Lanes<Abi> x) { return stdx::sqrt(x); }
template <class Abi> inline Lanes<Abi> magnitude(Lanes<Abi> x) { return stdx::abs(x); }
template <class Abi> inline Lanes<Abi> with_sign_of(Lanes<Abi> size, Lanes<Abi> sign) {
  return stdx::copysign(size, sign);
}
template <class Abi> inline bool any(LaneMask<Abi> condition) { return stdx::any_of(condition); }
#endif

} // namespace cdem
