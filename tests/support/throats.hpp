// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/area.hpp"
#include "tetrapore/simplex/throat.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

/// \file
/// Throats of all three shapes with nodes where a power diagram has them, motions of them, and the solid angles of
/// their grains by another formula.

namespace throats {

using namespace tetrapore;

/// The same throat in another scalar.
template <real T, std::floating_point S>
[[nodiscard]] throat<T> as(const throat<S>& t) {
  using value_type = underlying_t<T>;
  const auto number = [](const S& x) { return T(static_cast<value_type>(x)); };
  const auto point = [&](const vec3<S>& v) -> vec3<T> { return {number(v.x), number(v.y), number(v.z)}; };
  throat<T> r{};
  for (std::size_t k = 0; k < 3; ++k) {
    r.grains[k] = {point(t.grains[k].centre), number(t.grains[k].radius)};
  }
  for (std::size_t k = 0; k < 2; ++k) {
    r.walls[k] = {point(t.walls[k].point), point(t.walls[k].normal)};
    r.nodes[k] = point(t.nodes[k]);
  }
  r.grain_count = t.grain_count;
  r.area_vector = point(t.area_vector);
  return r;
}

/// The area vector that belongs to the grains and walls.
template <real T>
void set_area(throat<T>& t) {
  t.area_vector = t.grain_count == 3   ? triangle_area(t.grains[0].centre, t.grains[1].centre, t.grains[2].centre)
                  : t.grain_count == 2 ? trapezoid_area(t.grains[0].centre, t.grains[1].centre, t.walls[0])
                                       : rectangle_area(t.grains[0].centre, t.walls[0], t.walls[1]);
}

/// Three grains in the plane z = 0; nodes on the axis of equal power at two heights.
[[nodiscard]] inline throat<double> of_grains(const std::array<double, 3>& r, double d01, double d02, double d12,
                                              double z0, double z1) {
  throat<double> t{};
  t.grain_count = 3;
  const double x = (d01 * d01 + d02 * d02 - d12 * d12) / (2 * d01);
  const double y = std::sqrt(d02 * d02 - x * x);
  t.grains = {{{{0, 0, 0}, r[0]}, {{d01, 0, 0}, r[1]}, {{x, y, 0}, r[2]}}};
  const double qx = (d01 * d01 + r[0] * r[0] - r[1] * r[1]) / (2 * d01);
  const double qy = (d02 * d02 + r[0] * r[0] - r[2] * r[2] - 2 * qx * x) / (2 * y);
  t.nodes = {{{qx, qy, z0}, {qx, qy, z1}}};
  set_area(t);
  return t;
}

/// Two grains above the wall y = 0, at the heights h, w apart along x.
[[nodiscard]] inline throat<double> on_a_wall(const std::array<double, 2>& r, const std::array<double, 2>& h, double w,
                                              double z0, double z1) {
  throat<double> t{};
  t.grain_count = 2;
  t.grains[0] = {{0, h[0], 0}, r[0]};
  t.grains[1] = {{w, h[1], 0}, r[1]};
  t.walls[0] = {{0, 0, 0}, {0, 1, 0}};
  const double q = (w * w + h[1] * h[1] - r[1] * r[1] - h[0] * h[0] + r[0] * r[0]) / (2 * w);
  set_area(t);
  const double s = t.area_vector.z > 0 ? 1.0 : -1.0;
  t.nodes = {{{q, 0, s * z0}, {q, 0, s * z1}}};
  return t;
}

/// One grain in the corner of the walls x = 0 and y = 0.
[[nodiscard]] inline throat<double> in_a_corner(double r, double a, double b, double z0, double z1) {
  throat<double> t{};
  t.grain_count = 1;
  t.grains[0] = {{a, b, 0}, r};
  t.walls = {{{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 1, 0}}}};
  t.nodes = {{{0, 0, z0}, {0, 0, z1}}};
  set_area(t);
  return t;
}

template <real T, class Point, class Normal>
[[nodiscard]] throat<T> mapped(const throat<T>& t, const Point& point, const Normal& normal, const T& scale = T(1)) {
  throat<T> r = t;
  for (std::size_t k = 0; k < t.grain_count; ++k) {
    r.grains[k] = {point(t.grains[k].centre), t.grains[k].radius * scale};
  }
  for (std::size_t k = 0; k < t.wall_count(); ++k) {
    r.walls[k] = {point(t.walls[k].point), normal(t.walls[k].normal)};
  }
  r.nodes = {point(t.nodes[0]), point(t.nodes[1])};
  set_area(r);
  return r;
}

template <real T>
[[nodiscard]] throat<T> moved(const throat<T>& t, const vec3<T>& by) {
  return mapped(
      t, [&](const vec3<T>& p) { return p + by; }, [](const vec3<T>& n) { return n; });
}

template <real T>
[[nodiscard]] throat<T> scaled(const throat<T>& t, const T& by) {
  return mapped(
      t, [&](const vec3<T>& p) { return p * by; }, [](const vec3<T>& n) { return n; }, by);
}

/// Turned about (1, 1, 1) by a third and about z by an angle.
template <real T>
[[nodiscard]] throat<T> turned(const throat<T>& t, const T& angle) {
  const T c = std::cos(angle);
  const T s = std::sin(angle);
  const auto turn = [&](const vec3<T>& v) -> vec3<T> { return {v.z, c * v.x - s * v.y, s * v.x + c * v.y}; };
  return mapped(t, turn, turn);
}

/// Seen from the other pore.
template <real T>
[[nodiscard]] throat<T> reversed(const throat<T>& t) {
  throat<T> r = t;
  std::swap(r.nodes[0], r.nodes[1]);
  if (t.grain_count == 1) {
    std::swap(r.walls[0], r.walls[1]);
  } else {
    std::swap(r.grains[0], r.grains[1]);
  }
  set_area(r);
  return r;
}

/// Begins with another vertex.
template <real T>
[[nodiscard]] throat<T> rotated(const throat<T>& t) {
  throat<T> r = t;
  if (t.grain_count == 3) {
    r.grains = {t.grains[1], t.grains[2], t.grains[0]};
  }
  set_area(r);
  return r;
}

/// Solid angle of the throat domain at grain k from the foot of the axis in the facet: right-angled spherical
/// triangles, tan(E/2) = tan(α/2) tan(φ/2), on both sides of the axis and below both nodes. For an axis at a right
/// angle to the facet.
template <std::floating_point T>
[[nodiscard]] T solid_angle_by_feet(const throat<T>& t, std::size_t k) {
  const vec3<T> normal = t.area_vector / norm(t.area_vector);
  const vec3<T>& c = t.grains[k].centre;
  const auto towards = [&](std::size_t j) {
    return j < t.grain_count ? t.grains[j].centre - c : -t.walls[j - t.grain_count].normal;
  };
  const T low = dot(t.nodes[0] - c, normal);
  const T high = dot(t.nodes[1] - c, normal);
  const vec3<T> foot = (t.nodes[0] - c) - normal * low;
  const T far = norm(foot);
  const auto side = [&](const vec3<T>& from, const vec3<T>& to) {
    const T alpha = std::atan2(dot(normal, cross(from, to)), dot(from, to));
    const auto below = [&](T z) { return 2 * std::atan(std::tan(alpha / 2) * std::tan(std::atan2(z, far) / 2)); };
    return below(high) - below(low);
  };
  return side(towards((k + 1) % 3), foot) + side(foot, towards((k + 2) % 3));
}

/// Throats as in a dense packing, of all shapes; sizes near 1, near the origin.
class random_throats {
 public:
  explicit random_throats(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] double uniform(double a, double b) {
    return a + (b - a) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  [[nodiscard]] throat<double> operator()() {
    for (;;) {
      const double shape = uniform(0, 1);
      const double z0 = uniform(-1, 0.3);
      const double z1 = z0 + std::pow(10.0, uniform(-3, 0.5));
      const std::array<double, 3> r{radius(), radius(), radius()};
      const auto gap = [&] { return uniform(0, 1) < 0.4 ? uniform(-0.02, 0.001) : uniform(0, 0.6); };
      if (shape < 0.7) {
        const double a = r[0] + r[1] + gap();
        const double b = r[0] + r[2] + gap();
        const double c = r[1] + r[2] + (uniform(0, 1) < 0.3 ? uniform(0.6, 1.6) : gap());  // obtuse: off the axis
        if (a < 0.99 * (b + c) && b < 0.99 * (a + c) && c < 0.99 * (a + b)) {
          return of_grains(r, a, b, c, z0, z1);
        }
      } else if (shape < 0.9) {
        const double h0 = r[0] + gap();
        const double h1 = r[1] + gap();
        const double d = r[0] + r[1] + gap();
        if (std::abs(h1 - h0) < 0.9 * d) {
          return on_a_wall({r[0], r[1]}, {h0, h1}, std::sqrt(d * d - (h1 - h0) * (h1 - h0)), z0, z1);
        }
      } else {
        return in_a_corner(r[0], r[0] + gap(), r[0] + gap(), z0, z1);
      }
    }
  }

 private:
  [[nodiscard]] double radius() { return uniform(0.7, 1.3); }
  std::mt19937_64 random_;
};

}  // namespace throats
