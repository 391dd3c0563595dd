// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

/// \file
/// Several nodes at once: a number of numbers that the compiler keeps in one register.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

#if defined(__AVX512F__)
inline constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
inline constexpr std::size_t register_bytes = 32;
#else
inline constexpr std::size_t register_bytes = 16;
#endif

/// As many numbers as a register of the machine that is compiled for holds.
template <std::floating_point T>
inline constexpr int native_lanes = static_cast<int>(register_bytes / sizeof(T));

/// N numbers of type T with the four operations, lane by lane: each lane gets the bits that T itself would.
template <std::floating_point T, int N>
struct pack {
  // GCC and clang; a fixed number of bytes, whatever the target
  typedef T values
      __attribute__((vector_size(static_cast<std::size_t>(N) * sizeof(T))));  // NOLINT(modernize-use-using)
  values v;

  pack() = default;
  [[gnu::always_inline]] explicit pack(const T& x) noexcept : v(x - values{}) {}

  [[nodiscard, gnu::always_inline]] static pack load(const T* from) noexcept {
    pack p;
    std::memcpy(&p.v, from, sizeof(values));
    return p;
  }
  [[gnu::always_inline]] void store(T* to) const noexcept { std::memcpy(to, &v, sizeof(values)); }

  /// Lanes of a where the lane's bit is set, else of b.
  [[nodiscard, gnu::always_inline]] static pack select(std::uint32_t lanes, const pack& a, const pack& b) noexcept {
    integers bit{};
    for (int lane = 0; lane < N; ++lane) {
      bit[lane] = static_cast<integer>(std::uint32_t{1} << static_cast<unsigned>(lane));
    }
    const integers chosen = bit & (integers{} + static_cast<integer>(lanes));
    return of(chosen != integers{} ? a.v : b.v);
  }

  [[nodiscard]] T operator[](int lane) const noexcept { return v[lane]; }
  void set(int lane, const T& x) noexcept { v[lane] = x; }

  [[nodiscard, gnu::always_inline]] friend pack operator+(const pack& a, const pack& b) noexcept {
    return of(a.v + b.v);
  }
  [[nodiscard, gnu::always_inline]] friend pack operator-(const pack& a, const pack& b) noexcept {
    return of(a.v - b.v);
  }
  [[nodiscard, gnu::always_inline]] friend pack operator*(const pack& a, const pack& b) noexcept {
    return of(a.v * b.v);
  }
  [[nodiscard, gnu::always_inline]] friend pack operator/(const pack& a, const pack& b) noexcept {
    return of(a.v / b.v);
  }
  [[nodiscard, gnu::always_inline]] friend pack operator-(const pack& a) noexcept { return of(-a.v); }

 private:
  using integer = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
  typedef integer integers
      __attribute__((vector_size(static_cast<std::size_t>(N) * sizeof(T))));  // NOLINT(modernize-use-using)

  [[nodiscard, gnu::always_inline]] static pack of(const values& x) noexcept {
    pack p;
    p.v = x;
    return p;
  }
};

/// The scalar of which a node's numbers are made.
template <class R>
struct lane_of {
  using type = R;
};
template <std::floating_point T, int N>
struct lane_of<pack<T, N>> {
  using type = T;
};

/// f of each lane.
template <std::floating_point T, class F>
[[nodiscard, gnu::always_inline]] inline T lanewise(const T& x, F f) noexcept {
  return f(x);
}
template <std::floating_point T, int N, class F>
[[nodiscard, gnu::always_inline]] inline pack<T, N> lanewise(const pack<T, N>& x, F f) noexcept {
  pack<T, N> y;
  for (int lane = 0; lane < N; ++lane) {
    y.set(lane, f(x[lane]));
  }
  return y;
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
