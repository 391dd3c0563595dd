// SPDX-License-Identifier: BSD-3-Clause
//
// Conductance of a throat, one row per law and scalar: time per throat; `error`, the worst relative difference from the
// long double answer; `failed`, the hard cases of that law that came out wrong. The throats are of all three shapes (7
// in 10 between three grains), distinct, in random order, larger than the L2 cache.

#include "support/throats.hpp"
#include "tetrapore/law/conductance.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace {

using namespace tetrapore;

constexpr std::size_t input_count = std::size_t{1} << 14;  // 280 B each: 4.6 MB

template <class Law>
[[nodiscard]] Law law_of() {
  if constexpr (std::is_same_v<Law, darcy>) {
    return {.permeability = 1e-3, .viscosity = 1.0};
  } else {
    return {.viscosity = 1.0};
  }
}

/// Throats that every law answers, the fluid at least a hundredth of the domain, so that the difference keeps digits.
template <std::floating_point T>
const std::vector<throat<T>>& inputs() {
  static const std::vector<throat<T>> all = [] {
    throats::random_throats next(17);
    std::vector<throat<T>> made;
    while (made.size() < input_count) {
      const throat<double> t = next();
      const auto h = hydraulics_of(t).value;
      if (h.fluid_volume() > 0.01 * h.domain_volume && law_of<calibrated>().conductance(t).ok() &&
          law_of<mean_radius>().conductance(t).ok()) {
        made.push_back(throats::as<T>(t));
      }
    }
    return made;
  }();
  return all;
}

template <class Law>
[[nodiscard]] double wrong_by(const throat<double>& t) {
  const auto d = law_of<Law>().conductance(t);
  const auto exact = law_of<Law>().conductance(throats::as<long double>(t));
  return d.ok() && exact.ok() ? static_cast<double>(std::abs(static_cast<long double>(d.value) / exact.value - 1))
                              : 1.0;
}

/// Throats with two nodes that nearly coincide or lie far apart, and with radii 1 : 1000, off by more than 1e-10.
template <class Law>
[[nodiscard]] double failed_hard_cases() {
  double failed = 0;
  for (int k = -12; k <= 6; ++k) {
    const double apart = std::pow(10.0, k);
    failed += wrong_by<Law>(throats::of_grains({1, 1, 1}, 2.1, 2.2, 2.05, 0.1, 0.1 + apart)) < 1e-10 ? 0 : 1;
    failed += wrong_by<Law>(throats::on_a_wall({1, 1}, {1.05, 1.1}, 2.2, 0.1, 0.1 + apart)) < 1e-10 ? 0 : 1;
  }
  for (const double large : {10.0, 100.0, 1000.0}) {
    failed +=
        wrong_by<Law>(throats::of_grains({1, 1, large}, 2.1, large + 1.1, large + 1.05, -0.5, 0.5)) < 1e-10 ? 0 : 1;
  }
  return failed;
}

template <class Law, std::floating_point T>
void conductance(benchmark::State& state) {
  const auto& all = inputs<T>();
  const Law law = law_of<Law>();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(law.conductance(all[i]));
    i = (i + 1) % input_count;
  }
  double worst = 0;
  for (const auto& t : all) {
    const auto exact = law.conductance(throats::as<long double>(t));
    worst = std::max(
        worst, std::abs(static_cast<double>(static_cast<long double>(law.conductance(t).value) / exact.value - 1)));
  }
  state.counters["error"] = worst;
  state.counters["failed"] = failed_hard_cases<Law>();
}

/// What the laws of a throat's own geometry share: areas, volumes and solid angles.
void hydraulics(benchmark::State& state) {
  const auto& all = inputs<double>();
  std::size_t i = 0;
  for (auto _ : state) {
    const auto h = hydraulics_of(all[i]);
    benchmark::DoNotOptimize(&h);
    benchmark::ClobberMemory();
    i = (i + 1) % input_count;
  }
  double worst = 0;
  for (const auto& t : all) {
    const auto h = hydraulics_of(t).value;
    const auto exact = hydraulics_of(throats::as<long double>(t)).value;
    const auto of = [](const auto& a) { return a.hydraulic_radius(wall_condition::no_slip); };
    worst = std::max(worst, std::abs(static_cast<double>(static_cast<long double>(of(h)) / of(exact) - 1)));
  }
  state.counters["error"] = worst;
  state.counters["failed"] = failed_hard_cases<hydraulic_radius>();
}

BENCHMARK(hydraulics);
BENCHMARK_TEMPLATE(conductance, hydraulic_radius, double);
BENCHMARK_TEMPLATE(conductance, hydraulic_radius, float);
BENCHMARK_TEMPLATE(conductance, mean_radius, double);
BENCHMARK_TEMPLATE(conductance, calibrated, double);
BENCHMARK_TEMPLATE(conductance, calibrated, float);
BENCHMARK_TEMPLATE(conductance, darcy, double);

}  // namespace
