// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/vec3.hpp"
#include "tetrapore/io/output_file.hpp"

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

/// \file
/// What VTU and VTP files share: named columns of numbers, appended to the XML as raw binary.
///
/// Encoding: one `<AppendedData encoding="raw">` block behind the XML, each array preceded by its length in bytes as
/// UInt64, in the byte order of this machine, which the header names. ParaView and VTK read it without a plug-in; a
/// general XML parser stops at the block, as the VTK format intends.
///
/// NaN policy: numbers are written bit by bit, NaN and infinity too, and ParaView paints them in its "NaN colour". A
/// column that may hold them is best written beside a column that says why (a status).

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

namespace detail {

/// VTK's name of a type of numbers.
template <class T>
[[nodiscard]] constexpr const char* vtk_type_name() noexcept {
  if constexpr (std::is_enum_v<T>) {
    return vtk_type_name<std::underlying_type_t<T>>();
  } else if constexpr (std::is_floating_point_v<T>) {
    static_assert(sizeof(T) == 4 || sizeof(T) == 8, "VTK knows float and double");
    return sizeof(T) == 4 ? "Float32" : "Float64";
  } else {
    static_assert(std::is_integral_v<T> && !std::is_same_v<T, bool>, "a column holds numbers, enumerations or vec3");
    constexpr std::array<const char*, 4> with_sign{"Int8", "Int16", "Int32", "Int64"};
    constexpr std::array<const char*, 4> without{"UInt8", "UInt16", "UInt32", "UInt64"};
    constexpr auto k = static_cast<std::size_t>(std::countr_zero(sizeof(T)));
    return std::is_signed_v<T> ? with_sign[k] : without[k];
  }
}

template <class T>
struct vtk_element {
  using scalar = T;
  static constexpr std::size_t components = 1;
};
template <class T>
struct vtk_element<vec3<T>> {
  static_assert(sizeof(vec3<T>) == 3 * sizeof(T));
  using scalar = T;
  static constexpr std::size_t components = 3;
};

[[nodiscard]] inline std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

}  // namespace detail

/// A named column of numbers: a view of the caller's array, which must live until the file is written. Elements are
/// integers, enumerations, float, double or vec3.
class data_column {
 public:
  template <class Array>
    requires requires(const Array& a) {
      std::data(a);
      std::size(a);
    }
  data_column(std::string name, const Array& values) : name_(std::move(name)), bytes_(std::data(values)) {
    using value = std::remove_cvref_t<decltype(*std::data(values))>;
    using element = detail::vtk_element<value>;
    rows_ = std::size(values);
    size_ = rows_ * sizeof(value);
    components_ = element::components;
    type_ = detail::vtk_type_name<typename element::scalar>();
  }

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const char* type() const noexcept { return type_; }
  [[nodiscard]] std::size_t components() const noexcept { return components_; }
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t size_in_bytes() const noexcept { return size_; }
  [[nodiscard]] const void* bytes() const noexcept { return bytes_; }

 private:
  std::string name_;
  const void* bytes_;
  const char* type_ = nullptr;
  std::size_t components_ = 1;
  std::size_t rows_ = 0;
  std::size_t size_ = 0;
};

namespace detail {

/// One VTK XML file under way: elements first, then the arrays that they announced.
class vtk_xml_file {
 public:
  /// \param attributes  of the element that is named as the type, with a blank in front
  vtk_xml_file(const std::filesystem::path& path, std::string_view type, std::string_view attributes = "")
      : file_(path), type_(type) {
    constexpr bool little = std::endian::native == std::endian::little;
    file_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type_ << "\" version=\"1.0\" byte_order=\""
          << (little ? "LittleEndian" : "BigEndian") << "\" header_type=\"UInt64\">\n<" << type_ << attributes << ">\n";
  }

  void open(std::string_view tag_and_attributes) { file_ << '<' << tag_and_attributes << ">\n"; }
  void close(std::string_view tag) { file_ << "</" << tag << ">\n"; }

  /// Announces an array; its bytes follow in `finish`.
  void array(data_column c) {
    file_ << "<DataArray type=\"" << c.type() << "\" Name=\"" << xml_escaped(c.name()) << "\" NumberOfComponents=\""
          << c.components() << "\" format=\"appended\" offset=\"" << offset_ << "\"/>\n";
    offset_ += sizeof(std::uint64_t) + c.size_in_bytes();
    arrays_.push_back(std::move(c));
  }

  /// A block of the caller's columns, each of which must have one row per cell or point.
  void columns(std::string_view tag, std::span<const data_column> all, std::size_t rows) {
    open(tag);
    for (const data_column& c : all) {
      if (c.rows() != rows) {
        throw parameter_error("column \"" + c.name() + "\"", std::to_string(c.rows()) + " rows",
                              std::to_string(rows) + ", one per row of " + file_.path().filename().string());
      }
      array(c);
    }
    close(tag);
  }

  void finish() {
    file_ << "</" << type_ << ">\n<AppendedData encoding=\"raw\">\n_";
    for (const data_column& c : arrays_) {
      const auto size = static_cast<std::uint64_t>(c.size_in_bytes());
      file_.write(&size, sizeof size);
      file_.write(c.bytes(), c.size_in_bytes());
    }
    file_ << "\n</AppendedData>\n</VTKFile>\n";
    file_.commit();
  }

 private:
  output_file file_;
  std::string type_;
  std::vector<data_column> arrays_;
  std::size_t offset_ = 0;
};

}  // namespace detail
}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
