// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/solve_profile.hpp"
#include "tetrapore/simplex/edge.hpp"

/// \file
/// What a pair remembers of its bridge, to start the next time step near its answer.
/// \par Source  derived here

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

/// T is the scalar of the edge, W that of the arithmetic.
template <class T, std::floating_point W>
struct bridge_memory {
  surface_pair<W> pair{};
  T radius1{};
  T radius2{};
  double tension{};
  double angle1{};
  double angle2{};
  demand<W> met{};
  profile<W> u{};
  W by_gap[4]{};  ///< of k, ln extent, ln w1, ln w2
  W by_value[4]{};
  W gap_step{};  ///< from the step before
  W value_step{};
  W bend[4]{};  ///< what the derivative along that step changed over it
  bool warm = false;
  bool bent = false;

  [[nodiscard]] bool knows(const edge<T>& e, double sigma, double theta1, double theta2,
                           bridge_control by) const noexcept {
    return warm && met.by == by && radius1 == e.radius1 && radius2 == e.radius2 && tension == sigma &&
           angle1 == theta1 && angle2 == theta2;
  }

  void meet(const edge<T>& e, double sigma, double theta1, double theta2, const surface_pair<W>& of) noexcept {
    pair = of;
    radius1 = e.radius1;
    radius2 = e.radius2;
    tension = sigma;
    angle1 = theta1;
    angle2 = theta2;
    warm = bent = false;
  }

  /// The profile expected at a demand; false where that is too far to expect anything.
  [[nodiscard]] bool predict(const demand<W>& d, profile<W>& expected) const noexcept {
    const W gap = d.gap - met.gap;
    const W value = d.value - met.value;
    // how many steps like the last this one is, if it goes the same way
    W ratio(0);
    if (bent) {
      const W square = gap_step * gap_step * reach_of_value() * reach_of_value() + value_step * value_step;
      const W along = gap * gap_step * reach_of_value() * reach_of_value() + value * value_step;
      const W across = (gap * value_step - value * gap_step) * reach_of_value();
      if (square > W(0) && std::abs(across) < W(0.01) * std::abs(along)) {
        ratio = along / square;
      }
    }
    const W second = std::abs(ratio) < W(3) ? W(0.5) * ratio * ratio : W(0);
    W change[4];
    W size(0);
    for (int i = 0; i < 4; ++i) {
      change[i] = gap * by_gap[i] + value * by_value[i] + second * bend[i];
      if (i > 0) {
        size = larger(size, std::abs(change[i]));
      }
    }
    size = larger(size, std::abs(change[0]) * u.w[0] / (W(1) + std::abs(u.k) * u.w[0]));
    if (!(size < W(0.1))) {
      return false;
    }
    const auto grown = [](const W& x, const W& by) { return x * (W(1) + by * (W(1) + W(0.5) * by)); };
    expected.k = u.k + change[0];
    expected.extent = grown(u.extent, change[1]);
    expected.w[0] = grown(u.w[0], change[2]);
    expected.w[1] = pair.equal ? expected.w[0] : grown(u.w[1], change[3]);
    expected.by = u.by;
    return true;
  }

  void remember(const demand<W>& d, const found<W>& f, bool continued) noexcept {
    const W scale = f.at.scale;
    const W inverse = W(1) / scale;
    const W per_value = d.by == bridge_control::volume ? inverse * inverse * inverse : scale;
    const W gap = d.gap - met.gap;
    const W value = d.value - met.value;
    bent = continued && warm && f.u.by == u.by;
    for (int i = 0; i < 4; ++i) {
      const W unit = i == 0 ? inverse : W(1);
      const W gap_rate = f.by_gap[i] * unit * inverse;
      const W value_rate = f.by_value[i] * unit * per_value;
      bend[i] = (gap_rate - by_gap[i]) * gap + (value_rate - by_value[i]) * value;
      by_gap[i] = gap_rate;
      by_value[i] = value_rate;
    }
    gap_step = gap;
    value_step = value;
    met = d;
    u = f.u;
    warm = true;
  }

 private:
  /// Units of the given value in a unit of the gap.
  [[nodiscard]] W reach_of_value() const noexcept { return std::abs(met.value) / u.w[0]; }
};

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
