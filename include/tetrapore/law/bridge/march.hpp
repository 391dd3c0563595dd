// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/solve_profile.hpp"

/// \file
/// The bridges of a pair as a curve: from the bridge at contact along the gap, through the fold where it ends.
/// \par Source  pseudo-arclength continuation: Keller, in Applications of Bifurcation Theory, Academic Press (1977),
///              359; folds of bridges: Lian, Thornton & Adams, J. Colloid Interface Sci. 161, 138 (1993)

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

enum class along : unsigned char { gap, value };

/// A bridge on the curve, with the direction in which the curve goes on.
template <std::floating_point T>
struct waypoint {
  profile<T> u;
  sample<T> at;
  T direction[4];  ///< of the unknowns, of length 1
  T reach;         ///< the gap, or the volume or k
  T slope;         ///< of `reach` along the curve
  T hold;          ///< ∂λ/∂δ of an equal pair by size, negative from where its circles slide together
  int index;       ///< negative directions of the energy under the control
  bool sound;
};

template <bool Equal, std::floating_point T>
class path {
 public:
  static constexpr int n = unknowns<Equal>;
  static constexpr int step_cap = 400;
  static constexpr int locate_cap = 80;

  path(const surface_pair<T>& pair, const demand<T>& fixed, along what) noexcept
      : pair_(pair), fixed_(fixed), what_(what) {}

  [[nodiscard]] const surface_pair<T>& pair() const noexcept { return pair_; }

  /// The waypoint at a solution; the curve leaves it as `reach` grows (`sense` 1) or falls (−1).
  template <int N>
  [[nodiscard]] waypoint<T> begin(const profile<T>& u, int sense) const noexcept {
    waypoint<T> p;
    p.u = u;
    choose_chart<Equal>(pair_, p.u);
    settle<N>(p, nullptr, sense);
    return p;
  }

  /// The waypoint at a distance along the curve, or one that is not sound; a rough one lies beside the curve by 1e-6.
  template <int N>
  [[nodiscard]] waypoint<T> advance(const waypoint<T>& from, const T& distance, int* iterations,
                                    bool rough = false) const noexcept {
    using std::isfinite;
    waypoint<T> p;
    p.u = from.u;
    p.sound = false;
    T to[4];
    for (int i = 0; i < 4; ++i) {
      to[i] = from.direction[i] * (i == 0 ? weight(from) : T(1));
    }
    move<Equal>(p.u, from.at.scale, to, distance);
    T before = T(1);
    for (int iteration = 0; iteration < 12; ++iteration) {
      p.at = sample_of<N, Equal>(pair_, p.u);
      if (!p.at.sound) {
        return p;
      }
      matrix<T, n, n + 1> a;
      equations<Equal, n + 1>(p.at, p.u, fixed_, a);
      const int free = what_ == along::gap ? gap_row : volume_row;
      for (int column = 0; column < n; ++column) {
        a[free][column] = from.direction[column] * (column == 0 ? T(1) / weight(p) : T(1));
      }
      a[free][n] = T(0);
      if (!eliminate<n, 1, T>(a)) {
        return p;
      }
      T step[4]{};
      T size = std::abs(a[0][n]) / weight(p);
      for (int i = 0; i < n; ++i) {
        step[i] = a[i][n];
        if (i > 0) {
          size = larger(size, std::abs(step[i]));
        }
      }
      if (!isfinite(size) || size > T(0.5)) {
        return p;
      }
      move<Equal>(p.u, p.at.scale, step, T(1));
      *iterations = iteration + 1;
      const T gain = size / before;
      if ((rough && size < T(1e-3)) || size < T(20) * std::numeric_limits<T>::epsilon() ||
          (iteration > 0 && size * gain * gain < T(4) * std::numeric_limits<T>::epsilon() && size < T(1e-3)) ||
          (iteration > 2 && size < T(1e-8) && gain > T(0.3))) {
        settle<N>(p, &from, 0);
        const chart was = p.u.by;
        choose_chart<Equal>(pair_, p.u);
        if (p.sound && p.u.by != was) {
          settle<N>(p, nullptr, p.slope < T(0) ? -1 : 1);
        }
        return p;
      }
      before = size;
    }
    return p;
  }

 private:
  surface_pair<T> pair_;
  demand<T> fixed_;
  along what_;

  [[nodiscard]] static T weight(const waypoint<T>& p) noexcept { return T(1) + std::abs(p.u.k) * p.at.scale; }

  /// Direction, reach and slope at a solution.
  template <int N>
  void settle(waypoint<T>& p, const waypoint<T>* from, int sense) const noexcept {
    using std::isfinite;
    using std::sqrt;
    p.at = sample_of<N, Equal>(pair_, p.u);
    p.sound = p.at.sound;
    if (!p.sound) {
      return;
    }
    found<T> f{};
    T step[4];
    f.u = p.u;
    f.at = p.at;
    // at a fold itself the unknowns have no derivatives: the direction is then that of the border
    const bool regular = linearise<Equal>(p.at, p.u, fixed_, step, f.by_gap, f.by_value);
    p.sound = regular || from != nullptr;
    if (!p.sound) {
      return;
    }
    const stability_index index = index_of<Equal>(pair_, f, fixed_.by);
    p.index = !regular ? 1 : fixed_.by == bridge_control::volume ? index.at_volume : index.at_suction;
    p.hold = index.slides ? -std::abs(p.at.turn[0]) : std::abs(p.at.turn[0]);
    const T(&along_curve)[4] = !regular ? from->direction : what_ == along::gap ? f.by_gap : f.by_value;
    T unit = p.at.scale;
    if (what_ == along::value) {
      unit = fixed_.by == bridge_control::volume ? unit * unit * unit : T(1) / unit;
    }
    T square(0);
    T overlap(0);
    for (int i = 0; i < 4; ++i) {
      const T c = along_curve[i] / (regular && i == 0 ? weight(p) : T(1));
      p.direction[i] = c;
      square += c * c;
      if (from != nullptr) {
        overlap += c * from->direction[i];
      }
    }
    const T size = sqrt(square);
    p.sound = p.sound && isfinite(size) && size > T(0);
    const bool back = from != nullptr ? overlap < T(0) : sense < 0;
    const T factor = (back ? T(-1) : T(1)) / size;
    for (T& c : p.direction) {
      c *= factor;
    }
    p.slope = regular ? factor * unit : T(0);
    if (what_ == along::gap) {
      p.reach = p.at.gap * p.at.scale;
    } else {
      p.reach = fixed_.by == bridge_control::volume ? p.at.volume * p.at.scale * p.at.scale * p.at.scale : p.u.k;
    }
  }
};

/// Why a march ended.
enum class arrival : unsigned char { at_target, at_fold, at_slide, at_limit, lost };

template <std::floating_point T>
struct journey {
  waypoint<T> end;  ///< at the target, at the fold, or where the circles of an equal pair begin to slide together
  arrival how;
};

/// Whether the curve turns so far between two waypoints that they may lie on two curves.
template <std::floating_point T>
[[nodiscard]] inline bool turned(const waypoint<T>& from, const waypoint<T>& to) noexcept {
  T cosine(0);
  for (int i = 0; i < 4; ++i) {
    cosine += from.direction[i] * to.direction[i];
  }
  return from.u.by == to.u.by && cosine < T(0.9);
}

/// Finds where between two waypoints of an equal pair the circles begin to slide; false if they do not.
template <int N, bool Equal, std::floating_point T>
[[nodiscard]] inline bool slides(const path<Equal, T>& along_path, const waypoint<T>& from, const waypoint<T>& to,
                                 const T& distance, waypoint<T>& where) noexcept {
  if (!Equal || !(from.hold > T(0)) || to.hold > T(0)) {
    return false;
  }
  T low(0);
  T high = distance;
  T at_low = from.hold;
  T at_high = to.hold;
  where = to;
  int iterations = 0;
  for (int i = 0; i < path<Equal, T>::locate_cap; ++i) {
    const T tau = i % 3 == 2 ? T(0.5) * (low + high) : low + (high - low) * at_low / (at_low - at_high);
    const waypoint<T> mid = along_path.template advance<N>(from, tau, &iterations);
    if (!mid.sound) {
      break;
    }
    where = mid;
    const T now = mid.hold;
    if (std::abs(now) < T(4) * std::numeric_limits<T>::epsilon() * from.hold ||
        high - low < std::numeric_limits<T>::epsilon()) {
      break;
    }
    (now > T(0) ? low : high) = tau;
    (now > T(0) ? at_low : at_high) = now;
  }
  return true;
}

/// Whether the liquid closes over a sphere, but for a contact circle of 1e-6 of its radius.
template <std::floating_point T>
[[nodiscard]] inline bool closed(const surface_pair<T>& pair, const profile<T>& u) noexcept {
  return pair.side[0].curvature * u.w[0] > T(4e6) || pair.side[1].curvature * u.w[1] > T(4e6);
}

/// Follows the curve from `start` until `reach` is the target or turns back. `sense` is that of the start.
template <int N, bool Equal, std::floating_point T>
[[nodiscard]] inline journey<T> follow(const path<Equal, T>& along_path, waypoint<T> from, const T& target,
                                       int sense) noexcept {
  using std::isfinite;
  const T sign = sense < 0 ? T(-1) : T(1);
  journey<T> trip{from, arrival::lost};
  T h = from.sound ? T(0.1) : T(0);
  int iterations = 0;
  for (int step = 0; step < path<Equal, T>::step_cap && h >= T(1e-7); ++step) {
    if (!(sign * (target - from.reach) > T(0))) {
      trip.end = from;
      trip.how = arrival::at_target;
      return trip;
    }
    waypoint<T> next = along_path.template advance<N>(from, h, &iterations, true);
    // a rough one may only seem to have passed the target, a fold or a slide, or to lie before them
    const bool near = next.sound && (sign * (next.reach - target) >= T(0) || (Equal && next.hold < T(0.01)) ||
                                     sign * next.slope < T(0.1) * sign * from.slope);
    if (near && iterations <= 5) {
      next = along_path.template advance<N>(from, h, &iterations);
      iterations = next.sound ? 3 : 12;
    }
    if (!next.sound || iterations > 5 || turned(from, next)) {
      h *= T(0.4);
      continue;
    }
    const bool passed = sign * (next.reach - target) >= T(0);
    const bool folded = !(sign * next.slope > T(0));
    // a step that leaps to another curve arrives where the number of negative directions does not fit
    const bool sliding = Equal && !(next.hold > T(0));
    if (!sliding && next.index != (folded ? 1 : 0)) {
      h *= T(0.4);
      continue;
    }
    const auto arrived = [&](const waypoint<T>& at, arrival how) {
      trip.end = at;
      trip.how = how;
      return trip;
    };
    waypoint<T> where;
    const auto slid = [&](const waypoint<T>& to, const T& distance) {
      return slides<N>(along_path, from, to, distance, where) && sign * (where.reach - target) < T(0);
    };
    if (!folded && slid(next, h)) {
      return arrived(where, arrival::at_slide);
    }
    if (!passed && !folded) {
      if (closed(along_path.pair(), next.u)) {
        return arrived(next, arrival::at_limit);
      }
      from = next;
      h = smaller(h * (iterations <= 2 ? T(1.6) : T(1)), T(0.8));
      continue;
    }
    // between `from`, which lies before, and `next`: the fold first, then the target if it lies before the fold
    T low(0);
    T high = h;
    bool lost = false;
    waypoint<T> at_low = from;
    waypoint<T> at_high = next;
    if (folded) {
      for (int i = 0; i < path<Equal, T>::locate_cap; ++i) {
        const T a = sign * at_low.slope;
        const T b = sign * at_high.slope;
        const T tau = i % 3 == 2 ? T(0.5) * (low + high) : low + (high - low) * a / (a - b);
        const waypoint<T> mid = along_path.template advance<N>(from, tau, &iterations);
        if (!mid.sound) {
          lost = true;
          break;
        }
        if (sign * mid.slope > T(0)) {
          low = tau;
          at_low = mid;
        } else {
          high = tau;
          at_high = mid;
        }
        const T least = smaller(std::abs(at_low.slope), std::abs(at_high.slope));
        const bool ordered = !Equal || (at_low.hold > T(0)) == (at_high.hold > T(0));  // no slide between the two
        if (ordered && isfinite(target) &&
            sign * (target - at_low.reach) >
                T(2) * std::abs(at_low.slope) * (high - low) + T(0.02) * std::abs(target)) {
          break;  // the target is far beyond any fold of a curve that bends down
        }
        if (sign * (mid.reach - target) >= T(0) ||
            least * (high - low) < T(0.1) * std::numeric_limits<T>::epsilon() * std::abs(mid.reach)) {
          break;
        }
      }
      if (lost) {
        h *= T(0.4);
        continue;
      }
      // the secants may close in on the fold from either side alone: what is near it is the higher of the two
      const bool beyond = sign * (at_high.reach - at_low.reach) > T(0);
      const waypoint<T>& top = beyond ? at_high : at_low;
      if (slid(top, beyond ? high : low)) {
        return arrived(where, arrival::at_slide);
      }
      if (sign * (top.reach - target) < T(0)) {
        return arrived(top, arrival::at_fold);
      }
      if (sign * (at_low.reach - target) >= T(0)) {
        high = low;
        at_high = at_low;
        low = T(0);
        at_low = from;
      }
    }
    waypoint<T> mid = at_low;
    for (int i = 0; i < path<Equal, T>::locate_cap; ++i) {
      const T a = sign * (target - at_low.reach);
      const T b = sign * (at_high.reach - target);
      const T share = i % 3 == 2 ? T(0.5) : a / (a + b);
      const T tau = low + (high - low) * share;
      mid = along_path.template advance<N>(from, tau, &iterations);
      if (!mid.sound) {
        lost = true;
        break;
      }
      // near enough for Newton's method, which must not pass the fold at slope² / (2 bend) from here
      const T miss = std::abs(mid.reach - target);
      const T bend = std::abs(at_low.slope - at_high.slope) / (high - low);
      const T slope = std::abs(mid.slope);
      if ((sign * mid.slope > T(0) && miss < T(1e-4) * slope * h && miss * bend < T(0.01) * slope * slope) ||
          miss <= T(4) * std::numeric_limits<T>::epsilon() * std::abs(target)) {
        break;
      }
      if (sign * (mid.reach - target) < T(0)) {
        low = tau;
        at_low = mid;
      } else {
        high = tau;
        at_high = mid;
      }
    }
    if (lost) {
      h *= T(0.4);
      continue;
    }
    return arrived(mid, arrival::at_target);
  }
  trip.end = from;
  return trip;
}

/// The bridge of a volume that neither pulls nor pushes, with its gap: λ is 0 and the profile an arc about its centre.
template <bool Equal, std::floating_point T>
[[nodiscard]] inline profile<T> sphere_between(const surface_pair<T>& pair, const T& volume, T& gap) noexcept {
  using std::acos;
  using std::cbrt;
  using std::sqrt;
  profile<T> u;
  u.by = chart::from_contact;
  const auto holds = [&](const T& a) {
    T span(0);
    T held(0);
    T turned(0);
    gap = T(0);
    for (std::size_t i = 0; i < 2; ++i) {
      const wetted_surface<T>& on = pair.side[i];
      // a sin(δ + θ) = R sin δ
      const T t = a * on.curvature * on.sine;
      const T b = T(1) - a * on.curvature * on.cosine;
      const T size = sqrt(t * t + b * b);
      u.w[i] = b > T(0) ? T(2) * a * on.sine / (size + b) : T(2) * (size - b) / (on.curvature * t);
      const contact_circle<T> at(on, u.w[i]);
      span -= a * at.cosine;
      held -= pi<T> * a * a * a * at.cosine * (T(1) - at.cosine * at.cosine / T(3)) + at.cap;
      turned += acos(at.cosine);
      gap -= at.height;
    }
    gap += span;
    u.k = T(-1) / a;
    u.extent = a * (turned - pi<T>)*(Equal ? T(0.5) : T(1));
    return span > T(0) ? held : T(0);
  };
  T low = T(0.1) * cbrt(volume);
  T high = low;
  for (int i = 0; i < 100 && holds(high) < volume; ++i) {
    high *= T(2);
  }
  for (int i = 0; i < 60; ++i) {
    const T middle = T(0.5) * (low + high);
    (holds(middle) < volume ? low : high) = middle;
  }
  static_cast<void>(holds(high));
  return u;
}

/// Along the gap from where a bridge neither pulls nor pushes: for so much liquid that it would close over a sphere at
/// contact. That start is one of a pair wetted less, if need be.
template <int N, bool Equal, std::floating_point T>
[[nodiscard]] inline journey<T> travel_from_sphere(const surface_pair<T>& pair, const demand<T>& d,
                                                   const T& gap_limit) noexcept {
  using std::atan2;
  using std::cos;
  using std::sin;
  journey<T> trip{{}, arrival::lost};
  surface_pair<T> on = pair;
  const auto wet = [&](const T& share) {
    for (std::size_t i = 0; i < 2; ++i) {
      const T theta = atan2(pair.side[i].sine, pair.side[i].cosine);
      if (theta < T(0.2)) {
        const T now = theta + (T(1) - share) * T(0.2);
        on.side[i].cosine = cos(now);
        on.side[i].sine = sin(now);
      }
    }
  };
  wet(T(0));
  demand<T> at{T(0), d.value, d.by};
  profile<T> u = sphere_between<Equal>(on, d.value, at.gap);
  const auto solve = [&] {
    const found<T> f = newton<N, Equal>(on, at, u, 12);
    u = f.u;
    return f.converged && index_of<Equal>(on, f, d.by).at_volume == 0;
  };
  if (!solve()) {
    return trip;
  }
  if (on.side[0].sine > pair.side[0].sine || on.side[1].sine > pair.side[1].sine) {
    const path<Equal, T> opening(on, at, along::gap);
    const auto start = opening.template begin<N>(u, 1);
    const auto end = follow<N>(opening, start, infinity<T>, 1);
    if (end.how != arrival::at_fold && end.how != arrival::at_slide) {
      return trip;
    }
    at.gap = T(0.5) * (at.gap + end.end.reach);
    u = follow<N>(opening, start, at.gap, 1).end.u;
    for (int i = 0; i <= 8; ++i) {
      wet(T(0.125) * T(i));
      if (!solve()) {
        return trip;
      }
    }
    on = pair;
  }
  const path<Equal, T> opening(pair, at, along::gap);
  const int sense = gap_limit < at.gap ? -1 : 1;
  trip = follow<N>(opening, opening.template begin<N>(u, sense), gap_limit, sense);
  if (sense < 0 && (trip.how == arrival::at_fold || trip.how == arrival::at_slide)) {
    trip.how = arrival::at_limit;
  }
  return trip;
}

/// Whether the gap is too wide for any bridge, from bounds that cost no march.
///
/// Of a suction, k > 0: the profile is convex, its curvature is 2k + cos φ / r, and r ≤ ρ, the radius of the circle, so
/// that a side reaches no farther from the neck, real or virtual, than 1 / (2k / cos θ + 1 / ρ (90° − θ)) (Jensen's
/// inequality), of which the cap takes ρ²/2R at least; the tangent at any ρ bounds the greatest difference.
/// Of a volume: the widest gap of all pairs over the cube root of the volume is below 1.76, for little liquid below
/// 1 + 0.47 θ and 1.47, and 0.22 v more, with v³ = V × (mean curvature of the surfaces)³ and the larger angle; the
/// bounds here are 3.5 % and more above what was found on 10⁵ random pairs.
template <std::floating_point T>
[[nodiscard]] inline bool out_of_reach(const surface_pair<T>& pair, const demand<T>& d) noexcept {
  using std::acos;
  using std::cbrt;
  const bool by_volume = d.by == bridge_control::volume;
  const T cube = d.gap * d.gap * d.gap;
  const T a = T(2) * d.value;
  const T wetting = pair.side[0].cosine + pair.side[1].cosine;
  if (!(d.gap > T(0)) || !(by_volume ? cube > d.value : a * d.gap > T(0.15) * wetting)) {
    return false;  // near enough to be worth a try
  }
  if (by_volume) {
    const T v = T(0.5) * cbrt(d.value) * (pair.side[0].curvature + pair.side[1].curvature);
    const T angle = acos(smaller(pair.side[0].cosine, pair.side[1].cosine));
    const T widest = v < T(0.75) ? smaller(T(1.04) + T(0.47) * angle, T(1.53)) + T(0.22) * v : T(1.85);
    return cube > d.value * widest * widest * widest;
  }
  T reach = wetting / a * T(1e-9);
  for (const wetted_surface<T>& on : pair.side) {
    const T s = on.cosine;
    const T turn = acos(on.sine);
    T side = s / a;
    if (on.curvature > T(0)) {
      T rho = smaller(cbrt(s * s / (on.curvature * a * a * turn)), turn / on.curvature);
      for (int i = 0; i < 2; ++i) {  // to where the difference is greatest, from above
        const T sum = a * rho * turn + s;
        const T miss = on.curvature * rho * sum * sum - turn * s * s;
        rho -= miss / (on.curvature * sum * (sum + T(2) * a * rho * turn));
      }
      const T sum = a * rho * turn + s;
      const T slope = turn * (s / sum) * (s / sum);
      side = smaller(side, rho * turn * s / sum - slope * rho + slope * slope / (T(2) * on.curvature));
    }
    reach += side;
  }
  return d.gap > reach;
}

/// A bridge from nothing: at contact from little liquid (or a high suction) to the value asked, then along the gap.
template <int N, bool Equal, std::floating_point T>
[[nodiscard]] inline journey<T> travel(const surface_pair<T>& pair, const demand<T>& d, const T& gap_limit) noexcept {
  journey<T> trip{{}, arrival::lost};
  demand<T> at_contact{T(0), d.value, d.by};
  const T curvature = pair.side[0].curvature + pair.side[1].curvature;
  const T wetting = pair.side[0].cosine + pair.side[1].cosine;
  const bool by_volume = d.by == bridge_control::volume;
  const auto easy = [&](const T& circle) {
    const T square = circle * circle;
    return by_volume ? pi<T> * square * square * curvature / T(4) : wetting / (curvature * square);
  };
  T circle = T(0.5) * wetting / curvature;
  found<T> f;
  f.converged = false;
  for (int i = 0; i < 12 && !f.converged; ++i, circle *= T(0.4)) {
    const T value = easy(circle);
    at_contact.value = by_volume ? smaller(value, d.value) : larger(value, d.value);
    f = newton<N, Equal>(pair, at_contact, first_guess<Equal>(pair, at_contact), 12);
    if (f.converged) {
      const auto index = index_of<Equal>(pair, f, d.by);
      f.converged = (by_volume ? index.at_volume : index.at_suction) == 0;
    }
  }
  if (!f.converged) {
    return trip;
  }
  // along the gap first where the surfaces overlap: more suctions have a bridge there than at contact
  profile<T> u = f.u;
  const bool overlap = gap_limit < T(0);
  const auto move_gap = [&] {
    const path<Equal, T> opening(pair, at_contact, along::gap);
    const int sense = overlap ? -1 : 1;
    trip = follow<N>(opening, opening.template begin<N>(u, sense), gap_limit, sense);
    return trip.how == arrival::at_target;
  };
  const auto settle = [&](const profile<T>& near) {
    f = newton<N, Equal>(pair, at_contact, near, 12);
    u = f.u;
    return f.converged;
  };
  if (overlap && at_contact.value != d.value) {
    if (!move_gap()) {
      return trip;
    }
    at_contact.gap = gap_limit;
    trip.how = arrival::lost;
    if (!settle(trip.end.u)) {
      return trip;
    }
  }
  if (at_contact.value != d.value) {
    const path<Equal, T> filling(pair, at_contact, along::value);
    const int sense = by_volume ? 1 : -1;
    const auto filled = follow<N>(filling, filling.template begin<N>(u, sense), d.value, sense);
    if (filled.how != arrival::at_target) {
      if (by_volume && gap_limit > T(0)) {
        return travel_from_sphere<N, Equal>(pair, d, gap_limit);
      }
      trip.how = filled.how == arrival::lost ? arrival::lost : arrival::at_limit;
      return trip;
    }
    at_contact.value = d.value;
    if (!settle(filled.end.u)) {
      return trip;
    }
  }
  trip.end.u = u;
  trip.how = arrival::at_target;
  if (at_contact.gap != gap_limit) {
    static_cast<void>(move_gap());
  }
  return trip;
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
