// SPDX-License-Identifier: GPL-2.0-or-later
// Time of the two loops of a step alone, for every instruction set of this machine, on a triangular packing of discs:
//
//   cmake --build build --target kernel_benchmark && taskset -c 0 build/kernel_benchmark
//
// "forces" is the time per pair, "advance" (sum the forces of a disc and move it) the time per disc: items_per_second.
#include "core/force_kernel.h"

#include <benchmark/benchmark.h>

#include <functional>

using namespace cdem;

namespace {

constexpr double DT = 2e-7, RADIUS = 1.5e-3, OVERLAP = 1e-8;
constexpr int BLOCK = 512;

struct Packing {
  Column<Disc<double>> discs;
  Column<Body> bodies;
  DiscPairs pairs;
  ForceSlots slots;
  int count = 0;

  explicit Packing(int side) {
    const int n = side * side;
    std::vector<int> starts;
    for (int first = 0; first < n; first += BLOCK)
      starts.push_back(first);
    starts.push_back(n);
    std::vector<int> sizes(starts.size() - 1, 0), next(sizes.size());
    for_each_pair(side, [&](int i, int) { sizes[i / BLOCK]++; });
    pairs.lay_out({material(1e8, 2.5e7, 0.215, 0.215, 0.5)}, sizes, {});
    for (std::size_t k = 0; k < sizes.size(); k++)
      next[k] = pairs.segments[k].begin;
    for_each_pair(side, [&](int i, int j) {
      const int k = next[i / BLOCK]++;
      pairs.set_discs(k, i, j);
      pairs.set_constants(k, {2 * RADIUS, 0, 0.013});
      count++;
    });
    slots.build(
        pairs, starts, [](int row) { return row; }, [](int) { return false; });
    const double distance = 2 * RADIUS - OVERLAP;
    for (int i = 0; i < n; i++) {
      const int row = i / side, column = i % side;
      discs.push_back({distance * (column + 0.5 * (row % 2)), distance * row * std::sqrt(0.75), 0, 0, 0, 0, 0, 0});
      bodies.push_back({0, 0, 0, 0}); // too heavy to move
    }
  }

  // Right, and the two above.
  template <class Visit> static void for_each_pair(int side, Visit visit) {
    for (int i = 0; i < side * side; i++) {
      const int row = i / side, column = i % side, left = column - 1 + row % 2;
      if (column + 1 < side)
        visit(i, i + 1);
      for (int above = left; above <= left + 1; above++)
        if (row + 1 < side && above >= 0 && above < side)
          visit(i, (row + 1) * side + above);
    }
  }
};

void time_forces(benchmark::State &state, const std::string &instructions) {
  Packing p(int(state.range(0)));
  const Kernels k = kernels({}, instructions);
  const PairColumns columns = p.pairs.columns(p.slots.data());
  for (auto _ : state)
    for (const auto &s : p.pairs.segments)
      k.forces(p.discs.data(), columns, s.material, s.begin, s.end, DT);
  state.SetItemsProcessed(state.iterations() * p.count);
}

void time_advance(benchmark::State &state, const std::string &instructions) {
  Packing p(int(state.range(0)));
  const Kernels k = kernels({}, instructions);
  Fastest fastest;
  for (auto _ : state)
    for (int block = 0; block < p.slots.blocks(); block++)
      k.advance(p.slots.block(block), p.discs.data(), p.bodies.data(), {DT, DT / 2}, fastest, nullptr);
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0));
}

} // namespace

int main(int argc, char **argv) {
  for (const std::string &name : instruction_sets()) {
    benchmark::RegisterBenchmark(("forces/" + name).c_str(), time_forces, name)->Arg(40);
    benchmark::RegisterBenchmark(("advance/" + name).c_str(), time_advance, name)->Arg(40);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 1;
  benchmark::RunSpecifiedBenchmarks();
}
