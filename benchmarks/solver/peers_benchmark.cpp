// SPDX-License-Identifier: BSD-3-Clause
//
// The pressure system of dense grains (58,600 pores, `large` 234,000, `huge` 6.7 million) by every solver that we know
// of, beside our own. Conductances as they are, or changed as the label says. `error` is the largest against long
// double, relative to the largest pressure; `failed` is 1 where the solver says that it has not solved. Rows `cold`
// begin from the graph, `again` from other conductances on the same graph, `resolve` from the factor. `raw` rows call
// Eigen as its manual does; those of hypre are there where it is installed (Debian: libhypre-dev). OpenBLAS takes as
// many threads as there are cores unless OPENBLAS_NUM_THREADS says otherwise.

#ifdef TETRAPORE_HAS_HYPRE
#include "solver/hypre.hpp"
#endif
#include "solver/system.hpp"
#include "tetrapore/solver/cholmod.hpp"
#include "tetrapore/solver/eigen.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

using namespace tetrapore;

namespace {

const bench::pressure_case& case_of(const benchmark::State& state) {
  return bench::dense_case(static_cast<std::size_t>(state.range(0)), static_cast<bench::contrast>(state.range(1)));
}

void tell(benchmark::State& state, const bench::pressure_case& c, std::span<const double> x, bool solved,
          std::size_t iterations) {
  state.SetLabel(bench::describe(static_cast<bench::contrast>(state.range(1))));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(c.graph.node_count()));
  bench::tell_solution(state, c, x, solved);
  state.counters["contrast"] = c.ratio;
  if (iterations > 0) {
    state.counters["iterations"] = static_cast<double>(iterations);
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
  tell(state, c, x, report.ok(), report.iterations);
}

template <class Solver>
void again(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  std::vector<double> x(c.sources.size());
  solve_report report;
  Solver solver;
  solver.analyze(c.graph);
  for (auto _ : state) {
    report = solver.factorize(c.weights, c.excess);
    report = report.ok() ? solver.solve(c.sources, x) : report;
    benchmark::DoNotOptimize(x.data());
  }
  tell(state, c, x, report.ok(), report.iterations);
}

template <class Solver>
void resolve_with(benchmark::State& state, Solver solver) {
  const bench::pressure_case& c = case_of(state);
  std::vector<double> x(c.sources.size());
  solver.analyze(c.graph);
  solve_report report = solver.factorize(c.weights, c.excess);
  const bool factored = report.ok();
  for (auto _ : state) {
    report = factored ? solver.solve(c.sources, x) : report;
    benchmark::DoNotOptimize(x.data());
  }
  tell(state, c, x, report.ok(), report.iterations);
}

template <class Solver>
void resolve(benchmark::State& state) {
  resolve_with(state, Solver());
}

void cholmod_resolve_unrefined(benchmark::State& state) {
  resolve_with(state, cholmod_solver(cholmod_settings{.refinements = 0}));
}

/// Eight right-hand sides at once; the time is that of all.
void cholmod_resolve_eight(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  constexpr std::size_t count = 8;
  const std::size_t n = c.sources.size();
  std::vector<double> b;
  for (std::size_t k = 0; k < count; ++k) {
    b.insert(b.end(), c.sources.begin(), c.sources.end());
  }
  std::vector<double> x(b.size());
  cholmod_solver solver;
  solver.analyze(c.graph);
  bool solved = solver.factorize(c.weights, c.excess).ok();
  for (auto _ : state) {
    for (const solve_report& r : solver.solve_many(b, x)) {
      solved = solved && r.ok();
    }
  }
  tell(state, c, std::span<const double>(x).subspan(n * (count - 1)), solved, 0);
}

/// One conductance changes by half and back: rank-1 update and downdate, each with a solution. The time is that of
/// both.
void cholmod_update_and_resolve(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  std::vector<double> x(c.sources.size());
  cholmod_solver solver(cholmod_settings{.update_limit = 8, .wear_limit = 1000000});
  solver.analyze(c.graph);
  std::vector<double> w = c.weights;
  bool solved = solver.factorize(w, c.excess).ok();
  std::size_t edge = 0;
  for (auto _ : state) {
    edge = (edge + 7919) % w.size();
    for (const double factor : {0.5, 1.0}) {
      w[edge] = factor * c.weights[edge];
      solved = solved && solver.factorize(w, c.excess).ok() && solver.solve(c.sources, x).ok();
    }
  }
  tell(state, c, x, solved, 0);
  state.counters["updates"] = static_cast<double>(solver.factor().updates());
}

template <class Preconditioner>
void raw_cg(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  Eigen::VectorXd x;
  bool solved = false;
  Eigen::Index iterations = 0;
  const Eigen::Map<const Eigen::VectorXd> b(c.sources.data(), static_cast<Eigen::Index>(c.sources.size()));
  for (auto _ : state) {
    const Eigen::SparseMatrix<double> matrix = laplacian(c.graph, c.weights, c.excess);
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper, Preconditioner> cg;
    cg.setTolerance(1e-10);
    cg.setMaxIterations(20000);
    cg.compute(matrix);
    x = cg.solve(b);
    solved = cg.info() == Eigen::Success;
    iterations = cg.iterations();
  }
  tell(state, c, {x.data(), static_cast<std::size_t>(x.size())}, solved, static_cast<std::size_t>(iterations));
}

void raw_simplicial_ldlt(benchmark::State& state) {
  const bench::pressure_case& c = case_of(state);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c.sources.size()));
  bool solved = false;
  const Eigen::Map<const Eigen::VectorXd> b(c.sources.data(), static_cast<Eigen::Index>(c.sources.size()));
  for (auto _ : state) {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(laplacian(c.graph, c.weights, c.excess));
    solved = ldlt.info() == Eigen::Success;
    if (solved) {
      x = ldlt.solve(b);
    }
  }
  tell(state, c, {x.data(), static_cast<std::size_t>(x.size())}, solved, 0);
}

using multigrid = multigrid_solver<>;
using cg_vcycle = eigen_cg_solver<>;

void all_contrasts(benchmark::internal::Benchmark* b) {
  b->ArgNames({"grains", "contrast"})->ArgsProduct({{10000}, {0, 1, 2, 3, 4}})->Unit(benchmark::kMillisecond);
}
void solvable(benchmark::internal::Benchmark* b) {  // by an assembled matrix
  b->ArgNames({"grains", "contrast"})->ArgsProduct({{10000}, {0, 1, 2, 3}})->Unit(benchmark::kMillisecond);
}
void natural(benchmark::internal::Benchmark* b) {
  b->ArgNames({"grains", "contrast"})->Args({10000, 0})->Unit(benchmark::kMillisecond);
}
void extremes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"grains", "contrast"})->ArgsProduct({{10000}, {0, 2}})->Unit(benchmark::kMillisecond);
}
void large(benchmark::internal::Benchmark* b) {
  b->ArgNames({"grains", "contrast"})->Args({40000, 0})->Unit(benchmark::kMillisecond);
}
void huge(benchmark::internal::Benchmark* b) {
  b->ArgNames({"grains", "contrast"})->Args({1100000, 0})->Unit(benchmark::kMillisecond)->Iterations(1);
}

}  // namespace

BENCHMARK(cold<multigrid>)->Name("multigrid_cold")->Apply(all_contrasts);
BENCHMARK(again<multigrid>)->Name("multigrid_again")->Apply(natural);
BENCHMARK(resolve<multigrid>)->Name("multigrid_resolve")->Apply(natural);
BENCHMARK(cold<cg_vcycle>)->Name("eigen_cg_vcycle_cold")->Apply(all_contrasts);
BENCHMARK(cold<cholmod_solver>)->Name("cholmod_cold")->Apply(all_contrasts);
BENCHMARK(again<cholmod_solver>)->Name("cholmod_again")->Apply(natural);
BENCHMARK(resolve<cholmod_solver>)->Name("cholmod_resolve")->Apply(solvable);
BENCHMARK(cholmod_resolve_unrefined)->Apply(solvable);
BENCHMARK(cholmod_resolve_eight)->Apply(natural);
BENCHMARK(cholmod_update_and_resolve)->Apply(natural);
BENCHMARK(cold<eigen_ldlt_solver>)->Name("eigen_ldlt_cold")->Apply(extremes);
BENCHMARK(resolve<eigen_ldlt_solver>)->Name("eigen_ldlt_resolve")->Apply(natural);
BENCHMARK(raw_simplicial_ldlt)->Apply(extremes);
BENCHMARK(raw_cg<Eigen::DiagonalPreconditioner<double>>)->Name("raw_cg_diagonal")->Apply(natural);
BENCHMARK(raw_cg<Eigen::IncompleteCholesky<double>>)->Name("raw_cg_incomplete_cholesky")->Apply(natural);

BENCHMARK(cold<multigrid>)->Name("large_multigrid_cold")->Apply(large);
BENCHMARK(resolve<multigrid>)->Name("large_multigrid_resolve")->Apply(large);
BENCHMARK(cold<cg_vcycle>)->Name("large_eigen_cg_vcycle_cold")->Apply(large);
BENCHMARK(cold<cholmod_solver>)->Name("large_cholmod_cold")->Apply(large);
BENCHMARK(again<cholmod_solver>)->Name("large_cholmod_again")->Apply(large);
BENCHMARK(resolve<cholmod_solver>)->Name("large_cholmod_resolve")->Apply(large);
BENCHMARK(cholmod_resolve_unrefined)->Name("large_cholmod_resolve_unrefined")->Apply(large);
BENCHMARK(raw_simplicial_ldlt)->Name("large_raw_simplicial_ldlt")->Apply(large)->Iterations(1);
BENCHMARK(raw_cg<Eigen::DiagonalPreconditioner<double>>)->Name("large_raw_cg_diagonal")->Apply(large);
BENCHMARK(raw_cg<Eigen::IncompleteCholesky<double>>)->Name("large_raw_cg_incomplete_cholesky")->Apply(large);

BENCHMARK(cold<multigrid>)->Name("huge_multigrid_cold")->Apply(huge);

#ifdef TETRAPORE_HAS_HYPRE
BENCHMARK(cold<bench::hypre_solver>)->Name("hypre_cold")->Apply(natural);
BENCHMARK(cold<bench::hypre_solver>)->Name("large_hypre_cold")->Apply(large);
BENCHMARK(cold<bench::hypre_solver>)->Name("huge_hypre_cold")->Apply(huge);
#endif
