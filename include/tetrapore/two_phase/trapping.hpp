// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/clusters.hpp"
#include "tetrapore/two_phase/state.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

/// \file
/// Which wet pores lost their way to the outlet.

namespace tetrapore::inline TETRAPORE_ABI {

/// A way out of a pore; `to` is invalid where no pore lies beyond.
struct pore_link {
  pore_id to;
  throat_id throat;
};

/// The four ways out of every pore, side by side in memory, and which of them liquid can pass.
class pore_links {
 public:
  pore_links() = default;
  explicit pore_links(const network& net) : links_(net.pore_count()) {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const pore_id p(i);
      for (std::size_t k = 0; k < 4; ++k) {
        const throat_id t = net.throats(p)[k];
        links_[i][k] = {t.valid() ? net.across(p, t) : pore_id{}, t};
      }
    }
  }

  /// Liquid no longer passes throat t.
  void close(throat_id t, std::size_t throat_count) {
    closed_.resize(throat_count, 0);
    closed_[t.index()] = 1;
  }

  [[nodiscard]] const std::array<pore_link, 4>& of(pore_id p) const noexcept { return links_[p.index()]; }

  void prefetch(pore_id p) const noexcept { detail::prefetch(&links_[p.index()]); }

  /// Calls f(neighbour) for the pores that liquid of pore p can reach through one throat.
  template <class F>
  void around(pore_id p, F&& f) const {
    for (const pore_link& l : of(p)) {
      if (l.to.valid() && (closed_.empty() || closed_[l.throat.index()] == 0)) {
        f(l.to);
      }
    }
  }

 private:
  std::vector<std::array<pore_link, 4>> links_;
  std::vector<std::uint8_t> closed_;  ///< empty: none
};

/// Sets of pores cut off together, one after another in one array, each with the time at which it was cut off.
class cut_off_sets {
 public:
  void clear() noexcept {
    pores_.clear();
    sets_.clear();
  }
  [[nodiscard]] std::size_t size() const noexcept { return sets_.size(); }
  [[nodiscard]] std::size_t time(std::size_t k) const noexcept { return sets_[k].time; }
  [[nodiscard]] std::span<const std::uint32_t> pores(std::size_t k) const noexcept {
    return {pores_.data() + sets_[k].begin, sets_[k].count};
  }
  void begin_set(std::size_t time) { sets_.push_back({time, pores_.size(), 0}); }
  void add(std::size_t pore) {
    pores_.push_back(static_cast<std::uint32_t>(pore));
    ++sets_.back().count;
  }
  /// Pores of a set by id; earlier sets first, among those of one time by their least pore: one order, and so one sum
  /// of volumes, for whichever way the sets were found.
  void sort() {
    for (const entry& s : sets_) {
      const auto first = pores_.begin() + static_cast<std::ptrdiff_t>(s.begin);
      std::sort(first, first + static_cast<std::ptrdiff_t>(s.count));
    }
    std::sort(sets_.begin(), sets_.end(), [&](const entry& a, const entry& b) {
      return a.time != b.time ? a.time < b.time : pores_[a.begin] < pores_[b.begin];
    });
  }

 private:
  struct entry {
    std::size_t time;
    std::size_t begin;
    std::size_t count;
  };
  std::vector<std::uint32_t> pores_;
  std::vector<entry> sets_;
};

/// Trapping while an invasion goes on: after some pores became gas, finds the sets of wet pores that this cut off.
/// Searches start from all wet neighbours of the new gas and advance in turn; they stop where they meet, at the outlet,
/// or when a single one is left, so the price is that of the smaller sides.
class live_trapping {
 public:
  live_trapping() = default;
  explicit live_trapping(std::size_t pores) : owner_(pores, 0) {}

  /// Everything wet that never had a way to the outlet. Appends sets of time 0.
  void find_initial(const two_phase_state& state, const pore_links& links, cut_off_sets& out) {
    begin(1);
    std::vector<std::uint32_t>& queue = groups_[0].queue;
    for (std::size_t i = 0; i < state.pore_count(); ++i) {
      if (state.is_outlet(pore_id(i))) {
        queue.push_back(static_cast<std::uint32_t>(i));
        owner_[i] = stamp_;
      }
    }
    const auto flood = [&](std::size_t head) {
      for (; head < queue.size(); ++head) {
        links.around(pore_id(queue[head]), [&](pore_id q) {
          if (owner_[q.index()] != stamp_ && state.is_wet(q) && !state.is_trapped(q)) {
            owner_[q.index()] = stamp_;
            queue.push_back(q.value);
          }
        });
      }
    };
    flood(0);
    for (std::size_t i = 0; i < state.pore_count(); ++i) {
      if (owner_[i] != stamp_ && state.is_drainable(pore_id(i))) {
        const std::size_t from = queue.size();
        owner_[i] = stamp_;
        queue.push_back(static_cast<std::uint32_t>(i));
        flood(from);
        out.begin_set(0);
        std::for_each(queue.begin() + static_cast<std::ptrdiff_t>(from), queue.end(),
                      [&](std::size_t p) { out.add(p); });
      }
    }
  }

  /// The sets cut off by `invaded`, which just became gas, given that every other wet pore that is not trapped had a
  /// way to the outlet before. Appends sets of time 0.
  void find(const two_phase_state& state, const pore_links& links, std::span<const pore_id> invaded,
            cut_off_sets& out) {
    seeds_.clear();
    bool at_outlet = false;
    for (const pore_id p : invaded) {
      links.around(p, [&](pore_id q) {
        at_outlet = at_outlet || state.is_outlet(q);
        if (state.is_drainable(q)) {
          seeds_.push_back(q.value);
        }
      });
    }
    if (seeds_.size() + (at_outlet ? 1 : 0) < 2) {
      return;
    }
    begin(seeds_.size());
    std::size_t used = 0;
    for (const std::uint32_t s : seeds_) {
      if (owner_[s] < stamp_) {
        owner_[s] = stamp_ + static_cast<std::uint32_t>(used);
        groups_[used++].queue.push_back(s);
      }
    }
    turns_.resize(used);
    std::iota(turns_.begin(), turns_.end(), 0U);
    // Some group always keeps its way to the outlet, unless the outlet itself was beside the new gas.
    bool safe = at_outlet;
    while (turns_.size() > (safe ? 0U : 1U)) {
      std::size_t kept = 0;
      for (std::size_t k = 0; k < turns_.size(); ++k) {
        const std::uint32_t g = turns_[k];
        if (groups_[g].parent != g || groups_[g].safe) {
          continue;  // met another, or the outlet
        }
        if (groups_[g].head == groups_[g].queue.size()) {
          out.begin_set(0);
          collect(g, out);
          continue;
        }
        advance(state, links, g);
        const std::uint32_t now = find_root(g);
        safe = safe || groups_[now].safe;
        if (now == g && !groups_[g].safe) {
          turns_[kept++] = g;
        }
      }
      turns_.resize(kept);
    }
  }

 private:
  struct group {
    std::vector<std::uint32_t> queue;   ///< pores found; from head on still to be looked around
    std::vector<std::uint32_t> joined;  ///< groups that were united into this one
    std::size_t head = 0;
    std::uint32_t parent = 0;
    bool safe = false;
  };

  void begin(std::size_t count) {
    if (stamp_ > 0xffffffffU - last_count_ - count) {
      std::fill(owner_.begin(), owner_.end(), 0U);
      stamp_ = 1;
    } else {
      stamp_ += static_cast<std::uint32_t>(last_count_);
    }
    last_count_ = count;
    if (groups_.size() < count) {
      groups_.resize(count);
    }
    for (std::size_t k = 0; k < count; ++k) {
      groups_[k].queue.clear();
      groups_[k].joined.clear();
      groups_[k].head = 0;
      groups_[k].parent = static_cast<std::uint32_t>(k);
      groups_[k].safe = false;
    }
  }

  [[nodiscard]] std::uint32_t find_root(std::uint32_t g) noexcept {
    while (groups_[g].parent != g) {
      groups_[g].parent = groups_[groups_[g].parent].parent;
      g = groups_[g].parent;
    }
    return g;
  }

  /// One pore of group g looks around.
  void advance(const two_phase_state& state, const pore_links& links, std::uint32_t g) {
    const pore_id p(groups_[g].queue[groups_[g].head++]);
    links.around(p, [&](pore_id q) {
      if (state.is_outlet(q)) {
        groups_[find_root(g)].safe = true;
      } else if (state.is_drainable(q)) {
        std::uint32_t& owner = owner_[q.index()];
        const std::uint32_t mine = find_root(g);
        if (owner < stamp_) {
          owner = stamp_ + mine;
          groups_[mine].queue.push_back(q.value);
        } else {
          unite(mine, find_root(owner - stamp_));
        }
      }
    });
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    if (a == b) {
      return;
    }
    group& small = groups_[a].queue.size() < groups_[b].queue.size() ? groups_[a] : groups_[b];
    group& large = &small == &groups_[a] ? groups_[b] : groups_[a];
    const std::uint32_t name = small.parent;
    small.parent = large.parent;
    large.safe = large.safe || small.safe;
    large.joined.push_back(name);
    // What the small one had still to look around is the large one's task; the part looked at stays where it is.
    large.queue.insert(large.queue.end(), small.queue.begin() + static_cast<std::ptrdiff_t>(small.head),
                       small.queue.end());
    small.queue.resize(small.head);
  }

  void collect(std::uint32_t g, cut_off_sets& out) const {
    for (const std::uint32_t p : groups_[g].queue) {
      out.add(p);
    }
    for (const std::uint32_t h : groups_[g].joined) {
      collect(h, out);
    }
  }

  std::vector<std::uint32_t> owner_;  ///< stamp_ + group of the search that found the pore; below stamp_: not found
  std::vector<group> groups_;
  std::vector<std::uint32_t> seeds_;
  std::vector<std::uint32_t> turns_;
  std::uint32_t stamp_ = 1;
  std::size_t last_count_ = 0;
};

/// Trapping after the fact, exact where thresholds do not depend on the state (Masson 2016, doi
/// 10.1016/j.cageo.2016.02.003): the invasion was run without trapping; walking it backwards, pores become wet again
/// and unite; a pore whose set does not reach the outlet when it returns had been trapped, and is deleted from the
/// sequence. The sequence is cut into groups (single events, or all events of one pressure level); trapping is tested
/// after each.
///
/// \param state     the state at the END of the sequence: wet are the pores that were never reached
/// \param sequence  the pores in the order in which they became gas
/// \param group_end for each group, the index after its last event
/// \param kept      one flag per event: false where the pore had been trapped before
/// \param out       the sets cut off, with time = number of the group after which (0: from the start), in order
inline void trap_backwards(const two_phase_state& state, const pore_links& links, std::span<const pore_id> sequence,
                           std::span<const std::uint32_t> group_end, std::vector<std::uint8_t>& kept,
                           cut_off_sets& out) {
  const std::size_t n = state.pore_count();
  const std::size_t outlet = n;
  disjoint_sets sets(n + 1);
  std::vector<std::uint8_t> wet(n, 0);
  std::vector<std::uint32_t> ring(n);  // the pores of a set that is not joined to the outlet, as a circular list
  std::iota(ring.begin(), ring.end(), 0U);

  const auto add = [&](pore_id p) {
    links.around(p, [&](pore_id q) {
      if (wet[q.index()] != 0 && !sets.same(p.index(), q.index())) {
        sets.unite(p.index(), q.index());
      }
    });
  };
  for (std::size_t i = 0; i < n; ++i) {
    const pore_id p(i);
    wet[i] = state.is_wet(p) && !state.is_trapped(p) ? 1 : 0;
    if (state.is_outlet(p)) {
      sets.unite(i, outlet);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (wet[i] != 0) {
      add(pore_id(i));
    }
  }
  // Members of one set go into one ring: a round of gathering is numbered by `now`.
  std::vector<std::uint32_t> round(n + 1, 0);
  std::vector<std::uint32_t> first(n + 1, 0);
  std::uint32_t now = 0;
  const auto gather = [&](std::uint32_t member) {
    const std::size_t root = sets.find(member);
    if (round[root] != now) {
      round[root] = now;
      first[root] = member;
    } else {
      std::swap(ring[first[root]], ring[member]);
    }
  };
  const auto emit = [&](std::uint32_t member, std::size_t time) {
    out.begin_set(time);
    std::uint32_t p = member;
    do {
      out.add(p);
      p = ring[p];
    } while (p != member);
  };

  now = 1;
  for (std::size_t i = 0; i < n; ++i) {
    if (wet[i] != 0 && !sets.same(i, outlet)) {
      gather(static_cast<std::uint32_t>(i));
    }
  }
  constexpr std::size_t ahead = 8;    // events, to fetch their links in time
  std::vector<std::uint32_t> beside;  // one member of each set beside the group that was cut off after it
  kept.assign(sequence.size(), 0);
  for (std::size_t g = group_end.size(); g-- > 0;) {
    const std::size_t begin = g == 0 ? 0 : group_end[g - 1];
    const auto group = sequence.subspan(begin, group_end[g] - begin);
    if (begin >= ahead) {
      links.prefetch(sequence[begin - ahead]);
    }
    beside.clear();
    ++now;
    const std::size_t outlet_root = sets.find(outlet);
    for (const pore_id p : group) {
      links.around(p, [&](pore_id q) {
        if (wet[q.index()] != 0) {
          const std::size_t root = sets.find(q.index());
          if (root != outlet_root && round[root] != now) {
            round[root] = now;
            beside.push_back(q.value);
          }
        }
      });
    }
    for (const pore_id p : group) {
      wet[p.index()] = 1;
      add(p);
    }
    ++now;
    for (const std::uint32_t member : beside) {
      if (sets.same(member, outlet)) {
        emit(member, g + 1);
      } else {
        gather(member);
      }
    }
    for (std::size_t k = 0; k < group.size(); ++k) {
      kept[begin + k] = sets.same(group[k].index(), outlet) ? 1 : 0;
      if (kept[begin + k] == 0) {
        gather(group[k].value);
      }
    }
  }
  ++now;
  for (std::size_t i = 0; i < n; ++i) {
    if (wet[i] != 0) {
      const std::size_t root = sets.find(i);
      if (root != sets.find(outlet) && round[root] != now) {
        round[root] = now;
        emit(static_cast<std::uint32_t>(i), 0);
      }
    }
  }
  out.sort();
}

}  // namespace tetrapore::inline TETRAPORE_ABI
