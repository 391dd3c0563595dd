// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/concept.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// Entry pressure of an opening whose sides are mirror planes, as in a lattice experiment on one throat: the gas may
/// also cross the gaps. The least pressure over all choices of gaps that are open, of those whose answer is ok.
/// \par Units   result [Pa]
/// \par Domain  of the law inside, which must cover open gaps; a gap without width cannot be crossed
/// \par Accuracy  of the law inside for the plane picture; beside three-dimensional menisci between equal spheres 6 %,
///                except 16 % low at θ = 60° and a gap of 0.2 R (tests/truth/se_results.csv)
/// \par Source  minimum over the branches of Mayer & Stowe (arcs) and of Carman's ratio cos θ P_solid / A_void (all
///              open)
template <class Law>
struct mirror_sided {
  Law law;

  template <real T>
    requires entry_law<Law, T>
  [[nodiscard]] outcome<T, entry_status> entry_pressure(const opening<T>& o) const noexcept {
    outcome<T, entry_status> best = law.entry_pressure(o);
    if (best.reason == entry_status::invalid_input || best.reason == entry_status::closed ||
        o.count > opening<T>::max_sides) {
      return best;
    }
    unsigned crossable = 0;
    for (std::size_t k = 0; k < o.count; ++k) {
      if (has_width(o.sides[k], o.sides[o.next(k)]) && o.gaps[k] == gap_state::liquid) {
        crossable |= 1U << k;
      }
    }
    opening<T> trial = o;
    for (unsigned open = crossable; open != 0; open = (open - 1) & crossable) {
      for (std::size_t k = 0; k < o.count; ++k) {
        trial.gaps[k] = (open >> k & 1U) != 0 ? gap_state::open : o.gaps[k];
      }
      const auto answer = law.entry_pressure(trial);
      if (answer.ok() && !(best.ok() && best.value <= answer.value)) {
        best = answer;
      }
    }
    return best;
  }

 private:
  [[nodiscard]] static bool has_width(const auto& s, const auto& t) noexcept {
    const auto v = t.point - s.point;
    if (s.kind == side_kind::disc && t.kind == side_kind::disc) {
      const auto sum = s.radius + t.radius;
      return dot(v, v) > sum * sum;
    }
    if (s.kind == side_kind::disc) {
      return -dot(t.normal, v) > s.radius;
    }
    return t.kind == side_kind::disc && dot(s.normal, v) > t.radius;
  }
};
template <class Law>
mirror_sided(Law) -> mirror_sided<Law>;

}  // namespace tetrapore::inline TETRAPORE_ABI
