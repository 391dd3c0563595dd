// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/ids.hpp"

#include <cstdint>
#include <initializer_list>
#include <string>

/// \file
/// Some of the six faces of a box.

namespace tetrapore::inline TETRAPORE_ABI {

class face_set {
 public:
  constexpr face_set() noexcept = default;
  constexpr face_set(face f) noexcept : bits_(bit(f)) {}  // NOLINT(google-explicit-constructor)
  constexpr face_set(std::initializer_list<face> faces) noexcept {
    for (const face f : faces) {
      bits_ = static_cast<std::uint8_t>(bits_ | bit(f));
    }
  }

  [[nodiscard]] constexpr bool contains(face f) const noexcept { return (bits_ & bit(f)) != 0; }
  [[nodiscard]] constexpr bool empty() const noexcept { return bits_ == 0; }
  [[nodiscard]] friend constexpr face_set operator&(face_set a, face_set b) noexcept {
    face_set both;
    both.bits_ = static_cast<std::uint8_t>(a.bits_ & b.bits_);
    return both;
  }
  [[nodiscard]] friend constexpr face_set operator|(face_set a, face_set b) noexcept {
    face_set either;
    either.bits_ = static_cast<std::uint8_t>(a.bits_ | b.bits_);
    return either;
  }
  [[nodiscard]] friend constexpr bool operator==(face_set, face_set) noexcept = default;

 private:
  [[nodiscard]] static constexpr std::uint8_t bit(face f) noexcept {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(f));
  }
  std::uint8_t bits_ = 0;
};

/// The names of the faces, in brackets: "{y_min, y_max}".
[[nodiscard]] inline std::string describe(face_set faces) {
  std::string text = "{";
  for (const face f : all_faces) {
    if (faces.contains(f)) {
      text += (text.size() > 1 ? ", " : "") + std::string(describe(f));
    }
  }
  return text + "}";
}

}  // namespace tetrapore::inline TETRAPORE_ABI
