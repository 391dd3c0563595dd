// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

/// \file
/// A file that appears under its name only when it is complete.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// A file or folder that cannot be written. Names the path, and what the system said.
class output_error : public setup_error {
 public:
  output_error(const std::filesystem::path& path, const std::string& reason)
      : setup_error(path.string(), reason, "a file that can be written") {}
};

/// Writes to `path.part` and renames it to `path` on `commit`, so that a run that is killed or fails leaves no half
/// file under a good name, and what stood there before stays until then. Without a commit the part is removed.
///
/// Numbers are written without regard to the locale. A double gets the fewest digits that read back as the same double
/// (at most 17); `nan`, `inf`, `-inf` are written in these letters.
/// \throw output_error  where the system refuses: no such folder, no permission, disk full
class output_file {
 public:
  explicit output_file(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
    part_ += ".part";
    file_.reset(std::fopen(part_.string().c_str(), "wb"));
    if (!file_) {
      throw output_error(path_, std::strerror(errno));
    }
    buffer_.reserve(buffer_size);
  }
  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;
  ~output_file() {
    if (file_) {
      file_.reset();
      std::error_code ignored;  // a destructor cannot report; the part is named so that nobody takes it for the file
      std::filesystem::remove(part_, ignored);
    }
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  output_file& operator<<(std::string_view text) {
    write(text.data(), text.size());
    return *this;
  }
  output_file& operator<<(char c) {
    write(&c, 1);
    return *this;
  }
  template <class N>
    requires(std::integral<N> || std::floating_point<N>) && (!std::same_as<N, char>) && (!std::same_as<N, bool>)
  output_file& operator<<(N number) {
    std::array<char, 40> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    write(digits.data(), static_cast<std::size_t>(end.ptr - digits.data()));
    return *this;
  }

  /// Bytes as they are in memory.
  void write(const void* bytes, std::size_t count) {
    if (buffer_.size() + count > buffer_size) {
      flush();
    }
    if (count > buffer_size) {
      put(bytes, count);
    } else {
      buffer_.append(static_cast<const char*>(bytes), count);
    }
  }

  /// Gives the complete file its name. Nothing may be written afterwards.
  void commit() {
    flush();
    std::FILE* file = file_.release();
    if (std::fclose(file) != 0) {
      fail(errno);
    }
    std::error_code error;
    std::filesystem::rename(part_, path_, error);
    if (error) {
      fail(error.value());
    }
  }

 private:
  static constexpr std::size_t buffer_size = std::size_t{1} << 16U;

  struct closer {
    void operator()(std::FILE* f) const noexcept { std::fclose(f); }
  };

  void put(const void* bytes, std::size_t count) {
    if (count > 0 && std::fwrite(bytes, 1, count, file_.get()) != count) {
      throw output_error(path_, std::strerror(errno));
    }
  }
  void flush() {
    put(buffer_.data(), buffer_.size());
    buffer_.clear();
  }
  [[noreturn]] void fail(int reason) const {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    throw output_error(path_, std::strerror(reason));
  }

  std::filesystem::path path_;
  std::filesystem::path part_;
  std::unique_ptr<std::FILE, closer> file_;
  std::string buffer_;
};

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
