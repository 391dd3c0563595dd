// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/bridges.hpp"
#include "tetrapore/law/bridge/liquid.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <iomanip>
#include <istream>
#include <ostream>
#include <string>

/// \file
/// Lives of a bridge, step by step: stretched, compressed, filled, drained, ruptured and made again at random, with
/// the books of energy and liquid that a discrete-element model keeps. Any step is small or large; the warm solve of
/// each is compared with the cold one, and its work comes from a Gauss rule along the step.

namespace bridges {

/// Free energy over surface tension of liquid alone on one surface: a cap of a sphere with the contact angle, and
/// where that is 0 a film around the grain (on a plane one without end, of no energy).
[[nodiscard]] inline double drop_energy(double radius, double theta, double volume) {
  const auto less_cosine = [](double x) { return 2 * std::sin(x / 2) * std::sin(x / 2); };
  const auto cap = [&](double r, double angle) {
    const double c = less_cosine(angle);
    return pi<double> / 3 * r * r * r * c * c * (3 - c);
  };
  if (!(volume > 0)) {
    return 0;
  }
  if (std::isinf(radius)) {
    const double r = theta > 0 ? std::cbrt(volume / cap(1, theta)) : 0.0;
    return pi<double> * r * r * (2 * less_cosine(theta) - std::cos(theta) * std::sin(theta) * std::sin(theta));
  }
  if (theta == 0) {
    const double outer = std::cbrt(radius * radius * radius + 0.75 * volume / pi<double>);
    return 4 * pi<double> * (outer - radius) * (outer + radius);
  }
  double low = 0;  // filling angle
  double high = pi<double> - theta;
  double drop = 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    drop = radius * std::sin(middle) / std::sin(middle + theta);
    (cap(drop, middle + theta) - cap(radius, middle) < volume ? low : high) = middle;
  }
  return 2 * pi<double> *
         (drop * drop * less_cosine(low + theta) - std::cos(theta) * radius * radius * less_cosine(low));
}

/// What many steps have shown.
struct tally {
  std::uint64_t lives = 0;
  std::uint64_t steps = 0;
  std::uint64_t present = 0;             ///< steps that end with a bridge
  std::uint64_t fillings = 0;            ///< steps that change volume or suction
  std::uint64_t evaluations = 0;         ///< warm solves, those of the Gauss rules among them
  std::uint64_t made = 0;                ///< at contact
  std::uint64_t folded = 0;              ///< ruptured at a fold
  std::uint64_t lopsided = 0;            ///< ruptured because the liquid slid to one side
  std::uint64_t let_go = 0;              ///< folded, and the neck parts the liquid as its energy does not allow
  std::uint64_t cycles = 0;              ///< closed, without rupture
  std::uint64_t other_status = 0;        ///< warm and cold solve differ, or a gap does not end as its rupture gap says
  std::uint64_t refused = 0;             ///< neither a bridge nor absent, though asked within the domain
  std::uint64_t gains = 0;               ///< ruptures or bridges made that gave energy
  double force_error = 0;                ///< of the warm solve against the cold, over the error that the law states
  double cycle_error = 0;                ///< work around a cycle over the sum of its parts
  double ledger_error = 0;               ///< work − energy gained − booked, over the sum of all parts: of a life
  double liquid_error = 0;               ///< liquid at the end less that at the start and what was added, relative
  double least_loss = infinity<double>;  ///< of energy by a rupture, over surface tension × volume^(2/3)
  double largest_loss = 0;

  template <class Self, class F>
  static void each(Self& t, F&& f) {
    f("lives", t.lives);
    f("steps", t.steps);
    f("steps_with_bridge", t.present);
    f("steps_of_volume_or_suction", t.fillings);
    f("warm_solves", t.evaluations);
    f("bridges_made", t.made);
    f("ruptures_at_fold", t.folded);
    f("ruptures_lopsided", t.lopsided);
    f("ruptures_parted_otherwise_than_at_the_neck", t.let_go);
    f("closed_cycles", t.cycles);
    f("wrong_status", t.other_status);
    f("refused", t.refused);
    f("gains_of_energy", t.gains);
    f("warm_against_cold_over_stated_error", t.force_error);
    f("cycle_work_defect", t.cycle_error);
    f("ledger_defect", t.ledger_error);
    f("liquid_defect", t.liquid_error);
    f("least_loss_over_tension_area", t.least_loss);
    f("largest_loss_over_tension_area", t.largest_loss);
  }

  void save(std::ostream& out) const {
    out << std::hexfloat;
    each(*this, [&](const char*, const auto& x) { out << x << ' '; });
  }
  [[nodiscard]] bool load(std::istream& in) {
    each(*this, [&](const char*, auto& x) {
      std::string word;
      in >> word;
      if constexpr (std::is_same_v<std::remove_reference_t<decltype(x)>, double>) {
        x = std::strtod(word.c_str(), nullptr);
      } else {
        x = std::strtoull(word.c_str(), nullptr, 10);
      }
    });
    return static_cast<bool>(in);
  }
};

/// What any number of steps must have shown.
inline void check(const tally& t) {
  CHECK(t.other_status == 0);
  CHECK(t.refused == 0);
  CHECK(t.gains == 0);
  CHECK(t.least_loss > 0);
  CHECK(t.force_error <= 1);
  CHECK(t.cycle_error < 1e-9);
  CHECK(t.ledger_error < 1e-9);
  CHECK(t.liquid_error < 2e-14);  // a rounding for each of 200 steps
  CHECK(t.present > t.steps / 2);
  CHECK(t.fillings > t.steps / 20);
  CHECK(t.folded > t.steps / 200);
  CHECK(t.lopsided > t.steps / 4000);
  CHECK(t.made > t.steps / 200);
  CHECK(t.cycles > t.steps / 200);
}

/// One pair and its bridge. Under a volume the energy is that of the surfaces and dE = F dgap − p dV; under a suction
/// it is E + p V, whose changes are F dgap + V dp, and a ruptured bridge drains to what holds the suction.
class life {
 public:
  explicit life(std::uint64_t seed, tally& t) : random_(static_cast<unsigned>(seed)), t_(t) {
    do {
      const auto c = random_.next();
      e_ = c.e;
      e_.gap = 0;
      small_ = std::min(e_.radius1, e_.radius2);
      law_ = law_of(c.theta1, c.theta2);
      by_volume_ = random_.uniform(0, 1) < 0.6;
      value_ = by_volume_ ? c.volume : std::pow(10.0, random_.uniform(-1, 3)) / small_;
      if (!by_volume_ && random_.uniform(0, 1) < 0.1) {
        value_ = -0.2 * std::min(std::cos(c.theta1), std::cos(c.theta2)) / small_;
      }
    } while (!find_limit() || !cold().ok());
    pushed_ = value_ < 0;
    overlap_ = !pushed_ && random_.uniform(0, 1) < 0.5 ? std::min(0.02 * small_, 0.05 * limit_.gap) : 0.0;
    liquid_ = value_;
    pair_.present = true;
    const auto b = solve(e_.gap, value_, warm_);
    energy_ = first_ = energy_at(e_.gap, b.value);
  }

  void run(int steps) {
    const std::uint64_t end = t_.steps + static_cast<std::uint64_t>(steps);
    while (t_.steps < end) {
      const int count = static_cast<int>(std::min<std::uint64_t>(end - t_.steps, 20));
      if (pushed_ || (pair_.present && random_.uniform(0, 1) < 0.6)) {
        cycle(count);
      } else {
        wander(count);
      }
    }
    const double all = stretched_ + std::abs(lost_) + std::abs(gained_);
    if (!(all <= 0)) {
      worst(t_.ledger_error, std::abs(work_ - (energy_ - first_) - lost_ - gained_) / all);
    }
    if (by_volume_) {
      const double here = pair_.present ? value_ : parts_[0] + parts_[1];
      worst(t_.liquid_error, std::abs(here - liquid_) / liquid_);
    }
    ++t_.lives;
  }

 private:
  using answer = outcome<meniscus<double>, bridge_status>;

  random_pairs random_;
  tally& t_;
  young_laplace<> law_{1.0};
  edge<double> e_{};
  double small_ = 1;
  bool by_volume_ = true;
  double value_ = 0;     ///< volume or suction
  bool pushed_ = false;  ///< by a reservoir under pressure: a rupture would not end its flow, and is left out
  double overlap_ = 0;
  bridge_limit<double> limit_{};
  bridge_presence<double> pair_{};
  young_laplace<>::warm_state<double> warm_{};
  std::array<double, 2> parts_{};  ///< liquid on either surface after a rupture
  double liquid_ = 0;              ///< in the pair at the start, and added
  double energy_ = 0;
  double first_ = 0;
  double work_ = 0;
  double stretched_ = 0;  ///< absolute work
  double lost_ = 0;       ///< by ruptures
  double gained_ = 0;     ///< by making: lost as well

  static void worst(double& of, double x) { of = x > of || std::isnan(x) ? x : of; }

  [[nodiscard]] edge<double> at(double gap) const {
    edge<double> e = e_;
    e.gap = gap;
    return e;
  }
  [[nodiscard]] answer solve(double gap, double value, young_laplace<>::warm_state<double>& w) {
    ++t_.evaluations;
    return by_volume_ ? pair_.bridge(law_, at(gap), given_volume<double>{value}, w)
                      : pair_.bridge(law_, at(gap), given_suction<double>{value}, w);
  }
  [[nodiscard]] answer law_at(double gap, double value, young_laplace<>::warm_state<double>& w) {
    ++t_.evaluations;
    return by_volume_ ? law_.bridge(at(gap), given_volume<double>{value}, w)
                      : law_.bridge(at(gap), given_suction<double>{value}, w);
  }
  [[nodiscard]] answer cold() const {
    return by_volume_ ? law_.bridge(e_, given_volume<double>{value_}) : law_.bridge(e_, given_suction<double>{value_});
  }
  [[nodiscard]] bool find_limit() {
    const auto l = by_volume_ ? law_.rupture_gap(e_, given_volume<double>{value_})
                              : law_.rupture_gap(e_, given_suction<double>{value_});
    limit_ = l.value;
    return l.ok();
  }
  [[nodiscard]] double energy_at(double gap, const meniscus<double>& m) const {
    return law_.energy(at(gap), m) + (by_volume_ ? 0.0 : m.suction * m.volume);
  }
  [[nodiscard]] double energy_of_parts() const {
    return by_volume_ ? drop_energy(e_.radius1, law_.contact_angle1, parts_[0]) +
                            drop_energy(e_.radius2, law_.contact_angle2, parts_[1])
                      : 0.0;
  }

  /// Work by a rule of 8 nodes from one gap and value to another, halved where it is not settled; to the rupture, F
  /// goes with the root of the distance: there the nodes are those of its square.
  struct stretch {
    double gap0, gap1, value0, value1;
    bool to_rupture;
  };
  [[nodiscard]] double rule(const stretch& s, double from, double to, young_laplace<>::warm_state<double>& w) {
    const auto& gauss = detail::gauss<double, 4>;
    double sum = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t j = k < 4 ? 3 - k : k - 4;
      const double t = from + (to - from) * 0.5 * (k < 4 ? 1 - gauss.node[j] : 1 + gauss.node[j]);
      const double share = s.to_rupture ? t * (2 - t) : t;
      const double rate = s.to_rupture ? 2 * (1 - t) : 1;
      const auto b = law_at(s.gap0 + share * (s.gap1 - s.gap0), s.value0 + share * (s.value1 - s.value0), w);
      if (!b.ok()) {
        return quiet_nan<double>;
      }
      const double by_value = by_volume_ ? -b.value.suction : b.value.volume;
      sum += 0.5 * gauss.weight[j] * rate * (b.value.force * (s.gap1 - s.gap0) + by_value * (s.value1 - s.value0));
    }
    return sum * (to - from);
  }
  [[nodiscard]] double work_of(const stretch& s, double from, double to, double whole, int depth,
                               young_laplace<>::warm_state<double>& w) {
    const double middle = 0.5 * (from + to);
    const double first = rule(s, from, middle, w);
    const double second = rule(s, middle, to, w);
    if (std::isnan(first + second) || depth == 0 || std::abs(first + second - whole) <= 1e-12 * std::abs(whole)) {
      return first + second;
    }
    return work_of(s, from, middle, first, depth - 1, w) + work_of(s, middle, to, second, depth - 1, w);
  }
  [[nodiscard]] double work_of(const stretch& s) {
    auto along = warm_;
    const double whole = rule(s, 0, 1, along);
    // towards the rupture no node comes nearer to it than 1e-12 of its gap
    const double nearest = 0.0199 * std::sqrt(std::abs(s.gap1 - s.gap0) / limit_.gap * 1e12);
    const int depth = s.to_rupture ? std::min(std::max(static_cast<int>(std::log2(nearest)) - 1, 0), 10) : 10;
    const bool tiny = std::abs(s.gap1 - s.gap0) < 1e-3 * limit_.gap &&
                      std::abs(s.value1 - s.value0) < 1e-3 * std::abs(s.value0) && !s.to_rupture;
    const double w = tiny ? whole : work_of(s, 0, 1, whole, depth, along);
    work_ += w;
    stretched_ += std::abs(w);
    return w;
  }

  /// Compares the warm solve of where the pair is with the cold one.
  void compare(const answer& b) {
    const answer c = cold();
    ++t_.steps;
    t_.other_status += b.reason != c.reason ? 1U : 0U;
    t_.refused += b.kind() != verdict::ok && b.kind() != verdict::absent ? 1U : 0U;
    if (b.ok() && c.ok()) {
      const auto s = law_.stiffness(e_, c.value);
      const double kappa = std::max(1e-12, 16 * rounding_of_request(s, c.value, e_.gap, by_volume_));
      const double parts = 2 * pi<double> * std::max(c.value.contact1, c.value.contact2);
      worst(t_.force_error,
            std::abs(b.value.force - c.value.force) / (2 * kappa * std::abs(c.value.force) + 1e-14 * parts));
    }
  }
  answer check() {
    const answer b = solve(e_.gap, value_, warm_);
    t_.present += b.ok() ? 1U : 0U;
    compare(b);
    return b;
  }

  /// A step that keeps the bridge.
  double go(double gap, double value) {
    const double w = work_of({e_.gap, gap, value_, value, false});
    if (by_volume_) {
      liquid_ += value - value_;
    }
    e_.gap = gap;
    value_ = value;
    const answer b = check();
    t_.other_status += b.ok() ? 0U : 1U;
    energy_ = energy_at(gap, b.value);
    return w;
  }

  [[nodiscard]] double step_size() {
    const double size = random_.uniform(0, 1) < 0.6 ? std::pow(10.0, random_.uniform(-12, -1)) : random_.uniform(0, 1);
    return random_.uniform(0, 1) < 0.5 ? size : -size;
  }

  /// Around a closed cycle within 0.98 of the rupture gap, with changes of volume or suction.
  void cycle(int count) {
    const double gap = e_.gap;
    const double value = value_;
    const bridge_limit<double> limit = limit_;
    if (gap > 0.98 * limit.gap) {
      wander(count);
      return;
    }
    double around = 0;
    double parts = 0;
    for (int i = 0; i < count; ++i) {
      const double held = value_;
      const bridge_limit<double> held_limit = limit_;
      double next = i + 1 == count ? value : value_;
      if (i + 1 < count && random_.uniform(0, 1) < 0.3) {
        const double factor = 1 + 0.2 * step_size();
        const double least = pushed_ ? value : 0.7 * value;
        next = std::min(std::max(value_ * factor, least), (pushed_ ? 0.7 : 1.4) * value);
      }
      double room = held_limit.gap;
      if (next != held) {
        ++t_.fillings;
        value_ = next;
        t_.other_status += find_limit() ? 0U : 1U;
        room = std::min(room, limit_.gap);
        value_ = held;
      }
      double target = i + 1 == count ? gap : e_.gap + step_size() * room;
      if (i + 1 < count) {
        target = std::min(std::max(target, -overlap_), 0.98 * room);
        if (e_.gap > 0.98 * room) {  // first nearer, then drier
          next = held;
          limit_ = held_limit;
        }
      }
      if (i + 1 == count && std::max(e_.gap, gap) > 0.98 * std::min(room, limit.gap)) {
        const double w = go(std::min(e_.gap, gap), value_);
        around += w;
        parts += std::abs(w);
      }
      const double w = go(target, next);
      around += w;
      parts += std::abs(w);
    }
    limit_ = limit;
    ++t_.cycles;
    worst(t_.cycle_error, parts > 0 ? std::abs(around) / parts : 0.0);
  }

  /// Anywhere, beyond the rupture and back to contact.
  void wander(int count) {
    for (int i = 0; i < count; ++i) {
      double gap = e_.gap + (pair_.present ? step_size() : random_.uniform(-1.5, 0.5)) * limit_.gap;
      if (random_.uniform(0, 1) < 0.1) {  // next to the rupture, on either side
        gap = limit_.gap * (1 + (random_.uniform(0, 1) < 0.5 ? 1 : -1) * std::pow(10.0, random_.uniform(-6, -2)));
      }
      gap = std::min(std::max(gap, -overlap_), 2 * limit_.gap);
      if (!pair_.present) {
        if (gap > pair_.creation_gap) {
          e_.gap = gap;
          compare(law_at(gap, value_, warm_));  // what the law would say if there were one
          continue;
        }
        make();
      } else if (gap > limit_.gap) {
        rupture(gap);
        continue;
      }
      static_cast<void>(go(gap, value_));
    }
  }

  void make() {
    e_.gap = pair_.creation_gap;
    if (by_volume_) {
      value_ = parts_[0] + parts_[1];
    }
    const answer b = solve(e_.gap, value_, warm_);
    t_.other_status += b.ok() ? 0U : 1U;
    const double now = energy_at(e_.gap, b.value);
    gained_ += now < energy_ ? energy_ - now : 0.0;
    lost_ += now < energy_ ? 0.0 : energy_ - now;
    t_.gains += now < energy_ ? 0U : 1U;
    energy_ = now;
    ++t_.made;
  }

  void rupture(double gap) {
    if (const double rest = limit_.gap - e_.gap; rest > 1e-8 * limit_.gap) {
      static_cast<void>(work_of({e_.gap, limit_.gap, value_, value_, true}));
    } else {  // too near for nodes between: F goes with the root of the distance
      const double force = law_at(e_.gap, value_, warm_).value.force;
      work_ += rest * (2 * force + limit_.last.force) / 3;
      stretched_ += std::abs(rest * force);
    }
    const double before = energy_at(limit_.gap, limit_.last);
    const bool fold = limit_.end == bridge_end::fold;
    if (by_volume_) {
      parts_ = fold ? law_.halves(at(limit_.gap), limit_.last) : std::array<double, 2>{value_, 0.0};
      worst(t_.liquid_error, std::abs(parts_[0] + parts_[1] - value_) / value_);
    }
    energy_ = energy_of_parts();
    if (by_volume_ && fold && energy_ > before) {
      // no rupture can part the liquid so: the surface that it wets less lets go of it
      const std::size_t keeps = parts_[0] > parts_[1] ? 0 : 1;
      parts_[keeps] = value_;
      parts_[1 - keeps] = 0;
      energy_ = energy_of_parts();
      ++t_.let_go;
    }
    const double loss = before - energy_;
    lost_ += loss;
    t_.gains += loss > 0 ? 0U : 1U;
    const double volume = limit_.last.volume;
    const double share = loss / std::cbrt(volume * volume);
    t_.least_loss = std::min(t_.least_loss, share);
    t_.largest_loss = std::max(t_.largest_loss, share);
    (fold ? t_.folded : t_.lopsided) += 1;
    e_.gap = gap;
    const answer b = check();
    t_.other_status += b.reason == (fold ? bridge_status::ruptured : bridge_status::lopsided) ? 0U : 1U;
  }
};

}  // namespace bridges
