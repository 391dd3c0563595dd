// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/two_phase/drainage.hpp"

#include <random>
#include <set>
#include <vector>

/// \file
/// Drainage without any cleverness: everything is looked at again for each event.

struct oracle_event {
  std::size_t pore, throat;
  double threshold, pressure;
  std::size_t level;
};

/// What is known of a pore that lost its way to the outlet.
struct oracle_trap {
  double pressure = -1;     ///< -1: not trapped
  std::size_t cluster = 0;  ///< least pore of the cluster it was trapped with
};

template <class Rule>
class drainage_oracle {
 public:
  drainage_oracle(const tetrapore::network& net, Rule rule, const tetrapore::drainage_options& options)
      : net_(net), rule_(rule), options_(options), state_(net), traps(net.pore_count()) {
    using namespace tetrapore;
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      for (const face f : all_faces) {
        if (options.inlet.contains(f) && net.touches(pore_id(i), f)) {
          state_.mark_inlet(pore_id(i));
          state_.invade(pore_id(i));
        }
        if (options.outlet.contains(f) && net.touches(pore_id(i), f)) {
          state_.mark_outlet(pore_id(i));
        }
      }
    }
    trap_what_is_cut_off();
    run();
  }

  std::vector<oracle_event> events;

 private:
  void run() {
    using namespace tetrapore;
    for (;;) {
      oracle_event best{0, net_.throat_count(), 0, 0, 0};
      for (std::size_t t = 0; t < net_.throat_count(); ++t) {
        for (const auto& [gas, wet] : {std::pair{0, 1}, std::pair{1, 0}}) {
          const pore_id from = net_.pores(throat_id(t))[static_cast<std::size_t>(gas)];
          const pore_id to = net_.pores(throat_id(t))[static_cast<std::size_t>(wet)];
          if (!state_.is_gas(from) || state_.is_gas(to) || state_.is_outlet(to) || traps[to.index()].pressure >= 0) {
            continue;
          }
          const auto answer = rule_.threshold(net_, state_, throat_id(t));
          if (answer.ok() && (best.throat == net_.throat_count() || answer.value.value() < best.threshold)) {
            best = {to.index(), t, answer.value.value(), 0, 0};
          }
        }
      }
      const bool none = best.throat == net_.throat_count();
      const bool new_level = none || level_ == 0 || best.threshold > pressure_;
      if (options_.trap == trapping::per_level && new_level && level_ > 0) {
        trap_what_is_cut_off();
        if (!none && traps[best.pore].pressure >= 0) {
          continue;  // the candidate was cut off with the level that just ended
        }
      }
      if (none) {
        return;
      }
      if (new_level) {
        ++level_;
        pressure_ = best.threshold * (1 + options_.level_margin);
      }
      best.pressure = pressure_;
      best.level = level_;
      events.push_back(best);
      state_.invade(pore_id(best.pore));
      if (options_.trap == trapping::per_event) {
        trap_what_is_cut_off();
      }
    }
  }

  void trap_what_is_cut_off() {
    using namespace tetrapore;
    if (options_.trap == trapping::none) {
      return;
    }
    const std::size_t n = net_.pore_count();
    const auto flood = [&](std::set<std::size_t> seen) {
      for (bool grown = true; grown;) {
        grown = false;
        for (std::size_t t = 0; t < net_.throat_count(); ++t) {
          if (!options_.liquid_passes_closed_throats &&
              rule_.threshold(net_, state_, throat_id(t)).kind() == verdict::absent) {
            continue;
          }
          const auto& [a, b] = net_.pores(throat_id(t));
          if (state_.is_wet(a) && state_.is_wet(b) && seen.contains(a.index()) != seen.contains(b.index())) {
            seen.insert(a.index());
            seen.insert(b.index());
            grown = true;
          }
        }
      }
      return seen;
    };
    std::set<std::size_t> outlet;
    for (std::size_t i = 0; i < n; ++i) {
      if (state_.is_outlet(pore_id(i))) {
        outlet.insert(i);
      }
    }
    const std::set<std::size_t> joined = flood(outlet);
    for (std::size_t i = 0; i < n; ++i) {
      if (state_.is_wet(pore_id(i)) && !joined.contains(i) && traps[i].pressure < 0) {
        for (const std::size_t k : flood({i})) {
          traps[k] = {pressure_, i};
        }
      }
    }
  }

  const tetrapore::network& net_;
  Rule rule_;
  tetrapore::drainage_options options_;
  tetrapore::two_phase_state state_;
  double pressure_ = 0;
  std::size_t level_ = 0;

 public:
  std::vector<oracle_trap> traps;
};
