// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign of the lattice's permeability: simple cubic spheres and a random packing of 64 equal spheres on finer and
// finer lattices, extrapolated to the limit (docs/campaigns/lattice_permeability_<name>.json). A packing that has its
// file is not run again, its numbers are checked again; each lattice that is done is kept beside it.
#include "support/campaign.hpp"
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

struct measured {
  int nodes;      ///< along the box
  double offset;  ///< of the spheres along x [nodes]
  double permeability;
};

/// Least squares of k = limit + slope / n^order; also the standard error of the limit.
struct fitted {
  double limit, error;
};

fitted fit(const std::vector<measured>& all, double order) {
  const auto count = static_cast<double>(all.size());
  const auto abscissa = [&](const measured& m) { return std::pow(m.nodes, -order); };
  double x_mean = 0;
  double k_mean = 0;
  for (const measured& m : all) {
    x_mean += abscissa(m) / count;
    k_mean += m.permeability / count;
  }
  double xx = 0;
  double xk = 0;
  for (const measured& m : all) {
    const double x = abscissa(m) - x_mean;
    xx += x * x;
    xk += x * (m.permeability - k_mean);
  }
  const double slope = xk / xx;
  const double limit = k_mean - slope * x_mean;
  double squares = 0;
  for (const measured& m : all) {
    const double off = m.permeability - limit - slope * abscissa(m);
    squares += off * off;
  }
  return {limit, std::sqrt(squares / (count - 2) * (1 / count + x_mean * x_mean / xx))};
}

/// Runs what is missing of a packing and writes its file.
/// \param order   of the error that is left in the width of a node
/// \param within  of the reference, relative, that the limit has to be
void campaign(const std::string& name, const periodic_spheres& spheres,
              const std::vector<std::pair<int, double>>& lattices, double order, double reference, double within) {
  const auto path = campaigns::file_of("lattice_permeability_" + name);
  const auto kept = path.parent_path() / ("lattice_permeability_" + name + ".progress");
  const bool finished = std::filesystem::exists(path);
  std::vector<measured> done;
  if (finished) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      if (const auto of = campaigns::numbers_of(line); of.numbers.size() == 4) {
        done.push_back({static_cast<int>(of.numbers[0]), of.numbers[1], of.numbers[2]});
      }
    }
    REQUIRE(done.size() == lattices.size());
    for (std::size_t k = 0; k < done.size(); ++k) {
      CHECK(std::pair(done[k].nodes, done[k].offset) == lattices[k]);
    }
  } else {
    std::ifstream before(kept);
    for (measured m{}; before >> m.nodes >> m.offset >> m.permeability;) {
      done.push_back(m);
    }
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
  const fitted f = fit(done, order);
  CHECK(std::abs(f.limit / reference - 1) < within);
  CHECK(f.error < within * reference);  // or the agreement would be luck
  if (finished) {
    return;
  }
  std::ostringstream rows;
  for (const measured& m : done) {
    rows << (rows.str().empty() ? "" : ",") << "\n    [" << m.nodes << ", " << m.offset << ", " << m.permeability
         << ", " << m.permeability / reference - 1 << "]";
  }
  std::ofstream(path) << "{\n  \"command\": \"tests/run.sh --long long_lbm\",\n  \"reference\": " << reference
                      << ",\n  \"limit\": " << f.limit << ",\n  \"limit_error\": " << f.limit / reference - 1
                      << ",\n  \"standard_error\": " << f.error / reference << ",\n  \"order\": " << order
                      << ",\n  \"nodes, offset, permeability, error\": [" << rows.str() << "\n  ]\n}\n";
  std::filesystem::remove(kept);
  MESSAGE(name << ": limit " << f.limit / reference - 1 << " ± " << f.error / reference);
}

}  // namespace

TEST_CASE("simple cubic spheres, extrapolated, have the permeability of Zick and Homsy within 1 %") {
  std::vector<std::pair<int, double>> lattices;
  for (const int nodes : {40, 48, 56, 64, 80}) {
    lattices.insert(lattices.end(), {{nodes, 0.0}, {nodes, 0.3}});
  }
  for (const auto& [name, fraction, drag] :
       {std::tuple{"simple_cubic_343", 0.343, 15.4}, std::tuple{"simple_cubic_450", 0.45, 28.1},
        std::tuple{"simple_cubic_524", 0.5236, 42.1}}) {
    const double radius = std::cbrt(3 * fraction / (4 * std::numbers::pi));
    campaign(name, {{1, 1, 1}, {{{0, 0, 0}, radius}}, {false, true, true}}, lattices, 2,
             1 / (6 * std::numbers::pi * radius * drag), 0.01);
  }
}

TEST_CASE(
    "64 random spheres of solid fraction 0.6, extrapolated, have the permeability of the reference within 1.5 %") {
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
  // links that are cut on both sides of their node leave an error of the first order
  campaign("random", p, {{72, 0}, {72, 0.4}, {84, 0}, {96, 0}, {96, 0.4}, {108, 0}, {120, 0}}, 1, 7.33e-5, 0.015);
}
