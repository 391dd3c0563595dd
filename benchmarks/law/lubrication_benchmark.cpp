// SPDX-License-Identifier: BSD-3-Clause
//
// Lubrication of a pair, one row per law and scalar: time for the resistance, and for the forces and torques on both
// grains; `error`, the worst relative difference from the exact two-sphere table up to h/a = 0.1, of squeeze, shear,
// coupling, roll and twist of two spheres free in a liquid (leading order: of its squeeze up to 0.01; sphere and plane:
// of the squeeze); `failed`, hard cases that came out wrong: no answer where there is one, an answer where there is
// none. Pairs are distinct, in random order, of ratios 1 to 0.1.

#include "support/csv_table.hpp"
#include "support/pairs.hpp"
#include "support/two_spheres.hpp"
#include "tetrapore/law/contact.hpp"
#include "tetrapore/law/lubrication.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

namespace {

using namespace tetrapore;

constexpr std::size_t input_count = std::size_t{1} << 11;
constexpr double inf = std::numeric_limits<double>::infinity();

template <std::floating_point T>
struct inputs {
  std::vector<edge<T>> edges;
  std::vector<pair_motion<T>> motions;
};

template <class Law, std::floating_point T>
const inputs<T>& all() {
  static const inputs<T> made = [] {
    inputs<T> out;
    pairs::random_pairs random(13);
    const auto as = [](const vec3<double>& v) { return vec3<T>{T(v.x), T(v.y), T(v.z)}; };
    for (std::size_t k = 0; k < input_count; ++k) {
      edge<double> e = random.pair(9.9, 1e-4, 0.2);
      e.radius2 = std::is_same_v<Law, sphere_plane> ? inf : e.radius2;
      out.edges.push_back(pairs::as<T>(e));
      const pair_motion<double> m = random.motion(e.radius1);
      out.motions.push_back({as(m.velocity1), as(m.spin1), as(m.velocity2), as(m.spin2)});
    }
    return out;
  }();
  return made;
}

template <class Law>
double error() {
  double worst = 0;
  const Law law{.viscosity = 1.0};
  if constexpr (std::is_same_v<Law, sphere_plane>) {
    const csv_table table(TETRAPORE_TEST_DATA "/truth/open_sphere_plane_normal.csv");
    for (std::size_t k = 0; k < table.size() && table.number(k, "h_over_a") <= 0.1; ++k) {
      const auto r = law.resistance(edge<double>{1, inf, table.number(k, "h_over_a"), {0, 0, 1}}).value;
      worst = std::max(worst, std::abs(r.squeeze / (6 * pi<double> * table.number(k, "lambda_exact")) - 1));
    }
  } else {
    const csv_table table(TETRAPORE_TEST_DATA "/truth/open_lubrication.csv");
    for (std::size_t k = 0; k < table.size(); ++k) {
      const double lambda = table.number(k, "lambda");
      const double gap = table.number(k, "h_over_a1");
      if (gap > (std::is_same_v<Law, leading_order> ? 0.01 : 0.1)) {
        continue;
      }
      const auto at = [&](const char* name) { return table.precise(k, name); };
      const auto exact = two_spheres_truth::free_pair(
          1, static_cast<long double>(lambda), static_cast<long double>(gap),
          {at("XA11"), at("XA12"), at("XA22"), at("XC11"), at("XC12"), at("XC22"), at("YA11"), at("YA12"), at("YA22"),
           at("YB11"), at("YB12"), at("YB21"), at("YB22"), at("YC11"), at("YC12"), at("YC22")});
      const auto r = law.resistance(edge<double>{1, lambda, gap, {0, 0, 1}}).value;
      worst = std::max(worst, static_cast<double>(std::abs(r.squeeze / exact.squeeze - 1)));
      if constexpr (!std::is_same_v<Law, leading_order>) {
        const long double mixed = std::sqrt(exact.shear * exact.roll);
        worst = std::max({worst, static_cast<double>(std::abs(r.shear / exact.shear - 1)),
                          static_cast<double>(std::abs(r.coupling - exact.coupling) / mixed),
                          static_cast<double>(std::abs(r.roll / exact.roll - 1)),
                          static_cast<double>(std::abs(r.twist / exact.twist - 1))});
      }
    }
  }
  return worst;
}

template <class Law>
double failed_hard_cases() {
  const Law law{.viscosity = 1.0};
  const double other = std::is_same_v<Law, sphere_plane> ? inf : 0.5;
  double failed = 0;
  for (const double gap : {1e-300, 1e-12, 1e-6, 0.1}) {
    failed += law.resistance(edge<double>{1, other, gap, {0, 0, 1}}).ok() ? 0 : 1;
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const double gap : {0.0, -0.1, none, inf}) {
    failed += law.resistance(edge<double>{1, other, gap, {0, 0, 1}}).ok() ? 1 : 0;
  }
  for (const double radius : {0.0, -1.0, none, inf}) {
    failed += law.resistance(edge<double>{radius, other, 0.1, {0, 0, 1}}).ok() ? 1 : 0;
  }
  return failed;
}

template <class Law>
void counters(benchmark::State& state) {
  state.counters["error"] = error<Law>();
  state.counters["failed"] = failed_hard_cases<Law>();
}

template <class Law, std::floating_point T>
void resistance(benchmark::State& state) {
  const auto& in = all<Law, T>();
  const Law law{.viscosity = 1.0};
  std::size_t i = 0;
  for (auto _ : state) {
    const auto r = law.resistance(in.edges[i]);
    benchmark::DoNotOptimize(&r);
    benchmark::ClobberMemory();
    i = (i + 1) % input_count;
  }
  counters<Law>(state);
}

/// Forces and torques on both grains.
template <class Law, std::floating_point T>
void forces(benchmark::State& state) {
  const auto& in = all<Law, T>();
  const Law law{.viscosity = 1.0};
  std::size_t i = 0;
  for (auto _ : state) {
    const auto f = apply(law.resistance(in.edges[i]).value, in.motions[i]);
    benchmark::DoNotOptimize(&f);
    benchmark::ClobberMemory();
    i = (i + 1) % input_count;
  }
  counters<Law>(state);
}

/// What the arithmetic alone costs: the leading order of two spheres written out by hand, without status, plane, or the
/// series of a wide gap. A limit for the rows `forces`, not a law: it fails the hard cases.
pair_forces<double> bare_leading_order(const edge<double>& e, const pair_motion<double>& m) {
  const double per_sum = 1 / (e.radius1 + e.radius2);
  const double star = e.radius1 * e.radius2 * per_sum;
  const double x1 = e.radius1 * per_sum;
  const double x2 = e.radius2 * per_sum;
  const double y = 4 * star / e.gap;
  const double scale = pi<double> * star;
  const double shearing = 0.8 * scale * ((1 + e.gap / (4 * star)) * std::log(1 + y) - 1);
  const double half = 0.5 * e.gap;
  return apply(pair_resistance<double>{1.5 * scale * y, shearing * (4 * (x1 * x1 + x2 * x2) + 2 * x1 * x2),
                                       3 * shearing * star * (x2 - x1), 6 * shearing * star * star, 0, e.radius1 + half,
                                       e.radius2 + half, e.normal},
               m);
}

void forces_by_hand(benchmark::State& state) {
  const auto& in = all<leading_order, double>();
  const leading_order law{.viscosity = 1.0};
  std::size_t i = 0;
  for (auto _ : state) {
    const auto f = bare_leading_order(in.edges[i], in.motions[i]);
    benchmark::DoNotOptimize(&f);
    benchmark::ClobberMemory();
    i = (i + 1) % input_count;
  }
  double worst = 0;  // against the law itself
  for (i = 0; i < input_count; ++i) {
    const auto f = bare_leading_order(in.edges[i], in.motions[i]).force1;
    const auto g = apply(law.resistance(in.edges[i]).value, in.motions[i]).force1;
    worst = std::max(worst, norm(f - g) / norm(g));
  }
  state.counters["error"] = worst;
  double failed = 0;
  for (const double gap : {0.0, -0.1}) {
    failed += std::isfinite(bare_leading_order({1, 0.5, gap, {0, 0, 1}}, in.motions[0]).force1.z) ? 1 : 0;
  }
  state.counters["failed"] =
      failed + (std::isfinite(bare_leading_order({1, inf, 0.1, {0, 0, 1}}, in.motions[0]).force1.z) ? 0 : 1);
}

/// A step of the film between two grains.
void film_step(benchmark::State& state) {
  const elastic_film<double> film{1, 1, 0.1, 1};
  double u = 1;
  for (auto _ : state) {
    u = step_film(film, u, -0.1, -0.1, 0.1).value;
    benchmark::DoNotOptimize(u);
    u = u < 0.05 ? 1 : u;
  }
  // against the exact curve u0/(1 + k u0 t/ν) at u_n = 0 in 1,000 steps of the second order
  double v = 1;
  for (int k = 0; k < 1000; ++k) {
    v = step_film(elastic_film<double>{1, 1}, v, 0.0, 0.0, 1e-3, {film_variable::thickness, 0.5}).value;
  }
  state.counters["error"] = std::abs(v / 0.5 - 1);
  double failed = 0;
  for (int power = -12; power <= 12; ++power) {
    failed += step_film(film, 1.0, -0.5, -0.5, std::pow(10.0, power)).value > 0 ? 0 : 1;
  }
  state.counters["failed"] = failed;
}

BENCHMARK_TEMPLATE(resistance, leading_order, double);
BENCHMARK_TEMPLATE(resistance, two_spheres, double);
BENCHMARK_TEMPLATE(resistance, sphere_plane, double);
BENCHMARK_TEMPLATE(forces, leading_order, double);
BENCHMARK(forces_by_hand);
BENCHMARK_TEMPLATE(forces, leading_order, float);
BENCHMARK_TEMPLATE(forces, two_spheres, double);
BENCHMARK_TEMPLATE(forces, two_spheres, float);
BENCHMARK_TEMPLATE(forces, sphere_plane, double);
BENCHMARK(film_step);

}  // namespace
