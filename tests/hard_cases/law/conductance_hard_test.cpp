// SPDX-License-Identifier: BSD-3-Clause
#include "support/throats.hpp"
#include "tetrapore/law/conductance.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace throats;

namespace {

const hydraulic_radius by_radius{.viscosity = 1.0};
const calibrated by_fit{.viscosity = 1.0};

/// Relative distance of the answer in double from that in long double.
template <class Law>
double error(const Law& law, const throat<double>& t) {
  const auto d = law.conductance(t);
  const auto exact = law.conductance(as<long double>(t));
  REQUIRE(d.ok());
  REQUIRE(exact.ok());
  return static_cast<double>(std::abs(static_cast<long double>(d.value) / exact.value - 1));
}

/// How much of the volume of the domain is fluid: its inverse is what the difference of the volumes loses.
double cancellation(const throat<double>& t) {
  const auto h = hydraulics_of(t).value;
  return h.domain_volume / std::abs(h.fluid_volume());
}

}  // namespace

TEST_CASE("radii 1 : 1000, on either side: the answer keeps its digits") {
  random_throats next(1);
  std::size_t answered = 0;
  for (int i = 0; i < 3000; ++i) {
    const double large = std::pow(10.0, next.uniform(0, 3));
    const bool two = i % 2 == 0;
    const std::array<double, 3> r{1.0, two ? large : 1.0, large};
    const auto gap = [&] { return next.uniform(0, 0.1); };
    const throat<double> t = of_grains(r, r[0] + r[1] + gap(), r[0] + r[2] + gap(), r[1] + r[2] + gap(), -0.5, 0.4);
    if (!by_radius.conductance(t).ok()) {
      continue;
    }
    ++answered;
    // areas and volumes are differences of numbers as large as the square and the cube of the largest radius
    const auto h = hydraulics_of(t).value;
    const double lost = large * large / h.fluid_area + h.solid_volume / h.fluid_volume() + cancellation(t);
    CAPTURE(large);
    CHECK(error(by_radius, t) < 16 * epsilon<double> * (1 + lost));
    CHECK(error(by_fit, t) < 16 * epsilon<double> * (1 + lost));
  }
  CHECK(answered > 1000);
}

TEST_CASE("slivers: three centres that are nearly collinear, two nodes that are far off or close together") {
  for (const double sliver : {1e-2, 1e-4, 1e-6}) {
    // touching 1, 1 and a small grain almost between them
    const double d = 2 + sliver;
    const throat<double> t = of_grains({1, 1, sliver}, 2.0, 1 + sliver, d * 0.5 + sliver, -sliver, sliver);
    const auto k = by_radius.conductance(t);
    CAPTURE(sliver);
    CHECK((k.ok() ? k.value > 0 : k.reason != conductance_status::invalid_input));
  }
  for (const double apart : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const throat<double> t = of_grains({1, 1, 1}, 2.1, 2.1, 2.1, 0.0, apart);
    CAPTURE(apart);
    // K is the inverse of the distance of the nodes, with all digits: R_h is a ratio of two numbers that vanish alike
    CHECK(error(by_radius, t) < 64 * epsilon<double>);
    CHECK(error(by_fit, t) < 64 * epsilon<double>);
    CHECK(by_radius.conductance(t).value * apart ==
          doctest::Approx(by_radius.conductance(of_grains({1, 1, 1}, 2.1, 2.1, 2.1, 0.0, 1e-9)).value * 1e-9)
              .epsilon(2 * apart + 1e-8));
  }
  for (const double far : {1e2, 1e4, 1e6}) {
    const throat<double> t = of_grains({1, 1, 1}, 2.1, 2.1, 2.1, 0.4, far);
    CHECK(error(by_radius, t) < 64 * epsilon<double>);
    CHECK(error(by_fit, t) < 64 * epsilon<double>);
  }
}

TEST_CASE("a million box lengths from the origin: what is lost is the rounding of the coordinates") {
  random_throats next(2);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const throat<double> t = next();
    // move by multiples of a power of two and keep the coordinates on a grid, so that the motion is exact
    const double grid = 0x1p-28;
    throat<double> near = t;
    const auto snap = [&](vec3<double>& v) {
      for (std::size_t k = 0; k < 3; ++k) {
        v[k] = std::round(v[k] / grid) * grid;
      }
    };
    for (std::size_t k = 0; k < t.grain_count; ++k) {
      snap(near.grains[k].centre);
    }
    for (auto& n : near.nodes) {
      snap(n);
    }
    set_area(near);
    const throat<double> away = moved(near, {1048576.0, -2097152.0, 1048576.0});
    for (const bool fit : {false, true}) {
      const auto a = fit ? by_fit.conductance(near) : by_radius.conductance(near);
      const auto b = fit ? by_fit.conductance(away) : by_radius.conductance(away);
      CHECK(a.reason == b.reason);
      if (a.ok() && b.ok()) {
        worst = std::max(worst, std::abs(b.value / a.value - 1));
        CHECK(std::abs(b.value / a.value - 1) < 64 * epsilon<double> * cancellation(near));
      }
    }
  }
  MESSAGE("worst change under an exact motion of a million lengths " << worst);
}

TEST_CASE("the unit of length does not matter, from 1e-6 to 1e6, to the last digits and in every status") {
  random_throats next(3);
  for (int i = 0; i < 3000; ++i) {
    const throat<double> t = next();
    const auto k = by_fit.conductance(t);
    for (const double unit : {0x1p-20, 0x1p20}) {  // about 1e-6 and 1e6; a power of two rounds nothing
      const auto other = by_fit.conductance(scaled(t, unit));
      CHECK(other.reason == k.reason);
      CHECK((!k.ok() || other.value == k.value * unit * unit * unit));
    }
  }
}

TEST_CASE("grains that just close the facet: no jump to a wrong number, closed or a vanishing conductance") {
  // equal grains whose discs meet at the middle of the facet at d = r √3
  for (const double open : {1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 0.0, -1e-8, -1e-2}) {
    const double d = std::sqrt(3.0) * (1 + open);
    const auto k = mean_radius{.viscosity = 1.0}.conductance(of_grains({1, 1, 1}, d, d, d, -1.0, 1.0));
    CAPTURE(open);
    CHECK((k.ok() || k.reason == conductance_status::closed || k.reason == conductance_status::no_inscribed_circle));
    if (k.ok()) {
      CHECK(k.value < 10 * open * open);
    }
  }
}
