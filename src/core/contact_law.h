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
  T root_mass; // 2 sqrt(m), m = m_a m_b/(m_a + m_b), or the grain's mass against a wall; times dashpot_in_steps
};

// What a contact remembers: the tangential spring force, and for the incremental law the normal one (N).
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

// The part of the step behind that a pair was in contact, as it enters the forces now.
//
// The trapezoidal rule of the time integration gives half of either neighbouring step to a force. A contact that closed
// a fraction f of the step ago acted during f, not 1/2, of it: its dashpot counts f + 1/2 now. One that opened after a
// fraction f of the step got 1/2 of it when it was last seen: the dashpot's share of f - 1/2 is made good now. Without
// this a dashpot switches on and off at the borders of steps, and the scheme is of first order in time.
template <class T> struct Presence {
  T spring;  // share of this step's displacement that was made in contact
  T dashpot; // weight of the dashpot
};

template <class T> inline Presence<T> presence(T overlap, T un_half, double dt) {
  const T before = fused(un_half, T(dt), overlap); // overlap one step ago
  const auto touch = overlap > T(0), touched = before > T(0);
  const auto changed = touch != touched;
  const T plain = select(touch, T(1), T(0));
  if (!any(changed))
    return {T(1), plain};
  const T in_contact = select(touch, overlap, before) / select(changed, magnitude(overlap - before), T(1));
  return {select(changed, in_contact, T(1)), select(changed, in_contact + select(touch, T(0.5), T(-0.5)), plain)};
}

// The dashpots of a pair that are to be used with steps of dt, over 2 h sqrt(m k): with them an oscillation decays per
// period as it does without steps.
//
// The dashpots' velocity comes from the two half steps behind, x' - dt^2/3 x''', and the scheme's acceleration is
// x'' + dt^2/12 x''''. For x' = lambda x the equation of motion gives lambda^3 and lambda^4 in terms of lambda, and so
// the damping ratio of the scheme, h (1 + (11 - 20 h^2)/24 k dt^2/m), which this takes away. w is the share by which
// the velocity is carried forward (stability.h); as it goes to 0 so does the correction.
inline double dashpot_in_steps(double h, double kdt2_over_m, double w) {
  return 1 / (1 + w * std::max(0.0, (11 - 20 * h * h) / 24) * kdt2_over_m);
}

// What the friction and the dashpots of a pair have taken out (J), if somebody keeps books. The time integration gives
// the bodies the mean of the forces at the two ends of each step times its displacement as work, and so do the books.
template <class T> struct Losses {
  T friction, dashpots;
  T dashpot_n, dashpot_t; // the dashpots' forces at the beginning of the step (N)
};
struct NoLosses {};

// In a step with these velocities. The spring of a contact that slides is stretched to `trial`, and then gives way.
template <class T>
inline void book(Losses<T> &l, const Approach<T> &step, const Approach<T> &dashpot, T es_before, T trial, T es,
                 const Material &m, double dt) {
  const T n = l.dashpot_n + dashpot.n, t = l.dashpot_t + dashpot.t;
  l.dashpots = fused(T(-0.5 * dt), fused(n, step.n, t * step.t), l.dashpots);
  const double none = std::numeric_limits<double>::infinity(); // a division that depends on nothing leaves the loop
  l.friction = fused(T(0.5 / (m.ks > 0 ? m.ks : none)) * (es_before + es), trial - es, l.friction);
  l.dashpot_n = dashpot.n;
  l.dashpot_t = dashpot.t;
}
template <class T>
inline void book(NoLosses &, const Approach<T> &, const Approach<T> &, T, T, T, const Material &, double) {}

// Of the centres of two discs. Root and division take so long that a loop had better begin with those of the next
// pairs.
template <class T> struct Distance { T length, inverse; };

template <class T> [[gnu::always_inline]] inline Distance<T> distance_of(const Relative<T> &u) {
  const T length = square_root(fused(u.x, u.x, u.y * u.y));
  return {length, T(1) / length};
}

// The force of a pair, and its history brought forward by the displacement of a step of length dt. With dt = 0 it is
// the force of the present state, and the history stays as it is.
template <Law law, bool limit_damping, class T, class Books>
[[gnu::always_inline]] inline Forces<T> contact_force(const Relative<T> &u, const Distance<T> &of_centres,
                                                      const Pair<T> &pair, const Material &m, double dt,
                                                      History<T> &history, Books &books) {
  const auto &[distance, inverse] = of_centres;
  const T overlap = pair.radius_sum - distance;
  const auto touch = overlap > T(0);
  const T nx = u.x * inverse, ny = u.y * inverse;
  const T lever_a = fused(T(0.5), distance, pair.half_difference), lever_b = distance - lever_a;

  const T across_half = fused_minus(u.vy_half, nx, u.vx_half * ny), across = fused_minus(u.vy, nx, u.vx * ny);
  const Approach<T> half{fused(u.vx_half, nx, u.vy_half * ny),
                         across_half - fused(u.omega_half_a, lever_a, u.omega_half_b * lever_b)};
  const Approach<T> now{fused(u.vx, nx, u.vy * ny), across - fused(u.omega_a, lever_a, u.omega_b * lever_b)};
  const Presence<T> share = presence<T>(overlap, half.n, dt);

  T en = select(touch, T(m.kn) * overlap, T(0));
  if constexpr (law == Law::incremental) {
    // A contact that closed in this step, or is met without a history, starts with the overlap it has.
    const auto known = (share.spring == T(1)) && (history.en != T(0));
    en = select(touch && known, fused(T(-m.kn * dt), half.n, history.en), en);
    history.en = en;
  }

  // Apart, the limit is 0, which clears the history.
  const T limit = law == Law::direct ? T(m.mu) * en : T(m.mu) * select(en > T(0), en, T(0));
  const Approach<T> step = of_step<T>(half, across_half, u.omega_half_a + u.omega_half_b, inverse, dt);
  const T es_before = history.es, trial = fused(T(-m.ks * dt) * step.t, share.spring, es_before);
  const auto slides = magnitude(trial) >= limit;
  const T es = select(slides, with_sign_of(limit, trial), trial);
  history.es = es;

  const T dashpot = pair.root_mass * share.dashpot;
  T fn = fused(T(-m.dn) * dashpot, now.n, en);
  if constexpr (limit_damping)
    fn = select(touch && fn > T(0), fn, T(0));
  const T ft = select(slides, es, fused(T(-m.ds) * dashpot, now.t, es)), back = -ft;
  book(books, step, {fn - en, ft - es}, es_before, trial, es, m, dt);
  return {fused(fn, nx, back * ny), fused(fn, ny, ft * nx), back * lever_a, back * lever_b};
}

} // namespace cdem
