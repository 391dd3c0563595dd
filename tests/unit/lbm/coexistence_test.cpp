// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/coexistence.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

constexpr coexistence pair{1.8, 1.995, 0.5, 1.003};

double potential(const coexistence& c, const std::array<double, 2>& rho, std::size_t a) {
  return std::log(rho[a]) + c.attraction * c.factor * rho[1 - a] + c.common * std::log(rho[0] + rho[1]);
}

}  // namespace

TEST_CASE("the dissolved density solves ln(a/b) = c G (a - b), down to the critical point") {
  for (const double k : {1.001, 1.1, 1.5, 3.0, 10.0, 40.0}) {
    CAPTURE(k);
    const coexistence c{k / 2, 2, 1, 1};
    const auto b = dissolved_density(c);
    REQUIRE(b.ok());
    CHECK(b.value > 0);
    CHECK(b.value < 1);
    // what a change of one unit in the last place of b does, times a few
    CHECK(std::abs(std::log(1 / b.value) - k * (1 - b.value)) < 1e-15 * (4 + 8 * k));
  }
  CHECK(dissolved_density({0.5, 2, 1, 1}).reason == coexistence_status::no_separation);
  CHECK(dissolved_density({-1, 2, 1, 1}).reason == coexistence_status::invalid_input);
  CHECK(dissolved_density({1.8, 2, 1, std::numeric_limits<double>::quiet_NaN()}).reason ==
        coexistence_status::invalid_input);
}

TEST_CASE("reservoirs have equal potentials of each component and pressures that differ by p_c") {
  const double rest = pressure_of(pair, {pair.main, dissolved_density(pair).value});
  for (const double share : {0.0, 0.5, 1.0}) {
    for (const double p : {-0.04, -0.01, 0.0, 1e-9, 0.01, 0.04}) {
      CAPTURE(share);
      CAPTURE(p);
      const auto r = reservoirs(pair, p, share);
      REQUIRE(r.ok());
      const double gas = pressure_of(pair, r.value.gas);
      const double liquid = pressure_of(pair, r.value.liquid);
      CHECK(gas - liquid == doctest::Approx(p).epsilon(1e-12).scale(rest));
      CHECK(gas == doctest::Approx(rest + share * p).epsilon(1e-12));
      for (std::size_t a = 0; a < 2; ++a) {
        CHECK(potential(pair, r.value.gas, a) ==
              doctest::Approx(potential(pair, r.value.liquid, a)).epsilon(1e-12).scale(1));
      }
      CHECK(r.value.gas[0] > r.value.gas[1]);
      CHECK(r.value.liquid[1] > r.value.liquid[0]);
    }
  }
}

TEST_CASE("without capillary pressure the reservoirs are mirror images; with the opposite one they change places") {
  const auto none = reservoirs(pair, 0);
  CHECK(none.value.gas[0] == none.value.liquid[1]);
  CHECK(none.value.gas[1] == none.value.liquid[0]);
  const auto up = reservoirs(pair, 0.03);
  const auto down = reservoirs(pair, -0.03);
  CHECK(up.value.gas[0] == doctest::Approx(down.value.liquid[1]).epsilon(1e-12));
  CHECK(up.value.liquid[0] == doctest::Approx(down.value.gas[1]).epsilon(1e-12));
}

TEST_CASE("a capillary pressure that no liquid bears is refused as dissolved") {
  for (const double p : {0.6, 1.0, 1e3, 1e300}) {
    const auto r = reservoirs(pair, p);
    CHECK(r.reason == coexistence_status::dissolved);
    CHECK(std::isnan(r.value.gas[0]));
    CHECK(r.kind() == verdict::refused);
  }
  CHECK(reservoirs(pair, std::numeric_limits<double>::infinity()).reason == coexistence_status::invalid_input);
  CHECK(reservoirs(pair, 0.01, 2).reason == coexistence_status::invalid_input);
  CHECK(reservoirs({0.3, 2, 1, 1}, 0.01).reason == coexistence_status::no_separation);
}
