// SPDX-License-Identifier: GPL-2.0-or-later
// The contact law of two discs (Matsunae, Seguro, Yoshida 2012): direct accumulation (eq. 3) and incremental (eq. 2).
//
//   normal      e_n = k_n overlap (direct)   or   e_n += k_n du_n (incremental)
//   tangential  e_s += k_s du_s,   |e_s| <= e_n tan(phi);   at the limit the contact slides and its dashpot is off
//   viscous     d_n = c_n u_n,  d_s = c_s u_s,   c = 2 h sqrt(m k)
//
// Written once, for T = double or a vector of doubles (lanes.h). What changes within a step is in step_events.h.
#pragma once

#include "books.h"
#include "declaration.h"

#include <array>

namespace cdem {

// Force of the normal spring one step ago and now; `pressing` is the part of it that limits friction (N).
template <class T> struct NormalSpring { T before, now, pressing; };

struct DirectAccumulation {
  static constexpr const char *NAME = "direct";
  static constexpr std::array<Remembered, 0> REMEMBERS{};

  template <class T, class Share>
  [[gnu::always_inline]] static NormalSpring<T> spring(const Contact<T> &c, const Share &, const Material &m, double,
                                                       T *) {
    const T e_n = select(c.overlap > T(0), T(m.kn) * c.overlap, T(0));
    return {T(m.kn) * c.before, e_n, e_n};
  }
  static double force(double overlap, const Material &m, const double *) { return m.kn * overlap; }
};

struct IncrementalAccumulation {
  static constexpr const char *NAME = "incremental";
  static constexpr std::array<Remembered, 1> REMEMBERS{{{"en", "N"}}};

  // A contact that closed in this step, or has no history, starts with the force of its present overlap.
  template <class T, class Share>
  [[gnu::always_inline]] static NormalSpring<T> spring(const Contact<T> &c, const Share &share, const Material &m,
                                                       double dt, T *memory) {
    const auto touch = c.overlap > T(0), known = (share.spring == T(1)) && (memory[0] != T(0));
    const T before = memory[0], e_n = select(touch && known, fused(T(-m.kn * dt), c.half.n, before),
                                             select(touch, T(m.kn) * c.overlap, T(0)));
    memory[0] = e_n;
    return {before, e_n, select(e_n > T(0), e_n, T(0))};
  }
  static double force(double, const Material &, const double *memory) { return memory[0]; }
};

// Force along n and t on disc a (N), and a torque in addition to that of the force (N m). Disc b gets the opposite.
template <class T> struct Action { T fn, ft, torque; };

// The tangential spring (N), marked (in its last bit, lanes.h) as long as the contact sticks. Apart, the limit is 0 and
// clears it; in contact, TOUCHING stands for a limit of 0 in what is remembered. With dt = 0 a sliding contact stays
// sliding: neither value is marked, so |trial| equals the limit.
template <class T, class Share>
[[gnu::always_inline]] inline Friction<T> friction(const Contact<T> &c, const Share &share, const NormalSpring<T> &e_n,
                                                   const Material &m, double dt, T &es) {
  const T limit = unmarked(T(m.mu) * e_n.pressing), before = es;
  const T trial = unmarked(fused(T(-m.ks * dt) * c.step.t, share.spring, before));
  const auto sticks = magnitude(trial) < limit;
  const T now = select(sticks, trial, with_sign_of(limit, trial));
  es = select(sticks, marked(now), now + select(c.overlap > T(0), T(TOUCHING), T(0)));
  return {now, trial, limit, before, T(m.mu) * e_n.before};
}

// Springs, friction and dashpots of a contact; `e_n` is its normal spring. With limit_damping the normal force never
// pulls: the dashpot fades out before the discs separate, so the correction for a contact that opens is left out.
template <bool limit_damping, class T, class Share, class Books>
[[gnu::always_inline]] inline Action<T> springs_and_dashpots(const Contact<T> &c, const Share &share,
                                                             const PairConstants<T> &pair, const NormalSpring<T> &e_n,
                                                             const Material &m, double dt, T &es, Books &books) {
  const auto touch = c.overlap > T(0), stuck = is_marked(es);
  const Friction<T> f = friction(c, share, e_n, m, dt, es);
  const auto sticks = magnitude(f.trial) < f.limit;
  T weight_t = select(sticks, share.dashpot_t, T(0));
  if (any(sticks != stuck))
    weight_t += weight_of_switch(c, f, stuck, sticks, m, dt);

  T fn = fused(T(-m.dn) * (pair.dashpot_scale * share.dashpot_n), c.now.n, e_n.now);
  T ft = fused(T(-m.ds) * (pair.dashpot_scale * weight_t), c.now.t, f.es);
  T impulse = share.impulse, loss = share.loss;
  if constexpr (limit_damping) {
    fn = select(touch && fn > T(0), fn, T(0));
    impulse = select(touch, impulse, T(0)), loss = select(touch, loss, T(0));
  }
  const PartOfStep<T> part = part_of_step(c, share, pair, f, m, dt);
  book(books, c.step, {fn - e_n.now, ft - f.es}, f, loss, part.friction, m, dt);
  return {with_event(share, fn, impulse), with_event(share, ft, part.force), T(0)};
}

} // namespace cdem
