// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/graph.hpp"
#include "tetrapore/solver/ldlt.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

/// \file
/// Aggregation multigrid on conductances and excess: a preconditioner for pressure systems of any contrast.

namespace tetrapore::inline TETRAPORE_ABI {

/// How a hierarchy is made; the defaults were chosen on dense packings.
struct hierarchy_options {
  double quality = 0.25;         ///< two nodes may be merged when w (D_i + D_j) / (D_i D_j) reaches it
  double shrink = 2.5;           ///< a level ends when it has so many times fewer nodes than the one before
  std::uint32_t largest = 8;     ///< nodes of one level that may be merged into one
  double dominance = 1e3;        ///< a node whose diagonal exceeds so many times Σw is left to the smoother
  std::size_t coarsest = 300;    ///< systems of at most this size are solved directly
  double over = 1.0;
};

namespace detail {

inline constexpr std::uint32_t no_aggregate = 0xffffffffU;

/// Rows of a level: the neighbours before a node, then those after it.
template <class T>
struct level_rows {
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> split;  // where the neighbours after the node begin
  std::vector<std::uint32_t> columns;
  std::vector<T> weights;
  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
};

/// Merges nodes pair by pair, best quality first.
template <class T>
class pairwise_aggregation {
 public:
  pairwise_aggregation(const level_rows<T>& rows, std::span<const T> excess, const hierarchy_options& how)
      : fine_(rows), how_(how) {
    const std::size_t n = rows.size();
    aggregate_.resize(n);
    diagonal_.resize(n);
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < n; ++i) {
      T sum(0);
      for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k) {
        sum += rows.weights[k];
      }
      const T whole = sum + excess[i];
      diagonal_[i] = whole;
      aggregate_[i] = sum > T(0) && whole <= static_cast<T>(how.dominance) * sum ? kept++ : no_aggregate;
    }
    count_ = kept;
    size_.assign(n, 1);
  }

  /// The aggregate of each node of the level.
  [[nodiscard]] std::span<const std::uint32_t> aggregate() const noexcept { return aggregate_; }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// Merges until the level has shrunk enough; the rows of what is left.
  level_rows<T> run() {
    const std::size_t n = fine_.size();
    level_rows<T> rows = merged_rows(fine_, aggregate_, count_);
    merge_diagonals(aggregate_);
    if (count_ == 0) {
      return rows;
    }
    for (int pass = 0; pass < 4 && static_cast<double>(count_) * how_.shrink > static_cast<double>(n); ++pass) {
      const std::size_t before = count_;
      const std::vector<std::uint32_t> merge = match(rows);
      if (count_ == before) {
        break;
      }
      rows = merged_rows(rows, merge, count_);
      merge_diagonals(merge);
      for (std::uint32_t& a : aggregate_) {
        a = a == no_aggregate ? a : merge[a];
      }
    }
    return rows;
  }

 private:
  struct candidate {
    std::uint32_t i, j;
    float quality;
  };

  [[nodiscard]] T quality(T w, T d_i, T d_j) const noexcept { return w / d_i + w / d_j; }

  void merge_diagonals(const std::vector<std::uint32_t>& merge) {
    std::vector<T> diagonal(count_, T(0));
    std::vector<std::uint32_t> size(count_, 0);
    for (std::size_t i = 0; i < merge.size(); ++i) {
      if (merge[i] != no_aggregate) {
        diagonal[merge[i]] += diagonal_[i];
        size[merge[i]] += size_[i];
      }
    }
    diagonal_ = std::move(diagonal);
    size_ = std::move(size);
  }

  /// One pass: the aggregate of each node of these rows, numbered by their first node.
  [[nodiscard]] std::vector<std::uint32_t> match(const level_rows<T>& rows) {
    const std::size_t n = rows.size();
    std::vector<candidate> found;
    found.reserve(rows.columns.size() / 4);
    for (std::size_t i = 0; i < n; ++i) {
      const T over = T(1) / diagonal_[i];
      for (std::uint32_t k = rows.split[i]; k < rows.offsets[i + 1]; ++k) {
        const std::uint32_t j = rows.columns[k];
        const T q = rows.weights[k] * over + rows.weights[k] / diagonal_[j];
        if (q >= static_cast<T>(how_.quality) && size_[i] + size_[j] <= how_.largest) {
          found.push_back({static_cast<std::uint32_t>(i), j, static_cast<float>(q)});
        }
      }
    }
    const std::vector<candidate> best_first = sorted(found);
    std::vector<std::uint32_t> leader(n, no_aggregate);  // the first of a pair; no_aggregate: free
    std::vector<std::uint32_t> pair_size(n, 0);
    std::vector<T> pair_diagonal(n, T(0));
    const auto best_join = [&](std::uint32_t i) {
      std::pair<T, std::uint32_t> best{T(0), no_aggregate};
      for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k) {
        const std::uint32_t a = leader[rows.columns[k]];
        if (a == no_aggregate || pair_size[a] + size_[i] > how_.largest) {
          continue;
        }
        T w(0);
        for (std::uint32_t m = rows.offsets[i]; m < rows.offsets[i + 1]; ++m) {
          w += leader[rows.columns[m]] == a ? rows.weights[m] : T(0);
        }
        const T q = w / diagonal_[i] + w / pair_diagonal[a];
        if (q > best.first) {
          best = {q, a};
        }
      }
      return best;
    };
    const auto join = [&](std::uint32_t i, std::uint32_t a) {
      leader[i] = a;
      pair_size[a] += size_[i];
      pair_diagonal[a] += diagonal_[i];
    };
    for (const candidate& c : best_first) {
      if (leader[c.i] != no_aggregate || leader[c.j] != no_aggregate) {
        continue;
      }
      bool joined = false;
      for (const std::uint32_t i : {c.i, c.j}) {
        const auto [q, a] = best_join(i);
        if (q > T(2) * static_cast<T>(c.quality)) {
          join(i, a);
          joined = true;
        }
      }
      if (!joined) {
        leader[c.i] = c.i;
        leader[c.j] = c.i;
        pair_size[c.i] = size_[c.i] + size_[c.j];
        pair_diagonal[c.i] = diagonal_[c.i] + diagonal_[c.j];
      }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      if (leader[i] == no_aggregate) {
        if (const auto [q, a] = best_join(i); q >= T(2) * static_cast<T>(how_.quality)) {
          join(i, a);
        }
      }
    }
    std::vector<std::uint32_t> merge(n, no_aggregate);
    std::vector<std::uint32_t> number(n, no_aggregate);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = leader[i] == no_aggregate ? i : leader[i];
      if (number[a] == no_aggregate) {
        number[a] = count++;
      }
      merge[i] = number[a];
    }
    count_ = count;
    return merge;
  }

  /// Largest quality first, to 1 part in 256; in the order found among equals.
  [[nodiscard]] static std::vector<candidate> sorted(const std::vector<candidate>& found) {
    const auto key = [](const candidate& c) {
      return 0xffffU - (std::bit_cast<std::uint32_t>(c.quality) >> 15U);  // positive floats sort as their bits do
    };
    std::vector<std::uint32_t> begin(0x10001U, 0);
    for (const candidate& c : found) {
      ++begin[key(c) + 1];
    }
    for (std::size_t k = 0; k + 1 < begin.size(); ++k) {
      begin[k + 1] += begin[k];
    }
    std::vector<candidate> sorted(found.size());
    for (const candidate& c : found) {
      sorted[begin[key(c)]++] = c;
    }
    return sorted;
  }

  /// The rows of aggregates: conductances between them summed, those inside dropped.
  [[nodiscard]] static level_rows<T> merged_rows(const level_rows<T>& rows, std::span<const std::uint32_t> merge,
                                                 std::size_t count) {
    const std::size_t n = rows.size();
    std::vector<std::uint32_t> begin(count + 1, 0);
    for (const std::uint32_t a : merge) {
      if (a != no_aggregate) {
        ++begin[a + std::size_t{1}];
      }
    }
    for (std::size_t a = 0; a < count; ++a) {
      begin[a + 1] += begin[a];
    }
    std::vector<std::uint32_t> members(begin[count]);
    {
      std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
      for (std::uint32_t i = 0; i < n; ++i) {
        if (merge[i] != no_aggregate) {
          members[next[merge[i]]++] = i;
        }
      }
    }
    level_rows<T> out;
    out.offsets.resize(count + 1);
    out.split.resize(count);
    out.columns.reserve(rows.columns.size());
    out.weights.reserve(rows.columns.size());
    std::vector<std::uint32_t> at(count, no_aggregate);  // where the row of the moment holds a column
    std::vector<std::pair<std::uint32_t, T>> upper;
    for (std::uint32_t a = 0; a < count; ++a) {
      const auto start = static_cast<std::uint32_t>(out.columns.size());
      out.offsets[a] = start;
      upper.clear();
      for (std::uint32_t m = begin[a]; m < begin[a + std::size_t{1}]; ++m) {
        const std::uint32_t i = members[m];
        for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + std::size_t{1}]; ++k) {
          const std::uint32_t b = merge[rows.columns[k]];
          if (b == a || b == no_aggregate) {
            continue;
          }
          if (b < a) {
            if (at[b] == no_aggregate || at[b] < start || out.columns[at[b]] != b) {
              at[b] = static_cast<std::uint32_t>(out.columns.size());
              out.columns.push_back(b);
              out.weights.push_back(rows.weights[k]);
            } else {
              out.weights[at[b]] += rows.weights[k];
            }
          } else {
            if (at[b] == no_aggregate || at[b] >= upper.size() || upper[at[b]].first != b) {
              at[b] = static_cast<std::uint32_t>(upper.size());
              upper.emplace_back(b, rows.weights[k]);
            } else {
              upper[at[b]].second += rows.weights[k];
            }
          }
        }
      }
      out.split[a] = static_cast<std::uint32_t>(out.columns.size());
      for (const auto& [b, w] : upper) {
        at[b] = no_aggregate;
        out.columns.push_back(b);
        out.weights.push_back(w);
      }
    }
    out.offsets[count] = static_cast<std::uint32_t>(out.columns.size());
    out.columns.shrink_to_fit();
    out.weights.shrink_to_fit();
    return out;
  }

  const level_rows<T>& fine_;
  hierarchy_options how_;
  std::vector<std::uint32_t> aggregate_;
  std::vector<T> diagonal_;  // of the partial aggregates: Σ of the diagonals of the level
  std::vector<std::uint32_t> size_;
  std::size_t count_ = 0;
};

}  // namespace detail

template <std::floating_point T>
class aggregation_hierarchy {
 public:
  explicit aggregation_hierarchy(const hierarchy_options& how = {}) : how_(how) {}

  void analyze(const network_graph& graph) {
    graph_ = graph;
    levels_.clear();
    levels_.emplace_back();
    auto& rows = levels_[0].rows;
    const std::size_t n = graph.node_count();
    rows.offsets.assign(graph.offsets().begin(), graph.offsets().end());
    rows.split.resize(n);
    rows.columns.resize(graph.all_neighbours().size());
    edges_.resize(rows.columns.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto near = graph.neighbours(i);
      const auto edge = graph.incident_edges(i);
      std::uint32_t low = rows.offsets[i];
      std::uint32_t high = rows.offsets[i + std::size_t{1}];
      for (std::size_t k = 0; k < near.size(); ++k) {
        const std::uint32_t at = near[k] < i ? low++ : --high;
        rows.columns[at] = near[k];
        edges_[at] = edge[k];
      }
      rows.split[i] = low;
    }
  }

  void factorize(std::span<const double> weights, std::span<const double> excess) {
    levels_.resize(1);
    scale_ = scale_of(weights, excess);
    level& finest = levels_[0];
    finest.rows.weights.resize(edges_.size());
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      finest.rows.weights[k] = narrowed(weights[edges_[k]] * scale_);
    }
    std::vector<T> s(excess.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
      s[i] = narrowed(excess[i] * scale_);
    }
    for (;;) {
      level& now = levels_.back();
      const std::size_t n = now.rows.size();
      if (n <= how_.coarsest) {
        coarsest_.analyze(n, now.rows.offsets, now.rows.columns);
        coarsest_.factorize(now.rows.offsets, now.rows.columns, s,
                            [&](std::size_t k) { return static_cast<double>(now.rows.weights[k]); });
        direct_ = true;
        now.prepare(s);
        return;
      }
      now.prepare(s);
      detail::pairwise_aggregation<T> aggregation(now.rows, s, how_);
      detail::level_rows<T> coarse = aggregation.run();
      now.aggregate.assign(aggregation.aggregate().begin(), aggregation.aggregate().end());
      if (10 * coarse.size() > 9 * n) {
        direct_ = false;
        return;
      }
      std::vector<T> coarse_s(coarse.size(), T(0));
      for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t a = now.aggregate[i];
        if (a == detail::no_aggregate) {
          continue;
        }
        coarse_s[a] += s[i];
        for (std::uint32_t k = now.rows.offsets[i]; k < now.rows.offsets[i + 1]; ++k) {
          if (now.aggregate[now.rows.columns[k]] == detail::no_aggregate) {
            coarse_s[a] += now.rows.weights[k];
          }
        }
      }
      s = std::move(coarse_s);
      levels_.emplace_back();
      levels_.back().rows = std::move(coarse);
    }
  }

  [[nodiscard]] std::size_t level_count() const noexcept { return levels_.size(); }
  [[nodiscard]] std::size_t level_size(std::size_t l) const noexcept { return levels_[l].rows.size(); }
  [[nodiscard]] std::size_t level_entries(std::size_t l) const noexcept { return levels_[l].rows.columns.size(); }
  [[nodiscard]] const detail::level_rows<T>& finest() const noexcept { return levels_[0].rows; }
  [[nodiscard]] std::span<const std::uint32_t> edges() const noexcept { return edges_; }
  [[nodiscard]] std::span<T> input() noexcept { return levels_[0].r; }
  [[nodiscard]] std::span<const T> output() const noexcept { return levels_[0].z; }
  [[nodiscard]] double scale() const noexcept { return scale_; }

  /// One V-cycle on input(), to output().
  void cycle() {
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
      down(levels_[l], levels_[l + 1]);
    }
    level& last = levels_.back();
    if (direct_) {
      coarsest_.apply(last.r, last.z);
    } else {
      forward(last);
      up(last);
    }
    for (std::size_t l = levels_.size() - 1; l-- > 0;) {
      prolong(levels_[l], levels_[l + 1]);
      up(levels_[l]);
    }
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = edges_.capacity() * 4 + coarsest_.fill() * 12;
    for (const level& l : levels_) {
      sum += 4 * (l.rows.offsets.capacity() + l.rows.split.capacity() + l.rows.columns.capacity() +
                  l.aggregate.capacity()) +
             sizeof(T) * (l.rows.weights.capacity() + l.inverse.capacity() + l.r.capacity() + l.z.capacity());
    }
    return sum;
  }

 private:
  struct level {
    detail::level_rows<T> rows;
    std::vector<T> inverse;  // 1 / diagonal
    std::vector<std::uint32_t> aggregate;
    std::vector<T> r, z;

    void prepare(const std::vector<T>& s) {
      const std::size_t n = rows.size();
      inverse.resize(n);
      r.assign(n, T(0));
      z.assign(n, T(0));
      for (std::size_t i = 0; i < n; ++i) {
        T sum = s[i];
        for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k) {
          sum += rows.weights[k];
        }
        inverse[i] = sum > T(0) ? T(1) / sum : T(0);
      }
    }
  };

  [[nodiscard]] static T narrowed(double v) noexcept {
    const T t = static_cast<T>(v);
    return v > 0 && t < std::numeric_limits<T>::min() ? std::numeric_limits<T>::min() : t;
  }
  [[nodiscard]] static double scale_of(std::span<const double> w, std::span<const double> s) noexcept {
    double largest = 0;
    for (const double v : w) {
      largest = v > largest ? v : largest;
    }
    for (const double v : s) {
      largest = v > largest ? v : largest;
    }
    return largest > 0 ? std::ldexp(1.0, std::numeric_limits<T>::max_exponent / 2 - std::ilogb(largest)) : 1.0;
  }

  static void forward(level& f) noexcept {
    const std::size_t n = f.rows.size();
    for (std::size_t i = 0; i < n; ++i) {
      T sum = f.r[i];
      for (std::uint32_t k = f.rows.offsets[i]; k < f.rows.split[i]; ++k) {
        sum += f.rows.weights[k] * f.z[f.rows.columns[k]];
      }
      f.z[i] = sum * f.inverse[i];
    }
  }
  void down(level& f, level& c) noexcept {
    const std::size_t n = f.rows.size();
    std::fill(c.r.begin(), c.r.end(), T(0));
    for (std::size_t i = 0; i < n; ++i) {
      T sum = f.r[i];
      for (std::uint32_t k = f.rows.offsets[i]; k < f.rows.split[i]; ++k) {
        sum += f.rows.weights[k] * f.z[f.rows.columns[k]];
      }
      f.z[i] = sum * f.inverse[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
      T sum(0);
      for (std::uint32_t k = f.rows.split[i]; k < f.rows.offsets[i + 1]; ++k) {
        sum += f.rows.weights[k] * f.z[f.rows.columns[k]];
      }
      if (f.aggregate[i] != detail::no_aggregate) {
        c.r[f.aggregate[i]] += sum;
      }
    }
  }
  void prolong(level& f, const level& c) const noexcept {
    const T over = static_cast<T>(how_.over);
    for (std::size_t i = 0; i < f.z.size(); ++i) {
      if (f.aggregate[i] != detail::no_aggregate) {
        f.z[i] += over * c.z[f.aggregate[i]];
      }
    }
  }
  static void up(level& f) noexcept {
    for (std::size_t i = f.rows.size(); i-- > 0;) {
      T sum = f.r[i];
      for (std::uint32_t k = f.rows.offsets[i]; k < f.rows.offsets[i + 1]; ++k) {
        sum += f.rows.weights[k] * f.z[f.rows.columns[k]];
      }
      f.z[i] = sum * f.inverse[i];
    }
  }

  hierarchy_options how_;
  network_graph graph_;
  std::vector<level> levels_;
  std::vector<std::uint32_t> edges_;  // of each entry of the finest rows
  double scale_ = 1;
  bool direct_ = false;
  subtraction_free_ldlt<double> coarsest_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
