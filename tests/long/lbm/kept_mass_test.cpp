// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign: what 100,000 steps do to the mass of each component and to the momentum of all
// (docs/campaigns/kept_mass.json).
#include "support/lattice_states.hpp"
#include "tetrapore/lbm/moments.hpp"
#include "tetrapore/lbm/throat.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using namespace lattice_states;

namespace {

constexpr std::size_t steps = 100000;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

plain pair_of_fluids() {
  plain m;
  m.attraction = {{{0, 1.8}, {1.8, 0}}};
  m.reference = {1, 1};
  return m;
}

template <storage Storage, class T>
std::array<double, 3> momentum(const simulation<plain, T, Storage>& s) {
  std::array<double, 3> sum{};
  for (std::size_t n = 0; n < s.sites().size(); ++n) {
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t a = 0; a < 3; ++a) {
        if constexpr (Storage == storage::moments) {
          sum[a] += static_cast<double>(s.moment(c, n, 1 + a));
        } else {
          for (std::size_t i = 1; i < plain::directions; ++i) {
            sum[a] += static_cast<double>(s.population(c, n, i)) * d3q19::velocity[i][a];
          }
        }
      }
    }
  }
  return sum;
}

/// What goes of mass and momentum, the latter as a mean velocity: of all mass.
struct drift {
  std::array<double, 2> mass{};
  double velocity = 0;
};

template <storage Storage, class T, class Gas>
drift drift_of(site_map<d3q19> map, const std::array<double, 3>& wind, Gas gas) {
  simulation<plain, T, Storage> s(pair_of_fluids(), std::move(map));
  s.set_wall(tetrapore::lbm::grain_wall, {0.03, 1.0});
  s.initialise([&](const place& p, auto& rho, auto& u) {
    const double share = gas(p);
    rho = {0.03 + 0.97 * share, 1.0 - 0.97 * share};
    u = wind;
  });
  s.run(2);  // a state that populations in float can tell
  const std::array before{s.mass(0), s.mass(1)};
  const auto carried = momentum<Storage, T>(s);
  s.run(steps);
  const auto after = momentum<Storage, T>(s);
  drift d;
  for (std::size_t c = 0; c < 2; ++c) {
    d.mass[c] = s.mass(c) / before[c] - 1;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    d.velocity = std::max(d.velocity, std::abs(after[a] - carried[a]) / (before[0] + before[1]));
  }
  double lightest = 1;
  for (std::size_t n = 0; n < s.sites().size(); ++n) {
    lightest = std::min(lightest, s.density(0, n));
  }
  CHECK(lightest < 0.1);  // both phases are still there
  return d;
}

template <storage Storage, class T>
drift in_throat() {
  const auto o = tetrapore::opening_from_distances<double>(1, 0.8, 0.7, 2, 1.9, 1.7).value;
  // no node lies so far from the grains: no reservoir, mirrors above and below
  const throat_on_lattice t(o, {}, {.nodes_per_length = 12, .retraction = 1.1, .above = 10, .below = 12, .plug = 1e9});
  return drift_of<Storage, T>(t.sites<d3q19>(), {},
                              [&](const place& p) { return 0.5 * (1 + std::tanh((p[2] - t.middle()) / 1.5)); });
}
template <storage Storage, class T>
drift in_box() {
  const int side = 16;
  return drift_of<Storage, T>({box_of({side, side, side}), [](int, int, int) { return site{}; }},
                              {0.004, -0.002, 0.001}, [&](const place& p) {
                                const double r = std::hypot(p[0] - 7.4, p[1] - 8.1, p[2] - 7.8);
                                return 0.5 * (1 - std::tanh((r - 5) / 1.5));
                              });
}

template <storage Storage, class T>
void add_rows(std::vector<std::string>& rows) {
  for (const bool throat : {true, false}) {
    const drift d = throat ? in_throat<Storage, T>() : in_box<Storage, T>();
    const double allowed = sizeof(T) == 8 ? 1e-12 : 1e-6;
    CHECK(std::abs(d.mass[0]) <= allowed);
    CHECK(std::abs(d.mass[1]) <= allowed);
    rows.push_back(std::string("{\"domain\": \"") + (throat ? "throat between mirrors" : "bubble in a periodic box") +
                   "\", \"storage\": \"" + (Storage == storage::moments ? "moments" : "in_place") +
                   "\", \"precision\": \"" + (sizeof(T) == 8 ? "double" : "float") +
                   "\", \"mass_of_gas\": " + number(d.mass[0]) + ", \"mass_of_liquid\": " + number(d.mass[1]) +
                   ", \"mean_velocity\": " + (throat ? "null" : number(d.velocity)) + "}");
    if (!throat) {  // populations of about 0.1 that are rounded the same way in every step
      const double unit = sizeof(T) == 8 ? 0x1p-53 : 0x1p-24;
      CHECK(d.velocity <= 0.1 * unit * static_cast<double>(steps));
    }
  }
}

}  // namespace

TEST_CASE("mass is kept over 100,000 steps, in a throat and in a periodic box, and so is momentum in the box") {
  const std::filesystem::path folder = TETRAPORE_CAMPAIGN_DIR;
  std::filesystem::create_directories(folder);
  const auto path = folder / "kept_mass.json";
  if (std::filesystem::exists(path)) {
    MESSAGE("there already: " << path.filename().string());
    return;
  }
  std::vector<std::string> rows;
  add_rows<storage::in_place, double>(rows);
  add_rows<storage::in_place, float>(rows);
  add_rows<storage::moments, double>(rows);
  add_rows<storage::moments, float>(rows);
  const auto part = path.string() + ".part";
  std::ofstream out(part);
  out << "{\n  \"command\": \"tests/run.sh --long long_lbm\",\n  \"steps\": " << steps << ",\n  \"rows\": [\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    out << "    " << rows[k] << (k + 1 < rows.size() ? ",\n" : "\n");
  }
  out << "  ]\n}\n";
  out.close();
  std::filesystem::rename(part, path);
}
