// SPDX-License-Identifier: BSD-3-Clause
#include "support/bridges.hpp"
#include "support/sanitized.hpp"

#include <doctest/doctest.h>

#include <array>
#include <optional>

using namespace bridges;

namespace {

constexpr int many = sanitized ? 1000 : 100000;
constexpr double rounding = 0x1p-53;

struct worst_of {
  double value = 0;
  void add(double x) { value = x > value || std::isnan(x) ? x : value; }
};

/// Requests of every kind: two spheres or a plane, equal or not, perfectly wetted or not, apart, in contact or pressed
/// together; volumes of 1e-8 to 1e3 of the cube of the smaller radius, suctions of either sign.
class random_requests {
 public:
  explicit random_requests(unsigned seed) : random_(seed) {}

  [[nodiscard]] request next() {
    const bool plane = uniform(0, 1) < 0.15;
    const bool equal = !plane && uniform(0, 1) < 0.3;
    const double r2 = plane ? infinity<double> : equal ? 1.0 : std::pow(10.0, uniform(-2, 1));
    const double theta1 = angle();
    const double theta2 = equal || uniform(0, 1) < 0.3 ? theta1 : angle();
    const double small = std::min(1.0, r2);
    const bool by_volume = uniform(0, 1) < 0.7;
    double value = 0;
    double size = small;
    if (by_volume) {
      value = std::pow(10.0, uniform(0, 1) < 0.95 ? uniform(-8, 0.5) : uniform(0.5, 3)) * small * small * small;
      size = 0.9 * std::cbrt(value);
    } else if (uniform(0, 1) < 0.85) {
      value = std::pow(10.0, uniform(-2, 4)) / small;
      size = std::min(0.9 / value, small);
    } else {
      value = -std::pow(10.0, uniform(-3, 0.5)) / small;
      size = 0.5 * small;
    }
    const double gap = uniform(0, 1) < 0.1 ? 0.0 : uniform(-0.02, 1) * size;
    return {{1.0, r2, gap, {0, 0, 1}}, theta1, theta2, by_volume, value};
  }

 private:
  random_pairs random_;

  [[nodiscard]] double uniform(double a, double b) { return random_.uniform(a, b); }
  [[nodiscard]] double angle() { return uniform(0, 1) < 0.25 ? 0.0 : radians(uniform(0, 85)); }
};

/// The same seen from the other end, and in another unit of length.
request exchanged(const request& q) {
  return {{q.pair.radius2, q.pair.radius1, q.pair.gap, {0, 0, -1}}, q.theta2, q.theta1, q.by_volume, q.value};
}
request scaled(const request& q, double by) {
  const auto& e = q.pair;
  return {{e.radius1 * by, e.radius2 * by, e.gap * by, e.normal},
          q.theta1,
          q.theta2,
          q.by_volume,
          q.by_volume ? q.value * by * by * by : q.value / by};
}

/// How many bridges of a kind of request there are, and how many are not.
struct tally_of_statuses {
  int of[8] = {};
  void add(bridge_status s) { ++of[static_cast<int>(s)]; }
  [[nodiscard]] int operator[](bridge_status s) const { return of[static_cast<int>(s)]; }
};

/// What the worst bridge of a kind shows, each error over what roundings can make of it.
struct relations {
  int bridges = 0;
  worst_of maxwell;
  worst_of chain;
  worst_of ends;
  worst_of gorge;
  worst_of exchange;
  worst_of homogeneity;
  worst_of controls;
};

/// Lengths and forces of a bridge by which errors count, at a surface tension of 1.
struct measures {
  double circle;   ///< the larger contact circle
  double size;     ///< of the liquid
  double parts;    ///< what balances in the force
  double steepen;  ///< what a relative error of the profile becomes in a derivative: 1 / distance to a fold
  measures(const meniscus<double>& m, const bridge_stiffness<double>& s)
      : circle(std::max(m.contact1, m.contact2)),
        size(std::max(circle, std::cbrt(std::abs(m.volume)))),
        parts(2 * pi<double> * circle),
        steepen(1 + (std::abs(s.force_by_gap_at_volume) + std::abs(s.force_by_gap_at_suction)) * size / parts) {}
};

/// \param back  the bridge seen from the other end
template <int Nodes>
void relate(const request& q, const meniscus<double>& m, const outcome<meniscus<double>, bridge_status>& back,
            relations& worst) {
  const auto law = law_of<Nodes>(q.theta1, q.theta2);
  const auto s = law.stiffness(q.pair, m);
  const measures of(m, s);
  ++worst.bridges;
  // dF/dg at V = dF/dg at p + (dF/dp)(dp/dg at V), where Maxwell's relation makes dF/dp = dV/dg at p
  const double coupled = s.volume_by_gap_at_suction * s.suction_by_gap_at_volume;
  const double stiff = std::abs(s.force_by_gap_at_volume) + std::abs(s.force_by_gap_at_suction) + std::abs(coupled);
  worst.maxwell.add(std::abs(s.force_by_gap_at_volume - s.force_by_gap_at_suction - coupled) /
                    (rounding * of.steepen * (stiff + 2 * pi<double>)));
  const double along = s.volume_by_suction * s.suction_by_gap_at_volume;
  worst.chain.add(std::abs(s.volume_by_gap_at_suction + along) /
                  (rounding * of.steepen * (std::abs(along) + of.size * of.size)));
  // F = 2πσ r sin(δ + θ) + πr² p at either circle, and at the gorge, where the profile is upright
  const double first = m.filling1 + q.theta1;
  const double second = m.filling2 + q.theta2;
  const auto force_at = [&](double r, double sine) { return pi<double> * r * (2 * sine + r * m.suction); };
  const double balance = of.parts * (1 + of.circle * std::abs(m.suction));
  worst.ends.add(std::abs(force_at(m.contact1, std::sin(first)) - m.force) / balance);
  worst.ends.add(std::abs(force_at(m.contact2, std::sin(second)) - m.force) / balance);
  if (first < pi<double> / 2 && second < pi<double> / 2) {
    worst.gorge.add(std::abs(force_at(m.neck, 1) - m.force) / (rounding * balance));
  }
  // the force again, twice as uncertain as the law states
  const double stated = 2 * std::max(1e-12, 16 * rounding_of_request(s, m, q.pair.gap, q.by_volume));
  const double uncertain = stated * std::abs(m.force) + 1e-14 * of.parts;
  const double centi = 0.01;
  if (const auto b = scaled(q, centi).bridge<Nodes>(); b.ok()) {
    worst.homogeneity.add(std::abs(b.value.force / centi - m.force) / uncertain);
  }
  if (back.ok()) {
    worst.exchange.add(std::abs(back.value.force - m.force) / uncertain);
  }
  // the other control: its value is known to its rounding, and to that of the parts where it all but vanishes
  if (m.volume > 0 && law.stable(q.pair, m, q.by_volume ? bridge_control::suction : bridge_control::volume)) {
    const request other{q.pair, q.theta1, q.theta2, !q.by_volume, q.by_volume ? m.suction : m.volume};
    const auto b = other.bridge<Nodes>();
    const double again = 2 * std::max(1e-12, 16 * rounding_of_request(s, m, q.pair.gap, !q.by_volume));
    const double flat = 64 * rounding * std::abs(s.volume_by_gap_at_suction) / of.circle;
    worst.controls.add(b.ok() ? std::abs(b.value.force - m.force) /
                                    (uncertain + again * std::abs(m.force) + flat + 1e-13 * of.parts)
                              : infinity<double>);
  }
}

/// More liquid than the cube of the smaller radius.
bool plenty(const request& q, double volume) {
  const double small = std::min(q.pair.radius1, q.pair.radius2);
  return volume > small * small * small;
}

}  // namespace

TEST_CASE("100,000 random requests: Maxwell's relation, force at ends and gorge, exchange, scale, both controls") {
  random_requests random(11);
  tally_of_statuses volume;
  tally_of_statuses suction;
  relations usual;
  relations much;
  worst_of nodes;
  int turned = 0;
  for (int i = 0; i < many; ++i) {
    const request q = random.next();
    const auto b = q.bridge();
    (q.by_volume ? volume : suction).add(b.reason);
    if (!b.ok() && i % 16 != 0) {
      continue;
    }
    const auto back = exchanged(q).bridge();
    turned += back.reason == b.reason ? 0 : 1;
    if (b.ok() && !plenty(q, b.value.volume)) {
      relate<10>(q, b.value, back, usual);
    } else if (b.ok() && i % 8 == 0) {
      const auto fine = q.bridge<24>();
      REQUIRE(fine.ok());
      relate<24>(q, fine.value, exchanged(q).bridge<24>(), much);
      const double circle = std::max(fine.value.contact1, fine.value.contact2);
      nodes.add(std::abs(b.value.force - fine.value.force) / (2 * pi<double> * circle + std::abs(fine.value.force)));
    }
  }
  using enum bridge_status;
  for (const auto* t : {&volume, &suction}) {
    MESSAGE((*t)[ok] << " bridges, " << (*t)[ruptured] + (*t)[lopsided] << " ruptured, " << (*t)[flooded]
                     << " flooded, " << (*t)[not_converged] << " not converged");
    CHECK((*t)[invalid_input] + (*t)[no_liquid] + (*t)[not_covered] == 0);
    CHECK((*t)[ok] > many / 10);
    CHECK((*t)[ruptured] > many / 200);
    CHECK((*t)[not_converged] == 0);
  }
  CHECK(turned == 0);
  for (const auto* r : {&usual, &much}) {
    MESSAGE(r->bridges << " bridges; Maxwell " << r->maxwell.value << " and chain " << r->chain.value
                       << " roundings, ends " << r->ends.value << ", gorge " << r->gorge.value
                       << " roundings, exchange " << r->exchange.value << ", homogeneity " << r->homogeneity.value
                       << ", controls " << r->controls.value);
    CHECK(r->maxwell.value <= 256);
    CHECK(r->chain.value <= 512);
    CHECK(r->ends.value <= 2e-13);
    CHECK(r->gorge.value <= 16);
    CHECK(r->exchange.value <= 1);
    CHECK(r->homogeneity.value <= 1);
    CHECK(r->controls.value <= 1);
  }
  CHECK(usual.bridges > many * 6 / 10);
  CHECK(much.bridges > many / 200);
  MESSAGE("with much liquid 10 nodes are off by " << nodes.value);
  CHECK(nodes.value < 1e-6);
}

namespace {

/// Work along a short stretch of the gap less what the energy gains, over what the roundings of both can make of it.
/// At a given suction the energy is that of the surfaces and p V. None where the bridge ends within the stretch.
template <int Nodes>
std::optional<double> defect_of_energy(const request& q) {
  const auto law = law_of<Nodes>(q.theta1, q.theta2);
  typename young_laplace<Nodes>::template warm_state<double> warm;
  const auto at = [&](double gap) {
    edge<double> e = q.pair;
    e.gap = gap;
    return q.by_volume ? law.bridge(e, given_volume<double>{q.value}, warm)
                       : law.bridge(e, given_suction<double>{q.value}, warm);
  };
  const auto energy = [&](double gap, const meniscus<double>& m) {
    edge<double> e = q.pair;
    e.gap = gap;
    return law.energy(e, m) + (q.by_volume ? 0 : m.suction * m.volume);
  };
  const auto middle = at(q.pair.gap);
  if (!middle.ok()) {
    return {};
  }
  const auto& m = middle.value;
  const double circle = std::max(m.contact1, m.contact2);
  const double small = std::min(q.pair.radius1, q.pair.radius2);
  double half = 1e-3 * std::min({std::abs(q.pair.gap) + 0.05 * circle, circle, small});
  for (int tries = 0; tries < 4; ++tries, half /= 16) {
    const double from = q.pair.gap - half;
    const double to = q.pair.gap + half;
    const double inner = std::sqrt(3.0 / 7) * half;
    const std::array b{at(from), at(q.pair.gap - inner), at(q.pair.gap + inner), at(to)};
    if (!b[0].ok() || !b[1].ok() || !b[2].ok() || !b[3].ok()) {
      continue;
    }
    // Lobatto's rule of 5 nodes; that of 3 says how many digits the length of the stretch can cost
    const double ends = b[0].value.force + b[3].value.force;
    const double work = half * (0.1 * ends + 49.0 / 90 * (b[1].value.force + b[2].value.force) + 32.0 / 45 * m.force);
    const double rough = half * (ends + 4 * m.force) / 3;
    const double parts = 2 * half * (2 * pi<double> * circle + std::abs(m.force));
    if (std::abs(work - rough) > 1e-7 * parts) {
      continue;
    }
    const auto a = law.areas(q.pair, m);
    const double size = a.liquid_gas + a.wetted1 + a.wetted2 + std::abs(m.suction * m.volume);
    const double gained = energy(to, b[3].value) - energy(from, b[0].value);
    return std::abs(gained - work) / (1e-13 * size + 1e-12 * parts);
  }
  return {};
}

}  // namespace

TEST_CASE("the force is the slope of the energy on 100,000 random requests, at a volume and at a suction") {
  random_requests random(12);
  worst_of usual;
  worst_of much;
  int checked = 0;
  for (int i = 0; i < many; ++i) {
    const request q = random.next();
    const bool large = q.by_volume ? plenty(q, q.value) : q.value < 0;
    if (large && i % 8 != 0) {
      continue;
    }
    if (const auto defect = large ? defect_of_energy<24>(q) : defect_of_energy<10>(q)) {
      ++checked;
      (large ? much : usual).add(*defect);
    }
  }
  MESSAGE(checked << " bridges; defect " << usual.value << ", with much liquid " << much.value);
  CHECK(checked > many * 6 / 10);
  CHECK(usual.value <= 1);
  CHECK(much.value <= 1);
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

TEST_CASE("the rupture gap is where the bridge ends, by the same way, on random pairs at a volume and at a suction") {
  std::mt19937_64 random(17);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  int slid = 0;
  int flooded = 0;
  for (int i = 0; i < (sanitized ? 100 : 3200); ++i) {
    const bool equal = i % 8 < 6;
    const bool by_volume = i % 8 < 5 || i % 8 == 6;
    const double r2 = equal ? 1.0 : uniform(0, 1) < 0.2 ? infinity<double> : std::pow(10.0, uniform(-2, 2));
    const double theta1 = uniform(0, 1) < 0.1 ? 0.0 : uniform(0, 89.9);
    const double theta2 = equal || uniform(0, 1) < 0.3 ? theta1 : uniform(0, 89.9);
    const double small = std::min(1.0, r2);
    const double value = by_volume              ? std::pow(10.0, uniform(-7, std::log10(30))) * small * small * small
                         : uniform(0, 1) < 0.75 ? std::pow(10.0, uniform(-2, 4)) / small
                                                : -std::pow(10.0, uniform(-3, 0.3)) / small;
    CAPTURE(r2);
    CAPTURE(theta1);
    CAPTURE(theta2);
    CAPTURE(value);
    const auto law = law_of(radians(theta1), radians(theta2));
    const edge<double> e{1.0, r2, 0.0, {0, 0, 1}};
    const auto limit =
        by_volume ? law.rupture_gap(e, given_volume<double>{value}) : law.rupture_gap(e, given_suction<double>{value});
    if (!by_volume && limit.reason == bridge_status::flooded) {
      CHECK(value < 0);
      ++flooded;
      continue;
    }
    REQUIRE(limit.ok());
    const bool slides = limit.value.end == bridge_end::lopsided;
    slid += slides ? 1 : 0;
    const auto at = [&](double gap) {
      return request{{1.0, r2, gap, {0, 0, 1}}, radians(theta1), radians(theta2), by_volume, value}.bridge().reason;
    };
    for (const double away : {1e-6, 1e-10}) {
      CHECK(at(limit.value.gap * (1 - away)) == bridge_status::ok);
      CHECK(at(limit.value.gap * (1 + away)) == (slides ? bridge_status::lopsided : bridge_status::ruptured));
    }
  }
  MESSAGE(slid << " slide, " << flooded << " flooded");
  CHECK(slid > (sanitized ? 20 : 1000));
  CHECK(flooded < (sanitized ? 10 : 100));
}
