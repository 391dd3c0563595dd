// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/output_file.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

/// \file
/// Files of bytes: the states that a run which is killed leaves to the next.

namespace support {

[[nodiscard]] inline std::vector<std::byte> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::byte> bytes(text.size());
  for (std::size_t k = 0; k < text.size(); ++k) {
    bytes[k] = static_cast<std::byte>(text[k]);
  }
  return bytes;
}
inline void write_bytes(const std::filesystem::path& path, const std::vector<std::byte>& bytes) {
  tetrapore::io::output_file file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace support
