// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/statoil.hpp"

#include "support/small_networks.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <limits>
#include <sstream>

using namespace tetrapore;

namespace {

std::vector<std::vector<double>> rows_of(const std::filesystem::path& path) {
  std::istringstream text(contents_of(path));
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; cells >> cell;) {
      rows.back().push_back(std::stod(cell));
    }
  }
  return rows;
}

/// Three tetrahedra in a row along x, from the open face x_min to x_max.
network chain() {
  std::vector<sphere<double>> grains{{{0, 0, 0}, 0.1}, {{0, 1, 0}, 0.1}, {{0, 0, 1}, 0.1},
                                     {{1, 0, 0}, 0.1}, {{1, 1, 0}, 0.1}, {{1, 0, 1}, 0.1}};
  const auto g = [](std::size_t k) { return vertex(grain_id(k)); };
  network net = network_of({{{-0.5, 0, 0}, {1, 2, 3}}, unbounded().faces}, grains,
                           {{g(0), g(1), g(2), g(3)}, {g(1), g(2), g(3), g(4)}, {g(2), g(3), g(4), g(5)}});
  tetrapore::detail::name_boundaries(net);
  return net;
}

}  // namespace

TEST_CASE("the four files hold the pores between the reservoirs and the links to them") {
  const temporary_folder folder("statoil");
  const network net = chain();
  REQUIRE(net.touches(pore_id(std::size_t{0}), face::x_min));
  REQUIRE(net.touches(pore_id(std::size_t{2}), face::x_max));
  const std::vector<double> pore_radius{0.5, 0.25, 0.5};
  const std::vector<double> throat_radius(net.throat_count(), 0.125);
  const std::vector<double> throat_area(net.throat_count(), 0.0625);
  const auto report = io::write_statoil(folder / "chain", net,
                                        {.pore_radius = pore_radius,
                                         .throat_radius = throat_radius,
                                         .throat_area = throat_area,
                                         .inlet = face::x_max,
                                         .outlet = face::x_min});
  CHECK(report.pores == 1);
  CHECK(report.links == 2);
  CHECK(report.reservoir_pores == 2);
  CHECK(report.closed_throats == 0);
  CHECK(folder.files() == 4);

  const auto node1 = rows_of(folder / "chain_node1.dat");
  REQUIRE(node1.size() == 2);
  CHECK(node1[0] == std::vector<double>{1, 1.5, 2, 3});  // one pore; the box along x, y, z
  // the mean of grains 1 to 4, seen from the inlet x_max; links to the outlet (0) and the inlet (-1)
  CHECK(node1[1] == std::vector<double>{1, 0.5, 0.5, 0.25, 2, 0, -1, 1, 1, 1, 2});
  const double shape = 0.125 * 0.125 / (4 * 0.0625);
  CHECK(rows_of(folder / "chain_node2.dat") ==
        std::vector<std::vector<double>>{{1, net.void_volume(pore_id(std::size_t{1})), 0.25, shape, 0}});

  const auto link1 = rows_of(folder / "chain_link1.dat");
  const auto link2 = rows_of(folder / "chain_link2.dat");
  REQUIRE(link1.size() == 3);
  REQUIRE(link2.size() == 2);
  CHECK(link1[0] == std::vector<double>{2});
  for (std::size_t l = 0; l < 2; ++l) {
    const double end = l == 0 ? 0 : -1;
    // centre of pore 1 = (1/2, 1/2, 1/4); facets have their centres in (1/3, 1/3, 1/3) and (2/3, 1/3, 1/3)
    const vec3<double> centre{0.5, 0.5, 0.25};
    const vec3<double> facet{l == 0 ? 1.0 / 3 : 2.0 / 3, 1.0 / 3, 1.0 / 3};
    const vec3<double> reservoir = l == 0 ? vec3<double>{0.25, 0.25, 0.25} : vec3<double>{0.75, 0.25, 0.5};
    const double near = norm(facet - centre);
    const double far = norm(facet - reservoir);
    CHECK(link1[l + 1][0] == static_cast<double>(l + 1));
    CHECK(link1[l + 1][1] == end);
    CHECK(link1[l + 1][2] == 1);
    CHECK(link1[l + 1][3] == 0.125);
    CHECK(link1[l + 1][4] == shape);
    CHECK(link1[l + 1][5] == doctest::Approx(near + far).epsilon(1e-14));
    CHECK(link2[l][3] == doctest::Approx(far * 2 / 3).epsilon(1e-14));
    CHECK(link2[l][4] == doctest::Approx(near * 2 / 3).epsilon(1e-14));
    CHECK(link2[l][3] + link2[l][4] + link2[l][5] == doctest::Approx(link1[l + 1][5]).epsilon(1e-14));
    CHECK(link2[l][6] == 0);
  }
}

TEST_CASE("closed throats and the pores behind them are counted and left out") {
  const temporary_folder folder("closed");
  const network net = chain();
  const std::vector<double> pore_radius(3, 0.5);
  const std::vector<double> closed(net.throat_count(), 0.0);
  const auto report = io::write_statoil(folder / "chain", net,
                                        {.pore_radius = pore_radius,
                                         .throat_radius = closed,
                                         .throat_area = closed,
                                         .inlet = face::x_min,
                                         .outlet = face::x_max});
  CHECK(report.links == 0);
  CHECK(report.closed_throats == 2);
  CHECK(report.isolated_pores == 1);
  CHECK(report.pores == 0);
  CHECK(rows_of(folder / "chain_node1.dat") == std::vector<std::vector<double>>{{0, 1.5, 2, 3}});
}

TEST_CASE("a column of another length, a NaN and inlet = outlet are refused and leave no file") {
  const temporary_folder folder("refused");
  const network net = chain();
  const std::vector<double> pores(3, 0.5);
  std::vector<double> throats(net.throat_count(), 0.1);
  const std::vector<double> short_one(2, 0.5);
  const auto write = [&](std::span<const double> p, face outlet) {
    (void)io::write_statoil(folder / "chain", net,
                            {.pore_radius = p, .throat_radius = throats, .throat_area = throats, .outlet = outlet});
  };
  CHECK_THROWS_WITH_AS(write(short_one, face::y_min), "pore_radius: found 2 rows, expected 3", parameter_error);
  CHECK_THROWS_WITH_AS(write(pores, face::y_max), "outlet: found y_max, expected another face than the inlet",
                       parameter_error);
  throats[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(write(pores, face::y_min), "throat_radius 1: found nan, expected a finite number, not negative",
                       parameter_error);
  CHECK(folder.files() == 0);
}
