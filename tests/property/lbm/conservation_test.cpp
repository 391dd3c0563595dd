// SPDX-License-Identifier: BSD-3-Clause
//
// Every mixture keeps mass to the last bit, and momentum in a periodic box.
#include "support/lattice_states.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

using namespace lattice_states;

namespace {

template <class T, class Model>
double worst_drift(std::size_t steps) {
  simulation<Model, T> s(repelling<Model>(), with_ball({9, 10, 11}));
  s.set_wall(3, {0.4, 0.7});
  stir(s, as_it_is);
  const double before[] = {s.mass(0), s.mass(1)};
  s.run(steps);
  return std::max(std::abs(s.mass(0) / before[0] - 1), std::abs(s.mass(1) / before[1] - 1));
}

}  // namespace

TEST_CASE_TEMPLATE("the mass of a component stays what it was, in float too", T, double, other_scalar) {
  CHECK(worst_drift<T, plain>(2000) < 1e-15);
  CHECK(worst_drift<T, unless_sanitized<mixture<d3q19, trt, guo>>>(2000) < 1e-15);
  CHECK(worst_drift<T, unless_sanitized<mixture<d3q19, regularised, guo, exponential_potential>>>(2000) < 1e-15);
}

TEST_CASE_TEMPLATE("a periodic box keeps its momentum", Model, plain, unless_sanitized<mixture<d3q19, trt, guo>>,
                   unless_sanitized<mixture<d3q27, regularised, guo>>, unless_sanitized<mixture<d2q9, bgk>>) {
  const place size = Model::lattice_type::dimensions == 2 ? place{16, 15, 1} : place{8, 9, 10};
  simulation<Model, double> s(
      repelling<Model>(), site_map<typename Model::lattice_type>(box_of(size), [](int, int, int) { return site{}; }));
  stir(s, as_it_is);
  const auto momentum = [&] {
    std::array<double, 3> sum{};
    for (std::size_t n = 0; n < s.sites().size(); ++n) {
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t i = 1; i < Model::directions; ++i) {
          for (std::size_t a = 0; a < 3; ++a) {
            sum[a] += s.population(c, n, i) * Model::lattice_type::velocity[i][a];
          }
        }
      }
    }
    return sum;
  };
  const auto before = momentum();
  s.run(200);
  const auto after = momentum();
  for (std::size_t a = 0; a < static_cast<std::size_t>(Model::lattice_type::dimensions); ++a) {
    // each of 720 nodes rounds by 2^-53 a population: a walk of 200 steps
    CHECK(std::abs(after[a] - before[a]) < 1e-12);
  }
}
