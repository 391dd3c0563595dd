// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/forcing.hpp"
#include "tetrapore/lbm/lattice.hpp"

/// \file
/// Collisions: how the populations of one component at one node relax. Populations are kept as what they differ by from
/// weight × reference density; the rest population takes what is left, so that a collision keeps the mass of its node.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// What a component relaxes to.
template <class R>
struct relaxation_target {
  R excess;       ///< density − reference, the sum of the populations
  R rho;          ///< density
  R momentum[3];  ///< Σ f c before the collision
  R velocity[3];  ///< of the equilibrium
};

/// A collision on a lattice.
/// Syntax: `c.tau`; `c.rate()`, 1/τ of what relaxes momentum; `c.relax<L>(f, target, source)`, const and noexcept, on
/// an array of one number, or one pack, for each direction.
/// Semantics: keeps Σ f; changes Σ f c by rate × (ρ u − Σ f c) and what the source gives; shear relaxes with
/// `c.tau`, viscosity (τ − 1/2)/3.
/// Models: bgk, trt, regularised.
template <class C, class L = d3q19>
concept collision =
    lattice<L> && std::copyable<C> &&
    requires(const C c, double (&f)[L::directions], const relaxation_target<double>& t, const guo_source<double>& s) {
      { c.tau } -> std::convertible_to<double>;
      { c.rate() } noexcept -> std::same_as<double>;
      c.template relax<L>(f, t, no_source{});
      c.template relax<L>(f, t, s);
    };

namespace detail {

template <class R>
[[nodiscard, gnu::always_inline]] inline R constant(double x) noexcept {
  return R(static_cast<typename lane_of<R>::type>(x));
}

template <lattice L, int K, class R>
[[nodiscard, gnu::always_inline]] inline R along_pair(const R (&u)[3]) noexcept {
  // (± x) + (± y) + (± z) without the zeros
  R sum(0);
  bool begun = false;
  repeat<L::dimensions>([&]<int A>(detail::number<A>) TETRAPORE_INLINE {
    constexpr int c = along<L>(K, A);
    if constexpr (c != 0) {
      sum = begun ? sum + times_sign<c>(u[A]) : times_sign<c>(u[A]);
      begun = true;
    }
  });
  return sum;
}

template <lattice L, class R>
[[nodiscard, gnu::always_inline]] inline R product(const R (&a)[3], const R (&b)[3]) noexcept {
  R sum = a[0] * b[0];
  repeat<L::dimensions - 1>([&]<int K>(number<K>) TETRAPORE_INLINE { sum = sum + a[K + 1] * b[K + 1]; });
  return sum;
}

/// The even and the odd half of the equilibrium of the pairs' first directions, over the weight:
/// f_eq = weight × (even ± odd).
template <lattice L, class R>
struct equilibrium {
  R excess;
  R rho;
  R triple_rho[3];   ///< 3 ρ u
  R half_triple[3];  ///< 3/2 u
  R flat;            ///< excess − 3/2 ρ u²

  [[gnu::always_inline]] explicit equilibrium(const relaxation_target<R>& t) noexcept : excess(t.excess), rho(t.rho) {
    repeat<L::dimensions>([&]<int A>(number<A>) TETRAPORE_INLINE {
      half_triple[A] = constant<R>(1.5) * t.velocity[A];
      triple_rho[A] = constant<R>(3) * t.rho * t.velocity[A];
    });
    flat = excess - t.rho * product<L>(half_triple, t.velocity);
  }
  template <int K>
  [[gnu::always_inline]] void of_pair(R& even, R& odd) const noexcept {
    odd = along_pair<L, K>(triple_rho);
    even = flat + along_pair<L, K>(half_triple) * odd;
  }
};

/// Guo's source of a pair, even and odd, over the weight and without the factors of relaxation.
template <lattice L, int K, class R>
[[gnu::always_inline]] inline void source_of_pair(const guo_source<R>& s, const R& inner, R& even, R& odd) noexcept {
  const R cf = along_pair<L, K>(s.force);
  odd = constant<R>(3) * cf;
  even = constant<R>(9) * along_pair<L, K>(s.velocity) * cf - constant<R>(3) * inner;
}

template <int K, lattice L>
inline constexpr double pair_weight = L::weight[static_cast<std::size_t>(2 * K + 1)];

/// Rounded to a multiple of half the rounding unit of 1. Sums of such numbers are exact while they stay below 1.
template <class R>
[[nodiscard, gnu::always_inline]] inline R on_grid(const R& x) noexcept {
  const R anchor = constant<R>(0.75);  // |x| < 1/4
  return (x + anchor) - anchor;
}

/// Rounds what leaves a node to the grid and gives the rest population what is left of the sum. With a density within 1
/// of its reference no mass is lost to rounding, in float neither: a rounding error at rest would repeat itself.
template <lattice L, class R>
[[gnu::always_inline]] inline void settle(R (&f)[L::directions], const R& excess) noexcept {
  repeat<2 * pairs<L>>([&]<int I>(number<I>) TETRAPORE_INLINE { f[I + 1] = on_grid(f[I + 1]); });
  f[0] = excess - sum_over_pairs<L, R>([]<int K>(number<K>) TETRAPORE_INLINE { return true; },
                                       [&]<int K>(number<K>) TETRAPORE_INLINE {
                                         constexpr int i = 2 * K + 1;
                                         return f[i] + f[i + 1];
                                       });
}

/// `give(i, f)` gets the populations of an equilibrium, settled: each half of a pair is rounded, their sums and
/// differences are exact.
template <lattice L, class R, class Give>
[[gnu::always_inline]] inline void give_settled(const relaxation_target<R>& t, const R& excess, Give give) noexcept {
  const equilibrium<L, R> eq(t);
  const R sum = sum_over_pairs<L, R>([]<int K>(number<K>) TETRAPORE_INLINE { return true; },
                                     [&]<int K>(number<K>) TETRAPORE_INLINE {
                                       const R w = constant<R>(pair_weight<K, L>);
                                       R even;
                                       R odd;
                                       eq.template of_pair<K>(even, odd);
                                       even = on_grid(w * even);
                                       odd = on_grid(w * odd);
                                       give(number<2 * K + 1>{}, even + odd);
                                       give(number<2 * K + 2>{}, even - odd);
                                       return even;
                                     });
  give(number<0>{}, excess - (sum + sum));
}

/// Both halves of each pair by a rate of their own.
template <lattice L, class R, class Source>
[[gnu::always_inline]] inline void relax_halves(R (&f)[L::directions], const relaxation_target<R>& t, const Source& s,
                                                double even_rate, double odd_rate) noexcept {
  const equilibrium<L, R> eq(t);
  const R half_even = constant<R>(0.5 * even_rate);
  const R half_odd = constant<R>(0.5 * odd_rate);
  R inner(0);
  if constexpr (!std::same_as<Source, no_source>) {
    inner = product<L>(s.velocity, s.force);
  }
  repeat<pairs<L>>([&]<int K>(detail::number<K>) TETRAPORE_INLINE {
    constexpr int i = 2 * K + 1;
    const R w = constant<R>(pair_weight<K, L>);
    R even;
    R odd;
    eq.template of_pair<K>(even, odd);
    R up = half_even * (w * (even + even) - (f[i] + f[i + 1]));
    R across = half_odd * (w * (odd + odd) - (f[i] - f[i + 1]));
    if constexpr (!std::same_as<Source, no_source>) {
      source_of_pair<L, K>(s, inner, even, odd);
      up = up + constant<R>(1 - 0.5 * even_rate) * (w * even);
      across = across + constant<R>(1 - 0.5 * odd_rate) * (w * odd);
    }
    f[i] = f[i] + (up + across);
    f[i + 1] = f[i + 1] + (up - across);
  });
  settle<L>(f, t.excess);
}

}  // namespace detail

/// Bhatnagar, Gross and Krook: one relaxation time.
/// \par Domain    τ > 1/2
/// \par Accuracy  second order between plates: where a wall by bounce-back lies follows the viscosity
/// \par Source    Qian, d'Humières & Lallemand, Europhys. Lett. 17, 479 (1992)
struct bgk {
  static constexpr bool equilibrium_at_one = true;  ///< with tau = 1 nothing is left but the equilibrium
  double tau = 1;

  [[nodiscard]] double rate() const noexcept { return 1 / tau; }

  template <lattice L, class R, class Source>
  [[gnu::always_inline]] void relax(R (&f)[L::directions], const relaxation_target<R>& t,
                                    const Source& s) const noexcept {
    const detail::equilibrium<L, R> eq(t);
    const R keep = detail::constant<R>(1 - 1 / tau);
    const R give = detail::constant<R>(1 / tau);
    R inner(0);
    if constexpr (!std::same_as<Source, no_source>) {
      inner = detail::product<L>(s.velocity, s.force);
    }
    detail::repeat<pairs<L>>([&]<int K>(detail::number<K>) TETRAPORE_INLINE {
      constexpr int i = 2 * K + 1;
      const R w = give * detail::constant<R>(detail::pair_weight<K, L>);
      R even;
      R odd;
      eq.template of_pair<K>(even, odd);
      if constexpr (!std::same_as<Source, no_source>) {
        R more_even;
        R more_odd;
        detail::source_of_pair<L, K>(s, inner, more_even, more_odd);
        const R share = detail::constant<R>(tau - 0.5);
        even = even + share * more_even;
        odd = odd + share * more_odd;
      }
      f[i] = keep * f[i] + w * (even + odd);
      f[i + 1] = keep * f[i + 1] + w * (even - odd);
    });
    detail::settle<L>(f, t.excess);
  }
};
static_assert(collision<bgk>);

/// Two relaxation times: τ for what is even in the velocities, and by Λ = (τ − ½)(τ⁻ − ½) another for what is odd. A
/// wall by bounce-back lies half-way between nodes, whatever the viscosity, at Λ = 3/16.
/// \par Domain    τ > 1/2, Λ > 0
/// \par Accuracy  the parabola between plates to 1e-10 at Λ = 3/16
/// \par Source    Ginzburg, Verhaeghe & d'Humières, Commun. Comput. Phys. 3, 427 (2008)
struct trt {
  double tau = 1;
  double magic = 3.0 / 16;

  [[nodiscard]] double rate() const noexcept { return 1 / (0.5 + magic / (tau - 0.5)); }

  template <lattice L, class R, class Source>
  [[gnu::always_inline]] void relax(R (&f)[L::directions], const relaxation_target<R>& t,
                                    const Source& s) const noexcept {
    detail::relax_halves<L>(f, t, s, 1 / tau, rate());
  }
};
static_assert(collision<trt>);

/// One relaxation time, of density, momentum and stress alone: what else the populations hold is dropped.
/// \par Domain    τ > 1/2
/// \par Accuracy  between plates as bgk
/// \par Source    Latt & Chopard, Math. Comput. Simul. 72, 165 (2006)
struct regularised {
  static constexpr bool equilibrium_at_one = true;  ///< with tau = 1 nothing is left but the equilibrium
  double tau = 1;

  [[nodiscard]] double rate() const noexcept { return 1 / tau; }

  template <lattice L, class R, class Source>
  [[gnu::always_inline]] void relax(R (&f)[L::directions], const relaxation_target<R>& t,
                                    const Source& s) const noexcept {
    using detail::along;
    constexpr int axes = L::dimensions;
    const detail::equilibrium<L, R> eq(t);
    R inner(0);
    if constexpr (!std::same_as<Source, no_source>) {
      inner = detail::product<L>(s.velocity, s.force);
    }
    R surplus[pairs<L>];  // what each pair holds beyond its equilibrium; with a source half of that is no stress
    detail::repeat<pairs<L>>([&]<int K>(detail::number<K>) TETRAPORE_INLINE {
      constexpr int i = 2 * K + 1;
      const R w = detail::constant<R>(detail::pair_weight<K, L>);
      R even;
      R odd;
      eq.template of_pair<K>(even, odd);
      surplus[K] = (f[i] + f[i + 1]) - w * (even + even);
      if constexpr (!std::same_as<Source, no_source>) {
        detail::source_of_pair<L, K>(s, inner, even, odd);
        surplus[K] = surplus[K] + w * even;
      }
    });
    R stress[3][3];
    detail::repeat<axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE {
      detail::repeat<axes>([&]<int B>(detail::number<B>) TETRAPORE_INLINE {
        if constexpr (A <= B) {
          stress[A][B] = detail::sum_over_pairs<L, R>(
              []<int K>(detail::number<K>) TETRAPORE_INLINE { return along<L>(K, A) * along<L>(K, B) != 0; },
              [&]<int K>(detail::number<K>)
                  TETRAPORE_INLINE { return detail::times_sign<along<L>(K, A) * along<L>(K, B)>(surplus[K]); });
        }
      });
    });
    R trace = stress[0][0];
    for (int a = 1; a < axes; ++a) {
      trace = trace + stress[a][a];
    }
    const R keep = detail::constant<R>(1 - 1 / tau);
    R carried[3];  // 3 × the momentum after the collision, the source left aside
    for (int a = 0; a < axes; ++a) {
      const R target = t.rho * t.velocity[a];
      R now = t.momentum[a];
      if constexpr (!std::same_as<Source, no_source>) {
        now = now + detail::constant<R>(0.5) * s.force[a];
      }
      carried[a] = detail::constant<R>(3) * (target + keep * (now - target));
    }
    detail::repeat<pairs<L>>([&]<int K>(detail::number<K>) TETRAPORE_INLINE {
      constexpr int i = 2 * K + 1;
      const R w = detail::constant<R>(detail::pair_weight<K, L>);
      R even;
      R odd;
      eq.template of_pair<K>(even, odd);
      R pull = detail::constant<R>(-1.0 / 3) * trace;
      detail::repeat<axes>([&]<int A>(detail::number<A>) TETRAPORE_INLINE {
        detail::repeat<axes>([&]<int B>(detail::number<B>) TETRAPORE_INLINE {
          constexpr int both = along<L>(K, A) * along<L>(K, B);
          if constexpr (A <= B && both != 0) {
            const R part = detail::times_sign<both>(stress[A][B]);
            pull = pull + (A == B ? part : part + part);
          }
        });
      });
      even = even + keep * detail::constant<R>(4.5) * pull;
      odd = detail::along_pair<L, K>(carried);
      if constexpr (!std::same_as<Source, no_source>) {
        R more_even;
        R more_odd;
        detail::source_of_pair<L, K>(s, inner, more_even, more_odd);
        const R half = detail::constant<R>(0.5);
        even = even + half * more_even;
        odd = odd + half * more_odd;
      }
      f[i] = w * (even + odd);
      f[i + 1] = w * (even - odd);
    });
    detail::settle<L>(f, t.excess);
  }
};
static_assert(collision<regularised>);

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
