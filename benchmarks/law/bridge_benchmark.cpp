// SPDX-License-Identifier: BSD-3-Clause
//
// The force of a bridge, one row per law: time per pair; `error`, the worst error against the exact law in long double
// with 24 nodes, in 2πRσ (R of Derjaguin), on what the row is timed on; `failed`, the stable bridges of
// tests/truth/open_bridge.csv (402, 221 of them at a volume) under the row's control that get no answer, or one off
// by more than a tenth of the force. Pairs of one material, θ = 20°: spheres of one size or two, V/R³ = 1e-3 to 0.1,
// gaps up to 0.9 of the rupture gap; distinct, in random order, each law on those that it covers. `wetted` rows:
// θ = 0. Warm rows step the gap of 4096 pairs by 0.002 ∛V, to and fro.

#include "support/csv_table.hpp"
#include "tetrapore/law/bridge.hpp"
#include "tetrapore/law/bridge/closed_forms.hpp"
#include "tetrapore/law/bridge/table.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using namespace tetrapore;

constexpr std::size_t input_count = std::size_t{1} << 12;
enum class shape { equal, unequal, wetted };  ///< wetted: equal, θ = 0
constexpr double angle_of(shape s) { return s == shape::wetted ? 0 : pi<double> / 9; }

/// One value for each shape, all made at the first use.
template <class Make>
[[nodiscard]] auto for_each_shape(Make make) {
  return std::array{make(shape::equal), make(shape::unequal), make(shape::wetted)};
}

struct request {
  edge<double> e;
  double volume;
  double suction;
  double force;  ///< exact
  double unit;   ///< 2πRσ
};

[[nodiscard]] edge<long double> precise(const edge<double>& e) { return {e.radius1, e.radius2, e.gap, {}}; }

/// Requests with their exact answers. Unequal: the second radius is half the first.
const std::vector<request>& requests(shape s) {
  static const auto made = [](shape which) {
    const young_laplace<24> exact{1.0, angle_of(which), angle_of(which)};
    const young_laplace<> quick{1.0, angle_of(which), angle_of(which)};
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<request> all;
    while (all.size() < input_count) {
      const double size = 0.5 + uniform(random);
      request r{{size, which == shape::unequal ? size / 2 : size, 0, {0, 0, 1}}, 0, 0, 0, 0};
      const double radius = detail::derjaguin_radius(r.e);
      r.volume = std::pow(10, -3 + 1.99 * uniform(random)) * 1.001 * radius * radius * radius;
      const auto limit = quick.rupture_gap(r.e, given_volume<double>{r.volume});
      r.e.gap = 0.9 * uniform(random) * limit.value.gap;
      const auto answer = exact.bridge(precise(r.e), given_volume<long double>{r.volume});
      if (!limit.ok() || !answer.ok()) {
        continue;
      }
      r.suction = static_cast<double>(answer.value.suction);
      r.force = static_cast<double>(answer.value.force);
      r.unit = 2 * pi<double> * radius;
      all.push_back(r);
    }
    return all;
  };
  static const auto all = for_each_shape(made);
  return all[static_cast<std::size_t>(s)];
}

template <class Given>
[[nodiscard]] Given given(const request& r) {
  if constexpr (std::is_same_v<Given, given_volume<double>>) {
    return {r.volume};
  } else {
    return {r.suction};
  }
}

/// The law of a material, for those with one contact angle and those with two.
template <class Law>
[[nodiscard]] Law law_for(double angle1, double angle2) {
  if constexpr (requires(Law l) { l.contact_angle1; }) {
    return {.surface_tension = 1.0, .contact_angle1 = angle1, .contact_angle2 = angle2};
  } else if constexpr (requires(Law l) { l.contact_angle; }) {
    return {.surface_tension = 1.0, .contact_angle = angle1};
  } else {
    return {.surface_tension = 1.0};
  }
}
template <class Law>
[[nodiscard]] bool knows(double angle1, double angle2) {
  if constexpr (requires(Law l) { l.contact_angle1; }) {
    return true;
  } else if constexpr (requires(Law l) { l.contact_angle; }) {
    return angle1 == angle2;
  } else {
    return angle1 == 0 && angle2 == 0;
  }
}

/// Stable bridges that `ask(edge, angle1, angle2, given)` does not answer to a tenth of the force.
template <class Given, class Ask>
[[nodiscard]] double failed_hard_cases(const Ask& ask) {
  static const csv_table t(std::string(TETRAPORE_TEST_DATA) + "/truth/open_bridge.csv");
  constexpr bool by_volume = std::is_same_v<Given, given_volume<double>>;
  double failed = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t.text(i, "control") != (by_volume ? "V" : "p") || t.text(i, by_volume ? "stable_V" : "stable_p") != "1") {
      continue;
    }
    const double radius2 = t.text(i, "R2") == "inf" ? infinity<double> : t.number(i, "R2");
    const auto a =
        ask(edge<double>{1, radius2, t.number(i, "D"), {0, 0, 1}}, t.number(i, "theta1_deg") * pi<double> / 180,
            t.number(i, "theta2_deg") * pi<double> / 180, Given{t.number(i, by_volume ? "V" : "pc")});
    failed += a.ok() && std::abs(a.value.force / t.number(i, "F") - 1) < 0.1 ? 0 : 1;
  }
  return failed;
}

/// The requests that have a bridge under this control: the one of a volume may be none of its suction.
template <class Given>
const std::vector<request>& held(shape s) {
  if constexpr (std::is_same_v<Given, given_volume<double>>) {
    return requests(s);
  } else {
    static const auto chosen = [](shape which) {
      const young_laplace<24> exact{1.0, angle_of(which), angle_of(which)};
      std::vector<request> some;
      std::copy_if(requests(which).begin(), requests(which).end(), std::back_inserter(some), [&](const request& r) {
        const auto a = exact.bridge(precise(r.e), given_suction<long double>{r.suction});
        return a.ok() && std::abs(static_cast<double>(a.value.force) / r.force - 1) < 1e-6;
      });
      return some;
    };
    static const auto all = for_each_shape(chosen);
    return all[static_cast<std::size_t>(s)];
  }
}

/// Times a law on requests and measures it on the same.
template <class Given, class Law>
void time_law(benchmark::State& state, const Law& law, const std::vector<request>& all) {
  std::vector<request> covered;
  std::copy_if(all.begin(), all.end(), std::back_inserter(covered),
               [&](const request& r) { return law.bridge(r.e, given<Given>(r)).ok(); });
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(law.bridge(covered[i].e, given<Given>(covered[i])).value.force);
    i = i + 1 == covered.size() ? 0 : i + 1;
  }
  double worst = 0;
  for (const request& r : covered) {
    worst = std::max(worst, std::abs(law.bridge(r.e, given<Given>(r)).value.force - r.force) / r.unit);
  }
  state.counters["error"] = worst;
  state.counters["covers"] = static_cast<double>(covered.size()) / static_cast<double>(all.size());
  state.SetLabel("error in 2πRσ");
}

template <class Law, class Given>
void cold(benchmark::State& state, shape s) {
  time_law<Given>(state, law_for<Law>(angle_of(s), angle_of(s)), held<Given>(s));
  static const double failed =
      failed_hard_cases<Given>([](const edge<double>& e, double angle1, double angle2, const Given& g) {
        using answer = decltype(law_for<Law>(angle1, angle2).bridge(e, g));
        return knows<Law>(angle1, angle2) ? law_for<Law>(angle1, angle2).bridge(e, g)
                                          : answer{{}, bridge_status::not_covered};
      });
  state.counters["failed"] = failed;
}

/// The requests after a step of the gap; as they were where the step leads past the last bridge.
template <class Given>
const std::vector<request>& stepped(shape s) {
  static const auto made = [](shape which) {
    const young_laplace<24> exact{1.0, angle_of(which), angle_of(which)};
    std::vector<request> all = held<Given>(which);
    for (request& r : all) {
      request next = r;
      next.e.gap += 0.002 * std::cbrt(r.volume);
      const auto asked = given<Given>(next);
      const std::conditional_t<std::is_same_v<Given, given_volume<double>>, given_volume<long double>,
                               given_suction<long double>>
          precisely{asked.value};
      const auto a = exact.bridge(precise(next.e), precisely);
      next.force = static_cast<double>(a.value.force);
      if (a.ok()) {
        r = next;
      }
    }
    return all;
  };
  static const auto all = for_each_shape(made);
  return all[static_cast<std::size_t>(s)];
}

template <int Nodes, class Given>
void warm(benchmark::State& state, shape s) {
  using law_type = young_laplace<Nodes>;
  using warm_state = typename law_type::template warm_state<double>;
  const law_type law{1.0, angle_of(s), angle_of(s)};
  const auto& all = held<Given>(s);
  const auto& near = stepped<Given>(s);
  std::vector<warm_state> remembered(all.size());
  bool aside = false;
  std::size_t i = 0;
  for (auto _ : state) {
    const request& r = aside ? near[i] : all[i];
    benchmark::DoNotOptimize(law.bridge(r.e, given<Given>(r), remembered[i]).value.force);
    if (++i == all.size()) {
      i = 0;
      aside = !aside;
    }
  }
  double worst = 0;
  for (const auto* at : {&near, &all}) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const request& r = (*at)[k];
      const auto a = law.bridge(r.e, given<Given>(r), remembered[k]);
      worst = std::max(worst, a.ok() ? std::abs(a.value.force - r.force) / r.unit : 1.0);
    }
  }
  state.counters["error"] = worst;
  state.counters["covers"] = 1;
  state.SetLabel("error in 2πRσ");
  // a warm start from a hundredth of the gap away
  static const double failed =
      failed_hard_cases<Given>([](edge<double> e, double angle1, double angle2, const Given& g) {
        const law_type here{1.0, angle1, angle2};
        warm_state w;
        const double gap = e.gap;
        e.gap = 0.99 * gap;
        (void)here.bridge(e, g, w);
        e.gap = gap;
        return here.bridge(e, g, w);
      });
  state.counters["failed"] = failed;
}

template <int GapCells>
void table(benchmark::State& state, shape s) {
  using storage = bridge_table<7, GapCells>;
  const auto build = [](const edge<double>& e, double angle1, double angle2, double least, double largest, storage& t) {
    return t.build(young_laplace<>{1.0, angle1, angle2}, {.radius1 = e.radius1,
                                                          .radius2 = e.radius2,
                                                          .least_volume = least,
                                                          .largest_volume = largest,
                                                          .deepest_overlap = e.gap < 0 ? -1.01 * e.gap : 0});
  };
  const auto& all = requests(s);
  auto t = std::make_unique<storage>();
  const double half = s == shape::unequal ? 0.5 : 1.0;
  const double cube = std::pow(detail::derjaguin_radius(edge<double>{1, half, 0, {}}), 3);
  const table_report report = build({1, half, 0, {}}, angle_of(s), angle_of(s), 1e-3 * cube, 0.1 * cube, *t);
  if (report.reason != bridge_status::ok) {
    state.SkipWithError(describe(report.reason));
    return;
  }
  time_law<given_volume<double>>(state, tabulated<storage>{t.get()}, all);
  static const double failed = failed_hard_cases<given_volume<double>>(
      [&](const edge<double>& e, double angle1, double angle2, const given_volume<double>& g) {
        const table_report made = build(e, angle1, angle2, g.value / 1.2, g.value * 1.2, *t);
        return made.reason == bridge_status::ok ? tabulated<storage>{t.get()}.bridge(e, g)
                                                : detail::no_pull<double>(bridge_status::not_covered);
      });
  state.counters["failed"] = failed;
  state.counters["kilobytes"] = static_cast<double>(sizeof(storage)) / 1024;
}

template <int Octaves>
void build_a_table(benchmark::State& state) {
  auto t = std::make_unique<bridge_table<Octaves>>();
  table_report report{};
  for (auto _ : state) {
    report = t->build(
        young_laplace<>{1.0, angle_of(shape::equal), angle_of(shape::equal)},
        {.radius1 = 1.0, .radius2 = 1.0, .least_volume = 0.1 / std::ldexp(0.99, Octaves), .largest_volume = 0.1});
  }
  state.counters["error"] = report.error;
  state.counters["failed"] = report.reason == bridge_status::ok ? 0 : 1;
  state.SetLabel("of " + std::to_string(Octaves) + " octaves of volume; error as stated");
}

using volume = given_volume<double>;
using suction = given_suction<double>;

template <int Nodes>
void exact_cold_volume(benchmark::State& state, shape s) {
  cold<young_laplace<Nodes>, volume>(state, s);
}
template <int Nodes>
void exact_cold_suction(benchmark::State& state, shape s) {
  cold<young_laplace<Nodes>, suction>(state, s);
}
constexpr auto exact_volume_6 = exact_cold_volume<6>;
constexpr auto exact_volume_8 = exact_cold_volume<8>;
constexpr auto exact_volume = exact_cold_volume<10>;
constexpr auto exact_volume_12 = exact_cold_volume<12>;
constexpr auto exact_suction = exact_cold_suction<10>;
constexpr auto warm_volume = warm<10, volume>;
constexpr auto warm_suction = warm<10, suction>;
constexpr auto toroid_volume = cold<toroid<>, volume>;
constexpr auto toroid_suction = cold<toroid<>, suction>;
constexpr auto willett_appendix = cold<willett<>, volume>;
constexpr auto willett_eq_12 = cold<willett_small<>, volume>;
constexpr auto lambert_2008 = cold<lambert<>, volume>;
constexpr auto rabinovich_2005 = cold<rabinovich<>, volume>;
constexpr auto soulie_2006 = cold<soulie<>, volume>;
constexpr auto weigert_1999 = cold<weigert_ripperger<>, volume>;
constexpr auto mikami_1998 = cold<mikami<>, volume>;
constexpr auto table_16 = table<16>;

BENCHMARK_CAPTURE(exact_volume_6, equal, shape::equal);
BENCHMARK_CAPTURE(exact_volume_8, equal, shape::equal);
BENCHMARK_CAPTURE(exact_volume, equal, shape::equal);
BENCHMARK_CAPTURE(exact_volume, unequal, shape::unequal);
BENCHMARK_CAPTURE(exact_volume_12, equal, shape::equal);
BENCHMARK_CAPTURE(exact_suction, equal, shape::equal);
BENCHMARK_CAPTURE(exact_suction, unequal, shape::unequal);
BENCHMARK_CAPTURE(warm_volume, equal, shape::equal);
BENCHMARK_CAPTURE(warm_volume, unequal, shape::unequal);
BENCHMARK_CAPTURE(warm_suction, equal, shape::equal);
BENCHMARK_CAPTURE(warm_suction, unequal, shape::unequal);
BENCHMARK_CAPTURE(table_16, equal, shape::equal);
BENCHMARK_CAPTURE(table_16, unequal, shape::unequal);
BENCHMARK_CAPTURE(toroid_volume, equal, shape::equal);
BENCHMARK_CAPTURE(toroid_volume, unequal, shape::unequal);
BENCHMARK_CAPTURE(toroid_suction, equal, shape::equal);
BENCHMARK_CAPTURE(willett_appendix, equal, shape::equal);
BENCHMARK_CAPTURE(willett_appendix, unequal, shape::unequal);
BENCHMARK_CAPTURE(willett_eq_12, equal, shape::equal);
BENCHMARK_CAPTURE(lambert_2008, equal, shape::equal);
BENCHMARK_CAPTURE(rabinovich_2005, equal, shape::equal);
BENCHMARK_CAPTURE(soulie_2006, equal, shape::equal);
BENCHMARK_CAPTURE(soulie_2006, unequal, shape::unequal);
BENCHMARK_CAPTURE(weigert_1999, equal, shape::equal);
BENCHMARK_CAPTURE(mikami_1998, wetted, shape::wetted);
BENCHMARK_CAPTURE(soulie_2006, wetted, shape::wetted);
BENCHMARK_TEMPLATE(build_a_table, 10)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(build_a_table, 20)->Unit(benchmark::kMillisecond);

}  // namespace
