// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include "support/compiled_triangulation.hpp"
#include "support/flow_scenes.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <map>

// The exact facts of one-phase flow (paper §2.2): they hold to rounding whatever the packing and the conductances.

using namespace tetrapore;
using namespace flow_scenes;

namespace {

constexpr double exact = 1e-12;

double sum_of_magnitudes(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) {
    sum += std::abs(x);
  }
  return sum;
}

/// Rows of a matrix.
using matrix = std::array<vec3<double>, 3>;
vec3<double> times(const matrix& m, const vec3<double>& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

double difference(const vec3<double>& a, const vec3<double>& b) { return norm(a - b); }

}  // namespace

TEST_CASE("volume rates sum to zero in a closed box, however its grains move") {
  for (const bool periodic : {false, true}) {
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      CAPTURE(s.name);
      std::mt19937_64 random(1);
      std::vector<vec3<double>> v(s.net.grain_count());
      for (auto& x : v) {
        x = {unit_draw(random) - 0.5, unit_draw(random) - 0.5, unit_draw(random) - 0.5};
      }
      const volume_rates rates = rates_of_volume(s.net, {.velocities = v});
      const double sum = compensated_sum(rates.values);
      CHECK(std::abs(sum) <= exact * sum_of_magnitudes(rates.values));
      CHECK(std::abs(sum) <= rates.rounding);
    }
  }
}

TEST_CASE("grains that move with the velocity A x change each cell by tr(A) times its volume") {
  // walls keep their direction, so in a walled box A is a stretch along the axes; a periodic box takes any A
  for (const bool periodic : {false, true}) {
    const matrix a = periodic ? matrix{{{0.3, -0.7, 0.2}, {0.5, 0.1, 0.9}, {-0.4, 0.6, 0.25}}}
                              : matrix{{{0.3, 0, 0}, {0, 0.1, 0}, {0, 0, 0.25}}};
    const double trace = 0.65;
    for (const scene& s : periodic ? periodic_scenes() : walled_scenes()) {
      CAPTURE(s.name);
      const box& b = s.net.region().bounds;
      std::vector<vec3<double>> v;
      for (const auto& g : s.net.grains()) {
        v.push_back(times(a, g.centre - b.lo));
      }
      motion m{.velocities = v};
      const vec3<double> size = b.size();
      m.period_rates = {times(a, {size.x, 0, 0}), times(a, {0, size.y, 0}), times(a, {0, 0, size.z})};
      for (const face f : all_faces) {
        m.walls[static_cast<std::size_t>(f)] = times(a, is_max(f) ? size : vec3<double>{});
      }
      const volume_rates rates = rates_of_volume(s.net, m);
      double worst = 0;
      for (std::size_t i = 0; i < s.net.pore_count(); ++i) {
        const pore_id p(i);
        const double cube = std::pow(longest_edge2(pore_body_at(s.net, p)), 1.5) + std::abs(s.net.volume(p));
        // velocities of the size of the box, of which a cell sees differences
        const double reach = norm(size) * std::pow(cube, 2.0 / 3.0);
        worst = std::max(worst, std::abs(rates.values[i] - trace * s.net.volume(p)) / (cube + 1e-2 * reach));
      }
      CHECK(worst < exact);
      CHECK(compensated_sum(rates.values) == doctest::Approx(trace * b.volume()).epsilon(exact));
    }
  }
}

TEST_CASE("a uniform pressure moves no fluid and no grain") {
  for (const scene& s : walled_scenes()) {
    CAPTURE(s.name);
    auto flow = flow_of(s.net, water(), between(face::y_min, 7.5, face::x_max, 7.5));
    CHECK(flow.solve().ok());
    CHECK(flow.flux(face::y_min) == 0);
    CHECK(flow.flux(face::x_max) == 0);
    const fluid_forces f = forces_on_grains(flow);
    for (std::size_t g = 0; g < s.net.grain_count(); ++g) {
      CHECK(f.on(grain_id(g)) == vec3<double>{});
    }
    for (const double p : flow.pressure().values()) {
      CHECK(p == 7.5);
    }
  }
}

TEST_CASE("the forces on grains and walls sum to what the boundary pushes, whatever the conductances") {
  for (const scene& s : walled_scenes()) {
    CAPTURE(s.name);
    const vec3<double> size = s.net.region().bounds.size();
    const auto check = [&](const auto& law) {
      auto flow = flow_of(s.net, law, between(face::y_min, 3.0, face::y_max, 1.0));
      CHECK(flow.solve().ok());
      const double push = 2.0 * size.x * size.z;
      for (const auto wall : {wall_condition::no_slip, wall_condition::slip}) {
        const fluid_forces f = forces_on_grains(flow, share_by_wetted_area{wall});
        CHECK(f.total().y == doctest::Approx(push).epsilon(exact));
        CHECK(difference(f.total(), boundary_force(s.net, flow.driving_pressure())) < exact * push);
        CHECK((wall == wall_condition::no_slip || norm(f.walls[0]) == 0));
      }
    };
    check(water());
    check(arbitrary_law{});
  }
}

TEST_CASE("hydraulics that are kept from the law to the forces change no bit of either") {
  const auto same = [](const scene& s, const auto& law, const flow_conditions& c) {
    CAPTURE(s.name);
    flow_options how{.conditions = c, .refused = refused_throats::closed};
    saturated_flow anew(s.net, law, ldlt_solver<>{}, how);
    how.hydraulics = keep_hydraulics::yes;
    saturated_flow kept(s.net, law, ldlt_solver<>{}, how);
    CHECK(anew.conductances().hydraulics.empty());
    CHECK(kept.conductances().hydraulics.size() == s.net.throat_count());
    CHECK(kept.conductances().values == anew.conductances().values);
    for (int round = 0; round < 2; ++round) {  // conductances of the caller's own leave the geometry
      CHECK(anew.solve().ok());
      CHECK(kept.solve().ok());
      const fluid_forces a = forces_on_grains(anew);
      const fluid_forces b = forces_on_grains(kept);
      CHECK(a.pressure == b.pressure);
      CHECK(a.viscous == b.viscous);
      CHECK(a.torques == b.torques);
      CHECK(a.walls == b.walls);
      const std::vector<double> ones(s.net.throat_count(), 1.0);
      anew.set_conductances(ones);
      kept.set_conductances(ones);
    }
  };
  for (const scene& s : walled_scenes()) {
    same(s, water(), between(face::y_min, 3.0, face::y_max, 1.0));
    same(s, arbitrary_law{}, between(face::y_min, 3.0, face::y_max, 1.0));
  }
  flow_conditions tilted;
  tilted.mean_gradient = {-0.5, 2.0, 1.25};
  for (const scene& s : periodic_scenes()) {
    same(s, water(), tilted);
  }
}

TEST_CASE("the forces on the grains of a periodic box sum to −V ∇p, whatever the conductances") {
  const vec3<double> gradient{-0.5, 2.0, 1.25};
  for (const scene& s : periodic_scenes()) {
    CAPTURE(s.name);
    flow_conditions c;
    c.mean_gradient = gradient;
    const vec3<double> expected = gradient * -s.net.region().bounds.volume();
    const auto check = [&](const auto& law) {
      auto flow = flow_of(s.net, law, c);
      CHECK(flow.solve().ok());
      const fluid_forces f = forces_on_grains(flow);
      CHECK(difference(f.total(), expected) < exact * norm(expected));
      CHECK(difference(boundary_force(s.net, flow.pressure(), gradient), expected) < exact * norm(expected));
    };
    check(water());
    check(arbitrary_law{});
  }
}

TEST_CASE("what enters at one face leaves at the other") {
  for (const scene& s : walled_scenes()) {
    CAPTURE(s.name);
    const auto check = [&](const auto& law) {
      auto flow = flow_of(s.net, law, between(face::z_max, 1e5 + 1.0, face::z_min, 1e5));
      CHECK(flow.solve().ok());
      const double q = flow.flux(face::z_max);
      CHECK(q > 0);
      CHECK(flow.flux(face::z_min) == doctest::Approx(-q).epsilon(exact));
    };
    check(water());
    check(arbitrary_law{});
  }
}

TEST_CASE("an imposed flux comes out where pressure is held, and needs the pressure that the flux came from") {
  const packing p = dense(120, {}, 3);
  const network net = triangulated(p);
  flow_conditions c;
  c.at(face::x_min) = imposed_flux(0.125);
  c.at(face::x_max) = held_pressure(4.0);
  auto flow = flow_of(net, water(), c);
  CHECK(flow.solve().ok());
  CHECK(flow.flux(face::x_max) == doctest::Approx(-0.125).epsilon(exact));
  CHECK(flow.flux(face::x_min) == 0.125);
}

TEST_CASE("the grains' motion drives the fluid out: what the box loses leaves at the held face") {
  for (const scene& s : walled_scenes()) {
    CAPTURE(s.name);
    const box& b = s.net.region().bounds;
    std::vector<vec3<double>> v;
    for (const auto& g : s.net.grains()) {
      v.push_back({0, 0, -0.01 * (g.centre.z - b.lo.z)});
    }
    motion m{.velocities = v};
    m.walls[static_cast<std::size_t>(face::z_max)].z = -0.01 * b.size().z;
    flow_conditions c;
    c.at(face::z_max) = held_pressure(0);
    auto flow = flow_of(s.net, water(), c);
    CHECK(flow.solve(rates_of_volume(s.net, m)).ok());
    CHECK(flow.flux(face::z_max) == doctest::Approx(-0.01 * b.volume()).epsilon(exact));
  }
}

TEST_CASE("the permeability tensor is symmetric, as mean velocity and as dissipation") {
  for (const scene& s : periodic_scenes()) {
    CAPTURE(s.name);
    auto flow = flow_of(s.net, water(), {});
    const permeability_tensor k = tensor_of_permeability(flow, 1.0);
    const double size = k(0, 0) + k(1, 1) + k(2, 2);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(k.reports[axis].ok());
      CHECK(k(axis, axis) > 0);
      flow_conditions c;
      c.mean_gradient[axis] = -1.0;
      flow.set_conditions(c);
      CHECK(flow.solve().ok());
      const vec3<double> u = mean_velocity(flow);
      for (std::size_t j = 0; j < 3; ++j) {
        CHECK(std::abs(u[j] - k(j, axis)) < exact * size);
      }
    }
  }
}

TEST_CASE("the permeability tensor turns with the packing") {
  const packing p = dense(120, {true, true, true}, 5);
  const auto turn = [](const vec3<double>& v) { return vec3<double>{v.y, v.z, v.x}; };
  packing turned = p;
  turned.bounds = box{turn(p.bounds->lo), turn(p.bounds->hi)};
  for (auto& g : turned.grains) {
    g.centre = turn(g.centre);
  }
  const network net = triangulated(p);
  const network net_turned = triangulated(turned);
  auto flow = flow_of(net, water(), {});
  auto flow_turned = flow_of(net_turned, water(), {});
  const permeability_tensor k = tensor_of_permeability(flow, 1.0);
  const permeability_tensor k_turned = tensor_of_permeability(flow_turned, 1.0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(std::abs(k_turned(i, j) - k((i + 1) % 3, (j + 1) % 3)) < exact * k(0, 0));
    }
  }
}

TEST_CASE("fluxes stay and forces turn when an open packing is rotated") {
  const packing p = dense(150, {}, 8);
  const vec3<double> u{2.0 / 3, 1.0 / 3, -2.0 / 3};
  const vec3<double> v{-2.0 / 3, 2.0 / 3, -1.0 / 3};
  const vec3<double> w = cross(u, v);
  const auto rotate = [&](const vec3<double>& x) { return u * x.x + v * x.y + w * x.z; };
  std::vector<sphere<double>> turned;
  for (const auto& g : p.grains) {
    turned.push_back({rotate(g.centre), g.radius});
  }
  const auto run = [&](const std::vector<sphere<double>>& grains) {
    const network net = compiled_triangulation{}(grains, unbounded()).net;
    flow_conditions c;  // two grains whose pores are reservoirs
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      const auto has = [&](std::size_t g) {
        return std::count(net.vertices(pore_id(i)).begin(), net.vertices(pore_id(i)).end(), vertex(grain_id(g))) > 0;
      };
      if (has(0) != has(1)) {
        c.pores.push_back({pore_id(i), held_pressure(has(0) ? 1.0 : 0.0)});
      }
    }
    auto flow = flow_of(net, water(), c);
    CHECK(flow.solve().ok());
    double q = 0;
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      q += flow.flux(throat_id(i)) * flow.pressure_drop(throat_id(i));
    }
    return std::pair{q, forces_on_grains(flow, share_by_wetted_area{}, {.stress = true})};
  };
  const auto [q, forces] = run(p.grains);
  const auto [q_turned, forces_turned] = run(turned);
  CHECK(q_turned == doctest::Approx(q).epsilon(1e-11));
  double largest = 0;
  double largest_torque = 0;
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    largest = std::max(largest, norm(forces.on(grain_id(g))));
    largest_torque = std::max(largest_torque, norm(forces.torques[g]));
  }
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    CHECK(difference(forces_turned.on(grain_id(g)), rotate(forces.on(grain_id(g)))) < 1e-10 * largest);
    CHECK(difference(forces_turned.torques[g], rotate(forces.torques[g])) < 1e-10 * largest_torque);
  }
  CHECK(largest_torque > 0);
  // stress: R σ Rᵀ; of its entries those off the diagonal are not alike
  const matrix& sigma = forces.stress;
  const std::array<vec3<double>, 3> rows{rotate(sigma[0]), rotate(sigma[1]), rotate(sigma[2])};  // σ Rᵀ
  const double size = norm(sigma[0]) + norm(sigma[1]) + norm(sigma[2]);
  for (std::size_t j = 0; j < 3; ++j) {
    const vec3<double> column = rotate({rows[0][j], rows[1][j], rows[2][j]});
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(std::abs(forces_turned.stress[i][j] - column[i]) < 1e-10 * size);
    }
  }
  CHECK(difference(sigma[0], {sigma[0].x, sigma[1].x, sigma[2].x}) > 1e-6 * size);
}

TEST_CASE("the permeability over the square of the unit of length is the same in every unit") {
  for (const bool periodic : {false, true}) {
    const packing p = dense(120, {periodic, periodic, periodic}, 3);
    const auto k = [&](double unit) {
      const network net = triangulated(scaled(p, unit));
      auto flow = flow_of(net, water(), periodic ? flow_conditions{} : between(face::y_min, 1, face::y_max, 0));
      if (periodic) {
        return tensor_of_permeability(flow, 1.0)(1, 1) / (unit * unit);
      }
      CHECK(flow.solve().ok());
      return box_permeability(flow, face::y_min, face::y_max, 1.0) / (unit * unit);
    };
    const double one = k(1.0);
    for (const double unit : {1e-6, 1e-3, 0.37, 1e3, 1e6}) {
      CHECK(k(unit) == doctest::Approx(one).epsilon(1e-10));
    }
  }
}

TEST_CASE("after any rebuild a flow that is updated is the flow that is made anew") {
  for (const bool periodic : {false, true}) {  // with and without held nodes
    const packing p = dense(60, {periodic, periodic, periodic}, 7);
    flow_conditions c;
    if (periodic) {
      c.mean_gradient = {0, -1, 0};
    } else {
      c = between(face::y_min, 1, face::y_max, 0);
    }
    std::vector<sphere<double>> grains = p.grains;
    network net = triangulated(p);
    auto flow = flow_of(net, water(), c);
    std::mt19937_64 random(4);
    std::size_t alike = 0;
    for (int n = 0; n < 50; ++n) {
      for (std::size_t g = 0; g < grains.size(); ++g) {
        for (std::size_t k = 0; k < 3; ++k) {
          grains[g].centre[k] = p.grains[g].centre[k] + 0.08 * (unit_draw(random) - 0.5);
        }
      }
      const std::size_t before = net.pore_count();
      static_cast<void>(rebuild(net, compiled_triangulation{}, grains));
      alike += net.pore_count() == before ? 1U : 0U;
      flow.update();
      CHECK(flow.solve().ok());
      auto fresh = flow_of(net, water(), c);
      CHECK(fresh.solve().ok());
      if (periodic) {
        CHECK(mean_velocity(flow).y == doctest::Approx(mean_velocity(fresh).y).epsilon(exact));
      } else {
        CHECK(flow.flux(face::y_min) == doctest::Approx(fresh.flux(face::y_min)).epsilon(exact));
        CHECK(flow.flux(face::y_max) == doctest::Approx(-fresh.flux(face::y_min)).epsilon(exact));
      }
    }
    CHECK(alike > 0);  // those in which the number of pores tells nothing
  }
}

TEST_CASE("a condition of its own holds for all pores that are one node") {
  const network net = triangulated(lattice(lattice_kind::face_centred, {3, 3, 3}, 0.3));
  flow_conditions c = between(face::x_min, 1, face::z_max, 0);
  const flow_nodes nodes(net);
  std::vector<int> touched(nodes.size(), 0);
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    touched[nodes[pore_id(i)]] |=
        (net.touches(pore_id(i), face::x_min) ? 1 : 0) | (net.touches(pore_id(i), face::z_max) ? 2 : 0);
  }
  CHECK_THROWS_AS(static_cast<void>(flow_of(net, water(), c)), parameter_error);
  std::size_t conflicts = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (touched[n] == 3) {
      c.pores.push_back({nodes.pore(n), held_pressure(0.5)});
      ++conflicts;
    }
  }
  CHECK(conflicts > 0);
  auto flow = flow_of(net, water(), c);
  CHECK(flow.solve().ok());
  for (const pore_condition& own : c.pores) {
    CHECK(flow.pressure()[own.pore] == 0.5);
  }
}

TEST_CASE("nothing but a mean gradient may drive the flow that a permeability tensor is asked of") {
  const network net = triangulated(dense(60, {true, true, true}, 5));
  flow_conditions c;
  c.mean_gradient = {1, 2, 3};
  auto flow = flow_of(net, water(), c);
  const permeability_tensor k = tensor_of_permeability(flow);  // the viscosity is the law's
  CHECK(k(0, 0) == tensor_of_permeability(flow, 1.0)(0, 0));
  CHECK(flow.system().conditions().mean_gradient == c.mean_gradient);
  for (const flow_condition& own : {held_pressure(1), imposed_flux(0)}) {
    c.pores = {{pore_id(0), own}};
    flow.set_conditions(c);
    CHECK_THROWS_WITH_AS(static_cast<void>(tensor_of_permeability(flow, 1.0)), doctest::Contains("mean gradient"),
                         parameter_error);
    CHECK(flow.system().conditions().pores.size() == 1);
  }
  // a solution that throws leaves the conditions as they were
  c.pores.clear();
  flow.set_conditions(c);
  CHECK_THROWS_AS(static_cast<void>(tensor_of_permeability(flow, 1.0, {.balance = -1, .balance_floor = -1})),
                  network_error);
  CHECK(flow.system().conditions().mean_gradient == c.mean_gradient);
}

TEST_CASE("a source is not taken for the rounding of a mean gradient") {
  // a lattice under a gradient: the tilt of its throats cancels, and the rates, far smaller, stay
  const network net = triangulated(lattice(lattice_kind::simple_cubic, {3, 3, 3}, 0.3, {true, true, true}));
  flow_conditions c;
  c.mean_gradient = {1e18, 0, 0};
  auto flow = flow_of(net, water(), c);
  const flow_system& system = flow.system();
  std::vector<double> entering(system.nodes().size(), 0.0);
  entering[0] = 1e-3;
  entering[1] = -1e-3;
  const auto b = system.sources(net, flow.conductances().values, entering).b;
  CHECK(b[0] == 1e-3);
  CHECK(b[1] == -1e-3);
}

TEST_CASE(
    "a flow along a mean gradient is the start of one along another, of which only the part that repeats changes") {
  const network net = triangulated(dense(60, {true, true, true}, 5));
  flow_conditions c;
  c.mean_gradient = {0, -1, 0};
  saturated_flow flow(net, water(), multigrid_solver<>{}, {.conditions = c});
  CHECK(flow.solve().ok());
  const std::size_t cold = flow.report().iterations;
  flow.set_conditions(c);
  CHECK(flow.solve().ok());
  CHECK(flow.report().iterations <= 1);  // rounding of the pressure it starts from may cost one
  c.mean_gradient *= 1 + 1e-6;
  flow.set_conditions(c);
  CHECK(flow.solve().ok());
  CHECK(flow.report().iterations < cold / 2 + 2);
}

namespace {

/// The same law in a wrapper, with and without a word about walls.
struct silent_wrapper {
  hydraulic_radius inner;
  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t) const noexcept {
    return inner.conductance(t);
  }
};
struct telling_wrapper : silent_wrapper {
  friend wall_condition tetrapore_wall_condition(const telling_wrapper& law) { return law.inner.wall; }
};

}  // namespace

TEST_CASE("a law tells whether walls take shear by its member, or by the customisation point") {
  const hydraulic_radius slips{.viscosity = 1.0, .wall = wall_condition::slip};
  CHECK(wall_condition_of(slips) == wall_condition::slip);
  CHECK(wall_condition_of(silent_wrapper{slips}) == wall_condition::no_slip);
  CHECK(wall_condition_of(telling_wrapper{{slips}}) == wall_condition::slip);
  const network net = triangulated(dense(60, {}, 7));
  auto direct = flow_of(net, slips, between(face::y_min, 1, face::y_max, 0));
  auto wrapped = flow_of(net, telling_wrapper{{slips}}, between(face::y_min, 1, face::y_max, 0));
  CHECK(direct.solve().ok());
  CHECK(wrapped.solve().ok());
  CHECK(forces_on_grains(direct).viscous == forces_on_grains(wrapped).viscous);
  CHECK(norm(forces_on_grains(wrapped).walls[0]) == 0);
}
