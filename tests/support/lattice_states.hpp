// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/sanitized.hpp"
#include "tetrapore/lbm/simulation.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

/// \file
/// Fluids on small lattices, stirred by numbers that belong to places.

namespace lattice_states {

using namespace tetrapore::lbm;
using place = std::array<int, 3>;

/// A sanitized build takes the plainest model in place of others: to compile each of them costs half a minute there.
using plain = mixture<d3q19, bgk>;
template <class Model>
using unless_sanitized = std::conditional_t<sanitized, plain, Model>;
using other_scalar = std::conditional_t<sanitized, double, float>;

/// A number in 0 … 1 that belongs to a place.
inline double noise(const place& p, std::uint32_t salt) {
  std::uint64_t h = salt;
  for (const int x : p) {
    h = (h ^ static_cast<std::uint64_t>(x + 1000)) * std::uint64_t{0x9E3779B97F4A7C15};
    h ^= h >> 29U;
  }
  return static_cast<double>(h >> 11U) * 0x1p-53;
}

template <class Model>
Model repelling(double tau = 0.9) {
  Model m;
  for (std::size_t c = 0; c < Model::components; ++c) {
    m.collisions[c].tau = tau + 0.1 * static_cast<double>(c);
    m.reference[c] = 1;
    for (std::size_t b = 0; b < Model::components; ++b) {
      m.attraction[c][b] = b == c ? 0 : 1.5;
    }
  }
  return m;
}

inline lattice_box box_of(const place& size, face_kind kind = face_kind::periodic) {
  return {size, {kind, kind, kind}, {kind, kind, kind}};
}

inline constexpr auto as_it_is = [](const auto& p) { return p; };

/// Blobs of the components and a stir, seen through a map of places and one of velocities.
template <class Simulation, class Map, class Turn = decltype(as_it_is)>
void stir(Simulation& s, Map map, Turn turn = as_it_is) {
  s.initialise([&](const place& p, auto& rho, auto& u) {
    const place q = map(p);
    for (std::size_t c = 0; c < rho.size(); ++c) {
      rho[c] = 0.2 + 0.7 * noise(q, 1 + static_cast<std::uint32_t>(c));
    }
    u = turn(std::array{0.02 * noise(q, 11) - 0.01, 0.02 * noise(q, 12) - 0.01, 0.02 * noise(q, 13) - 0.01});
  });
}

/// A box with a solid ball that shows the components different densities.
inline site_map<d3q19> with_ball(const place& size) {
  return {box_of(size), [size](int x, int y, int z) {
            const double d = std::hypot(x - 0.4 * size[0], y - 0.5 * size[1], z - 0.6 * size[2]);
            return site{d < 3 ? site_kind::solid : site_kind::fluid, 3};
          }};
}

}  // namespace lattice_states
