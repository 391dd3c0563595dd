// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/vtk_xml.hpp"

#include <cstddef>
#include <initializer_list>

/// \file
/// Numbers on the points of a regular lattice (VTI) for ParaView.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// A lattice of points. \par Units  origin and spacing in any unit of length
struct image_grid {
  std::array<int, 3> size{1, 1, 1};
  vec3<double> origin{};
  double spacing = 1;
};

/// Writes columns of one number for each point, x fastest, z slowest.
/// \throw output_error     where the file cannot be written
/// \throw parameter_error  for a column of another length, a size below 1 or a spacing that is not above 0; nothing is
///                         written then
inline void write_image(const std::filesystem::path& path, const image_grid& grid, std::span<const data_column> data) {
  std::size_t points = 1;
  for (const int n : grid.size) {
    if (n < 1 || !(grid.spacing > 0)) {
      throw parameter_error(path.filename().string(), std::to_string(n) + " points, " + short_number(grid.spacing),
                            "at least one point, a spacing above 0");
    }
    points *= static_cast<std::size_t>(n);
  }
  std::string extent;
  for (const int n : grid.size) {
    extent += (extent.empty() ? "0 " : " 0 ") + std::to_string(n - 1);
  }
  const std::string step = short_number(grid.spacing);
  detail::vtk_xml_file file(path, "ImageData",
                            " WholeExtent=\"" + extent + "\" Origin=\"" + short_number(grid.origin.x) + ' ' +
                                short_number(grid.origin.y) + ' ' + short_number(grid.origin.z) + "\" Spacing=\"" +
                                step + ' ' + step + ' ' + step + '"');
  file.open("Piece Extent=\"" + extent + '"');
  file.columns("PointData", data, points);
  file.close("Piece");
  file.finish();
}
inline void write_image(const std::filesystem::path& path, const image_grid& grid,
                        std::initializer_list<data_column> data) {
  write_image(path, grid, std::span(data.begin(), data.size()));
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
