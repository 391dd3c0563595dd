// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include "support/flow_scenes.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <algorithm>
#include <cmath>

using namespace tetrapore;
using namespace flow_scenes;

namespace {

/// The pressure on whole sectors, and nothing else.
struct only_pressure {
  facet_load operator()(const throat<double>& t) const noexcept {
    facet_load load;
    for (std::size_t k = 0; k < t.grain_count; ++k) {
      const auto towards = [&](std::size_t j) {
        return j < t.grain_count ? t.grains[j].centre - t.grains[k].centre : -t.walls[j - t.grain_count].normal;
      };
      const vec3<double> a = towards((k + 1) % 3);
      const vec3<double> b = towards((k + 2) % 3);
      load.pressure[k] = t.grains[k].radius * t.grains[k].radius * std::atan2(norm(cross(a, b)), dot(a, b)) / 2;
    }
    return load;
  }
};

pressure_field arbitrary_pressure(const network& net, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  pressure_field p(net);
  for (double& x : p.values()) {
    x = unit_draw(random);
  }
  return p;
}

/// ∫ n dΩ and ∫ n ⊗ n dΩ over a part of the unit sphere.
struct sphere_moments {
  vec3<double> first;
  std::array<vec3<double>, 3> second{};
};

/// Adds them over the spherical triangle of three unit vectors, signed, by Radon's rule of degree 5 on 4^levels parts.
void add_triangle(sphere_moments& m, const vec3<double>& a, const vec3<double>& b, const vec3<double>& c, int levels) {
  if (levels > 0) {
    const auto middle = [](const vec3<double>& x, const vec3<double>& y) { return (x + y) / norm(x + y); };
    const vec3<double> ab = middle(a, b);
    const vec3<double> bc = middle(b, c);
    const vec3<double> ca = middle(c, a);
    add_triangle(m, a, ab, ca, levels - 1);
    add_triangle(m, ab, b, bc, levels - 1);
    add_triangle(m, ca, bc, c, levels - 1);
    add_triangle(m, ab, bc, ca, levels - 1);
    return;
  }
  const double scale = triple(a, b, c) / 2;
  const auto add = [&](double wa, double wb, double wc, double weight) {
    const vec3<double> x = a * wa + b * wb + c * wc;
    const double length = norm(x);
    const vec3<double> n = x / length;
    const double solid_angle = weight * scale / (length * length * length);
    m.first += n * solid_angle;
    for (std::size_t i = 0; i < 3; ++i) {
      m.second[i] += n * (n[i] * solid_angle);
    }
  };
  add(1.0 / 3, 1.0 / 3, 1.0 / 3, 9.0 / 40);
  for (const double sign : {-1.0, 1.0}) {
    const double root = sign * std::sqrt(15.0);
    const double u = (6 + root) / 21;
    const double weight = (155 + root) / 1200;
    add(1 - 2 * u, u, u, weight);
    add(u, 1 - 2 * u, u, weight);
    add(u, u, 1 - 2 * u, weight);
  }
}

/// The same over the sector that a cell has at its grain k. Split at the pole of its three directions, since the
/// triangle of a flat cell is nearly half of the sphere.
sphere_moments moments_of_sector(const pore_body<double>& body, std::size_t k) {
  const auto towards = [&](std::size_t other) {
    const vec3<double> d = other < body.grain_count ? body.grains[other].centre - body.grains[k].centre
                                                    : -body.walls[other - body.grain_count].normal;
    return d / norm(d);
  };
  const auto& slots = facet_vertices[k];
  std::array<vec3<double>, 3> corner{towards(slots[0]), towards(slots[1]), towards(slots[2])};
  if (triple(corner[0], corner[1], corner[2]) < 0) {
    std::swap(corner[1], corner[2]);
  }
  const vec3<double> normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const vec3<double> pole = normal / norm(normal);
  sphere_moments m;
  for (std::size_t i = 0; i < 3; ++i) {
    add_triangle(m, pole, corner[i], corner[(i + 1) % 3], 4);
  }
  return m;
}

}  // namespace

TEST_CASE("the parts of a facet sum to its area, none is negative") {
  for (const bool periodic : {false, true}) {
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      CAPTURE(s.name);
      const flow_nodes nodes(s.net);
      for (std::size_t i = 0; i < s.net.throat_count(); ++i) {
        const throat_id t(i);
        if (s.net.is_boundary(t) || nodes.inside(s.net, t)) {
          continue;
        }
        const throat<double> seen = nodes.throat_between(s.net, t);
        for (const auto wall : {wall_condition::no_slip, wall_condition::slip}) {
          const facet_load load = share_by_wetted_area{wall}(seen);
          double sum = 0;
          double least = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            sum += load.pressure[k] + load.viscous[k];
            least = std::min({least, load.pressure[k], load.viscous[k]});
          }
          double largest = norm(seen.area_vector);
          for (std::size_t k = 0; k < seen.grain_count; ++k) {
            largest = std::max(largest, seen.grains[k].radius * seen.grains[k].radius);
          }
          CHECK(std::abs(sum - norm(seen.area_vector)) < 1e-14 * largest);
          CHECK(least > -1e-14 * largest);
        }
      }
    }
  }
}

TEST_CASE("a uniform pressure stresses the grains by −p times their share of the volume") {
  for (const bool periodic : {false, true}) {
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      CAPTURE(s.name);
      double solid = 0;
      double volume = 0;
      for (std::size_t i = 0; i < s.net.pore_count(); ++i) {
        solid += sector_volume(pore_body_at(s.net, pore_id(i)));
        volume += s.net.volume(pore_id(i));
      }
      const fluid_forces f = forces_of_pressure(s.net, flow_nodes(s.net), pressure_field(s.net, 2.5), {},
                                                share_by_wetted_area{}, {.stress = true});
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          CHECK(f.stress[i][j] == doctest::Approx(i == j ? -2.5 * solid / volume : 0).epsilon(1e-12));
        }
      }
    }
  }
}

TEST_CASE("pressure that differs from pore to pore gives a symmetric stress and no torque") {
  for (const bool periodic : {false, true}) {
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      CAPTURE(s.name);
      const flow_nodes nodes(s.net, {.coincidence = 0, .flatness = 0});  // every facet counts
      const vec3<double> gradient = periodic ? vec3<double>{0.5, -1, 2} : vec3<double>{};
      const fluid_forces f =
          forces_of_pressure(s.net, nodes, arbitrary_pressure(s.net, 4), gradient, only_pressure{}, {.stress = true});
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(f.stress[i][i] < 0);
        for (std::size_t j = 0; j < i; ++j) {
          CHECK(std::abs(f.stress[i][j] - f.stress[j][i]) < 1e-12);
        }
      }
      for (const vec3<double>& torque : f.torques) {
        CHECK(norm(torque) == 0);
      }
    }
  }
}

TEST_CASE("pressure forces and stress are the tractions −p n on the spheres, integrated sector by sector") {
  for (const bool periodic : {false, true}) {
    const packing p = periodic ? dense(60, {true, true, true}, 7) : dense(60, {}, 7);
    const network net = triangulated(p);
    const pressure_field pressure = arbitrary_pressure(net, 6);
    const vec3<double> gradient = periodic ? vec3<double>{0.1, -0.05, 0.02} : vec3<double>{};
    std::vector<vec3<double>> force(net.grain_count());
    std::array<vec3<double>, 3> stress{};
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      const pore_body<double> body = pore_body_at(net, pore_id(i));
      for (std::size_t k = 0; k < body.grain_count; ++k) {
        const auto m = moments_of_sector(body, k);
        const double r = body.grains[k].radius;
        const image at = net.image_of(pore_id(i), k);
        const double here = pressure[pore_id(i)] - dot(gradient, net.region().shift(at));  // beside the grain itself
        force[net.vertices(pore_id(i))[k].grain().index()] -= m.first * (here * r * r);
        for (std::size_t j = 0; j < 3; ++j) {
          stress[j] -= m.second[j] * (here * r * r * r / p.bounds->volume());
        }
      }
    }
    const flow_nodes nodes(net, {.coincidence = 0, .flatness = 0});
    const fluid_forces f = forces_of_pressure(net, nodes, pressure, gradient, only_pressure{}, {.stress = true});
    double worst = 0;
    for (std::size_t g = 0; g < force.size(); ++g) {
      worst = std::max(worst, norm(f.pressure[g] - force[g]));
    }
    CHECK(worst < 1e-8);  // the rule's own error, 64 times larger with one level less; forces are of order 1
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(norm(f.stress[j] - stress[j]) < 1e-8);
      CHECK(norm(stress[j]) > 0.1);
    }
    MESSAGE("forces within " << worst << ", stress within " << norm(f.stress[0] - stress[0]));
  }
}

TEST_CASE("flow along the axis of a lattice turns no grain, and pulls all alike") {
  for (const auto kind : {lattice_kind::simple_cubic, lattice_kind::body_centred, lattice_kind::face_centred}) {
    const network net = triangulated(lattice(kind, {3, 3, 3}, 0.5, {true, true, true}));
    flow_conditions c;
    c.mean_gradient = {0, 0, -1};
    auto flow = flow_of(net, water(), c);
    CHECK(flow.solve().ok());
    const fluid_forces f = forces_on_grains(flow);
    const double each = net.region().bounds.volume() / static_cast<double>(net.grain_count());
    for (std::size_t g = 0; g < net.grain_count(); ++g) {
      CAPTURE(g);
      const vec3<double> force = f.on(grain_id(g));
      CHECK(norm(force - vec3<double>{0, 0, each}) < 1e-12 * each);
      CHECK(norm(f.torques[g]) < 1e-12 * each);
    }
  }
}

TEST_CASE("the pressure on the walls of a closed box and the forces inside it balance") {
  for (const scene& s : walled_scenes()) {
    CAPTURE(s.name);
    const pressure_field p = arbitrary_pressure(s.net, 9);
    vec3<double> sum = forces_of_pressure(s.net, flow_nodes(s.net, {.coincidence = 0, .flatness = 0}), p).total();
    const auto walls = pressure_on_walls(s.net, p);
    double size = 0;
    for (const vec3<double>& w : walls) {
      sum += w;
      size += norm(w);
    }
    CHECK(norm(sum) < 1e-12 * size);
  }
}

TEST_CASE("the exact facts of a flow hold with the multigrid solver too, to the tolerance that it is given") {
  const solve_options tight{.tolerance = 1e-13};
  const multigrid_solver<> multigrid({.coarsest = 50});  // a hierarchy, small as the packings are
  const auto check = [&](const scene& s, const auto& law) {
    CAPTURE(s.name);
    const bool periodic = s.net.region().any_periodic();
    const vec3<double> gradient{-0.5, 2.0, 1.25};
    flow_options options{.conditions = periodic ? flow_conditions{} : between(face::y_min, 3.0, face::y_max, 1.0),
                         .refused = refused_throats::closed};
    if (periodic) {
      options.conditions.mean_gradient = gradient;
    }
    saturated_flow flow(s.net, law, multigrid, options);
    const solve_report report = flow.solve({}, tight);
    CHECK(report.ok());
    const vec3<double> size = s.net.region().bounds.size();
    const fluid_forces f = forces_on_grains(flow);
    if (periodic) {
      const vec3<double> expected = gradient * -s.net.region().bounds.volume();
      CHECK(norm(f.total() - expected) < 1e-12 * norm(expected));
    } else {
      const double push = 2.0 * size.x * size.z;
      CHECK(f.total().y == doctest::Approx(push).epsilon(1e-12));
      CHECK(norm(f.total() - boundary_force(s.net, flow.driving_pressure())) < 1e-12 * push);
      const double in = flow.flux(face::y_min);
      CHECK(in > 0);
      CHECK(std::abs(flow.flux(face::y_max) + in) < 1e-11 * in);  // a balance of fluxes is as good as the residual
    }
    return report.iterations;
  };
  std::size_t iterations = 0;
  for (const bool periodic : {false, true}) {
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      iterations = std::max(iterations, check(s, water()));
      iterations = std::max(iterations, check(s, arbitrary_law{}));
    }
  }
  CHECK(iterations > 3);  // it was no direct solution
}
