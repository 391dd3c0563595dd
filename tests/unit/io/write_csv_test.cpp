// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/csv.hpp"

#include "support/temporary_folder.hpp"

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

using namespace tetrapore;

TEST_CASE("a table has one header line, quotes what needs quotes, and names NaN and infinity") {
  const temporary_folder folder("csv");
  io::csv_writer table(folder / "t.csv", {"p_c [Pa]", "a, b", "count"});
  constexpr double inf = std::numeric_limits<double>::infinity();
  table.row(0.1, "said \"no\"", 3U);
  table.row(inf, std::string("plain"), -1);
  table.row(std::nan(""), "two\nlines", std::size_t{18446744073709551615U});
  table.row(-inf, "", std::uint8_t{65});
  table.commit();
  CHECK(contents_of(folder / "t.csv") ==
        "p_c [Pa],\"a, b\",count\n0.1,\"said "
        "\"\"no\"\"\",3\ninf,plain,-1\nnan,\"two\nlines\",18446744073709551615\n-inf,,65\n");
}

TEST_CASE("every double reads back to the last bit, whatever the locale") {
  const temporary_folder folder("digits");
  const bool commas = std::setlocale(LC_NUMERIC, "de_DE.UTF-8") != nullptr;
  std::mt19937_64 random(1);
  std::vector<double> values{std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max(), -0.0};
  while (values.size() < 10000) {
    const std::uint64_t bits = random();
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) {
      values.push_back(x);
    }
  }
  io::csv_writer table(folder / "t.csv", {"x"});
  for (const double x : values) {
    table.row(x);
  }
  table.commit();
  if (commas) {
    std::setlocale(LC_NUMERIC, "C");
  }
  std::ifstream in(folder / "t.csv");
  std::string line;
  std::getline(in, line);
  std::size_t wrong = 0;
  std::size_t longest = 0;
  for (const double x : values) {
    REQUIRE(std::getline(in, line));
    const double back = std::strtod(line.c_str(), nullptr);
    wrong += std::memcmp(&back, &x, sizeof x) == 0 ? 0 : 1;
    std::size_t digits = 0;
    for (const char c : line.substr(0, line.find('e'))) {
      digits += c >= '0' && c <= '9' ? 1 : 0;
    }
    longest = std::max(longest, digits);
  }
  CHECK(wrong == 0);
  CHECK(longest >= 17);
}

TEST_CASE("a file appears when it is complete, and not before") {
  const temporary_folder folder("part");
  {
    io::output_file file(folder / "a.txt");
    file << "half";
    CHECK_FALSE(std::filesystem::exists(folder / "a.txt"));
  }
  CHECK(folder.files() == 0);
  {
    io::output_file file(folder / "a.txt");
    file << "whole " << 1 << ' ' << 2.5 << '\n';
    file.commit();
  }
  CHECK(contents_of(folder / "a.txt") == "whole 1 2.5\n");
  {
    io::output_file file(folder / "a.txt");
    file << "another half";
  }
  CHECK(contents_of(folder / "a.txt") == "whole 1 2.5\n");
  CHECK(folder.files() == 1);
}

TEST_CASE("what is longer than the buffer arrives whole and in order") {
  const temporary_folder folder("long");
  const std::string block(200000, 'x');
  io::output_file file(folder / "a.txt");
  file << "begin" << block << "end" << block;
  file.commit();
  CHECK(contents_of(folder / "a.txt") == "begin" + block + "end" + block);
}

TEST_CASE("a place that cannot be written is named, with what the system said") {
  const temporary_folder folder("refused");
  const std::string path = (folder / "absent/a.csv").string();
  CHECK_THROWS_WITH_AS(io::output_file{path},
                       (path + ": found No such file or directory, expected a file that can be written").c_str(),
                       io::output_error);
  CHECK_THROWS_AS(io::output_file{folder.path() / "x" / ".." / "absent" / "b"}, io::output_error);
  std::filesystem::create_directory(folder / "occupied");
  set_contents(folder / "occupied/x", "x");
  io::output_file onto_a_folder(folder / "occupied");
  CHECK_THROWS_AS(onto_a_folder.commit(), io::output_error);
  CHECK(folder.files() == 1);
}

TEST_CASE("a full disk is an error") {
  if (!std::filesystem::exists("/dev/full")) {
    MESSAGE("skipped: this system has no /dev/full");
    return;
  }
  const temporary_folder folder("full");
  std::filesystem::create_symlink("/dev/full", folder / "a.csv.part");
  io::output_file file(folder / "a.csv");
  file << "something";
  CHECK_THROWS_AS(file.commit(), io::output_error);
}
