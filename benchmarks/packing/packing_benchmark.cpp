// SPDX-License-Identifier: BSD-3-Clause
//
// Packings: making, tiling, checking and reading them. `error`: the largest overlap over the smaller radius, or 0, for
// a generator; the largest difference of a coordinate, in units of the box, for a copy or a reader. `failed`: packings
// that came out with another number of grains, a solid fraction off by more than 1e-12, or an overlap.

#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/io/write_packing.hpp"
#include "tetrapore/packing.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace {

using namespace tetrapore;

/// Walls cost space: 1,000 grains between them jam below 0.60.
constexpr double solid(std::size_t n, bool periodic) { return periodic || n >= 10000 ? 0.60 : 0.57; }

packing make(std::size_t n, bool periodic, std::uint64_t seed) {
  return random_packing(
      uniform_radii(n, 1e-3, 0.3),
      {.solid_fraction = solid(n, periodic), .periodic = {periodic, periodic, periodic}, .seed = seed});
}

void count_faults(benchmark::State& state, const packing& p, std::size_t n) {
  const double wanted = solid(n, p.periodic[0]);
  const auto overlap = largest_overlap(p);
  const double worst = std::max({overlap.grains, overlap.walls, 0.0});
  const bool wrong = p.grains.size() != n || !(std::abs(solid_fraction(p) - wanted) < 1e-12) || worst > 0;
  state.counters["error"] = worst;
  state.counters["failed"] = wrong ? 1 : 0;
}

void random_walled(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  packing p;
  std::uint64_t seed = 1;
  for (auto _ : state) {
    p = make(n, false, seed++);
  }
  count_faults(state, p, n);
}
BENCHMARK(random_walled)->Arg(1000)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond)->Iterations(1);

void random_periodic(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  packing p;
  std::uint64_t seed = 1;
  for (auto _ : state) {
    p = make(n, true, seed++);
  }
  count_faults(state, p, n);
}
BENCHMARK(random_periodic)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond)->Iterations(1);

void tiling(benchmark::State& state) {
  const auto p = make(1000, true, 1);
  const auto k = static_cast<std::size_t>(state.range(0)) / 10000;
  packing large;
  for (auto _ : state) {
    large = tile(p, {10, k, 1});
    benchmark::DoNotOptimize(large.grains.data());
  }
  double worst = 0;
  for (std::size_t i = 0; i < large.grains.size(); ++i) {  // back into the first copy, where each grain has its origin
    const auto& g = p.grains[i % p.grains.size()];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double length = p.bounds->size()[axis];
      const double laps = (large.grains[i].centre[axis] - g.centre[axis]) / length;
      worst = std::max(worst, std::abs(laps - std::round(laps)));
    }
  }
  state.counters["error"] = worst;
  state.counters["failed"] = large.grains.size() != 10 * k * p.grains.size();
}
BENCHMARK(tiling)->Arg(10000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);

void checking(benchmark::State& state) {
  const auto p = tile(make(1000, true, 1), {static_cast<std::size_t>(state.range(0)) / 1000, 1, 1});
  std::size_t failed = 0;
  for (auto _ : state) {
    try {
      check(p);
    } catch (const packing_error&) {
      ++failed;
    }
  }
  state.counters["error"] = 0;
  state.counters["failed"] = static_cast<double>(failed);
}
BENCHMARK(checking)->Arg(40000)->Arg(1000000)->Unit(benchmark::kMillisecond);

void reading_text(benchmark::State& state) {
  const auto p = tile(make(1000, true, 1), {static_cast<std::size_t>(state.range(0)) / 1000, 1, 1});
  const auto text = io::packing_text(p);
  io::read_result r;
  for (auto _ : state) {
    r = io::read_packing_from_memory(text, "packing.txt");
  }
  double worst = 0;
  const bool complete = r.packing.grains.size() == p.grains.size();
  for (std::size_t i = 0; complete && i < p.grains.size(); ++i) {
    worst = std::max(worst, norm(r.packing.grains[i].centre - p.grains[i].centre) / p.bounds->size().x);
  }
  state.counters["error"] = worst;
  state.counters["failed"] = complete ? 0 : 1;
  state.SetBytesProcessed(static_cast<std::int64_t>(text.size()) * static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(reading_text)->Arg(10000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);

}  // namespace
