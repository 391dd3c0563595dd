// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud.hpp"
#include "collision.hpp"
#include "number_options.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

/// \file
/// What wet_collision is asked on its command line.

namespace support {

struct collision_job {
  wet_material material;
  encounter pair;
  std::size_t points = 32;  ///< of the sweep; 0: none
  double sweep_to = 100;    ///< highest Stokes number
  cloud_options cloud;
  std::filesystem::path out = "wet_collision_out";
};

inline constexpr number_range many_steps{"a whole number from 20 to 1000000",
                                         [](double x) { return x >= 20 && x <= 1e6 && x == std::floor(x); }};
inline constexpr number_range few_points{"a whole number from 0 to 1000",
                                         [](double x) { return x >= 0 && x <= 1000 && x == std::floor(x); }};
inline constexpr number_range few_grains{"0, or a whole number from 2 to 10000", [](double x) {
                                           return x == 0 || (x >= 2 && x <= 10000 && x == std::floor(x));
                                         }};
inline constexpr number_range any_seed{"a whole number from 0 to 1e9",
                                       [](double x) { return x >= 0 && x <= 1e9 && x == std::floor(x); }};
inline constexpr number_range loose{"a number above 0, at most 0.2", [](double x) { return x > 0 && x <= 0.2; }};

/// Reads the command line; empty when only help was asked for, which is then printed.
/// \throw tetrapore::parameter_error  names the option, what it was given and what it takes
[[nodiscard]] inline std::optional<collision_job> read_collision_job(int argc, char** argv) {
  collision_job job;
  wet_material& m = job.material;
  double angle = 0;
  double obliquity = 0;
  double creation = m.creation_gap;
  std::string law = "leading";
  std::string out = job.out.string();

  CLI::App app("Wet grains that collide: film, contact, bridge, rebound; two of them, and a cloud.", "wet_collision");
  number_options numbers(app);
  numbers.add("--radius", job.pair.radius1, above_zero, "of the first grain, and of half of the cloud [m]");
  double radius2 = 0;
  numbers.add("--radius2", radius2, zero_or_more, "of the second grain, and of the other half [m]; 0: the same");
  numbers.add("--density", m.density, above_zero, "of the grains [kg/m3]");
  numbers.add("--velocity", job.pair.speed, above_zero, "of approach; mean speed in the cloud [m/s]");
  numbers.add("--obliquity", obliquity, acute_angle, "of the approach to the line of centres [degrees]");
  numbers.add("--viscosity", m.viscosity, zero_or_more, "of the liquid [Pa s]; 0: no film");
  numbers.add("--film", m.film, above_zero, "gap below which the film acts [m]");
  app.add_option("--film-law", law, "leading or accurate")->capture_default_str();
  numbers.add("--roughness", m.roughness, above_zero, "height of the asperities [m], below --film");
  numbers.add("--surface-tension", m.surface_tension, above_zero, "[N/m]");
  numbers.add("--contact-angle", angle, acute_angle, "[degrees]");
  numbers.add("--volume", m.bridge_volume, zero_or_more, "of a new bridge [m3]; 0: none");
  numbers.add("--creation-gap", creation, zero_or_more, "gap at which a bridge forms [m]; 0: at contact");
  numbers.add("--stiffness", m.stiffness, above_zero, "of a contact [N/m]; 0.8 of it in shear");
  numbers.add("--asperity-stiffness", m.asperity_stiffness, above_zero, "[N/m]");
  numbers.add("--friction", m.friction, zero_or_more, "coefficient of Coulomb");
  numbers.add("--steps-per-contact", job.pair.steps, many_steps,
              "time steps in half a period of a contact, two grains");
  numbers.add("--points", job.points, few_points, "of the sweep over Stokes numbers; 0: none");
  numbers.add("--sweep-to", job.sweep_to, above_zero, "highest Stokes number of the sweep");
  numbers.add("--grains", job.cloud.grains, few_grains, "of the cloud; 0: none");
  numbers.add("--solid", job.cloud.solid, loose, "share of the box that they fill");
  numbers.add("--wetness", job.cloud.wetness, zero_or_more, "bridges for which a grain of the cloud has liquid");
  numbers.add("--gravity", job.cloud.gravity, zero_or_more, "in the box of the cloud [m/s2]");
  numbers.add("--time", job.cloud.time, above_zero, "that the cloud is followed [s]");
  numbers.add("--cloud-steps", job.cloud.steps, many_steps, "time steps in half a period of a contact, cloud");
  numbers.add("--seed", job.cloud.seed, any_seed, "of the cloud");
  app.add_option("--out", out, "folder for the files")->capture_default_str();
  if (!parsed(app, argc, argv)) {
    return std::nullopt;
  }
  numbers.read();

  job.pair.radius2 = radius2 > 0 ? radius2 : job.pair.radius1;
  job.pair.obliquity = obliquity * tp::pi<double> / 180;
  m.contact_angle = angle * tp::pi<double> / 180;
  m.shear_stiffness = 0.8 * m.stiffness;
  m.accurate_film = choice_of("--film-law", law, {"leading", "accurate"}) == "accurate";
  m.creation_gap = creation;
  job.pair.liquid = 0.5 * m.bridge_volume;
  job.out = folder_of("--out", out);
  const double small = std::min(job.pair.radius1, job.pair.radius2);
  const double large = std::max(job.pair.radius1, job.pair.radius2);
  const auto below = [](const char* name, double value, double limit, const char* of) {
    if (!(value < limit)) {
      refuse(name, tp::short_number(value), "below " + tp::short_number(limit) + ", " + of);
    }
  };
  below("--roughness", m.roughness, m.film, "the thickness of the film");
  below("--film", m.film, small, "the smaller radius");
  below("--creation-gap", m.creation_gap, small, "the smaller radius");
  below("--volume", m.bridge_volume, small * small * small, "the cube of the smaller radius");
  if (m.accurate_film && large > 10 * small) {
    refuse("--radius2", tp::short_number(radius2), "at most a ratio of 10 with --film-law accurate");
  }
  const double overlap = job.pair.speed * m.contact_time(0.5 * m.mass(large)) / tp::pi<double>;  // of two dry grains
  below("--velocity", job.pair.speed, 0.2 * small / overlap * job.pair.speed, "or the contacts are too soft for it");
  const double dt = m.contact_time(reduced_mass(m, job.pair)) / job.pair.steps;
  if (!(reach_of(m) / (job.pair.speed * std::cos(job.pair.obliquity) * dt) < 1e6)) {
    refuse("--velocity", tp::short_number(job.pair.speed), "a faster approach, or fewer --steps-per-contact");
  }
  if (!(cloud_steps(m, job.cloud, small) < 1e7)) {
    refuse("--time", tp::short_number(job.cloud.time), "at most 1e7 steps of the cloud");
  }
  // The film's resistance to rolling is the one force that a step takes from its beginning.
  const double longest = std::max(dt, job.cloud.grains > 0 ? job.cloud.time / cloud_steps(m, job.cloud, small) : 0);
  const double inertia = 0.4 * m.mass(small) * small * small;
  if (m.viscosity > 0 &&
      !(2 * film_of(m).resistance(tp::edge<double>{small, large, m.roughness, {0, 0, 1}}).value.roll * longest <
        inertia)) {
    refuse("--viscosity", tp::short_number(m.viscosity), "a thinner liquid, or more steps per contact");
  }
  return job;
}

}  // namespace support
