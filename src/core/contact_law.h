// SPDX-License-Identifier: GPL-2.0-or-later
// The contact law of two discs: direct and incremental accumulation (Matsunae, Seguro, Yoshida 2012, eqs. 2 and 3).
//
//   normal      e_n = k_n overlap (direct)   or   e_n += k_n du_n (incremental)
//   tangential  e_s += k_s du_s,   |e_s| <= e_n tan(phi);   at the limit the contact slides and its dashpot is off
//   viscous     d_n = c_n u_n,  d_s = c_s u_s,   c = 2 h sqrt(m k)
//
// Every force here is written once, for T = double or a vector of doubles; see lanes.h.
#pragma once

#include "lanes.h"

#include <algorithm>
#include <limits>

namespace cdem {

enum class Law { direct, incremental };

// What the law needs of one disc. The springs follow the displacement of the step, so they take the velocity of the
// half step, with which the positions moved; the dashpots take the velocity at the time of the force.
template <class T> struct alignas(8 * sizeof(T)) Disc {
  T x, y;
  T vx_half, vy_half;
  T vx, vy;
  T omega_half, omega;
};

// Disc a relative to disc b, and the spins of both.
template <class T> struct Relative {
  T x, y;
  T vx_half, vy_half;
  T vx, vy;
  T omega_half_a, omega_a, omega_half_b, omega_b;
};

inline Relative<double> relative(const Disc<double> &a, const Disc<double> &b) {
  return {a.x - b.x,    a.y - b.y,   a.vx_half - b.vx_half, a.vy_half - b.vy_half,
          a.vx - b.vx,  a.vy - b.vy, a.omega_half,          a.omega,
          b.omega_half, b.omega};
}

// Constants of one pair of materials.
struct Material {
  double kn = 0, ks = 0; // N/m
  double dn = 0, ds = 0; // dashpots over 2 sqrt(m): h sqrt(k)
  double mu = 0;         // tan(phi)
};

inline Material material(double kn, double ks, double hn, double hs, double mu) {
  return {kn, ks, hn * std::sqrt(kn), hs * std::sqrt(ks), mu};
}

// Constants of one pair of discs. The lever arms to the contact point are r - overlap/2: of disc a, half the distance
// plus, and of disc b, half the distance minus half the difference of the radii.
template <class T> struct Pair {
  T radius_sum, half_difference; // r_a + r_b, (r_a - r_b)/2
  T root_mass; // 2 sqrt(m), m = m_a m_b/(m_a + m_b), or the grain's mass against a wall; less by mass_of_steps
};

// What a contact remembers: the tangential spring force, and for the incremental law the normal one (N). The former is
// marked (lanes.h) as long as the contact sticks.
template <class T> struct History { T es, en; };

// Force on the first disc, and the torques on both, about the disc centres.
template <class T> struct alignas(4 * sizeof(T)) Forces { T fx, fy, torque_a, torque_b; };

// The same, with b as the first disc.
template <class T> inline Forces<T> opposite(const Forces<T> &f) { return {-f.fx, -f.fy, f.torque_b, f.torque_a}; }

// Relative motion of the contact point of disc a against b, along n (from b to a) and t (n turned by +90 degrees):
// that of the centres, less that of the rims by the spin = omega_a l_a + omega_b l_b, l the lever arms.
template <class T> struct Approach { T n, t; };

// Displacement of a step over dt. It was made about the distance and the normal of the middle of the step, while `half`
// is taken about those of its end. The difference is of first order in dt; this removes it, and leaves exactly no slip
// where the two discs turn as one body. `across` is the part of half.t that is not spin.
template <class T>
inline Approach<T> of_step(const Approach<T> &half, T across, T omega_sum, T inverse_distance, double dt) {
  const T turning = across * inverse_distance;
  const T n = fused(T(-0.5 * dt) * across, turning, half.n);
  return {n, fused(T(0.25 * dt) * n, fused(T(2), turning, omega_sum), half.t)};
}

// How the forces of a pair count now, after the part of the step behind in which it was in contact.
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
[[gnu::always_inline]] inline Presence<T> presence(T overlap, T before, T root_mass, const Material &m, double dt) {
  const auto touch = overlap > T(0), changed = touch != (before > T(0));
  const Steady<T> lasting = steady(overlap);
  const T X = magnitude(overlap - before), f = select(touch, overlap, before) / select(changed, X, T(1));
  const T ratio = T(4 * m.dn * dt) / root_mass, b = select(ratio < T(1), ratio, T(1));
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
// Pair's value for the time steps that `of_steps` is of.
inline double root_mass(double m, double of_steps) { return 2 * std::sqrt(m) * m / (m + of_steps); }

// The tangential spring of a pair in this step and before it, what it would be without friction's limit, and that
// limit.
template <class T> struct Friction {
  T es, trial, limit;
  T es_before, limit_before;
};

// What the friction and the dashpots of a pair have taken out (J), if somebody keeps books. The time integration gives
// the bodies the mean of the forces at the two ends of each step times its displacement as work, and so do the books.
template <class T> struct Losses {
  T friction, dashpots;
  T dashpot_n, dashpot_t; // the dashpots' forces at the beginning of the step (N)
};
struct NoLosses {};

// In a step with these velocities, with what is beside that mean. The spring of a contact that slides is stretched to
// `trial`, and then gives way.
template <class T>
inline void book(Losses<T> &l, const Approach<T> &step, const Approach<T> &dashpot, const Friction<T> &f,
                 T beside_dashpots, T beside_friction, const Material &m, double dt) {
  const T n = l.dashpot_n + dashpot.n, t = l.dashpot_t + dashpot.t;
  l.dashpots = fused(T(-0.5 * dt), fused(n, step.n, t * step.t), l.dashpots + beside_dashpots);
  const double none = std::numeric_limits<double>::infinity(); // a division that depends on nothing leaves the loop
  const double half = 0.5 / (m.ks > 0 ? m.ks : none);
  l.friction = fused(T(half) * (f.es_before + f.es), f.trial - f.es, l.friction + beside_friction);
  l.dashpot_n = dashpot.n;
  l.dashpot_t = dashpot.t;
}
template <class T>
inline void book(NoLosses &, const Approach<T> &, const Approach<T> &, const Friction<T> &, T, T, const Material &,
                 double) {}

// Of the centres of two discs. Root and division take so long that a loop had better begin with those of the next
// pairs.
template <class T> struct Distance { T length, inverse; };

template <class T> [[gnu::always_inline]] inline Distance<T> distance_of(const Relative<T> &u) {
  const T length = square_root(fused(u.x, u.x, u.y * u.y));
  return {length, T(1) / length};
}

// Where two discs are to each other, and how their rims move.
template <class T> struct Meeting {
  T nx, ny, overlap, before; // before: the overlap one step ago
  T lever_a, lever_b;
  Approach<T> half, now, step;
};

template <class T>
[[gnu::always_inline]] inline Meeting<T> meeting(const Relative<T> &u, const Distance<T> &distance, const Pair<T> &pair,
                                                 double dt) {
  Meeting<T> c;
  c.overlap = pair.radius_sum - distance.length;
  c.nx = u.x * distance.inverse;
  c.ny = u.y * distance.inverse;
  c.lever_a = fused(T(0.5), distance.length, pair.half_difference);
  c.lever_b = distance.length - c.lever_a;
  const T across_half = fused_minus(u.vy_half, c.nx, u.vx_half * c.ny), across = fused_minus(u.vy, c.nx, u.vx * c.ny);
  c.half = {fused(u.vx_half, c.nx, u.vy_half * c.ny),
            across_half - fused(u.omega_half_a, c.lever_a, u.omega_half_b * c.lever_b)};
  c.now = {fused(u.vx, c.nx, u.vy * c.ny), across - fused(u.omega_a, c.lever_a, u.omega_b * c.lever_b)};
  c.step = of_step<T>(c.half, across_half, u.omega_half_a + u.omega_half_b, distance.inverse, dt);
  c.before = fused(c.step.n, T(dt), c.overlap);
  return c;
}

// The tangential spring of a contact that closed or opened in the step acted during f of it; the time integration gives
// it the mean of before and now for all of it. If the contact closed and sticks, or stuck until it opened and so let go
// of a stretched spring and of a dashpot, the difference is a force that is to be added now. If it slides, the spring
// is mu times the normal one, and so is its impulse: then nothing is missing but that work in the books.
template <class T> struct PartOfStep { T force, friction; }; // (N), (J)

template <class T>
[[gnu::always_inline]] inline PartOfStep<T> part_of_step(const Meeting<T> &c, const Presence<T> &share,
                                                         const Pair<T> &pair, const Friction<T> &f, const Material &m,
                                                         double dt) {
  constexpr double FAR = 0.5; // from sliding, which sets in before the contact opens
  const auto touch = c.overlap > T(0), touched = c.before > T(0);
  const auto closes = touch && !touched, opens = touched && !touch;
  const auto closes_sticking = closes && magnitude(f.trial) < f.limit;
  const auto opens_sticking = opens && magnitude(f.es_before) < T(FAR) * f.limit_before;
  const T spring = T(0.5) * fused(share.spring, f.es_before + f.trial, -(f.es_before + f.es));
  const T dashpot = T(-m.ds) * (pair.root_mass * share.dashpot_t) * c.now.t;
  const T work = T(-0.5 * dt) * (T(1) - share.spring) * (f.es_before + f.es) * c.step.t;
  const auto sticks = closes_sticking || opens_sticking;
  return {select(closes_sticking, spring, select(opens_sticking, spring + dashpot, T(0))),
          select((closes || opens) && !sticks, work, T(0))};
}
template <class T>
inline PartOfStep<T> part_of_step(const Meeting<T> &, const Steady<T> &, const Pair<T> &, const Friction<T> &,
                                  const Material &, double) {
  return {T(0), T(0)};
}

// Of pairs some of which began or ceased to slide in the step: what their tangential dashpot counts beside its weight,
// by the rule of Presence, as it acts while the contact sticks. One that sticks until a fraction f of the step got 1/2
// when it was last seen, one that sticks from then on gets 1 now instead of 1 - f + 1/2. A spring reaches its limit as
// if both changed uniformly. A contact slides as long as the spring, but for the limit, gains on it, at a rate that is
// known for the middle of the step and for its end.
template <class T, class Mask>
[[gnu::always_inline]] inline T weight_of_switch(const Meeting<T> &c, const Friction<T> &f, Mask stuck, Mask sticks,
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

// The forces of pairs that are present so.
template <Law law, bool limit_damping, class T, class Share, class Books>
[[gnu::always_inline]] inline Forces<T> forces_of(const Meeting<T> &c, const Share &share, const Pair<T> &pair,
                                                  const Material &m, double dt, History<T> &history, Books &books) {
  const auto touch = c.overlap > T(0);
  const T en_before = law == Law::direct ? T(m.kn) * c.before : history.en;
  T en = select(touch, T(m.kn) * c.overlap, T(0));
  if constexpr (law == Law::incremental) {
    // A contact that closed in this step, or is met without a history, starts with the overlap it has.
    const auto known = (share.spring == T(1)) && (history.en != T(0));
    en = select(touch && known, fused(T(-m.kn * dt), c.half.n, history.en), en);
    history.en = en;
  }

  // Apart, the limit is 0, which clears the history. Without time a contact at the limit stays there: neither is
  // marked.
  const T limit = unmarked(T(m.mu) * (law == Law::direct ? en : select(en > T(0), en, T(0))));
  const T es_before = history.es, trial = unmarked(fused(T(-m.ks * dt) * c.step.t, share.spring, es_before));
  const auto stuck = is_marked(history.es), sticks = magnitude(trial) < limit;
  const T es = select(sticks, trial, with_sign_of(limit, trial));
  history.es = select(sticks, marked(es), es);
  T weight_t = select(sticks, share.dashpot_t, T(0));
  const Friction<T> friction{es, trial, limit, es_before, T(m.mu) * en_before};
  if (any(sticks != stuck))
    weight_t += weight_of_switch(c, friction, stuck, sticks, m, dt);

  T fn = fused(T(-m.dn) * (pair.root_mass * share.dashpot_n), c.now.n, en);
  if constexpr (limit_damping)
    fn = select(touch && fn > T(0), fn, T(0));
  T ft = fused(T(-m.ds) * (pair.root_mass * weight_t), c.now.t, es);

  // Dashpots that may not pull end before the discs part, and smoothly.
  const T impulse = limit_damping ? select(touch, share.impulse, T(0)) : share.impulse;
  const T loss = limit_damping ? select(touch, share.loss, T(0)) : share.loss;
  const PartOfStep<T> part = part_of_step(c, share, pair, friction, m, dt);
  book(books, c.step, {fn - en, ft - es}, friction, loss, part.friction, m, dt);
  fn += impulse;
  ft += part.force;
  const T back = -ft;
  return {fused(fn, c.nx, back * c.ny), fused(fn, c.ny, ft * c.nx), back * c.lever_a, back * c.lever_b};
}

// The force of a pair, and its history brought forward by the displacement of a step of length dt. With dt = 0 it is
// the force of the present state, and the history stays as it is.
template <Law law, bool limit_damping, class T, class Books>
[[gnu::always_inline]] inline Forces<T> contact_force(const Relative<T> &u, const Distance<T> &distance,
                                                      const Pair<T> &pair, const Material &m, double dt,
                                                      History<T> &history, Books &books) {
  const Meeting<T> c = meeting(u, distance, pair, dt);
  if (any((c.overlap > T(0)) != (c.before > T(0))))
    return forces_of<law, limit_damping>(c, presence(c.overlap, c.before, pair.root_mass, m, dt), pair, m, dt, history,
                                         books);
  return forces_of<law, limit_damping>(c, steady(c.overlap), pair, m, dt, history, books);
}

} // namespace cdem
