// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"
#include "tetrapore/simplex/edge.hpp"

/// \file
/// What a bridge law is: the liquid that hangs between two grains, or a grain and a plane.

namespace tetrapore::inline TETRAPORE_ABI {

/// Why a bridge is what it is.
enum class bridge_status : unsigned char {
  ok,
  no_liquid,    ///< absent: a volume of zero
  ruptured,     ///< absent: beyond the fold, there is no bridge of this volume or suction across this gap
  lopsided,     ///< absent: the symmetric bridge of equal grains has lost its stability: the liquid slides to one side
  flooded,      ///< refused: so much liquid, or so little suction, that no bridge ends on both surfaces
  not_covered,  ///< refused: the law does not cover this pair (a plane, unequal radii or angles, its fitted range)
  invalid_input,  ///< refused: NaN, a negative volume, a radius, angle or gap outside its domain
  not_converged   ///< failed: the iteration did not reach its tolerance
};

[[nodiscard]] constexpr verdict verdict_of(bridge_status s) noexcept {
  switch (s) {
    case bridge_status::ok: return verdict::ok;
    case bridge_status::no_liquid:
    case bridge_status::ruptured:
    case bridge_status::lopsided: return verdict::absent;
    case bridge_status::flooded:
    case bridge_status::not_covered:
    case bridge_status::invalid_input: return verdict::refused;
    case bridge_status::not_converged: break;
  }
  return verdict::failed;
}

[[nodiscard]] constexpr const char* describe(bridge_status s) noexcept {
  switch (s) {
    case bridge_status::ok: return "ok";
    case bridge_status::no_liquid: return "there is no liquid";
    case bridge_status::ruptured: return "no bridge of this volume or suction spans the gap";
    case bridge_status::lopsided: return "the symmetric bridge is unstable: the liquid slides to one grain";
    case bridge_status::flooded: return "no bridge with so much liquid ends on both surfaces";
    case bridge_status::not_covered: return "the law does not cover a pair like this";
    case bridge_status::invalid_input: return "a radius, gap, angle, volume or suction outside the domain";
    case bridge_status::not_converged: return "the iteration did not reach its tolerance";
  }
  return "not a bridge status";
}
static_assert(status<bridge_status>);

/// The bridge that holds a volume, as where liquid cannot leave the pair. \par Units  [m³]
template <real T>
struct given_volume {
  T value;
};

/// The bridge at a suction, as where films or vapour tie it to a reservoir. \par Units  [Pa], gas less liquid
template <real T>
struct given_suction {
  T value;
};

/// The capillary force of a pair.
/// Syntax: `l.bridge(edge, given)`, const and noexcept, gives an outcome whose value has a member `force` [N], positive
/// where it pulls the pair together. `Given` is given_volume or given_suction.
/// Semantics: the same when the pair is seen from its other end (with its angles); scales as surface tension × length
/// when lengths scale; the derivative of the energy by the gap where the law knows one; 0 where the bridge is
/// absent and NaN where the law has no answer; pure: no state, safe in threads.
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.3, Eq. (4)
template <class L, class T = double, class Given = given_volume<T>>
concept bridge_law = real<T> && std::copyable<L> && requires(const L l, const edge<T> e, const Given g) {
  { l.bridge(e, g).value.force } -> std::convertible_to<T>;
  { l.bridge(e, g).reason } -> std::convertible_to<bridge_status>;
  requires noexcept(l.bridge(e, g));
};

/// A bridge law that takes up from the last step of the same pair: faster, the same answer to the stated error.
/// `L::warm_state` is a small copyable value; a new one starts cold.
template <class L, class T = double, class Given = given_volume<T>>
concept warm_bridge_law = bridge_law<L, T, Given> &&
                          requires(const L l, const edge<T> e, const Given g, typename L::template warm_state<T> w) {
                            { l.bridge(e, g, w).value.force } -> std::convertible_to<T>;
                          };

/// A bridge law that knows the highest suction at which a bridge spans a gap: there is one at any lower suction of its
/// domain, and none above. `l.highest_suction(edge)` gives it in [Pa]; infinite where the surfaces touch.
template <class L, class T = double>
concept ring_limit_law = bridge_law<L, T, given_suction<T>> && requires(const L l, const edge<T> e) {
  { l.highest_suction(e) } noexcept -> std::same_as<outcome<T, bridge_status>>;
};

/// The force alone: the answer of a closed form.
template <real T>
struct bridge_pull {
  T force;  ///< [N], positive where it pulls the pair together
};

}  // namespace tetrapore::inline TETRAPORE_ABI
