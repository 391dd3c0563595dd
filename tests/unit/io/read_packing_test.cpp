// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/read_packing.hpp"

#include "support/errors.hpp"
#include "support/shared_data.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <clocale>
#include <cstdint>
#include <string>

using namespace tetrapore;
using io::packing_format;
using io::read_packing;
using io::read_packing_from_memory;

namespace {

std::string bytes_of(std::initializer_list<double> values) {
  std::string out;
  for (const double v : values) {
    const auto bits = std::bit_cast<std::uint64_t>(v);
    for (unsigned k = 0; k < 8; ++k) {
      out += static_cast<char>(bits >> (8 * k) & 0xff);
    }
  }
  return out;
}

}  // namespace

TEST_CASE("our text format gives grains, box and nothing else") {
  const auto r = read_packing_from_memory(
      "# box 0 1 -1 2 0 3.5 ; units m ; columns x y z r ; N 2\n# made by hand\n.5 .25 1e0 1E-1\n+0.5 1 -0 2.5e-1\n",
      "p.txt");
  REQUIRE(r.packing.grains.size() == 2);
  CHECK(r.packing.grains[0] == sphere<double>{{0.5, 0.25, 1.0}, 0.1});
  CHECK(r.packing.grains[1] == sphere<double>{{0.5, 1.0, 0.0}, 0.25});
  REQUIRE(r.packing.bounds);
  CHECK(r.packing.bounds->lo == vec3<double>{0, -1, 0});
  CHECK(r.packing.bounds->hi == vec3<double>{1, 2, 3.5});
  CHECK(r.packing.periodic == std::array<bool, 3>{false, false, false});
  CHECK(r.report.format == packing_format::text);
  CHECK(r.report.lines == 4);
  CHECK(r.report.grains_read == 2);
  CHECK(r.report.box_source == "line 1");
  CHECK(r.report.warnings.size() == 2);  // the grains fill less than half of y and of z
}

TEST_CASE("the box comment states periodic axes, and grains are wrapped into it") {
  const auto r = read_packing_from_memory("# box 0 1 0 1 0 1 ; periodic xz\n1.25 .5 -.25 .1\n.5 .5 .5 .1\n", "p.txt");
  CHECK(r.packing.periodic == std::array<bool, 3>{true, false, true});
  CHECK(r.packing.grains[0].centre == vec3<double>{0.25, 0.5, 0.75});
  CHECK(r.report.wrapping.wrapped == 1);
}

TEST_CASE("a grain listed with its periodic image is read once, and the report names the image") {
  const auto r = read_packing_from_memory(
      "# box 0 1 0 1 0 1 ; periodic xyz\n0 .5 .5 .1\n.5 .5 .5 .1\n1 .5 .5 .1\n.5 .5 1.5 .1\n", "p.txt");
  CHECK(r.report.grains_read == 4);
  CHECK(r.report.wrapping.duplicates == std::vector<std::size_t>{2, 3});
  REQUIRE(r.packing.grains.size() == 2);
  CHECK(r.packing.grains[0].centre.x == 0.0);
}

TEST_CASE("line ends, byte order marks, blank lines and trailing comments do not matter") {
  const auto plain = read_packing_from_memory("0 0 0 1\n2 0 0 1\n", "p.txt").packing;
  for (const char* text : {"0 0 0 1\r\n2 0 0 1\r\n",
                           "\xef\xbb\xbf"
                           "0 0 0 1\n2 0 0 1",
                           "\n0 0 0 1\n\n \t\n2 0 0 1\n\n", "\t0 0\t0  1  \n2 0 0 1 # the last\n"}) {
    CHECK(read_packing_from_memory(text, "p.txt").packing.grains == plain.grains);
  }
}

TEST_CASE("numbers are read alike in a locale with a decimal comma") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) {
      break;
    }
  }
  const auto r = read_packing_from_memory("0.5 1.5 2.5 0.125\n", "p.txt");
  std::setlocale(LC_ALL, before.c_str());
  CHECK(r.packing.grains[0] == sphere<double>{{0.5, 1.5, 2.5}, 0.125});
}

TEST_CASE("CSV columns are found by their names, in any order and case") {
  for (const char* text :
       {"id,Radius,Z,Y,X\n7,0.5,3,2,1\n", "id;radius;z;y;x\n7;0.5;3;2;1\n", "id\tr\tz\ty\tx\n7\t.5\t3\t2\t1\n",
        "\"id\",\"D\",\"Points:2\",\"Points:1\",\"Points:0\"\n7,1,3,2,1\n", "# id, rad, z, y, x\n7, 0.5, 3, 2, 1\n"}) {
    const auto r = read_packing_from_memory(text, "p.csv");
    CHECK(r.packing.grains == std::vector<sphere<double>>{{{1, 2, 3}, 0.5}});
    CHECK(r.report.format == packing_format::csv);
  }
}

TEST_CASE("a column map chooses columns by name or position, radius or diameter") {
  const std::string text = "a,b,c,d\n1,2,3,4\n";
  CHECK(read_packing_from_memory(text, "p.csv", {.columns = {.x = "c", .y = "a", .z = 1, .radius = 3}})
            .packing.grains[0] == sphere<double>{{3, 1, 2}, 4});
  CHECK(read_packing_from_memory(text, "p.csv", {.columns = {.x = "A", .y = "b", .z = "c", .diameter = "d"}})
            .packing.grains[0] == sphere<double>{{1, 2, 3}, 2});
  CHECK(read_packing_from_memory("9 1 2 3\n", "p.txt", {.columns = {.x = 1, .y = 2, .z = 3}, .radius = 0.5})
            .packing.grains[0] == sphere<double>{{1, 2, 3}, 0.5});
  CHECK(read_packing_from_memory("1 2 3\n", "p.txt", {.radius = 0.5}).packing.grains[0].radius == 0.5);
}

TEST_CASE("scale turns the file's unit into metres, box and radius included") {
  const auto r =
      read_packing_from_memory("# box 0 2 0 2 0 2\n1 1 1 0.5\n", "p.txt", {.scale = 1e-3, .radius_factor = 2.0});
  CHECK(r.packing.grains[0] == sphere<double>{{1e-3, 1e-3, 1e-3}, 1e-3});
  CHECK(r.packing.bounds->hi == vec3<double>{2e-3, 2e-3, 2e-3});
}

TEST_CASE("the options' box and periodic axes replace those of the file") {
  const auto r = read_packing_from_memory(
      "# box 0 2 0 2 0 2\n1 1 5.5 0.5\n", "p.txt",
      {.bounds = box{{0, 0, 0}, {4, 4, 4}}, .periodic = std::array<bool, 3>{false, false, true}});
  CHECK(r.packing.bounds->hi.x == 4.0);
  CHECK(r.packing.grains[0].centre.z == 1.5);
  CHECK(r.report.box_source == "options");
}

TEST_CASE("Yade's text export names its columns in its first line") {
  const auto r = read_packing_from_memory("#format x_y_z_r\n0\t1\t2\t0.5\n1e-3\t0\t0\t.25\n", "spheres.txt");
  CHECK(r.report.format == packing_format::yade);
  CHECK(r.packing.grains == std::vector<sphere<double>>{{{0, 1, 2}, 0.5}, {{1e-3, 0, 0}, 0.25}});
  CHECK(read_packing_from_memory("#format id_x_y_z_r_matId\n3\t0\t1\t2\t0.5\t1\n", "s").packing.grains ==
        std::vector<sphere<double>>{{{0, 1, 2}, 0.5}});
  CHECK(read_packing_from_memory("#format x_y_z_r_attrs\n# x y z r volume mass\n0 1 2 .5 7 8\n", "s").packing.grains ==
        std::vector<sphere<double>>{{{0, 1, 2}, 0.5}});
}

namespace {
constexpr const char* two_steps =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp ff pp\n0 1\n0 2\n0 3\nITEM: ATOMS id x y z "
    "radius\n"
    "1 .5 .5 .5 .1\n"
    "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ff pp\n0 1\n0 2\n0 4\n"
    "ITEM: ATOMS radius z y x id \n.2 .5 .25 1.75 2\n.1 1 1 .5 1\n";
}

TEST_CASE("a dump gives its last time step, or the one asked for") {
  const auto last = read_packing_from_memory(two_steps, "dump.lammpstrj");
  CHECK(last.report.format == packing_format::dump);
  CHECK(last.report.snapshots == 2);
  CHECK(last.report.time_step == "100");
  CHECK(last.packing.grains == std::vector<sphere<double>>{{{0.75, 0.25, 0.5}, 0.2}, {{0.5, 1, 1}, 0.1}});
  CHECK(last.packing.bounds->hi.z == 4.0);
  CHECK(last.packing.periodic == std::array<bool, 3>{true, false, true});
  const auto first = read_packing_from_memory(two_steps, "dump.lammpstrj", {.snapshot = 0});
  CHECK(first.report.time_step == "0");
  CHECK(first.packing.grains.size() == 1);
  CHECK(first.packing.bounds->hi.z == 3.0);
}

TEST_CASE("a dump's scaled coordinates are taken back to the box, unwrapped ones are wrapped") {
  const std::string head =
      "ITEM: UNITS\nsi\nITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n"
      "1 3\n0 2\n0 2\nITEM: ATOMS id ";
  CHECK(read_packing_from_memory(head + "xs ys zs diameter\n1 .25 .5 .5 1\n", "d").packing.grains[0] ==
        sphere<double>{{1.5, 1, 1}, 0.5});
  CHECK(read_packing_from_memory(head + "xu yu zu radius\n1 5.5 1 1 .5\n", "d").packing.grains[0] ==
        sphere<double>{{1.5, 1, 1}, 0.5});
}

TEST_CASE("xyzd holds diameters, and the .nfo text gives the periodic box") {
  const auto bytes = bytes_of({1, 2, 3, 0.5, 4, 5, 6, 0.25});
  const auto bare = read_packing_from_memory(bytes, "packing.xyzd");
  CHECK(bare.packing.grains == std::vector<sphere<double>>{{{1, 2, 3}, 0.25}, {{4, 5, 6}, 0.125}});
  CHECK_FALSE(bare.packing.bounds);
  CHECK(bare.report.lines == 2);
  const auto boxed = read_packing_from_memory(bytes, "packing.xyzd", {}, "N: 2\n Dimensions: 7 8 9\n");
  CHECK(boxed.packing.bounds->hi == vec3<double>{7, 8, 9});
  CHECK(boxed.packing.periodic == std::array<bool, 3>{true, true, true});
}

TEST_CASE("pack.out has five lines of header and a periodic box") {
  const auto r = read_packing_from_memory(
      "Number of Spheres: 2\nDomain Length (x,y,z):  1, 2, 3\nMedia porosity: 0.4\nlog(r) …\nMean …\n"
      "0.1 0.2 0.3 0.05\n0.5 0.5 2.5 0.1\n",
      "pack.out");
  CHECK(r.report.format == packing_format::pack_out);
  CHECK(r.packing.grains.size() == 2);
  CHECK(r.packing.bounds->hi == vec3<double>{1, 2, 3});
  CHECK(r.packing.periodic == std::array<bool, 3>{true, true, true});
}

TEST_CASE("every packing of the shared data is read with its count and its box") {
  struct known {
    const char* file;
    std::size_t grains;
    packing_format format;
    bool boxed;
    bool periodic;
  };
  for (const auto& k : {known{"open_200.txt", 200, packing_format::text, true, false},
                        known{"open_1000.txt", 1000, packing_format::text, true, false},
                        known{"open_10000.txt", 10000, packing_format::text, true, false},
                        known{"open_40000.txt", 40000, packing_format::text, true, false},
                        known{"open_dem_1000.txt", 1000, packing_format::text, true, false},
                        known{"lattice_sc.txt", 512, packing_format::text, true, false},
                        known{"lattice_bcc.txt", 686, packing_format::text, true, false},
                        known{"lattice_fcc.txt", 864, packing_format::text, true, false},
                        known{"packing.xyzd", 10000, packing_format::xyzd, true, true},
                        known{"liggghts_dump.particles", 22410, packing_format::dump, true, false},
                        known{"Sph125_pack.out", 125, packing_format::pack_out, true, true},
                        known{"periodic_120_a.dat", 120, packing_format::text, false, false}}) {
    CAPTURE(k.file);
    const auto path = shared_file(std::string("data/packings/") + k.file);
    if (!path) {
      return;
    }
    const auto r = read_packing(*path);
    CHECK(r.packing.grains.size() == k.grains);
    CHECK(r.report.format == k.format);
    CHECK(r.packing.bounds.has_value() == k.boxed);
    CHECK(r.packing.periodic == std::array<bool, 3>{k.periodic, k.periodic, k.periodic});
    CHECK(r.report.wrapping.duplicates.empty());
  }
}

TEST_CASE("boxes and sizes of the shared data are those of its description") {
  const auto xyzd = shared_file("data/packings/packing.xyzd");
  const auto dump = shared_file("data/packings/liggghts_dump.particles");
  const auto equal = shared_file("data/packings/periodic_120_a.dat");
  if (!xyzd || !dump || !equal) {
    return;
  }
  CHECK(read_packing(*xyzd).packing.bounds->hi.x == 20.0823593086113);
  const auto d = read_packing(*dump);
  CHECK(d.packing.bounds->lo == vec3<double>{-0.05, -0.05, -0.5});
  CHECK(d.packing.bounds->hi == vec3<double>{0.55, 0.55, 4});
  CHECK(d.report.time_step == "50000000");
  CHECK(d.packing.grains[0].radius == 0.002);
  const auto e =
      read_packing(*equal, {.bounds = box{{0, 0, 0}, {1, 1, 1}}, .periodic = std::array<bool, 3>{true, true, true}});
  CHECK(e.packing.grains[0].radius == doctest::Approx(0.5 * 0.2049298395197904).epsilon(1e-15));
}

TEST_CASE("Finney's packing is read through a column map: 4021 balls of radius 1") {
  const auto path = shared_file("data/experiments/FinneyPack4021.txt");
  if (!path) {
    return;
  }
  const auto r = read_packing(*path, {.columns = {.x = 1, .y = 2, .z = 3}, .radius = 1.0});
  CHECK(r.packing.grains.size() == 4021);
  CHECK(r.packing.grains[0] == sphere<double>{{-0.324554, 0.081522, -0.452144}, 1.0});
}
