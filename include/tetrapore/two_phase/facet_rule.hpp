// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/evaluate.hpp"
#include "tetrapore/law/entry/concept.hpp"
#include "tetrapore/network/gather_opening.hpp"
#include "tetrapore/two_phase/entry_rule.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

/// \file
/// Thresholds from an entry law on the facets of a network, and what to do where a gap gives way first.

namespace tetrapore::inline TETRAPORE_ABI {

/// What stands for the threshold of a facet that the law refuses as gap_limited or no_hole.
enum class gap_model : unsigned char {
  lost_arc,  ///< the pressure at which the widest gap loses its arc; a lower bound, fixed
  merged,  ///< the facet shares one meniscus with the other facet that bounds the gas at that gap; moves with the state
  refused  ///< nothing: gas does not pass
};

[[nodiscard]] constexpr const char* describe(gap_model m) noexcept {
  switch (m) {
    case gap_model::lost_arc: return "lost_arc";
    case gap_model::merged: return "merged";
    case gap_model::refused: return "refused";
  }
  return "not a gap model";
}

/// How the merged facets came out: the last answer for each throat that was asked. A driver asks for the throats of the
/// front whose lower bound came within its reach.
struct merge_counts {
  std::size_t merged = 0;      ///< throats whose threshold is that of a ring of several facets
  std::size_t at_arc = 0;      ///< of these: the ring could be entered at once when the arc was lost
  std::size_t no_partner = 0;  ///< the network ends at the gap: the pressure of the lost arc stands
  std::size_t no_ring = 0;     ///< the facets form no ring of at most 8 sides, or the law refuses it: the same
  std::size_t moved = 0;       ///< throats that were asked again and gave another value
  std::array<std::size_t, opening<double>::max_sides + 1> by_sides{};  ///< merged, by the number of sides

  /// Throats that were asked: the gap-limited ones that came within reach of the gas.
  [[nodiscard]] constexpr std::size_t asked() const noexcept { return merged + no_partner + no_ring; }
};

/// The thresholds of an entry law, each facet seen as an opening of its own.
///
/// gap_model::merged: gas waits at a facet whose widest gap loses its arc at p_arc, before the law would let it in.
/// Once p_c > p_arc no liquid is left in that gap, and the meniscus continues through it onto the other facet that
/// bounds the gas there. Both facets, unfolded about the edge, are one opening, which the law is asked about; where a
/// gap of that ring in turn gives way first, the facet there joins too. With the arcs gone at p_1, p_2, … and the
/// last ring entered at p_ring, the threshold is the largest of them all: below p_k the gap k still holds its ring of
/// liquid and the larger meniscus does not exist; where p_ring is below that, the larger meniscus is unstable as it
/// forms, and gas passes at p_k. Hence merged is never below lost_arc. A facet that has a threshold of its own keeps
/// it: all of its gaps outlive it. Where the network ends at a gap, or no ring of 8 sides suffices, the pressure of
/// the arc lost last stands, with the status lost_arc, and is counted in `merges`.
/// \par Units  pressures [Pa]
/// \par Thread safety  merged notes which facets each answer rested on: one invasion at a time
/// \par Source  Princen, J. Colloid Interface Sci. 30, 69 (1969) for the arcs; the merging of facets is derived here
template <class Law, gap_model Model = gap_aware_entry_law<Law> ? gap_model::lost_arc : gap_model::refused>
  requires entry_law<Law> && (Model == gap_model::refused || gap_aware_entry_law<Law>)
class facet_rule {
 public:
  static constexpr bool depends_on_state = Model == gap_model::merged;
  static constexpr gap_model model = Model;

  /// Asks the law about every facet.
  template <executor E = serial>
  facet_rule(const network& net, const Law& law, const E& cores = {})
      : law_(law), answers_(net.throat_count()), reasons_(net.throat_count()) {
    totals_ = evaluate(
        cores, net.throat_count(), [&](throat_id t) noexcept { return law_.entry_pressure(opening_at(net, t)); },
        [](std::size_t t) { return throat_id(t); },
        [&](std::size_t t, const outcome<double, entry_status>& answer) {
          reasons_[t] = answer.reason;
          answers_[t] = standing(net, throat_id(t), answer);
        });
    for (const entry_status reason : reasons_) {
      facets_.add(reason);
    }
    if constexpr (depends_on_state) {
      bounds_.resize(net.throat_count());
      cores.blocks(net.throat_count(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
          bounds_[t] = bound_of(net, throat_id(t));
        }
      });
      newest_.assign(net.throat_count(), nothing);
      askings_.assign(net.throat_count(), 0);
      last_.assign(net.throat_count(), account{});
    }
  }

  [[nodiscard]] threshold_outcome threshold(const network& net, const two_phase_state& state, throat_id t) {
    const auto& [value, reason] = answers_[t.index()];
    if constexpr (depends_on_state) {
      if (gives_way(reason)) {
        const auto& [a, b] = net.pores(t);
        if (b.valid() && state.is_gas(a) != state.is_gas(b)) {
          return merged_threshold(net, state, t);
        }
        return {bracket<double>::exactly(quiet_nan<double>), reason};
      }
    }
    return {bracket<double>::exactly(value), reason};
  }

  /// Never above the threshold of t in any state: that of the facet alone, or the pressure at which its first arc is
  /// lost; infinite where there can be none.
  [[nodiscard]] double lower_bound(throat_id t) const noexcept
    requires depends_on_state
  {
    return bounds_[t.index()];
  }

  /// Begins to fetch what `threshold` will need.
  void prefetch(throat_id t) const noexcept { detail::prefetch(&answers_[t.index()]); }

  /// Closed laws have nothing to settle.
  void settle(const network&, const two_phase_state&, std::span<const throat_id>) const noexcept {}

  /// The throats whose ring rested on a facet of pore p, which bounds the gas no longer.
  void touched_by(const network& net, const two_phase_state&, pore_id p, std::vector<throat_id>& out) {
    if constexpr (depends_on_state) {
      for (const throat_id t : net.throats(p)) {
        if (!t.valid()) {
          continue;
        }
        for (std::uint32_t k = std::exchange(newest_[t.index()], nothing); k != nothing;) {
          // A throat is named once, and by its last asking alone.
          const throat_id rests = notes_[k].throat;
          if (notes_[k].asking == askings_[rests.index()]) {
            ++askings_[rests.index()];
            out.push_back(rests);
          }
          const std::uint32_t older = notes_[k].older;
          notes_[k].older = std::exchange(spare_, k);
          k = older;
        }
      }
    }
  }

  [[nodiscard]] const Law& law() const noexcept { return law_; }
  /// Answers of the law for every facet alone, before any model of the gap.
  [[nodiscard]] const status_counts& facets() const noexcept { return facets_; }
  /// The same per verdict, with the first throat of each.
  [[nodiscard]] const tally& totals() const noexcept { return totals_; }
  /// The law's own reason for the facet alone, before any model of the gap.
  [[nodiscard]] entry_status law_reason(throat_id t) const noexcept { return reasons_[t.index()]; }
  /// The threshold of the facet alone, the same in every state: the law's answer, or under lost_arc, where a gap gives
  /// way first, the pressure of the lost arc with that status.
  [[nodiscard]] const outcome<double, entry_status>& alone(throat_id t) const noexcept { return answers_[t.index()]; }
  /// The threshold that was told last; that of the facet alone where it has no other.
  [[nodiscard]] double last_threshold(throat_id t) const noexcept {
    if constexpr (depends_on_state) {
      if (last_[t.index()].how != ending::not_asked) {
        return last_[t.index()].value;
      }
    }
    return answers_[t.index()].value;
  }
  /// How merging came out so far.
  [[nodiscard]] const merge_counts& merges() const noexcept { return merges_; }
  /// Begins the counts and notes of merging anew, for another invasion.
  void forget_merges() {
    merges_ = {};
    notes_.clear();
    spare_ = nothing;
    newest_.assign(newest_.size(), nothing);
    last_.assign(last_.size(), account{});
  }

 private:
  static constexpr std::uint32_t nothing = 0xffffffffU;

  enum class ending : std::uint8_t { not_asked, ring, no_partner, no_ring };

  /// How the last answer for a throat came out.
  struct account {
    ending how = ending::not_asked;
    std::uint8_t sides = 0;
    bool at_arc = false;
    bool moved = false;
    double value = quiet_nan<double>;  ///< [Pa]
  };

  /// Throat t rested on a facet when it was last asked; a list per facet, newest first.
  struct note {
    throat_id throat;
    std::uint32_t asking;
    std::uint32_t older;
  };

  /// The gap of a ring that loses its arc first. All facets around an edge read the same pressure off it, to the last
  /// bit: they form one level, whatever the unit of length.
  [[nodiscard]] arc_limit<double> weakest_gap(const network& net, const gathered_ring& ring) const noexcept {
    arc_limit<double> weakest{infinity<double>, 0};
    for (std::size_t k = 0; k < ring.ring().count; ++k) {
      if (const auto e = ring.edge_in_gap(net, k)) {
        if (const auto lost = law_.arc_lost(*e); lost.ok() && lost.value < weakest.pressure) {
          weakest = {lost.value, k};
        }
      }
    }
    return weakest;
  }

  /// The pressure at which a facet alone loses its first arc.
  [[nodiscard]] double first_arc_lost(const network& net, throat_id t) const noexcept {
    const pore_id p = net.pores(t)[0];
    const auto& slots = facet_vertices[net.slot(t, 0)];
    double lowest = infinity<double>;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = slots[k];
      const std::size_t b = slots[(k + 1) % 3];
      if (net.vertices(p)[a].is_wall() && net.vertices(p)[b].is_wall()) {
        continue;
      }
      if (const auto lost = law_.arc_lost(edge_at(net, p, a, b)); lost.ok() && lost.value < lowest) {
        lowest = lost.value;
      }
    }
    return lowest;
  }

  /// What stands for the law's answer to the facet alone.
  [[nodiscard]] outcome<double, entry_status> standing([[maybe_unused]] const network& net,
                                                       [[maybe_unused]] throat_id t,
                                                       const outcome<double, entry_status>& answer) const noexcept {
    if constexpr (Model == gap_model::lost_arc) {
      if (gives_way(answer.reason)) {
        if (const double lost = first_arc_lost(net, t); lost < infinity<double>) {
          return {lost, entry_status::lost_arc};
        }
      }
    }
    return answer;
  }

  [[nodiscard]] static constexpr bool gives_way(entry_status s) noexcept {
    return s == entry_status::gap_limited || s == entry_status::no_hole;
  }

  [[nodiscard]] double bound_of(const network& net, throat_id t) const noexcept {
    const auto& alone = answers_[t.index()];
    if (!gives_way(alone.reason)) {
      return alone.ok() ? alone.value : infinity<double>;
    }
    return first_arc_lost(net, t);
  }

  /// The facet seen from the gas.
  [[nodiscard]] static gathered_ring from_gas(const network& net, const two_phase_state& state, throat_id t) {
    const std::size_t side = state.is_gas(net.pores(t)[0]) ? 0 : 1;
    return gathered_ring(net, net.pores(t)[side], net.slot(t, side));
  }

  /// Lets facets join the ring until the law lets gas in or nothing more can join. The answer for `asking` rests on
  /// each of them. `lost` rises to the pressure of the last arc lost; `entered` is that of the ring.
  [[nodiscard]] ending merge_facets(const network& net, const two_phase_state& state, throat_id asking,
                                    gathered_ring& ring, double& lost, double& entered) {
    const auto is_gas = [&](pore_id p) { return state.is_gas(p); };
    for (;;) {
      const arc_limit<double> limit = weakest_gap(net, ring);
      if (!(limit.pressure < infinity<double>)) {
        return ending::no_ring;
      }
      lost = limit.pressure > lost ? limit.pressure : lost;
      const std::size_t before = ring.facets().size();
      const auto grown = ring.grow(net, limit.gap, is_gas);
      if (ring.facets().size() > before && ring.facets().back() != asking) {
        take_note(asking, ring.facets().back());
      }
      if (grown != gathered_ring::growth::grown) {
        return grown == gathered_ring::growth::no_partner ? ending::no_partner : ending::no_ring;
      }
      const auto answer = law_.entry_pressure(ring.ring());
      if (answer.ok()) {
        entered = answer.value;
        return ending::ring;
      }
      if (!gives_way(answer.reason)) {
        return ending::no_ring;
      }
    }
  }

  [[nodiscard]] static bool same_facets(const gathered_ring& a, const gathered_ring& b) noexcept {
    const auto in_b = [&](throat_id t) {
      for (const throat_id u : b.facets()) {
        if (u == t) {
          return true;
        }
      }
      return false;
    };
    for (const throat_id t : a.facets()) {
      if (!in_b(t)) {
        return false;
      }
    }
    return a.facets().size() == b.facets().size();
  }

  [[nodiscard]] threshold_outcome merged_threshold(const network& net, const two_phase_state& state, throat_id t) {
    gathered_ring ring = from_gas(net, state, t);
    ++askings_[t.index()];
    double lost = bounds_[t.index()];
    double entered = 0;
    const ending how = merge_facets(net, state, t, ring, lost, entered);
    if (how != ending::ring) {
      return booked(t, lost, {how});
    }
    // Facets of one ring read the same pressure off it, to the last bit: that of the ring as its first facet unfolds
    // it. Otherwise round-off, and with it the unit of length, would choose the pore that gas takes.
    throat_id first = t;
    for (const throat_id u : ring.facets()) {
      first = u < first ? u : first;
    }
    if (first != t) {
      gathered_ring twin = from_gas(net, state, first);
      double twin_lost = 0;
      double twin_entered = 0;
      if (merge_facets(net, state, t, twin, twin_lost, twin_entered) == ending::ring && same_facets(ring, twin)) {
        entered = twin_entered;
      }
    }
    const bool at_arc = !(entered > lost);
    return booked(t, at_arc ? lost : entered, {ending::ring, static_cast<std::uint8_t>(ring.ring().count), at_arc});
  }

  void take_note(throat_id t, throat_id rests_on) {
    std::uint32_t k = spare_;
    if (k != nothing) {
      spare_ = notes_[k].older;
    } else {
      k = static_cast<std::uint32_t>(notes_.size());
      notes_.emplace_back();
    }
    notes_[k] = {t, askings_[t.index()], std::exchange(newest_[rests_on.index()], k)};
  }

  /// Books an answer in place of the one before, and gives it.
  threshold_outcome booked(throat_id t, double value, account now) {
    account& last = last_[t.index()];
    if (last.how != ending::not_asked) {
      now.moved = last.moved || value != last.value;
      count(last, -1);
    }
    count(now, +1);
    now.value = value;
    last = now;
    return {bracket<double>::exactly(value), now.how == ending::ring ? entry_status::merged : entry_status::lost_arc};
  }

  void count(const account& a, int by) noexcept {
    const auto change = [&](std::size_t& n, bool applies) { n += applies ? static_cast<std::size_t>(by) : 0; };
    change(merges_.merged, a.how == ending::ring);
    change(merges_.at_arc, a.at_arc);
    change(merges_.no_partner, a.how == ending::no_partner);
    change(merges_.no_ring, a.how == ending::no_ring);
    change(merges_.moved, a.moved);
    change(merges_.by_sides[a.sides], a.how == ending::ring);
  }

  Law law_;
  std::vector<outcome<double, entry_status>> answers_;  ///< per facet alone; constant
  std::vector<entry_status> reasons_;                   ///< the law's own
  status_counts facets_;
  tally totals_;
  merge_counts merges_;
  std::vector<double> bounds_;         ///< merged: per facet, lower bound of its threshold [Pa]
  std::vector<std::uint32_t> newest_;  ///< per facet: the newest note
  std::vector<note> notes_;
  std::uint32_t spare_ = nothing;
  std::vector<std::uint32_t> askings_;  ///< per throat: how often it was asked; its older notes hold no more
  std::vector<account> last_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
