// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable time step of a packing (Otsubo, O'Sullivan, Shire 2017: it depends on the contacts of a grain, not
// on the duration of one contact).
//
// The worst packing is the one in which a grain has N neighbours of its own kind, as many as fit around it. Its
// stiffest modes are those in which neighbours move against each other, or all turn the same way, so that every contact
// sees twice the displacement of one grain. With S = |sum of exp(2 i phi)| over the directions phi of the neighbours,
// and the lever arms l of the contacts, the largest eigenvalues of K are then at most
//
//   N (k_n + k_s) + S |k_n - k_s|        moving, relative to m
//   2 (k_n sum l_n^2 + k_s sum l_t^2)    turning, relative to I
//
// Six neighbours of a disc cannot all be in antiphase: by Bloch's theorem the triangular lattice has at most
// 6 k_n + 3 k_s. That holds with the inertia of a disc or less; with more, modes that turn and move at once can be
// faster.
//
// The dashpots take the velocity of the half step, carried forward by a share w of half a step. A mode with stiffness
// k, damping c and mass m is stable while k dt^2 + 2 (1 + w) c dt < 4 m. Local damping raises the force that resists a
// motion by a share A of it, which is as if the mass were m/(1 + A).
#pragma once

#include "declaration.h"
#include "grain_shape.h"
#include "material.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cdem {

// A mode of motion (N/m, N s/m, kg) or of rotation (N m, N m s, kg m^2).
struct Mode {
  double stiffness, damping, mass;

  // Largest stable step without prediction (w = 0); infinite if nothing resists.
  double step_limit() const {
    const double root = std::sqrt(damping * damping + 4 * mass * stiffness);
    const bool overdamped = damping * damping >= 4 * mass * stiffness; // there the difference below would lose digits
    return overdamped ? 4 * mass / (root + damping) : (root - damping) / stiffness;
  }

  // Largest stable w, at most 1. With w = 1 the scheme is of second order.
  double prediction_weight(double dt) const {
    constexpr double MARGIN = 0.95;
    const double left = 4 * mass - (stiffness * dt + 2 * damping) * dt, used = 2 * damping * dt;
    return left >= used ? 1 : std::max(0.0, MARGIN * left / used);
  }
};

// A grain surrounded by equal grains, with all contacts of one material. `inertia` is over m r^2, r the circumscribed
// radius.
struct AmongItsLike {
  const GrainShape &shape;
  double mass, radius, inertia;
  Material material;
  Resistance added;   // by the law's additions, for one contact
  double damping = 0; // local damping
};

// Three modes: grains move against each other; all turn the same way; neighbours turn in opposite directions, which
// only the law's additions resist. At one contact two discs cannot do both of the latter; but of six neighbours not all
// can turn the other way, so some tangential springs are stretched too: by Bloch's theorem a quarter of them is enough.
// For other grains, and for discs with more inertia, both are added up.
inline std::array<Mode, 3> stiffest_modes(const AmongItsLike &grain) {
  const GrainShape &shape = grain.shape;
  const Material &m = grain.material;
  const double dashpot_scale = 2 * std::sqrt(grain.mass / 2);
  const bool is_disc = shape.discs().size() == 1 && grain.inertia <= shape.inertia();
  auto moving = [&](double normal, double tangential) {
    if (is_disc)
      return 6 * normal + 3 * tangential;
    return shape.neighbours() * (normal + tangential) + shape.unevenness() * std::fabs(normal - tangential);
  };
  auto turning = [&](double normal, double tangential) {
    return 2 * (normal * shape.normal_levers() + tangential * shape.tangential_levers());
  };
  auto mode = [&](auto sum, double mass) {
    return Mode{sum(m.kn + grain.added.normal.stiffness, m.ks + grain.added.tangent.stiffness),
                dashpot_scale * sum(m.dn, m.ds) + sum(grain.added.normal.dashpot, grain.added.tangent.dashpot), mass};
  };
  const double mass = grain.mass / (1 + grain.damping);
  const Mode sideways = mode(moving, mass), turns = mode(turning, mass * grain.inertia);
  const double per_contact = 2 * shape.neighbours() / (grain.radius * grain.radius);
  const double share = is_disc ? 0.25 : 1;
  const Resistance::Part &against = grain.added.turning;
  const Mode rolls{share * turns.stiffness + per_contact * against.stiffness,
                   share * turns.damping + per_contact * against.dashpot, turns.mass};
  return {sideways, turns, rolls};
}

inline double step_limit(const AmongItsLike &grain) {
  double least = INFINITY;
  for (const Mode &mode : stiffest_modes(grain))
    least = std::min(least, mode.step_limit());
  return least;
}

inline double prediction_weight(const AmongItsLike &grain, double dt) {
  double least = 1;
  for (const Mode &mode : stiffest_modes(grain))
    least = std::min(least, mode.prediction_weight(dt));
  return least;
}

} // namespace cdem
