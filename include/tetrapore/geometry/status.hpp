// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"

#include <cstdint>

/// \file
/// Why a geometric quantity is what it is.

namespace tetrapore::inline TETRAPORE_ABI {

enum class geometry_status : std::uint8_t {
  ok,
  flat,        ///< the determinant of the cell is indistinguishable from zero: the point is not unique
  not_finite,  ///< an input is NaN or infinite, or the result overflows
  too_complex  ///< more faces than the fixed capacity holds
};

[[nodiscard]] constexpr verdict verdict_of(geometry_status s) noexcept {
  return s == geometry_status::ok ? verdict::ok : verdict::refused;
}

[[nodiscard]] constexpr const char* describe(geometry_status s) noexcept {
  switch (s) {
    case geometry_status::ok: return "ok";
    case geometry_status::flat:
      return "flat: the centres (and wall normals) are coplanar to rounding, so no single point has equal power";
    case geometry_status::not_finite: return "not finite: a coordinate or radius is NaN or infinite, or overflows";
    case geometry_status::too_complex: return "too complex: more balls cut one cell than the fixed capacity holds";
  }
  return "not a geometry status";
}
static_assert(status<geometry_status>);

namespace detail {

template <real T>
[[nodiscard]] constexpr outcome<T, geometry_status> refuse(geometry_status why) noexcept {
  return {T(quiet_nan<T>), why};
}

/// The outcome of a computed number: a NaN or an infinity becomes a status.
template <real T>
[[nodiscard]] constexpr outcome<T, geometry_status> checked(const T& x) noexcept {
  return x - x == T(0) ? outcome<T, geometry_status>{x, geometry_status::ok} : refuse<T>(geometry_status::not_finite);
}

template <real T>
[[nodiscard]] constexpr T magnitude(const T& x) noexcept {
  return x < T(0) ? -x : x;
}

template <real T>
[[nodiscard]] constexpr T smaller(const T& a, const T& b) noexcept {
  return b < a ? b : a;
}

template <real T>
[[nodiscard]] constexpr T larger(const T& a, const T& b) noexcept {
  return a < b ? b : a;
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
