// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/network/measure.hpp"
#include "tetrapore/one_phase.hpp"
#include "tetrapore/solver/ldlt.hpp"

#include <doctest/doctest.h>

#include "support/small_networks.hpp"

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cmath>
#include <memory>
#include <numeric>
#include <type_traits>

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

/// A solver that tells how it was called, and fails when it is told to.
struct watched_solver {
  struct record {
    bool warm = false;
    std::vector<double> start;
    solve_status factor = solve_status::ok;
    std::size_t solutions = 0;
  };
  ldlt_solver<> inner;
  std::shared_ptr<record> seen = std::make_shared<record>();

  void analyze(const network_graph& g) { inner.analyze(g); }
  [[nodiscard]] solve_report factorize(std::span<const double> w, std::span<const double> s) {
    solve_report r = inner.factorize(w, s);
    r.reason = r.ok() ? seen->factor : r.reason;
    return r;
  }
  [[nodiscard]] solve_report solve(std::span<const double> b, std::span<double> x, const solve_options& how = {}) {
    seen->warm = how.warm;
    seen->start.assign(x.begin(), x.end());
    ++seen->solutions;
    return inner.solve(b, x, how);
  }
};
static_assert(network_solver<watched_solver>);

/// Runs in blocks of one, and counts them.
struct counting_cores {
  std::shared_ptr<std::atomic<std::size_t>> blocks_run = std::make_shared<std::atomic<std::size_t>>(0);
  template <std::invocable<std::size_t, std::size_t> F>
  void blocks(std::size_t n, F&& f) const {
    for (std::size_t i = 0; i < n; ++i) {
      f(i, i + 1);
      ++*blocks_run;
    }
  }
};

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
  CHECK_THROWS_WITH_AS((void)flow.solve(piston(net, 0.01)), doctest::Contains("a cluster of 12 nodes, at pores 0, "),
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
  CHECK_THROWS_WITH_AS((void)flow.solve(squeeze),
                       doctest::Contains("a cluster of 1 nodes, at pores 1: found sources with the sum 1 m³/s"),
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

TEST_CASE("a flow does not keep a network that nobody keeps") {
  static_assert(std::is_constructible_v<flow_type, const network&, even_law, ldlt_solver<>, flow_options>);
  static_assert(std::is_constructible_v<flow_type, network&, even_law, ldlt_solver<>>);
  static_assert(!std::is_constructible_v<flow_type, network, even_law, ldlt_solver<>, flow_options>);
  static_assert(!std::is_constructible_v<flow_type, const network, even_law, ldlt_solver<>>);
}

TEST_CASE("a solver that has no factor is not asked for a solution, and its reason is told") {
  const network net = box_of_two();
  flow_options o;
  o.conditions.at(face::z_max) = held_pressure(1);
  for (const auto why : {solve_status::factorization_failed, solve_status::out_of_range}) {
    saturated_flow flow(net, even_law{}, watched_solver{}, o);
    const auto seen = flow.solver().seen;
    seen->factor = why;
    for (int n = 0; n < 2; ++n) {  // the second does not take the factor for granted
      CHECK(flow.solve().reason == why);
      CHECK(flow.report().reason == why);
      CHECK(seen->solutions == 0);
      CHECK_THROWS_AS((void)flow.flux(face::z_max), parameter_error);
      CHECK(flow.pressure()[pore_id(0)] == 0);
    }
    seen->factor = solve_status::ok;
    CHECK(flow.solve().ok());
    CHECK(flow.pressure()[pore_id(0)] == 1);
  }
}

TEST_CASE("a solution starts from the last one, from a guess of the caller's, or from nothing, as the options say") {
  const network net = box_of_two();
  flow_options o;
  o.conditions.at(face::z_min) = held_pressure(1);
  o.conditions.at(face::z_max) = held_pressure(0);
  saturated_flow flow(net, even_law{}, watched_solver{}, o);
  const auto seen = flow.solver().seen;
  CHECK(flow.solve().ok());
  CHECK(!seen->warm);                                 // nothing is known yet
  const auto start = [&](const flow_conditions& c) {  // what the present pressure is worth, less the mean held one
    const double level = 0.5 * (c.at(face::z_min).value + c.at(face::z_max).value);
    std::vector<double> x;
    for (std::size_t i = 0; i < flow.system().unknowns(); ++i) {
      x.push_back(flow.pressure()[flow.system().pore_of(i)] - level);
    }
    return x;
  };
  flow_conditions c = o.conditions;
  c.at(face::z_min) = held_pressure(1.5);
  const std::vector<double> expected = start(c);
  flow.set_conditions(c);
  CHECK(flow.solve().ok());
  CHECK(seen->warm);
  CHECK(seen->start == expected);
  CHECK(flow.solve({}, {}).ok());
  CHECK(!seen->warm);
  // a guess before the first solution
  saturated_flow fresh(net, even_law{}, watched_solver{}, o);
  const auto seen_fresh = fresh.solver().seen;
  fresh.pressure() = flow.pressure();
  const std::vector<double> guess = start(o.conditions);
  CHECK(fresh.solve({}, {.warm = true}).ok());
  CHECK(seen_fresh->warm);
  CHECK(seen_fresh->start == guess);
}

TEST_CASE("a pressure that was carried across a rebuild is the start of the next solution, one that was not is none") {
  for (const bool carried : {false, true}) {
    network net = box_of_two();
    flow_options o;
    o.conditions.at(face::z_min) = held_pressure(1);
    o.conditions.at(face::z_max) = held_pressure(0);
    saturated_flow flow(net, even_law{}, watched_solver{}, o);
    const auto seen = flow.solver().seen;
    CHECK(flow.solve().ok());
    net = network(net.arrays(), net.epoch() + 1);
    if (carried) {
      const auto p = flow.pressure().values();
      flow.pressure() = pressure_field(std::vector<double>(p.begin(), p.end()), net.epoch());
    }
    flow.update();
    CHECK(flow.solve().ok());
    CHECK(seen->warm == carried);
  }
}

TEST_CASE("what enters through a face goes past the pores that have a condition of their own") {
  const network net = box_of_two();
  flow_options o;
  o.conditions.at(face::z_min) = imposed_flux(2.0);
  o.conditions.at(face::z_max) = held_pressure(0);
  pore_id own;
  double area = 0;
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const pore_id p(i);
    if (!own.valid() && net.touches(p, face::z_min) && !net.touches(p, face::z_max)) {
      own = p;
    } else {
      area += covered_area(net, p, face::z_min);
    }
  }
  o.conditions.pores = {{own, imposed_flux(0.5)}};
  auto flow = make(net, o);
  CHECK(flow.solve().ok());
  CHECK(flow.flux(face::z_max) == doctest::Approx(-2.5).epsilon(1e-13));
  const auto entering = flow.system().inflow({});
  CHECK(entering[flow.system().nodes()[own]] == 0.5);
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const pore_id p(i);
    if (p != own && net.touches(p, face::z_min)) {
      CHECK(entering[flow.system().nodes()[p]] == doctest::Approx(2.0 * covered_area(net, p, face::z_min) / area));
    }
  }
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    if (net.touches(pore_id(i), face::z_min)) {
      o.conditions.pores.push_back({pore_id(i), no_flow()});
    }
  }
  CHECK_THROWS_WITH_AS((void)make(net, o), doctest::Contains("condition at z_min: found a flux without pores"),
                       parameter_error);
}

TEST_CASE("a conductance that cannot be one is refused by its throat, also beside a held pore") {
  const network net = box_of_two();
  flow_options o;
  o.conditions.at(face::z_max) = held_pressure(1);
  auto flow = make(net, o);
  const std::vector<double> good(net.throat_count(), 1.0);
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    for (const double bad : {-0.5, quiet_nan<double>, infinity<double>}) {
      std::vector<double> k = good;
      k[i] = bad;
      if (net.is_boundary(throat_id(i))) {
        CHECK_NOTHROW(flow.set_conductances(k));
        continue;
      }
      CHECK_THROWS_WITH_AS(flow.set_conductances(k), doctest::Contains(("throat " + std::to_string(i) + ":").c_str()),
                           parameter_error);
    }
  }
  for (const double bad : {-1e-14, quiet_nan<double>, infinity<double>}) {
    for (const auto refused : {refused_throats::error, refused_throats::closed}) {
      o.refused = refused;
      CHECK_THROWS_WITH_AS((void)make(net, o, {bad}), doctest::Contains("from the law"), network_error);
    }
  }
}

TEST_CASE("the permeability of a box is that of the pressure which drives the flow") {
  const network net = box_of_two();
  flow_options o;
  o.conditions.at(face::z_min) = held_pressure(5);
  o.conditions.at(face::z_max) = held_pressure(1);
  auto light = make(net, o);
  CHECK(light.solve().ok());
  const double k = box_permeability(light, face::z_min, face::z_max, 2.0);
  o.fluid = {.density = 3, .gravity = {0, 0, -0.5}};
  auto heavy = make(net, o);
  CHECK(heavy.solve().ok());
  CHECK(box_permeability(heavy, face::z_min, face::z_max, 2.0) == doctest::Approx(k).epsilon(1e-13));
  CHECK(box_permeability(heavy, face::z_max, face::z_min, 2.0) == doctest::Approx(k).epsilon(1e-13));
  o.fluid.gravity = {0, 0.5, -0.5};
  auto aslant = make(net, o);
  CHECK(aslant.solve().ok());
  CHECK_THROWS_WITH_AS((void)box_permeability(aslant, face::z_min, face::z_max, 2.0), doctest::Contains("gravity"),
                       parameter_error);
}

TEST_CASE("numbers in messages keep their digits in any unit") {
  CHECK(short_number(1.25e-9) == "1.25e-09");
  CHECK(short_number(-3) == "-3");
  const network net = box_of_two();
  flow_options o;
  o.conditions.at(face::z_max) = held_pressure(2.5e-9);
  o.conditions.at(face::x_min) = held_pressure(0);
  CHECK_THROWS_WITH_AS((void)make(net, o), doctest::Contains("2.5e-09"), parameter_error);
}

TEST_CASE("the contrast is that of open throats between nodes, and there is none without them") {
  const network net = box_of_two();
  auto flow = make(net, {});
  std::vector<double> k(net.throat_count(), 2.0);
  for (std::size_t i = 0; i < k.size(); ++i) {
    k[i] = net.is_boundary(throat_id(i)) ? 1e9 : 2.0;
  }
  k[static_cast<std::size_t>(std::find(k.begin(), k.end(), 2.0) - k.begin())] = 0.5;
  flow.set_conductances(k);
  CHECK(flow.contrast() == 4);
  flow.set_conductances(std::vector<double>(net.throat_count(), 0.0));
  CHECK_THROWS_WITH_AS((void)flow.contrast(), doctest::Contains("no open throat"), parameter_error);
}

TEST_CASE("the law is asked on the cores of the caller") {
  const network net = box_of_two();
  const counting_cores cores;
  saturated_flow flow(net, even_law{}, ldlt_solver<>{}, flow_options{}, cores);
  CHECK(*cores.blocks_run == net.throat_count());
  flow.update();
  CHECK(*cores.blocks_run == 2 * net.throat_count());
  CHECK(flow.conductances().values == make(net, {}).conductances().values);
}
