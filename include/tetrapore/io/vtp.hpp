// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"
#include "tetrapore/io/vtk_xml.hpp"

#include <numeric>

/// \file
/// Grains as points with a radius (VTP) for ParaView.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// Writes one point per grain with the column `radius`: a sphere glyph of radius 1 scaled by it shows the packing.
/// \par Units   [m], as the grains
/// \param data  further columns of one row per grain
/// \throw output_error     where the file cannot be written
/// \throw parameter_error  for a column of another length; nothing is written then
inline void write_grains(const std::filesystem::path& path, std::span<const sphere<double>> grains,
                         std::span<const data_column> data = {}) {
  std::vector<vec3<double>> centres;
  std::vector<double> radii;
  for (const auto& g : grains) {
    centres.push_back(g.centre);
    radii.push_back(g.radius);
  }
  std::vector<std::int32_t> each(grains.size());
  std::iota(each.begin(), each.end(), 0);
  std::vector<std::int32_t> ends(grains.size());
  std::iota(ends.begin(), ends.end(), 1);
  std::vector<data_column> all{{"radius", radii}};
  all.insert(all.end(), data.begin(), data.end());

  detail::vtk_xml_file file(path, "PolyData");
  const std::string count = std::to_string(grains.size());
  file.open("Piece NumberOfPoints=\"" + count + "\" NumberOfVerts=\"" + count +
            "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"");
  file.columns("PointData", all, grains.size());
  file.open("Points");
  file.array({"Points", centres});
  file.close("Points");
  file.open("Verts");
  file.array({"connectivity", each});
  file.array({"offsets", ends});
  file.close("Verts");
  file.close("Piece");
  file.finish();
}
inline void write_grains(const std::filesystem::path& path, std::span<const sphere<double>> grains,
                         std::initializer_list<data_column> data) {
  write_grains(path, grains, std::span(data.begin(), data.size()));
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
