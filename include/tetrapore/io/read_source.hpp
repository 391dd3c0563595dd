// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

/// \file
/// Where readers take bytes, lines and numbers from: a file, in blocks, or memory. Independent of the locale; memory is
/// bounded by the longest line that is allowed.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// Text from a file as it may stand in a message: shortened, and bytes that do not print written in hexadecimal.
[[nodiscard]] inline std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  constexpr const char* digits = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      out += c;
    } else {
      out += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return out + (text.size() > longest ? "…\"" : "\"");
}

/// Bytes in order, from a file or from memory. An empty source is an error: no format is empty.
class byte_source {
 public:
  /// \throw input_error  the file is missing, is a folder, cannot be read, or is empty
  explicit byte_source(const std::filesystem::path& path) : name_(path.string()) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
      throw input_error(name_, "a folder", "a file of spheres");
    }
    file_.reset(std::fopen(path.c_str(), "rb"));
    if (!file_) {
      throw input_error(name_, std::string("no readable file (") + std::strerror(errno) + ")", "a file of spheres");
    }
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
    refuse_empty();
  }
  byte_source(std::string_view bytes, std::string name) : name_(std::move(name)), memory_(bytes) { refuse_empty(); }

  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// Fills `to` with up to `n` bytes; fewer only at the end.
  std::size_t read(char* to, std::size_t n) {
    const std::size_t head = std::min(n, ahead_.size() - taken_);
    std::copy_n(ahead_.data() + taken_, head, to);
    taken_ += head;
    return head + raw_read(to + head, n - head);
  }

  /// The first bytes, without taking them: at most `n`.
  [[nodiscard]] std::string_view peek(std::size_t n) {
    if (ahead_.size() < n) {
      const auto had = ahead_.size();
      ahead_.resize(n);
      ahead_.resize(had + raw_read(ahead_.data() + had, n - had));
    }
    return std::string_view(ahead_).substr(taken_, n);
  }

 private:
  struct closer {
    void operator()(std::FILE* f) const noexcept { std::fclose(f); }
  };

  std::size_t raw_read(char* to, std::size_t n) {
    if (n == 0) {
      return 0;
    }
    if (!file_) {
      const std::size_t part = std::min(n, memory_.size());
      std::copy_n(memory_.data(), part, to);
      memory_.remove_prefix(part);
      return part;
    }
    const std::size_t part = std::fread(to, 1, n, file_.get());
    if (part < n && std::ferror(file_.get()) != 0) {
      throw input_error(name_, std::string("a read error (") + std::strerror(errno) + ")", "bytes");
    }
    return part;
  }
  void refuse_empty() {
    if (peek(1).empty()) {
      throw input_error(name_ + ":1", "an empty file", "at least one sphere");
    }
  }

  std::string name_;
  std::string_view memory_;
  std::unique_ptr<std::FILE, closer> file_;
  std::string ahead_;
  std::size_t taken_ = 0;
};

/// Lines of a source, one at a time: without their end (LF or CR LF), without a UTF-8 mark at the start.
class line_source {
 public:
  line_source(byte_source& bytes, std::size_t longest_line)
      : bytes_(bytes), longest_(longest_line), block_(block_size) {}

  /// The next line, valid until the following call; false at the end.
  /// \throw input_error  a line longer than allowed
  bool next(std::string_view& line) {
    for (;;) {
      const char* first = block_.data() + begin_;
      const auto* stop = static_cast<const char*>(std::memchr(first + scanned_, '\n', end_ - begin_ - scanned_));
      if (stop != nullptr) {
        line = std::string_view(first, static_cast<std::size_t>(stop - first));
        begin_ += line.size() + 1;
        break;
      }
      scanned_ = end_ - begin_;
      if (finished_) {
        if (scanned_ == 0) {
          return false;
        }
        line = std::string_view(first, scanned_);
        begin_ = end_;
        break;
      }
      if (scanned_ > longest_) {
        too_long();
      }
      std::memmove(block_.data(), first, scanned_);
      begin_ = 0;
      if (scanned_ == block_.size()) {
        block_.resize(2 * block_.size());  // at most twice the longest line
      }
      end_ = scanned_ + bytes_.read(block_.data() + scanned_, block_.size() - scanned_);
      finished_ = end_ < block_.size();
    }
    scanned_ = 0;
    if (line.size() > longest_ + 1) {
      too_long();
    }
    ++number_;
    if (number_ == 1 && line.substr(0, 3) == "\xef\xbb\xbf") {
      line.remove_prefix(3);
    }
    if (!line.empty() && line.back() == '\r') {
      line.remove_suffix(1);
    }
    return true;
  }

  /// Number of the last line read; 1 is the first.
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  [[nodiscard]] std::string where() const { return where(number_); }
  [[nodiscard]] std::string where(std::size_t line) const { return bytes_.name() + ":" + std::to_string(line); }

 private:
  static constexpr std::size_t block_size = std::size_t{1} << 16;

  [[noreturn]] void too_long() const {
    throw input_error(where(number_ + 1), "a line of more than " + std::to_string(longest_) + " bytes",
                      "lines of at most " + std::to_string(longest_) + " bytes");
  }

  byte_source& bytes_;
  std::size_t longest_;
  std::vector<char> block_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t scanned_ = 0;
  std::size_t number_ = 0;
  bool finished_ = false;
};

[[nodiscard]] constexpr bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// Text without the blanks around it.
[[nodiscard]] constexpr std::string_view trimmed(std::string_view text) noexcept {
  while (!text.empty() && is_blank(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && is_blank(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

/// ASCII letters in lower case: names of columns do not depend on case.
[[nodiscard]] inline std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return out;
}

/// Cuts a line into fields, at blanks (`separator` 0) or at a separator; quotes around a field are taken off, and a
/// separator inside them does not cut.
inline void split(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  const std::size_t n = line.size();
  if (separator == 0) {
    for (std::size_t i = 0; i < n;) {
      while (i < n && is_blank(line[i])) {
        ++i;
      }
      const std::size_t first = i;
      while (i < n && !is_blank(line[i])) {
        ++i;
      }
      if (i > first) {
        fields.push_back(line.substr(first, i - first));
      }
    }
    return;
  }
  for (std::size_t first = 0; first <= n;) {
    std::size_t stop = first;
    bool open = false;
    while (stop < n && (open || line[stop] != separator)) {
      open = (line[stop] == '"') != open;
      ++stop;
    }
    auto field = trimmed(line.substr(first, stop - first));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
      field = field.substr(1, field.size() - 2);
    }
    fields.push_back(field);
    first = stop + 1;
  }
}

/// Reads one finite number that fills the whole text.
[[nodiscard]] inline bool parse_number(std::string_view text, double& value) noexcept {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && stop == text.data() + text.size() && std::isfinite(value);
}

[[nodiscard]] inline bool parse_count(std::string_view text, std::uint64_t& value) noexcept {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && stop == text.data() + text.size();
}

/// \throw input_error  not a finite number
[[nodiscard]] inline double number_at(const line_source& lines, std::string_view text, const char* what) {
  double value = 0;
  if (!parse_number(text, value)) {
    throw input_error(lines.where(), shown(text), std::string("a finite number for ") + what);
  }
  return value;
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
