// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/bridge/liquid.hpp"
#include "tetrapore/law/bridge/march.hpp"
#include "tetrapore/law/bridge/memory.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// The bridge between two wetted surfaces that solves the equation of Young and Laplace without gravity: two spheres of
/// any radii, or a sphere and a plane, apart, in contact or overlapping, of a given volume or at a given suction.
/// Of all profiles the stable one that comes, as the gap widens, from the bridge at contact; of so much liquid that it
/// would close over a grain there, from the one that neither pulls nor pushes. `Nodes` is half the order of the
/// quadrature; next to a fold twice as many are used.
///
/// Beyond the fold: `ruptured`. An equal pair (radii and angles) whose liquid slides to one side before: `lopsided`, at
/// any gap from there on. Too little suction (over a plane at θ = 0 any of 0 and less), or a pair too near for so much
/// liquid: `flooded`. How the gap or the value came to be does not matter; a warm state changes the time, never the
/// bridge. Where the surfaces overlap, the volume is that of the profile less both caps, so that their common lens
/// counts twice, and the force is that of the whole neck, so that the suction counts on the solid disc too: for grains
/// that are pressed together take held_at_contact (closed_form.hpp).
/// \par Units   surface tension [N/m], angles [rad], else SI
/// \par Domain  0 ≤ θ < 90° on either surface (angle k on the surface of radius k); gap > −R; any volume or suction.
///              float, double, long double; float computes in double
/// \par Accuracy  of the force, κ being what a rounding of gap and value does to it: max(1e-12, 16 κ) on the 402 stable
///                rows of open_bridge.csv (worst 0.44 of that) and on random bridges against 24 nodes (worst 0.31),
///                unless the force nearly vanishes: then 1e-14 of 2πσ × radius of the contact circle. Stiffness 1e-10
///                and 1.8e-15 over the distance to the fold (worst 0.2 of that). Folds 6e-15 and lost symmetry 4e-14 on
///                the tables, both 2e-13 anywhere; 1e-10 of the gap within its limit the bridge is there, as much
///                beyond it is gone, on 60,000 random equal pairs and 16,000 others, at a volume and at a suction.
///                Maxwell's relation 4e-13, force at both ends 1.4e-13 of its parts, work against energy 4e-14.
///                Stability agrees with finite elements on 2,000 bridges. long double with 20 nodes 1e-17 and 32 κ;
///                float 6e-8. On 10⁵ random pairs (radii 1e-4 to a plane, angles to 89.9°) every request at a volume
///                was answered, and all but 1 in 10⁴ at a suction, those at which two curves of bridges all but cross
///                near a cylinder (`not_converged`). Rupture gaps of volumes up to 1e4 R³: 4 of 20,000 not found
///                (`not_converged`, all above 6,000 R³). Much liquid, 0.3 to 150 R³ or k down to −1.5 / R: worst 0.61
///                of that against 40 nodes in long double on 6,200 random bridges, none with another status; up to 1e-6
///                of the volume at which liquid closes over the grains worst 0.82 of 1e-12 and 16 κ, κ of a rounding of
///                that whole ball. A bridge that is gone is told by a bound (march.hpp: out_of_reach) in 0.06 µs at a
///                volume and 0.1 to 0.2 µs at a suction, unless the gap is within some 4 to 50 % of the widest: then by
///                a march, 15 to 40 µs. On 10⁶ random time steps warm and cold solve never differed in status, in force
///                by 0.68 of twice the above; work around closed cycles vanished to 1e-13
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.3, Eq. (4); profiles of Delaunay (profile.hpp);
///              stability by Jacobi's field, derived here (solve_profile.hpp)
template <int Nodes = 10>
struct young_laplace {
  static_assert(Nodes >= 4);
  required<double> surface_tension;
  double contact_angle1 = 0;
  double contact_angle2 = 0;

  /// Relative error of force, areas, and the one of volume and suction that is not given, in double with 10 nodes or
  /// more, per unit of max(1, 16 κ / 1e-12), over the stable rows of open_bridge.csv.
  static constexpr double stated_accuracy = 5.5e-13;
  /// Relative error of the rupture gap: at a fold, and where an equal pair turns lopsided, over rupture_open.csv and
  /// rupture_asym_open.csv.
  static constexpr double stated_fold_accuracy = 1.2e-14;
  static constexpr double stated_lopsided_accuracy = 6e-14;

  /// What a pair remembers from its last step. A new one starts cold; so does one whose pair or law has changed.
  template <real T>
  struct warm_state {
    detail::bridge_memory<T, std::conditional_t<std::is_same_v<T, float>, double, T>> last{};
  };

  template <std::floating_point T>
  [[nodiscard]] outcome<meniscus<T>, bridge_status> bridge(const edge<T>& e, const given_volume<T>& v) const noexcept {
    warm_state<T> none;
    return solve<T, false>(e, v.value, bridge_control::volume, none);
  }
  template <std::floating_point T>
  [[nodiscard]] outcome<meniscus<T>, bridge_status> bridge(const edge<T>& e, const given_suction<T>& p) const noexcept {
    warm_state<T> none;
    return solve<T, false>(e, p.value, bridge_control::suction, none);
  }
  template <std::floating_point T>
  [[nodiscard]] outcome<meniscus<T>, bridge_status> bridge(const edge<T>& e, const given_volume<T>& v,
                                                           warm_state<T>& w) const noexcept {
    return solve<T, true>(e, v.value, bridge_control::volume, w);
  }
  template <std::floating_point T>
  [[nodiscard]] outcome<meniscus<T>, bridge_status> bridge(const edge<T>& e, const given_suction<T>& p,
                                                           warm_state<T>& w) const noexcept {
    return solve<T, true>(e, p.value, bridge_control::suction, w);
  }

  /// Areas of a bridge of this law on this edge. Here and below the bridge must be there, its answer ok: a contract
  /// (core/contracts.hpp); unchecked, areas, energy and stiffness of none are NaN. \par Units  [m²]
  template <std::floating_point T>
  [[nodiscard]] bridge_areas<T> areas(const edge<T>& e, const meniscus<T>& m) const noexcept;

  /// Free energy of a bridge, σ (A_liquid_gas − Σ cos θ A_wetted). By dE = F dgap − p_c dV its slope along the gap is
  /// the force. \par Units  [J]
  template <std::floating_point T>
  [[nodiscard]] T energy(const edge<T>& e, const meniscus<T>& m) const noexcept {
    using std::cos;
    const bridge_areas<T> a = areas(e, m);
    return T(surface_tension.get()) *
           (a.liquid_gas - T(cos(contact_angle1)) * a.wetted1 - T(cos(contact_angle2)) * a.wetted2);
  }

  /// Derivatives of a bridge of this law on this edge.
  template <std::floating_point T>
  [[nodiscard]] bridge_stiffness<T> stiffness(const edge<T>& e, const meniscus<T>& m) const noexcept;

  /// The liquid on either side of the neck, which each surface keeps when the bridge ruptures; halves where there is
  /// none. Where the angles differ much, two such drops may have more energy than the last bridge: then the liquid
  /// stays on the surface that it wets more. \par Units  [m³]
  template <std::floating_point T>
  [[nodiscard]] std::array<T, 2> halves(const edge<T>& e, const meniscus<T>& m) const noexcept;

  /// Whether a bridge of this law on this edge is stable against axisymmetric disturbances.
  template <std::floating_point T>
  [[nodiscard]] bool stable(const edge<T>& e, const meniscus<T>& m, bridge_control control) const noexcept;

  /// The widest gap that a bridge of this volume spans; the gap of the edge does not matter.
  template <std::floating_point T>
  [[nodiscard]] outcome<bridge_limit<T>, bridge_status> rupture_gap(const edge<T>& e,
                                                                    const given_volume<T>& v) const noexcept {
    return widest(e, v.value, bridge_control::volume);
  }
  /// The widest gap that a bridge at this suction spans; the gap of the edge does not matter.
  template <std::floating_point T>
  [[nodiscard]] outcome<bridge_limit<T>, bridge_status> rupture_gap(const edge<T>& e,
                                                                    const given_suction<T>& p) const noexcept {
    return widest(e, p.value, bridge_control::suction);
  }

  /// The highest suction at which a bridge spans the gap of the edge: below it there is one, above it none. Infinite
  /// where the surfaces touch or overlap; absent where the gap is too wide for any positive suction (on a plane at
  /// θ = 0, where it falls off exponentially: for any that a number holds). \par Units [Pa]
  template <std::floating_point T>
  [[nodiscard]] outcome<T, bridge_status> highest_suction(const edge<T>& e) const noexcept {
    if (!in_domain(e)) {
      return {T(quiet_nan<T>), bridge_status::invalid_input};
    }
    if (!(e.gap > T(0))) {
      return {T(infinity<T>), bridge_status::ok};
    }
    const auto pair = pair_of(e);
    return pair.equal ? driest<T, true>(pair, e.gap) : driest<T, false>(pair, e.gap);
  }

 private:
  template <class T>
  using work = std::conditional_t<std::is_same_v<T, float>, double, T>;

  template <class T>
  [[nodiscard]] bool in_domain(const edge<T>& e) const noexcept {
    using std::isfinite;
    const double right = pi<double> / 2;
    const bool angles = contact_angle1 >= 0 && contact_angle1 < right && contact_angle2 >= 0 && contact_angle2 < right;
    const bool radii = e.radius1 > T(0) && e.radius2 > T(0) && (isfinite(e.radius1) || isfinite(e.radius2));
    return surface_tension.get() > 0 && surface_tension.get() < infinity<double> && angles && radii &&
           isfinite(e.gap) && e.gap > -detail::smaller(e.radius1, e.radius2);
  }

  template <class T, class W = work<T>>
  [[nodiscard]] detail::surface_pair<W> pair_of(const edge<T>& e) const noexcept {
    using std::cos;
    using std::sin;
    const W one = static_cast<W>(contact_angle1);
    const W two = static_cast<W>(contact_angle2);
    detail::surface_pair<W> pair;
    pair.side[0] = {W(1) / static_cast<W>(e.radius1), cos(one), sin(one)};
    pair.equal = e.radius1 == e.radius2 && contact_angle1 == contact_angle2;
    if (pair.equal) {
      pair.side[1] = pair.side[0];
    } else {
      pair.side[1] = {W(1) / static_cast<W>(e.radius2), cos(two), sin(two)};
    }
    return pair;
  }

  template <class T>
  [[nodiscard]] static outcome<meniscus<T>, bridge_status> without(bridge_status s) noexcept {
    const T x = verdict_of(s) == verdict::absent ? T(0) : T(quiet_nan<T>);
    return {{x, x, x, x, x, x, x, x, x, x, x, x, false}, s};
  }

  template <class T, class W = work<T>>
  [[nodiscard]] meniscus<T> meniscus_of(const detail::surface_pair<W>& pair, const detail::profile<W>& u,
                                        const W& lambda, const W& volume) const noexcept {
    using std::atan;
    const W sigma = static_cast<W>(surface_tension.get());
    const detail::contact_circle<W> first(pair.side[0], u.w[0]);
    const detail::contact_circle<W> second(pair.side[1], u.w[1]);
    const W fill1 = W(2) * atan(W(0.5) * pair.side[0].curvature * u.w[0]);
    W neck = detail::smaller(first.radius, second.radius);
    const bool by_length = u.by == detail::chart::from_contact;
    if (!by_length && first.cosine > W(0) && second.cosine > W(0)) {
      neck = u.extent;
    } else if (by_length && first.cosine > W(0) && second.cosine > W(0)) {
      using std::sqrt;
      const W re = W(1) + W(2) * u.k * first.radius * first.sine;
      const W im = W(2) * u.k * first.radius * first.cosine;
      neck = (sqrt(re * re + im * im) - W(1)) / (W(2) * u.k);
    }
    meniscus<T> m;
    m.force = static_cast<T>(W(2) * pi<W> * sigma * lambda);
    m.volume = static_cast<T>(volume);
    m.suction = static_cast<T>(W(2) * sigma * u.k);
    m.neck = static_cast<T>(neck);
    m.filling1 = static_cast<T>(fill1);
    m.filling2 = pair.equal ? m.filling1 : static_cast<T>(W(2) * atan(W(0.5) * pair.side[1].curvature * u.w[1]));
    m.contact1 = static_cast<T>(first.radius);
    m.contact2 = static_cast<T>(second.radius);
    m.curvature = static_cast<T>(u.k);
    m.extent = static_cast<T>(u.extent);
    m.circle1 = static_cast<T>(u.w[0]);
    m.circle2 = static_cast<T>(u.w[1]);
    m.by_length = by_length;
    return m;
  }

  template <class T, class W = work<T>>
  [[nodiscard]] static detail::profile<W> profile_in(const meniscus<T>& m) noexcept {
    TETRAPORE_EXPECTS(m.extent > T(0), "an absent or refused bridge has no profile");
    return {static_cast<W>(m.curvature),
            static_cast<W>(m.extent),
            {static_cast<W>(m.circle1), static_cast<W>(m.circle2)},
            m.by_length ? detail::chart::from_contact : detail::chart::from_extremum};
  }

  template <class T, bool Warm>
  [[nodiscard]] outcome<meniscus<T>, bridge_status> solve(const edge<T>& e, const T& value, bridge_control by,
                                                          warm_state<T>& w) const noexcept {
    using wide = work<T>;
    using std::isfinite;
    const bool known = Warm && w.last.knows(e, surface_tension.get(), contact_angle1, contact_angle2, by);
    if ((!known && !in_domain(e)) || !isfinite(value) || !isfinite(e.gap) ||
        !(e.gap > -detail::smaller(e.radius1, e.radius2)) || (by == bridge_control::volume && value < T(0))) {
      return without<T>(bridge_status::invalid_input);
    }
    if (by == bridge_control::volume && value == T(0)) {
      return without<T>(bridge_status::no_liquid);
    }
    const wide asked =
        by == bridge_control::volume ? static_cast<wide>(value) : half_mean_curvature(static_cast<wide>(value));
    const detail::demand<wide> d{static_cast<wide>(e.gap), asked, by};
    if (known) {
      const detail::surface_pair<wide>& pair = w.last.pair;
      return pair.equal ? solve_pair<T, Warm, true>(e, pair, d, true, w)
                        : solve_pair<T, Warm, false>(e, pair, d, true, w);
    }
    const auto pair = pair_of(e);
    return pair.equal ? solve_pair<T, Warm, true>(e, pair, d, false, w)
                      : solve_pair<T, Warm, false>(e, pair, d, false, w);
  }

  template <class W>
  [[nodiscard]] W half_mean_curvature(const W& suction) const noexcept {
    return suction / (W(2) * static_cast<W>(surface_tension.get()));
  }

  [[nodiscard]] static bool holds(const detail::stability_index& i, bridge_control by) noexcept {
    return (by == bridge_control::volume ? i.at_volume : i.at_suction) == 0;
  }

  /// How a bridge that is out of reach ended where that is known without a march, else ok. At k > 0 the circles of an
  /// equal pair never slide; of a volume they do above 31.2°, and above 5 R³ at any angle, but not below 25.8° up to
  /// 0.3 R³.
  template <bool Equal, class W>
  [[nodiscard]] static bridge_status end_of(const detail::surface_pair<W>& pair, const detail::demand<W>& d) noexcept {
    const W c = pair.side[0].curvature;
    const W v = d.value * c * c * c;
    const W sine = pair.side[0].sine;
    if (!Equal || d.by == bridge_control::suction || (sine < W(0.42) && v < W(0.3))) {
      return bridge_status::ruptured;
    }
    return sine > W(0.53) || v > W(8) ? bridge_status::lopsided : bridge_status::ok;
  }

  /// Whether no bridge at this k ends on both surfaces: on a plane at θ = 0 it has λ = kw², so that the slope of the
  /// profile, cos φ = k (w² − r²) / r, leads from the circle into the liquid's side only where k > 0.
  template <class W>
  [[nodiscard]] static bool floods(const detail::surface_pair<W>& pair, const detail::demand<W>& d) noexcept {
    const auto flat = [](const detail::wetted_surface<W>& on) { return !(on.curvature > W(0)) && !(on.sine > W(0)); };
    return d.by == bridge_control::suction && !(d.value > W(0)) && (flat(pair.side[0]) || flat(pair.side[1]));
  }

  /// How many nodes the last digits need: near a fold the error of the quadrature is amplified.
  static constexpr int fine = 2 * Nodes;
  static constexpr int rough = 6;  ///< enough to tell that a gap is a per cent beyond the fold

  template <class T, bool Warm, bool Equal, class W = work<T>>
  [[nodiscard]] outcome<meniscus<T>, bridge_status> solve_pair(const edge<T>& e, const detail::surface_pair<W>& pair,
                                                               const detail::demand<W>& d, bool known,
                                                               warm_state<T>& w) const noexcept {
    detail::found<W> f;
    f.converged = false;
    if constexpr (Warm) {
      if (known) {
        f = from_memory<T, Equal>(d, w);
      }
    }
    const bool continued = f.converged;
    const bool gone = !continued && detail::out_of_reach(pair, d);
    if (!f.converged && !gone) {
      f = detail::approach<Nodes, Equal>(pair, d);
      if (f.converged) {
        refine<Equal>(pair, d, f);
      }
    }
    if (!f.converged) {
      bridge_status why = gone ? end_of<Equal>(pair, d) : bridge_status::ok;
      why = why == bridge_status::ok ? travel_to<Equal>(pair, d, f) : why;
      if (why != bridge_status::ok) {
        if constexpr (Warm) {
          w.last.warm = false;
        }
        return without<T>(why);
      }
    }
    const auto answer = meniscus_of<T>(pair, f.u, f.lambda, d.by == bridge_control::volume ? d.value : f.volume);
    if constexpr (Warm) {
      if (!known) {
        w.last.meet(e, surface_tension.get(), contact_angle1, contact_angle2, pair);
      }
      w.last.remember(d, f, continued);
    }
    return {answer, bridge_status::ok};
  }

  /// The last digits near a fold, where errors of the quadrature reach the force enlarged.
  template <bool Equal, class W>
  static void refine(const detail::surface_pair<W>& pair, const detail::demand<W>& d, detail::found<W>& f) noexcept {
    if (sensitive<Equal>(f)) {
      f = detail::newton<fine, Equal>(pair, d, f.u, 8);
      f.converged = f.converged && holds(detail::index_of<Equal>(pair, f, d.by), d.by);
    }
  }

  /// The bridge by way of its whole curve from the bridge at contact, or why there is none.
  template <bool Equal, class W>
  [[nodiscard]] static bridge_status travel_to(const detail::surface_pair<W>& pair, const detail::demand<W>& d,
                                               detail::found<W>& f) noexcept {
    if (floods(pair, d)) {
      return bridge_status::flooded;
    }
    auto trip = detail::travel<rough, Equal>(pair, d, d.gap);
    if (trip.how == detail::arrival::at_target) {
      f = detail::newton<fine, Equal>(pair, d, trip.end.u);
      if (f.converged && holds(detail::index_of<Equal>(pair, f, d.by), d.by)) {
        return bridge_status::ok;
      }
    }
    const bool far = (trip.how == detail::arrival::at_fold || trip.how == detail::arrival::at_slide) &&
                     std::abs(d.gap - trip.end.reach) > W(0.01) * std::abs(d.gap);
    if (!far) {
      trip = detail::travel<fine, Equal>(pair, d, d.gap);
    }
    switch (trip.how) {
      case detail::arrival::at_fold: return d.gap < W(0) ? bridge_status::flooded : bridge_status::ruptured;
      case detail::arrival::at_slide: return bridge_status::lopsided;
      case detail::arrival::at_limit: return bridge_status::flooded;
      case detail::arrival::lost: return bridge_status::not_converged;
      case detail::arrival::at_target: break;
    }
    f = detail::newton<fine, Equal>(pair, d, trip.end.u);
    if (!f.converged) {
      return bridge_status::not_converged;
    }
    const auto index = detail::index_of<Equal>(pair, f, d.by);
    if (!holds(index, d.by)) {
      return index.slides ? bridge_status::lopsided : bridge_status::ruptured;
    }
    return bridge_status::ok;
  }

  /// Whether errors of the quadrature reach the force enlarged.
  template <bool Equal, class W>
  [[nodiscard]] static bool sensitive(const detail::found<W>& f) noexcept {
    W lambda_gap(0);
    for (int i = 0; i < detail::unknowns<Equal>; ++i) {
      lambda_gap += f.at.lambda_by[i] * f.by_gap[i];
    }
    // the two sides of a virtual neck cancel
    const bool beside =
        f.u.by == detail::chart::from_extremum && f.u.k < W(0) && (f.at.cosine[0] < W(0)) != (f.at.cosine[1] < W(0));
    // a circle far from the neck and near a bulge
    const W w = f.u.w[0] < f.u.w[1] ? f.u.w[1] : f.u.w[0];
    const bool far = f.u.by == detail::chart::from_extremum && f.u.k * w < W(-0.45) && w > W(4.5) * f.u.extent;
    return beside || far || std::abs(lambda_gap) * std::abs(f.at.gap) > W(6) * std::abs(f.at.lambda);
  }

  template <class T, bool Equal, class W = work<T>>
  [[nodiscard]] static detail::found<W> from_memory(const detail::demand<W>& d, const warm_state<T>& w) noexcept {
    detail::found<W> f;
    f.converged = false;
    detail::profile<W> u;
    if (!w.last.predict(d, u)) {
      return f;
    }
    f = detail::newton<Nodes, Equal>(w.last.pair, d, u, 6);
    f.converged = f.converged && holds(detail::index_of<Equal>(w.last.pair, f, d.by), d.by);
    if (f.converged) {
      refine<Equal>(w.last.pair, d, f);
    }
    return f;
  }

  template <class T>
  [[nodiscard]] outcome<bridge_limit<T>, bridge_status> widest(const edge<T>& e, const T& value,
                                                               bridge_control by) const noexcept {
    using wide = work<T>;
    using std::isfinite;
    const T nan = quiet_nan<T>;
    edge<T> touching = e;
    touching.gap = T(0);
    if (!in_domain(touching) || !isfinite(value) || (by == bridge_control::volume && value < T(0))) {
      return {{nan, bridge_end::fold, without<T>(bridge_status::invalid_input).value}, bridge_status::invalid_input};
    }
    if (by == bridge_control::volume && value == T(0)) {
      return {{T(0), bridge_end::fold, without<T>(bridge_status::no_liquid).value}, bridge_status::no_liquid};
    }
    const auto pair = pair_of(e);
    const wide asked =
        by == bridge_control::volume ? static_cast<wide>(value) : half_mean_curvature(static_cast<wide>(value));
    const detail::demand<wide> d{wide(0), asked, by};
    return pair.equal ? widest_of<T, true>(pair, d) : widest_of<T, false>(pair, d);
  }

  template <class T, bool Equal, class W = work<T>>
  [[nodiscard]] outcome<bridge_limit<T>, bridge_status> widest_of(const detail::surface_pair<W>& pair,
                                                                  const detail::demand<W>& d) const noexcept {
    const auto trip = floods(pair, d) ? detail::journey<W>{{}, detail::arrival::at_limit}
                                      : detail::travel<fine, Equal>(pair, d, infinity<W>);
    if (trip.how == detail::arrival::at_fold || trip.how == detail::arrival::at_slide) {
      const W scale = trip.end.at.scale;
      const W volume = d.by == bridge_control::volume ? d.value : trip.end.at.volume * scale * scale * scale;
      return {{static_cast<T>(trip.end.reach),
               trip.how == detail::arrival::at_fold ? bridge_end::fold : bridge_end::lopsided,
               meniscus_of<T>(pair, trip.end.u, trip.end.at.lambda * scale, volume)},
              bridge_status::ok};
    }
    const auto why = trip.how == detail::arrival::at_limit ? bridge_status::flooded : bridge_status::not_converged;
    return {{T(quiet_nan<T>), bridge_end::fold, without<T>(why).value}, why};
  }

  /// The fold under suction is where the suction is highest along the bridges of the gap, told apart by their volume;
  /// all of these are stable at constant volume down to smaller ones.
  template <class T, bool Equal, class W = work<T>>
  [[nodiscard]] outcome<T, bridge_status> driest(const detail::surface_pair<W>& pair, const T& gap) const noexcept {
    using std::cbrt;
    using std::isfinite;
    using std::sqrt;
    constexpr int cap = 100;
    detail::demand<W> d{static_cast<W>(gap), W(0), bridge_control::volume};
    detail::found<W> f;
    f.converged = false;
    const auto solved_at = [&](const W& volume) {
      d.value = volume;
      const detail::profile<W> near = f.u;
      const bool known = f.converged;
      f = known ? detail::newton<Nodes, Equal>(pair, d, near, 12) : detail::approach<Nodes, Equal>(pair, d);
      if (known && !(f.converged && holds(detail::index_of<Equal>(pair, f, d.by), d.by))) {
        f = detail::approach<Nodes, Equal>(pair, d);
      }
      return f.converged;
    };
    const auto slope = [&] {  // dk/d ln V
      const W inverse = W(1) / f.at.scale;
      return f.by_value[0] * d.value * inverse * inverse * inverse * inverse;
    };
    // about the volume of the fold, between paraboloids as the power 7/3 of the gap
    const W radius = W(2) / (pair.side[0].curvature + pair.side[1].curvature);
    W low = W(2) * d.gap * d.gap * cbrt(d.gap * radius * radius);
    int calls = 0;
    while (!solved_at(low) && calls < cap) {
      low *= W(2);
      ++calls;
    }
    const auto slope_at = [&](const W& volume) { return solved_at(volume) ? slope() : infinity<W>; };
    W at_low = f.converged ? slope() : infinity<W>;
    W high = low;
    W at_high = at_low;
    while (f.converged && at_high > W(0) && calls < cap) {
      low = high;
      at_low = at_high;
      high *= W(2);
      at_high = slope_at(high);
      ++calls;
    }
    while (at_high < W(0) && !(at_low > W(0)) && calls < cap) {
      low *= W(0.5);
      at_low = slope_at(low);
      ++calls;
    }
    for (; at_high < W(0) && high - low > W(1e-6) * high && calls < cap; ++calls) {
      const bool bisect = !isfinite(at_low) || calls % 3 == 2;
      const W middle = bisect ? sqrt(low * high) : low + (high - low) * at_low / (at_low - at_high);
      const W now = slope_at(middle);
      (now > W(0) ? low : high) = middle;
      (now > W(0) ? at_low : at_high) = now;
    }
    // where the fold was missed for want of bridges beside it the slope is none of a summit
    if (at_low > W(0) && isfinite(at_low) && !(at_high > W(0)) && calls < cap && solved_at(high) && f.u.k > W(0) &&
        std::abs(slope()) < W(1e-3) * f.u.k) {
      return {static_cast<T>(W(2) * static_cast<W>(surface_tension.get()) * f.u.k), bridge_status::ok};
    }
    d = {static_cast<W>(gap), W(0), bridge_control::suction};
    const bridge_status flat = travel_to<Equal>(pair, d, f);
    const bool none = flat == bridge_status::ruptured || flat == bridge_status::lopsided;
    return none ? outcome<T, bridge_status>{T(0), flat} : driest_by_march<T, Equal>(pair, gap);
  }

  /// The inverse of the widest gap by secants: on a plane at θ = 0 it grows about as −ln k.
  template <class T, bool Equal, class W = work<T>>
  [[nodiscard]] outcome<T, bridge_status> driest_by_march(const detail::surface_pair<W>& pair,
                                                          const T& gap) const noexcept {
    using std::exp;
    using std::log;
    constexpr int cap = 40;
    const W least = log(std::numeric_limits<W>::min()) + W(10);
    W x = log(W(0.01) * (pair.side[0].curvature + pair.side[1].curvature));
    W step(-1);
    W before(0);
    for (int i = 0; i < cap; ++i) {
      const W k = exp(x);
      const auto trip = detail::travel<fine, Equal>(pair, {W(0), k, bridge_control::suction}, infinity<W>);
      if (trip.how != detail::arrival::at_fold && trip.how != detail::arrival::at_slide) {
        break;
      }
      const W miss = trip.end.reach - static_cast<W>(gap);
      if (std::abs(miss) < W(1e-13) * static_cast<W>(gap)) {
        return {static_cast<T>(W(2) * static_cast<W>(surface_tension.get()) * k), bridge_status::ok};
      }
      if (i > 0) {
        step *= miss / (before - miss);
      }
      before = miss;
      x += step;
      if (x < least) {
        return {T(0), bridge_status::ruptured};
      }
    }
    return {T(quiet_nan<T>), bridge_status::not_converged};
  }

  template <class T, class W = work<T>>
  [[nodiscard]] detail::found<W> found_at(const detail::surface_pair<W>& pair, const meniscus<T>& m,
                                          bridge_control by) const noexcept {
    detail::found<W> f;
    f.u = profile_in(m);
    f.at = pair.equal ? detail::sample_of<fine, true>(pair, f.u) : detail::sample_of<fine, false>(pair, f.u);
    f.converged = false;
    if (f.at.sound) {
      const detail::demand<W> d{f.at.gap * f.at.scale, f.u.k, by};
      W step[4];
      f.converged = pair.equal ? detail::linearise<true>(f.at, f.u, d, step, f.by_gap, f.by_value)
                               : detail::linearise<false>(f.at, f.u, d, step, f.by_gap, f.by_value);
    }
    return f;
  }
};

template <int Nodes>
template <std::floating_point T>
bridge_stiffness<T> young_laplace<Nodes>::stiffness(const edge<T>& e, const meniscus<T>& m) const noexcept {
  using wide = work<T>;
  const T nan = quiet_nan<T>;
  const auto pair = pair_of(e);
  const auto at_k = found_at(pair, m, bridge_control::suction);
  const auto at_volume = found_at(pair, m, bridge_control::volume);
  if (!at_k.converged || !at_volume.converged) {
    return {nan, nan, nan, nan, nan};
  }
  wide lambda_gap(0);
  wide lambda_gap_at_volume(0);
  wide volume_gap(0);
  wide volume_k(0);
  for (int i = 0; i < (pair.equal ? 3 : 4); ++i) {
    lambda_gap += at_k.at.lambda_by[i] * at_k.by_gap[i];
    lambda_gap_at_volume += at_k.at.lambda_by[i] * at_volume.by_gap[i];
    volume_gap += at_k.at.by[detail::volume_row][i] * at_k.by_gap[i];
    volume_k += at_k.at.by[detail::volume_row][i] * at_k.by_value[i];
  }
  const wide sigma = static_cast<wide>(surface_tension.get());
  const wide scale = at_k.at.scale;
  const wide around = wide(2) * pi<wide> * sigma;
  bridge_stiffness<T> s;
  s.force_by_gap_at_volume = static_cast<T>(around * lambda_gap_at_volume);
  s.force_by_gap_at_suction = static_cast<T>(around * lambda_gap);
  s.volume_by_gap_at_suction = static_cast<T>(volume_gap * scale * scale);
  s.suction_by_gap_at_volume = static_cast<T>(wide(2) * sigma * at_volume.by_gap[0] / (scale * scale));
  s.volume_by_suction = static_cast<T>(volume_k * scale * scale * scale * scale / (wide(2) * sigma));
  return s;
}

template <int Nodes>
template <std::floating_point T>
bool young_laplace<Nodes>::stable(const edge<T>& e, const meniscus<T>& m, bridge_control control) const noexcept {
  const auto pair = pair_of(e);
  const auto f = found_at(pair, m, bridge_control::suction);
  return f.converged && holds(pair.equal ? detail::index_of<true>(pair, f, bridge_control::suction)
                                         : detail::index_of<false>(pair, f, bridge_control::suction),
                              control);
}

template <int Nodes>
template <std::floating_point T>
bridge_areas<T> young_laplace<Nodes>::areas(const edge<T>& e, const meniscus<T>& m) const noexcept {
  using wide = work<T>;
  const auto pair = pair_of(e);
  const auto u = profile_in(m);
  bridge_areas<T> a;
  const auto wetted = [&](std::size_t i) {
    const detail::contact_circle<wide> at(pair.side[i], u.w[i]);
    return static_cast<T>(pi<wide> * u.w[i] * at.radius);  // 2πRh
  };
  a.wetted1 = wetted(0);
  a.wetted2 = pair.equal ? a.wetted1 : wetted(1);
  a.liquid_gas = static_cast<T>(detail::profile_area<fine>(pair, u));
  return a;
}

template <int Nodes>
template <std::floating_point T>
std::array<T, 2> young_laplace<Nodes>::halves(const edge<T>& e, const meniscus<T>& m) const noexcept {
  using wide = work<T>;
  using std::sqrt;
  const auto pair = pair_of(e);
  const auto u = profile_in(m);
  const T half = T(0.5) * m.volume;
  const detail::contact_circle<wide> first(pair.side[0], u.w[0]);
  const detail::contact_circle<wide> second(pair.side[1], u.w[1]);
  if (pair.equal || m.by_length || !(first.cosine > wide(0)) || !(second.cosine > wide(0))) {
    return {half, half};
  }
  detail::sample<wide> s;
  s.gap = s.volume = wide(0);
  for (auto& row : s.by) {
    row[0] = row[1] = wide(0);
  }
  const wide a = u.k * u.extent;
  const wide p = wide(1) + wide(2) * a;
  if (!detail::add_side<fine>(s, pair.side[0], a, p, wide(1) / p, sqrt(p), wide(1) / u.extent, u.w[0], 0)) {
    return {half, half};
  }
  const T one = static_cast<T>(s.volume * u.extent * u.extent * u.extent);
  return {one, m.volume - one};
}

static_assert(warm_bridge_law<young_laplace<>, double, given_volume<double>>);
static_assert(warm_bridge_law<young_laplace<>, double, given_suction<double>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
