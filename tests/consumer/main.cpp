// SPDX-License-Identifier: BSD-3-Clause
// A user's program of several translation units.

#include <tetrapore/core.hpp>
#include <tetrapore/law/entry/concept.hpp>

#include <array>

bool other_half();
#ifdef CONSUMER_HAS_CGAL
bool has_network();
#else
static bool has_network() { return true; }
#endif
#ifdef CONSUMER_HAS_EIGEN
bool takes_eigen_positions();
#else
static bool takes_eigen_positions() { return true; }
#endif
#ifdef CONSUMER_HAS_CHOLMOD
bool halves_the_drop();
#else
static bool halves_the_drop() { return true; }
#endif

namespace {

struct grain {  // a user's own type
  std::array<float, 3> centre;
};

/// A user's own law: a straight tube as wide as the first disc.
struct tube {
  double tension;

  [[nodiscard]] tetrapore::outcome<double, tetrapore::entry_status> entry_pressure(
      const tetrapore::opening<double>& ring) const noexcept {
    return {2 * tension / ring.sides[0].radius, tetrapore::entry_status::ok};
  }
};
static_assert(tetrapore::entry_law<tube>);

}  // namespace

int main() {
  tetrapore::opening<double> ring;
  ring.add_disc({0.0, 0.0}, 0.5);
  const auto answer = tube{1.0}.entry_pressure(ring);
  const auto x = tetrapore::coordinates(grain{{1.0F, 2.0F, 3.0F}}.centre);
  return answer.ok() && answer.value == 4.0 && x.z == 3.0 && other_half() && has_network() && takes_eigen_positions() &&
                 halves_the_drop()
             ? 0
             : 1;
}
