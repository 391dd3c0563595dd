// SPDX-License-Identifier: BSD-3-Clause
// A rule says at compile time whether its thresholds depend on the state; the compiler names the part that is missing.
#include "tetrapore/two_phase/entry_rule.hpp"

struct mine {
  static constexpr bool depends_on_state = false;
  tetrapore::threshold_outcome threshold(const tetrapore::network&, const tetrapore::two_phase_state&,
                                         tetrapore::throat_id) const {
    return {tetrapore::bracket<double>::exactly(1.0), tetrapore::entry_status::ok};
  }
  void settle(const tetrapore::network&, const tetrapore::two_phase_state&, std::span<const tetrapore::throat_id>) {}
  void touched_by(const tetrapore::network&, const tetrapore::two_phase_state&, tetrapore::pore_id,
                  std::vector<tetrapore::throat_id>&) const {}
};
static_assert(tetrapore::entry_rule<mine>);
