// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "support/random_spheres.hpp"
#include "tetrapore/network.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace tetrapore;

namespace {

constexpr auto wall = boundary::wall;
constexpr auto periodic = boundary::periodic;

/// Moves every grain by up to `amplitude` radii, inside the box.
std::vector<sphere<double>> stirred(std::vector<sphere<double>> grains, const domain& d, double amplitude,
                                    unsigned seed) {
  std::mt19937_64 random(seed);
  for (auto& g : grains) {
    for (std::size_t k = 0; k < 3; ++k) {
      g.centre[k] += amplitude * g.radius * (static_cast<double>(random() >> 11U) * 0x1p-52 - 1.0);
      if (!d.is_periodic(k)) {
        g.centre[k] = std::clamp(g.centre[k], g.radius, 1 - g.radius);
      }
    }
  }
  return grains;
}

}  // namespace

TEST_CASE("a rebuild keeps the liquid, fills full pores exactly, and leaves a constant pressure constant") {
  std::size_t changed = 0;
  for (const auto& region :
       {unit_box(wall, wall, wall), unit_box(periodic, wall, wall), unit_box(periodic, periodic, periodic)}) {
    for (const double amplitude : {0.01, 0.1, 0.4}) {
      CAPTURE(amplitude);
      const auto grains = loose_spheres(150, 5);
      const compiled_triangulation engine;
      network net = engine(grains, region).net;
      const auto moved = stirred(grains, region, amplitude, 11);
      network followed = net;
      follow(followed, moved);
      volume_field liquid(net);
      volume_field full(net);
      pressure_field pressure(net, 2.5);
      for (std::size_t i = 0; i < net.pore_count(); ++i) {
        liquid[pore_id(i)] = net.void_volume(pore_id(i)) * static_cast<double>(i % 7) / 6.0;
        full[pore_id(i)] = followed.void_volume(pore_id(i));
      }
      const double sum = compensated_sum(liquid.values());
      const bool upright = *std::min_element(followed.arrays().volumes.begin(), followed.arrays().volumes.end()) >= 0;
      const std::size_t before = net.pore_count();
      const transfer way = rebuild(net, engine, moved);
      changed += before != net.pore_count() ? 1U : 0U;
      carry(way, liquid);
      carry(way, full);
      carry(way, pressure);
      CHECK(liquid.belongs_to(net));
      CHECK(net.epoch() == 1);
      CHECK(std::abs(compensated_sum(liquid.values()) - sum) < 1e-13 * sum);
      for (std::size_t j = 0; j < net.pore_count(); ++j) {
        CHECK(std::abs(pressure[pore_id(j)] - 2.5) < 1e-14);
        if (upright) {  // both triangulations then fill the region once
          CHECK(std::abs(full[pore_id(j)] - net.void_volume(pore_id(j))) < 1e-12 * net.volume(pore_id(j)) + 1e-18);
        }
      }
    }
  }
  CHECK(changed > 4);  // the stirring did change the topology
}

TEST_CASE("a rebuild of grains that did not move hands every pore over whole") {
  const auto grains = loose_spheres(100, 3);
  const compiled_triangulation engine;
  network net = engine(grains, unit_box(wall, periodic, wall)).net;
  const network before = net;
  const transfer way = rebuild(net, engine, grains);
  for (std::size_t i = 0; i < before.pore_count(); ++i) {
    REQUIRE(way.of(pore_id(i)).size() == 1);
    CHECK(way.of(pore_id(i))[0].weight == 1.0);
    CHECK(before.vertices(pore_id(i)) == net.vertices(way.of(pore_id(i))[0].pore));
  }
}
