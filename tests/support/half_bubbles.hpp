// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/moments.hpp"
#include "tetrapore/lbm/rest.hpp"
#include "tetrapore/lbm/throat.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <array>
#include <cmath>
#include <cstddef>

/// \file
/// Bubbles cut in half by a mirror: a face of the box, or an inclined side of a throat, which is made of images.

namespace half_bubbles {

using namespace tetrapore;
using namespace tetrapore::lbm;

struct seen {
  double tension;  ///< radius × difference of pressure over 1 (disc) or 2 (ball), mean of 1000 to 2000 steps
  double way;      ///< along the mirror in 2000 steps [nodes]
};

/// A bubble of 12 nodes in an empty prism of equal sides, whose grains are specks in its corners: half a disc through
/// all layers, or half of half a ball on the lowest one.
inline seen on_mirror(bool inclined, bool ball, double nodes) {
  const throat_on_lattice prism(opening_from_distances<double>(0.04, 0.04, 0.04, 1, 1, 1).value, {},
                                {.nodes_per_length = nodes, .above = 1, .below = ball ? 22.0 : 1.0, .plug = 1e9});
  const std::size_t side = prism.on_face(0) == inclined ? 1 : 0;
  const vec2<double> end = prism.grain((side + 1) % 3).centre;
  const vec2<double> along = (end - prism.grain(side).centre) * (1 / norm(end - prism.grain(side).centre));
  const vec2<double> centre = (end + prism.grain(side).centre) * 0.5;
  using fluids = mixture<d3q19, bgk>;
  simulation<fluids, float, storage::moments> s(repelling_pair<fluids>(1.8), prism.sites<d3q19>());
  s.set_wall(grain_wall, {0.03, 1});
  const auto from_centre = [&](const std::array<int, 3>& p, double way) {
    const vec2<double> d = vec2<double>{static_cast<double>(p[0]), static_cast<double>(p[1])} - centre - along * way;
    return std::hypot(norm(d), ball ? p[2] + 0.5 : 0);
  };
  lay_interface(s, {{ball ? 1.034 : 1.017, 0.029}, {0.034, 0.983}},
                [&](const std::array<int, 3>& p) { return 12 - from_centre(p, 0); });
  seen mean{};
  for (int look = 1; look <= 20; ++look) {
    s.run(100);
    double gas = 0;
    double moment = 0;
    std::array<double, 2> pressure{};
    std::array<double, 2> count{};
    for (std::size_t n = 0; n < s.sites().size(); ++n) {
      const auto& p = s.sites().place(n);
      const auto rho = s.densities_at(n);
      const double share = (rho[0] - rho[1] + 0.965) / 1.975;
      const double far = from_centre(p, mean.way);
      if (far < 18) {
        gas += share;
        moment += share * dot(vec2<double>{static_cast<double>(p[0]), static_cast<double>(p[1])} - centre, along);
      }
      if (far < 5 || (far > 20 && far < 23)) {
        pressure[far < 5 ? 0 : 1] += s.model().pressure(rho);
        count[far < 5 ? 0 : 1] += 1;
      }
    }
    mean.way = moment / gas;
    const double radius =
        ball ? std::cbrt(3 * gas / pi<double>) : std::sqrt(2 * gas / prism.box().size[2] / pi<double>);
    if (look > 10) {
      mean.tension += radius / (ball ? 20 : 10) * (pressure[0] / count[0] - pressure[1] / count[1]);
    }
  }
  return mean;
}

}  // namespace half_bubbles
