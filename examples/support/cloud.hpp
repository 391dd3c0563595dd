// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "wet_grains.hpp"

#include "tetrapore/core/error.hpp"
#include "tetrapore/packing/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// \file
/// A cloud of wet grains that collide in a box.

namespace support {

struct cloud_options {
  std::size_t grains = 200;
  double solid = 0.15;  ///< share of the box
  double wetness = 4;   ///< liquid on a grain, in shares of a bridge
  double gravity = 9.81;
  double time = 0.03;  ///< [s]
  double steps = 50;   ///< in half a period of a contact
  std::size_t seed = 1;
};

struct cloud_instant {
  double time;
  energies energy;
  ledger books;
  std::size_t bridges;
  double liquid_in_bridges;  ///< [m³]
  double energy_defect;      ///< what the books do not explain, over the energy at the start
};

struct cloud_run {
  std::size_t grains = 0;
  double step = 0;  ///< [s]
  double liquid = 0;
  double liquid_defect = 0;
  std::vector<cloud_instant> trace;  ///< the first row is the start
};

/// Grains of two radii in turn, at random places in a cubic box, out of each other's reach; speeds of Maxwell's kind.
[[nodiscard]] inline wet_grains make_cloud(const wet_material& m, const cloud_options& c, double radius1,
                                           double radius2, double speed) {
  const auto radius = [&](std::size_t i) { return i % 2 == 0 ? radius1 : radius2; };
  double solid = 0;
  for (std::size_t i = 0; i < c.grains; ++i) {
    solid += 4.0 / 3 * tp::pi<double> * radius(i) * radius(i) * radius(i);
  }
  const double edge = std::cbrt(solid / c.solid);
  const double apart = 1.01 * std::max(m.film, m.creation_gap);
  tp::random_sequence random(c.seed);
  std::vector<tp::sphere<double>> spheres;
  for (std::size_t tries = 0; spheres.size() < c.grains; ++tries) {
    if (tries > 10000 * c.grains) {
      throw tp::parameter_error("--solid", tp::short_number(c.solid), "room for all grains: fewer, or thinner films");
    }
    const double r = radius(spheres.size());
    const double free = edge - 2 * (r + apart);
    const vec at = vec{random.uniform(), random.uniform(), random.uniform()} * free + vec{1, 1, 1} * (r + apart);
    const bool clear = std::none_of(spheres.begin(), spheres.end(), [&](const tp::sphere<double>& other) {
      const double near = r + other.radius + apart;
      return norm2(at - other.centre) < near * near;
    });
    if (free > 0 && clear) {
      spheres.push_back({at, r});
    }
  }
  wet_grains cloud(std::move(spheres), tp::walled({{}, {edge, edge, edge}}), m, {0, 0, -c.gravity},
                   0.5 * c.wetness * m.bridge_volume);
  // the sum of twelve uniform numbers is as good as normal; the mean speed of Maxwell is √(8/π) of one component
  for (vec& v : cloud.velocities) {
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = -6;
      for (int i = 0; i < 12; ++i) {
        sum += random.uniform();
      }
      v[k] = sum * speed / std::sqrt(8 / tp::pi<double>);
    }
  }
  return cloud;
}

/// Time steps of a cloud whose smallest grains have this radius.
[[nodiscard]] inline double cloud_steps(const wet_material& m, const cloud_options& c, double radius) {
  return std::ceil(c.time * c.steps / m.contact_time(0.5 * m.mass(radius)));
}

/// Follows a cloud, with some two hundred rows of books.
[[nodiscard]] inline cloud_run follow(wet_grains& cloud, const wet_material& m, const cloud_options& c) {
  cloud_run run;
  run.grains = cloud.grains.size();
  const auto smallest = std::min_element(cloud.grains.begin(), cloud.grains.end(),
                                         [](const auto& a, const auto& b) { return a.radius < b.radius; });
  const auto steps = static_cast<std::size_t>(cloud_steps(m, c, smallest->radius));
  run.step = c.time / static_cast<double>(steps);
  run.liquid = cloud.liquid();
  const energies start = cloud.energy();
  const auto note = [&](double time) {
    const energies now = cloud.energy();
    double held = 0;
    for (const auto& pair : cloud.pairs()) {
      held += pair.volume;
    }
    run.trace.push_back({time, now, cloud.books(), cloud.bridges(), held,
                         (start.sum() - now.sum() - cloud.books().dissipated()) / start.sum()});
  };
  note(0);
  const std::size_t every = std::max<std::size_t>(1, steps / 200);
  for (std::size_t k = 1; k <= steps; ++k) {
    cloud.step(run.step);
    if (k % every == 0 || k == steps) {
      note(static_cast<double>(k) * run.step);
    }
  }
  run.liquid_defect = run.liquid > 0 ? std::abs(cloud.liquid() - run.liquid) / run.liquid : 0;
  return run;
}

}  // namespace support
