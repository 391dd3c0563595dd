// SPDX-License-Identifier: BSD-3-Clause
//
// Entry pressure of throats from the first state to the last bracket, one after the other and two side by side.
// `updates` is the effort of a throat; `error` is the distance of the corrected value from Surface Evolver's.
#include "tetrapore/lbm/entry_experiment.hpp"
#include "tetrapore/lbm/farm.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace tetrapore;

namespace {

lbm::entry_set_up equal_spheres(double gap, double inscribed) {
  lbm::entry_set_up s;
  s.throat = opening_from_distances<double>(1, 1, 1, 2 + gap, 2 + gap, 2 + gap).value;
  s.nodes_per_length = inscribed / lbm::plane_entry_of(s.throat, s.sides).inscribed;
  return s;
}

lbm::entry_result measured(const lbm::entry_set_up& s) {
  lbm::entry_experiment<float> experiment(s);
  lbm::threshold_search search(experiment.bracket());
  run(experiment, search);
  return experiment.result(search);
}

/// θ = 0. The truth is Surface Evolver's (tests/truth/se_results.csv): touching, its value at 20 degrees, ± 1.8 %; gap
/// 0.4 R, from 20 and 40 degrees by a line in the square of the angle, ± 0.2 %.
void one_throat(benchmark::State& state, double gap, double truth) {
  const lbm::entry_set_up s = equal_spheres(gap, 4);
  lbm::entry_result found{};
  for (auto _ : state) {
    found = measured(s);
  }
  state.counters["updates"] = static_cast<double>(found.updates);
  state.counters["mlups"] =
      benchmark::Counter(1e-6 * static_cast<double>(found.updates), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["error"] = std::abs(found.value / lbm::plane_entry_of(s.throat, s.sides).best / truth - 1);
  state.counters["failed"] = verdict_of(found.end) == verdict::ok ? 0 : 1;
}

/// As many equal throats as threads: `throats_per_second` is to grow with them.
void side_by_side(benchmark::State& state) {
  const auto throats = static_cast<std::size_t>(state.range(0));
  const lbm::entry_set_up s = equal_spheres(0.4, 4);
  std::array<double, 16> value{};
  for (auto _ : state) {
    lbm::farm(
        throats, [&](std::size_t k) { value[k] = measured(s).value; }, throats);
  }
  state.counters["throats_per_second"] =
      benchmark::Counter(static_cast<double>(throats), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["error"] = 0;
  state.counters["failed"] = 0;
  for (std::size_t k = 1; k < throats; ++k) {
    state.counters["error"] = std::max(state.counters["error"].value, std::abs(value[k] / value[0] - 1));
    state.counters["failed"] += value[k] == value[0] ? 0 : 1;  // to the last bit
  }
}

}  // namespace

BENCHMARK_CAPTURE(one_throat, touching_large, 0.0, 1.0)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK_CAPTURE(one_throat, gap, 0.4, 0.994)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK(side_by_side)->Arg(1)->Arg(2)->Unit(benchmark::kSecond)->UseRealTime();
