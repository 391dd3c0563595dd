// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/byte_files.hpp"
#include "tetrapore/lbm/kept_waits.hpp"

#include <cstdio>
#include <string>

/// \file
/// The states of an experiment's waits in a folder, a file for each.

namespace support {

class wait_files final : public tetrapore::lbm::kept_waits {
 public:
  explicit wait_files(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }
  [[nodiscard]] std::optional<std::vector<std::byte>> load(std::size_t wait) override {
    const std::filesystem::path file = file_of(wait);
    if (!std::filesystem::exists(file)) {
      return std::nullopt;
    }
    std::fprintf(stderr, "takes up %s\n", file.string().c_str());
    return bytes_of(file);
  }
  void save(std::size_t wait, const std::vector<std::byte>& state) override { write_bytes(file_of(wait), state); }

 private:
  [[nodiscard]] std::filesystem::path file_of(std::size_t wait) const {
    return folder_ / ("wait_" + std::to_string(wait + 1) + ".bin");
  }

  std::filesystem::path folder_;
};

}  // namespace support
