// SPDX-License-Identifier: BSD-3-Clause
#include "support/lattice_throats.hpp"
#include "support/sanitized.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace lattice_throats;

TEST_CASE("brackets that start 30 % too low and 30 % too high end overlapping") {
  const entry_set_up s = equal_spheres(0.4, 2);
  const entry_result low = found(s, 0.7 * 0.7, 1.3 * 0.7, 0.1, 1.3);
  CHECK(low.end == search_end::converged);
  CHECK(low.upper - low.lower <= 0.1 * (low.upper + low.lower) / 2 * (1 + 1e-9));
  CHECK(low.discretisation == doctest::Approx(0.2));  // 0.05 (4 / 2)²: what was seen at 2 nodes is 0.14
  CHECK(low.updates > 0);
  CHECK(low.film == film_status::unresolved);
  if (!sanitized) {
    const entry_result high = found(s, 0.7 * 1.3, 1.3 * 1.3, 0.1, 1.3);
    CHECK(high.end == search_end::converged);
    CHECK(low.lower < high.upper);
    CHECK(high.lower < low.upper);
  }
}

TEST_CASE("the film is resolved at four nodes, and there is none where liquid does not wet") {
  entry_experiment<float> e(equal_spheres(0.4, 4));
  search_options o = e.bracket(0.75);
  o.most_widenings = 0;
  threshold_search search(o);
  CHECK(e.result(search).film == film_status::unknown);
  const hold_report r = e.hold(search.next());
  REQUIRE(r.end == hold_end::stable);
  CHECK(r.film > 0.3);
  search.take(r);
  CHECK(e.result(search).film == film_status::resolved);
  entry_set_up partly = equal_spheres(0.4, 4);
  partly.contact_angle = 0.7;
  CHECK(entry_experiment<float>(partly).result(search).film == film_status::none);
}

TEST_CASE("at 40 degrees two nodes give the entry pressure of Surface Evolver within the error stated") {
  entry_set_up s = equal_spheres(0.2, 2);  // which the correction was not calibrated on
  s.contact_angle = 40 * pi<double> / 180;
  entry_experiment<float> e(s);
  const double width = sanitized ? 0.1 : 0.03;
  threshold_search search(e.bracket(1, width));
  run(e, search);
  const entry_result r = e.result(search);
  REQUIRE(r.end == search_end::converged);
  CHECK(r.discretisation == doctest::Approx(0.09));
  CHECK(std::abs(r.value / 4.746 - 1) <= r.discretisation + width / 2);  // tests/truth/se_results.csv
}

TEST_CASE("a wetting side holds gas back that a mirror lets across the gap, by as much as the plane tells") {
  // What a gas touches costs energy at a wetting side and nothing at a mirror: the entry pressure cannot fall. Gas that
  // may cross all gaps of 0.4 R but one enters at 1.089 times the pressure, by arcs and lines.
  entry_set_up s = equal_spheres(0.4, 2);
  const double mirrors_plane = plane_entry_of(s.throat, s.sides).best;
  s.sides[1] = prism_side::wetting;
  entry_experiment<float> e(s);
  CHECK(e.plane().best / mirrors_plane == doctest::Approx(1.089).epsilon(1e-3));
  CHECK(e.correction() == 1);
  const double width = 0.05;
  threshold_search search(e.bracket(1, width));
  run(e, search);
  const entry_result wet = e.result(search);
  REQUIRE(wet.end == search_end::converged);
  CHECK(std::isnan(wet.discretisation));
  if (sanitized) {
    return;
  }
  s.sides = {};
  entry_experiment<float> mirrored(s);
  threshold_search mirror_search(mirrored.bracket(1, width));
  run(mirrored, mirror_search);
  const entry_result mirrors = mirrored.result(mirror_search);
  REQUIRE(mirrors.end == search_end::converged);
  CHECK(wet.lower > mirrors.upper);
  const double ratio = (wet.lower + wet.upper) / (mirrors.lower + mirrors.upper);
  // half of either bracket, and 1.5 % by which either scatters when the lattice shifts against the throat
  CHECK(ratio * mirrors_plane / e.plane().best == doctest::Approx(1).epsilon(width + 0.03));
}

TEST_CASE("sides that leave the reservoir no room are refused") {
  entry_set_up s = equal_spheres(0.4, 2);
  s.sides = {prism_side::wetting, prism_side::wetting, prism_side::wetting};
  CHECK_THROWS_WITH_AS(entry_experiment<float>{s},
                       doctest::Contains("nodes away from grains and wetting sides: a finer lattice"), parameter_error);
}

TEST_CASE("a pair that nobody has measured is measured, and refused where it is not as claimed") {
  entry_set_up s = equal_spheres(0.4, 2);
  s.pair.attraction = 0.4;  // below the critical strength
  CHECK_THROWS_WITH_AS(entry_experiment<float>{s}, doctest::Contains("a phase dissolved"), parameter_error);
  s.pair.attraction = 2.6;  // the table ends at 2.4
  CHECK_THROWS_WITH_AS(entry_experiment<float>{s}, doctest::Contains("as measured"), parameter_error);
  if (sanitized) {
    return;
  }
  const auto pair = measure_pair<mixture<d3q19, bgk>>(2.6, 1);
  REQUIRE(pair.ok());
  s.pair = pair.value;
  CHECK_NOTHROW(entry_experiment<float>{s});
  s.pair.surface_tension *= 1.03;
  CHECK_THROWS_AS(entry_experiment<float>{s}, parameter_error);
  const auto known = measure_pair<mixture<d3q19, bgk>>(2.1, 1.5);  // its bubbles have 6 % more tension than its plane
  REQUIRE(known.ok());
  CHECK_NOTHROW(check_pair<mixture<d3q19, bgk>>(known.value, 1.5));
}

TEST_CASE("a throat that the lattice does not resolve is refused") {
  CHECK_THROWS_WITH_AS(entry_experiment<float>(equal_spheres(0.4, 1.5)),
                       "throat: found an inscribed circle of 1.5 nodes, expected a radius of 2 or more: films and "
                       "interfaces are as wide",
                       parameter_error);
}

TEST_CASE("reservoirs of densities that do not belong together are named") {
  entry_set_up s = equal_spheres(0.4, 4);
  s.pair.common = 4;  // no densities go with it
  entry_experiment<float> none(s);
  CHECK(none.hold(none.lattice_pressure(none.plane().best)).end == hold_end::dissolved);
  CHECK(std::isnan(entry_error(4, 0.1)));
  CHECK(std::isnan(entry_error(4, 1.1)));
  CHECK(entry_correction(4, 0.1) == 1);
  entry_set_up wrong = equal_spheres(0.4, 4);
  wrong.pair.factor = 1.9;  // 1.995 was measured
  CHECK_THROWS_AS(entry_experiment<float>{wrong}, parameter_error);
}
