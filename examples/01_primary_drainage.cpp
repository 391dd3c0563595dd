// SPDX-License-Identifier: BSD-3-Clause
//
// Primary drainage: from a file of spheres to the retention curve of the packing, its pictures and its full history.
//
// A packing saturated with a wetting liquid is opened to gas on one face. The capillary pressure rises, and gas takes
// one pore after the other, always through the throat that lets it in at the lowest pressure; liquid that loses its way
// to the outlet is trapped. `primary_drainage --help` lists the options, docs/start.md says what comes out.
#include "support/drainage_files.hpp"
#include "support/drainage_job.hpp"
#include "support/drainage_results.hpp"
#include "support/stopwatch.hpp"

#include "tetrapore/tessellation/cgal.hpp"

#include <cstdio>
#include <exception>
#include <numbers>
#include <variant>

namespace tp = tetrapore;
using support::drainage_job;

// The packing that ships with the project lies beside this file.
const std::filesystem::path shipped = std::filesystem::path(__FILE__).parent_path() / "data" / "beads_10000.txt";

// Step 1: the grains, and the box that holds them. Nothing that is wrong in the file gets past here.
tp::packing read_grains(const drainage_job& job) {
  tp::packing packing = support::read_grains(job);
  for (const auto& [option, f] : {std::pair{"--inlet", job.inlet}, std::pair{"--outlet", job.outlet}}) {
    if (packing.periodic[axis_of(f)]) {
      support::refuse(option, describe(f), "a face across which the packing does not repeat (see --periodic)");
    }
  }
  return packing;
}

// Step 2: pores and throats, the dual of the power diagram of the spheres.
tp::tessellation triangulate(const tp::packing& packing, const drainage_job& job) {
  tp::tessellation mesh = tp::cgal_triangulation{}(packing.grains, domain_of(packing, job.walls));
  support::report_mesh(mesh);
  return mesh;
}

// Step 3: what lets gas through a throat. The law is chosen on the command line, so it is a variant here; below it,
// every combination is a type of its own.
using msp = tp::mayer_stowe_princen;
using entry_rule_of_the_job =
    std::variant<tp::facet_rule<msp, tp::gap_model::lost_arc>, tp::facet_rule<msp, tp::gap_model::merged>,
                 tp::facet_rule<msp, tp::gap_model::refused>, tp::facet_rule<tp::inscribed_circle>>;

entry_rule_of_the_job thresholds(const tp::network& net, const drainage_job& job) {
  const double angle = job.contact_angle * std::numbers::pi / 180;
  if (job.entry == "inscribed") {
    return tp::facet_rule<tp::inscribed_circle>(net, {.surface_tension = job.surface_tension, .contact_angle = angle});
  }
  const msp law{.surface_tension = job.surface_tension, .contact_angle = angle};
  if (job.gap_limited == "merged") {
    return tp::facet_rule<msp, tp::gap_model::merged>(net, law);
  }
  if (job.gap_limited == "refused") {
    return tp::facet_rule<msp, tp::gap_model::refused>(net, law);
  }
  return tp::facet_rule<msp, tp::gap_model::lost_arc>(net, law);
}

// From a file to the numbers on stdout and the files in a folder. Nothing is written before everything is known.
void run(const drainage_job& job) {
  support::stopwatch watch;
  support::seconds spent;

  const tp::packing packing = read_grains(job);
  spent.read = watch.lap();

  const tp::tessellation mesh = triangulate(packing, job);
  spent.tessellation = watch.lap();

  auto rule = thresholds(mesh.net, job);
  const support::sizes sizes = std::visit([&](const auto& r) { return support::measure_sizes(mesh.net, r); }, rule);
  spent.laws = watch.lap();

  const support::history history = std::visit([&](auto& r) { return support::drain(mesh.net, r, job); }, rule);
  std::fprintf(stderr, "gas took %zu pores\n", history.events.size());
  if (const tp::merge_counts& m = history.merges; m.asked() > 0) {
    std::fprintf(stderr, "merged: %zu asked, %zu moved\n", m.asked(), m.moved);
  }
  const support::summary summary = support::summarise(mesh, sizes, history, job);
  support::warn_of_gravity(summary, job);
  spent.invasion = watch.lap();

  support::write_everything(job, mesh.net, sizes, history, summary);
  std::fprintf(stderr, "wrote %s\n", job.out.string().c_str());
  support::print_table(history.curve, summary);
  spent.write = watch.lap();
  support::print_keys(summary, spent);
}

int main(int argc, char** argv) {
  try {
    if (const auto job = support::read_drainage_job(argc, argv, shipped)) {
      run(*job);
    }
    return 0;
  } catch (const tp::io::output_error& e) {
    std::fprintf(stderr, "primary_drainage: %s\n", e.what());
    return 1;
  } catch (const tp::setup_error& e) {  // the command line or the packing: nothing was written
    std::fprintf(stderr, "primary_drainage: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "primary_drainage: %s\n", e.what());
    return 1;
  }
}
