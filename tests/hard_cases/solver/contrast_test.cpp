// SPDX-License-Identifier: BSD-3-Clause
#include "support/pressure_truth.hpp"
#include "support/sanitized.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <doctest/doctest.h>

using namespace tetrapore;

#define MODELS multigrid_solver<float>, multigrid_solver<double>, ldlt_solver<>

namespace {

template <class Solver>
void solves(const pressure_case& c, std::span<const long double> truth) {
  Solver solver;
  solver.analyze(c.graph);
  REQUIRE(solver.factorize(c.w, c.s).ok());
  std::vector<double> x(c.b.size());
  const solve_report report = solver.solve(c.b, x);
  CHECK_MESSAGE(report.ok(), describe(report.reason));
  CHECK(report.backward_error <= 1e-10);
  CHECK(relative_error(x, truth) <= 1e-8);
}

double contrast(const pressure_case& c) {
  const auto [low, high] = std::minmax_element(c.w.begin(), c.w.end());
  return *high / *low;
}

}  // namespace

TEST_CASE("the two ways to the truth agree to 1e-15") {
  for (const double power : {1.0, 2.0}) {
    pressure_case c = packing_like(8, power, 11);
    scale_some(c, 0.4, 1e-18, 3);
    const auto dense = dense_truth(c);
    const auto refined = refined_truth<multigrid_solver<double>>(c);
    const std::vector<double> rounded(refined.begin(), refined.end());
    CHECK(relative_error(rounded, dense) < 1e-15);
  }
}

TEST_CASE_TEMPLATE("a dense oracle of 1000 nodes: the true error stays below 1e-8 at any contrast", Solver, MODELS) {
  for (const double power : {1.0, 1.4, 2.0}) {
    for (const auto& [share, factor] : {std::pair{0.0, 1.0}, {0.1, 1e-10}, {0.4, 1e-18}}) {
      pressure_case c = packing_like(9, power, 5);
      scale_some(c, share, factor, 9);
      CAPTURE(power);
      CAPTURE(share);
      solves<Solver>(c, dense_truth(c));
    }
  }
}

TEST_CASE_TEMPLATE("16,000 nodes: the true error stays below 1e-8 at any contrast", Solver, multigrid_solver<float>,
                   multigrid_solver<double>) {
  struct row {
    double power, share, factor, contrast;
  };
  for (const row& r : {row{1.4, 0, 1, 9e11}, row{2.0, 0, 1, 1.2e17}, row{1.0, 0.1, 1e-10, 1e18},
                       row{1.4, 0.1, 1e-10, 1e20}, row{2.0, 0.1, 1e-10, 1e25}, row{1.0, 0.4, 1e-18, 1e25},
                       row{1.4, 0.4, 1e-18, 1e28}, row{2.0, 0.4, 1e-18, 1e33}}) {
    if (sanitized && r.power < 2) {
      continue;
    }
    pressure_case c = packing_like(25, r.power, 21);
    scale_some(c, r.share, r.factor, 4);
    CAPTURE(r.power);
    CAPTURE(r.factor);
    CHECK(contrast(c) > r.contrast);
    solves<Solver>(c, refined_truth<multigrid_solver<double>>(c));
  }
}

TEST_CASE_TEMPLATE("sources in nearly sealed pores are solved to 1e-8", Solver, MODELS) {
  pressure_case c = packing_like(9, 1.0, 6);
  scale_some(c, 0.5, 1e-12, 8);
  std::mt19937_64 random(2);
  for (double& b : c.b) {
    b = static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5;
  }
  solves<Solver>(c, dense_truth(c));
}

TEST_CASE_TEMPLATE("numbers near the ends of the range of double are solved to 1e-8", Solver, MODELS) {
  for (const auto& [unit, source] : {std::pair{1e-280, 1.0}, {1e280, 1.0}, {1.0, 1e-280}, {1e-150, 1e-150}}) {
    pressure_case c = packing_like(9, 1.0, 7);
    for (std::vector<double>* v : {&c.w, &c.s}) {
      for (double& number : *v) {
        number *= unit;
      }
    }
    for (double& b : c.b) {
      b *= source;
    }
    CAPTURE(unit);
    CAPTURE(source);
    if (unit == 1e-280) {  // x is near 1e280
      for (double& b : c.b) {
        b *= 1e-10;
      }
    }
    solves<Solver>(c, dense_truth(c));
  }
}
