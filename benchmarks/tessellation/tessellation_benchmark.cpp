// SPDX-License-Identifier: BSD-3-Clause
//
// From spheres to the measured network, beside what the bare library call allows: CGAL's range insertion of the same
// spheres. The error of a row is |Σ void + solid - box| / box.

#include "support/compiled_triangulation.hpp"
#include "support/dense_packing.hpp"
#include "tetrapore/network.hpp"
#include "tetrapore/packing/packing.hpp"

#include <benchmark/benchmark.h>

#include <map>

using namespace tetrapore;

namespace {

const packing& dense(std::size_t n) {
  static std::map<std::size_t, packing> made;
  const auto found = made.find(n);
  return found != made.end() ? found->second : made.emplace(n, dense_packing(n)).first->second;
}

void cgal_alone(benchmark::State& state) {
  const packing& p = dense(static_cast<std::size_t>(state.range(0)));
  std::size_t cells = 0;
  for (auto _ : state) {
    cells = triangulate_bare(p.grains).cells;
  }
  state.counters["per_grain"] =
      benchmark::Counter(static_cast<double>(p.grains.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["cells"] = static_cast<double>(cells);
  state.counters["error"] = 0;
  state.counters["failed"] = 0;
}

std::size_t bytes_of(const network_arrays& a) {
  const auto of = [](const auto& column) { return column.capacity() * sizeof(column[0]); };
  return of(a.grains) + of(a.pore_vertices) + of(a.pore_images) + of(a.pore_throats) + of(a.power_centres) +
         of(a.volumes) + of(a.void_volumes) + of(a.throat_pores) + of(a.throat_slots) + of(a.throat_shifts);
}

void spheres_to_network(benchmark::State& state) {
  const packing& p = dense(static_cast<std::size_t>(state.range(0)));
  const domain region = state.range(1) != 0 ? domain_of(packing{p.grains, p.bounds, {true, true, true}}) : domain_of(p);
  network net;
  for (auto _ : state) {
    net = compiled_triangulation{}(p.grains, region).net;
  }
  const double box = compensated_sum(net.arrays().volumes);
  state.counters["per_grain"] =
      benchmark::Counter(static_cast<double>(p.grains.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["cells"] = static_cast<double>(net.pore_count());
  state.counters["bytes_per_pore"] =
      static_cast<double>(bytes_of(net.arrays())) / static_cast<double>(net.pore_count());
  state.counters["error"] = std::abs(compensated_sum(net.arrays().void_volumes) + solid_volume(net) - box) / box;
  state.counters["failed"] = 0;
}

}  // namespace

BENCHMARK(cgal_alone)->Arg(40000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(spheres_to_network)
    ->ArgNames({"grains", "periodic"})
    ->Args({40000, 0})
    ->Args({40000, 1})
    ->Args({1000000, 0})
    ->Unit(benchmark::kMillisecond);
