// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/concept.hpp"
#include "tetrapore/solver/hierarchy.hpp"
#include "tetrapore/solver/pressure_system.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// \file
/// Conjugate gradients with aggregation multigrid.

namespace tetrapore::inline TETRAPORE_ABI {

template <std::floating_point Hierarchy = float>
class multigrid_solver {
 public:
  multigrid_solver() = default;
  explicit multigrid_solver(const hierarchy_options& how) : hierarchy_(how) {}

  void analyze(const network_graph& graph) {
    system_.analyze(graph);
    hierarchy_.analyze(graph);
    ready_ = false;
  }

  [[nodiscard]] solve_report factorize(std::span<const double> weights, std::span<const double> excess) {
    ready_ = false;
    const solve_report report = system_.factorize(weights, excess);
    if (!report.ok()) {
      return report;
    }
    hierarchy_.factorize(weights, excess);
    const std::size_t n = system_.size();
    weights_.resize(hierarchy_.entry_edges().size());
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      weights_[k] = weights[hierarchy_.entry_edges()[k]];
    }
    excess_.resize(n);
    inverse_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t node = hierarchy_.order()[i];
      excess_[i] = excess[node];
      const double diagonal = system_.diagonal()[node];
      inverse_[i] = diagonal > 0 ? 1 / diagonal : 0.0;
    }
    ready_ = true;
    return report;
  }

  [[nodiscard]] solve_report solve(std::span<const double> b, std::span<double> x, const solve_options& options = {}) {
    if (!ready_) {
      return {};
    }
    solve_report report = system_.begin(b, x, options);
    if (!report.ok()) {
      return report;
    }
    const std::size_t n = system_.size();
    const auto order = hierarchy_.order();
    b_.resize(n);
    x_.resize(n);
    r_.resize(n);
    p_.resize(n);
    q_.resize(n);
    double b_norm = 0;
    for (std::size_t i = 0; i < n; ++i) {
      b_[i] = system_.sources()[order[i]];
      x_[i] = options.warm && inverse_[i] > 0 ? x[order[i]] : 0.0;
      b_norm += b_[i] * b_[i] * inverse_[i];
    }
    iterate(options, std::sqrt(b_norm), report);
    for (std::size_t i = 0; i < n; ++i) {
      x[order[i]] = x_[i];
    }
    system_.finish(x, report);
    if (report.ok() && !(report.backward_error <= options.tolerance)) {
      report.reason = solve_status::not_converged;
    }
    return report;
  }

  [[nodiscard]] const pressure_system& system() const noexcept { return system_; }
  [[nodiscard]] const aggregation_hierarchy<Hierarchy>& hierarchy() const noexcept { return hierarchy_; }

 private:
  void iterate(const solve_options& options, double b_norm, solve_report& report) {
    const std::size_t n = system_.size();
    const double target = options.tolerance * b_norm;
    double norm = true_residual(options.warm);
    double rz = 0;
    const auto output = hierarchy_.output();
    for (; norm > target && report.iterations < options.max_iterations; ++report.iterations) {
      const double unit = aggregation_hierarchy<Hierarchy>::power_of_two_near(largest_);
      const double over = 1 / unit;
      const auto input = hierarchy_.input();
      for (std::size_t i = 0; i < n; ++i) {
        input[i] = static_cast<Hierarchy>(r_[i] * over);
      }
      double sum = 0;
      hierarchy_.cycle([&](std::size_t i, Hierarchy z) { sum += r_[i] * static_cast<double>(z); });
      const double back = unit * hierarchy_.scale();
      const double next = sum * back;
      const double beta = rz > 0 ? next / rz : 0.0;
      rz = next;
      for (std::size_t i = 0; i < n; ++i) {
        p_[i] = back * static_cast<double>(output[i]) + beta * p_[i];
      }
      const double energy = multiply();
      const double alpha = rz / energy;
#ifdef PROBE
      PROBE(*this, norm / b_norm, rz, report.iterations);
#endif
      norm = advance(alpha);
    }
    report.stop = norm <= target ? solve_stop::backward_error : solve_stop::max_iterations;
  }

  /// r = b − A x, flux by flux; its norm.
  double true_residual(bool from_x) noexcept {
    const auto& rows = hierarchy_.rows();
    double norm = 0;
    largest_ = 0;
    for (std::size_t i = 0; i < r_.size(); ++i) {
      double sum = b_[i];
      if (from_x) {
        sum -= excess_[i] * x_[i];
        for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k) {
          sum -= weights_[k] * (x_[i] - x_[rows.columns[k]]);
        }
      }
      r_[i] = sum;
      p_[i] = 0;
      norm += sum * sum * inverse_[i];
      largest_ = std::fmax(largest_, std::abs(sum));
    }
    return std::sqrt(norm);
  }
  /// q = A p; pᵀ q.
  double multiply() noexcept {
    const auto& rows = hierarchy_.rows();
    const double* const p = p_.data();
    double energy = 0;
    for (std::size_t i = 0; i < q_.size(); ++i) {
      double sum = excess_[i] * p[i];
      for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k) {
        sum += weights_[k] * (p[i] - p[rows.columns[k]]);
      }
      q_[i] = sum;
      energy += sum * p[i];
    }
    return energy;
  }
  /// x += α p, r −= α q; the norm of r.
  double advance(double alpha) noexcept {
    double norm = 0;
    double largest = 0;
    for (std::size_t i = 0; i < r_.size(); ++i) {
      x_[i] += alpha * p_[i];
      const double r = r_[i] - alpha * q_[i];
      r_[i] = r;
      norm += r * r * inverse_[i];
      largest = std::abs(r) > largest ? std::abs(r) : largest;
    }
    largest_ = largest;
    return std::sqrt(norm);
  }
#ifdef PROBE
 public:
#endif
  pressure_system system_;
  aggregation_hierarchy<Hierarchy> hierarchy_;
  bool ready_ = false;
  // in the numbering of the hierarchy
  std::vector<double> weights_, excess_, inverse_;
  std::vector<double> b_, x_, r_, p_, q_;
  double largest_ = 0;  // |r_i|
};
static_assert(network_solver<multigrid_solver<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
