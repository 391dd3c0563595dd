// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/gauss_rule.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

/// \file
/// The profile of a bridge, a piece of a Delaunay curve between two wetted surfaces, with all first derivatives.
///
/// With k half the mean curvature p_c / 2σ, φ the slope of the profile and s its arc length, z = r exp(iφ) obeys
/// 1 + 2kz ∝ exp(2iks): its modulus p is constant, the force is 2πσλ with λ = Re z + k |z|² = (p² − 1)/4k, and the
/// profile has its extremum r0 = (p − 1)/2k where z is real.
/// \par Source  Delaunay, J. Math. Pures Appl. 6, 309 (1841); Kenmotsu, Tôhoku Math. J. 32, 147 (1980), for the complex
///              form; equations derived here

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

/// A surface that the liquid wets: a sphere, or a plane of curvature 0.
template <std::floating_point T>
struct wetted_surface {
  T curvature;
  T cosine;  ///< of the contact angle
  T sine;
};

template <std::floating_point T>
struct surface_pair {
  std::array<wetted_surface<T>, 2> side;
  bool equal;  ///< both sides are the same: the bridge is its own mirror image
};

/// Where the profile meets a surface, by w = (2/curvature) tan(half of the filling angle): regular on a plane, where w
/// is the radius of the contact circle, and up to a filling angle of 180°.
template <std::floating_point T>
struct contact_circle {
  T radius;
  T height;      ///< of the wetted cap
  T cap;         ///< volume of the wetted cap
  T cap_cosine;  ///< of the filling angle δ
  T cap_sine;
  T sine;  ///< of δ + θ, the angle between the profile and the plane of the circle
  T cosine;

  contact_circle(const wetted_surface<T>& on, const T& w) noexcept {
    const T q = T(0.5) * on.curvature * w;
    const T share = T(1) / (T(1) + q * q);
    radius = w * share;
    cap_cosine = (T(1) - q * q) * share;
    cap_sine = T(2) * q * share;
    const T level = T(0.5) * w * radius;  // radius of the sphere × height of the cap
    height = on.curvature * level;
    cap = (pi<T> / T(3)) * height * level * (T(2) + cap_cosine);
    sine = cap_sine * on.cosine + cap_cosine * on.sine;
    cosine = cap_cosine * on.cosine - cap_sine * on.sine;
  }

  /// ∂λ/∂δ at constant k, over the radius of the surface.
  [[nodiscard]] T turn(const T& k) const noexcept {
    return (sine + T(2) * k * radius) * cap_cosine + cosine * cap_sine;
  }
};

/// 1/√x in operations that compilers vectorise: the exponent halved in the bits, then Newton's method.
template <std::floating_point T>
[[nodiscard]] inline T inverse_root(const T& x) noexcept {
  if constexpr (std::is_same_v<T, double> && std::numeric_limits<T>::is_iec559) {
    double y = std::bit_cast<double>(0x5fe6eb50c7b537a9ULL - (std::bit_cast<std::uint64_t>(x) >> 1U));
    const double half = 0.5 * x;
    y *= 1.5 - half * y * y;
    y *= 1.5 - half * y * y;
    y *= 1.5 - half * y * y;
    y *= 1.5 - half * y * y;
    return y;
  } else {
    using std::sqrt;
    return T(1) / sqrt(x);
  }
}

template <std::floating_point T, std::size_t N>
[[nodiscard]] inline T sum_of(const std::array<T, N>& a) noexcept {
  T even(0);
  T odd(0);
  for (std::size_t j = 0; j + 1 < N; j += 2) {
    even += a[j];
    odd += a[j + 1];
  }
  return N % 2 == 0 ? even + odd : even + odd + a[N - 1];
}
template <std::floating_point T, std::size_t N>
[[nodiscard]] inline T sum_of(const std::array<T, N>& a, const std::array<T, N>& b) noexcept {
  T even(0);
  T odd(0);
  for (std::size_t j = 0; j + 1 < N; j += 2) {
    even += a[j] * b[j];
    odd += a[j + 1] * b[j + 1];
  }
  return N % 2 == 0 ? even + odd : even + odd + a[N - 1] * b[N - 1];
}

/// Coefficients 4^n / 2 (2n)! of sinh²(√x), from n = 1.
template <std::floating_point T>
struct squared_sine_series {
  static constexpr int terms = std::numeric_limits<T>::digits > 53 ? 15 : 12;
  static constexpr auto coefficient = [] {
    std::array<T, static_cast<std::size_t>(terms)> c{};
    long double term = 1;
    for (int n = 2; n <= terms + 1; ++n) {
      c[static_cast<std::size_t>(n - 2)] = static_cast<T>(term);
      term *= 4.0L / static_cast<long double>((2 * n - 1) * (2 * n));
    }
    return c;
  }();
  template <int n = 0>
  [[nodiscard]] static constexpr T from(const T& x) noexcept {
    if constexpr (n == terms - 1) {
      return coefficient[static_cast<std::size_t>(n)];
    } else {
      return coefficient[static_cast<std::size_t>(n)] + x * from<n + 1>(x);
    }
  }
};

/// sinh²(√z) for z > 0 and −sin²(√−z) for z < 0 at z × square[j].
template <std::floating_point T, std::size_t N>
inline void squared_sines(const T& z, const std::array<T, N>& square, std::array<T, N>& result) noexcept {
  T scale = z * T(0.0625);
  int doublings = 0;
  while (scale > T(1) && doublings < 16) {
    scale *= T(0.25);
    ++doublings;
  }
  for (std::size_t j = 0; j < N; ++j) {
    const T x = scale * square[j];
    const T quarter = x * squared_sine_series<T>::from(x);
    const T half = T(4) * quarter * (T(1) + quarter);
    result[j] = T(4) * half * (T(1) + half);
  }
  for (int d = 0; d < doublings; ++d) {
    for (std::size_t j = 0; j < N; ++j) {
      result[j] = T(4) * result[j] * (T(1) + result[j]);
    }
  }
}

/// −sin² at the nodes of a rule that is Gauss's in u, from 0 to the angle m = s sinh u, and its weights.
template <int N, std::floating_point T>
inline void stretched_sines(const T& m, const T& s, std::array<T, static_cast<std::size_t>(N)>& q,
                            std::array<T, static_cast<std::size_t>(N)>& weight) noexcept {
  using std::asinh;
  using std::sqrt;
  const auto& rule = gauss<T, N>;
  const T u = asinh(m / s);
  squared_sines(u * u, rule.square, q);
  const T front = s * u / m;
  const T square = s * s / (m * m);
  std::array<T, static_cast<std::size_t>(N)> shares;
  for (std::size_t j = 0; j < static_cast<std::size_t>(N); ++j) {
    weight[j] = rule.weight[j] * front * sqrt(T(1) + q[j]);
    shares[j] = square * q[j];
  }
  squared_sines(-m * m, shares, q);
}

/// Calls visit(fraction, weight) at the nodes of a rule along a profile, for 1 + 2kz = p exp(−ix) from x = `from` over
/// `span`: Gauss's rule, unless its branch points 2πm ± i ln p at the necks slow it down. Then a rule for each piece
/// between two bulges, x = 2πm + |ln p| sinh u, that is Gauss's in u.
template <int N, std::floating_point T, class Visit>
inline void visit_nodes(const T& p, const T& from, const T& span, const Visit& visit) noexcept {
  using std::asinh;
  using std::cosh;
  using std::floor;
  using std::log;
  using std::sinh;
  using std::sqrt;
  constexpr T round = T(2) * pi<T>;
  const auto& rule = gauss<T, N>;
  const T end = from + span;
  const T depth = larger(std::abs(log(p)), T(1e-9));
  const auto distance = [&](const T& x) { return sqrt(x * x + depth * depth); };
  T neck = round * floor(from / round);
  T nearest = distance(from - neck) + distance(end - neck);
  for (T next = neck + round; next < end + round; next += round) {
    nearest = smaller(nearest, distance(from - next) + distance(end - next));
  }
  const bool plain = nearest > T(1.45) * span;
  for (T a = from; a < end;) {
    neck = round * floor(a / round + T(0.5));
    const T b = plain ? end : smaller(end, neck + pi<T> > a ? neck + pi<T> : neck + round + pi<T>);
    const T u = plain ? a : asinh((a - neck) / depth);
    const T half = T(0.5) * ((plain ? b : asinh((b - neck) / depth)) - u);
    for (std::size_t j = 0; j < static_cast<std::size_t>(N); ++j) {
      for (int mirror = 0; mirror < 2; ++mirror) {
        const T v = u + half * (mirror == 0 ? T(1) - rule.node[j] : T(1) + rule.node[j]);
        const T x = plain ? v : neck + depth * sinh(v);
        visit((x - from) / span, half * rule.weight[j] / span * (plain ? T(1) : depth * cosh(v)));
      }
    }
    a = b;
  }
}

/// How the unknowns are counted. Unknowns: k, then `extent`, then w of each contact circle.
enum class chart : unsigned char {
  from_extremum,  ///< extent is the radius of the neck, real or virtual, from which both sides are measured
  from_contact    ///< extent is the arc length from the first circle: to the mirror plane if equal, else to the second
};

/// The unknowns of a profile.
template <std::floating_point T>
struct profile {
  T k;
  T extent;
  std::array<T, 2> w;
  chart by;
};

/// What the equations of a profile are at a point, and their derivatives by (scale × k, ln extent, ln w1, ln w2).
/// Rows: the contact condition of the first circle, the gap, the volume, the contact condition of the second. Gap,
/// volume and λ are in units of the scale.
template <std::floating_point T>
struct sample {
  T scale;
  T match[2];
  T gap;
  T volume;
  T lambda;
  T by[4][4];  ///< rows as above
  T lambda_by[4];
  T turn[2];    ///< the sign of ∂λ/∂δ at each circle, k constant, and where × cosine < 0 the circle slides
  T cosine[2];  ///< of δ + θ; both are over the signed p where a mirror plane gives them so (see mirrored)
  T modulus;    ///< p, negative on the side of a bulge
  T span;       ///< |2k| × arc length
  bool sound;   ///< false: no such profile
};

inline constexpr int match_row = 0;
inline constexpr int gap_row = 1;
inline constexpr int volume_row = 2;
inline constexpr int second_match_row = 3;

/// Of the two sides of a bridge seen from its neck, one: x, the distance to the circle, and the volume.
template <int N, std::floating_point T>
[[nodiscard]] inline bool add_side(sample<T>& s, const wetted_surface<T>& on, const T& a, const T& p, const T& per_p,
                                   const T& root_p, const T& inverse, const T& w, int side) noexcept {
  using std::asinh;
  using std::atan;
  using std::log;
  using std::sqrt;
  const contact_circle<T> at(on, w);
  const T rho = at.radius * inverse;
  const T g = at.sine;
  const T c = at.cosine;
  const T base = T(1) + a + a * rho * g;
  if (!(base > T(0.02) * p)) {
    return false;
  }
  // t = tan(ks)/k, σ = sin(ks)/k, both over r0
  const T per_base = T(1) / base;
  const T t = rho * c * per_base;
  const T t_a = -t * (T(1) + rho * g) * per_base;
  const T t_rho = (c - t * a * g) * per_base;
  const T t_beta = -rho * (g + t * a * c) * per_base;
  const T square = T(1) + a * a * t * t;
  const T secant = sqrt(square);
  const T cosine = T(1) / secant;
  const T sine = t * cosine;
  const auto& rule = gauss<T, N>;
  std::array<T, static_cast<std::size_t>(N)> q;
  T x;
  T x_a;
  T x_m;
  T v;
  T v_a;
  T v_m;
  T m_t;
  T m_a;
  const T ends = p * sine * sine;  // (r/r0)² − 1 at the circle
  const bool hyperbolic = a < T(2) && std::abs(a * sine) < T(0.55);
  T x0(0);
  T x1(0);
  T v0(0);
  T v1(0);
  if (hyperbolic) {
    // r = r0 cosh m
    const T y = root_p * sine;
    const T cosh_m = sqrt(T(1) + ends);
    const T m = y > T(0.5) ? log(y + cosh_m) : asinh(y);
    const T per_cosh = T(1) / cosh_m;
    const T per_root = root_p * per_p;
    const T cube = cosine * cosine * cosine;
    m_t = root_p * cube * per_cosh;
    m_a = (sine * per_root - root_p * a * t * t * t * cube) * per_cosh;
    const T ratio = a * a * per_p;
    const T half_ratio_a = a * (T(1) + a) * per_p * per_p;
    squared_sines(m * m, rule.square, q);
    std::array<T, static_cast<std::size_t>(N)> value;
    std::array<T, static_cast<std::size_t>(N)> slope;
    for (std::size_t j = 0; j < static_cast<std::size_t>(N); ++j) {
      const T inner = inverse_root(T(1) - ratio * q[j]);
      const T f = rule.weight[j] * inner;
      value[j] = (T(1) - a * q[j]) * f;
      slope[j] = q[j] * (half_ratio_a * value[j] * (inner * inner) - f);
    }
    x0 = sum_of(value);
    x1 = sum_of(slope);
    v0 = sum_of(value, q);
    v1 = sum_of(slope, q);
    const T front = m * per_root;
    x = front * x0;
    x_a = front * (x1 - x0 * per_p);
    v = pi<T> * front * (x0 + v0);
    v_a = pi<T> * front * (x1 + v1 - (x0 + v0) * per_p);
    x_m = (T(1) - a * ends) * per_root * secant;
    v_m = pi<T> * (T(1) + ends) * x_m;
  } else {
    // the angle m = ks, stretched as m = s sinh u where the branch points ± i s of r would slow the rule down
    const T m = atan(a * t);
    m_t = a * cosine * cosine;
    m_a = t * cosine * cosine;
    const T per_a = T(1) / a;
    const T ratio = -p * per_a * per_a;
    const T rate = T(-2) * (T(1) + a) * per_a * per_p;
    std::array<T, static_cast<std::size_t>(N)> weight = rule.weight;
    if (a < T(6) && std::abs(a * sine) > T(0.5)) {
      stretched_sines<N>(m, asinh(std::abs(a) / root_p), q, weight);
    } else {
      squared_sines(-m * m, rule.square, q);
    }
    std::array<T, static_cast<std::size_t>(N)> value;
    std::array<T, static_cast<std::size_t>(N)> slope;
    std::array<T, static_cast<std::size_t>(N)> slope_of_volume;
    for (std::size_t j = 0; j < static_cast<std::size_t>(N); ++j) {
      const T e = ratio * q[j];  // (r/r0)² − 1
      const T e_a = rate * e;
      const T size = T(1) + e;
      const T inner = inverse_root(size);
      const T f = weight[j] * inner;
      const T n = T(1) - a * e;
      const T n_a = -e - a * e_a;
      const T half = T(0.5) * n * e_a;
      q[j] = size;
      value[j] = n * f;
      slope[j] = (n_a - half * (inner * inner)) * f;
      slope_of_volume[j] = (n_a * size + half) * f;
    }
    x0 = sum_of(value);
    x1 = sum_of(slope);
    v0 = sum_of(value, q);
    v1 = sum_of(slope_of_volume);
    const T front = m * per_a;
    x = front * x0;
    x_a = front * (x1 - x0 * per_a);
    v = pi<T> * front * v0;
    v_a = pi<T> * front * (v1 - v0 * per_a);
    x_m = (T(1) - a * ends) * per_a / sqrt(T(1) + ends);
    v_m = pi<T> * (T(1) + ends) * x_m;
  }
  const T reach_a = m_t * t_a + m_a;  // of m, along (a, ln r0 at constant k, ln w)
  const T reach_rho = m_t * t_rho;
  const T reach_l = a * reach_a - rho * reach_rho;
  const T rho_w = rho * at.cap_cosine;
  const T reach_w = reach_rho * rho_w + m_t * t_beta * at.cap_sine;
  const T height = at.height * inverse;
  const T rise = height * (T(1) + at.cap_cosine);
  const T slide = g + T(2) * a * rho;
  const T turn = slide * at.cap_cosine + c * at.cap_sine;
  const int row = side == 0 ? match_row : second_match_row;
  const int own = 2 + side;
  s.match[side] = rho * g + a * rho * rho - T(1) - a;
  s.by[row][0] = rho * rho - T(1);
  s.by[row][1] = a * (rho * rho - T(1)) - rho * slide;
  s.by[row][own] = rho * turn;
  s.by[row][5 - own] = T(0);
  s.gap += x - height;
  s.by[gap_row][0] += x_a + x_m * reach_a;
  s.by[gap_row][1] += x + a * x_a + x_m * reach_l;
  s.by[gap_row][own] = x_m * reach_w - rise;
  s.volume += v - at.cap * inverse * inverse * inverse;
  s.by[volume_row][0] += v_a + v_m * reach_a;
  s.by[volume_row][1] += T(3) * v + a * v_a + v_m * reach_l;
  s.by[volume_row][own] = v_m * reach_w - pi<T> * rho * rho * rise;
  s.turn[side] = turn;
  s.cosine[side] = c;
  return true;
}

template <int N, bool Equal, std::floating_point T>
[[nodiscard]] inline sample<T> sample_from_extremum(const surface_pair<T>& pair, const profile<T>& u) noexcept {
  using std::sqrt;
  sample<T> s;
  const T a = u.k * u.extent;
  const T p = T(1) + T(2) * a;
  s.sound = p > T(0.04) && u.extent > T(0);
  if (!s.sound) {
    return s;
  }
  s.scale = u.extent;
  s.modulus = p;
  s.span = T(0);
  s.gap = s.volume = T(0);
  s.by[gap_row][0] = s.by[gap_row][1] = s.by[volume_row][0] = s.by[volume_row][1] = T(0);
  s.lambda = T(1) + a;
  s.lambda_by[0] = T(1);
  s.lambda_by[1] = p;
  s.lambda_by[2] = s.lambda_by[3] = T(0);
  const T root_p = sqrt(p);
  const T per_p = T(1) / p;
  const T inverse = T(1) / u.extent;
  s.sound = add_side<N>(s, pair.side[0], a, p, per_p, root_p, inverse, u.w[0], 0);
  if constexpr (Equal) {
    s.gap *= T(2);
    s.volume *= T(2);
    for (int row = gap_row; row <= volume_row; ++row) {
      for (int column = 0; column < 3; ++column) {
        s.by[row][column] *= T(2);
      }
    }
    s.turn[1] = s.turn[0];
    s.cosine[1] = s.cosine[0];
  } else {
    s.sound = s.sound && add_side<N>(s, pair.side[1], a, p, per_p, root_p, inverse, u.w[1], 1);
  }
  return s;
}

/// A point of the complex plane with as much arithmetic as a profile needs.
template <std::floating_point T>
struct complex_point {
  T re;
  T im;
  [[nodiscard]] friend complex_point operator*(const complex_point& a, const complex_point& b) noexcept {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  [[nodiscard]] friend complex_point operator+(const complex_point& a, const complex_point& b) noexcept {
    return {a.re + b.re, a.im + b.im};
  }
  [[nodiscard]] friend complex_point operator*(const complex_point& a, const T& b) noexcept {
    return {a.re * b, a.im * b};
  }
  [[nodiscard]] complex_point turned() const noexcept { return {-im, re}; }  ///< × i
};

/// z at a contact circle and its derivative by ln w; `side` 0: the profile leaves the circle, 1: it arrives.
template <std::floating_point T>
struct circle_point {
  complex_point<T> z;
  complex_point<T> z_w;
  circle_point(const contact_circle<T>& at, int side) noexcept {
    const T c = side == 0 ? -at.cosine : at.cosine;
    const T g = at.sine;
    z = {at.radius * g, at.radius * c};
    // d(g ± ic)/dδ = ±c̃ …: the direction turns by −i at the second circle and by +i at the first
    const T sign = side == 0 ? T(1) : T(-1);
    z_w = {at.radius * (at.cap_cosine * g - sign * at.cap_sine * c),
           at.radius * (at.cap_cosine * c + sign * at.cap_sine * g)};
  }
};

/// Turn, cosine and span of a profile of length `extent` from the circle to its mirror plane. There 1 + 2kz is ±p, and
/// both are ∝ ±p, which next to a cylinder leaves of them no digit: they are taken without it.
template <std::floating_point T>
inline void mirrored(sample<T>& s, const contact_circle<T>& at, const profile<T>& u) noexcept {
  const T x = T(-2) * u.k * u.extent;
  const T sine = std::sin(x);
  s.span = T(2) * x;
  s.cosine[0] = s.cosine[1] = sine;
  s.turn[0] = s.turn[1] =
      (at.sine * std::cos(x) - at.cosine * sine) * at.cap_cosine - at.cap_sine * sine / (T(2) * u.k * at.radius);
}

template <int N, bool Equal, std::floating_point T>
[[nodiscard]] inline sample<T> sample_from_contact(const surface_pair<T>& pair, const profile<T>& u) noexcept {
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  sample<T> s;
  const T k = u.k;
  s.sound = u.extent > T(0) && u.w[0] > T(0) && u.w[1] > T(0) && k < T(0) && -k * u.extent < (Equal ? T(3.2) : T(6.4));
  if (!s.sound) {
    return s;
  }
  const contact_circle<T> first(pair.side[0], u.w[0]);
  const circle_point<T> start(first, 0);
  const T scale = first.radius;
  const T inverse = T(1) / scale;
  const T length = u.extent;
  const T per_k = T(1) / k;
  const complex_point<T> front{T(1) + T(2) * k * start.z.re, T(2) * k * start.z.im};
  s.scale = scale;
  struct walk {
    complex_point<T> z, z_k, z_l, z_w;
  };
  const auto at = [&](const T& fraction) {
    const T arc = fraction * length;
    const T angle = k * arc;
    const complex_point<T> half{cos(angle), sin(angle)};
    const complex_point<T> full = half * half;
    walk to;
    const complex_point<T> step = half.turned() * (half.im * per_k);
    to.z = full * start.z + step;
    to.z_k = (full * start.z).turned() * (T(2) * arc) + (full.turned() * arc + step * T(-1)) * per_k;
    to.z_l = (full * front).turned() * arc;  // by ln L
    to.z_w = full * start.z_w;
    return to;
  };
  T x(0);
  T v(0);
  T x_by[3]{};
  T v_by[3]{};
  s.modulus = sqrt(front.re * front.re + front.im * front.im);
  visit_nodes<N>(s.modulus, -atan2(front.im, front.re), T(-2) * k * length, [&](const T& fraction, const T& weight) {
    const walk to = at(fraction);
    const T square = to.z.re * to.z.re + to.z.im * to.z.im;
    const T r = sqrt(square);
    const T per_r = T(1) / r;
    const T cosine = to.z.re * per_r;
    x += weight * cosine;
    v += weight * r * to.z.re;
    const complex_point<T> rates[3] = {to.z_k, to.z_l, to.z_w};
    for (int i = 0; i < 3; ++i) {
      const T r_i = (to.z.re * rates[i].re + to.z.im * rates[i].im) * per_r;
      x_by[i] += weight * (rates[i].re - cosine * r_i) * per_r;
      v_by[i] += weight * (r * rates[i].re + to.z.re * r_i);
    }
  });
  const T both = Equal ? T(2) : T(1);
  const T per_length = both * length * inverse;
  const T per_volume = both * pi<T> * length * inverse * inverse * inverse;
  const T rise = first.height * inverse * (T(1) + first.cap_cosine);
  s.gap = per_length * x - both * first.height * inverse;
  s.volume = per_volume * v - both * first.cap * inverse * inverse * inverse;
  s.by[gap_row][0] = per_length * x_by[0] * inverse;
  s.by[gap_row][1] = per_length * (x + x_by[1]);
  s.by[gap_row][2] = per_length * x_by[2] - both * rise;
  s.by[volume_row][0] = per_volume * v_by[0] * inverse;
  s.by[volume_row][1] = per_volume * (v + v_by[1]);
  s.by[volume_row][2] = per_volume * v_by[2] - both * pi<T> * rise;
  const walk end = at(T(1));
  if constexpr (Equal) {
    mirrored(s, first, u);
    s.match[0] = end.z.im * inverse;
    s.by[match_row][0] = end.z_k.im * inverse * inverse;
    s.by[match_row][1] = end.z_l.im * inverse;
    s.by[match_row][2] = end.z_w.im * inverse;
  } else {
    const contact_circle<T> second(pair.side[1], u.w[1]);
    const circle_point<T> target(second, 1);
    s.match[0] = (end.z.re - target.z.re) * inverse;
    s.match[1] = (end.z.im - target.z.im) * inverse;
    const complex_point<T> columns[4] = {end.z_k * inverse, end.z_l, end.z_w, target.z_w * T(-1)};
    for (int column = 0; column < 4; ++column) {
      s.by[match_row][column] = columns[column].re * inverse;
      s.by[second_match_row][column] = columns[column].im * inverse;
    }
    const T second_rise = second.height * inverse * (T(1) + second.cap_cosine);
    const T ratio = second.radius * inverse;
    s.gap -= second.height * inverse;
    s.volume -= second.cap * inverse * inverse * inverse;
    s.by[gap_row][3] = -second_rise;
    s.by[volume_row][3] = -pi<T> * ratio * ratio * second_rise;
    s.turn[0] = first.turn(k);
    s.turn[1] = second.turn(k);
    s.cosine[0] = first.cosine;
    s.cosine[1] = second.cosine;
    s.span = T(-2) * k * length;
  }
  const T size = start.z.re * start.z.re + start.z.im * start.z.im;
  s.lambda = (start.z.re + k * size) * inverse;
  s.lambda_by[0] = size * inverse * inverse;
  s.lambda_by[1] = T(0);
  s.lambda_by[2] = (front.re * start.z_w.re + front.im * start.z_w.im) * inverse;
  s.lambda_by[3] = T(0);
  return s;
}

template <int N, bool Equal, std::floating_point T>
[[nodiscard]] inline sample<T> sample_of(const surface_pair<T>& pair, const profile<T>& u) noexcept {
  return u.by == chart::from_extremum ? sample_from_extremum<N, Equal>(pair, u)
                                      : sample_from_contact<N, Equal>(pair, u);
}

/// Area between liquid and gas.
template <int N, std::floating_point T>
[[nodiscard]] inline T profile_area(const surface_pair<T>& pair, const profile<T>& u) noexcept {
  using std::asinh;
  using std::atan;
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const auto& rule = gauss<T, N>;
  T area(0);
  if (u.by == chart::from_contact) {
    const contact_circle<T> first(pair.side[0], u.w[0]);
    const circle_point<T> start(first, 0);
    const complex_point<T> front{T(1) + T(2) * u.k * start.z.re, T(2) * u.k * start.z.im};
    visit_nodes<N>(sqrt(front.re * front.re + front.im * front.im), -atan2(front.im, front.re), T(-2) * u.k * u.extent,
                   [&](const T& fraction, const T& weight) {
                     const T angle = u.k * u.extent * fraction;
                     const complex_point<T> half{cos(angle), sin(angle)};
                     const complex_point<T> z = half * half * start.z + half.turned() * (half.im / u.k);
                     area += weight * sqrt(z.re * z.re + z.im * z.im);
                   });
    return T(2) * pi<T> * u.extent * area * (pair.equal ? T(2) : T(1));
  }
  const T a = u.k * u.extent;
  const T p = T(1) + T(2) * a;
  const T root_p = sqrt(p);
  std::array<T, static_cast<std::size_t>(N)> q;
  for (std::size_t i = 0; i < (pair.equal ? 1U : 2U); ++i) {
    const contact_circle<T> at(pair.side[i], u.w[i]);
    const T rho = at.radius / u.extent;
    const T t = rho * at.cosine / (T(1) + a + a * rho * at.sine);
    const T sine = t / sqrt(T(1) + a * a * t * t);
    T sum(0);
    if (a < T(2) && std::abs(a * sine) < T(0.55)) {
      const T m = asinh(root_p * sine);
      squared_sines(m * m, rule.square, q);
      for (std::size_t j = 0; j < q.size(); ++j) {
        sum += rule.weight[j] * (T(1) + q[j]) / sqrt(T(1) - a * a / p * q[j]);
      }
      area += sum * m / root_p;
    } else {
      const T m = atan(a * t);
      std::array<T, static_cast<std::size_t>(N)> weight;
      stretched_sines<N>(m, asinh(std::abs(a) / root_p), q, weight);
      for (std::size_t j = 0; j < q.size(); ++j) {
        sum += weight[j] * sqrt(T(1) - p / (a * a) * q[j]);
      }
      area += sum * m / a;
    }
  }
  return T(2) * pi<T> * u.extent * u.extent * area * (pair.equal ? T(2) : T(1));
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
