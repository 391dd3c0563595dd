// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/network/measure.hpp"
#include "tetrapore/one_phase.hpp"
#include "tetrapore/solver/ldlt.hpp"

#include <doctest/doctest.h>

#include "support/small_networks.hpp"

#include <cmath>
#include <numeric>

using namespace tetrapore;

namespace {

/// The same conductance everywhere, except at one facet, told by its area.
struct even_law {
  double value = 1;
  double area_of_other = 0;
  conductance_status other = conductance_status::ok;

  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t) const noexcept {
    if (other != conductance_status::ok && norm(t.area_vector) == T(area_of_other)) {
      return {T(verdict_of(other) == verdict::absent ? 0.0 : quiet_nan<double>), other};
    }
    return {T(value), conductance_status::ok};
  }
};
static_assert(conductance_law<even_law>);

network box_of_two() {
  network net = two_grains_in_a_box();
  measure(net);
  return net;
}

using flow_type = saturated_flow<even_law, ldlt_solver<>>;

flow_type make(const network& net, const flow_options& options, const even_law& law = {}) {
  return flow_type(net, law, ldlt_solver<>{}, options);
}

double sum(std::span<const double> v) { return std::accumulate(v.begin(), v.end(), 0.0); }

/// What follows from a piston that enters at z_max, with grains at rest.
volume_rates piston(const network& net, double speed) {
  const std::vector<vec3<double>> still(net.grain_count());
  motion m{.velocities = still};
  m.walls[static_cast<std::size_t>(face::z_max)] = {0, 0, -speed};
  return rates_of_volume(net, m);
}

}  // namespace

TEST_CASE("a fluid at rest has the pressure of its weight, moves nothing, and lifts the grains by what they displace") {
  const network net = box_of_two();
  flow_options o{.fluid = {.density = 1000, .gravity = {0, 0, -9.81}}};
  o.conditions.at(face::z_max) = held_pressure(1e5);
  auto flow = make(net, o);
  CHECK(flow.solve().ok());
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const double depth = 3 - net.power_centre(pore_id(i)).z;
    CHECK(flow.pressure()[pore_id(i)] == doctest::Approx(1e5 + 9810 * depth).epsilon(1e-14));
  }
  CHECK(std::abs(flow.flux(face::z_max)) < 1e-10);  // of 1e5 Pa times a conductance of 1
  const fluid_forces f = forces_on_grains(flow);
  CHECK(norm(f.total()) < 1e-9);
  const auto lift = buoyancy(net, o.fluid);
  CHECK(lift[0].z == doctest::Approx(9810 * 4.0 / 3.0 * pi<double> * 0.4 * 0.4 * 0.4));
  CHECK(lift[0].x == 0);
  // the nodes of this network lie on its walls
  CHECK(pressure_on_walls(net, flow.pressure())[static_cast<std::size_t>(face::z_min)].z ==
        doctest::Approx(-(1e5 + 9810 * 3) * 4 * 2));
}

TEST_CASE("a compressible fluid in a closed box takes up what the box loses") {
  const network net = box_of_two();
  auto flow = make(net, {.fluid = {.bulk_modulus = 2e3}});
  for (double& p : flow.pressure().values()) {
    p = 7;
  }
  const volume_rates rates = piston(net, 0.01);
  const double dt = 0.5;
  CHECK(flow.step(dt, rates).ok());
  double taken_up = 0;
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    taken_up += net.void_volume(pore_id(i)) * (flow.pressure()[pore_id(i)] - 7) / 2e3;
  }
  CHECK(taken_up == doctest::Approx(0.01 * 4 * 2 * dt).epsilon(1e-12));
  // in many small steps the same amount, and a mean that rises with it
  const double after_one = flow.pressure()[pore_id(0)];
  CHECK(flow.step(dt).ok());
  CHECK(std::abs(flow.pressure()[pore_id(0)] - after_one) < 40);
}

TEST_CASE("a compressible fluid is squeezed out through a held face without loss") {
  const network net = box_of_two();
  flow_options o{.fluid = {.bulk_modulus = 50}};
  o.conditions.at(face::z_min) = held_pressure(3);
  auto flow = make(net, o);
  const volume_rates rates = piston(net, 0.01);
  double lost = 0;
  double left = 0;
  double stored = 0;
  const double dt = 0.25;
  for (int n = 0; n < 20; ++n) {
    std::vector<double> before(flow.pressure().values().begin(), flow.pressure().values().end());
    CHECK(flow.step(dt, rates, {.tolerance = 1e-15}).kind() != verdict::refused);
    lost -= dt * sum(rates.values);
    left -= dt * flow.flux(face::z_min);
    for (std::size_t i = 0; i < before.size(); ++i) {
      stored += net.void_volume(pore_id(i)) * (flow.pressure()[pore_id(i)] - before[i]) / 50;
    }
  }
  CHECK(left + stored == doctest::Approx(lost).epsilon(1e-12));
}

TEST_CASE("a closed box that loses volume is refused by the names of its pores, and keeps its pressure") {
  const network net = box_of_two();
  auto flow = make(net, {});
  CHECK(flow.solve().ok());
  const std::vector<double> before(flow.pressure().values().begin(), flow.pressure().values().end());
  CHECK_THROWS_WITH_AS((void)flow.solve(piston(net, 0.01)), doctest::Contains("a cluster of 12 pores: 0, "),
                       network_error);
  CHECK(std::equal(before.begin(), before.end(), flow.pressure().values().begin()));
  CHECK(flow.report().floating_clusters == 1);
}

TEST_CASE("a sealed pore has the pressure of nobody, and is named when it is squeezed") {
  const network net = box_of_two();
  // the corner pore of grain 0 at y_min, z_min, x_min: pore 1; its facets have areas of their own
  flow_options o;
  o.conditions.at(face::z_max) = held_pressure(1);
  auto flow = make(net, o);
  std::vector<double> k(net.throat_count(), 1.0);
  for (const throat_id t : net.throats(pore_id(1))) {
    if (t.valid()) {
      k[t.index()] = 0;
    }
  }
  flow.set_conductances(k);
  CHECK(flow.solve().ok());
  CHECK(flow.report().floating_clusters == 1);
  volume_rates squeeze;
  squeeze.values.assign(net.pore_count(), 0.0);
  squeeze.values[1] = -1;
  CHECK_THROWS_WITH_AS((void)flow.solve(squeeze), doctest::Contains("a cluster of 1 pores: 1: found sources"),
                       network_error);
}

TEST_CASE("conditions that contradict each other name the pore, and a condition of its own decides") {
  const network net = box_of_two();
  flow_options o;
  o.conditions.at(face::z_max) = held_pressure(1);
  o.conditions.at(face::x_min) = held_pressure(0);
  CHECK_THROWS_WITH_AS((void)make(net, o), doctest::Contains("one pressure, or a condition of its own"),
                       parameter_error);
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    if (net.touches(pore_id(i), face::z_max) && net.touches(pore_id(i), face::x_min)) {
      o.conditions.pores.push_back({pore_id(i), held_pressure(0.5)});
    }
  }
  auto flow = make(net, o);
  CHECK(flow.solve().ok());
  CHECK(flow.pressure()[o.conditions.pores.front().pore] == 0.5);
  CHECK(flow.flux(face::z_max) + flow.flux(face::x_min) + flow.flux_of_held_pores() ==
        doctest::Approx(0).epsilon(1e-13));
}

TEST_CASE("what a condition may not say is refused by name") {
  const network net = box_of_two();
  const auto refused = [&](const flow_options& o, const char* text) {
    CHECK_THROWS_WITH_AS((void)make(net, o), doctest::Contains(text), parameter_error);
  };
  flow_options o;
  o.conditions.mean_gradient = {0, 1, 0};
  refused(o, "mean gradient along axis 1");
  o = {};
  o.conditions.at(face::y_min) = held_pressure(quiet_nan<double>);
  refused(o, "condition at y_min");
  o = {};
  o.conditions.pores.push_back({pore_id(12), held_pressure(0)});
  refused(o, "condition of pore 12");
  o = {};
  o.fluid.bulk_modulus = 0;
  refused(o, "bulk modulus");
  const network open = [] {
    network n = one_tetrahedron();
    measure(n);
    return n;
  }();
  for (const face f : all_faces) {
    if (!open.touches(pore_id(0), f)) {
      o = {};
      o.conditions.at(f) = held_pressure(1);
      CHECK_THROWS_WITH_AS((void)make(open, o), doctest::Contains("a face that no pore touches"), parameter_error);
    }
  }
  auto flow = make(net, {});
  CHECK_THROWS_WITH_AS((void)flow.flux(throat_id(0)), doctest::Contains("no solution"), parameter_error);
  CHECK_THROWS_AS((void)flow.step(0), parameter_error);
  CHECK_THROWS_AS((void)flow.step(-1), parameter_error);
}

TEST_CASE("a throat that the law refuses fails the set-up by name, or is closed and counted") {
  const network net = box_of_two();
  throat_id inner;
  for (std::size_t i = 0; i < net.throat_count() && !inner.valid(); ++i) {
    inner = net.is_boundary(throat_id(i)) ? inner : throat_id(i);
  }
  const flow_nodes nodes(net);
  const double area = norm(nodes.throat_between(net, inner).area_vector);
  for (const auto why : {conductance_status::negative_hydraulic_radius, conductance_status::not_covered}) {
    const even_law law{1, area, why};
    CHECK_THROWS_WITH_AS((void)make(net, {}, law),
                         doctest::Contains(("throat " + std::to_string(inner.index()) + " (the first of ").c_str()),
                         network_error);
    auto flow = make(net, {.refused = refused_throats::closed}, law);
    CHECK(flow.conductances().counts[why] >= 1);
    CHECK(flow.conductances().counts.first(why) == inner);
    CHECK(flow.conductances().counts.refused() == flow.conductances().counts[why]);
    CHECK(flow.conductances().values[inner.index()] == 0);
  }
  // what is closed by solid is no error
  const auto flow = make(net, {}, even_law{1, area, conductance_status::closed});
  CHECK(flow.conductances().counts.refused() == 0);
  CHECK(flow.conductances().counts[conductance_status::closed] >= 1);
}

TEST_CASE("an imposed flux of a face is spread over its area") {
  const network net = box_of_two();
  flow_options o;
  o.conditions.at(face::z_min) = imposed_flux(2.0);
  o.conditions.at(face::z_max) = held_pressure(0);
  double area = 0;
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    area += covered_area(net, pore_id(i), face::z_min);
  }
  CHECK(area == doctest::Approx(4 * 2).epsilon(1e-14));
  auto flow = make(net, o);
  CHECK(flow.solve().ok());
  CHECK(flow.flux(face::z_max) == doctest::Approx(-2.0).epsilon(1e-13));
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const pore_id p(i);
    if (flow.system().is_held(p)) {
      continue;
    }
    double out = 0;
    for (const throat_id t : net.throats(p)) {
      if (t.valid()) {
        out += net.pores(t)[0] == p ? flow.flux(t) : -flow.flux(t);
      }
    }
    CHECK(out == doctest::Approx(2.0 * covered_area(net, p, face::z_min) / 8).epsilon(1e-12));
  }
}

TEST_CASE("the flow follows its grains, and new conditions need a new solution") {
  network net = box_of_two();
  flow_options o;
  o.conditions.at(face::x_min) = held_pressure(1);
  o.conditions.at(face::x_max) = held_pressure(0);
  auto flow = make(net, o);
  CHECK(flow.solve().ok());
  const double q = flow.flux(face::x_min);
  auto grains = std::vector<sphere<double>>(net.grains().begin(), net.grains().end());
  grains[0].centre.y += 0.125;
  follow(net, grains);
  flow.update();
  CHECK(flow.solve().ok());
  CHECK(flow.flux(face::x_min) == doctest::Approx(q));  // the same conductances
  flow_conditions c = o.conditions;
  c.at(face::x_min) = held_pressure(3);
  flow.set_conditions(c);
  CHECK_THROWS_AS((void)flow.flux(face::x_min), parameter_error);
  CHECK(flow.solve().ok());
  CHECK(flow.flux(face::x_min) == doctest::Approx(3 * q));
  CHECK(box_permeability(flow, face::x_min, face::x_max, 2.0) == doctest::Approx(3 * q * 2.0 * 4 / (6 * 3)));
  CHECK_THROWS_AS((void)box_permeability(flow, face::x_min, face::y_max, 2.0), parameter_error);
}

TEST_CASE("conditions of single pores are asked for again after a rebuild") {
  network net = box_of_two();
  flow_options o;
  o.conditions.pores.push_back({pore_id(3), held_pressure(1)});
  auto flow = make(net, o);
  CHECK(flow.solve().ok());
  net = network(net.arrays(), net.epoch() + 1);
  CHECK_THROWS_WITH_AS(flow.update(), doctest::Contains("conditions of single pores"), parameter_error);
  flow.update({.pores = {{pore_id(5), held_pressure(2)}}});
  CHECK(flow.solve().ok());
  for (const double p : flow.pressure().values()) {
    CHECK(p == 2);
  }
}
