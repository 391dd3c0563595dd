// SPDX-License-Identifier: BSD-3-Clause
// A collision says at which rate momentum relaxes: forcing schemes weigh by it.
#include "tetrapore/lbm/mixture.hpp"

using namespace tetrapore::lbm;

struct mine {
  double tau = 1;
  double rate() const noexcept { return 1 / tau; }
  template <lattice L, class R, class Source>
  void relax(R (&)[L::directions], const relaxation_target<R>&, const Source&) const noexcept {}
};
using fluid = mixture<d3q19, mine>;
static_assert(sizeof(fluid) > 0);
