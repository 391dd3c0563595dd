// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/entry_experiment.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

entry_set_up touching_spheres() {
  entry_set_up s;
  s.throat.add_disc({0, 0}, 1);
  s.throat.add_disc({2, 0}, 1);
  s.throat.add_disc({1, std::sqrt(3.0)}, 1);
  return s;
}

opening<double> between(double r1, double r2, double r3, double gap) {
  return opening_from_distances<double>(r1, r2, r3, r1 + r2 + gap, r1 + r3 + gap, r2 + r3 + gap).value;
}
std::array<prism_side, 3> wetting(unsigned bits) {
  std::array<prism_side, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] = (bits >> k & 1U) != 0 ? prism_side::wetting : prism_side::mirror;
  }
  return sides;
}

/// r F = 0 for three equal discs with a line from centre to centre at each gap, an arc in each of the six right angles
/// between disc and line.
double lined_pressure(double gap) {
  const double half = 1 + gap / 2;
  const auto excess = [&](double r) {
    const double turn = std::asin(r / (1 + r));
    const double foot = std::sqrt(1 + 2 * r);  // from the centre of a disc to where an arc ends on the line
    const double corner = 0.5 * (r * foot - turn - r * r * (pi<double> / 2 - turn));
    const double area = std::sqrt(3.0) * half * half - pi<double> / 2 - 6 * corner;
    const double around = 6 * r * (pi<double> / 2 - turn) + 3 * (pi<double> / 3 - 2 * turn) + 6 * (half - foot);
    return r * around - area;
  };
  double low = 1e-3;
  double high = (half * half - 1) / 2;  // beyond which arcs overlap on the line
  for (int k = 0; k < 100; ++k) {
    (excess((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  }
  return 2 / (low + high);
}

}  // namespace

TEST_CASE("wetting sides of touching grains change nothing in the plane: arcs end the gas before it sees them") {
  for (const auto& o : {between(1, 1, 1, 0), between(1, 0.7, 0.5, 0), between(1, 0.9, 0.3, 0)}) {
    const plane_entry mirrors = plane_entry_of(o, {});
    for (unsigned bits = 1; bits < 8; ++bits) {
      CHECK(plane_entry_of(o, wetting(bits)).best == doctest::Approx(mirrors.princen).epsilon(1e-13));
    }
  }
}

TEST_CASE("a wetting side never lowers the plane value, and three give arcs in all gaps or on the sides") {
  for (const double gap : {0.05, 0.2, 0.4, 0.55, 1.0, 2.0}) {
    for (const double angle : {0.0, 0.6}) {
      for (const double r : {1.0, 0.7}) {
        const auto o = between(1, 1, r, gap * r);
        for (unsigned bits = 0; bits < 8; ++bits) {
          for (unsigned k = 0; k < 3; ++k) {
            CAPTURE(gap);
            CAPTURE(bits);
            CHECK(plane_entry_of(o, wetting(bits), angle).best <=
                  plane_entry_of(o, wetting(bits | 1U << k), angle).best * (1 + 1e-12));
          }
        }
      }
    }
    const plane_entry all = plane_entry_of(between(1, 1, 1, gap), wetting(7));
    const bool bridged = gap < 0.5;  // an arc from grain to grain, the side behind it
    CHECK(all.best == doctest::Approx(bridged ? all.princen : lined_pressure(gap)).epsilon(1e-12));
  }
}

TEST_CASE("between three wetting sides, far from its grains, gas enters as into a triangular tube") {
  const double gap = 50;
  const double inscribed = (2 + gap) / (2 * std::sqrt(3.0));
  CHECK(plane_entry_of(between(1, 1, 1, gap), wetting(7)).best * inscribed ==
        doctest::Approx(1.7775601508).epsilon(1e-10));
}

TEST_CASE("a neck that cannot be fitted has no correction, and its first bracket is where it was") {
  entry_set_up s;
  s.throat = between(1, 1, 0.1, 0);
  s.nodes_per_length = 2 / plane_entry_of(s.throat, s.sides).inscribed;
  const entry_experiment<float> through(s);  // the large grains reach through the sides opposite to them
  CHECK(entry_calibrated(s));
  CHECK_FALSE(through.throat().fitted());
  CHECK(through.correction() == 1);
  const threshold_search search(through.bracket());
  CHECK(std::isnan(through.result(search).discretisation));
  CHECK(search.value() ==
        doctest::Approx(through.lattice_pressure(through.plane().best) / entry_correction(2)).epsilon(1e-12));
  s.throat = between(1, 1, 1, 0);
  s.nodes_per_length = 2 / plane_entry_of(s.throat, s.sides).inscribed;
  const entry_experiment<float> apart(s);
  CHECK(apart.throat().fitted());
  CHECK(apart.correction() == entry_correction(apart.inscribed()));
}

TEST_CASE("correction and error hold for the set-up that they were measured with and for no other") {
  entry_set_up s = touching_spheres();
  CHECK(entry_calibrated(s));
  s.halved = false;
  s.contact_angle = 0.3;
  s.nodes_per_length = 40;
  s.most_nodes = 5;
  CHECK(entry_calibrated(s));
  const auto not_with = [](auto change) {
    entry_set_up other = touching_spheres();
    change(other);
    return !entry_calibrated(other);
  };
  CHECK(not_with([](entry_set_up& o) { o.retraction = 1.1; }));
  CHECK(not_with([](entry_set_up& o) { o.tau = 0.7; }));
  CHECK(not_with([](entry_set_up& o) { o.gas_share = 1; }));
  CHECK(not_with([](entry_set_up& o) { o.plug = 2; }));
  CHECK(not_with([](entry_set_up& o) { o.clear = 0.5; }));
  CHECK(not_with([](entry_set_up& o) { o.fitted = false; }));
  CHECK(not_with([](entry_set_up& o) { o.sides[2] = prism_side::wetting; }));
  CHECK(not_with([](entry_set_up& o) { o.pair.attraction = 2; }));
  CHECK(not_with([](entry_set_up& o) { o.pair.main = 0.98; }));
  CHECK(not_with([](entry_set_up& o) { o.pair.factor *= 1.01; }));
  CHECK(not_with([](entry_set_up& o) { o.pair.common = 0.4; }));
  CHECK(not_with([](entry_set_up& o) { o.pair.surface_tension *= 1.01; }));
  CHECK(!entry_calibrated<mixture<d3q19, trt>>(touching_spheres()));
  CHECK(!entry_calibrated<mixture<d3q19, bgk, guo>>(touching_spheres()));
  CHECK(!entry_calibrated<mixture<d3q19, bgk, velocity_shift, exponential_potential>>(touching_spheres()));
}

TEST_CASE("the error stated covers what was found above 0 where the correction was not calibrated") {
  constexpr double degree = pi<double> / 180;
  CHECK(entry_error(5, 20 * degree) >= 0.042);  // gap 0.4 R
  CHECK(entry_error(3, 40 * degree) >= 0.063);  // touching
  CHECK(entry_error(4, 60 * degree) >= 0.0895);
  CHECK(entry_error(3) == doctest::Approx(0.08889).epsilon(1e-4));
}
