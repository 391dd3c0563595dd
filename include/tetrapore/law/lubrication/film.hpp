// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"
#include "tetrapore/core/real.hpp"

/// \file
/// Steps in time of a film that is squeezed, for any length of the step: the thickness stays positive, because it
/// is the one positive root of the step's equation. The film between elastic grains, and between two free masses.

namespace tetrapore::inline TETRAPORE_ABI {

/// Why a step of a film is what it is.
enum class film_status : unsigned char {
  ok,
  step_too_long,  ///< failed: this scheme has no positive thickness, or none that a number can hold, after such a step
  invalid_input   ///< refused: NaN, a thickness, drag, mass or time that is not positive, a negative stiffness
};

[[nodiscard]] constexpr verdict verdict_of(film_status s) noexcept {
  switch (s) {
    case film_status::ok: return verdict::ok;
    case film_status::step_too_long: return verdict::failed;
    case film_status::invalid_input: break;
  }
  return verdict::refused;
}

[[nodiscard]] constexpr const char* describe(film_status s) noexcept {
  switch (s) {
    case film_status::ok: return "ok";
    case film_status::step_too_long: return "the scheme has no positive thickness after a step of this length";
    case film_status::invalid_input: return "a thickness, drag, mass, stiffness or time outside the domain";
  }
  return "not a film status";
}
static_assert(status<film_status>);

/// What is stepped in time.
enum class film_variable : unsigned char {
  thickness,  ///< u: the step is a quadratic equation
  logarithm   ///< ln u: exact under a constant force, and of the balance of momentum and drag; a few Newton steps
};

/// A scheme: theta = 1 is backward Euler, 1/2 is of second order. Backward Euler in the thickness has a positive answer
/// for every step; the others refuse a step that takes them out of the numbers.
struct film_scheme {
  film_variable variable = film_variable::thickness;
  double theta = 1;
};

/// A film in series with the stiffness of the grains, and asperities beside it:
///
///   ν u'/u = k (u_n − u) + k_a (u_a − u)₊ u_a/u
///
/// Asperities give way with the stiffness k_a where the film begins to be thinner than they are, and without bound
/// where it vanishes: plain springs under a load beyond k_a u_a would let the film thin out of the numbers. u is the
/// thickness of the film, u_n the gap of the undeformed grains (negative in an overlap), ν = h × squeeze resistance,
/// 6 π μ a*² to leading order.
/// \par Units  drag [N s], stiffnesses [N/m], height [m]
template <real T>
struct elastic_film {
  T drag;                  ///< ν
  T stiffness;             ///< k, of the two grains in series
  T asperity_height{};     ///< u_a: thickness at which asperities begin to carry; 0: smooth grains
  T asperity_stiffness{};  ///< k_a

  /// Rate of growth u'/u [1/s].
  [[nodiscard]] constexpr T growth(const T& thickness, const T& gap) const noexcept {
    T force = stiffness * (gap - thickness);
    if (thickness < asperity_height) {
      force = force + asperities(thickness);
    }
    return force / drag;
  }

  /// What the asperities carry [N] where the film is thinner than they are, and the energy that they store [J].
  [[nodiscard]] constexpr T asperities(const T& thickness) const noexcept {
    return asperity_stiffness * (asperity_height - thickness) * (asperity_height / thickness);
  }
  [[nodiscard]] T asperity_energy(const T& thickness) const noexcept {
    using std::log;
    return asperity_stiffness * asperity_height *
           (asperity_height * log(asperity_height / thickness) - (asperity_height - thickness));
  }
};

namespace detail {

/// The positive root of a u² + b u − c = 0, a ≥ 0, c > 0, without cancellation; infinite or negative where a = 0 has
/// none.
template <real T>
[[nodiscard]] T positive_root(const T& a, const T& b, const T& c) noexcept {
  using std::sqrt;
  const T size = b < T(0) ? -b : b;
  const T mixed = T(2) * sqrt(a) * sqrt(c);
  const T larger = size < mixed ? mixed : size;  // no square leaves the numbers
  const T smaller = size < mixed ? size : mixed;
  const T root = larger * sqrt(T(1) + (smaller / larger) * (smaller / larger));
  return b < T(0) ? (root - b) / (T(2) * a) : T(2) * c / (root + b);
}

inline constexpr int newton_limit = 100;

/// y with y + a (e^y − 1) + b (1 − e^(−y)) = c, a, b ≥ 0: the left side grows. Newton's iteration, halved where it
/// leaves what is known to hold the root. NaN when it does not converge.
template <real T>
[[nodiscard]] T logarithmic_growth(const T& a, const T& b, const T& c) noexcept {
  using std::exp;
  using std::expm1;
  using std::log1p;
  // y lies between 0 and what each term alone would make of it
  T y = c;
  const bool grows = c > T(0);
  const auto nearer = [&y, grows](const T& other) {
    if (grows ? other < y : y < other) {
      y = other;
    }
  };
  if (a > T(0) && (grows || -c < a)) {
    nearer(log1p(c / a));
  }
  if (b > T(0) && (!grows || c < b)) {
    nearer(-log1p(-c / b));
  }
  T low = grows ? T(0) : y;
  T high = grows ? y : T(0);
  T last(infinity<T>);
  for (int k = 0; k < newton_limit; ++k) {  // steps shrink until they are rounding
    const T value = y + a * expm1(y) - b * expm1(-y) - c;
    (value > T(0) ? high : low) = y;
    T next = y - value / (T(1) + a * exp(y) + b * exp(-y));
    const bool inside = !(next < low) && !(high < next);
    if (!inside) {
      next = low + (high - low) * T(0.5);
    }
    const T size = next < y ? y - next : next - y;
    y = next;
    if (!(T(epsilon<T>) * (y < T(0) ? -y : y) < size) || (k > 1 && inside && !(size < last) && size < T(1e-3))) {
      return y;
    }
    last = size;
  }
  return T(quiet_nan<T>);
}

template <real T>
[[nodiscard]] constexpr outcome<T, film_status> no_film(film_status why) noexcept {
  return {T(quiet_nan<T>), why};
}

template <real T>
[[nodiscard]] constexpr bool positive_number(const T& x) noexcept {
  return x > T(0) && x < T(infinity<T>);
}

}  // namespace detail

/// Thickness of the film after a step.
/// \param before, after  the undeformed gap u_n at the two ends of the step
/// \par Units   lengths [m], time [s]
/// \par Domain  thickness, drag, time > 0; stiffnesses, height ≥ 0; 0 ≤ theta ≤ 1. With theta = 1 in the thickness any
///              step has an answer, else step_too_long
/// \par Accuracy  the step's equation to rounding (16 epsilon); of the first order, of the second with theta = 1/2; the
///                logarithm with k = 0 and no asperities: exact
/// \par Source  u² + b u + c = 0 with c < 0 has one positive root: backward Euler for the film; the other schemes: own
///              derivation. The exact solutions it is tested on: u_n/(1 + (u_n/u_0 − 1) e^(−k u_n t/ν)) for constant
///              u_n
template <real T>
[[nodiscard]] outcome<T, film_status> step_film(const elastic_film<T>& film, const T& thickness, const T& before,
                                                const T& after, const T& time,
                                                const film_scheme& scheme = {}) noexcept {
  using std::exp;
  const T limit(infinity<T>);
  if (!detail::positive_number(thickness) || !detail::positive_number(film.drag) || !detail::positive_number(time) ||
      !(film.stiffness >= T(0)) || !(film.stiffness < limit) || !(film.asperity_height >= T(0)) ||
      !(film.asperity_height < limit) || !(film.asperity_stiffness >= T(0)) || !(film.asperity_stiffness < limit) ||
      !(before < limit) || !(-limit < before) || !(after < limit) || !(-limit < after) ||
      !(scheme.theta >= 0 && scheme.theta <= 1)) {
    return detail::no_film<T>(film_status::invalid_input);
  }
  const T theta = T(static_cast<underlying_t<T>>(scheme.theta));
  const T now = (T(1) - theta) * film.growth(thickness, before) * time;  // growth by the state before the step
  const T weight = theta * (time / film.drag);
  const auto solve = [&](const T& rough) -> T {  // rough: stiffness of the asperities, where they carry
    const T load = film.stiffness * after - rough * film.asperity_height;  // growth: (load − k u + rough u_a²/u)/ν
    const T wedge = rough * film.asperity_height * film.asperity_height;
    if (scheme.variable == film_variable::logarithm) {
      const T pushed = now + weight * (load - film.stiffness * thickness + wedge / thickness);
      return thickness *
             exp(detail::logarithmic_growth(weight * film.stiffness * thickness, weight * (wedge / thickness), pushed));
    }
    const T held = thickness * (T(1) + now) + weight * wedge;
    return held > T(0) ? detail::positive_root(weight * film.stiffness, T(1) - weight * load, held) : T(0);
  };
  T next = solve(T(0));
  if (!(next > film.asperity_height) && film.asperity_stiffness > T(0)) {
    next = solve(film.asperity_stiffness);
  }
  if (!detail::positive_number(next)) {
    return detail::no_film<T>(film_status::step_too_long);
  }
  return {next, film_status::ok};
}

/// The gap between two masses and its rate.
/// \par Units  [m], [m/s]
template <real T>
struct approach {
  T gap;
  T rate;  ///< positive: it opens
};

/// Two rigid grains in a constant force with the film between them, m h'' = F − ν h'/h, after a step.
/// \param mass   the reduced mass m1 m2/(m1 + m2)
/// \param drag   ν, h × squeeze resistance
/// \param force  F, positive where it opens the gap
/// \par Units   [kg], [N s], [N], time [s]
/// \par Domain  mass, drag, time, gap > 0
/// \par Accuracy  the step's equation to rounding. Stepped by the logarithm, mass × rate + drag × ln(gap) − force ×
///                time is kept to rounding, whatever the step, so that a free approach never touches; by the thickness
///                (backward Euler) it is so to the first order, and the gap is positive after any step
/// \par Source  own derivation; the constant of free approach: the integral of m h'' = −ν h'/h
template <real T>
[[nodiscard]] outcome<approach<T>, film_status> step_approach(
    const approach<T>& from, const T& mass, const T& drag, const T& force, const T& time,
    film_variable variable = film_variable::logarithm) noexcept {
  using std::exp;
  using std::expm1;
  const T limit(infinity<T>);
  const T none(quiet_nan<T>);
  if (!detail::positive_number(from.gap) || !detail::positive_number(mass) || !detail::positive_number(drag) ||
      !detail::positive_number(time) || !(from.rate < limit) || !(-limit < from.rate) || !(force < limit) ||
      !(-limit < force)) {
    return {{none, none}, film_status::invalid_input};
  }
  const T push = (mass * from.rate + force * time) / drag;  // ln of the gap's growth if there were no inertia
  const T inertia = (mass / drag) * (from.gap / time);
  approach<T> to{none, none};
  if (variable == film_variable::logarithm) {
    const T y = detail::logarithmic_growth(inertia, T(0), push);
    to.gap = from.gap * exp(y);
    to.rate = (from.gap / time) * expm1(y);
  } else {
    // inertia (u/h − 1) + (1 − h/u) = push, u the new gap over the old one
    const T u = detail::positive_root(inertia, T(1) - inertia - push, T(1));
    to.gap = from.gap * u;
    to.rate = (from.gap / time) * (push / (inertia + T(1) / u));
  }
  if (!detail::positive_number(to.gap) || !(to.rate < limit) || !(-limit < to.rate)) {
    return {{none, none}, film_status::step_too_long};
  }
  return {to, film_status::ok};
}

}  // namespace tetrapore::inline TETRAPORE_ABI
