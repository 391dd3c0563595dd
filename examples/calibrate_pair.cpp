// SPDX-License-Identifier: BSD-3-Clause
//
// Two components that repel each other, measured: flat interfaces, bubbles, menisci between plates. Prints the header
// include/tetrapore/lbm/calibrated/mixtures.hpp; with arguments rows of it alone:
//   calibrate_pair [velocity_shift|guo TAU G]…
// About half an hour on a core. Rows that do not come to rest are named on stderr and left out.
#include "tetrapore/lbm/calibrate.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace lbm = tetrapore::lbm;

namespace {

struct request {
  bool shift;
  double tau;
  double attraction;
};

constexpr double main_density = 1;

/// c G of 2.8 to 4.8 by the velocity shift at four τ; Guo's source, whose c is near 1.
std::vector<request> all() {
  std::vector<request> r;
  for (const double g : {1.4, 1.6, 1.8, 2.0, 2.4}) {
    r.push_back({true, 1, g});
  }
  for (const double g : {0.8, 1.0}) {
    r.push_back({true, 0.7, g});
  }
  for (const double g : {2.1, 2.4}) {
    r.push_back({true, 1.5, g});
  }
  for (const double g : {2.4, 2.8, 3.2, 3.6, 4.0}) {
    r.push_back({false, 1, g});
  }
  for (const double g : {2.8, 3.2}) {
    r.push_back({false, 0.7, g});
  }
  return r;
}

bool print(const request& q) {
  const lbm::calibration_run run = q.shift ? lbm::calibrate<lbm::velocity_shift>(q.attraction, q.tau, main_density)
                                           : lbm::calibrate<lbm::guo>(q.attraction, q.tau, main_density);
  const lbm::calibrated_mixture& m = run.mixture;
  std::fprintf(stderr, "%s tau %g G %g: %s, %.2g updates\n", q.shift ? "velocity_shift" : "guo", q.tau, q.attraction,
               lbm::describe(run.end), static_cast<double>(run.updates));
  if (run.end != lbm::hold_end::stable) {
    return false;
  }
  std::printf("    {forcing_kind::%s, %g, %g, %.5f, %.5f, %.5f, %.2f, %.5f, %.2f, %.5f, %.2f, %.1e,\n     {",
              q.shift ? "velocity_shift" : "guo", m.tau, m.attraction, m.main, m.dissolved, m.factor, m.width,
              m.flat_tension, m.density_exponent, m.bubble_tension, m.curvature, m.spurious);
  for (std::size_t k = 0; k < m.wettability.size(); ++k) {
    std::printf("%s%.4f", k == 0 ? "" : ", ", m.wettability[k]);
  }
  std::printf("}},\n");
  std::fflush(stdout);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    bool good = true;
    for (int k = 1; k < argc; k += 3) {
      const bool known = std::strcmp(argv[k], "guo") == 0 || std::strcmp(argv[k], "velocity_shift") == 0;
      if (!known || k + 2 >= argc) {
        std::fprintf(stderr, "calibrate_pair [velocity_shift|guo TAU G]...: '%s' begins no row\n", argv[k]);
        return 2;
      }
      good = print({std::strcmp(argv[k], "guo") != 0, std::strtod(argv[k + 1], nullptr),
                    std::strtod(argv[k + 2], nullptr)}) &&
             good;
    }
    return good ? 0 : 1;
  }
  std::printf(
      "// SPDX-License-Identifier: BSD-3-Clause\n#pragma once\n\n"
      "// Made by examples/calibrate_pair.cpp: ./examples/run.sh calibrate_pair\n\n"
      "#include \"tetrapore/lbm/calibrated/mixture.hpp\"\n\n"
      "namespace tetrapore::inline TETRAPORE_ABI {\nnamespace lbm {\n\n"
      "// clang-format off\n"
      "/// Mixtures that were measured; `calibration.hpp` says to what accuracy.\n"
      "inline constexpr calibrated_mixture calibrated_mixtures[] = {\n");
  bool good = true;
  for (const request& q : all()) {
    good = print(q) && good;
  }
  std::printf("};\n// clang-format on\n\n}  // namespace lbm\n}  // namespace tetrapore::inline TETRAPORE_ABI\n");
  return good ? 0 : 1;
}
