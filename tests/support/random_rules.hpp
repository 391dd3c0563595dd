// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/graph_network.hpp"

#include "tetrapore/two_phase/entry_rule.hpp"

#include <algorithm>
#include <random>
#include <vector>

/// \file
/// Random graphs, and rules on them that have nothing to do with geometry.

/// A connected-or-not graph of 5 to 40 pores, with loops and parallel links; some pores at y_max, some at y_min.
[[nodiscard]] inline tetrapore::network random_graph(std::mt19937& random) {
  using tetrapore::face;
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  std::vector<graph_pore> pores(5 + below(36));
  const std::size_t inlets = 1 + below(2);
  const std::size_t outlets = 1 + below(2);
  for (std::size_t i = 0; i < pores.size(); ++i) {
    pores[i].void_volume = 0.5 + std::uniform_real_distribution<double>()(random);
    if (i < inlets) {
      pores[i].walls = {face::y_max};
    } else if (i >= pores.size() - outlets) {
      pores[i].walls = {face::y_min};
    } else if (below(6) == 0) {
      pores[i].walls = {face::x_min};
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> links;
  std::vector<std::size_t> degree(pores.size(), 0);
  const std::size_t wanted = pores.size() + below(pores.size() + 1);
  for (std::size_t tries = 0; links.size() < wanted && tries < 20 * wanted; ++tries) {
    const std::size_t i = below(pores.size());
    // Mostly short links, so that the graph is more of a strip than a ball and much gets cut off.
    const std::size_t j = below(4) == 0 ? below(pores.size()) : std::min(i + below(4), pores.size() - 1);
    if (degree[i] + (i == j ? 1U : 0U) < 4 && degree[j] < 4) {
      links.emplace_back(i, j);
      ++degree[i];
      ++degree[j];
    }
  }
  return graph_network(pores, links);
}

/// Given thresholds for both directions; few distinct values, so that ties abound; some throats closed or refused.
struct random_fixed_rule {
  static constexpr bool depends_on_state = false;

  random_fixed_rule(const tetrapore::network& net, std::mt19937& random) {
    const std::size_t values = std::uniform_int_distribution<std::size_t>(2, 30)(random);
    std::uniform_int_distribution<std::size_t> value(1, values);
    std::uniform_int_distribution<int> percent(0, 99);
    for (std::size_t t = 0; t < net.throat_count(); ++t) {
      using tetrapore::entry_status;
      const double forward = static_cast<double>(value(random));
      thresholds.push_back({forward, percent(random) < 70 ? forward : static_cast<double>(value(random))});
      const int p = percent(random);
      reasons.push_back(p < 8 ? entry_status::closed : (p < 14 ? entry_status::no_hole : entry_status::ok));
    }
  }
  [[nodiscard]] tetrapore::threshold_outcome threshold(const tetrapore::network& net,
                                                       const tetrapore::two_phase_state& state,
                                                       tetrapore::throat_id t) const {
    const double value = thresholds[t.index()][state.is_gas(net.pores(t)[0]) ? 0 : 1];
    return {tetrapore::bracket<double>::exactly(value), reasons[t.index()]};
  }
  void settle(const tetrapore::network&, const tetrapore::two_phase_state&,
              std::span<const tetrapore::throat_id>) const {}
  void touched_by(const tetrapore::network&, const tetrapore::two_phase_state&, tetrapore::pore_id,
                  std::vector<tetrapore::throat_id>&) const {}

  std::vector<std::array<double, 2>> thresholds;
  std::vector<tetrapore::entry_status> reasons;
};

/// The same, plus (or minus) something for each gas pore beside the pore to be entered; with much gas around, a throat
/// can also be refused.
struct random_state_rule {
  static constexpr bool depends_on_state = true;

  random_state_rule(const tetrapore::network& net, std::mt19937& random) : fixed(net, random) {
    std::uniform_int_distribution<int> step(-3, 3);
    for (std::size_t t = 0; t < net.throat_count(); ++t) {
      slope.push_back(step(random));
    }
  }
  [[nodiscard]] tetrapore::threshold_outcome threshold(const tetrapore::network& net,
                                                       const tetrapore::two_phase_state& state,
                                                       tetrapore::throat_id t) const {
    auto answer = fixed.threshold(net, state, t);
    const auto& [a, b] = net.pores(t);
    const tetrapore::pore_id into = state.is_gas(a) ? b : a;
    int gas = 0;
    for (const tetrapore::throat_id s : net.throats(into)) {
      gas += s.valid() && state.is_gas(net.across(into, s)) ? 1 : 0;
    }
    if (answer.ok() && slope[t.index()] == 3 && gas > 2) {
      answer.reason = tetrapore::entry_status::gap_limited;
    }
    answer.value = tetrapore::bracket<double>::exactly(answer.value.lo + slope[t.index()] * gas + 20);
    return answer;
  }
  void settle(const tetrapore::network&, const tetrapore::two_phase_state&,
              std::span<const tetrapore::throat_id>) const {}
  void touched_by(const tetrapore::network& net, const tetrapore::two_phase_state&, tetrapore::pore_id p,
                  std::vector<tetrapore::throat_id>& out) const {
    for (const tetrapore::throat_id s : net.throats(p)) {
      if (s.valid()) {
        for (const tetrapore::throat_id t : net.throats(net.across(p, s))) {
          if (t.valid()) {
            out.push_back(t);
          }
        }
      }
    }
  }

  random_fixed_rule fixed;
  std::vector<int> slope;
};

/// The same, with bounds that hold in every state.
struct random_bounded_rule : random_state_rule {
  using random_state_rule::random_state_rule;

  [[nodiscard]] double lower_bound(tetrapore::throat_id t) const {
    const auto& both = fixed.thresholds[t.index()];
    return std::min(both[0], both[1]) + std::min(4 * slope[t.index()], 0) + 20;
  }
};

/// A rule whose values come from an experiment: it knows brackets, and settles a throat only when asked to.
struct random_settling_rule {
  static constexpr bool depends_on_state = false;

  random_settling_rule(const random_fixed_rule& truth, std::mt19937& random) : fixed(truth) {
    std::uniform_real_distribution<double> margin(0, 3);
    for (std::size_t t = 0; t < truth.reasons.size(); ++t) {
      below.push_back(margin(random));
      above.push_back(margin(random));
      settled.push_back(0);
    }
  }
  [[nodiscard]] tetrapore::threshold_outcome threshold(const tetrapore::network& net,
                                                       const tetrapore::two_phase_state& state,
                                                       tetrapore::throat_id t) const {
    auto answer = fixed.threshold(net, state, t);
    const double left = 1.0 / (1 << settled[t.index()]);
    if (settled[t.index()] < 3) {
      answer.value = {answer.value.lo - left * below[t.index()], answer.value.hi + left * above[t.index()]};
    }
    return answer;
  }
  void settle(const tetrapore::network&, const tetrapore::two_phase_state&,
              std::span<const tetrapore::throat_id> candidates) {
    for (const tetrapore::throat_id t : candidates) {
      settled[t.index()] = settled[t.index()] < 3 ? settled[t.index()] + 1 : 3;
      ++experiments;
    }
  }
  void touched_by(const tetrapore::network&, const tetrapore::two_phase_state&, tetrapore::pore_id,
                  std::vector<tetrapore::throat_id>&) const {}

  random_fixed_rule fixed;
  std::vector<double> below, above;
  std::vector<int> settled;
  std::size_t experiments = 0;
};

static_assert(tetrapore::bounds_thresholds<random_bounded_rule> && !tetrapore::bounds_thresholds<random_state_rule>);
static_assert(tetrapore::entry_rule<random_fixed_rule> && tetrapore::entry_rule<random_state_rule> &&
              tetrapore::entry_rule<random_settling_rule>);
