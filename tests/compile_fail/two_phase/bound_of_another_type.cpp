// SPDX-License-Identifier: BSD-3-Clause
// A bound of a threshold is a pressure, not an answer that still has to be unpacked.
// expect: does not satisfy return-type-requirement|same_as<.*, double>
#include "tetrapore/two_phase/entry_rule.hpp"

struct mine {
  tetrapore::threshold_outcome answer(double p) const {
    return {tetrapore::bracket<double>::exactly(p), tetrapore::entry_status::ok};
  }
  auto lower_bound(tetrapore::throat_id) const { return answer(1.0); }
};
static_assert(tetrapore::bounds_thresholds<mine>);
