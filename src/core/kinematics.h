// SPDX-License-Identifier: GPL-2.0-or-later
// Where two discs are to each other and how their rims move: what every contact law begins with.
#pragma once

#include "lanes.h"

namespace cdem {

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

// Constants of one pair of discs. The lever arms to the contact point are r - overlap/2: of disc a, half the distance
// plus, and of disc b, half the distance minus half the difference of the radii.
template <class T> struct PairConstants {
  T radius_sum, half_difference; // r_a + r_b, (r_a - r_b)/2
  T dashpot_scale; // 2 sqrt(m), m = m_a m_b/(m_a + m_b), or the grain's mass against a wall; less by mass_of_steps
};

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

// Of the centres of two discs. Root and division take so long that a loop had better begin with those of the next
// pairs.
template <class T> struct Distance { T length, inverse; };

template <class T> [[gnu::always_inline]] inline Distance<T> distance_of(const Relative<T> &u) {
  const T length = square_root(fused(u.x, u.x, u.y * u.y));
  return {length, T(1) / length};
}

// Where two discs are to each other, and how their rims move.
template <class T> struct Contact {
  T nx, ny, overlap, before; // before: the overlap one step ago
  T lever_a, lever_b;
  Approach<T> half, now, step;
  T turning_half, turning; // of disc a against disc b, rad/s: in the step, and at the time of the force
};

template <class T>
[[gnu::always_inline]] inline Contact<T> contact_of(const Relative<T> &u, const Distance<T> &distance,
                                                    const PairConstants<T> &pair, double dt) {
  Contact<T> c;
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
  c.turning_half = u.omega_half_a - u.omega_half_b;
  c.turning = u.omega_a - u.omega_b;
  return c;
}

// Force on the first disc, and the torques on both, about the disc centres.
template <class T> struct alignas(4 * sizeof(T)) Forces { T fx, fy, torque_a, torque_b; };

// The same, with b as the first disc.
template <class T> inline Forces<T> opposite(const Forces<T> &f) { return {-f.fx, -f.fy, f.torque_b, f.torque_a}; }

} // namespace cdem
