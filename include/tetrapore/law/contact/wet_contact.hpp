// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/contact/concept.hpp"
#include "tetrapore/law/lubrication/apply.hpp"
#include "tetrapore/law/lubrication/film.hpp"
#include "tetrapore/law/lubrication/leading_order.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// Two elastic grains with a film of liquid between them, in contact or not: the grains' stiffness in series with the
/// film, and asperities that carry beside the film where it is thinner than they are high. One implicit step of any
/// length closes a step of a wet DEM:
///
///   normal   ν u'/u = k (u_n − u) + k_a (u_a − u)₊ u_a/u, backward Euler: the thickness u stays positive
///   shear    a spring k_s in series with the film (implicit Maxwell); where asperities carry N_a, nothing slides below
///            the friction × N_a, and above it friction and film add up
///   roll, twist, and the coupling of roll and shear: the film's, at its new thickness
///
/// The film's resistance is that of the lubrication law at the thickness u; its arms are those of the distance of the
/// centres, so that forces and torques balance about any point.
/// \par Units   stiffnesses [N/m], asperity height [m], friction 1
/// \par Domain  normal and shear stiffness > 0, the others ≥ 0; gap > −radius. Where the lubrication law refuses the
///              thickness as too far the grains are apart: no force, and the state starts anew
/// \par Accuracy  of the first order in the step. The work done on the pair covers what is stored and dissipated, for
///                every step, and every part dissipates
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.2; Marzougui, Chareyre & Chauchat 2015, Granular
///              Matter 17, 809, for film, spring and asperities; friction beside the film: own derivation
template <class Film = leading_order>
struct wet_contact {
  Film film;
  required<double> normal_stiffness;
  required<double> shear_stiffness;
  double friction = 0;
  double asperity_height = 0;
  double asperity_stiffness = 0;

  /// What a pair remembers from step to step.
  template <real T>
  struct state {
    T thickness{};     ///< u
    vec3<T> shear{};   ///< force of the shear spring on grain 1
    vec3<T> normal{};  ///< of the last step
  };

  /// A pair that comes into reach: the film fills the gap. Grains that touch or overlap from the start rest on their
  /// asperities, k (u − u_n) = k_a (u_a − u) u_a/u. Smooth ones have no thickness at rest: it has to be given, and a
  /// step says `no_film` until it is.
  template <real T>
  [[nodiscard]] state<T> start(const edge<T>& e) const noexcept {
    using std::sqrt;
    if (!(e.gap <= T(0))) {
      return {e.gap, {}, e.normal};
    }
    const auto number = [](double x) { return T(static_cast<underlying_t<T>>(x)); };
    const T held = number(asperity_stiffness) * number(asperity_height);
    const T linear = held - number(normal_stiffness) * e.gap;
    const T constant = held * number(asperity_height);
    if (!(constant > T(0))) {
      return {T(0), {}, e.normal};
    }
    const T root = sqrt(linear * linear + T(4) * number(normal_stiffness) * constant);
    return {T(2) * constant / (linear + root), {}, e.normal};
  }
  template <real T>
  [[nodiscard]] state<T> start(const edge<T>& e, const T& thickness) const noexcept {
    return {thickness, {}, e.normal};
  }

  /// One step. The edge is that of the end of the step, the motion the mean over it.
  template <real T>
    requires lubrication_law<Film, T>
  [[nodiscard]] outcome<contact_forces<T>, contact_status> step(const edge<T>& e, const pair_motion<T>& m,
                                                                const T& time, state<T>& s) const noexcept {
    using std::sqrt;
    const auto number = [](double x) { return T(static_cast<underlying_t<T>>(x)); };
    const contact_status first = detail::admit_contact(e, time, {normal_stiffness, shear_stiffness}, friction);
    if (first != contact_status::ok || !(s.thickness > T(0)) || !(asperity_height >= 0) || !(asperity_stiffness >= 0)) {
      const bool given_nothing = first == contact_status::ok && s.thickness <= T(0) && !(s.thickness < T(0));
      return detail::no_contact_forces<T>(given_nothing ? contact_status::no_film : contact_status::invalid_input);
    }
    edge<T> gap = e;
    gap.gap = s.thickness;
    const auto before = film.resistance(gap);
    if (!before.ok()) {
      return refused(before.reason, e, s);
    }
    const elastic_film<T> squeezed{before.value.squeeze * s.thickness, number(normal_stiffness),
                                   number(asperity_height), number(asperity_stiffness)};
    const auto thickness = step_film(squeezed, s.thickness, e.gap, e.gap, time);
    if (!thickness.ok()) {
      return detail::no_contact_forces<T>(thickness.reason == film_status::step_too_long
                                              ? contact_status::step_too_long
                                              : contact_status::invalid_input);
    }
    gap.gap = thickness.value;
    const auto now = film.resistance(gap);
    if (!now.ok()) {
      return refused(now.reason, e, s);
    }
    const pair_resistance<T>& r = now.value;
    const T half = e.gap * T(0.5);
    const T arm1 = e.radius1 + half;
    const T arm2 = e.with_plane() ? half : e.radius2 + half;
    const vec3<T> middle = detail::halfway(s.normal, e.normal);
    relative_motion<T> v = relative_motion_of(m, middle, arm1, arm2);
    v.slip = detail::turned(v.slip, middle, e.normal, T(0));
    v.roll = detail::turned(v.roll, middle, e.normal, T(0));

    contact_forces<T> answer;
    answer.thickness = thickness.value;
    answer.pull = squeezed.stiffness * (e.gap - thickness.value);
    const bool touching = thickness.value < squeezed.asperity_height;
    answer.asperities = touching ? squeezed.asperities(thickness.value) : T(0);
    const vec3<T> coupled = v.roll * r.coupling;
    const vec3<T> carried =
        detail::turned(s.shear, s.normal, e.normal, (dot(m.spin1 + m.spin2, middle)) * time * T(0.5));
    const vec3<T> trial = carried + v.slip * (number(shear_stiffness) * time);
    const detail::slider<T> sliding =
        detail::slide(trial - coupled, number(friction) * answer.asperities, number(shear_stiffness) * time, r.shear);
    const vec3<T> drag = sliding.force + coupled;
    const vec3<T> rolling = sliding.rate * r.coupling + v.roll * r.roll;
    answer.sliding = sliding.slides;
    answer.shear = drag;
    answer.on = detail::forces_of(e.normal, arm1, arm2, answer.pull, drag, rolling, r.twist * v.twist);
    const T growth = (thickness.value - s.thickness) / time;
    answer.dissipated = time * ((answer.pull + answer.asperities) * growth + dot(drag, sliding.rate) +
                                dot(rolling, v.roll) + r.twist * v.twist * v.twist);
    answer.stored = (answer.pull * answer.pull / squeezed.stiffness + norm2(drag) / number(shear_stiffness)) * T(0.5);
    if (touching) {
      answer.stored = answer.stored + squeezed.asperity_energy(thickness.value);
    }
    s = {thickness.value, drag, e.normal};
    return {answer, contact_status::ok};
  }

 private:
  template <real T>
  [[nodiscard]] static outcome<contact_forces<T>, contact_status> refused(pair_status why, const edge<T>& e,
                                                                          state<T>& s) noexcept {
    if (why == pair_status::too_far && e.gap > T(0)) {
      s = {e.gap, {}, e.normal};
      return {contact_forces<T>{}, contact_status::apart};
    }
    return detail::no_contact_forces<T>(why == pair_status::invalid_input ? contact_status::invalid_input
                                                                          : contact_status::not_covered);
  }
};
static_assert(contact_law<wet_contact<>, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
