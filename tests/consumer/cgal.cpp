// SPDX-License-Identifier: BSD-3-Clause
#include <tetrapore/tessellation/cgal.hpp>

bool has_network();

bool has_network() { return true; }
