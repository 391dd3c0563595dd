// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/vtp.hpp"

#include "support/vtk_file.hpp"

#include <cmath>
#include <vector>

using namespace tetrapore;

namespace {

struct strip_sums {
  double area = 0;
  vec3<double> area_vector{};
  double outward = 0;  ///< of area vectors times the radial direction, over the area
};

/// The triangles of strip k, turned as the format says: every second one the other way.
strip_sums sums_of(const vtk_file& file, std::size_t k, const io::tube& t) {
  const auto xyz = file.array<float>("Points", "Points");
  const auto corners = file.array<std::int32_t>("Strips", "connectivity");
  const auto ends = file.array<std::int32_t>("Strips", "offsets");
  const auto begin = static_cast<std::size_t>(k == 0 ? 0 : ends.at(k - 1));
  const auto end = static_cast<std::size_t>(ends.at(k));
  const auto point = [&](std::size_t c) {
    const auto p = static_cast<std::size_t>(corners.at(c));
    return vec3<double>{xyz.at(3 * p), xyz.at(3 * p + 1), xyz.at(3 * p + 2)};
  };
  strip_sums s;
  for (std::size_t c = begin; c + 2 < end; ++c) {
    const bool even = (c - begin) % 2 == 0;
    const auto p = point(c);
    const auto q = point(even ? c + 1 : c + 2);
    const auto r = point(even ? c + 2 : c + 1);
    const auto a = 0.5 * cross(q - p, r - p);
    const auto middle = (p + q + r) / 3 - t.start;
    const auto radial = middle - dot(middle, t.axis) * t.axis;
    s.area += norm(a);
    s.area_vector += a;
    s.outward += dot(a, radial) / norm(radial);
  }
  s.outward /= s.area;
  return s;
}

}  // namespace

TEST_CASE("tubes are one strip each, face outward and have the area of their surface") {
  const temporary_folder folder("tubes");
  const double third = 1 / std::sqrt(3.0);
  const std::vector<io::tube> tubes{{{1, 2, 3}, {0, 0, 1}, {{0, 0.5}, {1, 0.5}, {3, 0.5}}},
                                    {{0, 0, 0}, {third, -third, third}, {{-1, 1}, {1, 2}}}};
  const std::vector<double> force{4, 5};
  const std::size_t sides = 400;
  io::write_tubes(folder / "bridges.vtp", tubes, {{"force [N]", force}}, sides);
  const vtk_file file(folder / "bridges.vtp");
  CHECK(file.type() == "PolyData");
  CHECK(file.piece().at("NumberOfStrips") == "2");
  CHECK(file.points() == 5 * sides);
  CHECK(file.array<double>("CellData", "force [N]") == force);
  const auto cylinder = sums_of(file, 0, tubes[0]);
  CHECK(cylinder.area == doctest::Approx(2 * pi<double> * 0.5 * 3).epsilon(1e-4));
  CHECK(cylinder.outward == doctest::Approx(1).epsilon(1e-4));
  CHECK(norm(cylinder.area_vector) < 1e-5);
  const auto cone = sums_of(file, 1, tubes[1]);
  CHECK(cone.area == doctest::Approx(pi<double> * (1 + 2) * std::sqrt(5.0)).epsilon(1e-4));
  CHECK(cone.outward == doctest::Approx(2 / std::sqrt(5.0)).epsilon(1e-3));
}

TEST_CASE("no tubes make a file without cells") {
  const temporary_folder folder("no_tubes");
  io::write_tubes(folder / "bridges.vtp", {}, {});
  CHECK(vtk_file(folder / "bridges.vtp").piece().at("NumberOfStrips") == "0");
}

TEST_CASE("a tube of one point, a section of two corners and a column of another length are refused by name") {
  const temporary_folder folder("bad_tubes");
  const std::vector<io::tube> good{{{0, 0, 0}, {0, 0, 1}, {{0, 1}, {1, 1}}}};
  const std::vector<io::tube> bad{good[0], {{0, 0, 0}, {0, 0, 1}, {{0, 1}}}};
  const std::vector<double> two(2);
  CHECK_THROWS_WITH_AS(io::write_tubes(folder / "x.vtp", bad, {}),
                       "tube 1: found a profile of 1 points, expected at least 2", parameter_error);
  CHECK_THROWS_WITH_AS(io::write_tubes(folder / "x.vtp", good, {}, 2), "sides of a tube: found 2, expected at least 3",
                       parameter_error);
  CHECK_THROWS_AS(io::write_tubes(folder / "x.vtp", good, {{"two", two}}), parameter_error);
  CHECK(folder.files() == 0);
}
