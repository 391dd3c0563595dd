// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/eliminate.hpp"
#include "tetrapore/geometry/status.hpp"
#include "tetrapore/law/bridge/meniscus.hpp"
#include "tetrapore/law/bridge/profile.hpp"

/// \file
/// The profile of a given gap and volume or suction: Newton's method on all four equations.
/// \par Source  derived here

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

/// What is asked: a gap, and a volume or a k.
template <std::floating_point T>
struct demand {
  T gap;
  T value;
  bridge_control by;
};

/// The unknowns in one order for all charts: (scale × k, ln extent, ln w1, ln w2); an equal pair has three.
template <bool Equal>
inline constexpr int unknowns = Equal ? 3 : 4;

template <bool Equal, std::floating_point T>
inline void move(profile<T>& u, const T& scale, const T (&by)[4], const T& factor) noexcept {
  u.k += factor * by[0] / scale;
  u.extent += u.extent * (factor * by[1]);
  u.w[0] += u.w[0] * (factor * by[2]);
  if constexpr (Equal) {
    u.w[1] = u.w[0];
  } else {
    u.w[1] += u.w[1] * (factor * by[3]);
  }
}

/// The profile in the chart that suits it: from the extremum where there is a neck, real or virtual, else from the
/// contact; p small, a bulge and a radius of the neck that is negative all need the latter.
template <bool Equal, std::floating_point T>
inline void choose_chart(const surface_pair<T>& pair, profile<T>& u) noexcept {
  using std::atan2;
  using std::sqrt;
  T re[2];
  T im[2];
  T p[2];
  T lambda[2];
  T thinnest[2];
  for (int i = 0; i < 2; ++i) {
    const auto side = static_cast<std::size_t>(i);
    const contact_circle<T> at(pair.side[side], u.w[side]);
    re[i] = T(1) + T(2) * u.k * at.radius * at.sine;
    im[i] = T(2) * u.k * at.radius * at.cosine;
    p[i] = sqrt(re[i] * re[i] + im[i] * im[i]);
    lambda[i] = at.radius * (at.sine + u.k * at.radius);
    thinnest[i] = T(1e-3) * at.radius;
  }
  const T least = smaller(p[0], p[1]);
  const bool bulge = im[0] > T(0) && im[1] > T(0) && u.k < T(0);      // both circles on the way to it
  const bool between = im[0] < T(0) && im[1] < T(0);                  // a neck between them
  const T thin = between ? T(0) : smaller(thinnest[0], thinnest[1]);  // of a virtual neck
  const bool neck =
      !(u.k < T(0)) || (!bulge && (between || re[0] + re[1] > T(0)) && least > T(0.1) && lambda[0] > thin &&
                        lambda[1] > thin && re[0] > T(-0.9) * p[0] && re[1] > T(-0.9) * p[1]);
  const auto length = [&](const T& turned) {
    return T(0.5) * (atan2(im[0], re[0]) - turned + (Equal ? T(0) : atan2(im[1], re[1]) - turned)) / u.k;
  };
  if (neck && u.by == chart::from_contact) {
    // the same circles may belong to a longer profile that passes a bulge
    if (!(u.k < T(0)) || std::abs(length(T(0)) - u.extent) < T(0.1) * u.extent) {
      u.by = chart::from_extremum;
      u.extent = (lambda[0] + lambda[1]) / (T(1) + T(0.5) * (p[0] + p[1]));
    }
  } else if (!neck && u.by == chart::from_extremum) {
    u.by = chart::from_contact;
    u.extent = length(bulge ? pi<T> : T(0));
  }
}

/// A profile that was found.
template <std::floating_point T>
struct found {
  profile<T> u;
  sample<T> at;  ///< where the last step was taken from
  T lambda;      ///< after the last step, as the volume
  T volume;
  T by_gap[4];    ///< the unknowns by gap / scale, the given value constant
  T by_value[4];  ///< the unknowns by the given value: volume / scale³ or k × scale, gap constant
  T least;        ///< (step of the unknowns per unit of gap)⁻¹: how near the fold
  bool converged;
};

/// Negative directions of the energy under constant suction, from Jacobi's field of the profile: the translation of the
/// curve and its change of size at constant k span its solutions, so that its zeros are counted without tracing it.
/// With g the gap: [∂λ/∂δ₁ cos(δ₁+θ₁) < 0] + [the same of 2] + [dλ/dg at k > 0] + (extrema of the profile) − 1.
/// Under constant volume one less where dV/dk > 0 at constant gap.
struct stability_index {
  int at_suction;
  int at_volume;
  bool slides;  ///< the contact circles of an equal pair slide together: the bridge turns lopsided
};

template <std::floating_point T>
[[nodiscard]] inline int extrema(const sample<T>& s) noexcept {
  if ((s.cosine[0] < T(0)) == (s.cosine[1] < T(0))) {
    return s.span > T(2) * pi<T> ? 3 : 1;
  }
  return s.span > pi<T> ? 2 : 0;
}

template <bool Equal, std::floating_point T>
[[nodiscard]] inline stability_index index_of(const surface_pair<T>& pair, const found<T>& f,
                                              bridge_control by) noexcept {
  using std::cos;
  using std::sin;
  T lambda_gap(0);
  T lambda_value(0);
  T volume_value(0);
  for (int i = 0; i < unknowns<Equal>; ++i) {
    lambda_gap += f.at.lambda_by[i] * f.by_gap[i];
    lambda_value += f.at.lambda_by[i] * f.by_value[i];
    volume_value += f.at.by[volume_row][i] * f.by_value[i];
  }
  bool swells = volume_value > T(0);  // dV/dk > 0
  bool stiffens = lambda_gap > T(0);  // dλ/dg > 0 at k
  if (by == bridge_control::volume) {
    const T k_value = f.by_value[0];
    swells = k_value > T(0);
    const T numerator = lambda_gap * k_value - lambda_value * f.by_gap[0];
    stiffens = swells ? numerator > T(0) : numerator < T(0);
  }
  stability_index index{};
  if (std::abs(f.at.modulus) < T(1e-9)) {
    // the cylinder itself: Jacobi's field is a sine
    const contact_circle<T> first(pair.side[0], f.u.w[0]);
    const contact_circle<T> second(pair.side[1], f.u.w[1]);
    const T angle = f.at.span;
    const T a = first.cap_sine / first.cap_cosine;
    const T b = second.cap_sine / second.cap_cosine;
    const T field = cos(angle) + a * sin(angle);
    const T slope = a * cos(angle) - sin(angle);
    const bool zero = field < T(0);
    index.at_suction = (zero ? 1 : 0) + ((slope + b * field) * (zero ? T(-1) : T(1)) < T(0) ? 1 : 0);
    index.slides = index.at_suction > 1;
  } else {
    index.at_suction = (f.at.turn[0] * f.at.cosine[0] < T(0) ? 1 : 0) + (f.at.turn[1] * f.at.cosine[1] < T(0) ? 1 : 0) +
                       (stiffens ? 1 : 0) + extrema(f.at) - 1;
    index.slides = Equal && (f.at.turn[0] * f.at.cosine[0] < T(0) || extrema(f.at) > 1);
  }
  index.at_volume = index.at_suction - (swells ? 1 : 0);
  // where the circles begin to slide dλ/dg changes its sign with them; rounding may let it go first
  index.at_suction = index.at_suction < 0 ? 0 : index.at_suction;
  index.at_volume = index.at_volume < 0 ? 0 : index.at_volume;
  return index;
}

/// The equations at a sample, linear in the step to the solution, in the first columns of a matrix.
template <bool Equal, int Columns, std::floating_point T>
inline void equations(const sample<T>& s, const profile<T>& u, const demand<T>& d,
                      matrix<T, unknowns<Equal>, Columns>& a) noexcept {
  constexpr int n = unknowns<Equal>;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      a[row][column] = s.by[row][column];
    }
  }
  const T inverse = T(1) / s.scale;
  a[match_row][n] = -s.match[0];
  a[gap_row][n] = d.gap * inverse - s.gap;
  if (d.by == bridge_control::volume) {
    a[volume_row][n] = d.value * inverse * inverse * inverse - s.volume;
  } else {
    a[volume_row][n] = (d.value - u.k) * s.scale;
    a[volume_row][0] = T(1);
    for (int column = 1; column < n; ++column) {
      a[volume_row][column] = T(0);
    }
  }
  if constexpr (!Equal) {
    a[second_match_row][n] = -s.match[1];
  }
}

/// The step to the solution, and the changes by gap and by value.
template <bool Equal, std::floating_point T>
[[nodiscard]] inline bool linearise(const sample<T>& s, const profile<T>& u, const demand<T>& d, T (&step)[4],
                                    T (&by_gap)[4], T (&by_value)[4]) noexcept {
  constexpr int n = unknowns<Equal>;
  matrix<T, n, n + 3> a;
  equations<Equal, n + 3>(s, u, d, a);
  for (int row = 0; row < n; ++row) {
    a[row][n + 1] = a[row][n + 2] = T(0);
  }
  a[gap_row][n + 1] = T(1);
  a[volume_row][n + 2] = T(1);
  if (!eliminate<n, 3, T>(a)) {
    return false;
  }
  for (int i = 0; i < n; ++i) {
    step[i] = a[i][n];
    by_gap[i] = a[i][n + 1];
    by_value[i] = a[i][n + 2];
  }
  for (int i = n; i < 4; ++i) {
    step[i] = by_gap[i] = by_value[i] = T(0);
  }
  return true;
}

inline constexpr int newton_cap = 30;
inline constexpr int coarse_nodes = 4;  ///< what a rough iterate is worth

/// Newton's method from `u`. A rough start is improved with few nodes until its steps are small.
template <int N, bool Equal, bool Rough = false, std::floating_point T>
[[nodiscard]] inline found<T> newton(const surface_pair<T>& pair, const demand<T>& d, const profile<T>& u,
                                     int cap = newton_cap) noexcept {
  using std::isfinite;
  found<T> f;
  f.u = u;
  f.converged = false;
  T before = T(1);
  int charts = 0;
  bool trusted = false;
  bool coarse = Rough && N > coarse_nodes;
  for (int iteration = 0; iteration < cap; ++iteration) {
    f.at = coarse ? sample_of<coarse_nodes, Equal>(pair, f.u) : sample_of<N, Equal>(pair, f.u);
    T step[4];
    if (!f.at.sound) {
      const chart was = f.u.by;
      choose_chart<Equal>(pair, f.u);
      if (was == f.u.by || ++charts > 3) {
        return f;
      }
      continue;
    }
    if (!linearise<Equal>(f.at, f.u, d, step, f.by_gap, f.by_value)) {
      return f;
    }
    T size = std::abs(step[0]) / (T(1) + std::abs(f.u.k) * f.at.scale);
    for (int i = 1; i < unknowns<Equal>; ++i) {
      size = larger(size, std::abs(step[i]));
    }
    if (!isfinite(size)) {
      return f;
    }
    const T factor = size > T(0.5) ? T(0.5) / size : T(1);
    move<Equal>(f.u, f.at.scale, step, factor);
    // the error after a step is its square times that of the last; a step that no longer shrinks is rounding
    const T gain = size / before;
    const bool settled = size * gain * gain < T(8) * std::numeric_limits<T>::epsilon() && size < T(1e-3);
    const bool stalled = size < T(1e8) * std::numeric_limits<T>::epsilon() && gain > T(0.3);
    const bool small = size * size < std::numeric_limits<T>::epsilon() * T(1e-2);
    if (!coarse && (small || (trusted && (settled || stalled)))) {
      f.volume = f.at.volume;
      for (int i = 0; i < unknowns<Equal>; ++i) {
        f.volume += f.at.by[volume_row][i] * step[i];
      }
      f.volume *= f.at.scale * f.at.scale * f.at.scale;
      if (d.by == bridge_control::suction) {
        f.u.k = d.value;
      }
      if (f.u.by == chart::from_extremum) {
        f.lambda = f.u.extent + f.u.k * f.u.extent * f.u.extent;
      }
      if (Equal || f.u.by == chart::from_contact) {
        const contact_circle<T> first(pair.side[0], f.u.w[0]);
        if (f.u.by == chart::from_contact) {
          f.lambda = first.radius * (first.sine + f.u.k * first.radius);
          if constexpr (Equal) {
            mirrored(f.at, first, f.u);
          }
        } else {
          f.at.turn[0] = f.at.turn[1] = first.turn(f.u.k);
          f.at.cosine[0] = f.at.cosine[1] = first.cosine;
        }
      }
      f.converged = true;
      return f;
    }
    before = size;
    trusted = !coarse;  // this step and the next share their rule
    coarse = coarse && size > T(0.02);
    if (charts < 3 && (f.u.by == chart::from_contact || T(1) + T(2) * f.u.k * f.u.extent < T(0.1))) {
      const chart was = f.u.by;
      choose_chart<Equal>(pair, f.u);
      charts += was == f.u.by ? 0 : 1;
    }
  }
  return f;
}

/// The bridge as if its profile were an arc of a circle and both contact circles of one size.
template <bool Equal, std::floating_point T>
struct circular_bridge {
  T span;     ///< along the axis, from circle to circle
  T cosines;  ///< of δ + θ, summed
  T arc;      ///< radius of the arc, negative where it bulges
  T neck;
  T volume;
  std::array<T, 2> w;

  circular_bridge(const surface_pair<T>& pair, const T& gap, const T& rc) noexcept {
    using std::sqrt;
    const T both = Equal ? T(2) : T(1);
    cosines = T(0);
    span = gap;
    T sag(0);    // Σ (1 − sin)
    T lunes(0);  // between arc and chord, over arc²
    T rise(0);
    T caps(0);
    for (std::size_t i = 0; i < (Equal ? 1U : 2U); ++i) {
      const wetted_surface<T>& on = pair.side[i];
      const T sine = smaller(on.curvature * rc, T(0.97));
      const T cosine = sqrt(T(1) - sine * sine);
      w[i] = T(2) * (sine < T(0.97) ? rc : sine / on.curvature) / (T(1) + cosine);
      const T level = T(0.5) * w[i] * rc;
      const T height = on.curvature * level;
      const T g = sine * on.cosine + cosine * on.sine;
      const T c = cosine * on.cosine - sine * on.sine;
      const T s2 = c * c;
      // (φ − sin φ cos φ) / 2, to a per cent
      const T lune = c * s2 * (T(0.333) + s2 * (T(0.1) + s2 * (T(0.054) + T(0.298) * s2 * s2 * s2 * s2)));
      cosines += both * c;
      span += both * height;
      caps += both * (pi<T> / T(3)) * height * level * (T(2) + cosine);
      sag += both * (T(1) - g);
      lunes += both * lune;
      rise += both * lune * (T(1) - g);
    }
    if constexpr (Equal) {
      w[1] = w[0];
    }
    const T bend = cosines > T(1e-3) || cosines < T(-1e-3) ? cosines : T(1e-3);
    arc = span / bend;
    neck = larger(rc - T(0.5) * arc * sag, T(0.25) * rc);
    volume = pi<T> * rc * rc * span - caps - T(2) * pi<T> * arc * arc * (rc * lunes - T(0.4) * arc * rise);
  }

  [[nodiscard]] T k() const noexcept { return T(0.5) * (T(1) / arc - T(1) / neck); }
};

template <bool Equal, std::floating_point T>
[[nodiscard]] inline profile<T> profile_of(const surface_pair<T>& pair, const circular_bridge<Equal, T>& t,
                                           const T& k) noexcept {
  profile<T> u{k, t.neck, t.w, chart::from_extremum};
  if (k < T(0)) {
    choose_chart<Equal>(pair, u);
    if (u.by == chart::from_contact && !(u.extent > T(0.2) * t.span && u.extent < T(3) * t.span)) {
      u.extent = Equal ? T(0.5) * t.span : t.span;
    }
  }
  return u;
}

/// Where Newton's method starts.
template <bool Equal, std::floating_point T>
[[nodiscard]] inline profile<T> first_guess(const surface_pair<T>& pair, const demand<T>& d) noexcept {
  using std::sqrt;
  using bridge_type = circular_bridge<Equal, T>;
  const T curvature = pair.side[0].curvature + pair.side[1].curvature;
  const T gap = larger(d.gap, T(0));
  if (d.by == bridge_control::volume) {
    // the cylinder between two paraboloids: πr²g + π r⁴ curvature / 4 = V
    const T half = T(2) * gap / curvature;
    const T target = T(4) * d.value / (pi<T> * curvature);
    T rc = sqrt(target / (half + sqrt(half * half + target)));
    bridge_type t(pair, gap, rc);
    for (int i = 0; i < 4; ++i) {
      const T miss = d.value / t.volume - T(1);
      if (!(t.volume > T(0)) || miss > T(1)) {
        rc *= T(1.3);
      } else {
        const T quadratic = curvature * rc * rc;
        rc *= T(1) + miss * (gap + T(0.25) * quadratic) / (T(2) * gap + quadratic);
      }
      t = bridge_type(pair, gap, rc);
      if (std::abs(miss) < T(0.1)) {
        break;
      }
    }
    return profile_of<Equal>(pair, t, t.k());
  }
  // span (2k + 1/neck) = Σ cos: the larger root, from above, by secants in the square of the circle
  const T k = d.value;
  const T wetting = pair.side[0].cosine + pair.side[1].cosine;
  T widest = T(0.95) * pair.side[0].cosine / pair.side[0].curvature;
  if (widest * pair.side[1].curvature > T(0.95) * pair.side[1].cosine) {
    widest = T(0.95) * pair.side[1].cosine / pair.side[1].curvature;
  }
  T x = widest * widest;
  if (k > T(0)) {
    x = smaller(x, larger(T(2) * (T(0.5) * wetting / k - gap), T(1e-2) * wetting / k) / curvature);
  }
  bridge_type t(pair, gap, sqrt(x));
  T excess = t.span * (T(2) * k + T(1) / t.neck) - t.cosines;
  T slope = T(0.5) * curvature * (T(2) * k + T(1) / t.neck);
  for (int i = 0; i < 6 && excess > T(0.02) * t.cosines && slope > T(0); ++i) {
    const T next = larger(x - excess / slope, T(0.5) * x);
    const bridge_type trial(pair, gap, sqrt(next));
    const T now = trial.span * (T(2) * k + T(1) / trial.neck) - trial.cosines;
    if (!(now < excess)) {
      break;  // beyond the least excess: the arc of a circle has no root, the profile may have one near
    }
    slope = (excess - now) / (x - next);
    t = trial;
    x = next;
    excess = now;
  }
  return profile_of<Equal>(pair, t, k);
}

/// The bridge asked for, from the first guess; near its fold by way of smaller gaps, from where Newton's method comes
/// to the fold on the stable side. What is found is stable.
template <int N, bool Equal, std::floating_point T>
[[nodiscard]] inline found<T> approach(const surface_pair<T>& pair, const demand<T>& d) noexcept {
  const auto stable = [&](const found<T>& f) {
    if (!f.converged) {
      return false;
    }
    const stability_index index = index_of<Equal>(pair, f, d.by);
    return (d.by == bridge_control::volume ? index.at_volume : index.at_suction) == 0;
  };
  found<T> f = newton<N, Equal, true>(pair, d, first_guess<Equal>(pair, d), 12);
  if (stable(f)) {
    return f;
  }
  for (const T share : {T(0.75), T(0)}) {
    demand<T> nearer = d;
    nearer.gap *= share;
    f = newton<N, Equal, true>(pair, nearer, first_guess<Equal>(pair, nearer), 12);
    if (stable(f)) {
      f = newton<N, Equal>(pair, d, f.u, 12);
      if (stable(f)) {
        return f;
      }
    }
    if (!(d.gap > T(0))) {
      break;
    }
  }
  f.converged = false;
  return f;
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
