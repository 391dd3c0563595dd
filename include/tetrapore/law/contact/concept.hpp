// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/lubrication/apply.hpp"

#include <initializer_list>

/// \file
/// What a contact law is: forces of a pair that remembers its past, over one step in time.
/// \par Source  Cundall & Strack 1979, Géotechnique 29, 47: contacts step by step; the film in series: own derivation

namespace tetrapore::inline TETRAPORE_ABI {

/// Why a contact is what it is.
enum class contact_status : unsigned char {
  ok,
  apart,          ///< absent: out of reach, no force; the state starts anew
  not_covered,    ///< refused: the lubrication law does not cover this pair
  no_film,        ///< refused: grains that overlap from the start, and nothing says how thick the film between them is
  step_too_long,  ///< failed: no number holds the thickness of the film after such a step
  invalid_input   ///< refused: NaN, a parameter, radius, time or state outside its domain
};

[[nodiscard]] constexpr verdict verdict_of(contact_status s) noexcept {
  switch (s) {
    case contact_status::ok: return verdict::ok;
    case contact_status::apart: return verdict::absent;
    case contact_status::step_too_long: return verdict::failed;
    case contact_status::not_covered:
    case contact_status::no_film:
    case contact_status::invalid_input: break;
  }
  return verdict::refused;
}

[[nodiscard]] constexpr const char* describe(contact_status s) noexcept {
  switch (s) {
    case contact_status::ok: return "ok";
    case contact_status::apart: return "the grains are out of reach of each other";
    case contact_status::not_covered: return "the lubrication law does not cover a pair like this";
    case contact_status::no_film:
      return "the grains overlap from the start and the thickness of their film is not given";
    case contact_status::step_too_long: return "no number holds the thickness of the film after a step of this length";
    case contact_status::invalid_input: return "a radius, gap, time, parameter or state outside the domain";
  }
  return "not a contact status";
}
static_assert(status<contact_status>);

/// What a pair does at the end of a step.
/// \par Units  [N], [N m], [m], [J]
template <real T>
struct contact_forces {
  pair_forces<T> on{};   ///< both grains
  T pull{};              ///< normal force, positive where it pulls the grains together
  vec3<T> shear{};       ///< tangential force on grain 1
  T asperities{};        ///< what solid touching solid carries of the normal force (≥ 0)
  T thickness{};         ///< of the film
  bool sliding = false;  ///< whether the surfaces slip on each other
  T stored{};            ///< elastic energy
  T dissipated{};        ///< over the step
};

/// The contact of a pair.
/// Syntax: `l.start(edge)` gives a state; `l.step(edge, motion, time, state)`, const and noexcept, changes it and gives
/// an outcome<contact_forces, contact_status>.
/// Semantics: the edge is that of the end of the step, the motion the mean over it; forces opposite, torques balance;
/// dissipated ≥ 0; a rigid motion of the pair turns the forces and changes nothing else; where the law has no answer
/// the state is kept.
/// Models: wet_contact<Film>, dry_contact.
template <class L, class T = double>
concept contact_law =
    real<T> && std::copyable<L> &&
    requires(const L l, const edge<T> e, const pair_motion<T> m, const T time, decltype(l.start(e)) state) {
      { l.step(e, m, time, state) } noexcept -> std::same_as<outcome<contact_forces<T>, contact_status>>;
    };

namespace detail {

template <real T>
[[nodiscard]] constexpr outcome<contact_forces<T>, contact_status> no_contact_forces(contact_status why) noexcept {
  const T none(quiet_nan<T>);
  const vec3<T> nowhere{none, none, none};
  return {{{nowhere, nowhere, nowhere, nowhere}, none, nowhere, none, none, false, none, none}, why};
}

template <real T>
[[nodiscard]] constexpr contact_status admit_contact(const edge<T>& e, const T& time,
                                                     std::initializer_list<double> positive, double friction) noexcept {
  const T limit(infinity<T>);
  for (const double x : positive) {
    if (!(x > 0 && x < infinity<double>)) {
      return contact_status::invalid_input;
    }
  }
  return friction >= 0 && friction < infinity<double> && e.radius1 > T(0) && e.radius1 < limit && e.radius2 > T(0) &&
                 e.gap > -e.radius1 && e.gap > -e.radius2 && e.gap < limit && time > T(0) && time < limit &&
                 unit(e.normal)
             ? contact_status::ok
             : contact_status::invalid_input;
}

/// A force in the tangent plane carried along with the pair: its size kept, turned from the old normal to the new one
/// and by an angle about it.
template <real T>
[[nodiscard]] vec3<T> turned(const vec3<T>& force, const vec3<T>& from, const vec3<T>& to, const T& angle) noexcept {
  using std::cos;
  using std::sin;
  const T slope = T(1) + dot(from, to);
  if (!(slope > T(0))) {
    return {};  // the pair has been turned end over end in one step
  }
  const vec3<T> along = from + to;
  const vec3<T> flat = force - along * (dot(force, to) / slope);  // the shortest rotation of normal to normal
  return flat * cos(angle) + cross(to, flat) * sin(angle);
}

/// The normal half way through a step.
template <real T>
[[nodiscard]] vec3<T> halfway(const vec3<T>& from, const vec3<T>& to) noexcept {
  const vec3<T> sum = from + to;
  const T size = norm(sum);
  return size > T(0) ? sum / size : to;
}

/// A spring in series with a dashpot and a friction that acts beside it.
template <real T>
struct slider {
  vec3<T> force;  ///< of the spring, after the step
  vec3<T> rate;   ///< of sliding
  bool slides;
};

/// \param trial      force of the spring if nothing slid
/// \param friction   force below which nothing slides
/// \param stiffness  of the spring, times the step
template <real T>
[[nodiscard]] slider<T> slide(const vec3<T>& trial, const T& friction, const T& stiffness, const T& drag) noexcept {
  const T size = norm(trial);
  if (!(friction < size)) {
    return {trial, {}, false};
  }
  // |f| = |trial| − stiffness × rate and |f| = friction + drag × rate
  const T rate = (size - friction) / (stiffness + drag);
  const vec3<T> direction = trial / size;
  return {direction * (friction + drag * rate), direction * rate, true};
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
