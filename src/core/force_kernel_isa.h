// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies of the kernels: included once by each source file that is compiled for one instruction set.
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
void forces(const Disc<double> *discs, const PairColumns &columns, const Material &material, int begin, int end,
            double dt) {
  const PairColumns p = columns; // copies: what is stored below could otherwise change them
  const Material m = material;
  for (int k = begin; k < end; k += WIDTH) {
    const Pair<T> pair{load(p.radius_sum + k, T()), load(p.half_difference + k, T()), load(p.root_mass + k, T())};
    History<T> history{load(p.es + k, T()), T(0)};
    if constexpr (law == Law::incremental)
      history.en = load(p.en + k, T());
    const Relative<T> relative = load_relative(discs, p.a + k, p.b + k, T());
    store_forces(p.slots, p.slot_a + k, p.slot_b + k,
                 contact_force<law, limit_damping, T>(relative, pair, m, dt, history));
    store(p.es + k, history.es);
    if constexpr (law == Law::incremental)
      store(p.en + k, history.en);
  }
}

void sum(const SlotBlock &block, Forces<double> *sums, int first) {
  for_each_sum(block, [=](int disc, Four sum) { store_raw(&sums[disc - first].fx, sum); });
}

template <bool body_forces>
void advance_block(const SlotBlock &block, Disc<double> *discs, Body *bodies, const StepRule &step, Fastest &fastest) {
  Four squares{};
  const StepRule s = step;
  for_each_sum(block, [&](int disc, Four sum) { advance<body_forces>(discs[disc], bodies[disc], sum, s, squares); });
  fastest.see(squares);
}

void expand_clumps(const ClumpColumns &columns, int begin, int end, double half_step) {
  const ClumpColumns c = columns;
  expand(c, begin, end, half_step);
}

template <bool body_forces>
void advance_clumps(const ClumpColumns &columns, int begin, int end, const StepRule &step, Fastest &fastest) {
  Four squares{};
  const ClumpColumns c = columns;
  const StepRule s = step;
  for (int i = begin; i < end; i++)
    advance<body_forces>(c.grains[i], c.bodies[i], force_on(c, i), s, squares);
  fastest.see(squares);
  expand(c, begin, end, 0.5 * s.dt);
}

Kernels widest_kernels(Law law, bool limit_damping) {
  Kernels k{nullptr,
            sum,
            expand_clumps,
            {advance_clumps<false>, advance_clumps<true>},
            {advance_block<false>, advance_block<true>}};
  if (law == Law::direct)
    k.forces = limit_damping ? forces<Law::direct, true, Widest> : forces<Law::direct, false, Widest>;
  else
    k.forces = limit_damping ? forces<Law::incremental, true, Widest> : forces<Law::incremental, false, Widest>;
  return k;
}

} // namespace
} // namespace cdem
