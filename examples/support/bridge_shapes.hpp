// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bridge_choices.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <variant>
#include <vector>

/// \file
/// The outline of a bridge, for pictures.

namespace support {

/// Points (x, r) of an outline: x counts along the axis, from the surface of the first grain.
using outline = std::vector<tp::vec2<double>>;

inline constexpr std::size_t outline_points = 9;  ///< enough for a picture

/// Where a meniscus meets a surface. With the angle φ of its slope, walking from the first surface to the second,
/// r exp(iφ).
struct contact_point {
  double along;  ///< x [m]
  std::complex<double> slope;
};

/// \param radius   of the contact line
/// \param filling  half filling angle of a sphere
[[nodiscard]] inline contact_point first_contact(const tp::edge<double>& e, double radius, double filling,
                                                 double angle) {
  return {-2 * e.radius1 * std::sin(filling / 2) * std::sin(filling / 2),
          {radius * std::sin(filling + angle), -radius * std::cos(filling + angle)}};
}
[[nodiscard]] inline contact_point second_contact(const tp::edge<double>& e, double radius, double filling,
                                                  double angle) {
  if (e.with_plane()) {
    return {e.gap, {radius * std::sin(angle), radius * std::cos(angle)}};
  }
  return {e.gap + 2 * e.radius2 * std::sin(filling / 2) * std::sin(filling / 2),
          {radius * std::sin(filling + angle), radius * std::cos(filling + angle)}};
}

/// The curve of constant mean curvature between two contacts: with z = r exp(iφ) and k half that curvature, 1 + 2kz
/// goes round a circle, 2ks of its angle for an arc length s.
[[nodiscard]] inline outline constant_curvature(const contact_point& from, const contact_point& to, double k,
                                                std::size_t count = outline_points) {
  const std::complex<double> z1 = from.slope;
  const std::complex<double> radius = 1.0 + 2 * k * z1;
  const std::complex<double> step = (to.slope - z1) / radius;  // (exp(2ikL) − 1)/2k
  const double height = to.along - from.along;
  const double size = std::abs(z1) + std::abs(to.slope);
  double length = step.imag();
  if (std::abs(radius) < 1e-9) {
    length = height;  // a cylinder
  } else if (std::abs(k) * std::abs(step) > 1e-7) {
    double turn = std::atan2(2 * k * step.imag(), 1 + 2 * k * step.real());
    if (turn * k < 0 && std::abs(turn) > 1e-12) {  // an arc longer than half a turn
      turn += std::copysign(2 * tp::pi<double>, k);
    }
    length = turn / (2 * k);
  }
  const auto at = [&](double s) {
    const double half = k * s;
    const double chord = std::abs(half) < 1e-8 ? s : std::sin(half) / k;
    return z1 + radius * std::polar(1.0, half) * std::complex<double>(0, chord);
  };
  constexpr int pieces = 16;  // Simpson's rule from point to point
  outline points{{from.along, std::abs(z1)}};
  const double apart = length / static_cast<double>(count - 1);
  double x = from.along;
  for (std::size_t p = 1; p < count; ++p) {
    double sum = 0;
    for (int i = 0; i <= pieces; ++i) {
      const auto z = at(apart * (static_cast<double>(p - 1) + static_cast<double>(i) / pieces));
      const double cosine = std::abs(z) > 1e-12 * size ? z.real() / std::abs(z) : 0.0;
      sum += (i == 0 || i == pieces ? 1 : i % 2 == 1 ? 4 : 2) * cosine;
    }
    x += sum * apart / (3 * pieces);
    points.push_back({x, std::abs(at(apart * static_cast<double>(p)))});
  }
  return points;
}

/// The arc of a circle between two contacts, that bends away from the axis.
[[nodiscard]] inline outline circle(const contact_point& from, const contact_point& to, double radius,
                                    std::size_t count = outline_points) {
  const double begin = std::arg(from.slope);
  const double end = std::arg(to.slope);
  outline points;
  for (std::size_t p = 0; p < count; ++p) {
    const double phi = begin + (end - begin) * static_cast<double>(p) / static_cast<double>(count - 1);
    points.push_back({from.along + radius * (std::sin(phi) - std::sin(begin)),
                      std::abs(from.slope) + radius * (std::cos(begin) - std::cos(phi))});
  }
  return points;
}

/// The outline of a bridge: its true meridian by laws that know it, else an upright cylinder of the same volume.
template <class Law, class Given>
[[nodiscard]] outline outline_of(const Law& law, const tp::edge<double>& e, const Given& given,
                                 std::size_t count = outline_points) {
  const auto m = law.bridge(e, given).value;
  if constexpr (requires { m.filling1; }) {
    const contact_point from = first_contact(e, m.contact1, m.filling1, law.contact_angle1);
    const contact_point to = second_contact(e, m.contact2, m.filling2, law.contact_angle2);
    if constexpr (requires { m.arc; }) {
      return circle(from, to, m.arc, count);
    } else {
      return constant_curvature(from, to, m.suction / (2 * law.surface_tension), count);
    }
  } else {
    const double radius = detail::cylinder_radius(e, given.value);
    const auto sink = [radius](double r) {  // of the rim into a surface
      return r < std::numeric_limits<double>::infinity() ? radius * radius / (r + std::sqrt(r * r - radius * radius))
                                                         : 0.0;
    };
    return {{-sink(e.radius1), radius}, {e.gap + sink(e.radius2), radius}};
  }
}

}  // namespace support
