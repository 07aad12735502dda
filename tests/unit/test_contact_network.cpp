// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/contact_network.h"
#include "core/stability.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace cdem;

namespace {

constexpr double KN = 1e8, KS = 2.5e7, MASS = 3e-4, RADIUS = 2e-3;

Material with_damping(double h, double ks = KS) { return material(KN, ks, h, h, 0.5); }

// A packing as a test describes it: grains, and contacts with their places relative to either centre.
struct Grain {
  double mass, inertia; // mass 0: a wall
};
struct Contact {
  int a, b;
  double nx, ny; // from b to a
  double ax, ay, bx, by;
};
struct Packing {
  std::vector<Grain> grains;
  std::vector<Contact> contacts;
  Material material;
  Resistance::Part rolling{}; // of the two grains against rolling on each other

  double root_mass(const Contact &c) const {
    const double a = grains[c.a].mass, b = grains[c.b].mass;
    return 2 * std::sqrt(b == 0 ? a : a == 0 ? b : a * b / (a + b));
  }
  Resistance resistance(const Contact &c) const {
    const double root = root_mass(c);
    return {{material.kn, material.dn * root}, {material.ks, material.ds * root}, rolling};
  }
  int own() const { return int(grains.size()); }
  Grain inverse(int i) const {
    const Grain &g = grains[i];
    return g.mass > 0 ? Grain{1 / g.mass, 1 / g.inertia} : g;
  }
  template <class Visit> void for_each_touch(int i, Visit visit) const {
    for (const Contact &c : contacts) {
      if (c.a == i)
        visit(Touch{c.b, c.nx, c.ny, c.ax, c.ay, resistance(c)});
      if (c.b == i)
        visit(Touch{c.a, -c.nx, -c.ny, c.bx, c.by, resistance(c)});
    }
  }
  double limit(double enough = INFINITY) const {
    std::vector<double> weights(grains.size());
    return ContactNetwork(*this).step_limit(
        1e-6, enough, weights, [] {}, [](double x) { return x; });
  }

  // Largest u.(K dt^2 + 2 C dt) u/u.M u, by the power method.
  double load(double dt) const {
    std::vector<double> u(3 * grains.size()), f(u.size());
    std::mt19937 random(1);
    for (double &x : u)
      x = std::uniform_real_distribution<>(-1, 1)(random);
    double largest = 0;
    for (int k = 0; k < 4000; k++) {
      std::fill(f.begin(), f.end(), 0.0);
      for (const Contact &c : contacts) {
        const Resistance r = resistance(c);
        struct Direction {
          double x, y, turn_a, turn_b;
          Resistance::Part part;
        };
        auto along = [&c](double x, double y, const Resistance::Part &part) {
          return Direction{x, y, c.ax * y - c.ay * x, c.bx * y - c.by * x, part};
        };
        for (const auto &[x, y, turn_a, turn_b, part] :
             {along(c.nx, c.ny, r.normal), along(-c.ny, c.nx, r.tangent), Direction{0, 0, 1, 1, r.turning}}) {
          const double *const ua = &u[3 * c.a], *const ub = &u[3 * c.b];
          const double slip = x * (ua[0] - ub[0]) + y * (ua[1] - ub[1]) + turn_a * ua[2] - turn_b * ub[2];
          const double force = (part.stiffness * dt + 2 * part.dashpot) * dt * slip;
          for (const auto &[grain, sign, turn] : {std::tuple{c.a, 1, turn_a}, std::tuple{c.b, -1, turn_b}}) {
            f[3 * grain] += sign * force * x;
            f[3 * grain + 1] += sign * force * y;
            f[3 * grain + 2] += sign * force * turn;
          }
        }
      }
      double square = 0;
      for (std::size_t i = 0; i < f.size(); i++) {
        const Grain &g = grains[i / 3];
        f[i] = g.mass == 0 ? 0 : f[i] / (i % 3 == 2 ? g.inertia : g.mass);
        square += f[i] * f[i];
      }
      double before = 0;
      for (double x : u)
        before += x * x;
      largest = std::sqrt(square / before);
      for (std::size_t i = 0; i < f.size(); i++)
        u[i] = f[i] / std::sqrt(square);
    }
    return largest;
  }
};

Grain disc(double mass = MASS, double radius = RADIUS) { return {mass, mass * radius * radius / 2}; }

// Discs a and b that touch; the direction is from b to a.
Contact touching(int a, int b, double nx, double ny, double ra = RADIUS, double rb = RADIUS) {
  return {a, b, nx, ny, -ra * nx, -ra * ny, rb * nx, rb * ny};
}

// n x n discs on a periodic lattice, with contacts along these directions.
Packing lattice(int n, const std::vector<std::array<int, 2>> &steps, double angle, const Material &m) {
  Packing p{std::vector<Grain>(n * n, disc()), {}, m};
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (const auto &[di, dj] : steps) {
        const double x = di + dj * std::cos(angle), y = dj * std::sin(angle);
        p.contacts.push_back(touching((i + di + n) % n * n + (j + dj + n) % n, i * n + j, x, y));
      }
  return p;
}

// The step limit of modes, each given by its sums of kn and of ks; the dashpots have the same sums.
double closed_form(const std::vector<std::array<double, 2>> &modes, const Material &m) {
  const double root = 2 * std::sqrt(MASS / 2);
  double limit = INFINITY;
  for (const auto &[n, t] : modes)
    limit = std::min(limit, (Mode{n * m.kn + t * m.ks, root * (n * m.dn + t * m.ds), MASS}).step_limit());
  return limit;
}

TEST(Squares, LargestEigenvalue) {
  Squares one;
  one.add(3, 1, -2, 0.5);
  EXPECT_NEAR(one.largest(), 3 * 5.25, 1e-9);
  Squares equal; // a double root: Newton's method stops slightly above it
  equal.add(2, 1, 0, 0);
  equal.add(2, 0, 1, 0);
  EXPECT_GE(equal.largest(), 2);
  EXPECT_NEAR(equal.largest(), 2, 1e-4);
  Squares coupled; // {{5, 2}, {2, 2}}, with eigenvalues 6 and 1
  coupled.add(1, 2, 1, 0);
  coupled.add(1, 1, 0, 0);
  coupled.add(1, 0, 1, 0);
  EXPECT_NEAR(coupled.largest(), 6, 1e-9);
  EXPECT_EQ(Squares().largest(), 0);
}

TEST(ContactNetwork, WithoutContactsThereIsNoLimit) {
  EXPECT_EQ((Packing{{disc(), disc()}, {}, with_damping(0)}.limit()), INFINITY);
}

// Two discs that move against each other: the eigenvalue is k (1/m + 1/M), however different their masses are.
TEST(ContactNetwork, TwoDiscs) {
  for (double ratio : {1.0, 3.0, 100.0, 1e6}) {
    const Packing p{{disc(), disc(ratio * MASS)}, {touching(0, 1, 0.6, 0.8)}, with_damping(0, 0)};
    EXPECT_NEAR(p.limit() / (2 / std::sqrt(KN * (1 + 1 / ratio) / MASS)), 1, 1e-6) << ratio;
  }
}

TEST(ContactNetwork, DiscOnAWall) {
  const Packing p{{disc(), Grain{0, 0}}, {touching(0, 1, 0, 1)}, with_damping(0, 0)};
  EXPECT_NEAR(p.limit() / (2 / std::sqrt(KN / MASS)), 1, 1e-6);
}

// Neighbours in antiphase: 4 kn in a chain, 4 (kn + ks) on a square lattice. All turning the same way: 8 ks and 16 ks.
TEST(ContactNetwork, ChainAndSquareLatticeAreExact) {
  for (double h : {0.0, 0.215, 0.9})
    for (double ks : {KS, KN}) {
      const Material m = with_damping(h, ks);
      Packing chain{std::vector<Grain>(10, disc()), {}, m};
      for (int i = 0; i < 10; i++)
        chain.contacts.push_back(touching((i + 1) % 10, i, 1, 0));
      EXPECT_NEAR(chain.limit() / closed_form({{4, 0}, {0, 8}}, m), 1, 2e-3) << h;
      const Packing square = lattice(6, {{1, 0}, {0, 1}}, M_PI / 2, m);
      EXPECT_NEAR(square.limit() / closed_form({{4, 4}, {0, 16}}, m), 1, 2e-3) << h;
    }
}

// By Bloch's theorem the eigenvalues are at most 6 kn + 3 ks and 24 ks.
TEST(ContactNetwork, TriangularLattice) {
  for (double h : {0.0, 0.215, 0.9}) {
    const Material m = with_damping(h);
    const double found = lattice(6, {{1, 0}, {0, 1}, {-1, 1}}, M_PI / 3, m).limit();
    const double exact = closed_form({{6, 3}, {0, 24}}, m);
    EXPECT_LE(found, exact * (1 + 1e-12)) << h;
    EXPECT_GE(found, 0.94 * exact) << h;
  }
}

// Two discs that turn on each other: k_r (1/I + 1/I).
TEST(ContactNetwork, TurningOnEachOther) {
  Packing p{{disc(), disc(3 * MASS)}, {touching(0, 1, 0.6, 0.8)}, material(1e-3, 0, 0, 0, 0)};
  p.rolling = {50, 0};
  EXPECT_NEAR(p.limit() / (2 / std::sqrt(50 * (1 + 1. / 3) / disc().inertia)), 1, 1e-6);
}

// The limits of the contacts and of the worst packing against the lattice itself, with resistance to turning and with
// any inertia; 12 x 12 discs have most of its modes. With more inertia and dashpots the latter is on the safe side by
// up to half.
TEST(ContactNetwork, LatticeThatResistsTurning) {
  for (double factor : {0.5, 1.0, 2.0, 4.0})
    for (double mu : {0.0, 0.3, 0.7, 1.0, 2.0})
      for (double h : {0.0, 0.5}) {
        const Material m = with_damping(h, KN);
        Packing p = lattice(6, {{1, 0}, {0, 1}, {-1, 1}}, M_PI / 3, m);
        for (Grain &g : p.grains)
          g.inertia *= factor;
        const double arm = mu * RADIUS / 2, rim = p.grains[0].inertia + MASS * RADIUS * RADIUS;
        p.rolling.stiffness = 3 * KN * arm * arm;
        p.rolling.dashpot = 2 * h * std::sqrt(rim / 2 * p.rolling.stiffness);
        static const GrainShape shape = GrainShape::single();
        const double of_contacts = p.limit();
        const double of_worst = step_limit({shape, MASS, RADIUS, 0.5 * factor, m, {{}, {}, p.rolling}});
        EXPECT_LE(p.load(of_contacts), 4 * (1 + 1e-9)) << factor << ' ' << mu << ' ' << h;
        EXPECT_LE(p.load(of_worst), 4 * (1 + 1e-9)) << factor << ' ' << mu << ' ' << h;
        EXPECT_GT(p.load(1.9 * of_worst), 4) << factor << ' ' << mu << ' ' << h;
      }
}

// Grains of random mass and inertia, with contacts at random places on them, as clumps have.
Packing irregular(int seed, const Material &m) {
  std::mt19937 random(seed);
  auto number = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  const int n = 8;
  Packing p{{}, {}, m};
  for (int i = 0; i < n * n; i++) {
    const double mass = MASS * std::exp(number(-1.5, 1.5));
    p.grains.push_back({mass, mass * RADIUS * RADIUS * number(0.3, 0.8)});
  }
  p.grains[3] = p.grains[17] = {0, 0};
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (const auto &[di, dj] : {std::array{1, 0}, std::array{0, 1}, std::array{1, 1}, std::array{1, -1}}) {
        if (number(0, 1) < 0.4)
          continue;
        const double angle = std::atan2(dj, di) + number(-0.5, 0.5), x = std::cos(angle), y = std::sin(angle);
        Contact c = touching((i + di) % n * n + (j + dj + n) % n, i * n + j, x, y);
        for (double *place : {&c.ax, &c.ay, &c.bx, &c.by})
          *place += number(-0.5, 0.5) * RADIUS;
        p.contacts.push_back(c);
      }
  return p;
}

// 2 c dt < 4 I, whether there is a spring beside the dashpot or not.
TEST(ContactNetwork, DashpotAgainstTurning) {
  Packing p{{disc(), Grain{0, 0}}, {touching(0, 1, 0, 1)}, with_damping(0, 0)};
  p.rolling = {0, 6e-3};
  EXPECT_NEAR(p.limit() / (2 * disc().inertia / p.rolling.dashpot), 1, 1e-6);
}

TEST(ContactNetwork, IsSafeAndNotMuchBelowTheLimit) {
  for (int seed = 1; seed <= 4; seed++)
    for (double h : {0.0, 0.5}) {
      Packing p = irregular(seed, with_damping(h));
      if (seed % 2 == 0)
        p.rolling = {30, h * 1e-4};
      const double found = p.limit();
      EXPECT_LE(p.load(found), 4 * (1 + 1e-9)) << seed << ' ' << h;
      EXPECT_GT(p.load(1.2 * found), 4) << seed << ' ' << h;
    }
}

TEST(ContactNetwork, StopsWhenItIsEnough) {
  const Packing p = irregular(1, with_damping(0.2));
  const double limit = p.limit();
  EXPECT_GE(p.limit(0.8 * limit), 0.8 * limit);
  EXPECT_LE(p.limit(0.8 * limit), limit);
  EXPECT_LT(p.limit(1.1 * limit), 1.1 * limit); // asked for more than there is, it returns less
}

} // namespace
