// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "tetrapore/law/entry.hpp"
#include "tetrapore/network.hpp"
#include "tetrapore/packing/random_packing.hpp"
#include "tetrapore/two_phase.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace tetrapore;

namespace {

constexpr std::size_t count = 6;

network random_network(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> radii(2000);
  for (double& r : radii) {
    r = 0.7 + 0.6 * static_cast<double>(random() >> 11U) * 0x1p-53;
  }
  const packing p = random_packing(radii, {.solid_fraction = 0.56, .seed = seed});
  return compiled_triangulation{}(p.grains, domain_of(p)).net;
}

/// p_c at S = 0.5 when gas comes from one face towards the opposite one, with σ = 1.
double half_drained(const network& net, face inlet) {
  facet_rule<mayer_stowe_princen, gap_model::lost_arc> rule(net, {.surface_tension = 1.0});
  drainage invasion(net, rule, {.inlet = inlet, .outlet = opposite(inlet)});
  invasion.run();
  const auto p = retention_curve(invasion).pressure_at(0.5);
  REQUIRE(p.has_value());
  return *p;
}

}  // namespace

TEST_CASE(
    "drainage has no preferred direction: six directions spread by less than two standard deviations of six seeds") {
  std::array<double, count> over_seeds{};
  std::array<double, count> over_directions{};
  for (std::size_t i = 0; i < count; ++i) {
    const network net = random_network(i + 1);
    over_seeds[i] = half_drained(net, face::y_max);
    if (i == 0) {
      for (const face f : all_faces) {
        over_directions[static_cast<std::size_t>(f)] = half_drained(net, f);
      }
    }
  }
  double mean = 0;
  for (const double p : over_seeds) {
    mean += p / count;
  }
  double variance = 0;
  for (const double p : over_seeds) {
    variance += (p - mean) * (p - mean) / (count - 1);
  }
  const auto [least, most] = std::minmax_element(over_directions.begin(), over_directions.end());
  MESSAGE("p_c at S = 0.5: directions spread by " << *most - *least << ", seeds deviate by " << std::sqrt(variance)
                                                  << ", mean " << mean);
  CHECK(*most - *least <= 2 * std::sqrt(variance));
}
