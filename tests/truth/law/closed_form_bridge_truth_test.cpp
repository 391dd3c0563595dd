// SPDX-License-Identifier: BSD-3-Clause
#include "support/csv_table.hpp"
#include "support/shared_data.hpp"
#include "tetrapore/law/bridge.hpp"
#include "tetrapore/law/bridge/closed_forms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace tetrapore;

namespace {

constexpr double degree = pi<double> / 180;

/// A row of open_bridge.csv that is stable under its own control: σ = R₁ = 1.
struct row {
  edge<double> e;
  double angle1, angle2, volume, suction, force, rupture;
  bool by_volume;
};

template <class F>
void each_stable_row(const csv_table& t, const F& f) {
  for (std::size_t i = 0; i < t.size(); ++i) {
    const bool by_volume = t.text(i, "control") == "V";
    if (t.text(i, by_volume ? "stable_V" : "stable_p") != "1") {
      continue;
    }
    CAPTURE(i);
    const double radius2 = t.text(i, "R2") == "inf" ? infinity<double> : t.number(i, "R2");
    f(row{{1, radius2, t.number(i, "D"), {0, 0, 1}},
          t.number(i, "theta1_deg") * degree,
          t.number(i, "theta2_deg") * degree,
          t.number(i, "V"),
          t.number(i, "pc"),
          t.number(i, "F"),
          t.number(i, "D_rupt"),
          by_volume});
  }
}

struct tally_of_errors {
  double worst = 0;
  int answered = 0;
  void add(double error) {
    worst = std::max(worst, error);
    ++answered;
  }
};

/// Worst relative error of a form for one angle on the rows up to 0.9 of the rupture gap.
template <class Make>
tally_of_errors worst_of(const csv_table& t, const Make& make, double least_v = 1e-3) {
  tally_of_errors all;
  each_stable_row(t, [&](const row& r) {
    const double radius = detail::derjaguin_radius(r.e);
    if (!r.by_volume || r.angle1 != r.angle2 || r.e.gap > 0.9001 * r.rupture ||
        r.volume < 0.999 * least_v * radius * radius * radius || r.angle1 > 50.1 * degree) {
      return;
    }
    const auto a = make(r.angle1).bridge(r.e, given_volume<double>{r.volume});
    CHECK(a.kind() != verdict::failed);
    if (a.ok()) {
      all.add(std::abs(a.value.force / r.force - 1));
    }
  });
  return all;
}

}  // namespace

TEST_CASE("on the stable rows of open_bridge.csv each closed form keeps the error it states") {
  const csv_table t(test_file("truth/open_bridge.csv"));
  using none = without_rupture;
  const auto check = [&](const std::string& name, double stated, int rows, const tally_of_errors& e) {
    CAPTURE(name);
    CHECK(e.worst <= stated);
    CHECK(e.answered >= rows);
    MESSAGE(name << ": worst " << e.worst << " of " << e.answered << " rows");
  };
  check("willett", 0.12, 20, worst_of(t, [](double a) { return willett<none>{1.0, a}; }));
  check("willett_small", 0.70, 20, worst_of(t, [](double a) { return willett_small<none>{1.0, a}; }));
  check("willett_small, little liquid", 0.54, 40,
        worst_of(
            t,
            [](double a) {
              return willett_small<none>{1.0, a};
            },
            0));
  check("lambert", 0.75, 24, worst_of(t, [](double a) { return lambert<none>{1.0, a}; }));
  check("rabinovich", 2.03, 24, worst_of(t, [](double a) { return rabinovich<none>{1.0, a}; }));
  check("soulie", 1.00, 10, worst_of(t, [](double a) { return soulie<none>{1.0, a}; }));
  check("weigert_ripperger", 2.00, 2, worst_of(t, [](double a) { return weigert_ripperger<none>{1.0, a}; }));
  check("toroid", 0.09, 49,
        worst_of(
            t,
            [](double a) {
              return toroid<none>{1.0, a, a};
            },
            0));
}

TEST_CASE("the toroid finds stable bridges of unequal angles, and of given suction, to a third of their force") {
  const csv_table t(test_file("truth/open_bridge.csv"));
  tally_of_errors by_volume;
  tally_of_errors by_suction;
  each_stable_row(t, [&](const row& r) {
    const toroid<without_rupture> law{1.0, r.angle1, r.angle2};
    if (r.by_volume) {
      const auto a = law.bridge(r.e, given_volume<double>{r.volume});
      CHECK(a.kind() != verdict::failed);
      if (a.ok()) {
        by_volume.add(std::abs(a.value.force / r.force - 1));
      }
    } else {
      const auto a = law.bridge(r.e, given_suction<double>{r.suction});
      CHECK(a.kind() != verdict::failed);
      if (a.ok()) {
        by_suction.add(std::abs(a.value.force / r.force - 1));
      }
    }
  });
  CHECK(by_volume.worst < 0.36);
  CHECK(by_volume.answered > 160);
  CHECK(by_suction.worst < 0.34);
  CHECK(by_suction.answered > 130);
}

TEST_CASE("the rupture fits keep the errors they state on rupture_open.csv") {
  const csv_table t(test_file("truth/rupture_open.csv"));
  int rows = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double angle = t.number(i, "theta1_deg") * degree;
    if (t.text(i, "control") != "V" || t.text(i, "theta1_deg") != t.text(i, "theta2_deg") || angle > 50.1 * degree) {
      continue;
    }
    const double radius2 = t.text(i, "R2") == "inf" ? infinity<double> : t.number(i, "R2");
    const edge<double> e{1, radius2, 0, {}};
    const double radius = detail::derjaguin_radius(e);
    const double volume = t.number(i, "V");
    const double v = volume / (radius * radius * radius);
    if (v < 0.99e-6 || v > 0.1001) {
      continue;
    }
    CAPTURE(i);
    ++rows;
    const double fold = t.number(i, "D");
    const double willett_off = willett_rupture{}.gap(e, volume, angle) / fold - 1;
    const double lian_off = lian_rupture{}.gap(e, volume, angle) / fold - 1;
    if (radius2 == 1) {
      CHECK(willett_off == doctest::Approx(0.006).epsilon(0.033));
      CHECK(std::abs(lian_off) < 0.07);
      const double mikami_off = mikami_rupture{}.gap(e, volume, angle) / fold - 1;
      CHECK(mikami_off > -0.105);
      CHECK(mikami_off < 0.02);
    } else {
      CHECK(willett_off > -0.10);
      CHECK(willett_off < 0.025);
      CHECK(lian_off > -0.03);
      CHECK(lian_off < 0.40);
    }
    if (angle == 0) {
      CHECK(std::abs(willett_off) < (radius2 == 1 ? 0.006 : 0.035));
    }
  }
  CHECK(rows > 60);
}
