// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign of the lattice's permeability: simple cubic spheres and the random packing of 64 equal spheres, on finer and
// finer lattices, extrapolated to the limit (docs/campaigns/lattice_permeability_<case>.json). A case that has its file
// is not run again; each lattice that is done is kept beside it.
#include "support/shared_data.hpp"
#include "tetrapore/lbm/permeability.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

struct placed {  // one lattice: nodes along the box, where the spheres lie on it, what came out
  int nodes;
  double offset;  ///< of the spheres along x [nodes]
  double permeability;
};

/// Least squares of k = limit (1 + slope / n); also the standard error of the limit.
struct fitted {
  double limit, slope, error;
};

fitted fit(const std::vector<placed>& all) {
  const auto count = static_cast<double>(all.size());
  double x_mean = 0;
  double k_mean = 0;
  for (const placed& p : all) {
    x_mean += 1.0 / p.nodes / count;
    k_mean += p.permeability / count;
  }
  double xx = 0;
  double xk = 0;
  for (const placed& p : all) {
    const double x = 1.0 / p.nodes - x_mean;
    xx += x * x;
    xk += x * (p.permeability - k_mean);
  }
  const double slope = xk / xx;
  const double limit = k_mean - slope * x_mean;
  double squares = 0;
  for (const placed& p : all) {
    const double off = p.permeability - limit - slope / p.nodes;
    squares += off * off;
  }
  return {limit, slope / limit, std::sqrt(squares / (count - 2) * (1 / count + x_mean * x_mean / xx))};
}

/// Runs what is missing of a case and writes its file. \param within  of the reference, that the limit has to be
void campaign(const std::string& name, const periodic_spheres& spheres,
              const std::vector<std::pair<int, double>>& lattices, double reference, double within) {
  const std::filesystem::path folder = TETRAPORE_CAMPAIGN_DIR;
  std::filesystem::create_directories(folder);
  const auto path = folder / ("lattice_permeability_" + name + ".json");
  const auto kept = folder / ("lattice_permeability_" + name + ".progress");
  if (std::filesystem::exists(path)) {
    MESSAGE("there already: " << path.filename().string());
    return;
  }
  std::vector<placed> done;
  std::ifstream before(kept);
  for (placed p{}; before >> p.nodes >> p.offset >> p.permeability;) {
    done.push_back(p);
  }
  for (std::size_t k = done.size(); k < lattices.size(); ++k) {
    const auto [nodes, offset] = lattices[k];
    periodic_spheres moved = spheres;
    for (auto& s : moved.spheres) {
      s.centre.x += offset * spheres.box[0] / nodes;
    }
    const auto answer = measure_permeability(moved, nodes, 0);
    REQUIRE(answer.ok());
    done.push_back({nodes, offset, answer.value.permeability});
    std::ofstream(kept, std::ios::app) << std::setprecision(12) << nodes << ' ' << offset << ' '
                                       << answer.value.permeability << '\n';
  }
  const fitted f = fit(done);
  CHECK(std::abs(f.limit / reference - 1) < within);
  CHECK(f.error < within * reference);  // or the agreement would be luck
  std::ostringstream rows;
  for (const placed& p : done) {
    rows << (p.nodes == done.front().nodes && p.offset == done.front().offset ? "" : ",") << "\n    [" << p.nodes
         << ", " << p.offset << ", " << p.permeability << ", " << p.permeability / reference - 1 << "]";
  }
  std::ofstream(path) << "{\n  \"command\": \"tests/run.sh --long long_lbm\",\n  \"reference\": " << reference
                      << ",\n  \"limit\": " << f.limit << ",\n  \"limit_error\": " << f.limit / reference - 1
                      << ",\n  \"standard_error\": " << f.error / reference << ",\n  \"first_order\": " << f.slope
                      << ",\n  \"nodes, offset, permeability, error\": [" << rows.str() << "\n  ]\n}\n";
  std::filesystem::remove(kept);
  MESSAGE(name << ": limit " << f.limit / reference - 1 << " ± " << f.error / reference);
}

}  // namespace

TEST_CASE("simple cubic spheres, extrapolated, have the permeability of Zick and Homsy within 1 %") {
  std::vector<std::pair<int, double>> lattices;
  for (const int nodes : {40, 44, 48, 52, 56, 60, 64, 72, 80}) {
    lattices.insert(lattices.end(), {{nodes, 0.0}, {nodes, 0.3}});
  }
  for (const auto& [name, fraction, drag] :
       {std::tuple{"343", 0.343, 15.4}, std::tuple{"450", 0.45, 28.1}, std::tuple{"524", 0.5236, 42.1}}) {
    const double radius = std::cbrt(3 * fraction / (4 * std::numbers::pi));
    campaign(name, {{1, 1, 1}, {{{0, 0, 0}, radius}}, {false, true, true}}, lattices,
             1 / (6 * std::numbers::pi * radius * drag), 0.01);
  }
}

TEST_CASE(
    "64 random spheres of solid fraction 0.6, extrapolated, have the permeability of another lattice within 1.5 %") {
  const auto file = shared_file("data/truth/stokes_random/open_packing.txt");
  if (!file) {
    return;
  }
  periodic_spheres p{{1, 1, 1}, {}, {}};
  std::ifstream in(*file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    sphere<double> s{};
    if (line[0] != '#' && words >> s.centre.x >> s.centre.y >> s.centre.z >> s.radius) {
      p.spheres.push_back(s);
    }
  }
  REQUIRE(p.spheres.size() == 64);
  campaign("random", p, {{48, 0.0}, {54, 0.0}, {60, 0.0}, {66, 0.0}, {72, 0.0}, {84, 0.0}, {96, 0.0}}, 7.33e-5, 0.015);
}
