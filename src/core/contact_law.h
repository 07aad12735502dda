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

// Disc a relative to disc b: the difference of all, and the sums of the spins.
template <class T> struct Relative {
  Disc<T> difference;
  T omega_half_sum, omega_sum;
};

inline Relative<double> relative(const Disc<double> &a, const Disc<double> &b) {
  return {{a.x - b.x, a.y - b.y, a.vx_half - b.vx_half, a.vy_half - b.vy_half, a.vx - b.vx, a.vy - b.vy,
           a.omega_half - b.omega_half, a.omega - b.omega},
          a.omega_half + b.omega_half,
          a.omega + b.omega};
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

// Constants of one pair of discs. The lever arm to the contact point is r_a - overlap/2 = (distance + r_a - r_b)/2.
template <class T> struct Pair {
  T radius_sum, radius_difference;
  T root_mass; // 2 sqrt(m), m = m_a m_b/(m_a + m_b), or the grain's mass against a wall
};

// What a contact remembers: the tangential spring force, and for the incremental law the normal one (N).
template <class T> struct History { T es, en; };

// Force on the first disc, and the torques on both, about the disc centres.
template <class T> struct alignas(4 * sizeof(T)) Forces { T fx, fy, torque_a, torque_b; };

// Relative motion of the contact point of disc a against b, along n (from b to a) and t (n turned by +90 degrees).
template <class T> struct Approach { T n, t; };

// The discs' rims move with omega_a l_a + omega_b l_b against each other, l = (distance +- difference of radii)/2.
template <class T>
inline Approach<T> approach(T ux, T uy, T omega_sum, T omega_difference, T nx, T ny, T distance, T difference) {
  const T spin = T(0.5) * (omega_sum * distance + omega_difference * difference);
  return {ux * nx + uy * ny, uy * nx - ux * ny - spin};
}

// The slip of a step over dt, for the spring. It was made about the distance and the normal of the middle of the step,
// while `half` is taken about those of its end. The difference is of first order in dt; this removes it, and leaves
// exactly 0 where the two discs turn as one body.
template <class T>
inline T slip_velocity(const Disc<T> &u, T omega_sum, const Approach<T> &half, T nx, T ny, T inverse, T half_dt) {
  const T across = u.vy_half * nx - u.vx_half * ny;
  const T turning = across * inverse;
  return half.t + half_dt * (half.n - half_dt * across * turning) * (turning + T(0.5) * omega_sum);
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
  const T before = overlap + un_half * T(dt); // overlap one step ago
  const auto touch = overlap > T(0), touched = before > T(0);
  const auto changed = touch != touched;
  const T plain = select(touch, T(1), T(0));
  if (!any(changed))
    return {T(1), plain};
  const T in_contact = select(touch, overlap, before) / select(changed, magnitude(overlap - before), T(1));
  return {select(changed, in_contact, T(1)), select(changed, in_contact + select(touch, T(0.5), T(-0.5)), plain)};
}

// The force of a pair, and its history brought forward by the displacement of a step of length dt. With dt = 0 it is
// the force of the present state, and the history stays as it is.
template <Law law, bool limit_damping, class T>
[[gnu::always_inline]] inline Forces<T> contact_force(const Relative<T> &of_a, const Pair<T> &pair, const Material &m,
                                                      double dt, History<T> &history) {
  const Disc<T> &u = of_a.difference;
  const T distance = square_root(u.x * u.x + u.y * u.y), inverse = T(1) / distance;
  const T overlap = pair.radius_sum - distance;
  const auto touch = overlap > T(0);
  const T nx = u.x * inverse, ny = u.y * inverse;

  const Approach<T> half =
      approach<T>(u.vx_half, u.vy_half, of_a.omega_half_sum, u.omega_half, nx, ny, distance, pair.radius_difference);
  const Approach<T> now = approach<T>(u.vx, u.vy, of_a.omega_sum, u.omega, nx, ny, distance, pair.radius_difference);
  const Presence<T> share = presence<T>(overlap, half.n, dt);

  T en = select(touch, T(m.kn) * overlap, T(0));
  if constexpr (law == Law::incremental) {
    // A contact that closed in this step, or is met without a history, starts with the overlap it has.
    const auto known = (share.spring == T(1)) && (history.en != T(0));
    en = select(touch && known, history.en - T(m.kn * dt) * half.n, en);
    history.en = en;
  }

  // Apart, the limit is 0, which clears the history.
  const T limit = law == Law::direct ? T(m.mu) * en : T(m.mu) * select(en > T(0), en, T(0));
  const T slip = slip_velocity<T>(u, of_a.omega_half_sum, half, nx, ny, inverse, T(0.5 * dt));
  const T trial = history.es - T(m.ks * dt) * slip * share.spring;
  const auto slides = magnitude(trial) >= limit;
  const T es = select(slides, with_sign_of(limit, trial), trial);
  history.es = es;

  const T dashpot = pair.root_mass * share.dashpot;
  T fn = en - T(m.dn) * dashpot * now.n;
  if constexpr (limit_damping)
    fn = select(touch && fn > T(0), fn, T(0));
  const T ft = select(slides, es, es - T(m.ds) * dashpot * now.t);
  return {fn * nx - ft * ny, fn * ny + ft * nx, T(-0.5) * ft * (distance + pair.radius_difference),
          T(-0.5) * ft * (distance - pair.radius_difference)};
}

} // namespace cdem
