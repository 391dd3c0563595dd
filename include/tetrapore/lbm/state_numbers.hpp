// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

/// \file
/// The numbers that fluids keep between steps: populations or moments of all nodes.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {
namespace detail {

/// Whether a simulation keeps moments in place of populations.
template <class Simulation>
inline constexpr bool keeps_moments = requires { Simulation::moments; };

/// Numbers that are kept of a node and component.
template <class Simulation>
inline constexpr std::size_t kept_of_node = [] {
  if constexpr (keeps_moments<Simulation>) {
    return Simulation::moments;
  } else {
    return Simulation::directions;
  }
}();

template <class Simulation>
[[nodiscard]] auto& kept_number(Simulation& s, std::size_t component, std::size_t node, std::size_t k) noexcept {
  if constexpr (keeps_moments<Simulation>) {
    return s.moment(component, node, k);
  } else {
    return s.population(component, node, k);
  }
}

template <class Simulation, class Do>
void for_each_number(Simulation& s, Do apply) {
  for (std::size_t c = 0; c < Simulation::components; ++c) {
    for (std::size_t k = 0; k < kept_of_node<Simulation>; ++k) {
      for (std::size_t n = 0; n < s.sites().size(); ++n) {
        apply(kept_number(s, c, n, k));
      }
    }
  }
}

}  // namespace detail

/// The state of fluids behind a step: with it another simulation of the same model, nodes, walls and reservoirs goes on
/// to the bit, where both have made an even number of steps.
template <class Simulation>
using state_numbers =
    std::vector<std::remove_cvref_t<decltype(detail::kept_number(std::declval<const Simulation&>(), 0, 0, 0))>>;

template <class Simulation>
[[nodiscard]] std::size_t state_size(const Simulation& s) noexcept {
  return Simulation::components * detail::kept_of_node<Simulation> * s.sites().size();
}
template <class Simulation>
void copy_state(const Simulation& s, state_numbers<Simulation>& to) {
  to.resize(state_size(s));
  std::size_t at = 0;
  detail::for_each_number(s, [&](const auto& x) { to[at++] = x; });
}
/// \param from  `state_size(s)` numbers
template <class Simulation>
void put_state(Simulation& s, const state_numbers<Simulation>& from) {
  std::size_t at = 0;
  detail::for_each_number(s, [&](auto& x) { x = from[at++]; });
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
