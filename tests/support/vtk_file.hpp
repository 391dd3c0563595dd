// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/temporary_folder.hpp"

#include "tetrapore/core/vec3.hpp"

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

/// \file
/// A reader of VTU, VTP and PVD files, written against the description of the format and apart from our writers.

/// An XML element: its attributes, and the elements inside it. Text between elements is not kept.
struct xml_element {
  std::string tag;
  std::map<std::string, std::string> attributes;
  std::vector<xml_element> children;

  [[nodiscard]] const xml_element& child(const std::string& name) const {
    for (const auto& c : children) {
      if (c.tag == name) {
        return c;
      }
    }
    FAIL("no <" << name << "> in <" << tag << ">");
    return *this;
  }
  [[nodiscard]] const std::string& at(const std::string& name) const {
    REQUIRE_MESSAGE(attributes.count(name) == 1, "no attribute " << name << " in <" << tag << ">");
    return attributes.at(name);
  }
};

/// Parses one element and all inside it, and insists on well-formed XML.
class xml_parser {
 public:
  explicit xml_parser(const std::string& text) : text_(text) {}

  [[nodiscard]] xml_element document() {
    REQUIRE(text_.compare(0, 21, "<?xml version=\"1.0\"?>") == 0);
    at_ = 21;
    xml_element root = element();
    space();
    REQUIRE(at_ == text_.size());
    return root;
  }

 private:
  void space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
      ++at_;
    }
  }
  void expect(const std::string& what) {
    REQUIRE_MESSAGE(text_.compare(at_, what.size(), what) == 0, "expected " << what << " at byte " << at_);
    at_ += what.size();
  }
  [[nodiscard]] std::string name() {
    const std::size_t from = at_;
    while (std::isalnum(static_cast<unsigned char>(text_.at(at_))) != 0 || text_[at_] == '_') {
      ++at_;
    }
    REQUIRE(at_ > from);
    return text_.substr(from, at_ - from);
  }
  [[nodiscard]] std::string value() {
    expect("\"");
    std::string out;
    for (; text_.at(at_) != '"'; ++at_) {
      REQUIRE(text_[at_] != '<');
      if (text_[at_] != '&') {
        out += text_[at_];
        continue;
      }
      const std::map<std::string, char> entities{{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}};
      const std::string entity = text_.substr(at_, text_.find(';', at_) + 1 - at_);
      REQUIRE(entities.count(entity) == 1);
      out += entities.at(entity);
      at_ += entity.size() - 1;
    }
    expect("\"");
    return out;
  }
  [[nodiscard]] xml_element element() {
    space();
    expect("<");
    xml_element e;
    e.tag = name();
    for (space(); text_.at(at_) != '>' && text_[at_] != '/'; space()) {
      const std::string key = name();
      expect("=");
      REQUIRE(e.attributes.emplace(key, value()).second);
    }
    if (text_[at_] == '/') {
      expect("/>");
      return e;
    }
    expect(">");
    for (space(); text_.compare(at_, 2, "</") != 0; space()) {
      e.children.push_back(element());
    }
    expect("</" + e.tag + ">");
    return e;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

/// A VTU or VTP file in memory.
class vtk_file {
 public:
  explicit vtk_file(const std::filesystem::path& path) : bytes_(contents_of(path)) {
    const std::string opening = "<AppendedData encoding=\"raw\">\n_";
    const std::string closing = "\n</AppendedData>\n</VTKFile>\n";
    const std::size_t from = bytes_.find(opening);
    REQUIRE(from != std::string::npos);
    REQUIRE(bytes_.size() > closing.size());
    REQUIRE(bytes_.compare(bytes_.size() - closing.size(), closing.size(), closing) == 0);
    data_ = from + opening.size();
    end_ = bytes_.size() - closing.size();
    const std::string head = bytes_.substr(0, from) + "</VTKFile>";
    root_ = xml_parser(head).document();
    REQUIRE(root_.tag == "VTKFile");
    REQUIRE(root_.at("header_type") == "UInt64");
    REQUIRE(root_.at("byte_order") == "LittleEndian");
    const xml_element& p = piece();
    cells_ = std::stoul(p.attributes.count("NumberOfCells") != 0 ? p.at("NumberOfCells") : p.at("NumberOfVerts"));
    points_ = std::stoul(p.at("NumberOfPoints"));
    check_that_arrays_fill_the_block();
  }

  [[nodiscard]] std::string type() const { return root_.at("type"); }
  [[nodiscard]] const xml_element& piece() const { return root_.child(type()).child("Piece"); }
  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] std::size_t points() const { return points_; }

  /// The array of a name in a block (CellData, Points, Cells …), whose type must be T.
  template <class T>
  [[nodiscard]] std::vector<T> array(const std::string& block, const std::string& name) const {
    for (const auto& a : piece().child(block).children) {
      if (a.at("Name") == name) {
        REQUIRE(a.at("type") == type_name<T>());
        const std::string raw = raw_bytes(a);
        REQUIRE(raw.size() % sizeof(T) == 0);
        std::vector<T> out(raw.size() / sizeof(T));
        std::memcpy(out.data(), raw.data(), raw.size());
        return out;
      }
    }
    FAIL("no array " << name);
    return {};
  }

  /// The corners of cell k.
  [[nodiscard]] std::vector<tetrapore::vec3<double>> corners(std::size_t k) const {
    const auto xyz = array<double>("Points", "Points");
    const auto connectivity = array<std::int32_t>("Cells", "connectivity");
    const auto offsets = array<std::int32_t>("Cells", "offsets");
    REQUIRE(xyz.size() == 3 * points_);
    REQUIRE(offsets.size() == cells_);
    REQUIRE(connectivity.size() == static_cast<std::size_t>(offsets.back()));
    std::vector<tetrapore::vec3<double>> out;
    for (auto i = static_cast<std::size_t>(k == 0 ? 0 : offsets[k - 1]); i < static_cast<std::size_t>(offsets[k]);
         ++i) {
      const auto p = static_cast<std::size_t>(connectivity[i]);
      REQUIRE(p < points_);
      out.push_back({xyz[3 * p], xyz[3 * p + 1], xyz[3 * p + 2]});
    }
    return out;
  }

 private:
  template <class T>
  static std::string type_name() {
    if constexpr (std::is_same_v<T, double>) {
      return "Float64";
    } else if constexpr (std::is_same_v<T, float>) {
      return "Float32";
    } else {
      return (std::is_signed_v<T> ? "Int" : "UInt") + std::to_string(8 * sizeof(T));
    }
  }

  [[nodiscard]] std::string raw_bytes(const xml_element& a) const {
    REQUIRE(a.at("format") == "appended");
    const std::size_t at = data_ + std::stoul(a.at("offset"));
    std::uint64_t size = 0;
    REQUIRE(at + sizeof size <= end_);
    std::memcpy(&size, bytes_.data() + at, sizeof size);
    REQUIRE(at + sizeof size + size <= end_);
    return bytes_.substr(at + sizeof size, size);
  }

  void check_that_arrays_fill_the_block() const {
    std::size_t next = 0;
    for (const auto& block : piece().children) {
      for (const auto& a : block.children) {
        REQUIRE(a.tag == "DataArray");
        REQUIRE(std::stoul(a.at("offset")) == next);
        next += sizeof(std::uint64_t) + raw_bytes(a).size();
      }
    }
    REQUIRE(data_ + next == end_);
  }

  std::string bytes_;
  std::size_t data_ = 0;
  std::size_t end_ = 0;
  std::size_t cells_ = 0;
  std::size_t points_ = 0;
  xml_element root_;
};
