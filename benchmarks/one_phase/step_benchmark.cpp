// SPDX-License-Identifier: BSD-3-Clause
//
// One step of a saturated flow through dense grains, from spheres to the forces on them, and its parts, beside what the
// bare library call allows, CGAL's range insertion of the same spheres (`bare_triangulation`): `triangulate`,
// `laws` (nodes and conductances), `pressures` (hierarchy and solution), `forces`; `whole` does them all, graph
// included, `follow_and_solve` all but the triangulation, on a network that follows its grains. `error` is the part of
// the boundary pressure force that the forces on grains and walls miss, `failed` is 1 where the solver says that it has
// not solved.

#include "support/compiled_triangulation.hpp"
#include "support/dense_packing.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/one_phase.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <map>

using namespace tetrapore;

namespace {

using flow_of_the_step = saturated_flow<hydraulic_radius, multigrid_solver<>>;

const packing& packing_of(const benchmark::State& state) {
  static std::map<std::int64_t, packing> made;
  auto [entry, added] = made.try_emplace(state.range(0));
  if (added) {
    entry->second = dense_packing(static_cast<std::size_t>(state.range(0)));
  }
  return entry->second;
}

network triangulated(const packing& p) { return compiled_triangulation{}(p.grains, domain_of(p)).net; }

flow_of_the_step flow_through(const network& net) {
  flow_options options;
  options.conditions.at(face::y_min) = held_pressure(1.0);
  options.conditions.at(face::y_max) = held_pressure(0.0);
  options.refused = refused_throats::closed;
  options.hydraulics = keep_hydraulics::yes;
  return {net, hydraulic_radius{.viscosity = 1.0}, multigrid_solver<>{}, options};
}

void tell(benchmark::State& state, const network& net, const flow_of_the_step& flow, const fluid_forces& forces) {
  const vec3<double> outside = boundary_force(net, flow.driving_pressure());
  state.counters["error"] = norm(forces.total() - outside) / norm(outside);
  state.counters["failed"] = flow.report().ok() ? 0 : 1;
  state.counters["pores"] = static_cast<double>(net.pore_count());
  state.counters["iterations"] = static_cast<double>(flow.report().iterations);
}

void tell(benchmark::State& state, const network& net) {
  flow_of_the_step flow = flow_through(net);
  flow.solve();
  tell(state, net, flow, forces_on_grains(flow));
}

void bare(benchmark::State& state) {
  const packing& p = packing_of(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(triangulate_bare(p.grains).cells);
  }
  tell(state, triangulated(p));
}

void triangulate(benchmark::State& state) {
  const packing& p = packing_of(state);
  network net;
  for (auto _ : state) {
    net = triangulated(p);
  }
  tell(state, net);
}

void laws(benchmark::State& state) {
  const network net = triangulated(packing_of(state));
  for (auto _ : state) {
    const flow_nodes nodes(net);
    benchmark::DoNotOptimize(conductances(net, nodes, hydraulic_radius{.viscosity = 1.0}, refused_throats::closed,
                                          serial{}, keep_hydraulics::yes)
                                 .values.data());
  }
  tell(state, net);
}

void pressures(benchmark::State& state) {
  const network net = triangulated(packing_of(state));
  for (auto _ : state) {
    state.PauseTiming();
    flow_of_the_step flow = flow_through(net);
    state.ResumeTiming();
    benchmark::DoNotOptimize(flow.solve().residual);
  }
  tell(state, net);
}

void forces(benchmark::State& state) {
  const network net = triangulated(packing_of(state));
  flow_of_the_step flow = flow_through(net);
  flow.solve();
  for (auto _ : state) {
    benchmark::DoNotOptimize(forces_on_grains(flow).viscous.data());
  }
  tell(state, net, flow, forces_on_grains(flow));
}

void follow_and_solve(benchmark::State& state) {
  const packing& p = packing_of(state);
  network net = triangulated(p);
  flow_of_the_step flow = flow_through(net);
  flow.solve();
  fluid_forces f;
  for (auto _ : state) {
    follow(net, p.grains);
    flow.update();
    flow.solve();
    f = forces_on_grains(flow);
  }
  tell(state, net, flow, f);
}

void whole(benchmark::State& state) {
  const packing& p = packing_of(state);
  for (auto _ : state) {
    const network net = triangulated(p);
    flow_of_the_step flow = flow_through(net);
    flow.solve();
    const fluid_forces f = forces_on_grains(flow);
    state.PauseTiming();
    tell(state, net, flow, f);
    state.ResumeTiming();
  }
}

void sizes(benchmark::internal::Benchmark* b) { b->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond); }

BENCHMARK(bare)->Name("bare_triangulation")->Apply(sizes);
BENCHMARK(triangulate)->Apply(sizes);
BENCHMARK(laws)->Apply(sizes);
BENCHMARK(pressures)->Apply(sizes);
BENCHMARK(forces)->Apply(sizes);
BENCHMARK(follow_and_solve)->Apply(sizes);
BENCHMARK(whole)->Apply(sizes);

}  // namespace
