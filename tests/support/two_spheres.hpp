// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

/// \file
/// Two spheres in Stokes flow to ten digits, by the twin multipole series of Jeffrey & Onishi 1984, J. Fluid Mech. 139,
/// 261 (torque about the axis: Jeffery 1915, Proc. London Math. Soc. 14, 327): what the fits of law/lubrication are
/// made from and tested against. It shares nothing with them.

namespace two_spheres_truth {

using number = long double;
inline constexpr number pi = 3.141592653589793238462643383279502884L;

/// Coefficients of the twin multipoles of one kind of motion. They do not depend on the radii.
class multipoles {
 public:
  enum class motion { along, across, spin_across };

  multipoles(int order, motion kind) : order_(order) {
    const auto entries = static_cast<std::size_t>(order + 1) * static_cast<std::size_t>(order + 2) *
                         static_cast<std::size_t>(order + 3) / 6;
    p_.assign(entries, 0);
    v_.assign(entries, 0);
    q_.assign(kind == motion::along ? 0 : entries, 0);
    const int size = order + 2;
    binomial_.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j <= i; ++j) {
        binomial_[index2(i, j)] = j == 0 || j == i ? 1 : binomial_[index2(i - 1, j - 1)] + binomial_[index2(i - 1, j)];
      }
    }
    if (kind == motion::spin_across) {
      q_[0] = 1;
    } else {
      p_[0] = v_[0] = 1;
    }
    for (int k = 1; k <= order; ++k) {
      for (int q = 1; q <= k; ++q) {
        for (int n = 1; n <= k - q + 1; ++n) {
          kind == motion::along ? along(n, k - q, q) : across(n, k - q, q);
        }
      }
    }
  }

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] number p1(int p, int q) const { return at(p_, 1, p, q); }
  [[nodiscard]] number q1(int p, int q) const { return at(q_, 1, p, q); }

 private:
  [[nodiscard]] std::size_t index2(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(order_ + 2) + static_cast<std::size_t>(j);
  }
  [[nodiscard]] number choose(int i, int j) const { return binomial_[index2(i, j)]; }
  [[nodiscard]] static std::size_t place(int n, int p, int q) {
    const auto k = static_cast<std::size_t>(p + q);
    const auto row = static_cast<std::size_t>(p);
    return k * (k + 1) * (k + 2) / 6 + row * (row + 1) / 2 + static_cast<std::size_t>(n - 1);
  }
  [[nodiscard]] static number at(const std::vector<number>& of, int n, int p, int q) {
    return n < 1 || p < 0 || q < 0 || n > p + 1 ? 0 : of[place(n, p, q)];
  }

  void along(int n, int p, int q) {
    const number a = n;
    number sum = 0;
    number lower = 0;
    for (int s = 1; s <= q; ++s) {
      const number b = s;
      const number c = choose(n + s, n);
      const number below = at(p_, s, q - s, p - n - 1);
      sum += c * (a * (2 * a + 1) * (2 * a * b - a - b + 2) / (2 * (a + 1) * (2 * b - 1) * (a + b)) *
                      at(p_, s, q - s, p - n + 1) -
                  a * (2 * a - 1) / (2 * (a + 1)) * below -
                  a * (4 * a * a - 1) / (2 * (a + 1) * (2 * b + 1)) * at(v_, s, q - s - 2, p - n + 1));
      lower += c * below;
    }
    p_[place(n, p, q)] = sum;
    v_[place(n, p, q)] = sum - 2 * a / ((a + 1) * (2 * a + 3)) * lower;
  }

  void across(int n, int p, int q) {
    const number a = n;
    number sum = 0;
    number lower = 0;
    number turn = 0;
    for (int s = 1; s <= q; ++s) {
      const number b = s;
      const number c = choose(n + s, n + 1);
      const number below = at(p_, s, q - s, p - n - 1);
      sum += c * ((2 * a + 1) / (2 * (a + 1)) * (3 * (a + b) - (a * b + 1) * (2 * a * b - a - b + 2)) /
                      (b * (a + b) * (2 * b - 1)) * at(p_, s, q - s, p - n + 1) +
                  a * (2 * a - 1) / (2 * (a + 1)) * below +
                  a * (4 * a * a - 1) / (2 * (a + 1) * (2 * b + 1)) * at(v_, s, q - s - 2, p - n + 1) -
                  2 * (4 * a * a - 1) / (3 * (a + 1)) * at(q_, s, q - s - 1, p - n + 1));
      lower += c * below;
      turn += c * (b / (a + 1) * at(q_, s, q - s - 1, p - n) - 3 / (2 * a * b * (a + 1)) * at(p_, s, q - s, p - n));
    }
    p_[place(n, p, q)] = sum;
    v_[place(n, p, q)] = sum + 2 * a / ((a + 1) * (2 * a + 3)) * lower;
    q_[place(n, p, q)] = turn;
  }

  int order_;
  std::vector<number> p_, v_, q_, binomial_;
};

/// Σ c_m q^m over even or odd m, known to an order and continued by the singular functions of contact: 1/w, ln w, w ln
/// w, w² ln w with w = 1 − q² (odd m: q/w and w^k ln((1 − q)/(1 + q))). The first three factors are known; the fourth
/// is the mean of what is left of the last coefficients, which oscillates and falls as m⁻³. So the sum is good to about
/// 1/order³ at contact, and to all digits where the gap is above 30/order of the mean radius.
class continued_series {
 public:
  static constexpr std::size_t terms = 4;

  continued_series(std::vector<number> coefficients, bool odd, const std::array<number, 3>& factors)
      : odd_(odd), rest_(std::move(coefficients)), factor_{factors[0], factors[1], factors[2], 0} {
    std::array<number, 2> slower{};  // coefficients of ln w and w ln w before
    std::vector<number> fourth;
    for (std::size_t j = 0; j < rest_.size(); ++j) {
      const number log = odd ? -2 / static_cast<number>(2 * j + 1) : (j == 0 ? 0 : -1 / static_cast<number>(j));
      const number w_log = log - slower[0];
      rest_[j] -= factor_[0] + factor_[1] * log + factor_[2] * w_log;
      fourth.push_back(w_log - slower[1]);
      slower = {log, w_log};
    }
    number weights = 0;
    for (std::size_t j = rest_.size() / 3; j < rest_.size(); ++j) {  // a smooth window over the last two thirds
      const number place = (static_cast<number>(j) + 0.5L) / static_cast<number>(rest_.size());
      const number weight = (place - 1 / 3.0L) * (place - 1 / 3.0L) * (1 - place) * (1 - place);
      factor_[3] += weight * rest_[j] / fourth[j];
      weights += weight;
    }
    factor_[3] /= weights;
    for (std::size_t j = 0; j < rest_.size(); ++j) {
      rest_[j] -= factor_[3] * fourth[j];
    }
  }

  /// x: the gap over the sum of the radii; q = 1/(1 + x)
  [[nodiscard]] number operator()(number x) const {
    const number q = 1 / (1 + x);
    const number u = q * q;
    const number w = x * (2 + x) * u;
    number sum = 0;
    for (std::size_t j = rest_.size(); j-- > 0;) {
      sum = sum * u + rest_[j];
    }
    number power = odd_ ? std::log(x / (2 + x)) : std::log(w);
    number singular = factor_[0] * (odd_ ? q : 1) / w;
    for (std::size_t k = 1; k < terms; ++k) {
      singular += factor_[k] * power;
      power *= w;
    }
    return singular + sum * (odd_ ? q : 1);
  }

 private:
  bool odd_;
  std::vector<number> rest_;
  std::array<number, terms> factor_;
};

/// Resistance of the pair in Jeffrey & Onishi's normalisation.
struct functions {
  number xa11, xa12, xa22, xc11, xc12, xc22, ya11, ya12, ya22, yb11, yb12, yb21, yb22, yc11, yc12, yc22;
};

/// What is left when the rigid motions are free: the resistance between two spheres on which no other force or torque
/// acts. Units of μ = 1.
struct pair {
  number squeeze, shear, coupling, roll, twist;
};

[[nodiscard]] inline pair free_pair(number a1, number a2, number h, const functions& f) {
  const number d = a1 + a2;
  pair r{};
  {
    const number m11 = 6 * pi * a1 * f.xa11;
    const number m12 = 3 * pi * d * f.xa12;
    const number m22 = 6 * pi * a2 * f.xa22;
    r.squeeze = m22 - (m12 + m22) * (m12 + m22) / (m11 + 2 * m12 + m22);
  }
  {
    const number m11 = 8 * pi * a1 * a1 * a1 * f.xc11;
    const number m12 = pi * d * d * d * f.xc12;
    const number m22 = 8 * pi * a2 * a2 * a2 * f.xc22;
    r.twist = m22 - (m12 + m22) * (m12 + m22) / (m11 + 2 * m12 + m22);
  }
  const number b1 = a1 + h / 2;
  const number b2 = a2 + h / 2;
  using vector = std::array<number, 4>;
  std::array<vector, 4> m{};
  m[0] = {6 * pi * a1 * f.ya11, 3 * pi * d * f.ya12, 4 * pi * a1 * a1 * f.yb11, pi * d * d * f.yb21};
  m[1] = {m[0][1], 6 * pi * a2 * f.ya22, pi * d * d * f.yb12, 4 * pi * a2 * a2 * f.yb22};
  m[2] = {m[0][2], m[1][2], 8 * pi * a1 * a1 * a1 * f.yc11, pi * d * d * d * f.yc12};
  m[3] = {m[0][3], m[1][3], m[2][3], 8 * pi * a2 * a2 * a2 * f.yc22};
  const auto form = [&m](const vector& x, const vector& y) {
    number sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        sum += x[i] * m[i][j] * y[j];
      }
    }
    return sum;
  };
  // sphere 1 above: slip (V2 − V1) + b1 ω1 + b2 ω2, roll −(ω1 − ω2); the last two are the rigid motions
  const vector slip{0, 1, 0, 0};
  const vector roll{0, b1, -1, 0};
  const vector shift{1, 1, 0, 0};
  const vector turn{b1, -b2, 1, 1};
  const number k11 = form(shift, shift);
  const number k12 = form(shift, turn);
  const number k22 = form(turn, turn);
  const number det = k11 * k22 - k12 * k12;
  const auto free = [&](const vector& x, const vector& y) {
    const number x1 = form(shift, x), x2 = form(turn, x), y1 = form(shift, y), y2 = form(turn, y);
    return form(x, y) - (x1 * (k22 * y1 - k12 * y2) + x2 * (k11 * y2 - k12 * y1)) / det;
  };
  r.shear = free(slip, slip);
  r.coupling = free(slip, roll);
  r.roll = free(roll, roll);
  return r;
}

/// Torque about the axis, by images.
[[nodiscard]] inline std::array<number, 3> twist_functions(number a1, number a2, number h) {
  const number d = a1 + a2 + h;
  const auto height = [h, d](number a, number b) { return 2 * std::asinh(std::sqrt(h * (h + 2 * b) / (4 * d * a))); };
  const number alpha = height(a1, a2);
  const number beta = height(a2, a1);
  const number c1 = std::sinh(alpha);
  const number c2 = std::sinh(beta);
  const number c = a1 * c1;
  number t11 = 0, t22 = 0, t12 = 0;
  for (int m = 0;; ++m) {
    const auto cube = [](number x) { return x * x * x; };
    const number first = cube(c1 / std::sinh(static_cast<number>(m + 1) * alpha + static_cast<number>(m) * beta));
    const number second = cube(c2 / std::sinh(static_cast<number>(m + 1) * beta + static_cast<number>(m) * alpha));
    const number cross = cube(2 * c / (a1 + a2) / std::sinh(static_cast<number>(m + 1) * (alpha + beta)));
    t11 += first;
    t22 += second;
    t12 -= cross;
    if (first < 1e-19L * t11 / static_cast<number>(m + 1) && second < 1e-19L * t22 / static_cast<number>(m + 1)) {
      return {t11, t12, t22};
    }
  }
}

class series {
 public:
  explicit series(int order)
      : along_(order, multipoles::motion::along),
        across_(order, multipoles::motion::across),
        spin_(order, multipoles::motion::spin_across) {}

  /// The functions of one ratio λ = a2/a1, at any gap.
  class ratio {
   public:
    ratio(const series& of, number lambda) : lambda_(lambda), first_{make(of, lambda)}, second_{make(of, 1 / lambda)} {}

    [[nodiscard]] functions operator()(number h_over_a1) const {
      const number x = h_over_a1 / (1 + lambda_);
      const number l = 1 + lambda_;
      const number k = 1 + 1 / lambda_;
      const auto c = twist_functions(1, lambda_, h_over_a1);
      functions f{};
      f.xa11 = first_[0](x);
      f.xa12 = -2 / l * first_[1](x);
      f.xa22 = second_[0](x);
      f.ya11 = first_[2](x);
      f.ya12 = -2 / l * first_[3](x);
      f.ya22 = second_[2](x);
      f.yb11 = first_[4](x);
      f.yb12 = -4 / (l * l) * first_[5](x);
      f.yb22 = -second_[4](x);
      f.yb21 = 4 / (k * k) * second_[5](x);
      f.yc11 = first_[6](x);
      f.yc12 = 8 / (l * l * l) * first_[7](x);
      f.yc22 = second_[6](x);
      f.xc11 = c[0];
      f.xc12 = c[1];
      f.xc22 = c[2];
      return f;
    }

   private:
    static std::vector<number> coefficients(const multipoles& m, bool of_q, int parity, int shift, number lambda,
                                            number scale) {
      std::vector<number> c;
      for (int k = parity; k <= m.order(); k += 2) {
        number sum = 0;
        for (int q = k; q >= 0; --q) {
          sum = sum * lambda + (of_q ? m.q1(k - q, q) : m.p1(k - q, q));
        }
        c.push_back(scale * sum * std::pow(lambda, static_cast<number>(shift)) /
                    std::pow(1 + lambda, static_cast<number>(k)));
      }
      return c;
    }
    static std::array<continued_series, 8> make(const series& s, number x) {
      const number y = 1 + x;
      const number y2 = y * y;
      const number y3 = y2 * y;
      const number x2 = x * x;
      const number xa1 = 2 * x2 / y3;
      const number xa2 = x * (1 + 7 * x + x2) / (5 * y3);
      const number xa3 = (1 + 18 * x - 29 * x2 + 18 * x2 * x + x2 * x2) / (42 * y3);
      const number ya2 = 4 * x * (2 + x + 2 * x2) / (15 * y3);
      const number ya3 = 2 * (16 - 45 * x + 58 * x2 - 45 * x2 * x + 16 * x2 * x2) / (375 * y3);
      const number yb2 = -x * (4 + x) / (5 * y2);
      const number yb3 = -(32 - 33 * x + 83 * x2 + 43 * x2 * x) / (250 * y2);
      const number yc2 = 2 * x / (5 * y);
      const number yc3 = (8 + 6 * x + 33 * x2) / (125 * y);
      const number yc4 = 4 * x2 / (5 * y2 * y2) * y3 / 8;
      const number yc5 = 2 * x * (43 - 24 * x + 43 * x2) / (125 * y2 * y2) * y3 / 8;
      return {continued_series(coefficients(s.along_, false, 0, 0, x, 1), false, {xa1, -xa2, -xa3}),
              continued_series(coefficients(s.along_, false, 1, 0, x, 1), true, {xa1, -xa2, -xa3}),
              continued_series(coefficients(s.across_, false, 0, 0, x, 1), false, {0, -ya2, -ya3}),
              continued_series(coefficients(s.across_, false, 1, 0, x, 1), true, {0, -ya2, -ya3}),
              continued_series(coefficients(s.across_, true, 1, 0, x, 2), true, {0, -yb2, -yb3}),
              continued_series(coefficients(s.across_, true, 0, 0, x, 2), false, {0, -yb2, -yb3}),
              continued_series(coefficients(s.spin_, true, 0, 0, x, 1), false, {0, -yc2, -yc3}),
              continued_series(coefficients(s.spin_, true, 1, 1, x, 1), true, {0, -yc4, -yc5})};
    }

    number lambda_;
    std::array<continued_series, 8> first_, second_;
  };

 private:
  multipoles along_, across_, spin_;
};

}  // namespace two_spheres_truth
