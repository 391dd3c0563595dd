// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "support/dense_packing.hpp"
#include "support/sanitized.hpp"
#include "support/pressure_truth.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/one_phase/flow.hpp"
#include "tetrapore/solver/cholmod.hpp"
#include "tetrapore/solver/eigen.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

// The conductances of a packing as they come, with their contrast stretched by a power, and with throats that are
// nearly closed: every solver against the solution in extended precision.

using namespace tetrapore;

namespace {

struct contrast_case {
  double power;   ///< that the conductances are raised to
  double share;   ///< of the throats that is nearly closed
  double factor;  ///< by which
  double contrast;
  pressure_case system;
  std::vector<long double> truth;
};

/// Pressure 1 at one face of a packing and 0 at the opposite one, by the hydraulic radius: the conductances as they
/// are and two powers of them, each plain, with a tenth of the throats × 1e-10, and with four tenths × 1e-18.
const std::vector<contrast_case>& cases() {
  static const std::vector<contrast_case> all = [] {
    const packing p = dense_packing(sanitized ? 1000 : 3000);
    const network net = compiled_triangulation{}(p.grains, domain_of(p)).net;
    flow_options options;
    options.conditions.at(face::y_min) = held_pressure(1.0);
    options.conditions.at(face::y_max) = held_pressure(0.0);
    options.refused = refused_throats::closed;
    const saturated_flow flow(net, hydraulic_radius{.viscosity = 1.0}, ldlt_solver<>{}, options);
    const flow_system& system = flow.system();
    std::vector<contrast_case> made;
    for (const double power : {1.0, 1.4, 2.0}) {
      for (const auto& [share, factor] : {std::pair{0.0, 1.0}, {0.1, 1e-10}, {0.4, 1e-18}}) {
        contrast_case c{power, share, factor, 1.0, {}, {}};
        std::mt19937_64 random(11);
        std::vector<double> k = flow.conductances().values;
        double largest = 0;
        double smallest = infinity<double>;
        for (double& w : k) {
          const bool chosen = static_cast<double>(random() >> 11U) * 0x1p-53 < share;
          w = w > 0 ? std::pow(w, power) * (chosen ? factor : 1.0) : 0.0;
          largest = std::max(largest, w);
          smallest = w > 0 ? std::min(smallest, w) : smallest;
        }
        c.contrast = largest / smallest;
        c.system = {system.graph(), system.edge_weights(k), system.excess(k, 0.0),
                    system.sources(net, k, system.inflow({})).b};
        c.truth = refined_truth<ldlt_solver<>>(c.system);
        made.push_back(std::move(c));
      }
    }
    return made;
  }();
  return all;
}

struct outcome_of_run {
  bool ok;
  double error;  ///< largest true error of x over the largest pressure
};

template <class Solver>
outcome_of_run run(const contrast_case& c) {
  Solver solver;
  solver.analyze(c.system.graph);
  std::vector<double> x(c.system.b.size());
  if (!solver.factorize(c.system.w, c.system.s).ok()) {
    return {false, infinity<double>};
  }
  const bool ok = solver.solve(c.system.b, x).ok();
  return {ok, relative_error(x, c.truth)};
}

}  // namespace

TEST_CASE("the truth does not depend on the solver that finds it, and the cases are as hard as they should be") {
  REQUIRE(cases().size() == 9);
  for (const contrast_case& c : cases()) {
    CHECK(c.truth.size() > (sanitized ? 4000 : 10000));
    const auto again = refined_truth<multigrid_solver<double>>(c.system);
    long double difference = 0;
    for (std::size_t i = 0; i < again.size(); ++i) {
      difference = std::max(difference, std::abs(again[i] - c.truth[i]));
    }
    CHECK(difference < 1e-14L);
  }
  CHECK(cases()[3].contrast > 9e11);
  CHECK(cases()[6].contrast > 1.2e17);
}

TEST_CASE_TEMPLATE("solves every case, with a true error of at most 1e-8", Solver, multigrid_solver<float>,
                   multigrid_solver<double>, ldlt_solver<>) {
  double worst = 0;
  for (const contrast_case& c : cases()) {
    CAPTURE(c.power);
    CAPTURE(c.factor);
    const auto [ok, error] = run<Solver>(c);
    CHECK(ok);
    CHECK(error <= 1e-8);
    worst = std::max(worst, error);
  }
  MESSAGE("largest true error " << worst);
}

TEST_CASE_TEMPLATE("has a true error of at most 1e-8, or says that it did not solve the case", Solver, cholmod_solver,
                   eigen_ldlt_solver, eigen_cg_solver<>) {
  double worst = 0;
  std::size_t refused = 0;
  for (const contrast_case& c : cases()) {
    CAPTURE(c.power);
    CAPTURE(c.factor);
    const auto [ok, error] = run<Solver>(c);
    if (!ok) {
      ++refused;
      CHECK(c.factor < 1);  // what a packing has of itself is no excuse
      continue;
    }
    CHECK(error <= 1e-8);
    worst = std::max(worst, error);
  }
  MESSAGE("largest true error " << worst << " of those solved; " << refused << " not solved");
}
