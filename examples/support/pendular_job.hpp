// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/packing_options.hpp"
#include "support/pendular.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// \file
/// What pendular_packing is asked on its command line.

namespace support {

struct pendular_job : packing_job {
  double surface_tension = 0.072;  ///< [N/m]
  double contact_angle = 0;        ///< [degrees]
  std::string law = "exact";
  control held = control::suction;
  std::vector<double> steps;  ///< rising suctions [Pa], or falling volumes of a bridge [m³]: from wet to dry
};

/// A law for the job's material.
[[nodiscard]] inline bridge_law_of_the_job law_of(const pendular_job& job, const std::string& name) {
  return bridge_law_named(name, job.surface_tension, job.contact_angle * tp::pi<double> / 180);
}

/// The pairs of the job. Tables answer for no pair before they are made: the exact law speaks for them.
[[nodiscard]] inline pendular_scene make_scene(tp::packing packing, const pendular_job& job) {
  const bridge_law_of_the_job law = law_of(job, job.law == "table" ? "exact" : job.law);
  return make_scene(std::move(packing), law, job.held, job.steps.front());
}

/// The tables of a job with the law `table`.
[[nodiscard]] inline bridge_tables make_tables(const pendular_scene& scene, const pendular_job& job) {
  return {std::get<tp::young_laplace<>>(law_of(job, "exact")), scene.pairs, job.steps.back(), job.steps.front()};
}

/// The numbers of "a:b:n": n of them from a to b, each the same multiple of the one before; or of "a".
[[nodiscard]] inline std::vector<double> sweep_of(const std::string& option, const std::string& text,
                                                  const std::string& unit) {
  const std::string expected = "a number above 0 " + unit + ", or a:b:n, n from 2 to 10000 of them from a up to b";
  const auto number = [&](const std::string& part) { return number_of(option, part, positive, expected); };
  const std::size_t first = text.find(':');
  if (first == std::string::npos) {
    return {number(text)};
  }
  const std::size_t second = text.find(':', first + 1);
  if (second == std::string::npos || text.find(':', second + 1) != std::string::npos) {
    refuse(option, text, expected);
  }
  const double a = number(text.substr(0, first));
  const double b = number(text.substr(first + 1, second - first - 1));
  const double n = number(text.substr(second + 1));
  if (!(a < b) || !(n >= 2 && n <= 10000) || n != std::floor(n)) {
    refuse(option, text, expected);
  }
  std::vector<double> steps;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    steps.push_back(a * std::pow(b / a, static_cast<double>(i) / (n - 1)));
  }
  steps.back() = b;
  return steps;
}

/// Reads the command line; empty when only help was asked for, which is then printed.
/// \throw tetrapore::parameter_error  names the option, what it was given and what it takes
[[nodiscard]] inline std::optional<pendular_job> read_pendular_job(int argc, char** argv,
                                                                   const std::filesystem::path& shipped) {
  pendular_job job;
  std::string tension = "0.072";
  std::string angle = "0";
  std::string suction;
  std::string volume;

  CLI::App app("Pendular bridges on all close pairs of a packing: liquid content, capillary stress, strength.",
               "pendular_packing");
  app.add_option("--surface-tension", tension, "surface tension [N/m]")->capture_default_str();
  app.add_option("--contact-angle", angle, "contact angle [degrees], 0 to below 90")->capture_default_str();
  app.add_option("--suction", suction, "suction of all bridges [Pa]; a:b:n rises from a to b in n equal ratios");
  app.add_option("--volume", volume, "volume of every bridge [m3]; a:b:n takes n volumes, in equal ratios");
  app.add_option("--law", job.law, "law of a bridge: " + bridge_law_names())->capture_default_str();
  packing_options common(app, shipped);
  if (!common.read(argc, argv, job)) {
    return std::nullopt;
  }

  job.surface_tension = number_of("--surface-tension", tension, positive, "a number above 0 [N/m]");
  job.contact_angle = number_of(
      "--contact-angle", angle, [](double x) { return x >= 0 && x < 90; }, "a number from 0 to below 90 [degrees]");
  const bool by_suction = app.count("--suction") > 0;
  const bool by_volume = app.count("--volume") > 0;
  if (by_suction == by_volume) {
    throw tp::parameter_error("--suction and --volume", by_suction ? "both" : "neither", "exactly one of the two");
  }
  job.held = by_suction ? control::suction : control::volume;
  job.steps = by_suction ? sweep_of("--suction", suction, "[Pa]") : sweep_of("--volume", volume, "[m3]");
  if (by_volume) {
    std::reverse(job.steps.begin(), job.steps.end());
  }
  check_bridge_law(job.law, by_suction, job.contact_angle);
  return job;
}

}  // namespace support
