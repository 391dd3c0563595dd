// SPDX-License-Identifier: BSD-3-Clause
// A bare number is no id.
#include "tetrapore/core.hpp"

std::size_t wanted(tetrapore::pore_id p) { return p.index(); }
std::size_t given(std::size_t n) { return wanted(tetrapore::pore_id{n}); }
