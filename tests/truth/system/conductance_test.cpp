// SPDX-License-Identifier: BSD-3-Clause
//
// Permeability and forces by the conductance laws against Stokes flow: Zick & Homsy 1982 where they give a number, else
// lattice-Boltzmann runs extrapolated in their resolution.
#include "support/compiled_triangulation.hpp"
#include "support/csv_table.hpp"
#include "support/shared_data.hpp"
#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/law/conductance.hpp"
#include "tetrapore/one_phase/forces.hpp"
#include "tetrapore/one_phase/permeability.hpp"
#include "tetrapore/packing/lattice.hpp"
#include "tetrapore/solver/multigrid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace tetrapore;

namespace {

/// The flow of a fluid of viscosity 1 through a periodic packing, as a user would have it.
template <class Law>
struct periodic_flow {
  explicit periodic_flow(const packing& p) : net(compiled_triangulation{}(p.grains, domain_of(p)).net) {}

  [[nodiscard]] permeability_tensor permeability() {
    const permeability_tensor k = tensor_of_permeability(flow, 1.0);
    for (const solve_report& r : k.reports) {
      CHECK(r.ok());
    }
    return k;
  }
  /// Force on each grain under the mean gradient −1 along an axis.
  [[nodiscard]] fluid_forces forces(std::size_t axis) {
    flow_conditions c;
    c.mean_gradient[axis] = -1.0;
    flow.set_conditions(c);
    CHECK(flow.solve().ok());
    return forces_on_grains(flow);
  }

  network net;
  saturated_flow<Law, multigrid_solver<>> flow{net, Law{.viscosity = 1.0},
                                               multigrid_solver<>({.coarsest = 50})};  // a hierarchy, small as it is
};

template <class Law>
double permeability(const packing& p) {
  return periodic_flow<Law>(p).permeability()(0, 0);
}

/// Lattice of spheres of radius 1 that do not touch: a block of `cells`³ cells, periodic, of the given solid fraction.
packing open_lattice(lattice_kind kind, double solid_fraction, std::size_t cells) {
  packing p = lattice(kind, {cells, cells, cells}, 1.0, {true, true, true});
  const double touching = static_cast<double>(p.grains.size()) * 4.0 / 3.0 * pi<double> / p.bounds->volume();
  const double stretch = std::cbrt(touching / solid_fraction);
  for (auto& g : p.grains) {
    g.centre *= stretch;
  }
  p.bounds->lo *= stretch;
  p.bounds->hi *= stretch;
  return p;
}

lattice_kind kind_of(const std::string& name) {
  return name == "sc"    ? lattice_kind::simple_cubic
         : name == "bcc" ? lattice_kind::body_centred
                         : lattice_kind::face_centred;
}

/// Permeability of an array of spheres of radius 1 from its drag factor.
double permeability_of(double drag, const packing& p) {
  return p.bounds->volume() / (6 * pi<double> * static_cast<double>(p.grains.size()) * drag);
}

/// The packing of stokes_random/: 64 equal spheres in a periodic unit cube, solid fraction 0.6.
packing random_of(const std::filesystem::path& path) {
  packing p;
  p.bounds = box{{0, 0, 0}, {1, 1, 1}};
  p.periodic = {true, true, true};
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    sphere<double> s;
    if (line.front() != '#' && words >> s.centre.x >> s.centre.y >> s.centre.z >> s.radius) {
      p.grains.push_back(s);
    }
  }
  return p;
}

/// Total force on each grain (with that of the mean gradient on its volume), per gradient times volume of the cell.
std::vector<vec3<double>> stokes_forces(const std::filesystem::path& path) {
  std::vector<vec3<double>> all;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    double skipped = 0;
    vec3<double> f;
    if (line.front() != '#' && words >> skipped >> skipped >> skipped >> skipped >> f.x >> f.y >> f.z) {
      all.push_back(f);
    }
  }
  return all;
}

/// √(Σ |F − F_stokes|² / Σ |F_stokes|²).
double force_error(const fluid_forces& f, const std::vector<vec3<double>>& exact) {
  double wrong = 0;
  double all = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    wrong += norm2(f.on(grain_id(i)) - exact[i]);
    all += norm2(exact[i]);
  }
  return std::sqrt(wrong / all);
}

}  // namespace

TEST_CASE(
    "regular arrays: the calibrated law is within 10 % of Stokes flow, within 5 % from a solid fraction of 0.55") {
  const csv_table t(test_file("truth/regular_arrays.csv"));
  // rows that the law was fitted to; the others test it
  const std::vector<std::string> fitted{"sc0.343", "sc0.5236", "bcc0.5", "bcc0.6802", "fcc0.3", "fcc0.6", "fcc0.7405"};
  REQUIRE(t.size() == 11);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const std::string name = t.text(i, "lattice") + t.text(i, "c");
    CAPTURE(name);
    const bool known = !t.text(i, "K_Zick_Homsy").empty();
    const double drag = t.number(i, known ? "K_Zick_Homsy" : "K_LBM_extrap2");
    const packing p = open_lattice(kind_of(t.text(i, "lattice")), t.number(i, "c"), 3);
    const double exact = permeability_of(drag, p);
    const double by_fit = permeability<calibrated>(p) / exact;
    const double by_radius = permeability<hydraulic_radius>(p) / exact;
    CHECK(std::abs(by_fit - 1) < (t.number(i, "c") >= 0.55 ? 0.05 : 0.10));
    CHECK(by_radius == doctest::Approx(drag / t.number(i, "K_PFV_alpha1")).epsilon(0.006));
    const std::string role = std::find(fitted.begin(), fitted.end(), name) == fitted.end() ? "test" : "fitted";
    MESSAGE(role << ": k over that of Stokes flow, calibrated " << by_fit << ", hydraulic radius " << by_radius);
  }
}

TEST_CASE("open arrays, far below the range of the fit: the calibrated law falls as Stokes' law does") {
  // Zick & Homsy, simple cubic; the hydraulic radius is 3 to 16 times too permeable here
  for (const auto& [fraction, drag] : {std::array{0.027, 2.008}, {0.064, 2.810}, {0.125, 4.292}, {0.216, 7.442}}) {
    const packing p = open_lattice(lattice_kind::simple_cubic, fraction, 3);
    const double ratio = permeability<calibrated>(p) / permeability_of(drag, p);
    CAPTURE(fraction);
    CHECK(std::abs(ratio - 1) < 0.10);
  }
}

TEST_CASE("random packing: permeability and the force on each grain against Stokes flow") {
  const auto spheres = shared_file("data/truth/stokes_random/open_packing.txt");
  if (!spheres) {
    return;
  }
  const packing p = random_of(*spheres);
  REQUIRE(p.grains.size() == 64);
  struct run {
    const char* file;
    double permeability;          // of Stokes flow
    std::array<double, 2> ratio;  // to it, by the hydraulic radius and the calibrated law, as docs/flow.md has it
    std::array<double, 2> error;  // of the forces, likewise
  };
  // Along y and z the runs have 72 nodes; along x that resolution is 1.7 % below the extrapolated value. The calibrated
  // law was fitted to the permeability along x, among others; without this packing the fit is 6.7 % too high on it.
  const std::array<run, 3> runs{{{"open_forces_x_L144", 7.33e-5, {1.158, 1.018}, {0.0838, 0.0503}},
                                 {"open_forces_y_L72", 6.804e-5 * 7.33 / 7.205, {1.146, 1.012}, {0.0716, 0.0478}},
                                 {"open_forces_z_L72", 7.293e-5 * 7.33 / 7.205, {1.154, 1.008}, {0.0912, 0.0513}}}};
  periodic_flow<hydraulic_radius> by_radius(p);
  periodic_flow<calibrated> by_fit(p);
  const permeability_tensor k_radius = by_radius.permeability();
  const permeability_tensor k_fit = by_fit.permeability();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    const run& r = runs[axis];
    const auto path = shared_file("data/truth/stokes_random/" + std::string(r.file) + ".txt");
    if (!path) {
      return;
    }
    const auto truth = stokes_forces(*path);
    REQUIRE(truth.size() == 64);
    const double radius_error = force_error(by_radius.forces(axis), truth);
    const double fit_error = force_error(by_fit.forces(axis), truth);
    CHECK(radius_error <= 0.11);
    CHECK(fit_error <= radius_error);
    CHECK(std::abs(radius_error - r.error[0]) < 1e-4);
    CHECK(std::abs(fit_error - r.error[1]) < 1e-4);
    const double radius_ratio = k_radius(axis, axis) / r.permeability;
    const double fit_ratio = k_fit(axis, axis) / r.permeability;
    CHECK(std::abs(fit_ratio - 1) < 0.05);
    CHECK(std::abs(radius_ratio - r.ratio[0]) < 1e-3);
    CHECK(std::abs(fit_ratio - r.ratio[1]) < 1e-3);
    MESSAGE("axis " << axis << ": k over that of Stokes flow, hydraulic radius " << radius_ratio << ", calibrated "
                    << fit_ratio << "; error of the forces " << radius_error << ", " << fit_error);
  }
}

TEST_CASE("random packings that no law has seen: the calibrated law is within 10 % of Stokes flow") {
  // lattices of 72 nodes, 9 to the radius, lie 1 to 2 % below their limit where grains are so close (docs/lattice.md)
  const csv_table t(test_file("truth/periodic_packings.csv"));
  REQUIRE(t.size() == 12);
  std::string last;
  permeability_tensor by_radius;
  permeability_tensor by_fit;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const std::string name = t.text(i, "packing");
    const auto axis = static_cast<std::size_t>(t.text(i, "axis")[0] - 'x');
    CAPTURE(name);
    CAPTURE(axis);
    if (name != last) {
      const packing p = io::read_packing(test_file(name)).packing;
      REQUIRE(p.grains.size() == 64);
      by_radius = periodic_flow<hydraulic_radius>(p).permeability();
      by_fit = periodic_flow<calibrated>(p).permeability();
      last = name;
    }
    const double stokes = t.number(i, "permeability");
    const double fit_ratio = by_fit(axis, axis) / stokes;
    const double radius_ratio = by_radius(axis, axis) / stokes;
    CHECK(std::abs(fit_ratio - 1) < 0.10);
    CHECK(radius_ratio > fit_ratio);
    MESSAGE(name << ", axis " << axis << ": k over that of Stokes flow, hydraulic radius " << radius_ratio
                 << ", calibrated " << fit_ratio);
  }
}
