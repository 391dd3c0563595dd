// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/two_phase/entry_rule.hpp"
#include "tetrapore/two_phase/face_set.hpp"
#include "tetrapore/two_phase/front_heap.hpp"
#include "tetrapore/two_phase/state.hpp"
#include "tetrapore/two_phase/trapping.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Primary drainage: gas invades a network from the inlet, always through the throat of lowest threshold.
///
/// In short:
/// \code
///   facet_rule<mayer_stowe_princen, gap_model::lost_arc> rule(net, law);       // or any entry_rule
///   drainage invasion(net, rule, {.inlet = face::y_max, .outlet = face::y_min});
///   invasion.run();                                                            // or step(), step_level(), run_to(...)
///   invasion.state();                                                          // liquid volumes, phases, clusters
///   invasion.events();                                                         // the history
///   retention_curve curve(invasion);                                           // two_phase/retention_curve.hpp
///   auto fit = fit_van_genuchten(curve);                                       // two_phase/van_genuchten.hpp
///   auto bytes = to_bytes(net, invasion.state());                              // two_phase/state_file.hpp
/// \endcode
/// A level is a burst: all the pores that gas takes at one capillary pressure. The pressure of a level is
/// (1 + level_margin) times the lowest threshold that was open when it began.

namespace tetrapore::inline TETRAPORE_ABI {

/// What becomes of liquid without a way to the outlet.
enum class trapping : unsigned char {
  none,       ///< it drains all the same
  per_event,  ///< it stays; tested after every pore
  per_level   ///< it stays; tested when a burst has ended, so that a burst may still empty what it cut off
};

/// How trapping is computed. Both ways give the same answer where both apply.
enum class trapping_method : unsigned char {
  automatic,   ///< two passes where they are exact
  two_passes,  ///< invade without trapping, then walk back; exact where thresholds do not depend on the state and
               ///< levels need no margin
  live         ///< search after each event or level
};

struct drainage_options {
  face_set inlet = face::y_max;   ///< all pores that touch these faces are gas from the start
  face_set outlet = face::y_min;  ///< all pores that touch these faces stay wet; every other face is sealed
  trapping trap = trapping::per_event;
  trapping_method method = trapping_method::automatic;
  double level_margin = 0;  ///< relative rise of the pressure above the lowest threshold that opens a level
  /// Whether liquid passes a throat whose threshold is absent. Such a throat is closed by solid, so by default it does
  /// not. A refused throat is open, only its threshold is unknown: liquid always passes it.
  bool liquid_passes_closed_throats = false;
};

/// One pore taken by gas.
struct drainage_event {
  pore_id pore;
  throat_id throat;     ///< through which gas came
  double pressure;      ///< [Pa] capillary pressure: the running maximum of the thresholds (with the margin)
  double threshold;     ///< [Pa] of that throat, in the state at that time
  double volume;        ///< [m³] liquid that left
  std::uint32_t level;  ///< number of the burst, from 1
  entry_status reason;  ///< of the threshold

  [[nodiscard]] friend constexpr bool operator==(const drainage_event&, const drainage_event&) = default;
};

/// Drainage of a network under a rule. Deterministic: ties go to the lower throat id. Can be stopped after any event
/// and continued from a copy of its state (which can be saved: two_phase/state_file.hpp), with the same events to
/// follow.
/// \par Thread safety  one thread at a time; the network and the rule must outlive it
template <entry_rule Rule>
class drainage {
 public:
  /// From a saturated network.
  /// \throw parameter_error  no or a common face for inlet and outlet, a face that no pore touches, a pore that touches
  ///                         both, nothing between the two, a negative margin, a method that does not apply
  drainage(const network& net, Rule& rule, const drainage_options& options = {})
      : drainage(net, rule, two_phase_state(net), options) {}

  /// From a given state, as saved or after a rebuild. Gas that is not connected to the inlet takes part when the front
  /// reaches it.
  drainage(const network& net, Rule& rule, two_phase_state from, const drainage_options& options = {})
      : net_(&net), rule_(&rule), options_(options), state_(std::move(from)) {
    check_options();
    place_reservoirs();
    link_pores();
    if constexpr (Rule::depends_on_state) {
      key_.assign(net.throat_count(), no_key);
      reason_.assign(net.throat_count(), entry_status::ok);
      bounded_.assign(by_bounds ? net.throat_count() : 0, 0);
    } else {
      best_.assign(net.pore_count(), infinity<double>);
    }
    feed_inlet();
    if (options_.trap != trapping::none) {
      prepare_trapping();
    }
  }

  /// Gas takes one more pore. False when nothing is left to take.
  bool step() {
    if (two_passes_) {
      return replay();
    }
    if (!find_next()) {
      return false;
    }
    const candidate taken = std::exchange(next_, candidate{});
    entry_status reason{};
    if constexpr (Rule::depends_on_state) {
      reason = reason_[taken.throat.index()];
    } else {
      reason = rule_->threshold(*net_, state_, taken.throat).reason;
    }
    record(taken.target, taken.throat, taken.threshold.value(), reason);
    advance_front(taken.target);
    if (live_) {
      trap_live(taken.target);
    }
    return true;
  }

  /// Gas takes the rest of the present burst, or all of the next one. Returns the number of pores taken.
  std::size_t step_level() {
    const std::size_t before = events_.size();
    while (step() && next_pressure() <= state_.pressure()) {
    }
    return events_.size() - before;
  }

  /// Until nothing is left to take.
  void run() {
    while (step()) {
    }
  }

  /// Until the next event would need more than this capillary pressure [Pa].
  void run_to_pressure(double pressure) {
    while (next_pressure() <= pressure && step()) {
    }
  }

  /// Until the saturation of all pores that are not reservoir is at most this.
  void run_to_saturation(double target) {
    while (saturation() > target && step()) {
    }
  }

  /// Capillary pressure of the next event [Pa]; infinity when nothing is left to take.
  [[nodiscard]] double next_pressure() {
    if (two_passes_) {
      return done_ == plan_.size() ? infinity<double> : pressure_for(plan_[done_].threshold);
    }
    return find_next() ? pressure_for(next_.threshold.value()) : infinity<double>;
  }

  [[nodiscard]] const network& net() const noexcept { return *net_; }
  [[nodiscard]] const Rule& rule() const noexcept { return *rule_; }
  [[nodiscard]] const drainage_options& options() const noexcept { return options_; }
  [[nodiscard]] const two_phase_state& state() const noexcept { return state_; }
  [[nodiscard]] const std::vector<drainage_event>& events() const noexcept { return events_; }
  /// Liquid in the pores that are not reservoir when this drainage began [m³].
  [[nodiscard]] double initial_liquid() const noexcept { return initial_liquid_; }
  /// Liquid that left since [m³].
  [[nodiscard]] double drained_liquid() const noexcept { return drained_; }
  /// Void volume of the pores that are not reservoir [m³].
  [[nodiscard]] double void_volume() const noexcept { return void_volume_; }
  /// Liquid over void of the pores that are not reservoir.
  [[nodiscard]] double saturation() const noexcept { return (initial_liquid_ - drained_) / void_volume_; }
  /// Answers at the front that held no value, refused and failed, by their reason: gas did not pass. A throat is asked
  /// once where thresholds are fixed, and again each time its threshold may have moved.
  [[nodiscard]] const status_counts& without_value() const noexcept { return without_value_; }
  /// Whether trapping is computed in two passes.
  [[nodiscard]] bool in_two_passes() const noexcept { return two_passes_; }

 private:
  struct candidate {
    bracket<double> threshold{};
    throat_id throat;
    pore_id target;
  };
  struct planned {
    double threshold;
    pore_id pore;
    throat_id throat;
    std::uint32_t group;
  };
  static constexpr double no_key = infinity<double>;

  // set-up ------------------------------------------------------------------------------------------------------------

  void check_options() const {
    if (!state_.belongs_to(*net_)) {
      throw parameter_error("state", "the state of another network", "one of epoch " + std::to_string(net_->epoch()));
    }
    if (options_.inlet.empty()) {
      throw parameter_error("inlet", "no face", "at least one face");
    }
    if (options_.outlet.empty() && options_.trap != trapping::none) {
      throw parameter_error("outlet", "no face", "at least one face, or no trapping");
    }
    if (const face_set common = options_.inlet & options_.outlet; !common.empty()) {
      throw parameter_error("inlet and outlet", "both contain " + describe(common), "different faces");
    }
    if (!(options_.level_margin >= 0) || !std::isfinite(options_.level_margin)) {
      throw parameter_error("level_margin", short_number(options_.level_margin), "a finite number, 0 or more");
    }
  }

  /// Which of the given faces each pore touches, in linear passes.
  void place_reservoirs() {
    const network& net = *net_;
    state_.clear_reservoirs();
    face_set touched;
    const auto mark = [&](pore_id p, face f) {
      const bool in = options_.inlet.contains(f);
      const bool out = options_.outlet.contains(f);
      if (!in && !out) {
        return;
      }
      touched = touched | f;
      if (in) {
        state_.mark_inlet(p);
      } else {
        state_.mark_outlet(p);
      }
      if (state_.is_inlet(p) && state_.is_outlet(p)) {
        throw parameter_error("pore " + std::to_string(p.index()), "a pore that touches inlet and outlet",
                              "faces at least two pores apart");
      }
    };
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      const auto& vertices = net.vertices(pore_id(i));
      for (std::size_t k = 4; k-- > 0 && vertices[k].is_wall();) {
        mark(pore_id(i), vertices[k].wall());
      }
    }
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      if (net.is_boundary(throat_id(i))) {
        mark(net.pores(throat_id(i))[0], net.boundary_face(throat_id(i)));
      }
    }
    for (const face f : all_faces) {
      if ((options_.inlet.contains(f) || options_.outlet.contains(f)) && !touched.contains(f)) {
        throw parameter_error(options_.inlet.contains(f) ? "inlet" : "outlet",
                              std::string(describe(f)) + ", which no pore touches", "a face where the network ends");
      }
    }
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      const pore_id p(i);
      if (state_.is_outlet(p)) {
        state_.flood(p, net.void_volume(p));
      } else if (state_.is_inlet(p)) {
        if (state_.is_wet(p)) {
          state_.invade(p);
        }
      } else {
        initial_liquid_ += state_.liquid()[p];
        void_volume_ += net.void_volume(p);
      }
    }
    if (!(void_volume_ > 0)) {
      throw parameter_error("network", "no void between inlet and outlet", "pores that touch neither");
    }
  }

  void link_pores() {
    links_ = pore_links(*net_);
    if (options_.liquid_passes_closed_throats) {
      return;
    }
    for (std::size_t i = 0; i < net_->throat_count(); ++i) {
      if (rule_->threshold(*net_, state_, throat_id(i)).kind() == verdict::absent) {
        links_.close(throat_id(i), net_->throat_count());
      }
    }
  }

  void feed_inlet() {
    for (std::size_t i = 0; i < net_->pore_count(); ++i) {
      if (state_.is_inlet(pore_id(i))) {
        state_.mark_fed(pore_id(i));
      }
    }
    for (std::size_t i = 0; i < net_->pore_count(); ++i) {
      if (state_.is_inlet(pore_id(i))) {
        expose(pore_id(i));
      }
    }
  }

  // the front ---------------------------------------------------------------------------------------------------------

  /// Pore p is gas connected to the inlet: its throats to drainable pores come to the front, and gas behind its other
  /// throats is connected too.
  template <bool Asking = true>
  void expose(pore_id p) {
    newly_fed_.clear();
    newly_fed_.push_back(p);
    for (std::size_t head = 0; head < newly_fed_.size(); ++head) {
      const pore_id from = newly_fed_[head];
      if constexpr (Asking && requires { rule_->prefetch(throat_id{}); }) {
        for (const pore_link& l : links_.of(from)) {
          if (l.to.valid()) {
            rule_->prefetch(l.throat);
          }
        }
      }
      for (const auto& [to, t] : links_.of(from)) {
        if (!to.valid()) {
          continue;
        }
        if (state_.is_drainable(to)) {
          if constexpr (Asking) {
            ask(t, to);
          }
        } else if (state_.is_gas(to) && !state_.is_fed(to) &&
                   rule_->threshold(*net_, state_, t).kind() != verdict::absent) {
          state_.mark_fed(to);
          newly_fed_.push_back(to);
        }
      }
    }
  }

  /// Whether thresholds stand on the heap by their lower bounds until these come up.
  static constexpr bool by_bounds = Rule::depends_on_state && bounds_thresholds<Rule>;

  /// Whether an answer lets gas pass at some pressure; what is refused or failed is counted.
  [[nodiscard]] bool passes(const threshold_outcome& answer) {
    const verdict v = answer.kind();
    if (v == verdict::refused || v == verdict::failed) {
      without_value_.add(answer.reason);
    }
    return v == verdict::ok;
  }

  /// Asks for the threshold of a throat of the front, and puts it on the heap unless it is there as it is.
  void ask(throat_id t, pore_id target) {
    if constexpr (by_bounds) {
      const double bound = rule_->lower_bound(t);
      bounded_[t.index()] = 1;
      if (std::exchange(key_[t.index()], bound) != bound) {
        heap_.push({bound, t, target});
      }
      return;
    }
    const threshold_outcome answer = rule_->threshold(*net_, state_, t);
    const bool passable = passes(answer);
    if constexpr (Rule::depends_on_state) {
      reason_[t.index()] = answer.reason;
      const double key = passable ? answer.value.lo : no_key;
      if (std::exchange(key_[t.index()], key) == key) {
        return;
      }
    }
    if constexpr (!Rule::depends_on_state) {
      // Behind a lower threshold that is on the heap already, this one will never be passed.
      double& best = best_[target.index()];
      if (!passable || answer.value.lo > best) {
        return;
      }
      best = answer.value.hi < best ? answer.value.hi : best;
    }
    if (passable) {
      any_wide_ = any_wide_ || !answer.value.exact();
      heap_.push({answer.value.lo, t, target});
    }
  }

  /// Gas took p: what that changes at the front.
  void advance_front(pore_id p) {
    state_.mark_fed(p);
    if constexpr (Rule::depends_on_state) {
      touched_.clear();
      rule_->touched_by(*net_, state_, p, touched_);
    }
    expose(p);
    if constexpr (Rule::depends_on_state) {
      for (const throat_id t : touched_) {
        const auto& [a, b] = net_->pores(t);
        if (b.valid() && state_.is_fed(a) && state_.is_drainable(b)) {
          ask(t, b);
        } else if (b.valid() && state_.is_fed(b) && state_.is_drainable(a)) {
          ask(t, a);
        }
      }
    }
  }

  /// Drops what no longer holds from the top of the heap; false when the heap is empty then.
  [[nodiscard]] bool clean_top() {
    while (!heap_.empty()) {
      const detail::front_entry e = heap_.top();
      bool holds = state_.is_drainable(e.target);
      if constexpr (Rule::depends_on_state) {
        holds = holds && key_[e.throat.index()] == e.key;
      }
      if constexpr (by_bounds) {
        if (holds && std::exchange(bounded_[e.throat.index()], std::uint8_t{0}) != 0) {
          const threshold_outcome answer = rule_->threshold(*net_, state_, e.throat);
          const bool passable = passes(answer);
          const double key = passable ? answer.value.lo : no_key;
          reason_[e.throat.index()] = answer.reason;
          key_[e.throat.index()] = key;
          any_wide_ = any_wide_ || (passable && !answer.value.exact());
          holds = key == e.key;
          if (passable && !holds) {
            heap_.pop();
            heap_.push({key, e.throat, e.target});
            continue;
          }
        }
      }
      if (holds) {
        return true;
      }
      heap_.pop();
    }
    return false;
  }

  /// Makes sure that next_ is the throat to be passed next, off the heap; false when there is none.
  [[nodiscard]] bool find_next() {
    if (next_.target.valid()) {
      if (state_.is_drainable(next_.target)) {
        return true;
      }
      next_ = {};
    }
    if (!clean_top()) {
      return false;
    }
    if (any_wide_) {
      choose_among_brackets();
    } else {
      const detail::front_entry e = heap_.top();
      links_.prefetch(e.target);
      heap_.pop();
      next_ = {bracket<double>::exactly(e.key), e.throat, e.target};
    }
    return true;
  }

  /// Takes all candidates off the heap whose bracket overlaps the lowest one, lets the rule settle them, and repeats
  /// until a single one is left or nothing narrows any more; then the least value decides, and the lower id among
  /// equals.
  void choose_among_brackets() {
    for (;;) {
      rivals_.clear();
      double least_hi = infinity<double>;
      while (clean_top() && heap_.top().key < least_hi) {
        const detail::front_entry e = heap_.top();
        heap_.pop();
        const bracket<double> b = rule_->threshold(*net_, state_, e.throat).value;
        rivals_.push_back({b, e.throat, e.target});
        least_hi = b.hi < least_hi ? b.hi : least_hi;
      }
      if (rivals_.empty()) {
        // Every bracket was a point, and equal ones are told apart by the order of the heap.
        const detail::front_entry e = heap_.top();
        heap_.pop();
        next_ = {bracket<double>::exactly(e.key), e.throat, e.target};
        return;
      }
      bool narrowed = false;
      if (rivals_.size() > 1) {
        asked_.clear();
        for (const candidate& c : rivals_) {
          asked_.push_back(c.throat);
        }
        rule_->settle(*net_, state_, asked_);
        for (candidate& c : rivals_) {
          const bracket<double> now = rule_->threshold(*net_, state_, c.throat).value;
          narrowed = narrowed || now != c.threshold;
          c.threshold = now;
        }
      }
      std::size_t best = 0;
      for (std::size_t k = 1; k < rivals_.size(); ++k) {
        const double a = rivals_[k].threshold.value();
        const double b = rivals_[best].threshold.value();
        const bool tie = a == b && rivals_[best].throat > rivals_[k].throat;
        best = a < b || tie ? k : best;
      }
      for (std::size_t k = 0; k < rivals_.size(); ++k) {
        if (narrowed || k != best) {
          const candidate& c = rivals_[k];
          if constexpr (Rule::depends_on_state) {
            key_[c.throat.index()] = c.threshold.lo;
          }
          heap_.push({c.threshold.lo, c.throat, c.target});
        }
      }
      if (!narrowed) {
        next_ = rivals_[best];
        return;
      }
    }
  }

  // events ------------------------------------------------------------------------------------------------------------

  [[nodiscard]] bool opens_level(double threshold) const noexcept {
    return state_.level() == 0 || threshold > state_.pressure();
  }
  [[nodiscard]] double pressure_for(double threshold) const noexcept {
    return opens_level(threshold) ? threshold * (1 + options_.level_margin) : state_.pressure();
  }

  void record(pore_id p, throat_id t, double threshold, entry_status reason) {
    if (opens_level(threshold)) {
      state_.open_level(pressure_for(threshold));
    }
    const double volume = state_.invade(p);
    drained_ += volume;
    events_.push_back({p, t, state_.pressure(), threshold, volume, state_.level(), reason});
  }

  // trapping ----------------------------------------------------------------------------------------------------------

  void prepare_trapping() {
    const bool mid_level = options_.trap == trapping::per_level && state_.level() > 0 && find_next() &&
                           next_.threshold.value() <= state_.pressure();
    const bool exact =
        !Rule::depends_on_state && !mid_level && (options_.trap == trapping::per_event || options_.level_margin == 0);
    if (options_.method == trapping_method::two_passes && !exact) {
      throw parameter_error(
          "trapping method", "two passes",
          "the live method: two passes are exact only where thresholds do not depend on the state, and "
          "for trapping per level only without a margin and from the end of a level");
    }
    two_passes_ = exact && options_.method != trapping_method::live;
    live_ = !two_passes_;
    if (two_passes_) {
      plan_two_passes();
      return;
    }
    search_ = live_trapping(net_->pore_count());
    search_all_ = mid_level;
    if (!mid_level) {
      search_.find_initial(state_, links_, cut_off_);
      trap_found();
    }
  }

  void trap_found() {
    cut_off_.sort();
    for (std::size_t k = 0; k < cut_off_.size(); ++k) {
      state_.trap(cut_off_.pores(k));
    }
    cut_off_.clear();
  }

  void trap_live(pore_id taken) {
    in_level_.push_back(taken);
    if (options_.trap == trapping::per_level && find_next() && !opens_level(next_.threshold.value())) {
      return;
    }
    if (std::exchange(search_all_, false)) {
      search_.find_initial(state_, links_, cut_off_);
    } else {
      search_.find(state_, links_, in_level_, cut_off_);
    }
    in_level_.clear();
    trap_found();
  }

  /// The whole invasion without trapping, on the phase marks alone; then backwards.
  void plan_two_passes() {
    std::vector<pore_id> sequence;
    std::vector<planned> all;
    std::vector<std::uint32_t> group_end;
    std::vector<pore_id> unfed;
    sequence.reserve(net_->pore_count());
    all.reserve(net_->pore_count());
    group_end.reserve(net_->pore_count());
    for (std::size_t i = 0; i < net_->pore_count(); ++i) {
      const pore_id p(i);
      if (state_.is_gas(p) && !state_.is_fed(p)) {
        unfed.push_back(p);
      }
    }
    old_gas_ = !unfed.empty();
    double running = state_.level() == 0 ? -infinity<double> : state_.pressure();
    while (find_next()) {
      const candidate taken = std::exchange(next_, candidate{});
      const double threshold = taken.threshold.value();
      const auto count = static_cast<std::uint32_t>(sequence.size() + 1);
      if (options_.trap == trapping::per_event || threshold > running || group_end.empty()) {
        group_end.push_back(count);
      } else {
        group_end.back() = count;
      }
      running = threshold > running ? threshold : running;
      all.push_back({threshold, taken.target, taken.throat, static_cast<std::uint32_t>(group_end.size())});
      sequence.push_back(taken.target);
      state_.mark_gas(taken.target);
      advance_front(taken.target);
    }
    std::vector<std::uint8_t> kept;
    trap_backwards(state_, links_, sequence, group_end, kept, cut_off_);
    for (const pore_id p : sequence) {
      state_.mark_wet(p);
    }
    for (const pore_id p : unfed) {
      state_.mark_unfed(p);
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (kept[k] != 0) {
        plan_.push_back(all[k]);
      }
    }
    trap_planned(0);
    events_.reserve(plan_.size());
  }

  /// The planned sets that are cut off after this group.
  void trap_planned(std::uint32_t group) {
    for (; done_sets_ < cut_off_.size() && cut_off_.time(done_sets_) <= group; ++done_sets_) {
      state_.trap(cut_off_.pores(done_sets_));
    }
  }

  bool replay() {
    if (done_ == plan_.size()) {
      return false;
    }
    const planned& e = plan_[done_++];
    if (constexpr std::size_t ahead = 8; done_ + ahead < plan_.size()) {
      state_.prefetch(plan_[done_ + ahead].pore);
    }
    const entry_status reason = rule_->threshold(*net_, state_, e.throat).reason;
    record(e.pore, e.throat, e.threshold, reason);
    state_.mark_fed(e.pore);
    if (old_gas_) {
      expose<false>(e.pore);
    }
    if (done_ == plan_.size() || plan_[done_].group != e.group) {
      trap_planned(e.group);
    }
    return true;
  }

  const network* net_;
  Rule* rule_;
  drainage_options options_;
  two_phase_state state_;
  std::vector<drainage_event> events_;
  double initial_liquid_ = 0;
  double void_volume_ = 0;
  double drained_ = 0;

  detail::front_heap heap_;
  status_counts without_value_;
  candidate next_;
  bool any_wide_ = false;
  std::vector<double> best_;           ///< fixed rules: upper end of the lowest threshold that leads into each pore
  std::vector<double> key_;            ///< state-dependent rules: the key that holds for each throat of the front
  std::vector<entry_status> reason_;   ///< and its reason
  std::vector<std::uint8_t> bounded_;  ///< and whether the key is only a lower bound
  std::vector<pore_id> newly_fed_;
  std::vector<throat_id> touched_;
  std::vector<candidate> rivals_;
  std::vector<throat_id> asked_;

  bool two_passes_ = false;
  bool live_ = false;
  bool search_all_ = false;
  bool old_gas_ = false;  ///< there was gas that the inlet did not feed
  pore_links links_;
  live_trapping search_;
  cut_off_sets cut_off_;
  std::vector<pore_id> in_level_;
  std::vector<planned> plan_;
  std::size_t done_ = 0;
  std::size_t done_sets_ = 0;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
