// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable time step of a packing (Otsubo, O'Sullivan, Shire 2017: it depends on the contacts of a grain, not
// on the duration of one contact).
//
// The worst packing is the one where a grain has as many neighbours of its own kind as fit around it, N, and its
// stiffest modes are those in which neighbours move against each other, or all turn the same way, so that every contact
// sees twice the displacement of one grain. With S = |sum of exp(2 i phi)| over the directions of the neighbours, and
// the lever arms l of the contacts, the largest eigenvalues of K are then at most
//
//   N (k_n + k_s) + S |k_n - k_s|        moving, relative to m
//   2 (k_n sum l_n^2 + k_s sum l_t^2)    turning, relative to I
//
// Six neighbours of a disc can't all be in antiphase: by Bloch's theorem the triangular lattice has at most 6 k_n + 3
// k_s.
//
// The step scheme takes the dashpots at the half step, carried forward by a share w of half a step. A mode with
// stiffness k, damping c and mass m is stable while k dt^2 + 2 (1 + w) c dt < 4 m.
#pragma once

#include "contact_law.h"
#include "grain_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cdem {

struct Mode {
  double stiffness, damping, mass;

  // Largest stable step with w = 0.
  double step_limit() const {
    if (stiffness == 0)
      return INFINITY;
    return (std::sqrt(damping * damping + 4 * mass * stiffness) - damping) / stiffness;
  }

  // Largest stable w, at most 1: then the scheme is of second order.
  double prediction_weight(double dt) const {
    constexpr double MARGIN = 0.95;
    const double left = 4 * mass - (stiffness * dt + 2 * damping) * dt, used = 2 * damping * dt;
    return left >= used ? 1 : std::max(0.0, MARGIN * left / used);
  }
};

// Of grains of mass m (kg) that have contacts of this material with their like all around.
inline std::array<Mode, 2> stiffest_modes(const Material &material, const GrainShape &shape, double m) {
  const double root_mass = 2 * std::sqrt(m / 2);
  auto moving = [&](double normal, double tangential) {
    if (shape.discs().size() == 1)
      return 6 * normal + 3 * tangential;
    return shape.neighbours() * (normal + tangential) + shape.unevenness() * std::fabs(normal - tangential);
  };
  auto turning = [&](double normal, double tangential) {
    return 2 * (normal * shape.normal_levers() + tangential * shape.tangential_levers());
  };
  auto mode = [&](auto sum, double mass) {
    return Mode{sum(material.kn, material.ks), root_mass * sum(material.dn, material.ds), mass};
  };
  return {mode(moving, m), mode(turning, m * shape.inertia())};
}

inline double step_limit(const Material &material, const GrainShape &shape, double m) {
  const auto [moving, turning] = stiffest_modes(material, shape, m);
  return std::min(moving.step_limit(), turning.step_limit());
}

inline double prediction_weight(const Material &material, const GrainShape &shape, double m, double dt) {
  const auto [moving, turning] = stiffest_modes(material, shape, m);
  return std::min(moving.prediction_weight(dt), turning.prediction_weight(dt));
}

} // namespace cdem
