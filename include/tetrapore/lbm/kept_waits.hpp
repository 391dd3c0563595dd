// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/checkpoint.hpp"
#include "tetrapore/lbm/state_numbers.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// \file
/// Experiments that are killed and go on: the states of their waits, in the order in which they begin.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Where the states of waits lie: files, memory, whatever a derived class makes of it. Pointed to by the options of one
/// experiment, or of several that run one after the other, always in the same order. What is lost of the states costs
/// time alone: an experiment goes on from those that are there, and ends to the bit as if it had never been killed.
class kept_waits {
 public:
  virtual ~kept_waits() = default;
  kept_waits(const kept_waits&) = delete;
  kept_waits& operator=(const kept_waits&) = delete;

  /// The state that was saved last of a wait, if one was.
  [[nodiscard]] virtual std::optional<std::vector<std::byte>> load(std::size_t wait) = 0;
  /// Called when fluids have been looked at, every few hundred to thousand steps, and when a wait ends; may skip some.
  virtual void save(std::size_t wait, const std::vector<std::byte>& state) = 0;

  /// The number of the wait that begins.
  [[nodiscard]] std::size_t begin() noexcept { return begun_++; }

 protected:
  kept_waits() = default;

 private:
  std::size_t begun_ = 0;
};

/// One of them, as the loop that waits sees it; nothing is done where no waits are kept.
///
/// A state belongs to the wait that begins with the same fluids, treats them as this one does and looks for the same.
/// The first two are told by trial, whatever model, walls and forces are: the numbers that are laid and what two steps
/// make of them go into the state's parameters. What is looked for the caller adds: rules, and what the first look saw.
template <class Simulation>
class kept_wait {
 public:
  /// \param two_steps  makes two steps of the fluids, that are taken back
  template <class TwoSteps>
  kept_wait(kept_waits* waits, Simulation& s, parameter_hash looked_for, TwoSteps two_steps)
      : waits_(waits), simulation_(&s) {
    if (waits_ == nullptr) {
      return;
    }
    number_ = waits_->begin();
    state_numbers<Simulation> laid;
    state_numbers<Simulation> moved;
    copy_state(s, laid);
    two_steps();
    copy_state(s, moved);
    put_state(s, laid);
    parameters_ = looked_for.add(std::uint64_t{sizeof laid[0]})
                      .add(std::as_bytes(std::span(laid)))
                      .add(std::as_bytes(std::span(moved)))
                      .value();
  }

  /// Puts fluids and the memory of the loop back to where they were saved; whether they were.
  /// \throw input_error  a state that is damaged or of another wait; nothing is changed then
  template <class Memory>
  [[nodiscard]] bool take_up(Memory& memory) {
    const auto bytes = waits_ == nullptr ? std::nullopt : waits_->load(number_);
    if (!bytes) {
      return false;
    }
    checkpoint_reader in(*bytes, parameters_, "state of wait " + std::to_string(number_ + 1));
    Memory kept = memory;
    state_numbers<Simulation> numbers(state_size(*simulation_));
    in.take(kept);
    in.take(std::span(numbers));
    in.finish();
    memory = kept;
    put_state(*simulation_, numbers);
    return true;
  }

  template <class Memory>
  void save(const Memory& memory) {
    if (waits_ == nullptr) {
      return;
    }
    checkpoint_writer out(parameters_);
    state_numbers<Simulation> numbers;
    copy_state(*simulation_, numbers);
    out.append(memory);
    out.append(std::span<const typename state_numbers<Simulation>::value_type>(numbers));
    waits_->save(number_, std::move(out).finish());
  }

 private:
  kept_waits* waits_;
  Simulation* simulation_;
  std::size_t number_ = 0;
  std::uint64_t parameters_ = 0;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
