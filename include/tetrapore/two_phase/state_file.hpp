// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/two_phase/state.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

/// \file
/// A two-phase state as bytes, to be written wherever the caller likes, and back.

namespace tetrapore::inline TETRAPORE_ABI {

/// Fingerprint of the pores and throats of a network, by which a state recognises the one it belongs to.
[[nodiscard]] inline std::uint64_t fingerprint(const network& net) noexcept {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  const auto mix = [&](std::uint64_t x) {
    h = (h ^ x) * 0x100000001b3ULL;
    h ^= h >> 29U;
  };
  mix(net.pore_count());
  mix(net.throat_count());
  for (std::size_t t = 0; t < net.throat_count(); ++t) {
    const auto& [a, b] = net.pores(throat_id(t));
    mix((std::uint64_t{a.value} << 32U) | b.value);
  }
  for (std::size_t p = 0; p < net.pore_count(); ++p) {
    mix(std::bit_cast<std::uint64_t>(net.void_volume(pore_id(p))));
  }
  return h;
}

/// What reads and writes the members of a state.
struct state_archive {
  /// The state as bytes: a header, the arrays, a checksum.
  [[nodiscard]] static std::vector<std::byte> write(const network& net, const two_phase_state& s) {
    std::vector<std::byte> out;
    const header head = header_for(net, s);
    append(out, std::span(&head, 1));
    append(out, s.liquid_.values());
    append(out, std::span(s.invasion_pressure_));
    append(out, std::span(s.cluster_));
    append(out, std::span(s.flags_));
    append(out, std::span(s.clusters_));
    const std::uint64_t sum = checksum(out);
    append(out, std::span(&sum, 1));
    return out;
  }

  /// The state that `write` made of the same network.
  /// \throw input_error  not a state, cut short, damaged, of another byte order, or of another network
  [[nodiscard]] static two_phase_state read(const network& net, std::span<const std::byte> bytes,
                                            const std::string& where) {
    header head{};
    if (bytes.size() < sizeof head + sizeof(std::uint64_t)) {
      throw input_error(where, std::to_string(bytes.size()) + " bytes", "a two-phase state, which is longer");
    }
    std::memcpy(&head, bytes.data(), sizeof head);
    if (head.magic != magic || head.order != order_mark) {
      throw input_error(where + ", byte 0", "other bytes",
                        "the mark of a two-phase state of this version and byte order");
    }
    const std::uint64_t size = sizeof head + head.pores * (8 + 8 + 4 + 1) + head.clusters * sizeof(trapped_cluster) + 8;
    if (head.pores > 0xffffffffULL || head.clusters > head.pores || bytes.size() != size) {
      throw input_error(where, std::to_string(bytes.size()) + " bytes", std::to_string(size) + ", as its header says");
    }
    std::uint64_t sum = 0;
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    if (sum != checksum(bytes.first(bytes.size() - sizeof sum))) {
      throw input_error(where, "a checksum that does not match", "the bytes as they were saved");
    }
    if (head.epoch != net.epoch() || head.pores != net.pore_count() || head.network != fingerprint(net)) {
      throw input_error(where,
                        "the state of another network (" + std::to_string(head.pores) + " pores, epoch " +
                            std::to_string(head.epoch) + ")",
                        "one of this network (" + std::to_string(net.pore_count()) + " pores, epoch " +
                            std::to_string(net.epoch()) + ")");
    }
    two_phase_state s{two_phase_state::unfilled{}};
    std::vector<double> liquid(net.pore_count());
    s.invasion_pressure_.resize(net.pore_count());
    s.cluster_.resize(net.pore_count());
    s.flags_.resize(net.pore_count());
    s.clusters_.resize(head.clusters);
    bytes = bytes.subspan(sizeof head);
    take(bytes, std::span(liquid));
    take(bytes, std::span(s.invasion_pressure_));
    take(bytes, std::span(s.cluster_));
    take(bytes, std::span(s.flags_));
    take(bytes, std::span(s.clusters_));
    s.liquid_ = volume_field(std::move(liquid), net.epoch());
    s.pressure_ = head.pressure;
    s.level_ = static_cast<std::uint32_t>(head.level);
    return s;
  }

 private:
  static constexpr std::uint64_t order_mark = 0x0102030405060708ULL;
  static constexpr std::array<char, 8> magic{'t', 'p', 's', 't', 'a', 't', 'e', '1'};
  struct header {
    std::array<char, 8> magic;
    std::uint64_t order;  ///< a number whose bytes tell the byte order
    std::uint64_t network;
    std::uint64_t epoch;
    std::uint64_t pores;
    std::uint64_t clusters;
    std::uint64_t level;
    double pressure;
  };
  static_assert(std::is_trivially_copyable_v<header> && std::is_trivially_copyable_v<trapped_cluster>);

  [[nodiscard]] static header header_for(const network& net, const two_phase_state& s) {
    return {magic,          order_mark,         fingerprint(net), net.epoch(),
            s.pore_count(), s.clusters_.size(), s.level_,         s.pressure_};
  }
  template <class T, std::size_t N>
  static void append(std::vector<std::byte>& out, std::span<T, N> values) {
    const std::size_t end = out.size();
    out.resize(end + values.size_bytes());
    if (!values.empty()) {
      std::memcpy(out.data() + end, values.data(), values.size_bytes());
    }
  }
  template <class T>
  static void take(std::span<const std::byte>& from, std::span<T> values) {
    if (!values.empty()) {
      std::memcpy(values.data(), from.data(), values.size_bytes());
    }
    from = from.subspan(values.size_bytes());
  }
  [[nodiscard]] static std::uint64_t checksum(std::span<const std::byte> bytes) noexcept {
    std::uint64_t h = 0xcbf29ce484222325ULL;
    std::size_t k = 0;
    for (; k + 8 <= bytes.size(); k += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + k, 8);
      h = (h ^ word) * 0x100000001b3ULL;
      h ^= h >> 29U;
    }
    for (; k < bytes.size(); ++k) {
      h = (h ^ std::to_integer<std::uint64_t>(bytes[k])) * 0x100000001b3ULL;
    }
    return h;
  }
};

/// A state as bytes; a drainage goes on from it with the events that were to follow.
[[nodiscard]] inline std::vector<std::byte> to_bytes(const network& net, const two_phase_state& state) {
  return state_archive::write(net, state);
}

/// The state that `to_bytes` made.
/// \throw input_error  not a state, cut short, damaged, of another byte order, or of another network
[[nodiscard]] inline two_phase_state state_from_bytes(const network& net, std::span<const std::byte> bytes,
                                                      const std::string& where = "two-phase state") {
  return state_archive::read(net, bytes, where);
}

}  // namespace tetrapore::inline TETRAPORE_ABI
