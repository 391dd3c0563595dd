// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/lubrication/concept.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// Any lubrication law between rough grains: where the gap is narrower than the asperities are high, the liquid between
/// them flows as through a gap of their height, so that grains that touch or overlap by a part of a radius have a
/// finite resistance too. The arms are those of the true gap: a rigid motion of the pair costs nothing.
/// \par Units   height [m]
/// \par Domain  height > 0; gap > −radius of the smaller grain
/// \par Accuracy  the law's own; at a gap above the height, its very answer
/// \par Source  the cut-off of Ball & Melrose 1997, Physica A 247, 444, §2, and of the wet contact of Yade
template <class Law>
struct rough {
  Law law;
  required<double> height;

  template <real T>
    requires lubrication_law<Law, T>
  [[nodiscard]] outcome<pair_resistance<T>, pair_status> resistance(const edge<T>& e) const noexcept {
    const T least = T(static_cast<underlying_t<T>>(height.get()));
    if (!(height > 0 && height < infinity<double>) || !(e.gap > -e.radius1) || !(e.gap > -e.radius2)) {
      return detail::no_resistance<T>(pair_status::invalid_input);
    }
    if (!(e.gap < least)) {
      return law.resistance(e);
    }
    edge<T> open = e;
    open.gap = least;
    auto answer = law.resistance(open);
    if (answer.ok()) {
      const T half = e.gap * T(0.5);
      answer.value.arm1 = e.radius1 + half;
      answer.value.arm2 = e.with_plane() ? half : e.radius2 + half;
    }
    return answer;
  }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
