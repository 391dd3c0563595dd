// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/concept.hpp"
#include "tetrapore/network/network.hpp"
#include "tetrapore/two_phase/state.hpp"

#include <algorithm>
#include <concepts>
#include <span>
#include <type_traits>
#include <vector>

/// \file
/// What drainage asks for a threshold.

namespace tetrapore::inline TETRAPORE_ABI {

/// What is known of a value: it lies in [lo, hi]. A closed law gives lo == hi.
template <class T>
struct bracket {
  T lo;
  T hi;

  [[nodiscard]] static constexpr bracket exactly(T value) noexcept { return {value, value}; }
  [[nodiscard]] constexpr bool exact() const noexcept { return !(lo < hi); }
  /// The value that stands for the bracket: its middle.
  [[nodiscard]] constexpr T value() const noexcept { return exact() ? lo : lo + (hi - lo) / 2; }
  [[nodiscard]] constexpr bool contains(const T& x) const noexcept { return lo <= x && x <= hi; }
  [[nodiscard]] constexpr bool contains(const bracket& inner) const noexcept {
    return lo <= inner.lo && inner.hi <= hi;
  }
  [[nodiscard]] friend constexpr bool operator==(const bracket&, const bracket&) = default;
};

/// The answer of a rule. \par Units  [Pa]
using threshold_outcome = outcome<bracket<double>, entry_status>;

/// A rule says at compile time whether its thresholds move with the state.
template <class R>
concept declares_state_dependence = requires { typename std::bool_constant<R::depends_on_state>; };

/// A rule gives the threshold of one throat.
template <class R>
concept gives_thresholds = requires(R r, const network& net, const two_phase_state& state, throat_id t) {
  { r.threshold(net, state, t) } -> std::same_as<threshold_outcome>;
};

/// A rule narrows the brackets of the throats that could be next.
template <class R>
concept settles_thresholds = requires(R r, const network& net, const two_phase_state& state,
                                      std::span<const throat_id> candidates) { r.settle(net, state, candidates); };

/// A rule names the throats whose threshold moved when a pore filled with gas.
template <class R>
concept names_touched_throats = requires(R r, const network& net, const two_phase_state& state, pore_id p,
                                         std::vector<throat_id>& out) { r.touched_by(net, state, p, out); };

/// Decides at which capillary pressure gas passes each throat of a network, in a given state.
///
/// Syntax: the four parts above.
/// Semantics:
/// - `threshold(net, state, t)` is asked of throats with gas on one side; the side that is gas may matter. Verdict ok:
///   the value lies in the bracket. absent: the throat is closed by solid. refused, failed: no value; gas does not
///   pass, and drainage::without_value counts it. Whether a throat is absent does not depend on the state, and may be
///   asked of any throat.
/// - the bracket contains the settled value; `settle` narrows, it never widens; the driver calls it with all the
///   candidates whose brackets overlap the lowest one, until they no longer do or nothing changes.
/// - same opening, same value: the answer is a function of what the rule sees of (net, state), not of the past.
/// - `touched_by(net, state, p, out)` is called just after pore p became gas and appends the throats whose threshold
///   may have changed by that; the throats of p itself need not be named. Nothing where depends_on_state is false.
/// Models: facet_rule, and any rule of the user.
template <class R>
concept entry_rule =
    declares_state_dependence<R> && gives_thresholds<R> && settles_thresholds<R> && names_touched_throats<R>;

/// A rule whose answers are dear may also bound them: `r.lower_bound(t)` is never above the threshold of t in any
/// state, infinite where gas can pass in none. The driver then asks for a threshold only when its bound comes up.
template <class R>
concept bounds_thresholds = requires(const R r, throat_id t) {
  { r.lower_bound(t) } -> std::same_as<double>;
};

/// Counts per entry_status.
class status_counts {
 public:
  static constexpr std::size_t kinds = static_cast<std::size_t>(entry_status::not_converged) + 1;

  constexpr void add(entry_status s) noexcept { ++count_[static_cast<std::size_t>(s)]; }
  [[nodiscard]] constexpr std::size_t operator[](entry_status s) const noexcept {
    return count_[static_cast<std::size_t>(s)];
  }
  [[nodiscard]] constexpr std::size_t of(verdict v) const noexcept {
    std::size_t n = 0;
    for (std::size_t k = 0; k < kinds; ++k) {
      n += verdict_of(static_cast<entry_status>(k)) == v ? count_[k] : 0;
    }
    return n;
  }

 private:
  std::array<std::size_t, kinds> count_{};
};

}  // namespace tetrapore::inline TETRAPORE_ABI
