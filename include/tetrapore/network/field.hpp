// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/network.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

/// \file
/// State that lives on the pores of one epoch of a network.

namespace tetrapore::inline TETRAPORE_ABI {

/// How a quantity is carried to another triangulation.
enum class quantity : unsigned char {
  extensive,  ///< an amount (liquid volume): the sum is kept
  intensive   ///< a level (pressure): averaged over what a new pore covers
};

/// One number per pore, tied to the epoch of the network it was made for. Use with a network of another epoch is a
/// contract violation; `carry` takes it across a rebuild.
template <quantity Q>
class field {
 public:
  field() = default;
  explicit field(const network& net, double value = 0.0) : values_(net.pore_count(), value), epoch_(net.epoch()) {}
  field(std::vector<double> values, std::uint64_t epoch) : values_(std::move(values)), epoch_(epoch) {}

  [[nodiscard]] double& operator[](pore_id p) noexcept { return values_[p.index()]; }
  [[nodiscard]] double operator[](pore_id p) const noexcept { return values_[p.index()]; }
  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }
  [[nodiscard]] std::span<const double> values() const noexcept { return values_; }
  [[nodiscard]] std::span<double> values() noexcept { return values_; }
  [[nodiscard]] bool belongs_to(const network& net) const noexcept {
    return epoch_ == net.epoch() && values_.size() == net.pore_count();
  }

 private:
  std::vector<double> values_;
  std::uint64_t epoch_ = 0;
};

using volume_field = field<quantity::extensive>;    ///< [m³]
using pressure_field = field<quantity::intensive>;  ///< [Pa]

}  // namespace tetrapore::inline TETRAPORE_ABI
