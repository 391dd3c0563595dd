// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include "support/flow_scenes.hpp"

#include <algorithm>
#include <cmath>

using namespace tetrapore;
using namespace flow_scenes;

namespace {

/// The pressure on whole sectors, and nothing else.
struct only_pressure {
  facet_load operator()(const throat<double>& t) const noexcept {
    facet_load load;
    for (std::size_t k = 0; k < t.grain_count; ++k) {
      const auto towards = [&](std::size_t j) {
        return j < t.grain_count ? t.grains[j].centre - t.grains[k].centre : -t.walls[j - t.grain_count].normal;
      };
      const vec3<double> a = towards((k + 1) % 3);
      const vec3<double> b = towards((k + 2) % 3);
      load.pressure[k] = t.grains[k].radius * t.grains[k].radius * std::atan2(norm(cross(a, b)), dot(a, b)) / 2;
    }
    return load;
  }
};

pressure_field arbitrary_pressure(const network& net, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  pressure_field p(net);
  for (double& x : p.values()) {
    x = unit_draw(random);
  }
  return p;
}

}  // namespace

TEST_CASE("the parts of a facet sum to its area, none is negative") {
  for (const bool periodic : {false, true}) {
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      CAPTURE(s.name);
      const flow_nodes nodes(s.net);
      for (std::size_t i = 0; i < s.net.throat_count(); ++i) {
        const throat_id t(i);
        if (s.net.is_boundary(t) || nodes.inside(s.net, t)) {
          continue;
        }
        const throat<double> seen = nodes.throat_between(s.net, t);
        for (const auto wall : {wall_condition::no_slip, wall_condition::slip}) {
          const facet_load load = share_by_wetted_area{wall}(seen);
          double sum = 0;
          double least = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            sum += load.pressure[k] + load.viscous[k];
            least = std::min({least, load.pressure[k], load.viscous[k]});
          }
          double largest = norm(seen.area_vector);
          for (std::size_t k = 0; k < seen.grain_count; ++k) {
            largest = std::max(largest, seen.grains[k].radius * seen.grains[k].radius);
          }
          CHECK(std::abs(sum - norm(seen.area_vector)) < 1e-14 * largest);
          CHECK(least > -1e-14 * largest);
        }
      }
    }
  }
}

TEST_CASE("a uniform pressure stresses the grains by −p times their share of the volume") {
  for (const bool periodic : {false, true}) {
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      CAPTURE(s.name);
      double solid = 0;
      double volume = 0;
      for (std::size_t i = 0; i < s.net.pore_count(); ++i) {
        solid += sector_volume(pore_body_at(s.net, pore_id(i)));
        volume += s.net.volume(pore_id(i));
      }
      const fluid_forces f =
          forces_of_pressure(s.net, flow_nodes(s.net), pressure_field(s.net, 2.5), {}, share_by_wetted_area{}, true);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          CHECK(f.stress[i][j] == doctest::Approx(i == j ? -2.5 * solid / volume : 0).epsilon(1e-12));
        }
      }
    }
  }
}

TEST_CASE("pressure that differs from pore to pore gives a symmetric stress and no torque") {
  for (const bool periodic : {false, true}) {
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      CAPTURE(s.name);
      const flow_nodes nodes(s.net, {.coincidence = 0, .flatness = 0});  // every facet counts
      const vec3<double> gradient = periodic ? vec3<double>{0.5, -1, 2} : vec3<double>{};
      const fluid_forces f =
          forces_of_pressure(s.net, nodes, arbitrary_pressure(s.net, 4), gradient, only_pressure{}, true);
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(f.stress[i][i] < 0);
        for (std::size_t j = 0; j < i; ++j) {
          CHECK(std::abs(f.stress[i][j] - f.stress[j][i]) < 1e-12);
        }
      }
      for (const vec3<double>& torque : f.torques) {
        CHECK(norm(torque) == 0);
      }
    }
  }
}

TEST_CASE("flow along the axis of a lattice turns no grain, and pulls all alike") {
  for (const auto kind : {lattice_kind::simple_cubic, lattice_kind::body_centred, lattice_kind::face_centred}) {
    const network net = triangulated(lattice(kind, {3, 3, 3}, 0.5, {true, true, true}));
    flow_conditions c;
    c.mean_gradient = {0, 0, -1};
    auto flow = flow_of(net, water(), c);
    CHECK(flow.solve().ok());
    const fluid_forces f = forces_on_grains(flow);
    const double each = net.region().bounds.volume() / static_cast<double>(net.grain_count());
    for (std::size_t g = 0; g < net.grain_count(); ++g) {
      CAPTURE(g);
      const vec3<double> force = f.on(grain_id(g));
      CHECK(norm(force - vec3<double>{0, 0, each}) < 1e-12 * each);
      CHECK(norm(f.torques[g]) < 1e-12 * each);
    }
  }
}

TEST_CASE("the pressure on the walls of a closed box and the forces inside it balance") {
  for (const scene& s : walled_scenes()) {
    CAPTURE(s.name);
    const pressure_field p = arbitrary_pressure(s.net, 9);
    vec3<double> sum = forces_of_pressure(s.net, flow_nodes(s.net, {.coincidence = 0, .flatness = 0}), p).total();
    const auto walls = pressure_on_walls(s.net, p);
    double size = 0;
    for (const vec3<double>& w : walls) {
      sum += w;
      size += norm(w);
    }
    CHECK(norm(sum) < 1e-12 * size);
  }
}
