// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/connect.hpp"
#include "tetrapore/network/measure.hpp"
#include "tetrapore/network/validate.hpp"

/// \file
/// A network from the caller's own cells: no triangulation library is needed.

namespace tetrapore::inline TETRAPORE_ABI {

/// Connects cells, names the boundaries of an open region, and measures volumes and centres. Pore i is cell i.
/// \param cells  tetrahedra (or cells with walls) in positive order, each with the cell opposite to each vertex
/// \throw network_error  when the cells do not form a network; names the cell, the facet or the grain
/// \throw packing_error  when a cell cannot be measured
template <executor E = serial>
[[nodiscard]] network make_network(const domain& region, std::vector<sphere<double>> grains, std::vector<cell> cells,
                                   const E& cores = {}) {
  network net(connect(region, std::move(grains), std::move(cells)));
  detail::name_boundaries(net);
  measure(net, cores);
  validate(net);
  return net;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
