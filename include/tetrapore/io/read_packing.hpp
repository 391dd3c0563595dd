// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/read_dump.hpp"
#include "tetrapore/io/read_pack_out.hpp"
#include "tetrapore/io/read_table.hpp"
#include "tetrapore/io/read_xyzd.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// \file
/// Reads a packing of spheres from any of the known formats.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {
namespace detail {

/// The first line decides where it can; then the extension; a table is what is left.
[[nodiscard]] inline packing_format recognise(std::string_view head, const std::filesystem::path& path) {
  if (head.substr(0, 3) == "\xef\xbb\xbf") {
    head.remove_prefix(3);
  }
  const auto starts = [&](std::string_view mark) { return head.substr(0, mark.size()) == mark; };
  if (starts("ITEM: ")) {
    return packing_format::dump;
  }
  if (starts("Number of Spheres")) {
    return packing_format::pack_out;
  }
  if (starts("#format ")) {
    return packing_format::yade;
  }
  const auto extension = lower_case(path.extension().string());
  if (extension == ".xyzd") {
    return packing_format::xyzd;
  }
  return extension == ".csv" ? packing_format::csv : packing_format::automatic;
}

[[nodiscard]] inline read_result read_from(byte_source& bytes, const std::filesystem::path& name,
                                           const read_options& options, std::optional<byte_source> nfo_bytes) {
  read_result result;
  auto& report = result.report;
  report.source = bytes.name();
  report.format = options.format == packing_format::automatic ? recognise(bytes.peek(32), name) : options.format;
  switch (report.format) {
    case packing_format::dump: result.packing = read_dump(bytes, options, report); break;
    case packing_format::pack_out: result.packing = read_pack_out(bytes, options, report); break;
    case packing_format::xyzd: {
      std::optional<nfo> stated;
      if (nfo_bytes) {
        stated = read_nfo(*nfo_bytes, options, report);
      }
      result.packing = read_xyzd(bytes, stated ? &*stated : nullptr, options, report);
      break;
    }
    case packing_format::automatic:
    case packing_format::text:
    case packing_format::csv:
    case packing_format::yade: result.packing = read_table(bytes, options, report); break;
  }
  return result;
}

}  // namespace detail

/// Reads a packing. Grains keep the order of the file; nothing is returned unless everything is right.
/// \par Units  the file's unit times options.scale, to [m]
/// \par Accuracy  decimal numbers are read to the nearest double, whatever the locale
/// \throw input_error      names file and line (or byte), what was found and what was expected
/// \throw packing_error    a grain a million box lengths outside of a periodic box
/// \throw parameter_error  an option outside its domain
[[nodiscard]] inline read_result read_packing(const std::filesystem::path& path, const read_options& options = {}) {
  byte_source bytes(path);
  std::optional<byte_source> nfo_bytes;
  for (const auto& beside :
       {std::filesystem::path(path).replace_extension(".nfo"), path.parent_path() / "packing.nfo"}) {
    std::error_code error;
    if (!nfo_bytes && path.extension() == ".xyzd" && std::filesystem::is_regular_file(beside, error)) {
      nfo_bytes.emplace(beside);
    }
  }
  return detail::read_from(bytes, path, options, std::move(nfo_bytes));
}

/// The same from memory. `name` stands for the file in messages, and its extension counts; `nfo_text` is what a .nfo
/// file beside an .xyzd file would say, empty for none.
[[nodiscard]] inline read_result read_packing_from_memory(std::string_view content, const std::string& name,
                                                          const read_options& options = {},
                                                          std::string_view nfo_text = {}) {
  byte_source bytes(content, name);
  std::optional<byte_source> nfo_bytes;
  if (!nfo_text.empty()) {
    nfo_bytes.emplace(nfo_text, name + ".nfo");
  }
  return detail::read_from(bytes, name, options, std::move(nfo_bytes));
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
