// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/real.hpp"

#include <array>
#include <cstddef>

/// \file
/// What is left of the resistance of a pair when its singular part is taken away, fitted to the exact solution: data of
/// two_spheres and sphere_plane, and how they are summed.

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

/// Lane 5 t + k holds what the term t gives to the number k. Terms: 1, p, p², p³, p⁴, p ln(1/p) with p = h/(h +
/// 4a*). Numbers: squeeze, shear, coupling, roll, twist, by 6πa*, πa*, πβa*², πa*³ and πa*³ with
/// β = (a1 − a2)/(a1 + a2).
template <class V>
using regular_lanes = std::array<V, 30>;

/// Powers of 4β²/(1 + β²/2) − 1, of two spheres, λ from 1 to 0.1; the twist by a further 1/(1 + 3β²)².
/// \par Source  least squares on 792 pairs of radii and gaps: the series of Jeffrey & Onishi 1984, J. Fluid Mech. 139,
///              261, to order 240, and for the twist Jeffery 1915, Proc. London Math. Soc. 14, 327
inline constexpr std::array<regular_lanes<double>, 5> regular_of_spheres{{
    {{
        0.723436795,  3.26032031,  -13.9892062, 16.6608404,   68.0805921,   0.267057469,  -0.752604361, -11.3582181,
        25.4192805,   81.8246117,  0.202841054, -2.66373433,  -6.32467057,  55.2539443,   -225.820855,  -0.217142099,
        -0.238242218, -1.00499665, -24.6844098, 338.177664,   0.0334619257, -0.988433503, 13.5161227,   100.065145,
        -289.332282,  0.276644392, 0.585413954, -0.794217703, 11.0423216,   -52.1165088,
    }},
    {{
        -0.196774014, 0.68516778,  6.41291984,  -5.47878002,  36.0444027,  0.0533233351, 3.84714304,  -11.4799611,
        10.0178233,   102.52166,   0.323105055, -0.540463408, -13.5451413, 54.462427,    -282.389144, -0.146959664,
        -0.498871915, -7.76250948, -22.1652544, 449.504242,   0.033820663, -3.09009276,  -18.5756605, 197.251631,
        -391.768145,  0.126051366, 0.930061275, -1.89938488,  3.82745389,  -53.9985597,
    }},
    {{
        0.107791801,  -1.39675892,   0.825580177,  -2.33743974,  7.16214698,  -0.211987125, 1.02254892,  8.86632047,
        -10.9859512,  42.2286022,    0.0259221672, 4.23164728,   -8.98387715, 15.7884053,   -138.542648, -0.0105083626,
        0.0512974221, 8.19212998,    -56.2373745,  251.428041,   0.168649443, -0.991481171, -35.5044172, 156.352201,
        -224.087365,  -0.0629364606, 0.431758851,  -0.341951467, 0.873908945, -21.2807369,
    }},
    {{
        -0.00363101986, -0.00817891696, -0.673632868,    0.744845217,   0.927672469,  0.109585921,
        -1.71520025,    1.4985115,      -3.1228062,      12.9014476,    -0.19740326,  1.086931,
        5.21125108,     -7.04915279,    -42.8779775,     0.0610666562,  0.117220819,  2.73957766,
        -9.59773405,    78.764185,      -0.000244880256, 2.08344561,    -1.59007271,  -14.1406521,
        -69.9705035,    -0.0189768332,  0.102076619,     -0.0226258167, 0.0499361168, -4.94287095,
    }},
    {{
        0.00206037164, 0.121526744,    -0.0221503129, 0.150539917,   0.193568765,  -0.00660550938,
        -0.0169398343, -1.66803178,    2.58278875,    1.94982903,    0.0411902221, -1.46091737,
        1.70612705,    -5.8306118,     -6.75455259,   -0.0147096954, -0.545201919, 2.10626469,
        12.6152448,    14.0365654,     -0.0599369303, 2.04823147,    7.54309937,   -46.9406315,
        -14.1051734,   -0.00512753247, 0.0176102373,  0.0444957871,  -0.202751973, -0.90321976,
    }},
}};

/// Sphere and plane; β = −1, the grain being the first.
/// \par Source  least squares on 44 gaps: Brenner 1961, Chem. Eng. Sci. 16, 242 (squeeze); the solution in bispherical
///              coordinates of O'Neill 1964, Mathematika 11, 67, in a form of our own (shear, coupling, roll); Jeffery
///              1915 (twist)
inline constexpr std::array<regular_lanes<double>, 1> regular_of_plane{{
    {{
        0.694043786, 1.2897975,   -3.94240232, 5.12565685,  9.61529495,  0.222183552, 1.94482891,  -9.97821419,
        14.4818413,  28.1488606,  0.147129818, 5.61419442,  -27.4705122, 135.262342,  -84.4747092, -0.105122345,
        -6.44479187, 18.0523995,  -154.484037, 143.789087,  0.04967995,  4.89086821,  -52.4713083, 480.789908,
        -127.339117, 0.186536293, 3.99733727,  -4.86360282, 19.2308866,  -14.5534383,
    }},
}};

template <class V, std::size_t N>
[[nodiscard]] constexpr std::array<regular_lanes<V>, N> converted(
    const std::array<regular_lanes<double>, N>& table) noexcept {
  std::array<regular_lanes<V>, N> out{};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < out[i].size(); ++k) {
      out[i][k] = static_cast<V>(table[i][k]);
    }
  }
  return out;
}

template <class V>
inline constexpr auto regular_of_spheres_as = converted<V>(regular_of_spheres);
template <class V>
inline constexpr auto regular_of_plane_as = converted<V>(regular_of_plane);

/// The polynomial in x of one lane, in two halves that do not wait for each other.
template <real T, std::size_t N>
[[nodiscard]] constexpr T lane(const std::array<regular_lanes<underlying_t<T>>, N>& table, std::size_t k,
                               [[maybe_unused]] const T& x, [[maybe_unused]] const T& square) noexcept {
  if constexpr (N == 1) {
    return T(table[0][k]);
  } else {
    static_assert(N == 5);
    return (T(table[0][k]) + x * T(table[1][k])) +
           square * (T(table[2][k]) + (x * T(table[3][k]) + square * T(table[4][k])));
  }
}

/// The five regular parts, by the polynomial in x that the rows of the table are.
template <real T, std::size_t N>
[[nodiscard]] inline std::array<T, 5> regular_part(const std::array<regular_lanes<underlying_t<T>>, N>& table,
                                                   const T& x, const T& p, const T& logarithm) noexcept {
  const T square = x * x;
  regular_lanes<T> sum;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    sum[k] = lane<T>(table, k, x, square);
  }
  const T slow = p * logarithm;
  const T p2 = p * p;
  std::array<T, 5> out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = (sum[k] + p * sum[5 + k]) + p2 * ((sum[10 + k] + p * sum[15 + k]) + p2 * sum[20 + k]) + slow * sum[25 + k];
  }
  return out;
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
