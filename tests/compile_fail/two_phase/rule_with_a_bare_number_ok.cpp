// SPDX-License-Identifier: BSD-3-Clause
// A rule answers with a bracket and a reason.
#include "tetrapore/two_phase/entry_rule.hpp"

struct mine {
  static constexpr bool depends_on_state = false;
  static constexpr tetrapore::threshold_outcome one{tetrapore::bracket<double>::exactly(1.0),
                                                    tetrapore::entry_status::ok};
  auto threshold(const tetrapore::network&, const tetrapore::two_phase_state&, tetrapore::throat_id) const {
    return one;
  }
  void settle(const tetrapore::network&, const tetrapore::two_phase_state&, std::span<const tetrapore::throat_id>) {}
  void touched_by(const tetrapore::network&, const tetrapore::two_phase_state&, tetrapore::pore_id,
                  std::vector<tetrapore::throat_id>&) const {}
};
static_assert(tetrapore::entry_rule<mine>);
