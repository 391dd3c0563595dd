// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/mixture.hpp"
#include "tetrapore/lbm/sites.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <numeric>
#include <span>
#include <vector>

/// \file
/// The loop over nodes: how populations are stored, streamed and handed to the mixture.
///
/// Nodes go in batches of as many as a register holds. Where consecutive nodes see fluid alone in the same places, a
/// batch is a first node and one offset for each direction; the rest (at walls, mirrors, the ends of runs) go by an
/// index for each node and direction. ψ of a plane is worked out just before the planes beside it are updated, so that
/// populations pass through the cache once.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// How populations are stored.
enum class storage {
  in_place,     ///< once: even steps turn populations round at their node, odd ones exchange them with the neighbours
  two_lattices  ///< twice: from one into the other. The plain reference
};

namespace detail {

/// Numbers that begin on a cache line.
template <class T>
struct cache_aligned {
  using value_type = T;
  cache_aligned() = default;
  template <class U>
  constexpr explicit cache_aligned(const cache_aligned<U>&) noexcept {}
  [[nodiscard]] T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t{64}));
  }
  void deallocate(T* p, std::size_t) noexcept { ::operator delete(p, std::align_val_t{64}); }
  [[nodiscard]] friend bool operator==(const cache_aligned&, const cache_aligned&) noexcept { return true; }
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
    stride_ = (map_.size() + 2 * width - 1) / width * width;  // at least one node for idle lanes
    idle_ = static_cast<std::int32_t>(map_.size());
    stride_ += 16;  // directions do not all begin in the same set of the cache
    for (std::size_t c = 0; c < components; ++c) {
      f_[c].assign(directions * stride_, T(0));
      if constexpr (Storage == storage::two_lattices) {
        next_[c].assign(directions * stride_, T(0));
      }
      psi_[c].assign(stride_ + tags + map_.images().size(), static_cast<T>(model_.potential(model_.reference[c])));
    }
    walls_.fill(model_.reference);
    reservoirs_.fill(model_.reference);
    make_batches();
    make_images();
  }

  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] const site_map<lattice_type>& sites() const noexcept { return map_; }
  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

  /// The densities that walls of a tag show their neighbours.
  void set_wall(std::uint8_t tag, const densities& rho) {
    walls_[tag] = rho;
    for (std::size_t c = 0; c < components; ++c) {
      psi_[c][stride_ + tag] = static_cast<T>(model_.potential(rho[c]));
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
    return f_[component][where(node, i)];
  }
  [[nodiscard]] const T& population(std::size_t component, std::size_t node, std::size_t i) const noexcept {
    return f_[component][where(node, i)];
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
  static constexpr int parts = static_cast<int>(components);
  using number = pack<T, Lanes>;
  using offsets = std::array<std::int32_t, directions>;

  /// Consecutive nodes that see fluid in the same places.
  struct run_of_batches {
    std::int32_t first;
    std::int32_t batches;
    std::int32_t table;  ///< of `tables_`: the neighbour in direction k is a node + this
  };
  /// Nodes each with links of its own.
  struct loose_batch {
    std::int32_t node[width];
    std::int32_t gate[directions][width];  ///< where what leaves in direction k arrives: slot × stride + node
    std::int32_t seen[directions][width];  ///< the index of ψ in direction k
    bool reservoir;
    std::uint8_t tag;
  };
  struct plane {
    std::size_t first_run, last_run;
    std::size_t first_loose, last_loose;
    std::size_t first_image, last_image;  ///< which this plane is the first to see
    std::size_t needs;                    ///< how many planes must show their ψ before this one is updated
  };
  /// ψ of a point beyond a mirror, from nodes and walls.
  struct image_slots {
    std::int32_t from[8];
    T weight[8];
    std::size_t count;
    std::int32_t slot;
  };

  [[nodiscard]] bool odd() const noexcept { return steps_ % 2 == 1; }

  /// Where the population that arrives at a node in direction i is stored between steps.
  [[nodiscard]] std::size_t where(std::size_t node, std::size_t i) const noexcept {
    const bool own = Storage == storage::in_place && !odd();
    if (own) {
      return i * stride_ + node;
    }
    const auto from = map_.arriving(node, static_cast<int>(i));
    const std::size_t slot = Storage == storage::in_place ? static_cast<std::size_t>(opposite(from.as)) : from.as;
    return slot * stride_ + static_cast<std::size_t>(from.to);
  }

  [[nodiscard]] double shown(std::size_t c, std::size_t node) const noexcept {
    const site s = map_.at(node);
    return s.kind == site_kind::reservoir ? reservoirs_[s.tag][c] : density(c, node);
  }

  void make_batches() {
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      plane p{runs_.size(), 0, loose_.size(), 0, 0, 0, std::min(x + 2, map_.plane_count())};
      auto n = static_cast<std::size_t>(map_.plane_begin(x));
      const auto end = static_cast<std::size_t>(map_.plane_begin(x + 1));
      std::vector<std::int32_t> rest;
      std::vector<std::int32_t> held;
      while (n < end) {
        offsets table;
        if (map_.at(n).kind == site_kind::reservoir) {
          held.push_back(static_cast<std::int32_t>(n++));
          continue;
        }
        if (!regular(n, table)) {
          rest.push_back(static_cast<std::int32_t>(n++));
          continue;
        }
        std::size_t last = n + 1;
        offsets other;
        while (last < end && map_.at(last).kind == site_kind::fluid && regular(last, other) && other == table) {
          ++last;
        }
        const auto batches = static_cast<std::int32_t>((last - n) / width);
        if (batches > 0) {
          if (tables_.empty() || tables_.back() != table) {
            tables_.push_back(table);
          }
          runs_.push_back({static_cast<std::int32_t>(n), batches, static_cast<std::int32_t>(tables_.size()) - 1});
          n += static_cast<std::size_t>(batches) * width;
        }
        while (n < last) {
          rest.push_back(static_cast<std::int32_t>(n++));
        }
      }
      for (std::size_t k = 0; k < rest.size(); k += width) {
        loose_.push_back(batch_of(std::span(rest).subspan(k, std::min(width, rest.size() - k))));
      }
      std::stable_sort(held.begin(), held.end(), [&](std::int32_t a, std::int32_t b) {
        return map_.at(static_cast<std::size_t>(a)).tag < map_.at(static_cast<std::size_t>(b)).tag;
      });
      for (std::size_t k = 0; k < held.size();) {
        const std::uint8_t tag = map_.at(static_cast<std::size_t>(held[k])).tag;
        std::size_t upto = k;
        while (upto < held.size() && upto - k < width && map_.at(static_cast<std::size_t>(held[upto])).tag == tag) {
          ++upto;
        }
        loose_.push_back(batch_of(std::span(held).subspan(k, upto - k)));
        loose_.back().reservoir = true;
        loose_.back().tag = tag;
        k = upto;
      }
      p.last_run = runs_.size();
      p.last_loose = loose_.size();
      batches_.push_back(p);
    }
  }

  /// Images in the order of the first plane that sees them.
  void make_images() {
    const auto& all = map_.images();
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return all[a].first_user < all[b].first_user; });
    std::size_t next = 0;
    std::size_t needs = 0;
    for (std::size_t x = 0; x < batches_.size(); ++x) {
      batches_[x].first_image = next;
      for (; next < order.size() && all[order[next]].first_user == static_cast<int>(x); ++next) {
        const auto& image = all[order[next]];
        image_slots slots{};
        slots.count = image.count;
        slots.slot = slot_of(none, 0, static_cast<std::int32_t>(order[next]));
        for (std::size_t s = 0; s < image.count; ++s) {
          slots.from[s] = slot_of(image.from[s].node, image.from[s].wall, none);
          slots.weight[s] = static_cast<T>(image.from[s].weight);
        }
        images_.push_back(slots);
        needs = std::max(needs, static_cast<std::size_t>(image.last_plane) + 1);
      }
      batches_[x].last_image = next;
      batches_[x].needs = std::max(batches_[x].needs, needs);
    }
  }

  /// Where ψ of what a node sees is kept.
  [[nodiscard]] std::int32_t slot_of(std::int32_t node, std::uint8_t wall, std::int32_t image) const noexcept {
    return node != none    ? node
           : image != none ? static_cast<std::int32_t>(stride_ + tags) + image
                           : static_cast<std::int32_t>(stride_ + wall);
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

  /// Whether all that leaves a node goes on as it is; then by which offsets.
  [[nodiscard]] bool regular(std::size_t n, offsets& by) const noexcept {
    for (std::size_t k = 0; k < directions; ++k) {
      const auto to = map_.leaving(n, static_cast<int>(k));
      if (to.as != k) {
        return false;
      }
      by[k] = to.to - static_cast<std::int32_t>(n);
    }
    return true;
  }

  [[nodiscard]] loose_batch batch_of(std::span<const std::int32_t> nodes) const {
    loose_batch b{};
    for (std::size_t lane = 0; lane < width; ++lane) {
      const bool used = lane < nodes.size();
      const std::int32_t node = used ? nodes[lane] : idle_;
      b.node[lane] = node;
      for (std::size_t k = 0; k < directions; ++k) {
        if (!used) {  // its own gate, so that no lane writes where another reads
          b.gate[k][lane] = static_cast<std::int32_t>(k * stride_ + static_cast<std::size_t>(idle_));
          b.seen[k][lane] = idle_;
          continue;
        }
        const auto n = static_cast<std::size_t>(node);
        const auto to = map_.leaving(n, static_cast<int>(k));
        b.gate[k][lane] = static_cast<std::int32_t>(to.as * stride_ + static_cast<std::size_t>(to.to));
        const auto s = map_.seen(n, static_cast<int>(k));
        b.seen[k][lane] = slot_of(s.node, s.wall, s.image);
      }
    }
    return b;
  }

  template <stream S>
  void sweep() {
    const std::size_t planes = batches_.size();
    const bool wrap = map_.box().low[0] == face_kind::periodic;
    if (wrap) {
      prepare<S>(planes - 1);
    }
    std::size_t ready = 0;
    for (std::size_t x = 0; x < planes; ++x) {
      for (; ready < batches_[x].needs; ++ready) {
        if (!(wrap && ready + 1 == planes)) {
          prepare<S>(ready);
        }
      }
      show_images(batches_[x]);
      update<S>(x);
    }
  }

  void show_images(const plane& p) noexcept {
    for (std::size_t k = p.first_image; k < p.last_image; ++k) {
      const auto& image = images_[k];
      for (std::size_t c = 0; c < components; ++c) {
        T sum(0);
        for (std::size_t s = 0; s < image.count; ++s) {
          sum += image.weight[s] * psi_[c][static_cast<std::size_t>(image.from[s])];
        }
        psi_[c][static_cast<std::size_t>(image.slot)] = sum;
      }
    }
  }

  // what arrives in direction i, and where what leaves in direction k goes: of a run
  template <stream S>
  [[nodiscard, gnu::always_inline]] const T* arrival(const T* f, std::size_t i, std::size_t n,
                                                     const offsets& by) const noexcept {
    const auto back = static_cast<std::size_t>(opposite(static_cast<int>(i)));
    if constexpr (S == stream::turn) {
      return f + i * stride_ + n;
    } else {
      return f + (S == stream::exchange ? back : i) * stride_ + n + by[back];
    }
  }
  template <stream S>
  [[nodiscard, gnu::always_inline]] T* departure(T* f, std::size_t k, std::size_t n, const offsets& by) const noexcept {
    if constexpr (S == stream::turn) {
      return f + static_cast<std::size_t>(opposite(static_cast<int>(k))) * stride_ + n;
    } else if constexpr (S == stream::exchange) {
      return f + k * stride_ + n + by[k];
    } else {
      return f + k * stride_ + n;
    }
  }
  // the same of a lane of a loose batch
  template <stream S>
  [[nodiscard, gnu::always_inline]] std::size_t arrival(std::size_t i, const loose_batch& b,
                                                        std::size_t lane) const noexcept {
    const auto back = static_cast<std::size_t>(opposite(static_cast<int>(i)));
    if constexpr (S == stream::turn) {
      return i * stride_ + static_cast<std::size_t>(b.node[lane]);
    } else if constexpr (S == stream::exchange) {
      return static_cast<std::size_t>(b.gate[back][lane]);
    } else {  // what leaves against i arrives there; what left there against that arrives here
      const auto gate = static_cast<std::size_t>(b.gate[back][lane]);
      return static_cast<std::size_t>(opposite(static_cast<int>(gate / stride_))) * stride_ + gate % stride_;
    }
  }

  template <stream S>
  void prepare(std::size_t x) {
    const plane& p = batches_[x];
    for (std::size_t c = 0; c < components; ++c) {
      const T* f = f_[c].data();
      T* psi = psi_[c].data();
      for (std::size_t r = p.first_run; r < p.last_run; ++r) {
        const run_of_batches& run = runs_[r];
        const offsets by = tables_[static_cast<std::size_t>(run.table)];
        auto n = static_cast<std::size_t>(run.first);
        for (std::int32_t k = 0; k < run.batches; ++k, n += width) {
          number g[directions];
          detail::repeat<count>([&]<int I>(detail::number<I>)
                                    TETRAPORE_INLINE { g[I] = number::load(arrival<S>(f, I, n, by)); });
          model_.potential(model_.density_of(g, c)).store(psi + n);
        }
      }
      for (std::size_t l = p.first_loose; l < p.last_loose; ++l) {
        const loose_batch& b = loose_[l];
        if (b.reservoir) {
          const T value = static_cast<T>(model_.potential(reservoirs_[b.tag][c]));
          for (std::size_t lane = 0; lane < width; ++lane) {
            psi[b.node[lane]] = value;
          }
          continue;
        }
        number g[directions];
        for (std::size_t i = 0; i < directions; ++i) {
          for (std::size_t lane = 0; lane < width; ++lane) {
            g[i].v[lane] = f[arrival<S>(i, b, lane)];
          }
        }
        const number shown = model_.potential(model_.density_of(g, c));
        for (std::size_t lane = 0; lane < width; ++lane) {
          psi[b.node[lane]] = shown.v[lane];
        }
      }
    }
  }

  template <stream S>
  void update(std::size_t x) {
    const plane& p = batches_[x];
    const auto target = [&](std::size_t c) { return S == stream::pull ? next_[c].data() : f_[c].data(); };
    for (std::size_t r = p.first_run; r < p.last_run; ++r) {
      const run_of_batches& run = runs_[r];
      const offsets by = tables_[static_cast<std::size_t>(run.table)];
      auto n = static_cast<std::size_t>(run.first);
      for (std::int32_t k = 0; k < run.batches; ++k, n += width) {
        number f[components][directions];
        detail::repeat<parts>([&]<int C>(detail::number<C>) TETRAPORE_INLINE {
          detail::repeat<count>([&]<int I>(detail::number<I>)
                                    TETRAPORE_INLINE { f[C][I] = number::load(arrival<S>(f_[C].data(), I, n, by)); });
        });
        model_.collide(f, [&]<int C, int I>(detail::number<C>, detail::number<I>)
                              TETRAPORE_INLINE { return number::load(psi_[C].data() + n + by[I]); });
        detail::repeat<parts>([&]<int C>(detail::number<C>) TETRAPORE_INLINE {
          T* to = target(C);
          detail::repeat<count>([&]<int I>(detail::number<I>)
                                    TETRAPORE_INLINE { f[C][I].store(departure<S>(to, I, n, by)); });
        });
      }
    }
    number f[components][directions];
    number psi[components][directions];
    for (std::size_t l = p.first_loose; l < p.last_loose; ++l) {
      const loose_batch& b = loose_[l];
      for (std::size_t c = 0; c < components; ++c) {
        const T* from = f_[c].data();
        const T* seen = psi_[c].data();
        for (std::size_t i = 0; i < directions; ++i) {
          for (std::size_t lane = 0; lane < width; ++lane) {
            f[c][i].v[lane] = from[arrival<S>(i, b, lane)];
            psi[c][i].v[lane] = seen[b.seen[i][lane]];
          }
        }
      }
      if (b.reservoir) {
        number rho[components];
        for (std::size_t c = 0; c < components; ++c) {
          rho[c] = number(static_cast<T>(reservoirs_[b.tag][c]));
        }
        model_.hold(f, rho);
      } else {
        model_.collide(f,
                       [&]<int C, int I>(detail::number<C>, detail::number<I>) TETRAPORE_INLINE { return psi[C][I]; });
      }
      for (std::size_t c = 0; c < components; ++c) {
        T* to = target(c);
        for (std::size_t k = 0; k < directions; ++k) {
          for (std::size_t lane = 0; lane < width; ++lane) {
            std::size_t at;
            if constexpr (S == stream::turn) {
              at = static_cast<std::size_t>(opposite(static_cast<int>(k))) * stride_ +
                   static_cast<std::size_t>(b.node[lane]);
            } else if constexpr (S == stream::exchange) {
              at = static_cast<std::size_t>(b.gate[k][lane]);
            } else {
              at = k * stride_ + static_cast<std::size_t>(b.node[lane]);
            }
            to[at] = f[c][k].v[lane];
          }
        }
      }
    }
  }

  Model model_;
  site_map<lattice_type> map_;
  std::size_t stride_ = 0;
  std::int32_t idle_ = 0;
  std::size_t steps_ = 0;
  std::array<detail::aligned_vector<T>, components> f_;
  std::array<detail::aligned_vector<T>, components> next_;
  std::array<detail::aligned_vector<T>, components> psi_;
  std::array<densities, tags> walls_;
  std::array<densities, tags> reservoirs_;
  std::vector<offsets> tables_;
  std::vector<run_of_batches> runs_;
  std::vector<loose_batch> loose_;
  std::vector<plane> batches_;
  std::vector<image_slots> images_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
