// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/read_packing.hpp"

#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <sys/resource.h>

using namespace tetrapore;
using io::read_options;
using io::read_packing;
using io::read_packing_from_memory;

namespace {

/// What the reader says about a text; empty when it accepts it.
std::string refusal(std::string_view text, const std::string& name = "p.txt", const read_options& options = {},
                    std::string_view nfo = {}) {
  return message_of<input_error>([&] { return read_packing_from_memory(text, name, options, nfo); });
}

/// A message that names the place, what was found and what was expected.
void says(const std::string& message, std::initializer_list<const char*> parts) {
  CAPTURE(message);
  CHECK_FALSE(message.empty());
  CHECK(contains(message, "found "));
  CHECK(contains(message, "expected "));
  for (const char* part : parts) {
    CAPTURE(part);
    CHECK(contains(message, part));
  }
}

/// Largest resident memory so far [kB].
long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

struct scratch_file {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("tetrapore_read_test_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)));
  ~scratch_file() { std::filesystem::remove(path); }
};

}  // namespace

TEST_CASE("a missing file, a folder and an empty file are named") {
  says(message_of<input_error>([] { return read_packing("no/such/file.txt"); }), {"no/such/file.txt", "No such file"});
  says(message_of<input_error>([] { return read_packing(std::filesystem::temp_directory_path()); }), {"a folder"});
  says(refusal(""), {"p.txt:1", "an empty file"});
  says(refusal("# box 0 1 0 1 0 1\n# nothing else\n"), {"p.txt:2", "no grain"});
}

TEST_CASE("text where a number should be is named with its line, the value and what was expected") {
  says(refusal("0 0 0 1\n1 0 0 1\n1 two 0 1\n"), {"p.txt:3", "\"two\"", "a finite number for y"});
  says(refusal("0 0 0 1\n1 0 0 1x\n"), {"p.txt:2", "\"1x\"", "the radius"});
  says(refusal("0 0 0 1\n0 0 0x10 1\n"), {"p.txt:2", "\"0x10\""});
  says(refusal("0 0 0 1\n1,5 0 0 1\n"), {"p.txt:2", "\"1,5\""});
  says(refusal("0 0 0 1\n1 0 0 1e\n"), {"\"1e\""});
  says(refusal("0 0 0 1\n1 0 0 +-1\n"), {"\"+-1\""});
  says(refusal("0,0,0,1\n1,,0,1\n", "p.csv"), {"p.csv:2", "\"\"", "a finite number for y"});
}

TEST_CASE("NaN, infinite and overflowing coordinates are refused with their line") {
  for (const char* bad : {"nan", "NaN", "inf", "-inf", "1e999", "-1e400"}) {
    CAPTURE(bad);
    says(refusal(std::string("0 0 0 1\n0 0 ") + bad + " 1\n"), {"p.txt:2", bad, "a finite number for z"});
  }
  says(refusal("nan nan nan nan\n"), {"p.txt:1", "nan"});
  says(refusal("1e300 0 0 1\n", "p.txt", {.scale = 1e10}), {"p.txt:1", "not finite"});
}

TEST_CASE("a radius of 0, below 0 or not finite is refused with its line") {
  for (const char* bad : {"0", "-0.25", "-0"}) {
    says(refusal(std::string("0 0 0 1\n0 0 1 ") + bad + "\n"), {"p.txt:2", "radius", "above 0"});
  }
  says(refusal("0 0 0 1\n0 0 1 -1e-7\n"), {"p.txt:2: found radius -1e-07"});
  says(refusal("0 0 0 1\n0 0 1 inf\n"), {"p.txt:2", "\"inf\""});
}

TEST_CASE("rows of another width and columns that are not there are refused") {
  says(refusal("0 0 0 1\n0 0 1\n"), {"p.txt:2", "3 columns", "4"});
  says(refusal("0 0 0 1 7\n"), {"p.txt:1", "5 columns"});
  says(refusal("x,y,z,mass\n0,0,0,1\n", "p.csv"), {"x y z mass", "a column for the radius"});
  says(refusal("x,z,r\n0,0,1\n", "p.csv"), {"a column for y"});
  says(refusal("x,y,z,r\n0,0,0\n", "p.csv"), {"p.csv:2", "3 columns", "4"});
  says(refusal("0 0 0 1\n", "p.txt", {.columns = {.x = "east"}}), {"east"});
  says(refusal("0 0 0 1\n", "p.txt", {.columns = {.x = 9}}), {"position 9"});
  CHECK_FALSE(message_of<parameter_error>([] {
                return read_packing_from_memory("0 0 0 1 2\n", "p", {.columns = {.radius = 3, .diameter = 4}});
              }).empty());
  CHECK_FALSE(message_of<parameter_error>([] {
                return read_packing_from_memory("x y z r\n0 0 0 1\n", "p", {.radius = 2.0});
              }).empty());
}

TEST_CASE("a box that is inverted, empty, not finite or cut short is refused with its line") {
  says(refusal("# box 0 1 1 0 0 1\n0 0 0 1\n"), {"p.txt:1", "along y", "the lower one first"});
  says(refusal("# box 0 0 0 1 0 1\n0 0 0 1\n"), {"p.txt:1", "along x"});
  says(refusal("# box 1e-7 -2e-7 0 1 0 1\n0 0 0 1\n"), {"a box from 1e-07 to -2e-07 along x"});
  says(refusal("# box 0 1 0 1 0 inf\n0 0 0 1\n"), {"p.txt:1", "\"inf\""});
  says(refusal("# box 0 1 0 1 0\n0 0 0 1\n"), {"p.txt:1", "x0 x1 y0 y1 z0 z1"});
  says(refusal("# box 0 1 0 1 0 1\n# box 0 1 0 1 0 1\n0 0 0 1\n"), {"p.txt:2", "a second box"});
  says(refusal("# box 0 1 0 1 0 1 ; periodic w\n0 0 0 1\n"), {"\"w\""});
  says(refusal("0 0 0 1\n", "p.txt", {.periodic = std::array<bool, 3>{true, false, false}}), {"periodic", "no box"});
}

TEST_CASE("a file with fewer or more grains than it states is refused") {
  says(refusal("# box 0 1 0 1 0 1 ; N 3\n0 0 0 1\n0 0 1 1\n"), {"2 grains", "3", "line 1"});
  says(refusal("Number of Spheres: 2\nDomain Length (x,y,z): 1, 1, 1\n\n\n\n.1 .1 .1 .1\n", "pack.out"),
       {"1 spheres", "2"});
  says(refusal("Number of Spheres: 2\nDomain Length (x,y,z): 1, -1, 1\n\n\n\n", "pack.out"), {"pack.out:2", "along y"});
}

TEST_CASE("a dump that is cut short, tilted or without radii is refused") {
  const std::string head = "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n";
  says(refusal(head + "ITEM: ATOMS id x y z radius\n1 0 0 0 1\n", "d"), {"d:10", "after 1 atoms", "2 atoms"});
  says(refusal(head + "ITEM: ATOMS id x y z radius\n1 0 0 0 1\n2 0 0 1\n", "d"), {"d:11", "4 columns", "5"});
  says(refusal(head + "ITEM: ATOMS id x y z\n1 0 0 0\n2 0 0 1\n", "d"), {"d:9", "radius"});
  says(refusal(head, "d"), {"0 time steps"});
  says(refusal("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n-2\n", "d"), {"d:4", "\"-2\""});
  says(refusal("ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0\n0 1 0\n0 1 0\n", "d"), {"d:1", "orthogonal"});
  says(refusal("ITEM: BOX BOUNDS pp pp pp\n0 1\n1 0\n0 1\n", "d"), {"along y"});
  says(refusal("ITEM: SURPRISE\n", "d"), {"d:1", "ITEM: SURPRISE"});
  says(refusal(head + "ITEM: ATOMS id x y z radius\n1 0 0 0 1\n2 0 0 1 1\n", "d", {.snapshot = 3}),
       {"1 time steps", "number 3"});
}

TEST_CASE("a truncated binary file is named with the byte") {
  const std::string grain(32, '\x3f');
  CHECK(refusal(grain, "p.xyzd").empty());
  says(refusal(grain + "abc", "p.xyzd"), {"p.xyzd: byte 32", "3 bytes", "32 bytes"});
  says(refusal(grain.substr(1), "p.xyzd"), {"byte 0", "31 bytes"});
  says(refusal(grain, "p.xyzd", {}, "N: 2\nDimensions: 1 1 1\n"), {"1 grains", "2", "nfo"});
  says(refusal(grain, "p.xyzd", {}, "Dimensions: 1 0 1\n"), {"nfo:1", "along y"});
  says(refusal(std::string(32, '\0'), "p.xyzd"), {"byte 0", "radius"});
  says(refusal(grain + std::string(24, '\0') + std::string(8, '\x7f') + std::string(32, '\xff'), "p.xyzd"),
       {"byte 64"});
}

TEST_CASE("a NUL byte, another encoding and a lone carriage return are not numbers") {
  says(refusal(std::string_view("0 0 0 1\n0 0 1\0 1\n", 17)), {"p.txt:2", "\\x00"});
  says(refusal(std::string_view("\xff\xfe"
                                "0\0 \0"
                                "0\0",
                                8)),
       {"p.txt:1"});
  says(refusal("0 0 0 1\r1 0 0 1\r"), {"p.txt:1"});
}

TEST_CASE("a line of 100 MB is refused without being held in memory") {
  const scratch_file file;
  {
    std::ofstream out(file.path, std::ios::binary);
    const std::string block(1000000, '1');
    out << "0 0 0 1\n";
    for (int k = 0; k < 100; ++k) {
      out << block;
    }
  }
  const long before = peak_memory();
  says(message_of<input_error>([&] { return read_packing(file.path); }), {":2", "65536 bytes"});
  CHECK(peak_memory() - before < 32 * 1024);
  says(refusal("0 0 0 1\n0 0 0 0.00000000000000001\n", "p", {.longest_line = 20}), {"p:2", "20 bytes"});
  CHECK(refusal("0 0 0 1\n0 0 0 0.00000000001\n", "p", {.longest_line = 20}).empty());
}

TEST_CASE("options outside their domain are refused by name") {
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK(
        contains(message_of<parameter_error>([&] { return read_packing_from_memory("0 0 0 1", "p", {.scale = bad}); }),
                 "scale"));
    CHECK(contains(message_of<parameter_error>([&] { return read_packing_from_memory("0 0 0", "p", {.radius = bad}); }),
                   "radius"));
  }
  says(message_of<parameter_error>([] { return read_packing_from_memory("0 0 0 1", "p", {.scale = -1e-7}); }),
       {"scale: found -1e-07"});
  CHECK_FALSE(message_of<parameter_error>([] { return io::column(-1); }).empty());
}
