// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/field.hpp"
#include "tetrapore/network/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// \file
/// From one triangulation of the grains to the next: what of each old pore lies in each new one.

namespace tetrapore::inline TETRAPORE_ABI {

/// How the pores of one epoch pass on to those of the next, by the void volume that an old and a new cell have in
/// common, both at the same place of the grains.
class transfer {
 public:
  /// One pore and what it counts for.
  struct share {
    pore_id pore;
    double weight;
  };
  /// Shares per pore; of every pore at least one, their weights sum to 1.
  using table = std::vector<std::vector<share>>;

  /// \param given  per old pore: the new pores that take over what it holds
  /// \param read   per new pore: the old pores whose level it takes the mean of
  transfer(std::uint64_t from, std::uint64_t to, const table& given, const table& read)
      : from_(from), to_(to), given_(given), read_(read) {}

  [[nodiscard]] std::uint64_t from_epoch() const noexcept { return from_; }
  [[nodiscard]] std::uint64_t to_epoch() const noexcept { return to_; }
  [[nodiscard]] std::size_t old_pore_count() const noexcept { return given_.size(); }
  [[nodiscard]] std::size_t new_pore_count() const noexcept { return read_.size(); }
  /// The new pores that take over what an old one holds, with their shares of it.
  [[nodiscard]] std::span<const share> of(pore_id old) const noexcept { return given_[old]; }
  /// The old pores that a new one covers, with their shares of what it covers.
  [[nodiscard]] std::span<const share> covered_by(pore_id made) const noexcept { return read_[made]; }

 private:
  class rows {
   public:
    explicit rows(const table& per_pore) {
      offsets_.reserve(per_pore.size() + 1);
      offsets_.push_back(0);
      for (const auto& row : per_pore) {
        shares_.insert(shares_.end(), row.begin(), row.end());
        offsets_.push_back(shares_.size());
      }
    }
    [[nodiscard]] std::size_t size() const noexcept { return offsets_.size() - 1; }
    [[nodiscard]] std::span<const share> operator[](pore_id p) const noexcept {
      return {shares_.data() + offsets_[p.index()], offsets_[p.index() + 1] - offsets_[p.index()]};
    }

   private:
    std::vector<std::size_t> offsets_;
    std::vector<share> shares_;
  };

  std::uint64_t from_;
  std::uint64_t to_;
  rows given_;
  rows read_;
};

/// Takes a field to the epoch of the rebuilt network. An extensive quantity keeps its sum to rounding, and where it
/// filled a share of every old void it fills no more than that share of any new one; an intensive quantity is averaged
/// over the void, and a constant stays what it was.
template <quantity Q>
void carry(const transfer& way, field<Q>& f) {
  TETRAPORE_EXPECTS(f.epoch() == way.from_epoch() && f.size() == way.old_pore_count(),
                    "a field is carried from the epoch it belongs to");
  std::vector<double> values(way.new_pore_count(), 0.0);
  if constexpr (Q == quantity::extensive) {
    for (std::size_t i = 0; i < way.old_pore_count(); ++i) {
      for (const auto& s : way.of(pore_id(i))) {
        values[s.pore.index()] += s.weight * f[pore_id(i)];
      }
    }
  } else {
    for (std::size_t j = 0; j < way.new_pore_count(); ++j) {
      for (const auto& s : way.covered_by(pore_id(j))) {
        values[j] += s.weight * f[s.pore];
      }
    }
  }
  f = field<Q>(std::move(values), way.to_epoch());
}

namespace detail {

struct site_key {
  std::array<std::pair<vertex, image>, 4> sites;
  [[nodiscard]] friend auto operator<=>(const site_key&, const site_key&) = default;
};

/// The vertices of a pore in ascending order, at images relative to the first.
[[nodiscard]] inline site_key key_of(const network& net, pore_id p) {
  site_key key;
  for (std::size_t k = 0; k < 4; ++k) {
    const vertex v = net.vertices(p)[k];
    key.sites[k] = {v, v.is_wall() ? image{} : net.image_of(p, k)};
  }
  std::sort(key.sites.begin(), key.sites.end(), [](const auto& a, const auto& b) {
    return a.first.is_wall() != b.first.is_wall() ? b.first.is_wall() : a < b;
  });
  const image base = key.sites[0].second;
  for (auto& [v, at] : key.sites) {
    at = v.is_wall() ? image{} : at - base;
  }
  return key;
}

struct bounds3 {
  vec3<double> lo;
  vec3<double> hi;
};

/// Box around the corners of a cell.
[[nodiscard]] inline bounds3 bounds_of(const pore_body<double>& body) noexcept {
  constexpr double far = std::numeric_limits<double>::infinity();
  bounds3 b{{far, far, far}, {-far, -far, -far}};
  const auto include = [&](const vec3<double>& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      b.lo[k] = std::min(b.lo[k], p[k]);
      b.hi[k] = std::max(b.hi[k], p[k]);
    }
  };
  for (std::size_t g = 0; g < body.grain_count; ++g) {
    const vec3<double>& c = body.grains[g].centre;
    include(c);
    vec3<double> corner = c;
    for (std::size_t w = 0; w < body.wall_count(); ++w) {
      include(body.walls[w].project(c));
      corner = body.walls[w].project(corner);
    }
    include(corner);
  }
  return b;
}

/// A cell as it was handed over, turned to positive order if following its grains has turned it inside out.
[[nodiscard]] inline pore_body<double> upright(pore_body<double> body) noexcept {
  if (total_volume(body) < 0.0) {
    if (body.grain_count >= 2) {
      std::swap(body.grains[0], body.grains[1]);
    } else {
      std::swap(body.walls[0], body.walls[1]);
    }
  }
  return body;
}

/// Cells sorted into a uniform grid by their boxes; on periodic axes the grid closes on itself.
class cell_grid {
 public:
  cell_grid(const domain& region, const bounds3& around, std::size_t cells) : region_(region), lo_(around.lo) {
    const vec3<double> size = around.hi - around.lo;
    const double spacing = std::cbrt(size.x * size.y * size.z / static_cast<double>(std::max<std::size_t>(cells, 1)));
    for (std::size_t k = 0; k < 3; ++k) {
      counts_[k] = std::clamp(static_cast<long>(size[k] / (2.0 * spacing)), 1L, 256L);
      step_[k] = size[k] / static_cast<double>(counts_[k]);
    }
    buckets_.resize(static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]));
  }

  template <class F>
  void for_buckets(const bounds3& b, const F& f) const {
    std::array<long, 3> first{};
    std::array<long, 3> last{};
    for (std::size_t k = 0; k < 3; ++k) {
      first[k] = static_cast<long>(std::floor((b.lo[k] - lo_[k]) / step_[k]));
      last[k] = static_cast<long>(std::floor((b.hi[k] - lo_[k]) / step_[k]));
      if (region_.is_periodic(k)) {
        last[k] = std::min(last[k], first[k] + counts_[k] - 1);
      } else {
        first[k] = std::clamp(first[k], 0L, counts_[k] - 1);
        last[k] = std::clamp(last[k], 0L, counts_[k] - 1);
      }
    }
    for (long x = first[0]; x <= last[0]; ++x) {
      for (long y = first[1]; y <= last[1]; ++y) {
        for (long z = first[2]; z <= last[2]; ++z) {
          f(static_cast<std::size_t>((wrap(x, 0) * counts_[1] + wrap(y, 1)) * counts_[2] + wrap(z, 2)));
        }
      }
    }
  }

  void insert(std::uint32_t item, const bounds3& b) {
    for_buckets(b, [&](std::size_t bucket) { buckets_[bucket].push_back(item); });
  }
  void find(const bounds3& b, std::vector<std::uint32_t>& out) const {
    out.clear();
    for_buckets(b,
                [&](std::size_t bucket) { out.insert(out.end(), buckets_[bucket].begin(), buckets_[bucket].end()); });
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }

 private:
  [[nodiscard]] long wrap(long i, std::size_t axis) const noexcept {
    return ((i % counts_[axis]) + counts_[axis]) % counts_[axis];
  }

  const domain& region_;
  vec3<double> lo_;
  vec3<double> step_;
  std::array<long, 3> counts_{};
  std::vector<std::vector<std::uint32_t>> buckets_;
};

/// Calls f(shift) for the periodic shifts of b that may meet a.
template <class F>
void for_meeting_images(const domain& region, const bounds3& a, const bounds3& b, const F& f) {
  std::array<int, 3> lo{};
  std::array<int, 3> hi{};
  const vec3<double> size = region.bounds.size();
  for (std::size_t k = 0; k < 3; ++k) {
    if (region.is_periodic(k)) {
      lo[k] = static_cast<int>(std::ceil((a.lo[k] - b.hi[k]) / size[k]));
      hi[k] = static_cast<int>(std::floor((a.hi[k] - b.lo[k]) / size[k]));
    } else if (b.hi[k] < a.lo[k] || b.lo[k] > a.hi[k]) {
      return;
    }
  }
  for (int x = lo[0]; x <= hi[0]; ++x) {
    for (int y = lo[1]; y <= hi[1]; ++y) {
      for (int z = lo[2]; z <= hi[2]; ++z) {
        f(region.shift({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z)}));
      }
    }
  }
}

inline void move_grains(pore_body<double>& body, const vec3<double>& shift) noexcept {
  for (std::size_t g = 0; g < body.grain_count; ++g) {
    body.grains[g].centre += shift;
  }
}

/// The cells of a network that the other does not have, as bodies with their boxes and intruders.
struct changed_cells {
  std::vector<pore_id> pores;
  std::vector<pore_body<double>> bodies;
  std::vector<bounds3> boxes;
  intruder_list intruders;

  changed_cells(const network& net, std::vector<pore_id> which)
      : pores(std::move(which)), intruders(find_intruders(net)) {
    for (const pore_id p : pores) {
      bodies.push_back(upright(pore_body_at(net, p)));
      boxes.push_back(bounds_of(bodies.back()));
    }
  }
};

/// Size of a cell: the longest side of its box.
[[nodiscard]] inline double size_of(const bounds3& b) noexcept {
  const vec3<double> s = b.hi - b.lo;
  return std::max({s.x, s.y, s.z});
}

/// The void volumes [m³] that a changed old cell has in common with the changed new ones.
[[nodiscard]] inline std::vector<transfer::share> common_voids(const domain& region, const changed_cells& before,
                                                               std::size_t i, const changed_cells& after,
                                                               std::span<const std::uint32_t> candidates) {
  std::vector<transfer::share> row;
  std::vector<sphere<double>> balls;
  for (const std::uint32_t j : candidates) {
    for_meeting_images(region, before.boxes[i], after.boxes[j], [&](const vec3<double>& shift) {
      pore_body<double> moved = after.bodies[j];
      move_grains(moved, shift);
      balls.clear();
      const auto add = [&](sphere<double> s, const vec3<double>& by) {
        s.centre += by;
        // The same ball seen from both cells may differ by the rounding of the shifts that were added to it.
        const double rounding = 8 * epsilon<double> * (std::sqrt(norm2(s.centre)) + norm(region.bounds.size()));
        for (const auto& known : balls) {
          if (known.radius == s.radius && norm2(known.centre - s.centre) <= rounding * rounding) {
            return;
          }
        }
        balls.push_back(s);
      };
      for (std::size_t g = 0; g < before.bodies[i].grain_count; ++g) {
        add(before.bodies[i].grains[g], {});
      }
      for (std::size_t g = 0; g < moved.grain_count; ++g) {
        add(moved.grains[g], {});
      }
      for (const auto& s : before.intruders.of(before.pores[i])) {
        add(s, {});
      }
      for (const auto& s : after.intruders.of(after.pores[j])) {
        add(s, shift);
      }
      const auto common = void_overlap(before.bodies[i], moved, std::span<const sphere<double>>(balls));
      if (!common.ok()) {
        throw packing_error("pore " + std::to_string(before.pores[i].index()) + " before and pore " +
                                std::to_string(after.pores[j].index()) + " after a rebuild",
                            describe(common.reason), "cells that a few overlapping grains cut");
      }
      // What is left of a void that grains fill is the rounding of void_overlap, with either sign.
      const double size = std::min(size_of(before.boxes[i]), size_of(after.boxes[j]));
      if (common.value > 8 * epsilon<double> * size * size * size) {
        row.push_back({after.pores[j], common.value});
      }
    });
  }
  return row;
}

/// Makes the weights of every pore sum to 1. A cell without any void in common (flat, or filled by grains) does what
/// its neighbour does.
inline void complete(const network& net, transfer::table& shares, const char* when) {
  std::vector<pore_id> without;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    double sum = 0.0;
    for (const auto& s : shares[i]) {
      sum += s.weight;
    }
    for (auto& s : shares[i]) {
      s.weight /= sum;
    }
    if (shares[i].empty()) {
      without.emplace_back(i);
    }
  }
  const pore_id lost = spread(net, std::move(without), [&](pore_id p, std::size_t slot) {
    shares[p.index()] = shares[net.across(p, net.throats(p)[slot]).index()];
  });
  if (lost.valid()) {
    throw packing_error("pore " + std::to_string(lost.index()) + when,
                        "a cell that has no void in common with the other network, nor have those connected to it",
                        "the same grains in the same region, with void between them");
  }
}

}  // namespace detail

/// The transfer between two networks of the same grains at the same place. Cells that both have are handed over whole;
/// the others by the void volume they have in common.
/// \par Domain  the same region; a cell that followed its grains until it turned inside out counts upright
[[nodiscard]] inline transfer overlap_transfer(const network& before, const network& after) {
  std::vector<std::pair<detail::site_key, std::uint32_t>> kept;
  kept.reserve(after.pore_count());
  for (std::size_t j = 0; j < after.pore_count(); ++j) {
    kept.emplace_back(detail::key_of(after, pore_id(j)), static_cast<std::uint32_t>(j));
  }
  std::sort(kept.begin(), kept.end());
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> same(before.pore_count(), none);
  std::vector<bool> found(after.pore_count(), false);
  std::vector<pore_id> gone;
  for (std::size_t i = 0; i < before.pore_count(); ++i) {
    const detail::site_key key = detail::key_of(before, pore_id(i));
    auto at = std::lower_bound(kept.begin(), kept.end(), std::pair{key, std::uint32_t{0}});
    while (at != kept.end() && at->first == key && found[at->second]) {
      ++at;  // flat cells on each other may have the same vertices
    }
    if (at != kept.end() && at->first == key) {
      same[i] = at->second;
      found[at->second] = true;
    } else {
      gone.emplace_back(i);
    }
  }
  std::vector<pore_id> fresh;
  for (std::size_t j = 0; j < after.pore_count(); ++j) {
    if (!found[j]) {
      fresh.emplace_back(j);
    }
  }

  transfer::table given(before.pore_count());
  transfer::table read(after.pore_count());
  for (std::size_t i = 0; i < before.pore_count(); ++i) {
    if (same[i] != none) {
      given[i] = {{pore_id(same[i]), 1.0}};
      read[same[i]] = {{pore_id(i), 1.0}};
    }
  }
  if (!gone.empty() && !fresh.empty()) {
    const detail::changed_cells old_cells(before, std::move(gone));
    const detail::changed_cells new_cells(after, std::move(fresh));
    detail::bounds3 around = new_cells.boxes.front();
    for (const auto& b : new_cells.boxes) {
      for (std::size_t k = 0; k < 3; ++k) {
        around.lo[k] = std::min(around.lo[k], b.lo[k]);
        around.hi[k] = std::max(around.hi[k], b.hi[k]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (after.region().is_periodic(k)) {
        around.lo[k] = after.region().bounds.lo[k];
        around.hi[k] = after.region().bounds.hi[k];
      }
    }
    detail::cell_grid grid(after.region(), around, new_cells.pores.size());
    for (std::size_t j = 0; j < new_cells.pores.size(); ++j) {
      grid.insert(static_cast<std::uint32_t>(j), new_cells.boxes[j]);
    }
    std::vector<std::uint32_t> candidates;
    for (std::size_t i = 0; i < old_cells.pores.size(); ++i) {
      grid.find(old_cells.boxes[i], candidates);
      const pore_id old = old_cells.pores[i];
      given[old.index()] = detail::common_voids(after.region(), old_cells, i, new_cells, candidates);
      for (const auto& s : given[old.index()]) {
        read[s.pore.index()].push_back({old, s.weight});
      }
    }
  }

  detail::complete(before, given, " before a rebuild");
  detail::complete(after, read, " after a rebuild");
  return {before.epoch(), after.epoch(), given, read};
}

/// Triangulates anew: the network follows the grains, then becomes that of their new triangulation, one epoch later.
/// \param engine  makes networks, see tessellation_engine
/// \return how to carry the fields of the old epoch
template <class Engine, class Grains>
[[nodiscard]] transfer rebuild(network& net, const Engine& engine, const Grains& grains) {
  network before = net;
  follow(before, grains);
  auto made = engine(before.grains(), before.region());
  network after(made.net.arrays(), net.epoch() + 1);
  transfer way = overlap_transfer(before, after);
  net = std::move(after);
  return way;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
