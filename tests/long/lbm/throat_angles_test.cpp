// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign: entry pressures above contact angle 0 against Surface Evolver, on what their correction was calibrated on
// and on the rest (docs/campaigns/throat_angles.json).
#include "support/lattice_throats.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace lattice_throats;

namespace {

/// tests/truth/se_results.csv: curvature × R at the entry between three equal spheres with mirrors.
struct spheres {
  double degrees;
  double gap;  ///< over R
  double curvature;
  bool calibrating;
};
constexpr spheres throats[] = {{40, 0, 9.42, true},     {40, 0.4, 2.766, true},   {40, 0.2, 4.746, false},
                               {40, 0.05, 7.89, false}, {10, 0.2, 5.765, false},  {20, 0, 10.9, false},
                               {20, 0.2, 5.563, false}, {20, 0.4, 3.2335, false}, {60, 0, 7.28, false},
                               {60, 0.05, 6.14, false}, {60, 0.2, 3.478, false}};

std::string number(double x) {
  if (!std::isfinite(x)) {
    return "null";
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

std::string row_of(const spheres& t, double inscribed) {
  constexpr double width = 0.025;
  entry_set_up s = equal_spheres(t.gap, inscribed);
  s.contact_angle = t.degrees * pi<double> / 180;
  s.patience = 5000;
  s.rules.most_steps = 40000;
  entry_experiment<float> e(s);
  threshold_search search(e.bracket(1, width));
  run(e, search);
  const entry_result r = e.result(search);
  CHECK((r.end == search_end::converged) == std::isfinite(r.value));
  if (r.end == search_end::converged) {
    CHECK(std::abs(r.value / t.curvature - 1) <= r.discretisation + width / 2);
  }
  return "{\"degrees\": " + number(t.degrees) + ", \"gap\": " + number(t.gap) +
         ", \"inscribed\": " + number(inscribed) + ", \"calibrating\": " + (t.calibrating ? "true" : "false") +
         ", \"end\": \"" + describe(r.end) + "\", \"last_hold\": \"" + describe(r.last) +
         "\", \"lower\": " + number(r.lower / t.curvature) + ", \"upper\": " + number(r.upper / t.curvature) +
         ", \"value\": " + number(r.value / t.curvature) + ", \"discretisation\": " + number(r.discretisation) +
         ", \"updates\": " + std::to_string(r.updates) + "}";
}

}  // namespace

TEST_CASE("entry pressures above contact angle 0 are within their error of Surface Evolver") {
  const std::filesystem::path folder = TETRAPORE_CAMPAIGN_DIR;
  std::filesystem::create_directories(folder);
  const auto path = folder / "throat_angles.json";
  if (std::filesystem::exists(path)) {
    MESSAGE("there already: " << path.filename().string());
    return;
  }
  std::vector<std::string> rows;
  for (const double inscribed : {2.0, 3.0, 4.0, 5.0, 6.0}) {
    for (const spheres& t : throats) {
      rows.push_back(row_of(t, inscribed));
    }
  }
  const auto part = path.string() + ".part";
  std::ofstream out(part);
  out << "{\n  \"command\": \"tests/run.sh --long long_lbm\",\n  \"unit\": \"the curvature of Surface Evolver\",\n"
      << "  \"rows\": [\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    out << "    " << rows[k] << (k + 1 < rows.size() ? ",\n" : "\n");
  }
  out << "  ]\n}\n";
  out.close();
  std::filesystem::rename(part, path);
}
