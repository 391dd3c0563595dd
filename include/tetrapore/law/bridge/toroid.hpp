// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/lambert.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// The root of a function of w in (0, widest] that falls, has one least value and rises again, or rises from the start:
/// the root on the rising side.
template <real T>
struct upper_root {
  T value;  ///< in: a guess; out: the root
  T widest;

  /// ok, ruptured where the least value is positive, not_covered where there is no positive value up to the widest.
  template <class F>
  [[nodiscard]] bridge_status find(const F& f) noexcept {
    if (!(value < widest)) {
      value = widest;
    }
    T right = value;
    T at_right = f(right);
    T left = right;
    T at_left = at_right;
    if (!(at_right > T(0))) {
      return climb(f, right, at_right);
    }
    for (int step = 0; step < step_limit; ++step) {  // down the rising side, by halves
      const T next = left * T(0.5);
      const T at_next = f(next);
      if (at_next < T(0)) {
        return between(f, next, at_next, left, at_left);
      }
      if (!(at_next < at_left)) {
        return past_the_least(f, next, left, at_left, right, at_right);
      }
      right = left;
      at_right = at_left;
      left = next;
      at_left = at_next;
    }
    return bridge_status::not_converged;
  }

 private:
  static constexpr int step_limit = 200;

  /// From a point below the root up to one above it, by doubling.
  template <class F>
  [[nodiscard]] bridge_status climb(const F& f, T left, T at_left) noexcept {
    for (int step = 0; step < step_limit && left < widest; ++step) {
      const T next = left * T(2) < widest ? left * T(2) : widest;
      const T at_next = f(next);
      if (at_next > T(0)) {
        return between(f, left, at_left, next, at_next);
      }
      left = next;
      at_left = at_next;
    }
    return bridge_status::not_covered;
  }

  /// No negative value yet, but the function rises on both sides of `middle`, or falls beyond it: looks for a negative
  /// value around the least one.
  template <class F>
  [[nodiscard]] bridge_status past_the_least(const F& f, T left, T middle, T at_middle, T right, T at_right) noexcept {
    for (int step = 0; step < step_limit && !(at_right > at_middle); ++step) {
      if (!(right < widest)) {
        return bridge_status::ruptured;
      }
      if (right > middle) {
        left = middle;
        middle = right;
        at_middle = at_right;
      }
      right = right * T(2) < widest ? right * T(2) : widest;
      at_right = f(right);
      if (!(at_right > T(0))) {
        return climb(f, right, at_right);
      }
    }
    const T golden = fit_number<T>(0.3819660112501051);
    for (int step = 0; step < step_limit; ++step) {
      const bool upper = right - middle > middle - left;
      const T next = upper ? middle + golden * (right - middle) : middle - golden * (middle - left);
      const T at_next = f(next);
      if (at_next < T(0)) {
        return upper ? between(f, next, at_next, right, at_right) : between(f, next, at_next, middle, at_middle);
      }
      if (at_next < at_middle) {
        (upper ? left : right) = middle;
        at_right = upper ? at_right : at_middle;
        middle = next;
        at_middle = at_next;
      } else {
        at_right = upper ? at_next : at_right;
        (upper ? right : left) = next;
      }
      // the least value is flat: its place is known to the root of the rounding
      if (!((right - left) * (right - left) > T(epsilon<T>) * middle * middle)) {
        return bridge_status::ruptured;
      }
    }
    return bridge_status::not_converged;
  }

  /// The root between two points of opposite sign: regula falsi with the Illinois weight.
  template <class F>
  [[nodiscard]] bridge_status between(const F& f, T left, T at_left, T right, T at_right) noexcept {
    int side = 0;
    for (int step = 0; step < step_limit; ++step) {
      value = (left * at_right - right * at_left) / (at_right - at_left);
      const T here = f(value);
      if (here > T(0)) {
        right = value;
        at_right = here;
        at_left = side > 0 ? at_left * T(0.5) : at_left;
        side = 1;
      } else if (here < T(0)) {
        left = value;
        at_left = here;
        at_right = side < 0 ? at_right * T(0.5) : at_right;
        side = -1;
      } else {
        return value_of(here) == 0 ? bridge_status::ok : bridge_status::not_converged;
      }
      const T size = here > T(0) ? here : -here;
      if (!(right - left > T(2 * epsilon<T>) * right) || !(size > T(4 * epsilon<T>))) {
        return bridge_status::ok;
      }
    }
    return bridge_status::not_converged;
  }
};

}  // namespace detail

/// What the toroid answers. Lengths [m], angles [rad].
template <real T>
struct toroid_ring {
  T force;    ///< [N]
  T volume;   ///< [m³]
  T suction;  ///< [Pa]
  T neck;     ///< radius of the gorge
  T arc;      ///< radius of the meridian circle
  T filling1, filling2;  ///< half filling angles; on a plane the radius of the contact line
};

/// The bridge whose meridian is a circle that meets both surfaces at their contact angles: suction σ (1/ρ − 1/y), ρ the
/// radius of that circle and y that of the gorge, and the force through the gorge, πσ y (1 + y/ρ). Any two radii, a
/// plane, unequal angles. Its mean curvature is not constant, so it is no bridge at equilibrium: its force is not minus
/// the derivative of an energy.
/// \par Units   surface tension [N/m], angles [rad], force [N]
/// \par Domain  meridians that bend inwards, with the gorge between the contact lines, ρ up to 1000 times the smaller
///              radius: not_covered beyond; a gap without such a ring of that volume or suction: ruptured
/// \par Source  Haines 1925, J. Agric. Sci. 15, 529; Fisher 1926, ibid. 16, 492 (gorge); the ring of unequal radii and
///              angles, and its volume, derived here
struct toroid {
  required<double> surface_tension;
  double contact_angle1 = 0;
  double contact_angle2 = 0;

  template <real T>
  [[nodiscard]] outcome<toroid_ring<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    if (admit(e) != bridge_status::ok || !(value_of(liquid.value) >= 0) ||
        !(value_of(liquid.value) < infinity<T>)) {
      return none<T>(bridge_status::invalid_input);
    }
    if (!(value_of(liquid.value) > 0)) {
      return none<T>(bridge_status::no_liquid);
    }
    if (e.gap < T(0)) {
      return none<T>(bridge_status::not_covered);
    }
    const shape<T> s = shape_of(e);
    // the depth of a disc of liquid with an upright rim (Derjaguin), in terms of the rim's circle
    const T radius = detail::derjaguin_radius(e);
    const T cosine = detail::fit_number<T>((std::cos(contact_angle1) + std::cos(contact_angle2)) / 2);
    const T guess = (e.gap * T(0.5) + detail::immersion(e.gap, liquid.value, radius)) / cosine;
    return solve(e, s, guess, s.largest, [&](const toroid_ring<T>& r) { return r.volume / liquid.value - T(1); });
  }

  template <real T>
  [[nodiscard]] outcome<toroid_ring<T>, bridge_status> bridge(const edge<T>& e,
                                                              given_suction<T> tied) const noexcept {
    if (admit(e) != bridge_status::ok || !(value_of(tied.value) < infinity<T>) ||
        !(value_of(tied.value) > -infinity<T>)) {
      return none<T>(bridge_status::invalid_input);
    }
    if (e.gap < T(0)) {
      return none<T>(bridge_status::not_covered);
    }
    const shape<T> s = shape_of(e);
    const T tension = detail::fit_number<T>(surface_tension);
    const bool drawn = tied.value * s.largest > tension;  // the arc of this suction alone is narrower than the widest
    const T widest = drawn ? tension / tied.value : s.largest;
    return solve(e, s, widest * T(0.5), widest, [&](const toroid_ring<T>& r) { return (tied.value - r.suction) * r.arc / tension; });
  }

 private:
  /// The centre of the meridian circle of radius ρ lies at a + bρ from the first surface, along the axis; its gorge is
  /// open for ρ from `least` on, and lies between the contact lines up to `largest`.
  template <real T>
  struct shape {
    T a, b, least, largest;
  };

  template <real T>
  [[nodiscard]] static outcome<toroid_ring<T>, bridge_status> none(bridge_status why) noexcept {
    const T force = detail::no_pull<T>(why).value.force;
    const T unknown(quiet_nan<T>);
    return {{force, verdict_of(why) == verdict::absent ? T(0) : unknown, unknown, unknown, unknown, unknown, unknown},
            why};
  }

  template <real T>
  [[nodiscard]] bridge_status admit(const edge<T>& e) const noexcept {
    return detail::admit_pair(e, surface_tension, contact_angle1, contact_angle2);
  }

  template <real T>
  [[nodiscard]] shape<T> shape_of(const edge<T>& e) const noexcept {
    using std::sqrt;
    const T cos1 = detail::fit_number<T>(std::cos(contact_angle1));
    const T cos2 = detail::fit_number<T>(std::cos(contact_angle2));
    const bool flat = e.with_plane();
    const T distance = e.radius1 + e.radius2 + e.gap;
    shape<T> s;
    s.a = flat ? e.gap : e.gap * (e.gap + T(2) * e.radius2) / (T(2) * distance);
    s.b = flat ? -cos2 : (e.radius1 * cos1 - e.radius2 * cos2) / distance;
    // gorge closed: (a + bρ)² + 2R₁ (a + bρ) = 2R₁ρ cos θ₁
    const T quadratic = s.b * s.b;
    const T linear = T(2) * (e.radius1 * cos1 - s.b * (s.a + e.radius1));
    const T constant = s.a * (s.a + T(2) * e.radius1);
    const T root = sqrt(linear * linear - T(4) * quadratic * constant);
    s.least = T(2) * constant / (linear + root);
    s.largest = T(1000) * (e.radius1 < e.radius2 ? e.radius1 : e.radius2);
    // the contact line that the gorge reaches when the meridian there is level
    const T sin1 = detail::fit_number<T>(std::sin(contact_angle1));
    const T sin2 = detail::fit_number<T>(std::sin(contact_angle2));
    const T reach = s.b < T(0) ? (s.a + e.radius1 * (T(1) - sin1)) / -s.b
                               : (e.gap - s.a + e.radius2 * (T(1) - sin2)) / s.b;
    if (reach < s.largest) {
      s.largest = reach;
    }
    return s;
  }

  /// The half of the liquid beside one sphere, and the sine and cosine of its filling angle.
  template <real T>
  struct half {
    T sine, cosine, volume;
  };
  /// \param along  distance of the circle's centre from the sphere's, along the axis
  template <real T>
  [[nodiscard]] static half<T> beside(const T& radius, double angle, const T& along, const T& height,
                                      const T& arc) noexcept {
    const T c = detail::fit_number<T>(std::cos(angle));
    const T s = detail::fit_number<T>(std::sin(angle));
    const T scale = T(1) / (along * along + height * height);
    half<T> h;
    h.sine = (height * (radius + arc * c) - along * arc * s) * scale;
    h.cosine = (along * (radius + arc * c) + height * arc * s) * scale;
    const T rise = h.sine * h.sine / (T(1) + h.cosine);
    const T cap = T(pi<T>) / T(3) * radius * radius * radius * rise * rise * (T(3) - rise);
    h.volume = under(h.cosine * c - h.sine * s, h.sine * c + h.cosine * s, height, arc) - cap;
    return h;
  }
  /// Volume inside the meridian from the gorge to where its slope has this sine and cosine.
  template <real T>
  [[nodiscard]] static T under(const T& s, const T& c, const T& height, const T& arc) noexcept {
    using std::atan2;
    return T(pi<T>) * arc *
           (height * height * s - height * arc * (atan2(s, c) + s * c) + arc * arc * (s - s * s * s / T(3)));
  }

  template <real T>
  [[nodiscard]] toroid_ring<T> ring(const edge<T>& e, const shape<T>& m, const T& arc) const noexcept {
    using std::atan2;
    using std::sqrt;
    const T tension = detail::fit_number<T>(surface_tension);
    const T cos1 = detail::fit_number<T>(std::cos(contact_angle1));
    const T x = m.a + m.b * arc;
    const T square = T(2) * e.radius1 * arc * cos1 - x * (x + T(2) * e.radius1);  // height² − ρ²
    const T height = sqrt(arc * arc + square);
    toroid_ring<T> r;
    r.arc = arc;
    r.neck = square / (height + arc);
    r.suction = tension * (T(1) / arc - T(1) / r.neck);
    r.force = T(pi<T>) * tension * r.neck * (T(1) + r.neck / arc);
    const half<T> first = beside(e.radius1, contact_angle1, x + e.radius1, height, arc);
    r.filling1 = atan2(first.sine, first.cosine);
    if (e.with_plane()) {
      const T c = detail::fit_number<T>(std::cos(contact_angle2));
      const T s = detail::fit_number<T>(std::sin(contact_angle2));
      r.filling2 = height - arc * s;
      r.volume = first.volume + under(c, s, height, arc);
    } else {
      const half<T> second = beside(e.radius2, contact_angle2, e.gap + e.radius2 - x, height, arc);
      r.filling2 = atan2(second.sine, second.cosine);
      r.volume = first.volume + second.volume;
    }
    return r;
  }

  /// The ring for which `excess` vanishes, growing with the arc: of the two rings of a volume or suction the larger one.
  template <real T, class Excess>
  [[nodiscard]] outcome<toroid_ring<T>, bridge_status> solve(const edge<T>& e, const shape<T>& m, const T& guess,
                                                             const T& widest, const Excess& excess) const noexcept {
    if (!(m.least < widest)) {
      return none<T>(bridge_status::ruptured);
    }
    const auto at = [&](const T& w) { return ring(e, m, m.least + w); };
    const auto f = [&](const T& w) { return excess(at(w)); };
    detail::upper_root<T> root{guess > m.least ? guess - m.least : detail::fit_number<T>(1e-3) * guess, widest - m.least};
    const bridge_status found = root.find(f);
    return found == bridge_status::ok ? outcome<toroid_ring<T>, bridge_status>{at(root.value), found}
                                      : none<T>(found);
  }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
