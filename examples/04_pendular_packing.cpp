// SPDX-License-Identifier: BSD-3-Clause
//
// A moist packing: a liquid bridge on every pair of grains, and of a grain and a wall, that is close enough for one.
//
// All bridges hang at the same suction, as where films or vapour let them exchange liquid, or all hold the same volume,
// as right after mixing. As the suction rises they lose liquid, let go of the wider gaps, and what holds the packing
// together changes. `pendular_packing --help` lists the options, docs/pendular.md says what comes out.
#include "support/pendular_files.hpp"

#include <cstdio>
#include <exception>
#include <optional>

namespace tp = tetrapore;
using support::pendular_job;

// The packing that ships with the project lies beside this file.
const std::filesystem::path shipped = std::filesystem::path(__FILE__).parent_path() / "data" / "beads_10000.txt";

// Says where bridges touch: their liquid is then shared, and the sum of their volumes is too large.
void warn_of_touching(const support::pendular_results& all, const support::pendular_scene& scene) {
  const support::pendular_state& wet = all.states.front();
  if (wet.overlapping > 0) {
    std::fprintf(stderr,
                 "warning: at the first step, S = %.3g, %zu of %zu bridges touch another one: beyond the pendular "
                 "limit liquid volumes and forces are those of bridges that do not see each other\n",
                 scene.saturation(wet), wet.overlapping, wet.formed());
  }
}

// Close pairs; their bridges, step by step; files and numbers.
void run(const pendular_job& job) {
  support::stopwatch watch;
  support::pendular_seconds spent;
  const tp::packing packing = support::read_grains(job);
  spent.read = watch.lap();

  const support::pendular_scene scene = support::make_scene(packing, job);
  std::fprintf(stderr, "%zu pairs nearer than %.4g m\n", scene.pairs.size(), scene.reach);
  spent.pairs = watch.lap();

  support::bridge_law_of_the_job law = support::law_of(job, job.law);
  std::optional<support::bridge_tables> tables;
  if (support::is_tabulated(law)) {
    law = support::tabulated_pairs{&tables.emplace(support::make_tables(scene, job))};
  }
  spent.tables = watch.lap();

  support::pendular_results all;
  for (const double step : job.steps) {
    support::answers found = support::ask(scene, law, job.held, step, all.last);
    all.seconds_laws += found.seconds;
    all.asked += found.asked;
    all.states.push_back(support::sum_up(scene, found.of_pair, step));
    all.last = std::move(found.of_pair);
  }
  all.seconds_last = support::seconds_of_bridges(scene, law, job.held, job.steps.back(), all.last);
  warn_of_touching(all, scene);
  spent.states = watch.lap();

  support::write_pendular(job, scene, all, law);
  std::fprintf(stderr, "wrote %s\n", job.out.string().c_str());
  spent.write = watch.lap();
  support::print_pendular(scene, all, job, tables ? &*tables : nullptr, spent);
}

int main(int argc, char** argv) {
  try {
    if (const auto job = support::read_pendular_job(argc, argv, shipped)) {
      run(*job);
    }
    return 0;
  } catch (const tp::io::output_error& e) {
    std::fprintf(stderr, "pendular_packing: %s\n", e.what());
    return 1;
  } catch (const tp::setup_error& e) {  // the command line or the packing: nothing was written
    std::fprintf(stderr, "pendular_packing: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "pendular_packing: %s\n", e.what());
    return 1;
  }
}
