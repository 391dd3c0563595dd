// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/packing/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Grains that push each other: a small discrete-element simulator, standing for the one that a user has.

namespace support {

namespace tp = tetrapore;
using vec = tp::vec3<double>;

/// Grains without friction. Two of them, of radii a and b, repel with the stiffness 2 E a b / (a + b); a grain and a
/// wall with 2 E a.
struct dem_material {
  double modulus = 1e8;   ///< E [Pa]
  double density = 2600;  ///< [kg/m³]
  double damping = 0.3;   ///< of a contact, as a share of its critical damping
};

/// Spheres in a box of six smooth walls, of which the one at y_max is a piston under a load.
///
/// One step of a caller: `push()` sets the forces to those of the contacts; the caller adds his own; `move(dt)` moves
/// the grains and the piston.
class dem {
 public:
  dem(tp::packing p, dem_material material) : grains(std::move(p.grains)), material_(material) {
    if (!p.bounds || p.periodic != std::array<bool, 3>{}) {
      throw tp::packing_error("the packing", "no box, or one that repeats", "a box with six walls");
    }
    bounds = *p.bounds;
    velocities.resize(grains.size());
    forces.resize(grains.size());
    smallest_ = grains.front().radius;
    double total = 0;
    for (const auto& g : grains) {
      masses.push_back(material.density * 4 / 3 * std::numbers::pi * g.radius * g.radius * g.radius);
      total += masses.back();
      smallest_ = std::min(smallest_, g.radius);
    }
    const double layer = 2 * std::cbrt(volume() / static_cast<double>(grains.size()));
    piston_mass = total * layer / height();
  }

  std::vector<tp::sphere<double>> grains;
  std::vector<vec> velocities;  ///< [m/s]
  std::vector<vec> forces;      ///< on the grains [N]
  std::vector<double> masses;   ///< [kg]
  tp::box bounds;
  double load = 0;             ///< on the piston, downwards [N]
  double piston_velocity = 0;  ///< upwards [m/s]
  double piston_force = 0;     ///< of the grains and of whoever adds to it, upwards [N]
  double piston_mass = 0;      ///< [kg]

  [[nodiscard]] double height() const { return bounds.size().y; }
  [[nodiscard]] double area() const { return bounds.size().x * bounds.size().z; }
  [[nodiscard]] double volume() const { return bounds.volume(); }
  /// Force by which the grains push the base [N].
  [[nodiscard]] double base_force() const { return base_force_; }

  /// Half of the time in which a grain swings through a radian on the stiffest contact: a third of the stable step.
  [[nodiscard]] double time_step() const {
    const double mass = material_.density * 4 / 3 * std::numbers::pi * smallest_ * smallest_ * smallest_;
    return 0.5 * std::sqrt(mass / (4 * material_.modulus * smallest_));
  }

  /// Sets the forces to those of the contacts.
  void push() {
    if (moved_since_search()) {
      search();
    }
    std::fill(forces.begin(), forces.end(), vec{});
    for (const auto& [i, j] : pairs_) {
      const vec apart = grains[j].centre - grains[i].centre;
      const double near = grains[i].radius + grains[j].radius;
      const double distance2 = norm2(apart);
      if (distance2 >= near * near) {
        continue;
      }
      const double distance = std::sqrt(distance2);
      const vec n = apart / distance;
      const double stiffness = 2 * material_.modulus * grains[i].radius * grains[j].radius / near;
      const double mass = masses[i] * masses[j] / (masses[i] + masses[j]);
      const vec f = n * contact_force(near - distance, dot(velocities[j] - velocities[i], n), stiffness, mass);
      forces[i] -= f;
      forces[j] += f;
    }
    piston_force = 0;
    base_force_ = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const double r = grains[i].radius;
      for (std::size_t k = 0; k < 3; ++k) {
        for (const bool upper : {false, true}) {
          const double depth = upper ? grains[i].centre[k] + r - bounds.hi[k] : bounds.lo[k] + r - grains[i].centre[k];
          if (depth <= 0) {
            continue;
          }
          const bool piston = upper && k == 1;
          const double speed = velocities[i][k] - (piston ? piston_velocity : 0);
          const double f = contact_force(depth, upper ? -speed : speed, 2 * material_.modulus * r, masses[i]);
          forces[i][k] += upper ? -f : f;
          piston_force += piston ? f : 0;
          base_force_ += !upper && k == 1 ? f : 0;
        }
      }
    }
  }

  /// Moves the grains and the piston by their forces. With inertia added, a grain (and the piston) resists a change of
  /// its velocity more than by its mass.
  void move(double dt, const std::vector<double>& added_mass = {}, double added_piston_mass = 0) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
      velocities[i] += forces[i] * (dt / (masses[i] + (added_mass.empty() ? 0 : added_mass[i])));
      grains[i].centre += velocities[i] * dt;
    }
    if (load > 0) {
      piston_velocity += (piston_force - load) * dt / (piston_mass + added_piston_mass);
      bounds.hi.y += piston_velocity * dt;
    }
  }

  /// Steps without anything else acting, with friction against the motion, until the forces balance.
  /// \param tolerance  largest force on a grain that is left, over the mean contact force
  /// \return steps taken
  /// \throw packing_error  when they do not
  std::size_t relax(double tolerance, std::size_t most_steps = 2000000) {
    const double dt = time_step();
    for (std::size_t step = 0; step < most_steps; ++step) {
      push();
      if (step % 100 == 99 && unbalanced() <= tolerance && std::abs(piston_force - load) <= tolerance * load) {
        std::fill(velocities.begin(), velocities.end(), vec{});
        piston_velocity = 0;
        return step;
      }
      slow_down();
      move(dt);
    }
    throw tp::packing_error("the grains", "an unbalanced force of " + tp::short_number(unbalanced()), "rest");
  }

  /// Shortens the box evenly over its height, all grains with it, until the piston carries its load; then lets the
  /// grains come to rest. A piston alone would leave the column denser at one end.
  /// \return steps taken
  std::size_t compact(double tolerance) {
    constexpr double rate = 1e-4;  // per step
    std::size_t steps = 0;
    const double wanted = std::exchange(load, 0.0);  // holds the piston
    for (push(); piston_force + base_force_ < 2 * wanted; push(), ++steps) {
      for (auto& g : grains) {
        g.centre.y = bounds.lo.y + (g.centre.y - bounds.lo.y) * (1 - rate);
      }
      bounds.hi.y = bounds.lo.y + height() * (1 - rate);
      push();
      slow_down();
      move(time_step());
    }
    load = wanted;
    return steps + relax(tolerance);
  }

  /// Largest force on a grain over the mean force of a contact.
  [[nodiscard]] double unbalanced() const {
    double sum = 0;
    std::size_t contacts = 0;
    for (const auto& [i, j] : pairs_) {
      const double near = grains[i].radius + grains[j].radius;
      const double depth = near - norm(grains[j].centre - grains[i].centre);
      if (depth > 0) {
        sum += 2 * material_.modulus * grains[i].radius * grains[j].radius / near * depth;
        ++contacts;
      }
    }
    double largest = 0;
    for (const vec& f : forces) {
      largest = std::max(largest, norm(f));
    }
    return contacts == 0 ? largest : largest * static_cast<double>(contacts) / sum;
  }

  [[nodiscard]] tp::packing packing() const { return {grains, bounds, {}}; }

 private:
  [[nodiscard]] double contact_force(double depth, double approach_rate, double stiffness, double mass) const {
    // approach_rate > 0 where the two part
    return stiffness * depth - 2 * material_.damping * std::sqrt(stiffness * mass) * approach_rate;
  }

  /// Takes a share off the forces that drive the motion, and adds it to those that brake it.
  void slow_down() {
    const auto slowed = [](double f, double v) { return f - (v > 0 ? 1 : v < 0 ? -1 : 0) * 0.3 * std::abs(f); };
    for (std::size_t i = 0; i < grains.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        forces[i][k] = slowed(forces[i][k], velocities[i][k]);
      }
    }
    piston_force = load + slowed(piston_force - load, piston_velocity);
  }

  [[nodiscard]] bool moved_since_search() const {
    if (found_at_.size() != grains.size()) {
      return true;
    }
    const double far = 0.1 * smallest_;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      if (norm2(grains[i].centre - found_at_[i]) > far * far) {
        return true;
      }
    }
    return false;
  }

  void search() {
    pairs_.clear();
    found_at_.clear();
    for (const auto& g : grains) {
      found_at_.push_back(g.centre);
    }
    tp::for_each_close_pair(packing(), 0.2 * smallest_,
                            [&](const tp::close_pair& c, const vec&) { pairs_.emplace_back(c.i, c.j); });
  }

  dem_material material_;
  double smallest_ = 0;
  double base_force_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  std::vector<vec> found_at_;
};

}  // namespace support
