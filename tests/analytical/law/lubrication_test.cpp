// SPDX-License-Identifier: BSD-3-Clause
// Closed forms: the singular parts of Jeffrey & Onishi 1984 put together by hand,
// and exact solutions of thinning films.

#include "tetrapore/law/lubrication.hpp"

#include "support/pairs.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace tetrapore;

namespace {

constexpr double half_turn = std::numbers::pi;
constexpr vec3<double> up{0, 0, 1};

/// Order of convergence from the errors of two steps, one half of the other.
double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

/// Thickness after `steps` steps to the time `end` under a gap that may change.
template <class Gap>
double stepped(const elastic_film<double>& film, double u, double end, int steps, const film_scheme& scheme,
               const Gap& gap) {
  for (int k = 0; k < steps; ++k) {
    const double t = end * k / steps;
    const auto answer = step_film(film, u, gap(t), gap(end * (k + 1) / steps), end / steps, scheme);
    REQUIRE(answer.ok());
    u = answer.value;
  }
  return u;
}

const std::vector<film_scheme>& first_order() {
  static const std::vector<film_scheme> all{{film_variable::thickness, 1}, {film_variable::logarithm, 1}};
  return all;
}
const std::vector<film_scheme>& second_order() {
  static const std::vector<film_scheme> all{{film_variable::thickness, 0.5}, {film_variable::logarithm, 0.5}};
  return all;
}

}  // namespace

TEST_CASE("the leading order has the singular parts of Jeffrey & Onishi for every radius ratio") {
  // difference of two gaps, so that bounded parts drop out: factors of ln(1/ξ)
  for (const double lambda : {1.0, 0.7, 0.5, 0.2, 0.1, 1e-2, 1e-3}) {
    const leading_order law{.viscosity = 1};
    const double h = 1e-12 * lambda;
    const auto near = law.resistance(edge<double>{1, lambda, h, -up}).value;
    const auto far = law.resistance(edge<double>{1, lambda, h * std::exp(1.0), -up}).value;
    const double k = 1 + lambda;
    CHECK(near.squeeze * h == doctest::Approx(6 * half_turn * std::pow(lambda / k, 2)).epsilon(1e-13));
    // grain 1 above moves along x or turns about y; the arms of contact
    const auto change = [&](const pair_motion<double>& m, auto part) {
      return part(apply(near, m)) - part(apply(far, m));
    };
    const auto force1 = [](const pair_forces<double>& f) { return -f.force1.x; };
    const auto torque1 = [](const pair_forces<double>& f) { return -f.torque1.y; };
    const auto torque2 = [](const pair_forces<double>& f) { return -f.torque2.y; };
    const pair_motion<double> slide{{1, 0, 0}, {}, {}, {}};
    const pair_motion<double> turn{{}, {0, 1, 0}, {}, {}};
    const pair_motion<double> other{{}, {}, {}, {0, 1, 0}};
    const double ya = 4 * lambda * (2 + lambda + 2 * lambda * lambda) / (15 * k * k * k);
    const double yb = -lambda * (4 + lambda) / (5 * k * k);
    const double yc = 2 * lambda / (5 * k);
    const double yc12 = 4 * lambda * lambda / (5 * k * k * k * k);
    CHECK(change(slide, force1) == doctest::Approx(6 * half_turn * ya).epsilon(1e-9));
    CHECK(change(slide, torque1) == doctest::Approx(4 * half_turn * yb).epsilon(1e-9));
    CHECK(change(turn, force1) == doctest::Approx(4 * half_turn * yb).epsilon(1e-9));
    CHECK(change(turn, torque1) == doctest::Approx(8 * half_turn * yc).epsilon(1e-9));
    CHECK(change(other, torque1) == doctest::Approx(half_turn * k * k * k * yc12).epsilon(1e-9));
    CHECK(change(turn, torque2) == doctest::Approx(half_turn * k * k * k * yc12).epsilon(1e-9));
  }
}

TEST_CASE("leading order: shear × roll − coupling² is (πΛ)² (48/5) a*⁴ for any radii") {
  for (const double lambda : {1.0, 0.5, 0.1, 1e-3, 1e3}) {
    const auto r = leading_order{.viscosity = 1}.resistance(edge<double>{1, lambda, 1e-3, up}).value;
    const double star = lambda / (1 + lambda);
    const double log = half_turn * leading_order::logarithm(4 * star / 1e-3, 1e-3 / (4 * star));
    CHECK(r.shear * r.roll - r.coupling * r.coupling ==
          doctest::Approx(log * log * 9.6 * std::pow(star, 4)).epsilon(1e-12));
  }
}

TEST_CASE("a grain a million times as large is a plane") {
  const leading_order law{.viscosity = 1};
  const double inf = std::numeric_limits<double>::infinity();
  for (const double h : {1e-6, 1e-3, 0.1}) {
    const auto wall = law.resistance(edge<double>{1, inf, h, up}).value;
    const auto large = law.resistance(edge<double>{1, 1e9, h, up}).value;
    CHECK(large.squeeze == doctest::Approx(wall.squeeze).epsilon(1e-8));
    CHECK(large.shear == doctest::Approx(wall.shear).epsilon(1e-8));
    CHECK(large.coupling == doctest::Approx(wall.coupling).epsilon(1e-8));
    CHECK(large.roll == doctest::Approx(wall.roll).epsilon(1e-8));
    CHECK(wall.squeeze == doctest::Approx(6 * half_turn / h).epsilon(1e-15));
    CHECK(wall.arm2 == h / 2);
  }
}

TEST_CASE("a film under a constant gap follows the logistic curve, each scheme to its order") {
  const elastic_film<double> film{2, 3};  // ν, k
  for (const double gap : {0.5, -0.4, 0.0}) {
    const double u0 = 0.2;
    const double end = 1.3;
    const double exact =
        gap == 0 ? u0 / (1 + 3 * u0 * end / 2) : gap / (1 + (gap / u0 - 1) * std::exp(-3 * gap * end / 2));
    const auto held = [gap](double) { return gap; };
    for (const film_scheme& s : first_order()) {
      const double coarse = stepped(film, u0, end, 500, s, held) - exact;
      const double fine = stepped(film, u0, end, 1000, s, held) - exact;
      CHECK(order(coarse, fine) == doctest::Approx(1).epsilon(0.02));
      CHECK(std::abs(fine) < 1e-3);
    }
    for (const film_scheme& s : second_order()) {
      const double coarse = stepped(film, u0, end, 200, s, held) - exact;
      const double fine = stepped(film, u0, end, 400, s, held) - exact;
      CHECK(order(coarse, fine) == doctest::Approx(2).epsilon(0.02));
      CHECK(std::abs(fine) < 1e-5);
    }
  }
}

TEST_CASE("under a gap that changes in time the schemes keep their order") {
  const elastic_film<double> film{2, 3};
  const auto gap = [](double t) { return 0.3 * std::cos(5 * t) - 0.1; };
  const double exact = stepped(film, 0.2, 1, 200000, {film_variable::logarithm, 0.5}, gap);
  for (const film_scheme& s : first_order()) {
    CHECK(order(stepped(film, 0.2, 1, 400, s, gap) - exact, stepped(film, 0.2, 1, 800, s, gap) - exact) ==
          doctest::Approx(1).epsilon(0.03));
  }
  for (const film_scheme& s : second_order()) {
    CHECK(order(stepped(film, 0.2, 1, 200, s, gap) - exact, stepped(film, 0.2, 1, 400, s, gap) - exact) ==
          doctest::Approx(2).epsilon(0.03));
  }
}

TEST_CASE("asperities beside the film: a film squeezed for long rests where springs and asperities balance") {
  const elastic_film<double> film{1, 2, 0.3, 5};
  // 2 u (g − u) + 5 · 0.3 (0.3 − u) = 0
  const double b = (2 * 0.1 + 5 * 0.3) / 2;
  const double rest = (-b + std::sqrt(b * b + 4 * 5 * 0.09 / 2)) / 2;
  for (const film_scheme& s : {film_scheme{}, film_scheme{film_variable::logarithm, 1}}) {
    double u = 1;
    for (int k = 0; k < 200; ++k) {
      u = step_film(film, u, -0.1, -0.1, 1.0, s).value;
    }
    CHECK(u == doctest::Approx(rest).epsilon(1e-12));
    CHECK(step_film(film, 1.0, -0.1, -0.1, 1e9, s).value == doctest::Approx(rest).epsilon(1e-8));
  }
  // above the asperities they are not felt
  CHECK(step_film(film, 1.0, 0.9, 0.9, 0.1).value == step_film(elastic_film<double>{1, 2}, 1.0, 0.9, 0.9, 0.1).value);
}

TEST_CASE("a constant force thins the film exponentially, exactly in its logarithm") {
  // a film without inertia under a force: the elastic film in the limit of a soft, far spring
  const double force = -1.7;
  const double nu = 0.8;
  const double soft = 1e-9;
  const elastic_film<double> film{nu, soft};
  const double gap = force / soft;
  double u = 0.5;
  for (int k = 0; k < 10; ++k) {
    u = step_film(film, u, gap, gap, 0.7, {film_variable::logarithm, 1}).value;
  }
  CHECK(u == doctest::Approx(0.5 * std::exp(force * 7 / nu)).epsilon(1e-7));
}

TEST_CASE("a free approach keeps m v + ν ln h to rounding, and never touches") {
  const double m = 0.7;
  const double nu = 1.3;
  for (const double dt : {1e-6, 1e-3, 1.0, 1e3, 1e9}) {
    approach<double> at{0.4, -5};
    const double kept = m * at.rate + nu * std::log(at.gap);
    for (int k = 0; k < 300; ++k) {
      const auto next = step_approach(at, m, nu, 0.0, dt);
      REQUIRE(next.ok());
      at = next.value;
      CHECK(at.gap > 0);
      CHECK(std::abs(m * at.rate + nu * std::log(at.gap) - kept) < 300 * 4e-16 * std::abs(kept));
    }
    CHECK(at.gap >= 0.4 * std::exp(-m * 5 / nu) * (1 - 1e-12));
  }
}

TEST_CASE("an approach with inertia under a force: both schemes converge in the first order to each other") {
  const auto run = [](film_variable variable, int steps) {
    approach<double> at{0.4, -2};
    for (int k = 0; k < steps; ++k) {
      at = step_approach(at, 0.7, 0.9, 0.8, 1.0 / steps, variable).value;
    }
    return at.gap;
  };
  const double exact = run(film_variable::logarithm, 400000);
  for (const film_variable v : {film_variable::thickness, film_variable::logarithm}) {
    CHECK(order(run(v, 1000) - exact, run(v, 2000) - exact) == doctest::Approx(1).epsilon(0.02));
  }
  // without inertia to speak of, h = h0 e^(Ft/ν), exactly in the logarithm
  approach<double> at{0.4, 0};
  for (int k = 0; k < 10; ++k) {
    at = step_approach(at, 1e-14, 0.9, -0.8, 0.5).value;
  }
  CHECK(at.gap == doctest::Approx(0.4 * std::exp(-0.8 * 5 / 0.9)).epsilon(1e-10));
}
