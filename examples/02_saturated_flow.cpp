// SPDX-License-Identifier: BSD-3-Clause
//
// Saturated flow: the permeability of a packing, the pressure in every pore and the drag on every grain.
//
// One fluid fills the packing and flows from one face to the opposite one, or along a periodic axis under a mean
// gradient. `saturated_flow --help` lists the options, docs/flow.md says what comes out.
#include "support/flow_choices.hpp"
#include "support/flow_job.hpp"
#include "support/flow_results.hpp"
#include "support/stopwatch.hpp"

#include "tetrapore/tessellation/cgal.hpp"

#include <cstdio>
#include <exception>

namespace tp = tetrapore;
using support::flow_job;

// The packing that ships with the project lies beside this file.
const std::filesystem::path shipped = std::filesystem::path(__FILE__).parent_path() / "data" / "beads_10000.txt";

// Step 1: the grains, and what drives the flow through them.
tp::packing read_grains(flow_job& job) {
  tp::packing packing = support::read_grains(job);
  if (!job.gradient && packing.periodic[axis_of(job.inlet)]) {
    job.gradient = axis_of(job.inlet);
    std::fprintf(stderr, "the box repeats along %c: a mean gradient drives the flow\n", "xyz"[*job.gradient]);
  }
  if (job.gradient && !packing.periodic[*job.gradient]) {
    support::refuse("--gradient", std::string(1, "xyz"[*job.gradient]), "an axis along which the box repeats");
  }
  if (!job.gradient && job.outlet != opposite(job.inlet)) {
    support::refuse("--outlet", describe(job.outlet),
                    std::string(describe(opposite(job.inlet))) + ", opposite to the inlet");
  }
  return packing;
}

void expect_solved(const tp::solve_report& report) {
  if (!report.ok()) {
    throw std::runtime_error(std::string("the pressures: ") + describe(report.reason));
  }
}

// Steps 2 to 4: pores and throats; conductances and the system of pressures; the flow, and what it does to the grains.
void run(flow_job job) {
  support::flow_seconds spent;
  const tp::packing packing = read_grains(job);

  support::stopwatch watch;
  const tp::tessellation mesh = tp::cgal_triangulation{}(packing.grains, domain_of(packing));
  support::report_mesh(mesh);
  spent.tessellation = watch.lap();

  support::flow_of_the_job flow(
      mesh.net, support::chosen_law(job), support::chosen_solver(job),
      {.conditions = support::conditions_of(job, *packing.bounds), .refused = tp::refused_throats::closed});
  spent.laws = watch.lap() - flow.solver().setup_seconds();
  if (const std::size_t n = flow.conductances().counts.refused(); n > 0) {
    const tp::throat_id first = flow.conductances().counts.first_refused();
    const auto why = flow.law().conductance(flow.system().nodes().throat_between(mesh.net, first)).reason;
    std::fprintf(stderr, "warning: the law refuses %zu throats, which are closed; the first is %zu: %s\n", n,
                 first.index(), describe(why));
  }

  expect_solved(flow.solve());
  spent.setup = flow.solver().setup_seconds();
  spent.solve = flow.solver().solve_seconds();
  const tp::fluid_forces forces =
      forces_on_grains(flow, tp::share_by_wetted_area{.wall = support::chosen_law::condition(job)});
  const support::flow_summary summary = support::summarise(flow, forces, job);
  const double at_throats = support::write_flow(job, flow, forces, summary);
  std::fprintf(stderr, "wrote %s\n", job.out.string().c_str());

  // What another right-hand side costs, from the solution at hand: the pressure drop rises by a tenth.
  flow_job more = job;
  more.pressure_drop *= 1.1;
  flow.set_conditions(support::conditions_of(more, *packing.bounds));
  expect_solved(flow.solve());
  spent.resolve = flow.solver().solve_seconds();

  support::print_flow(flow, summary, spent, at_throats);
}

int main(int argc, char** argv) {
  try {
    if (const auto job = support::read_flow_job(argc, argv, shipped)) {
      run(*job);
    }
    return 0;
  } catch (const tp::io::output_error& e) {
    std::fprintf(stderr, "saturated_flow: %s\n", e.what());
    return 1;
  } catch (const tp::setup_error& e) {  // the command line or the packing: nothing was written
    std::fprintf(stderr, "saturated_flow: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "saturated_flow: %s\n", e.what());
    return 1;
  }
}
