// SPDX-License-Identifier: BSD-3-Clause
//
// One law, inside a simulator of grains that knows nothing of networks: at which capillary pressure does air enter the
// throat between three grains? The header of the laws, the one that makes openings from spheres, and nothing to link.
#include "tetrapore/law/entry.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <cmath>
#include <cstdio>

namespace tp = tetrapore;

// The simulator has its own grains, and keeps them.
namespace simulator {

struct body {
  float position[3];  // [mm]
  float diameter;     // [mm]
};

// It says once where a centre and a radius are, in metres, and every function of tetrapore takes its bodies.
tp::sphere<double> tetrapore_sphere(const body& b) {
  constexpr double mm = 1e-3;
  return {{b.position[0] * mm, b.position[1] * mm, b.position[2] * mm}, 0.5 * b.diameter * mm};
}

}  // namespace simulator
static_assert(tp::grain_like<simulator::body>);

// A law of the user's own: p = σ cos θ (perimeter of the solid) / (area of the fluid), what a tube of that section
// would need if its corners did not matter. It models the concept, and that is all there is to register.
struct as_a_tube {
  tp::required<double> surface_tension;  // [N/m]
  double contact_angle = 0;              // [rad]

  tp::outcome<double, tp::entry_status> entry_pressure(const tp::opening<double>& ring) const noexcept {
    double area = 0;
    double perimeter = 0;
    for (std::size_t k = 0; k < ring.count; ++k) {
      const auto& side = ring.sides[k];
      if (side.kind == tp::side_kind::line) {
        return {std::nan(""), tp::entry_status::not_covered};  // a reason, not a guess
      }
      const auto to_next = ring.sides[ring.next(k)].point - side.point;
      const auto to_last = ring.sides[ring.previous(k)].point - side.point;
      const double angle = std::atan2(cross(to_next, to_last), dot(to_next, to_last));
      area += 0.5 * cross(side.point, ring.sides[ring.next(k)].point) - 0.5 * angle * side.radius * side.radius;
      perimeter += angle * side.radius;
    }
    if (!(area > 0)) {
      return {tp::infinity<double>, tp::entry_status::closed};
    }
    return {surface_tension * std::cos(contact_angle) * perimeter / area, tp::entry_status::ok};
  }
};
static_assert(tp::entry_law<as_a_tube>);

// Any law will do: which one is a template argument, and the compiler sees through it.
template <tp::entry_law Law>
void report(const char* name, const Law& law, const tp::opening<double>& throat) {
  const auto entry = law.entry_pressure(throat);
  if (entry.ok()) {
    std::printf("%-22s %8.1f Pa   (%s)\n", name, entry.value, describe(entry.reason));
  } else {
    std::printf("%-22s %11s   (%s: %s)\n", name, "-", describe(entry.kind()), describe(entry.reason));
  }
}

void ask_every_law(const char* title, const simulator::body& a, const simulator::body& b, const simulator::body& c) {
  constexpr double water = 0.072;  // [N/m]
  const auto throat = tp::opening_from_spheres(tp::as_sphere(a), tp::as_sphere(b), tp::as_sphere(c));
  std::printf("%s\n", title);
  report("  inscribed circle", tp::inscribed_circle{.surface_tension = water}, throat);
  report("  Mayer-Stowe-Princen", tp::mayer_stowe_princen{.surface_tension = water}, throat);
  report("  the same at 40 deg", tp::mayer_stowe_princen{.surface_tension = water, .contact_angle = 0.6981317}, throat);
  report("  as a tube (mine)", as_a_tube{.surface_tension = water}, throat);
}

int main() {
  const simulator::body a{{0, 0, 0}, 1};
  const simulator::body b{{1, 0, 0}, 1};
  ask_every_law("Three touching grains of 1 mm", a, b, {{0.5F, 0.8660254F, 0}, 1});
  ask_every_law("The third a little smaller, and apart", a, b, {{0.5F, 0.6F, 0.7F}, 0.8F});
  ask_every_law("The third far away: the widest gap holds no meniscus", a, b, {{0.5F, 1.9F, 0}, 1});
  ask_every_law("The third pressed between the two closes the throat", a, b, {{0.5F, 0.5F, 0}, 1});
}
