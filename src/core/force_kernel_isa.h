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

constexpr int LINE = 64; // of the cache, bytes

template <int lines> [[gnu::always_inline]] inline const void *prefetch(const void *memory) {
  const char *const begin = static_cast<const char *>(memory);
  for (int l = 0; l < lines; l++)
    __builtin_prefetch(begin + LINE * l);
  return begin + LINE * lines;
}

// Groups ahead, and what the block's grains and the next block will need.
[[gnu::always_inline]] inline void prefetch(const PairGroup *group, Ahead &ahead) {
  constexpr int GROUPS = 8;
  prefetch<sizeof(PairGroup) / LINE>(group + GROUPS);
  ahead.rows = prefetch<4>(ahead.rows); // three grains have some eight pairs
  ahead.bodies = prefetch<2>(ahead.bodies);
}

// Root and division of the next pairs are begun before the law is applied to these: see Distance.
template <Law law, bool limit_damping, class Books, class T, bool fetches>
void loop(const Disc<double> *discs, const PairColumns &columns, const Material &material, int begin, int end,
          double dt) {
  const PairColumns p = columns; // copies: what is stored below could otherwise change them
  const Material m = material;
  constexpr int SIZE = PairGroup::SIZE;
  [[maybe_unused]] Ahead ahead = p.ahead;
  PairGroup *group = p.groups + begin / SIZE, *const group_end = p.groups + (end + SIZE - 1) / SIZE;
  Relative<T> relative = load_relative(discs, group->a, group->b, T());
  Distance<T> distance = distance_of(relative);
  for (; group != group_end; ++group) {
    if constexpr (fetches)
      prefetch(group, ahead);
    for (int lane = 0; lane < SIZE; lane += WIDTH) {
      const PairGroup &next_group = group[(lane + WIDTH) / SIZE];
      const int next_lane = (lane + WIDTH) % SIZE;
      const Relative<T> next = load_relative(discs, next_group.a + next_lane, next_group.b + next_lane, T());
      const Distance<T> next_distance = distance_of(next);

      [[maybe_unused]] const int k = int(group - p.groups) * SIZE + lane;
      const Pair<T> pair{load(group->radius_sum + lane, T()), load(group->half_difference + lane, T()),
                         load(group->root_mass + lane, T())};
      History<T> history{load(group->es + lane, T()), T(0)};
      if constexpr (law == Law::incremental)
        history.en = load(p.en + k, T());
      Books books = load_losses<T>(p, k, Books());
      store_forces(p.slots, group->slot_a + lane, group->slot_b + lane,
                   contact_force<law, limit_damping, T>(relative, distance, pair, m, dt, history, books));
      store_losses(p, k, books);
      store(group->es + lane, history.es);
      if constexpr (law == Law::incremental)
        store(p.en + k, history.en);
      relative = next;
      distance = next_distance;
    }
  }
}

template <Law law, bool limit_damping, class Books, class T>
void forces(const Disc<double> *discs, const PairColumns &columns, const Material &material, int begin, int end,
            double dt) {
  columns.ahead.rows ? loop<law, limit_damping, Books, T, true>(discs, columns, material, begin, end, dt)
                     : loop<law, limit_damping, Books, T, false>(discs, columns, material, begin, end, dt);
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
