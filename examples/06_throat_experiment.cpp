// SPDX-License-Identifier: BSD-3-Clause
//
// Entry pressure of a throat by experiment: three grains, gas above, wetting liquid below, and a capillary pressure
// that is held until the meniscus rests or has gone through. Bisection narrows the bracket.
//
// A run that is killed goes on from the state in its folder. `throat_experiment --help` lists the options,
// docs/throat_experiment.md says what comes out.
#include "support/keys.hpp"
#include "support/stopwatch.hpp"
#include "support/throat_files.hpp"
#include "support/throat_job.hpp"

#include <cstdio>
#include <exception>

namespace tp = tetrapore;
namespace lbm = tetrapore::lbm;

namespace {

template <class Experiment>
void print(const Experiment& e, const lbm::threshold_search& search, std::uint64_t updates, double seconds) {
  const auto& found = search.now();
  const double princen = e.lattice_pressure(e.plane().princen);
  const support::key_printer key;
  std::printf("end=%s\n", describe(found.end));
  std::printf("last_hold=%s\n", describe(found.last));
  // the correction is calibrated for θ = 0 and its own retraction; elsewhere there is none to make
  const bool calibrated = e.set_up().contact_angle == 0 && e.set_up().retraction == lbm::entry_set_up{}.retraction;
  const double correction = calibrated ? lbm::entry_correction(e.inscribed()) : 1;
  key("entry_ratio_msp", correction * search.value() / princen);
  key("correction", correction);
  key("entry_ratio_msp_raw", search.value() / princen);
  key("entry_ratio_best2d", search.value() / e.lattice_pressure(e.plane().best));
  key("best2d_ratio_msp", e.plane().best / e.plane().princen);
  std::printf("bracket=%.6g..%.6g\n", found.lower / princen, found.upper / princen);
  key("measured_lower", found.measured_lower / princen);
  key("entry_pressure_lattice", search.value());
  key("surface_tension_lattice", e.set_up().pair.surface_tension);
  key("inscribed_nodes", e.inscribed());
  key("retraction_nodes", e.set_up().retraction);
  key("fluid_nodes", e.fluid_nodes());
  key("holds", std::size_t{found.holds});
  key("steps", static_cast<std::size_t>(found.steps));
  key("updates", static_cast<std::size_t>(found.updates));
  key("mlups", static_cast<double>(updates) / seconds * 1e-6);
  key("seconds", seconds);
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
  support::throat_series series(job.out, search.now().steps);
  const std::uint64_t before = search.now().updates;
  while (search.running()) {
    const double value = search.next();
    const lbm::hold_report r = experiment.hold(
        value, [&](const lbm::hold_report& so_far) { series.add(experiment, search.now().steps + so_far.steps); });
    if (r.steps > 0) {
      series.add(experiment, search.now().steps + r.steps);
    }
    std::fprintf(stderr, "p_c = %.5f: apex at %.3f r_in, %s\n", value, r.position / experiment.inscribed(),
                 describe(r.end));
    if (r.end == lbm::hold_end::stable) {
      experiment.keep();
    } else {
      experiment.back();
    }
    search.take(r);
    support::write_bytes(state, experiment.save(search));
  }
  print(experiment, search, search.now().updates - before, watch.lap());
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
