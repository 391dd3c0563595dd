// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/gas_section.hpp"
#include "tetrapore/law/entry/inscribed_circle.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tetrapore::inline TETRAPORE_ABI {

/// The section of a meniscus at the moment it enters.
/// \par Units  [m], [m²], angles [rad]
template <real T>
struct entry_meniscus {
  T radius;           ///< r = σ / p
  T area;             ///< A_nw, the gas
  T meniscus_length;  ///< L_nw, arcs
  T wetted_length;    ///< L_ns, solid that the gas touches
  std::size_t count;  ///< sides that it touches: all of them, unless a side of a ring lies behind an arc
  std::array<std::uint8_t, opening<T>::max_sides> side;  ///< index of each in the opening
  std::array<T, opening<T>::max_sides> arc;              ///< ψ, angle of the arc after each side; 0: corner or open
  std::array<T, opening<T>::max_sides> wetted;           ///< per side: angle of a disc, length of a line [m]
};

/// How the entry pressure answers to the moves of the sides of an opening.
/// \par Units  [Pa/m]
template <real T>
struct entry_sensitivity {
  T pressure;                                              ///< [Pa]
  std::array<vec2<T>, opening<T>::max_sides> by_centre{};  ///< dp/d centre of a disc; of a line: along its normal
  std::array<T, opening<T>::max_sides> by_radius{};        ///< dp/dR of a disc; 0 for a line
};

namespace detail {

/// A ring with the indices that its sides had in the opening it was taken from.
template <real T>
struct sub_ring {
  opening<T> ring;
  std::array<std::uint8_t, opening<T>::max_sides> side;

  [[nodiscard]] static sub_ring all_of(const opening<T>& o) noexcept {
    sub_ring s{o, {}};
    for (std::size_t k = 0; k < o.count; ++k) {
      s.side[k] = static_cast<std::uint8_t>(k);
    }
    return s;
  }
  /// All sides but one, with a liquid gap in its place.
  [[nodiscard]] sub_ring without(std::size_t gone) const noexcept {
    sub_ring s = *this;
    const std::size_t before = ring.previous(gone);
    s.ring.gaps[before] = gap_state::liquid;
    for (std::size_t k = gone; k + 1 < ring.count && k + 1 < opening<T>::max_sides; ++k) {
      s.ring.sides[k] = ring.sides[k + 1];
      s.ring.gaps[k] = s.ring.gaps[k + 1];
      s.side[k] = side[k + 1];
    }
    --s.ring.count;
    return s;
  }
};

template <real T>
struct entry_root {
  T radius;
  entry_status reason;
};

template <real T>
[[nodiscard]] entry_root<T> no_root(entry_status why) noexcept {
  return {T(quiet_nan<T>), why};
}

/// No point of the triangle of the centres is free: every free stretch of a gap, and where there is none the corner
/// between two discs, lies under the third side.
template <real T>
[[nodiscard]] bool covered(const ring_frame<T, 3>& f) noexcept {
  using std::sqrt;
  const auto under = [&](std::size_t k, const vec2<T>& p) {
    const vec2<T> v = p - f.side(k).point;
    return f.is_disc(k) ? dot(v, v) <= f.side(k).radius * f.side(k).radius : dot(f.side(k).normal, v) <= T(0);
  };
  bool all_overlap = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& g = f.gaps[k];
    const std::size_t third = f.previous(k);
    if (g.between_lines) {
      if (!under(third, g.base)) {
        return false;
      }
      all_overlap = false;
    } else if (g.width > T(0)) {
      const std::size_t b = g.base_first ? k : f.next(k);
      const vec2<T> near = g.base + g.axis * f.side(b).radius;
      if (!under(third, near) || !under(third, near + g.axis * g.width)) {
        return false;
      }
      all_overlap = false;
    }
  }
  if (!all_overlap) {
    return true;
  }
  // The deepest overlap may not leave a corner under the third side while another does not: one corner decides.
  const auto& g = f.gaps[0];
  const vec2<T> corner =
      g.end == gap_end::corner ? g.base : g.base + g.axis * g.x0 + g.inner * sqrt(g.q < T(0) ? -g.q : T(0));
  return under(2, corner);
}

/// Newton's iteration r ← A / P on the concave F = r P − A, at or above the least radius.
template <bool Plain, std::floating_point T, std::size_t N>
[[nodiscard]] entry_root<T> newton(const ring_frame<T, N>& f, T start) noexcept {
  constexpr int most = 60;
  const bool guessed = start > f.least;
  T r = guessed ? start : f.least;
  bool at_least = !guessed;
  bool tested = false;  // the opening at the least radius
  T last = T(0);
  T last_r = T(0);
  T last_excess = T(0);
  T last_perimeter = T(1);
  for (int i = 0; i < most; ++i) {
    const gas_balance<T> s = [&]() -> gas_balance<T> {
      if constexpr (Plain) {
        return f.plain_balance(r);
      } else {
        return f.section(r);
      }
    }();
    T better = s.area / s.perimeter;
    if (at_least) {
      at_least = false;
      tested = true;
      if (N == 3 && !s.hole) {
        return no_root<T>(r > T(0) ? entry_status::no_hole : entry_status::closed);
      }
      if (!(better >= r)) {
        return no_root<T>(better < r ? entry_status::gap_limited : entry_status::not_converged);
      }
    } else if (!(s.perimeter > T(0)) || !(better > f.least)) {
      at_least = true;
      r = f.least;
      last = T(0);
      continue;
    }
    const T step = std::abs(better - r);
    const T ratio = last > T(0) ? step / last : T(0.5);
    // Converging quadratically, the next step would be about step (step/last)²; a small step that does not shrink is
    // the rounding of A / P.
    bool done = step <= 4 * epsilon<T> * r || (ratio < T(0.1) && step * ratio * ratio <= T(0.25) * epsilon<T> * r) ||
                (ratio > T(0.5) && step * step <= epsilon<T> * r * r);
    const T excess = s.excess(r);
    if (!done && last > T(0)) {
      // The cubic through both values and slopes of the inverse function is wrong by about (step last)² / r³, away from
      // the least radius, where F has the singularity of a square root.
      const T share = step * last / (r * r);
      if (share * share <= 16 * epsilon<T> && better > T(1.2) * f.least) {
        const T span = last_excess - excess;
        const T t = -excess / span;
        better = r + span * t * (T(1) - t) * ((T(1) - t) / s.perimeter - t / last_perimeter) +
                 (last_r - r) * t * t * (T(3) - T(2) * t);
        done = true;
      }
    }
    if (done) {
      if (N == 3 && !s.hole && !tested) {
        at_least = true;
        r = f.least;
        last = T(0);
        continue;
      }
      return {better, f.dry ? entry_status::dry_corner : entry_status::ok};
    }
    last = step;
    last_r = r;
    last_excess = excess;
    last_perimeter = s.perimeter;
    r = better;
  }
  return no_root<T>(entry_status::not_converged);
}

/// About the radius at entry, from that of the inscribed circle: fitted, within 1 % in most throats, where it only
/// saves iterations.
template <std::floating_point T>
[[nodiscard]] T usual_radius(const contact<T>& wet, const T& inscribed, const T& least) noexcept {
  const T x = wet.angle * wet.angle;
  const T touching = T(0.5712) + x * (T(-0.11963) + x * (T(0.06482) + x * (T(-0.04900) + x * T(0.01198))));
  const T share = least / inscribed;
  return inscribed * (touching / wet.cosine + (T(0.04) - T(0.08) * wet.sine * wet.sine) * share * share);
}

/// The inscribed radius of three discs as `circle_between` finds it, from distances that are known by now and without
/// its care for digits; 0 where there is none.
template <std::floating_point T>
[[nodiscard]] T rough_inscribed(const ring_frame<T, 3>& f) noexcept {
  const T R = f.side(0).radius;
  const vec2<T> p = f.side(1).point - f.side(0).point;
  const vec2<T> q = f.side(2).point - f.side(0).point;
  const T slope_p = f.side(1).radius - R;
  const T slope_q = f.side(2).radius - R;
  const T offset_p = T(0.5) * (f.gaps[0].span * f.gaps[0].span - slope_p * (f.side(1).radius + R));
  const T offset_q = T(0.5) * (f.gaps[2].span * f.gaps[2].span - slope_q * (f.side(2).radius + R));
  const T inverse = T(1) / cross(p, q);
  const vec2<T> x0 = vec2<T>{offset_p * q.y - offset_q * p.y, offset_q * p.x - offset_p * q.x} * inverse;
  const vec2<T> x1 = vec2<T>{slope_q * p.y - slope_p * q.y, slope_p * q.x - slope_q * p.x} * inverse;
  const T a = dot(x1, x1) - T(1);
  const T b = R - dot(x0, x1);
  const T c = dot(x0, x0) - R * R;
  const T r = c / (b + std::sqrt(b * b - a * c));
  return r > T(0) ? r : T(0);
}

template <std::floating_point T>
[[nodiscard]] entry_root<T> root_of_three(const opening<T>& o, const contact<T>& wet) noexcept {
  ring_frame<T, 3> f;
  const auto sound = f.build(o, wet);
  if (sound == entry_status::invalid_input || sound == entry_status::not_covered) {
    return no_root<T>(sound);
  }
  if (covered(f)) {
    return {T(0), entry_status::closed};
  }
  if (sound != entry_status::ok) {
    return no_root<T>(sound);
  }
  T inscribed = T(0);
  if (f.plain) {
    inscribed = rough_inscribed(f);
  } else if (const auto c = circle_between(
                 std::array<bounding_side2<T>, 3>{bounding(o.sides[0]), bounding(o.sides[1]), bounding(o.sides[2])});
             c.ok()) {
    inscribed = c.value.radius;
  }
  const T start = inscribed > T(0) ? usual_radius(wet, inscribed, f.least) : T(0);
  return f.plain ? newton<true>(f, start) : newton<false>(f, start);
}

/// The root of a ring of more than three sides, with the sides that its meniscus touches left in `s`.
template <std::floating_point T>
[[nodiscard]] entry_root<T> root_of_ring(sub_ring<T>& s, const contact<T>& wet) noexcept {
  if (s.ring.count == 3) {
    return root_of_three(s.ring, wet);
  }
  ring_frame<T, opening<T>::max_sides> f;
  const auto sound = f.build(s.ring, wet);
  if (sound != entry_status::ok) {
    return no_root<T>(sound);
  }
  // A side that the meniscus does not reach lies in the liquid of the corner between its neighbours.
  const auto hidden = [&](const T& r) {
    const auto section = f.section(r);
    std::size_t worst = f.count();
    for (std::size_t k = 0; k < f.count(); ++k) {
      if (section.wetted[k] < T(0) && (worst == f.count() || section.wetted[k] < section.wetted[worst])) {
        worst = k;
      }
    }
    return worst;
  };
  const auto root = newton<false>(f, T(0));
  const auto behind = hidden(verdict_of(root.reason) == verdict::ok ? root.radius : f.least);
  if (behind != f.count()) {
    s = s.without(behind);
    return root_of_ring(s, wet);
  }
  return root;
}

}  // namespace detail

/// Capillary pressure at which the non-wetting phase enters an opening, by the balance of Mayer, Stowe and Princen:
/// the arc radius r = σ/p at which r (L_nw + cos θ L_ns) = A_nw.
/// \par Units   lengths [m], surface tension [N/m], angle [rad], pressure [Pa]
/// \par Domain  rings of 3 to 8 sides, discs and wall lines in any mix, gaps liquid or open; 0 ≤ θ < 90°. In the order
///              of the tests: closed (the sides cover the opening), no_hole, gap_limited, ok or dry_corner. A side of a
///              larger ring that lies behind an arc is left out. Arcs between sides that are no neighbours are not
///              looked for: a merged ring enters at the larger of its pressure and that at which the shared arc is lost
/// \par Accuracy  |Δp|/p at most `stated_accuracy` (32 + κ), with κ = L Σ |∂p/∂x| / p over the coordinates and radii of
///                the sides (`derivative`) and L the distance from the origin within which they lie: 32 for the law's
///                own roundings, κ for those of the opening. Worst of the tables (truth_check, docs/accuracy.md):
///                7.5e-17 (32 + κ); of 2·10⁵ random throats against long double 9.1e-17 (32 + κ). As relative errors:
///                2.4e-14 in open_msp.csv, 7.8e-16 in rings, 2.5e-11 in slivers 1 : 1 : 1e-5, where κ = 4e5. At the gap
///                limit the status may differ within the rounding of the gap
/// \par Source  Mayer & Stowe, J. Colloid Sci. 20, 893 (1965); Princen, J. Colloid Interface Sci. 30, 69 (1969);
///              Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.3
struct mayer_stowe_princen {
  required<double> surface_tension;
  double contact_angle = 0;

  /// Relative error of the pressure per unit of 32 + κ.
  static constexpr double stated_accuracy = 1.5e-16;

  template <real T>
  [[nodiscard]] outcome<T, entry_status> entry_pressure(const opening<T>& o) const noexcept {
    const auto root = solve(o);
    if (root.reason == entry_status::closed) {
      return {T(infinity<T>), root.reason};
    }
    return {T(tension<T>()) / root.radius, root.reason};
  }

  /// The gap that loses its arc first as the pressure rises, whatever the meniscus does then.
  template <real T>
  [[nodiscard]] outcome<arc_limit<T>, entry_status> first_arc_lost(const opening<T>& o) const noexcept {
    if (!in_domain(o)) {
      return {{T(quiet_nan<T>), 0}, entry_status::invalid_input};
    }
    detail::ring_frame<T, opening<T>::max_sides> f;
    const auto sound = f.build(o, contact_of<T>());
    if (sound == entry_status::invalid_input || sound == entry_status::not_covered) {
      return {{T(quiet_nan<T>), 0}, sound};
    }
    std::size_t widest = 0;
    T least = T(0);
    for (std::size_t k = 0; k < o.count; ++k) {
      const T r = f.gaps[k].least_radius();
      if (r > least) {
        least = r;
        widest = k;
      }
    }
    return {{least > T(0) ? T(tension<T>()) / least : T(infinity<T>), widest}, entry_status::ok};
  }

  /// Pressure at which the gap of an edge loses its arc: σ/r with ρ₁ + ρ₂ equal to the distance of the centres, at θ =
  /// 0 twice σ over the gap. Infinite where the grains touch: that arc is never lost.
  template <real T>
  [[nodiscard]] outcome<T, entry_status> arc_lost(const edge<T>& e) const noexcept {
    const T zero(0);
    if (!(detail::wets(surface_tension, contact_angle) && zero < e.radius1 &&
          (e.radius1 < infinity<T>)&&zero < e.radius2 && e.gap > -e.radius1 && e.gap > -e.radius2 &&
          (e.gap < infinity<T>))) {
      return {T(quiet_nan<T>), entry_status::invalid_input};
    }
    detail::gap_frame<T> g;
    g.width = e.gap;
    if (e.with_plane()) {
      detail::set_disc_and_line(g, e.radius1, e.radius1 + e.gap, contact_of<T>());
    } else {
      const T small = e.radius1 < e.radius2 ? e.radius1 : e.radius2;
      const T large = e.radius1 < e.radius2 ? e.radius2 : e.radius1;
      const T d = (small + e.gap) + large;
      static_cast<void>(detail::set_discs(g, small, large, d, T(1) / d, contact_of<T>()));
    }
    const T r = g.least_radius();
    return {r > zero ? T(tension<T>()) / r : T(infinity<T>), entry_status::lost_arc};
  }

  /// The meniscus at entry in full.
  template <std::floating_point T>
  [[nodiscard]] outcome<entry_meniscus<T>, entry_status> meniscus(const opening<T>& o) const noexcept;

  /// The derivative of the entry pressure with respect to the sides, for moving grains: −dp/dr (∂F/∂x) / P.
  template <std::floating_point T>
  [[nodiscard]] outcome<entry_sensitivity<T>, entry_status> derivative(const opening<T>& o) const noexcept;

 private:
  template <real T>
  [[nodiscard]] underlying_t<T> tension() const noexcept {
    return static_cast<underlying_t<T>>(surface_tension.get());
  }
  template <real T>
  [[nodiscard]] detail::contact<T> contact_of() const noexcept {
    const auto angle = static_cast<underlying_t<T>>(contact_angle);
    return {T(std::cos(angle)), T(std::sin(angle)), T(angle)};
  }
  template <real T>
  [[nodiscard]] bool in_domain(const opening<T>& o) const noexcept {
    return detail::wets(surface_tension, contact_angle) && o.count >= 3 && o.count <= opening<T>::max_sides;
  }
  template <real T>
  [[nodiscard]] detail::entry_root<T> solve(const opening<T>& o) const noexcept;
};
static_assert(gap_aware_entry_law<mayer_stowe_princen, double>);

namespace detail {

template <real T>
[[nodiscard]] opening<underlying_t<T>> values_of(const opening<T>& o) noexcept {
  opening<underlying_t<T>> v;
  v.count = o.count;
  for (std::size_t k = 0; k < o.count; ++k) {
    const auto& s = o.sides[k];
    v.sides[k] = {{value_of(s.point.x), value_of(s.point.y)},
                  {value_of(s.normal.x), value_of(s.normal.y)},
                  value_of(s.radius),
                  s.kind};
    v.gaps[k] = o.gaps[k];
  }
  return v;
}

/// One Newton step in T from the root of the values: exact first derivatives.
template <real T>
[[nodiscard]] T lifted(const opening<T>& o, const sub_ring<underlying_t<T>>& touched,
                       const entry_root<underlying_t<T>>& root, const contact<T>& wet) noexcept {
  opening<T> ring;
  ring.count = touched.ring.count;
  for (std::size_t k = 0; k < ring.count; ++k) {
    ring.sides[k] = o.sides[touched.side[k]];
    ring.gaps[k] = touched.ring.gaps[k];
  }
  ring_frame<T, opening<T>::max_sides> f;
  static_cast<void>(f.build(ring, wet));
  const auto s = f.section(T(root.radius));
  return s.area / s.perimeter;
}

/// dF/d(displacement of the end of side k's wetted arc), the rest of the boundary being carried along; `leaves`: the
/// end where the gap after the side begins.
template <std::floating_point T, std::size_t N>
[[nodiscard]] vec2<T> end_force(const ring_frame<T, N>& f, const gas_section<T, N>& s, std::size_t k, bool leaves,
                                const T& r) noexcept {
  const std::size_t gap = leaves ? k : f.previous(k);
  const gap_frame<T>& g = f.gaps[gap];
  const vec2<T> point = leaves ? s.leave[k] : s.enter[gap];
  if (g.end == gap_end::arc) {
    const vec2<T> centre = (leaves ? s.from[gap] : s.to[gap]) - f.side(k).point;
    const vec2<T> pull =
        f.is_disc(k) ? centre - point
                     : f.side(k).normal * (r * f.wet.cosine) + vec2<T>{f.side(k).normal.y, -f.side(k).normal.x} *
                                                                   ((leaves ? T(-1) : T(1)) * r * f.wet.sine);
    return left_of(leaves ? pull : -pull);
  }
  const std::size_t other = leaves ? f.next(k) : gap;
  if (g.end == gap_end::corner) {
    const auto forward = [&](std::size_t side) -> vec2<T> {
      const vec2<T> n = f.normal_at(side, g.base);
      return vec2<T>{n.y, -n.x} * (T(1) / norm(n));
    };
    const vec2<T> mine = forward(k);
    const vec2<T> theirs = forward(other);
    const T sine = leaves ? cross(mine, theirs) : cross(theirs, mine);
    return left_of(mine - theirs) * (-r * f.wet.cosine / sine);
  }
  if (!f.is_disc(k)) {
    return {T(0), T(0)};
  }
  if (!f.is_disc(other)) {
    return g.inner * (g.width - r * f.wet.cosine);
  }
  const T mine = f.side(k).radius;
  const T theirs = f.side(other).radius;
  return g.inner * ((r * f.wet.cosine * (mine - theirs) + T(0.5) * g.width * (g.span + theirs - mine)) / g.span);
}

}  // namespace detail

template <real T>
detail::entry_root<T> mayer_stowe_princen::solve(const opening<T>& o) const noexcept {
  using value_type = underlying_t<T>;
  if (!in_domain(o)) {
    return detail::no_root<T>(entry_status::invalid_input);
  }
  const auto wet = contact_of<value_type>();
  if constexpr (std::floating_point<T>) {
    if (o.count == 3) {
      return detail::root_of_three(o, wet);
    }
    auto touched = detail::sub_ring<T>::all_of(o);
    return detail::root_of_ring(touched, wet);
  } else {
    auto touched = detail::sub_ring<value_type>::all_of(detail::values_of(o));
    const auto root = detail::root_of_ring(touched, wet);
    if (verdict_of(root.reason) != verdict::ok) {
      return {T(root.radius), root.reason};
    }
    return {detail::lifted(o, touched, root, contact_of<T>()), root.reason};
  }
}

template <std::floating_point T>
outcome<entry_meniscus<T>, entry_status> mayer_stowe_princen::meniscus(const opening<T>& o) const noexcept {
  using std::atan2;
  entry_meniscus<T> m{};
  m.radius = m.area = m.meniscus_length = m.wetted_length = quiet_nan<T>;
  if (!in_domain(o)) {
    return {m, entry_status::invalid_input};
  }
  auto touched = detail::sub_ring<T>::all_of(o);
  const auto root = detail::root_of_ring(touched, contact_of<T>());
  if (root.reason == entry_status::closed) {
    m.radius = m.area = m.meniscus_length = m.wetted_length = T(0);
  }
  if (verdict_of(root.reason) != verdict::ok) {
    return {m, root.reason};
  }
  detail::ring_frame<T, opening<T>::max_sides> f;
  static_cast<void>(f.build(touched.ring, contact_of<T>()));
  const auto s = f.section(root.radius);
  m.radius = root.radius;
  m.area = s.area;
  m.meniscus_length = s.meniscus_length;
  m.wetted_length = s.wetted_length;
  m.count = f.count();
  for (std::size_t k = 0; k < f.count(); ++k) {
    m.side[k] = touched.side[k];
    m.wetted[k] = s.wetted[k];
    if (f.gaps[k].end == detail::gap_end::arc) {
      const vec2<T> a = f.side(k).point + s.leave[k] - s.from[k];
      const vec2<T> b = f.side(f.next(k)).point + s.enter[k] - s.from[k];
      m.arc[k] = atan2(cross(a, b), dot(a, b));
    }
  }
  return {m, root.reason};
}

template <std::floating_point T>
outcome<entry_sensitivity<T>, entry_status> mayer_stowe_princen::derivative(const opening<T>& o) const noexcept {
  entry_sensitivity<T> d;
  d.pressure = quiet_nan<T>;
  d.by_centre.fill({quiet_nan<T>, quiet_nan<T>});
  d.by_radius.fill(quiet_nan<T>);
  if (!in_domain(o)) {
    return {d, entry_status::invalid_input};
  }
  const auto wet = contact_of<T>();
  auto touched = detail::sub_ring<T>::all_of(o);
  const auto root = detail::root_of_ring(touched, wet);
  if (verdict_of(root.reason) != verdict::ok) {
    return {d, root.reason};
  }
  d.by_centre.fill({});
  d.by_radius.fill(T(0));
  const T r = root.radius;
  d.pressure = tension<T>() / r;
  const T per_radius = -tension<T>() / (r * r);  // dp/dr
  detail::ring_frame<T, opening<T>::max_sides> f;
  static_cast<void>(f.build(touched.ring, wet));
  const auto s = f.section(r);
  const T scale = -per_radius / s.perimeter;
  for (std::size_t k = 0; k < f.count(); ++k) {
    const std::size_t p = f.previous(k);
    const vec2<T> leave = detail::end_force(f, s, k, true, r);
    const vec2<T> enter = detail::end_force(f, s, k, false, r);
    const vec2<T> force = detail::left_of(s.leave[k] - s.enter[p]) + leave + enter;
    const std::size_t at = touched.side[k];
    if (f.is_disc(k)) {
      const T R = f.side(k).radius;
      d.by_centre[at] = force * scale;
      d.by_radius[at] =
          ((R + r * wet.cosine) * s.wetted[k] + (dot(leave, s.leave[k]) + dot(enter, s.enter[p])) / R) * scale;
    } else {
      d.by_centre[at] = f.side(k).normal * (dot(force, f.side(k).normal) * scale);
    }
  }
  return {d, root.reason};
}

}  // namespace tetrapore::inline TETRAPORE_ABI
