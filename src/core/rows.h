// SPDX-License-Identifier: GPL-2.0-or-later
// From rows in memory (one disc, or the forces of one pair) to lanes of a vector and back. A row is read with whole
// loads and transposed in registers, which is several times faster than gathering its values one by one.
#pragma once

#include "contact_law.h"

#include <cstring>
#include <utility>

namespace cdem {

inline Relative<double> load_relative(const Disc<double> *discs, const int *a, const int *b, double) {
  return relative(discs[*a], discs[*b]);
}
inline double load(const double *column, double) { return *column; }
inline void store(double *column, double value) { *column = value; }
inline void store_forces(Forces<double> *out, const Forces<double> &f) { *out = f; }

#ifdef CDEM_HAS_SIMD

template <int W> struct Raw { typedef double type __attribute__((vector_size(W * sizeof(double)))); };

// Of two vectors, swaps the blocks of `step` lanes that lie off the diagonal: the upper or the lower result.
template <int step, bool upper, class R, std::size_t... lane> inline R blocks(R a, R b, std::index_sequence<lane...>) {
  constexpr int W = sizeof...(lane);
  if constexpr (upper)
    return __builtin_shufflevector(a, b, ((lane & step) ? int(lane) - step + W : int(lane))...);
  else
    return __builtin_shufflevector(a, b, ((lane & step) ? int(lane) + W : int(lane) + step)...);
}

template <class R, std::size_t... lane> inline auto join(R low, R high, std::index_sequence<lane...>) {
  return __builtin_shufflevector(low, high, int(lane)...);
}

// The lower (0) or upper (1) half of a vector.
template <int which, class R, std::size_t... lane> inline auto half(R r, std::index_sequence<lane...>) {
  return __builtin_shufflevector(r, r, int(which * sizeof...(lane) + lane)...);
}

// Transposes W vectors of W lanes.
template <int W, int step = 1> inline void transpose(typename Raw<W>::type *r) {
  if constexpr (step < W) {
    constexpr std::make_index_sequence<W> lanes;
    for (int i = 0; i < W; i++) {
      if (i & step)
        continue;
      const auto a = r[i], b = r[i + step];
      r[i] = blocks<step, true>(a, b, lanes);
      r[i + step] = blocks<step, false>(a, b, lanes);
    }
    transpose<W, 2 * step>(r);
  }
}

// W rows of two values each to two vectors.
template <int W>
inline void to_lanes(const Raw<2>::type *rows, typename Raw<W>::type &first, typename Raw<W>::type &second) {
  if constexpr (W == 2) {
    first = __builtin_shufflevector(rows[0], rows[1], 0, 2);
    second = __builtin_shufflevector(rows[0], rows[1], 1, 3);
  } else {
    typename Raw<W / 2>::type low[2], high[2];
    to_lanes<W / 2>(rows, low[0], low[1]);
    to_lanes<W / 2>(rows + W / 2, high[0], high[1]);
    first = join(low[0], high[0], std::make_index_sequence<W>());
    second = join(low[1], high[1], std::make_index_sequence<W>());
  }
}

template <class R> inline R load_row(const double *row) {
  R r;
  std::memcpy(&r, row, sizeof(r));
  return r;
}

// Differences are taken of whole rows, before they are transposed.
template <class Abi>
inline Relative<Lanes<Abi>> load_relative(const Disc<double> *discs, const int *a, const int *b, Lanes<Abi>) {
  using V = Lanes<Abi>;
  constexpr int W = V::size(), FIELDS = sizeof(Disc<double>) / sizeof(double);
  static_assert(FIELDS % W == 0);
  using R = typename Raw<W>::type;
  using Spins = Raw<2>::type;

  R field[FIELDS];
  for (int part = 0; part < FIELDS; part += W) {
    for (int i = 0; i < W; i++)
      field[part + i] = load_row<R>(&discs[a[i]].x + part) - load_row<R>(&discs[b[i]].x + part);
    transpose<W>(field + part);
  }
  Spins spins[W];
  for (int i = 0; i < W; i++)
    spins[i] = load_row<Spins>(&discs[a[i]].omega_half) + load_row<Spins>(&discs[b[i]].omega_half);
  R half, now;
  to_lanes<W>(spins, half, now);
  return {{V(field[0]), V(field[1]), V(field[2]), V(field[3]), V(field[4]), V(field[5]), V(field[6]), V(field[7])},
          V(half),
          V(now)};
}

template <class Abi> inline Lanes<Abi> load(const double *column, Lanes<Abi>) {
  return Lanes<Abi>(column, stdx::vector_aligned);
}
template <class Abi> inline void store(double *column, Lanes<Abi> value) {
  value.copy_to(column, stdx::vector_aligned);
}

// Writes four vectors of W lanes as W rows of four values.
template <int W> inline void store_rows(double *out, const typename Raw<W>::type *r) {
  using R = typename Raw<W>::type;
  if constexpr (W == 2) {
    for (int half = 0; half < 4; half += 2) {
      R pair[2] = {r[half], r[half + 1]};
      transpose<2>(pair);
      for (int i = 0; i < 2; i++)
        std::memcpy(out + 4 * i + half, &pair[i], sizeof(R));
    }
  } else if constexpr (W == 4) {
    R row[4] = {r[0], r[1], r[2], r[3]};
    transpose<4>(row);
    for (int i = 0; i < 4; i++)
      std::memcpy(out + 4 * i, &row[i], sizeof(R));
  } else {
    constexpr std::make_index_sequence<W / 2> lanes;
    const typename Raw<W / 2>::type low[4] = {half<0>(r[0], lanes), half<0>(r[1], lanes), half<0>(r[2], lanes),
                                              half<0>(r[3], lanes)};
    const typename Raw<W / 2>::type high[4] = {half<1>(r[0], lanes), half<1>(r[1], lanes), half<1>(r[2], lanes),
                                               half<1>(r[3], lanes)};
    store_rows<W / 2>(out, low);
    store_rows<W / 2>(out + 2 * W, high);
  }
}

template <class Abi> inline void store_forces(Forces<double> *out, const Forces<Lanes<Abi>> &f) {
  constexpr int W = Lanes<Abi>::size();
  using R = typename Raw<W>::type;
  const R r[4] = {static_cast<R>(f.fx), static_cast<R>(f.fy), static_cast<R>(f.torque_a), static_cast<R>(f.torque_b)};
  store_rows<W>(&out->fx, r);
}

#endif

} // namespace cdem
