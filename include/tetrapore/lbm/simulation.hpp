// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/storage.hpp"
#include "tetrapore/lbm/surroundings.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

/// \file
/// The loop over nodes: how populations are stored, streamed and handed to the mixture.
///
/// Nodes go in batches of as many as a register holds, along the rows of a row_layout: a walled node streams and sees
/// as any other. What it sends into a wall lies in a cell of its own there, and is copied to where it belongs.
/// ψ of a plane is worked out just before the planes beside it are updated, so that populations pass through the cache
/// once.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// A mixture on the fluid nodes of a lattice.
/// \par Units   lattice units: nodes and steps
/// \tparam Model    a mixture
/// \tparam T        float or double, in which populations are stored and worked with
/// \tparam Storage  in_place or two_lattices: the same numbers, bit for bit; moments, by its header: to rounding
/// \tparam Lanes    nodes in a batch
template <class Model, std::floating_point T = double, storage Storage = storage::in_place, int Lanes = native_lanes<T>>
class simulation : public detail::surroundings<Model, T, Lanes, Storage == storage::two_lattices> {
  static_assert(Storage != storage::moments, "storage::moments takes #include <tetrapore/lbm/moments.hpp>");
  using base = detail::surroundings<Model, T, Lanes, Storage == storage::two_lattices>;

 public:
  using base::components;
  using base::directions;
  using typename base::densities;
  using typename base::lattice_type;

  /// All nodes at the mixture's reference densities, at rest; walls and reservoirs show them too.
  /// \throw parameter_error  a collision with τ of 1/2 or less; 2^32 populations or more
  simulation(const Model& model, site_map<lattice_type> map) : base(model, std::move(map), 1) {
    f_.assign(components * directions * rows_.stride() + beyond, T(0));
    if constexpr (Storage == storage::two_lattices) {
      next_.assign(f_.size(), T(0));
    }
  }

  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

  /// Densities and velocity of every node: `of(place, rho, u)` fills them. Populations become the equilibrium.
  template <class Of>
    requires std::invocable<Of&, const std::array<int, 3>&, densities&, std::array<double, 3>&>
  void initialise(Of of) {
    this->lay_equilibria(of, [&](std::size_t c, std::size_t n, const T(&f)[directions]) {
      for (std::size_t i = 0; i < directions; ++i) {
        population(c, n, i) = f[i];
      }
    });
  }

  void step() {
    if constexpr (Storage == storage::two_lattices) {
      sweep<stream::pull>();
      f_.swap(next_);
    } else if (odd()) {
      sweep<stream::exchange>();
    } else {
      sweep<stream::turn>();
    }
    ++steps_;
  }
  void run(std::size_t times) {
    for (std::size_t k = 0; k < times; ++k) {
      step();
    }
  }

  /// What arrives at a node in direction i, less weight × reference density.
  [[nodiscard]] T& population(std::size_t component, std::size_t node, std::size_t i) noexcept {
    return f_[component * directions * rows_.stride() + where(node, i)];
  }
  [[nodiscard]] const T& population(std::size_t component, std::size_t node, std::size_t i) const noexcept {
    return f_[component * directions * rows_.stride() + where(node, i)];
  }

  [[nodiscard]] double density(std::size_t component, std::size_t node) const noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < directions; ++i) {
      sum += static_cast<double>(population(component, node, i));
    }
    return model_.reference[component] + sum;
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
    double f[components][directions];
    double psi[components][directions];
    for (std::size_t c = 0; c < components; ++c) {
      for (std::size_t i = 0; i < directions; ++i) {
        f[c][i] = static_cast<double>(population(c, node, i));
        psi[c][i] = this->psi_of(c, map_.seen(node, static_cast<int>(i)),
                                 [this](std::size_t of, std::size_t n) { return density(of, n); });
      }
    }
    double u[3];
    model_.flow(
        f, [&]<int C, int I>(detail::number<C>, detail::number<I>) TETRAPORE_INLINE { return psi[C][I]; }, u);
    return {u[0], u[1], u[2]};
  }
  /// Mass of a component in all nodes that are no reservoir.
  [[nodiscard]] double mass(std::size_t component) const noexcept {
    return this->mass_of(component, [&](std::size_t n, auto add) {
      for (std::size_t i = 0; i < directions; ++i) {
        add(static_cast<double>(population(component, n, i)));
      }
    });
  }

 private:
  enum class stream { turn, exchange, pull };
  using base::beyond;
  using base::map_;
  using base::model_;
  using base::reservoirs_;
  using base::rows_;
  using base::width;
  using typename base::layout_type;
  using typename base::run_type;
  static constexpr int count = static_cast<int>(directions);
  using number = pack<T, Lanes>;

  [[nodiscard]] static constexpr std::size_t reversed(std::size_t i) noexcept {
    return static_cast<std::size_t>(opposite(static_cast<int>(i)));
  }

  [[nodiscard]] bool odd() const noexcept { return steps_ % 2 == 1; }

  /// Where the population that arrives at a node in direction i is stored between steps.
  [[nodiscard]] std::size_t where(std::size_t node, std::size_t i) const noexcept {
    const bool own = Storage == storage::in_place && !odd();
    return own ? rows_.place(rows_.cell(node), i) : rows_.gate(map_.leaving(node, opposite(static_cast<int>(i))));
  }

  [[nodiscard]] T* slots(detail::aligned_vector<T>& f, std::size_t c) const noexcept {
    return f.data() + c * directions * rows_.stride();
  }

  template <stream S>
  void sweep() {
    const std::size_t planes = map_.plane_count();
    const bool wrap = map_.box().low[0] == face_kind::periodic;
    if (wrap) {
      prepare<S>(planes - 1);
    }
    std::size_t ready = 0;
    for (std::size_t x = 0; x < planes; ++x) {
      const auto& images = this->image_ranges_[x];
      for (; ready < images.needs; ++ready) {
        if (!(wrap && ready + 1 == planes)) {
          prepare<S>(ready);
        }
      }
      this->show_images(images.first, images.last);
      update<S>(x);
    }
  }

  /// Where the numbers of the first node of a run begin, for each component and direction.
  struct ports {
    const T* from[components][directions];
    T* to[components][directions];
    const T* seen[components][directions];
  };

  /// The place of what leaves in direction k, less the place of the node's slot 0.
  template <stream S>
  [[nodiscard, gnu::always_inline]] std::ptrdiff_t departure(std::size_t k,
                                                             const typename layout_type::places& to) const noexcept {
    if constexpr (S == stream::exchange) {
      return static_cast<std::ptrdiff_t>(to[k]);
    } else {
      return static_cast<std::ptrdiff_t>((S == stream::turn ? reversed(k) : k) * rows_.stride());
    }
  }
  /// The place of what arrives in direction i.
  template <stream S>
  [[nodiscard, gnu::always_inline]] std::ptrdiff_t arrival(std::size_t i,
                                                           const typename layout_type::places& to) const noexcept {
    if constexpr (S == stream::turn) {
      return static_cast<std::ptrdiff_t>(i * rows_.stride());
    } else {
      return static_cast<std::ptrdiff_t>(to[reversed(i)]);  // populations change places in pairs
    }
  }

  /// What arrives from cells that are no nodes.
  void fetch(const typename layout_type::plane& p) {
    for (std::size_t c = 0; c < components; ++c) {
      T* const f = slots(f_, c);
      for (std::size_t k = p.first_link; k < p.last_link; ++k) {
        f[rows_.links()[k].cell] = f[rows_.links()[k].gate];
      }
    }
  }
  /// What has left for such cells goes where it belongs.
  void deliver(const typename layout_type::plane& p) {
    for (std::size_t c = 0; c < components; ++c) {
      T* const f = slots(f_, c);
      for (std::size_t k = p.first_link; k < p.last_link; ++k) {
        f[rows_.links()[k].gate] = f[rows_.links()[k].cell];
      }
    }
  }

  template <stream S>
  void prepare(std::size_t x) {
    const auto& p = rows_.planes()[x];
    const Model model = model_;
    if constexpr (S != stream::turn) {
      fetch(p);
    }
    const T* from[directions];
    for (std::size_t c = 0; c < components; ++c) {
      T* const psi = this->psi(c);
      const T* const f = slots(f_, c);
      for (std::size_t r = p.first_run; r < p.last_run; ++r) {
        const run_type& run = rows_.runs()[r];
        const auto& by = rows_.tables()[static_cast<std::size_t>(run.table)];
        T* const shown = psi + run.cell;
        if (run.what.kind == site_kind::reservoir) {
          std::fill_n(shown, run.nodes, static_cast<T>(model.potential(reservoirs_[run.what.tag][c])));
          continue;
        }
        for (std::size_t i = 0; i < directions; ++i) {
          from[i] = f + run.cell + arrival<S>(i, by.to);
        }
        const auto all = [&](std::ptrdiff_t n) TETRAPORE_INLINE {
          number g[directions];
          detail::repeat<count>([&]<int I>(detail::number<I>) TETRAPORE_INLINE { g[I] = number::load(from[I] + n); });
          return model.potential(model.density_of(g, c));
        };
        std::ptrdiff_t n = 0;
        for (; n + Lanes <= run.nodes; n += Lanes) {
          all(n).store(shown + n);
        }
        if (n < run.nodes) {
          number::select(base::lanes_of(run.nodes - n), all(n), number::load(shown + n)).store(shown + n);
        }
      }
      this->show_copies(c, p.first_copy, p.last_copy);
    }
  }

  template <stream S>
  void update(std::size_t x) {
    const auto& p = rows_.planes()[x];
    const Model model = model_;
    auto& next = S == stream::pull ? next_ : f_;
    alignas(detail::cache_line) T kept[components][directions][width];
    ports at;
    for (std::size_t r = p.first_run; r < p.last_run; ++r) {
      const run_type& run = rows_.runs()[r];
      const auto& by = rows_.tables()[static_cast<std::size_t>(run.table)];
      for (std::size_t c = 0; c < components; ++c) {
        const T* const f = slots(f_, c) + run.cell;
        T* const g = slots(next, c) + run.cell;
        const T* const psi = this->psi(c) + run.cell;
        for (std::size_t k = 0; k < directions; ++k) {
          at.from[c][k] = f + arrival<S>(k, by.to);
          at.to[c][k] = g + departure<S>(k, by.to);
          at.seen[c][k] = psi + by.seen[k];
        }
      }
      const std::ptrdiff_t whole = run.nodes / Lanes * Lanes;
      std::ptrdiff_t n = 0;
      for (const bool last : {false, true}) {  // whole batches write where they stand, the rest of a run is drawn in
        if (last) {
          for (std::size_t c = 0; c < components; ++c) {
            for (std::size_t k = 0; k < directions; ++k) {
              at.to[c][k] = kept[c][k];
            }
          }
        }
        const std::ptrdiff_t end = last ? run.nodes : whole;
        if (run.what.kind == site_kind::reservoir) {
          for (std::ptrdiff_t m = 0; n < end; n += Lanes, m += Lanes) {
            hold(at, run.what.tag, n, m);
          }
          continue;
        }
        for (std::ptrdiff_t m = 0; n < end; n += Lanes, m += Lanes) {
          model.template collide<number>([&]<int C, int I>(detail::number<C>, detail::number<I>)
                                             TETRAPORE_INLINE { return number::load(at.from[C][I] + n); },
                                         [&]<int C, int I>(detail::number<C>, detail::number<I>)
                                             TETRAPORE_INLINE { return number::load(at.seen[C][I] + n); },
                                         [&]<int C, int I>(detail::number<C>, detail::number<I>, const number& value)
                                             TETRAPORE_INLINE { value.store(at.to[C][I] + m); });
        }
      }
      if (whole < run.nodes) {
        const std::uint32_t lanes = base::lanes_of(run.nodes - whole);
        for (std::size_t c = 0; c < components; ++c) {
          T* const g = slots(next, c) + run.cell + whole;
          for (std::size_t k = 0; k < directions; ++k) {
            T* const to = g + departure<S>(k, by.to);
            number::select(lanes, number::load(kept[c][k]), number::load(to)).store(to);
          }
        }
      }
    }
    if constexpr (S == stream::exchange) {
      deliver(p);
    }
  }

  /// A batch of reservoir nodes: what leaves them does not depend on their neighbours.
  void hold(const ports& at, std::uint8_t tag, std::ptrdiff_t from, std::ptrdiff_t to) const {
    number f[components][directions];
    number rho[components];
    for (std::size_t c = 0; c < components; ++c) {
      rho[c] = number(static_cast<T>(reservoirs_[tag][c]));
      for (std::size_t i = 0; i < directions; ++i) {
        f[c][i] = number::load(at.from[c][i] + from);
      }
    }
    model_.hold(f, rho);
    for (std::size_t c = 0; c < components; ++c) {
      for (std::size_t k = 0; k < directions; ++k) {
        f[c][k].store(at.to[c][k] + to);
      }
    }
  }

  std::size_t steps_ = 0;
  detail::aligned_vector<T> f_;  ///< slots of all cells, one behind the other, component by component
  detail::aligned_vector<T> next_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
