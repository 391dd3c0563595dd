// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/liquid.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"
#include "tetrapore/law/contact/dry_contact.hpp"
#include "tetrapore/law/contact/wet_contact.hpp"
#include "tetrapore/law/lubrication/rough.hpp"
#include "tetrapore/law/lubrication/sphere_plane.hpp"
#include "tetrapore/law/lubrication/two_spheres.hpp"
#include "tetrapore/packing/close_edges.hpp"
#include "tetrapore/simplex/pair_store.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Wet grains that move: contact and film, bridges that form and rupture, liquid that stays, and books of the energy.

namespace support {

namespace tp = tetrapore;
using vec = tp::vec3<double>;

/// The liquid between two surfaces, by the leading order or by the accurate laws: a lubrication law made of three.
struct film_law {
  bool accurate = false;
  tp::leading_order leading;
  tp::two_spheres spheres;
  tp::sphere_plane wall;

  template <tp::real T>
  [[nodiscard]] tp::outcome<tp::pair_resistance<T>, tp::pair_status> resistance(const tp::edge<T>& e) const noexcept {
    return !accurate ? leading.resistance(e) : e.with_plane() ? wall.resistance(e) : spheres.resistance(e);
  }
};

/// Grains and their liquid. SI units.
struct wet_material {
  double density = 2500;
  double stiffness = 1e4;  ///< of a contact, normal
  double shear_stiffness = 8e3;
  double friction = 0.3;
  double viscosity = 5e-3;  ///< 0: no film
  double film = 5e-5;       ///< gap below which the film acts
  double roughness = 1e-6;  ///< height of the asperities
  double asperity_stiffness = 1e5;
  bool accurate_film = false;
  double surface_tension = 0.072;
  double contact_angle = 0;      ///< [rad]
  double bridge_volume = 1e-11;  ///< of a new bridge, if the grains have as much; 0: no bridges
  double creation_gap = 5e-5;

  [[nodiscard]] double mass(double radius) const { return density * 4 / 3 * tp::pi<double> * radius * radius * radius; }
  /// Half a period of a contact between grains of this reduced mass.
  [[nodiscard]] double contact_time(double mass) const { return tp::pi<double> * std::sqrt(mass / stiffness); }
};

/// The film between grains of a material.
[[nodiscard]] inline tp::rough<film_law> film_of(const wet_material& m) {
  return {.law = {.accurate = m.accurate_film,
                  .leading = {.viscosity = m.viscosity},
                  .spheres = {.viscosity = m.viscosity},
                  .wall = {.viscosity = m.viscosity}},
          .height = m.roughness};
}

/// \par Units  [J]
struct energies {
  double kinetic = 0;
  double potential = 0;  ///< of gravity
  double elastic = 0;    ///< of contacts and asperities
  double capillary = 0;  ///< of bridges, from where each of them formed

  [[nodiscard]] double sum() const { return kinetic + potential + elastic + capillary; }
};

/// What has happened so far.
struct ledger {
  double film = 0;      ///< dissipated by liquid that is squeezed out and drawn in [J]
  double friction = 0;  ///< by slip, roll and twist, of asperities and film [J]
  double rupture = 0;   ///< energy that bridges had gained since they formed, when they ruptured [J]
  std::size_t steps = 0;
  std::size_t formed = 0;
  std::size_t ruptures = 0;
  std::size_t refused_flooded = 0;  ///< requests that the bridge law refused: no force of a bridge in that step
  std::size_t refused_not_covered = 0;
  std::size_t refused_invalid_input = 0;
  std::size_t refused_not_converged = 0;
  double largest_overlap = 0;                       ///< [m]
  double largest_force = 0;                         ///< of a contact, pushing [N]
  double thinnest_film = tp::infinity<double>;      ///< [m]
  double last_rupture_gap = tp::quiet_nan<double>;  ///< of the last bridge that ruptured: the exact one [m]

  [[nodiscard]] double dissipated() const { return film + friction + rupture; }
};

/// Grains with contact, film and bridges, in a box with walls or in none.
///
/// A step is one of leapfrog: half a kick, a drift, the forces where the grains now are, half a kick. The drift moves
/// by the mean velocity of the step, which is what the contact laws ask for, and the mean of the forces at the two
/// ends, times the drift, is the work that the kinetic energy feels.
class wet_grains {
 public:
  using wet_law = tp::wet_contact<tp::rough<film_law>>;
  using bridge_law = tp::young_laplace<>;

  /// What a pair remembers.
  struct pair_memory {
    tp::edge<double> shape{};
    bool near = false;  ///< in reach of its contact law
    tp::dry_contact::state<double> dry{};
    wet_law::state<double> wet{};
    double pull = 0;    ///< of the contact, along the normal
    double stored = 0;  ///< elastic energy
    double shear_energy = 0;
    tp::bridge_presence<double> presence{};
    double volume = 0;     ///< of the bridge
    double formed_at = 0;  ///< energy of the bridge that is booked as none
    tp::meniscus<double> last{};
    bridge_law::warm_state<double> warm{};
  };

  wet_grains(std::vector<tp::sphere<double>> spheres, const tp::domain& region, const wet_material& material,
             const vec& gravity, double liquid_on_each)
      : grains(std::move(spheres)),
        velocities(grains.size()),
        spins(grains.size()),
        films(grains.size(), liquid_on_each),
        region_(region),
        material_(material),
        gravity_(gravity),
        forces_(grains.size()),
        torques_(grains.size()) {
    for (const auto& g : grains) {
      masses.push_back(material.mass(g.radius));
      skin_ += 0.2 * g.radius / static_cast<double>(grains.size());
    }
    for (std::size_t i = 0; i < grains.size(); ++i) {
      forces_[i] = gravity_ * masses[i];
    }
  }

  std::vector<tp::sphere<double>> grains;
  std::vector<vec> velocities;
  std::vector<vec> spins;
  std::vector<double> films;  ///< liquid on each grain that is in no bridge [m³]
  std::vector<double> masses;

  void step(double time) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
      kick(i, 0.5 * time);
      grains[i].centre += velocities[i] * time;
    }
    if (moved_since_search()) {
      search();
    }
    for (std::size_t i = 0; i < grains.size(); ++i) {
      forces_[i] = gravity_ * masses[i];
      torques_[i] = {};
    }
    for (const auto& [key, memory] : pairs_) {
      memory->shape = shape_of(key);
      touch(key, *memory, time);
      wet(key, *memory);
    }
    for (std::size_t i = 0; i < grains.size(); ++i) {
      kick(i, 0.5 * time);
    }
    ++books_.steps;
  }

  [[nodiscard]] energies energy() const {
    energies sum;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      sum.kinetic += 0.5 * masses[i] * norm2(velocities[i]) + 0.5 * inertia(i) * norm2(spins[i]);
      sum.potential -= masses[i] * dot(gravity_, grains[i].centre);
    }
    for (const pair_memory& m : store_.states()) {
      sum.elastic += m.stored;
      sum.capillary += m.presence.present ? bridge_.energy(m.shape, m.last) - m.formed_at : 0;
    }
    return sum;
  }
  [[nodiscard]] const ledger& books() const { return books_; }
  [[nodiscard]] std::span<const tp::pair_key> keys() const { return store_.keys(); }
  [[nodiscard]] std::span<const pair_memory> pairs() const { return store_.states(); }
  [[nodiscard]] std::size_t bridges() const {
    return static_cast<std::size_t>(
        std::count_if(pairs().begin(), pairs().end(), [](const pair_memory& m) { return m.presence.present; }));
  }
  /// All liquid: on grains, in bridges, on walls [m³].
  [[nodiscard]] double liquid() const {
    double sum = on_walls_;
    for (const double v : films) {
      sum += v;
    }
    for (const pair_memory& m : store_.states()) {
      sum += m.volume;
    }
    return sum;
  }
  /// Linear momentum [N s], and angular momentum about the origin [N m s].
  [[nodiscard]] std::array<vec, 2> momenta() const {
    std::array<vec, 2> sum;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      sum[0] += velocities[i] * masses[i];
      sum[1] += cross(grains[i].centre, velocities[i]) * masses[i] + spins[i] * inertia(i);
    }
    return sum;
  }
  /// The law of the bridges.
  [[nodiscard]] const bridge_law& capillarity() const { return bridge_; }

 private:
  [[nodiscard]] double inertia(std::size_t i) const { return 0.4 * masses[i] * grains[i].radius * grains[i].radius; }
  [[nodiscard]] bool has_film() const { return material_.viscosity > 0; }

  void kick(std::size_t i, double time) {
    velocities[i] += forces_[i] * (time / masses[i]);
    spins[i] += torques_[i] * (time / inertia(i));
  }

  [[nodiscard]] tp::edge<double> shape_of(const tp::pair_key& key) const {
    const auto& a = grains[key.a.index()];
    if (key.b.is_wall()) {
      const tp::plane<double> wall = region_.wall(key.b.wall());
      return {a.radius, tp::infinity<double>, wall.distance(a.centre) - a.radius, -wall.normal};
    }
    const auto& b = grains[key.b.grain().index()];
    const vec branch = b.centre - a.centre;
    const double distance = norm(branch);
    return {a.radius, b.radius, distance - a.radius - b.radius, branch / distance};
  }
  [[nodiscard]] tp::pair_motion<double> motion_of(const tp::pair_key& key) const {
    const std::size_t a = key.a.index();
    if (key.b.is_wall()) {
      return {velocities[a], spins[a], {}, {}};
    }
    const std::size_t b = key.b.grain().index();
    return {velocities[a], spins[a], velocities[b], spins[b]};
  }
  void push(const tp::pair_key& key, const tp::pair_forces<double>& on) {
    forces_[key.a.index()] += on.force1;
    torques_[key.a.index()] += on.torque1;
    if (!key.b.is_wall()) {
      forces_[key.b.grain().index()] += on.force2;
      torques_[key.b.grain().index()] += on.torque2;
    }
  }

  /// The contact of a pair, and the film in series with it.
  void touch(const tp::pair_key& key, pair_memory& m, double time) {
    const bool reached = m.shape.gap < (has_film() ? material_.film : 0);
    if (!reached) {
      leave(m);
      return;
    }
    if (!m.near) {  // a film has the thickness at which the two surfaces come into it
      m.near = true;
      m.dry = dry_.start(m.shape);
      m.wet = wet_.start(m.shape, material_.film);
    }
    const double before = m.wet.thickness;
    const auto answer =
        has_film() ? wet_.step(m.shape, motion_of(key), time, m.wet) : dry_.step(m.shape, motion_of(key), time, m.dry);
    if (answer.kind() == tp::verdict::absent) {
      leave(m);
      return;
    }
    if (!answer.ok()) {
      throw std::runtime_error("the contact of a pair: " + std::string(describe(answer.reason)));
    }
    const tp::contact_forces<double>& f = answer.value;
    push(key, f.on);
    double squeezed = 0;
    if (has_film()) {
      squeezed = (f.pull + f.asperities) * (f.thickness - before);
      books_.thinnest_film = std::min(books_.thinnest_film, f.thickness);
    }
    books_.film += squeezed;
    books_.friction += f.dissipated - squeezed;
    m.pull = f.pull;
    m.stored = f.stored;
    m.shear_energy = 0.5 * norm2(f.shear) / material_.shear_stiffness;
    books_.largest_overlap = std::max(books_.largest_overlap, -m.shape.gap);
    books_.largest_force = std::max(books_.largest_force, -f.pull);
  }

  /// A contact ends: its shear spring is cut, and so is the film that still pulled.
  void leave(pair_memory& m) {
    if (m.near) {
      books_.friction += m.shear_energy;
      books_.film += has_film() ? m.stored - m.shear_energy : 0;
      m.near = false;
      m.pull = m.stored = m.shear_energy = 0;
    }
  }

  /// The bridge of a pair.
  void wet(const tp::pair_key& key, pair_memory& m) {
    const bool had = m.presence.present;
    if (!had) {
      if (!(material_.bridge_volume > 0) || m.shape.gap > material_.creation_gap) {
        return;
      }
      m.volume = drawn_from(key);
      m.presence.creation_gap = material_.creation_gap;
    }
    const auto found = m.presence.bridge(bridge_, m.shape, tp::given_volume<double>{m.volume}, m.warm);
    count(found.reason);
    if (m.presence.present && found.ok()) {
      m.last = found.value;
      push(key, {found.value.force * m.shape.normal, {}, -found.value.force * m.shape.normal, {}});
      if (!had) {
        m.formed_at = bridge_.energy(m.shape, m.last);
        ++books_.formed;
      }
    } else if (!m.presence.present) {
      had ? rupture(key, m) : give_back(key, m);
    }
  }

  /// Takes the liquid of a new bridge off the grains, from each at most half of what a bridge holds.
  [[nodiscard]] double drawn_from(const tp::pair_key& key) {
    double sum = 0;
    const auto take = [&](double& film) {
      const double part = std::min(film, 0.5 * material_.bridge_volume);
      film -= part;
      sum += part;
    };
    take(films[key.a.index()]);
    if (!key.b.is_wall()) {
      take(films[key.b.grain().index()]);
    }
    return sum;
  }
  void give_back(const tp::pair_key& key, pair_memory& m) {
    const bool wall = key.b.is_wall();
    films[key.a.index()] += wall ? m.volume : 0.5 * m.volume;
    if (!wall) {
      films[key.b.grain().index()] += 0.5 * m.volume;
    }
    m.volume = 0;
  }

  /// A bridge lets go: each surface keeps what is on its side of the neck, and hands it to its other bridges.
  void rupture(const tp::pair_key& key, pair_memory& m) {
    const auto limit = bridge_.rupture_gap(m.shape, tp::given_volume<double>{m.volume});
    if (!limit.ok()) {
      throw std::runtime_error("the rupture of a bridge: " + std::string(describe(limit.reason)));
    }
    tp::edge<double> widest = m.shape;
    widest.gap = limit.value.gap;
    books_.rupture += bridge_.energy(widest, limit.value.last) - m.formed_at;
    books_.last_rupture_gap = limit.value.gap;
    ++books_.ruptures;
    const std::array<double, 2> halves = bridge_.halves(widest, limit.value.last);
    const double first = m.volume * halves[0] / (halves[0] + halves[1]);
    const double second = m.volume - first;
    m.volume = 0;
    m.warm = {};
    hand_on(key.a, first);
    if (key.b.is_wall()) {
      on_walls_ += second;
    } else {
      hand_on(key.b.grain(), second);
    }
  }

  /// Liquid on a grain flows to its bridges in proportion to their volumes. Where it has none, or one of them cannot
  /// take more, it stays on the grain.
  void hand_on(tp::grain_id grain, double liquid) {
    std::vector<pair_memory*> bridges;
    std::vector<double> volumes;
    for (std::size_t k = 0; k < store_.size(); ++k) {
      const tp::pair_key& key = store_.keys()[k];
      pair_memory& m = store_.states()[k];
      if (m.presence.present && (key.a == grain || (!key.b.is_wall() && key.b.grain() == grain))) {
        bridges.push_back(&m);
        volumes.push_back(m.volume);
      }
    }
    const std::vector<double> weights = volumes;
    if (!tp::share_liquid(liquid, volumes.data(), weights.data(), bridges.size())) {
      films[grain.index()] += liquid;
      return;
    }
    std::vector<tp::meniscus<double>> grown;
    for (std::size_t k = 0; k < bridges.size(); ++k) {
      const auto found = bridge_.bridge(bridges[k]->shape, tp::given_volume<double>{volumes[k]});
      if (!found.ok()) {
        films[grain.index()] += liquid;
        return;
      }
      grown.push_back(found.value);
    }
    for (std::size_t k = 0; k < bridges.size(); ++k) {  // liquid that flows in does no work on the grains
      pair_memory& m = *bridges[k];
      m.formed_at += bridge_.energy(m.shape, grown[k]) - bridge_.energy(m.shape, m.last);
      m.last = grown[k];
      m.volume = volumes[k];
    }
  }

  void count(tp::bridge_status why) {
    books_.refused_flooded += why == tp::bridge_status::flooded ? 1 : 0;
    books_.refused_not_covered += why == tp::bridge_status::not_covered ? 1 : 0;
    books_.refused_invalid_input += why == tp::bridge_status::invalid_input ? 1 : 0;
    books_.refused_not_converged += why == tp::bridge_status::not_converged ? 1 : 0;
  }

  [[nodiscard]] bool moved_since_search() const {
    if (found_at_.size() != grains.size()) {
      return true;
    }
    for (std::size_t i = 0; i < grains.size(); ++i) {
      if (norm2(grains[i].centre - found_at_[i]) > 0.25 * skin_ * skin_) {
        return true;
      }
    }
    return false;
  }

  /// The pairs that can come into reach before the next search, and all that have a bridge.
  void search() {
    found_at_.clear();
    for (const auto& g : grains) {
      found_at_.push_back(g.centre);
    }
    const double reach = std::max({material_.film, material_.creation_gap, 0.0}) + skin_;
    store_.erase_if([&](const tp::pair_key& key, const pair_memory& m) {
      return !m.near && !m.presence.present && !(shape_of(key).gap < reach);
    });
    tp::for_each_close_edge(grains, region_, reach, [&](const tp::close_edge& e) { store_.insert(e.key, {}); });
    pairs_.clear();
    for (std::size_t k = 0; k < store_.size(); ++k) {  // pointers hold: no pair comes or goes until the next search
      pairs_.emplace_back(store_.keys()[k], &store_.states()[k]);
    }
  }

  tp::domain region_;
  wet_material material_;
  vec gravity_;
  std::vector<vec> forces_;
  std::vector<vec> torques_;
  wet_law wet_{.film = film_of(material_),
               .normal_stiffness = material_.stiffness,
               .shear_stiffness = material_.shear_stiffness,
               .friction = material_.friction,
               .asperity_height = material_.roughness,
               .asperity_stiffness = material_.asperity_stiffness};
  tp::dry_contact dry_{.normal_stiffness = material_.stiffness,
                       .shear_stiffness = material_.shear_stiffness,
                       .friction = material_.friction};
  bridge_law bridge_{.surface_tension = material_.surface_tension,
                     .contact_angle1 = material_.contact_angle,
                     .contact_angle2 = material_.contact_angle};
  tp::pair_store<pair_memory> store_;
  std::vector<std::pair<tp::pair_key, pair_memory*>> pairs_;
  std::vector<vec> found_at_;
  double skin_ = 0;
  double on_walls_ = 0;  ///< liquid that walls kept [m³]
  ledger books_;
};

}  // namespace support
