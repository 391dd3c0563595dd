// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/evaluate.hpp"
#include "tetrapore/law/conductance/concept.hpp"
#include "tetrapore/one_phase/nodes.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

/// \file
/// A conductance law applied to the throats of a network.

namespace tetrapore::inline TETRAPORE_ABI {

/// What becomes of a throat that the law refuses.
enum class refused_throats : unsigned char {
  error,  ///< set-up fails, naming the first one and the law's reason
  closed  ///< nothing passes it; it is counted
};

/// Whether the hydraulics of the throats outlast the law, for forces_of_pressure: 104 bytes a throat, and less time.
enum class keep_hydraulics : bool { no, yes };

/// How often a law gave each reason, and the first throat that got it.
class conductance_counts {
 public:
  void add(conductance_status s, throat_id t) noexcept {
    auto& k = reasons_[static_cast<std::size_t>(s)];
    ++k.count;
    k.first = k.first.valid() && k.first < t ? k.first : t;
  }
  void add(const conductance_counts& other) noexcept {
    for (std::size_t s = 0; s < kinds; ++s) {
      reasons_[s].count += other.reasons_[s].count;
      const throat_id t = other.reasons_[s].first;
      if (t.valid() && (!reasons_[s].first.valid() || t < reasons_[s].first)) {
        reasons_[s].first = t;
      }
    }
  }
  [[nodiscard]] std::size_t operator[](conductance_status s) const noexcept {
    return reasons_[static_cast<std::size_t>(s)].count;
  }
  /// Invalid when there is none.
  [[nodiscard]] throat_id first(conductance_status s) const noexcept {
    return reasons_[static_cast<std::size_t>(s)].first;
  }
  /// Throats that the law refused or failed at.
  [[nodiscard]] std::size_t refused() const noexcept {
    std::size_t n = 0;
    for (std::size_t s = 0; s < kinds; ++s) {
      n += without_value(s) ? reasons_[s].count : 0;
    }
    return n;
  }
  [[nodiscard]] throat_id first_refused() const noexcept {
    throat_id best;
    for (std::size_t s = 0; s < kinds; ++s) {
      if (without_value(s) && reasons_[s].first.valid() && (!best.valid() || reasons_[s].first < best)) {
        best = reasons_[s].first;
      }
    }
    return best;
  }

 private:
  static constexpr std::size_t kinds = static_cast<std::size_t>(conductance_status::invalid_input) + 1;
  [[nodiscard]] static bool without_value(std::size_t s) noexcept {
    const verdict v = verdict_of(static_cast<conductance_status>(s));
    return v == verdict::refused || v == verdict::failed;
  }
  struct entry {
    std::size_t count = 0;
    throat_id first;
  };
  std::array<entry, kinds> reasons_{};
};

/// The conductances of a network's throats.
struct throat_conductances {
  /// Per throat [m³/(Pa s)]; 0 on a boundary and inside a node, where no law is asked, and where a throat is closed.
  std::vector<double> values;
  conductance_counts counts;
  /// Per throat, the nodes where they stand; nothing of a boundary. Empty unless they were to be kept.
  std::vector<throat_hydraulics<double>> hydraulics;
};

/// Whether a number can be a conductance: finite and at least 0.
[[nodiscard]] constexpr bool is_conductance(double k) noexcept {
  return k >= 0 && k <= std::numeric_limits<double>::max();
}

/// Asks a law about every throat between two nodes, with the nodes where they stand.
/// \throw network_error  a throat that the law refuses, unless such throats are to be closed; names it and the reason.
///                       In any case one that the law gives a value which is no conductance
template <conductance_law Law, executor E = serial>
[[nodiscard]] throat_conductances conductances(const network& net, const flow_nodes& nodes, const Law& law,
                                               refused_throats refused = refused_throats::error, const E& cores = {},
                                               keep_hydraulics keep = keep_hydraulics::no) {
  TETRAPORE_EXPECTS(nodes.pore_count() == net.pore_count(), "the nodes belong to the network");
  throat_conductances out;
  out.values.assign(net.throat_count(), 0.0);
  if (keep == keep_hydraulics::yes) {
    out.hydraulics.resize(net.throat_count());
  }
  throat_id impossible;
  std::mutex merge;
  cores.blocks(net.throat_count(), [&](std::size_t begin, std::size_t end) {
    conductance_counts mine;
    throat_id mine_impossible;
    for (std::size_t i = begin; i < end; ++i) {
      const throat_id t(i);
      const bool asked = !nodes.inside(net, t);
      if (net.is_boundary(t) || (!asked && out.hydraulics.empty())) {
        continue;
      }
      const throat<double> seen = nodes.throat_between(net, t);
      hydraulics_outcome<double> h{};
      if (hydraulic_law<Law> || !out.hydraulics.empty()) {
        h = hydraulics_of(seen);
      }
      if (!out.hydraulics.empty()) {
        out.hydraulics[i] = h.value;
      }
      if (!asked) {
        continue;
      }
      const auto answer = [&] {
        if constexpr (hydraulic_law<Law>) {
          return law.conductance(seen, h);
        } else {
          return law.conductance(seen);
        }
      }();
      mine.add(answer.reason, t);
      out.values[i] = answer.ok() ? answer.value : 0.0;
      if (!is_conductance(out.values[i]) && !mine_impossible.valid()) {
        mine_impossible = t;
      }
    }
    const std::lock_guard lock(merge);
    out.counts.add(mine);
    if (mine_impossible.valid() && (!impossible.valid() || mine_impossible < impossible)) {
      impossible = mine_impossible;
    }
  });
  if (impossible.valid()) {
    throw network_error("throat " + std::to_string(impossible.index()),
                        "a conductance of " + short_number(out.values[impossible.index()]) + " from the law",
                        "a finite number of at least 0, or a reason to refuse");
  }
  if (const throat_id t = out.counts.first_refused(); refused == refused_throats::error && t.valid()) {
    const auto why = law.conductance(nodes.throat_between(net, t)).reason;
    throw network_error(
        "throat " + std::to_string(t.index()) + " (the first of " + std::to_string(out.counts.refused()) + ")",
        describe(why), "a throat that the law covers, or refused_throats::closed");
  }
  return out;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
