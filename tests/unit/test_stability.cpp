// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stability.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <vector>

using namespace cdem;

namespace {

// Growth per step of a mode with alpha = k dt^2/m and beta = c dt/m, whose dashpot takes the velocity of the half step,
// carried forward by w dt/2: the largest absolute value of a root of
//
//   z (z-1)^2 + alpha z^2 + beta z (z-1) + beta w/2 (z-1)^2.
//
// This follows from x'' = -(k x + c v)/m in the scheme of fix cdem/integrate, with x, v and the last acceleration as
// the state. The roots are found by the method of Durand and Kerner.
double growth(double alpha, double beta, double w) {
  using Complex = std::complex<double>;
  const double g = beta * w / 2, c2 = alpha + beta + g - 2, c1 = 1 - beta - 2 * g, c0 = g;
  std::array<Complex, 3> z{1.0, Complex(0.4, 0.9), Complex(-0.65, 0.72)};
  for (int k = 0; k < 80; ++k)
    for (int i = 0; i < 3; ++i) {
      const Complex p = ((z[i] + c2) * z[i] + c1) * z[i] + c0;
      z[i] -= p / ((z[i] - z[(i + 1) % 3]) * (z[i] - z[(i + 2) % 3]));
    }
  return std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])});
}

std::vector<Mode> modes() {
  std::vector<Mode> all;
  for (double damping : {0.0, 1e-3, 0.05, 0.2, 0.5, 1.0, 3.0, 20.0})
    all.push_back({7.0, damping * std::sqrt(7.0 * 0.3), 0.3});
  return all;
}

TEST(Mode, UndampedLimitIsTwoOverTheFrequency) {
  EXPECT_DOUBLE_EQ((Mode{9, 0, 4}.step_limit()), 2 / std::sqrt(9.0 / 4.0));
  EXPECT_EQ((Mode{0, 0, 4}.step_limit()), INFINITY);
}

TEST(Mode, TheLimitSeparatesDecayFromGrowth) {
  for (const Mode &m : modes()) {
    const auto at = [&](double fraction) {
      const double dt = fraction * m.step_limit();
      return growth(m.stiffness * dt * dt / m.mass, m.damping * dt / m.mass, 0);
    };
    EXPECT_LE(at(0.999), 1 + 1e-9) << m.damping;
    EXPECT_GT(at(1.001), 1 + 1e-6) << m.damping;
  }
}

// The weight is chosen for the stiffest mode. Softer modes of the same kind have less stiffness, and less damping in
// the same proportion.
TEST(Mode, ThePredictionIsStableForAllSofterModesToo) {
  for (const Mode &m : modes())
    for (double fraction = 0.02; fraction < 1; fraction += 0.02) {
      const double dt = fraction * m.step_limit(), w = m.prediction_weight(dt);
      ASSERT_GE(w, 0);
      ASSERT_LE(w, 1);
      for (double soft = 0.05; soft <= 1; soft += 0.05)
        EXPECT_LE(growth(soft * m.stiffness * dt * dt / m.mass, soft * m.damping * dt / m.mass, w), 1 + 1e-9)
            << m.damping << ' ' << fraction << ' ' << soft;
    }
}

TEST(Mode, SmallStepsTakeTheFullPrediction) {
  for (const Mode &m : modes())
    EXPECT_EQ(m.prediction_weight(0.3 * m.step_limit()), 1) << m.damping;
}

AmongItsLike disc_among_its_like(const Material &m, const Resistance &added = {}) {
  static const GrainShape disc = GrainShape::single();
  return {disc, 3e-4, 2e-3, 0.5, m, added};
}

TEST(StepLimit, OfADiscIsThatOfTheTriangularLattice) {
  const double kn = 1e8, ks = 2.5e7, m = 3e-4, h = 0.2;
  auto limit = [](double kn, double ks, double h) {
    return step_limit(disc_among_its_like(material(kn, ks, h, h, 0.5)));
  };
  EXPECT_DOUBLE_EQ(limit(kn, ks, 0), 2 / std::sqrt(std::max(6 * kn + 3 * ks, 24 * ks) / m));
  EXPECT_DOUBLE_EQ(limit(kn, kn, 0), 2 / std::sqrt(24 * kn / m));
  EXPECT_DOUBLE_EQ(limit(kn, 0, 0), 2 / std::sqrt(6 * kn / m));
  EXPECT_LT(limit(kn, ks, h), limit(kn, ks, 0));
}

// Six neighbours that all turn in the opposite direction: a torque of 12 k_r theta on each disc.
TEST(StepLimit, KnowsWhatResistsTurningOnEachOther) {
  const double stiffness = 1e3, m = 3e-4, r = 2e-3;
  Resistance added;
  added.turning.stiffness = stiffness;
  EXPECT_DOUBLE_EQ(step_limit(disc_among_its_like(material(1e-6, 0, 0, 0, 0.5), added)),
                   2 / std::sqrt(12 * stiffness / (0.5 * m * r * r)));
}

// 2 c dt < 4 I of that motion, in which the springs and dashpots of the material have next to no part.
TEST(StepLimit, KnowsADashpotAgainstTurningWithoutASpring) {
  const double dashpot = 1e-3, m = 3e-4, r = 2e-3;
  Resistance added;
  added.turning.dashpot = dashpot;
  const double limit = 2 * 0.5 * m * r * r / (12 * dashpot);
  EXPECT_NEAR(step_limit(disc_among_its_like(material(1e-6, 1e-6, 0, 1, 0.5), added)), limit, 1e-6 * limit);
}

TEST(StepLimit, ALargerInertiaTurnsMoreSlowly) {
  AmongItsLike grain = disc_among_its_like(material(1e8, 1e8, 0, 0, 0.5)), heavy = grain;
  heavy.inertia = 2 * grain.inertia; // with k_s = k_n the modes of turning have the lowest limit
  EXPECT_DOUBLE_EQ(step_limit(heavy), std::sqrt(2.0) * step_limit(grain));
}

} // namespace
