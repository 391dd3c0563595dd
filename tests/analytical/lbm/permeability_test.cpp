// SPDX-License-Identifier: BSD-3-Clause
//
// Permeability by lattice Boltzmann, of simple cubic spheres against Zick & Homsy (J. Fluid Mech. 115, 13, 1982).

#include "support/sanitized.hpp"
#include "tetrapore/lbm/permeability.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

periodic_spheres simple_cubic(double fraction) {
  const double radius = std::cbrt(3 * fraction / (4 * std::numbers::pi));
  return {{1, 1, 1}, {{{0, 0, 0}, radius}}, {false, true, true}};
}

bool refused(const periodic_spheres& p, int nodes, std::size_t axis, const permeability_options& how = {}) {
  try {
    (void)measure_permeability(p, nodes, axis, how);
  } catch (const parameter_error&) {
    return true;
  }
  return false;
}

}  // namespace

TEST_CASE("simple cubic spheres resist as Zick and Homsy say, and closer with more nodes") {
  // drag / (6πμaU) of three solid fractions; the lattice's error is first order, about one per width of a sphere
  for (const auto& [fraction, drag] : {std::array{0.343, 15.4}, std::array{0.45, 28.1}, std::array{0.5236, 42.1}}) {
    if (sanitized && fraction < 0.5) {
      continue;
    }
    const periodic_spheres p = simple_cubic(fraction);
    const double exact = 1 / (6 * std::numbers::pi * p.spheres[0].radius * drag);
    const auto k = measure_permeability(p, 24, 0);
    REQUIRE(k.ok());
    CHECK(std::abs(k.value.permeability / exact - 1) < 0.05);
    CHECK(std::abs(k.value.porosity - (1 - fraction)) < 0.01);
  }
}

TEST_CASE("permeability does not depend on the viscosity that it is measured with") {
  const periodic_spheres p = simple_cubic(0.45);
  const double reference = measure_permeability(p, 12, 0).value.permeability;
  for (const double tau : {0.6, 1.6}) {
    // what is left is how steady the flux is asked to be
    CHECK(measure_permeability(p, 12, 0, {.tau = tau}).value.permeability == doctest::Approx(reference).epsilon(1e-5));
  }
}

TEST_CASE("half of a box between mirrors and the whole of it have one permeability") {
  periodic_spheres p = simple_cubic(0.343);
  const double halved = measure_permeability(p, 12, 0).value.permeability;
  p.halved = {false, false, false};
  CHECK(measure_permeability(p, 12, 0).value.permeability == doctest::Approx(halved).epsilon(1e-9));
  CHECK(measure_permeability(p, 12, 2).value.permeability == doctest::Approx(halved).epsilon(1e-5));
}

TEST_CASE("a permeability that cannot be measured is refused, or said not to be steady") {
  periodic_spheres p = simple_cubic(0.343);
  CHECK(refused(p, 13, 0));  // half of an odd number of nodes
  CHECK(refused(p, 12, 1));  // along a halved axis
  CHECK(refused(p, 12, 3));
  CHECK(refused(p, 12, 0, {.tau = 0.5}));
  const auto cut = measure_permeability(p, 24, 0, {.cap = 100});
  CHECK(cut.reason == flow_status::still_changing);
  CHECK(cut.kind() == verdict::failed);
  CHECK(std::isnan(cut.value.permeability));
  p.spheres[0].radius = 2;
  CHECK(refused(p, 12, 0));  // no fluid left
  p.spheres[0].radius = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused(p, 12, 0));
}
