// SPDX-License-Identifier: BSD-3-Clause
// An id of one kind cannot be used as an id of another.
// expect: could not convert .*throat|no known conversion from .*throat
#include "tetrapore/core.hpp"

std::size_t wanted(tetrapore::pore_id p) { return p.index(); }
std::size_t given() { return wanted(tetrapore::throat_id(7)); }
