// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign of the lattice's permeability: simple cubic spheres and the random packing of 64 equal spheres, on finer and
// finer lattices, extrapolated to the limit (docs/campaigns/lattice_permeability_<case>.json). A case that has its file
// is not run again; each lattice that is done is kept beside it.
#include "support/shared_data.hpp"
#include "tetrapore/lbm/permeability.hpp"

#include <doctest/doctest.h>

#include <array>
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

/// Least squares of k = limit (1 + a/n + b/n²); also the standard error of the limit.
struct fitted {
  double limit, slope, bend, error;
};

fitted fit(const std::vector<placed>& all) {
  constexpr std::size_t m = 3;
  std::array<std::array<double, 2 * m>, m> a{};  // the normal equations, and beside them what becomes their inverse
  std::array<double, m> b{};
  const auto row = [](const placed& p) { return std::array{1.0, 1.0 / p.nodes, 1.0 / (1.0 * p.nodes * p.nodes)}; };
  for (const placed& p : all) {
    const auto x = row(p);
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t j = 0; j < m; ++j) {
        a[i][j] += x[i] * x[j];
      }
      b[i] += x[i] * p.permeability;
    }
  }
  for (std::size_t i = 0; i < m; ++i) {
    a[i][m + i] = 1;
  }
  for (std::size_t k = 0; k < m; ++k) {  // Gauss-Jordan: the matrix is positive definite
    const double pivot = a[k][k];
    for (double& v : a[k]) {
      v /= pivot;
    }
    for (std::size_t i = 0; i < m; ++i) {
      const double share = i == k ? 0 : a[i][k];
      for (std::size_t j = 0; j < 2 * m; ++j) {
        a[i][j] -= share * a[k][j];
      }
    }
  }
  std::array<double, m> c{};
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      c[i] += a[i][m + j] * b[j];
    }
  }
  double squares = 0;
  for (const placed& p : all) {
    const auto x = row(p);
    const double off = p.permeability - c[0] * x[0] - c[1] * x[1] - c[2] * x[2];
    squares += off * off;
  }
  const double variance = squares / static_cast<double>(all.size() - m);
  return {c[0], c[1] / c[0], c[2] / c[0], std::sqrt(variance * a[0][m])};
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
                      << ",\n  \"second_order\": " << f.bend << ",\n  \"nodes, offset, permeability, error\": ["
                      << rows.str() << "\n  ]\n}\n";
  std::filesystem::remove(kept);
  MESSAGE(name << ": limit " << f.limit / reference - 1 << " ± " << f.error / reference);
}

}  // namespace

TEST_CASE("simple cubic spheres, extrapolated, have the permeability of Zick and Homsy within 1 %") {
  std::vector<std::pair<int, double>> lattices;
  for (const int nodes : {32, 36, 40, 44, 48, 52, 56, 60, 64, 72, 80}) {
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
  campaign("random", p,
           {{36, 0.0}, {42, 0.0}, {48, 0.0}, {54, 0.0}, {60, 0.0}, {66, 0.0}, {72, 0.0}, {84, 0.0}, {96, 0.0}}, 7.33e-5,
           0.015);
}
