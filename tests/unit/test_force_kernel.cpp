// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of all instruction sets give the bits of the plain loop over doubles.
#include "core/column.h"
#include "core/disc_pairs.h"
#include "core/force_kernel.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace cdem {
ForceKernel force_kernel_baseline(Law, bool limit_damping);
#if defined(__x86_64__)
ForceKernel force_kernel_avx2(Law, bool limit_damping);
ForceKernel force_kernel_avx512(Law, bool limit_damping);
#endif
} // namespace cdem

using namespace cdem;

namespace {

constexpr double DT = 2e-7;

// Discs of 1 mm on a jittered line, each pair of neighbours overlapping, apart, closing or opening within the step.
struct Scene {
  Column<Disc<double>> discs;
  DiscPairs pairs;

  explicit Scene(int n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i <= n; i++) {
      Disc<double> d{};
      d.x = 2e-3 * i + 1e-6 * unit(random), d.y = 1e-6 * unit(random);
      d.vx_half = 3 * unit(random), d.vy_half = unit(random), d.omega_half = 100 * unit(random);
      d.vx = d.vx_half + 0.1 * unit(random), d.vy = d.vy_half + 0.1 * unit(random), d.omega = d.omega_half;
      discs.push_back(d);
    }
    pairs.lay_out({material(1e8, 2.5e7, 0.215, 0.3, 0.5)}, {n});
    for (int k = 0; k < n; k++) {
      pairs.a[k] = k;
      pairs.b[k] = k + 1;
      pairs.radius_sum[k] = 2e-3 + 2e-6 * unit(random);
      pairs.radius_difference[k] = 1e-4 * unit(random);
      pairs.root_mass[k] = 0.013;
      pairs.es[k] = unit(random);
      pairs.en[k] = unit(random);
    }
  }
};

template <Law law, bool limit> void plain(Scene &s) {
  for (int k = 0; k < s.pairs.segments[0].end; k++) {
    DiscPairs &p = s.pairs;
    const Pair<double> pair{p.radius_sum[k], p.radius_difference[k], p.root_mass[k]};
    History<double> history{p.es[k], p.en[k]};
    p.force[k] = contact_force<law, limit, double>(relative(s.discs[p.a[k]], s.discs[p.b[k]]), pair,
                                                   p.segments[0].material, DT, history);
    p.es[k] = history.es;
    if (law == Law::incremental)
      p.en[k] = history.en;
  }
}

template <class T> bool same_bits(const Column<T> &a, const Column<T> &b, int n) {
  return std::memcmp(a.data(), b.data(), n * sizeof(T)) == 0;
}

template <Law law, bool limit> void compare(ForceKernel kernel) {
  for (int n : {1, 3, 8, 13, 1000}) {
    Scene expected(n), got(n);
    plain<law, limit>(expected);
    got.pairs.compute_forces(kernel, got.discs.data(), DT);
    EXPECT_TRUE(same_bits(expected.pairs.force, got.pairs.force, n)) << n << " pairs";
    EXPECT_TRUE(same_bits(expected.pairs.es, got.pairs.es, n)) << n << " pairs";
    EXPECT_TRUE(same_bits(expected.pairs.en, got.pairs.en, n)) << n << " pairs";
  }
}

void compare_all(ForceKernel (*kernel)(Law, bool)) {
  compare<Law::direct, false>(kernel(Law::direct, false));
  compare<Law::direct, true>(kernel(Law::direct, true));
  compare<Law::incremental, false>(kernel(Law::incremental, false));
  compare<Law::incremental, true>(kernel(Law::incremental, true));
}

} // namespace

TEST(ForceKernel, BaselineHasTheBitsOfThePlainLoop) { compare_all(force_kernel_baseline); }

TEST(ForceKernel, ChosenOneHasTheBitsOfThePlainLoop) { compare_all(force_kernel); }

#if defined(__x86_64__)
TEST(ForceKernel, Avx2HasTheBitsOfThePlainLoop) {
  if (!__builtin_cpu_supports("avx2"))
    GTEST_SKIP() << "no AVX2 here";
  compare_all(force_kernel_avx2);
}

TEST(ForceKernel, Avx512HasTheBitsOfThePlainLoop) {
  if (!__builtin_cpu_supports("avx512vl"))
    GTEST_SKIP() << "no AVX-512 here";
  compare_all(force_kernel_avx512);
}
#endif
