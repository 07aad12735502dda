// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable time step of a packing (Otsubo, O'Sullivan, Shire 2017: it depends on the contacts of a grain, not
// on the duration of one contact).
//
// The worst packing is the one where a grain has as many neighbours of its own kind as fit around it, N, and its
// stiffest modes are those in which neighbours move against each other, or all turn the same way, so that every contact
// sees twice the displacement of one grain. The largest eigenvalues of K are then
//   N (k_n + k_s) + |S| |k_n - k_s|        moving,  relative to m, S = sum of exp(2 i phi) over the neighbours'
//   directions 2 (k_n sum l_n^2 + k_s sum l_t^2)      turning, relative to I, with the lever arms l of the contacts
// For discs in the triangular lattice, S = 0, this gives 6 (k_n + k_s) and 24 k_s; by Bloch's theorem the true values
// there are at most 6 k_n + 3 k_s and 24 k_s.
//
// The step scheme takes the dashpots at the half step, which is stable while the eigenvalues of dt^2 K + 2 dt C stay
// below 4 m. With K and C of the same form this is a quadratic in dt.
#pragma once

#include "contact_law.h"
#include "grain_shape.h"

#include <algorithm>
#include <cmath>

namespace cdem {

// Positive root of stiffness dt^2 + 2 damping dt = 4 m.
inline double largest_step(double stiffness, double damping, double m) {
  return stiffness > 0 ? (std::sqrt(damping * damping + 4 * m * stiffness) - damping) / stiffness : INFINITY;
}

// Limit (s) for grains of mass m (kg) that have contacts of this material with their like all around.
inline double step_limit(const Material &material, const GrainShape &shape, double m) {
  const double root_mass = 2 * std::sqrt(m / 2);
  const double cn = material.dn * root_mass, cs = material.ds * root_mass;
  const double n = shape.neighbours(), s = shape.unevenness();
  const double ln = 2 * shape.normal_levers(), lt = 2 * shape.tangential_levers();
  const double moving = largest_step(n * (material.kn + material.ks) + s * std::fabs(material.kn - material.ks),
                                     n * (cn + cs) + s * std::fabs(cn - cs), m);
  const double turning = largest_step(ln * material.kn + lt * material.ks, ln * cn + lt * cs, m * shape.inertia());
  return std::min(moving, turning);
}

} // namespace cdem
