// SPDX-License-Identifier: GPL-2.0-or-later
// From rows in memory (one disc, or the forces of one pair) to lanes of a vector and back. A row is read with whole
// loads and transposed in registers, which is several times faster than gathering its values one by one.
#pragma once

#include "contact_law.h"

#include <cstring>
#include <utility>

namespace cdem {

inline Disc<double> load_discs(const Disc<double> *discs, const int *index, double) { return discs[*index]; }
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

template <class Abi> inline Disc<Lanes<Abi>> load_discs(const Disc<double> *discs, const int *index, Lanes<Abi>) {
  using V = Lanes<Abi>;
  constexpr int W = V::size(), FIELDS = sizeof(Disc<double>) / sizeof(double);
  static_assert(FIELDS % W == 0);
  V field[FIELDS];
  for (int part = 0; part < FIELDS; part += W) {
    typename Raw<W>::type r[W];
    for (int i = 0; i < W; i++)
      std::memcpy(&r[i], &discs[index[i]].x + part, sizeof(r[i]));
    transpose<W>(r);
    for (int i = 0; i < W; i++)
      field[part + i] = V(r[i]);
  }
  return {field[0], field[1], field[2], field[3], field[4], field[5], field[6], field[7]};
}

template <class Abi> inline Lanes<Abi> load(const double *column, Lanes<Abi>) {
  return Lanes<Abi>(column, stdx::vector_aligned);
}
template <class Abi> inline void store(double *column, Lanes<Abi> value) {
  value.copy_to(column, stdx::vector_aligned);
}

template <class Abi> inline void store_forces(Forces<double> *out, const Forces<Lanes<Abi>> &f) {
  constexpr int W = Lanes<Abi>::size();
  using R = typename Raw<W>::type;
  const R r[4] = {static_cast<R>(f.fx), static_cast<R>(f.fy), static_cast<R>(f.torque_a), static_cast<R>(f.torque_b)};
  if constexpr (W == 2) {
    for (int half = 0; half < 4; half += 2) {
      R pair[2] = {r[half], r[half + 1]};
      transpose<2>(pair);
      for (int i = 0; i < 2; i++)
        std::memcpy(&out[i].fx + half, &pair[i], sizeof(R));
    }
  } else {
    for (int first = 0; first < W; first += 4) {
      typename Raw<4>::type part[4];
      for (int i = 0; i < 4; i++)
        std::memcpy(&part[i], reinterpret_cast<const double *>(&r[i]) + first, sizeof(part[i]));
      transpose<4>(part);
      for (int i = 0; i < 4; i++)
        std::memcpy(&out[first + i], &part[i], sizeof(part[i]));
    }
  }
}

#endif

} // namespace cdem
