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
  T force;               ///< [N]
  T volume;              ///< [m³]
  T suction;             ///< [Pa]
  T neck;                ///< radius of the gorge
  T arc;                 ///< radius of the meridian circle
  T filling1, filling2;  ///< angles at the grains' centres between the axis and the contact circles; 0 on a plane
  T contact1, contact2;  ///< radii of the contact circles
};

/// The bridge whose meridian is a circle that meets both surfaces at their contact angles: suction σ (1/ρ − 1/y), ρ the
/// radius of that circle and y that of the gorge, and the force through the gorge, πσ y (1 + y/ρ). Any two radii, a
/// plane, unequal angles. Its mean curvature is not constant, so it is no bridge at equilibrium: its force is no
/// derivative of an energy. Under a volume it has rings far beyond the true rupture, which the rule (with the mean of
/// the angles) cuts off; under a suction it ruptures by itself.
/// \par Units   surface tension [N/m], angles [rad], force [N]
/// \par Domain  meridians that bend inwards, with the gorge between the contact lines, ρ up to 1000 times the smaller
///              radius: not_covered beyond
/// \par Accuracy  v = 1e-6 to 0.1, gaps up to 0.9 of the rupture gap: 7.2 / 4.7 % between spheres of any ratio, 8.8 /
///                4.9 % on a plane; 35 % at rupture. Under suction, stable bridges of the truth table up to
///                rupture: 33 / 9 %; up to 0.9 of the rupture gap (0.5 between unequal radii) 24 / 4.3 %.
///                Rounding: 1e-16 (ρ/R)² of the volume
/// \par Source  Haines 1925, J. Agric. Sci. 15, 529; Fisher 1926, ibid. 16, 492 (gorge); the ring of unequal radii and
///              angles, and its volume, derived here
template <class Rupture = willett_rupture>
struct toroid {
  required<double> surface_tension;
  double contact_angle1 = 0;
  double contact_angle2 = 0;
  Rupture rupture = {};

  /// Relative error of the force at a given volume: v up to 0.1, θ ≤ 50° (unequal too), gaps up to 0.9 of the rupture
  /// gap, 0.7 between unequal radii with unequal angles; worst measured 0.085.
  static constexpr double stated_accuracy = 0.1;
  /// The same at a given suction, on the stable bridges of open_bridge.csv up to 0.9 of their rupture gap, 0.5 between
  /// unequal radii; worst measured 0.24.
  static constexpr double stated_accuracy_at_suction = 0.4;

  template <real T>
  [[nodiscard]] outcome<toroid_ring<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    if (admit(e) != bridge_status::ok || !(value_of(liquid.value) >= 0) || !(value_of(liquid.value) < infinity<T>)) {
      return none<T>(bridge_status::invalid_input);
    }
    if (!(value_of(liquid.value) > 0)) {
      return none<T>(bridge_status::no_liquid);
    }
    if (e.gap < T(0)) {
      return none<T>(bridge_status::not_covered);
    }
    if (!(value_of(e.radius1) < infinity<T>)) {
      return from_the_other_end(e, liquid);
    }
    if (value_of(e.gap) > rupture.gap(e, liquid.value, (contact_angle1 + contact_angle2) / 2)) {
      return none<T>(bridge_status::ruptured);
    }
    const shape<T> s = shape_of(e);
    // the depth of a disc of liquid with an upright rim (Derjaguin), in terms of the rim's circle
    const T radius = detail::derjaguin_radius(e);
    const T guess = (e.gap + T(2) * detail::immersion(e.gap, liquid.value, radius)) / (s.cos1 + s.cos2);
    return solve(e, s, guess, s.largest, [&](const circle<T>& c) { return volume_of(e, s, c) / liquid.value - T(1); });
  }

  template <real T>
  [[nodiscard]] outcome<toroid_ring<T>, bridge_status> bridge(const edge<T>& e, given_suction<T> tied) const noexcept {
    if (admit(e) != bridge_status::ok || !(value_of(tied.value) < infinity<T>) ||
        !(value_of(tied.value) > -infinity<T>)) {
      return none<T>(bridge_status::invalid_input);
    }
    if (e.gap < T(0)) {
      return none<T>(bridge_status::not_covered);
    }
    if (!(value_of(e.radius1) < infinity<T>)) {
      return from_the_other_end(e, tied);
    }
    const shape<T> s = shape_of(e);
    const T per_tension = tied.value / detail::fit_number<T>(surface_tension);
    const bool drawn = per_tension * s.largest > T(1);  // the arc of this suction alone is narrower than the widest
    const T widest = drawn ? T(1) / per_tension : s.largest;
    return solve(e, s, widest * T(0.5), widest,
                 [&](const circle<T>& c) { return c.arc * per_tension - T(1) + c.arc / c.neck; });
  }

 private:
  /// The centre of the meridian circle of radius ρ lies at a + bρ from the first surface, along the axis; its gorge is
  /// open for ρ from `least` on, and lies between the contact lines up to `largest`.
  template <real T>
  struct shape {
    T cos1, sin1, cos2, sin2;
    T a, b, least, largest;
  };
  /// The circle: its radius, its centre along the axis and above it, and the radius of its gorge.
  template <real T>
  struct circle {
    T arc, along, height, neck;
  };
  /// Sine and cosine of a filling angle.
  template <real T>
  struct filling {
    T sine, cosine;
  };

  template <real T>
  [[nodiscard]] static outcome<toroid_ring<T>, bridge_status> none(bridge_status why) noexcept {
    const T force = detail::no_pull<T>(why).value.force;
    const T unknown(quiet_nan<T>);
    return {{force, verdict_of(why) == verdict::absent ? T(0) : unknown, unknown, unknown, unknown, unknown, unknown,
             unknown, unknown},
            why};
  }

  /// A plane that comes first.
  template <real T, class Given>
  [[nodiscard]] outcome<toroid_ring<T>, bridge_status> from_the_other_end(const edge<T>& e,
                                                                          const Given& given) const noexcept {
    const toroid turned{surface_tension, contact_angle2, contact_angle1, rupture};
    const auto found = turned.bridge(edge<T>{e.radius2, e.radius1, e.gap, -e.normal}, given);
    const toroid_ring<T>& r = found.value;
    return {{r.force, r.volume, r.suction, r.neck, r.arc, r.filling2, r.filling1, r.contact2, r.contact1},
            found.reason};
  }

  template <real T>
  [[nodiscard]] bridge_status admit(const edge<T>& e) const noexcept {
    return detail::admit_pair(e, surface_tension, contact_angle1, contact_angle2);
  }

  template <real T>
  [[nodiscard]] shape<T> shape_of(const edge<T>& e) const noexcept {
    using std::sqrt;
    const auto number = [](double x) { return detail::fit_number<T>(x); };
    shape<T> s;
    s.cos1 = number(std::cos(contact_angle1));
    s.sin1 = number(std::sin(contact_angle1));
    s.cos2 = number(std::cos(contact_angle2));
    s.sin2 = number(std::sin(contact_angle2));
    const T distance = e.radius1 + e.radius2 + e.gap;
    s.a = e.with_plane() ? e.gap : e.gap * (e.gap + T(2) * e.radius2) / (T(2) * distance);
    s.b = e.with_plane() ? -s.cos2 : (e.radius1 * s.cos1 - e.radius2 * s.cos2) / distance;
    // gorge closed: (a + bρ)² + 2R₁ (a + bρ) = 2R₁ρ cos θ₁
    const T linear = T(2) * (e.radius1 * s.cos1 - s.b * (s.a + e.radius1));
    const T constant = s.a * (s.a + T(2) * e.radius1);
    s.least = T(2) * constant / (linear + sqrt(linear * linear - T(4) * s.b * s.b * constant));
    s.largest = T(1000) * (e.radius1 < e.radius2 ? e.radius1 : e.radius2);
    // the arc whose gorge has come to a contact line: the meridian is level there
    const T reach =
        s.b < T(0) ? (s.a + e.radius1 * (T(1) - s.sin1)) / -s.b : (e.gap - s.a + e.radius2 * (T(1) - s.sin2)) / s.b;
    if (reach < s.largest) {
      s.largest = reach;
    }
    return s;
  }

  template <real T>
  [[nodiscard]] static circle<T> circle_of(const edge<T>& e, const shape<T>& s, const T& arc) noexcept {
    using std::sqrt;
    const T x = s.a + s.b * arc;
    const T square = T(2) * e.radius1 * arc * s.cos1 - x * (x + T(2) * e.radius1);  // height² − ρ²
    const T height = sqrt(arc * arc + square);
    return {arc, x, height, square / (height + arc)};
  }

  /// The contact line on a sphere whose centre is `along` from that of the circle.
  template <real T>
  [[nodiscard]] static filling<T> filling_of(const circle<T>& c, const T& radius, const T& along, const T& cosine,
                                             const T& sine) noexcept {
    const T scale = T(1) / (along * along + c.height * c.height);
    return {(c.height * (radius + c.arc * cosine) - along * c.arc * sine) * scale,
            (along * (radius + c.arc * cosine) + c.height * c.arc * sine) * scale};
  }
  /// Volume inside the meridian from the gorge to where the sine and cosine of its slope are these.
  template <real T>
  [[nodiscard]] static T inside(const circle<T>& at, const T& s, const T& c) noexcept {
    using std::atan2;
    return T(pi<T>) * at.arc *
           (at.height * at.height * s - at.height * at.arc * (atan2(s, c) + s * c) +
            at.arc * at.arc * (s - s * s * s / T(3)));
  }
  /// The liquid on the side of a sphere.
  template <real T>
  [[nodiscard]] static T beside(const circle<T>& c, const filling<T>& f, const T& radius, const T& cosine,
                                const T& sine) noexcept {
    const T rise = f.sine * f.sine / (T(1) + f.cosine);
    const T cap = T(pi<T>) / T(3) * radius * radius * radius * rise * rise * (T(3) - rise);
    return inside(c, f.cosine * cosine - f.sine * sine, f.sine * cosine + f.cosine * sine) - cap;
  }

  template <real T>
  [[nodiscard]] static filling<T> first_filling(const edge<T>& e, const shape<T>& s, const circle<T>& c) noexcept {
    return filling_of(c, e.radius1, c.along + e.radius1, s.cos1, s.sin1);
  }
  template <real T>
  [[nodiscard]] static filling<T> second_filling(const edge<T>& e, const shape<T>& s, const circle<T>& c) noexcept {
    return filling_of(c, e.radius2, e.gap + e.radius2 - c.along, s.cos2, s.sin2);
  }
  template <real T>
  [[nodiscard]] static T volume_of(const edge<T>& e, const shape<T>& s, const circle<T>& c) noexcept {
    return beside(c, first_filling(e, s, c), e.radius1, s.cos1, s.sin1) +
           (e.with_plane() ? inside(c, s.cos2, s.sin2) : beside(c, second_filling(e, s, c), e.radius2, s.cos2, s.sin2));
  }

  /// The ring for which `excess` vanishes, growing with the arc: of the two rings of a volume or suction the larger
  /// one.
  template <real T, class Excess>
  [[nodiscard]] outcome<toroid_ring<T>, bridge_status> solve(const edge<T>& e, const shape<T>& s, const T& guess,
                                                             const T& widest, const Excess& excess) const noexcept {
    using std::atan2;
    if (!(s.least < widest)) {
      return none<T>(bridge_status::ruptured);
    }
    detail::upper_root<T> root{guess > s.least ? guess - s.least : detail::fit_number<T>(1e-3) * guess,
                               widest - s.least};
    const bridge_status found = root.find([&](const T& w) { return excess(circle_of(e, s, s.least + w)); });
    if (found != bridge_status::ok) {
      return none<T>(found);
    }
    const circle<T> c = circle_of(e, s, s.least + root.value);
    const filling<T> first = first_filling(e, s, c);
    const filling<T> second = second_filling(e, s, c);
    const T tension = detail::fit_number<T>(surface_tension);
    return {{T(pi<T>) * tension * c.neck * (T(1) + c.neck / c.arc), volume_of(e, s, c),
             tension * (T(1) / c.arc - T(1) / c.neck), c.neck, c.arc, atan2(first.sine, first.cosine),
             e.with_plane() ? T(0) : atan2(second.sine, second.cosine), e.radius1 * first.sine,
             e.with_plane() ? c.height - c.arc * s.sin2 : e.radius2 * second.sine},
            found};
  }
};
static_assert(bridge_law<toroid<>> && bridge_law<toroid<>, double, given_suction<double>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
