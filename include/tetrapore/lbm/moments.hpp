// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/simulation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// \file
/// storage::moments: density and momentum of each component in place of its populations.
///
/// With one relaxation time of 1 what leaves a node is the equilibrium: a function of density and velocity. So a step
/// works out what leaves the nodes of a plane, keeps that of three planes in the cache, and sums what arrives in the
/// middle one. Only moments are read from and written to memory.

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
  simulation(const Model& model, site_map<lattice_type> map) : base(model, std::move(map), true, width) {
    for (const auto& c : model_.collisions) {
      if (c.tau != 1) {
        throw parameter_error("collision", "tau = " + short_number(c.tau), "1 where moments alone are kept");
      }
    }
    constexpr std::size_t room = 4 * beyond;
    state_step_ = apart(rows_.cells() + room);
    state_.assign(components * moments * state_step_ + beyond, T(0));
    std::size_t most = 0;
    for (const auto& p : rows_.planes()) {
      most = std::max(most, static_cast<std::size_t>(p.last_cell - p.first_cell));
    }
    plane_step_ = (most + room) / per_line * per_line;
    sent_step_ = apart(buffers * plane_step_);
    sent_.assign(components * directions * sent_step_ + beyond, T(0));
    for (const auto& l : rows_.links()) {
      links_.push_back({buffered(l.cell), buffered(l.gate)});
    }
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      for (std::size_t r = rows_.planes()[x].first_run; r < rows_.planes()[x].last_run; ++r) {
        senders_.push_back(senders_of(x, rows_.runs()[r]));
      }
    }
    make_held();
  }

  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

  /// Densities and velocity of every node: `of(place, rho, u)` fills them. Populations become the equilibrium.
  template <class Of>
    requires std::invocable<Of&, const std::array<int, 3>&, densities&, std::array<double, 3>&>
  void initialise(Of of) {
    this->lay_equilibria(of, [&](std::size_t c, std::size_t n, const T(&f)[directions]) {
      moment(c, n, 0) = Model::excess_of(f);
      detail::repeat<axes>([&]<int A>(detail::number<A>)
                               TETRAPORE_INLINE { moment(c, n, 1 + A) = detail::first_moment<lattice_type, A>(f); });
    });
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

  /// Planes whose populations are kept: three in turn, the first and the last, which a periodic box needs at both ends
  /// of a step.
  static constexpr std::size_t buffers = 5;

  /// Nodes of a reservoir.
  struct held_batch {
    std::int32_t cell[width];
    std::int32_t to[width];  ///< less the beginning of the plane's buffer
    std::size_t used;
    std::uint8_t tag;
  };
  using senders = std::array<std::uint32_t, directions>;
  /// What arrives from a cell that is no node, and where it has left.
  struct link {
    std::uint32_t cell;
    std::uint32_t from;
  };

  [[nodiscard]] T* state(std::size_t c, std::size_t k) noexcept {
    return state_.data() + (c * moments + k) * state_step_;
  }
  /// At least so many numbers between arrays that are worked on together; they do not share a set of the cache.
  [[nodiscard]] static constexpr std::size_t apart(std::size_t numbers) noexcept {
    const std::size_t lines = numbers / per_line + 1;
    return (lines + (27 + 64 - lines % 64) % 64) * per_line;
  }
  [[nodiscard]] std::size_t buffer_of(std::size_t x) const noexcept {
    return (x == 0 ? 3 : x + 1 == map_.plane_count() ? 4 : x % 3) * plane_step_;
  }
  /// Where the population is kept while its plane is needed that leaves a cell against the one which the layout
  /// stores at a place.
  [[nodiscard]] std::uint32_t buffered(std::size_t place) const noexcept {
    const auto slot = static_cast<std::size_t>(opposite(static_cast<int>(place / rows_.stride())));
    const auto cell = static_cast<std::int32_t>(place % rows_.stride());
    std::size_t x = 0;
    while (cell >= rows_.planes()[x].last_cell) {
      ++x;
    }
    return static_cast<std::uint32_t>(slot * sent_step_ + buffer_of(x) +
                                      static_cast<std::size_t>(cell - rows_.planes()[x].first_cell));
  }

  /// Where what arrives at the first node of a run of plane x in each direction has left.
  [[nodiscard]] senders senders_of(std::size_t x, const run_type& run) const noexcept {
    const auto& by = rows_.tables()[static_cast<std::size_t>(run.table)];
    const auto planes = static_cast<int>(map_.plane_count());
    const bool wrap = map_.box().low[0] == face_kind::periodic;
    senders from{};
    for (std::size_t k = 0; k < directions; ++k) {
      const auto offset = static_cast<std::ptrdiff_t>(by.to[k]) -
                          static_cast<std::ptrdiff_t>(by.as[k] * rows_.stride());  // of the cell in direction k
      int there = static_cast<int>(x);
      if (const int next = there + lattice_type::velocity[k][0]; offset != 0 && next >= 0 && next < planes) {
        there = next;
      } else if (offset != 0 && wrap) {
        there = (next + planes) % planes;
      }
      const auto plane = static_cast<std::size_t>(there);
      const auto slot = static_cast<std::size_t>(opposite(by.as[k]));
      from[static_cast<std::size_t>(opposite(static_cast<int>(k)))] =
          static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(slot * sent_step_ + buffer_of(plane)) + run.cell +
                                     offset - rows_.planes()[plane].first_cell);
    }
    return from;
  }

  void make_held() {
    held_of_.push_back(0);
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      std::vector<std::pair<std::uint8_t, std::int32_t>> all;
      for (auto n = static_cast<std::size_t>(map_.plane_begin(x));
           n < static_cast<std::size_t>(map_.plane_begin(x + 1)); ++n) {
        if (map_.at(n).kind == site_kind::reservoir) {
          all.emplace_back(map_.at(n).tag, rows_.cell(n));
        }
      }
      std::sort(all.begin(), all.end());
      for (std::size_t k = 0; k < all.size();) {
        held_batch b{};
        b.tag = all[k].first;
        for (; b.used < width && k < all.size() && all[k].first == b.tag; ++k, ++b.used) {
          b.cell[b.used] = all[k].second;
          b.to[b.used] = all[k].second - rows_.planes()[x].first_cell;
        }
        for (std::size_t lane = b.used; lane < width; ++lane) {
          b.cell[lane] = b.cell[0];
        }
        held_.push_back(b);
      }
      held_of_.push_back(held_.size());
    }
  }

  void sweep() {
    const std::size_t planes = map_.plane_count();
    const bool wrap = map_.box().low[0] == face_kind::periodic;
    for (std::size_t c = 0; c < components; ++c) {
      T* const psi = this->psi(c);
      for (const held_batch& h : held_) {
        const auto shown = static_cast<T>(model_.potential(reservoirs_[h.tag][c]));
        for (std::size_t lane = 0; lane < h.used; ++lane) {
          psi[h.cell[lane]] = shown;
        }
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

  /// What leaves the nodes of a plane. Numbers beyond the end of a run are nobody's or written later.
  void send(std::size_t x) {
    const auto& p = rows_.planes()[x];
    const Model model = model_;
    const std::size_t sent_step = sent_step_;
    const std::size_t state_step = state_step_;
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
      T* const to = sent_.data() + buffer_of(x) + (run.cell - p.first_cell);
      for (std::ptrdiff_t n = 0; n < run.nodes; n += Lanes) {
        model.template depart<number>(
            [&]<int C, int K>(detail::number<C>, detail::number<K>) TETRAPORE_INLINE {
              return number::load(from + (static_cast<std::size_t>(C) * moments + K) * state_step + n);
            },
            [&]<int C, int I>(detail::number<C>, detail::number<I>)
                TETRAPORE_INLINE { return number::load(seen[C][I] + n); },
            [&]<int C, int I>(detail::number<C>, detail::number<I>, const number& value)
                TETRAPORE_INLINE { value.store(to + (static_cast<std::size_t>(C) * directions + I) * sent_step + n); });
      }
    }
    for (std::size_t h = held_of_[x]; h < held_of_[x + 1]; ++h) {
      hold(held_[h], sent_.data() + buffer_of(x));
    }
  }
  /// What leaves nodes of a reservoir: its densities at the velocity of what came in.
  void hold(const held_batch& b, T* sent) {
    alignas(detail::cache_line) T row[width];
    const auto gather = [&](const T* from) {
      for (std::size_t lane = 0; lane < width; ++lane) {
        row[lane] = from[b.cell[lane]];
      }
      return number::load(row);
    };
    number mass(T(0));
    number carried[3]{number(T(0)), number(T(0)), number(T(0))};
    for (std::size_t c = 0; c < components; ++c) {
      mass = mass + (number(static_cast<T>(model_.reference[c])) + gather(state(c, 0)));
      for (std::size_t a = 0; a < axes; ++a) {
        carried[a] = carried[a] + gather(state(c, 1 + a));
      }
    }
    const number inverse = number(T(1)) / mass;
    for (std::size_t c = 0; c < components; ++c) {
      relaxation_target<number> t;
      t.rho = number(static_cast<T>(reservoirs_[b.tag][c]));
      t.excess = t.rho - number(static_cast<T>(model_.reference[c]));
      for (std::size_t a = 0; a < 3; ++a) {
        t.velocity[a] = carried[a] * inverse;
      }
      number f[directions];
      Model::fill(t, f);
      for (std::size_t i = 0; i < directions; ++i) {
        f[i].store(row);
        T* const to = sent + (c * directions + i) * sent_step_;
        for (std::size_t lane = 0; lane < b.used; ++lane) {
          to[b.to[lane]] = row[lane];
        }
      }
    }
  }

  /// The moments of what arrives in a plane, and ψ.
  void receive(std::size_t x) {
    const auto& p = rows_.planes()[x];
    for (std::size_t c = 0; c < components; ++c) {
      T* const f = sent_.data() + c * directions * sent_step_;
      for (std::size_t k = p.first_link; k < p.last_link; ++k) {
        f[links_[k].cell] = f[links_[k].from];
      }
    }
    const std::size_t component_step = directions * sent_step_;
    const std::size_t state_step = state_step_;
    for (std::size_t r = p.first_run; r < p.last_run; ++r) {
      const run_type& run = rows_.runs()[r];
      const T* from[directions];
      for (std::size_t i = 0; i < directions; ++i) {
        from[i] = sent_.data() + senders_[r][i];
      }
      T* const to = state_.data() + run.cell;
      const auto all = [&](std::ptrdiff_t n, auto give) TETRAPORE_INLINE {
        Model::template arrive<number>(
            [&]<int C, int I>(detail::number<C>, detail::number<I>)
                TETRAPORE_INLINE { return number::load(from[I] + n + static_cast<std::size_t>(C) * component_step); },
            give);
      };
      std::ptrdiff_t n = 0;
      for (; n + Lanes <= run.nodes; n += Lanes) {
        all(n, [&]<int C, int K>(detail::number<C>, detail::number<K>, const number& value) TETRAPORE_INLINE {
          value.store(to + (static_cast<std::size_t>(C) * moments + K) * state_step + n);
        });
      }
      if (n < run.nodes) {
        const std::uint32_t lanes = base::lanes_of(run.nodes - n);
        all(n, [&]<int C, int K>(detail::number<C>, detail::number<K>, const number& value) TETRAPORE_INLINE {
          T* const last = to + (static_cast<std::size_t>(C) * moments + K) * state_step + n;
          number::select(lanes, value, number::load(last)).store(last);
        });
      }
    }
    for (std::size_t c = 0; c < components; ++c) {
      show(x, c);
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
  detail::aligned_vector<T> sent_;   ///< populations that have left the planes in use, likewise
  std::vector<senders> senders_;     ///< of each run
  std::vector<link> links_;
  std::vector<held_batch> held_;
  std::vector<std::size_t> held_of_;  ///< where the batches of each plane begin
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
