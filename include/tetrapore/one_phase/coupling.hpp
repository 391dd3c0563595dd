// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/transfer.hpp"
#include "tetrapore/one_phase/drag_bounds.hpp"
#include "tetrapore/one_phase/flow.hpp"
#include "tetrapore/one_phase/forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// \file
/// Flow coupled two-way to grains that somebody else moves.
///
/// In short:
/// \code
///   coupled_flow flow(cgal_triangulation{}(grains, region).net, hydraulic_radius{.viscosity = 1e-3}, ldlt_solver<>{},
///                     {.conditions = drained});
///   for (…) {
///     compute_contacts(grains, forces);                      // the caller's
///     if (flow.rebuild_due({.strain = 0.02}) != rebuild_reason::none) {
///       flow.rebuild(cgal_triangulation{}, grains);
///     }
///     coupling_report r = flow.step(dt, grains, velocities, forces);  // adds the fluid's forces
///     integrate(grains, velocities, forces, dt);             // the caller's
///   }
/// \endcode

namespace tetrapore::inline TETRAPORE_ABI {

/// How the pressure of a compressible fluid goes from one time to the next.
enum class pressure_scheme : unsigned char {
  implicit_step,  ///< backward Euler: one solution per step, any length of step; the only one without compressibility
  explicit_step   ///< forward Euler: no solution, steps up to `coupled_flow::largest_explicit_step`
};

struct coupling_options {
  pressure_scheme scheme = pressure_scheme::implicit_step;
  /// Steps between two computations of the conductances and of the shares in which facets load grains. Volume rates and
  /// areas are always those of the present positions.
  std::size_t refresh_every = 1;
  /// A warm start is the present pressure, across rebuilds too; before the first step only where the caller has set
  /// one.
  solve_options solve{.warm = true};
};

/// How the box moves: where its faces are now, and the velocity of walls and periodic vectors.
struct box_motion {
  box bounds;
  std::array<vec3<double>, 6> walls{};         ///< only the normal part counts [m/s]
  std::array<vec3<double>, 3> period_rates{};  ///< [m/s]
};

enum class coupling_status : unsigned char {
  ok,
  not_solved,     ///< the solver did not converge: see `solve`; the forces are those of its best pressure
  step_too_long,  ///< refused: an explicit step beyond its bound; nothing has changed but the positions
  turned_cells    ///< refused: a pore of a compressible fluid without void, turned inside out: rebuild
};

[[nodiscard]] constexpr verdict verdict_of(coupling_status s) noexcept {
  return s == coupling_status::ok ? verdict::ok : s == coupling_status::not_solved ? verdict::failed : verdict::refused;
}

[[nodiscard]] constexpr const char* describe(coupling_status s) noexcept {
  switch (s) {
    case coupling_status::ok: return "ok";
    case coupling_status::not_solved: return "the pressure has not converged";
    case coupling_status::step_too_long: return "an explicit step of the pressure beyond its stability bound";
    case coupling_status::turned_cells: return "a pore without void: the grains have left their triangulation behind";
  }
  return "not a status";
}

/// Where the fluid went. Volumes at the reference pressure [m³].
struct fluid_ledger {
  double squeezed = 0;  ///< pushed out of the pores by their change of volume
  double injected = 0;  ///< by imposed fluxes
  double stored = 0;    ///< taken up by compression
  double outflow = 0;   ///< through pores of held pressure
  /// Exchanged by pores with the grains, with imposed fluxes and through held pressures: Σ of magnitudes.
  double throughput = 0;

  /// What is missing; to be compared with the throughput.
  [[nodiscard]] double defect() const noexcept { return std::abs(squeezed + injected - stored - outflow); }

  fluid_ledger& operator+=(const fluid_ledger& b) noexcept {
    squeezed += b.squeezed;
    injected += b.injected;
    stored += b.stored;
    outflow += b.outflow;
    throughput += b.throughput;
    return *this;
  }
};

/// What became of a step.
struct coupling_report {
  coupling_status reason = coupling_status::ok;
  solve_report solve;
  fluid_ledger fluid;      ///< of this step
  bool refreshed = false;  ///< conductances were computed

  [[nodiscard]] verdict kind() const noexcept { return verdict_of(reason); }
  [[nodiscard]] bool ok() const noexcept { return reason == coupling_status::ok; }
};

/// When to triangulate anew. What is 0 is not looked at.
struct rebuild_rule {
  std::size_t every = 0;         ///< steps
  double strain = 0;             ///< mean square root strain of the edges since the last triangulation
  double turned_volume = 1e-12;  ///< share of the network's volume in cells turned inside out that is borne
};

enum class rebuild_reason : unsigned char { none, steps, strain, turned_cells };

/// How far the grains have left their triangulation behind.
struct mesh_distortion {
  double strain = 0;             ///< √ of the mean of (change of length / length)² over the edges of all pores
  std::size_t turned_cells = 0;  ///< cells that had a positive volume and have no more
  double turned_volume = 0;      ///< their share of the volume of all cells
};

namespace detail {

template <class F>
concept hooked_force = requires(F& f, const vec3<double>& x) { tetrapore_add(f, x); };

/// Adds to a vector of the caller: by a free function `tetrapore_add(f, x)` found by argument-dependent lookup (the
/// customisation point), else to f.x, f.y, f.z, else to f[0], f[1], f[2].
template <class F>
void add_to(F& f, const vec3<double>& x) {
  const auto add = [](auto& sum, double value) {
    sum = static_cast<std::remove_reference_t<decltype(sum)>>(static_cast<double>(sum) + value);
  };
  if constexpr (hooked_force<F>) {
    tetrapore_add(f, x);
  } else if constexpr (member_position<F>) {
    add(f.x, x.x);
    add(f.y, x.y);
    add(f.z, x.z);
  } else {
    add(f[0], x.x);
    add(f[1], x.y);
    add(f[2], x.z);
  }
}

}  // namespace detail

/// A network that follows the caller's grains, the flow in it, and the forces of the flow on grains and walls.
///
/// One step: the network takes the positions; each pore changes its volume as fast as the velocities say; the pressure
/// that balances this is found; its forces are added to the caller's. So the forces belong to the velocities before the
/// caller's integration, and act in it as a viscous damper taken explicitly: its step is bounded by `largest_step`,
/// unless the caller adds `added_mass` to the inertia of his grains.
///
/// What a solution leaves unbalanced in a pore enters the next one as a source, so that no mass is lost however many
/// steps are made.
///
/// Neither copied nor moved, for the flow in it refers to the network in it: keep one in a std::optional or a
/// std::unique_ptr where it must go from place to place.
/// \par Thread safety  one thread at a time
template <conductance_law Law, network_solver Solver, load_sharing Sharing = share_by_wetted_area>
class coupled_flow {
 public:
  /// \param net  with the grains where they are now
  /// \throw as saturated_flow; parameter_error  an explicit step without compressibility
  coupled_flow(network net, Law law, Solver solver, flow_options flow = {}, coupling_options options = {})
      : coupled_flow(std::move(net), law, std::move(solver), std::move(flow), options, sharing_of<Sharing>(law)) {}
  /// The same, with a sharing of the caller's; without one, walls take shear where the law says that the fluid sticks.
  coupled_flow(network net, Law law, Solver solver, flow_options flow, coupling_options options, Sharing sharing)
      : net_(std::move(net)),
        options_(options),
        sharing_(std::move(sharing)),
        flow_(net_, std::move(law), std::move(solver), kept(std::move(flow))) {
    if (options_.scheme == pressure_scheme::explicit_step && !flow_.system().compressible()) {
      throw parameter_error("pressure scheme", "an explicit step of an incompressible fluid", "an implicit step");
    }
    if (options_.refresh_every == 0) {
      throw parameter_error("refresh_every", "0", "at least 1");
    }
    unbalanced_ = field<quantity::extensive>(net_);
    triangulated_ = lengths_of(net_);
    found_ = gather();
  }
  coupled_flow(const coupled_flow&) = delete;
  coupled_flow& operator=(const coupled_flow&) = delete;

  /// Makes a step with the walls at rest.
  template <class Grains, class Velocities, class Forces>
  coupling_report step(double dt, const Grains& grains, const Velocities& velocities, Forces&& forces) {
    return step(dt, grains, velocities, forces, box_motion{net_.region().bounds});
  }

  /// Makes a step: follows the grains, finds the pressure at the end of the step, adds its forces to `forces`. The
  /// forces on walls: `wall_forces`.
  /// \param grains      range of anything with a position and a radius (see as_sphere), in the order of the network's.
  ///                    Along a periodic axis a grain may have been put back into the box
  /// \param velocities  range of vectors (see coordinates) [m/s]
  /// \param forces      range of vectors that can be added to (see detail::add_to) [N]
  /// \throw parameter_error  ranges of other lengths, a step that is not above 0; as saturated_flow, where a throat is
  ///                         refused or sources have nowhere to go
  template <class Grains, class Velocities, class Forces>
  coupling_report step(double dt, const Grains& grains, const Velocities& velocities, Forces&& forces,
                       const box_motion& box) {
    if (!(dt > 0) || !std::isfinite(dt)) {
      throw parameter_error("time step", short_number(dt), "a finite number above 0");
    }
    if (const auto n = static_cast<std::size_t>(std::distance(std::begin(forces), std::end(forces)));
        n != net_.grain_count()) {
      throw parameter_error("forces", std::to_string(n), std::to_string(net_.grain_count()));
    }
    take_velocities(velocities);
    next_ = followed(grains, box.bounds);
    net_.mutable_arrays().region.bounds = box.bounds;
    std::swap(net_.mutable_arrays().grains, next_);
    coupling_report report;
    if (steps_since_refresh_ >= options_.refresh_every) {
      refresh();
      report.refreshed = true;
    }
    if (flow_.system().compressible() && has_turned_pores()) {
      report.reason = coupling_status::turned_cells;
      return report;
    }
    volume_rates rates = rates_of_volume(net_, motion{velocities_, box.walls, box.period_rates});
    for (const double v : rates.values) {
      report.fluid.throughput += std::abs(v) * dt;
      report.fluid.squeezed -= v * dt;
    }
    for (std::size_t i = 0; i < net_.pore_count(); ++i) {
      rates.values[i] -= unbalanced_[pore_id(i)] / dt;
    }
    old_.assign(flow_.pressure().values().begin(), flow_.pressure().values().end());
    if (options_.scheme == pressure_scheme::implicit_step) {
      solve_options how = options_.solve;
      how.warm = how.warm && (steps_ > 0 || std::any_of(old_.begin(), old_.end(), [](double p) { return p != 0; }));
      report.solve = flow_.step(dt, rates, how);
      report.reason = report.solve.ok() ? coupling_status::ok : coupling_status::not_solved;
    } else if (dt <= largest_explicit_step()) {
      report.solve.reason = solve_status::ok;
      advance_explicitly(dt, rates.values);
    } else {
      report.reason = coupling_status::step_too_long;
      return report;
    }
    balance(dt, rates.values, report);
    add_forces(forces);
    ledger_ += report.fluid;
    ++steps_;
    ++steps_since_refresh_;
    ++steps_since_rebuild_;
    return report;
  }

  /// Triangulates the grains anew where they are, and carries the pressure over.
  /// \param engine  makes networks, see tessellation_engine
  /// \return how to carry fields of the caller
  /// \throw parameter_error  there are conditions on single pores, which a rebuild renumbers: say the new ones;
  ///                         as the constructor, the engine and tetrapore::rebuild. Nothing has changed then but that
  ///                         the flow may have to be solved again before it tells fluxes
  template <class Engine, class Grains>
  transfer rebuild(const Engine& engine, const Grains& grains) {
    return rebuild(engine, grains, net_.region().bounds);
  }
  template <class Engine, class Grains>
  transfer rebuild(const Engine& engine, const Grains& grains, const box& bounds) {
    if (!flow_.system().conditions().pores.empty()) {
      throw parameter_error("conditions of single pores",
                            "pores of epoch " + std::to_string(net_.epoch()) + ", which a rebuild renumbers",
                            "rebuild(engine, grains, bounds, conditions)");
    }
    return rebuild(engine, grains, bounds, [this](const network&) { return flow_.system().conditions(); });
  }
  /// The same, with other conditions: what conditions(net) says of the new network.
  template <class Engine, class Grains, std::invocable<const network&> Conditions>
  transfer rebuild(const Engine& engine, const Grains& grains, const box& bounds, const Conditions& conditions) {
    network made = net_;
    const std::vector<sphere<double>> here = followed(grains, bounds);
    made.mutable_arrays().region.bounds = bounds;
    made.mutable_arrays().grains = here;
    transfer way = tetrapore::rebuild(made, engine, here);
    flow_conditions wanted = conditions(std::as_const(made));
    pressure_field pressure = flow_.pressure();
    carry(way, pressure);
    field<quantity::extensive> unbalanced = unbalanced_;
    carry(way, unbalanced);
    lengths triangulated = lengths_of(made);
    const auto exchange = [&]() noexcept {
      std::swap(net_, made);
      std::swap(flow_.pressure(), pressure);
    };
    const flow_conditions before = flow_.system().conditions();
    const std::uint64_t epoch = net_.epoch();
    exchange();
    try {
      flow_.update(std::move(wanted));
      found_ = gather();
    } catch (...) {
      exchange();
      if (flow_.system().epoch() != epoch) {
        flow_.update(before);
      }
      throw;
    }
    unbalanced_ = std::move(unbalanced);
    triangulated_ = std::move(triangulated);
    steps_since_rebuild_ = 0;
    steps_since_refresh_ = 0;
    return way;
  }

  /// Whether it is time to triangulate anew, at the positions of the last step.
  [[nodiscard]] rebuild_reason rebuild_due(const rebuild_rule& rule) const {
    if (rule.every > 0 && steps_since_rebuild_ >= rule.every) {
      return rebuild_reason::steps;
    }
    const mesh_distortion now = distortion();
    if (now.turned_volume > rule.turned_volume) {
      return rebuild_reason::turned_cells;
    }
    return rule.strain > 0 && now.strain > rule.strain ? rebuild_reason::strain : rebuild_reason::none;
  }

  /// How far the grains have left their triangulation behind, at the positions of the last step.
  [[nodiscard]] mesh_distortion distortion() const {
    mesh_distortion out;
    double squares = 0;
    double volume = 0;
    double turned = 0;
    for (std::size_t i = 0; i < net_.pore_count(); ++i) {
      const double now = total_volume(pore_body_at(net_, pore_id(i)));
      volume += std::abs(now);
      if (triangulated_.volumes[i] > 0 && !(now > 0)) {
        ++out.turned_cells;
        turned += std::abs(now);
      }
      std::size_t e = triangulated_.first_edge[i];
      for_edges(net_, pore_id(i), [&](double length) {
        const double change = length / triangulated_.edges[e++] - 1;
        squares += change * change;
      });
    }
    const std::size_t edges = triangulated_.edges.size();
    out.strain = edges == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(edges));
    out.turned_volume = volume > 0 ? turned / volume : 0.0;
    return out;
  }

  /// Bound on the drag that each grain feels by its own motion [N s/m], at the last refresh: see bounds_of_drag. Always
  /// finite; it leaves out the facets of `sealed_grains`.
  [[nodiscard]] std::span<const double> drag_bounds() const noexcept { return found_.drag.values; }
  /// Grains with a facet beside pores that closed throats seal off: see drag_bounds::sealed.
  [[nodiscard]] std::span<const grain_id> sealed_grains() const noexcept { return found_.drag.sealed; }

  /// Bound on the step of an explicit integrator of the caller, for the forces of the fluid alone: 2 / max Γ/m [s].
  /// Walls that are moved by the fluid are not counted, nor facets of `sealed_grains`.
  /// \param masses  range of numbers, one per grain [kg]
  template <class Masses>
  [[nodiscard]] double largest_step(const Masses& masses) const {
    double fastest = 0;
    std::size_t i = 0;
    for (const auto& m : masses) {
      if (i < found_.drag.values.size()) {
        fastest = std::max(fastest, found_.drag.values[i] / static_cast<double>(m));
      }
      ++i;
    }
    if (i != found_.drag.values.size()) {
      throw parameter_error("masses", std::to_string(i), std::to_string(found_.drag.values.size()) + ", one per grain");
    }
    return fastest > 0 ? 2 / fastest : infinity<double>;
  }

  /// The semi-implicit step: an inertia of m + Γ dt/2 in place of m makes the forces of the fluid stable at any dt. It
  /// takes the part Γ (v_new − v_old) of the drag at the end of the step and is consistent to first order in dt; where
  /// the motion is slow it changes nothing.
  [[nodiscard]] std::vector<double> added_mass(double dt) const {
    std::vector<double> out(found_.drag.values.begin(), found_.drag.values.end());
    for (double& m : out) {
      m *= 0.5 * dt;
    }
    return out;
  }

  /// Bound on the step of the explicit pressure scheme [s]: the least V_void / (K_f Σ w) of a node; 0 without
  /// compressibility.
  [[nodiscard]] double largest_explicit_step() const noexcept { return found_.largest_explicit; }

  [[nodiscard]] const network& net() const noexcept { return net_; }
  [[nodiscard]] const saturated_flow<Law, Solver>& flow() const noexcept { return flow_; }
  [[nodiscard]] const pressure_field& pressure() const noexcept { return flow_.pressure(); }
  [[nodiscard]] pressure_field& pressure() noexcept { return flow_.pressure(); }
  void set_conditions(flow_conditions conditions) {
    flow_.set_conditions(std::move(conditions));
    found_ = gather();
  }
  /// Force of the fluid on each wall in the last step, pressure and shear [N].
  [[nodiscard]] const std::array<vec3<double>, 6>& wall_forces() const noexcept { return wall_forces_; }
  /// Of all steps.
  [[nodiscard]] const fluid_ledger& ledger() const noexcept { return ledger_; }
  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }
  [[nodiscard]] std::size_t steps_since_rebuild() const noexcept { return steps_since_rebuild_; }

 private:
  [[nodiscard]] static flow_options kept(flow_options flow) {
    flow.hydraulics = keep_hydraulics::yes;
    return flow;
  }

  /// The grains as the network keeps them; along periodic axes at the image nearest to where each was.
  template <class Grains>
  [[nodiscard]] std::vector<sphere<double>> followed(const Grains& grains, const box& bounds) {
    std::vector<sphere<double>> next = std::move(next_);
    next.clear();
    for (const auto& g : grains) {
      next.push_back(as_sphere(g));
    }
    if (next.size() != net_.grain_count()) {
      throw parameter_error("grains", std::to_string(next.size()), std::to_string(net_.grain_count()));
    }
    const vec3<double> size = bounds.size();
    for (std::size_t k = 0; k < 3; ++k) {
      if (!net_.region().is_periodic(k)) {
        continue;
      }
      for (std::size_t i = 0; i < next.size(); ++i) {
        next[i].centre[k] -= size[k] * std::round((next[i].centre[k] - net_.grains()[i].centre[k]) / size[k]);
      }
    }
    return next;
  }

  template <class Velocities>
  void take_velocities(const Velocities& velocities) {
    velocities_.clear();
    for (const auto& v : velocities) {
      velocities_.push_back(coordinates(v));
    }
    if (velocities_.size() != net_.grain_count()) {
      throw parameter_error("velocities", std::to_string(velocities_.size()), std::to_string(net_.grain_count()));
    }
  }

  void refresh() {
    measure(net_);
    flow_.update(flow_.system().conditions());
    found_ = gather();
    steps_since_refresh_ = 0;
  }

  /// Calls f(length) for the edges of a pore.
  template <class F>
  static void for_edges(const network& net, pore_id p, const F& f) {
    const pore_body<double> body = pore_body_at(net, p);
    for (std::size_t i = 0; i < body.grain_count; ++i) {
      for (std::size_t j = i + 1; j < body.grain_count; ++j) {
        f(norm(body.grains[j].centre - body.grains[i].centre));
      }
      for (std::size_t w = 0; w < body.wall_count(); ++w) {
        f(body.walls[w].distance(body.grains[i].centre));
      }
    }
  }

  /// Lengths of the edges of all pores, and volumes.
  struct lengths {
    std::vector<double> volumes;
    std::vector<double> edges;
    std::vector<std::size_t> first_edge;  ///< per pore
  };
  [[nodiscard]] static lengths lengths_of(const network& net) {
    lengths out;
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      out.volumes.push_back(net.volume(pore_id(i)));
      out.first_edge.push_back(out.edges.size());
      for_edges(net, pore_id(i), [&](double length) { out.edges.push_back(length); });
    }
    return out;
  }

  /// What follows from positions and conductances.
  struct findings {
    std::vector<std::array<double, 3>> shares;  ///< per throat: parts of its load that its vertices take
    tetrapore::drag_bounds drag;
    std::vector<double> storage;  ///< per node: void / bulk modulus [m³/Pa]
    double largest_explicit = 0;  ///< [s]
  };
  [[nodiscard]] findings gather() const {
    const flow_system& system = flow_.system();
    const flow_nodes& nodes = system.nodes();
    const std::vector<double>& w = flow_.conductances().values;
    findings out;
    out.shares.assign(net_.throat_count(), {});
    std::vector<double> open(nodes.size(), 0.0);
    for (std::size_t i = 0; i < net_.throat_count(); ++i) {
      const throat_id t(i);
      if (net_.is_boundary(t) || nodes.inside(net_, t)) {
        continue;
      }
      const throat<double> seen = nodes.throat_between(net_, t);
      const double area = norm(seen.area_vector);
      if (!(area > 0)) {
        continue;
      }
      const facet_load load = detail::load_of(sharing_, seen, t, flow_.conductances().hydraulics);
      for (std::size_t k = 0; k < 3; ++k) {
        out.shares[i][k] = (load.pressure[k] + load.viscous[k]) / area;
      }
      const auto& [a, b] = net_.pores(t);
      open[nodes[a]] += w[i];
      open[nodes[b]] += w[i];
    }
    out.drag = bounds_of_drag(net_, system, w, out.shares);
    out.storage.assign(nodes.size(), 0.0);
    if (!system.compressible()) {
      return out;
    }
    system.take_up(std::vector<double>(nodes.size(), -1.0), 1.0, out.storage);
    out.largest_explicit = infinity<double>;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (open[n] > 0 && !system.is_held(nodes.pore(n))) {
        out.largest_explicit = std::min(out.largest_explicit, out.storage[n] / open[n]);
      }
    }
    return out;
  }

  [[nodiscard]] bool has_turned_pores() const noexcept {
    return std::any_of(found_.storage.begin(), found_.storage.end(), [](double s) { return !(s >= 0); });
  }

  /// What drives the flow out of each pore: the pressure without the weight of the fluid.
  void drive() {
    driving_ = pressure_field(net_);
    for (std::size_t i = 0; i < driving_.size(); ++i) {
      const pore_id p(i);
      driving_[p] = flow_.pressure()[p] - flow_.system().pressure_at_rest(net_, p);
    }
  }
  [[nodiscard]] double drop(throat_id t) const noexcept {
    const auto& [a, b] = net_.pores(t);
    return driving_[a] - driving_[b] -
           dot(flow_.system().conditions().mean_gradient, net_.region().shift(net_.shift(t)));
  }

  /// Net flow out of each node through its throats [m³/s], at the present pressure.
  void sum_outflow() {
    const flow_nodes& nodes = flow_.system().nodes();
    drive();
    leaving_.assign(nodes.size(), 0.0);
    for (std::size_t i = 0; i < net_.throat_count(); ++i) {
      const throat_id t(i);
      const double w = flow_.conductances().values[i];
      if (w > 0) {
        const double q = w * drop(t);
        leaving_[nodes[net_.pores(t)[0]]] += q;
        leaving_[nodes[net_.pores(t)[1]]] -= q;
      }
    }
  }

  void advance_explicitly(double dt, std::span<const double> rates) {
    const flow_nodes& nodes = flow_.system().nodes();
    sum_outflow();
    const std::vector<double> entering = flow_.system().inflow(rates);
    for (std::size_t i = 0; i < net_.pore_count(); ++i) {
      const std::size_t n = nodes[pore_id(i)];
      if (!flow_.system().is_held(pore_id(i))) {
        flow_.pressure()[pore_id(i)] += dt * (entering[n] - leaving_[n]) / found_.storage[n];
      }
    }
  }

  /// Enters in the ledger what the step did with the fluid, and notes what it left unbalanced.
  void balance(double dt, std::span<const double> rates, coupling_report& report) {
    const flow_nodes& nodes = flow_.system().nodes();
    if (options_.scheme == pressure_scheme::implicit_step) {
      sum_outflow();
    } else {
      drive();  // the flow was that of the old pressure
    }
    const std::vector<double> entering = flow_.system().inflow(rates);
    const std::vector<double> imposed = flow_.system().inflow({});
    const bool ties = report.solve.floating_clusters == 0;
    std::fill(unbalanced_.values().begin(), unbalanced_.values().end(), 0.0);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const pore_id p = nodes.pore(n);
      const double stored = found_.storage[n] * (flow_.pressure()[p] - old_[p.index()]);
      const double left = (entering[n] - leaving_[n]) * dt - stored;
      report.fluid.injected += imposed[n] * dt;
      report.fluid.throughput += std::abs(imposed[n]) * dt;
      report.fluid.stored += stored;
      if (flow_.system().is_held(p)) {
        report.fluid.outflow += left;
        report.fluid.throughput += std::abs(left);
      } else if (ties) {
        unbalanced_[p] = left;
      }
    }
  }

  template <class Forces>
  void add_forces(Forces& forces) {
    const vec3<double> slope = flow_.system().fluid().hydrostatic_gradient();
    wall_forces_ = pressure_on_walls(net_, driving_);
    fluid_.assign(net_.grain_count(), {});
    if (slope != vec3<double>{}) {
      fluid_ = buoyancy(net_, flow_.system().fluid());
      add_hydrostatic_walls(slope);
    }
    for (std::size_t i = 0; i < net_.throat_count(); ++i) {
      const throat_id t(i);
      if (net_.is_boundary(t)) {
        continue;
      }
      const double fall = drop(t);
      if (fall == 0) {
        continue;
      }
      const vec3<double> push = detail::facet_at(net_, t).area_vector * fall;
      const pore_id a = net_.pores(t)[0];
      const auto slots = facet_slots(net_, a, net_.slot(t, 0));
      for (std::size_t k = 0; k < 3; ++k) {
        const vertex v = net_.vertices(a)[slots[k]];
        (v.is_wall() ? wall_forces_[static_cast<std::size_t>(v.wall())] : fluid_[v.grain().index()]) +=
            push * found_.shares[i][k];
      }
    }
    std::size_t g = 0;
    for (auto&& f : forces) {
      detail::add_to(f, fluid_[g++]);
    }
  }

  void add_hydrostatic_walls(const vec3<double>& slope) {
    const vec3<double> size = net_.region().bounds.size();
    for (const face f : all_faces) {
      if (net_.region().is_wall(f)) {
        const std::size_t k = axis_of(f);
        vec3<double> middle = size * 0.5;
        middle[k] = is_max(f) ? size[k] : 0.0;
        const double area = size[(k + 1) % 3] * size[(k + 2) % 3];
        wall_forces_[static_cast<std::size_t>(f)] -= net_.region().wall(f).normal * (dot(slope, middle) * area);
      }
    }
  }

  network net_;
  coupling_options options_;
  Sharing sharing_;
  saturated_flow<Law, Solver> flow_;
  fluid_ledger ledger_;
  field<quantity::extensive> unbalanced_;  ///< per pore, at the first of each node [m³]
  std::size_t steps_ = 0;
  std::size_t steps_since_refresh_ = 0;
  std::size_t steps_since_rebuild_ = 0;
  lengths triangulated_;  ///< of the last triangulation
  findings found_;        ///< of the last refresh
  // of the last step
  std::array<vec3<double>, 6> wall_forces_{};
  std::vector<sphere<double>> next_;
  std::vector<vec3<double>> velocities_;
  std::vector<double> old_;
  pressure_field driving_;
  std::vector<double> leaving_;
  std::vector<vec3<double>> fluid_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
