// SPDX-License-Identifier: BSD-3-Clause
#include "support/random_rules.hpp"
#include "support/small_networks.hpp"

#include "tetrapore/law/entry/inscribed_circle.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/two_phase/facet_rule.hpp"

#include <doctest/doctest.h>

#include <random>

namespace {

using namespace tetrapore;

/// What stands in prose under the concept, for any rule: in random states, brackets contain the settled value, settling
/// never widens them, the same question gives the same answer, bounds hold, and what is closed stays closed.
template <class Rule>
void conforms(const network& net, Rule rule, std::mt19937& random) {
  two_phase_state dry(net);
  std::vector<bool> closed;
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    closed.push_back(rule.threshold(net, dry, throat_id(i)).kind() == verdict::absent);
  }
  for (int round = 0; round < 8; ++round) {
    two_phase_state state(net);
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      if (random() % 2 == 0) {
        state.mark_gas(pore_id(i));
      }
    }
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      const throat_id t(i);
      const auto& [a, b] = net.pores(t);
      CHECK((rule.threshold(net, state, t).kind() == verdict::absent) == closed[i]);
      if (!b.valid() || state.is_gas(a) == state.is_gas(b)) {
        continue;
      }
      const auto first = rule.threshold(net, state, t);
      const auto again = rule.threshold(net, state, t);
      CHECK(first.reason == again.reason);
      if (!first.ok()) {
        continue;
      }
      CHECK(first.value == again.value);
      CHECK(first.value.lo <= first.value.hi);
      auto wide = first.value;
      for (int k = 0; k < 5; ++k) {
        rule.settle(net, state, std::span(&t, 1));
        const auto narrow = rule.threshold(net, state, t);
        CHECK(narrow.ok());
        CHECK(wide.contains(narrow.value));
        wide = narrow.value;
      }
      if constexpr (bounds_thresholds<Rule>) {
        CHECK(rule.lower_bound(t) <= wide.lo);
      }
    }
  }
}

/// Grains of all sizes around the two tetrahedra and beyond: an octahedron with a wet or gas pore on each side.
network cluster(std::mt19937& random) {
  std::uniform_real_distribution<double> size(0.4, 1.0);
  std::vector<sphere<double>> grains{{{-1, -1, 0}, 0}, {{1, 1, 0}, 0},   {{1, -1, 0}, 0},
                                     {{-1, 1, 0}, 0},  {{0, 0, 1.5}, 0}, {{0, 0, -1.5}, 0}};
  for (auto& g : grains) {
    g.radius = size(random);
  }
  const auto v = [](std::size_t i) { return vertex(grain_id(i)); };
  return network_of(
      unbounded(), grains,
      {{v(0), v(1), v(2), v(4)}, {v(0), v(1), v(2), v(5)}, {v(0), v(1), v(3), v(4)}, {v(0), v(1), v(3), v(5)}});
}

}  // namespace

TEST_CASE("every model of entry_rule has the properties of its concept") {
  std::mt19937 random(31);
  for (int k = 0; k < 100; ++k) {
    const network graph = random_graph(random);
    const random_fixed_rule fixed(graph, random);
    conforms(graph, fixed, random);
    conforms(graph, random_state_rule(graph, random), random);
    conforms(graph, random_bounded_rule(graph, random), random);
    conforms(graph, random_settling_rule(fixed, random), random);
    const network net = k % 2 == 0 ? cluster(random) : two_grains_in_a_box();
    const mayer_stowe_princen law{0.07, 0.3 * (k % 3)};
    conforms(net, facet_rule<inscribed_circle>(net, {0.07}), random);
    conforms(net, facet_rule<mayer_stowe_princen, gap_model::refused>(net, law), random);
    conforms(net, facet_rule<mayer_stowe_princen, gap_model::lost_arc>(net, law), random);
    conforms(net, facet_rule<mayer_stowe_princen, gap_model::merged>(net, law), random);
  }
}

TEST_CASE("a merged threshold is never below that of the lost arc, nor a lost arc below nothing") {
  std::mt19937 random(32);
  std::size_t merged_seen = 0;
  for (int k = 0; k < 300; ++k) {
    const network net = cluster(random);
    facet_rule<mayer_stowe_princen, gap_model::lost_arc> lost(net, {1.0, 0.2 * (k % 4)});
    facet_rule<mayer_stowe_princen, gap_model::merged> merged(net, {1.0, 0.2 * (k % 4)});
    two_phase_state state(net);
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      if (random() % 2 == 0) {
        state.mark_gas(pore_id(i));
      }
    }
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      const throat_id t(i);
      const auto& [a, b] = net.pores(t);
      if (b.valid() && state.is_gas(a) != state.is_gas(b)) {
        const auto m = merged.threshold(net, state, t);
        const auto l = lost.threshold(net, state, t);
        merged_seen += m.reason == entry_status::merged ? 1U : 0U;
        CHECK(m.kind() == l.kind());
        if (m.ok()) {
          CHECK(m.value.lo >= l.value.lo * (1 - 1e-12));
        }
      }
    }
  }
  CHECK(merged_seen > 20);
}
