// SPDX-License-Identifier: BSD-3-Clause
#include "support/bridge_steps.hpp"

#include <doctest/doctest.h>

#include <ctime>

using namespace bridges;

// The short form of tests/long/law/bridge_steps_test.cpp.
TEST_CASE("8,000 time steps: never a wrong branch, work balances energy, what ruptures dissipate is booked") {
  tally t;
  for (std::uint64_t seed = 100001; seed <= 100040; ++seed) {
    life(seed, t).run(200);
  }
  MESSAGE(t.present << " steps with a bridge, " << t.made << " made, " << t.folded + t.lopsided
                    << " ruptured; warm against cold " << t.force_error << " of the stated error, cycles "
                    << t.cycle_error << ", ledger " << t.ledger_error << ", least loss " << t.least_loss);
  check(t);
}

TEST_CASE("the gap of rupture and how it ends are those that the bridges beside it show, near and far") {
  random_pairs random(21);
  int ends[2] = {0, 0};
  for (int i = 0; i < 1200; ++i) {
    const bool equal = i % 2 == 1;
    const double r2 = equal                        ? 1.0
                      : random.uniform(0, 1) < 0.2 ? infinity<double>
                                                   : std::pow(10.0, random.uniform(-2, 1));
    // an equal pair ends at a fold below about 31 degrees and lopsided above: half of them lie there
    const double theta1 = radians(i % 4 == 1 ? random.uniform(27, 35) : random.uniform(0, 85));
    // pairs that are nearly equal lose their symmetry nearly: there the curves come close to one another
    const double theta2 = equal        ? theta1
                          : i % 4 == 0 ? radians(random.uniform(0, 85))
                                       : std::min(theta1 + radians(random.uniform(0, 3)), radians(85));
    const double small = std::min(1.0, r2);
    const given_volume<double> v{std::pow(10.0, random.uniform(-6, 0)) * small * small * small};
    const auto law = law_of(theta1, theta2);
    edge<double> e{1.0, i % 8 == 2 ? 1.0 : r2, 0.0, {0, 0, 1}};
    const auto limit = law.rupture_gap(e, v);
    CAPTURE(i);
    REQUIRE(limit.ok());
    const auto at = [&](double share) {
      e.gap = share * limit.value.gap;
      return law.bridge(e, v).reason;
    };
    const bool fold = limit.value.end == bridge_end::fold;
    ends[fold ? 0 : 1] += 1;
    CHECK(at(1 - 1e-9) == bridge_status::ok);
    for (const double share : {1 + 1e-9, 1.001, 1.05, 1.5, 30.0}) {
      CAPTURE(share);
      CHECK(at(share) == (fold ? bridge_status::ruptured : bridge_status::lopsided));
    }
  }
  CHECK(ends[0] > 400);
  CHECK(ends[1] > 200);
}

TEST_CASE("equal spheres at 30 degrees turn lopsided just before their fold, where V/R³ is 0.012 to 0.022") {
  const auto law = law_of(radians(30), radians(30));
  for (int i = 0; i <= 100; ++i) {
    const given_volume<double> v{0.012 + 1e-4 * i};
    edge<double> e{1.0, 1.0, 0.0, {0, 0, 1}};
    const auto limit = law.rupture_gap(e, v);
    CAPTURE(v.value);
    REQUIRE(limit.ok());
    CHECK(limit.value.last.volume == v.value);
    for (const double off : {1e-9, 1e-7, 1e-5, 1e-3}) {
      e.gap = limit.value.gap * (1 - off);
      CHECK(law.bridge(e, v).reason == bridge_status::ok);
      e.gap = limit.value.gap * (1 + off);
      CHECK(law.bridge(e, v).reason ==
            (limit.value.end == bridge_end::fold ? bridge_status::ruptured : bridge_status::lopsided));
    }
  }
}

TEST_CASE("a drop as large as a thin neck allows is no bridge: beyond the rupture ten nodes see none") {
  const auto law = law_of(radians(71.321815461706322), radians(3.8280994549371257));
  edge<double> e{1.0, 3.9403765126570902, 0.0, {0, 0, 1}};
  const given_volume<double> v{0.060330710666066573};
  const auto limit = law.rupture_gap(e, v);
  REQUIRE(limit.ok());
  e.gap = 1.05 * limit.value.gap;
  CHECK(law.bridge(e, v).reason == bridge_status::ruptured);
}

namespace {

/// Processor time of a call [s], which other programs do not lengthen.
template <class F>
double time_of(F&& f) {
  const std::clock_t start = std::clock();
  f();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE("every loop has its cap, and hard requests come back: an answer or a status, each within 0.25 s") {
  using detail::path;
  static_assert(detail::newton_cap <= 30);
  static_assert(path<true, double>::step_cap <= 400 && path<false, double>::step_cap <= 400);
  static_assert(path<true, double>::locate_cap <= 80 && path<false, double>::locate_cap <= 80);
  const double tiny = std::numeric_limits<double>::min();
  const double denormal = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  int requests = 0;
  int answered = 0;
  double slowest = 0;
  const auto ask = [&](const young_laplace<>& law, const edge<double>& e, double x) {
    young_laplace<>::warm_state<double> w;
    const auto see = [&](const auto& b) {
      answered += b.reason == bridge_status::ok ? 1 : 0;
      CHECK(std::isfinite(b.value.force) == (b.kind() == verdict::ok || b.kind() == verdict::absent));
    };
    const double seconds = time_of([&] {
      see(law.bridge(e, given_volume<double>{x}, w));
      see(law.bridge(e, given_suction<double>{x}, w));
      see(law.bridge(e, given_suction<double>{-x}));
      static_cast<void>(law.rupture_gap(e, given_volume<double>{x}));
      static_cast<void>(law.rupture_gap(e, given_suction<double>{x}));
      static_cast<void>(law.highest_suction(e));
    });
    slowest = std::max(slowest, seconds);
    requests += 6;
  };
  for (const double r2 : {1.0, 1 + 1e-15, 1e-9, 1e9, tiny, huge, infinity<double>}) {
    for (const double theta : {0.0, 1e-12, 0.5, 1.5, pi<double> / 2 - 1e-15}) {
      for (const double gap : {0.0, denormal, 1e-9, 0.3, 1e9, huge, -1e-9, -0.999 * std::min(r2, 1.0)}) {
        for (const double x : {denormal, 1e-12, 0.1, 5.0, 1e9, huge}) {
          ask(law_of(theta, r2 == 1.0 ? theta : 0.3), edge<double>{1.0, r2, gap, {0, 0, 1}}, x);
        }
      }
    }
  }
  random_pairs random(22);
  for (int i = 0; i < 200; ++i) {
    auto c = random.next();
    c.e.gap *= i % 2 == 0 ? 1.0 : -1.0;
    ask(law_of(c.theta1, c.theta2), c.e, std::pow(10.0, random.uniform(-12, 12)));
  }
  MESSAGE(answered << " of " << requests << " requests have a bridge; the slowest six took " << slowest << " s");
  CHECK(slowest < 0.25);
}
