// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/geometry/inscribed.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>

using namespace tetrapore;

namespace {

bounding_side2<double> disc(double x, double y, double r) { return {{x, y}, {}, r, false}; }
bounding_side2<double> line(double x, double y, double nx, double ny) { return {{x, y}, {nx, ny}, 0, true}; }

template <class V, class C>
double clearance(const bounding_side<V, double>& s, const C& c) {
  const V v = c.centre - s.point;
  return (s.flat ? dot(s.normal, v) : std::sqrt(dot(v, v)) - s.radius) - c.radius;
}

}  // namespace

TEST_CASE("the circle between three touching rods has radius 2/√3 − 1, between two and a plate 1/4") {
  const double h = std::sqrt(3.0);
  const auto c = circle_between<double>({disc(0, 0, 1), disc(2, 0, 1), disc(1, h, 1)});
  CHECK(c.ok());
  CHECK(c.value.radius == doctest::Approx(2 / h - 1).epsilon(1e-14));
  CHECK(circle_between<double>({disc(0, 1, 1), disc(-2, 1, 1), line(0, 0, 0, 1)}).value.radius ==
        doctest::Approx(0.25).epsilon(1e-14));
  const double r = std::sqrt(0.5);
  CHECK(circle_between<double>({line(0, 0, 0, 1), line(1, 0, -r, -r), line(0, 0, 1, 0)}).value.radius ==
        doctest::Approx(1 - r).epsilon(1e-14));
}

TEST_CASE(
    "the sphere between four touching spheres has radius √(3/2) − 1, in the corner of a cube cut off 1/(3 + √3)") {
  const double a = 1 / std::sqrt(2.0);
  const auto round = [](double x, double y, double z) { return bounding_side3<double>{{x, y, z}, {}, 1, false}; };
  const double k = 2 * a;
  const auto s = sphere_between<double>({round(0, 0, 0), round(k, k, 0), round(k, 0, k), round(0, k, k)});
  CHECK(s.ok());
  CHECK(s.value.radius == doctest::Approx(std::sqrt(1.5) - 1).epsilon(1e-14));
  const double t = 1 / std::sqrt(3.0);
  const auto flat = [](vec3<double> p, vec3<double> n) { return bounding_side3<double>{p, n, 0, true}; };
  const auto corner = sphere_between<double>({flat({0, 0, 0}, {1, 0, 0}), flat({0, 0, 0}, {0, 1, 0}),
                                              flat({0, 0, 0}, {0, 0, 1}), flat({1, 0, 0}, {-t, -t, -t})});
  CHECK(corner.ok());
  CHECK(corner.value.radius == doctest::Approx(1 / (3 + std::sqrt(3.0))).epsilon(1e-14));
}

TEST_CASE("a circle or sphere that random sides were laid around is found again, a million boxes away too") {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> u(0, 1);
  const std::array<vec3<double>, 4> corner{{{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}}};
  for (int i = 0; i < 20000; ++i) {
    const double away = i % 2 == 0 ? 0 : 1e6;
    const double hidden = 0.05 + 0.3 * u(engine);
    const double tolerance = (away > 0 ? 1e-8 : 1e-12) / hidden;
    std::array<bounding_side2<double>, 3> ring;
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = 2.1 * static_cast<double>(k) + 0.4 * u(engine);
      const vec2<double> n{std::cos(angle), std::sin(angle)};
      const double r = std::pow(10.0, -3 * u(engine));
      const vec2<double> centre{away, -away};
      ring[k] = u(engine) < 0.3 ? bounding_side2<double>{centre + n * hidden, -n, 0, true}
                                : bounding_side2<double>{centre + n * (hidden + r), {}, r, false};
    }
    const auto c = circle_between(ring);
    REQUIRE(c.ok());
    CHECK(std::abs(c.value.radius / hidden - 1) < tolerance);
    CHECK(std::abs(clearance(ring[0], c.value)) < tolerance);
    std::array<bounding_side3<double>, 4> pore;
    for (std::size_t k = 0; k < 4; ++k) {
      vec3<double> n = corner[k] + vec3<double>{u(engine) - 0.5, u(engine) - 0.5, u(engine) - 0.5} * 0.4;
      n = n / norm(n);
      const double r = std::pow(10.0, -3 * u(engine));
      const vec3<double> centre{away, -away, away};
      pore[k] = u(engine) < 0.3 ? bounding_side3<double>{centre + n * hidden, -n, 0, true}
                                : bounding_side3<double>{centre + n * (hidden + r), {}, r, false};
    }
    const auto s = sphere_between(pore);
    REQUIRE(s.ok());
    CHECK(std::abs(s.value.radius / hidden - 1) < tolerance);
    CHECK(std::abs(clearance(pore[3], s.value)) < tolerance);
  }
}

TEST_CASE("collinear discs, coplanar spheres, parallel planes are degenerate; bad numbers are invalid") {
  CHECK(circle_between<double>({disc(0, 0, 1), disc(2, 0, 1), disc(4, 0, 1)}).reason == inscribed_status::degenerate);
  CHECK(circle_between<double>({line(0, 0, 0, 1), line(0, 1, 0, -1), line(0, 2, 0, 1)}).reason ==
        inscribed_status::degenerate);
  const auto round = [](double x, double y) { return bounding_side3<double>{{x, y, 0}, {}, 0.3, false}; };
  CHECK(sphere_between<double>({round(0, 0), round(1, 0), round(0, 1), round(1, 1)}).reason ==
        inscribed_status::degenerate);
  CHECK(circle_between<double>({disc(0, 0, -1), disc(2, 0, 1), disc(1, 2, 1)}).reason ==
        inscribed_status::invalid_input);
  CHECK(circle_between<double>({disc(0, quiet_nan<double>, 1), disc(2, 0, 1), disc(1, 2, 1)}).reason ==
        inscribed_status::invalid_input);
  CHECK(circle_between<double>({disc(0, 0, 1), disc(1, 0, 1), disc(0.5, 0.8, 1)}).reason == inscribed_status::covered);
}
