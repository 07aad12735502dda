// SPDX-License-Identifier: GPL-2.0-or-later
// Energy that friction and dashpots take out of the motion, for the energy audit (compute cdem/energy).
#pragma once

#include "step_events.h"

#include <array>
#include <limits>

namespace cdem {

// Energy that friction and dashpots of a pair have taken out (J), kept only for an energy audit. Work is the mean of
// the forces at the two ends of a step times its displacement, as in the time integration.
template <class T, std::size_t n = 0> struct Losses {
  T friction, dashpots;
  T dashpot_n, dashpot_t;     // the dashpots' forces at the beginning of the step (N)
  std::array<T, n> more = {}; // forces or torques of the additions' dashpots, at the same time (N or N m)
};
struct NoLosses {};

// Books one step with these velocities; `beside_*` are losses (J) that the mean of the two ends does not cover. The
// spring of a sliding contact is stretched to `trial` and then relaxes to its limit: the difference is friction.
template <class T, std::size_t n>
[[gnu::always_inline]] inline void book(Losses<T, n> &l, const Approach<T> &step, const Approach<T> &dashpot,
                                        const Friction<T> &f, T beside_dashpots, T beside_friction, const Material &m,
                                        double dt) {
  const T fn = l.dashpot_n + dashpot.n, ft = l.dashpot_t + dashpot.t;
  l.dashpots = fused(T(-0.5 * dt), fused(fn, step.n, ft * step.t), l.dashpots + beside_dashpots);
  const double none = std::numeric_limits<double>::infinity(); // does not depend on T: the division leaves the loop
  const double half = 0.5 / (m.ks > 0 ? m.ks : none);
  l.friction = fused(T(half) * (f.es_before + f.es), f.trial - f.es, l.friction + beside_friction);
  l.dashpot_n = dashpot.n;
  l.dashpot_t = dashpot.t;
}
template <class T>
inline void book(NoLosses &, const Approach<T> &, const Approach<T> &, const Friction<T> &, T, T, const Material &,
                 double) {}

// Spring and dashpot of an addition to the law, the k-th with a dashpot: forces or torques, which act at `velocity`.
// The spring is stretched to `trial` and relaxes to `now`.
template <class T> struct Added { T before, trial, now, stiffness, dashpot; };

template <class T, std::size_t n>
[[gnu::always_inline]] inline void book_added(Losses<T, n> &l, std::size_t k, const Added<T> &a, T velocity,
                                              double dt) {
  const T give = select(a.stiffness > T(0), T(0.5) / select(a.stiffness > T(0), a.stiffness, T(1)), T(0));
  l.friction = fused(give * (a.before + a.now), a.trial - a.now, l.friction);
  l.dashpots = fused(T(-0.5 * dt) * (l.more[k] + a.dashpot), velocity, l.dashpots);
  l.more[k] = a.dashpot;
}
template <class T> inline void book_added(NoLosses &, std::size_t, const Added<T> &, T, double) {}

} // namespace cdem
