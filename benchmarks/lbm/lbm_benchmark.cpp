// SPDX-License-Identifier: BSD-3-Clause
//
// Steps of a two-component fluid (d3q19, BGK, velocity shift) on periodic boxes and in a throat of about 45,000 nodes;
// items are updates of a fluid node, both components. `error` is the relative drift of the mass of a component; in the
// throat, which reservoirs feed, the worst difference of densities to the two-lattice reference after ten steps.
// `failed` counts nodes whose density is no number.
//
// Roofline: an update reads and writes each number that is kept of a node once. `of_roofline` is the share that this
// traffic has in what the machine reads and writes in place on an array of the same size, measured beside the row; the
// rows `bandwidth_…` show that and a plain copy. Boxes that fit in the cache are measured against the cache.

#include "tetrapore/lbm/moments.hpp"
#include "tetrapore/lbm/simulation.hpp"
#include "tetrapore/lbm/throat.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

template <class T>
using numbers = tetrapore::lbm::detail::aligned_vector<T>;
using fluid = mixture<d3q19, bgk>;
using clock_type = std::chrono::steady_clock;

fluid repelling() {
  fluid m;
  m.attraction = {{{0, 1.8}, {1.8, 0}}};
  m.reference = {1, 1};
  return m;
}

site_map<d3q19> periodic(int n) {
  constexpr auto kind = face_kind::periodic;
  return {{{n, n, n}, {kind, kind, kind}, {kind, kind, kind}}, [](int, int, int) { return site{}; }};
}

site_map<d3q19> box() { return periodic(32); }
site_map<d3q19> large_box() { return periodic(128); }

/// Three grains that touch, the film's room between them and the lattice's walls.
site_map<d3q19> throat() {
  constexpr double radius = 28.5;
  opening<double> o;
  o.add_disc({0, 0}, radius);
  o.add_disc({2 * radius, 0}, radius);
  o.add_disc({radius, std::sqrt(3.0) * radius}, radius);
  const throat_on_lattice t(o, {prism_side::mirror, prism_side::mirror, prism_side::mirror},
                            {1, 1.1, 1.1 * radius, 1.1 * radius});
  return t.sites<d3q19>();
}

/// One component above, the other below.
template <class Simulation>
void fill(Simulation& s) {
  const double middle = 0.5 * s.sites().box().size[2];
  s.set_wall(grain_wall, {0.03, 1});
  s.set_reservoir(reservoir_below, {0.03, 1});
  s.set_reservoir(reservoir_above, {1, 0.03});
  s.initialise([&](const std::array<int, 3>& p, auto& rho, auto&) {
    const double share = 0.5 * (1 + std::tanh((p[2] - middle) / 1.5));
    rho = {0.03 + 0.97 * share, 1 - 0.97 * share};
  });
}

/// Numbers that are kept of so many nodes; moments with ψ.
constexpr std::size_t numbers_of(std::size_t nodes, storage kept = storage::in_place) {
  return nodes * fluid::components * (kept == storage::moments ? 5 : fluid::directions);
}

/// x becomes 1 − x, again and again.
template <class T>
void turn_over(numbers<T>& x) {
  for (T& value : x) {
    value = T(1) - value;
  }
  benchmark::ClobberMemory();
}

/// Bytes read and written in a second on an array in place: the best of some passes.
template <class T>
double in_place_bandwidth(std::size_t count) {
  numbers<T> x(count, T(0.25));
  turn_over(x);
  double best = 0;
  const auto begin = clock_type::now();
  for (int pass = 0; pass < 5 || clock_type::now() - begin < std::chrono::milliseconds(50); ++pass) {
    const auto start = clock_type::now();
    turn_over(x);
    const std::chrono::duration<double> took = clock_type::now() - start;
    best = std::max(best, 2.0 * sizeof(T) * static_cast<double>(count) / took.count());
  }
  return best;
}

/// The worst difference of densities from those of the plain reference after ten steps from the same state.
template <class T, storage Storage>
double difference_to_reference() {
  simulation<fluid, T, Storage> one(repelling(), throat());
  simulation<fluid, T, storage::two_lattices> two(repelling(), throat());
  fill(one);
  fill(two);
  one.run(10);
  two.run(10);
  double worst = 0;
  for (std::size_t n = 0; n < one.sites().size(); ++n) {
    for (std::size_t c = 0; c < fluid::components; ++c) {
      worst = std::max(worst, std::abs(one.density(c, n) - two.density(c, n)));
    }
  }
  return worst;
}

template <class T, storage Storage, site_map<d3q19> (*Sites)()>
void steps(benchmark::State& state) {
  simulation<fluid, T, Storage> s(repelling(), Sites());
  fill(s);
  const bool closed = s.sites().box().low[0] == face_kind::periodic;
  const double before = s.mass(0);
  for (auto _ : state) {
    s.run(2);
  }
  const std::size_t nodes = s.sites().size();
  const double updates = 2.0 * static_cast<double>(state.iterations()) * static_cast<double>(nodes);
  state.SetItemsProcessed(static_cast<std::int64_t>(updates));
  std::size_t failed = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    failed += std::isfinite(s.density(0, n) + s.density(1, n)) ? 0U : 1U;
  }
  state.counters["error"] = closed ? std::abs(s.mass(0) / before - 1) : difference_to_reference<T, Storage>();
  state.counters["failed"] = static_cast<double>(failed);
  state.counters["nodes"] = static_cast<double>(nodes);
  const double traffic = 2.0 * sizeof(T) * static_cast<double>(numbers_of(1, Storage));
  state.counters["of_roofline"] = benchmark::Counter(
      updates * traffic / in_place_bandwidth<T>(numbers_of(nodes, Storage)), benchmark::Counter::kIsRate);
}

template <class T>
void bandwidth_in_place(benchmark::State& state) {
  numbers<T> x(numbers_of(static_cast<std::size_t>(state.range(0))), T(0.25));
  for (auto _ : state) {
    turn_over(x);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(2 * sizeof(T) * x.size()));
  const T expected = state.iterations() % 2 == 0 ? T(0.25) : T(0.75);
  state.counters["error"] = static_cast<double>(std::abs(x.back() - expected));
  state.counters["failed"] = 0;
}

template <class T>
void bandwidth_copy(benchmark::State& state) {
  const numbers<T> x(numbers_of(static_cast<std::size_t>(state.range(0))), T(0.25));
  numbers<T> y(x.size(), T(0));
  for (auto _ : state) {
    std::copy(x.begin(), x.end(), y.begin());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(2 * sizeof(T) * x.size()));
  state.counters["error"] = static_cast<double>(std::abs(y.back() - x.back()));
  state.counters["failed"] = 0;
}

BENCHMARK_TEMPLATE(steps, double, storage::in_place, box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, float, storage::in_place, box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, double, storage::moments, box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, float, storage::moments, box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, double, storage::two_lattices, box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, float, storage::two_lattices, box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, double, storage::in_place, throat)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, float, storage::in_place, throat)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, double, storage::moments, throat)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, float, storage::moments, throat)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, double, storage::two_lattices, throat)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, float, storage::two_lattices, throat)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, double, storage::in_place, large_box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, float, storage::in_place, large_box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, double, storage::moments, large_box)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(steps, float, storage::moments, large_box)->Unit(benchmark::kMillisecond);
BENCHMARK(bandwidth_in_place<double>)->Arg(32 * 32 * 32)->Arg(45000)->Arg(128 * 128 * 128);
BENCHMARK(bandwidth_in_place<float>)->Arg(32 * 32 * 32)->Arg(45000)->Arg(128 * 128 * 128);
BENCHMARK(bandwidth_copy<double>)->Arg(32 * 32 * 32)->Arg(45000)->Arg(128 * 128 * 128);
BENCHMARK(bandwidth_copy<float>)->Arg(32 * 32 * 32)->Arg(45000)->Arg(128 * 128 * 128);

}  // namespace
