// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// The graph that a pressure system lives on.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// Owns one immutable T together with its copies, and counts them. std::shared_ptr would do, at 15,000 lines for every
/// header that sees a graph.
template <class T>
class shared_constant {
 public:
  explicit shared_constant(T&& value) : held_(new counted{std::move(value), {1}}) {}
  shared_constant(const shared_constant& other) noexcept : held_(other.held_) {
    held_->owners.fetch_add(1, std::memory_order_relaxed);
  }
  shared_constant& operator=(const shared_constant& other) noexcept {
    shared_constant(other).swap(*this);
    return *this;
  }
  ~shared_constant() {
    if (held_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) {
      delete held_;
    }
  }
  [[nodiscard]] const T* operator->() const noexcept { return &held_->value; }
  [[nodiscard]] bool operator==(const shared_constant& other) const noexcept { return held_ == other.held_; }

 private:
  struct counted {
    T value;
    std::atomic<std::size_t> owners;
  };
  void swap(shared_constant& other) noexcept { std::swap(held_, other.held_); }
  counted* held_;
};

}  // namespace detail

/// Nodes 0 … n-1 and undirected edges between them, with the rows made once. Two nodes may share several edges; no edge
/// joins a node to itself. Immutable: copies share one set of arrays, so a solver keeps a graph at no cost.
/// \par Thread safety  all members may be called from any number of threads.
class network_graph {
 public:
  using edge = std::array<std::uint32_t, 2>;

  network_graph() : network_graph(0, {}) {}

  /// \throw network_error  an edge that ends outside 0 … n-1 or where it begins; names the edge
  network_graph(std::size_t nodes, std::vector<edge> edges) : arrays_(made_of(nodes, std::move(edges))) {}

  [[nodiscard]] std::size_t node_count() const noexcept { return arrays_->offsets.size() - 1; }
  [[nodiscard]] std::size_t edge_count() const noexcept { return arrays_->edges.size(); }
  /// The two ends of each edge, in the order given.
  [[nodiscard]] std::span<const edge> edges() const noexcept { return arrays_->edges; }
  [[nodiscard]] std::size_t degree(std::size_t i) const noexcept {
    return arrays_->offsets[i + 1] - arrays_->offsets[i];
  }
  /// The nodes next to node i, once per edge.
  [[nodiscard]] std::span<const std::uint32_t> neighbours(std::size_t i) const noexcept {
    return row(arrays_->neighbours, i);
  }
  /// The edges to those nodes, in the same order.
  [[nodiscard]] std::span<const std::uint32_t> incident_edges(std::size_t i) const noexcept {
    return row(arrays_->incident, i);
  }
  /// Row i is the range offsets()[i] … offsets()[i + 1] of all_neighbours() and all_incident_edges().
  [[nodiscard]] std::span<const std::uint32_t> offsets() const noexcept { return arrays_->offsets; }
  [[nodiscard]] std::span<const std::uint32_t> all_neighbours() const noexcept { return arrays_->neighbours; }
  [[nodiscard]] std::span<const std::uint32_t> all_incident_edges() const noexcept { return arrays_->incident; }

  /// Whether two graphs share their arrays: the same graph, not an equal one.
  [[nodiscard]] bool same_as(const network_graph& other) const noexcept { return arrays_ == other.arrays_; }

 private:
  struct arrays {
    std::vector<edge> edges;
    std::vector<std::uint32_t> offsets;
    std::vector<std::uint32_t> neighbours;
    std::vector<std::uint32_t> incident;
  };

  [[nodiscard]] static arrays made_of(std::size_t nodes, std::vector<edge> edges) {
    constexpr std::size_t limit = 0xffffffffU;
    if (nodes >= limit || edges.size() >= limit / 2) {
      throw network_error("graph", std::to_string(nodes) + " nodes and " + std::to_string(edges.size()) + " edges",
                          "fewer than 2^32 nodes and 2^31 edges");
    }
    arrays made;
    made.offsets.assign(nodes + 1, 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      for (const std::uint32_t end : edges[e]) {
        if (end >= nodes) {
          throw network_error("edge " + std::to_string(e), "node " + std::to_string(end),
                              "a node below " + std::to_string(nodes));
        }
        ++made.offsets[end + std::size_t{1}];
      }
      if (edges[e][0] == edges[e][1]) {
        throw network_error("edge " + std::to_string(e), "node " + std::to_string(edges[e][0]) + " at both ends",
                            "two nodes");
      }
    }
    for (std::size_t i = 0; i < nodes; ++i) {
      made.offsets[i + 1] += made.offsets[i];
    }
    made.neighbours.resize(2 * edges.size());
    made.incident.resize(2 * edges.size());
    std::vector<std::uint32_t> next(made.offsets.begin(), made.offsets.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      for (std::size_t end = 0; end < 2; ++end) {
        const std::uint32_t k = next[edges[e][end]]++;
        made.neighbours[k] = edges[e][1 - end];
        made.incident[k] = static_cast<std::uint32_t>(e);
      }
    }
    made.edges = std::move(edges);
    return made;
  }

  [[nodiscard]] std::span<const std::uint32_t> row(const std::vector<std::uint32_t>& of, std::size_t i) const noexcept {
    return {of.data() + arrays_->offsets[i], degree(i)};
  }

  detail::shared_constant<arrays> arrays_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
