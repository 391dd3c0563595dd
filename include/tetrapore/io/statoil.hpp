// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/output_file.hpp"
#include "tetrapore/network/gather.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

/// \file
/// Export to the "Statoil" text format of pore networks, which Imperial College's pnextract writes and pnflow, OpenPNM
/// and others read.
///
/// Four files, numbers counted from 1; -1 stands for the inlet reservoir, 0 for the outlet:
/// - PREFIX_node1.dat: the number of pores and the size of the sample, along the flow first [m]; then for each pore its
///   number, x, y, z [m], number of links, the pores at their other ends, whether it touches the inlet and the outlet
///   (0 or 1), the numbers of the links.
/// - PREFIX_node2.dat: for each pore its number, volume [m³], inscribed radius [m], shape factor, clay volume [m³].
/// - PREFIX_link1.dat: the number of links; then for each link its number, its two pores, inscribed radius [m], shape
///   factor, length from pore to pore [m].
/// - PREFIX_link2.dat: for each link its number, its two pores, the lengths of pore 1, of pore 2 and of the link
///   between them [m], volume [m³], clay volume [m³].
///
/// What the format asks and a tetrahedral network has no exact answer to is filled by these conventions:
/// - The format's flow is along x from 0 to the first size: the axis from inlet to outlet becomes x.
/// - Pores that touch the inlet or the outlet are the reservoirs; they are not listed, and their throats to the other
///   pores become links from -1 or 0. Other throats at a boundary are dead ends and are left out.
/// - All void belongs to the pores, so links have no volume; there is no clay.
/// - Shape factor is r² / (4 A), that of a polygon about its inscribed circle: r and A are the caller's for a throat; a
///   pore takes the mean over its throats weighted by area, as pnextract does.
/// - The position of a pore is the mean of the corners of its cell, the place of a throat that of its facet; two thirds
///   of the way from pore to facet count as pore, the rest as link, as in pnextract.
/// - A throat that is closed (radius 0) has no link, and a pore without links is not listed: the format knows neither.
/// A contact angle, an entry pressure and the merging of facets have no column.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// What the Statoil format needs beside the network. One number per pore or throat. \par Units  [m], [m²]
struct statoil_geometry {
  std::span<const double> pore_radius;    ///< radius of the sphere inscribed in each pore [m]
  std::span<const double> throat_radius;  ///< radius of the circle inscribed in each throat [m]; 0 where it is closed
  std::span<const double> throat_area;    ///< fluid area of each throat [m²], see fluid_area(throat)
  face inlet = face::y_max;
  face outlet = face::y_min;
};

/// How much of a network the files hold.
struct statoil_report {
  std::size_t pores = 0;
  std::size_t links = 0;
  std::size_t reservoir_pores = 0;  ///< left out: they are the reservoirs
  std::size_t closed_throats = 0;   ///< left out: radius 0
  std::size_t isolated_pores = 0;   ///< left out: every throat is closed
};

namespace detail {

/// Mean of the corners of a set of vertices: each grain centre, and its feet on the walls of the set.
template <class Slots>
[[nodiscard]] vec3<double> mean_corner(const network& net, pore_id p, const Slots& slots) {
  vec3<double> sum;
  double grains = 0;
  for (const auto k : slots) {
    if (!net.vertices(p)[k].is_wall()) {
      sum += net.grain_sphere(p, k).centre;
      grains += 1;
    }
  }
  sum = sum / grains;
  for (const auto k : slots) {
    const vertex v = net.vertices(p)[k];
    if (v.is_wall()) {  // half of the corners lie on the wall
      const std::size_t axis = axis_of(v.wall());
      sum[axis] = 0.5 * (sum[axis] + net.region().bounds.position(v.wall()));
    }
  }
  return sum;
}

[[nodiscard]] inline vec3<double> mean_corner(const network& net, pore_id p) {
  return mean_corner(net, p, std::array<std::size_t, 4>{0, 1, 2, 3});
}

}  // namespace detail

/// Writes PREFIX_node1.dat, PREFIX_node2.dat, PREFIX_link1.dat and PREFIX_link2.dat.
/// \throw parameter_error  for a column of another length, a radius or area that is negative or not finite, inlet =
///                         outlet; nothing is written then
/// \throw output_error     where a file cannot be written
inline statoil_report write_statoil(const std::filesystem::path& prefix, const network& net,
                                    const statoil_geometry& g) {
  const auto check = [](const char* name, std::span<const double> values, std::size_t rows) {
    if (values.size() != rows) {
      throw parameter_error(name, std::to_string(values.size()) + " rows", std::to_string(rows));
    }
    for (std::size_t k = 0; k < rows; ++k) {
      if (!(values[k] >= 0) || !std::isfinite(values[k])) {
        throw parameter_error(std::string(name) + " " + std::to_string(k), short_number(values[k]),
                              "a finite number, not negative");
      }
    }
  };
  check("pore_radius", g.pore_radius, net.pore_count());
  check("throat_radius", g.throat_radius, net.throat_count());
  check("throat_area", g.throat_area, net.throat_count());
  if (g.inlet == g.outlet) {
    throw parameter_error("outlet", describe(g.outlet), "another face than the inlet");
  }

  statoil_report report;
  constexpr std::int64_t at_inlet = -1;
  constexpr std::int64_t at_outlet = 0;
  constexpr std::int64_t isolated = -2;
  const auto open = [&](throat_id t) {
    return t.valid() && !net.is_boundary(t) && g.throat_radius[t.index()] > 0 && g.throat_area[t.index()] > 0;
  };
  std::vector<std::int64_t> number(net.pore_count(), isolated);
  for (std::size_t p = 0; p < net.pore_count(); ++p) {
    const auto& throats = net.throats(pore_id(p));
    const bool inlet = net.touches(pore_id(p), g.inlet);
    if (inlet || net.touches(pore_id(p), g.outlet)) {
      number[p] = inlet ? at_inlet : at_outlet;
      ++report.reservoir_pores;
    } else if (std::any_of(throats.begin(), throats.end(), open)) {
      number[p] = static_cast<std::int64_t>(++report.pores);
    } else {
      ++report.isolated_pores;
    }
  }

  struct link {
    throat_id throat;
    std::array<std::int64_t, 2> ends;
    std::array<double, 2> reach;  // from the centre of each pore to the facet
    double shape;
  };
  std::vector<link> links;
  std::vector<std::vector<std::size_t>> links_of(report.pores);
  for (std::size_t k = 0; k < net.throat_count(); ++k) {
    const throat_id t(k);
    if (net.is_boundary(t)) {
      continue;
    }
    const auto [p, q] = net.pores(t);
    std::array<std::int64_t, 2> ends{number[p.index()], number[q.index()]};
    if (!open(t)) {
      ++report.closed_throats;
      continue;
    }
    if (ends[0] <= 0 && ends[1] <= 0) {
      continue;  // inside a reservoir
    }
    const vec3<double> facet = detail::mean_corner(net, p, facet_vertices[net.slot(t, 0)]);
    const vec3<double> beyond = detail::mean_corner(net, q) + net.region().shift(net.shift(t));
    std::array<double, 2> reach{norm(facet - detail::mean_corner(net, p)), norm(facet - beyond)};
    if (ends[1] <= 0) {  // the format puts the reservoir first
      std::swap(ends[0], ends[1]);
      std::swap(reach[0], reach[1]);
    }
    for (const std::int64_t end : ends) {
      if (end > 0) {
        links_of[static_cast<std::size_t>(end - 1)].push_back(links.size());
      }
    }
    const double r = g.throat_radius[k];
    links.push_back({t, ends, reach, r * r / (4 * g.throat_area[k])});
  }
  report.links = links.size();

  // The axis from inlet to outlet becomes x, the other two follow in cyclic order.
  const box& bounds = net.region().bounds;
  const std::size_t x = axis_of(g.inlet);
  const auto along = [&](const vec3<double>& c, std::size_t k) {
    const std::size_t axis = (x + k) % 3;
    return k == 0 && is_max(g.inlet) ? bounds.hi[axis] - c[axis] : c[axis] - bounds.lo[axis];
  };
  const auto named = [&](const char* suffix) {
    std::filesystem::path path = prefix;
    path += suffix;
    return path;
  };
  output_file node1(named("_node1.dat"));
  output_file node2(named("_node2.dat"));
  output_file link1(named("_link1.dat"));
  output_file link2(named("_link2.dat"));

  const vec3<double> size = bounds.size();
  node1 << report.pores << ' ' << size[x] << ' ' << size[(x + 1) % 3] << ' ' << size[(x + 2) % 3] << '\n';
  for (std::size_t p = 0; p < net.pore_count(); ++p) {
    if (number[p] <= 0) {
      continue;
    }
    const vec3<double> c = detail::mean_corner(net, pore_id(p));
    const auto& mine = links_of[static_cast<std::size_t>(number[p] - 1)];
    node1 << number[p] << ' ' << along(c, 0) << ' ' << along(c, 1) << ' ' << along(c, 2) << ' ' << mine.size();
    std::array<bool, 2> touches{};  // outlet (0), inlet (-1)
    double shape = 0;
    double area = 0;
    for (const std::size_t l : mine) {
      const std::int64_t other = links[l].ends[0] == number[p] ? links[l].ends[1] : links[l].ends[0];
      if (other <= 0) {
        touches[static_cast<std::size_t>(-other)] = true;
      }
      const double a = g.throat_area[links[l].throat.index()];
      shape += links[l].shape * a;
      area += a;
      node1 << ' ' << other;
    }
    node1 << ' ' << (touches[1] ? 1 : 0) << ' ' << (touches[0] ? 1 : 0);
    for (const std::size_t l : mine) {
      node1 << ' ' << l + 1;
    }
    node1 << '\n';
    node2 << number[p] << ' ' << net.void_volume(pore_id(p)) << ' ' << g.pore_radius[p] << ' ' << shape / area
          << " 0\n";
  }
  link1 << links.size() << '\n';
  for (std::size_t l = 0; l < links.size(); ++l) {
    const auto& [t, ends, reach, shape] = links[l];
    const double whole = reach[0] + reach[1];
    link1 << l + 1 << ' ' << ends[0] << ' ' << ends[1] << ' ' << g.throat_radius[t.index()] << ' ' << shape << ' '
          << whole << '\n';
    link2 << l + 1 << ' ' << ends[0] << ' ' << ends[1] << ' ' << reach[0] * 2 / 3 << ' ' << reach[1] * 2 / 3 << ' '
          << whole / 3 << " 0 0\n";
  }
  for (output_file* file : {&node1, &node2, &link1, &link2}) {
    file->commit();
  }
  return report;
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
