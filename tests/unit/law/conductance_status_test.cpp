// SPDX-License-Identifier: BSD-3-Clause
#include "support/throats.hpp"
#include "tetrapore/law/conductance.hpp"

#include <doctest/doctest.h>

#include <cstring>

using namespace throats;

namespace {

const hydraulic_radius by_radius{.viscosity = 1e-3};
const mean_radius by_mean{.viscosity = 1e-3};
const darcy by_darcy{.permeability = 1e-12, .viscosity = 1e-3};
const calibrated by_fit{.viscosity = 1e-3};

const throat<double> plain = of_grains({1, 1, 1}, 2.1, 2.1, 2.1, -0.5, 0.5);

template <class Law>
void answers(const Law& law, const throat<double>& t, conductance_status expected) {
  const auto k = law.conductance(t);
  CHECK(k.reason == expected);
  if (k.kind() == verdict::ok) {
    CHECK(k.value > 0);
  } else if (k.kind() == verdict::absent) {
    CHECK(k.value == 0);
  } else {
    CHECK(std::isnan(k.value));
  }
}

}  // namespace

TEST_CASE("ok: a throat between three grains, at a wall, in a corner; with and without slip") {
  for (const auto& t : {plain, on_a_wall({1, 1}, {1.1, 1.2}, 2.1, -0.5, 0.5), in_a_corner(1, 1.1, 1.2, -0.5, 0.5)}) {
    for (const auto wall : {wall_condition::no_slip, wall_condition::slip}) {
      answers(hydraulic_radius{.viscosity = 1e-3, .wall = wall}, t, conductance_status::ok);
      answers(calibrated{.viscosity = 1e-3, .wall = wall}, t, conductance_status::ok);
    }
    answers(by_mean, t, conductance_status::ok);
    answers(by_darcy, t, conductance_status::ok);
  }
}

TEST_CASE("closed: discs that cover the facet let nothing through") {
  const throat<double> covered = of_grains({1, 1, 1}, 1.6, 1.6, 1.6, -0.5, 0.5);
  answers(by_radius, covered, conductance_status::closed);
  answers(by_fit, covered, conductance_status::closed);
  answers(by_mean, covered, conductance_status::closed);
  throat<double> line = plain;
  line.grains[2].centre = (line.grains[0].centre + line.grains[1].centre) * 0.5;
  set_area(line);
  answers(by_darcy, line, conductance_status::closed);
}

TEST_CASE("coincident_nodes: one node has no conductance to itself") {
  throat<double> t = plain;
  t.nodes[1] = t.nodes[0];
  answers(by_radius, t, conductance_status::coincident_nodes);
  answers(by_fit, t, conductance_status::coincident_nodes);
  answers(by_mean, t, conductance_status::coincident_nodes);
  answers(by_darcy, t, conductance_status::coincident_nodes);
}

TEST_CASE("negative_hydraulic_radius: sectors that hold more than the throat domain") {
  // overlapping grains with the nodes close to the facet
  const throat<double> tight = of_grains({1, 1, 1}, 1.75, 1.75, 1.75, -0.01, 0.01);
  CHECK(hydraulics_of(tight).value.fluid_volume() < 0);
  answers(by_radius, tight, conductance_status::negative_hydraulic_radius);
  answers(by_fit, tight, conductance_status::negative_hydraulic_radius);
}

TEST_CASE("no_inscribed_circle: fluid in the facet, but no circle between the three discs") {
  // the two small discs lie apart in the long shadow of the large one
  const throat<double> t = of_grains({1.209, 0.249, 0.553}, 1.841, 0.826, 2.114, -0.5, 0.5);
  CHECK(fluid_area(t).value > 0.05);
  answers(by_mean, t, conductance_status::no_inscribed_circle);
}

TEST_CASE("not_covered: without solid in the domain the fitted law has no measure of it") {
  // an axis far from normal to the facet: the angles of the grains count negative, and the wall alone is wetted
  throat<double> t = on_a_wall({1, 1}, {1.1, 1.2}, 2.1, -0.5, 0.5);
  t.nodes = {{{6.5, 0, 1.1}, {-5.2, 0, 0.8}}};
  CHECK(hydraulics_of(t).value.solid_volume < 0);
  answers(by_fit, t, conductance_status::not_covered);
}

TEST_CASE("invalid_input: NaN and infinity anywhere, radii and parameters outside their domain") {
  const double bad[] = {quiet_nan<double>, infinity<double>};
  const auto refused = [](const throat<double>& t) {
    answers(by_radius, t, conductance_status::invalid_input);
    answers(by_fit, t, conductance_status::invalid_input);
    answers(by_mean, t, conductance_status::invalid_input);
  };
  for (const double x : bad) {
    for (std::size_t k = 0; k < 3; ++k) {
      throat<double> t = plain;
      t.grains[k].centre.y = x;
      set_area(t);
      refused(t);
      answers(by_darcy, t, conductance_status::invalid_input);
      t = plain;
      t.grains[k].radius = x;
      refused(t);
    }
    throat<double> t = plain;
    t.nodes[1].z = x;
    refused(t);
    answers(by_darcy, t, conductance_status::invalid_input);
    t = on_a_wall({1, 1}, {1.1, 1.2}, 2.1, -0.5, 0.5);
    t.walls[0].point.y = x;
    refused(t);
  }
  for (const double r : {0.0, -1.0}) {
    throat<double> t = plain;
    t.grains[1].radius = r;
    refused(t);
  }
  for (const double x : {0.0, -1.0, quiet_nan<double>, infinity<double>}) {
    answers(hydraulic_radius{.viscosity = x}, plain, conductance_status::invalid_input);
    answers(hydraulic_radius{.viscosity = 1e-3, .factor = x}, plain, conductance_status::invalid_input);
    answers(mean_radius{.viscosity = x}, plain, conductance_status::invalid_input);
    answers(calibrated{.viscosity = x}, plain, conductance_status::invalid_input);
    answers(darcy{.permeability = x, .viscosity = 1e-3}, plain, conductance_status::invalid_input);
    answers(darcy{.permeability = 1e-12, .viscosity = x}, plain, conductance_status::invalid_input);
  }
}

TEST_CASE("every status has its verdict and its own words") {
  using enum conductance_status;
  const conductance_status all[] = {ok,          closed,        coincident_nodes,   negative_hydraulic_radius,
                                    not_covered, invalid_input, no_inscribed_circle};
  for (const auto s : all) {
    CHECK(verdict_of(s) == (s == ok ? verdict::ok : s == closed ? verdict::absent : verdict::refused));
    for (const auto other : all) {
      CHECK((std::strcmp(describe(s), describe(other)) == 0) == (s == other));
    }
  }
}
