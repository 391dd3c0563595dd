// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/inscribed_circle.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/law/entry/mirror_sided.hpp"
#include "tetrapore/lbm/calibration.hpp"
#include "tetrapore/lbm/held_fluids.hpp"
#include "tetrapore/lbm/measured_pair.hpp"
#include "tetrapore/lbm/measurement.hpp"
#include "tetrapore/lbm/throat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

/// \file
/// Entry pressure of a throat by experiment: gas above, wetting liquid below, a capillary pressure that is held until
/// the meniscus rests or has passed.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// The pair of the throats: G = 1.8 leaves an interface of 2.9 nodes and slow spurious currents. Its tension is that of
/// a bubble of 17.4 nodes, p_c shared between gas and liquid, and the unit of every entry pressure that is kept; the
/// table of measured mixtures says 0.2 % less.
inline constexpr calibrated_pair pair_18{1.8, 1.003, 1.99526, 0.5, 0.0877};

/// Contact angles above 0 at which entry pressures were compared with Surface Evolver. \par Units  θ [rad]
[[nodiscard]] constexpr bool entry_angle_measured(double contact_angle) noexcept {
  constexpr double degree = pi<double> / 180;
  return contact_angle > 9.9 * degree && contact_angle < 60.1 * degree;
}

/// What an entry pressure measured with r_in nodes is to be multiplied by: films and interfaces of finite width. 1 at
/// angles that were not measured.
/// \par Units     θ [rad]
/// \par Domain    grains retracted as entry_retraction says, the pair of G = 1.8; r_in from 2 nodes
/// \par Accuracy  see entry_error. Calibrated on three equal spheres against their Surface Evolver values: θ = 0 on
///                touching ones at r_in = 2.5 to 8.5 nodes, above 0 on touching ones and gaps of 0.4 R at θ = 20
///                and 40° and r_in = 2 to 6
[[nodiscard]] constexpr double entry_correction(double inscribed, double contact_angle = 0) noexcept {
  if (contact_angle == 0) {
    return 1 + (0.12 + 0.6 / inscribed) / inscribed;
  }
  return entry_angle_measured(contact_angle) ? 1 + (-0.25 + 1.03 / inscribed) / inscribed : 1;
}

/// What is left of the error behind correction and retraction, relative: the largest over throats that they were not
/// calibrated on, against Surface Evolver or, unequal grains, the least plane value.
/// \par Units     θ [rad]
/// \par Accuracy  θ = 0 (gaps 0.2 and 0.4 R, unequal grains): largest found 4.2 % from r_in = 4 to 8.5 nodes, 5.3 % at
///                3, 14 % at 2 to 2.5. θ = 10 to 40° (equal spheres, docs/campaigns/throat_angles.json): 4.2 % from
///                r_in = 4 to 6, those it was calibrated on included, 6.3 % at 2 and 3. θ = 60°: 9 % at 4, 6.1 % at 5
///                nodes. A bracket's half width comes on top. NaN at angles that were not measured: between 0 and 10°
///                and above 60°
[[nodiscard]] constexpr double entry_error(double inscribed, double contact_angle = 0) noexcept {
  constexpr double fine = 4;  // nodes
  if (contact_angle == 0) {
    return inscribed < fine ? 0.05 * fine * fine / (inscribed * inscribed) : 0.05;
  }
  constexpr double large_angle = 45 * pi<double> / 180;
  const double coarse = inscribed < fine * (1 - 1e-9) ? 0.09 : 0.05;
  return !entry_angle_measured(contact_angle) ? quiet_nan<double> : contact_angle > large_angle ? 0.12 : coarse;
}

/// Nodes by which grains shrink so that walls, and at θ = 0 the film on them, are where they should be.
/// \par Accuracy  θ = 0: that of entry_correction. Above, touching spheres and those with gaps of 0.4 R at θ = 40°,
///                r_in = 4 nodes, are right in the mean: +7.9, −0.7 and −8.2 % at 0.25, 0.5 and 0.75 nodes
[[nodiscard]] constexpr double entry_retraction(double contact_angle) noexcept { return contact_angle > 0 ? 0.5 : 1.1; }

/// What an entry experiment is made of.
/// \par Units  lattice units but where said
struct entry_set_up {
  opening<double> throat;              ///< three discs, in any unit of length
  std::array<prism_side, 3> sides{};   ///< that between discs k and k + 1
  double nodes_per_length = 1;         ///< nodes per unit of the throat
  std::optional<double> retraction{};  ///< nodes by which grains shrink; none: `entry_retraction` of the angle
  double clear = 0.7;                  ///< how far the upper reservoir lies at most, in radii of the largest grain
  double plug = 4;                     ///< nodes that it keeps from grains and wetting sides
  double contact_angle = 0;            ///< [rad]
  calibrated_pair pair = pair_18;
  double tau = 1;          ///< relaxation time of both fluids, that of the pair
  double gas_share = 0.5;  ///< of p_c that raises the gas; the rest lowers the liquid
  bool halved = true;      ///< a throat that is its own mirror image is solved by one half
  bool fitted = true;      ///< radii shift so that the neck has as many nodes as it has volume
  std::size_t most_nodes = 1000000;
  double patience =
      3500;  ///< steps per node of r_in (4 at least) after which a hold creeps, if not `rules.most_steps` before
  hold_rules rules{};
};

/// Whether a set-up is the one that entry_correction and entry_error were measured with, but for throat, angle and
/// resolution: the default model, pair, τ, retraction and reservoirs, radii to be fitted, no wetting sides. That the
/// radii could be fitted the lattice says (`throat_on_lattice::fitted`).
template <class Model = mixture<d3q19, bgk>>
[[nodiscard]] bool entry_calibrated(const entry_set_up& s) noexcept {
  const entry_set_up usual{};
  const auto same_pair = [](const calibrated_pair& a, const calibrated_pair& b) {
    return a.attraction == b.attraction && a.main == b.main && a.factor == b.factor && a.common == b.common &&
           a.surface_tension == b.surface_tension;
  };
  return std::is_same_v<Model, mixture<d3q19, bgk>> && same_pair(s.pair, usual.pair) && s.tau == usual.tau &&
         s.sides == usual.sides && !s.retraction && s.clear == usual.clear && s.plug == usual.plug &&
         s.gas_share == usual.gas_share && s.fitted;
}

/// The plane picture of a throat: what the experiment is compared with, and its first bracket.
/// \par Units  of the throat: length, 1/length for pressures per surface tension
struct plane_entry {
  double inscribed;  ///< radius of the inscribed circle
  double princen;    ///< p/σ of Mayer, Stowe & Princen: arcs in all gaps
  double best;       ///< p/σ, the least over all choices of gaps that the gas may cross
};

/// The section of a throat in the plane of the centres: a line from centre to centre for each wetting side.
/// \param open  bit k: gas may cross the gap after disc k, whose side is a mirror
[[nodiscard]] inline opening<double> section_of(const opening<double>& discs, const std::array<prism_side, 3>& sides,
                                                unsigned open) noexcept {
  opening<double> o;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& disc = discs.sides[k];
    o.add_disc(disc.point, disc.radius, (open >> k & 1U) != 0 ? gap_state::open : discs.gaps[k]);
    if (sides[k] == prism_side::wetting) {
      const vec2<double> along = discs.sides[discs.next(k)].point - disc.point;
      o.add_line(disc.point, vec2<double>{-along.y, along.x} * (1 / norm(along)));
    }
  }
  return o;
}

/// A side of wetting liquid is a wall to the gas: an arc ends on it where the gap is too wide for one from grain to
/// grain, and gas does not cross it. So no such side lowers the least value.
/// \par Domain  wetting sides have the throat's contact angle here. On the lattice theirs is 0, which at θ > 0 holds
///              the gas back more
/// Throws parameter_error where no law covers the throat.
[[nodiscard]] inline plane_entry plane_entry_of(const opening<double>& o, const std::array<prism_side, 3>& sides,
                                                double contact_angle = 0) {
  const mayer_stowe_princen arcs{.surface_tension = 1.0, .contact_angle = contact_angle};
  const auto circle = inscribed_circle{.surface_tension = 1.0, .contact_angle = 0.0}.entry_pressure(o);
  const auto princen = arcs.entry_pressure(o);
  const bool wetting = std::count(sides.begin(), sides.end(), prism_side::wetting) > 0;
  auto best = wetting ? arcs.entry_pressure(section_of(o, sides, 0)) : princen;
  for (unsigned open = 1; open < 8; ++open) {
    bool mirrors = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((open >> k & 1U) != 0) {
        const auto d = o.sides[o.next(k)].point - o.sides[k].point;
        const double sum = o.sides[k].radius + o.sides[o.next(k)].radius;
        mirrors = mirrors && sides[k] == prism_side::mirror && dot(d, d) > sum * sum;
      }
    }
    if (mirrors) {
      const auto answer = arcs.entry_pressure(section_of(o, sides, open));
      if (answer.ok() && !(best.ok() && best.value <= answer.value)) {
        best = answer;
      }
    }
  }
  if (!circle.ok() || !best.ok()) {
    throw parameter_error("throat", describe(circle.ok() ? best.reason : circle.reason), "one with an entry pressure");
  }
  return {2 / circle.value, princen.value, best.value};
}

/// What became of the film that covers grains at θ = 0 while gas passes.
enum class film_status : std::uint8_t {
  none,       ///< there is none where θ > 0
  unknown,    ///< no hold has come to rest
  resolved,   ///< liquid is left beside the grains
  unresolved  ///< the film is thinner than the lattice resolves: beside a tenth of the grains a quarter of it is left
};

[[nodiscard]] constexpr const char* describe(film_status s) noexcept {
  switch (s) {
    case film_status::none: return "no film";
    case film_status::unknown: return "no hold has come to rest";
    case film_status::resolved: return "resolved";
    case film_status::unresolved: return "unresolved: thinner than the lattice shows";
  }
  return "not a status of a film";
}

/// What an entry experiment found. \par Units  of the throat: pressures per surface tension, 1/length
struct entry_result {
  double value;  ///< entry pressure, corrected where it can be; NaN where the search has not converged
  double lower;  ///< the bracket of the search as it is, not corrected
  double upper;
  double correction;      ///< value = correction × middle of the bracket
  double discretisation;  ///< entry_error, the bracket's width not included; NaN where nothing is calibrated
  std::uint64_t steps;
  std::uint64_t updates;
  std::uint32_t holds;
  search_end end;  ///< why the search stopped
  hold_end last;   ///< how the last hold ended
  film_status
      film;  ///< in the last stable hold. Where unresolved `discretisation` covers what was found up to r_in = 3,
             ///< 8.9 % there and more below; at 4 nodes (gaps of 0.6 R) it is 5 % and untested
};

/// The entry pressure; the bracket is corrected as the value is.
[[nodiscard]] inline measurement measured(const entry_result& r) noexcept {
  return {r.value,   r.correction * r.lower, r.correction * r.upper, r.discretisation,
          r.updates, verdict_of(r.end),      describe(r.end)};
}
static_assert(experiment_result<entry_result>);

namespace detail {

[[nodiscard]] inline double largest_grain(const opening<double>& o) noexcept {
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    largest = std::max(largest, o.sides[k].radius);
  }
  return largest;
}

/// \param above  from the plane of the centres to a reservoir, and below [nodes]
[[nodiscard]] inline throat_resolution resolution_of(const entry_set_up& s, double above, double below) noexcept {
  throat_resolution r;
  r.nodes_per_length = s.nodes_per_length;
  r.retraction = s.retraction.value_or(entry_retraction(s.contact_angle));
  r.above = above;
  r.below = below;
  r.plug = s.plug;
  r.halved = s.halved;
  r.fitted = s.fitted;
  r.most_nodes = s.most_nodes;
  return r;
}

/// The fluids of a throat between its walls and reservoirs. Throws parameter_error for a pair that is not as measured,
/// and where grains and wetting sides leave a reservoir no node.
template <std::floating_point T, class Model, storage Storage>
[[nodiscard]] held_fluids<T, Model, Storage> fluids_of(const entry_set_up& s, const throat_on_lattice& t) {
  check_pair<Model>(s.pair, s.tau);
  for (const bool above : {false, true}) {
    if (!t.has_reservoir(above)) {
      throw parameter_error(
          "throat", std::string("no node for the reservoir ") + (above ? "above" : "below"),
          "some that are " + short_number(s.plug) + " nodes away from grains and wetting sides: a finer lattice");
    }
  }
  held_fluids<T, Model, Storage> fluids({s.pair.attraction, s.pair.factor, s.pair.common, s.pair.main}, s.gas_share,
                                        t.sites<typename Model::lattice_type>(), t.middle(), reservoir_above,
                                        reservoir_below, s.tau);
  constexpr auto forcing = kind_of_forcing<typename Model::forcing_type>;
  fluids.set_wall(grain_wall, wall_densities(fluids.pair(), forcing, s.tau, s.contact_angle));
  const auto wet = wall_densities(fluids.pair(), forcing, s.tau, 0);
  fluids.set_wall(liquid_wall, wet);
  fluids.set_wall(0, wet);  // a face of the box as a wetting side
  return fluids;
}

/// Gas above a level, and a film of liquid on all walls.
[[nodiscard]] inline double first_gas(const throat_on_lattice& t, const std::array<int, 3>& p, double level) noexcept {
  constexpr double film = 2.5;  // nodes
  return t.to_walls(p[0], p[1], p[2]) < film ? 0 : 0.5 * (1 + std::tanh((p[2] - level) / 1.5));
}

}  // namespace detail

/// A throat in which p_c can be held.
/// \par Units  lattice units: nodes, steps; positions of the apex are above the plane of the grains' centres
/// \tparam T        float or double
/// \tparam Storage  of the nodes: in_place takes any τ, moments 1 alone
template <std::floating_point T = float, class Model = mixture<d3q19, bgk>, storage Storage = leanest_storage<Model>>
class entry_experiment {
 public:
  using simulation_type = simulation<Model, T, Storage>;

  /// Throws parameter_error for a throat that no law covers, that the lattice does not resolve or has no room for, and
  /// for a pair whose factor or tension are not as measured: in the table or, where it has none, here on a flat
  /// interface (0.2 to 1.5 s).
  explicit entry_experiment(const entry_set_up& s)
      : set_up_(s),
        plane_(plane_entry_of(s.throat, s.sides, s.contact_angle)),
        throat_(s.throat, s.sides, resolution()),
        fluids_(detail::fluids_of<T, Model, Storage>(s, throat_)) {
    if (!(s.rules.still > 0) || !(s.rules.still_mass > 0) || s.rules.most_steps < 1000 || !(s.patience > 0)) {
      throw parameter_error("hold", "no motion that counts as rest, or fewer than 1000 steps", "more");
    }
    if (!(inscribed() >= 2 * (1 - 1e-12))) {
      throw parameter_error("throat", "an inscribed circle of " + short_number(inscribed()) + " nodes",
                            "a radius of 2 or more: films and interfaces are as wide");
    }
    find_axis();
    find_walls();
  }

  [[nodiscard]] const plane_entry& plane() const noexcept { return plane_; }
  [[nodiscard]] const entry_set_up& set_up() const noexcept { return set_up_; }
  [[nodiscard]] const throat_on_lattice& throat() const noexcept { return throat_; }
  [[nodiscard]] const simulation_type& fluids() const noexcept { return fluids_.simulation_of(); }
  [[nodiscard]] std::size_t fluid_nodes() const noexcept { return fluids_.sites().size(); }
  /// Radius of the inscribed circle in nodes.
  [[nodiscard]] double inscribed() const noexcept { return plane_.inscribed * set_up_.nodes_per_length; }

  /// p_c in lattice units of a pressure per surface tension in 1/length of the throat.
  [[nodiscard]] double lattice_pressure(double per_tension) const noexcept {
    return per_tension * set_up_.pair.surface_tension / set_up_.nodes_per_length;
  }

  /// Nodes by which the grains shrank.
  [[nodiscard]] double retraction() const noexcept {
    return set_up_.retraction.value_or(entry_retraction(set_up_.contact_angle));
  }
  /// By what the middle of a bracket is multiplied: 1 where nothing is calibrated.
  [[nodiscard]] double correction() const noexcept { return covered() ? expected() : 1; }

  /// A bracket as narrow as asked where the entry pressure is expected, `factor` × the least plane value less the
  /// correction (that of mirrors where sides wet, that of fitted radii where they cannot be fitted): the search widens
  /// it where it is not there.
  [[nodiscard]] search_options bracket(double factor = 1, double width = 0.03) const noexcept {
    const double p = factor * lattice_pressure(plane_.best) / expected();
    return {.lower = (1 - 0.499 * width) * p, .upper = (1 + 0.499 * width) * p, .width = width, .widen = 1 + width};
  }

  /// Holds p_c, from the kept state or else from a meniscus above the throat, until it is clear whether the meniscus
  /// comes to rest.
  [[nodiscard]] hold_report hold(double capillary) {
    return hold(capillary, [](const hold_report&) {});
  }
  /// The same; `watch(report so far)` is called after every 1000 steps.
  template <class Watch>
    requires std::invocable<Watch&, const hold_report&>
  [[nodiscard]] hold_report hold(double capillary, Watch watch) {
    hold_report r;
    r.value = capillary;
    if (!fluids_.densities(capillary).ok()) {
      r.end = hold_end::dissolved;
      return r;
    }
    if (!fluids_.started()) {
      const double level = throat_.middle() + inscribed();
      fluids_.start(capillary, [&](const std::array<int, 3>& p) { return detail::first_gas(throat_, p, level); });
    }
    fluids_.ramp(capillary, set_up_.rules.ramp, r);
    const double passed = -2 * inscribed();
    hold_rules rules = set_up_.rules;
    rules.most_steps =
        std::min(rules.most_steps, static_cast<std::uint64_t>(set_up_.patience * std::max(4.0, inscribed())));
    fluids_.wait(
        rules, interface_track(inscribed(), 5), -inscribed(), r,
        [&](const meniscus_sight& s) { return s.apex < passed ? hold_end::passed : hold_end::step_limit; }, watch);
    judge(r);
    return r;
  }

  void keep() { fluids_.keep(); }
  void back() { fluids_.back(); }

  /// What a search has found so far.
  [[nodiscard]] entry_result result(const threshold_search& search) const noexcept {
    const auto& m = search.now();
    const double unit = lattice_pressure(1);
    const double middle = m.end == search_end::converged ? search.value() : quiet_nan<double>;
    return {correction() * middle / unit,
            m.lower / unit,
            m.upper / unit,
            correction(),
            covered() ? entry_error(inscribed(), set_up_.contact_angle) : quiet_nan<double>,
            m.steps,
            m.updates,
            m.holds,
            m.end,
            m.last,
            film_of(m)};
  }

  /// The kept state and where a search stands, as bytes.
  [[nodiscard]] std::vector<std::byte> save(const threshold_search& search) const {
    checkpoint_writer out(fingerprint());
    out.append(search.now());
    fluids_.save(out);
    return std::move(out).finish();
  }
  /// What `save` made of an experiment of the same set-up; the search goes on where it stood, with the options given
  /// here: one that had ended goes on where they ask for more.
  /// \throw input_error  no such state, cut short, damaged, or of another experiment; nothing is changed then
  [[nodiscard]] threshold_search restore(std::span<const std::byte> bytes, const search_options& options,
                                         const std::string& where = "state") {
    checkpoint_reader in(bytes, fingerprint(), where);
    threshold_search::memory memory;
    in.take(memory);
    fluids_.restore(in);
    return {options, memory};
  }

 private:
  [[nodiscard]] throat_resolution resolution() const noexcept {
    const double largest = detail::largest_grain(set_up_.throat);
    // the gap between grains has doubled √(2 R r_in) above the centres
    const double above = std::min(set_up_.clear * largest, 1.25 * std::sqrt(2 * largest * plane_.inscribed));
    return detail::resolution_of(set_up_, std::max(above * set_up_.nodes_per_length, inscribed() + 6),
                                 2.2 * inscribed() + 5);
  }

  [[nodiscard]] film_status film_of(const threshold_search::memory& m) const noexcept {
    if (set_up_.contact_angle > 0) {
      return film_status::none;
    }
    constexpr double quarter = 0.25;
    return m.lower_known == 0       ? film_status::unknown
           : m.film_lower < quarter ? film_status::unresolved
                                    : film_status::resolved;
  }

  [[nodiscard]] bool covered() const noexcept { return entry_calibrated<Model>(set_up_) && throat_.fitted(); }

  /// The correction were the sides mirrors and the radii fitted.
  [[nodiscard]] double expected() const noexcept {
    entry_set_up usual = set_up_;
    usual.sides = {};
    return entry_calibrated<Model>(usual) ? entry_correction(inscribed(), set_up_.contact_angle) : 1;
  }

  /// The column of nodes that is furthest from grains and wetting sides.
  void find_axis() {
    const auto& map = fluids_.sites();
    const int z = static_cast<int>(throat_.middle());
    double most = -1;
    std::array<int, 3> best{};
    for (std::size_t n = 0; n < map.size(); ++n) {
      const auto& p = map.place(n);
      if (const double room = throat_.to_walls(p[0], p[1], z); p[2] == z && room > most) {
        most = room;
        best = p;
      }
    }
    for (int k = 0; k < throat_.box().size[2]; ++k) {
      axis_.push_back(map.node_at(best[0], best[1], k));
    }
  }
  [[nodiscard]] double axis_pressure(double level) const noexcept {
    const auto last = static_cast<double>(axis_.size() - 1);
    const auto z = static_cast<std::size_t>(std::clamp(level, 0.0, last));
    return fluids_.pressure_at(static_cast<std::size_t>(axis_[z]));
  }

  /// What the fluids show of p_c on the axis, nearer to the reservoirs than to the meniscus.
  void judge(hold_report& r) const {
    if (r.end == hold_end::not_finite || r.end == hold_end::dissolved) {
      return;
    }
    const double apex = r.position + throat_.middle();
    const auto top = static_cast<double>(axis_.size() - 1);
    r.measured = axis_pressure(apex + 0.7 * (top - apex)) - axis_pressure(0.3 * apex);
    r.film = film(r.value);
    const double coarse = 0.3 / (inscribed() * inscribed());  // the meniscus reaches to where the pressure is taken
    r.end = compared(r, set_up_.rules.flow + coarse);
  }

  /// Nodes beside the grains, from the plane of their centres upward: the gas passes there.
  void find_walls() {
    const auto& map = fluids_.sites();
    for (std::size_t n = 0; n < map.size(); ++n) {
      const auto& p = map.place(n);
      bool beside = false;
      for (std::size_t i = 1; i < Model::directions; ++i) {
        const auto& v = Model::lattice_type::velocity[i];
        beside = beside || throat_.to_grains(p[0] + v[0], p[1] + v[1], p[2] + v[2]) < 0;
      }
      if (beside && p[2] >= throat_.middle()) {
        beside_grains_.push_back(n);
      }
    }
  }
  /// Of what is left of the liquid beside the grains, 0 where it is gas, the value below which a tenth lies.
  [[nodiscard]] double film(double capillary) const {
    const reservoir_pair bulk = fluids_.densities(capillary).value;
    const double gas = bulk.gas[0] - bulk.gas[1];
    const double liquid = bulk.liquid[0] - bulk.liquid[1];
    std::vector<double> left;
    for (const std::size_t n : beside_grains_) {
      const auto rho = fluids_.simulation_of().densities_at(n);
      left.push_back((gas - rho[0] + rho[1]) / (gas - liquid));
    }
    const auto tenth = left.begin() + static_cast<std::ptrdiff_t>(left.size() / 10);
    std::nth_element(left.begin(), tenth, left.end());
    return left.empty() ? 1 : *tenth;
  }

  [[nodiscard]] std::uint64_t fingerprint() const noexcept {
    parameter_hash h;
    h.add(std::uint64_t{fluid_nodes()});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& side = set_up_.throat.sides[k];
      h.add(side.point.x).add(side.point.y).add(side.radius);
      h.add(static_cast<std::uint64_t>(set_up_.sides[k]));
    }
    const calibrated_pair& p = set_up_.pair;
    const hold_rules& rules = set_up_.rules;
    for (const double x : {set_up_.nodes_per_length, retraction(), set_up_.clear, set_up_.plug, set_up_.contact_angle,
                           set_up_.gas_share, set_up_.tau, set_up_.patience, rules.still, rules.still_mass, rules.flow,
                           p.attraction, p.factor, p.common, p.main, p.surface_tension}) {
      h.add(x);
    }
    // the model by what distinguishes those that the library knows, τ and repulsion aside
    using collision = typename Model::collision_type;
    constexpr bool known_collision = std::is_same_v<collision, bgk>;
    constexpr bool known_potential = std::is_same_v<decltype(Model::potential), linear_potential>;
    for (const std::uint64_t x :
         {std::uint64_t{set_up_.halved}, std::uint64_t{set_up_.fitted}, std::uint64_t{Model::directions},
          std::uint64_t{Model::forcing_type::carries_source}, std::uint64_t{known_collision},
          std::uint64_t{sizeof(collision)}, std::uint64_t{known_potential}}) {
      h.add(x);
    }
    return h.add(rules.ramp).add(rules.most_steps).add(std::uint64_t{rules.foresee}).value();
  }

  entry_set_up set_up_;
  plane_entry plane_;
  throat_on_lattice throat_;
  held_fluids<T, Model, Storage> fluids_;
  std::vector<std::int32_t> axis_;
  std::vector<std::size_t> beside_grains_;
};
static_assert(held_experiment<entry_experiment<>>);

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
