// SPDX-License-Identifier: BSD-3-Clause
#include "support/solver_conformance.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <doctest/doctest.h>

using namespace tetrapore;

TEST_CASE_TEMPLATE("a solver keeps the promises of network_solver", Solver, multigrid_solver<float>,
                   multigrid_solver<double>, ldlt_solver<double>, ldlt_solver<long double>) {
  conformance::check<Solver>();
}

TEST_CASE_TEMPLATE("a V-cycle is symmetric and positive", T, float, double) {
  pressure_case c = packing_like(14, 1.4, 2);
  scale_some(c, 0.3, 0.0, 5);  // clusters and lone nodes
  aggregation_hierarchy<T> hierarchy;
  hierarchy.analyze(c.graph);
  hierarchy.factorize(c.w, c.s);
  REQUIRE(hierarchy.level_count() > 1);
  const std::size_t n = c.graph.node_count();
  std::mt19937_64 random(4);
  std::vector<double> a(n), b(n), x(n), y(n);
  for (int k = 0; k < 10; ++k) {
    double ay = 0, bx = 0, ax = 0, by = 0;
    for (std::size_t i = 0; i < n; ++i) {
      a[i] = static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5;
      b[i] = static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5;
    }
    hierarchy.apply(a, x);
    hierarchy.apply(b, y);
    for (std::size_t i = 0; i < n; ++i) {
      ax += a[i] * x[i];
      by += b[i] * y[i];
      ay += a[i] * y[i];
      bx += b[i] * x[i];
    }
    CHECK(ax > 0);
    CHECK(by > 0);
    CHECK(std::abs(ay - bx) <= 1e-11 * std::sqrt(ax * by));
  }
}

TEST_CASE("iterations grow with neither size nor contrast") {
  for (const double power : {1.0, 2.0}) {
    for (const std::size_t side : {16U, 32U, 48U}) {
      const pressure_case c = packing_like(side, power, 8);
      multigrid_solver<> solver;
      solver.analyze(c.graph);
      REQUIRE(solver.factorize(c.w, c.s).ok());
      std::vector<double> x(c.b.size());
      const solve_report report = solver.solve(c.b, x);
      REQUIRE(report.ok());
      CAPTURE(side);
      CAPTURE(power);
      CAPTURE(report.iterations);
      CHECK(report.iterations <= 40);
      CHECK(solver.hierarchy().bytes() <= 200 * c.b.size());
    }
  }
}

TEST_CASE("a warm start near the solution saves half of the iterations") {
  pressure_case c = packing_like(24, 1.0, 8);
  multigrid_solver<> solver;
  solver.analyze(c.graph);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  std::vector<double> x(c.b.size());
  const std::size_t cold = solver.solve(c.b, x).iterations;
  for (double& b : c.b) {
    b *= 1 + 1e-6;
  }
  CHECK(2 * solver.solve(c.b, x, {.warm = true}).iterations <= cold + 2);
}

TEST_CASE("pressures imposed by an excess of 1e12 cost no iterations") {
  pressure_case c = packing_like(24, 1.0, 8);
  std::mt19937_64 random(6);
  for (std::size_t i = 0; i < c.s.size(); ++i) {
    if (c.s[i] > 0 || random() % 20 == 0) {  // on two faces, and in 5 % of the nodes
      c.b[i] = 1e12 * (c.s[i] > 0 ? c.b[i] : 0.5);
      c.s[i] = 1e12;
    }
  }
  multigrid_solver<> solver;
  solver.analyze(c.graph);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  std::vector<double> x(c.b.size());
  const solve_report report = solver.solve(c.b, x);
  REQUIRE(report.ok());
  CAPTURE(report.iterations);
  CHECK(report.iterations <= 20);
  CHECK(relative_error(x, refined_truth<multigrid_solver<double>>(c)) <= 1e-8);
}
