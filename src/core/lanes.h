// SPDX-License-Identifier: GPL-2.0-or-later
// The few operations that the contact law needs in addition to arithmetic, for one pair at a time (double) and for
// several at a time (std::experimental::simd, where the standard library has it).
#pragma once

#include <cmath>
#include <cstring>

#if __has_include(<experimental/simd>)
#include <experimental/simd>
#define CDEM_HAS_SIMD
#endif
#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace cdem {

// Two, four, eight doubles as the compiler knows them. Functions that take them are compiled once for each instruction
// set; they are always inlined, so that no copy for one set is ever called by code for another.
template <int W> struct Raw {
  typedef double type __attribute__((vector_size(W * sizeof(double))));
  typedef long long bits __attribute__((vector_size(W * sizeof(double))));
};
using Two = Raw<2>::type;
using Four = Raw<4>::type;
using Eight = Raw<8>::type;

template <class R> [[gnu::always_inline]] inline R load_raw(const double *from) {
  R r;
  std::memcpy(&r, from, sizeof(r));
  return r;
}
template <class R> [[gnu::always_inline]] inline void store_raw(double *to, R r) { std::memcpy(to, &r, sizeof(r)); }

// Otherwise GCC emits two scalar roots, each with a branch.
[[gnu::always_inline]] inline Two square_root(Two x) {
#if defined(__x86_64__)
  return _mm_sqrt_pd(x);
#elif defined(__aarch64__)
  return (Two)vsqrtq_f64((float64x2_t)x);
#else
  return Two{std::sqrt(x[0]), std::sqrt(x[1])};
#endif
}

inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline double square_root(double x) { return std::sqrt(x); }
inline double magnitude(double x) { return std::fabs(x); }
inline double with_sign_of(double size, double sign) { return std::copysign(size, sign); } // size >= 0
inline bool any(bool condition) { return condition; }

// A yes or no kept in the last bit of a number. It changes the number by a factor of at most 1 + 2e-16.
inline unsigned long long bits(double x) {
  unsigned long long bits;
  std::memcpy(&bits, &x, sizeof(bits));
  return bits;
}
inline double of_bits(unsigned long long bits) {
  double x;
  std::memcpy(&x, &bits, sizeof(x));
  return x;
}
inline bool is_marked(double x) { return bits(x) & 1; }
inline double marked(double x) { return of_bits(bits(x) | 1); }
inline double unmarked(double x) { return of_bits(bits(x) & ~1ull); }

// a b + c, rounded once where the machine has an instruction for it. The x86-64 baseline has none: there it is rounded
// twice, and the last bits differ.
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
[[gnu::always_inline]] inline double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }
[[gnu::always_inline]] inline double fused_minus(double a, double b, double c) { return __builtin_fma(a, b, -c); }
#else
[[gnu::always_inline]] inline double fused(double a, double b, double c) { return a * b + c; }
[[gnu::always_inline]] inline double fused_minus(double a, double b, double c) { return a * b - c; }
#endif

#ifdef CDEM_HAS_SIMD
namespace stdx = std::experimental;

template <class Abi> using Lanes = stdx::simd<double, Abi>;
template <class Abi> using LaneMask = stdx::simd_mask<double, Abi>;

// The library's own conversion fails on arm64 with GCC 12.
template <class Abi> inline auto raw(Lanes<Abi> lanes) {
  typename Raw<Lanes<Abi>::size()>::type r;
  std::memcpy(&r, &lanes, sizeof(r));
  return r;
}

template <class Abi> [[gnu::always_inline]] inline auto bits(Lanes<Abi> lanes) {
  return (typename Raw<Lanes<Abi>::size()>::bits)raw(lanes);
}
template <class Abi, class Bits> [[gnu::always_inline]] inline Lanes<Abi> of_bits(Bits bits) {
  return Lanes<Abi>((typename Raw<Lanes<Abi>::size()>::type)bits);
}

template <class Abi> inline Lanes<Abi> select(LaneMask<Abi> condition, Lanes<Abi> yes, Lanes<Abi> no) {
  stdx::where(condition, no) = yes;
  return no;
}
template <class Abi> inline Lanes<Abi> square_root(Lanes<Abi> x) { return stdx::sqrt(x); }
template <class Abi> inline Lanes<Abi> magnitude(Lanes<Abi> x) { return stdx::abs(x); }
template <class Abi> [[gnu::always_inline]] inline Lanes<Abi> with_sign_of(Lanes<Abi> size, Lanes<Abi> sign) {
  return of_bits<Abi>(bits(size) | (bits(sign) & bits(Lanes<Abi>(-0.0))));
}
template <class Abi> inline Lanes<Abi> fused(Lanes<Abi> a, Lanes<Abi> b, Lanes<Abi> c) {
  [[maybe_unused]] constexpr int W = Lanes<Abi>::size(); // in GCC 12 the library's own fma is a loop over scalars
#if defined(__AVX512F__)
  if constexpr (W == 8)
    return Lanes<Abi>(_mm512_fmadd_pd(raw(a), raw(b), raw(c)));
#endif
#if defined(__FMA__)
  if constexpr (W == 4)
    return Lanes<Abi>(_mm256_fmadd_pd(raw(a), raw(b), raw(c)));
#endif
#if defined(__ARM_FEATURE_FMA)
  if constexpr (W == 2)
    return Lanes<Abi>(vfmaq_f64(raw(c), raw(a), raw(b)));
#endif
  return a * b + c;
}
// a b - c; GCC does not make this of fused() and a change of sign.
template <class Abi> inline Lanes<Abi> fused_minus(Lanes<Abi> a, Lanes<Abi> b, Lanes<Abi> c) {
#if defined(__AVX512F__)
  if constexpr (Lanes<Abi>::size() == 8)
    return Lanes<Abi>(_mm512_fmsub_pd(raw(a), raw(b), raw(c)));
#endif
#if defined(__FMA__)
  if constexpr (Lanes<Abi>::size() == 4)
    return Lanes<Abi>(_mm256_fmsub_pd(raw(a), raw(b), raw(c)));
#endif
  return fused(a, b, -c);
}
template <class Abi> inline bool any(LaneMask<Abi> condition) { return stdx::any_of(condition); }

template <class Abi> [[gnu::always_inline]] inline LaneMask<Abi> is_marked(Lanes<Abi> x) {
  constexpr int EXPONENT = 62; // shifted there, the bit makes 2; the one before it becomes the sign
  return of_bits<Abi>(bits(x) << EXPONENT) != Lanes<Abi>(0);
}
template <class Abi> [[gnu::always_inline]] inline Lanes<Abi> marked(Lanes<Abi> x) { return of_bits<Abi>(bits(x) | 1); }
template <class Abi> [[gnu::always_inline]] inline Lanes<Abi> unmarked(Lanes<Abi> x) {
  return of_bits<Abi>(bits(x) & ~1ll);
}
#endif

} // namespace cdem
