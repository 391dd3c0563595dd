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
      0.723463126, 3.26031771, -13.9892204, 16.6611292, 68.0788211, 0.268052755, -0.754973203, -11.3137449,
      25.7820737, 78.6599379, 0.205899752, -2.65166357, -6.70946195, 53.3655456, -211.297819, -0.241405626,
      -0.269673694, 0.533973016, -19.8843723, 310.435455, 0.0692491045, -0.956370288, 11.3760605, 95.4519811,
      -274.488146, 0.275990899, 0.586011676, -0.80201389, 10.9551811, -51.3532652,
    }},
    {{
      -0.196746347, 0.685162095, 6.41290501, -5.47855226, 36.0420189, 0.0545123642, 3.82928625, -11.5113629,
      10.6040178, 98.297483, 0.325258724, -0.4221367, -13.3653964, 50.3657132, -262.981337, -0.168832052,
      -0.890962869, -8.25682858, -7.61977935, 412.253984, 0.0669695274, -2.60641873, -18.0702346, 178.220348,
      -371.515214, 0.125339349, 0.93384964, -1.89243271, 3.70215951, -52.9789,
    }},
    {{
      0.107807997, -1.39675493, 0.82549081, -2.33722197, 7.16080697, -0.210658033, 1.0199558, 8.68270712, -10.3800246,
      39.9100198, 0.0233416859, 4.26054923, -7.80282584, 11.3561946, -127.904736, -0.0115340724, -0.0755939809,
      4.32423287, -39.775533, 230.950897, 0.174335675, -0.808280562, -30.7425005, 134.083219, -212.793757,
      -0.0634939951, 0.432051196, -0.301517532, 0.7457523, -20.7190612,
    }},
    {{
      -0.00364446867, -0.00816980327, -0.673634139, 0.744860494, 0.927194424, 0.109182973, -1.70295266, 1.48813645,
      -3.11862918, 12.0966226, -0.199555732, 1.01623687, 5.31036898, -7.11303074, -39.1701987, 0.0751940906,
      0.325617814, 2.29493658, -9.16338438, 71.4917832, -0.020513107, 1.84741505, -0.918534288, -14.9626607,
      -65.7042915, -0.0186684807, 0.0992187409, -0.0206243968, 0.0484089275, -4.7472114,
    }},
    {{
      0.0020503381, 0.121530491, -0.0221146177, 0.150411719, 0.193456729, -0.00712911858, -0.0123383463, -1.61452405,
      2.32692251, 1.76809796, 0.0410347102, -1.48814737, 1.397921, -4.17832339, -5.93117255, -0.00880683109,
      -0.461402622, 3.00288301, 7.15004925, 12.4774227, -0.0695353508, 1.94907451, 6.5455582, -40.1412247, -13.276126,
      -0.00485121806, 0.0165288671, 0.0321346567, -0.146103576, -0.85874602,
    }},
}};

/// Sphere and plane; β = −1, the grain being the first.
/// \par Source  least squares on 44 gaps: Brenner 1961, Chem. Eng. Sci. 16, 242 (squeeze); the solution in bispherical
///              coordinates of O'Neill 1964, Mathematika 11, 67, in a form of our own (shear, coupling, roll); Jeffery
///              1915 (twist)
inline constexpr std::array<regular_lanes<double>, 1> regular_of_plane{{
    {{
      0.694059213, 1.2898574, -3.94258863, 5.1266808, 9.61448941, 0.223209411, 1.95273959, -10.2201519, 16.3816593,
      26.7618323, 0.146163038, 5.67264207, -26.0991072, 122.872653, -78.1114099, -0.110730072, -6.90777545,
      14.0638035, -112.771968, 131.540505, 0.0605199347, 5.67817759, -47.9937838, 427.986157, -120.582176, 0.18605734,
      3.99284038, -4.80633912, 18.8078387, -14.2173979,
    }},
}};

template <class V, std::size_t N>
[[nodiscard]] constexpr std::array<regular_lanes<V>, N> converted(const std::array<regular_lanes<double>, N>& table) noexcept {
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

/// The polynomial in x of one lane.
template <std::size_t Row, real T, std::size_t N>
[[nodiscard]] constexpr T lane(const std::array<regular_lanes<underlying_t<T>>, N>& table, std::size_t k,
                               const T& x) noexcept {
  if constexpr (Row + 1 == N) {
    return T(table[Row][k]);
  } else {
    return T(table[Row][k]) + x * lane<Row + 1, T>(table, k, x);
  }
}

/// The five regular parts, by the polynomial in x that the rows of the table are.
template <real T, std::size_t N>
[[nodiscard]] inline std::array<T, 5> regular_part(const std::array<regular_lanes<underlying_t<T>>, N>& table, const T& x,
                                                   const T& p, const T& logarithm) noexcept {
  regular_lanes<T> sum;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    sum[k] = lane<0, T>(table, k, x);
  }
  const T slow = p * logarithm;
  std::array<T, 5> out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = sum[k] + p * (sum[5 + k] + p * (sum[10 + k] + p * (sum[15 + k] + p * sum[20 + k]))) +
             slow * sum[25 + k];
  }
  return out;
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
