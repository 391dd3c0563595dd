// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/lbm/lattice.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

/// \file
/// Walls where they are, for links that a wall cuts elsewhere than half-way.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Where a wall cuts the link from a node to a solid one.
struct wall_cut {
  std::size_t node;
  int direction;
  double share;  ///< of the link, from the node on: above 0, at most 1
};

namespace detail {

template <class Simulation>
concept keeps_populations = requires(Simulation& s) { s.population(0, 0, 0); };

}  // namespace detail

/// What curved walls change of the populations that come back from them: to be applied after every step.
///
/// What leaves x in direction i and meets the wall after a share q of the link comes back as
/// f_i(x) + (1 − 2q)/(1 + 2q) (f_i(x − c_i) − f_ī(x)), all after collision: a velocity that is linear along the link is
/// 0 at the cut. Where a wall cuts the link on both sides of the node, a linear velocity would be 0 everywhere; such a
/// link stays as bounce-back makes it, half-way.
/// \par Domain  one component, a storage that keeps populations; by two relaxation times (trt), or the wall moves with
///              the viscosity
/// \par Accuracy  second order in the width of a node, first where links are cut on both sides; mass is conserved to
///                the order of the scheme alone (1e-9 a step in porous media)
/// \par Source  Ginzburg, Verhaeghe & d'Humières, Commun. Comput. Phys. 3, 427 (2008): central linear interpolation
template <class Simulation>
class curved_walls {
  static_assert(Simulation::components == 1, "curved_walls: populations of one component");
  static_assert(detail::keeps_populations<Simulation>,
                "curved_walls: storage::moments keeps no populations, take storage::in_place");

 public:
  /// Throws parameter_error for a share outside its domain.
  curved_walls(Simulation& s, std::span<const wall_cut> cuts) : simulation_(&s) {
    for (const wall_cut& cut : cuts) {
      if (!(cut.share > 0 && cut.share <= 1)) {
        throw parameter_error("curved wall", "a cut at " + short_number(cut.share) + " of a link",
                              "above 0, at most 1");
      }
      const auto behind = s.sites().leaving(cut.node, opposite(cut.direction));
      if (behind.to != static_cast<std::int32_t>(cut.node) || behind.as != cut.direction) {
        links_.push_back({cut.node, static_cast<std::size_t>(behind.to), static_cast<std::uint8_t>(cut.direction),
                          behind.as, static_cast<number>((1 - 2 * cut.share) / (1 + 2 * cut.share))});
      }
    }
  }

  void apply() {
    auto& places = places_[simulation_->steps() % 2];  // every storage keeps a population in at most two places
    if (places.empty()) {
      places.reserve(links_.size());
      for (const link& l : links_) {
        const auto back = static_cast<std::size_t>(opposite(l.direction));
        places.push_back({&simulation_->population(0, l.node, back), &simulation_->population(0, l.node, l.direction),
                          &simulation_->population(0, l.behind, l.as)});
      }
    }
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const place& at = places[k];
      *at.returning += links_[k].weight * (*at.following - *at.leaving);
    }
  }

  /// Links that are corrected.
  [[nodiscard]] std::size_t size() const noexcept { return links_.size(); }

 private:
  using number = std::remove_cvref_t<decltype(std::declval<Simulation&>().population(0, 0, 0))>;
  struct link {
    std::size_t node;
    std::size_t behind;      ///< the node on the other side
    std::uint8_t direction;  ///< towards the wall
    std::uint8_t as;         ///< what leaves the node for the one behind arrives there as
    number weight;
  };
  struct place {
    number* returning;        ///< from the wall
    const number* following;  ///< from behind, towards the wall
    const number* leaving;    ///< away from the wall
  };

  Simulation* simulation_;
  std::vector<link> links_;
  std::array<std::vector<place>, 2> places_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
