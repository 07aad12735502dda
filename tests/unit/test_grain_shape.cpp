// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grain_shape.h"
#include "core/stability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <vector>

using namespace cdem;

namespace {

using Discs = std::vector<GrainShape::Member>;

const double SQRT3 = std::sqrt(3.0);

// --- an independent integration: strips ------------------------------------------------------------
// Along a line of constant x, the union is a set of intervals in y, so each moment is an integral over x. It is divided
// at the x where a disc begins or ends, or two rims cross. In between, the integrand is smooth except for square roots
// at the ends. The substitution x = middle - half cos(t) removes these: then Gauss's rule converges exponentially.

struct Node {
  double t, weight;
};

std::vector<Node> gauss(int n) { // on 0 ... pi
  std::vector<Node> nodes;
  for (int k = 1; k <= n; k++) {
    double z = std::cos(M_PI * (k - 0.25) / (n + 0.5)), derivative = 1;
    for (int iteration = 0; iteration < 20; iteration++) {
      double p = 1, before = 0;
      for (int j = 1; j <= n; j++) {
        const double next = ((2 * j - 1) * z * p - (j - 1) * before) / j;
        before = p;
        p = next;
      }
      derivative = n * (z * p - before) / (z * z - 1);
      z -= p / derivative;
    }
    nodes.push_back({M_PI / 2 * (1 + z), M_PI / ((1 - z * z) * derivative * derivative)});
  }
  return nodes;
}

struct Union {
  double area = 0, x = 0, y = 0, polar = 0; // moments about the origin

  double inertia() const { return polar / area - (x * x + y * y) / (area * area); } // per mass, about the centre
};

Union strips(const Discs &discs, int n) {
  std::vector<double> ends;
  for (const auto &a : discs) {
    ends.insert(ends.end(), {a.x - a.r, a.x + a.r});
    for (const auto &b : discs) {
      const double dx = b.x - a.x, dy = b.y - a.y, d = std::hypot(dx, dy);
      const double along = (d * d + a.r * a.r - b.r * b.r) / (2 * d), square = a.r * a.r - along * along;
      if (d > 0 && square > 0)
        ends.push_back(a.x + (along * dx - std::sqrt(square) * dy) / d);
    }
  }
  std::sort(ends.begin(), ends.end());

  Union sum;
  const auto nodes = gauss(n);
  for (std::size_t e = 1; e < ends.size(); e++) {
    const double half = (ends[e] - ends[e - 1]) / 2;
    for (const auto &[t, weight] : nodes) {
      const double x = ends[e - 1] + half * (1 - std::cos(t)), dx = weight * half * std::sin(t);
      std::vector<std::pair<double, double>> cuts;
      for (const auto &d : discs)
        if (std::fabs(x - d.x) < d.r) {
          const double h = std::sqrt(d.r * d.r - (x - d.x) * (x - d.x));
          cuts.push_back({d.y - h, d.y + h});
        }
      std::sort(cuts.begin(), cuts.end());
      double above = -INFINITY;
      for (auto [lo, hi] : cuts) {
        lo = std::max(lo, above);
        if (hi <= lo)
          continue;
        above = hi;
        sum.area += dx * (hi - lo);
        sum.x += dx * x * (hi - lo);
        sum.y += dx * (hi * hi - lo * lo) / 2;
        sum.polar += dx * (x * x * (hi - lo) + (hi * hi * hi - lo * lo * lo) / 3);
      }
    }
  }
  return sum;
}

// Circumscribed radius of a shape, in the unit of the discs it was made from.
double radius_of(const GrainShape &shape, const Discs &given) { return given[0].r / shape.discs()[0].r; }

void expect_as_by_strips(const Discs &given, double tolerance, const std::string &what) {
  const GrainShape shape(given);
  const Union coarse = strips(given, 60), fine = strips(given, 120);
  ASSERT_NEAR(coarse.polar, fine.polar, tolerance / 3 * fine.polar) << what << ": the strips are too coarse";

  const double cx = fine.x / fine.area, cy = fine.y / fine.area, radius = radius_of(shape, given);
  double rim = 0;
  for (const auto &d : given)
    rim = std::max(rim, std::hypot(d.x - cx, d.y - cy) + d.r);
  EXPECT_NEAR(radius, rim, tolerance * rim) << what;
  EXPECT_NEAR(shape.area() * radius * radius, fine.area, tolerance * fine.area) << what;
  EXPECT_NEAR(shape.inertia() * radius * radius, fine.inertia(), tolerance * fine.inertia()) << what;
  for (std::size_t k = 0; k < given.size(); k++) {
    EXPECT_NEAR(shape.discs()[k].x * radius, given[k].x - cx, tolerance * rim) << what << ", disc " << k + 1;
    EXPECT_NEAR(shape.discs()[k].y * radius, given[k].y - cy, tolerance * rim) << what << ", disc " << k + 1;
    EXPECT_NEAR(shape.discs()[k].r * radius, given[k].r, tolerance * rim) << what << ", disc " << k + 1;
  }
}

// n discs, each of which touches or overlaps an earlier one.
Discs cluster(int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  Discs discs{{0.3, -0.2, 1}};
  while (int(discs.size()) < n) {
    const auto &base = discs[random() % discs.size()];
    const double r = 0.3 + share(random), turn = 2 * M_PI * share(random);
    const double nearest = 1.05 * std::fabs(base.r - r), distance = nearest + share(random) * (base.r + r - nearest);
    Discs more = discs;
    more.push_back({base.x + distance * std::cos(turn), base.y + distance * std::sin(turn), r});
    try {
      GrainShape accepted(more);
      discs = more;
    } catch (const std::invalid_argument &) { // one disc inside another: try again
    }
  }
  return discs;
}

Discs ring(int n, double radius, double r) {
  Discs discs;
  for (int k = 0; k < n; k++)
    discs.push_back({radius * std::cos(2 * M_PI * k / n), radius * std::sin(2 * M_PI * k / n), r});
  return discs;
}

TEST(GrainShape, StripsAreExactForADisc) {
  const Union disc = strips({{2, -1, 3}}, 40);
  EXPECT_NEAR(disc.area, 9 * M_PI, 1e-13);
  EXPECT_NEAR(disc.x / disc.area, 2, 1e-14);
  EXPECT_NEAR(disc.inertia(), 4.5, 1e-13);
}

TEST(GrainShape, ClustersAgreeWithStripsToRoundOff) {
  for (int n = 1; n <= 8; n++)
    for (unsigned seed = 1; seed <= 12; seed++)
      expect_as_by_strips(cluster(n, seed), 1e-12, std::to_string(n) + " discs, seed " + std::to_string(seed));
}

TEST(GrainShape, AHoleIsNotPartOfTheUnion) {
  expect_as_by_strips(ring(6, 2, 1.2), 1e-12, "ring");
  const double touching = std::sin(M_PI / 6) * 2;
  expect_as_by_strips(ring(6, 2, touching), 1e-12, "ring of touching discs");
}

// --- closed forms -----------------------------------------------------------------------------------

TEST(GrainShape, OneDisc) {
  for (const GrainShape &disc : {GrainShape::single(), GrainShape({{7, -3, 0.1}})}) {
    EXPECT_EQ(disc.area(), M_PI);
    EXPECT_EQ(disc.inertia(), 0.5);
    EXPECT_EQ(disc.reach(), 0);
    EXPECT_EQ(disc.discs()[0].r, 1);
  }
}

// Two discs of radius 1 at distance d meet in a chord at the distance c = d/2 = cos a from either centre; s = sin a.
// Take from one of them the segment beyond the chord. The rest has, about the centre of the disc and with x towards the
// chord,
//   area = pi - a + s c,   integral of x = -2/3 s^3,   of x^2 = (pi - a)/4 + s c (c^2 - s^2)/4,
//   of y^2 = (pi - a)/4 + s c/4 + s^3 c/6,
// and the union consists of two such parts.
TEST(GrainShape, TwoDiscsAndTheirLens) {
  for (double d : {0.021, 0.5, 1.0, 1.7, 1.999, 2.0}) {
    const double c = d / 2, s = std::sqrt(1 - c * c), a = std::acos(c);
    const double area = M_PI - a + s * c;
    const double x = -2.0 / 3 * s * s * s;
    const double xx = (M_PI - a) / 4 + s * c * (c * c - s * s) / 4;
    const double yy = (M_PI - a) / 4 + s * c / 4 + s * s * s * c / 6;
    const double polar = xx + yy - 2 * c * x + c * c * area; // about the middle of the union, at x = c
    const GrainShape shape({{0, 0, 1}, {d, 0, 1}});
    const double radius = 1 + c;
    EXPECT_NEAR(shape.area() * radius * radius, 2 * area, 1e-13) << d;
    EXPECT_NEAR(shape.inertia() * radius * radius, polar / area, 1e-13) << d;
    EXPECT_NEAR(shape.reach(), c / radius, 1e-14) << d;
  }
}

TEST(GrainShape, ThreeTouchingDiscs) {
  const GrainShape shape = GrainShape::triple();
  const double radius = 1 + 2 / SQRT3; // the circumscribed diameter is 2.155 d
  EXPECT_NEAR(shape.area(), 3 * M_PI / (radius * radius), 1e-15);
  EXPECT_NEAR(shape.inertia(), (0.5 + 4.0 / 3) / (radius * radius), 1e-15);
  EXPECT_NEAR(shape.reach(), 2 / SQRT3 / radius, 1e-15);
  ASSERT_EQ(shape.discs().size(), 3u);
  for (const auto &d : shape.discs())
    EXPECT_NEAR(d.r, 1 / radius, 1e-15);
}

// n equal touching discs in a row: I = m (r^2/2 + r^2 (n^2 - 1)/3).
TEST(GrainShape, RowOfTouchingDiscs) {
  Discs row;
  for (int n = 1; n <= 7; n++) {
    row.push_back({2.0 * (n - 1), 0, 1});
    const GrainShape shape(row);
    EXPECT_NEAR(shape.area() * n * n, n * M_PI, 1e-13 * n * n);
    EXPECT_NEAR(shape.inertia() * n * n, 0.5 + (n * n - 1) / 3.0, 1e-13 * n * n);
  }
}

// Slivers: the result is continuous where discs just touch, and where one is almost inside the other.
TEST(GrainShape, ContinuousAtItsLimits) {
  const GrainShape touching({{0, 0, 1}, {2, 0, 1}});
  for (double e : {1e-11, 1e-9, 1e-6}) {
    const GrainShape overlapping({{0, 0, 1}, {2 - e, 0, 1}}), inside({{0, 0, 1}, {0.5 + e, 0, 0.5}});
    EXPECT_NEAR(overlapping.area(), touching.area(), 2 * e);
    EXPECT_NEAR(overlapping.inertia(), touching.inertia(), 2 * e);
    EXPECT_NEAR(inside.area(), M_PI, 10 * e);
    EXPECT_NEAR(inside.inertia(), 0.5, 10 * e);
  }
}

// --- invariance -------------------------------------------------------------------------------------

void expect_same(const GrainShape &a, const GrainShape &b, double tolerance) {
  EXPECT_NEAR(a.area(), b.area(), tolerance);
  EXPECT_NEAR(a.inertia(), b.inertia(), tolerance);
  EXPECT_NEAR(a.reach(), b.reach(), tolerance);
  EXPECT_NEAR(a.neighbours(), b.neighbours(), 100 * tolerance);
  EXPECT_NEAR(a.normal_levers(), b.normal_levers(), 100 * tolerance);
  EXPECT_NEAR(a.tangential_levers(), b.tangential_levers(), 100 * tolerance);
}

TEST(GrainShape, PlaceAngleScaleAndOrderOfTheDiscsDoNotMatter) {
  for (unsigned seed = 1; seed <= 20; seed++) {
    const Discs given = cluster(5, seed);
    const GrainShape shape(given);
    const double turn = 0.37 * seed, scale = std::pow(10, int(seed % 13) - 6), shift = 3.0 * seed;
    Discs moved;
    for (const auto &d : given)
      moved.push_back({scale * (std::cos(turn) * d.x - std::sin(turn) * d.y + shift),
                       scale * (std::sin(turn) * d.x + std::cos(turn) * d.y - shift), scale * d.r});
    const GrainShape other(moved);
    expect_same(shape, other, 1e-11);
    for (std::size_t k = 0; k < given.size(); k++) { // the discs keep their order, and turn with the template
      const auto &d = shape.discs()[k], &e = other.discs()[k];
      EXPECT_NEAR(std::cos(turn) * d.x - std::sin(turn) * d.y, e.x, 1e-11);
      EXPECT_NEAR(std::sin(turn) * d.x + std::cos(turn) * d.y, e.y, 1e-11);
      EXPECT_NEAR(d.r, e.r, 1e-11);
    }
    std::shuffle(moved.begin(), moved.end(), std::mt19937_64(seed));
    expect_same(shape, GrainShape(moved), 1e-11);
  }
}

// A template may be at any position. These coordinates stay exact after the shift, so the results may differ by
// round-off only.
TEST(GrainShape, FarFromTheOrigin) {
  const double unit = std::ldexp(1, -10);
  const Discs near{{0, 0, 1}, {1230 * unit, 100 * unit, 0.75}, {400 * unit, 921 * unit, 0.5}};
  for (int exponent : {4, 10, 20, 30}) {
    Discs far = near;
    for (auto &d : far) {
      d.x += std::ldexp(1, exponent);
      d.y -= std::ldexp(3, exponent);
    }
    expect_same(GrainShape(near), GrainShape(far), 1e-13);
  }
}

// --- what is refused --------------------------------------------------------------------------------

std::string refusal(const Discs &discs) {
  try {
    GrainShape shape(discs);
  } catch (const std::invalid_argument &bad) {
    return bad.what();
  }
  return "none";
}

TEST(GrainShape, BadTemplatesAreNamed) {
  EXPECT_EQ(refusal({}), "it has no discs");
  std::vector<GrainShape::Member> many;
  for (int k = 0; k <= 1000; k++)
    many.push_back({2.0 * k, 0, 1});
  EXPECT_EQ(refusal(many), "it has 1001 discs, at most 1000 are allowed");
  EXPECT_EQ(refusal({{0, 0, 1}, {1, 0, 0}}), "disc 2 has radius 0, must be positive");
  EXPECT_EQ(refusal({{0, 0, -0.5}}), "disc 1 has radius -0.5, must be positive");
  EXPECT_EQ(refusal({{0, 0, 1}, {NAN, 0, 1}}), "disc 2 has a coordinate or radius that is not a finite number");
  EXPECT_EQ(refusal({{0, 0, INFINITY}}), "disc 1 has a coordinate or radius that is not a finite number");
  EXPECT_EQ(refusal({{0, 0, 1}, {2, 0, 1}, {0, 0, 1}}), "disc 1 is a duplicate of, or lies inside, disc 3");
  EXPECT_EQ(refusal({{0, 0, 1}, {0.3, 0.2, 0.5}}), "disc 2 is a duplicate of, or lies inside, disc 1");
  EXPECT_EQ(refusal({{0, 0, 1}, {0.03, 0, 1}, {0.04, 0, 0.995}}),
            "disc 3 nearly coincides with disc 2: distance of centres and difference of radii"
            " must add up to 2 % of the smaller radius");
  EXPECT_EQ(refusal({{0, 0, 1}, {0.021, 0, 1}, {1, 0, 1}, {1.03, 0, 0.98}}), "none"); // one sticks out of the other
  EXPECT_EQ(refusal({{0, 0, 1}, {2, 0, 1}, {5, 0, 1}, {7, 0, 1}}), "disc 3 is disconnected from disc 1");
  EXPECT_EQ(refusal({{0, 0, 1}, {2.001, 0, 1}}), "disc 2 is disconnected from disc 1");
}

TEST(GrainShape, TouchingToAFewDigitsIsConnected) {
  EXPECT_EQ(refusal({{0, 0, 1}, {2 + 1e-9, 0, 1}}), "none");
  EXPECT_EQ(refusal({{-0.866, 0, 0.866}, {0.866, 0, 0.866}, {0, 1.49995, 0.866}}), "none"); // by hand, a tiny gap
}

// --- the stability limit ----------------------------------------------------------------------------
// The limit is that of a packing of equal grains. In a lattice of them the exact limit is known: by Bloch's theorem its
// motions are waves, and the largest eigenvalue of a wave's 3 x 3 matrix gives the limit 2/sqrt(eigenvalue).

using Complex = std::complex<double>;
using Matrix = std::array<std::array<Complex, 3>, 3>;

// By powers: in (M/trace)^(2^12), from twelve squarings, only the largest eigenvalue of M >= 0 is left. The Rayleigh
// quotient of a column makes the remaining error one of second order.
double largest_eigenvalue(const Matrix &m) {
  const double trace = (m[0][0] + m[1][1] + m[2][2]).real();
  Matrix power = m;
  for (auto &row : power)
    for (auto &entry : row)
      entry /= trace;
  for (int squaring = 0; squaring < 12; squaring++) {
    Matrix square{};
    double sum = 0;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        for (int k = 0; k < 3; k++)
          square[i][j] += power[i][k] * power[k][j];
        sum = std::max(sum, std::abs(square[i][j]));
      }
    for (auto &row : square)
      for (auto &entry : row)
        entry /= sum;
    power = square;
  }
  int best = 0;
  for (int j = 1; j < 3; j++)
    if (power[j][j].real() > power[best][best].real())
      best = j;
  Complex above = 0;
  double below = 0;
  for (int i = 0; i < 3; i++) {
    below += std::norm(power[i][best]);
    for (int j = 0; j < 3; j++)
      above += std::conj(power[i][best]) * m[i][j] * power[j][best];
  }
  return above.real() / below;
}

struct Site {
  int i, j; // indices in the triangular lattice of discs of radius 1

  double x() const { return 2 * i + j; }
  double y() const { return SQRT3 * j; }
};

// A clump that tiles the triangular lattice when it is repeated by the two translations.
struct Tiling {
  std::string name;
  std::vector<Site> sites;
  Site first, second;
};

const Tiling TILINGS[] = {
    {"single", {{0, 0}}, {1, 0}, {0, 1}},
    {"pair", {{0, 0}, {1, 0}}, {2, 0}, {0, 1}},
    {"triple", {{0, 0}, {1, 0}, {0, 1}}, {1, 1}, {2, -1}},
    {"rhomb", {{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {2, 0}, {0, 2}},
    {"row", {{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {4, 0}, {2, 1}},
    {"flower", {{0, 0}, {1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}, {2, 1}, {-1, 3}},
};

Discs discs_of(const Tiling &tiling) {
  Discs discs;
  for (const Site &s : tiling.sites)
    discs.push_back({s.x(), s.y(), 1});
  return discs;
}

// Largest eigenvalue over all waves, times the mass of a disc.
double lattice_eigenvalue(const Tiling &tiling, double kn, double ks) {
  const int n = int(tiling.sites.size());
  double cx = 0, cy = 0, inertia = 0.5;
  for (const Site &s : tiling.sites) {
    cx += s.x() / n;
    cy += s.y() / n;
  }
  for (const Site &s : tiling.sites)
    inertia += (std::pow(s.x() - cx, 2) + std::pow(s.y() - cy, 2)) / n;
  const double scale[3] = {1 / std::sqrt(n), 1 / std::sqrt(n), 1 / std::sqrt(n * inertia)};

  // Per contact: its motion along n and t for unit motions of its two grains, and how many translations lie between
  // them.
  struct Contact {
    double own[2][3], other[2][3];
    int u, v;
  };
  std::vector<Contact> contacts;
  const Site a = tiling.first, b = tiling.second;
  const int cell = a.i * b.j - a.j * b.i;
  for (const Site &s : tiling.sites)
    for (const Site step : {Site{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}})
      for (const Site &t : tiling.sites) {
        const int di = s.i + step.i - t.i, dj = s.j + step.j - t.j;
        const int u = di * b.j - dj * b.i, v = a.i * dj - a.j * di;
        if (u % cell != 0 || v % cell != 0 || (u == 0 && v == 0))
          continue;
        Contact c{{}, {}, u / cell, v / cell};
        const double nx = step.x() / 2, ny = step.y() / 2, x = s.x() + nx, y = s.y() + ny;
        const double dx = c.u * a.x() + c.v * b.x(), dy = c.u * a.y() + c.v * b.y();
        const double along[2][2] = {{nx, ny}, {-ny, nx}};
        for (int k = 0; k < 2; k++) {
          const double ex = along[k][0], ey = along[k][1];
          const double own[3] = {ex, ey, (x - cx) * ey - (y - cy) * ex};
          const double other[3] = {ex, ey, (x - dx - cx) * ey - (y - dy - cy) * ex};
          for (int m = 0; m < 3; m++) {
            c.own[k][m] = own[m] * scale[m];
            c.other[k][m] = other[m] * scale[m];
          }
        }
        contacts.push_back(c);
      }

  double largest = 0;
  const int waves = 24; // 24: includes the edges and corners of the Brillouin zone, phases of 1/2 and 1/3 of a turn
  const double stiffness[2] = {kn, ks};
  for (int p = 0; p < waves; p++)
    for (int q = 0; q < waves; q++) {
      Matrix m{};
      for (const Contact &c : contacts) {
        const Complex phase = std::polar(1.0, 2 * M_PI * (p * c.u + q * c.v) / waves);
        for (int k = 0; k < 2; k++)
          for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
              m[i][j] += stiffness[k] * c.own[k][i] * (c.own[k][j] - phase * c.other[k][j]);
      }
      largest = std::max(largest, largest_eigenvalue(m));
    }
  return largest;
}

double eigenvalue_of_the_limit(const Tiling &tiling, double kn, double ks) {
  const GrainShape shape(discs_of(tiling));
  const double radius = radius_of(shape, discs_of(tiling)), mass = shape.area() * radius * radius / M_PI;
  const double step = step_limit({shape, mass, 1, shape.inertia(), material(kn, ks, 0, 0, 0.5), {}});
  return 4 / (step * step);
}

// For discs, the largest eigenvalues are 6 kn + 2 ks (neighbours move against each other) and 24 ks (all turn alike).
TEST(StepLimit, LatticeOfDiscs) {
  for (double ks : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0}) {
    const double exact = std::max(6 + 2 * ks, 24 * ks);
    EXPECT_NEAR(lattice_eigenvalue(TILINGS[0], 1, ks), exact, 1e-9) << "ks " << ks;
    EXPECT_GT(eigenvalue_of_the_limit(TILINGS[0], 1, ks), exact * (1 - 1e-9)) << "ks " << ks;
    EXPECT_LT(eigenvalue_of_the_limit(TILINGS[0], 1, ks), exact * 1.16) << "ks " << ks;
  }
  EXPECT_NEAR(eigenvalue_of_the_limit(TILINGS[0], 1, 0), 6, 1e-9);
  EXPECT_NEAR(eigenvalue_of_the_limit(TILINGS[0], 1, 1), 24, 1e-9);
}

// The limit is on the safe side in every lattice of clumps: its eigenvalue is too large by a third at most, the step
// too small by 15 %.
TEST(StepLimit, LatticesOfClumps) {
  for (const Tiling &tiling : TILINGS)
    for (double ks : {0.0, 0.1, 0.25, 0.5, 1.0}) {
      const double exact = lattice_eigenvalue(tiling, 1, ks), limit = eigenvalue_of_the_limit(tiling, 1, ks);
      EXPECT_GT(limit, exact * (1 - 1e-9)) << tiling.name << ", ks " << ks;
      EXPECT_LT(limit, exact * 1.34) << tiling.name << ", ks " << ks;
    }
}

// A disc has six contacts in its lattice; a grain of two touching discs has 10, one of three has 12. Lever arms of
// three discs: the centre of the grain is at 2/sqrt(3) from that of each disc. The contacts of a disc lie at 30 and 90
// degrees on either side of the direction away from that centre. So per disc the squared levers are 4/3 (sin^2 30 +
// sin^2 90) 2 and ((1 + 2/sqrt(3) cos 30)^2 + 1) 2.
TEST(StepLimit, NeighboursAroundAGrain) {
  for (const Tiling &tiling : TILINGS) {
    const double neighbours[] = {6, 10, 12, 14, 18, 18};
    EXPECT_NEAR(GrainShape(discs_of(tiling)).neighbours(), neighbours[&tiling - TILINGS], 1e-9) << tiling.name;
  }
  const GrainShape triple = GrainShape::triple();
  const double radius = 1 + 2 / SQRT3;
  EXPECT_NEAR(triple.normal_levers() * radius * radius, 3 * 2 * 4.0 / 3 * 1.25, 1e-9);
  EXPECT_NEAR(triple.tangential_levers() * radius * radius, 3 * 2 * (4 + 1), 1e-9);
}

// With dashpots of the same form as the springs, c = g k, the scheme is stable while (dt^2 + 2 (1 + w) g dt) k < 4 m.
TEST(StepLimit, Dashpots) {
  EXPECT_DOUBLE_EQ((Mode{6, 0, 1.5}.step_limit()), 1);
  EXPECT_EQ((Mode{0, 0, 1}.step_limit()), INFINITY);
  const Mode mode{6, 0.3 * 6, 1.5};
  const double step = mode.step_limit();
  EXPECT_NEAR((step * step + 2 * 0.3 * step) * 6, 4 * 1.5, 1e-14);
  for (double share : {0.01, 0.3, 0.7, 0.9, 0.99}) {
    const double dt = share * step, w = mode.prediction_weight(dt);
    EXPECT_LE((dt * dt + 2 * (1 + w) * 0.3 * dt) * 6, 4 * 1.5) << share;
    EXPECT_TRUE(w > 0 && w <= 1) << share;
  }
  EXPECT_EQ(mode.prediction_weight(step / 2), 1);
  EXPECT_EQ(mode.prediction_weight(step), 0);

  // h for a disc: c = 2 h sqrt(k m/2), so g = 2 h sqrt(m/(2 k)).
  const double k = 1e8, m = 3e-4, h = 0.215, g = 2 * h * std::sqrt(m / 2 / k);
  const GrainShape disc = GrainShape::single();
  auto limit = [&](double ratio) { return step_limit({disc, m, 1, 0.5, material(k, 0, ratio, ratio, 0.5), {}}); };
  const double damped = limit(h);
  EXPECT_NEAR((damped * damped + 2 * g * damped) * 6 * k, 4 * m, 1e-12 * m);
  EXPECT_LT(damped, limit(0));
}

} // namespace
