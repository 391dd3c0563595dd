// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/concept.hpp"

/// \file
/// What an exact bridge law says of a bridge.
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.3, Eq. (4); the quantities are those of Orr,
///              Scriven & Rivas, J. Fluid Mech. 67, 723 (1975)

namespace tetrapore::inline TETRAPORE_ABI {

/// What keeps a bridge company: nothing, so that its volume stays, or a reservoir, so that its suction stays.
enum class bridge_control : unsigned char { volume, suction };

/// A bridge. \par Units  SI; radii and lengths [m], angles [rad]
template <real T>
struct meniscus {
  T force;     ///< positive where it pulls the pair together
  T volume;    ///< of the liquid, the caps of both surfaces subtracted; where they overlap, their lens is so twice
  T suction;   ///< pressure of the gas less that of the liquid
  T neck;      ///< smallest radius of the profile
  T filling1;  ///< angle at the grain's centre between the axis and the contact circle; 0 on a plane
  T filling2;  ///< the same of the second surface
  T contact1;  ///< radius of the contact circle on the first surface
  T contact2;  ///< radius of the contact circle on the second surface
  // The profile: what areas, stiffness and stability start from
  T curvature;  ///< suction over twice the surface tension
  T extent;     ///< radius of the neck, real or virtual; else length of the profile (see `by_length`)
  T circle1;    ///< 2 R tan(filling1 / 2), which is contact1 on a plane
  T circle2;
  bool by_length;  ///< the extent is the length of the profile, half of it where the pair is equal
};

/// \par Units  [m²]
template <real T>
struct bridge_areas {
  T liquid_gas;
  T wetted1;
  T wetted2;
};

/// The derivatives of a bridge. By the Maxwell relation dF/dp_c at constant gap is dV/dgap at constant p_c, and
/// dF/dV at constant gap is −dp_c/dgap at constant volume.
template <real T>
struct bridge_stiffness {
  T force_by_gap_at_volume;    ///< dF/dgap at V
  T force_by_gap_at_suction;   ///< dF/dgap at p_c
  T volume_by_gap_at_suction;  ///< dV/dgap at p_c
  T suction_by_gap_at_volume;  ///< dp_c/dgap at V
  T volume_by_suction;         ///< dV/dp_c at gap
};

/// How a bridge ends as its gap grows.
enum class bridge_end : unsigned char {
  fold,     ///< the stable and the unstable bridge meet
  lopsided  ///< the symmetric bridge of an equal pair loses its stability: the liquid slides to one side
};

/// The widest gap of a bridge, and the bridge there.
template <real T>
struct bridge_limit {
  T gap;
  bridge_end end;
  meniscus<T> last;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
