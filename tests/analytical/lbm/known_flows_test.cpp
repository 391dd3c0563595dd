// SPDX-License-Identifier: BSD-3-Clause
//
// Flow between plates and through a square tube against their series, and coexistence of two components against its
// closed form: what a lattice gives where the truth is known.

#include "tetrapore/lbm/simulation.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

using namespace tetrapore::lbm;
using place = std::array<int, 3>;

namespace {

template <class Lattice, class Collision, class Forcing>
using fluid = mixture<Lattice, Collision, Forcing, linear_potential, 1>;

/// The largest error of the velocity between two plates, relative to the largest velocity; plates across y, flow along
/// x.
template <class Model>
double channel_error(int width, double tau) {
  Model m;
  m.collisions[0].tau = tau;
  m.reference = {1};
  const double viscosity = m.viscosity(0);
  const double top = 0.02;
  const double gravity = top * 8 * viscosity / (width * width);
  m.gravity = {gravity, 0, 0};
  const lattice_box box{{1, width, 1},
                        {face_kind::periodic, face_kind::wall, face_kind::periodic},
                        {face_kind::periodic, face_kind::wall, face_kind::periodic}};
  simulation<Model, double> s(m, {box, [](int, int, int) { return site{}; }});
  s.run(static_cast<std::size_t>(8 * width * width / viscosity));
  double worst = 0;
  for (int y = 0; y < width; ++y) {
    const double across = y + 0.5;
    const double exact = gravity / (2 * viscosity) * across * (width - across);
    worst =
        std::max(worst, std::abs(s.velocity(static_cast<std::size_t>(s.sites().node_at(0, y, 0)))[0] - exact) / top);
  }
  return worst;
}

}  // namespace

TEST_CASE_TEMPLATE("between plates two relaxation times give the parabola itself, whatever the viscosity", Lattice,
                   d2q9, d3q19) {
  // Λ = 3/16 puts a straight wall half-way between nodes; what is left is the start that has not yet died out
  for (const double tau : {0.6, 1.0, 1.7}) {
    CHECK(channel_error<fluid<Lattice, trt, guo>>(7, tau) < 1e-10);
  }
}

TEST_CASE_TEMPLATE("between plates one relaxation time converges to second order", Collision, bgk, regularised) {
  // the wall lies (τ − 1/2)²-wise off: an offset of the velocity by 1/width²
  const double coarse = channel_error<fluid<d2q9, Collision, guo>>(6, 0.9);
  const double fine = channel_error<fluid<d2q9, Collision, guo>>(12, 0.9);
  CHECK(coarse / fine == doctest::Approx(4).epsilon(1e-6).scale(0));
}

TEST_CASE("with the velocity shift the parabola is the same, the velocity half a step of the force behind") {
  CHECK(channel_error<fluid<d2q9, bgk, velocity_shift>>(12, 1.0) ==
        doctest::Approx(channel_error<fluid<d2q9, bgk, guo>>(12, 1.0)).epsilon(1e-3).scale(0));
}

TEST_CASE("a square tube carries what its series says, to second order") {
  // ∫∫ u = G a⁴ / ν × 0.0351442… for a tube of side a: Boussinesq's series
  double share = 0;
  for (int n = 1; n < 200; n += 2) {
    share += std::tanh(n * std::numbers::pi / 2) / std::pow(n, 5);
  }
  const double series = 1.0 / 12 - 16 / std::pow(std::numbers::pi, 5) * share;
  const auto error_of = [&](int side) {
    using model = fluid<d3q19, trt, guo>;
    model m;
    m.collisions[0].tau = 1.2;
    m.reference = {1};
    m.gravity = {1e-3 / (side * side), 0, 0};
    const lattice_box box{{1, side, side},
                          {face_kind::periodic, face_kind::wall, face_kind::wall},
                          {face_kind::periodic, face_kind::wall, face_kind::wall}};
    simulation<model, double> s(m, {box, [](int, int, int) { return site{}; }});
    s.run(static_cast<std::size_t>(8 * side * side / m.viscosity(0)));
    double flow = 0;
    for (std::size_t n = 0; n < s.sites().size(); ++n) {
      flow += s.velocity(n)[0];
    }
    return flow * m.viscosity(0) / (m.gravity[0] * std::pow(side, 4)) / series - 1;
  };
  const double coarse = error_of(8);
  const double fine = error_of(16);
  CHECK(std::abs(fine) < 0.01);
  CHECK(coarse / fine == doctest::Approx(4).epsilon(0.1).scale(0));
}

namespace {

/// ln(a/b) / (G (a − b)) across a flat interface between a of the one component and b of it dissolved in the other.
template <class Forcing>
double coexistence(double strength) {
  using model = mixture<d2q9, bgk, Forcing>;  // along an axis all lattices are one
  model m;
  m.attraction = {{{0, strength}, {strength, 0}}};
  m.reference = {1, 1};
  const lattice_box box{{1, 96, 1},
                        {face_kind::periodic, face_kind::mirror, face_kind::periodic},
                        {face_kind::periodic, face_kind::mirror, face_kind::periodic}};
  simulation<model, double> s(m, {box, [](int, int, int) { return site{}; }});
  s.initialise([](const place& p, auto& rho, auto&) { rho = p[1] < 48 ? std::array{1.0, 0.2} : std::array{0.2, 1.0}; });
  s.run(60000);
  const auto low = s.densities_at(0);
  const auto high = s.densities_at(s.sites().size() - 1);
  CHECK(low[0] == doctest::Approx(high[1]).epsilon(1e-9).scale(0));
  return std::log(low[0] / low[1]) / (strength * (low[0] - low[1]));
}

}  // namespace

TEST_CASE("two components part by the rule of their forcing") {
  // ∇ρ_a/3 = −ρ_a c G ∇ρ_b/3, c = 1/(1 − 1/2τ) by the velocity shift and 1 by a source: ln(a/b) = c G (a − b), but for
  // terms of the squared force, which fade with the steepness of the interface
  CHECK(coexistence<velocity_shift>(1.2) == doctest::Approx(2).epsilon(0.003).scale(0));
  CHECK(coexistence<velocity_shift>(1.8) == doctest::Approx(2).epsilon(0.01).scale(0));
  const double weak = std::abs(coexistence<guo>(2.2) - 1);
  const double strong = std::abs(coexistence<guo>(3.6) - 1);
  CHECK(weak < 0.01);
  CHECK(weak < strong / 10);
}
