// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"
#include "tetrapore/core/ids.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// \file
/// What a pair of grains remembers from step to step: the liquid of its bridge, the warm state of its law.

namespace tetrapore::inline TETRAPORE_ABI {

/// Names a pair by the caller's grains: a grain, and another one, an image of one along periodic axes, or a wall. Made
/// by `pair_of`, so that a pair has one name from whichever end it is seen.
struct pair_key {
  grain_id a;
  vertex b;
  image shift{};  ///< whole box lengths that are added to b

  [[nodiscard]] friend constexpr auto operator<=>(const pair_key&, const pair_key&) noexcept = default;
};

/// The pair of grain a and the image of grain b that is moved by `shift`. The smaller id stands first; of a grain and
/// its own image, the one along the positive direction of the first axis that is crossed.
[[nodiscard]] constexpr pair_key pair_of(grain_id a, grain_id b, image shift = {}) noexcept {
  if (b < a || (a == b && shift < image{})) {
    return {b, vertex(a), image{} - shift};
  }
  return {a, vertex(b), shift};
}
[[nodiscard]] constexpr pair_key pair_of(grain_id a, face wall) noexcept { return {a, vertex(wall), {}}; }

namespace detail {

[[nodiscard]] constexpr std::uint64_t hash_of(const pair_key& k) noexcept {
  const auto byte = [](std::int8_t x) { return static_cast<std::uint64_t>(static_cast<std::uint8_t>(x)); };
  std::uint64_t h = std::uint64_t{k.a.value} << 32U | static_cast<std::uint32_t>(k.b.code());
  h ^= (byte(k.shift.x) << 16U | byte(k.shift.y) << 8U | byte(k.shift.z)) * 0x9e3779b97f4a7c15ULL;
  h = (h ^ h >> 30U) * 0xbf58476d1ce4e5b9ULL;  // the finaliser of SplitMix64
  h = (h ^ h >> 27U) * 0x94d049bb133111ebULL;
  return h ^ h >> 31U;
}

}  // namespace detail

/// A state for each of some pairs, found by the name of the pair. A pair need not be an edge of a network, and names
/// hold the caller's grains alone: the store outlives every triangulation and every list of neighbours.
///
/// Keys and states lie in two arrays, in the order in which pairs came, where `erase` moves the last into the place of
/// the one that goes: a loop over them gives the same bits for the same history. Pointers and references to states hold
/// until a pair comes or goes.
/// ```
/// struct wet { double volume; young_laplace<>::warm_state<double> warm; };
/// pair_store<wet> bridges;
/// for_each_close_edge(grains, region, reach, [&](const close_edge& e) {
///   if (wet* b = bridges.find(e.key)) { … law.bridge(e.shape, given_volume{b->volume}, b->warm) … }
/// });
/// ```
/// \tparam State  any movable type
template <class State>
class pair_store {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return keys_.size(); }
  [[nodiscard]] bool empty() const noexcept { return keys_.empty(); }

  /// The names and the states, in the same order.
  [[nodiscard]] std::span<const pair_key> keys() const noexcept { return keys_; }
  [[nodiscard]] std::span<State> states() noexcept { return states_; }
  [[nodiscard]] std::span<const State> states() const noexcept { return states_; }

  /// The state of a pair; null where there is none.
  [[nodiscard]] State* find(const pair_key& k) noexcept {
    const std::size_t s = slot_of(k);
    return s == none || slots_[s] == free_slot ? nullptr : &states_[slots_[s]];
  }
  [[nodiscard]] const State* find(const pair_key& k) const noexcept {
    const std::size_t s = slot_of(k);
    return s == none || slots_[s] == free_slot ? nullptr : &states_[slots_[s]];
  }

  /// The state of a pair, which is made from `fresh` where the pair is new; and whether it is.
  std::pair<State&, bool> insert(const pair_key& k, State fresh) {
    if (2 * (size() + 1) > slots_.size()) {
      index(2 * (size() + 1));
    }
    std::uint32_t& s = slots_[slot_of(k)];
    const bool is_new = s == free_slot;
    if (is_new) {
      keys_.push_back(k);
      states_.push_back(std::move(fresh));
      s = static_cast<std::uint32_t>(size() - 1);
    }
    return {states_[s], is_new};
  }

  /// Forgets a pair; false where there is none.
  bool erase(const pair_key& k) {
    const std::size_t s = slot_of(k);
    if (s == none || slots_[s] == free_slot) {
      return false;
    }
    const std::uint32_t place = slots_[s];
    vacate(s);
    if (place + 1 < size()) {
      slots_[slot_of(keys_.back())] = place;
      keys_[place] = keys_.back();
      states_[place] = std::move(states_.back());
    }
    keys_.pop_back();
    states_.pop_back();
    return true;
  }

  /// Forgets all pairs for which gone(key, state) holds, and says how many; the order of the others stays.
  template <class F>
  std::size_t erase_if(F&& gone) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      if (!gone(std::as_const(keys_[i]), states_[i])) {
        if (kept != i) {
          keys_[kept] = keys_[i];
          states_[kept] = std::move(states_[i]);
        }
        ++kept;
      }
    }
    const std::size_t count = size() - kept;
    if (count > 0) {
      shrink(kept);
      index(slots_.size());
    }
    return count;
  }

  /// Gives every pair the name f(key), a `std::optional<pair_key>`; a pair without one is forgotten. For a simulator
  /// that numbers its grains anew.
  /// \pre  no two pairs get the same name
  template <class F>
  void rename(F&& f) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      const std::optional<pair_key> name = f(std::as_const(keys_[i]));
      if (name) {
        keys_[kept] = *name;
        if (kept != i) {
          states_[kept] = std::move(states_[i]);
        }
        ++kept;
      }
    }
    shrink(kept);
    index(slots_.size());
  }

  /// Grain i has been moved by laps[i] box lengths, as wrapping a periodic box does: every pair keeps its state.
  void wrap(std::span<const image> laps) {
    rename([&](pair_key k) {
      if (!k.b.is_wall()) {
        k.shift = k.shift + laps[k.a.index()] - laps[k.b.grain().index()];
      }
      return std::optional(k);
    });
  }

  void reserve(std::size_t pairs) {
    keys_.reserve(pairs);
    states_.reserve(pairs);
    if (2 * pairs > slots_.size()) {
      index(2 * pairs);
    }
  }
  void clear() noexcept {
    keys_.clear();
    states_.clear();
    slots_.clear();
  }

 private:
  static constexpr std::uint32_t free_slot = 0xffffffffU;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Where a pair is, or would be; none while there are no slots. Half of the slots are free: a walk ends.
  [[nodiscard]] std::size_t slot_of(const pair_key& k) const noexcept {
    if (slots_.empty()) {
      return none;
    }
    const std::size_t mask = slots_.size() - 1;
    std::size_t s = static_cast<std::size_t>(detail::hash_of(k)) & mask;
    while (slots_[s] != free_slot && keys_[slots_[s]] != k) {
      s = (s + 1) & mask;
    }
    return s;
  }

  /// Frees a slot, and closes the walks that went over it.
  void vacate(std::size_t hole) noexcept {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t s = (hole + 1) & mask; slots_[s] != free_slot; s = (s + 1) & mask) {
      const std::size_t home = static_cast<std::size_t>(detail::hash_of(keys_[slots_[s]])) & mask;
      if (((s - home) & mask) >= ((s - hole) & mask)) {
        slots_[hole] = slots_[s];
        hole = s;
      }
    }
    slots_[hole] = free_slot;
  }

  void shrink(std::size_t kept) {
    keys_.erase(keys_.begin() + static_cast<std::ptrdiff_t>(kept), keys_.end());
    states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(kept), states_.end());
  }

  /// Finds a slot for every pair anew, among at least so many.
  void index(std::size_t at_least) {
    TETRAPORE_EXPECTS(at_least < free_slot, "a pair store holds fewer than 2^31 pairs");
    slots_.assign(std::bit_ceil(at_least < 16 ? std::size_t{16} : at_least), free_slot);
    for (std::size_t i = 0; i < size(); ++i) {
      const std::size_t s = slot_of(keys_[i]);
      TETRAPORE_EXPECTS(slots_[s] == free_slot, "no two pairs get the same name");
      slots_[s] = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<pair_key> keys_;
  std::vector<State> states_;
  std::vector<std::uint32_t>
      slots_;  ///< place in the arrays, by hash; a power of two of them, at most half of them used
};

}  // namespace tetrapore::inline TETRAPORE_ABI
