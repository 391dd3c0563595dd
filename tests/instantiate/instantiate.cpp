// SPDX-License-Identifier: BSD-3-Clause
// Every template of the std-only layers instantiated whole, for every scalar that it is meant for: a member that nobody
// calls yet must compile too.

#include "tetrapore/core.hpp"
#include "tetrapore/geometry/area.hpp"
#include "tetrapore/geometry/ball_volume.hpp"
#include "tetrapore/geometry/inscribed.hpp"
#include "tetrapore/geometry/polyhedron.hpp"
#include "tetrapore/geometry/power_centre.hpp"
#include "tetrapore/geometry/solid_angle.hpp"
#include "tetrapore/law/entry/inscribed_circle.hpp"
#include "tetrapore/law/entry/lost_arc.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/law/entry/mirror_sided.hpp"
#include "tetrapore/network/field.hpp"
#include "tetrapore/simplex/edge.hpp"
#include "tetrapore/simplex/make_opening.hpp"
#include "tetrapore/simplex/pore_volume.hpp"
#include "tetrapore/two_phase/drainage.hpp"
#include "tetrapore/two_phase/facet_rule.hpp"
#include "tetrapore/two_phase/retention_curve.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

template class required<double>;
template struct id<grain_tag>;
template struct id<edge_tag>;
template struct id<throat_tag>;
template struct id<pore_tag>;
template struct outcome<double, entry_status>;
template struct bracket<double>;
template class field<quantity::extensive>;
template class field<quantity::intensive>;

#define TETRAPORE_INSTANTIATE(T)                                                                                   \
  template struct vec3<T>;                                                                                         \
  template struct vec2<T>;                                                                                         \
  template struct sphere<T>;                                                                                       \
  template struct plane<T>;                                                                                        \
  template struct circle<T>;                                                                                       \
  template struct small_polygon<T>;                                                                                \
  template class polyhedron<T>;                                                                                    \
  template struct edge<T>;                                                                                         \
  template struct throat<T>;                                                                                       \
  template struct opening<T>;                                                                                      \
  template struct pore_body<T>;                                                                                    \
  template vec3<T> triangle_area(const vec3<T>&, const vec3<T>&, const vec3<T>&) noexcept;                         \
  template vec3<T> quadrangle_area(const vec3<T>&, const vec3<T>&, const vec3<T>&, const vec3<T>&) noexcept;       \
  template vec3<T> trapezoid_area(const vec3<T>&, const vec3<T>&, const plane<T>&) noexcept;                       \
  template vec3<T> rectangle_area(const vec3<T>&, const plane<T>&, const plane<T>&) noexcept;                      \
  template T tetrahedron_volume(const vec3<T>&, const vec3<T>&, const vec3<T>&) noexcept;                          \
  template T solid_angle(const vec3<T>&, const vec3<T>&, const vec3<T>&) noexcept;                                 \
  template T ball_volume(const T&) noexcept;                                                                       \
  template T cap_volume(const T&, const T&) noexcept;                                                              \
  template T lens_volume(const T&, const T&, const T&) noexcept;                                                   \
  template T ball_volume(const sphere<T>&, const polyhedron<T>&) noexcept;                                         \
  template outcome<T, geometry_status> union_volume(const polyhedron<T>&, std::span<const sphere<T>>) noexcept;    \
  template outcome<circle<T>, inscribed_status> circle_between(const std::array<bounding_side2<T>, 3>&) noexcept;  \
  template outcome<sphere<T>, inscribed_status> sphere_between(const std::array<bounding_side3<T>, 4>&) noexcept;  \
  template outcome<vec3<T>, geometry_status> power_centre(const pore_body<T>&) noexcept;                           \
  template T total_volume(const pore_body<T>&) noexcept;                                                           \
  template T sector_volume(const pore_body<T>&) noexcept;                                                          \
  template outcome<T, geometry_status> void_volume(const pore_body<T>&, std::span<const sphere<T>>) noexcept;      \
  template opening<T> opening_of(const throat<T>&) noexcept;                                                       \
  template outcome<opening<T>, opening_status> opening_from_distances(const T&, const T&, const T&, const T&,      \
                                                                      const T&, const T&) noexcept;                \
  template outcome<opening<T>, opening_status> regular_polygon(std::size_t, const T&) noexcept;                    \
  template outcome<opening<T>, opening_status> ring_of_discs(std::size_t, const T&, const T&, gap_state) noexcept; \
  template outcome<opening<T>, opening_status> two_discs_on_plate(const T&, const T&) noexcept;                    \
  template outcome<opening<T>, opening_status> merge(const opening<T>&, std::size_t, const opening<T>&,            \
                                                     std::size_t) noexcept;                                        \
  template outcome<T, entry_status> inscribed_circle::entry_pressure(const opening<T>&) const noexcept;            \
  template outcome<T, entry_status> mayer_stowe_princen::entry_pressure(const opening<T>&) const noexcept;         \
  template outcome<arc_limit<T>, entry_status> mayer_stowe_princen::first_arc_lost(const opening<T>&) const noexcept;

TETRAPORE_INSTANTIATE(float)
TETRAPORE_INSTANTIATE(double)
TETRAPORE_INSTANTIATE(long double)

template struct lost_arc<mayer_stowe_princen>;
template struct mirror_sided<mayer_stowe_princen>;
template class facet_rule<mayer_stowe_princen, gap_model::refused>;
template class facet_rule<mayer_stowe_princen, gap_model::lost_arc>;
template class facet_rule<mayer_stowe_princen, gap_model::merged>;
template class drainage<facet_rule<inscribed_circle, gap_model::refused>>;
template class drainage<facet_rule<mayer_stowe_princen, gap_model::lost_arc>>;
template class drainage<facet_rule<mayer_stowe_princen, gap_model::merged>>;

}  // namespace tetrapore::inline TETRAPORE_ABI
