// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"
#include "tetrapore/io/vtk_xml.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

/// \file
/// Grains as points with a radius, bridges as tubes (VTP) for ParaView.

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

/// A surface of revolution, open at its ends: the meniscus of a bridge.
/// \par Units  [m]; axis a unit vector
struct tube {
  vec3<double> start;                 ///< a point of the axis
  vec3<double> axis;                  ///< its direction
  std::vector<vec2<double>> profile;  ///< x: distance from the start along the axis, y: radius there
};

/// Writes tubes as triangle strips, one cell for each, that face outward. Places are written as float.
/// \par Units   [m]
/// \param data   columns of one row per tube
/// \param sides  corners of a tube's section, at least 3
/// \throw output_error     where the file cannot be written
/// \throw parameter_error  for a column of another length, fewer than 3 sides, a profile of fewer than 2 points, or
///                         more points than 2^31; nothing is written then
inline void write_tubes(const std::filesystem::path& path, std::span<const tube> tubes,
                        std::span<const data_column> data = {}, std::size_t sides = 12) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (sides < 3) {
    throw parameter_error("sides of a tube", std::to_string(sides), "at least 3");
  }
  std::vector<vec3<float>> points;
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> ends;
  for (std::size_t k = 0; k < tubes.size(); ++k) {
    const tube& t = tubes[k];
    if (t.profile.size() < 2) {
      throw parameter_error("tube " + std::to_string(k), "a profile of " + std::to_string(t.profile.size()) + " points",
                            "at least 2");
    }
    if (2 * (points.size() + t.profile.size() * (sides + 1)) > most) {
      throw parameter_error("tubes", std::to_string(tubes.size()),
                            "no more than the 2^31 points that a file can number");
    }
    // u, v, axis right-handed; u stands upright on the axis's smallest coordinate
    std::size_t least = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      least = std::abs(t.axis[i]) < std::abs(t.axis[least]) ? i : least;
    }
    vec3<double> u{};
    u[least] = 1;
    u = cross(t.axis, u);
    u = u / norm(u);
    const vec3<double> v = cross(t.axis, u);
    const auto first = static_cast<std::int32_t>(points.size());
    for (const vec2<double>& at : t.profile) {
      for (std::size_t j = 0; j < sides; ++j) {
        const double turn = 2 * pi<double> * static_cast<double>(j) / static_cast<double>(sides);
        const vec3<double> p = t.start + at.x * t.axis + at.y * (std::cos(turn) * u + std::sin(turn) * v);
        points.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      }
    }
    const auto ring = static_cast<std::int32_t>(sides);
    for (std::int32_t band = 0; band + 1 < static_cast<std::int32_t>(t.profile.size()); ++band) {
      for (std::int32_t j = 0; j <= ring; ++j) {  // from band to band the strip goes over a corner twice
        corners.push_back(first + (band + 1) * ring + j % ring);
        corners.push_back(first + band * ring + j % ring);
      }
    }
    ends.push_back(static_cast<std::int32_t>(corners.size()));
  }

  detail::vtk_xml_file file(path, "PolyData");
  file.open("Piece NumberOfPoints=\"" + std::to_string(points.size()) +
            "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"" + std::to_string(tubes.size()) +
            "\" NumberOfPolys=\"0\"");
  file.columns("CellData", data, tubes.size());
  file.open("Points");
  file.array({"Points", points});
  file.close("Points");
  file.open("Strips");
  file.array({"connectivity", corners});
  file.array({"offsets", ends});
  file.close("Strips");
  file.close("Piece");
  file.finish();
}
inline void write_tubes(const std::filesystem::path& path, std::span<const tube> tubes,
                        std::initializer_list<data_column> data, std::size_t sides = 12) {
  write_tubes(path, tubes, std::span(data.begin(), data.size()), sides);
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
