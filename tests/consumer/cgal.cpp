// SPDX-License-Identifier: BSD-3-Clause
#include <tetrapore/tessellation/cgal.hpp>

#include <array>
#include <cmath>
#include <deque>

bool has_network();

namespace {

struct ball {
  std::array<float, 3> position;
  float radius;
};

}  // namespace

/// Eight balls in a box, in a container and of a type that are the user's own: box = void + solid.
bool has_network() {
  std::deque<ball> balls;
  for (unsigned k = 0; k < 8; ++k) {
    const auto at = [k](unsigned axis) { return (k >> axis & 1U) != 0 ? 0.75F : 0.25F; };
    balls.push_back({{at(0), at(1), at(2)}, 0.25F});
  }
  const auto mesh =
      tetrapore::tessellate(balls, tetrapore::walled({{0, 0, 0}, {1, 1, 1}}), tetrapore::cgal_triangulation{});
  double voids = 0;
  for (const double v : mesh.net.arrays().void_volumes) {
    voids += v;
  }
  return std::abs(voids - (1 - tetrapore::pi<double> / 6)) < 1e-14;
}
