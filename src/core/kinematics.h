// SPDX-License-Identifier: GPL-2.0-or-later
// The relative position of two discs and the relative motion of their rims, which every contact law begins with.
#pragma once

#include "lanes.h"

namespace cdem {

// The row of a disc: all that the law needs of it (m, m/s, rad/s). The springs follow the displacement of the step, so
// they take the velocity of the half step, with which the positions moved. The dashpots take the velocity at the time
// of the force.
template <class T> struct alignas(8 * sizeof(T)) Disc {
  T x, y;
  T vx_half, vy_half;
  T vx, vy;
  T omega_half, omega;
};

// Position and velocity of disc a relative to disc b, and the angular velocities of both.
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

// Constants of one pair of discs. The lever arms to the contact point are r - overlap/2, that is half the distance plus
// (disc a) or minus (disc b) half the difference of the radii.
// dashpot_scale: 2 sqrt(m) m/(m + mass_of_steps()), where m = m_a m_b/(m_a + m_b), or the mass of the grain against a
// wall.
template <class T> struct PairConstants {
  T radius_sum, half_difference; // r_a + r_b, (r_a - r_b)/2
  T dashpot_scale;               // sqrt(kg)
};

// Velocity of disc a relative to disc b at the contact point (m/s), along n (from b to a) and t (n turned by +90
// degrees): that of the centres, and along t less omega_a l_a + omega_b l_b, where l are the lever arms.
template <class T> struct Approach { T n, t; };

// Relative displacement in a step, over dt. It took place with the distance and the normal of the middle of the step,
// while `half` is taken with those of its end. The difference is of first order in dt; this removes it, so that two
// discs which turn as one body slip by an error of second order only. `across` is the part of half.t without the spins.
template <class T>
inline Approach<T> of_step(const Approach<T> &half, T across, T omega_sum, T inverse_distance, double dt) {
  const T turning = across * inverse_distance;
  const T n = fused(T(-0.5 * dt) * across, turning, half.n);
  return {n, fused(T(0.25 * dt) * n, fused(T(2), turning, omega_sum), half.t)};
}

// Distance of the centres of two discs, and its inverse. The square root and the division take so long that a loop
// should start those of the next pairs early.
template <class T> struct Distance { T length, inverse; };

template <class T> [[gnu::always_inline]] inline Distance<T> distance_of(const Relative<T> &u) {
  const T length = square_root(fused(u.x, u.x, u.y * u.y));
  return {length, T(1) / length};
}

// Relative position of two discs and relative motion of their rims.
template <class T> struct Contact {
  T nx, ny, overlap, before; // before: the overlap one step ago
  T lever_a, lever_b;        // from the centres to the contact point
  Approach<T> half, now, step;
  T turning_half, turning; // of disc a against disc b (rad/s): of the half step, and at the time of the force
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

// Force on the first disc (N), and the torques on both about their centres (N m).
template <class T> struct alignas(4 * sizeof(T)) Forces { T fx, fy, torque_a, torque_b; };

// The same pair, with b as the first disc.
template <class T> inline Forces<T> opposite(const Forces<T> &f) { return {-f.fx, -f.fy, f.torque_b, f.torque_a}; }

} // namespace cdem
