// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/lattice.hpp"
#include "tetrapore/lbm/pack.hpp"

/// \file
/// Forcing schemes: how the accelerations of the components enter a collision. The scheme changes the physics: with the
/// velocity shift a static gradient of pressure balances F / (1 − 1/2τ), with Guo's source F itself. A calibration
/// holds for the scheme that it was made with.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Nothing beside the equilibrium.
struct no_source {};

/// Guo's source: the force on a component and the velocity of all.
template <class R>
struct guo_source {
  R force[3];
  R velocity[3];
};

/// What a node's components carry into a forcing scheme.
template <class R, std::size_t Components>
struct node_motion {
  R rho[Components];
  R momentum[Components][3];      ///< Σ f c
  R acceleration[Components][3];  ///< force per density
  R rate[Components];             ///< 1/τ of what relaxes momentum
};

namespace detail {

/// (Σ rate × (momentum + share × force)) / Σ rate × ρ, the velocity that leaves the total momentum alone.
template <int Axes, bool HalfForce, class R, std::size_t Components>
[[gnu::always_inline]] inline void common_velocity(const node_motion<R, Components>& m, R (&u)[3]) noexcept {
  R weight = m.rate[0] * m.rho[0];
  repeat<static_cast<int>(Components) - 1>([&]<int C>(number<C>)
                                               TETRAPORE_INLINE { weight = weight + m.rate[C + 1] * m.rho[C + 1]; });
  const R inverse = R(1) / weight;
  const R half(static_cast<typename lane_of<R>::type>(0.5));
  repeat<Axes>([&]<int A>(number<A>) TETRAPORE_INLINE {
    R sum(0);
    repeat<static_cast<int>(Components)>([&]<int C>(number<C>) TETRAPORE_INLINE {
      R carried = m.momentum[C][A];
      if constexpr (HalfForce) {
        carried = carried + half * m.rho[C] * m.acceleration[C][A];
      }
      sum = C == 0 ? m.rate[C] * carried : sum + m.rate[C] * carried;
    });
    u[A] = sum * inverse;
  });
}

template <class F>
concept tells_source =
    requires(const F f, const node_motion<double, 2>& m, std::size_t component, const double (&u)[3]) {
      { f.template source<3>(m, component, u) } -> std::same_as<guo_source<double>>;
    };

}  // namespace detail

/// A forcing scheme.
/// Syntax: `F::carries_source`; `forcing.prepare<Axes>(motion, velocity)` fills the velocity of each component's
/// equilibrium; where it carries a source, `forcing.source<Axes>(motion, component, velocity)`, a guo_source.
/// Semantics: over a step the total momentum grows by the total force.
/// Models: velocity_shift, guo.
template <class F>
concept forcing_scheme = std::copyable<F> && requires(const F f, const node_motion<double, 2>& m, double (&u)[2][3]) {
  { F::carries_source } -> std::convertible_to<bool>;
  f.template prepare<3>(m, u);
} && (!F::carries_source || detail::tells_source<F>);

/// Each component relaxes to the common velocity plus τ F/ρ.
/// \par Accuracy  first order in the force: two components of ψ = ρ part with a c that is 0.1, 0.2 and 1.8 % below
///                1/(1 − 1/2τ) at G = 1.6, 1.8 and 2.4, τ = 1
/// \par Source    Shan & Chen, Phys. Rev. E 47, 1815 (1993)
struct velocity_shift {
  static constexpr bool carries_source = false;

  template <int Axes, class R, std::size_t Components>
  [[gnu::always_inline]] void prepare(const node_motion<R, Components>& m, R (&u)[Components][3]) const noexcept {
    R common[3];
    detail::common_velocity<Axes, false>(m, common);
    detail::repeat<static_cast<int>(Components)>([&]<int C>(detail::number<C>) TETRAPORE_INLINE {
      const R tau = R(1) / m.rate[C];
      detail::repeat<Axes>([&]<int A>(detail::number<A>)
                               TETRAPORE_INLINE { u[C][A] = common[A] + tau * m.acceleration[C][A]; });
    });
  }
};
static_assert(forcing_scheme<velocity_shift>);

/// A source in the populations, of second order in time; all components relax to one velocity, half the force included.
/// \par Accuracy  two components of ψ = ρ part with a c that is 0.9, 6.6 and 11 % above 1 at G = 2.4, 3.6 and 4, τ = 1;
///                one component with ψ = 1 − exp(−ρ) has the densities of the equal-area rule to 1e-6 at G = −4.4 and
///                τ = 1
/// \par Source    Guo, Zheng & Shi, Phys. Rev. E 65, 046308 (2002); several components: weighted by 1/τ, derived here
struct guo {
  static constexpr bool carries_source = true;

  template <int Axes, class R, std::size_t Components>
  [[gnu::always_inline]] void prepare(const node_motion<R, Components>& m, R (&u)[Components][3]) const noexcept {
    detail::common_velocity<Axes, true>(m, u[0]);
    detail::repeat<static_cast<int>(Components) - 1>([&]<int C>(detail::number<C>) TETRAPORE_INLINE {
      detail::repeat<Axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE { u[C + 1][A] = u[0][A]; });
    });
  }
  template <int Axes, class R, std::size_t Components>
  [[nodiscard, gnu::always_inline]] guo_source<R> source(const node_motion<R, Components>& m, std::size_t c,
                                                         const R (&u)[3]) const noexcept {
    guo_source<R> s;
    detail::repeat<Axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE {
      s.force[A] = m.rho[c] * m.acceleration[c][A];
      s.velocity[A] = u[A];
    });
    return s;
  }
};
static_assert(forcing_scheme<guo>);

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
