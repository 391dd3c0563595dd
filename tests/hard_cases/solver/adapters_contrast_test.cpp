// SPDX-License-Identifier: BSD-3-Clause
#include "support/pressure_truth.hpp"
#include "tetrapore/solver/cholmod.hpp"
#include "tetrapore/solver/eigen.hpp"

#include <doctest/doctest.h>

#include <utility>
#include <vector>

using namespace tetrapore;

TEST_CASE_TEMPLATE("refinement on w and s keeps the true error of an assembled factor below 1e-12 at high contrast",
                   Solver, cholmod_solver, eigen_ldlt_solver) {
  for (const double power : {1.0, 1.4, 2.0}) {
    for (const double factor : {1.0, 1e-10}) {
      CAPTURE(power);
      CAPTURE(factor);
      pressure_case c = packing_like(10, power, 5);
      scale_some(c, 0.1, factor, 9);
      Solver solver;
      solver.analyze(c.graph);
      REQUIRE(solver.factorize(c.w, c.s).ok());
      std::vector<double> x(c.b.size());
      REQUIRE(solver.solve(c.b, x).ok());
      CHECK(relative_error(x, dense_truth(c)) <= 1e-12);
    }
  }
}

TEST_CASE_TEMPLATE(
    "where nearly closed throats make the assembled matrix indefinite, the factor says so or the refined "
    "solution holds",
    Solver, cholmod_solver, eigen_ldlt_solver) {
  std::size_t failed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    pressure_case c = packing_like(8, 1.0, seed);
    scale_some(c, 0.4, 1e-18, seed + 1);
    Solver solver;
    solver.analyze(c.graph);
    const solve_report made = solver.factorize(c.w, c.s);
    if (!made.ok()) {
      CHECK(made.reason == solve_status::factorization_failed);
      ++failed;
      continue;
    }
    std::vector<double> x(c.b.size());
    const solve_report report = solver.solve(c.b, x);
    CHECK((!report.ok() || relative_error(x, dense_truth(c)) <= 1e-8));
  }
  CHECK(failed > 10);
}

TEST_CASE("Eigen's conjugate gradients on fluxes with the V-cycle reach 1e-7 at any contrast short of closed throats") {
  for (const double power : {1.0, 1.4, 2.0}) {
    for (const double factor : {1.0, 1e-10}) {
      CAPTURE(power);
      CAPTURE(factor);
      pressure_case c = packing_like(10, power, 5);
      scale_some(c, 0.1, factor, 9);
      eigen_cg_solver<> solver;
      solver.analyze(c.graph);
      REQUIRE(solver.factorize(c.w, c.s).ok());
      std::vector<double> x(c.b.size());
      const solve_report report = solver.solve(c.b, x);
      REQUIRE(report.ok());
      CHECK(report.iterations < 100);
      CHECK(relative_error(x, dense_truth(c)) <= 1e-7);
    }
  }
}

TEST_CASE("an iterative solver that runs out of iterations says so") {
  const pressure_case c = packing_like(12, 1.0, 7);
  eigen_cg_solver<Eigen::DiagonalPreconditioner<double>> solver;
  solver.analyze(c.graph);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  std::vector<double> x(c.b.size());
  const solve_report report = solver.solve(c.b, x, {.max_iterations = 3});
  CHECK(report.reason == solve_status::not_converged);
  CHECK(report.stop == solve_stop::max_iterations);
  CHECK(report.iterations == 3);
}
