// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/denormals.h"
#include "core/laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

using namespace cdem;

namespace {

constexpr double KN = 1e8, KS = 2.5e7, HN = 0.215, HS = 0.3, MU = 0.5, DT = 1e-7, MASS = 2e-4;
const Material steel = material(KN, KS, HN, HS, MU);

struct Scene {
  Disc<double> a{}, b{};
  double radius_a = 2e-3, radius_b = 1.5e-3;
  double es = 0, en = 0; // what the contact remembers

  // Disc b is at the origin; disc a is to its right, at the sum of the radii less the overlap.
  explicit Scene(double overlap) { a.x = radius_a + radius_b - overlap; }

  // The velocities of the half step equal those of the full step, as in uniform motion.
  Scene &moving(double vx, double vy, double omega_a = 0, double omega_b = 0) {
    a.vx = a.vx_half = vx;
    a.vy = a.vy_half = vy;
    a.omega = a.omega_half = omega_a;
    b.omega = b.omega_half = omega_b;
    return *this;
  }

  template <class Accumulation = DirectAccumulation, bool limit_damping = false>
  Forces<double> force(double dt = DT, const Material &m = steel) {
    using Law = ContactLaw<Accumulation, limit_damping>;
    const PairConstants<double> pair{radius_a + radius_b, 0.5 * (radius_a - radius_b), 2 * std::sqrt(MASS)};
    NoLosses none;
    const auto u = relative(a, b);
    std::array<double, Law::MEMORIES> memory{};
    if constexpr (Law::MEMORIES > 0)
      memory[0] = en;
    const auto f = Law::force(u, distance_of(u), pair, {}, m, dt, es, memory, none);
    if constexpr (Law::MEMORIES > 0)
      en = memory[0];
    return f;
  }
};

double dashpot(double h, double k) { return 2 * h * std::sqrt(MASS * k); }

TEST(ContactLaw, ApartThereIsNoForceAndNoMemory) {
  Scene s(-1e-6);
  s.es = 5, s.en = 7;
  s.moving(0.1, -0.3, 20).force<IncrementalAccumulation>(); // it opens
  const auto f = s.force<IncrementalAccumulation>();
  EXPECT_EQ(f.fx, 0);
  EXPECT_EQ(f.fy, 0);
  EXPECT_EQ(f.torque_a, 0);
  EXPECT_EQ(f.torque_b, 0);
  EXPECT_EQ(s.es, 0);
  EXPECT_EQ(s.en, 0);
}

TEST(ContactLaw, AtRestTheNormalForceIsStiffnessTimesOverlap) {
  EXPECT_NEAR(Scene(1e-6).force<DirectAccumulation>(0).fx, KN * 1e-6, 1e-9 * KN * 1e-6);
  EXPECT_NEAR(Scene(1e-6).force<IncrementalAccumulation>(0).fx, KN * 1e-6, 1e-9 * KN * 1e-6); // without history
}

TEST(ContactLaw, DashpotsAreTwiceTheDampingRatioTimesRootOfMassAndStiffness) {
  const double u = 1e-3; // slow enough not to reach the limit of friction
  const auto normal = Scene(1e-6).moving(-u, 0).force(0);
  EXPECT_NEAR(normal.fx, KN * 1e-6 + dashpot(HN, KN) * u, 1e-9 * KN * 1e-6);
  const auto tangential = Scene(1e-6).moving(0, u).force(0);
  EXPECT_NEAR(tangential.fy, -dashpot(HS, KS) * u, 1e-9 * KN * 1e-6);
}

#ifdef __SSE2__
TEST(ContactLaw, AContactWithoutATangentialSpringIsKnownThoughDenormalNumbersWereTakenForZero) {
  const auto seconds_of_three = [](unsigned flags) {
    const unsigned usual = _mm_getcsr();
    _mm_setcsr(usual | flags);
    EXPECT_TRUE(keep_denormals());
    EXPECT_FALSE(keep_denormals());
    Scene s(1e-6);
    s.moving(-1e-3, 0);
    s.force(0); // as a run begins
    const double second = s.force().fx, third = s.force().fx;
    _mm_setcsr(usual);
    return std::pair(second, third);
  };
  constexpr unsigned FLUSH_TO_ZERO = 0x8000, DENORMALS_ARE_ZERO = 0x0040;
  const auto [second, third] = seconds_of_three(FLUSH_TO_ZERO | DENORMALS_ARE_ZERO);
  const double force = KN * 1e-6 + dashpot(HN, KN) * 1e-3; // a contact that closed in the step would have another
  EXPECT_NEAR(second, force, 1e-9 * force);
  EXPECT_NEAR(third, force, 1e-9 * force);
}
#endif

TEST(ContactLaw, IncrementsFollowTheOverlap) {
  Scene s(1e-6);
  s.force<IncrementalAccumulation>(0);
  EXPECT_NEAR(s.en, KN * 1e-6, 1e-7);
  const double speed = -0.2;
  for (int step = 0; step < 20; ++step) {
    s.a.x += speed * DT;
    s.moving(speed, 0).force<IncrementalAccumulation>();
  }
  EXPECT_NEAR(s.en, KN * (1e-6 - 20 * speed * DT), 1e-6);
}

TEST(ContactLaw, TheTangentialSpringAddsUpTheSlipOfTheRims) {
  for (const auto &[vy, omega_a, omega_b] : {std::array{0.01, 0., 0.}, {0., 3., 0.}, {0., 0., 3.}, {0.02, -4., 2.}}) {
    const double overlap = 1e-6;
    Scene s(overlap);
    s.moving(0, vy, omega_a, omega_b);
    for (int step = 0; step < 3; ++step)
      s.force();
    // Lever arms end in the middle of the overlap. The disc also turns about the other one, which is slip, too: the
    // tolerance allows this error of second order, a third of a step's worth.
    const double slip = vy - omega_a * (s.radius_a - overlap / 2) - omega_b * (s.radius_b - overlap / 2);
    EXPECT_NEAR(s.es, -KS * slip * 3 * DT, 1e-6 * KS * std::fabs(slip) * 3 * DT);
  }
}

TEST(ContactLaw, TorquesActAtTheContactPoint) {
  Scene s(1e-6);
  s.es = 20;
  const auto f = s.force(0);
  EXPECT_NEAR(f.fy, 20, 1e-12);
  EXPECT_NEAR(f.torque_a, -20 * (s.radius_a - 0.5e-6), 1e-15);
  EXPECT_NEAR(f.torque_b, -20 * (s.radius_b - 0.5e-6), 1e-15);
  // The total moment about the origin is zero: x_a x F + torques.
  EXPECT_NEAR(s.a.x * f.fy + f.torque_a + f.torque_b, 0, 1e-16);
}

TEST(ContactLaw, FrictionIsLimitedExactlyAndHasNoDashpotThen) {
  for (double direction : {1., -1.}) {
    Scene s(1e-6);
    const auto f = s.moving(0, direction * 100).force();
    const double overlap = s.radius_a + s.radius_b - s.a.x, limit = unmarked(MU * (KN * overlap));
    EXPECT_EQ(s.es, -direction * limit);
    EXPECT_DOUBLE_EQ(f.fy, -direction * limit);
  }
}

TEST(ContactLaw, TheSpringIsMarkedAsLongAsTheContactSticks) {
  Scene s(1e-6);
  s.moving(0, 1e-3).force();
  EXPECT_TRUE(is_marked(s.es));
  EXPECT_NEAR(s.es, -KS * 1e-3 * DT, 1e-9 * KS * 1e-3 * DT);
  s.moving(0, 100).force();
  EXPECT_FALSE(is_marked(s.es));
}

TEST(ContactLaw, TheLimitIsThatOfTheElasticForceNotOfTheDashpot) {
  Scene s(1e-6);
  const auto f = s.moving(-0.5, 100).force();
  EXPECT_GT(f.fx, 1.2 * KN * 1e-6);
  EXPECT_NEAR(f.fy, -MU * KN * 1e-6, 1e-9 * KN * 1e-6);
}

TEST(ContactLaw, ASmoothWallHasNoTangentialForce) {
  Scene s(1e-6);
  const auto f = s.moving(-0.1, 10, 100).force(DT, material(KN, 0, HN, HS, MU));
  EXPECT_EQ(f.fy, 0);
  EXPECT_EQ(f.torque_a, 0);
}

TEST(ContactLaw, WithoutTimeTheHistoryStays) {
  Scene s(1e-6);
  const double es = marked(12);
  s.es = es, s.en = 99;
  s.moving(0.1, 0.1, 5).force<IncrementalAccumulation>(0);
  EXPECT_EQ(s.es, es);
  EXPECT_EQ(s.en, 99);
}

TEST(ContactLaw, TheDashpotMayPullUnlessItIsCut) {
  const double apart = 1; // m/s
  EXPECT_LT(Scene(1e-7).moving(apart, 0).force(0).fx, 0);
  EXPECT_EQ((Scene(1e-7).moving(apart, 0).force<DirectAccumulation, true>(0).fx), 0);
}

TEST(ContactLaw, ActionIsReaction) {
  Scene s(1e-6);
  s.moving(-0.01, 0.02, 3, -5);
  s.a.y = 1e-4;
  s.b.vx = s.b.vx_half = 0.003;
  Scene mirror = s;
  std::swap(mirror.a, mirror.b);
  std::swap(mirror.radius_a, mirror.radius_b);
  const auto f = s.force(), g = mirror.force();
  EXPECT_EQ(f.fx, -g.fx);
  EXPECT_EQ(f.fy, -g.fy);
  EXPECT_EQ(f.torque_a, g.torque_b);
  EXPECT_EQ(f.torque_b, g.torque_a);
  EXPECT_EQ(s.es, mirror.es); // swapping the discs turns t and the slip alike
}

TEST(ContactLaw, NoDirectionIsSpecial) {
  Scene s(1e-6);
  const auto f = s.moving(-0.01, 0.02, 3, -5).force();
  for (double angle : {0.3, 1.5707963, 2.5, -1.0}) {
    const double c = std::cos(angle), n = std::sin(angle);
    Scene turned(1e-6);
    turned.moving(-0.01 * c - 0.02 * n, -0.01 * n + 0.02 * c, 3, -5);
    turned.a.x = s.a.x * c;
    turned.a.y = s.a.x * n;
    const auto g = turned.force();
    EXPECT_NEAR(g.fx, f.fx * c - f.fy * n, 1e-8);
    EXPECT_NEAR(g.fy, f.fx * n + f.fy * c, 1e-8);
    EXPECT_NEAR(g.torque_a, f.torque_a, 1e-11);
  }
}

// The tangential spring after two discs have turned by one radian as one body. As in leapfrog, the velocity of the half
// step is the displacement of the step over its length.
double spring_after_turning_as_one_body(int steps) {
  const double w = 1000, step = 1e-3 / steps;
  Scene s(1e-6);
  const double distance = s.a.x;
  for (int k = 0; k < steps; ++k) {
    const double from = k * w * step, to = (k + 1) * w * step;
    s.a.x = distance * std::cos(to);
    s.a.y = distance * std::sin(to);
    s.moving(distance * (std::cos(to) - std::cos(from)) / step, distance * (std::sin(to) - std::sin(from)) / step, w,
             w);
    s.force(step, material(KN, KS, HN, HS, 1e9));
  }
  return s.es;
}

TEST(ContactLaw, TwoDiscsThatTurnAsOneBodyDoNotSlip) {
  // If the discs turned alone, without moving, their rims would stretch the spring to ks x distance.
  const double coarse = spring_after_turning_as_one_body(100), fine = spring_after_turning_as_one_body(200);
  EXPECT_LT(std::fabs(coarse), 2e-5 * KS * 3.5e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.1); // second order
}

const Material NO_SPRING_OR_DASHPOT{};

TEST(Presence, AContactThatLastsHasItsFullShare) {
  const auto p = presence(1e-6, 2e-6, true, 0.01, material(KN, KS, 0.2, 0.2, 0.5), 1e-7);
  EXPECT_EQ(p.spring, 1);
  EXPECT_EQ(p.dashpot_n, 1);
  EXPECT_EQ(p.dashpot_t, 1);
  EXPECT_EQ(p.impulse, 0);
}

TEST(Presence, ClosedAFractionOfTheStepAgo) {
  const auto p = presence(0.3e-6, -0.7e-6, false, 0.01, NO_SPRING_OR_DASHPOT, 1e-7);
  EXPECT_NEAR(p.spring, 0.3, 1e-12);
  EXPECT_NEAR(p.dashpot_n, 0.8, 1e-12);
  EXPECT_NEAR(p.dashpot_t, 0.8, 1e-12);
}

TEST(Presence, OpenedAfterAFractionOfTheStep) {
  const auto p = presence(-0.7e-6, 0.3e-6, true, 0.01, NO_SPRING_OR_DASHPOT, 1e-7);
  EXPECT_NEAR(p.dashpot_n, -0.2, 1e-12);
  EXPECT_NEAR(p.dashpot_t, -0.2, 1e-12);
}

TEST(Presence, ApartBeforeAndAfter) {
  const auto p = presence(-1e-6, -2e-6, false, 0.01, material(KN, KS, 0.2, 0.2, 0.5), 1e-7);
  EXPECT_EQ(p.dashpot_n, 0);
  EXPECT_EQ(p.impulse, 0);
}

TEST(Presence, RoundOffDoesNotTakeItOutOfTheStep) {
  const auto closes = presence(1e-6, 1e-19, false, 0.01, NO_SPRING_OR_DASHPOT, 1e-7);
  EXPECT_EQ(closes.spring, 1);
  EXPECT_EQ(closes.dashpot_t, 1.5);
  const auto opens = presence(-1e-6, -1e-19, true, 0.01, NO_SPRING_OR_DASHPOT, 1e-7);
  EXPECT_EQ(opens.spring, 0);
  EXPECT_EQ(opens.dashpot_t, -0.5);
}

// With springs that are 0, for lack of slip, stiffness or friction.
TEST(ContactLaw, AContactIsRememberedUntilItOpens) {
  for (const Material &m : {steel, material(KN, 0, HN, HS, 0), material(KN, KS, HN, HS, 0)}) {
    Scene s(1e-6);
    s.force(0, m);
    EXPECT_TRUE(touched(s.es));
    for (int step = 0; step < 3; step++)
      EXPECT_EQ(s.force(DT, m).fy, 0);
    EXPECT_TRUE(touched(s.es));
    s.a.x += 2e-6;
    s.force(DT, m);
    EXPECT_FALSE(touched(s.es));
  }
}

TEST(ContactLaw, WithoutTimeRoundOffDecidesNothing) {
  for (double sign : {1., -1.}) {
    const double overlap = sign * 1e-18;
    Scene unknown(overlap), known(overlap);
    known.es = marked(1e-6);
    unknown.moving(-1, 0).force(0), known.force(0);
    EXPECT_FALSE(touched(unknown.es)) << overlap;
    EXPECT_TRUE(touched(known.es)) << overlap;
  }
}

// A contact that was and is closed.
Contact<double> lasting(double approach, double slip) {
  Contact<double> c{};
  c.overlap = c.before = 1e-6;
  c.now = {approach, slip};
  return c;
}

TEST(Switch, BeginsToSlideAfterAFractionOfTheStep) {
  const Friction<double> friction{-10, -14, 10, -4, 10};
  EXPECT_NEAR(weight_of_switch(lasting(0, 0), friction, true, false, steel, DT), 0.6 - 0.5, 1e-12);
}

TEST(Switch, SticksSinceAFractionOfTheStep) {
  // At the end of the step, the spring without its limit would fall behind the limit at 3 N per step; on average over
  // the step at 1 N per step: so the contact has stuck for 3/4 of a step.
  const double slip = 3 / (KS * DT), approach = 3 / (MU * KN * DT);
  for (const auto &c : {lasting(0, slip), lasting(-approach, 0)})
    EXPECT_NEAR(weight_of_switch(c, {9, 9, 10, 10, 10}, false, true, steel, DT), 0.75 - 0.5, 1e-12);
}

TEST(Switch, NotWhereNothingChanges) {
  EXPECT_EQ(weight_of_switch(lasting(0, 1), {9, 9, 10, 8, 10}, true, true, steel, DT), 0);
  EXPECT_EQ(weight_of_switch(lasting(0, 1), {10, 12, 10, 10, 10}, false, false, steel, DT), 0);
}

// Error of the coefficient of restitution of two discs against exp(-pi h/sqrt(1 - h^2)): the force comes from the law,
// step by step, with `steps` steps per contact. The discs are `gap` apart at first, in parts of the approach in a step,
// and farther by so many units in the last place of their distance.
template <class Accumulation> double error_of_restitution(double h, int steps, double gap, int ulps) {
  using Law = ContactLaw<Accumulation, false>;
  const Material m = material(KN, KS, h, h, 0.5);
  const double mass = 1e-3; // of the pair
  const double dt = M_PI * std::sqrt(mass / KN / (1 - h * h)) / steps;
  const PairConstants<double> pair{2e-3, 0, dashpot_scale(mass, mass_of_steps(m, dt, 1))};
  Disc<double> a{}, b{};
  a.x = 2e-3 + gap * dt;
  for (int k = 0; k < std::abs(ulps); k++)
    a.x = std::nextafter(a.x, ulps);
  a.vx_half = a.vx = -1;
  double es = 0;
  std::array<double, Law::MEMORIES> memory{};
  NoLosses none;
  auto acceleration = [&](double in_step) {
    const auto u = relative(a, b);
    return Law::force(u, distance_of(u), pair, {}, m, in_step, es, memory, none).fx / mass;
  };
  a.vx_half += 0.5 * dt * acceleration(0);
  for (int step = 0; step < 1.5 * steps + 3; step++) {
    a.x += dt * a.vx_half;
    const double now = acceleration(dt);
    a.vx_half += dt * now;
    a.vx = a.vx_half + 0.5 * dt * now;
  }
  return std::fabs(a.vx_half - std::exp(-M_PI * h / std::sqrt(1 - h * h)));
}

// The worst over 32 phases, that is moments within a step at which the discs first touch, and over moments at the end
// of a step, but for round-off, and as a run begins.
template <class Accumulation> double worst_error_of_restitution(double h, int steps) {
  double worst = 0;
  for (int phase = 0; phase < 32; phase++)
    worst = std::max(worst, error_of_restitution<Accumulation>(h, steps, (phase + 0.5) / 32, 0));
  for (int gap = 0; gap < 4; gap++)
    for (int ulps = -8; ulps <= 8; ulps++)
      worst = std::max(worst, error_of_restitution<Accumulation>(h, steps, gap, ulps));
  return worst;
}

template <class Accumulation> void is_of_third_order() {
  for (double h : {0.05, 0.215, 0.5}) {
    const double coarse = worst_error_of_restitution<Accumulation>(h, 20),
                 fine = worst_error_of_restitution<Accumulation>(h, 40);
    EXPECT_LT(coarse, 1e-3) << h;
    EXPECT_GT(coarse / fine, 6) << h;
  }
}

TEST(ContactLaw, NormalImpactIsOfThirdOrder) {
  is_of_third_order<DirectAccumulation>();
  is_of_third_order<IncrementalAccumulation>();
}

// State of a disc after it has met a fixed one; `slip` is its tangential over its normal speed before. Velocity of the
// centre and of the rim, over the normal speed. The disc is so slow that the normal does not turn.
std::vector<double> after_oblique_impact(double slip, int steps, double phase) {
  const double radius = 1e-3, inertia = 0.5 * MASS * radius * radius, speed = 1e-5;
  const double dt = M_PI * std::sqrt(MASS / KN) / steps;
  const PairConstants<double> pair{2 * radius, 0, dashpot_scale(MASS, mass_of_steps(steel, dt, 1))};
  Disc<double> a{}, b{};
  a.x = 2 * radius + phase * speed * dt;
  a.vx_half = a.vx = -speed;
  a.vy_half = a.vy = slip * speed;
  double es = 0;
  std::array<double, 0> memory;
  NoLosses none;
  for (int step = 0; step < 1.2 * steps + 3; step++) {
    const auto u = relative(a, b);
    const auto f =
        ContactLaw<DirectAccumulation, false>::force(u, distance_of(u), pair, {}, steel, dt, es, memory, none);
    const double ax = f.fx / MASS, ay = f.fy / MASS, alpha = f.torque_a / inertia;
    a.vx = (a.vx_half += dt * ax) + 0.5 * dt * ax;
    a.vy = (a.vy_half += dt * ay) + 0.5 * dt * ay;
    a.omega = (a.omega_half += dt * alpha) + 0.5 * dt * alpha;
    a.x += dt * a.vx_half;
    a.y += dt * a.vy_half;
  }
  return {a.vx_half / speed, a.vy_half / speed, a.omega_half * radius / speed};
}

double worst_error_of_oblique_impact(double slip, int steps) {
  const auto exact = after_oblique_impact(slip, 5120, 0.5);
  double worst = 0;
  for (int phase = 0; phase < 32; phase++) {
    const auto got = after_oblique_impact(slip, steps, (phase + 0.5) / 32);
    for (std::size_t k = 0; k < got.size(); k++)
      worst = std::max(worst, std::fabs(got[k] - exact[k]));
  }
  return worst;
}

// Friction with a tangential dashpot, which acts while the contact sticks: from an impact that sticks nearly always to
// one that slides at its beginning and its end.
TEST(ContactLaw, ImpactsThatStickAndSlipAreOfSecondOrder) {
  for (double slip : {2 * MU, 3 * MU, 5 * MU, 7 * MU}) {
    // the fine step is 1/16 of the coarse one: an error of second order falls by 256, one of first order by 16
    const double coarse = worst_error_of_oblique_impact(slip, 20), fine = worst_error_of_oblique_impact(slip, 320);
    EXPECT_LT(coarse, 2e-3) << slip;
    EXPECT_GT(coarse / fine, 100) << slip;
  }
}

// The time integration of a single pair: velocity Verlet, with the dashpot's velocity carried forward by half a step.
// x'' + 2 h x' + x = 0 decays by exp(-h dt) in a step. For a sum of two geometric sequences, x_n^2 - x_(n-1) x_(n+1) is
// a geometric sequence, with the product of their factors: its ratio over one step gives the decay.
TEST(ContactLaw, ScaledDashpotsDecayAsWithoutSteps) {
  for (double h : {0.05, 0.215, 0.5})
    for (double dt : {0.3, 0.15}) {
      const double c = h * dashpot_scale(1, mass_of_steps(material(1, 1, h, h, 0), dt, 1));
      std::vector<double> x{1};
      for (double half = 0, a = 0; x.size() < 60;) {
        x.push_back(x.back() + dt * half);
        a = -x.back() - c * (half + 0.5 * dt * a);
        half += dt * a;
      }
      auto area = [&](int n) { return x[n] * x[n] - x[n - 1] * x[n + 1]; };
      EXPECT_NEAR(-std::log(area(51) / area(50)) / (2 * h * dt), 1, 0.15 * dt * dt) << h << ' ' << dt;
    }
}
} // namespace
