// SPDX-License-Identifier: BSD-3-Clause
//
// make_packing: writes a packing of spheres that the other programs read. Lengths are in metres.
//
// It has three sources:
//   a dense random packing    make_packing --grains 1000 --solid-fraction 0.58 --spread 0.3 --out random.txt
//   a lattice                 make_packing --lattice fcc --cells 8 --out fcc.txt
//   copies of another one     make_packing --tile 5 5 4 periodic.txt --out large.txt
//
// The packing that ships with the project was made by
//   ./examples/run.sh make_packing --grains 10000 --solid-fraction 0.60 --sizes examples/data/glass_beads_psd.csv
//       --seed 1 --walls --digits 9 --out examples/data/beads_10000.txt
// and says so in its second line.

#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/io/read_sizes.hpp"
#include "tetrapore/io/write_packing.hpp"
#include "tetrapore/packing.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace {

using tetrapore::lattice_kind;
using tetrapore::packing;

/// What the command line asks for.
struct request {
  std::size_t grains = 10000;
  double solid_fraction = 0.60;
  std::string sizes;
  double spread = 0.3;
  double lognormal = 0.0;
  double radius = 1e-3;
  std::uint64_t seed = 1;
  bool walls = false;
  std::string periodic;
  std::string lattice;
  std::size_t cells = 8;
  std::tuple<std::size_t, std::size_t, std::size_t, std::string> tile;
  std::string out;
  int digits = 17;
};

std::array<bool, 3> periodic_axes(const request& r) {
  std::array<bool, 3> axes{};
  for (const char axis : r.periodic) {
    axes[static_cast<std::size_t>(axis - 'x')] = true;
  }
  return axes;
}

std::vector<double> radii(const request& r) {
  if (!r.sizes.empty()) {
    return tetrapore::radii_by_mass(r.grains, tetrapore::io::read_sizes(r.sizes));
  }
  if (r.lognormal > 0) {
    return tetrapore::lognormal_radii(r.grains, r.radius, r.lognormal);
  }
  return tetrapore::uniform_radii(r.grains, r.radius, r.spread);
}

packing random_grains(const request& r) {
  tetrapore::random_packing_report report;
  auto p = tetrapore::random_packing(
      radii(r), {.solid_fraction = r.solid_fraction, .periodic = periodic_axes(r), .seed = r.seed}, &report);
  std::fprintf(stderr, "the grains came to rest after %zu iterations\n", report.iterations);
  return p;
}

const std::map<std::string, lattice_kind> lattices{{"sc", lattice_kind::simple_cubic},
                                                   {"bcc", lattice_kind::body_centred},
                                                   {"fcc", lattice_kind::face_centred},
                                                   {"hcp", lattice_kind::hexagonal_close}};

packing lattice(const request& r) {
  return tetrapore::lattice(lattices.at(r.lattice), {r.cells, r.cells, r.cells}, r.radius, periodic_axes(r));
}

packing copies(const request& r) {
  const auto& [nx, ny, nz, file] = r.tile;
  return tetrapore::tile(tetrapore::io::read_packing(file).packing, {nx, ny, nz});
}

/// The command as it was typed, without the path of the program.
std::string command(int argc, char** argv) {
  std::string line = "made by make_packing";
  for (int k = 1; k < argc; ++k) {
    line += std::string(" ") + argv[k];
  }
  return line;
}

/// What counts is the file: it is read back, and what rounding did to it is measured.
void verify(const std::string& file, bool may_overlap) {
  const auto p = tetrapore::io::read_packing(file).packing;
  tetrapore::check(p);
  const auto overlap = tetrapore::largest_overlap(p);
  if (!may_overlap && (overlap.grains > 0 || overlap.walls > 0)) {
    std::filesystem::remove(file);
    throw std::runtime_error("rounded to so few digits the grains would overlap: ask for more with --digits");
  }
  const auto r = tetrapore::radii_of(p.grains);
  std::printf("grains=%zu\nsolid_fraction=%.6f\nradius_smallest=%.9g\nradius_mean=%.9g\nradius_largest=%.9g\n",
              p.grains.size(), tetrapore::solid_fraction(p), r.smallest, r.mean, r.largest);
  std::printf("largest_overlap=%.3g\ncoordination=%.3f\n", overlap.grains, tetrapore::coordination_number(p, 1e-3));
}

}  // namespace

int main(int argc, char** argv) {
  request r;
  CLI::App app("Writes a packing of spheres: dense and random, a lattice, or copies of another packing.",
               "make_packing");
  app.add_option("--grains", r.grains, "number of grains")->capture_default_str();
  app.add_option("--solid-fraction", r.solid_fraction, "sphere volume over box volume")->capture_default_str();
  auto* sizes = app.add_option("--sizes", r.sizes, "grading curve: CSV, diameter_mm,cumulative_mass_fraction");
  auto* spread = app.add_option("--spread", r.spread, "radii even between 1 - spread and 1 + spread times --radius");
  spread->capture_default_str()->excludes(sizes);
  app.add_option("--lognormal", r.lognormal, "radii lognormal about --radius, with this deviation of ln r")
      ->excludes(sizes)
      ->excludes(spread);
  app.add_option("--radius", r.radius, "mean, median or only radius [m]")->capture_default_str()->excludes(sizes);
  app.add_option("--seed", r.seed, "another number gives another packing")->capture_default_str();
  auto* periodic = app.add_option("--periodic", r.periodic, "axes along which the box repeats, such as xz");
  periodic->check([](const std::string& axes) {
    return axes.find_first_not_of("xyz") == std::string::npos ? "" : "expected some of x, y, z";
  });
  app.add_flag("--walls", r.walls, "six walls; the default")->excludes(periodic);
  auto* lattice_of = app.add_option("--lattice", r.lattice, "touching spheres: sc, bcc, fcc or hcp");
  lattice_of->check(CLI::IsMember({"sc", "bcc", "fcc", "hcp"}));
  app.add_option("--cells", r.cells, "cells of the lattice along each axis")->capture_default_str()->needs(lattice_of);
  auto* copies_of = app.add_option("--tile", r.tile, "copies along x, y, z, and the periodic packing to copy");
  copies_of->excludes(lattice_of);
  app.add_option("--digits", r.digits, "significant digits in the file")
      ->capture_default_str()
      ->check(CLI::Range(1, 17));
  app.add_option("--out", r.out, "the file to write")->required();
  CLI11_PARSE(app, argc, argv);

  try {
    const bool is_lattice = lattice_of->count() > 0;
    const bool is_copy = copies_of->count() > 0;
    const packing p = is_lattice ? lattice(r) : (is_copy ? copies(r) : random_grains(r));
    tetrapore::check(p);
    tetrapore::io::write_packing(p, r.out, {.digits = r.digits, .comment = command(argc, argv)});
    verify(r.out, is_lattice || is_copy);  // spheres that touch overlap by their rounding
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_packing: %s\n", error.what());
    return 1;
  }
  return 0;
}
