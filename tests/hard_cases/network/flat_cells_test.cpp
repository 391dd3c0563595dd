// SPDX-License-Identifier: BSD-3-Clause
#include "support/paired_cells.hpp"
#include "tetrapore/network.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace tetrapore;

namespace {

using p2 = two_pyramids;

// Height over the square of the centre of every cell of a pyramid, equal grains: 1 + z² = (height - z)².
constexpr double upper_centre = 0.75;
constexpr double lower_centre = -4.0 / 3.0;

network made(const two_pyramids& shape, const std::vector<named_cell>& names) {
  return make_network(shape.region, shape.grains(), shape.cells(names));
}

double distance(const vec3<double>& p, const vec3<double>& q) { return norm(p - q); }

double sum(std::span<const double> values) { return compensated_sum(values); }

std::string refusal(const two_pyramids& shape, const std::vector<named_cell>& names) {
  try {
    static_cast<void>(made(shape, names));
  } catch (const packing_error& e) {
    return e.what();
  }
  return "accepted";
}

/// Periodic in x with period 4, the square across the seam: grain `a` is stored at the low end of the box.
two_pyramids across_the_seam() {
  two_pyramids shape;
  shape.region = {
      {{0, -2, -4}, {4, 2, 4}},
      {boundary::periodic, boundary::periodic, boundary::open, boundary::open, boundary::open, boundary::open}};
  shape.middle = {3.5, 0, 0};
  return shape;
}

std::vector<sphere<double>> wrapped(std::vector<sphere<double>> grains) {
  grains[p2::a].centre.x -= 4.0;
  return grains;
}

/// Its cell with grain `a` at the image where it closes the square.
named_cell at_seam(named_cell c) {
  for (std::size_t k = 0; k < 4; ++k) {
    c.images[k] = c.grains[k] == p2::a ? image{1, 0, 0} : image{};
  }
  return c;
}

}  // namespace

TEST_CASE("a flat cell takes the power centre of the cell beyond its first facet") {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    CAPTURE(unit);
    two_pyramids shape;
    shape.unit = unit;
    const std::vector<named_cell> names{p2::upper_b, p2::upper_d, p2::flat, p2::lower_a, p2::lower_c};
    network net = made(shape, names);
    CHECK(measure(net).flat_pores == 1);
    CHECK(distance(net.power_centre(pore_id(2)), {0, 0, upper_centre * unit}) < 1e-15 * unit);
    const network turned = made(shape, {p2::flat_turned, p2::upper_b, p2::upper_d, p2::lower_a, p2::lower_c});
    CHECK(distance(turned.power_centre(pore_id(0)), {0, 0, lower_centre * unit}) < 1e-15 * unit);
  }
}

TEST_CASE("a flat cell has no volume, and the cells around it are what they are without it") {
  two_pyramids shape;
  SUBCASE("separate grains") {}
  SUBCASE("a grain that reaches through the flat cell") { shape.radii[p2::bottom] = 3.1; }
  SUBCASE("grains that overlap inside the flat cell") { shape.radii[p2::a] = shape.radii[p2::c] = 1.05; }
  network net = made(shape, {p2::upper_b, p2::upper_d, p2::flat, p2::lower_a, p2::lower_c});
  const network plain = made(shape, {p2::upper_b, p2::upper_d, p2::lower_b, p2::lower_d});
  CHECK(net.volume(pore_id(2)) == 0.0);
  CHECK(std::abs(net.void_volume(pore_id(2))) < 1e-15);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(std::abs(net.void_volume(pore_id(i)) - plain.void_volume(pore_id(i))) < 1e-15);
  }
  const double region = 10.0 / 3.0;  // base 2, heights 2 + 3
  CHECK(std::abs(sum(net.arrays().volumes) - region) < 1e-15 * region);
  CHECK(std::abs(sum(net.arrays().void_volumes) + solid_volume(net) - region) < 1e-14);
  CHECK(std::abs(sum(plain.arrays().void_volumes) + solid_volume(plain) - region) < 1e-14);
}

TEST_CASE("flat cells on each other reach out through one another") {
  const network net = made({}, {p2::upper_b, p2::upper_d, p2::flat, p2::flat_back, p2::flat, p2::lower_a, p2::lower_c});
  network again = net;
  CHECK(measure(again).flat_pores == 3);
  CHECK(distance(net.power_centre(pore_id(2)), {0, 0, upper_centre}) < 1e-15);
  CHECK(distance(net.power_centre(pore_id(4)), {0, 0, lower_centre}) < 1e-15);  // flat cells above: not yet known
  CHECK(distance(net.power_centre(pore_id(3)), {0, 0, upper_centre}) < 1e-15);  // by its first facet, a step later
}

TEST_CASE("flat cells on each other that are listed from below end with the same centres") {
  const network net = made({}, {p2::lower_a, p2::lower_c, p2::flat, p2::flat_back, p2::flat, p2::upper_b, p2::upper_d});
  CHECK(distance(net.power_centre(pore_id(2)), {0, 0, lower_centre}) < 1e-15);
  CHECK(distance(net.power_centre(pore_id(3)), {0, 0, upper_centre}) < 1e-15);  // its first facet still looks up
  CHECK(distance(net.power_centre(pore_id(4)), {0, 0, upper_centre}) < 1e-15);
}

TEST_CASE("flat cells without a way out are refused by the name of the first") {
  CHECK(refusal({}, {p2::flat}) ==
        "pore 0: found a flat cell with flat neighbours only, expected grains that are not coplanar");
  CHECK(refusal({}, {p2::flat, p2::flat_back}).substr(0, 6) == "pore 0");
  // four coplanar grains of their own, apart from a sound cell
  std::vector<sphere<double>> grains = two_pyramids{}.grains();
  for (const vec3<double>& at : {vec3<double>{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}}) {
    grains.push_back({at, 0.1});
  }
  const std::vector<named_cell> names{p2::upper_b, p2::flat, {{6, 7, 8, 9}}};
  CHECK_THROWS_WITH_AS(static_cast<void>(make_network(unbounded(), grains, paired(unbounded(), grains, names))),
                       "pore 2: found a flat cell with flat neighbours only, expected grains that are not coplanar",
                       packing_error);
}

TEST_CASE("the centre that a flat cell takes across a periodic face is moved to the image of the flat cell") {
  const two_pyramids shape = across_the_seam();
  const auto grains = wrapped(shape.grains());
  for (const int k : {-2, -1, 0, 1, 2}) {
    for (const bool flat_first : {false, true}) {  // the flat cell is pore 1 of its throats, or pore 0
      CAPTURE(k);
      CAPTURE(flat_first);
      const image by{static_cast<std::int8_t>(k), 0, 0};
      std::vector<named_cell> names;
      for (const auto& c : {p2::upper_b, p2::upper_d, p2::lower_a, p2::lower_c}) {
        names.push_back(at_seam(c));
      }
      names.insert(flat_first ? names.begin() : names.end(), at_seam(p2::flat).moved(by));
      const network net = make_network(shape.region, grains, paired(shape.region, grains, names));
      const pore_id flat(flat_first ? 0 : 4);
      const vec3<double> expected{3.5 + 4.0 * k, 0, upper_centre};
      CHECK(distance(net.power_centre(flat), expected) < 1e-14);
      const throat_id t = net.throats(flat)[0];
      CHECK(net.pores(t)[flat_first ? 0 : 1] == flat);
      const auto facet = throat_at(net, t);  // the nodes of the throat, unwrapped: one point
      CHECK(distance(facet.nodes[0], facet.nodes[1]) < 1e-14);
    }
  }
}

TEST_CASE("a flat cell that moves with its grains stops being flat, and is flat again when they return") {
  const two_pyramids shape;
  network net = made(shape, {p2::upper_b, p2::upper_d, p2::flat, p2::lower_a, p2::lower_c});
  auto grains = shape.grains();
  grains[p2::a].centre.z = grains[p2::c].centre.z = 0.25;
  CHECK(follow(net, grains).flat_pores == 0);
  CHECK(net.volume(pore_id(2)) == doctest::Approx(0.25 * 4 / 6).epsilon(1e-15));  // two edges of 2, 0.25 apart
  CHECK(distance(net.power_centre(pore_id(2)), {0, 0, 0.125}) < 1e-15);
  CHECK(follow(net, shape.grains()).flat_pores == 1);
  CHECK(distance(net.power_centre(pore_id(2)), {0, 0, upper_centre}) < 1e-15);
}
