// SPDX-License-Identifier: BSD-3-Clause
#include "support/throats.hpp"
#include "tetrapore/simplex/throat_hydraulics.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace throats;

TEST_CASE("three equal grains: areas, volumes and wetted area in closed form") {
  const double r = 0.9;
  const double d = 2.1;
  const double z = 0.7;
  const throat<double> t = of_grains({r, r, r}, d, d, d, -z, z);
  const auto h = hydraulics_of(t);
  REQUIRE(h.ok());
  const double area = std::sqrt(3.0) / 4 * d * d;
  // four right-angled spherical triangles with legs of 30° and of the elevation of a node
  const double omega = 8 * std::atan(std::tan(pi<double> / 12) * std::tan(std::atan2(z, d / std::sqrt(3.0)) / 2));
  CHECK(h.value.length == doctest::Approx(2 * z).epsilon(1e-15));
  CHECK(h.value.facet_area == doctest::Approx(area).epsilon(1e-14));
  CHECK(h.value.fluid_area == doctest::Approx(area - pi<double> * r * r / 2).epsilon(1e-14));
  CHECK(h.value.domain_volume == doctest::Approx(area * 2 * z / 3).epsilon(1e-14));
  CHECK(h.value.solid_volume == doctest::Approx(r * r * r * omega).epsilon(1e-14));
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(h.value.wetted_area[k] == doctest::Approx(r * r * omega).epsilon(1e-14));
    CHECK(h.value.disc_area[k] == doctest::Approx(pi<double> * r * r / 6).epsilon(1e-14));
  }
  CHECK(h.value.hydraulic_radius(wall_condition::slip) ==
        doctest::Approx((area * 2 * z / 3 - r * r * r * omega) / (3 * r * r * omega)).epsilon(1e-13));
}

TEST_CASE("a grain in a corner: the walls are wetted on the triangles between foot, edge and nodes") {
  const double r = 0.5;
  const auto h = hydraulics_of(in_a_corner(r, 0.8, 1.5, -0.3, 1.1)).value;
  const double far = std::hypot(0.8, 1.5);
  const auto quarter = [&](double alpha, double z) {
    return 2 * std::atan(std::tan(alpha / 2) * std::tan(std::atan2(z, far) / 2));
  };
  const double alpha = std::atan2(1.5, 0.8);
  double omega = 0;
  for (const double z : {0.3, 1.1}) {
    omega += quarter(alpha, z) + quarter(pi<double> / 2 - alpha, z);
  }
  CHECK(h.domain_volume == doctest::Approx(0.8 * 1.5 * 1.4 / 3).epsilon(1e-14));
  CHECK(h.wetted_area[0] == doctest::Approx(r * r * omega).epsilon(1e-14));
  CHECK(h.wetted_area[1] == doctest::Approx(1.5 * 1.4 / 2).epsilon(1e-14));
  CHECK(h.wetted_area[2] == doctest::Approx(0.8 * 1.4 / 2).epsilon(1e-14));
  CHECK(h.sheared_area(wall_condition::slip) == h.wetted_area[0]);
  CHECK(h.sheared_area(wall_condition::no_slip) ==
        doctest::Approx(h.wetted_area[0] + h.wetted_area[1] + h.wetted_area[2]).epsilon(1e-15));
}

TEST_CASE("two grains on a wall: the wall is wetted on the quadrangle between their feet and the nodes") {
  const throat<double> t = on_a_wall({0.7, 0.9}, {0.8, 1.1}, 1.6, -0.4, 0.5);
  const auto h = hydraulics_of(t).value;
  CHECK(h.facet_area == doctest::Approx(1.6 * 0.95).epsilon(1e-14));
  CHECK(h.domain_volume == doctest::Approx(1.6 * 0.95 * 0.9 / 3).epsilon(1e-14));
  CHECK(h.wetted_area[2] == doctest::Approx(1.6 * 0.9 / 2).epsilon(1e-14));
  CHECK(h.disc_area[2] == 0);
}

TEST_CASE("random throats: solid angles agree with those from the feet of the axis, also where it misses the facet") {
  random_throats next(1);
  std::size_t outside = 0;
  double worst = 0;
  for (int i = 0; i < 50000; ++i) {
    const throat<double> t = next();
    const throat<long double> exact = as<long double>(t);
    const auto h = hydraulics_of(t);
    REQUIRE(h.ok());
    long double solid = 0;
    bool missed = false;
    for (std::size_t k = 0; k < t.grain_count; ++k) {
      const long double r = exact.grains[k].radius;
      const long double omega = solid_angle_by_feet(exact, k);
      solid += r * r * r * omega / 3;
      const auto wetted = static_cast<double>(r * r * omega);
      worst = std::max(worst, std::abs(h.value.wetted_area[k] - wetted));
      CHECK(std::abs(h.value.wetted_area[k] - wetted) < 32 * epsilon<double>);
      const auto share = [&](std::size_t j) {
        const vec3<double> along =
            j < t.grain_count ? t.grains[j].centre - t.grains[k].centre : -t.walls[j - t.grain_count].normal;
        return dot(t.area_vector, cross(along, t.nodes[0] - t.grains[k].centre));
      };
      missed = missed || share((k + 1) % 3) < 0 || share((k + 2) % 3) > 0;
    }
    outside += missed ? 1U : 0U;
    CHECK(std::abs(h.value.solid_volume - static_cast<double>(solid)) < 64 * epsilon<double>);
  }
  CHECK(outside > 2000);
  MESSAGE("worst error of a wetted area " << worst << ", axis outside the facet in " << outside << " of 50000");
}

TEST_CASE("fluid and discs fill the facet, also where grains overlap or a disc reaches across an edge or a wall") {
  random_throats next(2);
  for (int i = 0; i < 20000; ++i) {
    throat<double> t = next();
    for (std::size_t k = 0; k < t.grain_count; ++k) {
      t.grains[k].radius *= next.uniform(0.5, 1.6);
    }
    const auto h = hydraulics_of(t);
    REQUIRE(h.ok());
    double sum = h.value.fluid_area;
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(h.value.disc_area[k] >= -8 * epsilon<double>);
      sum += h.value.disc_area[k];
    }
    CHECK(std::abs(sum / norm(t.area_vector) - 1) < 16 * epsilon<double>);
    CHECK(h.value.fluid_area == fluid_area(t).value);
  }
}

TEST_CASE("sectors less half segments agree with clipped discs wherever they apply") {
  random_throats next(3);
  std::size_t sectors = 0;
  std::size_t overlapping = 0;
  std::size_t clipped = 0;
  for (int i = 0; i < 50000; ++i) {
    throat<double> t = next();
    const double grown = i % 3 == 0 ? 1.0 : next.uniform(0.9, 1.5);
    for (std::size_t k = 0; k < t.grain_count; ++k) {
      t.grains[k].radius *= grown * next.uniform(1.0, 1.1);
    }
    detail::facet_areas<double> fast{};
    if (t.grain_count < 3 || !detail::sectors_in_facet(t, fast)) {
      ++clipped;
      continue;
    }
    ++sectors;
    const auto slow = detail::clipped_in_facet(t);
    CHECK(std::abs(fast.whole - slow.whole) < 32 * epsilon<double>);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(std::abs(fast.disc[k] - slow.disc[k]) < 32 * epsilon<double>);
      const auto& a = t.grains[k];
      const auto& b = t.grains[(k + 1) % 3];
      overlapping += norm(a.centre - b.centre) < a.radius + b.radius ? 1U : 0U;
    }
  }
  CHECK(sectors > 10000);
  CHECK(overlapping > 10000);
  CHECK(clipped > 5000);
}

TEST_CASE("a node that comes to the other takes length, volume and wetted area with it, in proportion") {
  const throat<double> near = of_grains({1, 1.1, 0.9}, 2.2, 2.3, 2.1, 0.2, 0.2 + 1e-9);
  const throat<double> far = of_grains({1, 1.1, 0.9}, 2.2, 2.3, 2.1, 0.2, 0.2 + 1e-6);
  const auto a = hydraulics_of(near).value;
  const auto b = hydraulics_of(far).value;
  CHECK(a.hydraulic_radius(wall_condition::slip) ==
        doctest::Approx(b.hydraulic_radius(wall_condition::slip)).epsilon(1e-6));
  throat<double> none = near;
  none.nodes[1] = none.nodes[0];
  const auto zero = hydraulics_of(none);
  CHECK(zero.ok());
  CHECK(zero.value.length == 0);
  CHECK(zero.value.sheared_area(wall_condition::no_slip) == 0);
}
