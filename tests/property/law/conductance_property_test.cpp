// SPDX-License-Identifier: BSD-3-Clause
#include "support/dual.hpp"
#include "support/throats.hpp"
#include "tetrapore/law/conductance.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <utility>

using namespace throats;

namespace {

/// A law as a user would write it: a plane slit as wide as the least gap.
struct least_gap {
  double viscosity;

  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t) const noexcept {
    if (t.grain_count != 3) {
      return {T(quiet_nan<T>), conductance_status::not_covered};
    }
    T least(infinity<T>);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& a = t.grains[k];
      const auto& b = t.grains[(k + 1) % 3];
      const T gap = norm(b.centre - a.centre) - a.radius - b.radius;
      least = gap < least ? gap : least;
    }
    if (!(least > T(0))) {
      return {T(0), conductance_status::closed};
    }
    return {least * least * least / T(static_cast<underlying_t<T>>(12 * viscosity)), conductance_status::ok};
  }
};
static_assert(conductance_law<least_gap> && conductance_law<least_gap, float>);

template <class Law>
constexpr bool for_all_scalars = conductance_law<Law, float> && conductance_law<Law, double> &&
                                 conductance_law<Law, long double> && conductance_law<Law, dual<double>>;
static_assert(for_all_scalars<hydraulic_radius> && for_all_scalars<mean_radius> && for_all_scalars<darcy> &&
              for_all_scalars<calibrated>);

/// Sum of the relative changes of K by those of the coordinates, radii and nodes relative to the size of the throat:
/// what the rounding of its numbers does, 64 for that of the law's own arithmetic.
template <class Law>
double condition(const Law& law, const throat<double>& t) {
  double extent = 0;
  for (std::size_t k = 0; k < t.grain_count; ++k) {
    extent = std::max(extent, norm(t.grains[k].centre) + t.grains[k].radius);
  }
  for (const auto& p : t.nodes) {
    extent = std::max(extent, norm(p));
  }
  double sum = 64;
  const auto add = [&](auto&& part) {
    for (std::size_t axis = 0; axis < 4; ++axis) {
      auto moving = as<dual<double>>(t);
      if (part(moving, axis)) {
        set_area(moving);
        const auto k = law.conductance(moving).value;
        sum += std::abs(k.slope / k.value) * extent;
      }
    }
  };
  for (std::size_t k = 0; k < t.grain_count; ++k) {
    add([&](auto& m, std::size_t axis) {
      (axis == 3 ? m.grains[k].radius : m.grains[k].centre[axis]).slope = 1;
      return true;
    });
  }
  for (std::size_t k = 0; k < 2; ++k) {
    add([&](auto& m, std::size_t axis) {
      if (axis < 3) {
        m.nodes[k][axis].slope = 1;
      }
      return axis < 3;
    });
  }
  for (std::size_t k = 0; k < t.wall_count(); ++k) {
    add([&](auto& m, std::size_t axis) {
      if (axis < 3) {
        m.walls[k].point[axis].slope = 1;
      }
      return axis < 3;
    });
  }
  return sum;
}

struct conformance {
  std::size_t answered = 0;
  std::size_t moved_status = 0;  ///< on the very border of two statuses
  double motion = 0;             ///< worst change under a motion, per condition
};

/// What the prose under the concept promises, for any model; `law_at(viscosity, unit)`: a law whose own lengths, if it
/// has any, are multiples of the unit.
template <class Make>
conformance examine(const Make& law_at, std::size_t count, std::uint64_t seed) {
  random_throats next(seed);
  conformance c;
  for (std::size_t i = 0; i < count; ++i) {
    const throat<double> t = next();
    const auto law = law_at(1e-3, 1.0);
    const auto answer = law.conductance(t);
    const double factor = std::pow(10.0, next.uniform(-6, 6));
    const double cube = factor * factor * factor;
    const vec3<double> by{next.uniform(-1, 1), next.uniform(-1, 1), next.uniform(-1, 1)};
    const double angle = next.uniform(-3, 3);
    CAPTURE(i);
    CAPTURE(seed);
    const std::array<std::pair<throat<double>, double>, 5> same{
        {{reversed(t), 1}, {rotated(t), 1}, {moved(t, by), 1}, {turned(t, angle), 1}, {scaled(t, factor), cube}}};
    const double allowed = answer.ok() ? 4 * epsilon<double> * condition(law, t) : 0;
    for (const auto& [other, scale] : same) {
      const auto again = (scale == 1 ? law : law_at(1e-3, factor)).conductance(other);
      if (again.reason != answer.reason) {
        ++c.moved_status;
      } else if (answer.ok()) {
        const double e = std::abs(again.value / (answer.value * scale) - 1);
        CHECK(e < allowed);
        c.motion = std::max(c.motion, e / allowed);
      }
    }
    if constexpr (hydraulic_law<decltype(law)>) {
      const auto given = law.conductance(t, hydraulics_of(t));
      CHECK(given.reason == answer.reason);
      CHECK((given.value == answer.value || (std::isnan(given.value) && std::isnan(answer.value))));
    }
    const auto thicker = law_at(2.5e-3, 1.0).conductance(t);
    CHECK(thicker.reason == answer.reason);
    switch (answer.kind()) {
      case verdict::ok:
        ++c.answered;
        CHECK(answer.value > 0);
        CHECK(std::abs(thicker.value * 2.5 / answer.value - 1) < 8 * epsilon<double>);
        break;
      case verdict::absent: CHECK(answer.value == 0); break;
      default: CHECK(std::isnan(answer.value));
    }
  }
  MESSAGE("answered " << c.answered << " of " << count << ", status moved " << c.moved_status
                      << ", worst motion over what is allowed " << c.motion);
  CHECK(c.moved_status < count / 1000 + 1);
  return c;
}

template <class Law>
double error_per_condition(const Law& law, const throat<double>& t) {
  const auto d = law.conductance(t);
  const auto exact = law.conductance(as<long double>(t));
  if (!d.ok() || !exact.ok()) {
    return 0;
  }
  return static_cast<double>(std::abs(static_cast<long double>(d.value) / exact.value - 1)) / condition(law, t);
}

}  // namespace

TEST_CASE("hydraulic_radius: same from both pores, invariant under motions, proportional to length³/viscosity") {
  CHECK(examine([](double mu, double) { return hydraulic_radius{.viscosity = mu}; }, 10000, 1).answered > 9000);
  CHECK(examine([](double mu, double) { return hydraulic_radius{.viscosity = mu, .wall = wall_condition::slip}; }, 5000,
                2)
            .answered > 4500);
}

TEST_CASE("calibrated: the same") {
  CHECK(examine([](double mu, double) { return calibrated{.viscosity = mu}; }, 10000, 3).answered > 9000);
  CHECK(examine([](double mu, double) { return calibrated{.viscosity = mu, .wall = wall_condition::slip}; }, 5000, 4)
            .answered > 4500);
}

TEST_CASE("mean_radius, darcy: the same") {
  CHECK(examine([](double mu, double) { return mean_radius{.viscosity = mu}; }, 10000, 5).answered > 9000);
  CHECK(examine([](double mu, double unit) { return darcy{.permeability = unit * unit, .viscosity = mu}; }, 10000, 6)
            .answered > 9000);
}

TEST_CASE("a law of the user conforms without registration") {
  CHECK(examine([](double mu, double) { return least_gap{mu}; }, 3000, 7).answered > 500);
}

TEST_CASE("a factor multiplies, and slip walls let more through, never less") {
  random_throats next(8);
  std::size_t with_walls = 0;
  for (int i = 0; i < 5000; ++i) {
    const throat<double> t = next();
    const auto one = hydraulic_radius{.viscosity = 1.0}.conductance(t);
    const auto slip = hydraulic_radius{.viscosity = 1.0, .wall = wall_condition::slip}.conductance(t);
    if (!one.ok() || !slip.ok()) {
      continue;
    }
    CHECK(hydraulic_radius{.viscosity = 1.0, .factor = 3.0}.conductance(t).value ==
          doctest::Approx(3 * one.value).epsilon(1e-15));
    CHECK((t.grain_count == 3 ? slip.value == one.value : slip.value > one.value));
    with_walls += t.grain_count < 3 ? 1U : 0U;
  }
  CHECK(with_walls > 1000);
}

TEST_CASE("a slip wall is a mirror: half the conductance of the two throats between the grains and their images") {
  // four equal grains, two of them images of the others: the square facet is cut along a diagonal into two
  for (const double half : {1.0, 1.1, 1.5}) {
    const double side = 2 * half;
    const throat<double> at_wall = on_a_wall({1, 1}, {half, half}, side, -0.7, 0.7);
    const throat<double> between = of_grains({1, 1, 1}, side, side, side * std::sqrt(2.0), -0.7, 0.7);
    throat<double> triangle = between;
    std::swap(triangle.grains[0], triangle.grains[1]);  // the right angle is at grain 0 of the first
    set_area(triangle);
    triangle = reversed(triangle);
    const auto k_wall = hydraulic_radius{.viscosity = 1.0, .wall = wall_condition::slip}.conductance(at_wall);
    const auto k_half = hydraulic_radius{.viscosity = 1.0}.conductance(triangle);
    REQUIRE(k_wall.ok());
    REQUIRE(k_half.ok());
    CHECK(k_wall.value == doctest::Approx(k_half.value).epsilon(1e-12));
    const auto fit_wall = calibrated{.viscosity = 1.0, .wall = wall_condition::slip}.conductance(at_wall);
    const auto fit_half = calibrated{.viscosity = 1.0}.conductance(triangle);
    CHECK(fit_wall.value == doctest::Approx(fit_half.value).epsilon(1e-12));
  }
}

TEST_CASE("random throats: no further from long double than the condition allows") {
  random_throats next(9);
  std::array<double, 4> worst{};
  for (int i = 0; i < 20000; ++i) {
    const throat<double> t = next();
    worst[0] = std::max(worst[0], error_per_condition(hydraulic_radius{.viscosity = 1.0}, t));
    worst[1] = std::max(worst[1], error_per_condition(mean_radius{.viscosity = 1.0}, t));
    worst[2] = std::max(worst[2], error_per_condition(darcy{.permeability = 1.0, .viscosity = 1.0}, t));
    worst[3] = std::max(worst[3], error_per_condition(calibrated{.viscosity = 1.0}, t));
  }
  for (const double w : worst) {
    CHECK(w < 2 * epsilon<double>);
  }
  MESSAGE("worst per condition: hydraulic_radius " << worst[0] << ", mean_radius " << worst[1] << ", darcy " << worst[2]
                                                   << ", calibrated " << worst[3]);
}

TEST_CASE("float answers as double does, to its own digits") {
  random_throats next(10);
  std::size_t compared = 0;
  for (int i = 0; i < 5000; ++i) {
    const throat<double> t = next();
    const calibrated law{.viscosity = 1.0};
    const auto d = law.conductance(t);
    const auto f = law.conductance(as<float>(t));
    if (d.ok() && f.ok()) {
      CHECK(std::abs(static_cast<double>(f.value) / d.value - 1) < 2 * epsilon<float> * condition(law, t));
      ++compared;
    }
  }
  CHECK(compared > 4000);
}

TEST_CASE(
    "calibrated: never above the hydraulic radius where the grains around the axis stand apart, and it falls as "
    "they part") {
  double last = 0;
  for (const double gap : {0.0, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0}) {
    const double d = 2 + gap;
    const throat<double> t = of_grains({1, 1, 1}, d, d, d, -d / 4, d / 4);
    const auto h = hydraulics_of(t);
    const double loss = calibrated{.viscosity = 1.0}.loss(t, h.value);
    CHECK(loss > last);
    last = loss;
    if (gap > 0.01) {
      CHECK(loss > 1);
    }
  }
  // far apart the loss grows as the ratio of fluid to solid: k falls as the inverse of the solid fraction
  const auto ratio = [](double d) {
    const throat<double> t = of_grains({1, 1, 1}, d, d, d, -d / 4, d / 4);
    const auto h = hydraulics_of(t).value;
    return calibrated{.viscosity = 1.0}.loss(t, h) * h.solid_volume / h.fluid_volume();
  };
  CHECK(ratio(1e3) == doctest::Approx(0.394).epsilon(0.01));
  CHECK(ratio(1e4) == doctest::Approx(ratio(1e3)).epsilon(0.01));
}
