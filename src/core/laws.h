// SPDX-License-Identifier: GPL-2.0-or-later
// The list of contact laws. To add one, include its file and add its type to one of the two lists below. law_table.h
// shows them to the rest of the program.
#pragma once

#include "contact_law.h"
#include "laws/cohesion.h"
#include "laws/rolling_resistance.h"
#include "rules.h"

#include <array>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace cdem {

// Exactly one of these is in use.
using Accumulations = std::tuple<DirectAccumulation, IncrementalAccumulation>;
// Any of these may be added, to all contacts or to those of some atom types. Each has
//
//   NAME, PARAMETERS           as pair_coeff has them
//   REMEMBERS                  what a contact remembers of it
//   CONSTANTS, set_constants   numbers of a pair of discs that the loop reads, set when a list of pairs is built
//   BOOKS, rate                1 if it has a dashpot, which it books by book_added(), and the velocity of that; else 0
//   act                        what it adds to force and torque, in a step
//   resist                     what it adds to the resistance of a contact, for the stability limit
//   energy                     what a contact has stored in it (J)
using Additions = std::tuple<RollingResistance, Cohesion>;

constexpr int ACCUMULATIONS = std::tuple_size_v<Accumulations>, ADDITIONS = std::tuple_size_v<Additions>;

// Whether restart files have room for the names.
template <std::size_t n> constexpr bool names_fit(const std::array<Remembered, n> &numbers) {
  for (const Remembered &number : numbers)
    if (std::char_traits<char>::length(number.name) > LONGEST_NAME)
      return false;
  return true;
}

template <class Accumulation, bool limit_damping, class... Added> struct ContactLaw {
  // How many numbers of a pair the law adds: to what contacts remember (the tangential spring), to PairConstants, and
  // to Losses.
  static constexpr int MEMORIES = int((Accumulation::REMEMBERS.size() + ... + Added::REMEMBERS.size()));
  static constexpr int CONSTANTS = (0 + ... + Added::CONSTANTS), BOOKS = (0 + ... + Added::BOOKS);
  template <class T> using Books = Losses<T, BOOKS>;
  static_assert(MEMORIES <= MOST_NUMBERS && CONSTANTS <= MOST_NUMBERS && BOOKS <= MOST_NUMBERS);
  static_assert((names_fit(Accumulation::REMEMBERS) && ... && names_fit(Added::REMEMBERS)));

  // The force of a pair, and what its contact remembers, brought forward by the displacement of a step of length dt.
  // With dt = 0 it is the force of the present state, and the memory stays as it is.
  template <class T, class B>
  [[gnu::always_inline]] static Forces<T> force(const Relative<T> &u, const Distance<T> &distance,
                                                const PairConstants<T> &pair, const std::array<T, CONSTANTS> &constants,
                                                const Material &m, double dt, T &es, std::array<T, MEMORIES> &memory,
                                                B &books) {
    Contact<T> c = contact_of(u, distance, pair, dt);
    const auto was = touched(es);
    if (any((c.overlap > T(0)) != was)) {
      if (dt > 0)
        return force(c, presence(c.overlap, c.before, was, pair.dashpot_scale, m, dt), pair, constants, m, dt, es,
                     memory, books);
      settle(c.overlap, es, pair.radius_sum);
    }
    return force(c, steady(c.overlap), pair, constants, m, dt, es, memory, books);
  }

  // Books the half of the last dashpot forces that belongs to the step just made, for a list that will be replaced
  // before its next forces.
  static void finish_books(const Contact<double> &c, double dt, Books<double> &books) {
    const Friction<double> nothing{};
    book(books, c.step, {0, 0}, nothing, 0.0, 0.0, Material(), dt);
    [[maybe_unused]] std::size_t k = 0;
    [[maybe_unused]] auto finish = [&](auto addition) {
      if constexpr (decltype(addition)::BOOKS > 0)
        book_added(books, k++, {}, addition.rate(c), dt);
    };
    (finish(Added()), ...);
  }

  // Energy stored in a contact (J). `remembered` begins with the tangential spring.
  template <class Energy>
  static Energy energy(const Material &m, [[maybe_unused]] const double *constant, const double *remembered,
                       double overlap) {
    if (overlap <= 0)
      return {0, 0, 0};
    const double es = *remembered++, en = Accumulation::force(overlap, m, remembered);
    Energy e{0.5 * en * en / m.kn, m.ks > 0 ? 0.5 * es * es / m.ks : 0, 0};
    remembered += Accumulation::REMEMBERS.size();
    ((e.added += Added::energy(constant, remembered, overlap), constant += Added::CONSTANTS,
      remembered += Added::REMEMBERS.size()),
     ...);
    return e;
  }

private:
  template <class T, class Share, class B>
  [[gnu::always_inline]] static Forces<T> force(const Contact<T> &c, const Share &share, const PairConstants<T> &pair,
                                                const std::array<T, CONSTANTS> &constants, const Material &m, double dt,
                                                T &es, std::array<T, MEMORIES> &memory, B &books) {
    const NormalSpring<T> e_n = Accumulation::spring(c, share, m, dt, memory.data());
    Action<T> act = springs_and_dashpots<limit_damping>(c, share, pair, e_n, m, dt, es, books);
    [[maybe_unused]] const T *constant = constants.data();
    [[maybe_unused]] T *number = memory.data() + Accumulation::REMEMBERS.size();
    [[maybe_unused]] std::size_t dashpot = 0;
    ((Added::act(c, share, e_n, constant, number, dt, act, books, dashpot), constant += Added::CONSTANTS,
      number += Added::REMEMBERS.size(), dashpot += Added::BOOKS),
     ...);
    const T back = -act.ft;
    const Forces<T> f{fused(act.fn, c.nx, back * c.ny), fused(act.fn, c.ny, act.ft * c.nx), back * c.lever_a,
                      back * c.lever_b};
    if constexpr (sizeof...(Added) == 0)
      return f;
    else
      return {f.fx, f.fy, f.torque_a + act.torque, f.torque_b - act.torque};
  }
};

namespace laws {
template <class Accumulation, bool limit_damping, class... Added>
ContactLaw<Accumulation, limit_damping, Added...> composed(std::tuple<Added...>);
template <unsigned additions, std::size_t... k> auto chosen(std::index_sequence<k...>) {
  return std::tuple_cat(
      std::conditional_t<bool(additions >> k & 1), std::tuple<std::tuple_element_t<k, Additions>>, std::tuple<>>()...);
}
} // namespace laws
template <int accumulation, unsigned additions, bool limit_damping>
using LawOf = decltype(laws::composed<std::tuple_element_t<accumulation, Accumulations>, limit_damping>(
    laws::chosen<additions>(std::make_index_sequence<ADDITIONS>())));

// Calls visit with an object of the ContactLaw type that the rules choose, among those with the first `sets` sets of
// additions. A caller that uses none passes 1, so that no other law is compiled for it.
template <unsigned sets = 1u << ADDITIONS, int accumulation = 0, unsigned additions = 0, class Visit>
auto with_law(const ContactRules &rules, Visit visit) {
  if (rules.accumulation == accumulation && rules.additions == additions)
    return rules.limit_damping ? visit(LawOf<accumulation, additions, true>())
                               : visit(LawOf<accumulation, additions, false>());
  if constexpr (additions + 1 < sets)
    return with_law<sets, accumulation, additions + 1>(rules, visit);
  else if constexpr (accumulation + 1 < ACCUMULATIONS)
    return with_law<sets, accumulation + 1>(rules, visit);
  else
    throw std::out_of_range("no such contact law");
}

} // namespace cdem
