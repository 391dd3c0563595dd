// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/throat.hpp"
#include "tetrapore/lbm/tube.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

opening<double> between(double r1, double r2, double r3, double gap) {
  return opening_from_distances<double>(r1, r2, r3, r1 + r2 + gap, r1 + r3 + gap, r2 + r3 + gap).value;
}
throat_resolution resolution() {
  throat_resolution r;
  r.nodes_per_length = 14;
  r.above = r.below = 12;
  return r;
}
template <class Domain>
std::size_t fluid_nodes(const Domain& d) {
  return d.template sites<d3q19>().size();
}

opening<double> polygon(int sides) {
  opening<double> o;
  for (int k = 0; k < sides; ++k) {
    const double turn = 2 * pi<double> * k / sides - pi<double> / 2;
    const vec2<double> out{std::cos(turn), std::sin(turn)};
    o.add_line(out, out * -1.0);
  }
  return o;
}

}  // namespace

TEST_CASE("a throat with two equal grains is halved, whichever they are, and others are not") {
  const std::array<prism_side, 3> mirrors{};
  throat_resolution r = resolution();
  r.halved = true;
  for (const auto& o :
       {between(1, 1, 1, 0.2), between(1, 1, 0.7, 0.2), between(0.7, 1, 1, 0), between(1, 0.7, 1, 0.1)}) {
    const throat_on_lattice half(o, mirrors, r);
    const throat_on_lattice whole(o, mirrors, resolution());
    CHECK(half.halved());
    CHECK_FALSE(whole.halved());
    const auto nodes = static_cast<double>(fluid_nodes(whole));
    CHECK(2 * static_cast<double>(fluid_nodes(half)) == doctest::Approx(nodes).epsilon(0.05));
  }
  CHECK_FALSE(throat_on_lattice(between(1, 0.9, 0.8, 0.1), mirrors, r).halved());
}

TEST_CASE("what stands behind a side decides its face, its nodes, and which mirror halves the throat") {
  constexpr prism_side mirror = prism_side::mirror;
  constexpr prism_side wetting = prism_side::wetting;
  throat_resolution r = resolution();
  r.halved = true;
  const auto beyond = [](const throat_on_lattice& t, site_kind kind, std::uint8_t tag) {
    std::size_t count = 0;
    const int z = t.box().size[2] - 2;  // above the grains: what is no fluid lies beyond a side
    for (int x = 0; x < t.box().size[0]; ++x) {
      for (int y = 0; y < t.box().size[1]; ++y) {
        const site s = t.at(x, y, z);
        count += s.kind == kind && s.tag == tag ? 1U : 0U;
      }
    }
    return count;
  };
  // the one wetting side is cut in its middle and lies on a face, the other two stay one another's image
  const throat_on_lattice one(between(1, 1, 1, 0), {mirror, wetting, mirror}, r);
  CHECK(one.halved());
  CHECK(one.on_face(1));
  CHECK(one.box().low[1] == face_kind::wall);
  CHECK(one.box().high[0] == face_kind::mirror);
  CHECK(beyond(one, site_kind::image, 0) > 0);
  CHECK(beyond(one, site_kind::solid, liquid_wall) == 0);
  // the one mirror so
  const throat_on_lattice two(between(1, 1, 1, 0), {wetting, wetting, mirror}, r);
  CHECK(two.halved());
  CHECK(two.on_face(2));
  CHECK(two.box().low[1] == face_kind::mirror);
  CHECK(two.box().high[0] == face_kind::mirror);
  CHECK(beyond(two, site_kind::image, 0) == 0);
  CHECK(beyond(two, site_kind::solid, liquid_wall) > 0);
  // two equal grains: one wetting side leaves them each other's image if it is that between them, else not
  int halves = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<prism_side, 3> sides{};
    sides[k] = wetting;
    const throat_on_lattice t(between(1, 1, 0.7, 0.2), sides, r);
    halves += t.halved() ? 1 : 0;
    CHECK(t.halved() == (t.grain((k + 1) % 3).radius == t.grain(k).radius));
    CHECK(t.box().high[0] == (t.halved() ? face_kind::mirror : face_kind::wall));
    CHECK((t.box().low[1] == face_kind::wall) == t.on_face(k));
    CHECK((beyond(t, site_kind::solid, liquid_wall) > 0) == !t.on_face(k));
  }
  CHECK(halves == 1);
}

TEST_CASE("a plug keeps the upper reservoir from the grains, with mirrors beside it") {
  throat_resolution r = resolution();
  r.plug = 3;
  const throat_on_lattice t(between(1, 1, 1, 0.4), {}, r);
  const int top = t.box().size[2] - 1;
  std::size_t held = 0;
  for (int x = 0; x < t.box().size[0]; ++x) {
    for (int y = 0; y < t.box().size[1]; ++y) {
      const site s = t.at(x, y, top);
      if (s.kind == site_kind::reservoir) {
        ++held;
        CHECK(t.to_grains(x, y, top) >= 3);
      } else if (s.kind == site_kind::fluid) {
        CHECK(t.to_grains(x, y, top) < 3);
      }
    }
  }
  CHECK(held > 10);
  CHECK(t.box().high[2] == face_kind::mirror);
}

TEST_CASE("a reservoir keeps as far from a wetting side as from a grain, and may find no room") {
  throat_resolution r = resolution();
  r.plug = 3;
  constexpr prism_side wetting = prism_side::wetting;
  const throat_on_lattice t(between(1, 1, 1, 0.4), {wetting, prism_side::mirror, wetting}, r);
  const int top = t.box().size[2] - 1;
  std::size_t held = 0;
  std::size_t beside = 0;
  for (int x = 0; x < t.box().size[0]; ++x) {
    for (int y = 0; y < t.box().size[1]; ++y) {
      const site s = t.at(x, y, top);
      held += s.kind == site_kind::reservoir ? 1U : 0U;
      beside += s.kind == site_kind::fluid && t.to_grains(x, y, top) >= 3 ? 1U : 0U;
      CHECK((s.kind != site_kind::reservoir || t.to_walls(x, y, top) >= 3));
      CHECK((s.kind != site_kind::fluid || t.to_walls(x, y, top) < 3));
    }
  }
  CHECK(held > 10);
  CHECK(beside > 10);
  CHECK(t.has_reservoir(true));
  r.plug = 20;
  CHECK_FALSE(throat_on_lattice(between(1, 1, 1, 0.4), {wetting, wetting, wetting}, r).has_reservoir(true));
}

TEST_CASE("a fitted neck has as many nodes as it has volume") {
  for (const double nodes : {9.3, 12.0, 14.7, 19.1}) {
    CAPTURE(nodes);
    throat_resolution r = resolution();
    r.nodes_per_length = nodes;
    r.fitted = true;
    const throat_on_lattice t(between(1, 0.8, 0.7, 0.2), {}, r);
    const auto o = between(1, 0.8, 0.7, 0.2);
    const auto area = cross(o.sides[1].point - o.sides[0].point, o.sides[2].point - o.sides[0].point) / 2;
    std::size_t count = 0;
    double volume = 0;
    const int layers = std::max(1, static_cast<int>(0.3 * 0.7 * nodes));
    for (int z = -layers; z <= layers; ++z) {
      volume += area * nodes * nodes;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = o.sides[(k + 1) % 3].point - o.sides[k].point;
        const auto b = o.sides[(k + 2) % 3].point - o.sides[k].point;
        volume -= std::acos(dot(a, b) / norm(a) / norm(b)) / 2 *
                  (o.sides[k].radius * o.sides[k].radius * nodes * nodes - z * z);
      }
      for (int x = 0; x < t.box().size[0]; ++x) {
        for (int y = 0; y < t.box().size[1]; ++y) {
          count += t.at(x, y, static_cast<int>(t.middle()) + z).kind == site_kind::fluid ? 1U : 0U;
        }
      }
    }
    CHECK(static_cast<double>(count) == doctest::Approx(volume).epsilon(0.02));
  }
}

TEST_CASE("a throat or tube of more nodes than allowed is refused before it is made") {
  throat_resolution r = resolution();
  r.most_nodes = 100;
  CHECK_THROWS_WITH_AS(throat_on_lattice(between(1, 1, 1, 0), {}, r),
                       doctest::Contains("at most 100 fluid nodes: a coarser resolution or a higher limit"),
                       parameter_error);
  r.nodes_per_length = 1e6;
  CHECK_THROWS_AS(throat_on_lattice(between(1, 1, 1, 0), {}, r), parameter_error);
  CHECK_THROWS_AS(tube_on_lattice(polygon(4), {.nodes_per_length = 1e5, .length = 100}), parameter_error);
}

TEST_CASE("a tube is cut along its mirrors, and its nodes are its area") {
  for (const int sides : {3, 4, 6, 8}) {
    CAPTURE(sides);
    const double n = 40.3;
    const tube_on_lattice t(polygon(sides), {.nodes_per_length = n, .length = 4});
    CHECK(t.box().low[0] == face_kind::mirror);
    CHECK((t.box().low[1] == face_kind::mirror) == (sides != 3));
    const double area = sides * std::tan(pi<double> / sides) * n * n / (sides == 3 ? 2 : 4);
    CHECK(static_cast<double>(fluid_nodes(t)) / t.box().size[2] == doctest::Approx(area).epsilon(0.02));
  }
  opening<double> slanted;
  slanted.add_line({0, 0}, {0, 1});
  slanted.add_line({3, 0}, {-0.8, -0.6});
  slanted.add_line({0, 0}, {1, 0});
  const tube_on_lattice t(slanted, {.nodes_per_length = 20, .length = 4});
  CHECK(t.box().low[0] == face_kind::wall);
  CHECK(t.box().low[1] == face_kind::wall);
  CHECK(static_cast<double>(fluid_nodes(t)) / t.box().size[2] == doctest::Approx(0.5 * 3 * 4 * 400).epsilon(0.02));
}

TEST_CASE("what bounds no convex polygon is no tube") {
  const tube_resolution r{.nodes_per_length = 10, .length = 10};
  opening<double> open = polygon(4);
  open.count = 3;
  CHECK_THROWS_AS(tube_on_lattice(open, r), parameter_error);
  opening<double> turned;
  for (int k = 3; k-- > 0;) {
    turned.add_line(polygon(3).sides[static_cast<std::size_t>(k)].point,
                    polygon(3).sides[static_cast<std::size_t>(k)].normal);
  }
  CHECK_THROWS_AS(tube_on_lattice(turned, r), parameter_error);
  CHECK_THROWS_AS(tube_on_lattice(between(1, 1, 1, 0), r), parameter_error);
}
