// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/network.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

using namespace tetrapore;

namespace {

constexpr double small = 0.05;

/// Two tetrahedra on both sides of the triangle 1-2-3.
struct pair_of_cells {
  std::vector<sphere<double>> grains{
      {{0, 0, 0}, small}, {{1, 0, 0}, small}, {{0, 1, 0}, small}, {{0, 0, 1}, small}, {{1, 1, 1}, small}};
  std::vector<cell> cells{named({0, 1, 2, 3}), named({4, 2, 1, 3})};

  pair_of_cells() {
    cells[0].neighbours[0] = 1;
    cells[1].neighbours[0] = 0;
  }
  static cell named(std::array<std::size_t, 4> grains) {
    cell c;
    for (std::size_t k = 0; k < 4; ++k) {
      c.vertices[k] = vertex(grain_id(grains[k]));
    }
    return c;
  }
  [[nodiscard]] network make() const { return make_network(unbounded(), grains, cells); }
};

std::string refusal(const pair_of_cells& p) {
  try {
    static_cast<void>(p.make());
  } catch (const setup_error& e) {
    return e.what();
  }
  return "accepted";
}

std::string refusal(const network& net) {
  try {
    validate(net);
  } catch (const network_error& e) {
    return e.what();
  }
  return "accepted";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("two cells that share a facet make one inner throat and six on the boundary") {
  const network net = pair_of_cells{}.make();
  CHECK(net.pore_count() == 2);
  REQUIRE(net.throat_count() == 7);
  std::size_t inner = 0;
  for (std::size_t i = 0; i < 7; ++i) {
    inner += net.is_boundary(throat_id(i)) ? 0U : 1U;
  }
  CHECK(inner == 1);
  const throat_id shared = net.throats(pore_id(std::size_t{0}))[0];
  CHECK(net.across(pore_id(std::size_t{0}), shared) == pore_id(std::size_t{1}));
  CHECK(net.across(pore_id(std::size_t{1}), shared) == pore_id(std::size_t{0}));
  CHECK(net.volume(pore_id(std::size_t{0})) == doctest::Approx(1.0 / 6).epsilon(1e-15));
  CHECK(net.volume(pore_id(std::size_t{1})) == doctest::Approx(1.0 / 3).epsilon(1e-15));
}

TEST_CASE("the area vector of a throat points from pore 0 to pore 1") {
  const network net = pair_of_cells{}.make();
  const auto t = throat_at(net, net.throats(pore_id(std::size_t{0}))[0]);
  CHECK(t.area_vector.x == 0.5);
  CHECK(t.area_vector.y == 0.5);
  CHECK(t.area_vector.z == 0.5);
}

TEST_CASE("boundary throats are named by the face their normal points to") {
  const network net = pair_of_cells{}.make();
  const auto& slots = net.throats(pore_id(std::size_t{0}));
  CHECK(net.boundary_face(slots[1]) == face::x_min);
  CHECK(net.boundary_face(slots[2]) == face::y_min);
  CHECK(net.boundary_face(slots[3]) == face::z_min);
  CHECK(net.touches(pore_id(std::size_t{0}), face::x_min));
  CHECK_FALSE(net.touches(pore_id(std::size_t{0}), face::x_max));
}

TEST_CASE("edges are listed once, and a walk around an inner edge meets both cells") {
  const network net = pair_of_cells{}.make();
  CHECK(edges_of(net).size() == 9);
  // around the edge of grains 1 and 2, from cell 0 through the shared facet
  const edge_cursor start{pore_id(std::size_t{0}), 1, 2, 0, 3, {}};
  const auto next = next_around(net, start);
  REQUIRE(next.has_value());
  CHECK(next->pore == pore_id(std::size_t{1}));
  CHECK(net.vertices(next->pore)[next->first] == vertex(grain_id(std::size_t{1})));
  CHECK(net.vertices(next->pore)[next->second] == vertex(grain_id(std::size_t{2})));
  CHECK_FALSE(next_around(net, *next).has_value());
  const auto back = next_around(net, next->reversed());
  REQUIRE(back.has_value());
  CHECK(back->pore == start.pore);
  CHECK(back->exit(net) == start.entry(net));
}

TEST_CASE("cells that do not form a network are refused by the name of the cell") {
  SUBCASE("a neighbour that is not mutual") {
    pair_of_cells p;
    p.cells[1].neighbours[0] = cell::outside;
    CHECK(has(refusal(p), "pore 0, facet 0"));
  }
  SUBCASE("a facet that does not match") {
    pair_of_cells p;
    p.cells[1].vertices[1] = vertex(grain_id(std::size_t{0}));
    CHECK(has(refusal(p), "pore 0, facet 0"));
  }
  SUBCASE("a grain out of range") {
    pair_of_cells p;
    p.cells[1].vertices[0] = vertex(grain_id(std::size_t{9}));
    CHECK(has(refusal(p), "pore 1: found vertex 9"));
  }
  SUBCASE("a neighbour out of range") {
    pair_of_cells p;
    p.cells[1].neighbours[2] = 7;
    CHECK(has(refusal(p), "pore 1, facet 2"));
  }
  SUBCASE("a wall that the region does not have") {
    pair_of_cells p;
    p.cells[0].vertices[0] = vertex(face::y_max);
    CHECK(has(refusal(p), "the wall y_max"));
  }
  SUBCASE("a cell that is turned inside out") {
    pair_of_cells p;
    std::swap(p.cells[1].vertices[1], p.cells[1].vertices[2]);
    CHECK(has(refusal(p), "pore 1: found signed volume"));
  }
  SUBCASE("a radius that is not positive") {
    pair_of_cells p;
    p.grains[3].radius = 0;
    CHECK(has(refusal(p), "grain 3: found radius"));
  }
  SUBCASE("a coordinate that is NaN") {
    pair_of_cells p;
    p.grains[2].centre.y = std::numeric_limits<double>::quiet_NaN();
    CHECK(has(refusal(p), "expected"));
  }
}

TEST_CASE("damaged arrays are refused by the name of what is damaged") {
  network net = pair_of_cells{}.make();
  network_arrays& a = net.mutable_arrays();
  SUBCASE("untouched") { CHECK(refusal(net) == "accepted"); }
  SUBCASE("a column too short") {
    a.volumes.pop_back();
    CHECK(has(refusal(net), "column volumes"));
  }
  SUBCASE("a throat that does not lead back") {
    a.pore_throats[0][2] = a.pore_throats[1][3];
    CHECK(has(refusal(net), "pore 0, facet 2"));
  }
  SUBCASE("a pore out of range") {
    a.throat_pores[6][0] = pore_id(std::size_t{5});
    CHECK(has(refusal(net), "throat 6"));
  }
  SUBCASE("an infinite volume") {
    a.void_volumes[1] = std::numeric_limits<double>::infinity();
    CHECK(has(refusal(net), "pore 1: found void volume = inf"));
  }
}

TEST_CASE("a field knows the network it belongs to") {
  const network net = pair_of_cells{}.make();
  const network later(net.arrays(), 1);
  volume_field f(net, 2.0);
  CHECK(f.belongs_to(net));
  CHECK_FALSE(f.belongs_to(later));
  CHECK(f[pore_id(std::size_t{1})] == 2.0);
}

TEST_CASE("a network follows its grains and keeps its ids") {
  const pair_of_cells p;
  network net = p.make();
  auto moved = p.grains;
  for (auto& g : moved) {
    g.centre *= 2.0;
  }
  follow(net, moved);
  CHECK(net.volume(pore_id(std::size_t{0})) == doctest::Approx(8.0 / 6).epsilon(1e-15));
  CHECK(net.epoch() == 0);
  moved.pop_back();
  CHECK_THROWS_AS(follow(net, moved), packing_error);
}

TEST_CASE("a cell in a corner of the box, with its walls given first, is put in order") {
  const domain region = walled({{0, 0, 0}, {1, 1, 1}});
  cell c;
  c.vertices = {vertex(face::x_min), vertex(face::z_min), vertex(face::y_min), vertex(grain_id(std::size_t{0}))};
  for (const auto& order : {std::array<std::size_t, 4>{0, 1, 2, 3}, std::array<std::size_t, 4>{1, 2, 0, 3}}) {
    cell d;
    for (std::size_t k = 0; k < 4; ++k) {
      d.vertices[k] = c.vertices[order[k]];
    }
    const network net(connect(region, {{{0.25, 0.5, 0.75}, 0.1}}, {d}));
    CHECK_FALSE(net.vertices(pore_id(std::size_t{0}))[0].is_wall());
    CHECK(std::abs(total_volume(pore_body_at(net, pore_id(std::size_t{0})))) ==
          doctest::Approx(0.09375).epsilon(1e-15));
    CHECK(net.throat_count() == 3);
  }
}
