// SPDX-License-Identifier: BSD-3-Clause
#include "support/pressure_truth.hpp"
#include "tetrapore/solver/cholmod.hpp"
#include "tetrapore/solver/eigen.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <doctest/doctest.h>

#include <tuple>
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

TEST_CASE_TEMPLATE(
    "with 40 % of the throats nearly closed, conjugate gradients of Eigen say ok only where the true error is below "
    "1e-8",
    Solver, eigen_cg_solver<>, eigen_cg_solver<vcycle_preconditioner<float>>,
    eigen_cg_solver<Eigen::DiagonalPreconditioner<double>>, eigen_cg_solver<Eigen::IncompleteCholesky<double>>) {
  constexpr bool with_vcycle = requires(Solver s) { s.preconditioner().forget(); };
  std::size_t solved = 0;
  for (const auto& [side, power, seed] : {std::tuple{20, 1.0, 21U},
                                          {20, 1.0, 22U},
                                          {20, 1.4, 21U},
                                          {20, 1.4, 23U},
                                          {20, 2.0, 21U},
                                          {9, 1.0, 21U},
                                          {9, 1.4, 23U},
                                          {9, 2.0, 23U}}) {
    CAPTURE(side);
    CAPTURE(power);
    CAPTURE(seed);
    pressure_case c = packing_like(static_cast<std::size_t>(side), power, seed);
    scale_some(c, 0.4, 1e-18, seed - 17);
    Solver solver;
    solver.analyze(c.graph);
    REQUIRE(solver.factorize(c.w, c.s).ok());
    std::vector<double> x(c.b.size());
    const solve_report report = solver.solve(c.b, x);
    CHECK(report.error_estimate >= 0);
    if (report.ok()) {
      CHECK(report.stop == solve_stop::converged);
      CHECK(report.backward_error <= 1e-10);
      CHECK(relative_error(x, side == 9 ? dense_truth(c) : refined_truth<multigrid_solver<double>>(c)) <= 1e-8);
      ++solved;
    } else {
      CHECK(report.reason == solve_status::not_converged);
    }
  }
  CHECK(solved >= (with_vcycle ? 7 : 0));
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
