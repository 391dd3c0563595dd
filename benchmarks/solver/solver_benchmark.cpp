// SPDX-License-Identifier: BSD-3-Clause
//
// The pressure system of dense grains by our own solvers, against its size: six pores per grain, from 5,900 to 6.7
// million pores. `error` is the largest against long double, relative to the largest pressure; `failed` is 1 where the
// solver says that it has not solved. Rows `cold` begin from the graph, `factorize` gives the hierarchy of other
// conductances on the same graph, `resolve` begins from it, `warm` from the solution of conductances that have moved by
// 1 % too. Times per pore stand beside those of one residual in flux form, which is one pass over the edges.

#include "solver/system.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <vector>

using namespace tetrapore;

namespace {

const bench::pressure_case& case_of(const benchmark::State& state) {
  return bench::dense_case(static_cast<std::size_t>(state.range(0)), bench::contrast::natural);
}

void tell(benchmark::State& state, const bench::pressure_case& c, std::span<const double> x,
          const solve_report& report) {
  bench::tell_solution(state, c, x, report.ok());
  state.counters["per_pore"] = benchmark::Counter(
      state.counters["pores"], benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["iterations"] = static_cast<double>(report.iterations);
}

template <class Solver>
void tell_memory(benchmark::State& state, const Solver& solver) {
  if constexpr (requires { solver.hierarchy(); }) {
    state.counters["bytes_per_pore"] =
        static_cast<double>(solver.hierarchy().bytes()) / static_cast<double>(solver.system().size());
  }
}

template <class Solver>
void cold(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  std::vector<double> x(c.sources.size());
  solve_report report;
  for (auto _ : state) {
    Solver solver;
    solver.analyze(c.graph);
    report = solver.factorize(c.weights, c.excess);
    report = report.ok() ? solver.solve(c.sources, x) : report;
    benchmark::DoNotOptimize(x.data());
  }
  tell(state, c, x, report);
}

template <class Solver>
void factorize(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  Solver solver;
  solver.analyze(c.graph);
  solve_report report;
  for (auto _ : state) {
    report = solver.factorize(c.weights, c.excess);
  }
  std::vector<double> x(c.sources.size());
  report = report.ok() ? solver.solve(c.sources, x) : report;
  tell(state, c, x, report);
  tell_memory(state, solver);
}

template <class Solver>
void resolve(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  Solver solver;
  solver.analyze(c.graph);
  solve_report report = solver.factorize(c.weights, c.excess);
  std::vector<double> x(c.sources.size());
  const bool factored = report.ok();
  for (auto _ : state) {
    report = factored ? solver.solve(c.sources, x) : report;
  }
  tell(state, c, x, report);
}

template <class Solver>
void warm(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  Solver solver;
  solver.analyze(c.graph);
  std::vector<double> moved = c.weights;
  std::mt19937_64 random(2);
  for (double& w : moved) {
    w *= 1 + 0.01 * (static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5);
  }
  std::vector<double> start(c.sources.size());
  const bool started = solver.factorize(moved, c.excess).ok() && solver.solve(c.sources, start).ok();
  solve_report report = solver.factorize(c.weights, c.excess);
  std::vector<double> x = start;
  for (auto _ : state) {
    x = start;
    report = started ? solver.solve(c.sources, x, {.warm = true}) : report;
  }
  tell(state, c, x, report);
}

void flux_residual(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  pressure_system system;
  system.analyze(c.graph);
  const solve_report report = system.factorize(c.weights, c.excess);
  std::vector<double> r(c.sources.size());
  for (auto _ : state) {
    system.residual(c.sources, c.reference, r);
    benchmark::DoNotOptimize(r.data());
  }
  tell(state, c, c.reference, report);
}

using single = multigrid_solver<float>;
using twofold = multigrid_solver<double>;
using direct = ldlt_solver<>;

void small(benchmark::internal::Benchmark* b) {
  b->ArgName("grains")->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);
}
void sizes(benchmark::internal::Benchmark* b) {
  b->ArgName("grains")->Arg(1000)->Arg(4000)->Arg(10000)->Arg(40000)->Arg(100000)->Unit(benchmark::kMillisecond);
}
void every_size(benchmark::internal::Benchmark* b) {
  sizes(b);
  b->Arg(1100000);
}

}  // namespace

BENCHMARK(cold<single>)->Name("multigrid_cold")->Apply(every_size);
BENCHMARK(factorize<single>)->Name("multigrid_factorize")->Apply(every_size);
BENCHMARK(resolve<single>)->Name("multigrid_resolve")->Apply(every_size);
BENCHMARK(warm<single>)->Name("multigrid_warm")->Apply(sizes);
BENCHMARK(cold<twofold>)->Name("multigrid_double_cold")->Apply(sizes);
BENCHMARK(factorize<twofold>)->Name("multigrid_double_factorize")->Apply(sizes);
BENCHMARK(cold<direct>)->Name("ldlt_cold")->Apply(small);
BENCHMARK(resolve<direct>)->Name("ldlt_resolve")->Apply(small);
BENCHMARK(flux_residual)->Apply(every_size);
