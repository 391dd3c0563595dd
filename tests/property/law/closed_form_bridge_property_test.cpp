// SPDX-License-Identifier: BSD-3-Clause
#include "support/dual.hpp"
#include "tetrapore/law/bridge.hpp"
#include "tetrapore/law/bridge/closed_forms.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <type_traits>

using namespace tetrapore;

namespace {

constexpr double degree = pi<double> / 180;

/// Every closed form for one contact angle, each called with the function.
template <class F>
void each_form(double angle, const F& f) {
  f("willett", willett<>{.surface_tension = 0.07, .contact_angle = angle});
  f("willett_small", willett_small<>{.surface_tension = 0.07, .contact_angle = angle});
  f("lambert", lambert<>{.surface_tension = 0.07, .contact_angle = angle});
  f("rabinovich", rabinovich<>{.surface_tension = 0.07, .contact_angle = angle});
  f("soulie", soulie<>{.surface_tension = 0.07, .contact_angle = angle});
  f("weigert_ripperger", weigert_ripperger<>{.surface_tension = 0.07, .contact_angle = angle});
  f("mikami", mikami<>{.surface_tension = 0.07});
  f("toroid", toroid<>{.surface_tension = 0.07, .contact_angle1 = angle, .contact_angle2 = angle});
}

template <std::floating_point T>
edge<T> as(const edge<double>& e) {
  return {static_cast<T>(e.radius1), static_cast<T>(e.radius2), static_cast<T>(e.gap), {}};
}

struct random_requests {
  std::mt19937_64 random{5};
  std::uniform_real_distribution<double> uniform{0, 1};
  edge<double> e{};
  double volume = 0;
  double angle = 0;

  void next() {
    const double size = std::pow(10, 2 * uniform(random) - 4);
    const double kind = uniform(random);
    const double ratio = kind < 0.4 ? 1 : kind < 0.8 ? 0.2 + 0.8 * uniform(random) : infinity<double>;
    const double reduced = std::pow(10, -5 + 4.5 * uniform(random));
    e = {size, size * ratio, 0, {0, 0, 1}};
    const double radius = detail::derjaguin_radius(e);
    volume = reduced * radius * radius * radius;
    e.gap = uniform(random) < 0.2 ? 0 : 1.3 * uniform(random) * std::cbrt(volume);
    angle = 55 * degree * uniform(random);
  }
};

}  // namespace

TEST_CASE("a closed form answers ok with a finite force, absent with 0, and refuses with NaN") {
  random_requests q;
  int answered = 0;
  for (int i = 0; i < 20000; ++i) {
    q.next();
    each_form(q.angle, [&](const char* name, const auto& law) {
      CAPTURE(name);
      const auto a = law.bridge(q.e, given_volume<double>{q.volume});
      switch (a.kind()) {
        case verdict::ok:
          ++answered;
          CHECK(std::isfinite(a.value.force));
          break;
        case verdict::absent: CHECK(a.value.force == 0); break;
        case verdict::refused: CHECK(std::isnan(a.value.force)); break;
        case verdict::failed: FAIL_CHECK("a closed form failed"); break;
      }
    });
  }
  CHECK(answered > 50000);
}

TEST_CASE("a closed form is the same from either end, scales as tension times length, and as long double") {
  random_requests q;
  for (int i = 0; i < 3000; ++i) {
    q.next();
    each_form(q.angle, [&](const char* name, const auto& law) {
      CAPTURE(name);
      const auto a = law.bridge(q.e, given_volume<double>{q.volume});
      const edge<double> back{q.e.radius2, q.e.radius1, q.e.gap, -q.e.normal};
      const auto b = law.bridge(back, given_volume<double>{q.volume});
      const edge<double> large{1024 * q.e.radius1, 1024 * q.e.radius2, 1024 * q.e.gap, q.e.normal};
      const auto c = law.bridge(large, given_volume<double>{0x1p30 * q.volume});
      const auto d = law.bridge(as<long double>(q.e), given_volume<long double>{q.volume});
      CHECK(a.reason == b.reason);
      if (a.ok() && b.ok() && c.ok() && d.ok()) {
        CHECK(b.value.force == doctest::Approx(a.value.force).epsilon(1e-9));
        CHECK(c.value.force == doctest::Approx(1024 * a.value.force).epsilon(1e-9));
        CHECK(static_cast<double>(d.value.force) == doctest::Approx(a.value.force).epsilon(1e-9));
      }
    });
  }
}

TEST_CASE(
    "the toroid of unequal angles is the same from either end, a plane first or second, its two sides exchanged") {
  random_requests q;
  int planes = 0;
  const auto same = [&](const auto& a, const auto& b) {
    CHECK(a.reason == b.reason);
    if (!a.ok()) {
      return;
    }
    planes += q.e.with_plane() ? 1 : 0;
    const auto& [force, volume, suction, neck, arc, filling1, filling2, contact1, contact2] = a.value;
    CHECK(b.value.force == doctest::Approx(force).epsilon(1e-7));
    CHECK(b.value.volume == doctest::Approx(volume).epsilon(1e-7));
    CHECK(b.value.filling1 == doctest::Approx(filling2).epsilon(1e-7));
    CHECK(b.value.filling2 == doctest::Approx(filling1).epsilon(1e-7));
    CHECK(b.value.contact1 == doctest::Approx(contact2).epsilon(1e-7));
    CHECK(b.value.contact2 == doctest::Approx(contact1).epsilon(1e-7));
  };
  for (int i = 0; i < 3000; ++i) {
    q.next();
    const double other = 50 * degree * q.uniform(q.random);
    const toroid<> law{.surface_tension = 0.07, .contact_angle1 = q.angle, .contact_angle2 = other};
    const toroid<> turned{.surface_tension = 0.07, .contact_angle1 = other, .contact_angle2 = q.angle};
    const edge<double> back{q.e.radius2, q.e.radius1, q.e.gap, -q.e.normal};
    const auto a = law.bridge(q.e, given_volume<double>{q.volume});
    same(a, turned.bridge(back, given_volume<double>{q.volume}));
    if (a.ok()) {
      const given_suction<double> tied{a.value.suction};
      same(law.bridge(q.e, tied), turned.bridge(back, tied));
    }
  }
  CHECK(planes > 300);
}

TEST_CASE("a plane may come first: the same force or the same reason, and two planes are no pair") {
  const edge<double> behind{1e-3, infinity<double>, 1e-5, {0, 0, 1}};
  const edge<double> first{infinity<double>, 1e-3, 1e-5, {0, 0, -1}};
  const edge<double> planes{infinity<double>, infinity<double>, 1e-5, {0, 0, 1}};
  const given_volume<double> liquid{1e-11};
  const auto see = [&](const char* name, const auto& law) {
    CAPTURE(name);
    const auto a = law.bridge(behind, liquid);
    const auto b = law.bridge(first, liquid);
    CHECK(a.reason == b.reason);
    CHECK((a.reason == bridge_status::ok || a.reason == bridge_status::not_covered));
    CHECK(std::isnan(a.value.force) == std::isnan(b.value.force));
    CHECK((!a.ok() || b.value.force == doctest::Approx(a.value.force).epsilon(1e-12)));
    CHECK(law.bridge(planes, liquid).reason == bridge_status::invalid_input);
    CHECK(held_at_contact<std::decay_t<decltype(law)>>{law}.bridge(first, liquid).reason == a.reason);
  };
  each_form(20 * degree, see);
  see("Mikami's rupture", lambert<mikami_rupture>{.surface_tension = 0.07});
  see("exact", young_laplace<>{.surface_tension = 0.07});
  CHECK(young_laplace<>{.surface_tension = 0.07}.bridge(first, liquid).ok());
  CHECK(toroid<>{.surface_tension = 0.07}.bridge(first, liquid).ok());
}

TEST_CASE("as floats the closed forms agree to 1e-4") {
  random_requests q;
  for (int i = 0; i < 3000; ++i) {
    q.next();
    each_form(q.angle, [&](const char* name, const auto& law) {
      CAPTURE(name);
      const auto a = law.bridge(q.e, given_volume<double>{q.volume});
      const auto f = law.bridge(as<float>(q.e), given_volume<float>{static_cast<float>(q.volume)});
      if (a.ok() && f.ok()) {
        CHECK(static_cast<double>(f.value.force) == doctest::Approx(a.value.force).epsilon(1e-4));
      }
    });
  }
}

TEST_CASE("forms of the four operations and the root take dual numbers") {
  using number = dual<double>;
  const auto slope = [](const auto& law, double gap) {
    const edge<number> e{number(1), number(1), number(gap, 1), {}};
    return law.bridge(e, given_volume<number>{number(0.01)}).value.force.slope;
  };
  const auto difference = [](const auto& law, double gap) {
    const auto at = [&](double g) {
      return law.bridge(edge<double>{1, 1, g, {}}, given_volume<double>{0.01}).value.force;
    };
    return (at(gap + 1e-6) - at(gap - 1e-6)) / 2e-6;
  };
  for (const double gap : {0.01, 0.1, 0.15}) {
    CHECK(slope(lambert<>{1.0, 0.3}, gap) == doctest::Approx(difference(lambert<>{1.0, 0.3}, gap)).epsilon(1e-6));
    CHECK(slope(willett_small<>{1.0, 0.3}, gap) ==
          doctest::Approx(difference(willett_small<>{1.0, 0.3}, gap)).epsilon(1e-6));
    CHECK(slope(rabinovich<>{1.0, 0.3}, gap) == doctest::Approx(difference(rabinovich<>{1.0, 0.3}, gap)).epsilon(1e-6));
  }
}

TEST_CASE("bad input is refused as such by every closed form, no liquid is absent, an overlap is not covered") {
  const double nan = quiet_nan<double>;
  const double far = infinity<double>;
  const edge<double> good{1, 1, 0.01, {0, 0, 1}};
  each_form(0.2, [&](const char* name, const auto& law) {
    CAPTURE(name);
    const held_at_contact<std::remove_cvref_t<decltype(law)>> held{law};
    const auto reason = [&](double r1, double r2, double gap, double volume) {
      return law.bridge(edge<double>{r1, r2, gap, {}}, given_volume<double>{volume}).reason;
    };
    for (const double bad : {nan, 0.0, -1.0}) {
      CHECK(reason(bad, 1, 0, 0.01) == bridge_status::invalid_input);
      CHECK(reason(1, bad, 0, 0.01) == bridge_status::invalid_input);
    }
    CHECK(reason(far, far, 0, 0.01) == bridge_status::invalid_input);
    CHECK(reason(1, 1, nan, 0.01) == bridge_status::invalid_input);
    CHECK(reason(1, 1, far, 0.01) == bridge_status::invalid_input);
    CHECK(reason(1, 1, -1, 0.01) == bridge_status::invalid_input);
    for (const double bad : {nan, far, -1e-9}) {
      CHECK(reason(1, 1, 0.01, bad) == bridge_status::invalid_input);
    }
    CHECK(reason(1, 1, 0.01, 0) == bridge_status::no_liquid);
    CHECK(reason(1, 1, -0.01, 0.01) == bridge_status::not_covered);
    CHECK(held.bridge(edge<double>{1, 1, -0.01, {}}, given_volume<double>{0.01}).value.force ==
          law.bridge(edge<double>{1, 1, 0, {}}, given_volume<double>{0.01}).value.force);
    CHECK(held.bridge(edge<double>{1, 1, -1.5, {}}, given_volume<double>{0.01}).reason == bridge_status::invalid_input);
    CHECK(held.bridge(good, given_volume<double>{0.01}).value.force ==
          law.bridge(good, given_volume<double>{0.01}).value.force);
  });
  for (const double bad : {nan, -0.1, pi<double> / 2}) {
    CHECK(lambert<>{1.0, bad}.bridge(good, given_volume<double>{0.01}).reason == bridge_status::invalid_input);
    CHECK(toroid<>{1.0, 0.0, bad}.bridge(good, given_volume<double>{0.01}).reason == bridge_status::invalid_input);
    CHECK(toroid<>{1.0, bad, 0.0}.bridge(good, given_suction<double>{1.0}).reason == bridge_status::invalid_input);
  }
  for (const double bad : {nan, 0.0, -1.0, far}) {
    CHECK(lambert<>{bad, 0.1}.bridge(good, given_volume<double>{0.01}).reason == bridge_status::invalid_input);
    CHECK(toroid<>{bad}.bridge(good, given_suction<double>{1.0}).reason == bridge_status::invalid_input);
  }
  for (const double bad : {nan, far, -far}) {
    CHECK(toroid<>{1.0}.bridge(good, given_suction<double>{bad}).reason == bridge_status::invalid_input);
  }
}

TEST_CASE("a closed form refuses what its source does not cover") {
  const auto reason = [](const auto& law, double r2, double gap, double volume) {
    return law.bridge(edge<double>{1, r2, gap, {}}, given_volume<double>{volume}).reason;
  };
  const double plane = infinity<double>;
  CHECK(reason(willett<>{1.0}, 1, 0, 5e-4) == bridge_status::not_covered);
  CHECK(reason(willett<>{1.0}, 1, 0, 0.2) == bridge_status::not_covered);
  CHECK(reason(willett<>{1.0, 51 * degree}, 1, 0, 0.01) == bridge_status::not_covered);
  CHECK(reason(willett<>{1.0, 50 * degree}, 1, 0, 0.01) == bridge_status::ok);
  CHECK(reason(willett<>{1.0}, plane, 0, 0.01) == bridge_status::not_covered);
  CHECK(reason(willett_small<>{1.0}, plane, 0, 0.01) == bridge_status::not_covered);
  CHECK(reason(lambert<>{1.0}, plane, 0, 0.01) == bridge_status::ok);
  CHECK(reason(soulie<>{1.0}, 0.4, 0, 0.01) == bridge_status::not_covered);
  CHECK(reason(mikami<>{1.0}, 0.9, 0, 0.01) == bridge_status::not_covered);
  CHECK(reason(weigert_ripperger<>{1.0}, 0.9, 0, 0.01) == bridge_status::not_covered);
  CHECK(reason(weigert_ripperger<>{1.0}, 1, 0, 1e-5) == bridge_status::not_covered);
  CHECK(reason(toroid<>{1.0}, 1, 0, 10.0) == bridge_status::not_covered);
}

TEST_CASE("beyond the gap of its rule a bridge is ruptured; without a rule the formula goes on") {
  const edge<double> e{1, 1, 0.25, {}};
  const given_volume<double> liquid{0.01};
  CHECK(soulie<>{1.0}.bridge(e, liquid).reason == bridge_status::ruptured);
  CHECK(soulie<>{1.0}.bridge(e, liquid).value.force == 0);
  CHECK(soulie<without_rupture>{1.0}.bridge(e, liquid).ok());
  CHECK(soulie<mikami_rupture>{1.0}.bridge({1, 1, 0.206, {}}, liquid).ok());
  CHECK(soulie<mikami_rupture>{1.0}.bridge({1, 1, 0.208, {}}, liquid).reason == bridge_status::ruptured);
}
