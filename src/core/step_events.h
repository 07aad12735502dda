// SPDX-License-Identifier: GPL-2.0-or-later
// What happens within a step: contacts close and open, begin and cease to slide at some moment of it. With what stands
// here the forces count for their part of the step, so that the time integration is of second order, and of third in a
// normal impact.
#pragma once

#include "kinematics.h"
#include "material.h"

#include <algorithm>

namespace cdem {

// Weights of a pair's forces, when it was in contact for only a part of the step just made.
//
// The trapezoidal rule of the time integration gives half of either neighbouring step to a force. A contact that closed
// a fraction f of the step ago acted during f, not 1/2, of it: its dashpots count f + 1/2 now. One that opened after a
// fraction f of the step got 1/2 of it when it was last seen: the dashpots' share of f - 1/2 is made good now. Without
// this a dashpot switches on and off at the borders of steps, and the scheme is of first order in time.
//
// What is left is of second order. Expanding the exact motion about the moment at which the contact closes or opens,
// with the overlap changing by X in the step and b = c_n dt/m, it is an impulse of
//
//   spring   k_n X (1 - 3 f (1 - f))/6 dt
//   dashpot  c_n u_n times -5/12 b (closing) or (f/2 - 1/3) b (opening) dt
//
// to be added now (f itself is b f (1 - f)/2 too large when a contact opens). With it a normal impact is of third
// order. Springs without dashpots go without: velocity Verlet alone keeps their energy, on average, for ever.
//
// With the impulse, the work that the scheme does against a spring is k_n X^2/6 more when the contact closes, and as
// much less when it opens, than the spring takes and gives, at any f: for the books that is work of the dashpot.
template <class T> struct Presence {
  T spring;               // share of this step's displacement that was made in contact
  T dashpot_n, dashpot_t; // weights of the dashpots
  T impulse;              // normal force that is added (N)
  T loss;                 // in the books (J)
};

// The same where no contact closed or opened in the step: fewer instructions, and no other bits.
template <class T> struct Steady { T spring, dashpot_n, dashpot_t, impulse, loss; };

template <class T> [[gnu::always_inline]] inline Steady<T> steady(T overlap) {
  const T weight = select(overlap > T(0), T(1), T(0));
  return {T(1), weight, weight, T(0), T(0)};
}

// Of pairs some of which closed or opened in the step; before is the overlap one step ago.
template <class T>
[[gnu::always_inline]] inline Presence<T> presence(T overlap, T before, T dashpot_scale, const Material &m, double dt) {
  const auto touch = overlap > T(0), changed = touch != (before > T(0));
  const Steady<T> lasting = steady(overlap);
  const T X = magnitude(overlap - before), f = select(touch, overlap, before) / select(changed, X, T(1));
  const T ratio = T(4 * m.dn * dt) / dashpot_scale, b = select(ratio < T(1), ratio, T(1));
  const T share = f + select(touch, T(0.5), T(-0.5));
  const T second_order = b * select(touch, T(-5. / 12), T(0.5) * f - T(1. / 3));
  const T kx = T(m.dn > 0 ? m.kn / 6 : 0) * X, impulse = kx * (T(1) - T(3) * f * (T(1) - f));
  return {select(changed, f, lasting.spring), select(changed, share + second_order, lasting.dashpot_n),
          select(changed, share, lasting.dashpot_t), select(changed, impulse, lasting.impulse),
          select(changed, select(touch, kx, -kx) * X, lasting.loss)};
}

// The dashpots of a pair that are to be used with steps of dt, over 2 h sqrt(m k): with them an oscillation decays per
// period as it does without steps.
//
// The dashpots' velocity comes from the two half steps behind, x' - dt^2/3 x''', and the scheme's acceleration is
// x'' + dt^2/12 x''''. For x' = lambda x the equation of motion gives lambda^3 and lambda^4 in terms of lambda, and so
// the damping ratio of the scheme, h (1 + (11 - 20 h^2)/24 k dt^2/m), which this takes away: a pair of mass m has
// m/(m + this) of its dashpots. w is the share by which the velocity is carried forward (stability.h); as it goes to 0
// so does the correction.
inline double mass_of_steps(const Material &material, double dt, double w) {
  const double h = material.dn / std::sqrt(material.kn);
  return w * std::max(0.0, (11 - 20 * h * h) / 24) * material.kn * dt * dt;
}
// PairConstants::dashpot_scale of a pair of mass m, given mass_of_steps().
inline double dashpot_scale(double m, double of_steps) { return 2 * std::sqrt(m) * m / (m + of_steps); }

// The tangential spring of a pair in this step and before it, what it would be without friction's limit, and that
// limit.
template <class T> struct Friction {
  T es, trial, limit;
  T es_before, limit_before;
};

// The tangential spring of a contact that closed or opened in the step acted during f of it; the time integration gives
// it the mean of before and now for all of it. If the contact closed and sticks, or stuck until it opened and so let go
// of a stretched spring and of a dashpot, the difference is a force that is to be added now. If it slides, the spring
// is mu times the normal one, and so is its impulse: then nothing is missing but that work in the books.
template <class T> struct PartOfStep { T force, friction; }; // (N), (J)

template <class T>
[[gnu::always_inline]] inline PartOfStep<T> part_of_step(const Contact<T> &c, const Presence<T> &share,
                                                         const PairConstants<T> &pair, const Friction<T> &f,
                                                         const Material &m, double dt) {
  constexpr double FAR = 0.5; // from sliding, which sets in before the contact opens
  const auto touch = c.overlap > T(0), touched = c.before > T(0);
  const auto closes = touch && !touched, opens = touched && !touch;
  const auto closes_sticking = closes && magnitude(f.trial) < f.limit;
  const auto opens_sticking = opens && magnitude(f.es_before) < T(FAR) * f.limit_before;
  const T spring = T(0.5) * fused(share.spring, f.es_before + f.trial, -(f.es_before + f.es));
  const T dashpot = T(-m.ds) * (pair.dashpot_scale * share.dashpot_t) * c.now.t;
  const T work = T(-0.5 * dt) * (T(1) - share.spring) * (f.es_before + f.es) * c.step.t;
  const auto sticks = closes_sticking || opens_sticking;
  return {select(closes_sticking, spring, select(opens_sticking, spring + dashpot, T(0))),
          select((closes || opens) && !sticks, work, T(0))};
}
template <class T>
inline PartOfStep<T> part_of_step(const Contact<T> &, const Steady<T> &, const PairConstants<T> &, const Friction<T> &,
                                  const Material &, double) {
  return {T(0), T(0)};
}

// Of pairs some of which began or ceased to slide in the step: what their tangential dashpot counts beside its weight,
// by the rule of Presence, as it acts while the contact sticks. One that sticks until a fraction f of the step got 1/2
// when it was last seen, one that sticks from then on gets 1 now instead of 1 - f + 1/2. A spring reaches its limit as
// if both changed uniformly. A contact slides as long as the spring, but for the limit, gains on it, at a rate that is
// known for the middle of the step and for its end.
template <class T, class Mask>
[[gnu::always_inline]] inline T weight_of_switch(const Contact<T> &c, const Friction<T> &f, Mask stuck, Mask sticks,
                                                 const Material &m, double dt) {
  const auto both = c.before > T(0) && c.overlap > T(0);
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
