// SPDX-License-Identifier: BSD-3-Clause
// A table is made from a law that knows where its bridges end; a fit does not.
// expect: constraints not satisfied|no matching member function for call to 'build'
#include "tetrapore/law/bridge/table.hpp"
#include "tetrapore/law/bridge/willett.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"

tetrapore::table_report made(tetrapore::bridge_table<1>& table) {
  return table.build(tetrapore::willett<>{.surface_tension = 0.072},
                     {.radius1 = 1.0, .radius2 = 1.0, .least_volume = 0.01, .largest_volume = 0.015});
}
