// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/concept.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// Answers for the openings whose widest gap gives way first, with the pressure at which it does: p = σ / r_min, at
/// θ = 0 twice σ over the width of the gap. A lower bound of the pressure at which the gas then passes. Everything else
/// is left to the law inside.
/// \par Units   result [Pa]
/// \par Domain  of the law inside; gap_limited and no_hole become lost_arc, unless no gap has any width
/// \par Accuracy  of the law inside; r_min is the root of a quadratic without cancellation
/// \par Source  an arc of radius r closes a gap as long as ρ + ρ' ≥ d with ρ² = R² + r² + 2 R r cos θ: Princen,
///              J. Colloid Interface Sci. 30, 69 (1969); at θ = 0 what Yade's TwoPhaseFlowEngine does without a flag
template <class Law>
struct lost_arc {
  Law law;

  template <real T>
    requires gap_aware_entry_law<Law, T>
  [[nodiscard]] outcome<T, entry_status> entry_pressure(const opening<T>& o) const noexcept {
    const auto answer = law.entry_pressure(o);
    if (answer.reason != entry_status::gap_limited && answer.reason != entry_status::no_hole) {
      return answer;
    }
    const auto limit = law.first_arc_lost(o);
    if (!limit.ok() || !std::isfinite(value_of(limit.value.pressure))) {
      return answer;
    }
    return {limit.value.pressure, entry_status::lost_arc};
  }

  template <real T>
    requires gap_aware_entry_law<Law, T>
  [[nodiscard]] outcome<arc_limit<T>, entry_status> first_arc_lost(const opening<T>& o) const noexcept {
    return law.first_arc_lost(o);
  }

  template <real T>
    requires gap_aware_entry_law<Law, T>
  [[nodiscard]] outcome<T, entry_status> arc_lost(const edge<T>& e) const noexcept {
    return law.arc_lost(e);
  }
};
template <class Law>
lost_arc(Law) -> lost_arc<Law>;

}  // namespace tetrapore::inline TETRAPORE_ABI
