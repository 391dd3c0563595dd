// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <utility>

/// \file
/// Lattices: the velocities of a lattice Boltzmann model and their weights.
///
/// Directions stand in pairs: 0 is at rest, 2k + 1 and 2k + 2 are opposite. Pairs that mirrors on the axes exchange
/// stand side by side in a group of 1, 2 or 4, and sums run over groups by a balanced tree: that makes a step commute
/// with such mirrors to the last bit.

/// A lambda of a kernel: the loop over nodes must become one piece of code, or its numbers live in memory.
#define TETRAPORE_INLINE __attribute__((always_inline))

/// What was read is read again: a compiler would keep it, on the stack where registers run out. A back end that has no
/// use for this defines it empty.
#ifndef TETRAPORE_READ_AGAIN
#define TETRAPORE_READ_AGAIN() asm volatile("" ::: "memory")
#endif

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// A lattice.
/// Syntax: `dimensions`; `directions`; `velocity[i]`, three integers; `weight[i]`; `groups`, sizes of the groups of
/// pairs.
/// Semantics: weights isotropic to the fourth order with a speed of sound of 1/√3 (static_assert by isotropic<L>()).
/// Models: d2q9, d3q19, d3q27; a user's own.
template <class L>
concept lattice = requires {
  { L::dimensions } -> std::convertible_to<int>;
  { L::directions } -> std::convertible_to<std::size_t>;
  { L::velocity[0][0] } -> std::convertible_to<int>;
  { L::weight[0] } -> std::convertible_to<double>;
  { L::groups[0] } -> std::convertible_to<int>;
};

template <lattice L>
inline constexpr int pairs = static_cast<int>((L::directions - 1) / 2);

[[nodiscard]] constexpr int opposite(int i) noexcept { return i == 0 ? 0 : ((i - 1) ^ 1) + 1; }

/// The direction of a velocity; −1 where the lattice has none.
template <lattice L>
[[nodiscard]] constexpr int direction_of(int x, int y, int z) noexcept {
  for (int i = 0; i < static_cast<int>(L::directions); ++i) {
    const auto& c = L::velocity[static_cast<std::size_t>(i)];
    if (c[0] == x && c[1] == y && c[2] == z) {
      return i;
    }
  }
  return -1;
}

/// Direction i as a mirror across the axis sees it.
template <lattice L>
[[nodiscard]] constexpr int mirrored(int i, int axis) noexcept {
  auto c = L::velocity[static_cast<std::size_t>(i)];
  c[static_cast<std::size_t>(axis)] = -c[static_cast<std::size_t>(axis)];
  return direction_of<L>(c[0], c[1], c[2]);
}

/// Whether pairs are opposite, groups add up, and the moments of the weights are those of a Gaussian to fourth order.
template <lattice L>
[[nodiscard]] constexpr bool isotropic() noexcept {
  const auto near = [](double a, double b) { return a - b < 1e-15 && b - a < 1e-15; };
  int grouped = 0;
  for (const int g : L::groups) {
    grouped += g;
  }
  if (grouped != pairs<L>) {
    return false;
  }
  const auto c = [](int i, int a) { return L::velocity[static_cast<std::size_t>(i)][static_cast<std::size_t>(a)]; };
  for (int i = 0; i < static_cast<int>(L::directions); ++i) {
    for (int a = 0; a < 3; ++a) {
      if (c(i, a) != -c(opposite(i), a) || (a >= L::dimensions && c(i, a) != 0)) {
        return false;
      }
    }
  }
  const auto moment = [&](auto&& of) {
    double sum = 0;
    for (int i = 0; i < static_cast<int>(L::directions); ++i) {
      sum += L::weight[static_cast<std::size_t>(i)] * of(i);
    }
    return sum;
  };
  if (!near(moment([](int) { return 1; }), 1)) {
    return false;
  }
  const auto delta = [](int a, int b) { return a == b ? 1 : 0; };
  for (int a = 0; a < L::dimensions; ++a) {
    for (int b = 0; b < L::dimensions; ++b) {
      if (!near(moment([&](int i) { return c(i, a) * c(i, b); }), delta(a, b) / 3.0)) {
        return false;
      }
      for (int d = 0; d < L::dimensions; ++d) {
        for (int e = 0; e < L::dimensions; ++e) {
          const double gaussian =
              (delta(a, b) * delta(d, e) + delta(a, d) * delta(b, e) + delta(a, e) * delta(b, d)) / 9.0;
          if (!near(moment([&](int i) { return c(i, a) * c(i, b) * c(i, d) * c(i, e); }), gaussian)) {
            return false;
          }
        }
      }
    }
  }
  return true;
}

/// \par Source  Qian, d'Humières & Lallemand, Europhys. Lett. 17, 479 (1992)
struct d2q9 {
  static constexpr int dimensions = 2;
  static constexpr std::size_t directions = 9;
  static constexpr std::array<std::array<int, 3>, 9> velocity{
      {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}}};
  static constexpr std::array<double, 9> weight{4.0 / 9,  1.0 / 9,  1.0 / 9,  1.0 / 9, 1.0 / 9,
                                                1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36};
  static constexpr std::array<int, 3> groups{1, 1, 2};
};
static_assert(isotropic<d2q9>());

/// \par Source  Qian, d'Humières & Lallemand, Europhys. Lett. 17, 479 (1992)
struct d3q19 {
  static constexpr int dimensions = 3;
  static constexpr std::size_t directions = 19;
  static constexpr std::array<std::array<int, 3>, 19> velocity{{{0, 0, 0},
                                                                {1, 0, 0},
                                                                {-1, 0, 0},
                                                                {0, 1, 0},
                                                                {0, -1, 0},
                                                                {0, 0, 1},
                                                                {0, 0, -1},
                                                                {1, 1, 0},
                                                                {-1, -1, 0},
                                                                {1, -1, 0},
                                                                {-1, 1, 0},
                                                                {1, 0, 1},
                                                                {-1, 0, -1},
                                                                {1, 0, -1},
                                                                {-1, 0, 1},
                                                                {0, 1, 1},
                                                                {0, -1, -1},
                                                                {0, 1, -1},
                                                                {0, -1, 1}}};
  static constexpr std::array<double, 19> weight = [] {
    std::array<double, 19> w{};
    for (std::size_t i = 0; i < 19; ++i) {
      w[i] = i == 0 ? 1.0 / 3 : i < 7 ? 1.0 / 18 : 1.0 / 36;
    }
    return w;
  }();
  static constexpr std::array<int, 6> groups{1, 1, 1, 2, 2, 2};
};
static_assert(isotropic<d3q19>());

/// All 27 neighbours.
/// \par Source  He & Luo, Phys. Rev. E 56, 6811 (1997)
struct d3q27 {
  static constexpr int dimensions = 3;
  static constexpr std::size_t directions = 27;
  static constexpr std::array<std::array<int, 3>, 27> velocity = [] {
    std::array<std::array<int, 3>, 27> c{};
    for (std::size_t i = 0; i < 19; ++i) {
      c[i] = d3q19::velocity[i];
    }
    constexpr std::array<std::array<int, 3>, 4> corner{{{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      c[19 + 2 * k] = corner[k];
      c[20 + 2 * k] = {-corner[k][0], -corner[k][1], -corner[k][2]};
    }
    return c;
  }();
  static constexpr std::array<double, 27> weight = [] {
    std::array<double, 27> w{};
    for (std::size_t i = 0; i < 27; ++i) {
      w[i] = i == 0 ? 8.0 / 27 : i < 7 ? 2.0 / 27 : i < 19 ? 1.0 / 54 : 1.0 / 216;
    }
    return w;
  }();
  static constexpr std::array<int, 7> groups{1, 1, 1, 2, 2, 2, 4};
};
static_assert(isotropic<d3q27>());

namespace detail {

template <int K>
using number = std::integral_constant<int, K>;

template <class F, int... K>
[[gnu::always_inline]] constexpr void unroll(F&& f, std::integer_sequence<int, K...>) {
  (f(number<K>{}), ...);
}

/// f(k) for k = 0 … N − 1, each a constant.
template <int N, class F>
[[gnu::always_inline]] constexpr void repeat(F&& f) {
  unroll(f, std::make_integer_sequence<int, N>{});
}

template <lattice L>
[[nodiscard]] constexpr int first_of_group(int g) noexcept {
  int first = 0;
  for (int k = 0; k < g; ++k) {
    first += L::groups[static_cast<std::size_t>(k)];
  }
  return first;
}

/// The sum of `of(k)` over the pairs of a lattice for which `counts(k)`, in the order that mirrors leave alone; the
/// part of pairs k, k + 1, … of one length goes through `weigh(k, part)`. Without a single pair: 0.
template <lattice L, class R, class Counts, class Of, class Weigh>
[[nodiscard, gnu::always_inline]] inline R sum_over_pairs(Counts counts, Of of, Weigh weigh) noexcept {
  R total(0);
  bool begun = false;
  const auto add = [&](const R& x) TETRAPORE_INLINE {
    total = begun ? total + x : x;
    begun = true;
  };
  repeat<static_cast<int>(L::groups.size())>([&]<int G>(detail::number<G>) TETRAPORE_INLINE {
    constexpr int first = first_of_group<L>(G);
    constexpr int size = L::groups[static_cast<std::size_t>(G)];
    static_assert(size == 1 || size == 2 || size == 4, "a group has 1, 2 or 4 pairs");
    if constexpr (counts(number<first>{})) {
      if constexpr (size == 1) {
        add(weigh(number<first>{}, of(number<first>{})));
      } else if constexpr (size == 2) {
        add(weigh(number<first>{}, of(number<first>{}) + of(number<first + 1>{})));
      } else {
        add(weigh(number<first>{}, (of(number<first>{}) + of(number<first + 1>{})) +
                                       (of(number<first + 2>{}) + of(number<first + 3>{}))));
      }
    }
  });
  return total;
}
template <lattice L, class R, class Counts, class Of>
[[nodiscard, gnu::always_inline]] inline R sum_over_pairs(Counts counts, Of of) noexcept {
  return sum_over_pairs<L, R>(counts, of, [](auto, const R& part) TETRAPORE_INLINE { return part; });
}

/// Velocity of the first direction of pair k along an axis.
template <lattice L>
[[nodiscard]] constexpr int along(int pair, int axis) noexcept {
  return L::velocity[static_cast<std::size_t>(2 * pair + 1)][static_cast<std::size_t>(axis)];
}

/// ± x, or 0 where c is.
template <int C, class R>
[[nodiscard, gnu::always_inline]] inline R times_sign(const R& x) noexcept {
  static_assert(C == 1 || C == -1);
  if constexpr (C == 1) {
    return x;
  } else {
    return -x;
  }
}

/// Σ c_axis (first − second) over all pairs of an array of one number for each direction.
template <lattice L, int Axis, class R>
[[nodiscard, gnu::always_inline]] inline R first_moment(const R (&f)[L::directions]) noexcept {
  return sum_over_pairs<L, R>([]<int K>(detail::number<K>) TETRAPORE_INLINE { return along<L>(K, Axis) != 0; },
                              [&]<int K>(detail::number<K>) TETRAPORE_INLINE {
                                constexpr int i = 2 * K + 1;
                                return times_sign<along<L>(K, Axis)>(f[i] - f[i + 1]);
                              });
}

}  // namespace detail
}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
