// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of all instruction sets give the same bits. Without fused multiply-add, as here in the test, these are
// those of the plain loop over doubles; with it they differ from these by rounding.
#include "core/column.h"
#include "core/disc_pairs.h"
#include "core/force_kernel.h"
#include "core/force_slots.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <random>

namespace cdem {
Kernels kernels_baseline(const ContactRules &);
#if defined(__x86_64__)
Kernels kernels_avx2(const ContactRules &);
Kernels kernels_avx512(const ContactRules &);
#endif
} // namespace cdem

using namespace cdem;

namespace {

constexpr double DT = 2e-7;

bool is_wall(int disc) { return disc % 5 == 0; }

// Discs of 1 mm on a jittered line, each pair of neighbours overlapping, apart, closing or opening within the step.
struct Scene {
  Column<Disc<double>> discs;
  Column<Body> bodies;
  Column<Travel> travel;
  DiscPairs pairs;
  ForceSlots slots;

  Scene(int n, const ContactRules &rules) {
    const Law law = rules.law;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i <= n; i++) {
      Disc<double> d{};
      d.x = 2e-3 * i + 1e-6 * unit(random), d.y = 1e-6 * unit(random);
      d.vx_half = 3 * unit(random), d.vy_half = unit(random), d.omega_half = 100 * unit(random);
      d.vx = d.vx_half + 0.1 * unit(random), d.vy = d.vy_half + 0.1 * unit(random), d.omega = d.omega_half;
      discs.push_back(d);
      bodies.push_back({unit(random), 1e-4, 1e4, 1e10});
      travel.push_back({});
    }
    // Two blocks of discs; the pair between them belongs to the first, and the last disc is not summed.
    const int middle = n / 2 + 1;
    pairs.lay_out({material(1e8, 2.5e7, 0.215, 0.3, 0.5)}, {middle, n - middle}, law, rules.books);
    for (int pair = 0; pair < n; pair++) {
      const int k = pair < middle ? pair : pairs.segments[1].begin + pair - middle;
      pairs.set_discs(k, pair % 3 ? pair : pair + 1, pair % 3 ? pair + 1 : pair);
      const double gap = 2e-6 * unit(random), half_difference = 1e-4 * unit(random);
      pairs.set_constants(k, {2e-3 + gap, half_difference, 0.013});
      pairs.set_es(k, unit(random));
      if (law == Law::incremental)
        pairs.en[k] = unit(random);
    }
    slots.build(
        pairs, {0, middle, n}, [](int row) { return row; }, is_wall);
  }

  void step(const Kernels &kernels) {
    Fastest fastest;
    PairColumns columns = pairs.columns(slots.data());
    for (int block = 0; block < slots.blocks(); block++) {
      columns.ahead = block ? Ahead{discs.data(), bodies.data()} : Ahead{}; // both loops
      for (int s = pairs.first_segment[block]; s < pairs.first_segment[block + 1]; s++)
        kernels.forces(discs.data(), columns, pairs.segments[s].material, pairs.segments[s].begin,
                       pairs.segments[s].end, DT);
      kernels.advance(slots.block(block), discs.data(), bodies.data(), {DT, DT / 2, 3, -10, 5}, fastest, travel.data());
    }
  }
};

template <Law law, bool limit, bool books>
void plain_forces(const Disc<double> *discs, const PairColumns &p, const Material &m, int begin, int end, double dt) {
  for (int k = begin; k < end; k++) {
    PairGroup &g = p.groups[k / PairGroup::SIZE];
    const int lane = k % PairGroup::SIZE;
    const Pair<double> pair{g.radius_sum[lane], g.half_difference[lane], g.root_mass[lane]};
    History<double> history{g.es[lane], law == Law::incremental ? p.en[k] : 0};
    Losses<double> losses{};
    if (books)
      losses = {p.friction[k], p.dashpots[k], p.dashpot_n[k], p.dashpot_t[k]};
    const auto u = relative(discs[g.a[lane] / PairGroup::ROW], discs[g.b[lane] / PairGroup::ROW]);
    const auto f = contact_force<law, limit>(u, distance_of(u), pair, m, dt, history, losses);
    if (books) {
      p.friction[k] = losses.friction;
      p.dashpots[k] = losses.dashpots;
      p.dashpot_n[k] = losses.dashpot_n;
      p.dashpot_t[k] = losses.dashpot_t;
    }
    p.slots[g.slot_a[lane] / PairGroup::SLOT] = f;
    p.slots[g.slot_b[lane] / PairGroup::SLOT] = opposite(f);
    g.es[lane] = history.es;
    if (law == Law::incremental)
      p.en[k] = history.en;
  }
}

// All discs of a block, whose slots lie in their order, one value at a time.
void plain_advance(const SlotBlock &block, Disc<double> *discs, Body *bodies, const StepRule &step, Fastest &,
                   Travel *travel) {
  const Forces<double> *slot = block.slots;
  for (const SlotRun *run = block.begin; run != block.end; ++run)
    for (int d = run->begin; d < run->end; d++) {
      double fx = 0, fy = 0, torque = 0;
      for (int s = 0; s < run->count; s++, slot++)
        fx += slot->fx, fy += slot->fy, torque += slot->torque_a;
      if (is_wall(block.order[d]))
        continue;
      Disc<double> &disc = discs[block.order[d]];
      Body &body = bodies[block.order[d]];
      fx += body.mass * (step.gx - step.drag * disc.vx_half);
      fy += body.mass * (step.gy - step.drag * disc.vy_half);
      const double ax = fx * body.inverse_mass, ay = fy * body.inverse_mass, alpha = torque * body.inverse_inertia;
      for (int half = 0; half < 2; half++) {
        disc.vx_half += 0.5 * step.dt * ax;
        disc.vy_half += 0.5 * step.dt * ay;
        disc.omega_half += 0.5 * step.dt * alpha;
      }
      disc.x += step.dt * disc.vx_half;
      disc.y += step.dt * disc.vy_half;
      body.angle += step.dt * disc.omega_half;
      disc.vx = disc.vx_half + step.forward * ax;
      disc.vy = disc.vy_half + step.forward * ay;
      disc.omega = disc.omega_half + step.forward * alpha;
      Travel &t = travel[block.order[d]];
      t.path += step.dt * std::sqrt(disc.vx_half * disc.vx_half + disc.vy_half * disc.vy_half);
      t.turned += step.dt * std::fabs(disc.omega_half);
    }
}

template <Law law, bool limit, bool books> Kernels plain() {
  return {plain_forces<law, limit, books>, nullptr, nullptr, nullptr, plain_advance};
}

template <class T> bool same_bits(const Column<T> &a, const Column<T> &b, int n) {
  return std::memcmp(a.data(), b.data(), n * sizeof(T)) == 0;
}

void compare(const Kernels &expected_by, const Kernels &got_by, const ContactRules &rules) {
  for (int n : {2, 3, 8, 13, 1000}) {
    Scene expected(n, rules), got(n, rules);
    for (int step = 0; step < 3; step++) {
      expected.step(expected_by);
      got.step(got_by);
    }
    EXPECT_TRUE(same_bits(expected.discs, got.discs, n)) << n << " pairs";
    EXPECT_TRUE(same_bits(expected.bodies, got.bodies, n)) << n << " pairs";
    EXPECT_TRUE(same_bits(expected.travel, got.travel, n)) << n << " pairs";
    for (const auto &segment : got.pairs.segments)
      for (int k = segment.begin; k < segment.end; k++) {
        EXPECT_EQ(expected.pairs.es(k), got.pairs.es(k)) << n << " pairs";
        if (rules.law == Law::incremental) {
          EXPECT_EQ(expected.pairs.en[k], got.pairs.en[k]) << n << " pairs";
        }
        if (rules.books) {
          EXPECT_EQ(expected.pairs.friction[k], got.pairs.friction[k]) << n << " pairs";
          EXPECT_EQ(expected.pairs.dashpots[k], got.pairs.dashpots[k]) << n << " pairs";
        }
      }
  }
}

} // namespace

TEST(ForceKernel, BaselineHasTheBitsOfThePlainLoop) {
  auto check = [](const Kernels &plain, const ContactRules &rules) { compare(plain, kernels_baseline(rules), rules); };
  check(plain<Law::direct, false, false>(), {Law::direct, false, false});
  check(plain<Law::direct, false, true>(), {Law::direct, false, true});
  check(plain<Law::direct, true, true>(), {Law::direct, true, true});
  check(plain<Law::incremental, false, false>(), {Law::incremental, false, false});
  check(plain<Law::incremental, true, false>(), {Law::incremental, true, false});
  check(plain<Law::incremental, true, true>(), {Law::incremental, true, true});
}

TEST(ForceKernel, BooksDoNotChangeTheForces) {
  Scene with(1000, {Law::direct, false, true}), without(1000, {});
  for (int step = 0; step < 3; step++) {
    with.step(kernels({Law::direct, false, true}, instruction_sets().front()));
    without.step(kernels({}, instruction_sets().front()));
  }
  EXPECT_TRUE(same_bits(with.discs, without.discs, 1000));
}

TEST(ForceKernel, FusedOnesDifferByRoundingOnly) {
  Scene expected(1000, {}), got(1000, {});
  expected.step(plain<Law::direct, false, false>());
  got.step(kernels({}, instruction_sets().front()));
  for (int i = 0; i < 1000; i++) {
    EXPECT_NEAR(expected.discs[i].vx, got.discs[i].vx, 1e-11) << i;
    EXPECT_NEAR(expected.discs[i].vy, got.discs[i].vy, 1e-11) << i;
    EXPECT_NEAR(expected.discs[i].omega, got.discs[i].omega, 1e-8) << i;
  }
}

#if defined(__x86_64__)
TEST(ForceKernel, Avx2AndAvx512HaveTheSameBits) {
  if (!__builtin_cpu_supports("avx512vl"))
    GTEST_SKIP() << "no AVX-512 here";
  for (Law law : {Law::direct, Law::incremental})
    for (bool limit : {false, true})
      for (bool books : {false, true})
        compare(kernels_avx2({law, limit, books}), kernels_avx512({law, limit, books}), {law, limit, books});
}
#endif
