// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/field.hpp"
#include "tetrapore/network/network.hpp"
#include "tetrapore/two_phase/face_set.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// \file
/// Where the two phases are.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// Asks for a cache line before it is needed.
inline void prefetch(const void* address) noexcept { __builtin_prefetch(address); }

}  // namespace detail

/// A connected set of wet pores that lost its way to the outlet.
struct trapped_cluster {
  double pressure = 0;      ///< [Pa] capillary pressure at which it was cut off; it keeps it
  double volume = 0;        ///< [m³] liquid in it
  std::uint32_t pores = 0;  ///< number of its pores
  std::uint32_t level = 0;  ///< level at whose end, or in which, it was cut off; 0: before the first

  [[nodiscard]] friend constexpr bool operator==(const trapped_cluster&, const trapped_cluster&) = default;
};

/// The state of two phases on a network: the liquid volume of every pore, and what follows from its history. A pore is
/// wet or gas; gas pores may keep liquid (rings). Reservoir pores hold a phase without end and count in no saturation.
/// \par Units  volumes [m³], pressures [Pa]
class two_phase_state {
 public:
  static constexpr std::uint32_t no_cluster = 0xffffffffU;

  /// Saturated with liquid.
  explicit two_phase_state(const network& net)
      : two_phase_state(net, volume_field({net.arrays().void_volumes}, net.epoch())) {}

  /// From liquid volumes, as after a rebuild: a pore is gas when less than half of its void is liquid.
  /// \throw parameter_error  a field of another epoch
  two_phase_state(const network& net, volume_field liquid, double pressure = 0)
      : liquid_(std::move(liquid)),
        flags_(net.pore_count(), 0),
        invasion_pressure_(net.pore_count(), std::numeric_limits<double>::quiet_NaN()),
        cluster_(net.pore_count(), no_cluster),
        pressure_(pressure) {
    if (!liquid_.belongs_to(net)) {
      throw parameter_error("liquid volumes", "a field of epoch " + std::to_string(liquid_.epoch()),
                            "one value per pore of epoch " + std::to_string(net.epoch()));
    }
    for (std::size_t i = 0; i < flags_.size(); ++i) {
      const pore_id p(i);
      if (liquid_[p] < 0.5 * net.void_volume(p)) {
        flags_[i] = gas_bit;
        invasion_pressure_[i] = pressure;
      }
    }
  }

  [[nodiscard]] std::size_t pore_count() const noexcept { return flags_.size(); }
  [[nodiscard]] bool belongs_to(const network& net) const noexcept { return liquid_.belongs_to(net); }

  [[nodiscard]] bool is_gas(pore_id p) const noexcept { return (flags_[p.index()] & gas_bit) != 0; }
  [[nodiscard]] bool is_wet(pore_id p) const noexcept { return !is_gas(p); }
  [[nodiscard]] bool is_trapped(pore_id p) const noexcept { return (flags_[p.index()] & trapped_bit) != 0; }
  [[nodiscard]] bool is_inlet(pore_id p) const noexcept { return (flags_[p.index()] & inlet_bit) != 0; }
  [[nodiscard]] bool is_outlet(pore_id p) const noexcept { return (flags_[p.index()] & outlet_bit) != 0; }
  [[nodiscard]] bool is_reservoir(pore_id p) const noexcept {
    return (flags_[p.index()] & (inlet_bit | outlet_bit)) != 0;
  }
  /// Whether the pore is gas that is connected to the inlet.
  [[nodiscard]] bool is_fed(pore_id p) const noexcept { return (flags_[p.index()] & fed_bit) != 0; }
  /// Whether gas may still enter the pore: wet, not trapped, not the outlet.
  [[nodiscard]] bool is_drainable(pore_id p) const noexcept {
    return (flags_[p.index()] & (gas_bit | trapped_bit | outlet_bit)) == 0;
  }

  [[nodiscard]] const volume_field& liquid() const noexcept { return liquid_; }
  /// Capillary pressure now: the largest that was needed so far [Pa].
  [[nodiscard]] double pressure() const noexcept { return pressure_; }
  /// Capillary pressure at which gas entered a pore [Pa]; NaN while it is wet.
  [[nodiscard]] double invasion_pressure(pore_id p) const noexcept { return invasion_pressure_[p.index()]; }
  [[nodiscard]] std::span<const double> invasion_pressures() const noexcept { return invasion_pressure_; }
  /// The trapped cluster of a pore; no_cluster where it is not trapped.
  [[nodiscard]] std::uint32_t cluster(pore_id p) const noexcept { return cluster_[p.index()]; }
  [[nodiscard]] std::span<const trapped_cluster> clusters() const noexcept { return clusters_; }
  /// Number of pressure levels (bursts) so far.
  [[nodiscard]] std::uint32_t level() const noexcept { return level_; }

  /// Begins to fetch what `invade` will need.
  void prefetch(pore_id p) const noexcept {
    detail::prefetch(liquid_.values().data() + p.index());
    detail::prefetch(invasion_pressure_.data() + p.index());
  }

  // what drivers do to it ---------------------------------------------------------------------------------------------

  /// Marks the phase alone; volumes and history stay.
  void mark_gas(pore_id p) noexcept { flags_[p.index()] = static_cast<std::uint8_t>(flags_[p.index()] | gas_bit); }
  void mark_fed(pore_id p) noexcept { flags_[p.index()] = static_cast<std::uint8_t>(flags_[p.index()] | fed_bit); }
  void mark_unfed(pore_id p) noexcept { flags_[p.index()] = static_cast<std::uint8_t>(flags_[p.index()] & ~fed_bit); }
  void mark_wet(pore_id p) noexcept {
    flags_[p.index()] = static_cast<std::uint8_t>(flags_[p.index()] & ~(gas_bit | fed_bit));
  }
  void mark_inlet(pore_id p) noexcept { flags_[p.index()] = static_cast<std::uint8_t>(flags_[p.index()] | inlet_bit); }
  void mark_outlet(pore_id p) noexcept {
    flags_[p.index()] = static_cast<std::uint8_t>(flags_[p.index()] | outlet_bit);
  }
  /// Forgets which pores are reservoirs, and which gas they feed.
  void clear_reservoirs() noexcept {
    for (std::uint8_t& f : flags_) {
      f = static_cast<std::uint8_t>(f & ~(inlet_bit | outlet_bit | fed_bit));
    }
  }

  /// Opens a new level at a higher capillary pressure.
  void open_level(double pressure) noexcept {
    pressure_ = pressure;
    ++level_;
  }
  /// Gas takes a pore at the present pressure; returns the liquid that left [m³].
  double invade(pore_id p) noexcept {
    mark_gas(p);
    invasion_pressure_[p.index()] = pressure_;
    const double left = liquid_[p];
    liquid_[p] = 0;
    return left;
  }
  /// Liquid fills a pore whole.
  void flood(pore_id p, double volume) noexcept {
    mark_wet(p);
    invasion_pressure_[p.index()] = std::numeric_limits<double>::quiet_NaN();
    liquid_[p] = volume;
  }
  /// The pores become a trapped cluster at the present pressure.
  void trap(std::span<const std::uint32_t> pores) {
    trapped_cluster c{pressure_, 0, static_cast<std::uint32_t>(pores.size()), level_};
    const auto name = static_cast<std::uint32_t>(clusters_.size());
    for (const std::uint32_t p : pores) {
      flags_[p] = static_cast<std::uint8_t>(flags_[p] | trapped_bit);
      cluster_[p] = name;
      c.volume += liquid_[pore_id(p)];
    }
    clusters_.push_back(c);
  }

 private:
  friend struct state_archive;
  struct unfilled {};
  explicit two_phase_state(unfilled) {}

  static constexpr std::uint8_t gas_bit = 1;
  static constexpr std::uint8_t trapped_bit = 2;
  static constexpr std::uint8_t inlet_bit = 4;
  static constexpr std::uint8_t outlet_bit = 8;
  static constexpr std::uint8_t fed_bit = 16;

  volume_field liquid_;
  std::vector<std::uint8_t> flags_;
  std::vector<double> invasion_pressure_;
  std::vector<std::uint32_t> cluster_;
  std::vector<trapped_cluster> clusters_;
  double pressure_ = 0;
  std::uint32_t level_ = 0;
};

/// Liquid volume over void volume of the pores that are not reservoir and that `chosen` accepts; NaN where there are
/// none.
template <class Choice>
[[nodiscard]] double saturation(const network& net, const two_phase_state& state, const Choice& chosen) {
  double liquid = 0;
  double voids = 0;
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const pore_id p(i);
    if (!state.is_reservoir(p) && chosen(p)) {
      liquid += state.liquid()[p];
      voids += net.void_volume(p);
    }
  }
  return liquid / voids;
}

/// Saturation of all pores that are not reservoir.
[[nodiscard]] inline double saturation(const network& net, const two_phase_state& state) {
  return saturation(net, state, [](pore_id) { return true; });
}

/// Saturation of the pores that are not reservoir and touch no wall.
[[nodiscard]] inline double interior_saturation(const network& net, const two_phase_state& state) {
  return saturation(net, state, [&](pore_id p) { return !net.touches_wall(p); });
}

}  // namespace tetrapore::inline TETRAPORE_ABI
