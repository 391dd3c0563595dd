// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/law/bridge.hpp"
#include "tetrapore/law/bridge/closed_forms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace tetrapore;

namespace {

constexpr double degree = pi<double> / 180;

edge<double> pair_of(double radius1, double radius2, double gap) { return {radius1, radius2, gap, {0, 0, 1}}; }

template <class Law>
double force(const Law& law, const edge<double>& e, double volume) {
  const auto answer = law.bridge(e, given_volume<double>{volume});
  REQUIRE(answer.ok());
  return answer.value.force;
}

/// Volume between the meridian circle of a ring and the surfaces, by Simpson's rule along the axis: an independent
/// path.
double volume_by_slices(const edge<double>& e, const toroid_ring<double>& r, double x_centre) {
  const double x1 = -e.radius1 * (1 - std::cos(r.filling1));
  const double x2 = e.with_plane() ? e.gap : e.gap + e.radius2 * (1 - std::cos(r.filling2));
  const auto area = [&](double x) {
    const double y = r.neck + r.arc - std::sqrt(std::max(0.0, r.arc * r.arc - (x - x_centre) * (x - x_centre)));
    double a = y * y;
    if (x < 0) {
      a -= e.radius1 * e.radius1 - (x + e.radius1) * (x + e.radius1);
    }
    if (!e.with_plane() && x > e.gap) {
      a -= e.radius2 * e.radius2 - (x - e.gap - e.radius2) * (x - e.gap - e.radius2);
    }
    return pi<double> * a;
  };
  const auto simpson = [&](double a, double b) {  // the section has corners at the two apices: a piece each
    const int n = 2000;
    const double h = (b - a) / n;
    double sum = area(a) + area(b);
    for (int i = 1; i < n; ++i) {
      sum += (i % 2 == 1 ? 4 : 2) * area(a + i * h);
    }
    return sum * h / 3;
  };
  return simpson(x1, 0) + simpson(0, e.gap) + (e.with_plane() ? 0 : simpson(e.gap, x2));
}

}  // namespace

TEST_CASE("Lambert's force is the derivative by the gap of the energy of a disc with an upright rim") {
  const lambert<without_rupture> law{.surface_tension = 0.7, .contact_angle = 0.4};
  for (const double radius2 : {1.0, 0.3, infinity<double>}) {
    for (const double reduced : {1e-6, 1e-3, 0.01}) {
      const double radius = detail::derjaguin_radius(pair_of(1, radius2, 0));
      const double volume = reduced * radius * radius * radius;
      for (const double gap : {0.01, 0.05, 0.2}) {
        // the rim where the gap D + r²/R has the height h: V = π r² (D + h)/2, r² = R (h − D); σ cos θ gained on both
        const auto energy = [&](double d) {
          const double h = std::sqrt(d * d + 2 * volume / (pi<double> * radius));
          return -2 * 0.7 * std::cos(0.4) * pi<double> * radius * (2 * volume / (pi<double> * radius)) / (h + d);
        };
        const double step = 1e-4 * gap;
        const double slope = (energy(gap + step) - energy(gap - step)) / (2 * step);
        CHECK(force(law, pair_of(1, radius2, gap), volume) == doctest::Approx(slope).epsilon(1e-7));
      }
    }
  }
}

TEST_CASE("at contact with little liquid every form pulls by about 2 pi R sigma cos theta, R Derjaguin's radius") {
  const double angle = 30 * degree;
  for (const double radius2 : {1.0, 0.5}) {
    const auto e = pair_of(1, radius2, 0);
    const double radius = 2 * radius2 / (1 + radius2);
    const double limit = 2 * pi<double> * radius * 0.072 * std::cos(angle);
    CHECK(force(lambert<>{0.072, angle}, e, 1e-12) == doctest::Approx(limit).epsilon(1e-15));
    CHECK(force(willett_small<>{0.072, angle}, e, 1e-12) == doctest::Approx(limit).epsilon(1e-15));
    CHECK(force(rabinovich<>{0.072, angle}, e, 1e-12) == doctest::Approx(limit).epsilon(2e-3));
    CHECK(force(toroid<>{0.072, angle, angle}, e, 1e-12) == doctest::Approx(limit).epsilon(2e-3));
    CHECK(force(willett<>{0.072, angle}, e, 1e-3 * radius * radius * radius) == doctest::Approx(limit).epsilon(0.1));
    CHECK(force(soulie<>{0.072, angle}, e, 1e-3) == doctest::Approx(limit).epsilon(0.15));
  }
  CHECK(force(weigert_ripperger<>{0.072, angle}, pair_of(1, 1, 0), 0.01) ==
        doctest::Approx(2 * pi<double> * 0.072 * std::cos(angle)).epsilon(0.15));
}

TEST_CASE("Rabinovich's form is Lambert's and the pull along the contact line") {
  const double angle = 0.3;
  const double volume = 0.002;
  const auto e = pair_of(1, 1, 0.03);
  const double twice = -0.03 + std::sqrt(0.03 * 0.03 + 2 * volume / pi<double>);
  const double a = std::sqrt(twice);
  CHECK(force(rabinovich<>{1.0, angle}, e, volume) - force(lambert<>{1.0, angle}, e, volume) ==
        doctest::Approx(2 * pi<double> * std::sin(a) * std::sin(a + angle)).epsilon(1e-13));
}

TEST_CASE("Soulie's form without contact angle between equal spheres is Mikami's") {
  for (const double volume : {1e-3, 1e-1}) {
    for (const double gap : {0.0, 0.02}) {
      const auto e = pair_of(2, 2, gap);
      CHECK(force(soulie<without_rupture>{0.5, 0.0}, e, volume) == force(mikami<without_rupture>{0.5}, e, volume));
    }
  }
}

TEST_CASE("Willett's fit is continuous at contact") {
  for (const double angle : {0.0, 20 * degree, 50 * degree}) {
    const willett<> law{.surface_tension = 1.0, .contact_angle = angle};
    for (const double volume : {1e-3, 1e-2, 0.1}) {
      CHECK(force(law, pair_of(1, 1, 1e-12), volume) ==
            doctest::Approx(force(law, pair_of(1, 1, 0), volume)).epsilon(1e-5));
    }
  }
}

TEST_CASE("Weigert and Ripperger's form takes the volume of its filling angle") {
  const double angle = 20 * degree;
  const double gap = 0.04;
  const weigert_ripperger<> law{.surface_tension = 1.0, .contact_angle = angle};
  for (const double b : {12 * degree, 25 * degree, 38 * degree}) {
    const double r1 = (2 * (1 - std::cos(b)) + gap) / (2 * std::cos(b + angle));
    const double r2 = std::sin(b) + r1 * (std::sin(b + angle) - 1);
    const double sine = std::sin(b);
    const double pull = pi<double> * sine * sine * (1 / r1 - 1 / r2) + 2 * pi<double> * sine * std::sin(b + angle);
    const double volume = 0.12 * 8 * std::pow(sine, 4) * (1 + 6 * gap / 2) * (1 + 1.1 * std::sin(angle));
    CHECK(force(law, pair_of(1, 1, gap), volume) == doctest::Approx(pull).epsilon(1e-13));
  }
}

TEST_CASE("Willett's rupture gap for unequal radii is Eq. 15 where they are equal") {
  for (const double volume : {1e-6, 1e-3, 0.1}) {
    const double length = std::cbrt(volume);
    CHECK(willett_rupture{}.gap(pair_of(1, 1, 0), volume, 0.5) ==
          doctest::Approx(1.25 * (length + 0.1 * length * length)).epsilon(1e-14));
  }
}

TEST_CASE("the toroid meets both surfaces at their angles and holds its volume") {
  struct shape {
    double radius2, gap, angle1, angle2, volume;
  };
  for (const shape& s : {shape{1, 0, 0, 0, 0.01}, shape{1, 0.1, 20, 20, 0.01}, shape{0.5, 0.02, 0, 40, 1e-3},
                         shape{0.1, 0.001, 30, 10, 1e-5}, shape{infinity<double>, 0.03, 10, 60, 0.01},
                         shape{infinity<double>, 0, 0, 0, 1e-6}}) {
    CAPTURE(s.radius2);
    CAPTURE(s.volume);
    const auto e = pair_of(1, s.radius2, s.gap);
    const double angle1 = s.angle1 * degree;
    const double angle2 = s.angle2 * degree;
    const toroid<> law{.surface_tension = 0.5, .contact_angle1 = angle1, .contact_angle2 = angle2};
    const auto answer = law.bridge(e, given_volume<double>{s.volume});
    REQUIRE(answer.ok());
    const auto& r = answer.value;
    CHECK(r.volume == doctest::Approx(s.volume).epsilon(1e-11));
    CHECK(r.suction == doctest::Approx(0.5 * (1 / r.arc - 1 / r.neck)).epsilon(1e-14));
    CHECK(r.force ==
          doctest::Approx(2 * pi<double> * r.neck * 0.5 + pi<double> * r.neck * r.neck * r.suction).epsilon(1e-12));
    // the centre of the circle, from the contact line on the first grain and the normal of the meridian there
    const double normal = r.filling1 + angle1;
    const double x = -1 + std::cos(r.filling1) + r.arc * std::cos(normal);
    const double y = std::sin(r.filling1) + r.arc * std::sin(normal);
    CHECK(y == doctest::Approx(r.neck + r.arc).epsilon(1e-12));
    CHECK(r.contact1 == doctest::Approx(std::sin(r.filling1)).epsilon(1e-14));
    // and from the second surface
    if (e.with_plane()) {
      CHECK(r.filling2 == 0);
      CHECK(std::abs(s.gap - x - r.arc * std::cos(angle2)) < 1e-12);
      CHECK(y == doctest::Approx(r.contact2 + r.arc * std::sin(angle2)).epsilon(1e-12));
    } else {
      const double reach = std::hypot(s.gap + s.radius2 - x, y);
      CHECK(reach * reach ==
            doctest::Approx(s.radius2 * s.radius2 + r.arc * r.arc + 2 * s.radius2 * r.arc * std::cos(angle2))
                .epsilon(1e-12));
      CHECK(r.contact2 == doctest::Approx(std::sin(r.filling2) * s.radius2).epsilon(1e-14));
      CHECK(r.contact2 == doctest::Approx(y - r.arc * std::sin(r.filling2 + angle2)).epsilon(1e-9));
    }
    CHECK(volume_by_slices(e, r, x) == doctest::Approx(s.volume).epsilon(1e-5));
    // the same ring by its suction
    const auto tied = law.bridge(e, given_suction<double>{r.suction});
    REQUIRE(tied.ok());
    CHECK(tied.value.volume == doctest::Approx(s.volume).epsilon(1e-9));
  }
}

TEST_CASE("a plane is a sphere of large radius to the toroid") {
  const toroid<> law{.surface_tension = 1.0, .contact_angle1 = 0.2, .contact_angle2 = 0.6};
  const double flat = force(law, pair_of(1, infinity<double>, 0.05), 0.01);
  CHECK(force(law, pair_of(1, 1e6, 0.05), 0.01) == doctest::Approx(flat).epsilon(1e-5));
}

TEST_CASE("under a suction the toroid ruptures at the highest suction of its gap") {
  const toroid<> law{.surface_tension = 1.0};
  const auto e = pair_of(1, 1, 0.05);
  double low = 1;
  double high = 100;
  REQUIRE(law.bridge(e, given_suction<double>{low}).ok());
  REQUIRE(law.bridge(e, given_suction<double>{high}).reason == bridge_status::ruptured);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (law.bridge(e, given_suction<double>{middle}).ok() ? low : high) = middle;
  }
  // the highest of σ (1/ρ − 1/y) over the rings of this gap, y² + 2yρ = 2Rρ − D R − D²/4, in steps
  double highest = 0;
  for (int i = 1; i < 200000; ++i) {
    const double arc = 0.0253125 * (1 + 1e-4 * i);
    const double square = 2 * arc - 0.05 - 0.000625;
    if (square > 0) {
      const double neck = square / (std::sqrt(arc * arc + square) + arc);
      highest = std::max(highest, 1 / arc - 1 / neck);
    }
  }
  CHECK(low == doctest::Approx(highest).epsilon(1e-6));
}
