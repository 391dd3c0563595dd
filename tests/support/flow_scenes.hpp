// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/compiled_triangulation.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/network/solid.hpp"
#include "tetrapore/one_phase.hpp"
#include "tetrapore/packing/lattice.hpp"
#include "tetrapore/packing/random_packing.hpp"
#include "tetrapore/solver/ldlt.hpp"

#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Packings on which the exact facts of one-phase flow must hold, and a law without physics.

namespace flow_scenes {

using namespace tetrapore;

inline double unit_draw(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

struct scene {
  std::string name;
  network net;
};

inline packing dense(std::size_t n, std::array<bool, 3> periodic, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> radii(n);
  for (double& r : radii) {
    r = 0.7 + 0.6 * unit_draw(random);
  }
  const double fraction = periodic[0] ? 0.58 : 0.5;  // walls order the grains beside them
  return random_packing(radii,
                        {.solid_fraction = fraction, .periodic = periodic, .aspect = {1, 1.25, 0.75}, .seed = seed});
}

inline packing scaled(packing p, double unit) {
  for (auto& g : p.grains) {
    g = {g.centre * unit, g.radius * unit};
  }
  p.bounds = box{p.bounds->lo * unit, p.bounds->hi * unit};
  return p;
}

inline packing moved(packing p, const vec3<double>& by) {
  for (auto& g : p.grains) {
    g.centre += by;
  }
  p.bounds = box{p.bounds->lo + by, p.bounds->hi + by};
  return p;
}

/// A million boxes away.
inline packing far_away(const packing& p) {
  const vec3<double> s = p.bounds->size();
  return moved(p, {1e6 * s.x, -1e6 * s.y, 1e6 * s.z});
}

inline packing inflated(packing p, double factor) {
  for (auto& g : p.grains) {
    g.radius *= factor;
  }
  return p;
}

inline network triangulated(const packing& p) { return compiled_triangulation{}(p.grains, domain_of(p)).net; }

inline std::vector<scene> walled_scenes() {
  const packing random = dense(120, {}, 3);
  std::vector<scene> out;
  out.push_back({"random", triangulated(random)});
  out.push_back({"random, a million boxes away", triangulated(far_away(random))});
  out.push_back({"overlapping", triangulated(inflated(random, 1.06))});
  out.push_back({"overlapping, a million boxes away", triangulated(far_away(inflated(random, 1.06)))});
  for (const auto kind : {lattice_kind::simple_cubic, lattice_kind::body_centred, lattice_kind::face_centred}) {
    const packing p = lattice(kind, {3, 3, 3}, 0.3);
    out.push_back({"lattice " + std::to_string(static_cast<int>(kind)), triangulated(p)});
    out.push_back({"lattice far away " + std::to_string(static_cast<int>(kind)), triangulated(far_away(p))});
  }
  return out;
}

inline std::vector<scene> periodic_scenes() {
  const packing random = dense(120, {true, true, true}, 5);
  std::vector<scene> out;
  out.push_back({"random", triangulated(random)});
  out.push_back({"random, a million boxes away", triangulated(far_away(random))});
  out.push_back({"overlapping", triangulated(inflated(random, 1.06))});
  out.push_back({"overlapping, a million boxes away", triangulated(far_away(inflated(random, 1.06)))});
  for (const auto kind : {lattice_kind::simple_cubic, lattice_kind::body_centred, lattice_kind::face_centred}) {
    const packing p = lattice(kind, {2, 3, 2}, 0.3, {true, true, true});
    out.push_back({"lattice " + std::to_string(static_cast<int>(kind)), triangulated(p)});
    out.push_back({"lattice far away " + std::to_string(static_cast<int>(kind)), triangulated(far_away(p))});
  }
  return out;
}

/// Conductances that have nothing to do with flow: drawn from the area of the facet, over eight decades.
struct arbitrary_law {
  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t) const noexcept {
    const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(norm2(t.area_vector)));
    std::mt19937_64 random(bits >> 8U);
    return {T(std::pow(10.0, 8 * unit_draw(random) - 4)), conductance_status::ok};
  }
};
static_assert(conductance_law<arbitrary_law>);

inline flow_conditions between(face inlet, double in, face outlet, double out) {
  flow_conditions c;
  c.at(inlet) = held_pressure(in);
  c.at(outlet) = held_pressure(out);
  return c;
}

template <class Law>
auto flow_of(const network& net, const Law& law, const flow_conditions& c) {
  return saturated_flow(net, law, ldlt_solver<>{}, {.conditions = c, .refused = refused_throats::closed});
}

inline hydraulic_radius water() { return {.viscosity = 1.0}; }

}  // namespace flow_scenes
