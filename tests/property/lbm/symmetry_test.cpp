// SPDX-License-Identifier: BSD-3-Clause
//
// A step commutes with mirrors on the axes to the last bit, with rotations and diagonal mirrors to rounding.
#include "support/lattice_states.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

using namespace lattice_states;

TEST_CASE_TEMPLATE("the mirror image of a state stays the mirror image, to the last bit", Model, plain,
                   unless_sanitized<mixture<d3q19, trt, guo>>, unless_sanitized<mixture<d3q27, regularised, guo>>) {
  using map_type = site_map<typename Model::lattice_type>;
  const place size{8, 6, 7};
  const auto all_fluid = [](int, int, int) { return site{}; };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    simulation<Model, double> here(repelling<Model>(), map_type(box_of(size), all_fluid));
    simulation<Model, double> there(repelling<Model>(), map_type(box_of(size), all_fluid));
    const auto image = [&](place p) {
      p[axis] = size[axis] - 1 - p[axis];
      return p;
    };
    stir(here, as_it_is);
    stir(there, image, [&](auto u) {
      u[axis] = -u[axis];
      return u;
    });
    here.run(50);
    there.run(50);
    std::size_t differing = 0;
    for (std::size_t n = 0; n < here.sites().size(); ++n) {
      const place p = image(here.sites().place(n));
      const auto m = static_cast<std::size_t>(there.sites().node_at(p[0], p[1], p[2]));
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t i = 0; i < Model::directions; ++i) {
          const int j = mirrored<typename Model::lattice_type>(static_cast<int>(i), static_cast<int>(axis));
          differing += here.population(c, n, i) != there.population(c, m, static_cast<std::size_t>(j)) ? 1U : 0U;
        }
      }
    }
    CAPTURE(axis);
    CHECK(differing == 0);
  }
}

TEST_CASE("a box between mirrors is a quarter of the periodic box of all its images, to the last bit") {
  using model = plain;
  const place size{5, 7, 6};
  const auto all_fluid = [](int, int, int) { return site{}; };
  lattice_box part = box_of(size, face_kind::mirror);
  part.low[2] = part.high[2] = face_kind::periodic;
  simulation<model, double> quarter(repelling<model>(), {part, all_fluid});
  simulation<model, double> whole(repelling<model>(), {box_of({10, 14, 6}), all_fluid});
  const auto fold = [&](const place& p) {
    return place{p[0] < 5 ? p[0] : 9 - p[0], p[1] < 7 ? p[1] : 13 - p[1], p[2]};
  };
  const auto rest = [&](auto& s) {
    s.initialise([&](const place& p, auto& rho, auto&) {
      rho[0] = 0.2 + 0.7 * noise(fold(p), 1);
      rho[1] = 0.2 + 0.7 * noise(fold(p), 2);
    });
  };
  rest(quarter);
  rest(whole);
  quarter.run(41);
  whole.run(41);
  std::size_t differing = 0;
  for (std::size_t n = 0; n < quarter.sites().size(); ++n) {
    const place p = quarter.sites().place(n);
    const auto m = static_cast<std::size_t>(whole.sites().node_at(p[0], p[1], p[2]));
    for (std::size_t i = 0; i < 19; ++i) {
      differing += quarter.population(0, n, i) != whole.population(0, m, i) ? 1U : 0U;
      differing += quarter.population(1, n, i) != whole.population(1, m, i) ? 1U : 0U;
    }
  }
  CHECK(differing == 0);
}

TEST_CASE("a box that is turned or seen in a diagonal mirror stays its image, to rounding") {
  using model = unless_sanitized<mixture<d3q19, trt, guo>>;
  const place size{6, 7, 8};
  const auto all_fluid = [](int, int, int) { return site{}; };
  simulation<model, double> here(repelling<model>(), {box_of(size), all_fluid});
  stir(here, as_it_is);
  here.run(40);
  // axis a of the image is axis from[a] of what it shows, seen backwards where so said
  struct view {
    std::array<std::size_t, 3> from;
    std::array<bool, 3> backwards;
  };
  for (const view& v : {view{{1, 0, 2}, {false, true, false}},    // a right angle about z
                        view{{0, 2, 1}, {false, true, false}},    // about x
                        view{{1, 2, 0}, {false, false, false}},   // a third of a turn about a diagonal
                        view{{1, 0, 2}, {false, false, false}},   // the mirror x = y
                        view{{0, 2, 1}, {false, true, true}}}) {  // the mirror y = −z
    place seen_size{};
    for (std::size_t a = 0; a < 3; ++a) {
      seen_size[a] = size[v.from[a]];
    }
    const auto shown = [&](const place& p) {
      place q{};
      for (std::size_t a = 0; a < 3; ++a) {
        q[v.from[a]] = v.backwards[a] ? seen_size[a] - 1 - p[a] : p[a];
      }
      return q;
    };
    const auto seen = [&](const std::array<double, 3>& u) {
      std::array<double, 3> image{};
      for (std::size_t a = 0; a < 3; ++a) {
        image[a] = (v.backwards[a] ? -1 : 1) * u[v.from[a]];
      }
      return image;
    };
    simulation<model, double> there(repelling<model>(), {box_of(seen_size), all_fluid});
    stir(there, shown, seen);
    there.run(40);
    double worst = 0;
    for (std::size_t n = 0; n < there.sites().size(); ++n) {
      const place p = shown(there.sites().place(n));
      const auto m = static_cast<std::size_t>(here.sites().node_at(p[0], p[1], p[2]));
      for (std::size_t c = 0; c < 2; ++c) {
        worst = std::max(worst, std::abs(here.density(c, m) - there.density(c, n)));
      }
      const auto u = seen(here.velocity(m));
      for (std::size_t a = 0; a < 3; ++a) {
        worst = std::max(worst, std::abs(u[a] - there.velocity(n)[a]));
      }
    }
    CHECK(worst < 1e-13);
  }
}
