// SPDX-License-Identifier: BSD-3-Clause
// A forcing scheme that carries a source tells it.
#include "tetrapore/lbm/mixture.hpp"

using namespace tetrapore::lbm;

struct mine {
  static constexpr bool carries_source = false;
  template <int Axes, class R, std::size_t Components>
  void prepare(const node_motion<R, Components>&, R (&)[Components][3]) const noexcept {}
};
using fluid = mixture<d3q19, bgk, mine>;
static_assert(sizeof(fluid) > 0);
