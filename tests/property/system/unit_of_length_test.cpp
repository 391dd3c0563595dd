// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "tetrapore/law/entry.hpp"
#include "tetrapore/network.hpp"
#include "tetrapore/packing/random_packing.hpp"
#include "tetrapore/two_phase.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace tetrapore;

namespace {

packing dense(double unit) {
  std::mt19937_64 random(9);
  std::vector<double> radii(343);
  for (double& r : radii) {
    r = 0.7 + 0.6 * static_cast<double>(random() >> 11U) * 0x1p-53;
  }
  packing p = random_packing(radii, {.solid_fraction = 0.55, .seed = 4});
  for (auto& g : p.grains) {
    g = {g.centre * unit, g.radius * unit};
  }
  p.bounds = box{p.bounds->lo * unit, p.bounds->hi * unit};
  return p;
}

}  // namespace

TEST_CASE("facets around an edge whose gap gives way have one threshold, to the last bit") {
  const packing p = dense(1e-3);
  for (const bool periodic : {false, true}) {
    const domain d = periodic ? domain_of({p.grains, p.bounds, {true, true, true}}) : domain_of(p);
    const network net = compiled_triangulation{}(p.grains, d).net;
    std::size_t compared = 0;
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      const pore_id q(i);
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) {
          if (net.vertices(q)[a].is_wall()) {
            continue;
          }
          const edge<double> here = edge_at(net, q, a, b);
          for (const throat_id t : net.throats(q)) {
            if (!t.valid() || net.is_boundary(t)) {
              continue;
            }
            const pore_id other = net.across(q, t);
            for (std::size_t k = 0; k < 3; ++k) {
              for (std::size_t m = k + 1; m < 4; ++m) {
                if (net.vertices(other)[k].is_wall()) {
                  continue;
                }
                const edge<double> there = edge_at(net, other, k, m);
                const auto pair_of = [&](pore_id p0, std::size_t x, std::size_t y) {
                  return std::minmax(net.vertices(p0)[x], net.vertices(p0)[y]);
                };
                const vec3<double> turn = there.normal - here.normal;  // zero for the same image of the pair
                if (pair_of(q, a, b) == pair_of(other, k, m) && norm2(turn) < 1e-18) {
                  CHECK(there.gap == here.gap);
                  ++compared;
                }
              }
            }
          }
        }
      }
    }
    CHECK(compared > 10000);
  }
}

TEST_CASE("the order of invasion and the trapped pores do not depend on the unit of length") {
  std::vector<std::vector<pore_id>> orders;
  for (const double unit : {1.0, 1e-3, 3.7, 2.54e-2}) {
    const packing p = dense(unit);
    const network net = compiled_triangulation{}(p.grains, domain_of(p)).net;
    facet_rule<mayer_stowe_princen, gap_model::lost_arc> rule(net, {.surface_tension = 0.072});
    drainage invasion(net, rule);
    invasion.run();
    std::vector<pore_id> order;
    for (const auto& e : invasion.events()) {
      order.push_back(e.pore);
    }
    orders.push_back(order);
    CHECK(retention_curve(invasion).end_saturation() > 0.02);
  }
  for (const auto& order : orders) {
    CHECK(order == orders.front());
  }
}
