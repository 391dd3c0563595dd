// SPDX-License-Identifier: BSD-3-Clause
//
// Lattice permeability: Stokes flow through a periodic packing, solved on a lattice between the grains, without network
// and law: what conductance laws are measured against.
//
// Two lattices, one half as fine again as the other, tell how far the finer may be from the limit. With --state a run
// that is killed goes on where it was. `lattice_permeability --help` lists the options.
#include "support/keys.hpp"
#include "support/options.hpp"
#include "support/packing_options.hpp"
#include "support/stopwatch.hpp"
#include "support/wait_files.hpp"

#include "tetrapore/io/csv.hpp"
#include "tetrapore/lbm/permeability.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace tp = tetrapore;

const std::filesystem::path shipped = std::filesystem::path(__FILE__).parent_path() / "data" / "periodic_64.txt";

struct lattice_job : support::packing_job {
  int nodes = 36;
  std::size_t axis = 0;
  tp::lbm::permeability_options how;
  std::string precision = "double";
  std::string state;  // the folder of states, if there is one
};

std::optional<lattice_job> read_job(int argc, char** argv) {
  lattice_job job;
  std::string nodes = "36";
  std::string axis = "x";
  std::string tau = "1";
  std::string steady = "1e-6";
  CLI::App app("Permeability of a periodic packing by lattice Boltzmann.", "lattice_permeability");
  app.add_option("--nodes", nodes, "nodes along the box, in the x direction")->capture_default_str();
  app.add_option("--axis", axis, "the flow is along x, y or z")->capture_default_str();
  app.add_option("--tau", tau, "relaxation time; the result does not depend on it")->capture_default_str();
  app.add_option("--steady", steady, "relative change of the flux at which it is steady")->capture_default_str();
  app.add_option("--precision", job.precision, "float or double")->capture_default_str();
  app.add_option("--state", job.state, "folder for the state of a run: killed, it goes on from there");
  support::packing_options common(app, shipped);
  if (!common.read(argc, argv, job)) {
    return std::nullopt;
  }
  job.nodes = static_cast<int>(support::number_of(
      "--nodes", nodes, [](double x) { return x >= 3 && x <= 1000 && x == std::floor(x) && std::fmod(x, 3) == 0; },
      "a multiple of 3, at most 999"));
  if (axis != "x" && axis != "y" && axis != "z") {
    support::refuse("--axis", axis, "x, y or z");
  }
  job.axis = static_cast<std::size_t>(axis[0] - 'x');
  job.how.tau = support::number_of(
      "--tau", tau, [](double x) { return x > 0.5 && x <= 5; }, "a number above 0.5, at most 5");
  job.how.steady = support::number_of("--steady", steady, support::positive, "a number above 0");
  if (job.precision != "float" && job.precision != "double") {
    support::refuse("--precision", job.precision, "float or double");
  }
  if (app.count("--state") > 0) {
    job.state = support::folder_of("--state", job.state).string();
  }
  return job;
}

// The grains, with the corner of their box at 0.
tp::lbm::periodic_spheres on_lattice(const tp::packing& packing) {
  for (const bool periodic : packing.periodic) {
    if (!periodic) {
      throw tp::parameter_error("--periodic", "an axis along which the box does not repeat", "xyz");
    }
  }
  tp::lbm::periodic_spheres p;
  for (std::size_t a = 0; a < 3; ++a) {
    p.box[a] = packing.bounds->hi[a] - packing.bounds->lo[a];
  }
  for (const auto& g : packing.grains) {
    p.spheres.push_back({g.centre - packing.bounds->lo, g.radius});
  }
  return p;
}

tp::lbm::lattice_permeability measured(const tp::lbm::periodic_spheres& p, int nodes, const lattice_job& job) {
  const auto answer = job.precision == "float"
                          ? tp::lbm::measure_permeability<tp::lbm::d3q19, float>(p, nodes, job.axis, job.how)
                          : tp::lbm::measure_permeability<tp::lbm::d3q19, double>(p, nodes, job.axis, job.how);
  if (!answer.ok()) {
    throw std::runtime_error(std::to_string(nodes) + " nodes: " + describe(answer.reason));
  }
  return answer.value;
}

void run(lattice_job job) {
  const tp::packing packing = support::read_grains(job);
  const tp::lbm::periodic_spheres p = on_lattice(packing);
  double radius = 0;
  for (const auto& g : p.spheres) {
    radius += g.radius / static_cast<double>(p.spheres.size());
  }
  std::optional<support::wait_files> kept;
  if (!job.state.empty()) {
    job.how.kept = &kept.emplace(job.state);
  }
  support::stopwatch watch;
  const auto coarse = measured(p, job.nodes / 3 * 2, job);
  const auto fine = measured(p, job.nodes, job);
  const double seconds = watch.lap();

  std::filesystem::create_directories(job.out);
  tp::io::csv_writer file(job.out / "lattices.csv", {"nodes", "fluid nodes", "porosity", "permeability [m2]", "steps"});
  for (const auto& [nodes, k] : {std::pair(job.nodes / 3 * 2, coarse), std::pair(job.nodes, fine)}) {
    file.row(nodes, k.fluid_nodes, k.porosity, k.permeability, k.steps);
  }
  file.commit();

  const auto limit = tp::lbm::extrapolated(coarse, fine);
  std::size_t updates = 0;  // in these seconds
  for (const auto& k : {coarse, fine}) {
    updates += k.fluid_nodes * (k.steps - k.taken_up);
  }
  const support::key_printer print;
  print("grains", packing.grains.size());
  print("nodes", static_cast<std::size_t>(job.nodes));
  print("nodes_per_radius", radius / p.box[0] * job.nodes);
  print("fluid_nodes", fine.fluid_nodes);
  print("porosity", fine.porosity);
  print("half_way_share", static_cast<double>(fine.half_way_links) / static_cast<double>(fine.wall_links));
  print("permeability_coarse", coarse.permeability);
  print("permeability", fine.permeability);
  print("permeability_over_r2", fine.permeability / (radius * radius));
  print("permeability_extrapolated", limit.permeability);
  print("discretisation_estimate", limit.discretisation);
  print("steps", coarse.steps + fine.steps);
  print("mlups", static_cast<double>(updates) / seconds * 1e-6);
  print("seconds", seconds);
}

int main(int argc, char** argv) {
  try {
    if (const auto job = read_job(argc, argv)) {
      run(*job);
    }
    return 0;
  } catch (const tp::io::output_error& e) {
    std::fprintf(stderr, "lattice_permeability: %s\n", e.what());
    return 1;
  } catch (const tp::setup_error& e) {  // the command line, the packing or a state
    std::fprintf(stderr, "lattice_permeability: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "lattice_permeability: %s\n", e.what());
    return 1;
  }
}
