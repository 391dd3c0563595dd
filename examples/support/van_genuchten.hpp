// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

/// \file
/// Van Genuchten's retention function and its fit. Source: van Genuchten, Soil Sci. Soc. Am. J. 44, 892 (1980).

namespace support {

/// S(p) = S_r + (1 − S_r) (1 + (α p)^n)^(1/n − 1).
struct van_genuchten {
  double residual = 0;
  double alpha = std::numeric_limits<double>::quiet_NaN();  ///< [1/Pa]
  double n = std::numeric_limits<double>::quiet_NaN();
  double rms = std::numeric_limits<double>::quiet_NaN();  ///< root mean square of what S misses

  [[nodiscard]] double saturation(double p) const {
    return residual + (1 - residual) * std::pow(1 + std::pow(alpha * p, n), 1 / n - 1);
  }
};

/// Least squares in S over points (pressure, saturation), with the residual saturation given. Levenberg-Marquardt in
/// ln α and ln (n − 1), so that both stay where they have a meaning. NaN where fewer than three points are given.
[[nodiscard]] inline van_genuchten fit_van_genuchten(std::span<const double> pressure,
                                                     std::span<const double> saturation, double residual) {
  van_genuchten best{.residual = residual};
  if (pressure.size() < 3) {
    return best;
  }
  const auto misses = [&](double a, double b) {
    const van_genuchten v{residual, std::exp(a), 1 + std::exp(b), 0};
    double sum = 0;
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      const double miss = v.saturation(pressure[i]) - saturation[i];
      sum += miss * miss;
    }
    return sum;
  };
  double a = -std::log(pressure[pressure.size() / 2]);
  double b = std::log(9.0);
  double now = misses(a, b);
  double damping = 1e-3;
  for (int round = 0; round < 200 && damping < 1e12; ++round) {
    constexpr double h = 1e-6;
    double aa = 0, ab = 0, bb = 0, ga = 0, gb = 0;
    const van_genuchten at{residual, std::exp(a), 1 + std::exp(b), 0};
    const van_genuchten in_a{residual, std::exp(a + h), 1 + std::exp(b), 0};
    const van_genuchten in_b{residual, std::exp(a), 1 + std::exp(b + h), 0};
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      const double s = at.saturation(pressure[i]);
      const double da = (in_a.saturation(pressure[i]) - s) / h;
      const double db = (in_b.saturation(pressure[i]) - s) / h;
      const double miss = saturation[i] - s;
      aa += da * da;
      ab += da * db;
      bb += db * db;
      ga += da * miss;
      gb += db * miss;
    }
    const double la = aa * (1 + damping);
    const double lb = bb * (1 + damping);
    const double det = la * lb - ab * ab;
    const double step_a = (ga * lb - gb * ab) / det;
    const double step_b = (gb * la - ga * ab) / det;
    const double then = misses(a + step_a, b + step_b);
    if (then < now) {
      const bool settled = now - then <= 1e-14 * now;
      a += step_a;
      b += step_b;
      now = then;
      damping = std::max(damping / 10, 1e-12);
      if (settled) {
        break;
      }
    } else {
      damping *= 10;
    }
  }
  best.alpha = std::exp(a);
  best.n = 1 + std::exp(b);
  best.rms = std::sqrt(now / static_cast<double>(pressure.size()));
  return best;
}

}  // namespace support
