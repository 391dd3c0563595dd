// SPDX-License-Identifier: BSD-3-Clause
#include <tetrapore/core.hpp>
#include <tetrapore/law/entry/concept.hpp>

bool other_half();

bool other_half() {
  tetrapore::tally counts;
  counts.add(verdict_of(tetrapore::entry_status::closed), 7);
  return counts[tetrapore::verdict::absent] == 1;
}
