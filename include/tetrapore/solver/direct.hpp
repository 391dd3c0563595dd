// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/concept.hpp"
#include "tetrapore/solver/pressure_system.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

/// \file
/// A network_solver around any factorization.

namespace tetrapore::inline TETRAPORE_ABI {

/// A factorization of the matrix of a pressure system.
/// Syntax: `f.analyze(graph)`; `f.factorize(graph, w, s)`, true when the factor exists; `f.apply(b, x)`, x = A⁻¹ b,
/// true when it was done; else x is unchanged, for want of memory.
/// Semantics: s is such that A is definite (floating clusters are grounded). b and x do not overlap.
/// Models: subtraction_free_ldlt; the factors of solver/eigen.hpp and solver/cholmod.hpp.
template <class F>
concept pressure_factor = std::default_initializable<F> &&
                          requires(F f, const network_graph& graph, std::span<const double> in, std::span<double> x) {
                            f.analyze(graph);
                            { f.factorize(graph, in, in) } -> std::same_as<bool>;
                            { f.apply(in, x) } -> std::same_as<bool>;
                          };

/// Solves with a factor, and refines the solution by residuals in flux form until the scaled residual
/// ‖D^-½ r‖ / ‖D^-½ b‖ is below the tolerance, or corrections no longer halve. A factor of an assembled matrix has a
/// member `refinements()`: where that is above 0, the solution is refined so often at least, and on until the next
/// correction promises less than 1e-12 of x. With options.warm it begins from x instead of the factor's solution.
/// The next correction that the last ones promise is the estimated error; a solution that was not refined has none,
/// and is judged by its backward error alone.
/// \par Accuracy  that of the factor where it is subtraction-free; else refinement mends what assembling the diagonal
/// lost as long as the factor is right in its first digit
template <pressure_factor Factor>
class direct_solver {
 public:
  direct_solver() = default;
  explicit direct_solver(Factor factor) : factor_(std::move(factor)) {}

  void analyze(const network_graph& graph) {
    system_.analyze(graph);
    factor_.analyze(graph);
    ready_ = false;
  }

  [[nodiscard]] solve_report factorize(std::span<const double> weights, std::span<const double> excess) {
    ready_ = false;
    solve_report report = system_.factorize(weights, excess);
    if (report.ok()) {
      ready_ = factor_.factorize(system_.graph(), system_.weights(), system_.grounded_excess());
      report.reason = ready_ ? solve_status::ok : solve_status::factorization_failed;
    }
    return report;
  }

  [[nodiscard]] solve_report solve(std::span<const double> b, std::span<double> x, const solve_options& options = {}) {
    return refined(b, x, options, options.warm ? origin::caller : origin::none);
  }

  /// Whether there is a factor to solve with.
  [[nodiscard]] bool ready() const noexcept { return ready_; }
  [[nodiscard]] const pressure_system& system() const noexcept { return system_; }
  [[nodiscard]] const Factor& factor() const noexcept { return factor_; }
  [[nodiscard]] Factor& factor() noexcept { return factor_; }

 protected:
  /// Whose x is on entry.
  enum class origin { none, caller, factor };

  [[nodiscard]] solve_report refined(std::span<const double> b, std::span<double> x, const solve_options& options,
                                     origin from) {
    if (!ready_) {
      return {};
    }
    solve_report report = system_.begin(b, x, options);
    if (!report.ok()) {
      return report;
    }
    if (from == origin::none && !factor_.apply(system_.sources(), x)) {
      report.reason = solve_status::no_memory;
      return report;
    }
    system_.center(x);
    report.stop = solve_stop::direct;
    residual_.resize(x.size());
    correction_.resize(x.size());
    const double target = options.tolerance * system_.scaled_norm(system_.sources());
    std::size_t wanted = 0;
    if constexpr (requires { factor_.refinements(); }) {
      wanted = factor_.refinements();
    }
    double change = largest(x);  // of the last correction; at first x stands for it
    double left = 0;             // what the next correction is expected to be
    for (bool start = from == origin::caller;; start = false) {
      system_.residual(system_.sources(), x, residual_);
      const double scaled = system_.scaled_norm(residual_);
      const bool due = scaled > target || report.iterations < wanted || (wanted > 0 && left > 1e-12 * largest(x));
      if (!due || !(scaled > 0) || report.iterations >= options.max_iterations) {
        report.error_estimate = scaled > 0 || start ? report.error_estimate : 0.0;  // nothing is left of the residual
        break;
      }
      if (!factor_.apply(residual_, correction_)) {
        report.reason = solve_status::no_memory;
        break;
      }
      system_.center(correction_);
      const double next = largest(correction_);
      const bool falls = next <= 0.5 * change;
      if (!falls && !start) {
        report.error_estimate = relative(next, x);
        report.stop = report.error_estimate <= options.error_target() ? solve_stop::direct : solve_stop::stagnated;
        break;
      }
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] += correction_[i];
      }
      ++report.iterations;
      // the correction of a caller's start tells how far that was, not how good the factor is
      left = start ? next : next * (next / change);
      report.error_estimate = start ? -1.0 : relative(left, x);
      change = next;
    }
    system_.finish(x, options, report);
    return report;
  }

 private:
  [[nodiscard]] static double relative(double error, std::span<const double> x) noexcept {
    return error > 0 ? error / largest(x) : 0.0;
  }
  [[nodiscard]] static double largest(std::span<const double> v) noexcept {
    double most = 0;
    for (const double e : v) {
      most = std::abs(e) > most ? std::abs(e) : most;
    }
    return most;
  }

  pressure_system system_;
  Factor factor_;
  bool ready_ = false;
  std::vector<double> residual_;
  std::vector<double> correction_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
