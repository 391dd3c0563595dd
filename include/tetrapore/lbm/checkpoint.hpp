// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"

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
/// States of experiments as bytes, to be written wherever the caller likes, and back.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// A number that stands for a sequence of numbers: other parameters, another one.
class parameter_hash {
 public:
  parameter_hash& add(std::uint64_t x) noexcept {
    value_ = (value_ ^ x) * 0x100000001b3ULL;
    value_ ^= value_ >> 29U;
    return *this;
  }
  parameter_hash& add(double x) noexcept { return add(std::bit_cast<std::uint64_t>(x)); }
  parameter_hash& add(std::span<const std::byte> bytes) noexcept {
    for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data(), 8);
      add(word);
    }
    for (const std::byte b : bytes) {
      add(std::to_integer<std::uint64_t>(b));
    }
    return *this;
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

namespace detail {

struct checkpoint_header {
  std::array<char, 8> magic;
  std::uint64_t order;       ///< a number whose bytes tell the byte order
  std::uint64_t parameters;  ///< hash of what the state belongs to
  std::uint64_t size;        ///< bytes between this header and the checksum
};
inline constexpr std::array<char, 8> checkpoint_magic{'t', 'p', 'l', 'b', 'm', 's', 't', '3'};
inline constexpr std::uint64_t checkpoint_order = 0x0102030405060708ULL;

}  // namespace detail

/// Packs plain values: a header with the version and the parameters' hash, the values, a checksum.
class checkpoint_writer {
 public:
  explicit checkpoint_writer(std::uint64_t parameters) {
    append(detail::checkpoint_header{detail::checkpoint_magic, detail::checkpoint_order, parameters, 0});
  }
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void append(const T& value) {
    append(std::span<const T>(&value, 1));
  }
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void append(std::span<const T> values) {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + values.size_bytes());
    if (!values.empty()) {
      std::memcpy(bytes_.data() + end, values.data(), values.size_bytes());
    }
  }
  [[nodiscard]] std::vector<std::byte> finish() && {
    const std::uint64_t size = bytes_.size() - sizeof(detail::checkpoint_header);
    std::memcpy(bytes_.data() + offsetof(detail::checkpoint_header, size), &size, sizeof size);
    append(parameter_hash{}.add(std::span<const std::byte>(bytes_)).value());
    return std::move(bytes_);
  }

 private:
  std::vector<std::byte> bytes_;
};

/// Unpacks what a checkpoint_writer packed, in the same order. Everything is checked before the first value is given.
class checkpoint_reader {
 public:
  /// \throw input_error  no such state, cut short, damaged, of another byte order or version, or of other parameters
  checkpoint_reader(std::span<const std::byte> bytes, std::uint64_t parameters, std::string where)
      : where_(std::move(where)) {
    detail::checkpoint_header head{};
    if (bytes.size() < sizeof head + sizeof(std::uint64_t)) {
      throw input_error(where_, std::to_string(bytes.size()) + " bytes", "the state of an experiment, which is longer");
    }
    std::memcpy(&head, bytes.data(), sizeof head);
    if (head.magic != detail::checkpoint_magic || head.order != detail::checkpoint_order) {
      throw input_error(where_ + ", byte 0", "other bytes",
                        "the mark of an experiment's state of this version and byte order");
    }
    if (head.size != bytes.size() - sizeof head - sizeof(std::uint64_t)) {
      throw input_error(where_, std::to_string(bytes.size()) + " bytes", "as many as its header says");
    }
    std::uint64_t sum = 0;
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    bytes = bytes.first(bytes.size() - sizeof sum);
    if (sum != parameter_hash{}.add(bytes).value()) {
      throw input_error(where_, "a checksum that does not match", "the bytes as they were saved");
    }
    if (head.parameters != parameters) {
      throw input_error(where_, "the state of another experiment", "one of the same geometry, lattice and fluids");
    }
    rest_ = bytes.subspan(sizeof head);
  }

  template <class T>
    requires std::is_trivially_copyable_v<T>
  void take(T& value) {
    take(std::span<T>(&value, 1));
  }
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void take(std::span<T> values) {
    if (rest_.size() < values.size_bytes()) {
      throw input_error(where_, "fewer values than expected", "all of a state");
    }
    if (!values.empty()) {
      std::memcpy(values.data(), rest_.data(), values.size_bytes());
    }
    rest_ = rest_.subspan(values.size_bytes());
  }
  /// \throw input_error  at this state
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw input_error(where_, found, expected);
  }
  void finish() const {
    if (!rest_.empty()) {
      throw input_error(where_, std::to_string(rest_.size()) + " bytes more than a state has", "none");
    }
  }

 private:
  std::string where_;
  std::span<const std::byte> rest_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
