// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/entry_experiment.hpp"

#include <doctest/doctest.h>

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

}  // namespace

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
  CHECK(entry_error(4, 20 * degree) >= 0.052);  // gap 0.4 R
  CHECK(entry_error(6, 10 * degree) >= 0.048);  // gap 0.2 R
  CHECK(entry_error(2, 20 * degree) >= 0.051);  // touching
  CHECK(entry_error(4, 60 * degree) >= 0.0796);
  CHECK(entry_error(3, 60 * degree) >= 0.0564);
  CHECK(entry_error(3) == doctest::Approx(0.08889).epsilon(1e-4));
}
