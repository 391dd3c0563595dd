// SPDX-License-Identifier: BSD-3-Clause
#include "support/drainage_oracle.hpp"
#include "support/random_rules.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>

namespace {

using namespace tetrapore;

/// Whether an invasion is that of the oracle, event by event, cluster by cluster, to the last bit.
template <class Rule, class Oracle>
bool same(const drainage<Rule>& invasion, const Oracle& oracle) {
  const auto& events = invasion.events();
  bool same = events.size() == oracle.events.size();
  for (std::size_t k = 0; same && k < events.size(); ++k) {
    const auto& a = events[k];
    const auto& b = oracle.events[k];
    same = a.pore.index() == b.pore && a.throat.index() == b.throat && a.threshold == b.threshold &&
           a.pressure == b.pressure && a.level == b.level;
  }
  std::map<std::uint32_t, std::size_t> least;
  const two_phase_state& state = invasion.state();
  for (std::size_t i = 0; same && i < state.pore_count(); ++i) {
    const pore_id p(i);
    const auto& trap = oracle.traps[i];
    same = state.is_trapped(p) == (trap.pressure >= 0);
    if (same && state.is_trapped(p)) {
      least.try_emplace(state.cluster(p), i);
      same = least[state.cluster(p)] == trap.cluster && state.clusters()[state.cluster(p)].pressure == trap.pressure;
    }
  }
  return same;
}

/// Σ of what left and what stayed, against what was there.
template <class Rule>
double balance_defect(const drainage<Rule>& invasion) {
  const two_phase_state& s = invasion.state();
  double left = 0;
  for (const drainage_event& e : invasion.events()) {
    left += e.volume;
  }
  double stayed = 0;
  for (std::size_t i = 0; i < s.pore_count(); ++i) {
    stayed += s.is_reservoir(pore_id(i)) ? 0.0 : s.liquid()[pore_id(i)];
  }
  return std::abs(left + stayed - invasion.initial_liquid());
}

template <class Rule>
bool monotone(const drainage<Rule>& invasion) {
  double pressure = 0;
  for (const drainage_event& e : invasion.events()) {
    if (e.pressure < pressure || e.pressure < e.threshold) {
      return false;
    }
    pressure = e.pressure;
  }
  return true;
}

struct scene {
  trapping trap;
  double margin;
  bool films;
};
constexpr std::array<scene, 7> scenes{{{trapping::none, 0, false},
                                       {trapping::none, 0.2, false},
                                       {trapping::per_event, 0, false},
                                       {trapping::per_event, 0.2, true},
                                       {trapping::per_level, 0, false},
                                       {trapping::per_level, 0, true},
                                       {trapping::per_level, 0.2, false}}};

drainage_options options_for(const scene& s, trapping_method method) {
  return {.trap = s.trap, .method = method, .level_margin = s.margin, .liquid_passes_closed_throats = s.films};
}

/// Runs half of it, goes on from a copy of the state with a new driver, and returns all the events.
template <class Rule>
bool resumes(const network& net, Rule rule, const drainage_options& options, const std::vector<drainage_event>& all) {
  drainage first(net, rule, options);
  for (std::size_t k = 0; k < all.size() / 2; ++k) {
    first.step();
  }
  Rule fresh = rule;
  drainage second(net, fresh, first.state(), options);
  second.run();
  std::vector<drainage_event> both = first.events();
  both.insert(both.end(), second.events().begin(), second.events().end());
  drainage whole(net, rule, options);
  whole.run();
  const auto a = whole.state().clusters();
  const auto b = second.state().clusters();
  return both == all && std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

TEST_CASE("drainage with fixed thresholds is the oracle's, in two passes and live, event by event") {
  std::mt19937 random(20170612);
  std::size_t wrong = 0;
  std::size_t trapped = 0;
  std::size_t events = 0;
  double defect = 0;
  for (int k = 0; k < 1000; ++k) {
    const network net = random_graph(random);
    random_fixed_rule rule(net, random);
    for (const scene& s : scenes) {
      const drainage_oracle oracle(net, rule, options_for(s, trapping_method::automatic));
      for (const trapping_method method : {trapping_method::automatic, trapping_method::live}) {
        drainage invasion(net, rule, options_for(s, method));
        CHECK(invasion.in_two_passes() == (method == trapping_method::automatic && s.trap != trapping::none &&
                                           (s.trap == trapping::per_event || s.margin == 0)));
        invasion.run();
        wrong += same(invasion, oracle) && monotone(invasion) ? 0U : 1U;
        wrong += resumes(net, rule, options_for(s, method), invasion.events()) ? 0U : 1U;
        defect = std::max(defect, balance_defect(invasion));
        events += invasion.events().size();
        trapped += invasion.state().clusters().size();
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(defect < 1e-13);
  CHECK(events > 50000);
  CHECK(trapped > 5000);
  MESSAGE(events << " events, " << trapped << " trapped clusters, volume balance to " << defect);
}

TEST_CASE_TEMPLATE("drainage with thresholds that depend on the state is the oracle's, event by event", Rule,
                   random_state_rule, random_bounded_rule) {
  std::mt19937 random(4081);
  std::size_t wrong = 0;
  std::size_t events = 0;
  for (int k = 0; k < 1000; ++k) {
    const network net = random_graph(random);
    Rule rule(net, random);
    for (const scene& s : scenes) {
      const drainage_options options = options_for(s, trapping_method::automatic);
      const drainage_oracle oracle(net, rule, options);
      drainage invasion(net, rule, options);
      CHECK(!invasion.in_two_passes());
      invasion.run();
      wrong += same(invasion, oracle) && monotone(invasion) ? 0U : 1U;
      wrong += resumes(net, rule, options, invasion.events()) ? 0U : 1U;
      events += invasion.events().size();
    }
  }
  CHECK(wrong == 0);
  MESSAGE(events << " events");
}

TEST_CASE("brackets that settle give the order of the settled values, and settle only what could be next") {
  std::mt19937 random(99);
  std::size_t wrong = 0;
  std::size_t experiments = 0;
  std::size_t throats = 0;
  for (int k = 0; k < 1000; ++k) {
    const network net = random_graph(random);
    random_fixed_rule truth(net, random);
    // Distinct values in both directions alike, so that a settled order exists.
    for (std::size_t t = 0; t < truth.thresholds.size(); ++t) {
      const double value = truth.thresholds[t][0] + 1e-3 * static_cast<double>(t);
      truth.thresholds[t] = {value, value};
    }
    for (const trapping_method method : {trapping_method::automatic, trapping_method::live}) {
      random_settling_rule rule(truth, random);
      drainage exact(net, truth, {.method = method});
      drainage settled(net, rule, {.method = method});
      exact.run();
      settled.run();
      bool equal = exact.events().size() == settled.events().size();
      for (std::size_t e = 0; equal && e < exact.events().size(); ++e) {
        equal = exact.events()[e].pore == settled.events()[e].pore &&
                exact.events()[e].throat == settled.events()[e].throat;
      }
      wrong += equal ? 0U : 1U;
      experiments += rule.experiments;
      throats += 3 * net.throat_count();
    }
  }
  CHECK(wrong == 0);
  CHECK(experiments < throats);
  MESSAGE(experiments << " experiments of " << throats << " that settling everything would take");
}

TEST_CASE("a second run gives the same bits") {
  std::mt19937 random(5);
  for (int k = 0; k < 50; ++k) {
    const network net = random_graph(random);
    random_state_rule rule(net, random);
    drainage a(net, rule);
    drainage b(net, rule);
    a.run();
    b.run();
    CHECK(a.events() == b.events());
  }
}
