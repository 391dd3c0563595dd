// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/flow_job.hpp"
#include "support/stopwatch.hpp"

#include "tetrapore/law/conductance.hpp"
#include "tetrapore/solver/cholmod.hpp"
#include "tetrapore/solver/concept.hpp"
#include "tetrapore/solver/eigen.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <utility>
#include <variant>

/// \file
/// A law and a solver that are chosen on the command line: a model of the concept around a variant. A simulator that
/// knows its law and solver names them as template arguments instead.

namespace support {

/// A conductance law chosen at run time.
struct chosen_law {
  std::variant<tp::hydraulic_radius, tp::mean_radius, tp::calibrated> law;

  explicit chosen_law(const flow_job& job)
      : law(tp::hydraulic_radius{.viscosity = job.viscosity, .wall = condition(job)}) {
    if (job.law == "mean_radius") {
      law = tp::mean_radius{.viscosity = job.viscosity};
    } else if (job.law == "calibrated") {
      law = tp::calibrated{.viscosity = job.viscosity, .wall = condition(job)};
    }
  }

  [[nodiscard]] static tp::wall_condition condition(const flow_job& job) {
    return job.slip ? tp::wall_condition::slip : tp::wall_condition::no_slip;
  }
  [[nodiscard]] tp::outcome<double, tp::conductance_status> conductance(const tp::throat<double>& t) const noexcept {
    if (const auto* l = std::get_if<tp::mean_radius>(&law)) {
      return l->conductance(t);
    }
    if (const auto* l = std::get_if<tp::calibrated>(&law)) {
      return l->conductance(t);
    }
    return std::get_if<tp::hydraulic_radius>(&law)->conductance(t);
  }
};
static_assert(tp::conductance_law<chosen_law>);

/// A solver chosen at run time, which tells how long each part took.
class chosen_solver {
 public:
  explicit chosen_solver(const flow_job& job) {
    if (job.solver == "ldlt") {
      solver_.emplace<tp::eigen_ldlt_solver>();
    } else if (job.solver == "cg") {
      solver_.emplace<tp::eigen_cg_solver<>>();
    } else if (job.solver == "cholmod") {
      solver_.emplace<tp::cholmod_solver>();
    }
  }

  void analyze(const tp::network_graph& graph) {
    stopwatch watch;
    std::visit([&](auto& s) { s.analyze(graph); }, solver_);
    setup_ += watch.lap();
  }
  [[nodiscard]] tp::solve_report factorize(std::span<const double> w, std::span<const double> s) {
    stopwatch watch;
    const tp::solve_report report = std::visit([&](auto& solver) { return solver.factorize(w, s); }, solver_);
    setup_ += watch.lap();
    return report;
  }
  [[nodiscard]] tp::solve_report solve(std::span<const double> b, std::span<double> x, tp::solve_options how = {}) {
    stopwatch watch;
    const tp::solve_report report = std::visit([&](auto& s) { return s.solve(b, x, how); }, solver_);
    solve_ = watch.lap();
    return report;
  }

  /// Seconds of analyze and factorize so far, and of the last solve.
  [[nodiscard]] double setup_seconds() const { return setup_; }
  [[nodiscard]] double solve_seconds() const { return solve_; }

 private:
  std::variant<tp::multigrid_solver<>, tp::eigen_ldlt_solver, tp::eigen_cg_solver<>, tp::cholmod_solver> solver_;
  double setup_ = 0;
  double solve_ = 0;
};
static_assert(tp::network_solver<chosen_solver>);

}  // namespace support
