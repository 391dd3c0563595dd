// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/output_file.hpp"
#include "tetrapore/network/network.hpp"
#include "tetrapore/network/validate.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <type_traits>

/// \file
/// A network on disk.
///
/// The file, version 1 (all numbers in the byte order of the machine that wrote it):
/// | byte | what |
/// |---|---|
/// | 0  | the letters `TETRAPOR` |
/// | 8  | the number 0x0a0b0c0d as 4 bytes: reads otherwise on a machine of the other byte order |
/// | 12 | version of the format, 4 bytes |
/// | 16 | numbers of grains, pores, throats, 8 bytes each |
/// | 40 | 1 when an axis is periodic, else 0, 8 bytes |
/// | 48 | epoch, 8 bytes |
/// | 56 | bytes that follow the header |
/// | 64 | checksum of all bytes but these eight |
/// | 72 | box (6 doubles), its faces (6 bytes, 2 of filling); then the arrays of `network_arrays` in order |

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

namespace detail {

/// Order-dependent sum of 64-bit words. Each step is a bijection of the state and of the word, so a change that is
/// confined to one word always changes the sum.
class checksum {
 public:
  void add(const void* bytes, std::size_t count) noexcept {
    const auto* p = static_cast<const unsigned char*>(bytes);
    for (; count >= 8; p += 8, count -= 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, p, 8);
      step(word);
    }
    if (count > 0) {
      std::uint64_t word = 0;
      std::memcpy(&word, p, count);
      step(word);
    }
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return state_; }

 private:
  void step(std::uint64_t word) noexcept {
    state_ = (std::rotl(state_, 23) ^ word) * 0x9e3779b97f4a7c15U;
    state_ ^= state_ >> 29U;
  }
  std::uint64_t state_ = 0x7465747261706f72U;
};

struct network_header {
  std::array<char, 8> magic{'T', 'E', 'T', 'R', 'A', 'P', 'O', 'R'};
  std::uint32_t byte_order = 0x0a0b0c0dU;
  std::uint32_t version = 1;
  std::uint64_t grains = 0;
  std::uint64_t pores = 0;
  std::uint64_t throats = 0;
  std::uint64_t periodic = 0;
  std::uint64_t epoch = 0;
  std::uint64_t payload = 0;
  std::uint64_t sum = 0;
};
static_assert(sizeof(network_header) == 72 && std::is_trivially_copyable_v<network_header>);

struct stored_domain {
  std::array<double, 6> bounds{};
  std::array<std::uint8_t, 8> faces{};
};
static_assert(sizeof(stored_domain) == 56);

/// Visits the arrays in the order of the file; each(array, number of rows).
template <class Arrays, class Visitor>
void visit_network_arrays(Arrays& a, const network_header& h, Visitor&& each) {
  const std::uint64_t images = h.periodic;
  each(a.grains, h.grains);
  each(a.pore_vertices, h.pores);
  each(a.pore_images, h.pores * images);
  each(a.pore_throats, h.pores);
  each(a.power_centres, h.pores);
  each(a.volumes, h.pores);
  each(a.void_volumes, h.pores);
  each(a.throat_pores, h.throats);
  each(a.throat_slots, h.throats);
  each(a.throat_shifts, h.throats * images);
}

/// Bytes behind the header. The counts are 32-bit by the time this is called, so nothing overflows.
[[nodiscard]] inline std::uint64_t payload_size(const network_header& h) {
  std::uint64_t bytes = sizeof(stored_domain);
  network_arrays none;
  visit_network_arrays(none, h, [&](const auto& array, std::uint64_t rows) {
    using row = typename std::remove_cvref_t<decltype(array)>::value_type;
    static_assert(std::is_trivially_copyable_v<row>);
    bytes += rows * sizeof(row);
  });
  return bytes;
}

}  // namespace detail

/// Saves a network to a file, whole: `load_network` gives the same network to the last bit.
/// \throw output_error  where the file cannot be written
inline void save_network(const std::filesystem::path& path, const network& net) {
  const network_arrays& a = net.arrays();
  detail::network_header header;
  header.grains = a.grains.size();
  header.pores = a.pore_vertices.size();
  header.throats = a.throat_pores.size();
  header.periodic = net.periodic() ? 1 : 0;
  header.epoch = net.epoch();
  header.payload = detail::payload_size(header);

  detail::stored_domain region;
  for (std::size_t k = 0; k < 3; ++k) {
    region.bounds[2 * k] = a.region.bounds.lo[k];
    region.bounds[2 * k + 1] = a.region.bounds.hi[k];
  }
  for (std::size_t f = 0; f < 6; ++f) {
    region.faces[f] = static_cast<std::uint8_t>(a.region.faces[f]);
  }

  detail::checksum sum;
  const auto each_part = [&](const auto& part) {
    part(&header, offsetof(detail::network_header, sum));
    part(&region, sizeof region);
    detail::visit_network_arrays(a, header, [&](const auto& array, std::uint64_t rows) {
      TETRAPORE_EXPECTS(array.size() == rows, "the arrays of a network agree in length");
      part(array.data(), static_cast<std::size_t>(rows) * sizeof(array[0]));
    });
  };
  each_part([&](const void* bytes, std::size_t count) { sum.add(bytes, count); });
  header.sum = sum.value();

  output_file file(path);
  bool first = true;
  each_part([&](const void* bytes, std::size_t count) {
    file.write(bytes, count);
    if (first) {
      file.write(&header.sum, sizeof header.sum);
      first = false;
    }
  });
  file.commit();
}

/// Loads a network that `save_network` wrote, and validates it.
/// \throw input_error    for a file that is absent, foreign, of another version or byte order, truncated, too long, or
///                       altered: names the byte
/// \throw network_error  where the arrays do not form a network: names the pore or throat
[[nodiscard]] inline network load_network(const std::filesystem::path& path) {
  const auto refuse = [&](std::uint64_t byte, const std::string& found, const std::string& expected) {
    throw input_error(path.string() + ": byte " + std::to_string(byte), found, expected);
  };
  std::error_code status;
  const std::uint64_t size = std::filesystem::file_size(path, status);
  if (status) {
    throw input_error(path.string(), status.message(), "a file that can be read");
  }
  std::ifstream file(path, std::ios::binary);
  const auto read = [&](void* to, std::size_t bytes, std::uint64_t at) {
    if (!file.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) {
      refuse(at + static_cast<std::uint64_t>(file.gcount()), "the end of what can be read",
             std::to_string(bytes) + " bytes from byte " + std::to_string(at));
    }
  };
  if (!file) {
    throw input_error(path.string(), std::strerror(errno), "a file that can be read");
  }

  const detail::network_header good;
  detail::network_header header;
  if (size < sizeof header) {
    refuse(size, "the end of the file", "a header of " + std::to_string(sizeof header) + " bytes");
  }
  read(&header, sizeof header, 0);
  if (header.magic != good.magic) {
    refuse(0, "other letters", "TETRAPOR, by which a network file begins");
  }
  if (header.byte_order != good.byte_order) {
    refuse(8, "the byte order of another machine", "the byte order of this one");
  }
  if (header.version != good.version) {
    refuse(12, "version " + std::to_string(header.version), "version " + std::to_string(good.version));
  }
  constexpr std::uint64_t most = 0xfffffffeU;
  const std::array<std::uint64_t, 3> counts{header.grains, header.pores, header.throats};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] > most) {
      refuse(16 + 8 * k, std::to_string(counts[k]), "a number below 2^32 - 1");
    }
  }
  if (header.periodic > 1) {
    refuse(40, std::to_string(header.periodic), "0 or 1");
  }
  if (header.payload != detail::payload_size(header)) {
    refuse(56, std::to_string(header.payload) + " bytes",
           std::to_string(detail::payload_size(header)) + ", which the numbers of grains, pores and throats take");
  }
  if (size != sizeof header + header.payload) {
    const std::uint64_t end = sizeof header + header.payload;
    refuse(std::min(size, end), size < end ? "the end of the file" : "more bytes",
           "a file of " + std::to_string(end) + " bytes");
  }

  detail::checksum sum;
  sum.add(&header, offsetof(detail::network_header, sum));
  std::uint64_t at = sizeof header;
  detail::stored_domain region;
  read(&region, sizeof region, at);
  sum.add(&region, sizeof region);
  at += sizeof region;
  network_arrays a;
  detail::visit_network_arrays(a, header, [&](auto& array, std::uint64_t rows) {
    array.resize(static_cast<std::size_t>(rows));
    const std::size_t bytes = array.size() * sizeof(array[0]);
    read(array.data(), bytes, at);
    sum.add(array.data(), bytes);
    at += bytes;
  });
  if (sum.value() != header.sum) {
    refuse(offsetof(detail::network_header, sum), "a checksum that differs from that of the data",
           "a file as it was written");
  }
  for (std::size_t k = 0; k < 3; ++k) {
    a.region.bounds.lo[k] = region.bounds[2 * k];
    a.region.bounds.hi[k] = region.bounds[2 * k + 1];
  }
  for (std::size_t f = 0; f < 6; ++f) {
    if (region.faces[f] > static_cast<std::uint8_t>(boundary::periodic)) {
      refuse(sizeof header + offsetof(detail::stored_domain, faces) + f, std::to_string(region.faces[f]),
             "0 (open), 1 (wall) or 2 (periodic)");
    }
    a.region.faces[f] = static_cast<boundary>(region.faces[f]);
  }
  network loaded(std::move(a), header.epoch);
  validate(loaded);
  return loaded;
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
