// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/graph.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// \file
/// A graph from the rows of a symmetric matrix, checked.

namespace tetrapore::inline TETRAPORE_ABI {

/// A graph and one weight per edge.
struct weighted_graph {
  network_graph graph;
  std::vector<double> weights;
};

/// A graph from the rows of a symmetric matrix without its diagonal (compressed rows).
/// \param offsets     row i is the range offsets[i] … offsets[i + 1] of the next two
/// \param neighbours  column of each entry
/// \param weights     weight of each entry, the same in both rows of an edge
/// \throw network_error  rows that do not fit together, a diagonal entry, an entry without its mirror, or two that
///                       differ; names the row
[[nodiscard]] inline weighted_graph graph_of_rows(std::span<const std::size_t> offsets,
                                                  std::span<const std::uint32_t> neighbours,
                                                  std::span<const double> weights) {
  const auto row_name = [](std::size_t i) { return "row " + std::to_string(i); };
  if (offsets.empty() || offsets.front() != 0 || offsets.back() != neighbours.size() ||
      weights.size() != neighbours.size()) {
    throw network_error(
        "rows", std::to_string(neighbours.size()) + " columns and " + std::to_string(weights.size()) + " weights",
        "offsets from 0 to the number of columns, and a weight for each");
  }
  const std::size_t n = offsets.size() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    if (offsets[i + 1] < offsets[i] || offsets[i + 1] > neighbours.size()) {
      throw network_error(row_name(i), "an end at " + std::to_string(offsets[i + 1]), "offsets that never decrease");
    }
  }
  struct entry {
    std::uint32_t low, high;
    bool mirrored;
    double weight;
  };
  std::vector<entry> entries;
  entries.reserve(neighbours.size());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = offsets[i]; k < offsets[i + 1]; ++k) {
      const std::uint32_t j = neighbours[k];
      if (j >= n || j == i) {
        throw network_error(row_name(i), "column " + std::to_string(j), "another column below " + std::to_string(n));
      }
      const auto own = static_cast<std::uint32_t>(i);
      entries.push_back({std::min(own, j), std::max(own, j), own > j, weights[k]});
    }
  }
  const auto key = [](const entry& a) { return std::array{a.low, a.high}; };
  std::stable_sort(entries.begin(), entries.end(), [&](const entry& a, const entry& b) { return key(a) < key(b); });
  weighted_graph made;
  std::vector<network_graph::edge> edges;
  std::vector<double> one_way;
  std::vector<double> back;
  for (std::size_t begin = 0; begin < entries.size();) {
    one_way.clear();
    back.clear();
    std::size_t end = begin;
    for (; end < entries.size() && key(entries[end]) == key(entries[begin]); ++end) {
      (entries[end].mirrored ? back : one_way).push_back(entries[end].weight);
    }
    const auto [low, high] = key(entries[begin]);
    if (one_way.size() != back.size()) {
      throw network_error(
          row_name(one_way.size() > back.size() ? low : high),
          "an entry for row " + std::to_string(one_way.size() > back.size() ? high : low) + " without its mirror",
          "a symmetric matrix");
    }
    for (std::size_t k = 0; k < one_way.size(); ++k) {
      if (!(one_way[k] == back[k])) {
        throw network_error(row_name(low),
                            short_number(one_way[k]) + " for row " + std::to_string(high) + ", whose own differs by " +
                                short_number(back[k] - one_way[k]),
                            "a symmetric matrix");
      }
      edges.push_back({low, high});
      made.weights.push_back(one_way[k]);
    }
    begin = end;
  }
  made.graph = network_graph(n, std::move(edges));
  return made;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
