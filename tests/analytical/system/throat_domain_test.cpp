// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "tetrapore/law/conductance/darcy.hpp"
#include "tetrapore/one_phase/permeability.hpp"
#include "tetrapore/packing/random_packing.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <doctest/doctest.h>

#include <array>
#include <random>
#include <vector>

using namespace tetrapore;

namespace {

struct sums {
  double volume = 0;
  std::vector<double> angle;
  std::array<double, 6> wall{};
};

sums of(const network& net) {
  sums s;
  s.angle.resize(net.grain_count());
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    if (net.is_boundary(t)) {
      continue;
    }
    const throat<double> shape = throat_at(net, t);
    const auto h = hydraulics_of(shape);
    REQUIRE(h.ok());
    s.volume += h.value.domain_volume;
    const auto slots = facet_slots(net, net.pores(t)[0], net.slot(t, 0));
    for (std::size_t k = 0; k < 3; ++k) {
      const vertex v = net.vertices(net.pores(t)[0])[slots[k]];
      if (v.is_wall()) {
        s.wall[static_cast<std::size_t>(v.wall())] += h.value.wetted_area[k];
      } else {
        const double r = shape.grains[k].radius;
        s.angle[v.grain().index()] += h.value.wetted_area[k] / (r * r);
      }
    }
  }
  return s;
}

std::vector<double> radii(std::size_t n) {
  std::vector<double> r(n);
  std::mt19937_64 random(4);
  for (double& x : r) {
    x = 0.6 + 0.8 * static_cast<double>(random() >> 11U) * 0x1p-53;
  }
  return r;
}

}  // namespace

TEST_CASE("the domains of all throats tile a periodic packing: volumes to the box, solid angles to 4π at each grain") {
  const packing p = random_packing(radii(150), {.solid_fraction = 0.55, .periodic = {true, true, true}, .seed = 2});
  const network net = compiled_triangulation{}(p.grains, domain_of(p)).net;
  const sums s = of(net);
  CHECK(s.volume == doctest::Approx(p.bounds->volume()).epsilon(1e-12));
  for (const double angle : s.angle) {
    CHECK(angle == doctest::Approx(4 * pi<double>).epsilon(1e-11));
  }
}

TEST_CASE("with walls: volumes to the box, solid angles to 4π, wetted areas of the walls to their faces") {
  const packing p = random_packing(radii(150), {.solid_fraction = 0.5, .seed = 3});
  const network net = compiled_triangulation{}(p.grains, domain_of(p)).net;
  const sums s = of(net);
  const vec3<double> size = p.bounds->size();
  CHECK(s.volume == doctest::Approx(p.bounds->volume()).epsilon(1e-12));
  for (const double angle : s.angle) {
    CHECK(angle == doctest::Approx(4 * pi<double>).epsilon(1e-11));
  }
  for (const face f : all_faces) {
    const double area = p.bounds->volume() / size[axis_of(f)];
    CHECK(s.wall[static_cast<std::size_t>(f)] == doctest::Approx(area).epsilon(1e-12));
  }
}

TEST_CASE("a network of Darcy's throats has the permeability that they were given, isotropic, whatever its grains") {
  const packing p = random_packing(radii(60), {.solid_fraction = 0.5, .periodic = {true, true, true}, .seed = 5});
  const network net = compiled_triangulation{}(p.grains, domain_of(p)).net;
  saturated_flow flow(net, darcy{.permeability = 3.0, .viscosity = 2.0}, multigrid_solver<>({.coarsest = 50}));
  const permeability_tensor k = tensor_of_permeability(flow, 2.0, {.tolerance = 1e-12});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CHECK(k.reports[axis].ok());
    for (std::size_t other = 0; other < 3; ++other) {
      CHECK(std::abs(k(axis, other) - (other == axis ? 3.0 : 0.0)) < 1e-10);
    }
  }
}
