// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/two_phase/drainage.hpp"

#include <optional>
#include <span>
#include <vector>

/// \file
/// The retention curve of a drainage: capillary pressure against saturation.

namespace tetrapore::inline TETRAPORE_ABI {

/// The end of one pressure level.
struct retention_point {
  double pressure;             ///< [Pa]
  double saturation;           ///< of all pores that are not reservoir
  double interior_saturation;  ///< of those that touch no wall; NaN where there are none
  std::size_t events;          ///< events up to and with this level
  std::uint32_t level;
};

/// The curve as a staircase: at the pressure of each point the saturation falls to that of the point, and stays until
/// the pressure of the next.
class retention_curve {
 public:
  template <entry_rule Rule>
  explicit retention_curve(const drainage<Rule>& invasion) {
    const network& net = invasion.net();
    const two_phase_state& state = invasion.state();
    double liquid = 0;
    double interior = 0;
    double interior_void = 0;
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      const pore_id p(i);
      if (!state.is_reservoir(p)) {
        liquid += state.liquid()[p];
        if (!net.touches_wall(p)) {
          interior += state.liquid()[p];
          interior_void += net.void_volume(p);
        }
      }
    }
    // From the end backwards, so that the last saturation is that of the liquid that stayed, to round-off.
    const auto& events = invasion.events();
    for (std::size_t k = events.size(); k-- > 0;) {
      const drainage_event& e = events[k];
      if (points_.empty() || points_.back().level != e.level) {
        points_.push_back({e.pressure, liquid / invasion.void_volume(), interior / interior_void, k + 1, e.level});
      }
      liquid += e.volume;
      interior += net.touches_wall(e.pore) ? 0.0 : e.volume;
    }
    std::reverse(points_.begin(), points_.end());
    initial_ = liquid / invasion.void_volume();
    initial_interior_ = interior / interior_void;
  }

  [[nodiscard]] std::span<const retention_point> points() const noexcept { return points_; }
  [[nodiscard]] double initial_saturation() const noexcept { return initial_; }
  /// Saturation at the end of the curve: trapped pores, and pores that gas cannot reach.
  [[nodiscard]] double end_saturation() const noexcept {
    return points_.empty() ? initial_ : points_.back().saturation;
  }
  [[nodiscard]] double interior_end_saturation() const noexcept {
    return points_.empty() ? initial_interior_ : points_.back().interior_saturation;
  }

  /// Capillary pressure of the first level at whose end the saturation is at most s [Pa]; empty when the curve ends
  /// above.
  [[nodiscard]] std::optional<double> pressure_at(double s) const noexcept {
    // Saturation falls from point to point.
    const auto at = std::partition_point(points_.begin(), points_.end(),
                                         [&](const retention_point& p) { return !(p.saturation <= s); });
    return at == points_.end() ? std::nullopt : std::optional(at->pressure);
  }
  /// The same for the pores that touch no wall.
  [[nodiscard]] std::optional<double> interior_pressure_at(double s) const noexcept {
    const auto at = std::partition_point(points_.begin(), points_.end(),
                                         [&](const retention_point& p) { return !(p.interior_saturation <= s); });
    return at == points_.end() ? std::nullopt : std::optional(at->pressure);
  }

 private:
  std::vector<retention_point> points_;
  double initial_ = 0;
  double initial_interior_ = 0;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
