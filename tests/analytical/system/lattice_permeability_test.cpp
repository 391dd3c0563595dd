// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include "support/flow_scenes.hpp"

#include <cmath>

// Permeability of touching lattices: k = V / (6π a n F) with n spheres of radius a in the volume V and the drag
// factor F of Stokes flow (A. A. Zick and G. M. Homsy, J. Fluid Mech. 115, 13 (1982), Table 2: 42.1, 162.9, 435).

using namespace tetrapore;
using namespace flow_scenes;

namespace {

struct lattice_row {
  lattice_kind kind;
  double drag;
  double within;
};
constexpr lattice_row rows[] = {{lattice_kind::simple_cubic, 42.1, 0.03},
                                {lattice_kind::body_centred, 162.9, 0.025},
                                {lattice_kind::face_centred, 435.0, 0.09}};

packing shaken(packing p, double by, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (auto& g : p.grains) {
    for (std::size_t k = 0; k < 3; ++k) {
      g.centre[k] += by * g.radius * (2 * unit_draw(random) - 1);
    }
  }
  return p;
}

permeability_tensor tensor_of(const packing& p) {
  const network net = triangulated(p);
  saturated_flow flow(net, water(), ldlt_solver<>{});
  return tensor_of_permeability(flow, 1.0);
}

}  // namespace

TEST_CASE("the cells of a lattice that share a power centre are one node: its holes, however they are cut into cells") {
  // holes per sphere: a cube; six tetrahedra; two tetrahedra and an octahedron
  for (const auto& [kind, holes] : {std::pair{lattice_kind::simple_cubic, 1U},
                                    {lattice_kind::body_centred, 6U},
                                    {lattice_kind::face_centred, 3U}}) {
    const packing p = lattice(kind, {3, 2, 2}, 0.5, {true, true, true});
    for (const double jitter : {0.0, 1e-15, 1e-9}) {
      CHECK(flow_nodes(triangulated(shaken(p, jitter, 3))).size() == holes * p.grains.size());
    }
    CHECK(flow_nodes(triangulated(far_away(p))).size() == holes * p.grains.size());
  }
}

TEST_CASE("touching lattices have the permeability of Stokes flow within 3, 2.5 and 9 %, the same along each axis") {
  for (const lattice_row& row : rows) {
    const packing p = lattice(row.kind, {2, 2, 2}, 0.5, {true, true, true});
    const permeability_tensor k = tensor_of(p);
    const double stokes = p.bounds->volume() / (6 * pi<double> * 0.5 * static_cast<double>(p.grains.size()) * row.drag);
    CHECK(std::abs(k(0, 0) / stokes - 1) < row.within);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        CHECK(std::abs(k(i, j) - (i == j ? k(0, 0) : 0)) < 1e-12 * k(0, 0));
      }
    }
  }
}

TEST_CASE("a jitter of 1e-9 of the radius moves the permeability of a lattice by less than 1e-6") {
  for (const lattice_row& row : rows) {
    for (const std::size_t n : {2U, 3U}) {
      const packing p = lattice(row.kind, {n, n, n}, 0.5, {true, true, true});
      const permeability_tensor exact = tensor_of(p);
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        for (const double jitter : {1e-15, 1e-12, 1e-9}) {
          const permeability_tensor k = tensor_of(shaken(p, jitter, seed));
          for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
              CHECK(std::abs(k(i, j) - exact(i, j)) < 1e-6 * exact(0, 0));
            }
          }
        }
      }
    }
  }
}

TEST_CASE("touching lattices between walls have a finite permeability that a jitter does not move") {
  for (const lattice_row& row : rows) {
    const packing p = lattice(row.kind, {3, 3, 3}, 0.5);
    const auto k = [&](const packing& q) {
      const network net = triangulated(q);
      auto flow = flow_of(net, water(), between(face::z_min, 1, face::z_max, 0));
      CHECK(flow.solve().ok());
      CHECK(flow.conductances().counts.refused() == 0);
      return box_permeability(flow, face::z_min, face::z_max, 1.0);
    };
    const double exact = k(p);
    CHECK(exact > 0);
    CHECK(std::isfinite(exact));
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CHECK(k(shaken(p, 1e-9, seed)) == doctest::Approx(exact).epsilon(1e-6));
    }
  }
}
