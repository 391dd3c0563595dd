// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/collision.hpp"
#include "tetrapore/lbm/forcing.hpp"
#include "tetrapore/lbm/lattice.hpp"
#include "tetrapore/lbm/pseudopotential.hpp"

#include <array>

/// \file
/// A fluid of one or more components and what a step does to one of its nodes: a pure function of values, which knows
/// of no storage, no neighbours but by their ψ, and no threads.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Shan and Chen's model of one or more components.
///
///   F_a(x) = −ψ_a(x) Σ_b G_ab Σ_i w_i ψ_b(x + c_i) c_i + ρ_a g
///
/// \par Units   lattice units: nodes and steps
/// \par Domain  τ > 1/2 of every component; G_ab = G_ba, else momentum is not kept
/// \par Source  Shan & Chen, Phys. Rev. E 47, 1815 (1993)
template <lattice Lattice, class Collision, forcing_scheme Forcing = velocity_shift,
          pseudopotential Potential = linear_potential, std::size_t Components = 2>
  requires collision<Collision, Lattice>
struct mixture {
  using lattice_type = Lattice;
  using collision_type = Collision;
  using forcing_type = Forcing;
  static constexpr int components = Components;
  static constexpr std::size_t directions = Lattice::directions;
  static_assert(Components >= 1, "a mixture has at least one component");

  std::array<Collision, Components> collisions{};
  std::array<std::array<double, Components>, Components> attraction{};  ///< G_ab: positive repels
  std::array<double, Components> reference{};                           ///< populations are kept less weight × this
  std::array<double, 3> gravity{};                                      ///< acceleration of all components
  Forcing forcing{};
  Potential potential{};

  /// The viscosity of a component. \par Units  nodes²/step
  [[nodiscard]] constexpr double viscosity(std::size_t component) const noexcept {
    return (collisions[component].tau - 0.5) / 3;
  }

  /// Density less the reference.
  template <class R>
  [[nodiscard, gnu::always_inline]] static R excess_of(const R (&f)[directions]) noexcept {
    return f[0] + detail::sum_over_pairs<Lattice, R>([](auto) { return true; },
                                                     [&]<int K>(detail::number<K>) TETRAPORE_INLINE {
                                                       constexpr int i = 2 * K + 1;
                                                       return f[i] + f[i + 1];
                                                     });
  }
  template <class R>
  [[nodiscard, gnu::always_inline]] R density_of(const R (&f)[directions], std::size_t component) const noexcept {
    return detail::constant<R>(reference[component]) + excess_of(f);
  }

  /// What streams into a node turns into what leaves it: `take(c, i)` is the population of component c that arrives in
  /// direction i, `seen(c, i)` its ψ at x + c_i, `give(c, i, f)` gets what leaves in direction i; c and i come as
  /// constants. Populations are taken twice, for their moments and to relax: all at once would
  /// not fit in the registers.
  template <class R, class Take, class Seen, class Give>
  [[gnu::always_inline]] void collide(Take take, Seen seen, Give give) const noexcept {
    node_motion<R, Components> m;
    R excess[Components];
    moments_of(take, m, excess);
    accelerate(seen, m);
    TETRAPORE_READ_AGAIN();
    R u[Components][3];
    forcing.template prepare<axes>(m, u);
    detail::repeat<count>([&]<int C>(detail::number<C> c) TETRAPORE_INLINE {
      relaxation_target<R> t;
      t.excess = excess[C];
      t.rho = m.rho[C];
      detail::repeat<axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE {
        t.momentum[A] = m.momentum[C][A];
        t.velocity[A] = u[C][A];
      });
      R f[directions];
      detail::repeat<sites>([&]<int I>(detail::number<I> i) TETRAPORE_INLINE { f[I] = take(c, i); });
      const Collision& how = collisions[static_cast<std::size_t>(C)];
      if constexpr (Forcing::carries_source) {
        how.template relax<Lattice>(f, t, forcing.template source<axes>(m, C, u[C]));
      } else {
        how.template relax<Lattice>(f, t, no_source{});
      }
      detail::repeat<sites>([&]<int I>(detail::number<I> i) TETRAPORE_INLINE { give(c, i, f[I]); });
    });
  }

  /// The same where the collision ends at the equilibrium, from the moments of what streamed in: `moment(c, 0)` is the
  /// excess of density of component c, `moment(c, 1 + axis)` its momentum.
  template <class R, class Moment, class Seen, class Give>
  [[gnu::always_inline]] void depart(Moment moment, Seen seen, Give give) const noexcept {
    node_motion<R, Components> m;
    R excess[Components];
    detail::repeat<count>([&]<int C>(detail::number<C> c) TETRAPORE_INLINE {
      excess[C] = moment(c, detail::number<0>{});
      m.rho[C] = detail::constant<R>(reference[static_cast<std::size_t>(C)]) + excess[C];
      m.rate[C] = R(1);
      detail::repeat<axes>([&]<int A>(detail::number<A>)
                               TETRAPORE_INLINE { m.momentum[C][A] = moment(c, detail::number<1 + A>{}); });
    });
    accelerate(seen, m);
    R u[Components][3];
    forcing.template prepare<axes>(m, u);
    detail::repeat<count>([&]<int C>(detail::number<C> c) TETRAPORE_INLINE {
      relaxation_target<R> t;
      t.excess = excess[C];
      t.rho = m.rho[C];
      detail::repeat<axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE { t.velocity[A] = u[C][A]; });
      detail::give_settled<Lattice>(t, t.excess, [&](auto i, const R& f) TETRAPORE_INLINE { give(c, i, f); });
    });
  }
  /// The same of a node of a reservoir: the equilibrium of given densities at the velocity of what came in.
  template <class R, class Moment, class Give>
  [[gnu::always_inline]] void depart_held(const R (&rho)[Components], Moment moment, Give give) const noexcept {
    R mass(0);
    R velocity[3]{R(0), R(0), R(0)};
    detail::repeat<count>([&]<int C>(detail::number<C> c) TETRAPORE_INLINE {
      mass = mass + (detail::constant<R>(reference[static_cast<std::size_t>(C)]) + moment(c, detail::number<0>{}));
      detail::repeat<axes>([&]<int A>(detail::number<A>)
                               TETRAPORE_INLINE { velocity[A] = velocity[A] + moment(c, detail::number<1 + A>{}); });
    });
    const R inverse = R(1) / mass;
    for (R& u : velocity) {
      u = u * inverse;
    }
    detail::repeat<count>([&]<int C>(detail::number<C> c) TETRAPORE_INLINE {
      relaxation_target<R> t;
      t.rho = rho[C];
      t.excess = rho[C] - detail::constant<R>(reference[static_cast<std::size_t>(C)]);
      for (int a = 0; a < 3; ++a) {
        t.velocity[a] = velocity[a];
      }
      R f[directions];
      fill<R>(t, f);
      detail::repeat<sites>([&]<int I>(detail::number<I> i) TETRAPORE_INLINE { give(c, i, f[I]); });
    });
  }
  /// The moments of what streams into a node, as above.
  template <class R, class Take, class Give>
  [[gnu::always_inline]] static void arrive(Take take, Give give) noexcept {
    detail::repeat<count>([&]<int C>(detail::number<C> c) TETRAPORE_INLINE {
      R f[directions];
      detail::repeat<sites>([&]<int I>(detail::number<I> i) TETRAPORE_INLINE { f[I] = take(c, i); });
      give(c, detail::number<0>{}, excess_of(f));
      detail::repeat<axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE {
        give(c, detail::number<1 + A>{}, detail::first_moment<Lattice, A>(f));
      });
    });
  }

  /// What leaves a node of a reservoir: the equilibrium of given densities at the velocity of what came in.
  template <class R>
  [[gnu::always_inline]] void hold(R (&f)[Components][directions], const R (&rho)[Components]) const noexcept {
    R carried[3];
    R mass(0);
    for (int a = 0; a < axes; ++a) {
      carried[a] = R(0);
    }
    for (std::size_t c = 0; c < Components; ++c) {
      mass = mass + density_of(f[c], c);
      detail::repeat<axes>([&]<int A>(detail::number<A>)
                               TETRAPORE_INLINE { carried[A] = carried[A] + detail::first_moment<Lattice, A>(f[c]); });
    }
    const R inverse = R(1) / mass;
    for (std::size_t c = 0; c < Components; ++c) {
      relaxation_target<R> t;
      t.rho = rho[c];
      t.excess = rho[c] - detail::constant<R>(reference[c]);
      for (int a = 0; a < axes; ++a) {
        t.velocity[a] = carried[a] * inverse;
      }
      fill<R>(t, f[c]);
    }
  }

  /// The populations of an equilibrium.
  template <class R>
  [[gnu::always_inline]] static void fill(const relaxation_target<R>& t, R (&f)[directions]) noexcept {
    const R half = detail::constant<R>(0.5);
    const R excess = detail::on_grid(t.excess * half * half);
    detail::give_settled<Lattice>(t, (excess + excess) + (excess + excess),
                                  [&]<int I>(detail::number<I>, const R& value) TETRAPORE_INLINE { f[I] = value; });
  }

  /// The velocity of the mixture at a node, half of the force included.
  template <class R, class Seen>
  void flow(const R (&f)[Components][directions], Seen seen, R (&velocity)[3]) const noexcept {
    R excess[Components];
    R momentum[Components][3];
    for (std::size_t c = 0; c < Components; ++c) {
      excess[c] = excess_of(f[c]);
      detail::repeat<axes>([&]<int A>(detail::number<A>)
                               TETRAPORE_INLINE { momentum[c][A] = detail::first_moment<Lattice, A>(f[c]); });
    }
    flow(excess, momentum, seen, velocity);
  }
  /// The same from the moments of the populations.
  template <class R, class Seen>
  void flow(const R (&excess)[Components], const R (&momentum)[Components][3], Seen seen,
            R (&velocity)[3]) const noexcept {
    node_motion<R, Components> m;
    R mass(0);
    for (std::size_t c = 0; c < Components; ++c) {
      m.rho[c] = detail::constant<R>(reference[c]) + excess[c];
      mass = mass + m.rho[c];
    }
    accelerate(seen, m);
    for (int a = 0; a < 3; ++a) {
      velocity[a] = R(0);
      for (std::size_t c = 0; c < Components && a < axes; ++c) {
        velocity[a] =
            velocity[a] + (momentum[c][a] + detail::constant<R>(0.5) * m.rho[c] * m.acceleration[c][a]) / mass;
      }
    }
  }

  /// The pressure of a node of given densities, the sum of the components': Σ ρ/3 + ½ Σ G_ab ψ_a ψ_b / 3.
  [[nodiscard]] double pressure(const std::array<double, Components>& rho) const noexcept {
    double p = 0;
    for (std::size_t a = 0; a < Components; ++a) {
      p += rho[a] / 3;
      for (std::size_t b = 0; b < Components; ++b) {
        p += attraction[a][b] * potential(rho[a]) * potential(rho[b]) / 6;
      }
    }
    return p;
  }

 private:
  static constexpr int axes = Lattice::dimensions;
  static constexpr int count = static_cast<int>(Components);
  static constexpr int sites = static_cast<int>(directions);

  template <class R, class Take>
  [[gnu::always_inline]] void moments_of(Take take, node_motion<R, Components>& m,
                                         R (&excess)[Components]) const noexcept {
    detail::repeat<count>([&]<int C>(detail::number<C> c) TETRAPORE_INLINE {
      R f[directions];
      detail::repeat<sites>([&]<int I>(detail::number<I> i) TETRAPORE_INLINE { f[I] = take(c, i); });
      excess[C] = excess_of(f);
      m.rho[C] = detail::constant<R>(reference[static_cast<std::size_t>(C)]) + excess[C];
      m.rate[C] = detail::constant<R>(collisions[static_cast<std::size_t>(C)].rate());
      detail::repeat<axes>([&]<int A>(detail::number<A>)
                               TETRAPORE_INLINE { m.momentum[C][A] = detail::first_moment<Lattice, A>(f); });
    });
  }

  template <class R, class Seen>
  [[gnu::always_inline]] void accelerate(Seen seen, node_motion<R, Components>& m) const noexcept {
    R slope[Components][3];  // Σ w ψ(x + c) c
    detail::repeat<count>([&]<int C>(detail::number<C> c) TETRAPORE_INLINE {
      R step[pairs<Lattice>];
      detail::repeat<pairs<Lattice>>([&]<int K>(detail::number<K>) TETRAPORE_INLINE {
        step[K] = seen(c, detail::number<2 * K + 1>{}) - seen(c, detail::number<2 * K + 2>{});
      });
      detail::repeat<axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE {
        slope[C][A] = detail::sum_over_pairs<Lattice, R>(
            []<int K>(detail::number<K>) TETRAPORE_INLINE { return detail::along<Lattice>(K, A) != 0; },
            [&]<int K>(detail::number<K>)
                TETRAPORE_INLINE { return detail::times_sign<detail::along<Lattice>(K, A)>(step[K]); },
            [&]<int K>(detail::number<K>, const R& group)
                TETRAPORE_INLINE { return detail::constant<R>(detail::pair_weight<K, Lattice>) * group; });
      });
    });
    detail::repeat<count>([&]<int C>(detail::number<C>) TETRAPORE_INLINE {
      const R own = -potential.per_density(m.rho[C]);
      detail::repeat<axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE {
        R pull = detail::constant<R>(attraction[static_cast<std::size_t>(C)][0]) * slope[0][A];
        detail::repeat<count - 1>([&]<int B>(detail::number<B>) TETRAPORE_INLINE {
          pull = pull + detail::constant<R>(attraction[static_cast<std::size_t>(C)][B + 1]) * slope[B + 1][A];
        });
        m.acceleration[C][A] = own * pull + detail::constant<R>(gravity[static_cast<std::size_t>(A)]);
      });
    });
  }
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
