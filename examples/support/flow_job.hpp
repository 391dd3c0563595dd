// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/options.hpp"
#include "support/packing_options.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

/// \file
/// What saturated_flow is asked on its command line.

namespace support {

struct flow_job : packing_job {
  double viscosity = 1e-3;  ///< [Pa s]
  tetrapore::face inlet = tetrapore::face::y_min;
  tetrapore::face outlet = tetrapore::face::y_max;
  double pressure_drop = 1;  ///< [Pa] from inlet to outlet, or along one period
  bool slip = true;          ///< walls take no shear
  std::string law = "hydraulic_radius";
  std::optional<std::size_t> gradient;  ///< periodic axis along which a mean gradient drives the flow
  std::string solver = "multigrid";
};

/// Reads the command line; empty when only help was asked for, which is then printed.
/// \throw tetrapore::parameter_error  names the option, what it was given and what it takes
[[nodiscard]] inline std::optional<flow_job> read_flow_job(int argc, char** argv,
                                                           const std::filesystem::path& shipped) {
  flow_job job;
  std::string viscosity = "1e-3";
  std::string inlet = "y_min";
  std::string outlet = "y_max";
  std::string drop = "1";
  std::string gradient;
  bool slip = false;
  bool no_slip = false;

  CLI::App app("One-phase flow through a packing of spheres: its permeability, and the drag on each grain.",
               "saturated_flow");
  app.add_option("--viscosity", viscosity, "viscosity [Pa s]")->capture_default_str();
  app.add_option("--inlet", inlet, "face of the higher pressure: x_min ... z_max")->capture_default_str();
  app.add_option("--outlet", outlet, "face of pressure 0")->capture_default_str();
  app.add_option("--pressure-drop", drop, "from inlet to outlet, or along one period [Pa]")->capture_default_str();
  auto* slips = app.add_flag("--slip", slip, "walls take no shear (default)");
  app.add_flag("--no-slip", no_slip, "the fluid sticks to walls")->excludes(slips);
  app.add_option("--law", job.law, "conductance of a throat: hydraulic_radius, mean_radius or calibrated")
      ->capture_default_str();
  app.add_option("--gradient", gradient, "periodic axis along which a mean gradient drives the flow, x, y or z");
  app.add_option("--solver", job.solver, "multigrid, ldlt, cg or cholmod")->capture_default_str();
  packing_options common(app, shipped);
  if (!common.read(argc, argv, job)) {
    return std::nullopt;
  }

  job.viscosity = number_of("--viscosity", viscosity, positive, "a number above 0 [Pa s]");
  job.inlet = face_of("--inlet", inlet);
  job.outlet = face_of("--outlet", outlet);
  if (job.inlet == job.outlet) {
    refuse("--outlet", outlet, "another face than the inlet");
  }
  job.pressure_drop = number_of("--pressure-drop", drop, positive, "a number above 0 [Pa]");
  job.slip = !no_slip;
  job.law = choice_of("--law", job.law, {"hydraulic_radius", "mean_radius", "calibrated"});
  job.solver = choice_of("--solver", job.solver, {"multigrid", "ldlt", "cg", "cholmod"});
  if (app.count("--gradient") > 0) {
    job.gradient = static_cast<std::size_t>(choice_of("--gradient", gradient, {"x", "y", "z"})[0] - 'x');
  }
  return job;
}

}  // namespace support
