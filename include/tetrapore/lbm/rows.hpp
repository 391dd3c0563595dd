// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/sites.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

/// \file
/// Where nodes and what surrounds them lie in memory.
///
/// A cell is a node, or a place that some node's population leaves to without being one: in a wall, beyond a mirror,
/// beyond an end of the box. Cells of a row (z runs, or y where that makes fewer batches) lie side by side, so the
/// neighbours of side by side nodes do too, walls or none, and a step runs along rows without asking. What lies in a
/// cell that is no node belongs to one link: it is copied from and to where the link really leads.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Cells of a site_map, and its nodes in runs of neighbours.
/// \tparam Turned  populations lie in the slot against their direction (what leaves a node stays there to be pulled)
template <lattice L, bool Turned>
class row_layout {
 public:
  static constexpr std::size_t directions = L::directions;
  using places = std::array<std::int64_t, directions>;
  using offsets = std::array<std::int32_t, directions>;

  /// Nodes side by side, all fluid or all of one reservoir.
  struct run {
    std::int32_t cell;  ///< of the first node
    std::int32_t nodes;
    std::int32_t table;  ///< of the neighbours
    site what;
  };
  /// In direction k of a run's first node: where what leaves arrives, less the place of the node's slot 0; which cell
  /// it sees, less its own.
  struct neighbours {
    places to;
    offsets seen;
    std::array<std::uint8_t, directions> as;  ///< the direction as a face of the box turns it
    friend bool operator<(const neighbours& a, const neighbours& b) noexcept {
      return std::tie(a.to, a.seen, a.as) < std::tie(b.to, b.seen, b.as);
    }
  };
  /// What a node sends to a cell that is no node, and where it belongs.
  struct link {
    std::uint32_t cell;
    std::uint32_t gate;
  };
  /// A cell that shows the ψ of another.
  struct copy {
    std::int32_t to;
    std::int32_t from;
  };
  struct wall {
    std::int32_t cell;
    std::uint8_t tag;
  };
  struct image {
    std::int32_t cell;
    std::int32_t index;  ///< of the map's images
    int first_user;      ///< x of the first plane whose nodes see it
  };
  /// What of all lists belongs to nodes of one x.
  struct plane {
    std::size_t first_run, last_run;
    std::size_t first_link, last_link;
    std::size_t first_copy, last_copy;
  };
  /// The same of nodes of one row, and its cells.
  struct row_range {
    std::size_t first_run, last_run;
    std::size_t first_link, last_link;
    std::int32_t first_cell, last_cell;
  };

  row_layout() = default;
  /// \param lanes  so many cells beyond a run may be read and written as they were
  /// \param aligned  the first nodes of rows stand at multiples of this
  row_layout(const site_map<L>& map, std::size_t lanes, std::size_t per_cache_line, std::size_t aligned)
      : map_(&map), lanes_(lanes), aligned_(aligned) {
    lay_along(2);
    if (const std::size_t batches = batches_of_runs(); map.box().size[1] > 1) {
      lay_along(1);
      if (batches_of_runs() >= batches && map.box().size[2] > 1) {
        lay_along(2);
      }
    }
    mark_cells();
    number_cells(per_cache_line);
    for (std::size_t x = 0; x < map.plane_count(); ++x) {
      add_plane(x);
    }
    sort_copies();
    std::stable_sort(images_.begin(), images_.end(),
                     [](const image& a, const image& b) { return a.first_user < b.first_user; });
    at_ = {};
    content_ = {};
    known_ = {};
    pending_ = {};
    map_ = nullptr;
  }

  [[nodiscard]] std::int32_t cell(std::size_t node) const noexcept { return cells_[node]; }
  /// Cells, an idle one behind all others included.
  [[nodiscard]] std::size_t cells() const noexcept { return count_ + 1; }
  [[nodiscard]] std::int32_t idle() const noexcept { return static_cast<std::int32_t>(count_); }
  /// Numbers between the slots of a cell.
  [[nodiscard]] std::size_t stride() const noexcept { return stride_; }
  [[nodiscard]] std::size_t place(std::int32_t cell, std::size_t slot) const noexcept {
    return slot * stride_ + static_cast<std::size_t>(cell);
  }
  /// Where what leaves a node along a link of the map is stored for its receiver.
  [[nodiscard]] std::size_t gate(const typename site_map<L>::link& l) const noexcept {
    return place(cells_[static_cast<std::size_t>(l.to)], slot(l.as));
  }
  /// Nodes of the longest run.
  [[nodiscard]] std::size_t longest() const noexcept { return longest_; }
  [[nodiscard]] const std::vector<plane>& planes() const noexcept { return planes_; }
  /// Rows of one x lie behind each other.
  [[nodiscard]] const std::vector<row_range>& rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t rows_of_plane() const noexcept { return rows_.size() / planes_.size(); }
  /// The axis that separates rows of one x.
  [[nodiscard]] std::size_t across() const noexcept { return across_; }
  [[nodiscard]] const std::vector<run>& runs() const noexcept { return runs_; }
  [[nodiscard]] const std::vector<neighbours>& tables() const noexcept { return tables_; }
  [[nodiscard]] const std::vector<link>& links() const noexcept { return links_; }
  [[nodiscard]] const std::vector<copy>& copies() const noexcept { return copies_; }
  [[nodiscard]] const std::vector<wall>& walls() const noexcept { return walls_; }
  [[nodiscard]] const std::vector<image>& images() const noexcept { return images_; }
  /// Where a row of ψ of walls of tag 0 begins, as long as the longest run, for faces of the box that are walls.
  [[nodiscard]] std::int32_t face() const noexcept { return idle() + 1; }

 private:
  static constexpr std::int32_t none = site_map<L>::none;

  [[nodiscard]] static constexpr std::size_t slot(int as) noexcept {
    return static_cast<std::size_t>(Turned ? opposite(as) : as);
  }

  [[nodiscard]] std::size_t row_of(const std::array<int, 3>& p) const noexcept {
    return static_cast<std::size_t>(p[0]) * static_cast<std::size_t>(map_->box().size[across_]) +
           static_cast<std::size_t>(p[across_]);
  }
  /// The cell at a place of a row; the row's own ends are at −1 and its length.
  [[nodiscard]] std::int32_t& at(std::size_t row, int a) noexcept {
    return at_[row * length_ + static_cast<std::size_t>(a + 1)];
  }

  /// The row that direction k leads to, and the direction as the faces of the box turn it.
  struct beyond {
    bool wall;  ///< a face that is a wall
    std::size_t row;
    int as;
  };
  [[nodiscard]] beyond look(std::array<int, 3> p, int k) const noexcept {
    const lattice_box& box = map_->box();
    auto c = L::velocity[static_cast<std::size_t>(k)];
    for (const std::size_t a : {std::size_t{0}, across_}) {
      p[a] += c[a];
      const bool below = p[a] < 0;
      if (!below && p[a] < box.size[a]) {
        continue;
      }
      switch (below ? box.low[a] : box.high[a]) {
        case face_kind::periodic: p[a] = below ? box.size[a] - 1 : 0; break;
        case face_kind::mirror:
          p[a] -= c[a];
          c[a] = -c[a];
          break;
        case face_kind::wall: return {true, 0, opposite(k)};
      }
    }
    return {false, row_of(p), direction_of<L>(c[0], c[1], c[2])};
  }
  [[nodiscard]] int step_along(int k) const noexcept { return L::velocity[static_cast<std::size_t>(k)][along_]; }

  void mark_cells() {
    const auto rows =
        static_cast<std::size_t>(map_->box().size[0]) * static_cast<std::size_t>(map_->box().size[across_]);
    at_.assign(rows * length_, none);
    for (std::size_t n = 0; n < map_->size(); ++n) {
      const auto& p = map_->place(n);
      for (int k = 0; k < static_cast<int>(directions); ++k) {
        const beyond b = look(p, k);
        if (!b.wall) {
          at(b.row, p[along_] + step_along(k)) = 0;
        }
      }
    }
  }

  /// Lines of 64 bytes between the slots of a cell are 27 + a multiple of 64: no two slots share a set of the cache.
  void number_cells(std::size_t per_line) {
    for (std::size_t n = 0; n < map_->size(); ++n) {
      const auto& p = map_->place(n);
      at(row_of(p), p[along_]) = 1;
    }
    std::size_t next = 0;
    for (std::size_t k = 0; k < at_.size(); ++k) {
      if (at_[k] != none) {
        if (k % length_ == 0 || at_[k - 1] == none) {
          std::size_t before = 0;  // cells before the first node
          while (at_[k + before] == 0 && (k + before + 1) % length_ != 0) {
            ++before;
          }
          next += (aligned_ - (next + before) % aligned_) % aligned_;
        }
        at_[k] = static_cast<std::int32_t>(next++);
      }
    }
    count_ = next;
    const std::size_t lines = (next + 2 * lanes_ + 2) / per_line + 1;
    stride_ = (lines + (27 + 64 - lines % 64) % 64) * per_line;
    if (stride_ * directions > std::numeric_limits<std::uint32_t>::max()) {
      throw parameter_error("lattice", "more cells than an index holds", "fewer than 2^32 populations");
    }
    cells_.resize(map_->size());
    for (std::size_t n = 0; n < cells_.size(); ++n) {
      const auto& p = map_->place(n);
      cells_[n] = at(row_of(p), p[along_]);
    }
    content_.assign(count_, false);
  }

  void lay_along(std::size_t axis) noexcept {
    along_ = axis;
    across_ = 3 - axis;
    length_ = static_cast<std::size_t>(map_->box().size[along_]) + 2;
  }
  /// f(first node's place, nodes, what they are) for the runs of a row.
  template <class F>
  void for_runs_of(int x, int a, F f) const {
    std::array<int, 3> p{};
    p[0] = x;
    p[across_] = a;
    int& at = p[along_];
    const int end = map_->box().size[along_];
    while (at < end) {
      const std::int32_t n = node_at(p);
      if (n == none) {
        ++at;
        continue;
      }
      const auto first = p;
      const site what = map_->at(static_cast<std::size_t>(n));
      do {
        ++at;
      } while (at < end && is(node_at(p), what));
      f(first, at - first[along_], what);
    }
  }
  /// The node at a place; `none` where there is a wall or an image.
  [[nodiscard]] std::int32_t node_at(const std::array<int, 3>& p) const noexcept {
    const std::int32_t n = map_->node_at(p[0], p[1], p[2]);
    const auto k = static_cast<std::size_t>(n);
    return n != none && k < map_->size() && map_->place(k) == p ? n : none;
  }
  [[nodiscard]] bool is(std::int32_t node, const site& what) const noexcept {
    if (node == none) {
      return false;
    }
    const site found = map_->at(static_cast<std::size_t>(node));
    return found.kind == what.kind && (what.kind == site_kind::fluid || found.tag == what.tag);
  }
  [[nodiscard]] std::size_t batches_of_runs() const {
    std::size_t batches = 0;
    for (int x = 0; x < map_->box().size[0]; ++x) {
      for (int a = 0; a < map_->box().size[across_]; ++a) {
        for_runs_of(x, a, [&](const auto&, int nodes, site) {
          batches += (static_cast<std::size_t>(nodes) + lanes_ - 1) / lanes_;
        });
      }
    }
    return batches;
  }

  void add_plane(std::size_t x) {
    plane p{runs_.size(), 0, links_.size(), 0, 0, 0};
    const auto length = static_cast<std::ptrdiff_t>(length_);
    for (int a = 0; a < map_->box().size[across_]; ++a) {
      const auto r = static_cast<std::ptrdiff_t>(rows_.size());
      row_range of{runs_.size(), 0, links_.size(), 0, 0, 0};
      for (auto k = at_.begin() + r * length; k != at_.begin() + (r + 1) * length; ++k) {
        if (*k != none) {
          of.first_cell = of.first_cell == of.last_cell ? *k : of.first_cell;
          of.last_cell = *k + 1;
        }
      }
      for_runs_of(static_cast<int>(x), a,
                  [&](const std::array<int, 3>& first, int nodes, site what) { add_run(first, nodes, what); });
      of.last_run = runs_.size();
      of.last_link = links_.size();
      rows_.push_back(of);
    }
    p.last_run = runs_.size();
    p.last_link = links_.size();
    planes_.push_back(p);
  }
  void add_run(const std::array<int, 3>& p, int nodes, site what) {
    const std::int32_t cell = at(row_of(p), p[along_]);
    neighbours by{};
    for (int k = 0; k < static_cast<int>(directions); ++k) {
      const beyond b = look(p, k);
      const std::int32_t there = b.wall ? cell : at(b.row, p[along_] + step_along(k));
      const auto d = static_cast<std::size_t>(k);
      by.to[d] = static_cast<std::int64_t>(place(there, slot(b.as))) - static_cast<std::int64_t>(place(cell, 0));
      by.seen[d] = b.wall ? face() - cell : there - cell;
      by.as[d] = static_cast<std::uint8_t>(b.as);
      auto q = p;
      for (int j = 0; j < nodes && k != 0; ++j, ++q[along_]) {
        const auto n = static_cast<std::size_t>(node_at(q));
        const std::int32_t virtual_cell = there + j;
        const std::size_t virtual_place = place(virtual_cell, slot(b.as));
        const std::size_t really = gate(map_->leaving(n, k));
        if (really != virtual_place) {
          links_.push_back({static_cast<std::uint32_t>(virtual_place), static_cast<std::uint32_t>(really)});
        }
        if (!b.wall) {
          show(virtual_cell, map_->seen(n, k), p[0]);
        }
      }
    }
    const auto known = known_.try_emplace(by, static_cast<std::int32_t>(tables_.size()));
    if (known.second) {
      tables_.push_back(by);
    }
    runs_.push_back({cell, nodes, known.first->second, what});
    longest_ = std::max(longest_, static_cast<std::size_t>(nodes));
  }

  /// What a cell that is no node shows, the first time that it is seen; planes see in the order of x.
  void show(std::int32_t cell, const typename site_map<L>::sight& s, int x) {
    if ((s.node != none && cells_[static_cast<std::size_t>(s.node)] == cell) ||
        content_[static_cast<std::size_t>(cell)]) {
      return;
    }
    content_[static_cast<std::size_t>(cell)] = true;
    if (s.node != none) {
      pending_.push_back(
          {map_->place(static_cast<std::size_t>(s.node))[0], {cell, cells_[static_cast<std::size_t>(s.node)]}});
    } else if (s.image != none) {
      images_.push_back({cell, s.image, x});
    } else {
      walls_.push_back({cell, s.wall});
    }
  }

  void sort_copies() {
    std::stable_sort(pending_.begin(), pending_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::size_t next = 0;
    for (std::size_t x = 0; x < planes_.size(); ++x) {
      planes_[x].first_copy = next;
      for (; next < pending_.size() && pending_[next].first == static_cast<int>(x); ++next) {
        copies_.push_back(pending_[next].second);
      }
      planes_[x].last_copy = next;
    }
  }

  const site_map<L>* map_ = nullptr;  ///< while the layout is made
  std::size_t lanes_ = 0;
  std::size_t aligned_ = 1;
  std::size_t along_ = 2;   ///< the axis of rows
  std::size_t across_ = 1;  ///< the other one of a plane
  std::size_t length_ = 0;  ///< of a row, its two ends beyond the box included
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  std::size_t longest_ = 0;
  std::vector<std::int32_t> at_;  ///< the cell at a place of a row
  std::vector<std::int32_t> cells_;
  std::vector<bool> content_;  ///< whether it is known what a cell that is no node shows
  std::map<neighbours, std::int32_t> known_;
  std::vector<std::pair<int, copy>> pending_;  ///< copies, and the plane that they wait for
  std::vector<run> runs_;
  std::vector<neighbours> tables_;
  std::vector<link> links_;
  std::vector<copy> copies_;
  std::vector<wall> walls_;
  std::vector<image> images_;
  std::vector<plane> planes_;
  std::vector<row_range> rows_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
