// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/pack.hpp"

#include <cmath>
#include <concepts>

/// \file
/// Pseudopotentials: what of a node's density its neighbours feel.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// A pseudopotential ψ(ρ).
/// Syntax: `p(rho)` and `p.per_density(rho)`, ψ/ρ, for a number and for a pack of numbers, const and noexcept.
/// Semantics: ψ(0) = 0, rising; ψ/ρ is regular at 0, where a component is absent.
/// Models: linear_potential, exponential_potential; a user's own.
/// \par Source  Shan & Chen, Phys. Rev. E 47, 1815 (1993)
template <class P>
concept pseudopotential = std::copyable<P> && requires(const P p, const double x, const pack<float, 4> y) {
  { p(x) } noexcept -> std::same_as<double>;
  { p(y) } noexcept -> std::same_as<pack<float, 4>>;
  { p.per_density(y) } noexcept -> std::same_as<pack<float, 4>>;
};

/// ψ = ρ: two components that repel each other.
struct linear_potential {
  template <class R>
  [[nodiscard, gnu::always_inline]] R operator()(const R& rho) const noexcept {
    return rho;
  }
  template <class R>
  [[nodiscard, gnu::always_inline]] R per_density(const R&) const noexcept {
    return R(1);
  }
};
static_assert(pseudopotential<linear_potential>);

/// ψ = ρ0 (1 − exp(−ρ/ρ0)): one component with liquid and vapour; between two components it bounds what attracts.
/// \par Source  Shan & Chen, Phys. Rev. E 47, 1815 (1993)
struct exponential_potential {
  double saturation = 1;  ///< ρ0

  template <class R>
  [[nodiscard, gnu::always_inline]] R operator()(const R& rho) const noexcept {
    using number = typename lane_of<R>::type;
    const number most = static_cast<number>(saturation);
    return lanewise(rho, [most](const number& x) {
      using std::expm1;
      return -most * expm1(-x / most);
    });
  }
  template <class R>
  [[nodiscard, gnu::always_inline]] R per_density(const R& rho) const noexcept {
    using number = typename lane_of<R>::type;
    const number most = static_cast<number>(saturation);
    return lanewise(rho, [most](const number& x) {
      using std::abs;
      using std::expm1;
      const number share = x / most;
      return abs(share) < static_cast<number>(1e-4) ? number(1) - share * static_cast<number>(0.5)
                                                    : -expm1(-share) / share;
    });
  }
};
static_assert(pseudopotential<exponential_potential>);

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
