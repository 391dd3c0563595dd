// SPDX-License-Identifier: BSD-3-Clause
#include "support/bridges.hpp"

#include <doctest/doctest.h>

using namespace bridges;

namespace {

using detail::chart;
using detail::profile;
using detail::sample;
using detail::surface_pair;

template <class T>
surface_pair<T> pair_of(T r2, T theta1, T theta2) {
  return {{{{T(1), std::cos(theta1), std::sin(theta1)}, {T(1) / r2, std::cos(theta2), std::sin(theta2)}}}, false};
}

/// Largest error of the derivatives of all equations against differences in long double.
template <bool Equal>
double slope_error(const surface_pair<long double>& pair, const profile<long double>& u) {
  using T = long double;
  constexpr int n = Equal ? 3 : 4;
  const auto at = detail::sample_of<24, Equal>(pair, u);
  REQUIRE(at.sound);
  double worst = 0;
  for (int column = 0; column < n; ++column) {
    const T h = 1e-5L;
    const auto moved = [&](T by) {
      T step[4]{};
      step[column] = by;
      profile<T> v = u;
      detail::move<Equal>(v, at.scale, step, T(1));
      auto s = detail::sample_of<24, Equal>(pair, v);
      // in the units of the middle
      const T ratio = s.scale / at.scale;
      for (T* x : {&s.match[0], &s.match[1], &s.gap, &s.lambda}) {
        *x *= ratio;
      }
      s.volume *= ratio * ratio * ratio;
      return s;
    };
    const auto up = moved(h);
    const auto down = moved(-h);
    const auto check = [&](T slope, T above, T below) {
      worst = std::max(worst, static_cast<double>(std::abs(slope - (above - below) / (2 * h)) / (1 + std::abs(slope))));
    };
    check(at.by[detail::gap_row][column], up.gap, down.gap);
    check(at.by[detail::volume_row][column], up.volume, down.volume);
    check(at.lambda_by[column], up.lambda, down.lambda);
    if (u.by == chart::from_contact || column != 1) {
      check(at.by[detail::match_row][column], up.match[0], down.match[0]);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("the rule of 2 N points integrates even powers up to 4 N − 2 exactly, its weights sum up to 1") {
  const auto& rule = detail::gauss<long double, 10>;
  for (int power = 0; power <= 38; power += 2) {
    long double sum = 0;
    for (std::size_t j = 0; j < 10; ++j) {
      sum += rule.weight[j] * std::pow(rule.node[j], static_cast<long double>(power));
    }
    CHECK(std::abs(sum * (power + 1) - 1) < 1e-17L);
  }
}

TEST_CASE("squared sines from one series, circular below 0 and hyperbolic above") {
  const std::array<double, 3> share{0.01, 0.5, 1.0};
  std::array<double, 3> result{};
  for (const double x : {0.001, 0.7, 1.5, 3.0, 6.0, 20.0}) {
    detail::squared_sines(x * x, share, result);
    for (std::size_t j = 0; j < 3; ++j) {
      const double s = std::sinh(x * std::sqrt(share[j]));
      CHECK(std::abs(result[j] / (s * s) - 1) < 1e-14 * (1 + x));
    }
    if (x < 1.6) {
      detail::squared_sines(-x * x, share, result);
      for (std::size_t j = 0; j < 3; ++j) {
        const double s = std::sin(x * std::sqrt(share[j]));
        CHECK(std::abs(result[j] / (-s * s) - 1) < 1e-14);
      }
    }
  }
}

TEST_CASE("derivatives of all equations in both charts agree with differences") {
  const auto pair = pair_of<long double>(0.4L, 0.3L, 0.7L);
  // thin and thick necks, k of either sign, angles beyond 0.55 of the quarter turn
  for (const auto& [k, r0] : {std::array{-2.0L, 0.15L}, std::array{3.0L, 0.2L}, std::array{40.0L, 0.12L},
                              std::array{-1.0L, 0.05L}, std::array{0.0L, 0.1L}, std::array{8.0L, 0.02L}}) {
    CAPTURE(static_cast<double>(k));
    const profile<long double> u{k, r0, {0.31L, 0.24L}, chart::from_extremum};
    CHECK(slope_error<false>(pair, u) < 1e-8);
    CHECK(slope_error<true>(pair, u) < 1e-8);
  }
  for (const auto& [k, length] : {std::array{-2.0L, 0.15L}, std::array{-1.0L, 0.6L}, std::array{-0.3L, 0.2L}}) {
    CAPTURE(static_cast<double>(k));
    const profile<long double> u{k, length, {0.5L, 0.4L}, chart::from_contact};
    CHECK(slope_error<false>(pair, u) < 1e-8);
    CHECK(slope_error<true>(pair, u) < 1e-8);
  }
}

TEST_CASE("one profile in two charts: gap, volume, force and area are the same") {
  const auto law = law_of(0.5, 0.9);
  const edge<double> e{1.0, 0.7, 0.15, {0, 0, 1}};
  const auto b = law.bridge(e, given_suction<double>{-0.4});
  REQUIRE(b.ok());
  REQUIRE_FALSE(b.value.by_length);
  const auto pair = pair_of<double>(0.7, 0.5, 0.9);
  const profile<double> neck{
      b.value.curvature, b.value.extent, {b.value.circle1, b.value.circle2}, chart::from_extremum};
  const double k = neck.k;
  const auto turned = [&](double r, double angle) {
    return std::atan2(2 * k * r * std::cos(angle), 1 + 2 * k * r * std::sin(angle));
  };
  profile<double> walk = neck;
  walk.by = chart::from_contact;
  walk.extent =
      (turned(b.value.contact1, b.value.filling1 + 0.5) + turned(b.value.contact2, b.value.filling2 + 0.9)) / (2 * k);
  const auto s = detail::sample_of<20, false>(pair, neck);
  const auto t = detail::sample_of<20, false>(pair, walk);
  REQUIRE(s.sound);
  REQUIRE(t.sound);
  CHECK(std::abs(s.gap * s.scale - t.gap * t.scale) < 1e-14);
  CHECK(std::abs(s.volume * std::pow(s.scale, 3) - t.volume * std::pow(t.scale, 3)) < 1e-14);
  CHECK(std::abs(s.lambda * s.scale - t.lambda * t.scale) < 1e-14);
  CHECK(std::abs(t.match[0]) < 1e-13);
  CHECK(std::abs(t.match[1]) < 1e-13);
  CHECK(std::abs(detail::profile_area<20>(pair, neck) - detail::profile_area<20>(pair, walk)) < 1e-13);
}

TEST_CASE("liquid between planes of one angle at the limit of a plane: a cylinder stands to π times its radius") {
  // θ = 90° is the limit of great spheres and θ near 90°: V = πr²g, lost symmetry at g = πr, g = (πV)^(1/3)
  const double theta = 0.5 * pi<double> - 1e-6;
  const auto law = law_of(theta, theta);
  const edge<double> e{1e6, 1e6, 0.0, {0, 0, 1}};
  const auto limit = law.rupture_gap(e, given_volume<double>{1.0});
  REQUIRE(limit.ok());
  CHECK(limit.value.end == bridge_end::lopsided);
  CHECK(std::abs(limit.value.gap / std::cbrt(pi<double>) - 1) < 1e-5);
}

TEST_CASE(
    "θ = 0: equal spheres turn lopsided where the profile is one period of an unduloid, from equator to equator") {
  // with half the mean curvature −(1 + q)/2 the bulges have the radius 1 of the spheres; periodic: trapezia converge
  constexpr int nodes = 4000;
  for (const double q : {1e-3, 0.01, 0.1, 0.2, 0.3, 0.38}) {
    CAPTURE(q);
    const double k = (1 + q) / 2;
    double length = 0;
    double volume = 0;
    for (int i = 0; i < nodes; ++i) {
      const double psi = 2 * pi<double> * i / nodes;
      const double z = (1 - q * std::cos(psi)) / (2 * k);
      const double r = std::sqrt(1 + q * q - 2 * q * std::cos(psi)) / (2 * k);
      length += z / r;
      volume += pi<double> * z * r;
    }
    length *= pi<double> / (k * nodes);
    volume = volume * pi<double> / (k * nodes) - 4 * pi<double> / 3;
    const auto limit = law_of(0, 0).rupture_gap(edge<double>{1.0, 1.0, 0.0, {0, 0, 1}}, given_volume<double>{volume});
    REQUIRE(limit.ok());
    CHECK(limit.value.end == bridge_end::lopsided);
    CHECK(std::abs(limit.value.gap / (length - 2) - 1) < 1e-12);
    CHECK(std::abs(limit.value.last.suction / (-2 * k) - 1) < 1e-7);
    CHECK(std::abs(limit.value.last.filling1 - pi<double> / 2) < 1e-7);
  }
}
