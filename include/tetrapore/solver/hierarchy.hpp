// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/graph.hpp"
#include "tetrapore/solver/ldlt.hpp"

#include <algorithm>
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
  double quality = 0.25;        ///< two nodes may be merged when w (D_i + D_j) / (D_i D_j) reaches it
  double shrink = 2.5;          ///< a level ends when it has so many times fewer nodes than the one before
  std::uint32_t largest = 8;    ///< so many nodes of one level may become one
  double dominance = 1e3;       ///< a node whose diagonal exceeds so many times Σw is left to the smoother
  std::size_t coarsest = 1000;  ///< systems of at most this size are solved directly
  /// Factor on the correction from the coarser level. Constants on aggregates are stiffer than the pressures they stand
  /// for; the preconditioner is definite for any positive factor.
  double stretch = 1.35;
};

namespace detail {

inline constexpr std::uint32_t no_aggregate = 0xffffffffU;

/// Rows of a level: of each node the neighbours before it, then those after it.
template <class T>
struct level_rows {
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> split;  // where the neighbours after the node begin
  std::vector<std::uint32_t> columns;
  std::vector<T> weights;
  [[nodiscard]] std::size_t size() const noexcept { return split.size(); }
};

/// Merges the nodes of a level pair by pair, best quality first.
template <class T>
class pairwise_aggregation {
 public:
  /// \param inverse  1 / diagonal of each node, 0 for a node without conductance and excess
  pairwise_aggregation(const level_rows<T>& rows, std::span<const T> excess, std::span<const double> inverse,
                       const hierarchy_options& how)
      : fine_(rows), how_(how), inverse_(rows.size()), size_(rows.size()) {
    const T least = static_cast<T>(1 - 1 / how.dominance);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      inverse_[i] = static_cast<T>(inverse[i]);
      const bool apart =
          inverse_[i] == T(0) || rows.offsets[i] == rows.offsets[i + 1] || excess[i] * inverse_[i] > least;
      size_[i] = apart ? how.largest + 1 : 1;  // too large for any partner
    }
  }

  /// The aggregate of each node of the level, or no_aggregate.
  [[nodiscard]] std::vector<std::uint32_t>& aggregate() noexcept { return aggregate_; }

  /// Merges until the level has shrunk enough; the rows of what is left.
  [[nodiscard]] level_rows<T> run() {
    const auto n = static_cast<double>(fine_.size());
    aggregate_ = match(fine_);
    level_rows<T> rows = merged_rows(fine_, aggregate_, count_);
    for (int pass = 1; pass < 4 && static_cast<double>(count_) * how_.shrink > n; ++pass) {
      merge_diagonals(pass == 1 ? aggregate_ : merge_);
      const std::size_t before = count_;
      merge_ = match(rows);
      if (count_ == before) {
        break;
      }
      rows = merged_rows(rows, merge_, count_);
      for (std::uint32_t& a : aggregate_) {
        a = a == no_aggregate ? a : merge_[a];
      }
    }
    return rows;
  }

 private:
  struct candidate {
    std::uint32_t i, j;
    float quality;
  };
  struct share {
    std::uint32_t pair;
    T weight;
  };

  /// Diagonals and sizes of partial aggregates are sums over the nodes of the level.
  void merge_diagonals(const std::vector<std::uint32_t>& merge) {
    std::vector<T> diagonal(count_, T(0));
    std::vector<std::uint32_t> size(count_, 0);
    for (std::size_t i = 0; i < merge.size(); ++i) {
      if (merge[i] != no_aggregate) {
        diagonal[merge[i]] += T(1) / inverse_[i];
        size[merge[i]] += size_[i];
      }
    }
    for (T& d : diagonal) {
      d = T(1) / d;
    }
    inverse_ = std::move(diagonal);
    size_ = std::move(size);
  }

  /// One pass: the aggregate of each node of these rows, numbered by their first node.
  [[nodiscard]] std::vector<std::uint32_t> match(const level_rows<T>& rows) {
    const std::size_t n = rows.size();
    std::vector<std::uint32_t> leader(n, no_aggregate);  // the first of a pair; no_aggregate: free
    std::vector<T> pair_inverse(n);                      // of a leader: 1 / diagonal of its pair
    std::vector<std::uint32_t> pair_size(n);
    std::vector<share> shares;
    // The finished pair that node i fits best.
    const auto best_join = [&](std::uint32_t i) {
      shares.clear();
      for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + std::size_t{1}]; ++k) {
        const std::uint32_t pair = leader[rows.columns[k]];
        if (pair == no_aggregate) {
          continue;
        }
        std::size_t m = 0;
        while (m < shares.size() && shares[m].pair != pair) {
          ++m;
        }
        if (m < shares.size()) {
          shares[m].weight += rows.weights[k];
        } else if (pair_size[pair] + size_[i] <= how_.largest) {
          shares.push_back({pair, rows.weights[k]});
        }
      }
      share best{no_aggregate, T(0)};
      for (const share& s : shares) {
        const T q = s.weight * (inverse_[i] + pair_inverse[s.pair]);
        best = q > best.weight ? share{s.pair, q} : best;
      }
      return best;
    };
    const auto join = [&](std::uint32_t i, std::uint32_t pair) {
      leader[i] = pair;
      pair_size[pair] += size_[i];
      pair_inverse[pair] = T(1) / (T(1) / pair_inverse[pair] + T(1) / inverse_[i]);
    };
    for (const candidate& c : candidates(rows)) {
      if (leader[c.i] != no_aggregate || leader[c.j] != no_aggregate) {
        continue;
      }
      // Neither has a better free partner; a finished pair has to be twice as good. No quality is above 2.
      bool joined = false;
      for (const std::uint32_t i : {c.i, c.j}) {
        if (c.quality >= 1) {
          break;
        }
        if (const share best = best_join(i); best.weight > T(2) * static_cast<T>(c.quality)) {
          join(i, best.pair);
          joined = true;
        }
      }
      if (!joined) {
        leader[c.i] = c.i;
        leader[c.j] = c.i;
        pair_size[c.i] = size_[c.i] + size_[c.j];
        pair_inverse[c.i] = T(1) / (T(1) / inverse_[c.i] + T(1) / inverse_[c.j]);
      }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      if (leader[i] == no_aggregate && size_[i] < how_.largest) {
        if (const share best = best_join(i); best.weight >= T(2) * static_cast<T>(how_.quality)) {
          join(i, best.pair);
        }
      }
    }
    std::vector<std::uint32_t> number(n, no_aggregate);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (size_[i] > how_.largest) {
        continue;
      }
      std::uint32_t& of_pair = number[leader[i] == no_aggregate ? i : leader[i]];
      if (of_pair == no_aggregate) {
        of_pair = count++;
      }
      leader[i] = leader[i] == no_aggregate ? i : leader[i];
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      leader[i] = leader[i] == no_aggregate ? no_aggregate : number[leader[i]];
    }
    count_ = count;
    return leader;
  }

  /// The pairs of sufficient quality, best first to 1 part in 8; among equals in the order of the rows, which lie close
  /// in memory.
  [[nodiscard]] std::vector<candidate> candidates(const level_rows<T>& rows) const {
    constexpr std::uint32_t last_bucket = 0x7fffffffU >> 20U;
    const auto key = [](float quality) {
      // The bits of positive floats are ordered as they are.
      return last_bucket - (std::bit_cast<std::uint32_t>(quality) >> 20U);
    };
    const auto least = static_cast<T>(how_.quality);
    std::vector<candidate> found;
    found.reserve(rows.columns.size() / 2);
    std::vector<std::uint32_t> begin(last_bucket + std::size_t{2}, 0);
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
      for (std::uint32_t k = rows.split[i]; k < rows.offsets[i + std::size_t{1}]; ++k) {
        const std::uint32_t j = rows.columns[k];
        const T q = rows.weights[k] * (inverse_[i] + inverse_[j]);
        if (q >= least && size_[i] + size_[j] <= how_.largest) {
          found.push_back({i, j, static_cast<float>(q)});
          ++begin[key(found.back().quality) + 1];
        }
      }
    }
    for (std::size_t k = 0; k + 1 < begin.size(); ++k) {
      begin[k + 1] += begin[k];
    }
    std::vector<candidate> sorted(found.size());
    for (const candidate& c : found) {
      sorted[begin[key(c.quality)]++] = c;
    }
    return sorted;
  }

  /// The rows of aggregates: conductances between them summed, those inside dropped.
  [[nodiscard]] static level_rows<T> merged_rows(const level_rows<T>& rows, std::span<const std::uint32_t> merge,
                                                 std::size_t count) {
    constexpr std::uint32_t none = no_aggregate;
    std::vector<std::uint32_t> first(count, none);       // member of an aggregate
    std::vector<std::uint32_t> following(merge.size());  // member after this one
    for (auto i = static_cast<std::uint32_t>(merge.size()); i-- > 0;) {
      if (merge[i] != none) {
        following[i] = first[merge[i]];
        first[merge[i]] = i;
      }
    }
    struct place {
      std::uint32_t row, entry;
    };
    std::vector<place> places(count, place{none, 0});  // where the latest row that holds a column has it
    level_rows<T> out;
    out.offsets.resize(count + 1);
    out.split.resize(count);
    out.columns.reserve(rows.columns.size());
    out.weights.reserve(rows.columns.size());
    std::vector<share> after;  // of the row, the neighbours after it
    for (std::uint32_t a = 0; a < count; ++a) {
      after.clear();
      for (std::uint32_t i = first[a]; i != none; i = following[i]) {
        for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + std::size_t{1}]; ++k) {
          const std::uint32_t b = merge[rows.columns[k]];
          if (b == a || b == none) {
            continue;
          }
          const T w = rows.weights[k];
          place& of_column = places[b];
          if (b < a) {
            if (of_column.row == a) {
              out.weights[of_column.entry] += w;
            } else {
              of_column = {a, static_cast<std::uint32_t>(out.columns.size())};
              out.columns.push_back(b);
              out.weights.push_back(w);
            }
          } else if (of_column.row == a) {
            after[of_column.entry].weight += w;
          } else {
            of_column = {a, static_cast<std::uint32_t>(after.size())};
            after.push_back({b, w});
          }
        }
      }
      out.split[a] = static_cast<std::uint32_t>(out.columns.size());
      for (const share& entry : after) {
        out.columns.push_back(entry.pair);
        out.weights.push_back(entry.weight);
      }
      out.offsets[a + std::size_t{1}] = static_cast<std::uint32_t>(out.columns.size());
    }
    out.columns.shrink_to_fit();
    out.weights.shrink_to_fit();
    return out;
  }

  const level_rows<T>& fine_;
  hierarchy_options how_;
  std::vector<T> inverse_;  // 1 / diagonal of the partial aggregates
  std::vector<std::uint32_t> size_;
  std::vector<std::uint32_t> aggregate_;
  std::vector<std::uint32_t> merge_;
  std::size_t count_ = 0;
};

}  // namespace detail

/// A hierarchy of aggregates and its V-cycle: x = M⁻¹ b with M symmetric, positive (semi-)definite and close to the
/// matrix of the pressure system, so that it preconditions any conjugate gradients.
///
/// Nodes are merged pair by pair, best quality first; conductances and excess of a coarser level are sums of those of
/// the finer one, so that nothing cancels and floating clusters stay floating. One symmetric Gauss-Seidel sweep per
/// level; the last level is solved by the subtraction-free LDLᵀ. Vectors and diagonals are held in double: in float a
/// cluster that hangs on the rest by 1e-8 of its own conductances would lose its balance to rounding.
/// \tparam T  what conductances are held in, relative to the largest; those that would vanish are raised to the
///            smallest normal number of T. float costs no iterations, and a quarter less memory
/// \par Domain  any graph. Made for few neighbours per node; where merging stalls above 5 · coarsest nodes, the last
///              level is only smoothed, and iterations grow
/// \par Thread safety  none: a cycle works in the hierarchy
/// \par Source  Notay, Electron. Trans. Numer. Anal. 37 (2010) 123 (quality of aggregates); Braess, Computing 55 (1995)
///              379 (the stretched correction)
template <std::floating_point T>
class aggregation_hierarchy {
 public:
  aggregation_hierarchy() = default;
  explicit aggregation_hierarchy(const hierarchy_options& how) : how_(how) {}

  /// Numbers the nodes breadth-first, so that neighbours lie close in memory.
  void analyze(const network_graph& graph) {
    const std::size_t n = graph.node_count();
    levels_.clear();
    levels_.emplace_back();
    detail::level_rows<T>& rows = levels_[0].rows;
    rows.offsets.assign(n + 1, 0);
    rows.split.resize(n);
    rows.columns.resize(graph.all_neighbours().size());
    edges_.resize(rows.columns.size());
    order_.clear();
    order_.reserve(n);
    std::vector<std::uint32_t> position(n, detail::no_aggregate);
    const auto number = [&](std::uint32_t node) {
      if (position[node] == detail::no_aggregate) {
        position[node] = static_cast<std::uint32_t>(order_.size());
        order_.push_back(node);
      }
      return position[node];
    };
    std::uint32_t start = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      for (; order_.size() == i; ++start) {
        number(start);
      }
      const auto near = graph.neighbours(order_[i]);
      const auto edge = graph.incident_edges(order_[i]);
      std::uint32_t low = rows.offsets[i];
      std::uint32_t high = rows.offsets[i + std::size_t{1}] = low + static_cast<std::uint32_t>(near.size());
      for (std::size_t k = 0; k < near.size(); ++k) {
        const std::uint32_t j = number(near[k]);
        const std::uint32_t at = j < i ? low++ : --high;
        rows.columns[at] = j;
        edges_[at] = edge[k];
      }
      rows.split[i] = low;
    }
  }

  /// \param weights  of each edge, finite, at least 0
  /// \param excess   of each node, finite, at least 0
  void factorize(std::span<const double> weights, std::span<const double> excess) {
    levels_.resize(1);
    direct_ = false;
    scale_ = scale_of(weights, excess);
    std::vector<T> s(order_.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
      s[i] = narrowed(excess[order_[i]] * scale_);
    }
    levels_[0].rows.weights.resize(edges_.size());
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      levels_[0].rows.weights[k] = narrowed(weights[edges_[k]] * scale_);
    }
    levels_[0].prepare(s);
    while (levels_.back().rows.size() > how_.coarsest) {
      level next = coarsened(levels_.back(), s);
      if (next.rows.size() == 0) {
        break;
      }
      levels_.push_back(std::move(next));
    }
    const detail::level_rows<T>& last = levels_.back().rows;
    if (last.size() <= 5 * how_.coarsest) {
      direct_ = true;
      coarsest_.analyze(last.size(), last.offsets, last.columns);
      coarsest_.factorize(last.offsets, last.columns, s,
                          [&](std::size_t k) { return static_cast<double>(last.weights[k]); });
    }
  }

  /// x = M⁻¹ b, in the order of the graph.
  void apply(std::span<const double> b, std::span<double> x) {
    for (std::size_t i = 0; i < order_.size(); ++i) {
      input()[i] = b[order_[i]];
    }
    cycle([this](std::size_t i) { return input()[i]; }, [](std::size_t, double) {});
    for (std::size_t i = 0; i < order_.size(); ++i) {
      x[order_[i]] = scale_ * output()[i];
    }
  }

  /// The node of the graph at each place of the numbering that the members below use.
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept { return order_; }
  /// Rows of the finest level, and the edge of each entry.
  [[nodiscard]] const detail::level_rows<T>& rows() const noexcept { return levels_[0].rows; }
  [[nodiscard]] std::span<const std::uint32_t> entry_edges() const noexcept { return edges_; }
  /// `cycle` reads input() and fills output(), which then is x / scale() for the b in input().
  [[nodiscard]] std::span<double> input() noexcept { return levels_[0].r; }
  [[nodiscard]] std::span<const double> output() const noexcept { return levels_[0].z; }
  [[nodiscard]] double scale() const noexcept { return scale_; }
  /// \param feed   feed(i) sets input()[i] and returns it, for each i in turn
  /// \param visit  visit(i, output()[i]) as soon as it is known
  template <class Feed, class Visit>
  void cycle(const Feed& feed, const Visit& visit) {
    if (levels_.size() > 1) {
      sweep_down(levels_[0], levels_[1], feed);
    } else {
      for (std::size_t i = 0; i < order_.size(); ++i) {
        feed(i);
      }
    }
    for (std::size_t l = 1; l + 1 < levels_.size(); ++l) {
      sweep_down(levels_[l], levels_[l + 1], [&r = levels_[l].r](std::size_t i) { return r[i]; });
    }
    level& last = levels_.back();
    if (direct_) {
      coarsest_.apply(last.r, last.z);
    } else {
      sweep_forward(last);
    }
    for (std::size_t l = levels_.size() - (direct_ ? 1U : 0U); l-- > 0;) {
      if (l + 1 < levels_.size()) {
        correct(levels_[l], levels_[l + 1]);
      }
      if (l == 0) {
        sweep_backward(levels_[l], visit);
      } else {
        sweep_backward(levels_[l], [](std::size_t, double) {});
      }
    }
    if (direct_ && levels_.size() == 1) {
      for (std::size_t i = 0; i < order_.size(); ++i) {
        visit(i, levels_[0].z[i]);
      }
    }
  }

  [[nodiscard]] std::size_t level_count() const noexcept { return levels_.size(); }
  [[nodiscard]] std::size_t level_size(std::size_t l) const noexcept { return levels_[l].rows.size(); }
  /// Heap memory of the hierarchy.
  [[nodiscard]] std::size_t bytes() const noexcept {
    constexpr std::size_t index = sizeof(std::uint32_t);
    std::size_t sum = index * (edges_.capacity() + order_.capacity()) + coarsest_.fill() * (sizeof(double) + index);
    for (const level& l : levels_) {
      sum += index * (l.rows.offsets.capacity() + l.rows.split.capacity() + l.rows.columns.capacity() +
                      l.aggregate.capacity()) +
             sizeof(T) * l.rows.weights.capacity() +
             sizeof(double) * (l.inverse.capacity() + l.r.capacity() + l.z.capacity());
    }
    return sum;
  }

 private:
  struct level {
    detail::level_rows<T> rows;
    std::vector<double> inverse;           // 1 / diagonal; 0 where nothing is attached
    std::vector<std::uint32_t> aggregate;  // of each node, in the next level
    std::vector<double> r, z;

    void prepare(const std::vector<T>& s) {
      const std::size_t n = rows.size();
      inverse.resize(n);
      r.assign(n, 0.0);
      z.assign(n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        double sum = static_cast<double>(s[i]);
        for (std::uint32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k) {
          sum += static_cast<double>(rows.weights[k]);
        }
        inverse[i] = sum > 0 ? 1 / sum : 0.0;
      }
    }
  };

  [[nodiscard]] static T narrowed(double v) noexcept {
    constexpr T least = std::numeric_limits<T>::min();
    const T narrow = static_cast<T>(v);
    return v > 0 && narrow < least ? least : narrow;
  }
  /// Brings the largest number to the square root of what T can hold: products with a vector of order 1 neither
  /// overflow nor vanish.
  [[nodiscard]] static double scale_of(std::span<const double> w, std::span<const double> s) noexcept {
    double largest = 0;
    for (const std::span<const double> values : {w, s}) {
      for (const double v : values) {
        largest = v > largest ? v : largest;
      }
    }
    const int exponent = std::numeric_limits<T>::max_exponent / 2 - (largest > 0 ? std::ilogb(largest) : 0);
    return std::ldexp(1.0, std::min(exponent, 1000));
  }

  /// The next level, and its excess in place of that of the finer one; an empty level when no two nodes can be merged.
  [[nodiscard]] level coarsened(level& fine, std::vector<T>& s) const {
    const std::size_t n = fine.rows.size();
    level next;
    for (hierarchy_options how = how_;; how.quality /= 4) {
      if (how.quality < 1e-3) {
        return {};
      }
      detail::pairwise_aggregation<T> aggregation(fine.rows, s, fine.inverse, how);
      next.rows = aggregation.run();
      if (10 * next.rows.size() <= 9 * n) {
        fine.aggregate = std::move(aggregation.aggregate());
        break;
      }
    }
    std::vector<T> sums(next.rows.size(), T(0));
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t a = fine.aggregate[i];
      if (a == detail::no_aggregate) {
        continue;
      }
      sums[a] += s[i];
      for (std::uint32_t k = fine.rows.offsets[i]; k < fine.rows.offsets[i + 1]; ++k) {
        if (fine.aggregate[fine.rows.columns[k]] == detail::no_aggregate) {
          sums[a] += fine.rows.weights[k];
        }
      }
    }
    s = std::move(sums);
    next.prepare(s);
    return next;
  }

  /// z = (D − L)⁻¹ r.
  static void sweep_forward(level& f) noexcept {
    const T* const w = f.rows.weights.data();
    const std::uint32_t* const column = f.rows.columns.data();
    double* const z = f.z.data();
    for (std::size_t i = 0; i < f.rows.size(); ++i) {
      double sum = f.r[i];
      for (std::uint32_t k = f.rows.offsets[i]; k < f.rows.split[i]; ++k) {
        sum += static_cast<double>(w[k]) * z[column[k]];
      }
      z[i] = sum * f.inverse[i];
    }
  }
  /// The same, and the residual that it leaves, Lᵀ z, summed over aggregates.
  template <class Feed>
  static void sweep_down(level& f, level& c, const Feed& feed) noexcept {
    const T* const w = f.rows.weights.data();
    const std::uint32_t* const column = f.rows.columns.data();
    const std::uint32_t* const aggregate = f.aggregate.data();
    double* const z = f.z.data();
    double* const coarse = c.r.data();
    std::fill(c.r.begin(), c.r.end(), 0.0);
    for (std::size_t i = 0; i < f.rows.size(); ++i) {
      double sum = feed(i);
      const std::uint32_t begin = f.rows.offsets[i];
      const std::uint32_t end = f.rows.split[i];
      for (std::uint32_t k = begin; k < end; ++k) {
        sum += static_cast<double>(w[k]) * z[column[k]];
      }
      z[i] = sum * f.inverse[i];
      for (std::uint32_t k = begin; k < end; ++k) {
        if (const std::uint32_t a = aggregate[column[k]]; a != detail::no_aggregate) {
          coarse[a] += static_cast<double>(w[k]) * z[i];
        }
      }
    }
  }
  void correct(level& f, const level& c) const noexcept {
    for (std::size_t i = 0; i < f.z.size(); ++i) {
      if (f.aggregate[i] != detail::no_aggregate) {
        f.z[i] += how_.stretch * c.z[f.aggregate[i]];
      }
    }
  }
  template <class Visit>
  static void sweep_backward(level& f, const Visit& visit) {
    const T* const w = f.rows.weights.data();
    const std::uint32_t* const column = f.rows.columns.data();
    double* const z = f.z.data();
    for (std::size_t i = f.rows.size(); i-- > 0;) {
      double sum = f.r[i];
      for (std::uint32_t k = f.rows.offsets[i]; k < f.rows.offsets[i + 1]; ++k) {
        sum += static_cast<double>(w[k]) * z[column[k]];
      }
      z[i] = sum * f.inverse[i];
      visit(i, z[i]);
    }
  }

  hierarchy_options how_;
  std::vector<level> levels_{1};
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> edges_;
  double scale_ = 1;
  bool direct_ = false;  // whether the last level is solved by coarsest_
  subtraction_free_ldlt<double> coarsest_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
