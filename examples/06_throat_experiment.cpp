// SPDX-License-Identifier: BSD-3-Clause
//
// Entry pressure of a throat by experiment: three grains, gas above, wetting liquid below, and a capillary pressure
// that is held until the meniscus rests or has gone through. Bisection narrows the bracket.
//
// A run that is killed goes on from the state in its folder. `throat_experiment --help` lists the options,
// docs/throat_experiment.md says what comes out.
#include "support/keys.hpp"
#include "support/meniscus_picture.hpp"
#include "support/stopwatch.hpp"
#include "support/throat_files.hpp"
#include "support/throat_job.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>

namespace tp = tetrapore;
namespace lbm = tetrapore::lbm;

namespace {

template <class Experiment>
void print(const Experiment& e, const lbm::threshold_search& search, std::uint64_t updates, double seconds) {
  const auto& found = search.now();
  const lbm::entry_result result = e.result(search);
  const support::key_printer key;
  std::printf("end=%s\n", describe(result.end));
  std::printf("last_hold=%s\n", describe(result.last));
  // where arcs alone have no entry pressure, all ratios are to the least plane value
  const double unit = std::isfinite(e.plane().princen) ? e.plane().princen : e.plane().best;
  key("entry_ratio_msp", result.value / unit);
  key("correction", result.correction);
  key("discretisation", result.discretisation);
  std::printf("film=%s\n", describe(result.film));
  key("entry_ratio_msp_raw", result.value / result.correction / unit);
  key("entry_ratio_best2d", result.value / result.correction / e.plane().best);
  key("best2d_ratio_msp", e.plane().best / unit);
  std::printf("bracket=%.6g..%.6g\n", result.lower / unit, result.upper / unit);
  key("measured_lower", found.measured_lower / e.lattice_pressure(unit));
  key("entry_pressure_lattice", found.end == lbm::search_end::converged ? search.value() : tp::quiet_nan<double>);
  key("surface_tension_lattice", e.set_up().pair.surface_tension);
  key("inscribed_nodes", e.inscribed());
  key("retraction_nodes", e.retraction());
  key("fluid_nodes", e.fluid_nodes());
  key("holds", std::size_t{result.holds});
  key("steps", static_cast<std::size_t>(result.steps));
  key("updates", static_cast<std::size_t>(result.updates));
  key("mlups", static_cast<double>(updates) / seconds * 1e-6);
  key("seconds", seconds);
}

// Above the entry pressure the gas goes on: a picture at four moments, and what rings it leaves.
template <class T>
void leave_rings(const support::throat_job& job, double capillary) {
  lbm::ring_experiment<T> experiment(support::set_up_of(job));
  support::throat_series series(job.out, "rings", 0);
  support::meniscus_picture panels;
  const double inscribed = job.resolution;
  std::uint64_t through = 0;
  const lbm::hold_report r = experiment.drain(capillary, [&](const lbm::hold_report& now) {
    if (now.steps % 1000 == 0) {
      series.add(experiment, now.steps);
    }
    // it bends, goes through, and splits
    const bool at_bottom = now.end == lbm::hold_end::passed;
    through = at_bottom && through == 0 ? now.steps : through;
    const std::array<bool, 3> moments{now.position < 0, now.position < -2 * inscribed || at_bottom,
                                      at_bottom && now.steps > through + 300};
    if (panels.panels() < 3 && moments[panels.panels()]) {
      panels.add(experiment);
    }
  });
  panels.add(experiment);
  if (r.steps % 1000 != 0) {
    series.add(experiment, r.steps);
  }
  support::write_png(job.out / "meniscus.png", panels.draw());
  const support::key_printer key;
  std::printf("rings_end=%s\n", describe(r.end));
  key("rings_steps", static_cast<std::size_t>(r.steps));
  for (const lbm::ring_report& ring : experiment.rings(capillary)) {
    const std::size_t grain = (support::first_grain(job) + ring.side) % 3;
    const std::string name = "ring_" + std::to_string(grain + 1) + std::to_string((grain + 1) % 3 + 1);
    const bool wetting = job.sides[grain] == lbm::prism_side::wetting;
    std::printf("%s=%s\n", name.c_str(), wetting ? "none: the liquid of a wetting side" : describe(ring.law));
    if (verdict_of(ring.law) == tp::verdict::ok) {
      key((name + "_volume").c_str(), ring.volume);
      key((name + "_neck").c_str(), ring.neck);
      key((name + "_neck_law").c_str(), ring.law_neck);
      key((name + "_suction").c_str(), ring.suction);
      key((name + "_suction_law").c_str(), ring.law_suction);
    }
  }
}

// Hold after hold; a state behind each, a picture every 1000 steps.
template <class T>
int run(const support::throat_job& job) {
  support::stopwatch watch;
  lbm::entry_experiment<T> experiment(support::set_up_of(job));
  const lbm::search_options options = experiment.bracket(1, job.bracket);
  lbm::threshold_search search(options);
  std::filesystem::create_directories(job.out);
  const std::filesystem::path state = job.out / "state.bin";
  if (std::filesystem::exists(state)) {
    search = experiment.restore(support::bytes_of(state), options, state.string());
    std::fprintf(stderr, "took up %s behind %u holds\n", state.string().c_str(), search.now().holds);
  }
  support::throat_series series(job.out, "meniscus", search.now().steps);
  const std::uint64_t before = search.now().updates;
  while (search.running()) {
    const double value = search.next();
    std::uint64_t shown = 0;  // steps of this hold's last picture
    const auto show = [&](const lbm::hold_report& so_far) {
      if (so_far.steps > shown) {
        series.add(experiment, search.now().steps + so_far.steps);
        shown = so_far.steps;
      }
    };
    const lbm::hold_report r = experiment.hold(value, show);
    show(r);
    std::fprintf(stderr, "p_c = %.5f: apex at %.3f r_in, %s\n", value, r.position / experiment.inscribed(),
                 describe(r.end));
    if (lies_below(r.end)) {
      experiment.keep();
    } else {
      experiment.back();
    }
    search.take(r);
    support::write_bytes(state, experiment.save(search));
  }
  print(experiment, search, search.now().updates - before, watch.lap());
  if (job.rings && search.now().end == lbm::search_end::converged) {
    leave_rings<T>(job, 1.02 * search.now().upper);
  }
  return verdict_of(search.now().end) == tp::verdict::ok ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto job = support::read_throat_job(argc, argv);
    return !job ? 0 : job->in_double ? run<double>(*job) : run<float>(*job);
  } catch (const tp::io::output_error& e) {
    std::fprintf(stderr, "throat_experiment: %s\n", e.what());
    return 1;
  } catch (const tp::setup_error& e) {  // the command line or a state: nothing was written
    std::fprintf(stderr, "throat_experiment: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "throat_experiment: %s\n", e.what());
    return 1;
  }
}
