// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of all instruction sets give the same bits. Without fused multiply-add, as this test is compiled, these
// are also the bits of the plain loop over doubles; kernels with it differ from the plain loop by rounding.
#include "core/column.h"
#include "core/disc_pairs.h"
#include "core/force_kernel.h"
#include "core/force_slots.h"
#include "core/law_table.h"
#include "core/laws.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <random>

namespace cdem {
Kernels kernels_baseline(const ContactRules &);
#if defined(__x86_64__)
Kernels kernels_avx2(const ContactRules &);
#endif
} // namespace cdem

using namespace cdem;

namespace {

constexpr double DT = 2e-7;

bool is_wall(int disc) { return disc % 5 == 0; }

// Discs of radius 1 mm on a jittered line. Neighbours overlap, are apart, or close or open within the step.
struct Scene {
  Column<Disc<double>> discs;
  Column<Body> bodies;
  Column<Travel> travel;
  DiscPairs pairs;
  ForceSlots slots;

  Scene(int n, const ContactRules &rules) {
    const LawTable law(rules);
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
    // Two blocks of discs. The pair between them belongs to the first block. The last disc is not summed.
    const int middle = n / 2 + 1;
    pairs.lay_out({material(1e8, 2.5e7, 0.215, 0.3, 0.5)}, {middle, n - middle},
                  {law.memories(), law.constants(), rules.books ? 2 + law.books() : 0});
    for (int pair = 0; pair < n; pair++) {
      const int k = pair < middle ? pair : pairs.segments[1].begin + pair - middle;
      pairs.set_discs(k, pair % 3 ? pair : pair + 1, pair % 3 ? pair + 1 : pair);
      const double gap = 2e-6 * unit(random), half_difference = 1e-4 * unit(random);
      pairs.set_constants(k, {2e-3 + gap, half_difference, 0.013});
      std::array<double, 1 + MOST_NUMBERS> remembered{};
      for (int m = 0; m <= law.memories(); m++)
        remembered[m] = unit(random);
      pairs.set_remembered(k, remembered.data());
      std::array<double, MOST_NUMBERS> constants{};
      for (int c = 0; c < law.constants(); c++)
        constants[c] = 1 + unit(random);
      pairs.set_law_constants(k, constants.data());
    }
    slots.build(
        pairs, {0, middle, n}, [](int row) { return row; }, is_wall);
  }

  void step(const Kernels &kernels) {
    Fastest fastest;
    PairColumns columns = pairs.columns(slots.data());
    for (int block = 0; block < slots.blocks(); block++) {
      columns.ahead = block ? Ahead{discs.data(), bodies.data()} : Ahead{}; // with and without prefetching
      for (int s = pairs.first_segment[block]; s < pairs.first_segment[block + 1]; s++)
        kernels.forces(discs.data(), columns, pairs.segments[s].material, pairs.segments[s].begin,
                       pairs.segments[s].end, DT);
      kernels.advance(slots.block(block), discs.data(), bodies.data(), {DT, DT / 2, 3, -10, 5, 0.2}, fastest,
                      travel.data());
    }
  }
};

template <class Law, bool books>
void plain_forces(const Disc<double> *discs, const PairColumns &p, const Material &m, int begin, int end, double dt) {
  for (int k = begin; k < end; k++) {
    PairGroup &g = p.groups[k / PairGroup::SIZE];
    const int lane = k % PairGroup::SIZE;
    const PairConstants<double> pair{g.radius_sum[lane], g.half_difference[lane], g.dashpot_scale[lane]};
    std::array<double, Law::MEMORIES> memory;
    for (std::size_t i = 0; i < memory.size(); i++)
      memory[i] = p.memories[i][k];
    std::array<double, Law::CONSTANTS> constants;
    for (std::size_t i = 0; i < constants.size(); i++)
      constants[i] = p.constants[i][k];
    typename Law::template Books<double> losses{};
    if (books) {
      losses = {p.friction[k], p.dashpots[k], p.last_dashpots[0][k], p.last_dashpots[1][k]};
      for (std::size_t i = 0; i < losses.more.size(); i++)
        losses.more[i] = p.last_dashpots[2 + i][k];
    }
    const auto u = relative(discs[g.a[lane] / PairGroup::ROW], discs[g.b[lane] / PairGroup::ROW]);
    const auto f = Law::force(u, distance_of(u), pair, constants, m, dt, g.es[lane], memory, losses);
    if (books) {
      p.friction[k] = losses.friction;
      p.dashpots[k] = losses.dashpots;
      p.last_dashpots[0][k] = losses.dashpot_n;
      p.last_dashpots[1][k] = losses.dashpot_t;
      for (std::size_t i = 0; i < losses.more.size(); i++)
        p.last_dashpots[2 + i][k] = losses.more[i];
    }
    p.slots[g.slot_a[lane] / PairGroup::SLOT] = f;
    p.slots[g.slot_b[lane] / PairGroup::SLOT] = opposite(f);
    for (std::size_t i = 0; i < memory.size(); i++)
      p.memories[i][k] = memory[i];
  }
}

// Sums the forces on all discs of a block, whose slots are in the order of the discs, and moves the discs: one value at
// a time.
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
      fx -= step.damping * std::copysign(fx, disc.vx_half);
      fy -= step.damping * std::copysign(fy, disc.vy_half);
      torque -= step.damping * std::copysign(torque, disc.omega_half);
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

Kernels plain(const ContactRules &rules) {
  const auto forces = with_law(rules, [&rules](auto law) {
    using Law = decltype(law);
    return rules.books ? plain_forces<Law, true> : plain_forces<Law, false>;
  });
  return {forces, nullptr, nullptr, nullptr, plain_advance};
}

// The rules of all laws.
std::vector<ContactRules> all_rules() {
  std::vector<ContactRules> all;
  for (int accumulation = 0; accumulation < ACCUMULATIONS; accumulation++)
    for (unsigned additions = 0; additions < 1u << ADDITIONS; additions++)
      for (bool limit : {false, true})
        for (bool books : {false, true})
          all.push_back({accumulation, additions, limit, books});
  return all;
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
        EXPECT_EQ(expected.pairs.remembered(k), got.pairs.remembered(k)) << n << " pairs";
        if (rules.books) {
          EXPECT_EQ(expected.pairs.friction[k], got.pairs.friction[k]) << n << " pairs";
          EXPECT_EQ(expected.pairs.dashpots[k], got.pairs.dashpots[k]) << n << " pairs";
          EXPECT_EQ(expected.pairs.last_dashpots_of(k), got.pairs.last_dashpots_of(k)) << n << " pairs";
        }
      }
  }
}

} // namespace

TEST(ForceKernel, BaselineHasTheBitsOfThePlainLoop) {
  for (const ContactRules &rules : all_rules())
    compare(plain(rules), kernels_baseline(rules), rules);
}

TEST(ForceKernel, BooksDoNotChangeTheForces) {
  for (ContactRules rules : all_rules()) {
    if (!rules.books)
      continue;
    Scene with(1000, rules), without(1000, rules);
    const Kernels with_books = kernels(rules, instruction_sets().front());
    rules.books = false;
    const Kernels without_books = kernels(rules, instruction_sets().front());
    for (int step = 0; step < 3; step++) {
      with.step(with_books);
      without.step(without_books);
    }
    EXPECT_TRUE(same_bits(with.discs, without.discs, 1000)) << rules.accumulation << ' ' << rules.additions;
  }
}

TEST(ForceKernel, AnAdditionOfZeroChangesNothing) {
  for (ContactRules rules : all_rules()) {
    if (!rules.additions)
      continue;
    Scene none(1000, rules), zero(1000, rules);
    const std::array<double, MOST_NUMBERS> constants{};
    for (const auto &segment : zero.pairs.segments)
      for (int k = segment.begin; k < segment.end; k++)
        zero.pairs.set_law_constants(k, constants.data());
    zero.step(kernels(rules, instruction_sets().front()));
    rules.additions = 0;
    none.step(kernels(rules, instruction_sets().front()));
    for (int i = 0; i < 1000; i++) {
      EXPECT_EQ(none.discs[i].vx, zero.discs[i].vx);
      EXPECT_EQ(none.discs[i].omega, zero.discs[i].omega);
    }
  }
}

TEST(ForceKernel, FusedOnesDifferByRoundingOnly) {
  Scene expected(1000, {}), got(1000, {});
  expected.step(plain({}));
  got.step(kernels({}, instruction_sets().front()));
  for (int i = 0; i < 1000; i++) {
    EXPECT_NEAR(expected.discs[i].vx, got.discs[i].vx, 1e-11) << i;
    EXPECT_NEAR(expected.discs[i].vy, got.discs[i].vy, 1e-11) << i;
    EXPECT_NEAR(expected.discs[i].omega, got.discs[i].omega, 1e-8) << i;
  }
}

#if defined(__x86_64__)
TEST(ForceKernel, Avx2AndAvx512HaveTheSameBits) {
  if (instruction_sets().front() != "avx512")
    GTEST_SKIP() << "no AVX-512 here";
  for (const ContactRules &rules : all_rules())
    compare(kernels_avx2(rules), kernels(rules, "avx512"), rules);
}
#endif
