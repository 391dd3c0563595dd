// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/mixture.hpp"
#include "tetrapore/lbm/rows.hpp"
#include "tetrapore/lbm/sites.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

/// \file
/// The loop over nodes: how populations are stored, streamed and handed to the mixture.
///
/// Nodes go in batches of as many as a register holds, along the rows of a row_layout: a walled node streams and sees
/// as any other. What it sends into a wall lies in a cell of its own there, and is copied to where it belongs.
/// ψ of a plane is worked out just before the planes beside it are updated, so that populations pass through the cache
/// once.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// How populations are stored.
enum class storage {
  in_place,     ///< once: even steps turn populations round at their node, odd ones exchange them with the neighbours
  two_lattices  ///< twice: from one into the other. The plain reference
};

namespace detail {

inline constexpr std::size_t cache_line = 64;

/// Numbers that begin on a cache line; many of them on huge pages, where the system has some.
template <class T>
struct cache_aligned {
  using value_type = T;
  cache_aligned() = default;
  template <class U>
  constexpr explicit cache_aligned(const cache_aligned<U>&) noexcept {}
  [[nodiscard]] T* allocate(std::size_t n) {
    void* p = ::operator new(n * sizeof(T), alignment(n));
#if defined(__linux__)
    if (n * sizeof(T) >= huge_page) {
      madvise(p, n * sizeof(T), MADV_HUGEPAGE);  // advice: the result changes speed alone
    }
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) noexcept { ::operator delete(p, alignment(n)); }
  [[nodiscard]] friend bool operator==(const cache_aligned&, const cache_aligned&) noexcept { return true; }

 private:
  static constexpr std::size_t huge_page = std::size_t{1} << 21U;
  [[nodiscard]] static constexpr std::align_val_t alignment(std::size_t n) noexcept {
    return std::align_val_t{n * sizeof(T) >= huge_page ? huge_page : cache_line};
  }
};
template <class T>
using aligned_vector = std::vector<T, cache_aligned<T>>;

}  // namespace detail

/// A mixture on the fluid nodes of a lattice.
/// \par Units   lattice units: nodes and steps
/// \tparam Model    a mixture
/// \tparam T        float or double, in which populations are stored and worked with
/// \tparam Storage  in_place or two_lattices: the same numbers, bit for bit
/// \tparam Lanes    nodes in a batch
template <class Model, std::floating_point T = double, storage Storage = storage::in_place, int Lanes = native_lanes<T>>
class simulation {
 public:
  using lattice_type = typename Model::lattice_type;
  static constexpr std::size_t components = Model::components;
  static constexpr std::size_t directions = Model::directions;
  using densities = std::array<double, components>;

  /// All nodes at the mixture's reference densities, at rest; walls and reservoirs show them too.
  simulation(const Model& model, site_map<lattice_type> map) : model_(model), map_(std::move(map)) {
    for (const auto& c : model_.collisions) {
      if (!(c.tau > 0.5)) {
        throw parameter_error("collision", "tau = " + short_number(c.tau), "more than 0.5");
      }
    }
    rows_ = layout_type(map_, width, per_line);
    f_.assign(components * directions * rows_.stride() + beyond, T(0));
    if constexpr (Storage == storage::two_lattices) {
      next_.assign(f_.size(), T(0));
    }
    for (std::size_t c = 0; c < components; ++c) {
      psi_[c].assign(beyond + static_cast<std::size_t>(cell_of_wall(0)) + tags + beyond,
                     static_cast<T>(model_.potential(model_.reference[c])));
    }
    walls_.fill(model_.reference);
    reservoirs_.fill(model_.reference);
    make_planes();
    make_images();
  }

  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] const site_map<lattice_type>& sites() const noexcept { return map_; }
  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

  /// The densities that walls of a tag show their neighbours.
  void set_wall(std::uint8_t tag, const densities& rho) {
    walls_[tag] = rho;
    for (std::size_t c = 0; c < components; ++c) {
      const auto shown = static_cast<T>(model_.potential(rho[c]));
      psi(c)[cell_of_wall(tag)] = shown;
      for (const auto& wall : rows_.walls()) {
        if (wall.tag == tag) {
          psi(c)[wall.cell] = shown;
        }
      }
      if (tag == 0) {
        std::fill_n(psi(c) + rows_.face(), rows_.longest() + width, shown);
      }
    }
  }
  void set_reservoir(std::uint8_t tag, const densities& rho) { reservoirs_[tag] = rho; }
  void set_gravity(const std::array<double, 3>& g) { model_.gravity = g; }

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
        for (std::size_t i = 0; i < directions; ++i) {
          population(c, n, i) = f[i];
        }
      }
    }
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
        const auto s = map_.seen(node, static_cast<int>(i));
        psi[c][i] = psi_of(c, s);
      }
    }
    double u[3];
    model_.flow(
        f, [&]<int C, int I>(detail::number<C>, detail::number<I>) TETRAPORE_INLINE { return psi[C][I]; }, u);
    return {u[0], u[1], u[2]};
  }
  /// Mass of a component in all nodes that are no reservoir.
  [[nodiscard]] double mass(std::size_t component) const noexcept {
    double excess = 0;
    double lost = 0;  // Kahan's correction
    std::size_t nodes = 0;
    for (std::size_t n = 0; n < map_.size(); ++n) {
      if (map_.at(n).kind == site_kind::reservoir) {
        continue;
      }
      ++nodes;
      for (std::size_t i = 0; i < directions; ++i) {
        const double x = static_cast<double>(population(component, n, i)) - lost;
        const double sum = excess + x;
        lost = (sum - excess) - x;
        excess = sum;
      }
    }
    return excess + model_.reference[component] * static_cast<double>(nodes);
  }

 private:
  enum class stream { turn, exchange, pull };
  static constexpr std::size_t tags = 256;
  static constexpr std::int32_t none = site_map<lattice_type>::none;
  static constexpr std::size_t width = static_cast<std::size_t>(Lanes);
  static constexpr int count = static_cast<int>(directions);
  using number = pack<T, Lanes>;
  using layout_type = row_layout<lattice_type, Storage == storage::two_lattices>;
  using run_type = typename layout_type::run;

  static constexpr std::size_t per_line = detail::cache_line / sizeof(T);
  static constexpr std::size_t beyond = std::max<std::size_t>(width, per_line);
  static_assert(Lanes >= 1 && Lanes <= 32, "a bit of 32 for each node of a batch");

  /// Nodes of a reservoir.
  struct held_batch {
    std::int32_t cell[width];
    std::uint32_t gate[directions][width];
    std::uint8_t tag;
  };
  /// What of all lists belongs to nodes of one x.
  struct plane {
    std::size_t first_held, last_held;
    std::size_t first_image, last_image;  ///< which this plane is the first to see
    std::size_t needs;                    ///< how many planes must show their ψ before this one is updated
  };
  /// ψ of a point beyond a mirror, from nodes and walls.
  struct image_cells {
    std::int32_t from[8];
    T weight[8];
    std::size_t count;
    std::int32_t cell;
  };

  [[nodiscard]] static constexpr std::size_t reversed(std::size_t i) noexcept {
    return static_cast<std::size_t>(opposite(static_cast<int>(i)));
  }

  [[nodiscard]] bool odd() const noexcept { return steps_ % 2 == 1; }

  /// Where the population that arrives at a node in direction i is stored between steps.
  [[nodiscard]] std::size_t where(std::size_t node, std::size_t i) const noexcept {
    const bool own = Storage == storage::in_place && !odd();
    return own ? rows_.place(rows_.cell(node), i) : rows_.gate(map_.leaving(node, opposite(static_cast<int>(i))));
  }

  [[nodiscard]] double shown(std::size_t c, std::size_t node) const noexcept {
    const site s = map_.at(node);
    return s.kind == site_kind::reservoir ? reservoirs_[s.tag][c] : density(c, node);
  }

  [[nodiscard]] T* psi(std::size_t c) noexcept { return psi_[c].data() + beyond; }
  [[nodiscard]] T* slots(detail::aligned_vector<T>& f, std::size_t c) const noexcept {
    return f.data() + c * directions * rows_.stride();
  }
  /// Where ψ of walls of a tag is kept.
  [[nodiscard]] std::int32_t cell_of_wall(std::uint8_t tag) const noexcept {
    return rows_.face() + static_cast<std::int32_t>(rows_.longest() + width) + tag;
  }

  void make_planes() {
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      plane p{held_.size(), 0, 0, 0, std::min(x + 2, map_.plane_count())};
      std::vector<std::size_t> held;
      for (auto n = static_cast<std::size_t>(map_.plane_begin(x));
           n < static_cast<std::size_t>(map_.plane_begin(x + 1)); ++n) {
        if (map_.at(n).kind == site_kind::reservoir) {
          held.push_back(n);
        }
      }
      const auto tag = [&](std::size_t k) { return map_.at(held[k]).tag; };
      std::stable_sort(held.begin(), held.end(),
                       [&](std::size_t a, std::size_t b) { return map_.at(a).tag < map_.at(b).tag; });
      for (std::size_t k = 0; k < held.size();) {
        std::size_t upto = k;
        while (upto < held.size() && upto - k < width && tag(upto) == tag(k)) {
          ++upto;
        }
        held_.push_back(held_by(tag(k), std::span(held).subspan(k, upto - k)));
        k = upto;
      }
      p.last_held = held_.size();
      planes_.push_back(p);
    }
  }
  [[nodiscard]] held_batch held_by(std::uint8_t tag, std::span<const std::size_t> nodes) const {
    held_batch b{};
    b.tag = tag;
    for (std::size_t lane = 0; lane < width; ++lane) {
      const bool used = lane < nodes.size();
      b.cell[lane] = used ? rows_.cell(nodes[lane]) : rows_.idle();
      for (std::size_t k = 0; k < directions; ++k) {  // an idle lane's own gate: none writes where another reads
        b.gate[k][lane] = static_cast<std::uint32_t>(used ? rows_.gate(map_.leaving(nodes[lane], static_cast<int>(k)))
                                                          : rows_.place(rows_.idle(), k));
      }
    }
    return b;
  }

  /// Images in the order of the first plane that sees them.
  void make_images() {
    std::size_t needs = 0;
    for (std::size_t x = 0; x < planes_.size(); ++x) {
      planes_[x].first_image = images_.size();
      while (images_.size() < rows_.images().size() &&
             rows_.images()[images_.size()].first_user == static_cast<int>(x)) {
        const auto& at = rows_.images()[images_.size()];
        const auto& shows = map_.images()[static_cast<std::size_t>(at.index)];
        image_cells image{};
        image.count = shows.count;
        image.cell = at.cell;
        for (std::size_t s = 0; s < shows.count; ++s) {
          const auto& from = shows.from[s];
          image.from[s] = from.node == none ? cell_of_wall(from.wall) : rows_.cell(static_cast<std::size_t>(from.node));
          image.weight[s] = static_cast<T>(from.weight);
        }
        images_.push_back(image);
        needs = std::max(needs, static_cast<std::size_t>(shows.last_plane) + 1);
      }
      planes_[x].last_image = images_.size();
      planes_[x].needs = std::max(planes_[x].needs, needs);
    }
  }
  [[nodiscard]] double psi_of(std::size_t c, const typename site_map<lattice_type>::sight& s) const noexcept {
    if (s.image == none) {
      return model_.potential(s.node == none ? walls_[s.wall][c] : shown(c, static_cast<std::size_t>(s.node)));
    }
    const auto& image = map_.images()[static_cast<std::size_t>(s.image)];
    double sum = 0;
    for (std::size_t k = 0; k < image.count; ++k) {
      sum += image.from[k].weight * psi_of(c, {image.from[k].node, none, image.from[k].wall});
    }
    return sum;
  }

  template <stream S>
  void sweep() {
    const std::size_t planes = planes_.size();
    const bool wrap = map_.box().low[0] == face_kind::periodic;
    if (wrap) {
      prepare<S>(planes - 1);
    }
    std::size_t ready = 0;
    for (std::size_t x = 0; x < planes; ++x) {
      for (; ready < planes_[x].needs; ++ready) {
        if (!(wrap && ready + 1 == planes)) {
          prepare<S>(ready);
        }
      }
      show_images(planes_[x]);
      update<S>(x);
    }
  }

  void show_images(const plane& p) noexcept {
    for (std::size_t k = p.first_image; k < p.last_image; ++k) {
      const auto& image = images_[k];
      for (std::size_t c = 0; c < components; ++c) {
        T sum(0);
        for (std::size_t s = 0; s < image.count; ++s) {
          sum += image.weight[s] * psi(c)[image.from[s]];
        }
        psi(c)[image.cell] = sum;
      }
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

  /// The lanes of a batch whose nodes belong to the run.
  [[nodiscard]] static constexpr std::uint32_t lanes_of(std::ptrdiff_t left) noexcept {
    return static_cast<std::uint32_t>((std::uint64_t{1} << static_cast<std::size_t>(left)) - 1);
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
        for (std::size_t i = 0; i < directions; ++i) {
          from[i] = f + run.cell + arrival<S>(i, by.to);
        }
        T* const shown = psi + run.cell;
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
          number::select(lanes_of(run.nodes - n), all(n), number::load(shown + n)).store(shown + n);
        }
      }
      for (std::size_t h = planes_[x].first_held; h < planes_[x].last_held; ++h) {
        const T value = static_cast<T>(model.potential(reservoirs_[held_[h].tag][c]));
        for (const std::int32_t cell : held_[h].cell) {
          psi[cell] = value;
        }
      }
      for (std::size_t k = p.first_copy; k < p.last_copy; ++k) {
        psi[rows_.copies()[k].to] = psi[rows_.copies()[k].from];
      }
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
        const std::uint32_t lanes = lanes_of(run.nodes - whole);
        for (std::size_t c = 0; c < components; ++c) {
          T* const g = slots(next, c) + run.cell + whole;
          for (std::size_t k = 0; k < directions; ++k) {
            T* const to = g + departure<S>(k, by.to);
            number::select(lanes, number::load(kept[c][k]), number::load(to)).store(to);
          }
        }
      }
    }
    for (std::size_t h = planes_[x].first_held; h < planes_[x].last_held; ++h) {
      hold<S>(held_[h], next);
    }
    if constexpr (S == stream::exchange) {
      deliver(p);
    }
  }

  /// A batch of reservoir nodes: what leaves them does not depend on their neighbours.
  template <stream S>
  void hold(const held_batch& b, detail::aligned_vector<T>& next) {
    number f[components][directions];
    number rho[components];
    for (std::size_t c = 0; c < components; ++c) {
      const T* const from = slots(f_, c);
      for (std::size_t i = 0; i < directions; ++i) {
        for (std::size_t lane = 0; lane < width; ++lane) {
          f[c][i].v[lane] = from[S == stream::turn ? rows_.place(b.cell[lane], i) : b.gate[reversed(i)][lane]];
        }
      }
      rho[c] = number(static_cast<T>(reservoirs_[b.tag][c]));
    }
    model_.hold(f, rho);
    for (std::size_t c = 0; c < components; ++c) {
      T* const to = slots(next, c);
      for (std::size_t k = 0; k < directions; ++k) {
        for (std::size_t lane = 0; lane < width; ++lane) {
          to[S == stream::exchange ? b.gate[k][lane] : rows_.place(b.cell[lane], S == stream::turn ? reversed(k) : k)] =
              f[c][k].v[lane];
        }
      }
    }
  }

  Model model_;
  site_map<lattice_type> map_;
  layout_type rows_;
  std::size_t steps_ = 0;
  detail::aligned_vector<T> f_;  ///< slots of all cells, one behind the other, component by component
  detail::aligned_vector<T> next_;
  std::array<detail::aligned_vector<T>, components> psi_;
  std::array<densities, tags> walls_;
  std::array<densities, tags> reservoirs_;
  std::vector<held_batch> held_;
  std::vector<plane> planes_;
  std::vector<image_cells> images_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
