// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/simulation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

/// \file
/// storage::moments: density and momentum of each component in place of its populations.
///
/// With one relaxation time of 1 what leaves a node is the equilibrium: a function of density and velocity. So a step
/// works out what leaves the nodes of a plane, as the few numbers of detail::outgoing, keeps that of three planes, and
/// sums what arrives in the middle one. Only moments are read from and written to memory.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

template <class Model, std::floating_point T, int Lanes>
class simulation<Model, T, storage::moments, Lanes> : public detail::surroundings<Model, T, Lanes, false> {
  static_assert(
      requires { requires Model::collision_type::equilibrium_at_one; } && !Model::forcing_type::carries_source,
      "storage::moments takes bgk or regularised with tau = 1 and velocity_shift: other nodes send more than density "
      "and "
      "momentum tell");
  using base = detail::surroundings<Model, T, Lanes, false>;

 public:
  using base::components;
  using base::directions;
  using typename base::densities;
  using typename base::lattice_type;

  /// All nodes at the mixture's reference densities, at rest; walls and reservoirs show them too.
  simulation(const Model& model, site_map<lattice_type> map) : base(model, std::move(map), true) {
    for (const auto& c : model_.collisions) {
      if (c.tau != 1) {
        throw parameter_error("collision", "tau = " + short_number(c.tau), "1 where moments alone are kept");
      }
    }
    constexpr std::size_t room = 4 * beyond;
    state_step_ = apart(rows_.cells() + room);
    state_.assign(components * moments * state_step_ + beyond, T(0));
    std::size_t most = rows_.longest() + 2;
    for (const auto& p : rows_.planes()) {
      most = std::max(most, static_cast<std::size_t>(p.last_cell - p.first_cell));
    }
    plane_step_ = (most + room) / per_line * per_line;
    sent_step_ = apart(buffers * plane_step_);
    sent_.assign(components * outgoing * sent_step_ + beyond, T(0));
    make_detours();
    for (std::size_t n = 0; n < map_.size(); ++n) {
      if (map_.at(n).kind == site_kind::reservoir) {
        held_.push_back({rows_.cell(n), map_.at(n).tag});
      }
    }
    for (std::size_t x = 0; x <= map_.plane_count(); ++x) {
      const auto first = x < map_.plane_count() ? rows_.planes()[x].first_cell : rows_.idle();
      held_of_.push_back(static_cast<std::size_t>(
          std::lower_bound(held_.begin(), held_.end(), first,
                           [](const held_node& h, std::int32_t cell) { return h.cell < cell; }) -
          held_.begin()));
    }
  }

  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

  /// Densities and velocity of every node: `of(place, rho, u)` fills them. Populations become the equilibrium.
  template <class Of>
    requires std::invocable<Of&, const std::array<int, 3>&, densities&, std::array<double, 3>&>
  void initialise(Of of) {
    for (std::size_t n = 0; n < map_.size(); ++n) {
      densities rho = model_.reference;
      std::array<double, 3> u{};
      of(map_.place(n), rho, u);
      for (std::size_t c = 0; c < components; ++c) {
        relaxation_target<T> t;
        t.rho = static_cast<T>(rho[c]);
        t.excess = static_cast<T>(rho[c] - model_.reference[c]);
        for (std::size_t a = 0; a < 3; ++a) {
          t.velocity[a] = static_cast<T>(u[a]);
        }
        T f[directions];
        Model::fill(t, f);
        moment(c, n, 0) = Model::excess_of(f);
        detail::repeat<axes>([&]<int A>(detail::number<A>)
                                 TETRAPORE_INLINE { moment(c, n, 1 + A) = detail::first_moment<lattice_type, A>(f); });
      }
    }
  }

  void step() {
    for (std::size_t c = 0; stale_ && c < components; ++c) {
      for (std::size_t x = 0; x < map_.plane_count(); ++x) {
        show(x, c);
      }
    }
    stale_ = false;
    sweep();
    ++steps_;
  }
  void run(std::size_t times) {
    for (std::size_t k = 0; k < times; ++k) {
      step();
    }
  }

  /// Numbers that are kept of a node and component: the whole state of a simulation.
  static constexpr std::size_t moments = 1 + static_cast<std::size_t>(lattice_type::dimensions);
  /// Of the populations that arrive at a node: their sum (k = 0), which is the density less the reference, or their
  /// momentum along axis k − 1.
  [[nodiscard]] T& moment(std::size_t component, std::size_t node, std::size_t k) noexcept {
    stale_ = true;
    return state(component, k)[rows_.cell(node)];
  }
  [[nodiscard]] const T& moment(std::size_t component, std::size_t node, std::size_t k) const noexcept {
    return state_[(component * moments + k) * state_step_ + static_cast<std::size_t>(rows_.cell(node))];
  }

  [[nodiscard]] double density(std::size_t component, std::size_t node) const noexcept {
    return model_.reference[component] + static_cast<double>(moment(component, node, 0));
  }
  [[nodiscard]] densities densities_at(std::size_t node) const noexcept {
    densities rho{};
    for (std::size_t c = 0; c < components; ++c) {
      rho[c] = density(c, node);
    }
    return rho;
  }
  /// The velocity of the mixture, half of the force included.
  [[nodiscard]] std::array<double, 3> velocity(std::size_t node) const noexcept {
    double excess[components];
    double momentum[components][3]{};
    double psi[components][directions];
    for (std::size_t c = 0; c < components; ++c) {
      excess[c] = static_cast<double>(moment(c, node, 0));
      for (std::size_t a = 0; a < axes; ++a) {
        momentum[c][a] = static_cast<double>(moment(c, node, 1 + a));
      }
      for (std::size_t i = 0; i < directions; ++i) {
        psi[c][i] = this->psi_of(c, map_.seen(node, static_cast<int>(i)),
                                 [this](std::size_t of, std::size_t n) { return density(of, n); });
      }
    }
    double u[3];
    model_.flow(
        excess, momentum,
        [&]<int C, int I>(detail::number<C>, detail::number<I>) TETRAPORE_INLINE { return psi[C][I]; }, u);
    return {u[0], u[1], u[2]};
  }
  /// Mass of a component in all nodes that are no reservoir.
  [[nodiscard]] double mass(std::size_t component) const noexcept {
    return this->mass_of(component,
                         [&](std::size_t n, auto add) { add(static_cast<double>(moment(component, n, 0))); });
  }

 private:
  using base::beyond;
  using base::map_;
  using base::model_;
  using base::per_line;
  using base::reservoirs_;
  using base::rows_;
  using base::width;
  using typename base::layout_type;
  using typename base::run_type;
  static constexpr int axes = lattice_type::dimensions;
  using number = pack<T, Lanes>;
  using sent_by = detail::outgoing<lattice_type, number>;
  static constexpr std::size_t outgoing = sent_by::numbers;

  /// Planes whose outgoing numbers are kept: three in turn, the first and the last, which a periodic box needs at both
  /// ends of a step, and one of nodes that send nothing.
  static constexpr std::size_t buffers = 6;

  struct held_node {
    std::int32_t cell;
    std::uint8_t tag;
  };
  /// Nodes side by side, to some of which walls return what they send.
  struct walled_batch {
    std::int32_t to;
    std::int32_t from;        ///< + the beginning of its plane's buffer
    std::size_t first, last;  ///< of `returns_`
  };
  struct returned {
    std::uint32_t lanes;
    std::uint8_t departs;
  };
  /// Nodes that get what arrives in a direction from another than their neighbour, from as many senders.
  struct detour_batch {
    std::int32_t to[width];
    std::int32_t from[width];  ///< + the beginning of its plane's buffer
    std::uint32_t used;
    std::uint8_t arrives, departs;  ///< directions
  };

  /// A direction in numbers.
  struct course {
    T weight;
    T along[static_cast<std::size_t>(axes)];
  };
  static constexpr std::array<course, directions> courses = [] {
    std::array<course, directions> all{};
    for (std::size_t i = 0; i < directions; ++i) {
      all[i].weight = static_cast<T>(lattice_type::weight[i]);
      for (std::size_t a = 0; a < axes; ++a) {
        all[i].along[a] = static_cast<T>(lattice_type::velocity[i][a]);
      }
    }
    return all;
  }();

  [[nodiscard]] T* state(std::size_t c, std::size_t k) noexcept {
    return state_.data() + (c * moments + k) * state_step_;
  }
  [[nodiscard]] T* sent(std::size_t c, std::size_t k) noexcept {
    return sent_.data() + (c * outgoing + k) * sent_step_;
  }

  /// At least so many numbers between arrays that are worked on together; they do not share a set of the cache.
  [[nodiscard]] static constexpr std::size_t apart(std::size_t numbers) noexcept {
    const std::size_t lines = numbers / per_line + 1;
    return (lines + (27 + 64 - lines % 64) % 64) * per_line;
  }
  [[nodiscard]] std::size_t buffer_of(std::size_t x) const noexcept {
    return (x == 0 ? 3 : x + 1 == map_.plane_count() ? 4 : x % 3) * plane_step_;
  }
  /// Where what a node sends is kept while its plane is needed.
  [[nodiscard]] std::int32_t buffered(std::size_t node) const noexcept {
    const auto x = static_cast<std::size_t>(map_.place(node)[0]);
    return rows_.cell(node) - rows_.planes()[x].first_cell + static_cast<std::int32_t>(buffer_of(x));
  }

  void make_detours() {
    for (const auto& p : rows_.planes()) {
      detours_of_.push_back(detours_.size());
      walled_of_.push_back(walled_.size());
      using entry = std::tuple<int, int, std::int32_t, std::int32_t>;
      std::vector<entry> all;
      std::vector<std::pair<std::size_t, std::uint8_t>> returns;
      for (std::size_t d = p.first_detour; d < p.last_detour; ++d) {
        const auto& detour = rows_.detours()[d];
        const auto n = static_cast<std::size_t>(detour.node);
        const auto to = map_.leaving(n, detour.direction);  // what leaves `to` against `as` arrives against direction
        if (static_cast<std::size_t>(to.to) == n && to.as == opposite(detour.direction)) {
          returns.emplace_back(n, detour.direction);
          continue;
        }
        all.emplace_back(opposite(detour.direction), opposite(to.as), rows_.cell(n),
                         buffered(static_cast<std::size_t>(to.to)));
      }
      add_walled(returns);
      std::sort(all.begin(), all.end());
      for (std::size_t k = 0; k < all.size();) {
        detour_batch b{};
        b.arrives = static_cast<std::uint8_t>(std::get<0>(all[k]));
        b.departs = static_cast<std::uint8_t>(std::get<1>(all[k]));
        std::size_t lane = 0;
        for (; lane < width && k < all.size() && std::get<0>(all[k]) == b.arrives && std::get<1>(all[k]) == b.departs;
             ++lane, ++k) {
          b.to[lane] = std::get<2>(all[k]);
          b.from[lane] = std::get<3>(all[k]);
        }
        b.used = static_cast<std::uint32_t>(lane);
        detours_.push_back(b);
      }
    }
    detours_of_.push_back(detours_.size());
    walled_of_.push_back(walled_.size());
  }
  void add_walled(std::vector<std::pair<std::size_t, std::uint8_t>>& returns) {
    std::sort(returns.begin(), returns.end());
    for (std::size_t k = 0; k < returns.size();) {
      const std::int32_t to = rows_.cell(returns[k].first);
      walled_batch b{to, buffered(returns[k].first), returns_.size(), 0};
      std::uint32_t lanes_of[directions]{};
      for (; k < returns.size() && rows_.cell(returns[k].first) < to + Lanes; ++k) {
        lanes_of[returns[k].second] |= 1U << static_cast<unsigned>(rows_.cell(returns[k].first) - to);
      }
      for (std::size_t i = 1; i < directions; ++i) {
        if (lanes_of[i] != 0) {
          returns_.push_back({lanes_of[i], static_cast<std::uint8_t>(i)});
        }
      }
      b.last = returns_.size();
      walled_.push_back(b);
    }
  }

  void sweep() {
    const std::size_t planes = map_.plane_count();
    const bool wrap = map_.box().low[0] == face_kind::periodic;
    for (std::size_t c = 0; c < components; ++c) {
      T* const psi = this->psi(c);
      for (const held_node& h : held_) {
        psi[h.cell] = static_cast<T>(model_.potential(reservoirs_[h.tag][c]));
      }
      this->show_copies(c, 0, rows_.copies().size());
    }
    this->show_images(0, this->images_.size());
    if (wrap) {
      send(planes - 1);
    }
    std::size_t sent = 0;
    for (std::size_t x = 0; x < planes; ++x) {
      for (; sent < std::min(x + 2, planes); ++sent) {
        if (!(wrap && sent + 1 == planes)) {
          send(sent);
        }
      }
      receive(x);
    }
  }

  /// What leaves the nodes of a plane.
  void send(std::size_t x) {
    const auto& p = rows_.planes()[x];
    const Model model = model_;
    T* const to = sent_.data() + buffer_of(x);
    const number nothing(T(0));
    std::ptrdiff_t end = 0;  // of what has been written; other cells send nothing
    const auto clear = [&](std::ptrdiff_t upto) {
      for (; end < upto; end += Lanes) {
        for (std::size_t k = 0; k < components * outgoing; ++k) {
          nothing.store(to + k * sent_step_ + end);
        }
      }
    };
    for (std::size_t r = p.first_run; r < p.last_run; ++r) {
      const run_type& run = rows_.runs()[r];
      const auto& by = rows_.tables()[static_cast<std::size_t>(run.table)];
      const T* seen[components][directions];
      for (std::size_t c = 0; c < components; ++c) {
        const T* const psi = this->psi(c) + run.cell;
        for (std::size_t k = 0; k < directions; ++k) {
          seen[c][k] = psi + by.seen[k];
        }
      }
      const T* const from = state_.data() + run.cell;
      const std::ptrdiff_t first = run.cell - p.first_cell;
      clear(first);
      for (std::ptrdiff_t n = 0; n < run.nodes; n += Lanes) {
        model.template depart<number>(
            [&]<int C, int K>(detail::number<C>, detail::number<K>) TETRAPORE_INLINE {
              return number::load(from + (static_cast<std::size_t>(C) * moments + K) * state_step_ + n);
            },
            [&]<int C, int I>(detail::number<C>, detail::number<I>)
                TETRAPORE_INLINE { return number::load(seen[C][I] + n); },
            [&]<int C, int K>(detail::number<C>, detail::number<K>, const number& value) TETRAPORE_INLINE {
              value.store(to + (static_cast<std::size_t>(C) * outgoing + K) * sent_step_ + first + n);
            });
      }
      end = first + run.nodes;
      if (const std::ptrdiff_t over = run.nodes % Lanes; over != 0) {
        for (std::size_t k = 0; k < components * outgoing; ++k) {
          T* const last = to + k * sent_step_ + end - over;
          number::select(base::lanes_of(over), number::load(last), nothing).store(last);
        }
        end += Lanes - over;
      }
    }
    clear(p.last_cell - p.first_cell);
    for (std::size_t h = held_of_[x]; h < held_of_[x + 1]; ++h) {
      hold(held_[h], to + (held_[h].cell - p.first_cell));
    }
  }
  /// What leaves a node of a reservoir: its densities at the velocity of what came in.
  void hold(const held_node& h, T* to) {
    T mass(0);
    T carried[3]{};
    for (std::size_t c = 0; c < components; ++c) {
      mass += static_cast<T>(model_.reference[c]) + state(c, 0)[h.cell];
      for (std::size_t a = 0; a < axes; ++a) {
        carried[a] += state(c, 1 + a)[h.cell];
      }
    }
    for (std::size_t c = 0; c < components; ++c) {
      relaxation_target<T> t;
      t.rho = static_cast<T>(reservoirs_[h.tag][c]);
      t.excess = t.rho - static_cast<T>(model_.reference[c]);
      for (std::size_t a = 0; a < 3; ++a) {
        t.velocity[a] = carried[a] * (T(1) / mass);
      }
      const detail::outgoing<lattice_type, T> o(t);
      for (std::size_t k = 0; k < outgoing; ++k) {
        to[(c * outgoing + k) * sent_step_] = o.at[k];
      }
    }
  }

  /// The moments of what arrives in a plane.
  void receive(std::size_t x) {
    const auto& p = rows_.planes()[x];
    T* const state = state_.data();
    const T* const sent = sent_.data();
    const std::size_t sent_step = sent_step_;
    const std::size_t state_step = state_step_;
    std::array<std::ptrdiff_t, directions> plane{};  // the buffer of the plane that direction i comes from
    const auto planes = static_cast<int>(map_.plane_count());
    for (std::size_t i = 0; i < directions; ++i) {
      const int from = (static_cast<int>(x) - lattice_type::velocity[i][0] + planes) % planes;
      plane[i] = static_cast<std::ptrdiff_t>(buffer_of(static_cast<std::size_t>(from))) -
                 rows_.planes()[static_cast<std::size_t>(from)].first_cell;
    }
    const auto silent = static_cast<std::ptrdiff_t>((buffers - 1) * plane_step_);
    for (std::size_t r = p.first_run; r < p.last_run; ++r) {
      const run_type& run = rows_.runs()[r];
      const auto& by = rows_.tables()[static_cast<std::size_t>(run.table)];
      const T* from[directions];
      for (std::size_t i = 0; i < directions; ++i) {
        const auto k = static_cast<std::size_t>(opposite(static_cast<int>(i)));
        from[i] = sent + ((by.turned >> k & 1U) != 0 ? silent : plane[i] + run.cell + by.seen[k]);
      }
      T* const to = state + run.cell;
      number kept[components * moments];
      const std::ptrdiff_t whole = run.nodes / Lanes * Lanes;
      for (std::size_t k = 0; k < components * moments; ++k) {
        kept[k] = number::load(to + k * state_step + whole);
      }
      for (std::ptrdiff_t n = 0; n < run.nodes; n += Lanes) {
        Model::template arrive<number>(
            [&]<int C, int I, int K>(detail::number<C>, detail::number<I>, detail::number<K>) TETRAPORE_INLINE {
              return number::load(from[I] + n + (static_cast<std::size_t>(C) * outgoing + K) * sent_step);
            },
            [&]<int C, int K>(detail::number<C>, detail::number<K>, const number& value)
                TETRAPORE_INLINE { value.store(to + (static_cast<std::size_t>(C) * moments + K) * state_step + n); });
      }
      if (whole < run.nodes) {
        for (std::size_t k = 0; k < components * moments; ++k) {
          T* const last = to + k * state_step + whole;
          number::select(base::lanes_of(run.nodes - whole), number::load(last), kept[k]).store(last);
        }
      }
    }
    for (std::size_t w = walled_of_[x]; w < walled_of_[x + 1]; ++w) {
      bounce(walled_[w]);
    }
    for (std::size_t d = detours_of_[x]; d < detours_of_[x + 1]; ++d) {
      redirect(detours_[d]);
    }
    for (std::size_t c = 0; c < components; ++c) {
      show(x, c);
    }
  }
  /// What walls return to nodes side by side.
  void bounce(const walled_batch& b) {
    for (std::size_t c = 0; c < components; ++c) {
      number at[outgoing];
      for (std::size_t k = 1; k < outgoing; ++k) {
        at[k] = number::load(sent(c, k) + b.from);
      }
      number sum[moments];
      for (std::size_t k = 0; k < moments; ++k) {
        sum[k] = number::load(state(c, k) + b.to);
      }
      for (std::size_t r = b.first; r < b.last; ++r) {
        const course& way = courses[returns_[r].departs];
        number cu = number(way.along[0]) * at[3];
        detail::repeat<axes - 1>([&]<int A>(detail::number<A>)
                                     TETRAPORE_INLINE { cu = cu + number(way.along[A + 1]) * at[4 + A]; });
        const number f = number::select(returns_[r].lanes, sent_by::in_direction(number(way.weight), at[1], at[2], cu),
                                        number(T(0)));
        sum[0] = sum[0] + f;
        detail::repeat<axes>([&]<int A>(detail::number<A>)
                                 TETRAPORE_INLINE { sum[1 + A] = sum[1 + A] - number(way.along[A]) * f; });
      }
      for (std::size_t k = 0; k < moments; ++k) {
        sum[k].store(state(c, k) + b.to);
      }
    }
  }
  void redirect(const detour_batch& b) {
    const auto& out = lattice_type::velocity[b.departs];
    const auto& in = lattice_type::velocity[b.arrives];
    const number weight(static_cast<T>(lattice_type::weight[b.departs]));
    alignas(detail::cache_line) T row[width];
    const auto gather = [&](const T* from) {
      for (std::size_t lane = 0; lane < width; ++lane) {
        row[lane] = from[b.from[lane]];
      }
      return number::load(row);
    };
    for (std::size_t c = 0; c < components; ++c) {
      number cu(T(0));
      for (std::size_t a = 0; a < axes; ++a) {
        if (out[a] != 0) {
          cu = cu + number(static_cast<T>(out[a])) * gather(sent(c, 3 + a));
        }
      }
      sent_by::in_direction(weight, gather(sent(c, 1)), gather(sent(c, 2)), cu).store(row);
      const auto scatter = [&](T* to, T sign) {
        for (std::size_t lane = 0; lane < b.used; ++lane) {
          to[b.to[lane]] += sign * row[lane];
        }
      };
      scatter(state(c, 0), T(1));
      for (std::size_t a = 0; a < axes; ++a) {
        if (in[a] != 0) {
          scatter(state(c, 1 + a), static_cast<T>(in[a]));
        }
      }
    }
  }
  /// ψ of the nodes of a plane.
  void show(std::size_t x, std::size_t c) {
    const auto& p = rows_.planes()[x];
    const number reference(static_cast<T>(model_.reference[c]));
    const auto potential = model_.potential;
    for (std::size_t r = p.first_run; r < p.last_run; ++r) {
      const run_type& run = rows_.runs()[r];
      T* const psi = this->psi(c) + run.cell;
      const T* const excess = state(c, 0) + run.cell;
      std::ptrdiff_t n = 0;
      for (; n + Lanes <= run.nodes; n += Lanes) {
        potential(reference + number::load(excess + n)).store(psi + n);
      }
      if (n < run.nodes) {
        const number shown = potential(reference + number::load(excess + n));
        number::select(base::lanes_of(run.nodes - n), shown, number::load(psi + n)).store(psi + n);
      }
    }
  }

  std::size_t steps_ = 0;
  bool stale_ = true;  ///< whether ψ has to be worked out from the moments
  std::size_t state_step_ = 0;
  std::size_t plane_step_ = 0;
  std::size_t sent_step_ = 0;
  detail::aligned_vector<T> state_;  ///< moments of all cells, one behind the other, component by component
  detail::aligned_vector<T> sent_;   ///< outgoing numbers of the planes in use, likewise
  std::vector<detour_batch> detours_;
  std::vector<std::size_t> detours_of_;  ///< where the batches of each plane begin
  std::vector<walled_batch> walled_;
  std::vector<returned> returns_;
  std::vector<std::size_t> walled_of_;
  std::vector<held_node> held_;
  std::vector<std::size_t> held_of_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
