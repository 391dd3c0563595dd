// SPDX-License-Identifier: BSD-3-Clause
//
// The same numbers in all storages and widths of batches; where moments alone are kept, to rounding.
#include "support/lattice_states.hpp"
#include "tetrapore/lbm/moments.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

using namespace lattice_states;

TEST_CASE_TEMPLATE("both storages and every width of batch give the same bits", T, double, other_scalar) {
  using model = plain;
  simulation<model, T, storage::in_place> one(repelling<model>(), with_ball({9, 10, 21}));
  simulation<model, T, storage::two_lattices> two(repelling<model>(), with_ball({9, 10, 21}));
  simulation<model, T, storage::in_place, 2> narrow(repelling<model>(), with_ball({9, 10, 21}));
  for (const std::size_t steps : {0U, 1U, 10U, 31U}) {
    stir(one, as_it_is);
    stir(two, as_it_is);
    stir(narrow, as_it_is);
    one.run(steps);
    two.run(steps);
    narrow.run(steps);
    std::size_t differing = 0;
    for (std::size_t n = 0; n < one.sites().size(); ++n) {
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t i = 0; i < 19; ++i) {
          differing += one.population(c, n, i) != two.population(c, n, i) ? 1U : 0U;
          differing += one.population(c, n, i) != narrow.population(c, n, i) ? 1U : 0U;
        }
      }
    }
    CHECK(differing == 0);
  }
}

namespace {

/// A ball of a wall, and every kind of face.
site_map<d3q19> bounded(const place& size) {
  lattice_box box = box_of(size);
  box.low[0] = face_kind::mirror;
  box.high[0] = box.low[2] = face_kind::wall;
  box.high[2] = face_kind::mirror;
  return {box, [size](int x, int y, int z) {
            const double d = std::hypot(x - 0.4 * size[0], y - 0.5 * size[1], z - 0.6 * size[2]);
            return site{d < 3                          ? site_kind::solid
                        : y == 2 && (z > 15 || z == 0) ? site_kind::reservoir
                                                       : site_kind::fluid,
                        3};
          }};
}

/// The worst difference of densities and velocities after so many steps.
template <class T>
double difference_of_moments(const site_map<d3q19>& map, std::size_t steps) {
  using model = plain;
  model m = repelling<model>();
  for (auto& c : m.collisions) {
    c.tau = 1;
  }
  simulation<model, T, storage::in_place> all(m, map);
  simulation<model, T, storage::moments> few(m, map);
  const auto begin = [](auto& s) {
    s.set_wall(0, {0.2, 0.6});
    s.set_wall(3, {0.4, 0.7});
    s.set_reservoir(3, {0.5, 0.55});
    s.set_gravity({1e-4, 0, -1e-4});
    stir(s, as_it_is);
  };
  begin(all);
  begin(few);
  all.run(steps);
  few.run(steps);
  double worst = 0;
  for (std::size_t n = 0; n < all.sites().size(); ++n) {
    for (std::size_t c = 0; c < 2; ++c) {
      worst = std::max(worst, std::abs(all.density(c, n) - few.density(c, n)));
    }
    for (std::size_t a = 0; a < 3; ++a) {
      worst = std::max(worst, std::abs(all.velocity(n)[a] - few.velocity(n)[a]));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE_TEMPLATE("density and momentum alone are the same fluid to rounding", T, double, other_scalar) {
  const double rounding = std::is_same_v<T, double> ? 0x1p-53 : 0x1p-24;
  for (const std::size_t steps : {0U, 1U, 2U, 21U}) {
    // 38 populations of a node round in each step, and what they differ by is damped
    CHECK(difference_of_moments<T>(with_ball({9, 10, 21}), steps) < 38 * rounding * static_cast<double>(steps + 1));
    CHECK(difference_of_moments<T>(bounded({9, 10, 21}), steps) < 38 * rounding * static_cast<double>(steps + 1));
  }
}

TEST_CASE("boxes in strips that fit in a small cache, and batches of 64 bytes, give the same bits") {
  plain m = repelling<plain>();
  for (auto& c : m.collisions) {
    c.tau = 1;
  }
  for (const auto& map : {with_ball({9, 10, 21}), bounded({9, 11, 21}), with_ball({2, 9, 11}), with_ball({1, 4, 11})}) {
    simulation<plain, double, storage::moments> one(m, map);
    simulation<plain, double, storage::moments> many(m, map, 1);      // of two rows or three
    constexpr int lanes = sanitized ? native_lanes<double> : 8;       // another width takes long to compile
    simulation<plain, double, storage::moments, lanes> wide(m, map);  // the ends of rows in half a batch
    const auto begin = [](auto& s) {
      s.set_wall(3, {0.4, 0.7});
      s.set_reservoir(3, {0.5, 0.55});
      stir(s, as_it_is);
    };
    begin(one);
    begin(many);
    begin(wide);
    one.run(5);
    many.run(5);
    wide.run(5);
    std::size_t differing = 0;
    for (std::size_t n = 0; n < map.size(); ++n) {
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
          differing += one.moment(c, n, k) != many.moment(c, n, k) ? 1U : 0U;
          differing += one.moment(c, n, k) != wide.moment(c, n, k) ? 1U : 0U;
        }
      }
    }
    CHECK(differing == 0);
  }
}

TEST_CASE_TEMPLATE("density and momentum alone keep the mass to the last bit", T, double, other_scalar) {
  plain m = repelling<plain>();
  for (auto& c : m.collisions) {
    c.tau = 1;
  }
  simulation<plain, T, storage::moments> s(m, with_ball({9, 10, 11}));
  s.set_wall(3, {0.4, 0.7});
  stir(s, as_it_is);
  const double before[] = {s.mass(0), s.mass(1)};
  s.run(1000);
  CHECK(std::abs(s.mass(0) / before[0] - 1) < 1e-15);
  CHECK(std::abs(s.mass(1) / before[1] - 1) < 1e-15);
}

TEST_CASE("a relaxation time that leaves more than moments is refused where they alone are kept") {
  using kept = simulation<plain, double, storage::moments>;
  CHECK_THROWS_AS(kept(repelling<plain>(0.8), with_ball({9, 10, 11})), tetrapore::parameter_error);
}
