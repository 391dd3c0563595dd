// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/network/solid.hpp"
#include "tetrapore/one_phase/coupling.hpp"
#include "tetrapore/packing/random_packing.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <numbers>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace {

using namespace tetrapore;
using coupled = coupled_flow<hydraulic_radius, ldlt_solver<>>;
using vec = vec3<double>;

constexpr double viscosity = 0.7;
const hydraulic_radius law{.viscosity = viscosity};

packing grains_in_a_box(std::uint64_t seed = 4, std::array<bool, 3> periodic = {}, vec aspect = {1, 2, 1}) {
  std::vector<double> radii(160);
  random_sequence random(seed);
  for (double& r : radii) {
    r = 0.8 + 0.4 * random.uniform();
  }
  return random_packing(radii, {.solid_fraction = 0.5, .periodic = periodic, .aspect = aspect, .seed = seed});
}

network mesh_of(const packing& p) { return compiled_triangulation{}(p.grains, domain_of(p)).net; }

std::vector<vec> random_velocities(std::size_t n, std::uint64_t seed = 9) {
  random_sequence random(seed);
  std::vector<vec> v(n);
  for (vec& x : v) {
    x = {random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
  }
  return v;
}

flow_options drained_at(face f, double pressure = 0) {
  flow_options o;
  o.conditions.at(f) = held_pressure(pressure);
  o.refused = refused_throats::closed;
  return o;
}

double largest(const std::vector<vec>& f) {
  double out = 0;
  for (const vec& x : f) {
    out = std::max(out, norm(x));
  }
  return out;
}

vec sum(const std::vector<vec>& f, const std::array<vec, 6>& walls) {
  vec s;
  for (const vec& x : f) {
    s += x;
  }
  for (const vec& x : walls) {
    s += x;
  }
  return s;
}

/// The box with its piston at y_max moving, and the velocities of an affine compression of all grains.
struct compression {
  box_motion box;
  std::vector<vec> velocities;

  compression(const packing& p, double speed) : box{*p.bounds} {
    box.walls[static_cast<std::size_t>(face::y_max)] = {0, -speed, 0};
    const double height = p.bounds->size().y;
    for (const auto& g : p.grains) {
      velocities.push_back({0, -speed * (g.centre.y - p.bounds->lo.y) / height, 0});
    }
  }
};

void move(packing& p, compression& c, double dt) {
  for (std::size_t i = 0; i < p.grains.size(); ++i) {
    p.grains[i].centre += c.velocities[i] * dt;
  }
  for (const face f : all_faces) {
    (is_max(f) ? p.bounds->hi : p.bounds->lo)[axis_of(f)] += c.box.walls[static_cast<std::size_t>(f)][axis_of(f)] * dt;
  }
  c.box.bounds = *p.bounds;
}

/// A law that lets little or nothing pass some of the throats.
struct law_with_obstacles {
  hydraulic_radius open;
  double share = 0;                    ///< of the throats that have an obstacle
  double passing = 0;                  ///< share of the conductance that is left there
  vec sealed{infinity<double>, 0, 0};  ///< a node all of whose throats are closed
  conductance_status reason = conductance_status::closed;
  const bool* active = nullptr;  ///< where set, obstacles are there while it is true

  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t) const noexcept {
    auto k = open.conductance(t);
    const double pick = 1e4 * (std::abs(t.area_vector.x) + std::abs(t.area_vector.y) + std::abs(t.area_vector.z));
    const bool closed = norm(t.nodes[0] - sealed) < 1e-12 || norm(t.nodes[1] - sealed) < 1e-12;
    if ((active == nullptr || *active) && (closed || pick - std::floor(pick) < share)) {
      k.value *= closed ? 0 : passing;
      k.reason = k.value > 0 ? k.reason : reason;
    }
    return k;
  }
};
using obstructed = coupled_flow<law_with_obstacles, ldlt_solver<>>;

/// Largest rate at which the fluid brakes a motion [1/s], found by iteration.
template <class Flow>
double fastest_drag(Flow& flow, const packing& p, const std::vector<double>& masses, std::vector<vec>& v, int rounds) {
  double growth = 0;
  for (int k = 0; k < rounds; ++k) {
    std::vector<vec> f(v.size());
    REQUIRE(flow.step(1, p.grains, v, f).ok());
    double old = 0;
    double now = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      old += norm2(v[i]) * masses[i];
      v[i] = f[i] / -masses[i];
      now += norm2(v[i]) * masses[i];
    }
    growth = std::sqrt(now / old);
    for (vec& x : v) {
      x *= 1 / std::sqrt(now);
    }
  }
  return growth;
}

std::vector<double> masses_of(const packing& p) {
  std::vector<double> masses;
  for (const auto& g : p.grains) {
    masses.push_back(g.radius * g.radius * g.radius);
  }
  return masses;
}

/// Positions and velocities as a user may have them.
struct body {
  std::array<float, 3> position;
  float radius;
};
struct push {
  float x;
  float y;
  float z;
};

}  // namespace

TEST_CASE("the forces of a step are those of its pressure field, and nothing at all is pushed") {
  for (const bool repeats : {false, true}) {
    const packing p = grains_in_a_box(4, {repeats, false, repeats});
    coupled flow(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max, 3.0));
    std::vector<vec> forces(p.grains.size());
    const coupling_report r = flow.step(0.1, p.grains, random_velocities(p.grains.size()), forces);
    REQUIRE(r.ok());
    const fluid_forces direct = forces_on_grains(flow.flow());
    const double scale = largest(forces);
    REQUIRE(scale > 0);
    double worst = 0;
    for (std::size_t g = 0; g < forces.size(); ++g) {
      worst = std::max(worst, norm(forces[g] - direct.on(grain_id(g))));
    }
    CHECK(worst < 1e-12 * scale);
    const auto on_walls = pressure_on_walls(flow.net(), flow.pressure());
    for (std::size_t w = 0; w < 6; ++w) {
      CHECK(norm(flow.wall_forces()[w] - direct.walls[w] - on_walls[w]) < 1e-12 * scale * 160);
    }
    // a fluid without inertia between grains and walls passes every force on
    CHECK(norm(sum(forces, flow.wall_forces())) < 1e-11 * scale * 160);
  }
}

TEST_CASE("at rest under gravity the pressure is hydrostatic: grains and walls carry the weight of the fluid") {
  const packing p = grains_in_a_box();
  for (const bool open : {true, false}) {
    flow_options o = open ? drained_at(face::y_max, 5.0) : flow_options{};
    o.refused = refused_throats::closed;
    o.fluid.density = 1.3;
    o.fluid.gravity = open ? vec{0, -9.81, 0} : vec{0.2, -9.81, 0.4};
    coupled flow(mesh_of(p), law, ldlt_solver<>{}, o);
    std::vector<vec> forces(p.grains.size());
    REQUIRE(flow.step(0.1, p.grains, std::vector<vec>(p.grains.size()), forces).ok());
    double solid = 0;
    double worst = 0;
    for (std::size_t g = 0; g < forces.size(); ++g) {
      const double r = p.grains[g].radius;
      const double volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
      solid += volume;
      worst = std::max(worst, norm(forces[g] + o.fluid.gravity * (o.fluid.density * volume)));
    }
    const vec weight = o.fluid.gravity * (o.fluid.density * (p.bounds->volume() - solid));
    CHECK(worst < 1e-12 * norm(weight));
    CHECK(norm(sum(forces, flow.wall_forces()) - weight) < 1e-11 * norm(weight));
  }
}

TEST_CASE("rest stays rest, and what moves as a whole feels no pressure") {
  const packing p = grains_in_a_box();
  const std::size_t n = p.grains.size();
  for (const bool open : {true, false}) {
    coupled flow(mesh_of(p), law, ldlt_solver<>{}, open ? drained_at(face::y_max) : flow_options{});
    std::vector<vec> forces(n);
    REQUIRE(flow.step(0.1, p.grains, std::vector<vec>(n), forces).ok());
    CHECK(largest(forces) == 0);
    CHECK(flow.ledger().throughput == 0);

    const vec drift{0.3, -0.4, 0.5};
    box_motion box{*p.bounds};
    box.walls.fill(drift);
    REQUIRE(flow.step(0.1, p.grains, std::vector<vec>(n, drift), forces, box).ok());
    const double rigid = largest(forces);
    std::fill(forces.begin(), forces.end(), vec{});
    coupled loose(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max));
    REQUIRE(loose.step(0.1, p.grains, random_velocities(n), forces).ok());
    CHECK(rigid < 1e-12 * largest(forces));
  }
}

TEST_CASE("no fluid is lost: a piston presses out what it sweeps, compression and wells included") {
  for (const bool compressible : {false, true}) {
    packing p = grains_in_a_box();
    flow_options o = drained_at(face::y_min, 0.5);
    o.conditions.at(face::x_max) = imposed_flux(0.02);
    o.fluid.bulk_modulus = compressible ? 40.0 : infinity<double>;
    coupled flow(mesh_of(p), law, ldlt_solver<>{}, o);
    compression c(p, 0.05);
    const auto jitter = random_velocities(p.grains.size());
    for (std::size_t i = 0; i < jitter.size(); ++i) {
      c.velocities[i] += jitter[i] * 0.02;
    }
    const double before = p.bounds->volume();
    std::vector<vec> forces(p.grains.size());
    constexpr double dt = 0.01;
    for (int step = 0; step < 60; ++step) {
      const coupling_report r = flow.step(dt, p.grains, c.velocities, forces, c.box);
      REQUIRE(r.ok());
      CHECK(r.refreshed == (step % 20 != 0));
      move(p, c, dt);
      if (step % 20 == 19) {
        flow.rebuild(compiled_triangulation{}, p.grains, *p.bounds);
      }
    }
    const fluid_ledger& l = flow.ledger();
    CHECK(l.squeezed == doctest::Approx(before - p.bounds->volume()).epsilon(1e-11));
    CHECK(l.injected == doctest::Approx(60 * dt * 0.02).epsilon(1e-12));
    CHECK((l.stored > 0) == compressible);
    CHECK(l.defect() < 1e-13 * l.throughput);
  }
}

TEST_CASE("a sealed box that is pressed together slowly has one pressure: its bulk modulus times the volume lost") {
  packing p = grains_in_a_box();
  flow_options o;
  o.fluid.bulk_modulus = 2.0;
  o.refused = refused_throats::closed;
  coupled flow(mesh_of(p), law, ldlt_solver<>{}, o);
  const double void_volume = compensated_sum(flow.net().arrays().void_volumes);
  compression c(p, 1e-6);
  std::vector<vec> forces(p.grains.size());
  REQUIRE(flow.step(0.1, p.grains, c.velocities, forces, c.box).ok());
  const double area = p.bounds->size().x * p.bounds->size().z;
  const double expected = 2.0 * 1e-6 * 0.1 * area / void_volume;
  double mean = 0;
  for (std::size_t i = 0; i < flow.net().pore_count(); ++i) {
    mean += flow.pressure()[pore_id(i)] * flow.net().void_volume(pore_id(i)) / void_volume;
  }
  CHECK(mean == doctest::Approx(expected).epsilon(1e-10));
}

TEST_CASE("explicit and implicit pressure meet at first order of the step, and too long a step is refused") {
  const packing p = grains_in_a_box();
  const std::size_t n = p.grains.size();
  flow_options o = drained_at(face::y_max);
  o.fluid.bulk_modulus = 50;
  const network net = mesh_of(p);
  const std::vector<vec> velocities = random_velocities(n);
  std::vector<vec> forces(n);
  const double bound = coupled(net, law, ldlt_solver<>{}, o).largest_explicit_step();
  REQUIRE(bound > 0);
  const double time = 64 * bound;
  const auto after = [&](pressure_scheme scheme, int steps) {
    coupled flow(net, law, ldlt_solver<>{}, o, {.scheme = scheme});
    for (int i = 0; i < steps; ++i) {
      REQUIRE(flow.step(time / steps, p.grains, velocities, forces).ok());
    }
    CHECK(flow.ledger().defect() < 1e-13 * flow.ledger().throughput);
    return std::vector<double>(flow.pressure().values().begin(), flow.pressure().values().end());
  };
  const auto distance = [](const std::vector<double>& a, const std::vector<double>& b) {
    double d = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      d = std::max(d, std::abs(a[i] - b[i]));
    }
    return d;
  };
  using enum pressure_scheme;
  const double coarse = distance(after(explicit_step, 128), after(implicit_step, 128));
  const double fine = distance(after(explicit_step, 256), after(implicit_step, 256));
  const double finest = distance(after(explicit_step, 512), after(implicit_step, 512));
  CHECK(coarse / fine == doctest::Approx(2).epsilon(0.1));
  CHECK(fine / finest == doctest::Approx(2).epsilon(0.05));

  coupled flow(net, law, ldlt_solver<>{}, o, {.scheme = explicit_step});
  CHECK(flow.step(1.01 * bound, p.grains, velocities, forces).reason == coupling_status::step_too_long);
  CHECK(std::all_of(flow.pressure().values().begin(), flow.pressure().values().end(), [](double x) { return x == 0; }));
  CHECK(flow.ledger().throughput == 0);
  CHECK_THROWS_AS(coupled(net, law, ldlt_solver<>{}, drained_at(face::y_max), {.scheme = explicit_step}),
                  parameter_error);
}

TEST_CASE("to triangulate anew changes the pressure by little, and keeps what is stored") {
  packing p = grains_in_a_box();
  flow_options o = drained_at(face::y_max);
  o.fluid.bulk_modulus = 50;
  coupled flow(mesh_of(p), law, ldlt_solver<>{}, o);
  compression c(p, 0.5);
  const auto jitter = random_velocities(p.grains.size());
  for (std::size_t i = 0; i < jitter.size(); ++i) {
    c.velocities[i] += jitter[i] * 0.3;
  }
  std::vector<vec> forces(p.grains.size());
  constexpr double dt = 0.005;
  const rebuild_rule rule{.strain = 0.01};
  int steps = 0;
  for (; flow.rebuild_due(rule) == rebuild_reason::none && steps < 200; ++steps) {
    REQUIRE(flow.step(dt, p.grains, c.velocities, forces, c.box).ok());
    move(p, c, dt);
  }
  CHECK(steps > 2);
  CHECK(steps < 200);
  CHECK(flow.distortion().strain > 0.0);
  REQUIRE(flow.step(dt, p.grains, c.velocities, forces, c.box).ok());
  const auto content = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < flow.net().pore_count(); ++i) {
      sum += flow.pressure()[pore_id(i)] * flow.net().void_volume(pore_id(i));
    }
    return sum;
  };
  const auto extremes = [&] {
    const auto [lo, hi] = std::minmax_element(flow.pressure().values().begin(), flow.pressure().values().end());
    return std::array<double, 2>{*lo, *hi};
  };
  const double kept = content();
  const auto before = extremes();
  const transfer way = flow.rebuild(compiled_triangulation{}, p.grains, *p.bounds);
  CHECK(way.to_epoch() == flow.net().epoch());
  CHECK(flow.pressure().belongs_to(flow.net()));
  CHECK(flow.steps_since_rebuild() == 0);
  CHECK(flow.rebuild_due(rule) == rebuild_reason::none);
  CHECK(flow.distortion().strain == 0);
  // averages of what was there: no new extremes; and the content is that of the same voids
  const auto after = extremes();
  CHECK(after[0] >= before[0]);
  CHECK(after[1] <= before[1]);
  CHECK(content() == doctest::Approx(kept).epsilon(1e-9));
}

TEST_CASE("after a mean strain of 1 %, the old triangulation and a new one give forces within 5 % of each other") {
  packing p = grains_in_a_box();
  coupled flow(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max));
  compression c(p, 0.5);
  const auto jitter = random_velocities(p.grains.size());
  for (std::size_t i = 0; i < jitter.size(); ++i) {
    c.velocities[i] += jitter[i] * 0.3;
  }
  std::vector<vec> before(p.grains.size());
  for (int step = 0; flow.distortion().strain < 0.01 && step < 200; ++step) {
    before.assign(p.grains.size(), vec{});
    REQUIRE(flow.step(0.005, p.grains, c.velocities, before, c.box).ok());
    move(p, c, 0.005);
  }
  before.assign(p.grains.size(), vec{});
  REQUIRE(flow.step(0.005, p.grains, c.velocities, before, c.box).ok());
  const std::size_t pores = flow.net().pore_count();
  flow.rebuild(compiled_triangulation{}, p.grains, *p.bounds);
  CHECK(flow.net().pore_count() != pores);  // some facets have flipped
  std::vector<vec> after(p.grains.size());
  REQUIRE(flow.step(0.005, p.grains, c.velocities, after, c.box).ok());
  double change = 0;
  double size = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    change += norm2(after[i] - before[i]);
    size += norm2(before[i]);
  }
  MESSAGE("L2 change of the forces: " << std::sqrt(change / size));
  CHECK(change > 0);
  CHECK(std::sqrt(change / size) < 0.05);
}

TEST_CASE("rebuild_due names its reason") {
  packing p = grains_in_a_box();
  coupled flow(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max));
  const std::vector<vec> at_rest(p.grains.size());
  std::vector<vec> forces(p.grains.size());
  REQUIRE(flow.step(0.1, p.grains, at_rest, forces).ok());
  CHECK(flow.rebuild_due({}) == rebuild_reason::none);
  CHECK(flow.rebuild_due({.every = 1}) == rebuild_reason::steps);
  CHECK(flow.rebuild_due({.every = 2, .strain = 1e-9}) == rebuild_reason::none);
  p.grains[7].centre.x += 0.5;  // into its neighbours
  REQUIRE(flow.step(0.1, p.grains, at_rest, forces).ok());
  CHECK(flow.rebuild_due({.strain = 1e-3, .turned_volume = 1}) == rebuild_reason::strain);
  p.grains[7].centre.x += 4.0;
  coupled turned(mesh_of(grains_in_a_box()), law, ldlt_solver<>{}, drained_at(face::y_max));
  REQUIRE(turned.step(0.1, p.grains, at_rest, forces).ok());
  CHECK(turned.distortion().turned_cells > 0);
  CHECK(turned.rebuild_due({}) == rebuild_reason::turned_cells);
}

TEST_CASE("a piston over a saturated column: the outflow is what it sweeps, the pressure is Darcy's") {
  std::vector<double> radii(400, 1.0);
  const packing p = random_packing(radii, {.solid_fraction = 0.5, .aspect = {1, 4, 1}, .seed = 2});
  const network net = mesh_of(p);
  const double height = p.bounds->size().y;
  const double area = p.bounds->size().x * p.bounds->size().z;
  flow_options through = drained_at(face::y_max);
  through.conditions.at(face::y_min) = held_pressure(1);
  saturated_flow steady(net, law, ldlt_solver<>{}, through);
  steady.solve();
  const double mobility = steady.flux(face::y_min) * height / area;  // k/μ

  coupled flow(net, law, ldlt_solver<>{}, drained_at(face::y_min));
  constexpr double speed = 0.3;
  const compression c(p, speed);
  std::vector<vec> forces(p.grains.size());
  const coupling_report r = flow.step(0.01, p.grains, c.velocities, forces, c.box);
  REQUIRE(r.ok());
  CHECK(r.fluid.outflow == doctest::Approx(speed * area * 0.01).epsilon(1e-12));
  // p(y) = v/(k/μ) (y − y²/2H): the flow relative to the grains grows from 0 at the piston to v at the drain
  double top = 0;
  double covered = 0;
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const double a = covered_area(net, pore_id(i), face::y_max);
    top += a * flow.pressure()[pore_id(i)];
    covered += a;
  }
  CHECK(covered == doctest::Approx(area).epsilon(1e-12));
  CHECK(top / area == doctest::Approx(speed * height / (2 * mobility)).epsilon(0.05));
  const double on_piston = flow.wall_forces()[static_cast<std::size_t>(face::y_max)].y;
  CHECK(on_piston == doctest::Approx(top).epsilon(0.05));
}

TEST_CASE("the drag of no motion exceeds its bound; beyond it an explicit step grows, with added mass it does not") {
  const packing p = grains_in_a_box();
  const std::size_t n = p.grains.size();
  coupled flow(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max));
  const std::vector<double> masses = masses_of(p);
  std::vector<vec> fastest = random_velocities(n);
  const double measured = fastest_drag(flow, p, masses, fastest, 60);
  const double bound = 2 / flow.largest_step(masses);
  MESSAGE("largest drag rate over its bound: " << measured / bound);
  CHECK(measured <= bound);
  CHECK(measured > 0.05 * bound);

  const auto energy_after = [&](double dt, bool with_mass) {
    std::vector<vec> v = fastest;
    const std::vector<double> added = with_mass ? flow.added_mass(dt) : std::vector<double>(n, 0.0);
    for (int step = 0; step < 40; ++step) {
      std::vector<vec> f(n);
      REQUIRE(flow.step(dt, p.grains, v, f).ok());
      for (std::size_t i = 0; i < n; ++i) {
        v[i] += f[i] * (dt / (masses[i] + added[i]));
      }
    }
    double energy = 0;
    for (std::size_t i = 0; i < n; ++i) {
      energy += norm2(v[i]) * masses[i];
    }
    return energy;
  };
  CHECK(energy_after(flow.largest_step(masses), false) < 1);
  CHECK(energy_after(2.2 / measured, false) > 10);
  CHECK(energy_after(20 / measured, true) < 1);
  CHECK_THROWS_AS((void)flow.largest_step(std::vector<double>(3, 1.0)), parameter_error);
}

TEST_CASE("grains that were put back into a periodic box are the same grains") {
  packing p = grains_in_a_box(5, {true, false, true});
  const auto v = random_velocities(p.grains.size());
  coupled flow(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max));
  std::vector<vec> first(p.grains.size());
  REQUIRE(flow.step(0.1, p.grains, v, first).ok());
  for (std::size_t i = 0; i < p.grains.size(); i += 3) {
    p.grains[i].centre.x -= p.bounds->size().x;
  }
  std::vector<vec> second(p.grains.size());
  REQUIRE(flow.step(0.1, p.grains, v, second).ok());
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(norm(first[i] - second[i]) < 1e-10 * largest(first));
  }
}

TEST_CASE("positions, velocities and forces may be of any type and container") {
  const packing p = grains_in_a_box();
  coupled flow(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max));
  std::deque<body> bodies;
  for (const auto& g : p.grains) {
    bodies.push_back({{static_cast<float>(g.centre.x), static_cast<float>(g.centre.y), static_cast<float>(g.centre.z)},
                      static_cast<float>(g.radius)});
  }
  const std::vector<vec> v = random_velocities(p.grains.size());
  std::vector<push> pushed(p.grains.size(), push{1, 2, 3});
  std::vector<vec> exact(p.grains.size());
  REQUIRE(flow.step(0.1, bodies, v, pushed).ok());
  coupled same(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max));
  REQUIRE(same.step(0.1, p.grains, v, exact).ok());
  const double scale = largest(exact);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CHECK(norm(vec{pushed[i].x, pushed[i].y, pushed[i].z} - vec{1, 2, 3} - exact[i]) < 1e-4 * scale);
  }
  std::vector<push> too_few(3);
  CHECK_THROWS_AS(flow.step(0.1, bodies, v, too_few), parameter_error);
  CHECK_THROWS_AS(flow.step(0.0, bodies, v, pushed), parameter_error);
  CHECK_THROWS_AS(flow.step(0.1, bodies, std::vector<vec>(2), pushed), parameter_error);
}

TEST_CASE("beside closed throats the drag has a finite bound, by the ways round them, and no motion exceeds it") {
  const packing p = grains_in_a_box();
  const std::vector<double> masses = masses_of(p);
  for (const double passing : {0.0, 1e-18, 1e-5}) {
    obstructed flow(mesh_of(p), {.open = law, .share = 0.05, .passing = passing}, ldlt_solver<>{},
                    drained_at(face::y_max));
    CHECK(flow.sealed_grains().empty());
    double largest_bound = 0;
    for (const double b : flow.drag_bounds()) {
      CHECK(std::isfinite(b));
      CHECK(b > 0);
      largest_bound = std::max(largest_bound, b);
    }
    for (const double m : flow.added_mass(1e-3)) {
      CHECK(m <= 0.5e-3 * largest_bound);
    }
    std::vector<vec> v = random_velocities(p.grains.size());
    const double measured = fastest_drag(flow, p, masses, v, 60);
    const double bound = 2 / flow.largest_step(masses);
    MESSAGE("a share of " << passing << " passes: largest drag rate over its bound " << measured / bound);
    CHECK(measured <= bound);
    CHECK(measured > 0.005 * bound);
  }
}

TEST_CASE("the grains of a sealed pore are named, their bounds are finite, and a compressible fluid bears them") {
  const packing p = grains_in_a_box();
  const network net = mesh_of(p);
  const flow_nodes nodes(net);
  pore_id inner;
  for (std::size_t i = 0; i < net.pore_count() && !inner.valid(); ++i) {
    const pore_id candidate(i);
    std::size_t members = 0;
    for (std::size_t j = 0; j < net.pore_count(); ++j) {
      members += nodes[pore_id(j)] == nodes[candidate] ? 1U : 0U;
    }
    if (net.grain_vertices(candidate) == 4 && members == 1) {
      inner = candidate;
    }
  }
  REQUIRE(inner.valid());
  flow_options o = drained_at(face::y_max);
  o.fluid.bulk_modulus = 50;
  obstructed flow(net, {.open = law, .sealed = nodes.position(net, inner)}, ldlt_solver<>{}, o);
  std::set<grain_id> expected;
  for (const vertex v : net.vertices(inner)) {
    expected.insert(v.grain());
  }
  CHECK(std::set<grain_id>(flow.sealed_grains().begin(), flow.sealed_grains().end()) == expected);
  CHECK(std::all_of(flow.drag_bounds().begin(), flow.drag_bounds().end(), [](double b) { return std::isfinite(b); }));
  CHECK(flow.largest_step(masses_of(p)) > 0);
  std::vector<vec> forces(p.grains.size());
  REQUIRE(flow.step(1e-3, p.grains, random_velocities(p.grains.size()), forces).ok());
  CHECK(std::isfinite(largest(forces)));
  CHECK(flow.ledger().defect() < 1e-13 * flow.ledger().throughput);

  o.fluid.bulk_modulus = infinity<double>;
  obstructed stiff(net, {.open = law, .sealed = nodes.position(net, inner)}, ldlt_solver<>{}, o);
  CHECK_THROWS_AS(stiff.step(1e-3, p.grains, random_velocities(p.grains.size()), forces), network_error);
}

TEST_CASE("throats that the law refuses may be closed: the flow goes round them and loses nothing") {
  packing p = grains_in_a_box();
  const law_with_obstacles refusing{
      .open = law, .share = 0.05, .reason = conductance_status::negative_hydraulic_radius};
  flow_options o = drained_at(face::y_max);
  obstructed flow(mesh_of(p), refusing, ldlt_solver<>{}, o);
  CHECK(flow.flow().conductances().counts.refused() > 10);
  compression c(p, 0.05);
  std::vector<vec> forces(p.grains.size());
  const double before = p.bounds->volume();
  for (int step = 0; step < 6; ++step) {
    forces.assign(p.grains.size(), vec{});
    REQUIRE(flow.step(0.01, p.grains, c.velocities, forces, c.box).ok());
    CHECK(norm(sum(forces, flow.wall_forces())) < 1e-11 * largest(forces) * 160);
    move(p, c, 0.01);
  }
  CHECK(flow.ledger().outflow == doctest::Approx(before - p.bounds->volume()).epsilon(1e-11));
  CHECK(flow.ledger().defect() < 1e-13 * flow.ledger().throughput);
  o.refused = refused_throats::error;
  CHECK_THROWS_AS(obstructed(mesh_of(p), refusing, ldlt_solver<>{}, o), network_error);
}

TEST_CASE("with multigrid a step gives the forces of the direct solver, and starts from the pressure it has") {
  packing p = grains_in_a_box();
  const std::vector<vec> v = random_velocities(p.grains.size());
  const multigrid_solver<> multigrid({.coarsest = 50});  // a hierarchy, small as the packing is
  using coupled_multigrid = coupled_flow<hydraulic_radius, multigrid_solver<>>;
  coupled direct(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max, 3.0));
  coupled_multigrid flow(mesh_of(p), law, multigrid, drained_at(face::y_max, 3.0));
  std::vector<vec> exact(p.grains.size());
  std::vector<vec> forces(p.grains.size());
  REQUIRE(direct.step(0.1, p.grains, v, exact).ok());
  const coupling_report cold = flow.step(0.1, p.grains, v, forces);
  REQUIRE(cold.ok());
  for (std::size_t g = 0; g < forces.size(); ++g) {
    CHECK(norm(forces[g] - exact[g]) < 1e-7 * largest(exact));
  }
  MESSAGE("iterations of the first step: " << cold.solve.iterations);
  REQUIRE(cold.solve.iterations > 5);
  const auto iterations_of = [&](auto& f) {
    std::vector<vec> ignored(p.grains.size());
    const coupling_report r = f.step(0.1, p.grains, v, ignored);
    REQUIRE(r.ok());
    return r.solve.iterations;
  };
  CHECK(iterations_of(flow) <= 1);
  flow.rebuild(compiled_triangulation{}, p.grains);  // the same grains: what was carried is the solution
  CHECK(iterations_of(flow) <= 1);
  coupled_multigrid guessed(mesh_of(p), law, multigrid, drained_at(face::y_max, 3.0));
  std::copy(direct.pressure().values().begin(), direct.pressure().values().end(), guessed.pressure().values().begin());
  CHECK(iterations_of(guessed) <= 1);
  coupled_multigrid stubborn(mesh_of(p), law, multigrid, drained_at(face::y_max, 3.0), {.solve = {.warm = false}});
  CHECK(iterations_of(stubborn) == cold.solve.iterations);
  CHECK(iterations_of(stubborn) > 5);
}

TEST_CASE("conditions of single pores do not outlive their pores: a rebuild asks for those of the new network") {
  packing p = grains_in_a_box();
  const network net = mesh_of(p);
  flow_options o;
  o.refused = refused_throats::closed;
  const auto drain = [](const network& n) {  // the pore next to the middle of the box
    const vec middle = (n.region().bounds.lo + n.region().bounds.hi) * 0.5;
    pore_id best(0);
    for (std::size_t i = 0; i < n.pore_count(); ++i) {
      const pore_id candidate(i);
      best = norm2(n.power_centre(candidate) - middle) < norm2(n.power_centre(best) - middle) ? candidate : best;
    }
    flow_conditions c;
    c.pores.push_back({best, held_pressure(2.0)});
    return c;
  };
  o.conditions = drain(net);
  coupled flow(net, law, ldlt_solver<>{}, o);
  compression c(p, 0.5);
  const auto jitter = random_velocities(p.grains.size());
  for (std::size_t i = 0; i < jitter.size(); ++i) {
    c.velocities[i] += jitter[i] * 0.3;
  }
  std::vector<vec> forces(p.grains.size());
  for (int step = 0; step < 10; ++step) {
    REQUIRE(flow.step(0.005, p.grains, c.velocities, forces, c.box).ok());
    move(p, c, 0.005);
  }
  const std::vector<double> pressure(flow.pressure().values().begin(), flow.pressure().values().end());
  const auto at = flow.net().grains()[5].centre;
  CHECK_THROWS_AS(flow.rebuild(compiled_triangulation{}, p.grains, *p.bounds), parameter_error);
  CHECK(flow.net().epoch() == net.epoch());
  CHECK(flow.net().grains()[5].centre == at);
  CHECK(std::equal(pressure.begin(), pressure.end(), flow.pressure().values().begin()));

  flow.rebuild(compiled_triangulation{}, p.grains, *p.bounds, drain);
  o.conditions = drain(flow.net());
  REQUIRE(flow.flow().system().conditions().pores[0].pore == o.conditions.pores[0].pore);
  forces.assign(p.grains.size(), vec{});
  REQUIRE(flow.step(0.005, p.grains, c.velocities, forces, c.box).ok());
  CHECK(flow.pressure()[o.conditions.pores[0].pore] == doctest::Approx(2.0));
  coupled fresh(mesh_of(p), law, ldlt_solver<>{}, o);
  std::vector<vec> expected(p.grains.size());
  REQUIRE(fresh.step(0.005, p.grains, c.velocities, expected, c.box).ok());
  for (std::size_t g = 0; g < forces.size(); ++g) {
    CHECK(norm(forces[g] - expected[g]) < 1e-10 * largest(expected));
  }
}

TEST_CASE("a rebuild that fails has changed nothing, wherever it failed") {
  static_assert(!std::is_copy_constructible_v<coupled> && !std::is_move_constructible_v<coupled>);
  packing p = grains_in_a_box();
  bool refuse = false;
  const law_with_obstacles moody{
      .open = law, .share = 0.05, .reason = conductance_status::invalid_input, .active = &refuse};
  flow_options o = drained_at(face::y_max);
  o.refused = refused_throats::error;
  o.fluid.bulk_modulus = 50;
  obstructed flow(mesh_of(p), moody, ldlt_solver<>{}, o);
  obstructed twin(mesh_of(p), moody, ldlt_solver<>{}, o);
  compression c(p, 0.5);
  std::vector<vec> forces(p.grains.size());
  const auto advance = [&] {
    forces.assign(p.grains.size(), vec{});
    REQUIRE(flow.step(0.005, p.grains, c.velocities, forces, c.box).ok());
    std::vector<vec> expected(p.grains.size());
    REQUIRE(twin.step(0.005, p.grains, c.velocities, expected, c.box).ok());
    CHECK(forces == expected);
    CHECK(flow.steps_since_rebuild() == twin.steps_since_rebuild());
    CHECK(flow.distortion().strain == twin.distortion().strain);
    CHECK(std::equal(flow.drag_bounds().begin(), flow.drag_bounds().end(), twin.drag_bounds().begin()));
    move(p, c, 0.005);
  };
  advance();
  advance();
  SUBCASE("in the engine") {
    const auto broken = [](std::span<const sphere<double>>, const domain&) -> tessellation {
      throw std::runtime_error("no triangulation");
    };
    CHECK_THROWS_AS(flow.rebuild(broken, p.grains, *p.bounds), std::runtime_error);
  }
  SUBCASE("in the caller's grains") {
    auto fewer = p.grains;
    fewer.pop_back();
    CHECK_THROWS_AS(flow.rebuild(compiled_triangulation{}, fewer, *p.bounds), parameter_error);
  }
  SUBCASE("in the law") {
    refuse = true;
    CHECK_THROWS_AS(flow.rebuild(compiled_triangulation{}, p.grains, *p.bounds), network_error);
    refuse = false;
  }
  SUBCASE("in the conditions") {
    const auto impossible = [](const network& n) {
      flow_conditions f;
      f.pores.push_back({pore_id(n.pore_count()), held_pressure(1)});
      return f;
    };
    CHECK_THROWS_AS(flow.rebuild(compiled_triangulation{}, p.grains, *p.bounds, impossible), parameter_error);
  }
  CHECK(flow.net().epoch() == twin.net().epoch());
  advance();
  advance();
}

TEST_CASE("what held pores let through counts as throughput") {
  const packing p = grains_in_a_box();
  flow_options o = drained_at(face::y_max);
  o.conditions.at(face::y_min) = held_pressure(1);
  coupled flow(mesh_of(p), law, ldlt_solver<>{}, o);
  std::vector<vec> forces(p.grains.size());
  REQUIRE(flow.step(0.1, p.grains, std::vector<vec>(p.grains.size()), forces).ok());
  const double q = flow.flow().flux(face::y_min);
  REQUIRE(q > 0);
  CHECK(flow.ledger().throughput == doctest::Approx(2 * q * 0.1).epsilon(1e-12));
  CHECK(std::abs(flow.ledger().outflow) < 1e-13 * flow.ledger().throughput);
  CHECK(flow.ledger().defect() < 1e-13 * flow.ledger().throughput);
}

TEST_CASE("what a step squeezes out of each cell is the change of its volume, at first order of the step") {
  for (const bool repeats : {false, true}) {
    const auto error = [&](double dt) {
      packing p = grains_in_a_box(4, {repeats, false, repeats});
      compression c(p, 0.5);
      const auto jitter = random_velocities(p.grains.size());
      for (std::size_t i = 0; i < jitter.size(); ++i) {
        c.velocities[i] += jitter[i] * 0.3;
      }
      coupled flow(mesh_of(p), law, ldlt_solver<>{}, drained_at(face::y_max));
      const std::vector<double> before(flow.net().arrays().volumes);
      const volume_rates rates = rates_of_volume(flow.net(), {c.velocities, c.box.walls});
      std::vector<vec> forces(p.grains.size());
      const coupling_report first = flow.step(dt, p.grains, c.velocities, forces, c.box);
      REQUIRE(first.ok());
      move(p, c, dt);
      REQUIRE(flow.step(dt, p.grains, c.velocities, forces, c.box).ok());  // takes the positions, measures
      double sum = 0;
      double changes = 0;
      double missed = 0;
      for (std::size_t i = 0; i < before.size(); ++i) {
        const double change = flow.net().volume(pore_id(i)) - before[i];
        sum += change;
        changes += std::abs(change);
        missed += std::abs(change - rates.values[i] * dt);
      }
      CHECK(first.fluid.squeezed == doctest::Approx(-sum).epsilon(1e-10));  // of a box with one piston: exactly
      return missed / changes;
    };
    const double coarse = error(4e-3);
    const double fine = error(2e-3);
    MESSAGE("volume missed by a step of 0.002: " << fine << " of the change");
    CHECK(fine < 0.01);
    CHECK(coarse / fine == doctest::Approx(2).epsilon(0.03));
  }
}
