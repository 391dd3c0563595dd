// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign: throats at the limits of the lattice, each of which ends with a number or with the name of what is wrong
// (docs/campaigns/throat_diagnoses.json).
#include "support/lattice_throats.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace lattice_throats;

namespace {

std::string number(double x) {
  if (!std::isfinite(x)) {
    return "null";
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

using fluids = mixture<d3q19, bgk>;

/// A hold at `factor` × the pressure expected: from a fifth below on a meniscus should rest, from a fifth above not.
std::string row_of_hold(const char* what, const entry_set_up& s, double factor) {
  std::string row = std::string("{\"") + what + "\": true, \"tau\": " + number(s.tau) +
                    ", \"G\": " + number(s.pair.attraction) + ", \"factor\": " + number(s.pair.factor) +
                    ", \"tension\": " + number(s.pair.surface_tension) + ", \"held\": " + number(factor);
  try {
    entry_experiment<float, fluids, storage::in_place> e(s);
    const double p = factor * e.lattice_pressure(e.plane().best) / e.correction();
    const hold_report r = e.hold(p);
    if (r.end == hold_end::stable) {
      CHECK(factor < 1);
      CHECK(std::isfinite(r.position));
      CHECK(std::abs(r.measured / p - 1) <= s.rules.flow + 0.3 / (e.inscribed() * e.inscribed()));
    }
    if (r.end == hold_end::passed) {
      CHECK(factor > 1);
    }
    row += ", \"end\": \"" + std::string(describe(r.end)) + "\", \"measured\": " + number(r.measured / p);
  } catch (const setup_error& refusal) {
    row += ", \"end\": \"refused\", \"measured\": null";
  }
  return row + "}";
}

std::string row_of_search(double gap, double inscribed, double factor) {
  const entry_set_up s = equal_spheres(gap, inscribed);
  const double best = plane_entry_of(s.throat, s.sides).best;
  const entry_result r = found(s, factor, 0.03);
  CHECK(r.end == search_end::converged);
  CHECK((r.end == search_end::converged) == std::isfinite(r.value));
  if (inscribed <= 2) {
    CHECK(r.film == film_status::unresolved);
  }
  if (inscribed >= 4) {
    CHECK(r.film == film_status::resolved);
  }
  return "{\"search\": true, \"gap\": " + number(gap) + ", \"inscribed\": " + number(inscribed) +
         ", \"start\": " + number(factor) + ", \"end\": \"" + describe(r.end) + "\", \"last_hold\": \"" +
         describe(r.last) + "\"" + ", \"lower\": " + number(r.lower / best) + ", \"upper\": " + number(r.upper / best) +
         ", \"value\": " + number(r.value / best) + ", \"film\": \"" + describe(r.film) +
         "\", \"discretisation\": " + number(r.discretisation) + ", \"holds\": " + std::to_string(r.holds) +
         ", \"updates\": " + std::to_string(r.updates) + "}";
}

}  // namespace

TEST_CASE("throats at the limits of the lattice end with a number or with a name") {
  const std::filesystem::path folder = TETRAPORE_CAMPAIGN_DIR;
  std::filesystem::create_directories(folder);
  const auto path = folder / "throat_diagnoses.json";
  if (std::filesystem::exists(path)) {
    MESSAGE("there already: " << path.filename().string());
    return;
  }
  std::vector<std::string> rows;
  for (const double tau : {0.51, 0.55, 0.6, 0.7, 1.0, 1.5, 2.0}) {
    for (const double strength : {1.1, 1.5, 1.8, 2.4, 3.2}) {  // G ρ over its critical value, halves of it at τ = 1
      entry_set_up s = equal_spheres(0.4, 3);
      s.tau = tau;
      s.pair.factor = 1 / (1 - 1 / (2 * tau));
      s.pair.attraction = 2 * strength / s.pair.factor;
      s.pair.common = (s.pair.factor - 1) / 2;
      rows.push_back(row_of_hold("claimed_pair", s, 0.8));  // the tension of another pair
      if (const auto pair = measure_pair<fluids>(s.pair.attraction, tau); pair.ok()) {
        s.pair = pair.value;
        if (const auto known = calibrated(forcing_kind::velocity_shift, tau, s.pair.attraction); known.ok()) {
          s.pair.surface_tension = surface_tension(known.value, s.pair.main);
        }
        rows.push_back(row_of_hold("measured_pair", s, 0.8));
        rows.push_back(row_of_hold("measured_pair", s, 1.25));
      }
    }
  }
  for (const double factor : {1.5, 1.7, 1.9, 2.1, 2.3, 2.6}) {  // 1.995 is right
    entry_set_up s = equal_spheres(0.4, 4);
    s.pair.factor = factor;
    rows.push_back(row_of_hold("wrong_reservoirs", s, 0.8));
  }
  for (const double gap : {0.0, 0.4}) {
    for (const double inscribed : {2.5, 3.0}) {
      rows.push_back(row_of_search(gap, inscribed, 1));
    }
    for (const double inscribed : {2.0, 4.0}) {
      for (const double factor : {0.7, 1.0, 1.3}) {
        rows.push_back(row_of_search(gap, inscribed, factor));
      }
    }
  }
  const auto part = path.string() + ".part";
  std::ofstream out(part);
  out << "{\n  \"command\": \"tests/run.sh --long long_lbm\",\n  \"rows\": [\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    out << "    " << rows[k] << (k + 1 < rows.size() ? ",\n" : "\n");
  }
  out << "  ]\n}\n";
  out.close();
  std::filesystem::rename(part, path);
}
