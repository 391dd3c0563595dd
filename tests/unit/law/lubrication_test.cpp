// SPDX-License-Identifier: BSD-3-Clause

#include "tetrapore/law/lubrication.hpp"

#include "support/dual.hpp"
#include "support/pairs.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

using namespace tetrapore;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr vec3<double> up{0, 0, 1};

constexpr leading_order leading{.viscosity = 1e-3};
constexpr two_spheres resolved{.viscosity = 1e-3};
constexpr sphere_plane wall{.viscosity = 1e-3};

template <class Law>
pair_status reason(const Law& law, const edge<double>& e) {
  const auto answer = law.resistance(e);
  const auto& r = answer.value;
  const bool nothing = std::isnan(r.squeeze) && std::isnan(r.shear) && std::isnan(r.coupling) && std::isnan(r.roll) &&
                       std::isnan(r.twist) && std::isnan(r.arm1) && std::isnan(r.normal.x);
  const bool all = std::isfinite(r.squeeze) && std::isfinite(r.shear) && std::isfinite(r.coupling) &&
                   std::isfinite(r.roll) && std::isfinite(r.twist) && std::isfinite(r.arm1) && std::isfinite(r.arm2);
  CHECK(answer.ok() == all);
  CHECK(!answer.ok() == nothing);
  return answer.reason;
}

}  // namespace

/// log of a dual number, which a law of lubrication asks for beside the operations of `real`.
template <std::same_as<dual<double>> D>
static D log(const D& x) {
  return D(std::log(x.value), x.slope / x.value);
}

TEST_CASE("bad radii, gaps, normals and viscosities are refused, with NaN in every number") {
  const auto refuses = [](const auto& law, double other) {
    for (const double bad : {0.0, -1.0, not_a_number}) {
      CHECK(reason(law, {bad, other, 0.01, up}) == pair_status::invalid_input);
      CHECK(reason(law, {1, bad, 0.01, up}) == pair_status::invalid_input);
    }
    CHECK(reason(law, {inf, other, 0.01, up}) == pair_status::invalid_input);
    for (const double bad : {not_a_number, inf, -inf}) {
      CHECK(reason(law, {1, other, bad, up}) == pair_status::invalid_input);
      CHECK(reason(law, {1, other, 0.01, {0, bad, 1}}) == pair_status::invalid_input);
    }
    for (const double length : {0.0, 0.99, 2.0}) {  // a normal has the length 1
      CHECK(reason(law, {1, other, 0.01, up * length}) == pair_status::invalid_input);
    }
    CHECK(reason(law, {1, other, 0, up}) == pair_status::touching);
    CHECK(reason(law, {1, other, -0.1, up}) == pair_status::touching);
    CHECK(reason(law, {1, other, 0.01, up}) == pair_status::ok);
    for (const double bad : {0.0, -1.0, not_a_number, inf}) {
      auto other_law = law;
      other_law.viscosity = bad;
      CHECK(reason(other_law, {1, other, 0.01, up}) == pair_status::invalid_input);
    }
  };
  refuses(leading, 0.7);
  refuses(leading, inf);
  refuses(resolved, 0.7);
  refuses(wall, inf);
}

TEST_CASE(
    "a gap so narrow that its resistance overflows is touching, not infinity; lengths that underflow are refused") {
  CHECK(reason(leading, {1e200, 1e200, 1e-200, up}) == pair_status::touching);
  CHECK(reason(leading, {1, 1, 5e-324, up}) == pair_status::touching);
  CHECK(reason(leading, {1, 1, 1e-300, up}) == pair_status::ok);
  CHECK(reason(leading, {1e-200, 1e-200, 1e-202, up}) == pair_status::invalid_input);
  CHECK(reason(resolved, {1e-200, 1e-200, 1e-202, up}) != pair_status::ok);
}

TEST_CASE("beyond its range of radius ratios and gaps the resolved law says so") {
  CHECK(reason(resolved, {1, 0.1, 0.01, up}) == pair_status::ok);
  CHECK(reason(resolved, {0.1, 1, 0.01, up}) == pair_status::ok);
  CHECK(reason(resolved, {1, 0.0999, 0.01, up}) == pair_status::not_covered);
  CHECK(reason(resolved, {0.0999, 1, 0.01, up}) == pair_status::not_covered);
  CHECK(reason(resolved, {1, inf, 0.01, up}) == pair_status::not_covered);
  CHECK(reason(resolved, {1, 1, 1, up}) == pair_status::ok);
  CHECK(reason(resolved, {1, 1, 1.0001, up}) == pair_status::too_far);
  CHECK(reason(wall, {1, 1, 0.01, up}) == pair_status::not_covered);
  CHECK(reason(wall, {1, inf, 2, up}) == pair_status::ok);
  CHECK(reason(wall, {1, inf, 2.001, up}) == pair_status::too_far);
}

TEST_CASE("each status has a verdict and a sentence of its own") {
  std::string seen;
  for (int k = 0; k < 5; ++k) {
    const auto s = static_cast<pair_status>(k);
    CHECK(verdict_of(s) == (k == 0 ? verdict::ok : verdict::refused));
    CHECK(seen.find(std::string("|") + describe(s) + "|") == std::string::npos);
    seen += std::string("|") + describe(s) + "|";
  }
  for (int k = 1; k < 3; ++k) {
    const auto s = static_cast<film_status>(k);
    CHECK(seen.find(std::string("|") + describe(s) + "|") == std::string::npos);
    seen += std::string("|") + describe(s) + "|";
  }
  CHECK(verdict_of(film_status::step_too_long) == verdict::failed);
}

TEST_CASE("between equal grains the leading order is the paper's Eq. 2 and Eq. 3") {
  const double a = 2e-3;
  const double mu = 1e-3;
  for (const double h : {1e-9, 1e-6, 1e-4, 1e-3, 5e-3}) {
    const auto r = leading.resistance(edge<double>{a, a, h, up}).value;
    const double eq2 = 1.5 * std::numbers::pi * mu * a * a / h;
    const double eq3 = std::numbers::pi * mu / 2 * (-2 * a + (2 * a + h) * std::log((2 * a + h) / h));
    CHECK(r.squeeze == doctest::Approx(eq2).epsilon(1e-14));
    CHECK(r.shear == doctest::Approx(eq3).epsilon(1e-13));
    CHECK(r.coupling == 0);
    CHECK(r.roll == doctest::Approx(0.6 * a * a * eq3).epsilon(1e-13));
    CHECK(r.twist == 0);
    CHECK(r.arm1 == a + h / 2);
    CHECK(r.arm2 == a + h / 2);
  }
}

TEST_CASE("the logarithm of Eq. 3 keeps its digits at any gap") {
  for (const double y : {1e-12, 1e-6, 1e-3, 0.01, 0.06, 0.0624, 0.0626, 0.1, 1.0, 100.0, 1e6}) {
    const long double x = static_cast<long double>(y);
    const long double exact = x < 0.01L ? x * (0.5L - x * (1 / 6.0L - x * (1 / 12.0L - x * (1 / 20.0L - x / 30))))
                                        : (1 + 1 / x) * std::log1p(x) - 1;
    CHECK(leading_order::logarithm(y, 1 / y) ==
          doctest::Approx(static_cast<double>(exact)).epsilon(y < 1 ? 1e-13 : 1e-15));
  }
}

TEST_CASE("float and long double agree with double, and a dual number carries the slope by the gap") {
  const auto agree = [](const auto& law, const edge<double>& e, double float_error) {
    const auto d = law.resistance(e).value;
    const auto f = law.resistance(pairs::as<float>(e)).value;
    const auto l = law.resistance(pairs::as<long double>(e)).value;
    const double size = std::sqrt(d.shear * d.roll);
    CHECK(static_cast<double>(f.squeeze) == doctest::Approx(d.squeeze).epsilon(float_error));
    CHECK(static_cast<double>(f.shear) == doctest::Approx(d.shear).epsilon(float_error));
    CHECK(std::abs(static_cast<double>(f.coupling) - d.coupling) < float_error * size);
    CHECK(static_cast<double>(f.roll) == doctest::Approx(d.roll).epsilon(float_error));
    CHECK(static_cast<double>(l.squeeze) == doctest::Approx(d.squeeze).epsilon(1e-13));
    CHECK(static_cast<double>(l.shear) == doctest::Approx(d.shear).epsilon(1e-13));
    CHECK(std::abs(static_cast<double>(l.coupling) - d.coupling) < 1e-13 * size);
    CHECK(static_cast<double>(l.roll) == doctest::Approx(d.roll).epsilon(1e-13));
    edge<dual<double>> moving = pairs::as<dual<double>>(e);
    moving.gap.slope = 1;
    const auto slope = law.resistance(moving).value.shear.slope;
    const double step = 1e-6 * e.gap;
    edge<double> more = e;
    edge<double> less = e;
    more.gap += step;
    less.gap -= step;
    const double difference = (law.resistance(more).value.shear - law.resistance(less).value.shear) / (2 * step);
    CHECK(slope == doctest::Approx(difference).epsilon(1e-7));
  };
  for (const double h : {1e-5, 1e-2, 0.1}) {
    agree(leading, {1, 0.3, h, up}, 1e-5);
    agree(leading, {1, inf, h, up}, 1e-5);
    agree(resolved, {1, 0.3, h, up}, 1e-4);
    agree(wall, {1, inf, h, up}, 1e-4);
  }
}

TEST_CASE("rough grains have the law's own resistance above the height of the asperities, and a finite one below") {
  const rough<leading_order> law{.law = leading, .height = 1e-3};
  static_assert(lubrication_law<rough<leading_order>>);
  static_assert(lubrication_law<rough<two_spheres>, float>);
  const auto smooth = leading.resistance(edge<double>{1, 0.5, 2e-3, up}).value;
  const auto above = law.resistance(edge<double>{1, 0.5, 2e-3, up}).value;
  CHECK(above.squeeze == smooth.squeeze);
  CHECK(above.shear == smooth.shear);
  const auto at = leading.resistance(edge<double>{1, 0.5, 1e-3, up}).value;
  for (const double h : {1e-3, 1e-6, 0.0, -0.01}) {
    const auto below = law.resistance(edge<double>{1, 0.5, h, up});
    CHECK(below.ok());
    CHECK(below.value.squeeze == at.squeeze);
    CHECK(below.value.roll == at.roll);
    CHECK(below.value.arm1 + below.value.arm2 == doctest::Approx(1.5 + h).epsilon(1e-15));
  }
  CHECK(reason(law, {1, 0.5, -0.6, up}) == pair_status::invalid_input);
  CHECK(reason(law, {1, 0.5, not_a_number, up}) == pair_status::invalid_input);
  for (const double bad : {0.0, -1.0, not_a_number, inf}) {
    CHECK(reason(rough<leading_order>{.law = leading, .height = bad}, {1, 1, 0.1, up}) == pair_status::invalid_input);
  }
}

TEST_CASE("films and approaches with bad numbers are refused") {
  const elastic_film<double> good{1, 1, 0.1, 1};
  CHECK(step_film(good, 1.0, 0.5, 0.5, 1.0).ok());
  for (const double bad : {not_a_number, inf, -1.0}) {
    CHECK(step_film({bad, 1, 0.1, 1}, 1.0, 0.5, 0.5, 1.0).reason == film_status::invalid_input);
    CHECK(step_film({1, bad, 0.1, 1}, 1.0, 0.5, 0.5, 1.0).reason == film_status::invalid_input);
    CHECK(step_film({1, 1, bad, 1}, 1.0, 0.5, 0.5, 1.0).reason == film_status::invalid_input);
    CHECK(step_film({1, 1, 0.1, bad}, 1.0, 0.5, 0.5, 1.0).reason == film_status::invalid_input);
    CHECK(step_film(good, bad, 0.5, 0.5, 1.0).reason == film_status::invalid_input);
    CHECK(step_film(good, 1.0, 0.5, 0.5, bad).reason == film_status::invalid_input);
    CHECK(step_film(good, 1.0, 0.5, 0.5, 1.0, {film_variable::thickness, bad}).reason == film_status::invalid_input);
    CHECK(step_approach(approach<double>{bad, 0}, 1.0, 1.0, 0.0, 1.0).reason == film_status::invalid_input);
    CHECK(step_approach(approach<double>{1, 0}, bad, 1.0, 0.0, 1.0).reason == film_status::invalid_input);
    CHECK(step_approach(approach<double>{1, 0}, 1.0, bad, 0.0, 1.0).reason == film_status::invalid_input);
    CHECK(step_approach(approach<double>{1, 0}, 1.0, 1.0, 0.0, bad).reason == film_status::invalid_input);
  }
  for (const double bad : {not_a_number, inf}) {
    CHECK(step_film(good, 1.0, bad, 0.5, 1.0).reason == film_status::invalid_input);
    CHECK(step_film(good, 1.0, 0.5, bad, 1.0).reason == film_status::invalid_input);
    CHECK(step_approach(approach<double>{1, bad}, 1.0, 1.0, 0.0, 1.0).reason == film_status::invalid_input);
    CHECK(step_approach(approach<double>{1, 0}, 1.0, 1.0, bad, 1.0).reason == film_status::invalid_input);
  }
  CHECK(std::isnan(step_film(good, 0.0, 0.5, 0.5, 1.0).value));
}
