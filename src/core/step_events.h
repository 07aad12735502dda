// SPDX-License-Identifier: GPL-2.0-or-later
// Events within a step: a contact closes or opens, begins or ceases to slide, at some moment between two steps. The
// corrections here make the forces count for the part of the step in which they acted. With them the time integration
// is of second order, and of third order for a normal impact, at whatever moment of a step it begins. It is of first
// order where a contact stays at the border between sticking and sliding: neither holds for long, as sliding drops the
// dashpot and sticking has all of it, and the steps alternate.
#pragma once

#include "kinematics.h"
#include "material.h"

#include <algorithm>
#include <limits>

namespace cdem {

// Whether a pair touched one step ago is remembered, not told from Contact::before: this is rounded, and where the
// normal turns it is off by an error of third order. So a contact that begins or ends as a step ends would be missed,
// or be seen twice. Hence the tangential spring of a contact is never 0: where it vanishes, TOUCHING is remembered in
// its place (N). It is a power of two: it bears no mark, and to add it to any other spring changes no bit.
constexpr double TOUCHING = 0x1p-600;

template <class T> [[gnu::always_inline]] inline auto touched(T es) { return es != T(0); }

// As a run begins (dt = 0), discs may touch of which nothing is known, discs of old contacts may have been moved away,
// and coordinates may have changed by round-off, across a period. So a pair touches if its overlap is larger than
// round-off, and does not if its gap is; in between, it does if it did. Discs that have just touched as a run begins so
// close within its first step. Gives the overlap the sign of the answer; friction() clears what is to be forgotten.
template <class T> [[gnu::always_inline]] inline void settle(T &overlap, T &es, T radius_sum) {
  const T round_off = T(1e-12) * radius_sum, least = T(std::numeric_limits<double>::min());
  const auto positive = overlap > T(0), touches = overlap > round_off || (touched(es) && overlap > -round_off);
  overlap = select(touches, select(positive, overlap, least), select(positive, T(0), overlap));
  es = select(touches && !touched(es), marked(T(0)), es);
}

// Weights of a pair's forces, when it was in contact for only a part of the step just made.
//
// In the time integration (trapezoidal rule), a force counts for half of the step before it and half of the step after
// it. A contact that closed a fraction f of the step ago acted during f of that step, not 1/2: its dashpots now count
// f + 1/2. A contact that opened after a fraction f of the step was given 1/2 when it was last seen: now the dashpots
// get the difference, f - 1/2. Without this, dashpots switch on and off at the borders of steps, and the scheme is of
// first order in time.
// The remaining error is of second order. Expand the exact motion about the moment at which the contact closes or
// opens, with X the change of the overlap in the step and b = c_n dt/m (at most 1 here). The error is an impulse of
//
//   spring   k_n X (1 - 3 f (1 - f))/6 dt
//   dashpot  c_n u_n times -5/12 b (closing) or (f/2 - 1/3) b (opening) dt
//
// which is added now. (When a contact opens, the f that is computed here is too large by b f (1 - f)/2.) With it a
// normal impact is of third order. Without dashpots no impulse is added: velocity Verlet alone conserves the energy of
// the springs on average.
//
// With the impulse, the work of the scheme against a spring is not the energy that the spring takes up or gives back:
// it is k_n X^2/6 more when the contact closes, and as much less when it opens, for any f. The energy audit books this
// as work of the dashpot.
template <class T, class Mask> struct Presence {
  Mask changed;           // whether the contact closed or opened in the step
  T spring;               // share of this step's displacement that was made in contact
  T dashpot_n, dashpot_t; // weights of the dashpots
  T impulse;              // additional normal force (N)
  T loss;                 // booked as work of the dashpot (J)
};

// The same if no contact closed or opened in the step: fewer instructions, the same bits.
template <class T> struct Steady { T spring, dashpot_n, dashpot_t, impulse, loss; };

template <class T> [[gnu::always_inline]] inline Steady<T> steady(T overlap) {
  const T weight = select(overlap > T(0), T(1), T(0));
  return {T(1), weight, weight, T(0), T(0)};
}

// The general case: some of the pairs closed or opened in the step. `before` is the overlap one step ago (m), but for
// round-off: f is kept between 0 and 1.
template <class T, class Mask>
[[gnu::always_inline]] inline Presence<T, Mask> presence(T overlap, T before, Mask touched, T dashpot_scale,
                                                         const Material &m, double dt) {
  const auto touch = overlap > T(0), changed = touch != touched;
  const Steady<T> lasting = steady(overlap);
  const T X = magnitude(overlap - before), part = select(touch, overlap, before) / select(changed, X, T(1));
  const T above = select(part > T(0), part, T(0)), f = select(above < T(1), above, T(1));
  const T ratio = T(4 * m.dn * dt) / dashpot_scale, b = select(ratio < T(1), ratio, T(1));
  const T share = f + select(touch, T(0.5), T(-0.5));
  const T second_order = b * select(touch, T(-5. / 12), T(0.5) * f - T(1. / 3));
  const T kx = T(m.dn > 0 ? m.kn / 6 : 0) * X, impulse = kx * (T(1) - T(3) * f * (T(1) - f));
  return {changed,
          select(changed, f, lasting.spring),
          select(changed, share + second_order, lasting.dashpot_n),
          select(changed, share, lasting.dashpot_t),
          select(changed, impulse, lasting.impulse),
          select(changed, select(touch, kx, -kx) * X, lasting.loss)};
}

// `force`, and `more` if the contact closed or opened in the step.
template <class T, class Mask>
[[gnu::always_inline]] inline T with_event(const Presence<T, Mask> &share, T force, T more) {
  return select(share.changed, force + more, force);
}
template <class T> [[gnu::always_inline]] inline T with_event(const Steady<T> &, T force, T) { return force; }

// A mass (kg): with steps of dt, a pair of mass m uses m/(m + this) of its dashpots. Then an oscillation decays per
// period as in the exact motion.
//
// The velocity of the dashpots is extrapolated from the last two half steps, which gives x' - dt^2/3 x'''; the
// acceleration of the scheme is x'' + dt^2/12 x''''. With x' = lambda x the equation of motion gives lambda^3 and
// lambda^4 in terms of lambda, and so the damping ratio of the scheme, h (1 + (11 - 20 h^2)/24 k dt^2/m). The reduction
// removes this excess, if it is positive. w is the share by which the velocity is carried forward (stability.h); the
// correction is proportional to w.
inline double mass_of_steps(const Material &material, double dt, double w) {
  const double h = material.dn / std::sqrt(material.kn);
  return w * std::max(0.0, (11 - 20 * h * h) / 24) * material.kn * dt * dt;
}
// PairConstants::dashpot_scale of a pair of mass m, given mass_of_steps().
inline double dashpot_scale(double m, double of_steps) { return 2 * std::sqrt(m) * m / (m + of_steps); }

// The tangential spring of a pair now and one step ago, what it would be now without the limit of friction (`trial`),
// and that limit now and one step ago (N).
template <class T> struct Friction {
  T es, trial, limit;
  T es_before, limit_before;
};

// The tangential spring of a contact that closed or opened in the step acted during a fraction of the step, while the
// time integration counts the mean of before and now for the whole step. If the contact closed and sticks, the
// difference is a force that is added now. The same holds if it stuck until it opened, and so released a stretched
// spring and a dashpot. If it slides, the spring is mu times the normal spring, and so is its impulse: no force is
// missing, only friction work in the energy audit.
template <class T> struct PartOfStep { T force, friction; }; // (N), (J)

template <class T, class Mask>
[[gnu::always_inline]] inline PartOfStep<T> part_of_step(const Contact<T> &c, const Presence<T, Mask> &share,
                                                         const PairConstants<T> &pair, const Friction<T> &f,
                                                         const Material &m, double dt) {
  constexpr double FAR = 0.5; // share of the limit; a contact above it slides before it opens
  const auto touch = c.overlap > T(0), closes = share.changed && touch, opens = share.changed && !touch;
  const auto closes_sticking = closes && magnitude(f.trial) < f.limit;
  const auto opens_sticking = opens && magnitude(f.es_before) < T(FAR) * f.limit_before;
  const T spring = T(0.5) * fused(share.spring, f.es_before + f.trial, -(f.es_before + f.es));
  const T dashpot = T(-m.ds) * (pair.dashpot_scale * share.dashpot_t) * c.now.t;
  const T work = T(-0.5 * dt) * (T(1) - share.spring) * (f.es_before + f.es) * c.step.t;
  const auto sticks = closes_sticking || opens_sticking;
  return {select(closes_sticking, spring, select(opens_sticking, spring + dashpot, T(0))),
          select(share.changed && !sticks, work, T(0))};
}
template <class T>
inline PartOfStep<T> part_of_step(const Contact<T> &, const Steady<T> &, const PairConstants<T> &, const Friction<T> &,
                                  const Material &, double) {
  return {T(0), T(0)};
}

// For pairs of which some began or ceased to slide in the step: what is added to the weight of the tangential dashpot,
// which acts only while the contact sticks; the rule is that of Presence. A contact that sticks until a fraction f of
// the step was given 1/2 when it was last seen: f - 1/2 is added. One that sticks from f on gets 1 now instead of
// 1 - f + 1/2: 1/2 - f is added. The moment when sliding begins: spring and limit are taken to change uniformly. The
// moment when it ceases: a contact slides as long as the spring, if it had no limit, would grow faster than the limit;
// the difference of these rates is known for the middle of the step and for its end.
template <class T, class Mask>
[[gnu::always_inline]] inline T weight_of_switch(const Contact<T> &c, const Friction<T> &f, Mask stuck, Mask sticks,
                                                 const Material &m, double dt) {
  const auto both = touched(f.es_before) && c.overlap > T(0);
  const T excess = magnitude(f.trial) - f.limit, room = f.limit_before - magnitude(f.es_before);
  const auto begins = both && stuck && !sticks && room > T(0);
  const T until = room / select(begins, room + excess, T(1));

  const T slip = with_sign_of(T(m.ks * dt), f.es_before) * c.now.t;
  const T middle = excess + room, end = fused(T(m.mu * m.kn * dt), c.now.n, -slip);
  const auto ceases = both && !stuck && sticks && end < T(0) && end < middle;
  const T part = T(0.5) * end / select(ceases, end - middle, T(1)), since = select(part < T(1), part, T(1));
  return select(begins, until - T(0.5), select(ceases, since - T(0.5), T(0)));
}

} // namespace cdem
