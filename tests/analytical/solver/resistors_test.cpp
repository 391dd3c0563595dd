// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

using namespace tetrapore;

#define MODELS multigrid_solver<float>, multigrid_solver<double>, ldlt_solver<>

namespace {

using edges = std::vector<network_graph::edge>;

template <class Solver>
std::vector<double> solved(const network_graph& graph, const std::vector<double>& w, const std::vector<double>& s,
                           const std::vector<double>& b, double tolerance) {
  Solver solver;
  solver.analyze(graph);
  REQUIRE(solver.factorize(w, s).ok());
  std::vector<double> x(b.size());
  const solve_report report = solver.solve(b, x, {.tolerance = tolerance, .max_iterations = 5000});
  CHECK_MESSAGE(report.ok(), describe(report.reason), report.error_estimate);
  return x;
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

}  // namespace

// Current through a chain is the same everywhere: x falls by the running sum of the resistances.
TEST_CASE_TEMPLATE("a chain of resistors over six decades", Solver, MODELS) {
  for (const std::size_t n : {2U, 50U, 3000U}) {
    std::mt19937_64 random(1);
    edges chain;
    std::vector<double> w;
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      chain.push_back({i, i + 1});
      w.push_back(std::pow(10.0, 6 * uniform(random)));
    }
    std::vector<double> s(n, 0.0);
    std::vector<double> b(n, 0.0);
    s[0] = b[0] = 1;
    s[n - 1] = 1;
    const std::vector<double> x = solved<Solver>(network_graph(n, chain), w, s, b, 1e-13);
    long double total = 2;
    for (const double v : w) {
      total += 1 / static_cast<long double>(v);
    }
    long double expected = 1 - 1 / total;
    double error = 0;
    for (std::size_t i = 0; i < n; ++i) {
      error = std::fmax(error, std::abs(static_cast<double>(static_cast<long double>(x[i]) - expected)));
      expected -= i + 1 < n ? 1 / (total * static_cast<long double>(w[i])) : 0.0L;
    }
    CAPTURE(n);
    CHECK(error <= 1e-11);
  }
}

// Each branch of a tree carries what enters the part beyond it.
TEST_CASE_TEMPLATE("a random tree with sources everywhere, drained at its root", Solver, MODELS) {
  const std::size_t n = 4000;
  std::mt19937_64 random(5);
  std::vector<std::uint32_t> parent(n, 0);
  edges branches;
  std::vector<double> w;
  std::vector<double> b(n);
  std::vector<double> s(n, 0.0);
  s[0] = 2;
  for (std::uint32_t i = 0; i < n; ++i) {
    b[i] = uniform(random);
    if (i > 0) {
      parent[i] = static_cast<std::uint32_t>(uniform(random) * i);
      branches.push_back({parent[i], i});
      w.push_back(std::pow(10.0, 8 * uniform(random) - 4));
    }
  }
  std::vector<long double> through(b.begin(), b.end());
  for (std::size_t i = n - 1; i > 0; --i) {
    through[parent[i]] += through[i];
  }
  std::vector<long double> truth(n);
  truth[0] = through[0] / 2;
  for (std::size_t i = 1; i < n; ++i) {
    truth[i] = truth[parent[i]] + through[i] / static_cast<long double>(w[i - 1]);
  }
  const std::vector<double> x = solved<Solver>(network_graph(n, branches), w, s, b, 1e-13);
  double error = 0;
  double size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    error = std::fmax(error, std::abs(static_cast<double>(static_cast<long double>(x[i]) - truth[i])));
    size = std::fmax(size, static_cast<double>(truth[i]));
  }
  CHECK(error <= 1e-11 * size);
}

// Rungs and rails of 1: seen from its end, an infinite ladder has the golden ratio for resistance.
TEST_CASE_TEMPLATE("an infinite ladder of unit resistors has the resistance of the golden ratio", Solver, MODELS) {
  const std::size_t cells = 40;  // each makes the end matter by a factor 1/6.85 less
  edges ladder;
  std::vector<double> w;
  std::vector<double> s(cells + 1, 1.0);  // rungs to the grounded rail
  std::vector<double> b(cells + 1, 0.0);
  for (std::uint32_t i = 0; i < cells; ++i) {
    ladder.push_back({i, i + 1});
    w.push_back(1.0);
  }
  s[0] = 0;
  b[0] = 1;
  const std::vector<double> x = solved<Solver>(network_graph(cells + 1, ladder), w, s, b, 1e-14);
  CHECK(x[0] == doctest::Approx((1 + std::sqrt(5.0)) / 2).epsilon(1e-13));
}

TEST_CASE("the factor gives every entry of the inverse to rounding, at any contrast") {
  // A chain tied to zero by 1e-200 at one end: x = Σ b / s there, whatever the conductances.
  const std::size_t n = 200;
  std::mt19937_64 random(3);
  edges chain;
  std::vector<double> w;
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    chain.push_back({i, i + 1});
    w.push_back(std::pow(10.0, 60 * uniform(random) - 30));
  }
  std::vector<double> s(n, 0.0);
  std::vector<double> b(n, 1.0);
  s[n - 1] = 1e-200;
  subtraction_free_ldlt<double> factor;
  const network_graph graph(n, chain);
  factor.analyze(graph);
  REQUIRE(factor.factorize(graph, w, s));
  std::vector<double> x(n);
  factor.apply(b, x);
  CHECK(x[n - 1] == doctest::Approx(200e200).epsilon(1e-13));
  CHECK(x[0] == doctest::Approx(200e200).epsilon(1e-13));
}
