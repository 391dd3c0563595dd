// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/number_options.hpp"
#include "support/options.hpp"
#include "tetrapore/lbm/entry_experiment.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// \file
/// What throat_experiment is asked on its command line.

namespace support {

struct throat_job {
  std::array<double, 3> radii{1, 1, 1};
  std::array<double, 3> gaps{0, 0, 0};                ///< between surfaces: of grains 1 and 2, 2 and 3, 3 and 1
  std::array<tetrapore::lbm::prism_side, 3> sides{};  ///< behind the same pairs
  double contact_angle = 0;                           ///< [degrees]
  double resolution = 4;                              ///< nodes per radius of the inscribed circle
  std::optional<double> retraction;                   ///< [nodes]; none: by the contact angle
  double bracket = 0.03;                              ///< width of the last bracket
  std::size_t most_nodes = 1000000;                   ///< fluid nodes that are allowed
  bool rings = true;                                  ///< go on until rings are left, and draw it
  bool in_double = false;
  std::filesystem::path out;
};

/// \throw tetrapore::parameter_error  where no triangle has such sides
[[nodiscard]] inline tetrapore::opening<double> throat_of(const throat_job& job) {
  const auto& r = job.radii;
  const auto& g = job.gaps;
  const auto o = tetrapore::opening_from_distances<double>(r[0], r[1], r[2], r[0] + r[1] + g[0], r[0] + r[2] + g[2],
                                                           r[1] + r[2] + g[1]);
  if (!o.ok()) {
    throw tetrapore::parameter_error("--radii and --gaps", describe(o.reason), "three grains around a throat");
  }
  return o.value;
}

/// The grain of a job that the throat's first disc is, which is the smallest: disc k is grain first + k.
[[nodiscard]] inline std::size_t first_grain(const throat_job& job) noexcept {
  const auto& r = job.radii;
  return static_cast<std::size_t>(std::min_element(r.begin(), r.end()) - r.begin());
}

/// The experiment of a job, its lattice as fine as the resolution asks.
[[nodiscard]] inline tetrapore::lbm::entry_set_up set_up_of(const throat_job& job) {
  tetrapore::lbm::entry_set_up s;
  s.throat = throat_of(job);
  for (std::size_t k = 0; k < 3; ++k) {
    s.sides[k] = job.sides[(first_grain(job) + k) % 3];
  }
  s.contact_angle = job.contact_angle * tetrapore::pi<double> / 180;
  s.retraction = job.retraction;
  s.most_nodes = job.most_nodes;
  s.nodes_per_length = job.resolution / tetrapore::lbm::plane_entry_of(s.throat, s.sides, s.contact_angle).inscribed;
  return s;
}

/// Reads the command line; empty when only help was asked for, which is then printed.
/// \throw tetrapore::parameter_error  names the option, what it was given and what it takes
[[nodiscard]] inline std::optional<throat_job> read_throat_job(int argc, char** argv) {
  throat_job job;
  std::vector<std::string> radii{"1", "1", "1"};
  std::vector<std::string> gaps{"0", "0", "0"};
  std::vector<std::string> sides{"mirror", "mirror", "mirror"};
  std::string precision = "float";
  std::string retraction = "auto";
  std::string out = "throat_experiment_out";

  CLI::App app("Entry pressure of a throat of three grains by a lattice Boltzmann experiment.", "throat_experiment");
  app.add_option("--radii", radii, "radii of the grains, in any unit")->expected(3)->capture_default_str();
  app.add_option("--gaps", gaps, "gaps between surfaces 1-2, 2-3, 3-1, in the unit of the radii")
      ->expected(3)
      ->capture_default_str();
  app.add_option("--sides", sides, "what stands behind gaps 1-2, 2-3, 3-1: mirror, or wetting as a neighbour still wet")
      ->expected(3)
      ->capture_default_str();
  number_options numbers(app);
  numbers.add("--contact-angle", job.contact_angle, acute_angle, "contact angle [degrees]");
  numbers.add("--resolution", job.resolution,
              {"a number from 2 to 40 [nodes]", [](double x) { return x >= 2 && x <= 40; }},
              "nodes per radius of the inscribed circle");
  app.add_option("--retraction", retraction, "nodes by which grains shrink: auto, or a number from 0 to 4")
      ->capture_default_str();
  numbers.add("--bracket", job.bracket, {"a number from 0.001 to 0.5", [](double x) { return x >= 0.001 && x <= 0.5; }},
              "width of the last bracket, relative");
  numbers.add("--most-nodes", job.most_nodes,
              {"a whole number from 1000 to 1e8", [](double x) { return x >= 1000 && x <= 1e8 && x == std::floor(x); }},
              "fluid nodes that are allowed");
  bool no_rings = false;
  app.add_flag("--no-rings", no_rings, "stop at the entry pressure: no rings, no picture");
  app.add_option("--precision", precision, "float or double")->capture_default_str();
  app.add_option("--out", out, "folder for the files; a state in it is taken up")->capture_default_str();
  if (!parsed(app, argc, argv)) {
    return std::nullopt;
  }
  numbers.read();
  for (std::size_t k = 0; k < 3; ++k) {
    job.radii[k] = number_of("--radii", radii[k], above_zero.accepts, above_zero.expected);
    job.gaps[k] = number_of("--gaps", gaps[k], zero_or_more.accepts, zero_or_more.expected);
    job.sides[k] = choice_of("--sides", sides[k], {"mirror", "wetting"}) == "wetting"
                       ? tetrapore::lbm::prism_side::wetting
                       : tetrapore::lbm::prism_side::mirror;
  }
  if (retraction != "auto") {
    job.retraction = number_of(
        "--retraction", retraction, [](double x) { return x >= 0 && x <= 4; }, "auto, or a number from 0 to 4 [nodes]");
  }
  job.rings = !no_rings;
  job.in_double = choice_of("--precision", precision, {"float", "double"}) == "double";
  job.out = folder_of("--out", out);
  return job;
}

}  // namespace support
