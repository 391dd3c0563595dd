// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/lubrication/apply.hpp"

#include <cmath>
#include <random>

/// \file
/// Pairs of grains and their motions, for tests of lubrication and contact.

namespace pairs {

using namespace tetrapore;

template <class T>
[[nodiscard]] edge<T> as(const edge<double>& e) {
  return {T(e.radius1), T(e.radius2), T(e.gap), {T(e.normal.x), T(e.normal.y), T(e.normal.z)}};
}

/// The same pair, seen from its other end.
[[nodiscard]] inline edge<double> swapped(const edge<double>& e) { return {e.radius2, e.radius1, e.gap, -e.normal}; }
[[nodiscard]] inline pair_motion<double> swapped(const pair_motion<double>& m) {
  return {m.velocity2, m.spin2, m.velocity1, m.spin1};
}

class random_pairs {
 public:
  explicit random_pairs(unsigned seed) : engine_(seed) {}

  [[nodiscard]] double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  [[nodiscard]] double between_logs(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  [[nodiscard]] vec3<double> vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  [[nodiscard]] vec3<double> direction() {
    for (;;) {
      const vec3<double> v = vector();
      const double n = norm(v);
      if (n > 0.1 && n < 1) {
        return v / n;
      }
    }
  }
  /// Radii up to `ratio` apart, gap between two fractions of the harmonic mean of the radii.
  [[nodiscard]] edge<double> pair(double ratio, double narrow, double wide) {
    const double a = between_logs(1e-3, 1e3);
    const double b = a / between_logs(1, ratio);
    const double gap = 2 * a * b / (a + b) * between_logs(narrow, wide);
    return between(0, 1) < 0.5 ? edge<double>{a, b, gap, direction()} : edge<double>{b, a, gap, direction()};
  }
  /// Velocities and spins of all sizes.
  [[nodiscard]] pair_motion<double> motion(double length) {
    return {vector() * between_logs(1e-3, 1), vector() * (between_logs(1e-3, 1) / length),
            vector() * between_logs(1e-3, 1), vector() * (between_logs(1e-3, 1) / length)};
  }

 private:
  std::mt19937_64 engine_;
};

/// Work done on the grains per time.
template <class T>
[[nodiscard]] T work(const pair_forces<T>& f, const pair_motion<T>& m) {
  return dot(f.force1, m.velocity1) + dot(f.torque1, m.spin1) + dot(f.force2, m.velocity2) + dot(f.torque2, m.spin2);
}

}  // namespace pairs
