// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/graph.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// \file
/// A pressure system as an assembled matrix, for factorisations that need one.

namespace tetrapore::inline TETRAPORE_ABI {

/// The lower triangle of the matrix of a graph, by columns, diagonal first, rows ascending; edges between the same two
/// nodes share an entry. The pattern is made once and holds every edge, also those whose conductance is zero.
/// \par Accuracy  each diagonal is a sum that rounds: where conductances differ by a factor c within a row, the small
/// ones lose their digits beyond 1/(c ε). Solve with it, but measure the residual on w and s
template <class Index>
class lower_triangle {
 public:
  lower_triangle() : offsets_(1, Index(0)) {}

  /// \throw network_error  a graph with more nodes and edges than Index can count
  explicit lower_triangle(const network_graph& graph) : offsets_(graph.node_count() + 1), edges_(graph.edge_count()) {
    if (graph.node_count() + graph.edge_count() > static_cast<std::uint64_t>(std::numeric_limits<Index>::max())) {
      throw network_error(
          "graph", std::to_string(graph.node_count()) + " nodes and " + std::to_string(graph.edge_count()) + " edges",
          "at most " + std::to_string(std::numeric_limits<Index>::max()) + " in all");
    }
    const std::size_t n = graph.node_count();
    rows_.reserve(n + graph.edge_count());
    std::vector<std::array<std::uint32_t, 2>> below;  // row, edge
    for (std::size_t j = 0; j < n; ++j) {
      below.clear();
      const auto next = graph.neighbours(j);
      const auto by = graph.incident_edges(j);
      for (std::size_t k = 0; k < next.size(); ++k) {
        if (next[k] > j) {
          below.push_back({next[k], by[k]});
        }
      }
      std::sort(below.begin(), below.end());
      offsets_[j] = static_cast<Index>(rows_.size());
      rows_.push_back(static_cast<Index>(j));
      for (const auto& [row, edge] : below) {
        if (rows_.back() != static_cast<Index>(row)) {
          rows_.push_back(static_cast<Index>(row));
        }
        edges_[edge] = static_cast<Index>(rows_.size() - 1);
      }
    }
    offsets_[n] = static_cast<Index>(rows_.size());
  }

  /// The entries of Σ_j w_ij (x_i − x_j) + s_i x_i, in the order of rows().
  void fill(const network_graph& graph, std::span<const double> weights, std::span<const double> excess,
            std::span<double> values) const noexcept {
    std::fill(values.begin(), values.end(), 0.0);
    const auto diagonal = [&](std::size_t i) -> double& { return values[static_cast<std::size_t>(offsets_[i])]; };
    for (std::size_t i = 0; i < excess.size(); ++i) {
      diagonal(i) = excess[i];
    }
    const auto edges = graph.edges();
    for (std::size_t e = 0; e < weights.size(); ++e) {
      diagonal(edges[e][0]) += weights[e];
      diagonal(edges[e][1]) += weights[e];
      values[static_cast<std::size_t>(edges_[e])] -= weights[e];
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return offsets_.size() - 1; }
  /// Column j is the range offsets()[j] … offsets()[j + 1] of rows().
  [[nodiscard]] std::span<const Index> offsets() const noexcept { return offsets_; }
  [[nodiscard]] std::span<const Index> rows() const noexcept { return rows_; }

 private:
  std::vector<Index> offsets_;
  std::vector<Index> rows_;
  std::vector<Index> edges_;  // entry of each edge
};

}  // namespace tetrapore::inline TETRAPORE_ABI
