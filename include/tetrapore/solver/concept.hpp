// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/graph.hpp"
#include "tetrapore/solver/solve_report.hpp"

#include <concepts>
#include <span>

/// \file
/// What a driver asks of a solver of the pressure system Σ_j w_ij (x_i − x_j) + s_i x_i = b_i.

namespace tetrapore::inline TETRAPORE_ABI {

/// A solver of pressure systems on a graph: conductances w of its edges, excess s of its nodes, sources b.
///
/// Syntax: `s.analyze(graph)`; `s.factorize(w, s)` with one w per edge and one s per node; `s.solve(b, x)` and
/// `s.solve(b, x, options)` with one b and one x per node. The last two answer with a solve_report.
///
/// Semantics:
/// - the matrix is given by w ≥ 0 and s ≥ 0, never by its diagonal; x solves the system to the accuracy that the report
///   states, or the report says why not. Nothing but `analyze` throws, and that only for want of memory.
/// - weights, excess and sources that are NaN, infinite, or (w, s) negative are refused and named by their index; after
///   a refusal x is unchanged.
/// - edges with w = 0 do not connect. A cluster of nodes without excess is solvable if its sources sum to zero (to the
///   bound of solve_options); x has zero mean there. Otherwise the report names the cluster by its first node and size.
/// - with `options.warm`, x on entry is a guess; a direct solver may ignore it.
/// - factorize and solve may be called any number of times; w, s are copied as far as they are needed.
/// - the same input gives the same bits.
///
/// Models: multigrid_solver, ldlt_solver; those of solver/eigen.hpp and solver/cholmod.hpp.
template <class S>
concept network_solver =
    requires(S s, const network_graph& graph, std::span<const double> in, std::span<double> x, solve_options options) {
      s.analyze(graph);
      { s.factorize(in, in) } -> std::same_as<solve_report>;
      { s.solve(in, x) } -> std::same_as<solve_report>;
      { s.solve(in, x, options) } -> std::same_as<solve_report>;
    };

}  // namespace tetrapore::inline TETRAPORE_ABI
