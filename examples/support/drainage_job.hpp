// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/options.hpp"
#include "support/packing_options.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

/// \file
/// What primary_drainage is asked on its command line.

namespace support {

struct drainage_job : packing_job {
  double surface_tension = 0.072;  ///< [N/m]
  double contact_angle = 0;        ///< [degrees]
  std::string entry = "msp";
  std::string gap_limited = "lost_arc";
  tetrapore::face inlet = tetrapore::face::y_max;
  tetrapore::face outlet = tetrapore::face::y_min;
  bool trapping = true;
  std::optional<double> density;  ///< difference of the two fluids [kg/m³]
};

/// Reads the command line; empty when only help was asked for, which is then printed.
/// \throw tetrapore::parameter_error  names the option, what it was given and what it takes
[[nodiscard]] inline std::optional<drainage_job> read_drainage_job(int argc, char** argv,
                                                                   const std::filesystem::path& shipped) {
  drainage_job job;
  std::string tension = "0.072";
  std::string angle = "0";
  std::string inlet = "y_max";
  std::string outlet = "y_min";
  std::string density;
  bool no_walls = false;
  bool no_trapping = false;

  CLI::App app("Primary drainage of a packing of spheres: its retention curve, pictures and history.",
               "primary_drainage");
  app.add_option("--surface-tension", tension, "surface tension [N/m]")->capture_default_str();
  app.add_option("--contact-angle", angle, "contact angle [degrees], 0 to below 90")->capture_default_str();
  app.add_option("--entry", job.entry, "entry law: msp (Mayer-Stowe-Princen) or inscribed (circle)")
      ->capture_default_str();
  app.add_option("--gap-limited", job.gap_limited,
                 "a throat whose widest gap holds no meniscus: lost_arc, merged or refused")
      ->capture_default_str();
  app.add_option("--inlet", inlet, "face by which gas enters: x_min ... z_max")->capture_default_str();
  app.add_option("--outlet", outlet, "face by which liquid leaves")->capture_default_str();
  app.add_flag("--no-walls", no_walls, "open faces instead of walls: the hull of the grain centres");
  app.add_flag("--no-trapping", no_trapping, "liquid that is cut off drains all the same");
  app.add_option("--density", density, "density difference of the fluids [kg/m3]: gives the Bond number");
  packing_options common(app, shipped);
  if (!common.read(argc, argv, job)) {
    return std::nullopt;
  }

  job.surface_tension = number_of("--surface-tension", tension, positive, "a number above 0 [N/m]");
  job.contact_angle = number_of(
      "--contact-angle", angle, [](double x) { return x >= 0 && x < 90; }, "a number from 0 to below 90 [degrees]");
  job.entry = choice_of("--entry", job.entry, {"msp", "inscribed"});
  job.gap_limited = choice_of("--gap-limited", job.gap_limited, {"lost_arc", "merged", "refused"});
  job.inlet = face_of("--inlet", inlet);
  job.outlet = face_of("--outlet", outlet);
  if (job.inlet == job.outlet) {
    refuse("--outlet", outlet, "another face than the inlet");
  }
  job.walls = !no_walls;
  job.trapping = !no_trapping;
  if (app.count("--density") > 0) {
    job.density = number_of(
        "--density", density, [](double x) { return x >= 0; }, "a number, not negative [kg/m3]");
  }
  return job;
}

}  // namespace support
