// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/network.hpp"
#include "tetrapore/simplex/edge.hpp"
#include "tetrapore/simplex/pore_body.hpp"
#include "tetrapore/simplex/throat.hpp"

#include <utility>

/// \file
/// Simplices gathered from a network: what a law sees, with nothing of the network in it.

namespace tetrapore::inline TETRAPORE_ABI {

/// The pore body of pore p, unwrapped.
[[nodiscard]] inline pore_body<double> pore_body_at(const network& net, pore_id p) noexcept {
  pore_body<double> body;
  std::size_t grains = 0;
  std::size_t walls = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const vertex v = net.vertices(p)[k];
    if (v.is_wall()) {
      body.walls[walls++] = net.region().wall(v.wall());
    } else {
      body.grains[grains++] = net.grain_sphere(p, k);
    }
  }
  body.grain_count = static_cast<std::uint8_t>(grains);
  return body;
}

/// The edge between vertices a and b of pore p, of which one may be a wall: the grain of the lower id first, so that an
/// edge is the same to the last bit from whichever pore it is seen.
[[nodiscard]] inline edge<double> edge_at(const network& net, pore_id p, std::size_t a, std::size_t b) noexcept {
  vertex first = net.vertices(p)[a];
  vertex second = net.vertices(p)[b];
  TETRAPORE_EXPECTS(!first.is_wall() || !second.is_wall(), "an edge has at least one grain");
  if (first.is_wall() || (!second.is_wall() && second < first)) {
    std::swap(first, second);
    std::swap(a, b);
  }
  const sphere<double>& s = net.grains()[first.grain().index()];
  if (second.is_wall()) {
    const plane<double> w = net.region().wall(second.wall());
    return {s.radius, infinity<double>, w.distance(s.centre) - s.radius, -w.normal};
  }
  const sphere<double>& t = net.grains()[second.grain().index()];
  const vec3<double> step = (t.centre - s.centre) + net.region().shift(net.image_of(p, b) - net.image_of(p, a));
  const double distance = norm(step);
  return {s.radius, t.radius, (distance - s.radius) - t.radius, step / distance};
}

/// The vertices of a throat as slots of a pore that it bounds: outward order, grains first, then walls.
[[nodiscard]] inline std::array<std::uint8_t, 3> facet_slots(const network& net, pore_id p, std::size_t slot) noexcept {
  std::array<std::uint8_t, 3> f = facet_vertices[slot];
  const auto wall = [&](std::size_t i) { return net.vertices(p)[f[i]].is_wall(); };
  // An even permutation keeps the order outward; a facet has at least one grain, so walls fit at the end.
  for (int turns = 0; turns < 2 && (wall(0) || (wall(1) && !wall(2))); ++turns) {
    f = {f[1], f[2], f[0]};
  }
  return f;
}

namespace detail {

/// The vertices of the throat t, seen from its pore 0, unwrapped, with the area vector of the facet.
[[nodiscard]] inline throat<double> facet_at(const network& net, throat_id t) noexcept {
  const pore_id p = net.pores(t)[0];
  throat<double> out;
  std::size_t grains = 0;
  std::size_t walls = 0;
  for (const std::uint8_t k : facet_slots(net, p, net.slot(t, 0))) {
    const vertex v = net.vertices(p)[k];
    if (v.is_wall()) {
      out.walls[walls++] = net.region().wall(v.wall());
    } else {
      out.grains[grains++] = net.grain_sphere(p, k);
    }
  }
  out.grain_count = static_cast<std::uint8_t>(grains);
  const vec3<double>& c = out.grains[0].centre;
  if (grains == 3) {
    out.area_vector = 0.5 * cross(out.grains[1].centre - c, out.grains[2].centre - c);
  } else if (grains == 2) {
    const plane<double>& w = out.walls[0];
    const double mean_height = 0.5 * (w.distance(c) + w.distance(out.grains[1].centre));
    out.area_vector = cross(w.normal, out.grains[1].centre - c) * mean_height;
  } else {
    const auto& [w1, w2] = out.walls;
    out.area_vector = cross(w1.normal, w2.normal) * (w1.distance(c) * w2.distance(c));
  }
  return out;
}

}  // namespace detail

/// The throat t with its geometry, seen from its pore 0, unwrapped. The network must have been measured.
[[nodiscard]] inline throat<double> throat_at(const network& net, throat_id t) noexcept {
  throat<double> out = detail::facet_at(net, t);
  out.nodes[0] = net.power_centre(net.pores(t)[0]);
  out.nodes[1] =
      net.is_boundary(t) ? out.nodes[0] : net.power_centre(net.pores(t)[1]) + net.region().shift(net.shift(t));
  return out;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
