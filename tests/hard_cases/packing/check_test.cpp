// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/read_sizes.hpp"
#include "tetrapore/packing.hpp"

#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

using namespace tetrapore;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// Five grains in a unit box; nothing is wrong with them.
packing sound() {
  packing p;
  p.bounds = box{{0, 0, 0}, {1, 1, 1}};
  p.grains = {{{0.2, 0.2, 0.2}, 0.1},
              {{0.8, 0.2, 0.2}, 0.1},
              {{0.2, 0.8, 0.2}, 0.1},
              {{0.2, 0.2, 0.8}, 0.1},
              {{0.7, 0.7, 0.7}, 0.2}};
  return p;
}

std::string refusal(const packing& p) {
  return message_of<packing_error>([&] {
    check(p);
    return 0;
  });
}

void says(const std::string& message, std::initializer_list<const char*> parts) {
  CAPTURE(message);
  CHECK_FALSE(message.empty());
  for (const char* part : parts) {
    CAPTURE(part);
    CHECK(contains(message, part));
  }
}

}  // namespace

TEST_CASE("a sound packing passes, with walls, periodic, and without a box") {
  auto p = sound();
  CHECK(refusal(p).empty());
  p.periodic = {true, true, true};
  CHECK(refusal(p).empty());
  p.periodic = {};
  p.bounds.reset();
  CHECK(refusal(p).empty());
}

TEST_CASE("NaN, infinite coordinates and bad radii are named with the grain") {
  for (const double bad : {not_a_number, inf, -inf}) {
    auto p = sound();
    p.grains[3].centre.y = bad;
    says(refusal(p), {"grain 3", std::isnan(bad) ? "nan" : "inf", "finite coordinates"});
    p = sound();
    p.grains[2].radius = bad;
    says(refusal(p), {"grain 2", "radius", "above 0"});
  }
  for (const double bad : {0.0, -0.5}) {
    auto p = sound();
    p.grains[4].radius = bad;
    says(refusal(p), {"grain 4", "radius", "above 0"});
  }
}

TEST_CASE("fewer than four grains are refused with their number") {
  auto p = sound();
  p.grains.resize(3);
  says(refusal(p), {"found 3", "at least 4"});
  p.grains.clear();
  says(refusal(p), {"found 0"});
}

TEST_CASE("centres in a plane, on a line or at a point are refused, whatever the unit, the tilt and the offset") {
  for (const double unit : {1e-150, 1e-6, 1.0, 1e9, 1e150}) {
    for (const double offset : {0.0, 1e6}) {
      CAPTURE(unit);
      CAPTURE(offset);
      packing flat;
      packing line;
      packing thin;
      for (int i = 0; i < 30; ++i) {
        const double a = (i * 7 % 30) / 30.0;
        const double b = (i * 11 % 17) / 17.0;
        const vec3<double> shift{offset, -offset, offset};
        const auto in_plane = vec3<double>{0.36, 0.48, 0.8} * a + vec3<double>{0.8, -0.6, 0.0} * b;
        const auto normal = vec3<double>{0.48, 0.64, -0.6};
        flat.grains.push_back({(in_plane + shift) * unit, 0.01 * unit});
        line.grains.push_back({(vec3<double>{0.36, 0.48, 0.8} * (a + 0.001 * i) + shift) * unit, 0.01 * unit});
        // A sheet 1e-7 thick is thin, not flat: it is far above the rounding of these coordinates.
        thin.grains.push_back({(in_plane + normal * (i % 2 == 0 ? 0.0 : 1e-7) + shift) * unit, 0.01 * unit});
      }
      says(refusal(flat), {"one plane", "span a volume"});
      says(refusal(line), {"one line"});
      CHECK(refusal(thin).empty());
    }
  }
}

TEST_CASE("a centre outside a wall is named with its axis; on a periodic axis it is not outside") {
  auto p = sound();
  p.grains[1].centre.x = 1.0 + 1e-12;
  says(refusal(p), {"grain 1", "centre x = 1.000000000001", "from 0 to 1"});
  p.periodic[0] = true;
  CHECK(refusal(p).empty());
  p = sound();
  p.grains[1].centre.x = 1.0;  // on the wall: protrudes, and is clipped later
  CHECK(refusal(p).empty());
  p.grains[1].centre.x = -1e-300;
  says(refusal(p), {"grain 1"});
}

TEST_CASE("two grains at one place are named, modulo the box on periodic axes, and signed zeros are equal") {
  auto p = sound();
  p.grains.push_back({{0.8, 0.2, 0.2}, 0.05});
  says(refusal(p), {"grain 5", "grain 1", "different places"});
  p = sound();
  p.grains.push_back({{1.2, 0.2, 0.2}, 0.1});
  p.grains[0].centre.x = 1.2 - 1.0;
  p.periodic = {true, false, false};
  says(refusal(p), {"grain 5", "grain 0", "modulo the box"});
  p = sound();
  p.grains.push_back({{0.0, 0.5, 0.5}, 0.1});
  p.grains.push_back({{-0.0, 0.5, 0.5}, 0.1});
  says(refusal(p), {"grain 6", "grain 5"});
}

TEST_CASE("a box that is inverted, empty or not finite is refused with its axis") {
  using bounds = std::array<double, 2>;
  for (const auto& [lo, hi] : {bounds{1.0, 0.0}, bounds{0.5, 0.5}, bounds{0.0, inf}, bounds{not_a_number, 1.0}}) {
    auto p = sound();
    p.bounds->lo.z = lo;
    p.bounds->hi.z = hi;
    says(refusal(p), {"box along z", "the lower one first"});
  }
  packing p = sound();
  p.bounds.reset();
  p.periodic = {true, false, false};
  says(refusal(p), {"box", "periodic"});
  auto d = walled({{0, 0, 0}, {1, 1, 1}});
  d.faces[2] = boundary::periodic;
  says(message_of<packing_error>([&] {
         check(sound().grains, d);
         return 0;
       }),
       {"box along y", "both faces"});
}

TEST_CASE("generators refuse what they cannot do, and say what is possible") {
  const auto radii = uniform_radii(200, 1.0, 0.0);
  says(message_of<packing_error>([&] { return random_packing(radii, {.solid_fraction = 0.75}); }),
       {"0.75", "an overlap of", "a lower solid fraction"});
  CHECK_FALSE(message_of<parameter_error>([&] { return random_packing(radii, {.solid_fraction = 0.0}); }).empty());
  CHECK_FALSE(
      message_of<parameter_error>([&] { return random_packing(radii, {.solid_fraction = not_a_number}); }).empty());
  CHECK_FALSE(message_of<parameter_error>([&] { return random_packing({}, {.solid_fraction = 0.5}); }).empty());
  says(message_of<parameter_error>([&] {
         return random_packing(radii, {.solid_fraction = 0.5, .aspect = {1.0, 1.0, 0.01}});
       }),
       {"aspect", "largest radii"});
  CHECK_FALSE(message_of<parameter_error>([] { return uniform_radii(5, 1.0, 1.0); }).empty());
  CHECK_FALSE(message_of<parameter_error>([] { return uniform_radii(5, -1.0, 0.5); }).empty());
  CHECK_FALSE(message_of<parameter_error>([] { return lognormal_radii(5, 1.0, not_a_number); }).empty());
  const std::vector<mass_below> falls{{1.0, 0.0}, {0.5, 1.0}};
  CHECK_FALSE(message_of<parameter_error>([&] { return radii_by_mass(5, falls); }).empty());
  const std::vector<mass_below> open{{1.0, 0.0}, {2.0, 0.9}};
  CHECK_FALSE(message_of<parameter_error>([&] { return radii_by_mass(5, open); }).empty());
  says(message_of<packing_error>([] { return tile(sound(), {2, 1, 1}); }), {"box along x", "periodic"});
  CHECK_FALSE(message_of<parameter_error>([] { return tile(sound(), {1, 0, 1}); }).empty());
  CHECK_FALSE(message_of<parameter_error>([] { return lattice(lattice_kind::simple_cubic, {2, 0, 2}, 1.0); }).empty());
}

TEST_CASE("a message shows a small number as it is") {
  says(message_of<parameter_error>([] { return uniform_radii(5, -1e-7, 0.5); }), {"mean radius: found -1e-07"});
  says(message_of<parameter_error>([] { return uniform_radii(5, 1.0, -2e-9); }), {"spread: found -2e-09"});
  says(message_of<parameter_error>([] {
         return lattice(lattice_kind::simple_cubic, {2, 2, 2}, -1e-7);
       }),
       {"radius: found -1e-07"});
  const std::vector<double> radii{1e-4, -1e-7};
  says(message_of<parameter_error>([&] { return random_packing(radii, {.solid_fraction = 0.5}); }),
       {"radii: found -1e-07"});
  says(message_of<parameter_error>([&] { return random_packing(radii, {.solid_fraction = 0.5, .gap = 1e-13}); }),
       {"gap: found 1e-13"});
}

TEST_CASE("a grading curve whose file is wrong is refused with its line") {
  const auto refused = [](std::string_view text) {
    return message_of<input_error>([&] { return io::read_sizes_from_memory(text, "psd.csv"); });
  };
  const std::string head = "diameter_mm,cumulative_mass_fraction\n";
  CHECK(refused(head + "1,0\n2,1\n").empty());
  says(refused("d,f\n1,0\n"), {"psd.csv:1", "d,f"});
  says(refused(head + "1,0\n2,x\n"), {"psd.csv:3", "\"x\""});
  says(refused(head + "1,0\n0.5,1\n"), {"psd.csv:3", "falling"});
  says(refused(head + "1,0\n2,0.5\n"), {"psd.csv:3", "0 to 1"});
  says(refused(head + "0,0\n2,1\n"), {"psd.csv:2", "above 0"});
  says(refused(""), {"psd.csv:1", "empty"});
}
