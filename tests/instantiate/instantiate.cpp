// SPDX-License-Identifier: BSD-3-Clause
// The class templates and the public function templates of the std-only layers instantiated whole: those of the local
// laws for float, double and long double, those that take a callable or a rule with one of each kind, so that a member
// that nobody calls yet must compile too. Templates in namespace detail: as far as these reach them.

#include "tetrapore/core.hpp"
#include "tetrapore/core/evaluate.hpp"
#include "tetrapore/geometry/area.hpp"
#include "tetrapore/geometry/ball_volume.hpp"
#include "tetrapore/geometry/disc_area.hpp"
#include "tetrapore/geometry/inscribed.hpp"
#include "tetrapore/geometry/polyhedron.hpp"
#include "tetrapore/geometry/power_centre.hpp"
#include "tetrapore/geometry/solid_angle.hpp"
#include "tetrapore/io/csv.hpp"
#include "tetrapore/io/output_file.hpp"
#include "tetrapore/io/vtk_xml.hpp"
#include "tetrapore/law/entry/inscribed_circle.hpp"
#include "tetrapore/law/entry/lost_arc.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/law/entry/mirror_sided.hpp"
#include "tetrapore/network/field.hpp"
#include "tetrapore/network/gather_opening.hpp"
#include "tetrapore/network/make_network.hpp"
#include "tetrapore/network/measure.hpp"
#include "tetrapore/network/transfer.hpp"
#include "tetrapore/packing/close_edges.hpp"
#include "tetrapore/packing/neighbours.hpp"
#include "tetrapore/packing/random.hpp"
#include "tetrapore/simplex/edge.hpp"
#include "tetrapore/simplex/make_opening.hpp"
#include "tetrapore/simplex/pair_store.hpp"
#include "tetrapore/simplex/pore_volume.hpp"
#include "tetrapore/simplex/throat_geometry.hpp"
#include "tetrapore/tessellation/tessellation.hpp"
#include "tetrapore/two_phase/drainage.hpp"
#include "tetrapore/two_phase/facet_rule.hpp"
#include "tetrapore/two_phase/interfacial_area.hpp"
#include "tetrapore/two_phase/retention_curve.hpp"
#include "tetrapore/two_phase/state.hpp"
#include "tetrapore/two_phase/trapping.hpp"
#include "tetrapore/two_phase/van_genuchten.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tetrapore::inline TETRAPORE_ABI {

template class required<double>;
template struct id<grain_tag>;
template struct id<edge_tag>;
template struct id<throat_tag>;
template struct id<pore_tag>;
template struct outcome<double, entry_status>;
template struct bracket<double>;
template class pair_store<double>;
template class field<quantity::extensive>;
template class field<quantity::intensive>;

#define TETRAPORE_INSTANTIATE(T)                                                                                      \
  template struct vec3<T>;                                                                                            \
  template struct vec2<T>;                                                                                            \
  template struct sphere<T>;                                                                                          \
  template struct plane<T>;                                                                                           \
  template struct circle<T>;                                                                                          \
  template struct small_polygon<T>;                                                                                   \
  template class polyhedron<T>;                                                                                       \
  template struct edge<T>;                                                                                            \
  template struct throat<T>;                                                                                          \
  template struct opening<T>;                                                                                         \
  template struct disc<T>;                                                                                            \
  template struct plane_polygon<T>;                                                                                   \
  template struct entry_meniscus<T>;                                                                                  \
  template struct entry_sensitivity<T>;                                                                               \
  template T disc_area(const disc<T>&, const plane_polygon<T>&) noexcept;                                             \
  template T facet_area(const throat<T>&) noexcept;                                                                   \
  template outcome<T, geometry_status> fluid_area(const throat<T>&) noexcept;                                         \
  template small_polygon<T> facet(const pore_body<T>&, std::size_t) noexcept;                                         \
  template bool reaches(const sphere<T>&, const pore_body<T>&, std::size_t) noexcept;                                 \
  template bool pokes(const pore_body<T>&, std::size_t) noexcept;                                                     \
  template outcome<T, geometry_status> void_overlap(const pore_body<T>&, const pore_body<T>&,                         \
                                                    std::span<const sphere<T>>) noexcept;                             \
  template T protruding_volume(const sphere<T>&, const domain&) noexcept;                                             \
  template opening<T> mirrored(const opening<T>&) noexcept;                                                           \
  template struct pore_body<T>;                                                                                       \
  template vec3<T> triangle_area(const vec3<T>&, const vec3<T>&, const vec3<T>&) noexcept;                            \
  template vec3<T> quadrangle_area(const vec3<T>&, const vec3<T>&, const vec3<T>&, const vec3<T>&) noexcept;          \
  template vec3<T> trapezoid_area(const vec3<T>&, const vec3<T>&, const plane<T>&) noexcept;                          \
  template vec3<T> rectangle_area(const vec3<T>&, const plane<T>&, const plane<T>&) noexcept;                         \
  template T tetrahedron_volume(const vec3<T>&, const vec3<T>&, const vec3<T>&) noexcept;                             \
  template T solid_angle(const vec3<T>&, const vec3<T>&, const vec3<T>&) noexcept;                                    \
  template T ball_volume(const T&) noexcept;                                                                          \
  template T cap_volume(const T&, const T&) noexcept;                                                                 \
  template T lens_volume(const T&, const T&, const T&) noexcept;                                                      \
  template T ball_volume(const sphere<T>&, const polyhedron<T>&) noexcept;                                            \
  template outcome<T, geometry_status> union_volume(const polyhedron<T>&, std::span<const sphere<T>>) noexcept;       \
  template outcome<circle<T>, inscribed_status> circle_between(const std::array<bounding_side2<T>, 3>&) noexcept;     \
  template outcome<sphere<T>, inscribed_status> sphere_between(const std::array<bounding_side3<T>, 4>&) noexcept;     \
  template outcome<vec3<T>, geometry_status> power_centre(const pore_body<T>&) noexcept;                              \
  template T total_volume(const pore_body<T>&) noexcept;                                                              \
  template T sector_volume(const pore_body<T>&) noexcept;                                                             \
  template outcome<T, geometry_status> void_volume(const pore_body<T>&, std::span<const sphere<T>>) noexcept;         \
  template opening<T> opening_of(const throat<T>&) noexcept;                                                          \
  template outcome<opening<T>, opening_status> opening_from_distances(const T&, const T&, const T&, const T&,         \
                                                                      const T&, const T&) noexcept;                   \
  template outcome<opening<T>, opening_status> regular_polygon(std::size_t, const T&) noexcept;                       \
  template outcome<opening<T>, opening_status> ring_of_discs(std::size_t, const T&, const T&, gap_state) noexcept;    \
  template outcome<opening<T>, opening_status> two_discs_on_plate(const T&, const T&) noexcept;                       \
  template outcome<opening<T>, opening_status> merge(const opening<T>&, std::size_t, const opening<T>&,               \
                                                     std::size_t) noexcept;                                           \
  template outcome<T, entry_status> inscribed_circle::entry_pressure(const opening<T>&) const noexcept;               \
  template outcome<T, entry_status> mayer_stowe_princen::entry_pressure(const opening<T>&) const noexcept;            \
  template outcome<arc_limit<T>, entry_status> mayer_stowe_princen::first_arc_lost(const opening<T>&) const noexcept; \
  template outcome<T, entry_status> mayer_stowe_princen::arc_lost(const edge<T>&) const noexcept;                     \
  template outcome<entry_meniscus<T>, entry_status> mayer_stowe_princen::meniscus(const opening<T>&) const noexcept;  \
  template outcome<entry_sensitivity<T>, entry_status> mayer_stowe_princen::derivative(const opening<T>&)             \
      const noexcept;                                                                                                 \
  template outcome<T, entry_status> lost_arc<mayer_stowe_princen>::entry_pressure(const opening<T>&) const noexcept;  \
  template outcome<arc_limit<T>, entry_status> lost_arc<mayer_stowe_princen>::first_arc_lost(const opening<T>&)       \
      const noexcept;                                                                                                 \
  template outcome<T, entry_status> lost_arc<mayer_stowe_princen>::arc_lost(const edge<T>&) const noexcept;           \
  template outcome<T, entry_status> mirror_sided<mayer_stowe_princen>::entry_pressure(const opening<T>&) const noexcept;

template struct lost_arc<mayer_stowe_princen>;
template struct mirror_sided<mayer_stowe_princen>;

TETRAPORE_INSTANTIATE(float)
TETRAPORE_INSTANTIATE(double)
TETRAPORE_INSTANTIATE(long double)

template class facet_rule<mayer_stowe_princen, gap_model::refused>;
template class facet_rule<mayer_stowe_princen, gap_model::lost_arc>;
template class facet_rule<mayer_stowe_princen, gap_model::merged>;
template class drainage<facet_rule<inscribed_circle, gap_model::refused>>;
template class drainage<facet_rule<mayer_stowe_princen, gap_model::lost_arc>>;
template class drainage<facet_rule<mayer_stowe_princen, gap_model::merged>>;

// One callable, engine and packing of each kind that a function template asks for.
struct no_engine {
  tessellation operator()(std::span<const sphere<double>>, const domain&) const { return {}; }
};
struct constant_law {
  outcome<double, entry_status> operator()(throat_id) const noexcept { return {1.0, entry_status::ok}; }
};
struct nth_throat {
  throat_id operator()(std::size_t t) const { return throat_id(t); }
};
struct drop {
  void operator()(std::size_t, const outcome<double, entry_status>&) const {}
  void operator()(const close_pair&, const vec3<double>&) const {}
  void operator()(const close_edge&) const {}
  void operator()(pore_id) const {}
};
struct every_pore {
  bool operator()(pore_id) const noexcept { return true; }
};
using grain_list = std::vector<sphere<double>>;
using fixed_rule = facet_rule<mayer_stowe_princen, gap_model::lost_arc>;
using merging_rule = facet_rule<mayer_stowe_princen, gap_model::merged>;

template vec3<double> coordinates(const std::array<float, 3>&);
template vec3<double> coordinates(const vec3<double>&);
template sphere<double> as_sphere(const sphere<double>&);
template tally evaluate(const serial&, std::size_t, const constant_law&, const nth_throat&, const drop&);

template network make_network(const domain&, std::vector<sphere<double>>, std::vector<cell>, const serial&);
template measure_report measure(network&, const serial&);
template measure_report follow(network&, const grain_list&, const serial&);
template void carry(const transfer&, field<quantity::extensive>&);
template void carry(const transfer&, field<quantity::intensive>&);
template transfer rebuild(network&, const no_engine&, const grain_list&);
template tessellation tessellate(const grain_list&, const domain&, const no_engine&);
template std::optional<edge_cursor> end_of_gas(const network&, edge_cursor, const every_pore&) noexcept;
template gathered_ring::growth gathered_ring::grow(const network&, std::size_t, const every_pore&) noexcept;

template void size_class_grids::for_each_pair(const drop&) const;
template void for_each_close_pair(const packing&, double, const drop&);
template void for_each_close_edge(std::span<const sphere<double>>, const domain&, double, const drop&);
template void random_sequence::shuffle(std::vector<double>&) noexcept;

template fixed_rule::facet_rule(const network&, const mayer_stowe_princen&, const serial&);
template merging_rule::facet_rule(const network&, const mayer_stowe_princen&, const serial&);
template void pore_links::around(pore_id, const drop&) const;
template double saturation(const network&, const two_phase_state&, const every_pore&);
template retention_curve::retention_curve(const drainage<fixed_rule>&);
template retention_curve::retention_curve(const drainage<merging_rule>&);
template meniscus_area interfacial_area(const network&, const two_phase_state&, fixed_rule&, double, double);
template meniscus_area interfacial_area(const network&, const two_phase_state&, merging_rule&, double, double);
template outcome<van_genuchten_fit, fit_status> fit_van_genuchten(const retention_curve&, std::size_t);

namespace io {
template void csv_writer::row(const double&, const std::size_t&, const std::string_view&);
template output_file& output_file::operator<<(int);
template output_file& output_file::operator<<(float);
template output_file& output_file::operator<<(double);
template data_column::data_column(std::string, const std::vector<double>&);
template data_column::data_column(std::string, const std::vector<vec3<double>>&);
template data_column::data_column(std::string, const std::span<const int>&);
}  // namespace io

}  // namespace tetrapore::inline TETRAPORE_ABI
