// SPDX-License-Identifier: BSD-3-Clause
// A conductance comes with its reason, never as a bare number.
// expect: conductance\(t\). does not satisfy return-type-requirement|same_as<double, outcome<double, conductance_status> >
#include "tetrapore/law/conductance/concept.hpp"

struct mine {
  tetrapore::outcome<double, tetrapore::conductance_status> at(double k) const noexcept {
    return {k, tetrapore::conductance_status::ok};
  }
  auto conductance(const tetrapore::throat<double>&) const noexcept { return at(1.0).value; }
};
static_assert(tetrapore::conductance_law<mine>);
