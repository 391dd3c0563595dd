// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "support/shared_data.hpp"

#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/two_phase.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace {

using namespace tetrapore;
using merged_rule = facet_rule<mayer_stowe_princen, gap_model::merged>;

struct scene {
  network net;
  face inlet = face::y_max;
  face outlet = face::y_min;
};

/// 200 grains between six walls, and the same between four with y open and z periodic.
std::vector<scene> scenes() {
  std::vector<scene> all;
  if (const auto path = shared_file("data/packings/open_200.txt")) {
    packing p = io::read_packing(*path).packing;
    all.push_back({tessellate(p.grains, domain_of(p), compiled_triangulation{}).net});
    p.periodic = {false, false, true};
    all.push_back({tessellate(p.grains, domain_of(p), compiled_triangulation{}).net});
    all.push_back({tessellate(p.grains, unbounded(), compiled_triangulation{}).net});
  }
  return all;
}

bool at_front(const network& net, const two_phase_state& s, throat_id t) {
  const auto& [a, b] = net.pores(t);
  return b.valid() && s.is_gas(a) != s.is_gas(b);
}

}  // namespace

TEST_CASE("every threshold of a merged rule that an event moves is named by touched_by, on real packings") {
  for (const scene& s : scenes()) {
    const mayer_stowe_princen law{1.0};
    merged_rule driven(s.net, law);
    drainage invasion(s.net, driven, {.inlet = s.inlet, .outlet = s.outlet, .trap = trapping::none});
    invasion.run();
    REQUIRE(invasion.events().size() > 500);

    // The same events again: `kept` is asked only as a driver would, `fresh` about the whole front after each event.
    merged_rule kept(s.net, law);
    merged_rule fresh(s.net, law);
    facet_rule<mayer_stowe_princen, gap_model::lost_arc> lost(s.net, law);
    two_phase_state state(s.net);
    std::vector<double> value(s.net.throat_count(), 0);
    const auto ask = [&](throat_id t) {
      if (t.valid() && at_front(s.net, state, t)) {
        value[t.index()] = kept.threshold(s.net, state, t).value.lo;
      }
    };
    for (std::size_t i = 0; i < s.net.pore_count(); ++i) {
      if (s.net.touches(pore_id(i), s.inlet)) {
        state.mark_gas(pore_id(i));
      }
    }
    for (std::size_t t = 0; t < s.net.throat_count(); ++t) {
      ask(throat_id(t));
    }
    std::size_t missed = 0;
    std::size_t below = 0;
    std::size_t wrong_event = 0;
    std::vector<throat_id> touched;
    for (const drainage_event& e : invasion.events()) {
      double least = infinity<double>;
      for (std::size_t i = 0; i < s.net.throat_count(); ++i) {
        const throat_id t(i);
        if (!at_front(s.net, state, t)) {
          continue;
        }
        const auto answer = fresh.threshold(s.net, state, t);
        missed += answer.value.lo == value[i] ? 0U : 1U;
        below += answer.value.lo < lost.alone(t).value * (1 - 1e-12) ? 1U : 0U;
        const auto& [a, b] = s.net.pores(t);
        if (answer.ok() && !invasion.state().is_outlet(state.is_gas(a) ? b : a)) {
          least = std::min(least, answer.value.lo);
        }
      }
      wrong_event += e.threshold == least ? 0U : 1U;
      state.mark_gas(e.pore);
      touched.clear();
      kept.touched_by(s.net, state, e.pore, touched);
      for (const throat_id t : s.net.throats(e.pore)) {
        ask(t);
      }
      for (const throat_id t : touched) {
        ask(t);
      }
    }
    CHECK(missed == 0);
    CHECK(below == 0);
    CHECK(wrong_event == 0);
    const merge_counts& m = invasion.rule().merges();
    CHECK(m.merged > 100);
    MESSAGE(invasion.events().size() << " events; merged " << m.merged << ", at the lost arc " << m.at_arc
                                     << ", without partner " << m.no_partner << ", without ring " << m.no_ring
                                     << ", moved " << m.moved);
  }
}

TEST_CASE("a merged drainage resumed from its state gives the events of an uninterrupted one") {
  for (const scene& s : scenes()) {
    const mayer_stowe_princen law{1.0};
    for (const trapping trap : {trapping::per_event, trapping::per_level}) {
      const drainage_options options{.inlet = s.inlet, .outlet = s.outlet, .trap = trap};
      merged_rule rule(s.net, law);
      drainage whole(s.net, rule, options);
      whole.run();
      merged_rule half(s.net, law);
      drainage first(s.net, half, options);
      for (std::size_t k = 0; k < whole.events().size() / 3; ++k) {
        first.step();
      }
      merged_rule rest(s.net, law);
      drainage second(s.net, rest, state_from_bytes(s.net, to_bytes(s.net, first.state())), options);
      second.run();
      auto both = first.events();
      both.insert(both.end(), second.events().begin(), second.events().end());
      CHECK(both == whole.events());
      CHECK(to_bytes(s.net, second.state()) == to_bytes(s.net, whole.state()));
    }
  }
}

TEST_CASE("without trapping everything drains; the liquid that left and stayed is what was there") {
  for (const scene& s : scenes()) {
    const mayer_stowe_princen law{1.0};
    facet_rule<mayer_stowe_princen, gap_model::lost_arc> lost(s.net, law);
    merged_rule merged(s.net, law);
    const auto check = [&](auto& rule, trapping trap) {
      drainage invasion(s.net, rule, {.inlet = s.inlet, .outlet = s.outlet, .trap = trap});
      invasion.run();
      const double stayed = saturation(s.net, invasion.state()) * invasion.void_volume();
      CHECK(std::abs(invasion.drained_liquid() + stayed - invasion.initial_liquid()) <=
            1e-13 * invasion.initial_liquid());
      CHECK((trap == trapping::none ? stayed <= 1e-13 : stayed > 0));
    };
    for (const trapping trap : {trapping::none, trapping::per_event, trapping::per_level}) {
      check(lost, trap);
      check(merged, trap);
    }
  }
}
