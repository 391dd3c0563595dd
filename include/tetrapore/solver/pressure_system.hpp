// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/clusters.hpp"
#include "tetrapore/solver/graph.hpp"
#include "tetrapore/solver/solve_report.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// \file
/// The pressure system kept as conductances and excess, and what every solver of it does before and after its own work.

namespace tetrapore::inline TETRAPORE_ABI {

/// The system Σ_j w_ij (x_i − x_j) + s_i x_i = b_i on a graph: checked, split into clusters, with its residual in the
/// form of fluxes, so that no digit of a small conductance is lost beside a large one.
///
/// A solver calls `analyze`, `factorize`, and for each solution `begin`, its own method on `sources()`, and `finish`.
class pressure_system {
 public:
  void analyze(const network_graph& graph) {
    graph_ = graph;
    analyzed_ = true;
    factorized_ = false;
  }

  /// Checks and copies the conductances (one per edge) and the excess (one per node), and finds the clusters.
  /// Refuses sizes that do not fit, and numbers that are negative or not finite.
  [[nodiscard]] solve_report factorize(std::span<const double> weights, std::span<const double> excess) {
    factorized_ = false;
    solve_report report;
    if (!analyzed_) {
      return report;
    }
    if (weights.size() != graph_.edge_count() || excess.size() != graph_.node_count()) {
      return refused(report, solve_status::wrong_size, solve_report::none);
    }
    if (const std::size_t e = first_not_a_weight(weights); e < weights.size()) {
      return refused(report, solve_status::invalid_weight, e);
    }
    if (const std::size_t i = first_not_a_weight(excess); i < excess.size()) {
      return refused(report, solve_status::invalid_excess, i);
    }
    weights_.assign(weights.begin(), weights.end());
    excess_.assign(excess.begin(), excess.end());
    diagonal_ = excess_;
    const auto edges = graph_.edges();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      diagonal_[edges[e][0]] += weights_[e];
      diagonal_[edges[e][1]] += weights_[e];
    }
    norm_ = 0;
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
      const double row = diagonal_[i] + (diagonal_[i] - excess_[i]);
      if (!(row <= std::numeric_limits<double>::max())) {
        return refused(report, solve_status::out_of_range, i);
      }
      norm_ = row > norm_ ? row : norm_;
    }
    find_clusters();
    factorized_ = true;
    report.reason = solve_status::ok;
    report.clusters = clusters_;
    report.floating_clusters = floating_.size();
    return report;
  }

  [[nodiscard]] bool factorized() const noexcept { return factorized_; }
  [[nodiscard]] const network_graph& graph() const noexcept { return graph_; }
  [[nodiscard]] std::size_t size() const noexcept { return graph_.node_count(); }
  /// Conductance of each edge.
  [[nodiscard]] std::span<const double> weights() const noexcept { return weights_; }
  /// Excess of each node.
  [[nodiscard]] std::span<const double> excess() const noexcept { return excess_; }
  /// s_i + Σ_j w_ij of each node: to scale by, not to subtract from.
  [[nodiscard]] std::span<const double> diagonal() const noexcept { return diagonal_; }
  [[nodiscard]] std::size_t floating_clusters() const noexcept { return floating_.size(); }

  /// The excess with the first node of each floating cluster tied to zero: with it the matrix is definite, and the
  /// solution for balanced sources is the same up to a constant in each of those clusters.
  [[nodiscard]] std::vector<double> grounded_excess() const {
    std::vector<double> grounded = excess_;
    for (const floating_cluster& c : floating_) {
      grounded[c.first] = diagonal_[c.first] > 0 ? diagonal_[c.first] : 1.0;
    }
    return grounded;
  }

  /// Checks sources and the start; takes what little imbalance is allowed off the sources of floating clusters.
  [[nodiscard]] solve_report begin(std::span<const double> sources, std::span<const double> x,
                                   const solve_options& options) {
    solve_report report;
    if (!factorized_) {
      return report;
    }
    report.clusters = clusters_;
    report.floating_clusters = floating_.size();
    if (sources.size() != size() || x.size() != size()) {
      return refused(report, solve_status::wrong_size, solve_report::none);
    }
    if (const std::size_t i = first_not_finite(sources); i < size()) {
      return refused(report, solve_status::invalid_source, i);
    }
    if (const std::size_t i = options.warm ? first_not_finite(x) : size(); i < size()) {
      return refused(report, solve_status::invalid_start, i);
    }
    if (!floating_.empty()) {
      const std::vector<running_sum> sums = sum_floating(sources);
      for (std::size_t c = 0; c < floating_.size(); ++c) {
        const double total = sums[c].value();
        if (!(std::abs(total) <= options.balance * sums[c].magnitude + options.balance_floor)) {
          report.cluster_size = floating_[c].size;
          report.imbalance = total;
          return refused(report, solve_status::unbalanced_cluster, floating_[c].first);
        }
      }
      sources_.assign(sources.begin(), sources.end());
      subtract_means(sources_, sums);
    } else {
      sources_.assign(sources.begin(), sources.end());
    }
    report.reason = solve_status::ok;
    return report;
  }

  /// The sources that `begin` took, balanced.
  [[nodiscard]] std::span<const double> sources() const noexcept { return sources_; }

  /// r_i = b_i − Σ_j w_ij (x_i − x_j) − s_i x_i, flux by flux.
  void residual(std::span<const double> b, std::span<const double> x, std::span<double> r) const noexcept {
    for (std::size_t i = 0; i < r.size(); ++i) {
      r[i] = b[i] - excess_[i] * x[i];
    }
    const auto edges = graph_.edges();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [i, j] = edges[e];
      const double flux = weights_[e] * (x[i] - x[j]);
      r[i] -= flux;
      r[j] += flux;
    }
  }

  /// ‖D^-½ r‖: the norm in which a sealed pore counts as much as a wide one. Nodes without conductance and excess have
  /// no part in it.
  [[nodiscard]] double scaled_norm(std::span<const double> r) const noexcept {
    double largest = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      const double size = diagonal_[i] > 0 ? std::abs(r[i]) / std::sqrt(diagonal_[i]) : 0.0;
      largest = size > largest ? size : largest;
    }
    return largest;
  }

  /// Gives v zero mean in floating clusters.
  void center(std::span<double> v) const {
    if (!floating_.empty()) {
      subtract_means(v, sum_floating(v));
    }
  }

  /// ‖A‖ in the largest norm.
  [[nodiscard]] double norm() const noexcept { return norm_; }

  /// Gives x zero mean in floating clusters, measures what was reached, and decides whether that is a solution: see
  /// solve_options. x which is not finite is out of range.
  void finish(std::span<double> x, const solve_options& options, solve_report& report) {
    center(x);
    residual_.resize(size());
    residual(sources_, x, residual_);
    report.residual = 0;
    double b_norm = 0;
    double x_norm = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      const double r = std::abs(residual_[i]);
      if (!(r <= report.residual)) {
        report.residual = r;
        report.worst_node = i;
      }
      if (!std::isfinite(r) || !std::isfinite(x[i])) {
        report.reason = solve_status::out_of_range;
        report.index = i;
        report.backward_error = std::numeric_limits<double>::infinity();
        return;
      }
      b_norm = std::fmax(b_norm, std::abs(sources_[i]));
      x_norm = std::fmax(x_norm, std::abs(x[i]));
    }
    report.backward_error = report.residual > 0 ? report.residual / (b_norm + norm_ * x_norm) : 0.0;
    const bool ended = report.stop == solve_stop::direct || report.stop == solve_stop::converged;
    if (report.ok() &&
        !(ended && report.backward_error <= options.tolerance && report.error_estimate <= options.error_target())) {
      report.reason = solve_status::not_converged;
    }
  }

 private:
  struct floating_cluster {
    std::uint32_t first;
    std::uint32_t size;
  };
  /// Σ v and Σ |v|, the first compensated.
  struct running_sum {
    double sum = 0;
    double lost = 0;
    double magnitude = 0;
    void add(double v) noexcept {
      const double next = sum + v;
      lost += std::abs(sum) >= std::abs(v) ? (sum - next) + v : (v - next) + sum;
      sum = next;
      magnitude += std::abs(v);
    }
    [[nodiscard]] double value() const noexcept { return sum + lost; }
  };
  static constexpr std::uint32_t tied = 0xffffffffU;

  [[nodiscard]] static solve_report refused(solve_report report, solve_status why, std::size_t index) noexcept {
    report.reason = why;
    report.index = index;
    return report;
  }
  [[nodiscard]] static std::size_t first_not_a_weight(std::span<const double> v) noexcept {
    std::size_t i = 0;
    while (i < v.size() && v[i] >= 0 && v[i] <= std::numeric_limits<double>::max()) {
      ++i;
    }
    return i;
  }
  [[nodiscard]] static std::size_t first_not_finite(std::span<const double> v) noexcept {
    std::size_t i = 0;
    while (i < v.size() && std::abs(v[i]) <= std::numeric_limits<double>::max()) {
      ++i;
    }
    return i;
  }

  void find_clusters() {
    disjoint_sets sets(size());
    const auto edges = graph_.edges();
    clusters_ = size();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (weights_[e] > 0) {
        sets.unite(edges[e][0], edges[e][1]);
      }
    }
    std::vector<std::uint32_t> label(size(), tied - 1);  // of a root: unseen, tied, or the number of its cluster
    for (std::size_t i = 0; i < size(); ++i) {
      if (excess_[i] > 0) {
        label[sets.find(i)] = tied;
      }
    }
    clusters_ = 0;
    floating_.clear();
    cluster_of_.clear();
    for (std::size_t i = 0; i < size(); ++i) {
      const std::size_t root = sets.find(i);
      clusters_ += root == i ? 1U : 0U;
      if (label[root] == tied - 1) {
        label[root] = static_cast<std::uint32_t>(floating_.size());
        floating_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(sets.size_of(i))});
      }
    }
    if (!floating_.empty()) {
      cluster_of_.resize(size());
      for (std::size_t i = 0; i < size(); ++i) {
        cluster_of_[i] = label[sets.find(i)];
      }
    }
  }

  [[nodiscard]] std::vector<running_sum> sum_floating(std::span<const double> v) const {
    std::vector<running_sum> sums(floating_.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (cluster_of_[i] != tied) {
        sums[cluster_of_[i]].add(v[i]);
      }
    }
    return sums;
  }
  void subtract_means(std::span<double> v, const std::vector<running_sum>& sums) const noexcept {
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (const std::uint32_t c = cluster_of_[i]; c != tied) {
        v[i] -= sums[c].value() / floating_[c].size;
      }
    }
  }

  network_graph graph_;
  bool analyzed_ = false;
  bool factorized_ = false;
  std::vector<double> weights_;
  std::vector<double> excess_;
  std::vector<double> diagonal_;
  double norm_ = 0;
  std::size_t clusters_ = 0;
  std::vector<floating_cluster> floating_;
  std::vector<std::uint32_t> cluster_of_;  ///< of each node: a floating cluster, or tied; empty where none floats
  std::vector<double> sources_;
  std::vector<double> residual_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
