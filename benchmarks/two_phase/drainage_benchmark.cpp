// SPDX-License-Identifier: BSD-3-Clause
//
// Primary drainage of dense random grains between six walls, the network given: thresholds of all facets, then the
// invasion, by trapping method and model of the gap. `error` is the volume balance relative to the pore volume, for the
// thresholds the worst relative difference to long double; `failed` the throats for which the law failed
// (lost_arc and merged: after the model of the gap).

#include "support/compiled_triangulation.hpp"
#include "support/dense_packing.hpp"
#include "support/openings.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/two_phase.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

using namespace tetrapore;

namespace {

using fixed_rule = facet_rule<mayer_stowe_princen, gap_model::lost_arc>;
using merged_rule = facet_rule<mayer_stowe_princen, gap_model::merged>;

const network& dense(std::size_t n) {
  static std::map<std::size_t, std::unique_ptr<network>> made;
  auto& net = made[n];
  if (!net) {
    const packing p = dense_packing(n);
    net = std::make_unique<network>(tessellate(p.grains, domain_of(p), compiled_triangulation{}).net);
  }
  return *net;
}

void thresholds(benchmark::State& state) {
  const network& net = dense(static_cast<std::size_t>(state.range(0)));
  std::size_t failed = 0;
  for (auto _ : state) {
    const fixed_rule rule(net, {1.0});
    failed = rule.totals()[verdict::failed];
    benchmark::DoNotOptimize(rule.alone(throat_id(0)).value);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(net.throat_count()));
  double worst = 0;
  const mayer_stowe_princen law{1.0};
  for (std::size_t t = 0; t < net.throat_count(); ++t) {
    const opening<double> o = opening_at(net, throat_id(t));
    const auto answer = law.entry_pressure(o);
    const auto exact = law.entry_pressure(openings::as<long double>(o));
    if (answer.ok() && exact.ok()) {
      worst = std::max(worst, static_cast<double>(std::abs(answer.value / exact.value - 1)));
    }
  }
  state.counters["error"] = worst;
  state.counters["failed"] = static_cast<double>(failed);
}

template <class Rule>
void invade(benchmark::State& state, trapping trap, trapping_method method) {
  const network& net = dense(static_cast<std::size_t>(state.range(0)));
  Rule rule(net, {1.0});
  double error = 0;
  std::size_t events = 0;
  for (auto _ : state) {
    drainage invasion(net, rule, {.trap = trap, .method = method});
    invasion.run();
    benchmark::DoNotOptimize(invasion.events().data());
    state.PauseTiming();
    events = invasion.events().size();
    double stayed = 0;
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      const pore_id p(i);
      stayed += invasion.state().is_reservoir(p) ? 0.0 : invasion.state().liquid()[p];
    }
    error = std::abs(invasion.drained_liquid() + stayed - invasion.initial_liquid()) / invasion.initial_liquid();
    if constexpr (Rule::depends_on_state) {
      rule.forget_merges();
    }
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(events));
  state.counters["error"] = error;
  state.counters["failed"] = static_cast<double>(rule.totals()[verdict::failed]);
  state.counters["pores"] = static_cast<double>(net.pore_count());
}

void lost_arc_no_trapping(benchmark::State& s) { invade<fixed_rule>(s, trapping::none, trapping_method::automatic); }
void lost_arc_two_passes(benchmark::State& s) {
  invade<fixed_rule>(s, trapping::per_event, trapping_method::two_passes);
}
void lost_arc_live(benchmark::State& s) { invade<fixed_rule>(s, trapping::per_event, trapping_method::live); }
void merged_no_trapping(benchmark::State& s) { invade<merged_rule>(s, trapping::none, trapping_method::automatic); }
void merged_live(benchmark::State& s) { invade<merged_rule>(s, trapping::per_event, trapping_method::live); }

}  // namespace

BENCHMARK(thresholds)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(lost_arc_no_trapping)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(lost_arc_two_passes)->Arg(10000)->Arg(40000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(lost_arc_live)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(merged_no_trapping)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(merged_live)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond);
