// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/concept.hpp"
#include "tetrapore/law/entry/concept.hpp"

#include <optional>

namespace tetrapore::inline TETRAPORE_ABI {

/// Entry pressure of an opening whose arcs stand for pendular rings, where each ring has to exist: the edge decides for
/// the facet. In the plane a gap holds its arc as long as the arc spans it; the ring of liquid around the line between
/// the two grains, of which the arc is a section, ruptures at a lower suction. So an answer stands only if the bridge
/// law has a bridge of that suction in each liquid gap. Otherwise the gap gives way first, and is the one whose arc or
/// ring is lost at the lowest pressure.
/// \tparam Law     the law of the plane picture
/// \tparam Bridge  the law of the rings, of the same liquid and contact angle
/// \par Units   result [Pa]
/// \par Domain  that of both laws: gaps between two grains, or a grain and a wall; where both sides are walls, or the
///              grains touch, the ring cannot be lost
/// \par Accuracy  that of the law inside where it answers; against three-dimensional menisci (se_results.csv) at worst
///                14 %, where arcs alone are 36 % and open gaps alone 66 % off (tests/truth/law/ringed_entry_test.cpp)
/// \par Source  the arcs: Princen, J. Colloid Interface Sci. 30, 69 (1969); rings under suction: Chareyre et al., EPJ
///              Web Conf. 140, 09027 (2017), §2.3, Eq. (4)
template <class Law, class Bridge>
struct ringed {
  Law law;
  Bridge bridge;

  template <real T>
    requires gap_aware_entry_law<Law, T> && ring_limit_law<Bridge, T>
  [[nodiscard]] outcome<T, entry_status> entry_pressure(const opening<T>& o) const noexcept {
    const outcome<T, entry_status> answer = law.entry_pressure(o);
    if (!answer.ok()) {
      return answer;
    }
    for (std::size_t k = 0; k < o.count; ++k) {
      const std::optional<edge<T>> gap = gap_of(o, k);
      if (!gap || !(gap->gap > T(0))) {
        continue;
      }
      const bridge_status ring = bridge.bridge(*gap, given_suction<T>{answer.value}).reason;
      if (verdict_of(ring) == verdict::absent) {
        return {T(quiet_nan<T>), entry_status::gap_limited};
      }
      if (ring != bridge_status::ok && ring != bridge_status::flooded) {
        return {T(quiet_nan<T>), as_entry(ring)};
      }
    }
    return answer;
  }

  /// The gap whose arc or ring is lost first as the pressure rises.
  template <real T>
    requires gap_aware_entry_law<Law, T> && ring_limit_law<Bridge, T>
  [[nodiscard]] outcome<arc_limit<T>, entry_status> first_arc_lost(const opening<T>& o) const noexcept {
    outcome<arc_limit<T>, entry_status> first = law.first_arc_lost(o);
    for (std::size_t k = 0; k < o.count && first.ok(); ++k) {
      const std::optional<edge<T>> gap = gap_of(o, k);
      if (!gap || !(gap->gap > T(0))) {
        continue;
      }
      const outcome<T, bridge_status> limit = bridge.highest_suction(*gap);
      if (verdict_of(limit.reason) > verdict::absent) {
        return {{T(quiet_nan<T>), k}, as_entry(limit.reason)};
      }
      if (limit.value < first.value.pressure) {
        first.value = {limit.value, k};
      }
    }
    return first;
  }

  /// Pressure at which the gap of an edge loses its arc or its ring, whichever comes first.
  template <real T>
    requires gap_aware_entry_law<Law, T> && ring_limit_law<Bridge, T>
  [[nodiscard]] outcome<T, entry_status> arc_lost(const edge<T>& e) const noexcept {
    const outcome<T, entry_status> arc = law.arc_lost(e);
    if (!arc.ok() || !(e.gap > T(0))) {
      return arc;
    }
    const outcome<T, bridge_status> limit = bridge.highest_suction(e);
    if (verdict_of(limit.reason) > verdict::absent) {
      return {T(quiet_nan<T>), as_entry(limit.reason)};
    }
    return {limit.value < arc.value ? limit.value : arc.value, entry_status::lost_arc};
  }

 private:
  [[nodiscard]] static constexpr entry_status as_entry(bridge_status s) noexcept {
    switch (s) {
      case bridge_status::invalid_input: return entry_status::invalid_input;
      case bridge_status::not_converged: return entry_status::not_converged;
      default: return entry_status::not_covered;
    }
  }

  /// The edge in liquid gap k; none between two walls or where the gap is open.
  template <real T>
  [[nodiscard]] static std::optional<edge<T>> gap_of(const opening<T>& o, std::size_t k) noexcept {
    const opening_side<T>& a = o.sides[k];
    const opening_side<T>& b = o.sides[o.next(k)];
    if (o.gaps[k] == gap_state::open || (a.kind == side_kind::line && b.kind == side_kind::line)) {
      return std::nullopt;
    }
    const vec3<T> along{T(1), T(0), T(0)};  // a bridge law does not look where the pair lies
    if (a.kind == side_kind::disc && b.kind == side_kind::disc) {
      return edge<T>{a.radius, b.radius, (norm(b.point - a.point) - a.radius) - b.radius, along};
    }
    const opening_side<T>& grain = a.kind == side_kind::disc ? a : b;
    const opening_side<T>& wall = a.kind == side_kind::disc ? b : a;
    return edge<T>{grain.radius, T(infinity<T>), dot(wall.normal, grain.point - wall.point) - grain.radius, along};
  }
};
template <class Law, class Bridge>
ringed(Law, Bridge) -> ringed<Law, Bridge>;

}  // namespace tetrapore::inline TETRAPORE_ABI
