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
Kernels kernels_baseline(Law, bool limit_damping);
#if defined(__x86_64__)
Kernels kernels_avx2(Law, bool limit_damping);
Kernels kernels_avx512(Law, bool limit_damping);
#endif
} // namespace cdem

using namespace cdem;

namespace {

constexpr double DT = 2e-7;

// Discs of 1 mm on a jittered line, each pair of neighbours overlapping, apart, closing or opening within the step.
struct Scene {
  Column<Disc<double>> discs;
  Column<Body> bodies;
  DiscPairs pairs;
  ForceSlots slots;

  Scene(int n, Law law) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i <= n; i++) {
      Disc<double> d{};
      d.x = 2e-3 * i + 1e-6 * unit(random), d.y = 1e-6 * unit(random);
      d.vx_half = 3 * unit(random), d.vy_half = unit(random), d.omega_half = 100 * unit(random);
      d.vx = d.vx_half + 0.1 * unit(random), d.vy = d.vy_half + 0.1 * unit(random), d.omega = d.omega_half;
      discs.push_back(d);
      bodies.push_back({unit(random), 1e-4, 1e4, 1e10});
    }
    // Two blocks of discs; the pair between them belongs to the first, and the last disc is not summed.
    const int middle = n / 2 + 1;
    pairs.lay_out({material(1e8, 2.5e7, 0.215, 0.3, 0.5)}, {middle, n - middle}, law);
    for (int pair = 0; pair < n; pair++) {
      const int k = pair < middle ? pair : pairs.segments[1].begin + pair - middle;
      pairs.a[k] = pair % 3 ? pair : pair + 1;
      pairs.b[k] = pair % 3 ? pair + 1 : pair;
      pairs.radius_sum[k] = 2e-3 + 2e-6 * unit(random);
      pairs.half_difference[k] = 1e-4 * unit(random);
      pairs.root_mass[k] = 0.013;
      pairs.es[k] = unit(random);
      if (law == Law::incremental)
        pairs.en[k] = unit(random);
    }
    slots.build(pairs, {0, middle, n}, std::less<int>());
  }

  void step(const Kernels &kernels) {
    Fastest fastest;
    const PairColumns columns = pairs.columns(slots.data());
    for (int block = 0; block < slots.blocks(); block++) {
      for (int s = pairs.first_segment[block]; s < pairs.first_segment[block + 1]; s++)
        kernels.forces(discs.data(), columns, pairs.segments[s].material, pairs.segments[s].begin,
                       pairs.segments[s].end, DT);
      kernels.advance[1](slots.block(block), discs.data(), bodies.data(), {DT, DT / 2, 3, -10, 5}, fastest);
    }
  }
};

template <Law law, bool limit>
void plain_forces(const Disc<double> *discs, const PairColumns &p, const Material &m, int begin, int end, double dt) {
  for (int k = begin; k < end; k++) {
    const Pair<double> pair{p.radius_sum[k], p.half_difference[k], p.root_mass[k]};
    History<double> history{p.es[k], law == Law::incremental ? p.en[k] : 0};
    const auto f = contact_force<law, limit, double>(relative(discs[p.a[k]], discs[p.b[k]]), pair, m, dt, history);
    p.slots[p.slot_a[k]] = f;
    p.slots[p.slot_b[k]] = opposite(f);
    p.es[k] = history.es;
    if (law == Law::incremental)
      p.en[k] = history.en;
  }
}

// All discs of a block, whose slots lie in their order, one value at a time.
void plain_advance(const SlotBlock &block, Disc<double> *discs, Body *bodies, const StepRule &step, Fastest &) {
  const Forces<double> *slot = block.slots;
  for (const SlotRun *run = block.begin; run != block.end; ++run)
    for (int d = run->begin; d < run->end; d++) {
      double fx = 0, fy = 0, torque = 0;
      for (int s = 0; s < run->count; s++, slot++)
        fx += slot->fx, fy += slot->fy, torque += slot->torque_a;
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
    }
}

template <Law law, bool limit> Kernels plain() {
  return {plain_forces<law, limit>, nullptr, nullptr, {}, {plain_advance, plain_advance}};
}

template <class T> bool same_bits(const Column<T> &a, const Column<T> &b, int n) {
  return std::memcmp(a.data(), b.data(), n * sizeof(T)) == 0;
}

void compare(const Kernels &expected_by, const Kernels &got_by, Law law) {
  for (int n : {2, 3, 8, 13, 1000}) {
    Scene expected(n, law), got(n, law);
    for (int step = 0; step < 3; step++) {
      expected.step(expected_by);
      got.step(got_by);
    }
    EXPECT_TRUE(same_bits(expected.discs, got.discs, n)) << n << " pairs";
    EXPECT_TRUE(same_bits(expected.bodies, got.bodies, n)) << n << " pairs";
    for (const auto &segment : got.pairs.segments)
      for (int k = segment.begin; k < segment.end; k++) {
        EXPECT_EQ(expected.pairs.es[k], got.pairs.es[k]) << n << " pairs";
        if (law == Law::incremental) {
          EXPECT_EQ(expected.pairs.en[k], got.pairs.en[k]) << n << " pairs";
        }
      }
  }
}

} // namespace

TEST(ForceKernel, BaselineHasTheBitsOfThePlainLoop) {
  compare(plain<Law::direct, false>(), kernels_baseline(Law::direct, false), Law::direct);
  compare(plain<Law::direct, true>(), kernels_baseline(Law::direct, true), Law::direct);
  compare(plain<Law::incremental, false>(), kernels_baseline(Law::incremental, false), Law::incremental);
  compare(plain<Law::incremental, true>(), kernels_baseline(Law::incremental, true), Law::incremental);
}

TEST(ForceKernel, FusedOnesDifferByRoundingOnly) {
  Scene expected(1000, Law::direct), got(1000, Law::direct);
  expected.step(plain<Law::direct, false>());
  got.step(kernels(Law::direct, false, instruction_sets().front()));
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
      compare(kernels_avx2(law, limit), kernels_avx512(law, limit), law);
}
#endif
