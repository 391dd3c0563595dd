// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/contact/concept.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// Two elastic grains without liquid: linear springs where they overlap, and Coulomb's friction.
/// \par Units   stiffnesses [N/m], friction 1
/// \par Domain  stiffnesses > 0, friction ≥ 0; gap > −radius; apart where gap ≥ 0
/// \par Accuracy  rounding; the shear spring of the first order in the step
/// \par Source  Cundall & Strack 1979, Géotechnique 29, 47
struct dry_contact {
  required<double> normal_stiffness;
  required<double> shear_stiffness;
  double friction = 0;

  template <real T>
  struct state {
    vec3<T> shear{};
    vec3<T> normal{};
  };

  template <real T>
  [[nodiscard]] state<T> start(const edge<T>& e) const noexcept {
    return {{}, e.normal};
  }

  template <real T>
  [[nodiscard]] outcome<contact_forces<T>, contact_status> step(const edge<T>& e, const pair_motion<T>& m,
                                                                const T& time, state<T>& s) const noexcept {
    const auto number = [](double x) { return T(static_cast<underlying_t<T>>(x)); };
    if (detail::admit_contact(e, time, {normal_stiffness, shear_stiffness}, friction) != contact_status::ok) {
      return detail::no_contact_forces<T>(contact_status::invalid_input);
    }
    if (!(e.gap < T(0))) {
      s = start(e);
      return {contact_forces<T>{}, contact_status::apart};
    }
    const T half = e.gap * T(0.5);
    const T arm1 = e.radius1 + half;
    const T arm2 = e.with_plane() ? half : e.radius2 + half;
    const vec3<T> middle = detail::halfway(s.normal, e.normal);
    relative_motion<T> v = relative_motion_of(m, middle, arm1, arm2);
    v.slip = detail::turned(v.slip, middle, e.normal, T(0));
    contact_forces<T> answer;
    answer.pull = number(normal_stiffness) * e.gap;
    answer.asperities = -answer.pull;
    const vec3<T> carried = detail::turned(s.shear, s.normal, e.normal, dot(m.spin1 + m.spin2, middle) * time * T(0.5));
    const T spring = number(shear_stiffness) * time;
    const detail::slider<T> sliding =
        detail::slide(carried + v.slip * spring, number(friction) * answer.asperities, spring, T(0));
    answer.shear = sliding.force;
    answer.sliding = sliding.slides;
    answer.on = detail::forces_of(e.normal, arm1, arm2, answer.pull, answer.shear, vec3<T>{}, T(0));
    answer.dissipated = dot(answer.shear, sliding.rate) * time;
    answer.stored =
        (answer.pull * answer.pull / number(normal_stiffness) + norm2(answer.shear) / number(shear_stiffness)) * T(0.5);
    s = {answer.shear, e.normal};
    return {answer, contact_status::ok};
  }
};
static_assert(contact_law<dry_contact, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
