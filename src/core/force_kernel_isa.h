// SPDX-License-Identifier: GPL-2.0-or-later
// Body of the force kernels: included once by each source file that is compiled for one instruction set.
#pragma once

#include "force_kernel.h"
#include "rows.h"

namespace cdem {
namespace { // a copy for each instruction set, under no shared name

#ifdef CDEM_HAS_SIMD
using Widest = stdx::native_simd<double>;
constexpr int WIDTH = Widest::size();
#else
using Widest = double;
constexpr int WIDTH = 1;
#endif

template <Law law, bool limit_damping, class T>
void forces(const Disc<double> *discs, const PairColumns &p, const Material &material, int begin, int end, double dt) {
  for (int k = begin; k < end; k += WIDTH) {
    const Pair<T> pair{load(p.radius_sum + k, T()), load(p.radius_difference + k, T()), load(p.root_mass + k, T())};
    History<T> history{load(p.es + k, T()), T(0)};
    if constexpr (law == Law::incremental)
      history.en = load(p.en + k, T());
    store_forces(p.force + k, contact_force<law, limit_damping, T>(load_relative(discs, p.a + k, p.b + k, T()), pair,
                                                                   material, dt, history));
    store(p.es + k, history.es);
    if constexpr (law == Law::incremental)
      store(p.en + k, history.en);
  }
}

ForceKernel widest_kernel(Law law, bool limit_damping) {
  if (law == Law::direct)
    return limit_damping ? forces<Law::direct, true, Widest> : forces<Law::direct, false, Widest>;
  return limit_damping ? forces<Law::incremental, true, Widest> : forces<Law::incremental, false, Widest>;
}

} // namespace
} // namespace cdem
