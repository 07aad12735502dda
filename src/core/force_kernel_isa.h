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

template <class T> NoLosses load_losses(const PairColumns &, int, NoLosses) { return {}; }
template <class T> Losses<T> load_losses(const PairColumns &p, int k, Losses<T>) {
  return {load(p.friction + k, T()), load(p.dashpots + k, T()), load(p.dashpot_n + k, T()), load(p.dashpot_t + k, T())};
}

void store_losses(const PairColumns &, int, const NoLosses &) {}
template <class T> void store_losses(const PairColumns &p, int k, const Losses<T> &l) {
  store(p.friction + k, l.friction);
  store(p.dashpots + k, l.dashpots);
  store(p.dashpot_n + k, l.dashpot_n);
  store(p.dashpot_t + k, l.dashpot_t);
}

template <Law law, bool limit_damping, class Books, class T>
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
    Books books = load_losses<T>(p, k, Books());
    store_forces(p.slots, p.slot_a + k, p.slot_b + k,
                 contact_force<law, limit_damping, T>(relative, pair, m, dt, history, books));
    store_losses(p, k, books);
    store(p.es + k, history.es);
    if constexpr (law == Law::incremental)
      store(p.en + k, history.en);
  }
}

void sum(const SlotBlock &block, Forces<double> *sums, int first) {
  for_each_sum(block, block.end, [=](int disc, Four sum) { store_raw(&sums[disc - first].fx, sum); });
}

// Calls loop(body_forces, travels) with what it is to know when it is compiled.
template <class Loop> [[gnu::always_inline]] inline void choose(const StepRule &step, const Travel *travel, Loop loop) {
  using std::false_type, std::true_type;
  if (step.has_body_forces())
    travel ? loop(true_type(), true_type()) : loop(true_type(), false_type());
  else
    travel ? loop(false_type(), true_type()) : loop(false_type(), false_type());
}

void advance_block(const SlotBlock &block, Disc<double> *discs, Body *bodies, const StepRule &step, Fastest &fastest,
                   Travel *travel) {
  choose(step, travel, [&](auto body_forces, auto travels) {
    Four squares{};
    const StepRule s = step;
    for_each_sum(block, block.end_of_grains, [&](int disc, Four sum) {
      advance<body_forces>(discs[disc], bodies[disc], sum, s, squares, travels ? travel + disc : nullptr);
    });
    fastest.see(squares);
  });
}

void expand_clumps(const ClumpColumns &columns, int begin, int end, double half_step) {
  expand(columns, begin, end, half_step);
}

void advance_clumps(const ClumpColumns &columns, int begin, int end, const StepRule &step, Fastest &fastest,
                    Travel *travel) {
  choose(step, travel, [&](auto body_forces, auto travels) {
    Four squares{};
    const ClumpColumns c = columns;
    const StepRule s = step;
    Expansion discs(c, 0.5 * s.dt);
    for (int i = begin; i < end; i++) {
      if (c.bodies[i].inverse_mass == 0)
        continue;
      advance<body_forces>(c.grains[i], c.bodies[i], force_on(c, i), s, squares, travels ? travel + i : nullptr);
      discs.add(i);
    }
    discs.finish();
    fastest.see(squares);
  });
}

template <Law law, class Books> auto forces_of(bool limit_damping) {
  return limit_damping ? forces<law, true, Books, Widest> : forces<law, false, Books, Widest>;
}

template <class Books> auto forces_of(Law law, bool limit_damping) {
  return law == Law::direct ? forces_of<Law::direct, Books>(limit_damping)
                            : forces_of<Law::incremental, Books>(limit_damping);
}

Kernels widest_kernels(const ContactRules &rules) {
  return {rules.books ? forces_of<Losses<Widest>>(rules.law, rules.limit_damping)
                      : forces_of<NoLosses>(rules.law, rules.limit_damping),
          sum, expand_clumps, advance_clumps, advance_block};
}

} // namespace
} // namespace cdem
