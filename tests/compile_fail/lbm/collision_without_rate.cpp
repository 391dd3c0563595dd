// SPDX-License-Identifier: BSD-3-Clause
// A collision says at which rate momentum relaxes: forcing schemes weigh by it.
// expect: invalid because 'c\.rate\(\)' would be invalid|'c\.rate\(\)' is invalid|no member named 'rate'
#include "tetrapore/lbm/mixture.hpp"

using namespace tetrapore::lbm;

struct mine {
  double tau = 1;
  double speed() const noexcept { return 1 / tau; }
  template <lattice L, class R, class Source>
  void relax(R (&)[L::directions], const relaxation_target<R>&, const Source&) const noexcept {}
};
using fluid = mixture<d3q19, mine>;
static_assert(sizeof(fluid) > 0);
