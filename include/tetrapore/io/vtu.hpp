// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/vtk_xml.hpp"
#include "tetrapore/network/gather.hpp"

#include <unordered_map>

/// \file
/// Pores and throats as unstructured grids (VTU) for ParaView.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

namespace detail {

/// The corners of cells and facets: grain centres, their periodic images, and their feet on walls. Equal corners share
/// one point, so that filters which walk from cell to cell find the neighbour.
class corner_points {
 public:
  explicit corner_points(const network& net) : net_(net) {
    points_.reserve(net.grain_count());
    for (const auto& g : net.grains()) {
      points_.push_back(g.centre);
    }
  }

  /// The centre of grain vertex k of pore p, projected on the given walls.
  std::int32_t at(pore_id p, std::size_t k, std::initializer_list<face> feet = {}) {
    const std::uint32_t grain = net_.vertices(p)[k].grain().value;
    const image i = net_.image_of(p, k);
    if (i == image{} && feet.size() == 0) {
      return static_cast<std::int32_t>(grain);
    }
    std::uint64_t key = grain;
    for (const std::int8_t step : {i.x, i.y, i.z}) {
      key = (key << 8U) | static_cast<std::uint8_t>(step);
    }
    std::uint64_t on = 0;
    vec3<double> point = net_.grain_sphere(p, k).centre;
    for (const face f : feet) {
      on |= std::uint64_t{1} << static_cast<unsigned>(f);
      point[axis_of(f)] = net_.region().bounds.position(f);
    }
    key = (key << 6U) | on;
    const auto [entry, added] = index_.try_emplace(key, static_cast<std::int32_t>(points_.size()));
    if (added) {
      points_.push_back(point);
    }
    return entry->second;
  }

  [[nodiscard]] const std::vector<vec3<double>>& points() const noexcept { return points_; }

 private:
  const network& net_;
  std::vector<vec3<double>> points_;
  std::unordered_map<std::uint64_t, std::int32_t> index_;
};

/// VTK's numbers of the cell types used here.
enum class vtk_cell : std::uint8_t { triangle = 5, quad = 9, tetra = 10, hexahedron = 12, wedge = 13 };

struct vtk_cells {
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> ends;
  std::vector<vtk_cell> types;

  void add(vtk_cell type, std::initializer_list<std::int32_t> c) {
    corners.insert(corners.end(), c);
    ends.push_back(static_cast<std::int32_t>(corners.size()));
    types.push_back(type);
  }
};

inline void add_pore(vtk_cells& cells, corner_points& corners, const network& net, pore_id p) {
  const auto c = [&](std::size_t k, std::initializer_list<face> feet = {}) { return corners.at(p, k, feet); };
  const auto wall = [&](std::size_t k) { return net.vertices(p)[k].wall(); };
  switch (net.grain_vertices(p)) {
    case 4: cells.add(vtk_cell::tetra, {c(0), c(1), c(2), c(3)}); break;
    case 3: {  // VTK wants the first triangle to face out of the wedge: the feet do, as the order is positive
      const face w = wall(3);
      cells.add(vtk_cell::wedge, {c(0, {w}), c(1, {w}), c(2, {w}), c(0), c(1), c(2)});
      break;
    }
    case 2: {  // and the first quadrangle of a hexahedron to face in: from grain 0 to grain 1
      const face a = wall(2);
      const face b = wall(3);
      cells.add(vtk_cell::hexahedron, {c(0), c(0, {a}), c(0, {a, b}), c(0, {b}),  //
                                       c(1), c(1, {a}), c(1, {a, b}), c(1, {b})});
      break;
    }
    default: {
      const face x = wall(1);
      const face y = wall(2);
      const face z = wall(3);
      cells.add(vtk_cell::hexahedron, {c(0), c(0, {x}), c(0, {x, y}), c(0, {y}),  //
                                       c(0, {z}), c(0, {x, z}), c(0, {x, y, z}), c(0, {y, z})});
    }
  }
}

inline void add_throat(vtk_cells& cells, corner_points& corners, const network& net, throat_id t) {
  const pore_id p = net.pores(t)[0];
  const auto f = facet_slots(net, p, net.slot(t, 0));
  const auto c = [&](std::size_t i, std::initializer_list<face> feet = {}) { return corners.at(p, f[i], feet); };
  const auto wall = [&](std::size_t i) { return net.vertices(p)[f[i]].wall(); };
  if (net.vertices(p)[f[1]].is_wall()) {
    const face a = wall(1);
    const face b = wall(2);
    cells.add(vtk_cell::quad, {c(0), c(0, {a}), c(0, {a, b}), c(0, {b})});
  } else if (net.vertices(p)[f[2]].is_wall()) {
    const face w = wall(2);
    cells.add(vtk_cell::quad, {c(0), c(1), c(1, {w}), c(0, {w})});
  } else {
    cells.add(vtk_cell::triangle, {c(0), c(1), c(2)});
  }
}

inline void write_grid(const std::filesystem::path& path, const corner_points& corners, const vtk_cells& cells,
                       std::span<const data_column> data) {
  const std::size_t count = cells.types.size();
  vtk_xml_file file(path, "UnstructuredGrid");
  file.open("Piece NumberOfPoints=\"" + std::to_string(corners.points().size()) + "\" NumberOfCells=\"" +
            std::to_string(count) + "\"");
  file.columns("CellData", data, count);
  file.open("Points");
  file.array({"Points", corners.points()});
  file.close("Points");
  file.open("Cells");
  file.array({"connectivity", cells.corners});
  file.array({"offsets", cells.ends});
  file.array({"types", cells.types});
  file.close("Cells");
  file.close("Piece");
  file.finish();
}

}  // namespace detail

/// Writes the pores as cells: a tetrahedron between four grains, a wedge at a wall, a hexahedron at an edge or a corner
/// of the box. Across a periodic face a pore keeps its shape and sticks out of the box. Cell k is pore k.
/// \par Units   [m], as the network
/// \param data  columns of one row per pore
/// \throw output_error     where the file cannot be written
/// \throw parameter_error  for a column of another length; nothing is written then
inline void write_pores(const std::filesystem::path& path, const network& net, std::span<const data_column> data) {
  detail::corner_points corners(net);
  detail::vtk_cells cells;
  cells.corners.reserve(4 * net.pore_count());
  cells.ends.reserve(net.pore_count());
  cells.types.reserve(net.pore_count());
  for (std::size_t p = 0; p < net.pore_count(); ++p) {
    detail::add_pore(cells, corners, net, pore_id(p));
  }
  detail::write_grid(path, corners, cells, data);
}
inline void write_pores(const std::filesystem::path& path, const network& net,
                        std::initializer_list<data_column> data) {
  write_pores(path, net, std::span(data.begin(), data.size()));
}

/// Writes the throats as polygons: a triangle between three grains, a quadrangle at walls. Cell k is throat k, its
/// normal points from pore 0 to pore 1.
/// \par Units   [m], as the network
/// \param data  columns of one row per throat
/// \throw output_error     where the file cannot be written
/// \throw parameter_error  for a column of another length; nothing is written then
inline void write_throats(const std::filesystem::path& path, const network& net, std::span<const data_column> data) {
  detail::corner_points corners(net);
  detail::vtk_cells cells;
  for (std::size_t t = 0; t < net.throat_count(); ++t) {
    detail::add_throat(cells, corners, net, throat_id(t));
  }
  detail::write_grid(path, corners, cells, data);
}
inline void write_throats(const std::filesystem::path& path, const network& net,
                          std::initializer_list<data_column> data) {
  write_throats(path, net, std::span(data.begin(), data.size()));
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
