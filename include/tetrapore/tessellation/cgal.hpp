// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/connect.hpp"
#include "tetrapore/network/measure.hpp"
#include "tetrapore/packing/check.hpp"
#include "tetrapore/tessellation/tessellation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

/// \file
/// Regular triangulation by CGAL. The only header that sees CGAL, whose triangulations are licensed GPL-3+ (or
/// commercially): a program that includes it is distributed under those terms.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// Who a CGAL vertex stands for.
struct cgal_vertex {
  vertex name;
  image at;
};

using cgal_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using cgal_vertex_base =
    CGAL::Triangulation_vertex_base_with_info_3<cgal_vertex, cgal_kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<cgal_kernel>>;
using cgal_cell_base = CGAL::Triangulation_cell_base_with_info_3<
    std::uint32_t, cgal_kernel,
    CGAL::Regular_triangulation_cell_base_3<cgal_kernel, CGAL::Triangulation_cell_base_3<cgal_kernel>,
                                            CGAL::Discard_hidden_points>>;
using cgal_structure = CGAL::Triangulation_data_structure_3<cgal_vertex_base, cgal_cell_base>;
using cgal_regular = CGAL::Regular_triangulation_3<cgal_kernel, cgal_structure>;

/// The coordinates in which the topology is decided. Without periodic axes they are the caller's, moved near the origin
/// without rounding. With periodic axes they are integers, multiples of a quantum of 2^-40 of the longest side: shifts
/// by a box length are then exact, so that all periodic images of a cospherical set are triangulated alike.
struct topology_frame {
  bool rounded = false;
  vec3<double> origin;
  double quantum = 1.0;  ///< [m]
  vec3<double> period;   ///< box lengths in quanta, integers
  double extent = 1.0;   ///< longest side in quanta

  topology_frame(std::span<const sphere<double>> grains, const domain& region) : rounded(region.any_periodic()) {
    vec3<double> lo = grains.front().centre;
    vec3<double> hi = lo;
    for (const auto& g : grains) {
      for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], g.centre[k]);
        hi[k] = std::max(hi[k], g.centre[k]);
      }
    }
    for (const face f : all_faces) {
      if (region.at(f) != boundary::open) {
        (is_max(f) ? hi : lo)[axis_of(f)] = region.bounds.position(f);
      }
    }
    const vec3<double> size = hi - lo;
    extent = std::max({size.x, size.y, size.z, grains.front().radius});
    const double unit = std::ldexp(1.0, std::ilogb(extent));
    for (std::size_t k = 0; k < 3; ++k) {  // a coarse multiple, so that the difference to any coordinate is exact
      origin[k] = std::floor(lo[k] / unit) * unit;
    }
    if (rounded) {
      quantum = unit * 0x1p-40;
      extent = std::ceil(extent / quantum);
      for (std::size_t k = 0; k < 3; ++k) {
        period[k] = region.is_periodic(k) ? std::nearbyint(size[k] / quantum) : 0.0;
      }
    }
  }

  [[nodiscard]] vec3<double> operator()(const vec3<double>& p) const noexcept {
    const vec3<double> d = p - origin;
    return rounded ? vec3<double>{std::nearbyint(d.x / quantum), std::nearbyint(d.y / quantum),
                                  std::nearbyint(d.z / quantum)}
                   : d;
  }
};

/// A cell under its periodic shifts: the translate whose smallest grain lies in the box.
struct canonical_cell {
  std::array<std::pair<vertex, image>, 4> sites;  ///< ascending
  [[nodiscard]] friend auto operator<=>(const canonical_cell&, const canonical_cell&) = default;
};

[[nodiscard]] inline canonical_cell canonical(const std::array<cgal_vertex, 4>& v) {
  std::int32_t smallest = -1;
  for (const auto& s : v) {
    if (!s.name.is_wall() && (smallest < 0 || s.name.code() < smallest)) {
      smallest = s.name.code();
    }
  }
  std::optional<canonical_cell> best;
  for (const auto& base : v) {
    if (base.name.code() != smallest) {
      continue;
    }
    canonical_cell c;
    for (std::size_t k = 0; k < 4; ++k) {
      c.sites[k] = {v[k].name, v[k].name.is_wall() ? image{} : v[k].at - base.at};
    }
    std::sort(c.sites.begin(), c.sites.end());
    if (!best || c < *best) {
      best = c;
    }
  }
  return *best;
}

[[nodiscard]] inline bool in_translate(const canonical_cell& c, const std::array<cgal_vertex, 4>& v) {
  canonical_cell own;
  for (std::size_t k = 0; k < 4; ++k) {
    own.sites[k] = {v[k].name, v[k].name.is_wall() ? image{} : v[k].at};
  }
  std::sort(own.sites.begin(), own.sites.end());
  return own == c;
}

}  // namespace detail

/// Regular triangulation of spheres by CGAL, with walls, periodic axes and open faces in any mix.
///
/// A wall takes part in the search for the topology as a sphere of radius `wall_device` times the longest side; every
/// area, volume and power centre at a wall comes from its plane. Periodic axes are padded with ghost copies until each
/// cell finds its neighbours among the translates; any box will do.
/// \par Domain    at least four grains that are not coplanar, or walls that close the region around them
/// \par Accuracy  exact predicates; with periodic axes on coordinates rounded to 2^-41 of the longest side
/// \par Source    Chareyre et al. 2017, §2.1; walls: the limit of an infinite sphere of the same construction
class cgal_triangulation {
 public:
  /// How the topology is found; no result depends on it.
  struct options {
    double wall_device = 0x1p24;  ///< radius of the sphere that stands for a wall, in longest sides
    double first_padding = 3.0;   ///< first width of the ghost layers, in mean spacings of the grains
  };

  cgal_triangulation() = default;
  explicit cgal_triangulation(options o) : options_(o) {}

  /// \throw packing_error  naming the grain, or the region
  [[nodiscard]] tessellation operator()(std::span<const sphere<double>> grains, const domain& region) const {
    check_triangulable(grains, region);
    const detail::topology_frame frame(grains, region);
    if (!region.any_periodic()) {
      return *attempt(grains, region, frame, 0.0);
    }
    double cell_volume = 1.0;
    for (const double side : {frame.period.x, frame.period.y, frame.period.z}) {
      cell_volume *= side > 0 ? side : frame.extent;
    }
    const double spacing = std::cbrt(cell_volume / static_cast<double>(grains.size()));
    for (double padding = options_.first_padding * spacing; padding < 100.0 * frame.extent; padding *= 1.6) {
      if (auto done = attempt(grains, region, frame, padding)) {
        return std::move(*done);
      }
    }
    throw packing_error("the periodic box", "no closed triangulation with 100 images along each axis",
                        "grains that fill space when repeated");
  }

 private:
  using regular = detail::cgal_regular;

  /// Triangulates with ghost layers of the given width (in quanta); empty when a cell misses a neighbour.
  [[nodiscard]] std::optional<tessellation> attempt(std::span<const sphere<double>> grains, const domain& region,
                                                    const detail::topology_frame& frame, double padding) const {
    regular t;
    tessellation_report report;
    insert_walls(t, region, frame);  // first: a query at a wall would always need exact arithmetic
    const std::vector<vec3<double>> where = insert_grains(t, grains, region, frame, padding, report);
    note_hidden(t, where, report);
    std::vector<regular::Cell_handle> handles = region.any_periodic() ? unrepeated_pores(t) : pores(t);
    number_along_curve(handles, where);
    auto cells = region.any_periodic() ? periodic_cells(t, handles) : bounded_cells(handles);
    if (!cells) {
      return std::nullopt;
    }
    if (cells->empty()) {
      throw packing_error("the grains", "no cell with a volume", "at least four grains that are not coplanar");
    }
    t.clear();
    network net(connect(region, {grains.begin(), grains.end()}, std::move(*cells)));
    detail::name_boundaries(net);
    report.measured = measure(net);
    return tessellation{std::move(net), std::move(report)};
  }

  /// Returns the grains' places in the frame.
  static std::vector<vec3<double>> insert_grains(regular& t, std::span<const sphere<double>> grains,
                                                 const domain& region, const detail::topology_frame& frame,
                                                 double padding, tessellation_report& report) {
    using point = cgal_point;
    std::vector<std::pair<point, detail::cgal_vertex>> sites;
    std::vector<vec3<double>> where;
    sites.reserve(grains.size());
    where.reserve(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const vec3<double> p = frame(grains[i].centre);
      const double r = grains[i].radius / frame.quantum;
      sites.emplace_back(point({p.x, p.y, p.z}, r * r), detail::cgal_vertex{vertex(grain_id(i)), {}});
      where.push_back(p);
    }
    if (region.any_periodic()) {
      const vec3<double> lo = frame(region.bounds.lo);
      std::array<int, 3> layers{};
      for (std::size_t k = 0; k < 3; ++k) {
        layers[k] = region.is_periodic(k) ? static_cast<int>(std::ceil(padding / frame.period[k])) : 0;
      }
      for (int x = -layers[0]; x <= layers[0]; ++x) {
        for (int y = -layers[1]; y <= layers[1]; ++y) {
          for (int z = -layers[2]; z <= layers[2]; ++z) {
            if (x == 0 && y == 0 && z == 0) {
              continue;
            }
            const vec3<double> move{x * frame.period.x, y * frame.period.y, z * frame.period.z};
            const image at{static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z)};
            for (std::size_t i = 0; i < grains.size(); ++i) {
              const vec3<double> p = where[i] + move;
              bool near = true;
              for (std::size_t k = 0; k < 3; ++k) {
                near = near && (!region.is_periodic(k) ||
                                (p[k] >= lo[k] - padding && p[k] <= lo[k] + frame.period[k] + padding));
              }
              if (near) {
                const double r = grains[i].radius / frame.quantum;
                sites.emplace_back(point({p.x, p.y, p.z}, r * r), detail::cgal_vertex{vertex(grain_id(i)), at});
                ++report.ghosts;
              }
            }
          }
        }
      }
    }
    t.insert(sites.begin(), sites.end());
    return where;
  }

  void insert_walls(regular& t, const domain& region, const detail::topology_frame& frame) const {
    const vec3<double> lo = frame(region.bounds.lo);
    const vec3<double> hi = frame(region.bounds.hi);
    const double reach = options_.wall_device * frame.extent;
    for (const face f : all_faces) {
      if (!region.is_wall(f)) {
        continue;
      }
      vec3<double> c;
      for (std::size_t k = 0; k < 3; ++k) {
        const bool closed = region.at(static_cast<face>(2 * k)) != boundary::open;
        c[k] = closed ? 0.5 * (lo[k] + hi[k]) : 0.5 * frame.extent;
      }
      const double at = is_max(f) ? hi[axis_of(f)] : lo[axis_of(f)];
      c[axis_of(f)] = is_max(f) ? at + reach : at - reach;
      const double r = std::abs(c[axis_of(f)] - at);
      const auto v = t.insert(cgal_point({c.x, c.y, c.z}, r * r));
      v->info() = detail::cgal_vertex{vertex(f), {}};
    }
  }

  static void note_hidden(const regular& t, const std::vector<vec3<double>>& where, tessellation_report& report) {
    std::vector<bool> seen(where.size(), false);
    for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v) {
      if (!v->info().name.is_wall()) {
        seen[v->info().name.grain().index()] = true;
      }
    }
    std::map<std::array<double, 3>, std::size_t> twins;
    const auto key = [&](std::size_t i) { return std::array<double, 3>{where[i].x, where[i].y, where[i].z}; };
    for (std::size_t i = 0; i < where.size(); ++i) {
      if (!seen[i]) {
        report.hidden.push_back({grain_id(i), {}});
        twins.emplace(key(i), where.size());
      }
    }
    if (report.hidden.empty()) {
      return;
    }
    for (std::size_t i = 0; i < where.size(); ++i) {
      if (const auto twin = twins.find(key(i)); seen[i] && twin != twins.end()) {
        twin->second = i;
      }
    }
    for (auto& h : report.hidden) {
      const std::size_t twin = twins.at(key(h.grain.index()));
      h.twin = twin < where.size() ? grain_id(twin) : grain_id{};
    }
  }

  [[nodiscard]] static std::array<detail::cgal_vertex, 4> sites_of(const regular::Cell_handle c) {
    return {c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()};
  }

  /// A cell is a pore when it has a grain and no two opposite walls: between those it has no volume.
  [[nodiscard]] static bool is_pore(const regular& t, const regular::Cell_handle c) {
    if (t.is_infinite(c)) {
      return false;
    }
    unsigned walls = 0;
    bool grain = false;
    for (int k = 0; k < 4; ++k) {
      const vertex v = c->vertex(k)->info().name;
      if (v.is_wall()) {
        walls |= 1U << static_cast<unsigned>(v.wall());
      } else {
        grain = true;
      }
    }
    return grain && (walls & (walls >> 1U) & 0x15U) == 0;
  }

  [[nodiscard]] static cell named(const std::array<detail::cgal_vertex, 4>& sites) {
    cell out;
    for (std::size_t k = 0; k < 4; ++k) {
      out.vertices[k] = sites[k].name;
      out.images[k] = sites[k].name.is_wall() ? image{} : sites[k].at;
    }
    return out;
  }

  /// All pores; other cells are marked as outside.
  [[nodiscard]] static std::vector<regular::Cell_handle> pores(const regular& t) {
    std::vector<regular::Cell_handle> handles;
    handles.reserve(t.number_of_cells());
    for (auto c = t.all_cells_begin(); c != t.all_cells_end(); ++c) {
      c->info() = cell::outside;
      if (is_pore(t, c)) {
        handles.push_back(c);
      }
    }
    return handles;
  }

  /// One pore of each class of translates; other cells are marked as outside.
  [[nodiscard]] static std::vector<regular::Cell_handle> unrepeated_pores(const regular& t) {
    std::vector<regular::Cell_handle> handles = pores(t);
    std::erase_if(handles, [](const regular::Cell_handle c) {
      const auto sites = sites_of(c);
      return !detail::in_translate(detail::canonical(sites), sites);
    });
    return handles;
  }

  /// Orders pores along a space-filling curve through the grains and numbers them: neighbours in space lie near each
  /// other in memory, in whatever order the grains came.
  static void number_along_curve(std::vector<regular::Cell_handle>& handles, const std::vector<vec3<double>>& where) {
    std::vector<std::pair<detail::cgal_kernel::Point_3, std::uint32_t>> stops;
    stops.reserve(where.size());
    for (std::size_t i = 0; i < where.size(); ++i) {
      stops.emplace_back(detail::cgal_kernel::Point_3(where[i].x, where[i].y, where[i].z),
                         static_cast<std::uint32_t>(i));
    }
    using point_of = CGAL::First_of_pair_property_map<std::pair<detail::cgal_kernel::Point_3, std::uint32_t>>;
    CGAL::hilbert_sort(stops.begin(), stops.end(),
                       CGAL::Spatial_sort_traits_adapter_3<detail::cgal_kernel, point_of>());
    std::vector<std::uint32_t> rank(where.size());
    for (std::size_t i = 0; i < stops.size(); ++i) {
      rank[stops[i].second] = static_cast<std::uint32_t>(i);
    }
    const auto first_stop = [&](const regular::Cell_handle c) {
      std::uint32_t first = cell::outside;
      for (int k = 0; k < 4; ++k) {
        const vertex v = c->vertex(k)->info().name;
        first = v.is_wall() ? first : std::min(first, rank[v.grain().index()]);
      }
      return first;
    };
    std::vector<std::uint32_t> keys;
    keys.reserve(handles.size());
    std::vector<std::size_t> begin(where.size() + 1, 0);
    for (const auto c : handles) {
      keys.push_back(first_stop(c));
      ++begin[keys.back() + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<regular::Cell_handle> sorted(handles.size());
    for (std::size_t i = 0; i < handles.size(); ++i) {
      sorted[begin[keys[i]]++] = handles[i];
    }
    handles = std::move(sorted);
    for (std::size_t i = 0; i < handles.size(); ++i) {
      handles[i]->info() = static_cast<std::uint32_t>(i);
    }
  }

  [[nodiscard]] static std::optional<std::vector<cell>> bounded_cells(
      const std::vector<regular::Cell_handle>& handles) {
    std::vector<cell> cells;
    cells.reserve(handles.size());
    for (const auto c : handles) {
      cells.push_back(named(sites_of(c)));
      for (int k = 0; k < 4; ++k) {
        cells.back().neighbours[static_cast<std::size_t>(k)] = c->neighbor(k)->info();
      }
    }
    return cells;
  }

  /// The pores' cells; empty when the ghost layers were too thin for one of them.
  [[nodiscard]] static std::optional<std::vector<cell>> periodic_cells(
      const regular& t, const std::vector<regular::Cell_handle>& handles) {
    std::map<detail::canonical_cell, std::uint32_t> rim;
    for (const auto c : handles) {
      for (int k = 0; k < 4; ++k) {
        if (c->neighbor(k)->info() == cell::outside) {
          rim.emplace(detail::canonical(sites_of(c)), c->info());
          break;
        }
      }
    }
    std::vector<cell> cells;
    cells.reserve(handles.size());
    for (const auto c : handles) {
      cells.push_back(named(sites_of(c)));
      for (int k = 0; k < 4; ++k) {
        const auto beyond = c->neighbor(k);
        std::uint32_t index = beyond->info();
        if (index == cell::outside && is_pore(t, beyond)) {
          const auto found = rim.find(detail::canonical(sites_of(beyond)));
          if (found == rim.end()) {
            return std::nullopt;
          }
          index = found->second;
        }
        cells.back().neighbours[static_cast<std::size_t>(k)] = index;
      }
    }
    return cells;
  }

  using cgal_point = regular::Weighted_point;

  options options_;
};
static_assert(tessellation_engine<cgal_triangulation>);

}  // namespace tetrapore::inline TETRAPORE_ABI
