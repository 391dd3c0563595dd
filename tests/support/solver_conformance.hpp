// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/pressure_truth.hpp"
#include "tetrapore/solver/concept.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

/// \file
/// What the prose under network_solver promises, for any model.

namespace conformance {

using tetrapore::network_graph;
using tetrapore::solve_options;
using tetrapore::solve_report;
using tetrapore::solve_status;
using tetrapore::solve_stop;

/// Two chains of three nodes, 0-1-2 and 3-4-5, and the lone nodes 6 and 7.
inline pressure_case two_chains() {
  return {network_graph(8, {{0, 1}, {1, 2}, {3, 4}, {4, 5}}),
          {1, 2, 1, 1},
          std::vector<double>(8, 0.0),
          std::vector<double>(8, 0.0)};
}

template <class Solver>
solve_report solve(const pressure_case& c, std::vector<double>& x, const solve_options& options = {}) {
  Solver solver;
  solver.analyze(c.graph);
  x.resize(c.graph.node_count(), 0.0);
  const solve_report factored = solver.factorize(c.w, c.s);
  return factored.ok() ? solver.solve(c.b, x, options) : factored;
}

template <class Solver>
void refuses_what_is_no_system() {
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0};
  std::vector<double> x;
  for (const double v : bad) {
    CAPTURE(v);
    pressure_case c = two_chains();
    c.s.assign(8, 1.0);
    c.w[2] = v;
    solve_report report = solve<Solver>(c, x);
    CHECK(report.reason == solve_status::invalid_weight);
    CHECK(report.index == 2);
    CHECK(report.kind() == tetrapore::verdict::refused);
    c.w[2] = 1;
    c.s[5] = v;
    report = solve<Solver>(c, x);
    CHECK(report.reason == solve_status::invalid_excess);
    CHECK(report.index == 5);
    c.s[5] = 1;
    if (v != -1.0) {
      c.b[7] = v;
      std::vector<double> kept(8, 3.0);
      report = solve<Solver>(c, kept);
      CHECK(report.reason == solve_status::invalid_source);
      CHECK(report.index == 7);
      CHECK(kept == std::vector<double>(8, 3.0));
      c.b[7] = 0;
      kept[4] = v;
      report = solve<Solver>(c, kept, {.warm = true});
      CHECK(report.reason == solve_status::invalid_start);
      CHECK(report.index == 4);
    }
  }
  Solver solver;
  std::vector<double> none;
  const pressure_case c = two_chains();
  CHECK(solver.solve(none, none).reason == solve_status::not_factorized);
  CHECK(solver.factorize(c.w, c.s).reason == solve_status::not_factorized);
  solver.analyze(c.graph);
  CHECK(solver.solve(c.b, none).reason == solve_status::not_factorized);
  CHECK(solver.factorize(c.w, none).reason == solve_status::wrong_size);
  CHECK(solver.factorize(none, c.s).reason == solve_status::wrong_size);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  CHECK(solver.solve(c.b, none).reason == solve_status::wrong_size);
  std::vector<double> negative = c.w;
  negative[0] = -1;
  CHECK(!solver.factorize(negative, c.s).ok());
  std::vector<double> x8(8);
  CHECK(solver.solve(c.b, x8).reason == solve_status::not_factorized);
}

template <class Solver>
void solves_floating_clusters_of_balanced_sources() {
  pressure_case c = two_chains();
  c.s[0] = 1;
  c.b = {1, 0, 0, 3, -1, -2, 0, 0};
  std::vector<double> x;
  const solve_report report = solve<Solver>(c, x);
  REQUIRE(report.ok());
  CHECK(report.clusters == 4);
  CHECK(report.floating_clusters == 3);
  const std::vector<double> expected{1, 1, 1, 8.0 / 3, -1.0 / 3, -7.0 / 3, 0, 0};
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(std::abs(x[i] - expected[i]) <= 1e-14);
  }
}

template <class Solver>
void names_the_cluster_that_is_unbalanced() {
  pressure_case c = two_chains();
  c.s[0] = 1;
  c.b[4] = 1e-3;
  std::vector<double> x(8, 2.0);
  solve_report report = solve<Solver>(c, x);
  CHECK(report.reason == solve_status::unbalanced_cluster);
  CHECK(report.index == 3);
  CHECK(report.cluster_size == 3);
  CHECK(report.imbalance == 1e-3);
  CHECK(x == std::vector<double>(8, 2.0));
  c.b[4] = 0;
  c.b[6] = 1;
  report = solve<Solver>(c, x);
  CHECK(report.reason == solve_status::unbalanced_cluster);
  CHECK(report.index == 6);
  CHECK(report.cluster_size == 1);
  c.b[6] = 0;
  c.b[3] = 1;
  c.b[5] = -1 - 1e-13;  // round-off
  CHECK(solve<Solver>(c, x).ok());
  c.b[5] = -1 - 1e-9;
  CHECK(solve<Solver>(c, x).reason == solve_status::unbalanced_cluster);
  CHECK(solve<Solver>(c, x, {.balance_floor = 1e-8}).ok());
  // An edge without conductance does not connect.
  pressure_case cut{network_graph(2, {{0, 1}}), {0.0}, {1, 0}, {1, 1}};
  CHECK(solve<Solver>(cut, x).index == 1);
}

template <class Solver>
void solves_the_smallest_systems() {
  std::vector<double> x;
  pressure_case none{network_graph(0, {}), {}, {}, {}};
  CHECK(solve<Solver>(none, x).ok());
  CHECK(x.empty());
  pressure_case one{network_graph(1, {}), {}, {4}, {2}};
  REQUIRE(solve<Solver>(one, x).ok());
  CHECK(x[0] == 0.5);
  pressure_case lone{network_graph(1, {}), {}, {0}, {0}};
  REQUIRE(solve<Solver>(lone, x).ok());
  CHECK(x[0] == 0);
  pressure_case two{network_graph(2, {{0, 1}, {1, 0}}), {1, 3}, {0, 2}, {4, 2}};
  REQUIRE(solve<Solver>(two, x).ok());
  CHECK(std::abs(x[0] - 4) <= 1e-15 * 4);
  CHECK(std::abs(x[1] - 3) <= 1e-15 * 4);
}

template <class Solver>
void reports_the_true_residual() {
  pressure_case c = packing_like(14, 1.0, 3);
  std::vector<double> x;
  const solve_report report = solve<Solver>(c, x);
  REQUIRE(report.ok());
  std::vector<long double> r(x.size());
  long double b_norm = 0;
  long double x_norm = 0;
  std::vector<long double> row(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    r[i] = static_cast<long double>(c.b[i]) - static_cast<long double>(c.s[i]) * static_cast<long double>(x[i]);
    row[i] = static_cast<long double>(c.s[i]);
    b_norm = std::max(b_norm, std::abs(static_cast<long double>(c.b[i])));
    x_norm = std::max(x_norm, std::abs(static_cast<long double>(x[i])));
  }
  for (std::size_t e = 0; e < c.w.size(); ++e) {
    const auto [i, j] = c.graph.edges()[e];
    const auto w = static_cast<long double>(c.w[e]);
    const long double flux = w * (static_cast<long double>(x[i]) - static_cast<long double>(x[j]));
    r[i] -= flux;
    r[j] += flux;
    row[i] += 2 * w;
    row[j] += 2 * w;
  }
  long double largest = 0;
  long double norm = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, std::abs(r[i]));
    norm = std::max(norm, row[i]);
  }
  // The report's own residual rounds by a few ε of the fluxes, which are at most ε ‖A‖ ‖x‖.
  const auto rounding = static_cast<double>(8e-16L * norm * x_norm);
  CHECK(std::abs(report.residual - static_cast<double>(largest)) <= rounding);
  CHECK(report.backward_error <= 1e-10);
  CHECK(report.worst_node < x.size());
  CHECK(static_cast<double>(std::abs(r[report.worst_node])) >= static_cast<double>(largest) - 2 * rounding);
}

template <class Solver>
void gives_the_same_bits_and_factors_again() {
  pressure_case c = packing_like(12, 1.0, 3);
  for (double& excess : c.s) {
    excess += 0.01;  // no cluster floats
  }
  pressure_case other = c;
  scale_some(other, 0.5, 7.0, 1);
  std::vector<double> first;
  std::vector<double> alone;
  REQUIRE(solve<Solver>(c, first).ok());
  REQUIRE(solve<Solver>(other, alone).ok());
  Solver solver;
  solver.analyze(c.graph);
  std::vector<double> x(first.size(), 77.0);
  REQUIRE(solver.factorize(other.w, other.s).ok());
  REQUIRE(solver.solve(other.b, x).ok());
  CHECK(x == alone);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  REQUIRE(solver.solve(c.b, x).ok());
  CHECK(x == first);
  // many right-hand sides: linear to the accuracy of the solutions
  std::vector<double> b(c.b.size());
  std::mt19937_64 random(9);
  for (double& v : b) {
    v = static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5;
  }
  std::vector<double> y(b.size());
  REQUIRE(solver.solve(b, y).ok());
  std::vector<double> sum(b.size());
  std::vector<double> z(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    sum[i] = b[i] + c.b[i];
  }
  REQUIRE(solver.solve(sum, z).ok());
  double error = 0;
  double size = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    error = std::fmax(error, std::abs(z[i] - x[i] - y[i]));
    size = std::fmax(size, std::abs(y[i]) + std::abs(x[i]));
  }
  CHECK(error <= 1e-8 * size);
  // a warm start at the solution is not made worse
  const auto before = y;
  const solve_report warm = solver.solve(b, y, {.warm = true});
  REQUIRE(warm.ok());
  for (std::size_t i = 0; i < b.size(); ++i) {
    CHECK(std::abs(y[i] - before[i]) <= 1e-8 * size);
  }
}

template <class Solver>
void solves_to_1e_8() {
  for (const double power : {1.0, 1.4}) {
    pressure_case c = packing_like(9, power, 17);
    std::vector<double> x;
    const solve_report report = solve<Solver>(c, x);
    REQUIRE(report.ok());
    CHECK(relative_error(x, dense_truth(c)) <= 1e-8);
  }
}

/// All of it, for a solver that is default-constructed.
template <tetrapore::network_solver Solver>
void check() {
  refuses_what_is_no_system<Solver>();
  solves_floating_clusters_of_balanced_sources<Solver>();
  names_the_cluster_that_is_unbalanced<Solver>();
  solves_the_smallest_systems<Solver>();
  reports_the_true_residual<Solver>();
  gives_the_same_bits_and_factors_again<Solver>();
  solves_to_1e_8<Solver>();
}

}  // namespace conformance
