// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable time step of a packing (Otsubo, O'Sullivan, Shire 2017: it depends on the contacts of a grain, not
// on the duration of one contact).
//
// The worst packing of equal discs is the triangular lattice: by Bloch's theorem its stiffest modes have the eigenvalue
//   lambda = max(6 k_n + 3 k_s, 24 k_s) of K relative to m  (the second: all discs turning the same way).
// The step scheme takes the dashpots at the half step, which is stable while the eigenvalues of dt^2 K + 2 dt C stay
// below 4 m. With K and C of the same form this is a quadratic in dt.
#pragma once

#include "contact_law.h"

#include <algorithm>
#include <cmath>

namespace cdem {

// Positive root of stiffness dt^2 + 2 damping dt = 4 m.
inline double largest_step(double stiffness, double damping, double m)
{
  return stiffness > 0 ? (std::sqrt(damping * damping + 4 * m * stiffness) - damping) / stiffness : INFINITY;
}

// Limit for discs of mass m (kg) that have contacts of this material all around, s. `turning` is r^2 m / I, 2 for a disc.
inline double step_limit(const Material &material, double m, double turning = 2)
{
  const double root_mass = 2 * std::sqrt(m / 2);
  const double cn = material.dn() * root_mass, cs = material.ds() * root_mass;
  const double moving = largest_step(6 * material.kn + 3 * material.ks, 6 * cn + 3 * cs, m);
  const double spinning = largest_step(12 * turning * material.ks, 12 * turning * cs, m);
  return std::min(moving, spinning);
}

}    // namespace cdem
