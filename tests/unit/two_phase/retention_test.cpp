// SPDX-License-Identifier: BSD-3-Clause
#include "support/graph_network.hpp"
#include "support/random_rules.hpp"

#include "tetrapore/two_phase/interfacial_area.hpp"
#include "tetrapore/two_phase/retention_curve.hpp"
#include "tetrapore/two_phase/van_genuchten.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace {

using namespace tetrapore;

struct given_rule {
  static constexpr bool depends_on_state = false;
  std::vector<double> thresholds;

  [[nodiscard]] threshold_outcome threshold(const network&, const two_phase_state&, throat_id t) const {
    return {bracket<double>::exactly(thresholds[t.index()]), entry_status::ok};
  }
  void settle(const network&, const two_phase_state&, std::span<const throat_id>) const {}
  void touched_by(const network&, const two_phase_state&, pore_id, std::vector<throat_id>&) const {}
};

network chain() {
  return graph_network({{1, {face::y_max}}, {1}, {2, {face::x_min}}, {3}, {4, {face::x_min}}, {1, {face::y_min}}},
                       {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}});
}

}  // namespace

TEST_CASE("a retention curve has one point per level and is a staircase") {
  const network net = chain();
  given_rule rule{{3, 4, 2, 5, 4}};
  drainage invasion(net, rule);
  invasion.run();
  const retention_curve curve(invasion);
  REQUIRE(curve.points().size() == 3);
  CHECK(curve.initial_saturation() == doctest::Approx(1));
  CHECK(curve.points()[0].saturation == doctest::Approx(0.9));
  CHECK(curve.points()[0].interior_saturation == doctest::Approx(0.75));
  CHECK(curve.points()[1].saturation == doctest::Approx(0.4));
  CHECK(curve.points()[1].events == 3);
  CHECK(curve.points()[2].saturation == 0);
  CHECK(curve.pressure_at(0.95) == 3.0);
  CHECK(curve.pressure_at(0.5) == 4.0);
  CHECK(curve.pressure_at(0.0) == 5.0);
  CHECK(curve.interior_pressure_at(0.5) == 4.0);
  CHECK(curve.end_saturation() == 0);
}

TEST_CASE("a curve that ends above a saturation has no pressure there") {
  const network net = chain();
  given_rule rule{{3, 4, 2, 5, 4}};
  drainage invasion(net, rule);
  invasion.step();
  const retention_curve curve(invasion);
  CHECK(!curve.pressure_at(0.5).has_value());
  CHECK(curve.end_saturation() == doctest::Approx(0.9));
}

TEST_CASE("a throat without a value stops the gas, and is counted by its reason") {
  struct broken_rule : given_rule {
    [[nodiscard]] threshold_outcome threshold(const network& net, const two_phase_state& state, throat_id t) const {
      if (t == throat_id(2)) {
        return {bracket<double>::exactly(quiet_nan<double>), entry_status::not_converged};
      }
      return given_rule::threshold(net, state, t);
    }
  };
  const network net = chain();
  broken_rule rule{{{3, 4, 2, 5, 4}}};
  drainage invasion(net, rule, {.trap = trapping::none});
  CHECK(invasion.without_value()[entry_status::not_converged] == 0);
  invasion.run();
  CHECK(invasion.events().size() == 2);
  CHECK(invasion.without_value()[entry_status::not_converged] == 1);
  CHECK(invasion.without_value().of(verdict::failed) == 1);
  CHECK(invasion.without_value().of(verdict::ok) == 0);
}

TEST_CASE("a curve on which nothing drained has no law to fit, and the fit says so") {
  const network net = chain();
  given_rule rule{{3, 4, 2, 5, 4}};
  const drainage invasion(net, rule);
  const retention_curve curve(invasion);
  CHECK(curve.end_saturation() == 1);
  CHECK(fit_van_genuchten(curve).reason == fit_status::invalid_input);
}

TEST_CASE("saturation falls and pressure rises along every curve") {
  std::mt19937 random(8);
  for (int k = 0; k < 200; ++k) {
    const network net = random_graph(random);
    random_state_rule rule(net, random);
    drainage invasion(net, rule);
    invasion.run();
    const retention_curve curve(invasion);
    double pressure = 0;
    double s = curve.initial_saturation();
    for (const retention_point& p : curve.points()) {
      CHECK(p.pressure > pressure);
      CHECK(p.saturation <= s);
      pressure = p.pressure;
      s = p.saturation;
    }
    CHECK(curve.end_saturation() == doctest::Approx(saturation(net, invasion.state())).epsilon(1e-13));
  }
}

TEST_CASE("the fit recovers the parameters of a van Genuchten curve") {
  double worst = 0;
  for (const double n : {1.2, 1.5, 2.0, 4.0, 10.0, 40.0}) {
    for (const double alpha : {1e-5, 0.03, 1.0, 700.0}) {
      for (const double residual : {0.0, 0.2}) {
        const van_genuchten truth{alpha, n, residual};
        std::vector<retention_sample> samples;
        for (int k = 1; k < 100; ++k) {
          const double se = 1 - 0.01 * k;
          const double p = std::pow(std::pow(se, -n / (n - 1)) - 1, 1 / n) / alpha;
          samples.push_back({p, residual + (1 - residual) * se});
          CHECK(truth.saturation(p) == doctest::Approx(samples.back().saturation).epsilon(1e-12));
        }
        const auto fit = fit_van_genuchten(samples, residual);
        REQUIRE(fit.ok());
        worst = std::max({worst, std::abs(fit.value.law.alpha / alpha - 1), std::abs(fit.value.law.n / n - 1)});
        CHECK(fit.value.rms < 1e-10);
      }
    }
  }
  CHECK(worst < 1e-8);
  MESSAGE("worst relative error of a parameter " << worst);
}

TEST_CASE("the fit is the least of its neighbourhood on a curve that is no van Genuchten curve") {
  std::vector<retention_sample> samples;
  for (int k = 1; k < 60; ++k) {
    samples.push_back({3.0 + 0.05 * k + 0.4 * std::sin(k), 1 - k / 60.0});
  }
  const auto fit = fit_van_genuchten(samples, 0.0);
  REQUIRE(fit.ok());
  const auto rms = [&](double alpha, double n) {
    const van_genuchten law{alpha, n, 0};
    double sum = 0;
    for (const auto& s : samples) {
      sum += std::pow(law.saturation(s.pressure) - s.saturation, 2);
    }
    return std::sqrt(sum / static_cast<double>(samples.size()));
  };
  const auto& [alpha, n, residual] = fit.value.law;
  CHECK(rms(alpha, n) == doctest::Approx(fit.value.rms).epsilon(1e-12));
  for (const double f : {0.99, 1.01}) {
    CHECK(rms(alpha * f, n) > fit.value.rms);
    CHECK(rms(alpha, n * f) > fit.value.rms);
  }
}

TEST_CASE("the fit refuses what it cannot use") {
  CHECK(fit_van_genuchten(std::vector<retention_sample>{{1, 0.9}, {2, 0.5}}, 0.0).reason == fit_status::too_few_points);
  CHECK(fit_van_genuchten(std::vector<retention_sample>{{1, 0.9}, {1, 0.5}, {1, 0.2}}, 0.0).reason ==
        fit_status::too_few_points);
  CHECK(fit_van_genuchten(std::vector<retention_sample>{{1, 0.9}, {2, 0.5}, {-3, 0.2}}, 0.0).reason ==
        fit_status::invalid_input);
  CHECK(fit_van_genuchten(std::vector<retention_sample>{{1, 0.9}, {2, 0.5}, {3, 0.2}}, 1.0).reason ==
        fit_status::invalid_input);
}

TEST_CASE("a meniscus is flat at no pressure and half a sphere at entry, for a wetting liquid") {
  const network net = chain();
  given_rule rule{{3, 4, 2, 5, 4}};
  drainage invasion(net, rule, {.trap = trapping::none});
  const double a = 2.0 / 3.0;
  const auto flat = interfacial_area(net, invasion.state(), rule, 1.0);
  CHECK(flat.menisci == 1);
  CHECK(flat.area == doctest::Approx(pi<double> * a * a));
  invasion.step();
  // Now at p = 3 before a throat of 4: a = 0.5, sphere of radius 2/3.
  const auto bulged = interfacial_area(net, invasion.state(), rule, 1.0);
  const double R = 2.0 / 3.0;
  CHECK(bulged.area == doctest::Approx(2 * pi<double> * R * (R - std::sqrt(R * R - 0.25))));
  invasion.run();
  // The outlet: a throat of 4 at p = 5 has been passed; it counts as half a sphere.
  const auto outlet = interfacial_area(net, invasion.state(), rule, 1.0);
  CHECK(outlet.passed == 1);
  CHECK(outlet.area == doctest::Approx(2 * pi<double> * 0.25));
}
