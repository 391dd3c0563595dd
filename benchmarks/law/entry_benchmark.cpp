// SPDX-License-Identifier: BSD-3-Clause
//
// Entry pressure of a throat, one row per law and scalar: time per throat; `error`, the worst relative difference from
// the long double answer; `failed`, the hard cases of that law that came out wrong. The throats are those of a dense
// packing (three discs, gaps of 0 to 0.3 of the radius), distinct, in random order, larger than the L2 cache.

#include "support/openings.hpp"
#include "tetrapore/law/entry.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

using namespace tetrapore;

constexpr std::size_t input_count = std::size_t{1} << 14;  // 400 B each: 6.5 MB

/// Throats whose law answers ok at this angle.
template <std::floating_point T>
const std::vector<opening<T>>& throats(double angle, double widest) {
  struct set {
    double angle, widest;
    std::vector<opening<T>> all;
  };
  static std::vector<set> made;
  for (const auto& s : made) {
    if (s.angle == angle && s.widest == widest) {
      return s.all;
    }
  }
  made.reserve(16);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  const mayer_stowe_princen law{.surface_tension = 1.0, .contact_angle = angle};
  std::vector<opening<T>> all;
  while (all.size() < input_count) {
    const double a = 0.7 + 0.6 * uniform(random);
    const double b = 0.7 + 0.6 * uniform(random);
    const double c = 0.7 + 0.6 * uniform(random);
    const auto gap = [&] {
      const double u = uniform(random);
      return u < 0.4 ? 1e-6 * u : widest * uniform(random);
    };
    const auto o = opening_from_distances(a, b, c, a + b + gap(), a + c + gap(), b + c + gap());
    if (o.ok() && law.entry_pressure(o.value).ok()) {
      all.push_back(openings::as<T>(o.value));
    }
  }
  made.push_back({angle, widest, std::move(all)});
  return made.back().all;
}

/// Throats of three spheres far apart in memory, as a network holds them.
const std::vector<throat<double>>& facets() {
  static const std::vector<throat<double>> all = [] {
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<throat<double>> made;
    for (const auto& o : throats<double>(0, 0.3)) {
      throat<double> t{};
      t.grain_count = 3;
      const vec3<double> at{100 * uniform(random), 100 * uniform(random), 100 * uniform(random)};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& s = o.sides[k];
        t.grains[k] = {at + vec3<double>{s.point.x, 0.6 * s.point.y, 0.8 * s.point.y}, s.radius};
      }
      made.push_back(t);
    }
    return made;
  }();
  return all;
}

/// Rows of the tables of hard cases with a wrong status or an error above 1e-10.
template <class Law>
double failed_hard_cases() {
  double failed = 0;
  if constexpr (!std::is_same_v<Law, inscribed_circle>) {
    const csv_table t(std::string(TETRAPORE_TEST_DATA) + "/truth/entry_hard.csv");
    for (std::size_t i = 0; i < t.size(); ++i) {
      const Law law{.surface_tension = 1.0, .contact_angle = openings::degrees(t.number(i, "theta_deg"))};
      const auto answer = law.entry_pressure(openings::from_row(t, i).value);
      failed += answer.ok() && std::abs(answer.value / t.number(i, "C") - 1) < 1e-10 ? 0 : 1;
    }
  }
  const csv_table t(std::string(TETRAPORE_TEST_DATA) + "/truth/open_msp.csv");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double angle = openings::degrees(t.number(i, "theta_deg"));
    const Law law{.surface_tension = 1.0, .contact_angle = angle};
    const auto answer = law.entry_pressure(openings::from_row(t, i).value);
    if constexpr (std::is_same_v<Law, inscribed_circle>) {
      const double r = t.number(i, "r_ins");
      failed += r > 0 && !(std::abs(answer.value * r / (2 * std::cos(angle)) - 1) < 1e-10) ? 1 : 0;
    } else {
      failed += openings::name_of(answer.reason) == t.text(i, "status") ? 0 : 1;
    }
  }
  return failed;
}

template <class Law, std::floating_point T>
void entry(benchmark::State& state, double angle, double widest) {
  const auto& all = throats<T>(angle, widest);
  const Law law{.surface_tension = 1.0, .contact_angle = angle};
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(law.entry_pressure(all[i]));
    i = (i + 1) % input_count;
  }
  double worst = 0;
  for (const auto& o : all) {
    const auto exact = law.entry_pressure(openings::as<long double>(o));
    const auto answer = law.entry_pressure(o);
    worst = std::max(worst, std::abs(static_cast<double>(static_cast<long double>(answer.value) / exact.value - 1)));
  }
  state.counters["error"] = worst;
  state.counters["failed"] = failed_hard_cases<Law>();
}

/// The cost beside the law: cutting a facet by the plane of its centres.
void gather(benchmark::State& state) {
  const auto& all = facets();
  std::size_t i = 0;
  for (auto _ : state) {
    const auto o = opening_of(all[i]);
    benchmark::DoNotOptimize(&o);
    benchmark::ClobberMemory();
    i = (i + 1) % input_count;
  }
  const mayer_stowe_princen law{.surface_tension = 1.0};
  const auto& flat = throats<double>(0, 0.3);
  double worst = 0;
  double refused = 0;
  for (std::size_t k = 0; k < input_count; ++k) {
    const auto answer = law.entry_pressure(opening_of(all[k]));
    refused += answer.ok() ? 0 : 1;
    worst = std::max(worst, answer.ok() ? std::abs(answer.value / law.entry_pressure(flat[k]).value - 1) : 0.0);
  }
  state.counters["error"] = worst;
  state.counters["failed"] = refused;
}

void gather_and_answer(benchmark::State& state) {
  const auto& all = facets();
  const mayer_stowe_princen law{.surface_tension = 1.0};
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(law.entry_pressure(opening_of(all[i])));
    i = (i + 1) % input_count;
  }
  state.counters["error"] = 0;
  state.counters["failed"] = failed_hard_cases<mayer_stowe_princen>();
}

/// Rings of four equal rods: what a merged throat costs.
void ring_of_four(benchmark::State& state) {
  const mayer_stowe_princen law{.surface_tension = 1.0};
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(0, 0.3);
  std::vector<opening<double>> all;
  for (std::size_t k = 0; k < input_count; ++k) {
    all.push_back(ring_of_discs(4, 1.0, uniform(random)).value);
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(law.entry_pressure(all[i]));
    i = (i + 1) % input_count;
  }
  double worst = 0;
  double refused = 0;
  for (const auto& o : all) {
    const auto answer = law.entry_pressure(o);
    const auto exact = law.entry_pressure(openings::as<long double>(o));
    refused += answer.ok() ? 0 : 1;
    worst = std::max(worst, std::abs(static_cast<double>(static_cast<long double>(answer.value) / exact.value - 1)));
  }
  state.counters["error"] = worst;
  state.counters["failed"] = refused;
}

constexpr auto inscribed_double = entry<inscribed_circle, double>;
constexpr auto inscribed_float = entry<inscribed_circle, float>;
constexpr auto msp_double = entry<mayer_stowe_princen, double>;
constexpr auto msp_float = entry<mayer_stowe_princen, float>;

BENCHMARK_CAPTURE(inscribed_double, gaps, 0.0, 0.3);
BENCHMARK_CAPTURE(inscribed_float, gaps, 0.0, 0.3);
BENCHMARK_CAPTURE(msp_double, gaps, 0.0, 0.3);
BENCHMARK_CAPTURE(msp_double, gaps_at_0_7_rad, 0.7, 0.3);
BENCHMARK_CAPTURE(msp_double, touching, 0.0, 0.0);
BENCHMARK_CAPTURE(msp_float, gaps, 0.0, 0.3);
BENCHMARK(gather);
BENCHMARK(gather_and_answer);
BENCHMARK(ring_of_four);

}  // namespace
