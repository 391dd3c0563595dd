// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.hpp"

#include "tetrapore/law/bridge/table.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"
#include "tetrapore/packing/close_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Bridges of a packing from tables: one for each of the commonest ratios of radii.

namespace support {

namespace tp = tetrapore;

/// Smaller over larger radius; 0 before a plane.
[[nodiscard]] inline double radius_ratio(const tp::edge<double>& e) {
  return std::min(e.radius1, e.radius2) / std::max(e.radius1, e.radius2);
}

/// The tables, which the law below points to.
class bridge_tables {
 public:
  static constexpr std::size_t most = 64;

  /// Tables for the commonest ratios of radii among the pairs, and a range of volumes, from the exact law.
  /// \throw tetrapore::parameter_error  a range that a table cannot hold
  bridge_tables(const tp::young_laplace<>& law, std::span<const tp::close_edge> pairs, double least, double largest)
      : exact_(law) {
    std::vector<group> groups = groups_of(pairs);
    std::sort(groups.begin(), groups.end(), [](const group& a, const group& b) { return a.pairs > b.pairs; });
    groups.resize(std::min(groups.size(), most));
    std::sort(groups.begin(), groups.end(), [](const group& a, const group& b) { return a.ratio < b.ratio; });
    for (const group& g : groups) {
      const double other = g.ratio > 0 ? g.smallest / g.ratio : std::numeric_limits<double>::infinity();
      const double grown = g.smallest / g.largest;  // volumes count in the first radius cubed
      auto table = std::make_unique<tp::bridge_table<>>();
      const tp::table_report made = table->build(law, {.radius1 = g.smallest,
                                                       .radius2 = other,
                                                       .least_volume = 0.999 * least * grown * grown * grown,
                                                       .largest_volume = 1.001 * largest,
                                                       .deepest_overlap = 1.01 * g.deepest * g.smallest});
      if (made.reason != tp::bridge_status::ok) {
        refuse("--law", "table",
               "volumes and pairs that a table can hold; for radii " + tp::short_number(g.smallest) + " and " +
                   tp::short_number(other) + " m: " + describe(made.reason));
      }
      error_ = std::max(error_, made.error);
      covered_ += g.pairs;
      ratios_.push_back(g.ratio);
      tables_.push_back(std::move(table));
    }
  }

  [[nodiscard]] std::size_t covered() const { return covered_; }  ///< pairs that have a table
  [[nodiscard]] const tp::young_laplace<>& exact() const noexcept { return exact_; }
  [[nodiscard]] std::size_t size() const { return tables_.size(); }
  [[nodiscard]] double error() const { return error_; }  ///< the worst, in the largest force of its table

  /// The table of a pair; null where there is none.
  [[nodiscard]] const tp::bridge_table<>* of(const tp::edge<double>& e) const noexcept {
    const double ratio = radius_ratio(e);
    const auto at = std::lower_bound(ratios_.begin(), ratios_.end(), ratio * (1 - tolerance));
    return at != ratios_.end() && alike(*at, ratio) ? tables_[static_cast<std::size_t>(at - ratios_.begin())].get()
                                                    : nullptr;
  }

 private:
  static constexpr double tolerance = 1e-9;
  static bool alike(double a, double b) noexcept { return a <= b * (1 + tolerance) && b <= a * (1 + tolerance); }

  /// Pairs of one ratio of radii.
  struct group {
    double ratio;
    std::size_t pairs = 0;
    double smallest;  ///< of the smaller radii
    double largest;
    double deepest = 0;  ///< overlap over the smaller radius
  };

  static std::vector<group> groups_of(std::span<const tp::close_edge> pairs) {
    std::vector<std::pair<double, std::size_t>> sorted;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      sorted.emplace_back(radius_ratio(pairs[i].shape), i);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<group> groups;
    for (const auto& [ratio, i] : sorted) {
      const double r = std::min(pairs[i].shape.radius1, pairs[i].shape.radius2);
      if (groups.empty() || !alike(groups.back().ratio, ratio)) {
        groups.push_back({ratio, 0, r, r, 0});
      }
      group& g = groups.back();
      ++g.pairs;
      g.smallest = std::min(g.smallest, r);
      g.largest = std::max(g.largest, r);
      g.deepest = std::max(g.deepest, -pairs[i].shape.gap / r);
    }
    return groups;
  }

  tp::young_laplace<> exact_;
  std::vector<double> ratios_;
  std::vector<std::unique_ptr<tp::bridge_table<>>> tables_;
  double error_ = 0;
  std::size_t covered_ = 0;
};

/// The law of the tables, and the exact one for pairs without a table: a user's own law, as far as the library is
/// concerned.
struct tabulated_pairs {
  const bridge_tables* tables;

  [[nodiscard]] tp::outcome<tp::bridge_pull<double>, tp::bridge_status> bridge(
      const tp::edge<double>& e, tp::given_volume<double> liquid) const noexcept {
    const tp::bridge_table<>* table = tables->of(e);
    if (table == nullptr) {
      const auto found = tables->exact().bridge(e, liquid);
      return {{found.value.force}, found.reason};
    }
    return tp::tabulated<>{table}.bridge(e, liquid);
  }
};
static_assert(tp::bridge_law<tabulated_pairs>);

}  // namespace support
