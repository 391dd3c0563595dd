// SPDX-License-Identifier: BSD-3-Clause
#include "support/bridges.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace bridges;

namespace {

constexpr int many = 100000;

struct worst_of {
  double value = 0;
  void add(double x) { value = x > value || std::isnan(x) ? x : value; }
};

}  // namespace

TEST_CASE("100,000 random bridges: Maxwell's relation, force at both ends, exchange, homogeneity, both controls") {
  random_pairs random(11);
  int solved = 0;
  int absent = 0;
  int other = 0;
  worst_of maxwell;
  worst_of chain;
  worst_of ends;
  worst_of exchange;
  worst_of homogeneity;
  worst_of controls;
  int lost = 0;
  for (int i = 0; i < many; ++i) {
    const auto c = random.next();
    const auto law = law_of(c.theta1, c.theta2);
    const auto b = law.bridge(c.e, given_volume<double>{c.volume});
    if (!b.ok()) {
      (b.kind() == verdict::absent ? absent : other) += 1;
      continue;
    }
    ++solved;
    const auto& m = b.value;
    const auto s = law.stiffness(c.e, m);
    // dF/dg at V = dF/dg at p + (dF/dp)(dp/dg at V), where Maxwell's relation makes dF/dp = dV/dg at p
    const double coupled = s.volume_by_gap_at_suction * s.suction_by_gap_at_volume;
    maxwell.add(std::abs(s.force_by_gap_at_volume - s.force_by_gap_at_suction - coupled) /
                (std::abs(s.force_by_gap_at_volume) + std::abs(s.force_by_gap_at_suction) + std::abs(coupled)));
    chain.add(std::abs(s.volume_by_gap_at_suction + s.volume_by_suction * s.suction_by_gap_at_volume) /
              std::abs(s.volume_by_gap_at_suction));
    // F = 2πσ r sin(δ + θ) + πr² p at either circle; the error counts by the parts that balance
    const double kappa = std::max(1e-12, 16 * rounding_of_request(s, m, c.e.gap, true));
    const double parts = 2 * pi<double> * std::max(m.contact1, m.contact2);
    for (const auto& [r, angle] :
         {std::array{m.contact1, m.filling1 + c.theta1}, std::array{m.contact2, m.filling2 + c.theta2}}) {
      const double there = 2 * pi<double> * r * std::sin(angle) + pi<double> * r * r * m.suction;
      ends.add(std::abs(there - m.force) / parts);
    }
    const double size = std::abs(m.force);
    const edge<double> turned{c.e.radius2, c.e.radius1, c.e.gap, {0, 0, -1}};
    const auto back = law_of(c.theta2, c.theta1).bridge(turned, given_volume<double>{c.volume});
    const edge<double> scaled{c.e.radius1 * 1e-3, c.e.radius2 * 1e-3, c.e.gap * 1e-3, {0, 0, 1}};
    const auto small = law_of(c.theta1, c.theta2, 0.072).bridge(scaled, given_volume<double>{c.volume * 1e-9});
    if (!back.ok() || !small.ok()) {
      ++lost;
      continue;
    }
    exchange.add(std::abs(back.value.force - m.force) / (size * 2 * kappa + 1e-14 * parts));
    homogeneity.add(std::abs(small.value.force / (0.072e-3) - m.force) / (size * 2 * kappa + 1e-14 * parts));
    if (law.stable(c.e, m, bridge_control::suction)) {
      const auto same = law.bridge(c.e, given_suction<double>{m.suction});
      if (!same.ok()) {
        ++lost;
        continue;
      }
      // the suction's own rounding, through dF/dp and dV/dp
      const double rounding = std::ldexp(std::abs(m.suction) + 1 / m.contact1, -53);
      const double force_error = 64 * rounding * std::abs(s.volume_by_gap_at_suction) +
                                 64 * std::ldexp(std::abs(c.e.gap * s.force_by_gap_at_suction), -53);
      controls.add(std::abs(same.value.force - m.force) / (force_error + size * 4 * kappa + 1e-13 * parts));
    }
  }
  MESSAGE(solved << " solved, " << absent << " absent; Maxwell " << maxwell.value << ", chain " << chain.value
                 << ", ends " << ends.value << ", exchange " << exchange.value << ", homogeneity " << homogeneity.value
                 << ", controls " << controls.value);
  CHECK(other == 0);
  CHECK(solved > many / 2);
  CHECK(lost == 0);
  CHECK(maxwell.value < 1e-8);
  CHECK(chain.value < 1e-8);
  CHECK(ends.value < 1e-12);
  CHECK(exchange.value <= 1);
  CHECK(homogeneity.value <= 1);
  CHECK(controls.value <= 1);
}

TEST_CASE("the force is the slope of the energy: over a stretch at constant volume their integrals agree to 1e-11") {
  random_pairs random(12);
  const auto& rule = detail::gauss<double, 8>;
  int checked = 0;
  worst_of error;
  while (checked < 1000) {
    auto c = random.next();
    c.e.gap = 0;
    const auto law = law_of(c.theta1, c.theta2);
    const auto limit = law.rupture_gap(c.e, given_volume<double>{c.volume});
    if (!limit.ok()) {
      continue;
    }
    const double from = 0.3 * limit.value.gap;
    const double to = 0.7 * limit.value.gap;
    const auto at = [&](double gap) {
      edge<double> e = c.e;
      e.gap = gap;
      const auto b = law.bridge(e, given_volume<double>{c.volume});
      REQUIRE(b.ok());
      return std::array{b.value.force, law.energy(e, b.value)};
    };
    double work = 0;
    for (std::size_t j = 0; j < 8; ++j) {
      for (const double t : {0.5 * (1 - rule.node[j]), 0.5 * (1 + rule.node[j])}) {
        work += 0.5 * rule.weight[j] * at(from + t * (to - from))[0];
      }
    }
    work *= to - from;
    const auto first = at(from);
    const auto last = at(to);
    // the energies are differences of areas, known to a few roundings of the largest
    const double size = std::abs(work) + std::abs(last[1]) * 1e-3;
    error.add(std::abs(last[1] - first[1] - work) / size);
    ++checked;
  }
  MESSAGE("largest difference of work and energy, relative: " << error.value);
  CHECK(error.value < 1e-11);
}

TEST_CASE("stability agrees with finite elements on 2,000 random bridges under either control") {
  random_pairs random(13);
  int checked = 0;
  int stable_at_suction = 0;
  while (checked < 2000) {
    const auto c = random.next();
    if (c.theta1 < 0.02 || c.theta2 < 0.02) {
      continue;
    }
    const auto law = law_of(c.theta1, c.theta2);
    const auto b = law.bridge(c.e, given_volume<double>{c.volume});
    if (!b.ok()) {
      continue;
    }
    // next to a change of stability neither count is certain
    const auto s = law.stiffness(c.e, b.value);
    const double fold = std::abs(s.force_by_gap_at_volume) * b.value.contact1 / (1 + std::abs(b.value.force));
    const double at_suction = std::abs(s.force_by_gap_at_suction) * b.value.contact1 / std::abs(b.value.force);
    if (fold > 1e3 || at_suction > 1e3) {
      continue;
    }
    ++checked;
    const request q{c.e, c.theta1, c.theta2, true, c.volume};
    const auto count = count_negative(q, b.value);
    CAPTURE(checked);
    CHECK((count.at_volume == 0) == law.stable(c.e, b.value, bridge_control::volume));
    CHECK((count.at_suction == 0) == law.stable(c.e, b.value, bridge_control::suction));
    stable_at_suction += count.at_suction == 0 ? 1 : 0;
  }
  CHECK(stable_at_suction > 200);
  CHECK(stable_at_suction < 1800);
}

TEST_CASE("30,000 time steps of stretch and compression: a warm state changes time, never the bridge") {
  random_pairs random(14);
  int steps = 0;
  int differ = 0;
  int present = 0;
  worst_of error;
  while (steps < 30000) {
    auto c = random.next();
    const auto law = law_of(c.theta1, c.theta2);
    const auto limit = law.rupture_gap(c.e, given_volume<double>{c.volume});
    if (!limit.ok()) {
      continue;
    }
    young_laplace<>::warm_state<double> warm;
    for (int k = 0; k < 100; ++k, ++steps) {
      // small and large steps, past the rupture and back
      const double share = random.uniform(0, 1) < 0.8 ? random.uniform(-0.02, 0.02) : random.uniform(-0.5, 0.5);
      c.e.gap = std::min(std::max(c.e.gap + share * limit.value.gap, 0.0), 1.1 * limit.value.gap);
      const auto a = law.bridge(c.e, given_volume<double>{c.volume}, warm);
      const auto b = law.bridge(c.e, given_volume<double>{c.volume});
      if (a.reason != b.reason) {
        ++differ;
      } else if (a.ok()) {
        ++present;
        const auto s = law.stiffness(c.e, b.value);
        const double kappa = std::max(1e-12, 16 * rounding_of_request(s, b.value, c.e.gap, true));
        error.add(std::abs(a.value.force - b.value.force) / (2 * kappa * std::abs(b.value.force)));
      }
    }
  }
  MESSAGE(present << " of " << steps << " steps with a bridge; worst difference over its tolerance " << error.value);
  CHECK(differ == 0);
  CHECK(error.value <= 1);
}

TEST_CASE("more nodes change nothing beyond 1e-12: ten are enough on random bridges") {
  random_pairs random(15);
  worst_of error;
  for (int i = 0; i < 20000; ++i) {
    const auto c = random.next();
    const auto law = law_of(c.theta1, c.theta2);
    const auto coarse = law.bridge(c.e, given_volume<double>{c.volume});
    const auto fine = law_of<24>(c.theta1, c.theta2).bridge(c.e, given_volume<double>{c.volume});
    CHECK(coarse.reason == fine.reason);
    if (coarse.ok() && fine.ok()) {
      const auto s = law.stiffness(c.e, fine.value);
      const double kappa = std::max(1e-12, 16 * rounding_of_request(s, fine.value, c.e.gap, true));
      const double parts = 2 * pi<double> * std::max(fine.value.contact1, fine.value.contact2);
      error.add(std::abs(coarse.value.force - fine.value.force) / (kappa * std::abs(fine.value.force) + 1e-14 * parts));
    }
  }
  MESSAGE("worst difference over its tolerance " << error.value);
  CHECK(error.value <= 1);
}

TEST_CASE("float agrees with double to 1e-5 where the request's rounding allows, long double to its own digits") {
  random_pairs random(16);
  worst_of single;
  worst_of extended;
  for (int i = 0; i < 5000; ++i) {
    const auto c = random.next();
    const edge<float> narrow{1.0F, static_cast<float>(c.e.radius2), static_cast<float>(c.e.gap), {0, 0, 1}};
    const float volume = static_cast<float>(c.volume);
    const edge<double> e{1.0, static_cast<double>(narrow.radius2), static_cast<double>(narrow.gap), {0, 0, 1}};
    const auto law = law_of(c.theta1, c.theta2);
    const auto f = law.bridge(narrow, given_volume<float>{volume});
    const auto d = law.bridge(e, given_volume<double>{static_cast<double>(volume)});
    CHECK(f.reason == d.reason);
    if (d.ok() && f.ok()) {
      single.add(std::abs(static_cast<double>(f.value.force) / d.value.force - 1));
    }
    if (i < 1000 && d.ok()) {
      const edge<long double> wide{1.0L, c.e.radius2, c.e.gap, {0, 0, 1}};
      const auto one = law_of<20>(c.theta1, c.theta2).bridge(wide, given_volume<long double>{c.volume});
      const auto two = law_of<28>(c.theta1, c.theta2).bridge(wide, given_volume<long double>{c.volume});
      CHECK(one.reason == two.reason);
      if (one.ok() && two.ok()) {
        const auto s = law.stiffness(e, d.value);
        const double kappa = std::ldexp(rounding_of_request(s, d.value, c.e.gap, true), -11);
        const auto parts = static_cast<long double>(2 * pi<double> * std::max(d.value.contact1, d.value.contact2));
        extended.add(static_cast<double>(
            std::abs(one.value.force - two.value.force) /
            ((1e-17L + 32 * static_cast<long double>(kappa)) * std::abs(two.value.force) + 1e-18L * parts)));
      }
    }
  }
  MESSAGE("float " << single.value << "; long double over 1e-17 + 32 roundings of the request " << extended.value);
  CHECK(single.value < 1e-5);
  CHECK(extended.value <= 1);
}
