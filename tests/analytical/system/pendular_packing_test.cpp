// SPDX-License-Identifier: BSD-3-Clause
#include "../../../examples/support/bridge_shapes.hpp"
#include "../../../examples/support/pendular.hpp"
#include "support/compiled_triangulation.hpp"
#include "support/random_spheres.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace tetrapore;

namespace {

/// Volume between an outline and the caps of the surfaces that its ends lie on, and its area.
struct measured {
  double volume = 0;
  double area = 0;
};
measured measure(const support::outline& line, const edge<double>& e) {
  measured m;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double dx = line[i].x - line[i - 1].x;
    const double a = line[i - 1].y;
    const double b = line[i].y;
    m.volume += pi<double> / 3 * dx * (a * a + a * b + b * b);
    m.area += pi<double> * (a + b) * std::hypot(dx, b - a);
  }
  for (const auto& [radius, height] : {std::pair{e.radius1, -line.front().x}, {e.radius2, line.back().x - e.gap}}) {
    if (radius < infinity<double>) {
      m.volume -= pi<double> / 3 * height * height * (3 * radius - height);
    }
  }
  return m;
}

support::bridge_answer bridge_with(double contact1, double contact2) {
  return {bridge_status::ok, 1, 0, 0, contact1, contact2};
}

}  // namespace

TEST_CASE("the outline of an exact bridge ends on both surfaces, and encloses its volume within its area") {
  const double degree = pi<double> / 180;
  for (const auto& [radius2, gap, volume, angle1, angle2] : {std::array{1.0, 0.0, 1e-4, 0.0, 0.0},
                                                             {1.0, 0.1, 1e-2, 0.0, 0.0},
                                                             {1.0, 0.05, 0.1, 40.0, 40.0},
                                                             {0.3, 0.02, 1e-3, 20.0, 50.0},
                                                             {infinity<double>, 0.05, 1e-2, 0.0, 40.0},
                                                             {infinity<double>, 0.0, 0.3, 60.0, 70.0},
                                                             {0.5, -0.01, 1e-3, 10.0, 0.0},
                                                             {1.0, 0.2, 1.0, 0.0, 0.0}}) {
    CAPTURE(radius2);
    CAPTURE(volume);
    const young_laplace<> law{
        .surface_tension = 0.07, .contact_angle1 = angle1 * degree, .contact_angle2 = angle2 * degree};
    const edge<double> e{1.0, radius2, gap, {1, 0, 0}};
    const auto found = law.bridge(e, given_volume<double>{volume});
    REQUIRE(found.ok());
    const auto line = support::outline_of(law, e, given_volume<double>{volume}, 4001);
    const auto sunk = [](double radius, double filling) {
      return radius < infinity<double> ? 2 * radius * std::pow(std::sin(filling / 2), 2) : 0.0;
    };
    CHECK(line.front().y == doctest::Approx(found.value.contact1).epsilon(1e-9));
    CHECK(line.back().y == doctest::Approx(found.value.contact2).epsilon(1e-9));
    CHECK(line.back().x - line.front().x ==
          doctest::Approx(gap + sunk(1, found.value.filling1) + sunk(radius2, found.value.filling2)).epsilon(1e-8));
    const measured m = measure(line, e);
    CHECK(m.volume == doctest::Approx(volume).epsilon(1e-5));
    CHECK(m.area == doctest::Approx(law.areas(e, found.value).liquid_gas).epsilon(1e-5));
  }
}

TEST_CASE("the outline of a toroid encloses its volume, and the upright cylinder the one that it stands for") {
  const edge<double> e{1.0, 0.4, 0.03, {1, 0, 0}};
  const toroid<> ring{.surface_tension = 0.07, .contact_angle1 = 0.2, .contact_angle2 = 0.2};
  const lambert<> force_alone{.surface_tension = 0.07, .contact_angle = 0.2};
  const given_volume<double> liquid{1e-3};
  REQUIRE(ring.bridge(e, liquid).ok());
  CHECK(measure(support::outline_of(ring, e, liquid, 2001), e).volume == doctest::Approx(1e-3).epsilon(1e-5));
  CHECK(measure(support::outline_of(force_alone, e, liquid), e).volume == doctest::Approx(1e-3).epsilon(1e-9));
}

TEST_CASE("the void of a packing is that of its network, overlaps and what reaches through a wall included") {
  packing p;
  p.grains = loose_spheres(200, 3);
  p.bounds = box{{0, 0, 0}, {1, 1, 1}};
  for (const double grown : {1.0, 1.12}) {
    CAPTURE(grown);
    for (auto& g : p.grains) {
      g.radius *= grown;
    }
    const tessellation mesh = compiled_triangulation{}(p.grains, domain_of(p));
    double sum = 0;
    for (std::size_t i = 0; i < mesh.net.pore_count(); ++i) {
      sum += mesh.net.void_volume(pore_id(i));
    }
    CHECK(support::void_volume_of(p, domain_of(p)) == doctest::Approx(sum).epsilon(1e-12));
  }
}

TEST_CASE(
    "bridges touch when their filling angles add up to the angle between them, and on a wall when their feet meet") {
  support::pendular_scene scene;
  // three equal grains that touch: bridges at 60° from each other
  const double s = std::sqrt(3.0) / 2;
  scene.packing.grains = {{{0, 0, 0}, 0.5}, {{1, 0, 0}, 0.5}, {{0.5, s, 0}, 0.5}};
  scene.region = unbounded();
  scene.pairs = close_edges(scene.packing.grains, scene.region, 1e-9);
  REQUIRE(scene.pairs.size() == 3);
  for (const double filling : {29.9, 30.1}) {
    const double contact = 0.5 * std::sin(filling * pi<double> / 180);
    const std::vector<support::bridge_answer> all(3, bridge_with(contact, contact));
    CHECK(support::detail::overlapping_bridges(scene, all) == (filling > 30 ? 3 : 0));
  }
  // a large and a small grain on a floor, touching: their feet are 2 √(R r) apart
  scene.packing.grains = {{{0.5, 0.5, 0.25}, 0.25}, {{0.5 + 2 * std::sqrt(0.25 * 0.04), 0.5, 0.04}, 0.04}};
  scene.region = unit_box(boundary::wall, boundary::wall, boundary::wall);
  scene.pairs = close_edges(scene.packing.grains, scene.region, 1e-9);
  REQUIRE(scene.pairs.size() == 3);
  for (const double foot : {0.0999, 0.1001}) {
    std::vector<support::bridge_answer> all;
    for (const close_edge& e : scene.pairs) {
      all.push_back(e.key.b.is_wall() ? bridge_with(1e-3, foot) : bridge_with(1e-3, 1e-3));
    }
    CHECK(support::detail::overlapping_bridges(scene, all) == (foot > 0.1 ? 2 : 0));
  }
}

TEST_CASE("a pair gives the stress of its pull along its branch") {
  support::pendular_scene scene;
  const double h = std::sqrt(0.5);
  scene.packing.grains = {{{1, 1, 1}, 0.5}, {{1 + 1.1 * h, 1 + 1.1 * h, 1}, 0.5}};
  scene.region = domain{{{0, 0, 0}, {2, 3, 4}}};
  scene.packing.bounds = scene.region.bounds;
  scene.void_volume = 1;
  scene.pairs = close_edges(scene.packing.grains, scene.region, 0.2);
  REQUIRE(scene.pairs.size() == 1);
  const std::vector<support::bridge_answer> one{{bridge_status::ok, 3.0, 0.1, 5.0, 0.1, 0.1}};
  const auto s = support::sum_up(scene, one, 5.0);
  const double each = 3.0 * 1.1 / 24 / 2;
  CHECK(s.stress[0] == doctest::Approx(each).epsilon(1e-14));
  CHECK(s.stress[1] == doctest::Approx(each).epsilon(1e-14));
  CHECK(s.stress[5] == doctest::Approx(each).epsilon(1e-14));
  CHECK(s.stress[2] == 0);
  CHECK(s.stress[3] == 0);
  CHECK(s.liquid_volume == 0.1);
}
