// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/executor.hpp"
#include "tetrapore/network/gather.hpp"
#include "tetrapore/simplex/pore_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Volumes and power centres of a network's pores, from its snapshot of the grains.

namespace tetrapore::inline TETRAPORE_ABI {

/// The balls that reach into cells they are no vertex of.
class intruder_list {
 public:
  intruder_list() = default;

  /// The intruders of a pore, at the image that lies in it.
  [[nodiscard]] std::span<const sphere<double>> of(pore_id p) const noexcept {
    const auto range = std::equal_range(pores_.begin(), pores_.end(), p);
    const auto first = static_cast<std::size_t>(range.first - pores_.begin());
    return {balls_.data() + first, static_cast<std::size_t>(range.second - range.first)};
  }
  [[nodiscard]] std::size_t size() const noexcept { return pores_.size(); }
  /// The pores that have intruders, ascending, one entry per intruder.
  [[nodiscard]] std::span<const pore_id> pores() const noexcept { return pores_; }

  void add(pore_id p, const sphere<double>& ball) {
    pores_.push_back(p);
    balls_.push_back(ball);
  }
  /// Sorts by pore; to be called once after the last `add`.
  void close() {
    std::vector<std::size_t> order(pores_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = i;
    }
    std::sort(order.begin(), order.end(),
              [this](std::size_t a, std::size_t b) { return pores_[a] != pores_[b] ? pores_[a] < pores_[b] : a < b; });
    std::vector<pore_id> pores(order.size());
    std::vector<sphere<double>> balls(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      pores[i] = pores_[order[i]];
      balls[i] = balls_[order[i]];
    }
    pores_ = std::move(pores);
    balls_ = std::move(balls);
  }

 private:
  std::vector<pore_id> pores_;
  std::vector<sphere<double>> balls_;
};

/// What `measure` met.
struct measure_report {
  std::size_t flat_pores = 0;    ///< cells too flat for a power centre of their own: they took a neighbour's
  std::size_t kernel_pores = 0;  ///< cells in which a ball overlaps, reaches through a facet or a wall, or intrudes
  std::size_t intrusions = 0;    ///< pairs of a cell and a ball that is not one of its vertices
};

namespace detail {

/// Follows grain k of pore p through the facets that it reaches, and notes each cell it enters.
inline void follow_ball(const network& net, pore_id p, std::size_t k, intruder_list& out) {
  struct visit {
    pore_id pore;
    std::size_t entered;  ///< slot of the facet it came through
    image offset;         ///< image of that pore relative to the first
  };
  const vertex name = net.vertices(p)[k];
  const image at = net.image_of(p, k);
  const sphere<double> ball = net.grain_sphere(p, k);
  std::vector<visit> front;
  std::vector<std::pair<pore_id, image>> seen;
  const auto cross_facet = [&](pore_id from, std::size_t slot, image offset) {
    const throat_id t = net.throats(from)[slot];
    if (!t.valid() || net.is_boundary(t)) {
      return;
    }
    const bool first = net.pores(t)[0] == from && net.slot(t, 0) == slot;
    const pore_id to = net.pores(t)[first ? 1 : 0];
    const image there = offset + (first ? net.shift(t) : image{} - net.shift(t));
    for (std::size_t j = 0; j < 4; ++j) {
      if (net.vertices(to)[j] == name && net.image_of(to, j) + there == at) {
        return;  // a cell of its own
      }
    }
    if (std::find(seen.begin(), seen.end(), std::pair{to, there}) == seen.end()) {
      seen.emplace_back(to, there);
      front.push_back({to, net.slot(t, first ? 1 : 0), there});
    }
  };
  cross_facet(p, k, image{});
  while (!front.empty()) {
    const visit v = front.back();
    front.pop_back();
    sphere<double> here = ball;
    here.centre -= net.region().shift(v.offset);
    out.add(v.pore, here);
    const pore_body<double> body = pore_body_at(net, v.pore);
    for (std::size_t slot = 0; slot < 4; ++slot) {
      if (slot != v.entered && reaches(here, body, slot)) {
        cross_facet(v.pore, slot, v.offset);
      }
    }
  }
}

/// Pores that lack something take it from a neighbour that has it: those beside such a neighbour first, then those
/// beside them, each through the first throat that offers it.
/// \param take  called as take(p, slot), slot of the throat that pore p takes through
/// \return the first of the pores that no throat connects with one that has it; invalid when there is none
template <class Take>
[[nodiscard]] pore_id spread(const network& net, std::vector<pore_id> lacking, const Take& take) {
  std::vector<bool> lacks(net.pore_count(), false);
  for (const pore_id p : lacking) {
    lacks[p.index()] = true;
  }
  while (!lacking.empty()) {
    std::vector<std::pair<pore_id, std::size_t>> found;
    std::vector<pore_id> rest;
    for (const pore_id p : lacking) {
      const auto& throats = net.throats(p);
      const auto offer = std::find_if(throats.begin(), throats.end(), [&](throat_id t) {
        return t.valid() && !net.is_boundary(t) && !lacks[net.across(p, t).index()];
      });
      if (offer != throats.end()) {
        found.emplace_back(p, static_cast<std::size_t>(offer - throats.begin()));
      } else {
        rest.push_back(p);
      }
    }
    if (found.empty()) {
      return rest.front();
    }
    for (const auto& [p, slot] : found) {
      take(p, slot);
      lacks[p.index()] = false;
    }
    lacking = std::move(rest);
  }
  return {};
}

/// Gives cells without a power centre of their own that of the nearest neighbour that has one.
inline void spread_centres(network& net, std::vector<pore_id> flat) {
  const pore_id lost = spread(net, std::move(flat), [&net](pore_id p, std::size_t slot) {
    const throat_id t = net.throats(p)[slot];
    const bool first = net.pores(t)[0] == p;
    const vec3<double> shift = net.region().shift(net.shift(t));
    const vec3<double>& centre = net.power_centre(net.across(p, t));
    net.mutable_arrays().power_centres[p.index()] = first ? centre + shift : centre - shift;
  });
  if (lost.valid()) {
    throw packing_error("pore " + std::to_string(lost.index()), "a flat cell with flat neighbours only",
                        "grains that are not coplanar");
  }
}

/// Volume and centre of each pore; the void volume where the sectors are exact. Returns the pores left to the kernel.
template <executor E>
[[nodiscard]] std::vector<pore_id> measure_plain(network& net, const E& cores, std::vector<pore_id>& flat) {
  network_arrays& a = net.mutable_arrays();
  const std::size_t n = net.pore_count();
  a.volumes.resize(n);
  a.void_volumes.resize(n);
  a.power_centres.resize(n);
  enum : std::uint8_t { plain = 0, kernel = 1, without_centre = 2 };
  std::vector<std::uint8_t> kind(n);
  cores.blocks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const pore_body<double> body = pore_body_at(net, pore_id(i));
      std::uint8_t k = kernel;
      if (body.grain_count == 4) {
        const tetrahedron_frame<double> t(body);
        a.volumes[i] = t.determinant / 6.0;
        if (t.plain()) {
          a.void_volumes[i] = a.volumes[i] - t.sectors();
          k = plain;
        }
      } else {
        a.volumes[i] = total_volume(body);
      }
      const auto centre = power_centre(body);
      a.power_centres[i] = centre.value;
      kind[i] = static_cast<std::uint8_t>(k | (centre.ok() ? plain : without_centre));
    }
  });
  std::vector<pore_id> rest;
  for (std::size_t i = 0; i < n; ++i) {
    if ((kind[i] & kernel) != 0) {
      rest.emplace_back(i);
    }
    if ((kind[i] & without_centre) != 0) {
      flat.emplace_back(i);
    }
  }
  return rest;
}

}  // namespace detail

/// The balls that reach into cells they are no vertex of, found by walking from cell to cell.
[[nodiscard]] inline intruder_list find_intruders(const network& net, std::span<const pore_id> among) {
  intruder_list out;
  for (const pore_id p : among) {
    const pore_body<double> body = pore_body_at(net, p);
    for (std::size_t k = 0; k < body.grain_count; ++k) {
      if (pokes(body, k)) {
        detail::follow_ball(net, p, k, out);
      }
    }
  }
  out.close();
  return out;
}

/// The same, for all pores of a network.
[[nodiscard]] inline intruder_list find_intruders(const network& net) {
  std::vector<pore_id> all;
  all.reserve(net.pore_count());
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    all.emplace_back(i);
  }
  return find_intruders(net, all);
}

/// Computes volume, void volume and power centre of every pore from the network's snapshot. The void volume is exact:
/// the cell outside the union of all grains that reach into it, each pore computed alone.
/// \par Accuracy  Σ void + solid = region to 1e-12, also with overlapping and protruding grains
/// \throw packing_error  naming the pore, where so many grains overlap that the cell cannot be measured
template <executor E = serial>
measure_report measure(network& net, const E& cores = {}) {
  std::vector<pore_id> flat;
  std::vector<pore_id> rest = detail::measure_plain(net, cores, flat);
  measure_report report;
  report.flat_pores = flat.size();
  const intruder_list intruders = find_intruders(net, rest);
  report.intrusions = intruders.size();
  rest.insert(rest.end(), intruders.pores().begin(), intruders.pores().end());
  std::sort(rest.begin(), rest.end());
  rest.erase(std::unique(rest.begin(), rest.end()), rest.end());
  report.kernel_pores = rest.size();
  std::vector<geometry_status> reasons(rest.size());
  cores.blocks(rest.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = void_volume(pore_body_at(net, rest[i]), intruders.of(rest[i]));
      net.mutable_arrays().void_volumes[rest[i].index()] = v.value;
      reasons[i] = v.reason;
    }
  });
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (verdict_of(reasons[i]) != verdict::ok) {
      throw packing_error("pore " + std::to_string(rest[i].index()), describe(reasons[i]),
                          "a cell that a few overlapping grains cut");
    }
  }
  detail::spread_centres(net, std::move(flat));
  return report;
}

/// Makes the network follow its grains: a new snapshot, the same topology, volumes and centres computed again.
/// Ids and epoch stay.
/// \throw packing_error  when the number of grains differs
template <class Grains, executor E = serial>
measure_report follow(network& net, const Grains& grains, const E& cores = {}) {
  std::vector<sphere<double>> snapshot;
  snapshot.reserve(net.grain_count());
  for (const auto& g : grains) {
    snapshot.push_back(as_sphere(g));
  }
  if (snapshot.size() != net.grain_count()) {
    throw packing_error("the grains", std::to_string(snapshot.size()),
                        std::to_string(net.grain_count()) + ", those of the network");
  }
  net.mutable_arrays().grains = std::move(snapshot);
  return measure(net, cores);
}

}  // namespace tetrapore::inline TETRAPORE_ABI
