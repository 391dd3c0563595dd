// SPDX-License-Identifier: BSD-3-Clause
#include "support/pressure_truth.hpp"
#include "tetrapore/solver/cholmod.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

using namespace tetrapore;

namespace {

/// Largest difference between the solutions of a solver that has followed the changes and of a new one.
double against_refactorized(cholmod_solver& updated, const pressure_case& c) {
  cholmod_solver fresh;
  fresh.analyze(c.graph);
  REQUIRE(fresh.factorize(c.w, c.s).ok());
  std::vector<double> x(c.b.size());
  std::vector<double> y(c.b.size());
  REQUIRE(fresh.solve(c.b, x).ok());
  REQUIRE(updated.solve(c.b, y).ok());
  double worst = 0;
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    worst = std::max(worst, std::abs(x[i] - y[i]));
    largest = std::max(largest, std::abs(x[i]));
  }
  return worst / largest;
}

}  // namespace

TEST_CASE("a factor that follows changes by updates and downdates solves as a new factor does") {
  for (const std::size_t refinements : {std::size_t{0}, std::size_t{1}}) {
    CAPTURE(refinements);
    pressure_case c = packing_like(14, 1.0, 3);
    cholmod_solver solver(cholmod_settings{.refinements = refinements, .update_limit = 4});
    solver.analyze(c.graph);
    REQUIRE(solver.factorize(c.w, c.s).ok());
    std::mt19937_64 random(5);
    std::size_t changes = 0;
    for (int step = 0; step < 20; ++step) {
      for (std::size_t k = 0; k < 1 + random() % 3; ++k) {
        const std::size_t e = random() % c.w.size();
        c.w[e] *= step % 2 == 0 ? 0.01 : 30.0;
        ++changes;
      }
      if (step % 5 == 0) {
        c.s[random() % c.s.size()] += 0.5;
        ++changes;
      }
      REQUIRE(solver.factorize(c.w, c.s).ok());
      // without refinement ε times the condition number: conductances to 3e6 over a smallest eigenvalue near 0.02
      CHECK(against_refactorized(solver, c) <= (refinements == 0 ? 1e-7 : 1e-14));
    }
    CHECK(solver.factor().updates() >= changes - 2);  // the same edge may be drawn twice in one step
    CHECK(solver.factor().updates() <= changes);
  }
}

TEST_CASE("more changes than the limit, or as many updates as wear allows, make a new factor") {
  pressure_case c = packing_like(8, 1.0, 4);
  cholmod_solver solver(cholmod_settings{.update_limit = 2, .wear_limit = 5});
  solver.analyze(c.graph);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  const auto change = [&](std::size_t count) {
    for (std::size_t e = 0; e < count; ++e) {
      c.w[e] *= 1.5;
    }
    REQUIRE(solver.factorize(c.w, c.s).ok());
    CHECK(against_refactorized(solver, c) <= 1e-14);
    return solver.factor().updates();
  };
  CHECK(change(2) == 2);
  CHECK(change(0) == 2);
  CHECK(change(3) == 0);
  CHECK(change(2) == 2);
  CHECK(change(2) == 4);
  CHECK(change(2) == 0);
}

TEST_CASE("a node that would keep nothing but rounding makes a new factor") {
  pressure_case c{network_graph(3, {{0, 1}, {1, 2}}), {1.0, 2.0}, {1.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
  cholmod_solver solver(cholmod_settings{.update_limit = 2});
  solver.analyze(c.graph);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  for (const auto& [factor, updates] : {std::pair{1e-4, 2U}, {1e-4, 0U}, {1e5, 2U}}) {
    c.w[0] *= factor;
    c.w[1] *= factor;
    REQUIRE(solver.factorize(c.w, c.s).ok());
    CHECK(solver.factor().updates() == updates);
    CHECK(against_refactorized(solver, c) <= 1e-15);
  }
}

TEST_CASE("a cluster that comes off and one that is tied again are updates like any other") {
  // a ring of four hangs on the tied node by one edge
  pressure_case c{network_graph(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 1}}),
                  {2.0, 1.0, 3.0, 1.0, 2.0},
                  {1.0, 0.0, 0.0, 0.0, 0.0},
                  {1.0, 0.25, 0.0, -0.25, 0.0}};
  cholmod_solver solver(cholmod_settings{.update_limit = 4});
  solver.analyze(c.graph);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  for (const double tie : {0.0, 2.0, 1e-3, 0.0, 5.0}) {
    c.w[0] = tie;
    const solve_report made = solver.factorize(c.w, c.s);
    REQUIRE(made.ok());
    CHECK(made.floating_clusters == (tie > 0 ? 0 : 1));
    std::vector<double> x(5);
    REQUIRE(solver.solve(c.b, x).ok());
    CHECK(relative_error(x, dense_truth(c)) <= 1e-14);
  }
  CHECK(solver.factor().updates() > 5);
}

TEST_CASE("many right-hand sides at once are solved as one by one, each with its report") {
  pressure_case c = packing_like(10, 1.0, 6);
  for (double& excess : c.s) {
    excess += 1e-3;  // no cluster floats
  }
  const std::size_t n = c.b.size();
  cholmod_solver solver;
  solver.analyze(c.graph);
  std::vector<double> unused(n);
  CHECK(solver.solve_many(c.b, unused).front().reason == solve_status::not_factorized);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  std::vector<double> b;
  for (std::size_t k = 0; k < 5; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      b.push_back(std::sin(static_cast<double>(i * (k + 1))));
    }
  }
  b[3 * n + 7] = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> x(b.size(), 9.0);
  const auto reports = solver.solve_many(b, x);
  REQUIRE(reports.size() == 5);
  for (std::size_t k = 0; k < 5; ++k) {
    CAPTURE(k);
    pressure_case one = c;
    one.b.assign(b.begin() + static_cast<std::ptrdiff_t>(k * n), b.begin() + static_cast<std::ptrdiff_t>((k + 1) * n));
    const std::span<const double> part(x.data() + k * n, n);
    if (k == 3) {
      CHECK(reports[k].reason == solve_status::invalid_source);
      CHECK(reports[k].index == 7);
      CHECK(std::all_of(part.begin(), part.end(), [](double v) { return v == 9.0; }));
    } else {
      CHECK(reports[k].ok());
      CHECK(relative_error(part, dense_truth(one)) <= 1e-13);
    }
  }
  CHECK(solver.solve_many(std::span(b).first(n + 1), std::span(x).first(n + 1)).front().reason ==
        solve_status::wrong_size);
}

TEST_CASE("a matrix that is not positive definite in double is a status, and the solver goes on") {
  // Two nodes joined by 1 and tied by 1e-30: the ties are lost in the diagonals.
  const network_graph pair(2, {{0, 1}});
  cholmod_solver solver;
  solver.analyze(pair);
  CHECK(solver.factorize(std::array{1.0}, std::array{1e-30, 1e-30}).reason == solve_status::factorization_failed);
  std::array<double, 2> x{4.0, 4.0};
  CHECK(solver.solve(std::array{1.0, 0.0}, x).reason == solve_status::not_factorized);
  CHECK(x[0] == 4.0);
  REQUIRE(solver.factorize(std::array{1.0}, std::array{1.0, 1.0}).ok());
  REQUIRE(solver.solve(std::array{1.0, 0.0}, x).ok());
  CHECK(x[0] == doctest::Approx(2.0 / 3.0).epsilon(1e-15));
}

TEST_CASE("a solver may be moved with its factor") {
  const pressure_case c = packing_like(6, 1.0, 2);
  cholmod_solver first;
  first.analyze(c.graph);
  REQUIRE(first.factorize(c.w, c.s).ok());
  cholmod_solver second = std::move(first);
  std::vector<double> x(c.b.size());
  CHECK(second.solve(c.b, x).ok());
  CHECK(relative_error(x, dense_truth(c)) <= 1e-14);
}

namespace {

void* no_memory(std::size_t) { return nullptr; }

}  // namespace

TEST_CASE("a solution that finds no memory is a status that leaves x as it was, and the solver goes on") {
  const pressure_case c = packing_like(6, 1.0, 2);
  cholmod_solver solver;
  solver.analyze(c.graph);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  std::vector<double> x(c.b.size(), 4.0);
  auto* const allocate = std::exchange(SuiteSparse_config.malloc_func, no_memory);
  const solve_report report = solver.solve(c.b, x);
  const std::vector<solve_report> reports = solver.solve_many(c.b, x);
  SuiteSparse_config.malloc_func = allocate;
  CHECK(report.reason == solve_status::no_memory);
  CHECK(report.kind() == verdict::failed);
  REQUIRE(reports.size() == 1);
  CHECK(reports[0].reason == solve_status::no_memory);
  CHECK(std::all_of(x.begin(), x.end(), [](double v) { return v == 4.0; }));
  CHECK(solver.solve(c.b, x).ok());
  CHECK(relative_error(x, dense_truth(c)) <= 1e-14);
}
