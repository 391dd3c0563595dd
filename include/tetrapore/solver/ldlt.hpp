// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/direct.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

/// \file
/// LDLᵀ without a subtraction, in an order of minimum degree.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// An order of elimination with little fill, and the fill: minimum degree on a quotient graph, with the degrees bounded
/// as in Amestoy, Davis & Duff, SIAM J. Matrix Anal. Appl. 17 (1996) 886.
class elimination_order {
 public:
  /// Rows of a symmetric pattern; entries may repeat, and the diagonal is ignored.
  void make(std::size_t n, std::span<const std::uint32_t> offsets, std::span<const std::uint32_t> columns) {
    start(n, offsets, columns);
    std::vector<std::uint32_t> overlap(n, 0);  // |Le \ Lp| + mark of the step, of each element
    for (std::size_t step = 0; step < n; ++step) {
      const std::uint32_t pivot = take_lowest_degree();
      order_[step] = pivot;
      position_[pivot] = static_cast<std::uint32_t>(step);
      std::vector<std::uint32_t>& front = members_[pivot];
      front.clear();
      mark_[pivot] = ++stamp_;
      const auto gather = [&](const std::vector<std::uint32_t>& nodes) {
        for (const std::uint32_t i : nodes) {
          if (mark_[i] != stamp_ && position_[i] == unordered) {
            mark_[i] = stamp_;
            front.push_back(i);
          }
        }
      };
      gather(variables_[pivot]);
      for (const std::uint32_t e : elements_[pivot]) {
        gather(members_[e]);
        absorbed_[e] = true;
      }
      release(variables_[pivot]);
      release(elements_[pivot]);
      for (const std::uint32_t i : front) {
        for (const std::uint32_t e : elements_[i]) {
          if (!absorbed_[e]) {
            if (seen_[e] != stamp_) {
              seen_[e] = stamp_;
              overlap[e] = alive(members_[e]);
            }
            --overlap[e];
          }
        }
      }
      for (const std::uint32_t i : front) {
        std::erase_if(variables_[i], [&](std::uint32_t j) { return mark_[j] == stamp_ || position_[j] != unordered; });
        std::erase_if(elements_[i], [&](std::uint32_t e) {
          if (!absorbed_[e] && overlap[e] == 0) {
            absorbed_[e] = true;
          }
          return absorbed_[e];
        });
        std::size_t degree = variables_[i].size() + front.size() - 1;
        for (const std::uint32_t e : elements_[i]) {
          degree += overlap[e];
        }
        elements_[i].push_back(pivot);
        set_degree(i, std::min({degree, degree_[i] + front.size() - 1, n - step - 2}));
      }
    }
    fill(n);
  }

  [[nodiscard]] std::size_t size() const noexcept { return order_.size(); }
  /// The node eliminated at each position, and the position of each node.
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept { return order_; }
  [[nodiscard]] std::span<const std::uint32_t> position() const noexcept { return position_; }
  /// The positions after k that the node at k is joined to when it is eliminated, ascending.
  [[nodiscard]] std::span<const std::uint32_t> later(std::size_t k) const noexcept {
    return {later_.data() + begin_[k], begin_[k + 1] - begin_[k]};
  }
  [[nodiscard]] std::size_t begin(std::size_t k) const noexcept { return begin_[k]; }
  [[nodiscard]] std::size_t fill() const noexcept { return later_.size(); }

 private:
  static constexpr std::uint32_t unordered = 0xffffffffU;

  static void release(std::vector<std::uint32_t>& v) { std::vector<std::uint32_t>().swap(v); }

  /// How many of them are not yet eliminated.
  [[nodiscard]] std::uint32_t alive(const std::vector<std::uint32_t>& nodes) const {
    std::uint32_t count = 0;
    for (const std::uint32_t i : nodes) {
      count += position_[i] == unordered ? 1U : 0U;
    }
    return count;
  }

  void start(std::size_t n, std::span<const std::uint32_t> offsets, std::span<const std::uint32_t> columns) {
    order_.assign(n, 0);
    position_.assign(n, unordered);
    mark_.assign(n, 0);
    seen_.assign(n, 0);
    stamp_ = 0;
    absorbed_.assign(n, false);
    variables_.assign(n, {});
    elements_.assign(n, {});
    members_.assign(n, {});
    degree_.assign(n, 0);
    buckets_.assign(n + 1, {});
    lowest_ = 0;
    for (std::size_t i = 0; i < n; ++i) {
      ++stamp_;
      mark_[i] = stamp_;
      for (std::uint32_t k = offsets[i]; k < offsets[i + 1]; ++k) {
        if (mark_[columns[k]] != stamp_) {
          mark_[columns[k]] = stamp_;
          variables_[i].push_back(columns[k]);
        }
      }
      set_degree(static_cast<std::uint32_t>(i), variables_[i].size());
    }
  }

  void set_degree(std::uint32_t i, std::size_t degree) {
    degree_[i] = degree;
    buckets_[degree].push_back(i);
    lowest_ = std::min(lowest_, degree);
  }
  /// A node may lie in several buckets; only the one of its degree counts.
  [[nodiscard]] std::uint32_t take_lowest_degree() {
    for (;; ++lowest_) {
      auto& bucket = buckets_[lowest_];
      while (!bucket.empty()) {
        const std::uint32_t i = bucket.back();
        bucket.pop_back();
        if (position_[i] == unordered && degree_[i] == lowest_) {
          return i;
        }
      }
    }
  }

  void fill(std::size_t n) {
    begin_.assign(n + 1, 0);
    for (std::size_t k = 0; k < n; ++k) {
      begin_[k + 1] = begin_[k] + members_[order_[k]].size();
    }
    later_.resize(begin_[n]);
    for (std::size_t k = 0; k < n; ++k) {
      auto& front = members_[order_[k]];
      const auto to = later_.begin() + static_cast<std::ptrdiff_t>(begin_[k]);
      for (std::size_t m = 0; m < front.size(); ++m) {
        to[static_cast<std::ptrdiff_t>(m)] = position_[front[m]];
      }
      std::sort(to, to + static_cast<std::ptrdiff_t>(front.size()));
      release(front);
    }
    variables_.clear();
    elements_.clear();
    members_.clear();
    buckets_.clear();
  }

  std::vector<std::uint32_t> order_, position_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> later_;
  std::vector<std::uint32_t> mark_, seen_;
  std::uint32_t stamp_ = 0;
  std::vector<bool> absorbed_;
  std::vector<std::vector<std::uint32_t>> variables_, elements_, members_, buckets_;
  std::vector<std::size_t> degree_;
  std::size_t lowest_ = 0;
};

}  // namespace detail

/// The factor of a pressure system by the elimination of nodes, in the way of Grassmann, Taksar and Heyman: with the
/// pivot d = s_k + Σ_j w_kj over the nodes left, node k adds w_ik w_kj / d to w_ij, w_ik s_k / d to s_i and w_ik b_k /
/// d to b_i. Nothing is subtracted, so every conductance, excess and pivot holds to a few ε, whatever the contrast, and
/// sources of one sign give every x to a few ε. A cluster without excess ends in a pivot that is exactly zero, where x
/// is set to zero.
/// \par Accuracy  relative error of each entry of A⁻¹ of order n ε, independent of contrast
/// \par Source  O'Cinneide, Numer. Math. 65 (1993) 109; Alfa, Xue & Ye, Math. Comp. 71 (2002) 217
template <std::floating_point Real>
class subtraction_free_ldlt {
 public:
  void analyze(const network_graph& graph) { analyze(graph.node_count(), graph.offsets(), graph.all_neighbours()); }
  [[nodiscard]] bool factorize(const network_graph& graph, std::span<const double> weights,
                               std::span<const double> excess) {
    const auto edges = graph.all_incident_edges();
    factorize(graph.offsets(), graph.all_neighbours(), excess,
              [&](std::size_t k) { return static_cast<Real>(weights[edges[k]]); });
    return true;
  }

  /// The same from rows of a symmetric matrix without its diagonal.
  void analyze(std::size_t n, std::span<const std::uint32_t> offsets, std::span<const std::uint32_t> columns) {
    order_.make(n, offsets, columns);
    weights_.resize(order_.fill());
    pivots_.resize(n);
    work_.resize(n);
  }

  /// \param weight  weight(k) of the entry columns[k]
  template <class Excess, std::invocable<std::size_t> Weight>
  void factorize(std::span<const std::uint32_t> offsets, std::span<const std::uint32_t> columns, const Excess& excess,
                 const Weight& weight) {
    const std::size_t n = order_.size();
    const auto position = order_.position();
    std::vector<Real> reduced(n);               // excess with what earlier nodes have added
    std::vector<std::uint32_t> head(n, none);   // head[i]: first earlier node whose next neighbour is i
    std::vector<std::uint32_t> after(n, none);  // the next of them
    std::vector<std::size_t> reached(n);        // how far the row of an earlier node has been read
    std::fill(work_.begin(), work_.end(), Real(0));
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t node = order_.order()[i];
      Real own = static_cast<Real>(excess[node]);
      for (std::uint32_t k = offsets[node]; k < offsets[node + std::size_t{1}]; ++k) {
        if (position[columns[k]] > i) {
          work_[position[columns[k]]] += weight(k);
        }
      }
      for (std::uint32_t k = head[i]; k != none;) {
        const auto later = order_.later(k);
        const Real* const row = weights_.data() + order_.begin(k);
        const std::size_t at = reached[k];
        const Real share = row[at] / pivots_[k];
        own += share * reduced[k];
        for (std::size_t m = at + 1; m < later.size(); ++m) {
          work_[later[m]] += share * row[m];
        }
        const std::uint32_t following = after[k];
        wait(k, at + 1, head, after, reached);
        k = following;
      }
      Real pivot = own;
      const auto later = order_.later(i);
      Real* const row = weights_.data() + order_.begin(i);
      for (std::size_t m = 0; m < later.size(); ++m) {
        row[m] = work_[later[m]];
        work_[later[m]] = Real(0);
        pivot += row[m];
      }
      reduced[i] = own;
      pivots_[i] = pivot;
      if (pivot > Real(0)) {
        wait(static_cast<std::uint32_t>(i), 0, head, after, reached);
      }
    }
  }

  /// x = A⁻¹ b; b and x may be the same array. Always true: it needs no memory.
  template <class In, class Out>
  bool apply(const In& b, Out&& x) {
    const std::size_t n = order_.size();
    const auto order = order_.order();
    for (std::size_t i = 0; i < n; ++i) {
      work_[i] = static_cast<Real>(b[order[i]]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Real y = pivots_[k] > Real(0) ? work_[k] / pivots_[k] : Real(0);
      const auto later = order_.later(k);
      const Real* const row = weights_.data() + order_.begin(k);
      for (std::size_t m = 0; m < later.size(); ++m) {
        work_[later[m]] += row[m] * y;
      }
      work_[k] = y;
    }
    for (std::size_t k = n; k-- > 0;) {
      if (!(pivots_[k] > Real(0))) {
        continue;
      }
      Real sum(0);
      const auto later = order_.later(k);
      const Real* const row = weights_.data() + order_.begin(k);
      for (std::size_t m = 0; m < later.size(); ++m) {
        sum += row[m] * work_[later[m]];
      }
      work_[k] += sum / pivots_[k];
    }
    for (std::size_t i = 0; i < n; ++i) {
      x[order[i]] = static_cast<std::remove_cvref_t<decltype(x[0])>>(work_[i]);
    }
    return true;
  }

  [[nodiscard]] std::size_t size() const noexcept { return order_.size(); }
  /// Entries of the factor beside its diagonal.
  [[nodiscard]] std::size_t fill() const noexcept { return order_.fill(); }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  /// Puts node k on the list of its next neighbour that lies behind what has been read.
  void wait(std::uint32_t k, std::size_t at, std::vector<std::uint32_t>& head, std::vector<std::uint32_t>& after,
            std::vector<std::size_t>& reached) const noexcept {
    const auto later = order_.later(k);
    if (at < later.size()) {
      reached[k] = at;
      after[k] = head[later[at]];
      head[later[at]] = k;
    }
  }

  detail::elimination_order order_;
  std::vector<Real> weights_;  // of the eliminated graph
  std::vector<Real> pivots_;
  std::vector<Real> work_;
};

/// Solves directly: the choice for small systems, and the reference for all.
/// \par Accuracy  see subtraction_free_ldlt
template <std::floating_point Real = double>
using ldlt_solver = direct_solver<subtraction_free_ldlt<Real>>;
static_assert(network_solver<ldlt_solver<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
