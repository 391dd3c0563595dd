// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/rupture_fits.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// The fit of Willett's appendix: ln(F / 2πRσ) = f₁ − f₂ exp(f₃ ln S + f₄ ln² S), S = (D/2) / √(V/R), each f a
/// polynomial in ln(V/R³) and θ. Unequal radii by the radius of Derjaguin, as in the paper.
/// \par Units   surface tension [N/m], angle [rad], result [N]
/// \par Domain  two spheres; 1e-3 ≤ V/R³ ≤ 0.1, R of Derjaguin; θ ≤ 50°; gaps from 0 on
/// \par Accuracy  equal spheres 8.5 / 2.1 % (θ = 0: 4.9 / 1.3 %), radii 1 : 2 7.2 / 2.0 %, 1 : 10 12 / 3.0 %; 35 % just
///                before rupture
/// \par Source  Willett et al. 2000, Langmuir 16, 9396, appendix; rupture Eq. (15)
template <class Rupture = willett_rupture>
struct willett {
  required<double> surface_tension;
  double contact_angle = 0;
  Rupture rupture = {};

  /// Relative error of the force over the domain, radii up to 1 : 10, gaps up to 0.9 of the rupture gap; worst measured
  /// 0.12.
  static constexpr double stated_accuracy = 0.15;

  template <real T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    using std::exp;
    using std::log;
    using std::sqrt;
    const T radius = detail::derjaguin_radius(e);
    const T reduced = liquid.value / (radius * radius * radius);
    const bool outside =
        detail::before_plane(e) || contact_angle > detail::largest_fitted_angle || !detail::within(reduced, 1e-3, 0.1);
    const bridge_status found = detail::admit_fit(*this, e, liquid.value, outside);
    if (found != bridge_status::ok) {
      return detail::no_pull<T>(found);
    }
    const auto f = [this](double a, double b, double c) {  // a power's coefficient, itself a polynomial in the angle
      return detail::fit_number<T>(a + (b + c * contact_angle) * contact_angle);
    };
    const T l = log(reduced);
    T exponent = f(-0.44507, 0.050832, -1.1466) +
                 (f(-0.1119, -0.000411, -0.1490) +
                  (f(-0.012101, -0.0036456, -0.01255) + f(-0.0005, -0.0003505, -0.00029076) * l) * l) *
                     l;
    if (e.gap > T(0)) {
      const T f2 =
          f(1.9222, -0.57473, -1.2918) + (f(-0.0668, -0.1201, -0.22574) + f(-0.0013375, -0.0068988, -0.01137) * l) * l;
      const T f3 =
          f(1.268, -0.01396, -0.23566) +
          (f(0.198, 0.092, -0.06418) + (f(0.02232, 0.02238, -0.009853) + f(0.0008585, 0.001318, -0.00053) * l) * l) * l;
      const T f4 = f(-0.010703, 0.073776, -0.34742) +
                   (f(0.03345, 0.04543, -0.09056) + f(0.0018574, 0.004456, -0.006257) * l) * l;
      const T s = log(e.gap / (T(2) * sqrt(liquid.value / radius)));
      exponent = exponent - f2 * exp((f3 + f4 * s) * s);
    }
    const T scale = detail::fit_number<T>(2 * pi<double> * surface_tension);
    return {{scale * radius * exp(exponent)}, bridge_status::ok};
  }
};
static_assert(bridge_law<willett<>>);

/// F = 2πRσ cos θ / (1 + 2.1 S + 10 S²), S = (D/2) / √(V/R): the fit for little liquid. Unequal radii by the radius of
/// Derjaguin, as in the paper.
/// \par Units   surface tension [N/m], angle [rad], result [N]
/// \par Domain  two spheres; V/R³ ≤ 0.1, R of Derjaguin; θ ≤ 50°; gaps from 0 on
/// \par Accuracy  v = 1e-6 to 1e-3: 54 / 20 % (θ = 0: 17 / 9 %), and within 11 % of the force at contact; above 61 /
///                25 %, 61 % at contact too: the paper means it for v below 1e-3
/// \par Source  Willett et al. 2000, Langmuir 16, 9396, Eq. (12); rupture Eq. (15)
template <class Rupture = willett_rupture>
struct willett_small {
  required<double> surface_tension;
  double contact_angle = 0;
  Rupture rupture = {};

  /// Relative error of the force over the domain, v from 1e-6 on, radii up to 1 : 10, gaps up to 0.9 of the rupture
  /// gap; worst measured 0.70.
  static constexpr double stated_accuracy = 0.8;

  template <real T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    using std::sqrt;
    const T radius = detail::derjaguin_radius(e);
    const T reduced = liquid.value / (radius * radius * radius);
    const bool outside =
        detail::before_plane(e) || contact_angle > detail::largest_fitted_angle || !detail::within(reduced, 0, 0.1);
    const bridge_status found = detail::admit_fit(*this, e, liquid.value, outside);
    if (found != bridge_status::ok) {
      return detail::no_pull<T>(found);
    }
    const T s = e.gap / (T(2) * sqrt(liquid.value / radius));
    const T scale = detail::fit_number<T>(2 * pi<double> * surface_tension * std::cos(contact_angle));
    return {{scale * radius / (T(1) + (detail::fit_number<T>(2.1) + T(10) * s) * s)}, bridge_status::ok};
  }
};
static_assert(bridge_law<willett_small<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
