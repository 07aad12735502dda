// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies of the kernels: included once by each source file that is compiled for one instruction set.
#pragma once

#include "force_kernel.h"
#include "lane_io.h"
#include "laws.h"

#include <algorithm>
#include <array>

namespace cdem {
namespace { // without a name, so that each instruction set has its own copy

#ifdef CDEM_HAS_SIMD
using Widest = stdx::native_simd<double>;
constexpr int WIDTH = Widest::size();
#else
using Widest = double;
constexpr int WIDTH = 1;
#endif

// Some columns of the list of pairs. Has copies of the pointers: the compiler must assume that a store may change
// pointers that are in memory.
template <int n, class Number> struct Numbers {
  std::array<Number *, n> columns;

  explicit Numbers(Number *const *of) { std::copy_n(of, n, columns.begin()); }
  template <class T> [[gnu::always_inline]] std::array<T, n> load_all(int k, T) const {
    std::array<T, n> values;
    for (int i = 0; i < n; i++)
      values[i] = load(columns[i] + k, T());
    return values;
  }
  template <class T> [[gnu::always_inline]] void store_all(int k, const std::array<T, n> &values) const {
    for (int i = 0; i < n; i++)
      store(columns[i] + k, values[i]);
  }
};

// The columns of the energy losses of the pairs (books.h). Does nothing without an energy audit.
template <class Books> struct BookColumns {
  explicit BookColumns(const PairColumns &) {}
  NoLosses load_all(int) const { return {}; }
  void store_all(int, const NoLosses &) const {}
};
template <class T, std::size_t n> struct BookColumns<Losses<T, n>> {
  double *const friction, *const dashpots;
  const Numbers<2, double> first;
  const Numbers<int(n), double> more;

  explicit BookColumns(const PairColumns &p)
      : friction(p.friction), dashpots(p.dashpots), first(p.last_dashpots), more(p.last_dashpots + 2) {}
  [[gnu::always_inline]] Losses<T, n> load_all(int k) const {
    const auto [fn, ft] = first.load_all(k, T());
    return {load(friction + k, T()), load(dashpots + k, T()), fn, ft, more.load_all(k, T())};
  }
  [[gnu::always_inline]] void store_all(int k, const Losses<T, n> &l) const {
    store(friction + k, l.friction);
    store(dashpots + k, l.dashpots);
    first.store_all(k, std::array<T, 2>{l.dashpot_n, l.dashpot_t});
    more.store_all(k, l.more);
  }
};

constexpr int LINE = 64; // of the cache, bytes

template <int lines> [[gnu::always_inline]] inline const void *prefetch(const void *memory) {
  const char *const begin = static_cast<const char *>(memory);
  for (int l = 0; l < lines; l++)
    __builtin_prefetch(begin + LINE * l);
  return begin + LINE * lines;
}

// Prefetches a later group of pairs, and a part of what the block's grains and the next block will need (see Ahead).
[[gnu::always_inline]] inline void prefetch(const PairGroup *group, Ahead &ahead) {
  constexpr int GROUPS = 8;
  prefetch<sizeof(PairGroup) / LINE>(group + GROUPS);
  ahead.rows = prefetch<4>(ahead.rows); // eight pairs belong to about three grains
  ahead.bodies = prefetch<2>(ahead.bodies);
}

// The square root and the division of the next pairs are started before the law is applied to the present ones: see
// Distance. All functions of a law are always inlined: vectors would be passed to a function through memory.
// `fetches`: whether to prefetch; true_type or false_type, or a bool.
template <class Law, class Books, class T, class Fetches>
void loop(const Disc<double> *discs, const PairColumns &p, const Material &material, int begin, int end, double dt,
          Fetches fetches) {
  const Material m = material; // a copy: the compiler must assume that a store may change the original
  const Numbers<Law::MEMORIES, double> memories(p.memories);
  const Numbers<Law::CONSTANTS, const double> constants(p.constants);
  const BookColumns<Books> book_columns(p);
  Forces<double> *const slots = p.slots;
  constexpr int SIZE = PairGroup::SIZE;
  [[maybe_unused]] Ahead ahead = p.ahead;
  PairGroup *const groups = p.groups,
                   *group = groups + begin / SIZE, *const group_end = groups + (end + SIZE - 1) / SIZE;
  Relative<T> relative = load_relative(discs, group->a, group->b, T());
  Distance<T> distance = distance_of(relative);
  for (; group != group_end; ++group) {
    if (fetches)
      prefetch(group, ahead);
    for (int lane = 0; lane < SIZE; lane += WIDTH) {
      const PairGroup &next_group = group[(lane + WIDTH) / SIZE];
      const int next_lane = (lane + WIDTH) % SIZE;
      const Relative<T> next = load_relative(discs, next_group.a + next_lane, next_group.b + next_lane, T());
      const Distance<T> next_distance = distance_of(next);

      [[maybe_unused]] const int k = int(group - groups) * SIZE + lane;
      const PairConstants<T> pair{load(group->radius_sum + lane, T()), load(group->half_difference + lane, T()),
                                  load(group->dashpot_scale + lane, T())};
      T es = load(group->es + lane, T());
      auto memory = memories.load_all(k, T());
      Books books = book_columns.load_all(k);
      store_forces(slots, group->slot_a + lane, group->slot_b + lane,
                   Law::force(relative, distance, pair, constants.load_all(k, T()), m, dt, es, memory, books));
      book_columns.store_all(k, books);
      store(group->es + lane, es);
      memories.store_all(k, memory);
      relative = next;
      distance = next_distance;
    }
  }
}

template <class Law, class Books>
void forces(const Disc<double> *discs, const PairColumns &columns, const Material &material, int begin, int end,
            double dt) {
  const bool fetches = columns.ahead.rows;
  const auto run = [&](auto choice) { loop<Law, Books, Widest>(discs, columns, material, begin, end, dt, choice); };
  if constexpr (Law::CONSTANTS > 0)
    run(fetches); // with an addition the choice costs little beside the law, and a second loop as much to compile
  else if (fetches)
    run(std::true_type());
  else
    run(std::false_type());
}

void sum(const SlotBlock &block, Forces<double> *sums, int first) {
  for_each_sum(block, block.end, [=](int disc, Four sum) { store_raw(&sums[disc - first].fx, sum); });
}

// Calls loop(body_forces, travels) with both choices as compile-time constants.
template <class Loop> [[gnu::always_inline]] inline void choose(const StepRule &step, const Travel *travel, Loop loop) {
  using std::false_type, std::true_type;
  if (step.has_body_forces())
    travel ? loop(true_type(), true_type()) : loop(true_type(), false_type());
  else
    travel ? loop(false_type(), true_type()) : loop(false_type(), false_type());
}

void advance_block(const SlotBlock &block, Disc<double> *discs, Body *bodies, const StepRule &step, Fastest &fastest,
                   Travel *travel) {
  // Both always inlined: GCC otherwise calls a function for every disc, which reads all it needs from memory.
  choose(
      step, travel, [&](auto body_forces, auto travels) __attribute__((always_inline)) {
        Four squares{};
        const StepRule s = step;
        for_each_sum(
            block, block.end_of_grains, [&](int disc, Four sum) __attribute__((always_inline)) {
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

Kernels widest_kernels(const ContactRules &rules) {
  const auto loop_over_pairs = with_law(rules, [&rules](auto law) {
    using Law = decltype(law);
    return rules.books ? forces<Law, typename Law::template Books<Widest>> : forces<Law, NoLosses>;
  });
  return {loop_over_pairs, sum, expand_clumps, advance_clumps, advance_block};
}

} // namespace
} // namespace cdem
