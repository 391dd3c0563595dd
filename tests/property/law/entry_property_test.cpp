// SPDX-License-Identifier: BSD-3-Clause
#include "support/condition.hpp"
#include "support/dual.hpp"
#include "support/openings.hpp"
#include "tetrapore/law/entry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

using namespace openings;

namespace {

/// A law as a user would write it: one gap decides.
struct widest_gap {
  double surface_tension;

  template <real T>
  [[nodiscard]] outcome<T, entry_status> entry_pressure(const opening<T>& o) const noexcept {
    T widest = T(0);
    for (std::size_t k = 0; k < o.count; ++k) {
      const auto& s = o.sides[k];
      const auto& t = o.sides[o.next(k)];
      if (s.kind != side_kind::disc || t.kind != side_kind::disc) {
        return {T(quiet_nan<T>), entry_status::not_covered};
      }
      const T gap = norm(t.point - s.point) - s.radius - t.radius;
      widest = gap > widest ? gap : widest;
    }
    if (!(widest > T(0))) {
      return {T(infinity<T>), entry_status::closed};
    }
    return {T(static_cast<underlying_t<T>>(2 * surface_tension)) / widest, entry_status::ok};
  }
};
static_assert(entry_law<widest_gap> && !gap_aware_entry_law<widest_gap>);

static_assert(entry_law<inscribed_circle, float> && entry_law<inscribed_circle, long double>);
static_assert(entry_law<mayer_stowe_princen, float> && entry_law<mayer_stowe_princen, long double>);
static_assert(entry_law<mayer_stowe_princen, dual<double>> && entry_law<inscribed_circle, dual<double>>);
static_assert(gap_aware_entry_law<mayer_stowe_princen> && gap_aware_entry_law<lost_arc<mayer_stowe_princen>>);
static_assert(entry_law<mirror_sided<mayer_stowe_princen>> && !gap_aware_entry_law<inscribed_circle>);

struct conformance {
  std::size_t answered = 0;
  std::size_t moved_status = 0;  ///< the status changed under a motion: allowed on the very border of two of them
  double motion = 0;             ///< worst relative change under permutation, rotation, translation, scaling
};

double change(const outcome<double, entry_status>& a, const outcome<double, entry_status>& b, double factor = 1) {
  return a.value == b.value * factor ? 0.0 : std::abs(a.value / (b.value * factor) - 1);
}

/// Width of the narrowest part, relative to the whole.
double fineness(const opening<double>& o, double pressure) { return 1 / (pressure * extent(o)); }

/// Relative change of the answer by the relative change of one coordinate of the opening, summed over them: how much of
/// the rounding of the coordinates the answer must show. By differences, so infinite on the border of two statuses.
template <class Law>
double steepness(const Law& law, const opening<double>& o) {
  constexpr double h = 1e-9;
  const auto answer = law.entry_pressure(o);
  const double step = h * extent(o);
  double sum = 1;
  for (std::size_t k = 0; k < o.count; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      auto moved_by = o;
      auto& s = moved_by.sides[k];
      (axis == 0 ? s.point.x : axis == 1 ? s.point.y : s.radius) += step;
      const auto again = law.entry_pressure(moved_by);
      sum += again.reason == answer.reason ? std::abs(again.value / answer.value - 1) / h : infinity<double>;
    }
  }
  return sum;
}

/// The circle is the widest around its centre: its three sides surround it.
bool surrounded(const opening<double>& o) {
  std::array<bounding_side2<double>, 3> sides;
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] = {o.sides[k].point, o.sides[k].normal, o.sides[k].radius, o.sides[k].kind == side_kind::line};
  }
  const auto c = circle_between(sides).value.centre;
  std::array<vec2<double>, 3> away;
  for (std::size_t k = 0; k < 3; ++k) {
    away[k] = sides[k].flat ? sides[k].normal : c - sides[k].point;
  }
  return cross(away[0], away[1]) > 0 && cross(away[1], away[2]) > 0 && cross(away[2], away[0]) > 0;
}

/// `grows(opening, angle)`: the pressure must not fall when a disc of this opening grows.
template <class Make, class Grows>
conformance examine(const Make& law_at, std::size_t count, std::uint64_t seed, const Grows& grows) {
  random_throats next(seed);
  conformance c;
  for (std::size_t i = 0; i < count; ++i) {
    const auto o = next();
    const double angle = next.contact_angle();
    const auto law = law_at(1.0, angle);
    const auto answer = law.entry_pressure(o);
    const double shift = next.uniform(-1, 1) * extent(o);
    const double factor = std::pow(10.0, next.uniform(-6, 6));
    const std::array<std::pair<opening<double>, double>, 5> same{
        {{rotated(o, 1), 1},
         {rotated(o, 2), 1},
         {mirrored(o), 1},
         {turned(moved(o, {shift, -shift}), next.uniform(-3, 3)), 1},
         {scaled(o, factor), factor}}};
    CAPTURE(i);
    CAPTURE(seed);
    for (const auto& [other, by] : same) {
      const auto again = law.entry_pressure(other);
      if (again.reason != answer.reason) {
        ++c.moved_status;
      } else if (answer.ok()) {
        const double e = change(answer, again, by);
        c.motion = std::max(c.motion, e);
        if (e > 256 * epsilon<double>) {
          CHECK(e < 256 * epsilon<double> * steepness(law, o));
        }
      }
    }
    const auto stronger = law_at(2.5, angle).entry_pressure(o);
    CHECK(stronger.reason == answer.reason);
    if (!answer.ok()) {
      CHECK((answer.reason == entry_status::closed ? answer.value == infinity<double> : std::isnan(answer.value)));
      continue;
    }
    ++c.answered;
    CHECK(answer.value > 0);
    CHECK(change(stronger, answer, 2.5) < 4 * epsilon<double>);
    if (grows(o, angle)) {
      for (std::size_t k = 0; k < o.count; ++k) {
        if (o.sides[k].kind == side_kind::disc) {
          auto grown = o;
          grown.sides[k].radius *= 1 + std::pow(10.0, next.uniform(-6, -1));
          const auto higher = law.entry_pressure(grown);
          if (higher.kind() != verdict::refused && grows(grown, angle)) {
            CHECK(higher.value >= answer.value * (1 - 1e-11));
          }
        }
      }
    }
  }
  return c;
}

const auto never = [](const opening<double>&, double) { return false; };

const auto msp = [](double tension, double angle) {
  return mayer_stowe_princen{.surface_tension = tension, .contact_angle = angle};
};

}  // namespace

TEST_CASE(
    "mayer_stowe_princen: proportional to σ/length, invariant under motions, at θ = 0 never lower when a grain grows") {
  // With a contact angle the arcs shorten when a small disc with a short wetted arc grows, and the pressure may fall:
  // dF/dR = (R + r cos θ) e − 2 r sin θ. Without one it is never negative.
  const auto c = examine(msp, 100000, 1, [](const opening<double>&, double angle) { return angle == 0; });
  CHECK(c.answered > 40000);
  CHECK(c.moved_status < 20);
  MESSAGE("answered " << c.answered << ", worst change under a motion " << c.motion << ", status moved "
                      << c.moved_status);
}

TEST_CASE("inscribed_circle: the same properties") {
  const auto c = examine(
      [](double tension, double angle) { return inscribed_circle{.surface_tension = tension, .contact_angle = angle}; },
      100000, 2, [](const opening<double>& o, double) { return surrounded(o); });
  CHECK(c.answered > 80000);
  CHECK(c.moved_status < 20);
}

TEST_CASE("lost_arc and mirror_sided: the same properties") {
  const auto arc = examine([](double t, double a) { return lost_arc{msp(t, a)}; }, 20000, 3, never);
  CHECK(arc.answered > 16000);
  CHECK(arc.moved_status < 20);
  const auto sides = examine([](double t, double a) { return mirror_sided{msp(t, a)}; }, 10000, 4, never);
  CHECK(sides.moved_status < 20);
}

TEST_CASE("a law of the user conforms without registration") {
  const auto c = examine([](double t, double) { return widest_gap{t}; }, 5000, 5, never);
  CHECK(c.answered > 2000);
}

TEST_CASE("mayer_stowe_princen always says ok, closed or why not: it never fails to converge") {
  random_throats next(6);
  std::array<std::size_t, 10> seen{};
  for (int i = 0; i < 300000; ++i) {
    const auto answer = msp(1, next.contact_angle()).entry_pressure(next());
    ++seen[static_cast<std::size_t>(answer.reason)];
  }
  CHECK(seen[static_cast<std::size_t>(entry_status::not_converged)] == 0);
  CHECK(seen[static_cast<std::size_t>(entry_status::invalid_input)] == 0);
  CHECK(seen[static_cast<std::size_t>(entry_status::not_covered)] == 0);
  CHECK(seen[static_cast<std::size_t>(entry_status::ok)] > 100000);
  CHECK(seen[static_cast<std::size_t>(entry_status::gap_limited)] > 1000);
  CHECK(seen[static_cast<std::size_t>(entry_status::dry_corner)] > 100);
  CHECK(seen[static_cast<std::size_t>(entry_status::no_hole)] > 100);
}

TEST_CASE("random throats: no further from long double than stated_accuracy times the condition") {
  random_throats next(7);
  std::size_t compared = 0;
  double worst = 0;
  double worst_circle = 0;
  const auto far = [](const auto& law, const opening<double>& o) {
    const auto d = law.entry_pressure(o);
    const auto l = law.entry_pressure(as<long double>(o));
    return d.ok() && l.ok() ? static_cast<double>(std::abs(d.value / l.value - 1)) / condition(law, o) : 0.0;
  };
  for (int i = 0; i < 100000; ++i) {
    const auto o = next();
    const double angle = next.contact_angle();
    CAPTURE(i);
    const double e = far(msp(1, angle), o);
    CHECK(e <= mayer_stowe_princen::stated_accuracy);
    worst = std::max(worst, e);
    compared += e > 0 ? 1U : 0U;
    const double circle = far(inscribed_circle{.surface_tension = 1.0, .contact_angle = angle}, o);
    CHECK(circle <= inscribed_circle::stated_accuracy);
    worst_circle = std::max(worst_circle, circle);
  }
  CHECK(compared > 40000);
  MESSAGE("worst per condition: mayer_stowe_princen " << worst << ", inscribed_circle " << worst_circle);
}

TEST_CASE("float answers as double does, to its own digits") {
  random_throats next(7);
  std::size_t compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto o = next();
    const double angle = next.contact_angle();
    const auto d = msp(1, angle).entry_pressure(o);
    const auto f = msp(1, angle).entry_pressure(as<float>(o));
    const double fine = d.ok() ? std::min(1.0, fineness(o, d.value)) : 0;
    if (f.ok() && fine > 1e-3) {
      CHECK(std::abs(static_cast<double>(f.value) / d.value - 1) * fine < 2e-4);
      ++compared;
    }
  }
  CHECK(compared > 10000);
}

TEST_CASE("the derivative for moving grains agrees with differences in long double and with a dual number") {
  random_throats next(8);
  std::size_t compared = 0;
  for (int i = 0; i < 4000; ++i) {
    auto o = next();
    const double angle = next.contact_angle();
    const auto law = msp(1, angle);
    // Some gaps open, where they have a width that a difference cannot close.
    for (std::size_t k = 0; k < 3; ++k) {
      const bool discs = o.sides[k].kind == side_kind::disc && o.sides[o.next(k)].kind == side_kind::disc;
      const double width =
          discs ? norm(o.sides[k].point - o.sides[o.next(k)].point) - o.sides[k].radius - o.sides[o.next(k)].radius
                : 0.0;
      o.gaps[k] = i % 4 == 0 && width > 0.01 ? gap_state::open : gap_state::liquid;
    }
    const auto slope = law.derivative(o);
    const auto value = law.entry_pressure(o);
    CHECK(slope.reason == value.reason);
    if (!value.ok() || fineness(o, value.value) < 1e-3) {
      continue;
    }
    CHECK(slope.value.pressure == doctest::Approx(value.value).epsilon(1e-13));
    CAPTURE(i);
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      size = std::max({size, norm(slope.value.by_centre[k]), std::abs(slope.value.by_radius[k])});
    }
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        if (o.sides[k].kind == side_kind::line) {
          continue;
        }
        const auto with = [&](auto zero, auto step) {
          using T = decltype(zero);
          auto p = as<T>(o);
          auto& s = p.sides[k];
          auto& x = axis == 0 ? s.point.x : (axis == 1 ? s.point.y : s.radius);
          x = x + step;
          return law.entry_pressure(p);
        };
        const double computed = axis == 0   ? slope.value.by_centre[k].x
                                : axis == 1 ? slope.value.by_centre[k].y
                                            : slope.value.by_radius[k];
        const auto dualed = with(dual<double>(), dual<double>(0, 1));
        CHECK(std::abs(dualed.value.slope - computed) < 1e-8 * size);
        const long double h = 1e-8L / static_cast<long double>(value.value);
        const auto a = with(0.0L, h);
        const auto b = with(0.0L, -h);
        if (a.ok() && b.ok()) {
          const auto difference = static_cast<double>((a.value - b.value) / (2 * h));
          CHECK(std::abs(difference - computed) < 1e-5 * size);
          ++compared;
        }
      }
    }
  }
  CHECK(compared > 10000);
}

TEST_CASE("merging two openings keeps the shape: halves of a square ring give the square back") {
  for (const double angle : {0.0, 0.5, 1.0}) {
    for (const double gap : {0.0, 0.05, 0.2}) {
      CAPTURE(angle);
      CAPTURE(gap);
      const double side = 2 + gap;
      const double diagonal = side * std::sqrt(2.0);
      const auto half = opening_from_distances(1.0, 1.0, 1.0, diagonal, side, side).value;
      const auto ring = merge(half, 0, half, 0);
      REQUIRE(ring.ok());
      CHECK(ring.value.count == 4);
      const auto expected = msp(1, angle).entry_pressure(ring_of_discs(4, 1.0, gap).value);
      const auto merged = msp(1, angle).entry_pressure(ring.value);
      CHECK(merged.reason == expected.reason);
      CHECK(merged.value == doctest::Approx(expected.value).epsilon(1e-13));
    }
  }
}

TEST_CASE("merging wall facets, and three facets in any order") {
  // Two rods on a plate cut in the middle by nothing: one disc above a plate, merged with its mirror image at the foot.
  opening<double> right;
  right.add_disc({0, 0}, 1);
  right.add_line({0, -1.3}, {0, 1});
  right.add_disc({2.1, 0.1}, 1.1);
  opening<double> left;
  left.add_disc({0, 0}, 1);
  left.add_disc({-2.05, 0.2}, 1.05);
  left.add_line({0, -1.3}, {0, 1});
  const auto ring = merge(right, 0, left, 2);
  REQUIRE(ring.ok());
  CHECK(ring.value.count == 4);
  const auto other = merge(left, 2, right, 0);
  REQUIRE(other.ok());
  for (const double angle : {0.0, 0.4}) {
    const auto a = msp(1, angle).entry_pressure(ring.value);
    const auto b = msp(1, angle).entry_pressure(other.value);
    CHECK(a.reason == b.reason);
    if (a.ok()) {
      CHECK(a.value == doctest::Approx(b.value).epsilon(1e-13));
    }
  }
  CHECK(merge(right, 1, left, 2).reason == opening_status::not_shared);
  CHECK(merge(right, 3, left, 2).reason == opening_status::invalid_input);
}
