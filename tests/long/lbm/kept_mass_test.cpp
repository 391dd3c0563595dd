// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign: what 100,000 steps do to the mass of each component and to the momentum of all
// (docs/campaigns/kept_mass.json).
#include "support/campaign.hpp"
#include "support/lattice_states.hpp"
#include "tetrapore/lbm/moments.hpp"
#include "tetrapore/lbm/throat.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace lattice_states;

namespace {

constexpr std::size_t steps = 100000;

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
  REQUIRE(lightest < 0.1);  // both phases are still there
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
void add_rows(std::vector<campaigns::row>& rows) {
  for (const bool throat : {true, false}) {
    const drift d = throat ? in_throat<Storage, T>() : in_box<Storage, T>();
    campaigns::row row;
    row.put("domain", throat ? "throat between mirrors" : "bubble in a periodic box");
    row.put("storage", Storage == storage::moments ? "moments" : "in_place");
    row.put("precision", sizeof(T) == 8 ? "double" : "float");
    row.put("mass_of_gas", d.mass[0]).put("mass_of_liquid", d.mass[1]);
    rows.push_back(row.put("mean_velocity", throat ? tetrapore::quiet_nan<double> : d.velocity));
  }
}

}  // namespace

TEST_CASE("mass is kept over 100,000 steps, in a throat and in a periodic box, and so is momentum in the box") {
  campaigns::row head;
  head.put("steps", steps);
  const auto rows = campaigns::rows_of("kept_mass", head, [] {
    std::vector<campaigns::row> measured;
    add_rows<storage::in_place, double>(measured);
    add_rows<storage::in_place, float>(measured);
    add_rows<storage::moments, double>(measured);
    add_rows<storage::moments, float>(measured);
    return measured;
  });
  CHECK(rows.size() == 8);
  for (const campaigns::row& r : rows) {
    CAPTURE(r.line());
    const bool exact = r.word("precision") == "double";
    const double allowed = exact ? 1e-12 : 1e-6;
    CHECK(std::abs(r.number("mass_of_gas")) <= allowed);
    CHECK(std::abs(r.number("mass_of_liquid")) <= allowed);
    if (r.word("domain") == "bubble in a periodic box") {
      // populations of about 0.1 that are rounded the same way in every step
      CHECK(r.number("mean_velocity") <= 0.1 * (exact ? 0x1p-53 : 0x1p-24) * static_cast<double>(steps));
    }
  }
}
