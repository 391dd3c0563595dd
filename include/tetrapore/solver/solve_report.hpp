// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"

#include <cstddef>
#include <limits>

/// \file
/// What a solver of a pressure system is asked for, and what it answers.

namespace tetrapore::inline TETRAPORE_ABI {

/// Whether a pressure system was solved, and if not, why.
enum class solve_status : unsigned char {
  ok,
  not_factorized,        ///< solve before analyze and factorize, or after a factorize that was refused
  wrong_size,            ///< an array that does not fit the graph
  invalid_weight,        ///< a conductance that is negative, infinite or NaN; `index` is its edge
  invalid_excess,        ///< an excess that is negative, infinite or NaN; `index` is its node
  invalid_source,        ///< a source that is infinite or NaN; `index` is its node
  invalid_start,         ///< a warm start that is infinite or NaN; `index` is its node
  unbalanced_cluster,    ///< a cluster without excess whose sources do not sum to zero; `index` is its first node
  out_of_range,          ///< weights and sources whose solution or its residual is no finite number; `index` is a node
  not_converged,         ///< `stop` says how it ended; x holds the best iterate
  factorization_failed,  ///< the factor does not exist in this arithmetic, or did not fit in memory
  no_memory              ///< there is a factor, but no memory to apply it in
};

[[nodiscard]] constexpr verdict verdict_of(solve_status s) noexcept {
  switch (s) {
    case solve_status::ok: return verdict::ok;
    case solve_status::not_converged:
    case solve_status::out_of_range:
    case solve_status::factorization_failed:
    case solve_status::no_memory: return verdict::failed;
    default: return verdict::refused;
  }
}

[[nodiscard]] constexpr const char* describe(solve_status s) noexcept {
  switch (s) {
    case solve_status::ok: return "solved";
    case solve_status::not_factorized: return "no factorization: call analyze and factorize first";
    case solve_status::wrong_size: return "an array that does not fit the graph";
    case solve_status::invalid_weight: return "a conductance that is negative, infinite or NaN";
    case solve_status::invalid_excess: return "an excess that is negative, infinite or NaN";
    case solve_status::invalid_source: return "a source that is infinite or NaN";
    case solve_status::invalid_start: return "a warm start that is infinite or NaN";
    case solve_status::unbalanced_cluster:
      return "a cluster that nothing ties to a level, and whose sources do not sum to zero: no pressure solves it. "
             "Give it a boundary with a pressure, a compressibility, or balanced sources";
    case solve_status::out_of_range: return "numbers so large or so small that the solution is not finite";
    case solve_status::not_converged:
      return "the residual or the estimated error is still above what the tolerance allows. The usual causes: too few "
             "iterations, a tolerance below what rounding allows, or sources in pores that are nearly sealed";
    case solve_status::factorization_failed: return "no factor in this arithmetic, or no memory for it";
    case solve_status::no_memory: return "no memory to apply the factor in";
  }
  return "not a status";
}

/// What ended a solution. Only `direct` and `converged` can go with solve_status::ok.
enum class solve_stop : unsigned char {
  none,       ///< nothing was iterated: refused
  direct,     ///< a factor was applied, and its solution refined as far as that was due
  converged,  ///< an iteration has reached what solve_options::tolerance asks for
  stagnated,  ///< it has not, and further work no longer helps
  max_iterations
};

[[nodiscard]] constexpr const char* describe(solve_stop s) noexcept {
  switch (s) {
    case solve_stop::none: return "nothing was solved";
    case solve_stop::direct: return "direct";
    case solve_stop::converged: return "converged";
    case solve_stop::stagnated: return "stagnated";
    case solve_stop::max_iterations: return "largest number of iterations";
  }
  return "not a stop";
}

/// How a system is to be solved.
///
/// The same for every solver: a solution is `ok` when
/// - its backward error ‖r‖ / (‖b‖ + ‖A‖ ‖x‖), with r evaluated anew from the x that is returned, is at most
///   `tolerance`, in the largest norm;
/// - and its estimated error, where the solver has an estimate, is at most `error_target()`.
///
/// The second asks for more, for a normwise backward error of 1e-10 is reached by an x that is wrong altogether where
/// conductances differ by more than 1e10. Iterative solvers also carry their first run on until the scaled residual
/// ‖D^-½ r‖ / ‖D^-½ b‖, D the diagonal, is below `tolerance`; in it a sealed pore counts as much as a wide one. What
/// is left of it after that is rounding in stiff pairs, and the two conditions above decide.
struct solve_options {
  double tolerance = 1e-10;
  std::size_t max_iterations = 500;  ///< of an iterative solver
  bool warm = false;                 ///< x holds a guess on entry
  /// A cluster without excess is balanced when |Σ b| ≤ balance · Σ |b| + balance_floor over its nodes. What is left of
  /// Σ b is taken off its nodes in equal parts.
  double balance = 1e-12;
  double balance_floor = 0;  ///< [unit of b] round-off of sources that were themselves made by subtraction

  /// What the estimated error of x may be, relative to the largest |x|.
  [[nodiscard]] constexpr double error_target() const noexcept { return 10 * tolerance; }
};

/// What became of a system; `factorize` fills what it knows.
struct solve_report {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  solve_status reason = solve_status::not_factorized;
  solve_stop stop = solve_stop::none;
  std::size_t iterations = 0;
  /// Largest |r_i|, with r_i = b_i − Σ w_ij (x_i − x_j) − s_i x_i evaluated anew from the x that is returned.
  double residual = 0;
  std::size_t worst_node = none;  ///< where it is
  /// ‖r‖ / (‖b‖ + ‖A‖ ‖x‖) in the largest norm, of the x that is returned.
  double backward_error = 0;
  /// Estimated largest error of x over the largest |x|; negative: not estimated. Iterative solvers apply a V-cycle to
  /// the residual evaluated anew; direct solvers take the last correction, where the solution was refined.
  ///
  /// An estimate, not a bound. A V-cycle shows an error that is smooth within a cluster of well-connected pores in its
  /// right order (true errors up to 20 times the estimate have been seen), but rounding of x limits what any residual
  /// can show: of two clusters joined by conductances below ε of those inside them, the level of one against the other
  /// is only as good as the sums of their fluxes.
  double error_estimate = -1;
  std::size_t index = none;           ///< node or edge that the reason is about
  std::size_t clusters = 0;           ///< connected by positive conductances; an isolated node is one
  std::size_t floating_clusters = 0;  ///< those without excess
  std::size_t cluster_size = 0;       ///< of an unbalanced cluster
  double imbalance = 0;               ///< Σ b of the unbalanced cluster [unit of b]

  [[nodiscard]] verdict kind() const noexcept { return verdict_of(reason); }
  [[nodiscard]] bool ok() const noexcept { return reason == solve_status::ok; }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
