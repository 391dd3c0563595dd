// SPDX-License-Identifier: BSD-3-Clause
//
// Wet grains that collide: the liquid between them is squeezed out, they touch, a bridge forms, and they part or stick.
//
// First two grains, with books of where the energy goes; then the same two in liquids of many viscosities, which gives
// the restitution against the Stokes number and the one below which they stick; then a cloud of grains in a box, whose
// bridges form, rupture and hand their liquid on. Grains are moved by support/wet_grains.hpp, which stands for the
// simulator that you have. `wet_collision --help` lists the options, docs/collision.md says what comes out.
#include "support/collision_files.hpp"
#include "support/stopwatch.hpp"

#include <cstdio>
#include <exception>
#include <optional>

namespace tp = tetrapore;

void run(const support::collision_job& job) {
  support::stopwatch watch;
  const support::key_printer say;
  const support::collision one = support::collide(job.material, job.pair, true);
  const double seconds_pair = watch.lap();

  std::optional<support::restitution_sweep> restitution;  // a sweep of the viscosity needs a film
  if (job.points > 0 && job.material.viscosity > 0) {
    restitution = support::sweep(job.material, job.pair, job.points, job.sweep_to);
  }
  const double seconds_sweep = watch.lap();

  std::optional<support::cloud_run> cloud;
  if (job.cloud.grains > 0) {
    support::wet_grains grains =
        support::make_cloud(job.material, job.cloud, job.pair.radius1, job.pair.radius2, job.pair.speed);
    cloud = support::follow(grains, job.material, job.cloud);
  }
  const double seconds_cloud = watch.lap();

  std::filesystem::create_directories(job.out);
  support::write_trace(job.out, one);
  support::print_collision(say, job, one);
  if (restitution) {
    support::write_sweep(job.out, *restitution);
    support::print_sweep(say, *restitution);
  }
  if (cloud) {
    support::write_cloud(job.out, *cloud);
    support::print_cloud(say, *cloud);
  }
  std::fprintf(stderr, "wrote %s\n", job.out.string().c_str());
  say("seconds_pair", seconds_pair);
  say("seconds_sweep", seconds_sweep);
  say("seconds_cloud", seconds_cloud);
}

int main(int argc, char** argv) {
  try {
    if (const auto job = support::read_collision_job(argc, argv)) {
      run(*job);
    }
    return 0;
  } catch (const tp::io::output_error& e) {
    std::fprintf(stderr, "wet_collision: %s\n", e.what());
    return 1;
  } catch (const tp::setup_error& e) {  // the command line: nothing was written
    std::fprintf(stderr, "wet_collision: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "wet_collision: %s\n", e.what());
    return 1;
  }
}
