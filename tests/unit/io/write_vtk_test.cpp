// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/pvd.hpp"
#include "tetrapore/io/vtp.hpp"
#include "tetrapore/io/vtu.hpp"

#include "support/small_networks.hpp"
#include "support/vtk_file.hpp"

#include <cmath>
#include <limits>

using namespace tetrapore;

namespace {

constexpr unsigned triangle = 5;
constexpr unsigned quad = 9;
constexpr unsigned tetra = 10;
constexpr unsigned hexahedron = 12;
constexpr unsigned wedge = 13;

/// Faces of VTK's linear cells, each seen counter-clockwise from outside (VTK file formats, figure of the cell types).
const std::vector<std::vector<std::size_t>>& faces_of(unsigned type) {
  static const std::vector<std::vector<std::size_t>> of_tetra{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  static const std::vector<std::vector<std::size_t>> of_wedge{
      {0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const std::vector<std::vector<std::size_t>> of_hexahedron{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                                                   {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  return type == tetra ? of_tetra : (type == wedge ? of_wedge : of_hexahedron);
}

/// Volume enclosed by the faces of a cell, by the divergence theorem; positive when the faces look outward.
double volume(unsigned type, const std::vector<vec3<double>>& c) {
  double sum = 0;
  for (const auto& f : faces_of(type)) {
    for (std::size_t k = 2; k < f.size(); ++k) {
      sum += triple(c[f[0]], c[f[k - 1]], c[f[k]]) / 6;
    }
  }
  return sum;
}

vec3<double> area_vector(const std::vector<vec3<double>>& c) {
  vec3<double> sum;
  for (std::size_t k = 2; k < c.size(); ++k) {
    sum += 0.5 * cross(c[k - 1] - c[0], c[k] - c[0]);
  }
  return sum;
}

}  // namespace

TEST_CASE("wedges and cuboids of two grains in a box fill the box, turned as VTK wants them") {
  const temporary_folder folder("vtu");
  const network net = two_grains_in_a_box();
  io::write_pores(folder / "pores.vtu", net, {{"volume [m3]", net.arrays().volumes}});
  const vtk_file file(folder / "pores.vtu");
  CHECK(file.type() == "UnstructuredGrid");
  REQUIRE(file.cells() == net.pore_count());
  const auto types = file.array<std::uint8_t>("Cells", "types");
  double sum = 0;
  for (std::size_t k = 0; k < file.cells(); ++k) {
    CHECK(types[k] == hexahedron);
    const double v = volume(types[k], file.corners(k));
    CHECK(v > 0);
    sum += v;
  }
  CHECK(sum == doctest::Approx(24).epsilon(1e-14));
  CHECK(file.array<double>("CellData", "volume [m3]") == net.arrays().volumes);
  CHECK(file.points() == 2 * (2 * 3 * 3));  // of each grain: itself and its feet, to one side of x and both of y and z
  CHECK(folder.files() == 1);
}

TEST_CASE("a prism at a wall is a wedge whose first triangle faces out") {
  const temporary_folder folder("wedge");
  const network net = one_prism();
  io::write_pores(folder / "pores.vtu", net, {});
  const vtk_file file(folder / "pores.vtu");
  CHECK(file.array<std::uint8_t>("Cells", "types").at(0) == wedge);
  CHECK(file.points() == 6);
  // triangle of area 1/2 times the mean height 1/2 under the wall
  CHECK(volume(wedge, file.corners(0)) == doctest::Approx(0.25).epsilon(1e-15));
}

TEST_CASE("a tetrahedron keeps the points of its grains") {
  const temporary_folder folder("tetra");
  const network net = one_tetrahedron();
  io::write_pores(folder / "pores.vtu", net, {});
  const vtk_file file(folder / "pores.vtu");
  CHECK(file.array<std::uint8_t>("Cells", "types").at(0) == tetra);
  CHECK(file.points() == 4);
  CHECK(volume(tetra, file.corners(0)) == doctest::Approx(1.0 / 6).epsilon(1e-15));
}

TEST_CASE("across a periodic face a pore keeps its shape") {
  using enum boundary;
  const temporary_folder folder("periodic");
  cell c;
  for (std::size_t k = 0; k < 4; ++k) {
    c.vertices[k] = vertex(grain_id(k));
  }
  c.images[1] = {1, 0, 0};
  c.images[3] = {0, 0, -1};
  const domain region{{{0, 0, 0}, {1, 1, 1}}, {periodic, periodic, open, open, periodic, periodic}};
  std::vector<sphere<double>> grains{
      {{0.9, 0.2, 0.1}, 0.1}, {{0.1, 0.2, 0.1}, 0.1}, {{0.9, 0.4, 0.1}, 0.1}, {{0.9, 0.2, 0.8}, 0.1}};
  cell elsewhere = c;  // the same grains, another image of grain 3
  elsewhere.images[3] = {0, 0, 1};
  network_arrays a = connect(region, grains, {c, elsewhere});
  const network net{std::move(a)};
  io::write_pores(folder / "pores.vtu", net, {});
  const vtk_file file(folder / "pores.vtu");
  const auto corners = file.corners(0);
  CHECK(corners[1].x == 1.1);
  CHECK(corners[3].z == doctest::Approx(-0.2).epsilon(1e-15));
  CHECK(std::abs(volume(tetra, corners)) == doctest::Approx(0.2 * 0.2 * 0.3 / 6).epsilon(1e-14));
  CHECK(file.corners(1)[1] == corners[1]);
  CHECK(file.corners(1)[3].z == doctest::Approx(1.8).epsilon(1e-15));
  CHECK(file.points() == 7);  // four grains in the box and three images
}

TEST_CASE("throats are polygons with the area and direction of the throat") {
  const temporary_folder folder("throats");
  for (const network& net : {two_grains_in_a_box(), one_prism(), one_tetrahedron()}) {
    std::vector<double> index(net.throat_count());
    for (std::size_t k = 0; k < index.size(); ++k) {
      index[k] = static_cast<double>(k);
    }
    io::write_throats(folder / "throats.vtu", net, {{"index", index}});
    const vtk_file file(folder / "throats.vtu");
    REQUIRE(file.cells() == net.throat_count());
    const auto types = file.array<std::uint8_t>("Cells", "types");
    for (std::size_t k = 0; k < file.cells(); ++k) {
      const auto facet = detail::facet_at(net, throat_id(k));
      CHECK(types[k] == (facet.grain_count == 3 ? triangle : quad));
      const auto difference = area_vector(file.corners(k)) - facet.area_vector;
      CHECK(norm(difference) <= 1e-15 * norm(facet.area_vector));
    }
    CHECK(file.array<double>("CellData", "index") == index);
  }
}

TEST_CASE("columns keep every bit: NaN, infinity, integers, enumerations, vectors, and names that XML would swallow") {
  enum class colour : std::uint8_t { red = 3 };
  const temporary_folder folder("columns");
  const network net = one_tetrahedron();
  const std::vector<double> odd{std::numeric_limits<double>::quiet_NaN()};
  const std::vector<float> endless{std::numeric_limits<float>::infinity()};
  const std::vector<colour> reds{colour::red};
  const std::vector<std::int64_t> large{-(std::int64_t{1} << 60)};
  const std::vector<vec3<double>> vectors{{1, 2, 3}};
  io::write_pores(folder / "pores.vtu", net,
                  {{"a < b & \"c\"", odd}, {"endless", endless}, {"red", reds}, {"large", large}, {"vector", vectors}});
  const vtk_file file(folder / "pores.vtu");
  CHECK(std::isnan(file.array<double>("CellData", "a < b & \"c\"").at(0)));
  CHECK(file.array<float>("CellData", "endless") == endless);
  CHECK(file.array<std::uint8_t>("CellData", "red").at(0) == 3);
  CHECK(file.array<std::int64_t>("CellData", "large") == large);
  CHECK(file.array<double>("CellData", "vector") == std::vector<double>{1, 2, 3});
}

TEST_CASE("a column of another length is refused by name and leaves no file") {
  const temporary_folder folder("length");
  const std::vector<double> two(2);
  CHECK_THROWS_WITH_AS(io::write_pores(folder / "pores.vtu", one_tetrahedron(), {{"two", two}}),
                       "column \"two\": found 2 rows, expected 1, one per row of pores.vtu", parameter_error);
  CHECK(folder.files() == 0);
}

TEST_CASE("grains are points with a radius") {
  const temporary_folder folder("vtp");
  const std::vector<sphere<double>> grains{{{1, 2, 3}, 0.5}, {{4, 5, 6}, 0.25}};
  const std::vector<std::int32_t> ids{7, 9};
  io::write_grains(folder / "grains.vtp", grains, {{"id", ids}});
  const vtk_file file(folder / "grains.vtp");
  CHECK(file.type() == "PolyData");
  CHECK(file.points() == 2);
  CHECK(file.array<double>("Points", "Points") == std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(file.array<double>("PointData", "radius") == std::vector<double>{0.5, 0.25});
  CHECK(file.array<std::int32_t>("PointData", "id") == ids);
  CHECK(file.array<std::int32_t>("Verts", "connectivity") == std::vector<std::int32_t>{0, 1});
  CHECK(file.array<std::int32_t>("Verts", "offsets") == std::vector<std::int32_t>{1, 2});
}

TEST_CASE("a series lists its files relative to itself, with exact and rising times") {
  const temporary_folder folder("pvd");
  io::pvd_series series(folder / "phases.pvd");
  series.add(0.1, folder / "phases" / "one.vtu");
  series.add(0.30000000000000004, folder / "phases" / "two & three.vtu");
  CHECK_THROWS_AS(series.add(0.3, folder / "x.vtu"), parameter_error);
  CHECK_THROWS_AS(series.add(std::nan(""), folder / "x.vtu"), parameter_error);
  series.write();
  const std::string text = contents_of(folder / "phases.pvd");
  const xml_element root = xml_parser(text).document();
  CHECK(root.at("type") == "Collection");
  const auto& sets = root.child("Collection").children;
  REQUIRE(sets.size() == 2);
  CHECK(sets[0].at("file") == "phases/one.vtu");
  CHECK(sets[1].at("file") == "phases/two & three.vtu");
  CHECK(std::stod(sets[1].at("timestep")) == 0.30000000000000004);
}
