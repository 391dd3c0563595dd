// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/ball_volume.hpp"
#include "tetrapore/geometry/power_centre.hpp"
#include "tetrapore/simplex/pore_body.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

/// \file
/// Node, facets and volumes of a pore body: total, solid, void, and the void that two cells share.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// A face of a cell. Corners are named as in cell_shape, counter-clockwise from outside.
struct cell_face {
  std::uint8_t count;
  std::array<std::uint8_t, 4> corners;
};

/// The corners and faces of a cell with G grains and 4 - G walls. Corner `grain + G * set` is the centre of a grain
/// projected on a set of walls (bit w for wall w), in the order of the tables below. The first four faces are the
/// facets opposite to the vertices, grains first (opposite to the single grain of a cuboid there is none: count 0);
/// then the faces on the walls. A wall acts as a vertex at infinity, so all four shapes have the orientation of a
/// tetrahedron.
template <std::size_t G>
struct cell_shape;

template <>
struct cell_shape<4> {
  static constexpr std::size_t corner_count = 4;
  static constexpr std::array<cell_face, 4> faces{
      {{3, {1, 2, 3, 0}}, {3, {0, 3, 2, 0}}, {3, {0, 1, 3, 0}}, {3, {0, 2, 1, 0}}}};
};
template <>
struct cell_shape<3> {
  static constexpr std::size_t corner_count = 6;
  static constexpr std::array<cell_face, 5> faces{
      {{4, {1, 2, 5, 4}}, {4, {2, 0, 3, 5}}, {4, {0, 1, 4, 3}}, {3, {0, 2, 1, 0}}, {3, {3, 4, 5, 0}}}};
};
template <>
struct cell_shape<2> {
  static constexpr std::size_t corner_count = 8;
  static constexpr std::array<cell_face, 6> faces{{{4, {1, 3, 7, 5}},
                                                   {4, {0, 4, 6, 2}},
                                                   {4, {0, 1, 5, 4}},
                                                   {4, {1, 0, 2, 3}},
                                                   {4, {3, 2, 6, 7}},
                                                   {4, {4, 5, 7, 6}}}};
};
template <>
struct cell_shape<1> {
  static constexpr std::size_t corner_count = 8;
  static constexpr std::array<cell_face, 7> faces{{{0, {0, 0, 0, 0}},
                                                   {4, {0, 4, 6, 2}},
                                                   {4, {0, 1, 5, 4}},
                                                   {4, {0, 2, 3, 1}},
                                                   {4, {1, 3, 7, 5}},
                                                   {4, {2, 6, 7, 3}},
                                                   {4, {4, 5, 7, 6}}}};
};

/// The six edges of a tetrahedron and its determinant, taken at the vertex whose edges are shortest when they differ
/// much: next to a grain a thousand times larger, the others differ in their last digits only.
template <real T>
struct tetrahedron_edges {
  vec3<T> d1, d2, d3, d12, d13, d23;
  T q1, q2, q3, q12, q13, q23;  ///< squared lengths
  T determinant;

  tetrahedron_edges(const vec3<T>& c0, const vec3<T>& c1, const vec3<T>& c2, const vec3<T>& c3) noexcept
      : d1(c1 - c0),
        d2(c2 - c0),
        d3(c3 - c0),
        d12(c2 - c1),
        d13(c3 - c1),
        d23(c3 - c2),
        q1(norm2(d1)),
        q2(norm2(d2)),
        q3(norm2(d3)),
        q12(norm2(d12)),
        q13(norm2(d13)),
        q23(norm2(d23)),
        determinant(triple(d1, d2, d3)) {
    const T at0 = q1 * q2 * q3;
    const T at1 = q1 * q12 * q13;
    const T at2 = q2 * q12 * q23;
    const T at3 = q3 * q13 * q23;
    const T least = smaller(smaller(at1, at2), at3);
    if (at0 > T(64) * least) {
      determinant = at1 <= least ? triple(d1, d12, d13) : at2 <= least ? triple(d2, d12, d23) : triple(d3, d13, d23);
    }
  }
};

/// A cell in the frame of its first centre.
template <real T, std::size_t G>
struct cell_frame {
  using shape = cell_shape<G>;
  static constexpr std::size_t walls = 4 - G;

  const pore_body<T>& body;
  std::array<vec3<T>, G> centres;                                 ///< relative to the first
  std::array<std::array<T, walls == 0 ? 1 : walls>, G> distance;  ///< of each centre from each wall

  explicit cell_frame(const pore_body<T>& b) noexcept : body(b) {
    for (std::size_t i = 0; i < G; ++i) {
      centres[i] = b.grains[i].centre - b.grains[0].centre;
      for (std::size_t w = 0; w < walls; ++w) {
        distance[i][w] = b.walls[w].distance(b.grains[i].centre);
      }
    }
  }

  /// Vertex k counted from grain i: a difference of centres, or the direction towards a wall.
  [[nodiscard]] vec3<T> towards(std::size_t i, std::size_t k) const noexcept {
    return k < G ? centres[k] - centres[i] : -body.walls[k - G].normal;
  }

  [[nodiscard]] vec3<T> corner(std::size_t k) const noexcept {
    const std::size_t grain = k % G;
    const std::size_t set = k / G;
    vec3<T> p = centres[grain];
    for (std::size_t w = 0; w < walls; ++w) {
      if ((set >> w & 1U) != 0) {
        p -= body.walls[w].normal * distance[grain][w];
      }
    }
    return p;
  }

  [[nodiscard]] small_polygon<T> polygon(std::size_t face) const noexcept {
    small_polygon<T> p;
    p.count = shape::faces[face].count;
    for (std::size_t k = 0; k < p.count; ++k) {
      p.corners[k] = corner(shape::faces[face].corners[k]);
    }
    return p;
  }

  /// Outward unit normal of a face, with its digits along a needle.
  [[nodiscard]] vec3<T> normal(std::size_t face) const noexcept {
    if (face >= 4) {
      return -body.walls[face - 4].normal;
    }
    // the vertices of the facet in positive order: grains, then walls
    constexpr std::array<std::array<std::uint8_t, 3>, 4> opposite{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    std::array<std::uint8_t, 3> v = opposite[face];
    while (!(v[0] < G && (v[2] >= G || v[1] < G))) {
      v = {v[1], v[2], v[0]};
    }
    const vec3<T> a = towards(v[0], v[1]);
    const vec3<T> b = towards(v[0], v[2]);
    if (v[1] >= G) {
      return cross(a, b);  // walls are perpendicular
    }
    if (v[2] >= G) {
      return normal_across(cross(a, b), a);
    }
    const vec3<T> c = towards(v[1], v[2]);
    const T la = norm2(a);
    const T lb = norm2(b);
    const T lc = norm2(c);
    return normal_across(cross(a, b), la >= lb && la >= lc ? a : (lb >= lc ? b : c));
  }

  [[nodiscard]] polyhedron<T> solid() const noexcept {
    polyhedron<T> p;
    for (std::size_t k = 0; k < shape::corner_count; ++k) {
      p.add_vertex(corner(k));
    }
    for (std::size_t f = 0; f < shape::faces.size(); ++f) {
      if (shape::faces[f].count > 0) {
        p.add_face(normal(f), std::span(shape::faces[f].corners).first(shape::faces[f].count));
      }
    }
    return p;
  }

  [[nodiscard]] T determinant() const noexcept
    requires(G == 4)
  {
    return tetrahedron_edges<T>(body.grains[0].centre, body.grains[1].centre, body.grains[2].centre,
                                body.grains[3].centre)
        .determinant;
  }

  [[nodiscard]] T total() const noexcept {
    if constexpr (G == 4) {
      return determinant() / T(6);
    } else if constexpr (G == 3) {
      return triple(centres[1], centres[2], towards(0, 3)) * (distance[0][0] + distance[1][0] + distance[2][0]) / T(6);
    } else if constexpr (G == 2) {
      const auto& [a0, b0] = distance[0];
      const auto& [a1, b1] = distance[1];
      return triple(centres[1], towards(0, 2), towards(0, 3)) * (a0 * (b0 + b0 + b1) + a1 * (b1 + b1 + b0)) / T(6);
    } else {
      return triple(towards(0, 1), towards(0, 2), towards(0, 3)) * distance[0][0] * distance[0][1] * distance[0][2];
    }
  }

  /// Solid angle of the cell at grain i.
  [[nodiscard]] T angle(std::size_t i) const noexcept {
    constexpr std::array<std::array<std::uint8_t, 3>, 4> others{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    const vec3<T> a = towards(i, others[i][0]);
    const vec3<T> b = towards(i, others[i][1]);
    const vec3<T> c = towards(i, others[i][2]);
    if constexpr (G == 4) {
      using std::atan2;
      return T(2) * atan2(determinant(), half_angle_cosine(a, b, c, norm(a), norm(b), norm(c)));
    } else {
      return solid_angle(a, b, c);
    }
  }

  /// Angle between the two facets at the edge from grain i to grain j.
  [[nodiscard]] T edge_angle(std::size_t i, std::size_t j) const noexcept {
    using std::atan2;
    std::array<std::size_t, 2> rest{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (k != i && k != j) {
        rest[count++] = k;
      }
    }
    const vec3<T> edge = centres[j] - centres[i];
    const vec3<T> u = cross(edge, towards(i, rest[0]));
    const vec3<T> v = cross(edge, towards(i, rest[1]));
    return atan2(norm(cross(u, v)), dot(u, v));
  }

  [[nodiscard]] T sectors() const noexcept {
    T sum(0);
    for (std::size_t i = 0; i < G; ++i) {
      const T r = body.grains[i].radius;
      sum += r * r * r * angle(i);
    }
    return sum / T(3);
  }

  [[nodiscard]] bool reaches_facet(std::size_t i) const noexcept {
    return shape::faces[i].count > 0 && reaches(sphere<T>{centres[i], body.grains[i].radius}, polygon(i));
  }

  [[nodiscard]] bool reaches_wall(std::size_t i) const noexcept {
    for (std::size_t w = 0; w < walls; ++w) {
      if (!(distance[i][w] >= body.grains[i].radius)) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] sphere<T> local(const sphere<T>& ball) const noexcept {
    return {ball.centre - body.grains[0].centre, ball.radius};
  }
};

/// The tetrahedron, whose six edges are shared by its solid angles.
template <real T>
struct tetrahedron_frame : tetrahedron_edges<T> {
  std::array<T, 4> radius;

  using edges = tetrahedron_edges<T>;
  using edges::d1, edges::d2, edges::d3, edges::d12, edges::d13, edges::d23;
  using edges::determinant;
  using edges::q1, edges::q2, edges::q3, edges::q12, edges::q13, edges::q23;

  explicit tetrahedron_frame(const pore_body<T>& b) noexcept
      : edges(b.grains[0].centre, b.grains[1].centre, b.grains[2].centre, b.grains[3].centre),
        radius{b.grains[0].radius, b.grains[1].radius, b.grains[2].radius, b.grains[3].radius} {}

  [[nodiscard]] T sectors() const noexcept {
    using std::atan2;
    using std::sqrt;
    const T l1 = sqrt(q1), l2 = sqrt(q2), l3 = sqrt(q3), l12 = sqrt(q12), l13 = sqrt(q13), l23 = sqrt(q23);
    const T c0 = l1 * l2 * l3 + dot(d1, d2) * l3 + dot(d1, d3) * l2 + dot(d2, d3) * l1;
    const T c1 = l1 * l12 * l13 - dot(d1, d12) * l13 - dot(d1, d13) * l12 + dot(d12, d13) * l1;
    const T c2 = l2 * l12 * l23 + dot(d2, d12) * l23 - dot(d2, d23) * l12 - dot(d12, d23) * l2;
    const T c3 = l3 * l13 * l23 + dot(d3, d13) * l23 + dot(d3, d23) * l13 + dot(d13, d23) * l3;
    const auto cube = [](const T& r) noexcept { return r * r * r; };
    return (cube(radius[0]) * atan2(determinant, c0) + cube(radius[1]) * atan2(determinant, c1) +
            cube(radius[2]) * atan2(determinant, c2) + cube(radius[3]) * atan2(determinant, c3)) *
           (T(2) / T(3));
  }

  /// Whether no height is below the radius and no two grains overlap: then the sectors are the solid. Heights of a cell
  /// whose determinant keeps few digits say nothing.
  [[nodiscard]] bool plain() const noexcept {
    const vec3<T> n3 = cross(d1, d2);
    const vec3<T> n1 = cross(d2, d3);
    const vec3<T> n2 = cross(d3, d1);
    const vec3<T> n0 = cross(d12, d13);
    const T v2 = determinant * determinant;
    const auto clear = [&v2](const T& r, const vec3<T>& n) noexcept { return v2 >= r * r * norm2(n); };
    const bool solid = determinant > T(0) && v2 > q1 * q2 * q3 * T(static_cast<underlying_t<T>>(needle2));
    return solid && clear(radius[0], n0) && clear(radius[1], n1) && clear(radius[2], n2) && clear(radius[3], n3) &&
           !overlaps(q1, radius[0], radius[1]) && !overlaps(q2, radius[0], radius[2]) &&
           !overlaps(q3, radius[0], radius[3]) && !overlaps(q12, radius[1], radius[2]) &&
           !overlaps(q13, radius[1], radius[3]) && !overlaps(q23, radius[2], radius[3]);
  }
};

/// Calls f with the frame of the body's own shape.
template <real T, class F>
[[nodiscard]] auto in_frame(const pore_body<T>& body, const F& f) noexcept {
  TETRAPORE_EXPECTS(body.grain_count >= 1 && body.grain_count <= 4, "a pore body has one to four grains");
  switch (body.grain_count) {
    case 1: return f(cell_frame<T, 1>(body));
    case 2: return f(cell_frame<T, 2>(body));
    case 3: return f(cell_frame<T, 3>(body));
    default: return f(cell_frame<T, 4>(body));
  }
}

/// The lens that two overlapping balls share, when the radical plane lies between their centres: then it fits into the
/// ball over its rim.
template <real T>
struct lens {
  vec3<T> middle;  ///< centre of the rim
  T rim2;          ///< squared radius of the rim
  bool shallow;

  lens(const sphere<T>& a, const sphere<T>& b) noexcept {
    const vec3<T> d = b.centre - a.centre;
    const T q = norm2(d);
    const T t = (T(1) + (a.radius - b.radius) * ((a.radius + b.radius) / q)) * T(0.5);  // share of the distance
    middle = a.centre + d * t;
    rim2 = a.radius * a.radius - t * t * q;
    shallow = q > T(0) && t > T(0) && t < T(1) && rim2 > T(0);
  }
};

/// Solid volume in a cell. While no three balls meet, the union is the sum of the balls less the sum of their lenses,
/// and most of these are known without the kernel: a grain that reaches neither its opposite facet nor a wall fills a
/// sector; the lens of two such grains fills its share of the angle at their edge, as it can leave the cell only
/// through a facet that one of the two would reach.
template <real T, std::size_t G>
[[nodiscard]] outcome<T, geometry_status> solid_volume(const cell_frame<T, G>& cell,
                                                       std::span<const sphere<T>> intruders) noexcept {
  const std::size_t n = G + intruders.size();
  const auto ball = [&](std::size_t k) noexcept {
    return k < G ? sphere<T>{cell.centres[k], cell.body.grains[k].radius} : cell.local(intruders[k - G]);
  };
  std::array<bool, G> sector;
  bool need_kernel = n > G;
  for (std::size_t i = 0; i < G; ++i) {
    sector[i] = !cell.reaches_wall(i) && !cell.reaches_facet(i);
    need_kernel = need_kernel || !sector[i];
  }
  polyhedron<T> whole;
  if (need_kernel) {
    whole = cell.solid();
  }
  T solid(0);
  for (std::size_t i = 0; i < n; ++i) {
    const sphere<T> a = ball(i);
    if (!is_finite(a)) {
      return refuse<T>(geometry_status::not_finite);
    }
    if (i < G && sector[i]) {
      solid += a.radius * a.radius * a.radius * cell.angle(i) / T(3);
    } else if (!apart(a, whole)) {
      solid += ball_volume(a, whole);
    }
    for (std::size_t j = i + 1; j < n; ++j) {
      const sphere<T> b = ball(j);
      const T distance2 = norm2(b.centre - a.centre);
      if (!overlaps(distance2, a.radius, b.radius)) {
        continue;
      }
      const lens<T> common(a, b);
      bool alone = common.shallow;
      for (std::size_t k = 0; k < n && alone; ++k) {
        if (k != i && k != j) {
          const sphere<T> c = ball(k);
          using std::sqrt;
          const T reach = c.radius + sqrt(common.rim2);
          alone = norm2(common.middle - c.centre) >= reach * reach;
        }
      }
      if (!alone) {
        return union_volume(need_kernel ? whole : cell.solid(), n, ball);
      }
      if (j < G && sector[i] && sector[j]) {
        using std::sqrt;
        solid -= lens_volume(a.radius, b.radius, sqrt(distance2)) * (cell.edge_angle(i, j) / (T(2) * T(pi<T>)));
      } else if (!apart(a, whole) && !apart(b, whole)) {
        polyhedron<T> beyond = whole;
        polyhedron<T> before = whole;
        const plane<T> cut = radical_plane(a, b);  // normal towards a
        const geometry_status fit = beyond.clip({cut.point, -cut.normal});
        const geometry_status fits = before.clip(cut);
        if (fit != geometry_status::ok || fits != geometry_status::ok) {
          return refuse<T>(fit != geometry_status::ok ? fit : fits);
        }
        solid -= ball_volume(a, beyond) + ball_volume(b, before);
      }
    }
  }
  return checked(solid);
}

}  // namespace detail

/// The node of a pore: the point of equal power to its grains, on its walls.
/// \par Units  [m]
/// \par Domain  cells that are not flat to rounding, else the status is flat
template <real T>
[[nodiscard]] outcome<vec3<T>, geometry_status> power_centre(const pore_body<T>& body) noexcept {
  const auto& g = body.grains;
  const auto& w = body.walls;
  switch (body.grain_count) {
    case 1: return power_centre(g[0], w[0], w[1], w[2]);
    case 2: return power_centre(g[0], g[1], w[0], w[1]);
    case 3: return power_centre(g[0], g[1], g[2], w[0]);
    default: return power_centre(g[0], g[1], g[2], g[3]);
  }
}

/// The facet opposite to vertex k (grains first, then walls), counter-clockwise from outside the cell: a triangle, a
/// trapezoid or a rectangle. Opposite to the grain of a cuboid there is none: count 0.
/// \par Units  [m]
template <real T>
[[nodiscard]] small_polygon<T> facet(const pore_body<T>& body, std::size_t k) noexcept {
  return detail::in_frame(body, [&](const auto& cell) noexcept {
    auto p = cell.polygon(k);
    for (std::size_t c = 0; c < p.count; ++c) {
      p.corners[c] += body.grains[0].centre;
    }
    return p;
  });
}

/// Whether a ball reaches the facet opposite to vertex k, and so (unless it only touches) the cell behind it.
template <real T>
[[nodiscard]] bool reaches(const sphere<T>& ball, const pore_body<T>& body, std::size_t k) noexcept {
  return detail::in_frame(body, [&](const auto& cell) noexcept {
    const auto p = cell.polygon(k);
    return p.count > 0 && reaches(cell.local(ball), p);
  });
}

/// Whether grain k reaches through the facet opposite to it, so that the sector form gives this cell too much and the
/// cell behind too little.
template <real T>
[[nodiscard]] bool pokes(const pore_body<T>& body, std::size_t k) noexcept {
  return detail::in_frame(body, [&](const auto& cell) noexcept { return cell.reaches_facet(k); });
}

/// Volume of the cell, signed by its orientation.
/// \par Units  [m³]
/// \par Accuracy  a few epsilon of the product of three edges
template <real T>
[[nodiscard]] T total_volume(const pore_body<T>& body) noexcept {
  return detail::in_frame(body, [](const auto& cell) noexcept { return cell.total(); });
}

/// The solid of a cell as the sum of the sectors of its grains, r³ Ω/3: exact where no grain reaches through the facet
/// opposite to it or a wall, and none overlap; else exact only in the sum over all cells.
/// \par Units  [m³]
/// \par Source  Chareyre et al. 2017, §2.2
template <real T>
[[nodiscard]] T sector_volume(const pore_body<T>& body) noexcept {
  if (body.grain_count == 4) {
    return detail::tetrahedron_frame<T>(body).sectors();
  }
  return detail::in_frame(body, [](const auto& cell) noexcept { return cell.sectors(); });
}

/// Volume of the cell outside the union of its own grains and the intruders: exact, also for grains that overlap, that
/// reach through the opposite facet or beyond a wall, and for cells without volume.
/// \param intruders  the other balls that may reach into the cell; balls that do not, and repeated ones, change nothing
/// \par Units  [m³]
/// \par Domain  cells of positive or (to rounding) zero volume
/// \par Accuracy  2e-16 of the cube of the cell's size (measured, 12,000 cells of every shape with up to three
/// intruders of its size); 1.3e-16 of the volumes involved at radius ratios of a thousand; intruders much larger: as
/// ball_volume
template <real T>
[[nodiscard]] outcome<T, geometry_status> void_volume(const pore_body<T>& body,
                                                      std::span<const sphere<T>> intruders = {}) noexcept {
  if (body.grain_count == 4 && intruders.empty()) {
    const detail::tetrahedron_frame<T> t(body);
    if (t.plain()) {
      return detail::checked(t.determinant / T(6) - t.sectors());
    }
  }
  return detail::in_frame(body, [&](const auto& cell) noexcept {
    const auto solid = detail::solid_volume(cell, intruders);
    return solid.ok() ? detail::checked(cell.total() - solid.value) : solid;
  });
}

/// Void volume of the intersection of two cells, such as an old one and a new one.
/// \param balls  all balls that may reach into the intersection, the cells' own grains included
/// \par Units  [m³]
/// \par Domain  as void_volume, for both cells
template <real T>
[[nodiscard]] outcome<T, geometry_status> void_overlap(const pore_body<T>& a, const pore_body<T>& b,
                                                       std::span<const sphere<T>> balls) noexcept {
  if (total_volume(b) < total_volume(a)) {  // the smaller is cut, so that a sliver never shapes a larger result
    return void_overlap(b, a, balls);
  }
  polyhedron<T> common = detail::in_frame(a, [](const auto& cell) noexcept { return cell.solid(); });
  const polyhedron<T> other = detail::in_frame(b, [](const auto& cell) noexcept { return cell.solid(); });
  const vec3<T> origin = a.grains[0].centre;
  const vec3<T> shift = b.grains[0].centre - origin;
  for (std::size_t f = 0; f < other.face_count() && !common.empty(); ++f) {
    plane<T> keep = other.inner_side(f);
    keep.point += shift;
    const geometry_status fit = common.clip(keep);
    if (fit != geometry_status::ok) {
      return detail::refuse<T>(fit);
    }
  }
  const auto solid = detail::union_volume(common, balls.size(), [&](std::size_t k) noexcept {
    return sphere<T>{balls[k].centre - origin, balls[k].radius};
  });
  return solid.ok() ? detail::checked(common.empty() ? T(0) : common.volume() - solid.value) : solid;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
