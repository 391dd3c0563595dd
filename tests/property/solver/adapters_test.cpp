// SPDX-License-Identifier: BSD-3-Clause
#include "support/pressure_truth.hpp"
#include "support/solver_conformance.hpp"
#include "tetrapore/solver/cholmod.hpp"
#include "tetrapore/solver/eigen.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

using namespace tetrapore;

namespace {

/// n nodes in clusters of random size, each a tree with some more edges (also parallel ones), conductances over four
/// decades, some of them closed; every second cluster floats, with balanced sources.
pressure_case clusters(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  pressure_case c;
  c.s.assign(n, 0.0);
  c.b.assign(n, 0.0);
  std::vector<network_graph::edge> edges;
  bool floats = false;
  for (std::size_t begin = 0; begin < n; floats = !floats) {
    const std::size_t end = std::min(n, begin + 1 + static_cast<std::size_t>(uniform() * 40));
    const auto one_of = [&](std::size_t below) {
      return begin + static_cast<std::size_t>(uniform() * static_cast<double>(below - begin));
    };
    const auto join = [&](std::size_t i, std::size_t j, double w) {
      edges.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      c.w.push_back(w);
    };
    for (std::size_t i = begin + 1; i < end; ++i) {
      join(i, one_of(i), std::pow(10.0, 4 * uniform()));
      if (const std::size_t other = one_of(end); other != i) {
        join(other, i, uniform() < 0.3 ? 0.0 : std::pow(10.0, 4 * uniform()));
      }
    }
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) {  // multiples of 2^-20, so that the sum is exact
      c.b[i] = std::floor((uniform() - 0.5) * 0x1p20) * 0x1p-20;
      sum += c.b[i];
    }
    if (floats) {
      c.b[begin] -= sum;
    } else {
      c.s[one_of(end)] = 0.5 + uniform();
    }
    if (end < n) {
      join(end - 1, end, 0.0);  // a closed throat does not connect
    }
    begin = end;
  }
  c.graph = network_graph(n, std::move(edges));
  return c;
}

template <class Solver>
void solves_random_graphs() {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const pressure_case c = clusters(50 * seed, seed);
    const auto truth = dense_truth(c);
    Solver solver;
    solver.analyze(c.graph);
    const solve_report made = solver.factorize(c.w, c.s);
    REQUIRE(made.ok());
    CHECK(made.clusters > made.floating_clusters);
    std::vector<double> x(c.b.size(), 7.0);
    const solve_report report = solver.solve(c.b, x);
    REQUIRE(report.ok());
    CHECK(relative_error(x, truth) <= 1e-8);

    // a warm start, good or bad, changes nothing but the work
    std::vector<double> y = x;
    const solve_report short_way = solver.solve(c.b, y, {.warm = true});
    CHECK(short_way.ok());
    CHECK(short_way.iterations <= std::max<std::size_t>(report.iterations, 1));
    CHECK(relative_error(y, truth) <= 1e-8);
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] = 100 * std::sin(static_cast<double>(i));
    }
    CHECK(solver.solve(c.b, y, {.warm = true}).ok());
    CHECK(relative_error(y, truth) <= 1e-8);

    // other conductances on the same graph
    pressure_case other = c;
    for (std::size_t e = 0; e < c.w.size(); ++e) {
      other.w[e] *= 1.0 + static_cast<double>(e % 3);
    }
    REQUIRE(solver.factorize(other.w, other.s).ok());
    CHECK(solver.solve(other.b, x).ok());
    CHECK(relative_error(x, dense_truth(other)) <= 1e-8);
  }
}

/// Conjugate gradients with a preconditioner that needs thousands of iterations.
template <class Preconditioner>
struct patient : eigen_cg_solver<Preconditioner> {
  [[nodiscard]] solve_report solve(std::span<const double> b, std::span<double> x, solve_options options = {}) {
    options.max_iterations = 20000;
    return eigen_cg_solver<Preconditioner>::solve(b, x, options);
  }
};
using cg_diagonal = patient<Eigen::DiagonalPreconditioner<double>>;
using cg_incomplete_cholesky = patient<Eigen::IncompleteCholesky<double>>;
using cg_vcycle = eigen_cg_solver<vcycle_preconditioner<double>>;
using cg_vcycle_float = eigen_cg_solver<vcycle_preconditioner<float>>;

}  // namespace

TEST_CASE_TEMPLATE("the adapters keep the promises of network_solver", Solver, cholmod_solver, eigen_ldlt_solver,
                   cg_vcycle, cg_vcycle_float, cg_diagonal, cg_incomplete_cholesky) {
  conformance::check<Solver>();
}

TEST_CASE_TEMPLATE(
    "clusters tied and floating, with parallel and closed edges, are solved to 1e-8; warm starts, good "
    "and bad; other conductances on the same graph",
    Solver, cholmod_solver, eigen_ldlt_solver, cg_vcycle, cg_vcycle_float, cg_diagonal, cg_incomplete_cholesky,
    ldlt_solver<>, multigrid_solver<>) {
  solves_random_graphs<Solver>();
}
