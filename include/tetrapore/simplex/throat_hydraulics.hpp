// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/solid_angle.hpp"
#include "tetrapore/simplex/throat_geometry.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

/// \file
/// What a flow sees of a throat: the domain between its two pores, the solid in it, and the surface it wets.

namespace tetrapore::inline TETRAPORE_ABI {

/// Whether the fluid sticks to the walls. It always sticks to the grains.
enum class wall_condition : std::uint8_t {
  no_slip,  ///< a wall counts as wetted
  slip      ///< a wall takes no shear
};

/// The throat domain is the facet joined to both nodes. Vertices in the order of the throat: grains first, then walls.
template <real T>
struct throat_hydraulics {
  T length{};                      ///< distance of the two nodes [m]
  T facet_area{};                  ///< [m²]
  T fluid_area{};                  ///< [m²] of the facet outside all discs
  T domain_volume{};               ///< [m³]
  T solid_volume{};                ///< [m³] the sectors of the grains in the domain
  std::array<T, 3> disc_area{};    ///< [m²] of each grain in the facet; none of a wall. fluid + discs = facet
  std::array<T, 3> wetted_area{};  ///< [m²] of each grain and wall in the domain
  std::uint8_t grain_count{};

  /// Surface of vertex k that takes shear [m²].
  [[nodiscard]] constexpr T sheared_area(std::size_t k, wall_condition walls) const noexcept {
    return k < grain_count || walls == wall_condition::no_slip ? wetted_area[k] : T(0);
  }
  /// The same of all vertices [m²].
  [[nodiscard]] constexpr T sheared_area(wall_condition walls) const noexcept {
    return sheared_area(0, walls) + sheared_area(1, walls) + sheared_area(2, walls);
  }
  /// Volume of the fluid in the domain [m³]; negative where sectors overlap or reach beyond it.
  [[nodiscard]] constexpr T fluid_volume() const noexcept { return domain_volume - solid_volume; }
  /// Volume of the fluid over the surface that takes shear [m]: half the radius of a tube.
  [[nodiscard]] constexpr T hydraulic_radius(wall_condition walls) const noexcept {
    return fluid_volume() / sheared_area(walls);
  }
};

namespace detail {

/// The edges of a facet, edge k from vertex k to the next, a wall being a direction: from grain k the others lie along
/// edge k and against edge k + 2. Nothing between two walls.
template <real T>
[[nodiscard]] constexpr std::array<vec3<T>, 3> edges_of_facet(const throat<T>& t) noexcept {
  std::array<vec3<T>, 3> out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (k < t.grain_count && next < t.grain_count) {
      out[k] = t.grains[next].centre - t.grains[k].centre;
    } else if (k < t.grain_count) {
      out[k] = -t.walls[next - t.grain_count].normal;
    } else if (next < t.grain_count) {
      out[k] = t.walls[k - t.grain_count].normal;
    }
  }
  return out;
}

}  // namespace detail

/// Volumes and surfaces of a throat domain. From a grain a wall is a direction, as in a cell: the solid angle at grain
/// k is that of the spherical quadrangle (a, node 0, b, node 1), a and b being the other two vertices. The angles are
/// signed, with the sign of the whole domain: where the axis between the nodes misses the facet, one of the two
/// triangles of the quadrangle counts negative.
/// \par Units  [m] -> [m], [m²], [m³]
/// \par Domain  any throat; of coincident nodes length, volumes and wetted areas are 0. Sectors of grains that overlap,
///              or that reach beyond a wall, count whole
/// \par Accuracy  wetted areas of random throats 7e-16 r², absolute (tests/analytical/simplex/). Of all throats of a
///                packing the volumes sum to the box, the angles at each grain to 4π and the wetted areas of a wall to
///                its face, to 1e-12 (tests/analytical/system/throat_domain_test.cpp)
/// \par Source  Chareyre et al. 2012, Transp. Porous Media 92, 473, with signed angles; a wall is wetted on the
///              projection of the nodes and of the edge of the facet on it
template <real T>
[[nodiscard]] outcome<throat_hydraulics<T>, geometry_status> hydraulics_of(const throat<T>& t) noexcept {
  using std::atan2;
  TETRAPORE_EXPECTS(t.grain_count >= 1 && t.grain_count <= 3, "a throat has one to three grains");
  const detail::facet_areas<T> areas = detail::areas_in_facet(t);
  const vec3<T> axis = t.nodes[1] - t.nodes[0];
  const T flux = dot(t.area_vector, axis);
  const bool reversed = flux < T(0);
  throat_hydraulics<T> h;
  h.grain_count = t.grain_count;
  h.length = norm(axis);
  h.facet_area = areas.whole;
  h.fluid_area = areas.fluid();
  h.disc_area = areas.disc;
  h.domain_volume = detail::magnitude(flux) / T(3);
  const std::array<vec3<T>, 3> edges = detail::edges_of_facet(t);
  const std::array<T, 3> lengths{norm(edges[0]), norm(edges[1]), norm(edges[2])};
  T check = h.length + h.fluid_area + h.domain_volume;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k < t.grain_count) {
      const sphere<T>& g = t.grains[k];
      const vec3<T> from = t.nodes[0] - g.centre;
      const vec3<T> to = t.nodes[1] - g.centre;
      const T from_length = norm(from);
      const T to_length = norm(to);
      // Half of each triangle's angle as a complex number, their difference by a product. With the axis itself in the
      // volume, a cone between two close nodes keeps its digits.
      const auto cone = [&](const vec3<T>& a, const T& along) noexcept -> vec2<T> {
        return {detail::half_angle_cosine(a, from, to, along, from_length, to_length), triple(a, from, axis)};
      };
      const vec2<T> first = cone(edges[k], lengths[k]);
      const vec2<T> second = cone(-edges[(k + 2) % 3], lengths[(k + 2) % 3]);
      const T angle = h.length > T(0) ? T(2) * atan2(cross(second, first), dot(first, second)) : T(0);
      h.wetted_area[k] = g.radius * g.radius * (reversed ? -angle : angle);
      h.solid_volume = h.solid_volume + g.radius * h.wetted_area[k] / T(3);
    } else {
      // the facet stands on the wall: its area is its base times its mean height
      const plane<T>& wall = t.walls[k - t.grain_count];
      const T height = t.grain_count == 2
                           ? (wall.distance(t.grains[0].centre) + wall.distance(t.grains[1].centre)) * T(0.5)
                           : wall.distance(t.grains[0].centre);
      h.wetted_area[k] = detail::magnitude(flux) * T(0.5) / height;
    }
    check = check + h.wetted_area[k];
  }
  return {h, check - check == T(0) ? geometry_status::ok : geometry_status::not_finite};
}

}  // namespace tetrapore::inline TETRAPORE_ABI
