// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/csv_table.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

/// \file
/// Bridges for tests: rows of the tables of truth, random pairs, and the stability of a bridge by finite elements.

namespace bridges {

using namespace tetrapore;

[[nodiscard]] inline double radians(double degrees) { return degrees * pi<double> / 180; }

template <int Nodes = 10>
[[nodiscard]] young_laplace<Nodes> law_of(double theta1, double theta2, double sigma = 1.0) {
  return {.surface_tension = sigma, .contact_angle1 = theta1, .contact_angle2 = theta2};
}

/// A request of a table.
struct request {
  edge<double> pair;
  double theta1;
  double theta2;
  bool by_volume;
  double value;

  template <int Nodes = 10>
  [[nodiscard]] auto bridge() const {
    const auto law = law_of<Nodes>(theta1, theta2);
    return by_volume ? law.bridge(pair, given_volume<double>{value}) : law.bridge(pair, given_suction<double>{value});
  }
};

[[nodiscard]] inline request request_of(const csv_table& t, std::size_t i) {
  const bool by_volume = t.text(i, "control") == "V";
  return {{1.0, t.number(i, "R2"), t.number(i, "D"), {0, 0, 1}},
          radians(t.number(i, "theta1_deg")),
          radians(t.number(i, "theta2_deg")),
          by_volume,
          t.number(i, by_volume ? "V" : "pc")};
}

/// Roundings of the request alone in the force, for 2⁻⁵³ each.
[[nodiscard]] inline double rounding_of_request(const bridge_stiffness<double>& s, const meniscus<double>& m,
                                                double gap, bool by_volume) {
  const double by_value = by_volume ? m.volume * s.suction_by_gap_at_volume : m.suction * s.volume_by_gap_at_suction;
  const double by_gap = gap * (by_volume ? s.force_by_gap_at_volume : s.force_by_gap_at_suction);
  return std::ldexp((std::abs(by_gap) + std::abs(by_value)) / std::abs(m.force), -53);
}

/// A random pair with a volume, over the whole of the domain where bridges are not freaks.
class random_pairs {
 public:
  explicit random_pairs(unsigned seed) : random_(seed) {}

  struct pair {
    edge<double> e;
    double theta1;
    double theta2;
    double volume;
  };

  [[nodiscard]] double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

  [[nodiscard]] pair next() {
    const bool plane = uniform(0, 1) < 0.15;
    const bool equal = !plane && uniform(0, 1) < 0.3;
    const double r2 = plane ? infinity<double> : equal ? 1.0 : std::pow(10.0, uniform(-2, 0.5));
    const double theta1 = uniform(0, 1) < 0.2 ? 0.0 : radians(uniform(0, 75));
    const double theta2 = equal || uniform(0, 1) < 0.3 ? theta1 : radians(uniform(0, 75));
    const double small = std::min(1.0, r2);
    const double volume = std::pow(10.0, uniform(-8, 0)) * small * small * small;
    const double gap = uniform(0, 1) < 0.1 ? 0.0 : uniform(-0.02, 1.2) * std::cbrt(volume);
    return {{1.0, r2, gap, {0, 0, 1}}, theta1, theta2, volume};
  }

 private:
  std::mt19937_64 random_;
};

/// Negative directions of the energy of a bridge by linear finite elements along its profile: the second variation
/// ∫ r (u'² − |A|² u²) ds + Σ r b u², |A|² = φ'² + (cos φ / r)², b = φ' cot θ + 1/(R sin θ), without and with the
/// constraint ∫ r u ds = 0. Contact angles must not be 0.
struct counted {
  int at_suction;
  int at_volume;
};

[[nodiscard]] inline counted count_negative(const request& of, const meniscus<double>& m, int elements = 1500) {
  using std::cos;
  using std::sin;
  const double k = m.curvature;
  const double beta1 = m.filling1 + of.theta1;
  const double beta2 = m.filling2 + of.theta2;
  const double z_re = m.contact1 * sin(beta1);
  const double z_im = -m.contact1 * cos(beta1);
  const double y_re = m.contact2 * sin(beta2);
  const double y_im = m.contact2 * cos(beta2);
  // length of the profile from 2kL = arg(1 + 2k z2) − arg(1 + 2k z1)
  double turn = std::atan2(2 * k * y_im, 1 + 2 * k * y_re) - std::atan2(2 * k * z_im, 1 + 2 * k * z_re);
  if (turn * k < 0) {
    turn += k > 0 ? 2 * pi<double> : -2 * pi<double>;
  }
  const double length = k == 0 ? y_im - z_im : turn / (2 * k);
  const auto n = static_cast<std::size_t>(elements);
  const double h = length / elements;
  std::vector<double> diagonal(n + 1, 0.0);
  std::vector<double> off(n, 0.0);
  std::vector<double> load(n + 1, 0.0);
  const auto profile = [&](double s, double& r, double& cosine) {
    const double c = cos(2 * k * s);
    const double d = sin(2 * k * s);
    const double chord = k == 0 ? s : sin(k * s) / k;
    const double re = c * z_re - d * z_im - chord * sin(k * s);
    const double im = c * z_im + d * z_re + chord * cos(k * s);
    r = std::hypot(re, im);
    cosine = re / r;
  };
  for (std::size_t j = 0; j < n; ++j) {
    for (const double t : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
      double r = 0;
      double cosine = 0;
      profile((static_cast<double>(j) + t) * h, r, cosine);
      const double across = cosine / r;
      const double along = 2 * k + across;
      const double mass = -0.5 * h * r * (along * along + across * across);
      const double stiff = 0.5 * r / h;
      diagonal[j] += stiff + mass * (1 - t) * (1 - t);
      diagonal[j + 1] += stiff + mass * t * t;
      off[j] += -stiff + mass * t * (1 - t);
      load[j] += 0.5 * h * r * (1 - t);
      load[j + 1] += 0.5 * h * r * t;
    }
  }
  const auto wall = [&](double radius, double curvature, double cosine, double theta) {
    return radius * ((2 * k + cosine / radius) / std::tan(theta) + curvature / sin(theta));
  };
  diagonal.front() += wall(m.contact1, 1 / of.pair.radius1, sin(beta1), of.theta1);
  diagonal.back() += wall(m.contact2, 1 / of.pair.radius2, sin(beta2), of.theta2);
  // inertia by LDLᵀ, and cᵀA⁻¹c for the constraint
  counted found{0, 0};
  double schur = 0;
  double pivot = diagonal[0];
  double rest = load[0];
  for (std::size_t j = 0;; ++j) {
    found.at_suction += pivot < 0 ? 1 : 0;
    schur += rest * rest / pivot;
    if (j == n) {
      break;
    }
    const double factor = off[j] / pivot;
    rest = load[j + 1] - factor * rest;
    pivot = diagonal[j + 1] - factor * off[j];
  }
  found.at_volume = found.at_suction - (schur < 0 ? 1 : 0);
  return found;
}

}  // namespace bridges
