// SPDX-License-Identifier: BSD-3-Clause
// The templates of one-phase flow, instantiated whole.

#include "tetrapore/law/conductance/darcy.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/one_phase.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

template struct moving_body<float>;
template struct moving_body<double>;
template struct moving_body<long double>;
template float volume_rate(const moving_body<float>&) noexcept;
template double volume_rate(const moving_body<double>&) noexcept;
template long double volume_rate(const moving_body<long double>&) noexcept;

template throat_conductances conductances(const network&, const flow_nodes&, const darcy&, refused_throats,
                                          const serial&, keep_hydraulics);
template volume_rates rates_of_volume(const network&, const motion&, const serial&);

using direct_flow = saturated_flow<hydraulic_radius, ldlt_solver<>>;
using iterative_flow = saturated_flow<darcy, multigrid_solver<>>;
template class saturated_flow<hydraulic_radius, ldlt_solver<>>;
template class saturated_flow<darcy, multigrid_solver<>>;

template fluid_forces forces_of_pressure(const network&, const flow_nodes&, const pressure_field&, const vec3<double>&,
                                         const share_by_wetted_area&, const force_options&,
                                         std::span<const throat_hydraulics<double>>);
template fluid_forces forces_on_grains(const direct_flow&);
template fluid_forces forces_on_grains(const iterative_flow&);
template fluid_forces forces_on_grains(const iterative_flow&, const share_by_wetted_area&, const force_options&);
template double box_permeability(const direct_flow&, face, face, double);
template double box_permeability(const direct_flow&, face, face);
template vec3<double> mean_velocity(const direct_flow&);
template permeability_tensor tensor_of_permeability(direct_flow&, double, const solve_options&);

}  // namespace tetrapore::inline TETRAPORE_ABI
