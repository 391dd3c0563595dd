// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/area.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

/// \file
/// A small convex polyhedron that can be clipped, without allocation.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// Storage for up to N values of a trivially copyable type, not initialised: a polyhedron is made and dropped often,
/// and mostly empty.
template <class T, std::size_t N>
class workspace {
 public:
  workspace() noexcept {}  // NOLINT(modernize-use-equals-default): leaves the values alone
  [[nodiscard]] T& operator[](std::size_t k) noexcept { return values_[k]; }
  [[nodiscard]] const T& operator[](std::size_t k) const noexcept { return values_[k]; }
  [[nodiscard]] T* data() noexcept { return values_; }
  [[nodiscard]] const T* data() const noexcept { return values_; }

 private:
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  union {
    T values_[N];
  };
};

}  // namespace detail

/// Faces as closed sets of directed edges (counter-clockwise from outside) over shared vertices. All that is asked of
/// it (volume, the volume of a ball inside) is a sum over directed edges, so the order of the edges within a face does
/// not matter, and a clip that only cuts edges and joins the cuts stays closed whatever the rounding: slivers and
/// polyhedra without volume are ordinary. An inverted polyhedron has negative volume.
/// \par Units  [m]
template <real T>
class polyhedron {
 public:
  static constexpr std::size_t max_vertices = 64;
  static constexpr std::size_t max_faces = 32;
  static constexpr std::size_t max_edges = 256;

  /// An edge of a face, from vertex to vertex, counter-clockwise seen from outside.
  struct directed_edge {
    std::uint8_t from;
    std::uint8_t to;
  };

  polyhedron() noexcept = default;
  polyhedron(const polyhedron& other) noexcept { copy(other); }
  polyhedron& operator=(const polyhedron& other) noexcept {
    if (this != &other) {
      copy(other);
    }
    return *this;
  }
  ~polyhedron() = default;

  [[nodiscard]] bool empty() const noexcept { return face_count_ == 0; }
  [[nodiscard]] std::size_t face_count() const noexcept { return face_count_; }
  [[nodiscard]] std::span<const vec3<T>> vertices() const noexcept { return {vertices_.data(), vertex_count_}; }
  /// Unit normal of a face, outward.
  [[nodiscard]] const vec3<T>& normal(std::size_t face) const noexcept { return faces_[face].normal; }
  [[nodiscard]] std::span<const directed_edge> edges(std::size_t face) const noexcept {
    const std::size_t begin = faces_[face].begin;
    const std::size_t end = faces_[face].end;
    return {edges_.data() + begin, end - begin};
  }
  /// The plane of a face, normal inward.
  [[nodiscard]] plane<T> inner_side(std::size_t face) const noexcept {
    return {vertices_[edges_[faces_[face].begin].from], -faces_[face].normal};
  }

  void add_vertex(const vec3<T>& p) noexcept {
    TETRAPORE_EXPECTS(vertex_count_ < max_vertices, "a polyhedron has at most 64 vertices");
    vertices_[vertex_count_++] = p;
  }
  /// A face by its corners, counter-clockwise from outside.
  void add_face(const vec3<T>& outward, std::span<const std::uint8_t> corners) noexcept {
    TETRAPORE_EXPECTS(face_count_ < max_faces, "a polyhedron has at most 32 faces");
    TETRAPORE_EXPECTS(edge_count_ + corners.size() <= max_edges, "a polyhedron has at most 128 edges");
    const std::size_t begin = edge_count_;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      edges_[edge_count_++] = {corners[k], corners[k + 1 == corners.size() ? 0 : k + 1]};
    }
    close_face(outward, begin);
  }

  /// Signed volume [m³].
  [[nodiscard]] T volume() const noexcept {
    T sum(0);
    for (std::size_t f = 0; f < face_count_; ++f) {
      const vec3<T> base = vertices_[edges(f).front().from] - vertices_[0];
      for (const auto& e : edges(f)) {
        sum += triple(base, vertices_[e.from] - vertices_[0], vertices_[e.to] - vertices_[0]);
      }
    }
    return sum / T(6);
  }

  /// Keeps the side that the normal of the plane points to. A cut that does not fit leaves the polyhedron empty and
  /// answers too_complex; a distance that is NaN answers not_finite.
  [[nodiscard]] geometry_status clip(const plane<T>& keep) noexcept {
    detail::workspace<T, max_vertices> distance;
    std::size_t inside = 0;
    for (std::size_t v = 0; v < vertex_count_; ++v) {
      distance[v] = keep.distance(vertices_[v]);
      if (!(distance[v] - distance[v] == T(0))) {
        clear();
        return geometry_status::not_finite;
      }
      inside += distance[v] >= T(0) ? 1U : 0U;
    }
    if (inside == vertex_count_) {
      return geometry_status::ok;
    }
    if (inside == 0) {
      clear();
      return geometry_status::ok;
    }
    const polyhedron whole = *this;
    clear();
    detail::workspace<std::uint8_t, max_vertices> kept;
    for (std::size_t v = 0; v < whole.vertex_count_; ++v) {
      if (distance[v] >= T(0)) {
        kept[v] = static_cast<std::uint8_t>(vertex_count_);
        vertices_[vertex_count_++] = whole.vertices_[v];
      }
    }
    detail::workspace<cut, max_vertices> cuts;
    std::size_t cut_count = 0;
    detail::workspace<directed_edge, max_edges> cap;
    std::size_t cap_count = 0;
    bool fits = true;
    const auto crossing = [&](std::uint8_t in, std::uint8_t out) noexcept -> std::uint8_t {
      for (std::size_t k = 0; k < cut_count; ++k) {
        if (cuts[k].in == in && cuts[k].out == out) {
          return cuts[k].vertex;
        }
      }
      if (vertex_count_ == max_vertices) {
        fits = false;
        return 0;
      }
      const auto v = static_cast<std::uint8_t>(vertex_count_);
      const vec3<T>& p = whole.vertices_[in];
      vertices_[vertex_count_++] = p + (whole.vertices_[out] - p) * (distance[in] / (distance[in] - distance[out]));
      cuts[cut_count++] = {in, out, v};
      return v;
    };
    const auto push = [&](std::uint8_t from, std::uint8_t to) noexcept {
      if (from == to) {
        return;
      }
      if (edge_count_ == max_edges) {
        fits = false;
        return;
      }
      edges_[edge_count_++] = {from, to};
    };
    for (std::size_t f = 0; f < whole.face_count_ && fits; ++f) {
      const std::size_t begin = edge_count_;
      detail::workspace<std::uint8_t, max_vertices> exits;
      detail::workspace<std::uint8_t, max_vertices> entries;
      std::size_t exit_count = 0;
      std::size_t entry_count = 0;
      for (const auto& e : whole.edges(f)) {
        const bool from_in = distance[e.from] >= T(0);
        const bool to_in = distance[e.to] >= T(0);
        if (from_in && to_in) {
          push(kept[e.from], kept[e.to]);
        } else if (from_in) {
          const auto x = crossing(e.from, e.to);
          push(kept[e.from], x);
          fits = fits && exit_count < max_vertices;
          if (fits) {
            exits[exit_count++] = x;
          }
        } else if (to_in) {
          const auto x = crossing(e.to, e.from);
          push(x, kept[e.to]);
          fits = fits && entry_count < max_vertices;
          if (fits) {
            entries[entry_count++] = x;
          }
        }
      }
      // all cuts of a face lie on one line, so any pairing of exits with entries bounds the same area
      for (std::size_t k = 0; k < exit_count && fits; ++k) {
        push(exits[k], entries[k]);
        if (exits[k] != entries[k]) {
          fits = fits && cap_count < max_edges;
          if (fits) {
            cap[cap_count++] = {entries[k], exits[k]};
          }
        }
      }
      if (edge_count_ > begin) {
        close_face(whole.faces_[f].normal, begin);
      }
    }
    fits = fits && edge_count_ + cap_count <= max_edges && (cap_count == 0 || face_count_ < max_faces);
    if (!fits) {
      clear();
      return geometry_status::too_complex;
    }
    if (cap_count > 0) {
      const std::size_t begin = edge_count_;
      for (std::size_t k = 0; k < cap_count; ++k) {
        edges_[edge_count_++] = cap[k];
      }
      close_face(-keep.normal, begin);
    }
    return geometry_status::ok;
  }

 private:
  struct face_record {
    vec3<T> normal;
    std::uint16_t begin;
    std::uint16_t end;
  };
  struct cut {
    std::uint8_t in;
    std::uint8_t out;
    std::uint8_t vertex;
  };

  void clear() noexcept { vertex_count_ = face_count_ = edge_count_ = 0; }
  void close_face(const vec3<T>& outward, std::size_t begin) noexcept {
    faces_[face_count_++] = {outward, static_cast<std::uint16_t>(begin), static_cast<std::uint16_t>(edge_count_)};
  }
  void copy(const polyhedron& other) noexcept {
    vertex_count_ = other.vertex_count_;
    face_count_ = other.face_count_;
    edge_count_ = other.edge_count_;
    for (std::size_t k = 0; k < vertex_count_; ++k) {
      vertices_[k] = other.vertices_[k];
    }
    for (std::size_t k = 0; k < face_count_; ++k) {
      faces_[k] = other.faces_[k];
    }
    for (std::size_t k = 0; k < edge_count_; ++k) {
      edges_[k] = other.edges_[k];
    }
  }

  detail::workspace<vec3<T>, max_vertices> vertices_;
  detail::workspace<face_record, max_faces> faces_;
  detail::workspace<directed_edge, max_edges> edges_;
  std::size_t vertex_count_ = 0;
  std::size_t face_count_ = 0;
  std::size_t edge_count_ = 0;
};

/// The axis-aligned box between two corners, as a polyhedron. \par Units  [m]
template <real T>
[[nodiscard]] polyhedron<T> box_polyhedron(const vec3<T>& lo, const vec3<T>& hi) noexcept {
  polyhedron<T> p;
  for (unsigned k = 0; k < 8; ++k) {
    p.add_vertex({(k & 1U) != 0 ? hi.x : lo.x, (k & 2U) != 0 ? hi.y : lo.y, (k & 4U) != 0 ? hi.z : lo.z});
  }
  constexpr std::array<std::array<std::uint8_t, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t f = 0; f < 6; ++f) {
    vec3<T> n;
    n[f / 2] = f % 2 == 0 ? T(-1) : T(1);
    p.add_face(n, faces[f]);
  }
  return p;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
