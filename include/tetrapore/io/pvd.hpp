// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/vtk_xml.hpp"

#include <cmath>

/// \file
/// A series of VTU or VTP files as one data set with a time axis (PVD).

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// Lists files with a time each; ParaView opens the list as one data set and plays it. The time is any number that
/// rises: seconds, a capillary pressure, 1 − S.
/// \throw output_error     where the file cannot be written
/// \throw parameter_error  for a time that is not a number above the last one
class pvd_series {
 public:
  explicit pvd_series(std::filesystem::path path) : path_(std::move(path)) {}

  /// \param file  where the data of this time lie; named relative to the list, so that the folder can be moved
  void add(double time, const std::filesystem::path& file) {
    if (!std::isfinite(time) || (!entries_.empty() && !(time > entries_.back().time))) {
      throw parameter_error("time of " + file.string(), short_number(time),
                            entries_.empty() ? "a finite number" : "more than " + short_number(entries_.back().time));
    }
    entries_.push_back({time, file.lexically_proximate(path_.parent_path()).generic_string()});
  }

  void write() const {
    output_file file(path_);
    file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (const auto& e : entries_) {
      file << "<DataSet timestep=\"" << e.time << "\" part=\"0\" file=\"" << detail::xml_escaped(e.file) << "\"/>\n";
    }
    file << "</Collection>\n</VTKFile>\n";
    file.commit();
  }

 private:
  struct entry {
    double time;
    std::string file;
  };
  std::filesystem::path path_;
  std::vector<entry> entries_;
};

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
