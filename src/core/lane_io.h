// SPDX-License-Identifier: GPL-2.0-or-later
// Moves data between rows in memory (the values of a disc, the force of a pair) and the lanes of vectors, one lane per
// pair. A row is read with whole loads and transposed in registers, which is several times faster than gathering its
// values one by one. Indices are those of PairGroup, counted in doubles.
#pragma once

#include "disc_pairs.h"

#include <utility>

namespace cdem {

inline Relative<double> load_relative(const Disc<double> *discs, const int *a, const int *b, double) {
  return relative(discs[*a / PairGroup::ROW], discs[*b / PairGroup::ROW]);
}
inline double load(const double *column, double) { return *column; }
inline void store(double *column, double value) { *column = value; }

// Stores the force on disc a in its slot, and the opposite force, with the torque on b, in the slot of b.
inline void store_forces(Forces<double> *slots, const int *slot_a, const int *slot_b, const Forces<double> &f) {
  slots[*slot_a / PairGroup::SLOT] = f;
  slots[*slot_b / PairGroup::SLOT] = opposite(f);
}

#ifdef CDEM_HAS_SIMD

// Four values of each of W rows, in four vectors. W = 8: rows 0 and 4 in the first, 1 and 5 in the second, ...; W = 4:
// one row in each; W = 2: the first halves of rows 0 and 1 in two vectors, then the second halves in two.
template <int W> using Quads = typename Raw<W>::type[4];

// Joins two rows of four values in one vector, or takes them apart. AVX-512 has one instruction for either, which GCC
// 12 does not find.
[[gnu::always_inline]] inline Raw<8>::type join(Four low, Four high) {
#if defined(__AVX512F__)
  return _mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
#else
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}
[[gnu::always_inline]] inline Four low_half(Raw<8>::type r) { return __builtin_shufflevector(r, r, 0, 1, 2, 3); }
[[gnu::always_inline]] inline Four high_half(Raw<8>::type r) {
#if defined(__AVX512F__)
  return _mm512_extractf64x4_pd(r, 1);
#else
  return __builtin_shufflevector(r, r, 4, 5, 6, 7);
#endif
}

// Loads the first four values of W rows, and the second four.
template <int W>
[[gnu::always_inline]] inline void load_quads(Quads<W> &first, Quads<W> &second, const Disc<double> *discs,
                                              const int *index) {
  auto row = [=](int i) { return &discs->x + index[i]; };
  for (int i = 0; i < 4; i++) {
    if constexpr (W == 8) {
      const double *const low = row(i), *const high = row(i + 4);
      first[i] = join(load_raw<Four>(low), load_raw<Four>(high));
      second[i] = join(load_raw<Four>(low + 4), load_raw<Four>(high + 4));
    } else if constexpr (W == 4) {
      first[i] = load_raw<Four>(row(i));
      second[i] = load_raw<Four>(row(i) + 4);
    } else {
      first[i] = load_raw<Two>(row(i % 2) + 2 * (i / 2));
      second[i] = load_raw<Two>(row(i % 2) + 2 * (i / 2) + 4);
    }
  }
}

template <int W>
[[gnu::always_inline]] inline void store_quads(const Quads<W> &q, Forces<double> *slots, const int *index) {
  auto row = [=](int i) { return &slots->fx + index[i]; };
  for (int i = 0; i < 4; i++) {
    if constexpr (W == 8) {
      store_raw(row(i), low_half(q[i]));
      store_raw(row(i + 4), high_half(q[i]));
    } else if constexpr (W == 4) {
      store_raw(row(i), q[i]);
    } else {
      store_raw(row(i % 2) + 2 * (i / 2), q[i]);
    }
  }
}

// Interleaves every other value of a and of b. From rows of four values, with odd = 0: a0 b0 a2 b2; with odd = 1: a1 b1
// a3 b3.
template <int odd, class R, std::size_t... l> [[gnu::always_inline]] inline R zip(R a, R b, std::index_sequence<l...>) {
  constexpr int W = sizeof...(l);
  return __builtin_shufflevector(a, b, (int(l - l % 2) + odd + (l % 2 ? W : 0))...);
}

// From each four values, the first (last = 0) or last (last = 1) two of a, then those of b.
template <int last, class R, std::size_t... l>
[[gnu::always_inline]] inline R pack(R a, R b, std::index_sequence<l...>) {
  constexpr int W = sizeof...(l);
  return __builtin_shufflevector(a, b, (int(l - l % 4 + l % 2) + 2 * last + (l % 4 < 2 ? 0 : W))...);
}

// Turns Quads of rows into four vectors of one value each, or back: transposes each block of four by four, or two by
// two.
template <int W> [[gnu::always_inline]] inline void transpose(Quads<W> &q) {
  constexpr std::make_index_sequence<W> lanes;
  if constexpr (W == 2) {
    const auto a = q[0], b = q[1], c = q[2], d = q[3];
    q[0] = zip<0>(a, b, lanes), q[1] = zip<1>(a, b, lanes), q[2] = zip<0>(c, d, lanes), q[3] = zip<1>(c, d, lanes);
  } else {
    const auto a = zip<0>(q[0], q[1], lanes), b = zip<1>(q[0], q[1], lanes);
    const auto c = zip<0>(q[2], q[3], lanes), d = zip<1>(q[2], q[3], lanes);
    q[0] = pack<0>(a, c, lanes), q[1] = pack<0>(b, d, lanes), q[2] = pack<1>(a, c, lanes), q[3] = pack<1>(b, d, lanes);
  }
}

// opposite() of the forces in vector i of Quads.
template <class R, std::size_t... l>
[[gnu::always_inline]] inline R opposite_quad(R q, int i, std::index_sequence<l...>) {
  if constexpr (sizeof...(l) == 2)
    return i < 2 ? -q : __builtin_shufflevector(q, q, 1, 0);
  return __builtin_shufflevector(q, q, int(l % 4 < 2 ? l : l ^ 1)...) * R{(l % 4 < 2 ? -1.0 : 1.0)...};
}

// The first four values are subtracted as whole rows, before they are transposed.
template <class Abi>
[[gnu::always_inline]] inline Relative<Lanes<Abi>> load_relative(const Disc<double> *discs, const int *a, const int *b,
                                                                 Lanes<Abi>) {
  using V = Lanes<Abi>;
  constexpr int W = V::size();
  Quads<W> of_a, of_b, rest_of_a, rest_of_b;
  load_quads<W>(of_a, rest_of_a, discs, a);
  load_quads<W>(of_b, rest_of_b, discs, b);
  for (int i = 0; i < 4; i++)
    of_a[i] -= of_b[i];
  transpose<W>(of_a);
  transpose<W>(rest_of_a);
  transpose<W>(rest_of_b);
  return {V(of_a[0]),
          V(of_a[1]),
          V(of_a[2]),
          V(of_a[3]),
          V(rest_of_a[0] - rest_of_b[0]),
          V(rest_of_a[1] - rest_of_b[1]),
          V(rest_of_a[2]),
          V(rest_of_a[3]),
          V(rest_of_b[2]),
          V(rest_of_b[3])};
}

template <class Abi> [[gnu::always_inline]] inline Lanes<Abi> load(const double *column, Lanes<Abi>) {
  return Lanes<Abi>(column, stdx::vector_aligned);
}
template <class Abi> [[gnu::always_inline]] inline void store(double *column, Lanes<Abi> value) {
  value.copy_to(column, stdx::vector_aligned);
}

template <class Abi>
[[gnu::always_inline]] inline void store_forces(Forces<double> *slots, const int *slot_a, const int *slot_b,
                                                const Forces<Lanes<Abi>> &f) {
  constexpr int W = Lanes<Abi>::size();
  Quads<W> on_a{raw(f.fx), raw(f.fy), raw(f.torque_a), raw(f.torque_b)}, on_b;
  transpose<W>(on_a);
  for (int i = 0; i < 4; i++)
    on_b[i] = opposite_quad(on_a[i], i, std::make_index_sequence<W>());
  store_quads<W>(on_a, slots, slot_a);
  store_quads<W>(on_b, slots, slot_b);
}

#endif

} // namespace cdem
