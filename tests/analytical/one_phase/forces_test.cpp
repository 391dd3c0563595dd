// SPDX-License-Identifier: BSD-3-Clause
#include "support/small_networks.hpp"
#include "tetrapore/one_phase/forces.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

// Two cells and the facet between them: force, torque and stress worked out by hand.

using namespace tetrapore;

namespace {

constexpr node_rule every_pore{.coincidence = 0, .flatness = 0};

struct two_cells {
  network net;
  pressure_field pressure;
};

/// The base vertices with grain `above` on one side and grain `below` on the other, with their pressures; `volumes` and
/// the height of the two nodes over the base (both above the point `foot`) are what the geometry gives by hand.
two_cells make(const domain& region, std::vector<sphere<double>> grains, const std::array<vertex, 3>& base,
               const std::array<double, 2>& pressures, const std::array<double, 2>& volumes,
               const std::array<vec3<double>, 2>& nodes) {
  const auto cell_with = [&](std::size_t apex) {
    std::array<vertex, 4> v{vertex(grain_id(apex)), base[0], base[1], base[2]};
    return v;
  };
  const std::size_t n = grains.size();
  two_cells out{network_of(region, std::move(grains), {cell_with(n - 2), cell_with(n - 1)}), {}};
  out.net.mutable_arrays().volumes = {volumes[0], volumes[1]};
  out.net.mutable_arrays().power_centres = {nodes[0], nodes[1]};
  out.pressure = pressure_field(out.net);
  out.pressure[pore_id(0)] = pressures[0];
  out.pressure[pore_id(1)] = pressures[1];
  return out;
}

/// Parts of a facet by the radius of the grain, so that the order of its vertices does not matter; walls last.
struct parts_by_radius {
  struct part {
    double radius, pressure, viscous;
  };
  std::array<part, 3> parts;

  facet_load operator()(const throat<double>& t) const noexcept {
    facet_load load;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const part& p : parts) {
        if (k < t.grain_count ? t.grains[k].radius == p.radius : p.radius == 0) {
          load.pressure[k] = p.pressure;
          load.viscous[k] = p.viscous;
        }
      }
    }
    return load;
  }
};

void check_close(const vec3<double>& a, const vec3<double>& b) {
  CAPTURE(a.x);
  CAPTURE(a.y);
  CAPTURE(a.z);
  CAPTURE(b.x);
  CAPTURE(b.y);
  CAPTURE(b.z);
  CHECK(norm(a - b) < 1e-14 * (1 + norm(b)));
}

const double root3 = std::sqrt(3.0);

}  // namespace

TEST_CASE("flow down through an equilateral facet: each grain is pushed down and rolls into the hole") {
  // spheres of radius 0.8 on two regular tetrahedra of edge 2 with a common face; pressure 3 above and 1 below
  const double r = 0.8;
  const double h = 2 * std::sqrt(2.0 / 3.0);
  const double volume = 2 * std::sqrt(2.0) / 3;
  const double drop = 2;
  for (const bool above_first : {true, false}) {
    const double side = above_first ? 1 : -1;
    const two_cells c = make(unbounded(),
                             {{{0, 0, 0}, r},
                              {{2, 0, 0}, r},
                              {{1, root3, 0}, r},
                              {{1, root3 / 3, side * h}, r},
                              {{1, root3 / 3, -side * h}, r}},
                             {vertex(grain_id(0)), vertex(grain_id(1)), vertex(grain_id(2))},
                             {above_first ? 3.0 : 1.0, above_first ? 1.0 : 3.0}, {volume, volume},
                             {vec3<double>{1, root3 / 3, side * h / 4}, vec3<double>{1, root3 / 3, -side * h / 4}});
    const fluid_forces f = forces_of_pressure(c.net, flow_nodes(c.net, every_pore), c.pressure, {},
                                              share_by_wetted_area{}, {.stress = true});
    const double disc = pi<double> * r * r / 6;  // a sixth of a great circle
    const double open = (root3 - 3 * disc) / 3;  // a third of what the discs leave of the facet
    const double shear = drop * open;
    // unit vectors from the corners to the middle
    const std::array<vec3<double>, 3> arm{{{root3 / 2, 0.5, 0}, {-root3 / 2, 0.5, 0}, {0, -1, 0}}};
    // arm × (0, 0, −1), by hand
    const std::array<vec3<double>, 3> turn{{{-0.5, root3 / 2, 0}, {-0.5, -root3 / 2, 0}, {1, 0, 0}}};
    for (std::size_t g = 0; g < 3; ++g) {
      CAPTURE(g);
      check_close(f.pressure[g], {0, 0, -drop * disc});
      check_close(f.viscous[g], {0, 0, -shear});
      check_close(f.torques[g], turn[g] * (r * shear));
      CHECK(f.torques[g].z == 0);
      CHECK(dot(cross(arm[g], f.viscous[g]), f.torques[g]) > 0);
    }
    for (const std::size_t g : {3U, 4U}) {  // behind the hull the pressure is that of their pore
      check_close(f.on(grain_id(g)), {});
      check_close(f.torques[g], {});
    }
    check_close(f.total(), {0, 0, -drop * root3});
    CHECK(f.replaced == 0);
    // Three equal forces at three arms that cancel: only the pressure on the sectors is left. Tension is positive. The
    // solid angle of a regular tetrahedron is acos(23/27); each pore holds four such sectors.
    const double solid = 4 * r * r * r * std::acos(23.0 / 27.0) / 3;
    for (std::size_t i = 0; i < 3; ++i) {
      vec3<double> expected;
      expected[i] = -(3.0 + 1.0) * solid / (2 * volume);
      check_close(f.stress[i], expected);
    }
  }
}

TEST_CASE(
    "where wetted areas have no common sign their magnitudes share, where they vanish the discs, and it is said") {
  throat_hydraulics<double> h;
  h.grain_count = 3;
  h.fluid_area = 8;
  h.disc_area = {1, 2, 1};
  const auto shares = [&](std::array<double, 3> wetted) {
    h.wetted_area = wetted;
    return share_by_wetted_area{}(throat<double>{}, h);
  };
  const facet_load down = shares({-1, -1, -2});  // one sign
  CHECK_FALSE(down.replaced);
  CHECK(down.viscous == std::array<double, 3>{2, 2, 4});
  const facet_load mixed = shares({1, -1, 2});
  CHECK(mixed.replaced);
  CHECK(mixed.viscous == std::array<double, 3>{2, 2, 4});
  const facet_load none = shares({0, 0, 0});
  CHECK(none.replaced);
  CHECK(none.viscous == std::array<double, 3>{2, 4, 2});
  CHECK(none.pressure == h.disc_area);
}

TEST_CASE("a right-angled facet with unequal grains: arm × force is the torque, Σ arm ⊗ force / volume the stress") {
  // corners of a 3-4-5 triangle, apexes 2 above and 3 below it; pressure 5 above and 2 below pushes down with 3
  const std::array<double, 3> r{0.5, 0.4, 0.3};
  const two_cells c =
      make(unbounded(), {{{0, 0, 0}, r[0]}, {{4, 0, 0}, r[1]}, {{0, 3, 0}, r[2]}, {{1, 1, 2}, 0.2}, {{1, 1, -3}, 0.6}},
           {vertex(grain_id(0)), vertex(grain_id(1)), vertex(grain_id(2))}, {5, 2}, {4, 6},
           {vec3<double>{1, 1, 0.5}, vec3<double>{1, 1, -0.5}});
  const std::array<double, 3> disc{0.75, 0.5, 0.25};
  const std::array<double, 3> open{1, 2, 1.5};
  const parts_by_radius parts{{{{r[0], disc[0], open[0]}, {r[1], disc[1], open[1]}, {r[2], disc[2], open[2]}}}};
  const fluid_forces f =
      forces_of_pressure(c.net, flow_nodes(c.net, every_pore), c.pressure, {}, parts, {.stress = true});
  // the bisectors of the three corners, and half of their angles
  const std::array<vec3<double>, 3> bisector{{vec3<double>{1, 1, 0} / std::sqrt(2.0),
                                              vec3<double>{-3, 1, 0} / std::sqrt(10.0),
                                              vec3<double>{1, -2, 0} / std::sqrt(5.0)}};
  const std::array<double, 3> half{pi<double> / 4, std::atan(1.0 / 3.0), std::atan(0.5)};
  vec3<double> moment;  // Σ arm (force along −z), over the volume 10
  for (std::size_t g = 0; g < 3; ++g) {
    CAPTURE(g);
    check_close(f.pressure[g], {0, 0, -3 * disc[g]});
    check_close(f.viscous[g], {0, 0, -3 * open[g]});
    const vec3<double> lever = bisector[g] * r[g];
    // (x, y, 0) × (0, 0, −s) = (−s y, s x, 0)
    check_close(f.torques[g], {-3 * open[g] * lever.y, 3 * open[g] * lever.x, 0});
    // the pressure acts at the centroid of the sector, 2/3 r sin(half)/half from the centre
    moment += lever * (-3 * open[g] - 3 * disc[g] * (2.0 / 3.0) * std::sin(half[g]) / half[g]);
  }
  CHECK(std::abs(moment.x) > 0.4);
  CHECK(std::abs(moment.y) > 0.4);
  CHECK(f.stress[0].z == doctest::Approx(moment.x / 10).epsilon(1e-14));  // first index: arm; second: force
  CHECK(f.stress[1].z == doctest::Approx(moment.y / 10).epsilon(1e-14));
  for (const auto& [i, j] : {std::array<std::size_t, 2>{0, 1}, {1, 0}, {2, 0}, {2, 1}}) {
    CHECK(f.stress[i][j] == 0);
  }
  CHECK(f.stress[0].x < 0);  // a pressure is negative
  CHECK(f.stress[0].x == f.stress[1].y);
  CHECK(f.stress[0].x == f.stress[2].z);
}

TEST_CASE("a facet on a wall: the wall takes its share, and the arms of the grains point between neighbour and wall") {
  const std::array<double, 2> r{0.5, 0.4};
  const two_cells c =
      make(walled({{0, 0, 0}, {4, 4, 4}}), {{{1, 1, 2}, r[0]}, {{3, 1, 2}, r[1]}, {{2, 1, 1}, 0.3}, {{2, 1, 3}, 0.3}},
           {vertex(grain_id(0)), vertex(grain_id(1)), vertex(face::y_min)}, {1, 8}, {1, 1},
           {vec3<double>{2, 0.5, 1.5}, vec3<double>{2, 0.5, 2.5}});
  const parts_by_radius parts{{{{r[0], 0.1, 0.3}, {r[1], 0.2, 0.4}, {0, 0, 1}}}};
  const fluid_forces f = forces_of_pressure(c.net, flow_nodes(c.net, every_pore), c.pressure, {}, parts);
  // the pressure is 7 higher at larger z: all is pushed towards smaller z
  check_close(f.viscous[0], {0, 0, -7 * 0.3});
  check_close(f.viscous[1], {0, 0, -7 * 0.4});
  check_close(f.walls[static_cast<std::size_t>(face::y_min)], {0, 0, -7.0});
  const double root2 = std::sqrt(2.0);
  // arms r (1, −1, 0)/√2 and r (−1, −1, 0)/√2; (x, y, 0) × (0, 0, −s) = (−s y, s x, 0)
  check_close(f.torques[0], vec3<double>{1, 1, 0} * (7 * 0.3 * r[0] / root2));
  check_close(f.torques[1], vec3<double>{1, -1, 0} * (7 * 0.4 * r[1] / root2));
}
