// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

/// \file
/// Strong indices: an id of one kind cannot be used as an id of another.

namespace tetrapore::inline TETRAPORE_ABI {

/// Index of a simplex in the flat arrays of a network, or of a grain in the caller's range.
template <class Tag>
struct id {
  std::uint32_t value = 0xffffffffU;

  constexpr id() noexcept = default;
  constexpr explicit id(std::size_t index) noexcept : value(static_cast<std::uint32_t>(index)) {}

  [[nodiscard]] constexpr bool valid() const noexcept { return value != 0xffffffffU; }
  [[nodiscard]] constexpr std::size_t index() const noexcept { return value; }
  [[nodiscard]] friend constexpr auto operator<=>(const id&, const id&) noexcept = default;
};

using grain_id = id<struct grain_tag>;    ///< position in the caller's range of spheres
using edge_id = id<struct edge_tag>;      ///< a pair of neighbouring grains
using throat_id = id<struct throat_tag>;  ///< a facet
using pore_id = id<struct pore_tag>;      ///< a tetrahedron

/// The six faces of a box; also the names of the boundaries of a network.
enum class face : std::uint8_t { x_min, x_max, y_min, y_max, z_min, z_max };

inline constexpr std::array<face, 6> all_faces{face::x_min, face::x_max, face::y_min,
                                               face::y_max, face::z_min, face::z_max};

[[nodiscard]] constexpr std::size_t axis_of(face f) noexcept { return static_cast<std::size_t>(f) / 2; }
[[nodiscard]] constexpr bool is_max(face f) noexcept { return static_cast<std::uint8_t>(f) % 2 == 1; }
[[nodiscard]] constexpr face opposite(face f) noexcept {
  return static_cast<face>(static_cast<std::uint8_t>(f) ^ std::uint8_t{1});
}
[[nodiscard]] constexpr const char* describe(face f) noexcept {
  constexpr std::array<const char*, 6> names{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  return names[static_cast<std::size_t>(f)];
}

/// Periodic image: how many box lengths are added along each axis.
struct image {
  std::int8_t x = 0;
  std::int8_t y = 0;
  std::int8_t z = 0;

  [[nodiscard]] friend constexpr image operator+(image a, image b) noexcept {
    return {static_cast<std::int8_t>(a.x + b.x), static_cast<std::int8_t>(a.y + b.y),
            static_cast<std::int8_t>(a.z + b.z)};
  }
  [[nodiscard]] friend constexpr image operator-(image a, image b) noexcept {
    return {static_cast<std::int8_t>(a.x - b.x), static_cast<std::int8_t>(a.y - b.y),
            static_cast<std::int8_t>(a.z - b.z)};
  }
  [[nodiscard]] friend constexpr auto operator<=>(const image&, const image&) noexcept = default;
};

/// A vertex of a pore: a grain of the caller's range, or a wall plane of the box.
class vertex {
 public:
  constexpr vertex() noexcept = default;
  constexpr explicit vertex(grain_id g) noexcept : code_(static_cast<std::int32_t>(g.value)) {}
  constexpr explicit vertex(face wall) noexcept : code_(-1 - static_cast<std::int32_t>(wall)) {}

  [[nodiscard]] constexpr bool is_wall() const noexcept { return code_ < 0; }
  [[nodiscard]] constexpr grain_id grain() const noexcept { return grain_id(static_cast<std::size_t>(code_)); }
  [[nodiscard]] constexpr face wall() const noexcept { return static_cast<face>(-1 - code_); }
  [[nodiscard]] constexpr std::int32_t code() const noexcept { return code_; }
  [[nodiscard]] static constexpr vertex from_code(std::int32_t code) noexcept {
    vertex v;
    v.code_ = code;
    return v;
  }
  [[nodiscard]] friend constexpr auto operator<=>(const vertex&, const vertex&) noexcept = default;

 private:
  std::int32_t code_ = 0;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
