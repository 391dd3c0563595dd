// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/concept.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

/// \file
/// The gas in an opening at a given arc radius r: its area A, the length of its arcs L_nw and of solid it wets L_ns.
/// An arc touches both of its sides at the contact angle θ, so its centre v lies at ρ = √(R² + r² + 2 R r cos θ) from a
/// disc's centre and at r cos θ from a line. The gas is the polygon of the arc centres, plus the quadrilateral from
/// each of its edges to the chord of the wetted arc behind it, minus the segment between that chord and the disc,
/// plus the sectors of the arcs. All angles of arcs follow from the wetted angles by the turning of the boundary, which
/// is 2π: one inverse tangent per disc, and no difference of nearly equal areas.
/// \par Source  Mayer & Stowe, J. Colloid Sci. 20, 893 (1965); Princen, J. Colloid Interface Sci. 30, 69 (1969)

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

template <real T>
struct contact {
  T cosine;
  T sine;
  T angle;
};

/// What the meniscus does at a gap.
enum class gap_end : std::uint8_t {
  arc,     ///< an arc of radius r closes it
  corner,  ///< the two sides meet in a corner that gas fills
  open     ///< gas lies beyond: the section ends on the line of centres
};

template <real T>
[[nodiscard]] constexpr vec2<T> left_of(const vec2<T>& v) noexcept {
  return {-v.y, v.x};
}

/// A gap in the frame of its smaller disc (its base): the arc centre is base + axis (x0 + x1 r) + inner h, with
/// h² = (a r + 2 b) r − q. Two lines meet in the point base: the arc centre is base + inner r.
template <real T>
struct gap_frame {
  vec2<T> base;
  vec2<T> axis;   ///< unit vector from the base to the other side
  vec2<T> inner;  ///< unit vector into the opening
  T x0{}, x1{};
  T a{}, b{}, q{};
  T span{};   ///< distance from the base to the other centre, or to the line [m]
  T width{};  ///< of the gap [m]; negative is an overlap
  T turn{};   ///< corner: angle between the normals of the two sides there
  T leave0{}, enter0{},
      along1{};  ///< between discs: the arc centre from the first, from the second disc, along the line
  gap_end end = gap_end::arc;
  bool between_lines = false;
  bool base_first = true;  ///< the base is the first side of the gap

  /// Smallest radius for which the gap holds an arc [m].
  [[nodiscard]] T least_radius() const noexcept {
    using std::sqrt;
    if (end != gap_end::arc || between_lines || !(width > T(0))) {
      return T(0);
    }
    return q / (b + sqrt(b * b + a * q));
  }
};

/// The coefficients of the arc between two discs whose gap has the width g.width. Returns 1 − ((R − R')/d)².
template <real T>
[[nodiscard]] constexpr T set_discs(gap_frame<T>& g, const T& small, const T& large, const T& d, const T& per_d,
                                    const contact<T>& wet) noexcept {
  const T m = (g.width + T(2) * small) * (g.width + T(2) * large) * per_d * per_d;
  g.a = wet.sine * wet.sine + wet.cosine * wet.cosine * m;
  g.b = T(0.5) * wet.cosine * (small + large) * m;
  g.q = T(0.25) * g.width * m * (d + (small + large));
  return m;
}

/// The same for a disc and a line at the distance h of its centre.
template <real T>
constexpr void set_disc_and_line(gap_frame<T>& g, const T& radius, const T& h, const contact<T>& wet) noexcept {
  g.a = wet.sine * wet.sine;
  g.b = wet.cosine * (radius + h);
  g.q = g.width * (h + radius);
}

/// Width of the gap between two sides that may lie anywhere in the ring, and the frame of its arc. Returns false when
/// one disc lies inside the other, or behind the line: the two hold no arc.
template <real T>
[[nodiscard]] bool between_discs(const opening_side<T>& first, const opening_side<T>& second, const contact<T>& wet,
                                 gap_frame<T>& g) noexcept {
  const vec2<T> step = second.point - first.point;
  const T d = norm(step);
  g.base_first = first.radius <= second.radius;
  const opening_side<T>* const base = g.base_first ? &first : &second;
  const opening_side<T>* const other = g.base_first ? &second : &first;
  const T small = base->radius;
  const T large = other->radius;
  const T per_d = T(1) / d;
  const T sign = g.base_first ? T(1) : T(-1);
  const vec2<T> unit = step * per_d;
  g.base = base->point;
  g.axis = unit * sign;
  g.inner = left_of(unit);
  g.span = d;
  g.width = (d - large) - small;
  const T m = set_discs(g, small, large, d, per_d, wet);
  g.x0 = small + T(0.5) * g.width * (g.width + T(2) * large) * per_d;
  g.x1 = wet.cosine * (small - large) * per_d;
  g.leave0 = g.base_first ? g.x0 : d - g.x0;
  g.enter0 = g.base_first ? g.x0 - d : -g.x0;
  g.along1 = sign * g.x1;
  if (g.width * (d + (small + large)) + T(4) * wet.cosine * wet.cosine * small * large <= T(0)) {
    g.end = gap_end::corner;
  }
  return m > T(0);
}

template <real T>
[[nodiscard]] bool between_disc_and_line(const opening_side<T>& disc, const opening_side<T>& line, bool disc_first,
                                         const contact<T>& wet, gap_frame<T>& g) noexcept {
  const T h = dot(line.normal, disc.point - line.point);
  g.base_first = disc_first;
  g.base = disc.point;
  g.axis = -line.normal;
  g.inner = left_of(disc_first ? g.axis : line.normal);
  g.span = h;
  g.width = h - disc.radius;
  g.x0 = h;
  g.x1 = -wet.cosine;
  set_disc_and_line(g, disc.radius, h, wet);
  if (g.width + T(2) * wet.cosine * wet.cosine * disc.radius <= T(0)) {
    g.end = gap_end::corner;
  }
  return h + disc.radius > T(0);
}

/// Returns false when the two lines do not meet in a convex corner.
template <real T>
[[nodiscard]] bool between_lines(const opening_side<T>& first, const opening_side<T>& second, const contact<T>& wet,
                                 gap_frame<T>& g) noexcept {
  const T sine = cross(first.normal, second.normal);
  const T cosine = dot(first.normal, second.normal);
  const vec2<T> along{first.normal.y, -first.normal.x};
  // From a point of the first line, along it, to where the second is met.
  const T way = dot(second.normal, second.point - first.point) / dot(second.normal, along);
  g.base = first.point + along * way;
  g.between_lines = true;
  g.inner = (first.normal + second.normal) * (wet.cosine / (T(1) + cosine));
  if (cosine >= wet.cosine * wet.cosine - wet.sine * wet.sine) {
    g.end = gap_end::corner;
  }
  return sine > T(0) && value_of(T(1) + cosine) > 4 * epsilon<T>;
}

/// What Newton's iteration needs of a section.
template <real T>
struct gas_balance {
  T area{};
  T perimeter{};     ///< L_nw + cos θ L_ns
  bool hole = true;  ///< every side bounds the polygon of the arc centres

  /// Positive when the radius is too large: F = r P − A.
  [[nodiscard]] T excess(const T& r) const noexcept { return r * perimeter - area; }
};

/// The gas in the section. Per gap k: arc centres `from[k]`, `to[k]` (the same point unless the gap is open), contact
/// points `leave[k]` on side k and `enter[k]` on side k+1, each relative to that side's point. Per side: `wetted[k]`,
/// an angle for a disc, a length for a line.
template <real T, std::size_t N>
struct gas_section : gas_balance<T> {
  T meniscus_length{};
  T wetted_length{};
  std::array<vec2<T>, N> from;
  std::array<vec2<T>, N> to;
  std::array<vec2<T>, N> leave;
  std::array<vec2<T>, N> enter;
  std::array<T, N> wetted;
};

/// A circular arc: its angle e, and e − sin e, twice the area of its segment at radius 1.
template <real T>
struct circular_arc {
  T angle;
  T segment;
};

/// The arc with tan(e/2) = y/x, without cancellation where it is short.
template <real T>
[[nodiscard]] circular_arc<T> arc_of(const T& y, const T& x) noexcept {
  using std::atan2;
  const T e = T(2) * atan2(y, x);
  const T t = y / x;
  const T t2 = t * t;
  if (t2 < T(0.01) && e * e < T(1)) {
    T sum = T(0);
    for (int k = 10; k >= 1; --k) {
      sum = T(static_cast<underlying_t<T>>(2 * k) / static_cast<underlying_t<T>>(2 * k + 1)) - t2 * sum;
    }
    return {e, T(2) * t * t2 * sum};
  }
  return {e, e - T(2) * y * x / (x * x + y * y)};
}

/// The same in double, several times as fast and without a branch that could be foreseen no better than by chance: with
/// u = tan(e/4), e = 4 (u + u³ q(u²)) and e − sin e = 4 u³ (q + (3 + u²)/(1 + u²)²); q interpolates (atan u − u)/u³ at
/// Chebyshev's nodes for e ≤ 120° (relative error 2e-17).
[[nodiscard]] inline circular_arc<double> arc_of(const double& y, const double& x) noexcept {
  const double far = y < 0 ? -y : y;
  if (!(far < 1.7320508075688772 * x)) {
    return arc_of<double>(y, x);
  }
  const double u = y / (x + std::sqrt(x * x + y * y));
  const double w = u * u;
  const double w2 = w * w;
  const double w4 = w2 * w2;
  const double q0 = (-0.33333333333333332629 + 0.19999999999999170956 * w) +
                    w2 * (-0.14285714285551977045 + 0.11111111098553819247 * w);
  const double q1 = (-0.09090908582075020121 + 0.076922952867935039196 * w) +
                    w2 * (-0.066664696238910287539 + 0.058802125123406858668 * w);
  const double q2 = (-0.052467798323472553658 + 0.046721786047603465722 * w) +
                    w2 * (-0.039937323927724344766 + 0.029952661529252886698 * w);
  const double q3 = -0.016659167405869495995 + 0.004874352567045784564 * w;
  const double q = (q0 + w4 * q1) + (w4 * w4) * (q2 + w4 * q3);
  const double cube = 4 * u * w;
  const double one = 1 + w;
  return {4 * u + cube * q, cube * (q + (3 + w) / (one * one))};
}

/// A ring of up to N sides, reduced to what does not depend on the radius of the arcs.
template <real T, std::size_t N>
struct ring_frame {
  const opening<T>* ring;
  contact<T> wet;
  std::array<gap_frame<T>, N> gaps;
  T turning{};             ///< 2π minus what the ends of the gaps turn
  T least{};               ///< the largest of the least radii [m]
  std::size_t widest = 0;  ///< the gap that sets it
  bool dry = false;
  bool plain = N == 3;  ///< three discs with an arc in every gap

  [[nodiscard]] constexpr std::size_t count() const noexcept {
    if constexpr (N == 3) {
      return 3;
    } else {
      return ring->count;
    }
  }
  [[nodiscard]] constexpr std::size_t next(std::size_t k) const noexcept { return k + 1 == count() ? 0 : k + 1; }
  [[nodiscard]] constexpr std::size_t previous(std::size_t k) const noexcept { return k == 0 ? count() - 1 : k - 1; }
  [[nodiscard]] const opening_side<T>& side(std::size_t k) const noexcept { return ring->sides[k]; }
  [[nodiscard]] bool is_disc(std::size_t k) const noexcept { return side(k).kind == side_kind::disc; }

  /// \returns ok, no_hole (a disc inside another), not_covered (two walls without a corner) or invalid_input
  [[nodiscard]] entry_status build(const opening<T>& o, const contact<T>& angle) noexcept {
    ring = &o;
    wet = angle;
    turning = T(2 * pi<T>);
    bool nested = false;
    for (std::size_t k = 0; k < count(); ++k) {
      if (!sensible(side(k))) {
        return entry_status::invalid_input;
      }
    }
    for (std::size_t k = 0; k < count(); ++k) {
      gap_frame<T>& g = gaps[k];
      const auto& s = side(k);
      const auto& t = side(next(k));
      bool sound = true;
      if (s.kind == side_kind::disc && t.kind == side_kind::disc) {
        sound = between_discs(s, t, wet, g);
      } else if (s.kind == side_kind::disc) {
        sound = between_disc_and_line(s, t, true, wet, g);
      } else if (t.kind == side_kind::disc) {
        sound = between_disc_and_line(t, s, false, wet, g);
      } else if (!between_lines(s, t, wet, g)) {
        return entry_status::not_covered;
      }
      nested = nested || !sound;
      plain = plain && s.kind == side_kind::disc && g.end == gap_end::arc && o.gaps[k] == gap_state::liquid;
      if (o.gaps[k] == gap_state::open) {
        g.end = g.between_lines || !(g.width > T(0)) ? gap_end::corner : gap_end::open;
      } else if (g.end == gap_end::corner) {
        dry = true;
      }
    }
    if (nested) {
      return entry_status::no_hole;
    }
    for (std::size_t k = 0; k < count(); ++k) {
      close_gap(k);
    }
    return entry_status::ok;
  }

  [[nodiscard]] static bool sensible(const opening_side<T>& s) noexcept {
    const auto finite = std::isfinite(value_of(s.point.x + s.point.y));
    if (s.kind == side_kind::disc) {
      return finite && std::isfinite(value_of(s.radius)) && s.radius > T(0);
    }
    const auto stretch = value_of(dot(s.normal, s.normal)) - underlying_t<T>(1);
    return finite && stretch * stretch < underlying_t<T>(1e-8);
  }

  /// From the centre of disc k to the neighbouring corner of the ring.
  [[nodiscard]] vec2<T> towards(std::size_t k, std::size_t neighbour) const noexcept {
    return is_disc(neighbour) ? side(neighbour).point - side(k).point : -side(neighbour).normal;
  }

  /// The wetted angle of disc k, e up to a full turn: the angle of the ring there, less those from the lines of centres
  /// to the two contact points.
  [[nodiscard]] T unwound(std::size_t k, const T& e, const vec2<T>& enter, const vec2<T>& leave) const noexcept {
    using std::atan2;
    const vec2<T> after = towards(k, next(k));
    const vec2<T> before = towards(k, previous(k));
    T exact = atan2(cross(after, before), dot(after, before));
    if (exact < T(0)) {
      exact = exact + T(2 * pi<T>);
    }
    exact = exact - atan2(cross(after, leave), dot(after, leave)) - atan2(cross(enter, before), dot(enter, before));
    return exact < e - T(pi<T>) ? e - T(2 * pi<T>) : (exact > e + T(pi<T>) ? e + T(2 * pi<T>) : e);
  }

  void close_gap(std::size_t k) noexcept {
    using std::atan2;
    using std::sqrt;
    gap_frame<T>& g = gaps[k];
    if (g.end == gap_end::arc) {
      turning = turning - T(2) * wet.angle;
      const T r = g.least_radius();
      if (r > least) {
        least = r;
        widest = k;
      }
    } else if (g.end == gap_end::open) {
      turning = turning - T(pi<T>);
    } else {
      if (!g.between_lines) {
        g.base = g.base + g.axis * g.x0 + g.inner * sqrt(-g.q);
      }
      const vec2<T> n = normal_at(k, g.base);
      const vec2<T> m = normal_at(next(k), g.base);
      g.turn = atan2(cross(n, m), dot(n, m));
      turning = turning - g.turn;
    }
  }

  /// The direction from side k into the fluid, at one of its points; not normalised.
  [[nodiscard]] vec2<T> normal_at(std::size_t k, const vec2<T>& p) const noexcept {
    return is_disc(k) ? p - side(k).point : side(k).normal;
  }

  /// How the contact point of a disc follows from the arc centre w, both from the disc's centre: w swung by the angle
  /// ε at the disc, shortened from ρ to R. Cosine and sine, times R/ρ.
  [[nodiscard]] vec2<T> swing_of(std::size_t k, const T& r) const noexcept {
    if (!is_disc(k)) {
      return {T(0), T(0)};
    }
    const T along = side(k).radius + r * wet.cosine;
    const T across = r * wet.sine;
    const T scale = side(k).radius / (along * along + across * across);
    return {along * scale, across * scale};
  }

  /// The contact point on side k of the arc whose centre is w, relative to the side's point. `sense` is +1 where the
  /// arc leaves the side, −1 where it arrives.
  [[nodiscard]] vec2<T> contact_on(std::size_t k, const vec2<T>& w, const vec2<T>& swing, const T& r,
                                   const T& sense) const noexcept {
    const auto& s = side(k);
    if (s.kind == side_kind::disc) {
      return w * swing.x + left_of(w) * (-sense * swing.y);
    }
    const vec2<T> forward{s.normal.y, -s.normal.x};
    return forward * (dot(forward, w) + sense * r * wet.sine);
  }

  void place(std::size_t k, const T& r, const std::array<vec2<T>, N>& swing, gas_section<T, N>& out,
             std::array<vec2<T>, N>& w_leave, std::array<vec2<T>, N>& w_enter) const noexcept {
    using std::sqrt;
    const gap_frame<T>& g = gaps[k];
    const std::size_t j = next(k);
    if (g.end == gap_end::arc) {
      if (g.between_lines) {
        const vec2<T> v = g.base + g.inner * r;
        out.from[k] = v;
        w_leave[k] = v - side(k).point;
        w_enter[k] = v - side(j).point;
      } else {
        const T x = g.x0 + g.x1 * r;
        const T h2 = (g.a * r + T(2) * g.b) * r - g.q;
        const vec2<T> up = g.inner * (h2 > T(0) ? sqrt(h2) : T(0));
        const vec2<T> near = g.axis * x + up;
        out.from[k] = g.base + near;
        const std::size_t o = g.base_first ? j : k;
        const vec2<T> far = is_disc(o) ? g.axis * (x - g.span) + up : out.from[k] - side(o).point;
        w_leave[k] = g.base_first ? near : far;
        w_enter[k] = g.base_first ? far : near;
      }
      out.to[k] = out.from[k];
      out.leave[k] = contact_on(k, w_leave[k], swing[k], r, T(1));
      out.enter[k] = contact_on(j, w_enter[k], swing[j], r, T(-1));
      return;
    }
    if (g.end == gap_end::corner) {
      out.from[k] = g.base;
      out.to[k] = g.base;
    } else {
      // The line of centres, from surface to surface.
      const std::size_t b = g.base_first ? k : j;
      const std::size_t o = g.base_first ? j : k;
      const vec2<T> near = g.base + g.axis * side(b).radius;
      const vec2<T> far = g.base + g.axis * (is_disc(o) ? g.span - side(o).radius : g.span);
      out.from[k] = g.base_first ? near : far;
      out.to[k] = g.base_first ? far : near;
    }
    w_leave[k] = out.from[k] - side(k).point;
    w_enter[k] = out.to[k] - side(j).point;
    out.leave[k] = w_leave[k];
    out.enter[k] = w_enter[k];
  }

  /// The balance of three discs with an arc in every gap: what `section` says, without what the iteration leaves
  /// unread.
  [[nodiscard]] gas_balance<T> plain_balance(const T& r) const noexcept {
    using std::sqrt;
    const T lift = r * wet.cosine;
    const T tilt = r * wet.sine;
    std::array<vec2<T>, 3> centre;
    std::array<vec2<T>, 3> leave;
    std::array<vec2<T>, 3> enter;
    for (std::size_t k = 0; k < 3; ++k) {
      const gap_frame<T>& g = gaps[k];
      const T h2 = (g.a * r + T(2) * g.b) * r - g.q;
      const vec2<T> up = g.inner * (h2 > T(0) ? sqrt(h2) : T(0));
      const vec2<T> unit{g.inner.y, -g.inner.x};
      leave[k] = unit * (g.leave0 + g.along1 * r) + up;
      enter[k] = unit * (g.enter0 + g.along1 * r) + up;
      centre[k] = g.base + g.axis * (g.x0 + g.x1 * r) + up;
    }
    T twice = cross(centre[1] - centre[0], centre[2] - centre[0]);
    T angles = turning;
    T wetted = T(0);
    bool hole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t p = k == 0 ? 2 : k - 1;
      const T radius = side(k).radius;
      const T along = radius + lift;
      const T scale = radius / (along * along + tilt * tilt);
      const T c = along * scale;
      const T s = tilt * scale;
      const vec2<T>& v = leave[k];
      const vec2<T>& w = enter[p];
      const vec2<T> a{v.x * c + v.y * s, v.y * c - v.x * s};
      const vec2<T> b{w.x * c - w.y * s, w.y * c + w.x * s};
      const T square = radius * radius;
      auto arc = arc_of(cross(a, b), square + dot(a, b));
      if (arc.angle < T(0)) {
        arc.angle = unwound(k, arc.angle, b, a);
      }
      twice = twice + cross(a - w, v - b) - square * arc.segment;
      angles = angles + arc.angle;
      wetted = wetted + radius * arc.angle;
      hole = static_cast<bool>(static_cast<unsigned>(hole) & static_cast<unsigned>(cross(w, v) < T(0)));
    }
    const T meniscus = r * angles;
    return {T(0.5) * (twice + r * meniscus), meniscus + wet.cosine * wetted, hole};
  }

  [[nodiscard]] gas_section<T, N> section(const T& r) const noexcept {
    gas_section<T, N> out;
    std::array<vec2<T>, N> w_leave;
    std::array<vec2<T>, N> w_enter;
    std::array<vec2<T>, N> swing;
    for (std::size_t k = 0; k < count(); ++k) {
      swing[k] = swing_of(k, r);
    }
    for (std::size_t k = 0; k < count(); ++k) {
      place(k, r, swing, out, w_leave, w_enter);
    }
    T angles = turning;
    T area = T(0);
    const vec2<T> origin = out.from[0];
    for (std::size_t k = 0; k < count(); ++k) {
      const std::size_t p = previous(k);
      const auto& s = side(k);
      area = area + cross(out.to[p] - origin, out.from[k] - origin) + cross(out.from[k] - origin, out.to[k] - origin) +
             cross(out.leave[k] - w_enter[p], w_leave[k] - out.enter[p]);
      if (s.kind == side_kind::disc) {
        const T square = s.radius * s.radius;
        const T y = -cross(out.enter[p], out.leave[k]);
        const T x = square + dot(out.enter[p], out.leave[k]);
        const auto arc = arc_of(y, x);
        T e = arc.angle;
        if (N != 3 || e < T(0)) {
          e = unwound(k, e, out.enter[p], out.leave[k]);
        }
        area = area - square * arc.segment;
        angles = angles + e;
        out.wetted[k] = e;
        out.wetted_length = out.wetted_length + s.radius * e;
        if constexpr (N == 3) {
          out.hole = out.hole && cross(w_enter[p], w_leave[k]) < T(0);
        }
      } else {
        const vec2<T> forward{s.normal.y, -s.normal.x};
        const T length = dot(forward, out.leave[k] - out.enter[p]);
        out.wetted[k] = length;
        out.wetted_length = out.wetted_length + length;
        if constexpr (N == 3) {
          out.hole = out.hole && dot(forward, w_leave[k] - w_enter[p]) > T(0);
        }
      }
    }
    out.meniscus_length = r * angles;
    out.perimeter = out.meniscus_length + wet.cosine * out.wetted_length;
    out.area = T(0.5) * (area + r * out.meniscus_length);
    return out;
  }
};

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
