// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// \file
/// Radii of n grains that follow a size distribution. They are its quantiles at (k + ½)/n, in rising order, so that a
/// sample of any size has the distribution without scatter; the generator places them at random.

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

inline void check_positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw parameter_error(name, short_number(value), "a finite number above 0");
  }
}

[[nodiscard]] inline double middle(std::size_t k, std::size_t n) noexcept {
  return (static_cast<double>(k) + 0.5) / static_cast<double>(n);
}

}  // namespace detail

/// Radii uniform by number between (1 - spread) and (1 + spread) times the mean.
/// \par Units  [m]
inline std::vector<double> uniform_radii(std::size_t n, double mean, double spread) {
  detail::check_positive("mean radius", mean);
  if (!(spread >= 0 && spread < 1)) {
    throw parameter_error("spread", short_number(spread), "a number from 0 to below 1");
  }
  std::vector<double> radii(n);
  for (std::size_t k = 0; k < n; ++k) {
    radii[k] = mean * (1.0 + spread * (2.0 * detail::middle(k, n) - 1.0));
  }
  return radii;
}

/// Radii lognormal by number: ln r is normal about ln(median) with standard deviation `sigma`.
/// \par Units  [m]
/// \par Accuracy  quantiles to 1e-12; their last bits depend on the platform's exp and erfc
inline std::vector<double> lognormal_radii(std::size_t n, double median, double sigma) {
  detail::check_positive("median radius", median);
  if (!(sigma >= 0 && sigma < 2)) {
    throw parameter_error("sigma of ln r", short_number(sigma), "a number from 0 to below 2");
  }
  std::vector<double> radii(n);
  double x = -8.0;
  for (std::size_t k = 0; k < n; ++k) {  // the standard normal quantile, by bisection above the last one
    const double wanted = detail::middle(k, n);
    double lo = x;
    double hi = 8.5;
    for (int bisection = 0; bisection < 64 && hi - lo > 1e-13 * (1.0 + std::abs(lo)); ++bisection) {
      const double mid = 0.5 * (lo + hi);
      (0.5 * std::erfc(-mid / std::sqrt(2.0)) < wanted ? lo : hi) = mid;
    }
    x = lo;
    radii[k] = median * std::exp(sigma * 0.5 * (lo + hi));
  }
  return radii;
}

/// A point of a grading curve.
struct mass_below {
  double diameter;  ///< [m]
  double fraction;  ///< of the mass of all grains, in grains of at most this diameter
};

/// Radii from a grading curve: cumulative mass fraction against diameter, straight between its points; two points at
/// one diameter make a step, that is, grains of exactly that size. Grains are counted: the number of grains of diameter
/// d is the mass over d³.
/// \par Units  [m]
/// \throw parameter_error  a curve that does not rise from 0 to 1 over rising diameters
inline std::vector<double> radii_by_mass(std::size_t n, std::span<const mass_below> curve) {
  const auto point = [](std::size_t k) { return "grading curve, point " + std::to_string(k + 1); };
  if (curve.size() < 2 || curve.front().fraction != 0.0 || curve.back().fraction != 1.0) {
    throw parameter_error("grading curve",
                          curve.empty() ? "no points"
                                        : "mass fractions from " + short_number(curve.front().fraction) + " to " +
                                              short_number(curve.back().fraction),
                          "at least two points, from fraction 0 to fraction 1");
  }
  std::vector<double> number(curve.size(), 0.0);  // cumulative, of grains, up to a factor
  for (std::size_t k = 0; k < curve.size(); ++k) {
    detail::check_positive(point(k).c_str(), curve[k].diameter);
    if (k == 0) {
      continue;
    }
    const double d0 = curve[k - 1].diameter;
    const double d1 = curve[k].diameter;
    const double mass = curve[k].fraction - curve[k - 1].fraction;
    if (!(d1 >= d0) || !(mass >= 0)) {
      throw parameter_error(point(k), "diameter " + short_number(d1) + ", fraction " + short_number(curve[k].fraction),
                            "values that do not fall");
    }
    // ∫ mass/(d1 - d0) d⁻³ dd = mass (d0 + d1) / (2 d0² d1²), which is also right for a step.
    const double r = curve[0].diameter;
    number[k] = number[k - 1] + mass * (d0 + d1) / 2.0 * (r / d0) * (r / d0) * (r / d1) * (1.0 / d1);
  }
  std::vector<double> radii(n);
  std::size_t k = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double wanted = detail::middle(i, n) * number.back();
    while (k + 1 < curve.size() && !(number[k] > wanted)) {
      ++k;
    }
    const double d0 = curve[k - 1].diameter;
    const double d1 = curve[k].diameter;
    const double part = (wanted - number[k - 1]) / (number[k] - number[k - 1]);
    const double ratio2 = (d0 / d1) * (d0 / d1);  // d⁻² falls linearly with the count
    radii[i] = d0 == d1 ? 0.5 * d0 : 0.5 * d0 / std::sqrt(1.0 - part * (1.0 - ratio2));
  }
  return radii;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
