// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

/// \file
/// The two-parameter retention law of van Genuchten, and its fit to a curve.

namespace tetrapore::inline TETRAPORE_ABI {

/// S = S_r + (1 − S_r) [1 + (α p)^n]^(−m) with m = 1 − 1/n.
/// \par Units   pressure [Pa], alpha [1/Pa]
/// \par Domain  alpha > 0, n > 1, 0 ≤ residual < 1, p ≥ 0
/// \par Accuracy  a few ε
/// \par Source  M. T. van Genuchten, Soil Sci. Soc. Am. J. 44, 892 (1980)
struct van_genuchten {
  double alpha = 0;
  double n = 0;
  double residual = 0;

  [[nodiscard]] double saturation(double pressure) const noexcept {
    return residual + (1 - residual) * effective(std::log(alpha), std::log(n - 1), pressure);
  }

  /// Effective saturation from ln α and ln(n − 1), free of overflow.
  [[nodiscard]] static double effective(double log_alpha, double log_excess, double pressure) noexcept {
    if (!(pressure > 0)) {
      return 1;
    }
    const double n = 1 + std::exp(log_excess);
    const double x = n * (log_alpha + std::log(pressure));
    const double log_sum = x > 0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x));
    return std::exp(-(1 - 1 / n) * log_sum);
  }
};

/// One point to fit. \par Units  [Pa], 1
struct retention_sample {
  double pressure;
  double saturation;
};

enum class fit_status : unsigned char {
  ok,
  too_few_points,  ///< refused: fewer than three samples between the residual and 1, or all at one pressure
  invalid_input,   ///< refused: a residual outside [0, 1), a pressure that is not positive
  not_converged    ///< failed
};

[[nodiscard]] constexpr verdict verdict_of(fit_status s) noexcept {
  switch (s) {
    case fit_status::ok: return verdict::ok;
    case fit_status::too_few_points:
    case fit_status::invalid_input: return verdict::refused;
    case fit_status::not_converged: break;
  }
  return verdict::failed;
}

[[nodiscard]] constexpr const char* describe(fit_status s) noexcept {
  switch (s) {
    case fit_status::ok: return "ok";
    case fit_status::too_few_points: return "fewer than three samples at different pressures above the residual";
    case fit_status::invalid_input: return "the residual is outside [0, 1), or a pressure is not positive";
    case fit_status::not_converged: return "the iteration did not reach its tolerance";
  }
  return "not a fit status";
}

struct van_genuchten_fit {
  van_genuchten law;
  double rms = 0;  ///< root of the mean square of the differences of saturation
  std::size_t samples = 0;
};

/// Fits α and n to samples by least squares in the effective saturation, the residual being given (as measured).
/// Samples at or below the residual carry no weight. Levenberg-Marquardt in ln α and ln(n − 1), from the best of a few
/// starting slopes.
/// \par Accuracy  recovers the parameters of a noise-free curve to 1e-8 (measured, n = 1.2 … 40)
[[nodiscard]] inline outcome<van_genuchten_fit, fit_status> fit_van_genuchten(std::span<const retention_sample> samples,
                                                                              double residual) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const van_genuchten_fit none{{nan, nan, residual}, nan, 0};
  if (!(residual >= 0 && residual < 1)) {
    return {none, fit_status::invalid_input};
  }
  std::vector<retention_sample> used;
  for (const retention_sample& s : samples) {
    if (!(s.pressure > 0) || !std::isfinite(s.pressure)) {
      return {none, fit_status::invalid_input};
    }
    if (s.saturation > residual && s.saturation < 1) {
      used.push_back({s.pressure, (s.saturation - residual) / (1 - residual)});
    }
  }
  std::sort(used.begin(), used.end(), [](const auto& a, const auto& b) { return a.pressure < b.pressure; });
  if (used.size() < 3 || !(used.front().pressure < used.back().pressure)) {
    return {none, fit_status::too_few_points};
  }
  const auto cost = [&](double a, double b) {
    double sum = 0;
    for (const retention_sample& s : used) {
      const double d = van_genuchten::effective(a, b, s.pressure) - s.saturation;
      sum += d * d;
    }
    return sum;
  };
  const double middle = used[used.size() / 2].pressure;
  double a = 0;
  double b = 0;
  double best = std::numeric_limits<double>::infinity();
  for (const double n : {1.3, 2.0, 4.0, 8.0, 16.0, 32.0}) {
    for (const double shift : {0.5, 0.7, 1.0, 1.4, 2.0}) {
      const double start_a = std::log(shift / middle);
      const double start_b = std::log(n - 1);
      const double c = cost(start_a, start_b);
      if (c < best) {
        best = c;
        a = start_a;
        b = start_b;
      }
    }
  }
  double damping = 1e-3;
  bool converged = false;
  bool stuck = false;  // no step, however short, lowers the cost
  for (int step = 0; step < 200 && !converged && !stuck; ++step) {
    std::array<double, 3> h{};  // normal matrix: aa, ab, bb
    std::array<double, 2> g{};
    const double n = 1 + std::exp(b);
    const double m = 1 - 1 / n;
    for (const retention_sample& s : used) {
      const double value = van_genuchten::effective(a, b, s.pressure);
      const double log_x = a + std::log(s.pressure);
      const double x = n * log_x;
      const double share = x > 0 ? 1 / (1 + std::exp(-x)) : std::exp(x) / (1 + std::exp(x));  // X / (1 + X)
      const double log_sum = x > 0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x));
      const double by_a = -value * m * n * share;
      const double by_n = -value * (log_sum / (n * n) + m * share * log_x);
      const double by_b = by_n * (n - 1);
      const double d = value - s.saturation;
      h = {h[0] + by_a * by_a, h[1] + by_a * by_b, h[2] + by_b * by_b};
      g = {g[0] + by_a * d, g[1] + by_b * d};
    }
    for (;; damping *= 4) {
      const double aa = h[0] * (1 + damping);
      const double bb = h[2] * (1 + damping);
      const double det = aa * bb - h[1] * h[1];
      const double da = (-g[0] * bb + g[1] * h[1]) / det;
      const double db = (-g[1] * aa + g[0] * h[1]) / det;
      const bool usable = std::isfinite(da) && std::isfinite(db);
      const bool small = usable && std::abs(da) < 1e-11 * (1 + std::abs(a)) && std::abs(db) < 1e-11 * (1 + std::abs(b));
      const double c = usable ? cost(a + da, b + db) : std::numeric_limits<double>::infinity();
      if (c <= best) {
        a += da;
        b += db;
        best = c;
        damping = std::max(damping / 9, 1e-14);
        converged = small;
        break;
      }
      if (small || damping > 1e12) {
        converged = small;
        stuck = !small;
        break;
      }
    }
  }
  if (!converged) {
    return {none, fit_status::not_converged};
  }
  const van_genuchten law{std::exp(a), 1 + std::exp(b), residual};
  return {{law, (1 - residual) * std::sqrt(best / static_cast<double>(used.size())), used.size()}, fit_status::ok};
}

/// The law fitted to a curve (anything with pressure_at(s) and end_saturation()), sampled at equal steps of saturation,
/// so that a stretch of many small events weighs no more than one of few large ones. The residual of the law is the
/// saturation at the end of the curve, which for a retention_curve is a sum of volumes and never below 0; where nothing
/// drained it is 1, and the answer is invalid_input.
template <class Curve>
  requires requires(const Curve& c) {
    c.pressure_at(0.5);
    c.end_saturation();
  }
[[nodiscard]] outcome<van_genuchten_fit, fit_status> fit_van_genuchten(const Curve& curve, std::size_t samples = 200) {
  const double residual = curve.end_saturation();
  std::vector<retention_sample> taken;
  for (std::size_t k = 0; k < samples; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(samples);
    const double s = 1 - share * (1 - residual);
    if (const auto pressure = curve.pressure_at(s)) {
      taken.push_back({*pressure, s});
    }
  }
  return fit_van_genuchten(std::span<const retention_sample>(taken), residual);
}

}  // namespace tetrapore::inline TETRAPORE_ABI
