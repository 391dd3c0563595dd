// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/simplex/throat_hydraulics.hpp"

/// \file
/// What a conductance law is.

namespace tetrapore::inline TETRAPORE_ABI {

/// Why a conductance is what it is.
enum class conductance_status : unsigned char {
  ok,
  closed,                     ///< the discs cover the facet: K = 0
  coincident_nodes,           ///< refused: the two pores have one node, K has no bound; the caller merges them
  negative_hydraulic_radius,  ///< refused: the sectors of the grains hold more than the throat domain
  no_inscribed_circle,        ///< refused: no circle touches the three sides from outside
  not_covered,                ///< refused: the law does not cover this shape
  invalid_input               ///< refused: NaN, a parameter or radius outside its domain
};

[[nodiscard]] constexpr verdict verdict_of(conductance_status s) noexcept {
  switch (s) {
    case conductance_status::ok: return verdict::ok;
    case conductance_status::closed: return verdict::absent;
    case conductance_status::coincident_nodes:
    case conductance_status::negative_hydraulic_radius:
    case conductance_status::no_inscribed_circle:
    case conductance_status::not_covered:
    case conductance_status::invalid_input: break;
  }
  return verdict::refused;
}

[[nodiscard]] constexpr const char* describe(conductance_status s) noexcept {
  switch (s) {
    case conductance_status::ok: return "ok";
    case conductance_status::closed: return "closed: the grains cover the facet";
    case conductance_status::coincident_nodes: return "the two pores have one node: merge them";
    case conductance_status::negative_hydraulic_radius:
      return "the sectors of the grains hold more than the throat domain";
    case conductance_status::no_inscribed_circle: return "no circle touches the three sides of the facet from outside";
    case conductance_status::not_covered: return "the law does not cover a throat of this shape";
    case conductance_status::invalid_input: return "a coordinate, radius or parameter outside the domain";
  }
  return "not a conductance status";
}
static_assert(status<conductance_status>);

/// The hydraulic conductance K of a throat: flux = K (pressure of pore 0 − pressure of pore 1).
/// Syntax: `l.conductance(throat)`, const and noexcept, gives an outcome in [m³/(Pa s)].
/// Semantics: never negative; the same from either pore; proportional to length³ and to 1/viscosity; invariant under
/// permutation of the vertices and rigid motion; pure: no state, safe in threads. A law that does not cover a shape
/// refuses it; where the two nodes coincide it refuses, for the caller has to make them one.
/// Models: hydraulic_radius, mean_radius, darcy, calibrated; a user's own.
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.2, Eq. (1)
template <class L, class T = double>
concept conductance_law = real<T> && std::copyable<L> && requires(const L l, const throat<T> t) {
  { l.conductance(t) } noexcept -> std::same_as<outcome<T, conductance_status>>;
};

/// What hydraulics_of answers.
template <real T>
using hydraulics_outcome = outcome<throat_hydraulics<T>, geometry_status>;

/// A law that asks a throat's hydraulics, and so can be given them by a caller who has them:
/// `l.conductance(throat, hydraulics_of(throat))` is `l.conductance(throat)`, to the last bit.
template <class L, class T = double>
concept hydraulic_law = conductance_law<L, T> && requires(const L l, const throat<T> t, const hydraulics_outcome<T> h) {
  { l.conductance(t, h) } noexcept -> std::same_as<outcome<T, conductance_status>>;
};

namespace detail {

template <real T>
[[nodiscard]] outcome<T, conductance_status> no_conductance(conductance_status why) noexcept {
  return {T(quiet_nan<T>), why};
}

[[nodiscard]] inline bool positive(double x) noexcept { return x > 0 && std::isfinite(x); }

/// What every law of a throat's own geometry asks first: ok, or why there is no conductance.
template <real T>
[[nodiscard]] conductance_status admit(const throat<T>& t, const hydraulics_outcome<T>& h) noexcept {
  T largest(0);
  for (std::size_t k = 0; k < t.grain_count; ++k) {
    if (!(t.grains[k].radius > T(0))) {
      return conductance_status::invalid_input;
    }
    largest = larger(largest, t.grains[k].radius);
  }
  if (!h.ok()) {
    return conductance_status::invalid_input;
  }
  // below this a fluid area is rounding
  if (!(h.value.fluid_area > (h.value.facet_area + largest * largest) * T(8 * epsilon<T>))) {
    return conductance_status::closed;
  }
  return h.value.length > T(0) ? conductance_status::ok : conductance_status::coincident_nodes;
}

template <real T>
[[nodiscard]] outcome<T, conductance_status> refused_by(conductance_status why) noexcept {
  return why == conductance_status::closed ? outcome<T, conductance_status>{T(0), why} : no_conductance<T>(why);
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
