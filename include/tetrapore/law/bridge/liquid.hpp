// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/concept.hpp"

#include <cstddef>

/// \file
/// The liquid of bridges that come and go: when a bridge forms, and where its liquid goes when it ruptures.
/// \par Source  the usual bookkeeping of wet discrete-element models: Mani, Kadau & Herrmann, Granular Matter 15, 447
///              (2013)

namespace tetrapore::inline TETRAPORE_ABI {

/// Whether a pair carries a bridge: one forms when the surfaces come as near as `creation_gap` (0: at contact; the
/// thickness of two films, where the grains wear one) and lasts until the law says that it is gone.
/// \par Units  [m]
template <real T>
struct bridge_presence {
  T creation_gap{0};
  bool present = false;

  /// The law's answer while there is a bridge; else `no_liquid`, the liquid being on the grains. The arguments after
  /// the edge are those of `law.bridge`: what is given, and the warm state if there is one.
  template <class Law, class... Given>
  [[nodiscard]] auto bridge(const Law& law, const edge<T>& e, Given&&... given) noexcept {
    using answer_type = decltype(law.bridge(e, static_cast<Given&&>(given)...));
    const bool in_reach = present || e.gap <= creation_gap;
    if (!in_reach && e.radius1 > T(0) && e.radius2 > T(0) && e.gap > creation_gap) {
      return answer_type{{}, bridge_status::no_liquid};
    }
    answer_type answer = law.bridge(e, static_cast<Given&&>(given)...);
    if (!in_reach) {  // a pair, gap or distance that is no number: what the law says of it, or that
      answer.reason = answer.kind() == verdict::refused ? answer.reason : bridge_status::invalid_input;
      answer.value.force = T(quiet_nan<T>);
      return answer;
    }
    if (answer.kind() == verdict::ok || answer.kind() == verdict::absent) {
      present = answer.ok();
    }
    return answer;
  }
};

/// Adds liquid to bridges in proportion to a weight (their volume, the wetted area of the grain beside them …), equally
/// where all weights are 0. What is added sums up to `liquid` but for the rounding of the volumes themselves.
/// \par Units   [m³]
/// \par Domain  finite liquid and weights, none negative, and a bridge to take it; else false, nothing is changed and
///              the caller keeps the liquid
template <real T>
[[nodiscard]] constexpr bool share_liquid(const T& liquid, T* volumes, const T* weights, std::size_t count) noexcept {
  const T limit(infinity<T>);
  if (count == 0 || !(liquid >= T(0)) || !(liquid < limit)) {
    return false;
  }
  T total(0);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(weights[i] >= T(0)) || !(weights[i] < limit)) {
      return false;
    }
    total = total + weights[i];
  }
  // each takes its share of what is left, so that the last takes all the rest
  T left = liquid;
  T weight_left = total;
  for (std::size_t i = 0; i < count; ++i) {
    const bool last = i + 1 == count;
    T part = left;
    if (!last) {
      part = total > T(0) ? (weight_left > T(0) ? left * (weights[i] / weight_left) : T(0))
                          : left / T(static_cast<underlying_t<T>>(count - i));
    }
    if (left < part) {
      part = left;
    }
    volumes[i] = volumes[i] + part;
    left = left - part;
    weight_left = weight_left - weights[i];
  }
  return true;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
