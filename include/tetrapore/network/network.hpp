// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/core/ids.hpp"
#include "tetrapore/geometry/domain.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// The pore network: topology in flat arrays, and a snapshot of the spheres.

namespace tetrapore::inline TETRAPORE_ABI {

/// Vertices of the facet opposite to each vertex of a pore, counter-clockwise seen from outside.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> facet_vertices{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The flat arrays of a network; what is saved, loaded and validated.
struct network_arrays {
  domain region;
  std::vector<sphere<double>> grains;  ///< snapshot of the caller's spheres [m]

  // per pore
  std::vector<std::array<vertex, 4>> pore_vertices;    ///< grains first, then walls; positive order (see pore_body)
  std::vector<std::array<image, 4>> pore_images;       ///< image of each vertex; empty when no axis is periodic
  std::vector<std::array<throat_id, 4>> pore_throats;  ///< throat opposite to each vertex; invalid opposite to the one
                                                       ///< grain of a corner pore, where nothing lies beyond
  std::vector<vec3<double>> power_centres;             ///< [m]
  std::vector<double> volumes;                         ///< volume of the cell, signed [m³]
  std::vector<double> void_volumes;                    ///< volume of the cell outside the grains [m³]

  // per throat
  std::vector<std::array<pore_id, 2>> throat_pores;  ///< the second is invalid on a boundary
  std::vector<std::uint8_t> throat_slots;  ///< bits 0-1: slot in pore 0, 2-3: slot in pore 1, 4-6: boundary face
  std::vector<image> throat_shifts;        ///< added to pore 1 to lie beside pore 0; empty if not periodic
};

/// A pore network: pores, throats and grains with their topology, volumes and power centres.
///
/// The vertices of pore p are stored grains first, then walls, in positive order; its throat k lies opposite to its
/// vertex k. A throat is seen from its pore 0. Ids name the caller's grains in the order they were given.
/// \par Thread safety  const members may be called from any number of threads.
class network {
 public:
  network() = default;

  /// Takes over arrays that are known to be consistent; see `validate` for arrays of other origin.
  explicit network(network_arrays arrays, std::uint64_t epoch = 0) : a_(std::move(arrays)), epoch_(epoch) {}

  [[nodiscard]] std::size_t grain_count() const noexcept { return a_.grains.size(); }
  [[nodiscard]] std::size_t pore_count() const noexcept { return a_.pore_vertices.size(); }
  [[nodiscard]] std::size_t throat_count() const noexcept { return a_.throat_pores.size(); }
  [[nodiscard]] bool periodic() const noexcept { return !a_.pore_images.empty(); }

  /// Number of the triangulation this network stands for; a rebuild raises it. A field remembers its epoch.
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }
  [[nodiscard]] const domain& region() const noexcept { return a_.region; }
  [[nodiscard]] const network_arrays& arrays() const noexcept { return a_; }
  [[nodiscard]] std::span<const sphere<double>> grains() const noexcept { return a_.grains; }

  // pores ------------------------------------------------------------------------------------------------------------

  [[nodiscard]] const std::array<vertex, 4>& vertices(pore_id p) const noexcept { return a_.pore_vertices[p.index()]; }
  [[nodiscard]] const std::array<throat_id, 4>& throats(pore_id p) const noexcept { return a_.pore_throats[p.index()]; }
  [[nodiscard]] image image_of(pore_id p, std::size_t k) const noexcept {
    return periodic() ? a_.pore_images[p.index()][k] : image{};
  }
  [[nodiscard]] std::size_t grain_vertices(pore_id p) const noexcept {
    std::size_t n = 4;
    for (const vertex v : vertices(p)) {
      n -= v.is_wall() ? 1U : 0U;
    }
    return n;
  }
  /// Volume of the cell [m³]: grains and fluid.
  [[nodiscard]] double volume(pore_id p) const noexcept { return a_.volumes[p.index()]; }
  /// Volume of the fluid in the cell [m³].
  [[nodiscard]] double void_volume(pore_id p) const noexcept { return a_.void_volumes[p.index()]; }
  [[nodiscard]] const vec3<double>& power_centre(pore_id p) const noexcept { return a_.power_centres[p.index()]; }
  [[nodiscard]] bool touches_wall(pore_id p) const noexcept { return vertices(p)[3].is_wall(); }

  /// Whether a pore lies at a face of the box: one of its vertices is that wall, or one of its throats ends there.
  [[nodiscard]] bool touches(pore_id p, face f) const noexcept {
    for (std::size_t k = 0; k < 4; ++k) {
      const vertex v = vertices(p)[k];
      if (v.is_wall() && v.wall() == f) {
        return true;
      }
      const throat_id t = throats(p)[k];
      if (t.valid() && is_boundary(t) && boundary_face(t) == f) {
        return true;
      }
    }
    return false;
  }

  /// The sphere of vertex k of a pore, unwrapped: at the image that belongs to this pore.
  [[nodiscard]] sphere<double> grain_sphere(pore_id p, std::size_t k) const noexcept {
    sphere<double> s = a_.grains[vertices(p)[k].grain().index()];
    if (periodic()) {
      s.centre += a_.region.shift(a_.pore_images[p.index()][k]);
    }
    return s;
  }

  // throats ----------------------------------------------------------------------------------------------------------

  [[nodiscard]] const std::array<pore_id, 2>& pores(throat_id t) const noexcept { return a_.throat_pores[t.index()]; }
  [[nodiscard]] bool is_boundary(throat_id t) const noexcept { return !pores(t)[1].valid(); }
  /// The face of the box at which a boundary throat ends; on an open hull the one its normal points to most.
  [[nodiscard]] face boundary_face(throat_id t) const noexcept {
    return static_cast<face>((a_.throat_slots[t.index()] >> 4U) & 7U);
  }
  /// Which vertex of pore 0 (side 0) or pore 1 (side 1) lies opposite to the throat.
  [[nodiscard]] std::size_t slot(throat_id t, std::size_t side) const noexcept {
    return (a_.throat_slots[t.index()] >> (2U * side)) & 3U;
  }
  /// The pore on the other side; invalid beyond a boundary.
  [[nodiscard]] pore_id across(pore_id p, throat_id t) const noexcept {
    const auto& both = pores(t);
    return both[0] == p ? both[1] : both[0];
  }
  /// Image to add to the coordinates of pore 1 so that it lies beside pore 0.
  [[nodiscard]] image shift(throat_id t) const noexcept { return periodic() ? a_.throat_shifts[t.index()] : image{}; }

  /// Mutable access for the functions that build a network or make it follow its grains.
  [[nodiscard]] network_arrays& mutable_arrays() noexcept { return a_; }

 private:
  network_arrays a_;
  std::uint64_t epoch_ = 0;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
