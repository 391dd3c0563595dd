// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"
#include "tetrapore/simplex/edge.hpp"
#include "tetrapore/simplex/opening.hpp"

/// \file
/// What an entry law is.

namespace tetrapore::inline TETRAPORE_ABI {

/// Why an entry pressure is what it is.
enum class entry_status : unsigned char {
  ok,             ///< a meniscus of constant curvature with an arc in every liquid gap
  dry_corner,     ///< the same; at least one pair of sides overlaps so far that its corner holds no arc
  lost_arc,       ///< the widest gap lost its arc: the value is the pressure at which it did, a lower bound
  merged,         ///< the value is that of the facets merged across the widest gap
  closed,         ///< the discs cover the opening: p = infinity
  gap_limited,    ///< refused: the widest gap loses its arc before the meniscus enters
  no_hole,        ///< refused: where the widest gap loses its arc the discs leave no hole between them
  not_covered,    ///< refused: the law does not cover this shape (walls, number of sides, open gaps)
  invalid_input,  ///< refused: NaN, a radius or angle outside its domain, fewer than three sides
  not_converged   ///< failed: the iteration did not reach its tolerance
};

[[nodiscard]] constexpr verdict verdict_of(entry_status s) noexcept {
  switch (s) {
    case entry_status::ok:
    case entry_status::dry_corner:
    case entry_status::lost_arc:
    case entry_status::merged: return verdict::ok;
    case entry_status::closed: return verdict::absent;
    case entry_status::gap_limited:
    case entry_status::no_hole:
    case entry_status::not_covered:
    case entry_status::invalid_input: return verdict::refused;
    case entry_status::not_converged: break;
  }
  return verdict::failed;
}

[[nodiscard]] constexpr const char* describe(entry_status s) noexcept {
  switch (s) {
    case entry_status::ok: return "ok";
    case entry_status::dry_corner: return "a corner is dry: its two sides overlap too far to hold an arc";
    case entry_status::lost_arc: return "the pressure at which the widest gap loses its arc";
    case entry_status::merged: return "the two facets at the widest gap share one meniscus";
    case entry_status::closed: return "closed: the grains cover the opening";
    case entry_status::gap_limited: return "the widest gap loses its arc before the meniscus enters";
    case entry_status::no_hole: return "where the widest gap loses its arc, the grains leave no hole between them";
    case entry_status::not_covered: return "the law does not cover an opening of this shape";
    case entry_status::invalid_input: return "a coordinate, radius, angle or number of sides outside the domain";
    case entry_status::not_converged: return "the iteration did not reach its tolerance";
  }
  return "not an entry status";
}

/// The capillary pressure at which the non-wetting phase enters an opening.
/// Syntax: `l.entry_pressure(opening)`, const and noexcept, gives an outcome in [Pa].
/// Semantics: proportional to surface tension / length; invariant under permutation of the sides and rigid motion;
/// at zero contact angle never lower when a grain grows (at others a grain that grows can lower it: 1.8 % of random
/// growths under mayer_stowe_princen did, by at most 3.3 %); pure: no state, safe in threads. A law that does not cover
/// a shape refuses it.
/// Models: inscribed_circle, mayer_stowe_princen, lost_arc; a user's own.
/// \par Source  Chareyre et al. 2017, §2.3: the entry pressure of a throat
template <class L, class T = double>
concept entry_law = real<T> && std::copyable<L> && requires(const L l, const opening<T> o) {
  { l.entry_pressure(o) } noexcept -> std::same_as<outcome<T, entry_status>>;
};

/// The gap of an opening that loses its arc first when the pressure rises.
template <real T>
struct arc_limit {
  T pressure;       ///< [Pa] pressure at which that gap loses its arc; infinity when no gap ever does
  std::size_t gap;  ///< its index in the ring
};

/// An entry law that also says which gap gives way first, so that a driver can merge the facets there, and at which
/// pressure the gap of an edge does: that is the same for all facets around the edge.
/// Semantics: first_arc_lost(o) is the lowest arc_lost over the liquid gaps of o, to rounding.
template <class L, class T = double>
concept gap_aware_entry_law = entry_law<L, T> && requires(const L l, const opening<T> o, const edge<T> e) {
  { l.first_arc_lost(o) } noexcept -> std::same_as<outcome<arc_limit<T>, entry_status>>;
  { l.arc_lost(e) } noexcept -> std::same_as<outcome<T, entry_status>>;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
