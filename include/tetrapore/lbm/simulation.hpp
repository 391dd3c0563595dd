// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/mixture.hpp"
#include "tetrapore/lbm/sites.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <numeric>
#include <span>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

/// \file
/// The loop over nodes: how populations are stored, streamed and handed to the mixture.
///
/// Nodes go in batches of as many as a register holds: consecutive nodes, a first one and an offset for each direction.
/// Where a node of a batch streams elsewhere or sees something else (walls, mirrors, the ends of rows), that is an
/// exception of the batch: the direction goes through a small buffer, in which the exceptions replace some lanes.
/// All batches run through the same code. ψ of a plane is worked out just before the planes beside it are updated, so
/// that populations pass through the cache once.

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
    idle_ = static_cast<std::int32_t>(map_.size());
    stride_ = stride_for(map_.size());
    f_.assign(components * directions * stride_ + beyond, T(0));
    if constexpr (Storage == storage::two_lattices) {
      next_.assign(f_.size(), T(0));
    }
    for (std::size_t c = 0; c < components; ++c) {
      psi_[c].assign(beyond + stride_ + tags + map_.images().size() + beyond,
                     static_cast<T>(model_.potential(model_.reference[c])));
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
      psi(c)[stride_ + tag] = static_cast<T>(model_.potential(rho[c]));
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
    return f_[component * directions * stride_ + where(node, i)];
  }
  [[nodiscard]] const T& population(std::size_t component, std::size_t node, std::size_t i) const noexcept {
    return f_[component * directions * stride_ + where(node, i)];
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
  static constexpr std::uint32_t all_lanes = static_cast<std::uint32_t>((std::uint64_t{1} << width) - 1);
  using number = pack<T, Lanes>;
  using offsets = std::array<std::int32_t, directions>;

  static constexpr std::size_t beyond = std::max<std::size_t>(width, detail::cache_line / sizeof(T));
  static_assert(Lanes >= 1 && Lanes <= 32 && directions <= 32, "a bit of 32 for each node and direction of a batch");

  /// Batches one behind the other without exceptions, or one with them.
  struct run_of_batches {
    std::int32_t first;
    std::int32_t batches;
    std::int32_t table;     ///< of `tables_`: the neighbour in direction k is a node + this
    std::uint32_t used;     ///< a bit for each lane whose node is updated
    std::uint32_t streams;  ///< a bit for each direction in which some node's populations go elsewhere
    std::uint32_t sees;     ///< the same of ψ
    std::size_t gates[2];   ///< of `gates_`
    std::size_t sights[2];  ///< of `sights_`
  };
  /// Nodes of a batch that a wall returns their populations to, a mirror turns round or the next row gives other
  /// offsets in a direction: side by side there too.
  struct exception {
    std::int32_t place;  ///< + lane: the slot × stride + node where what leaves arrives, or the index of ψ
    std::uint32_t lanes;
    std::uint8_t direction;
    bool same;  ///< ψ: one place for all
  };
  /// Nodes of a reservoir.
  struct held_batch {
    std::int32_t node[width];
    std::int32_t gate[directions][width];
    std::uint8_t tag;
  };
  struct plane {
    std::size_t first_run, last_run;
    std::size_t first_held, last_held;
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

  [[nodiscard]] static constexpr std::size_t reversed(std::size_t i) noexcept {
    return static_cast<std::size_t>(opposite(static_cast<int>(i)));
  }

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

  /// Lines of 64 bytes between the slots of a node are 27 + a multiple of 64: no two slots share a set of the cache.
  [[nodiscard]] static std::size_t stride_for(std::size_t nodes) noexcept {
    constexpr std::size_t per_line = detail::cache_line / sizeof(T);
    const std::size_t lines = (nodes + 2 * beyond) / per_line + 1;
    return (lines + (27 + 64 - lines % 64) % 64) * per_line;
  }
  [[nodiscard]] T* psi(std::size_t c) noexcept { return psi_[c].data() + beyond; }
  [[nodiscard]] static T* slots(detail::aligned_vector<T>& f, std::size_t stride, std::size_t c) noexcept {
    return f.data() + c * directions * stride;
  }

  void make_batches() {
    std::map<offsets, std::int32_t> known;
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      plane p{runs_.size(), 0, held_.size(), 0, 0, 0, std::min(x + 2, map_.plane_count())};
      const auto end = static_cast<std::size_t>(map_.plane_begin(x + 1));
      std::vector<std::int32_t> held;
      auto n = static_cast<std::size_t>(map_.plane_begin(x));
      while (n < end) {
        if (map_.at(n).kind == site_kind::reservoir) {
          held.push_back(static_cast<std::int32_t>(n++));
          continue;
        }
        add_batch(n, end, p.first_run, known);
        for (const std::size_t upto = std::min(n + width, end); n < upto; ++n) {
          if (map_.at(n).kind == site_kind::reservoir) {
            held.push_back(static_cast<std::int32_t>(n));
          }
        }
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
        held_.push_back(held_by(tag, std::span(held).subspan(k, upto - k)));
        k = upto;
      }
      p.last_run = runs_.size();
      p.last_held = held_.size();
      planes_.push_back(p);
    }
  }

  /// The batch that begins at a node of a plane.
  void add_batch(std::size_t n, std::size_t end, std::size_t first_run, std::map<offsets, std::int32_t>& known) {
    run_of_batches b{static_cast<std::int32_t>(n), 1, 0, 0, 0, 0, {gates_.size(), 0}, {sights_.size(), 0}};
    for (std::size_t lane = 0; lane < width; ++lane) {
      if (n + lane < end && map_.at(n + lane).kind != site_kind::reservoir) {
        b.used |= 1U << lane;
      }
    }
    offsets by{};
    for (std::size_t k = 0; k < directions; ++k) {
      typename site_map<lattice_type>::link to[width]{};
      std::int32_t seen[width]{};
      std::size_t most = 0;  // the offset of most nodes is that of the batch
      for (std::size_t lane = 0; lane < width; ++lane) {
        if ((b.used >> lane & 1U) != 0) {
          to[lane] = map_.leaving(n + lane, static_cast<int>(k));
          const auto s = map_.seen(n + lane, static_cast<int>(k));
          seen[lane] = slot_of(s.node, s.wall, s.image);
          std::size_t alike = 0;
          for (std::size_t other = 0; other <= lane; ++other) {
            alike += (b.used >> other & 1U) != 0 && to[lane].as == k && to[other].as == k &&
                             to[lane].to - to[other].to == static_cast<std::int32_t>(lane - other)
                         ? 1U
                         : 0U;
          }
          if (alike > most) {
            most = alike;
            by[k] = to[lane].to - static_cast<std::int32_t>(n + lane);
          }
        }
      }
      for (std::size_t lane = 0; lane < width; ++lane) {
        const auto there = static_cast<std::int32_t>(n + lane) + by[k];
        if ((b.used >> lane & 1U) == 0) {
          continue;
        }
        if (to[lane].as != k || to[lane].to != there) {
          b.streams |= 1U << k;
          except(gates_, b.gates[0], static_cast<std::int32_t>(to[lane].as * stride_) + to[lane].to, k, lane, false);
        }
        if (seen[lane] != there) {
          b.sees |= 1U << k;
          const bool wall = seen[lane] >= static_cast<std::int32_t>(stride_) &&
                            seen[lane] < static_cast<std::int32_t>(stride_ + tags);
          except(sights_, b.sights[0], seen[lane], k, lane, wall);
        }
      }
    }
    b.gates[1] = gates_.size();
    b.sights[1] = sights_.size();
    b.table = known.try_emplace(by, static_cast<std::int32_t>(tables_.size())).first->second;
    if (static_cast<std::size_t>(b.table) == tables_.size()) {
      tables_.push_back(by);
    }
    if (plain(b) && runs_.size() > first_run) {
      run_of_batches& last = runs_.back();
      if (plain(last) && last.table == b.table &&
          last.first + last.batches * static_cast<std::int32_t>(width) == b.first) {
        ++last.batches;
        return;
      }
    }
    runs_.push_back(b);
  }
  /// Joins the lane to an exception of the batch in the same direction where one fits.
  static void except(std::vector<exception>& all, std::size_t first, std::int32_t place, std::size_t k,
                     std::size_t lane, bool same) {
    const std::int32_t begin = same ? place : place - static_cast<std::int32_t>(lane);
    for (std::size_t e = all.size(); e > first && all[e - 1].direction == k; --e) {
      if (all[e - 1].place == begin && all[e - 1].same == same) {
        all[e - 1].lanes |= 1U << lane;
        return;
      }
    }
    all.push_back({begin, 1U << lane, static_cast<std::uint8_t>(k), same});
  }
  [[nodiscard]] static bool plain(const run_of_batches& b) noexcept {
    return b.used == all_lanes && (b.streams | b.sees) == 0;
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
    for (std::size_t x = 0; x < planes_.size(); ++x) {
      planes_[x].first_image = next;
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
      planes_[x].last_image = next;
      planes_[x].needs = std::max(planes_[x].needs, needs);
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

  [[nodiscard]] held_batch held_by(std::uint8_t tag, std::span<const std::int32_t> nodes) const {
    held_batch b{};
    b.tag = tag;
    for (std::size_t lane = 0; lane < width; ++lane) {
      const bool used = lane < nodes.size();
      b.node[lane] = used ? nodes[lane] : idle_;
      for (std::size_t k = 0; k < directions; ++k) {  // an idle lane's own gate: none writes where another reads
        const auto to = used ? map_.leaving(static_cast<std::size_t>(nodes[lane]), static_cast<int>(k))
                             : typename site_map<lattice_type>::link{idle_, static_cast<std::uint8_t>(k)};
        b.gate[k][lane] = static_cast<std::int32_t>(to.as * stride_ + static_cast<std::size_t>(to.to));
      }
    }
    return b;
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
          sum += image.weight[s] * psi(c)[static_cast<std::size_t>(image.from[s])];
        }
        psi(c)[static_cast<std::size_t>(image.slot)] = sum;
      }
    }
  }

  /// Where the numbers of the first batch of a run begin, for each component and direction.
  struct ports {
    const T* from[components][directions];
    T* to[components][directions];
    const T* seen[components][directions];
  };
  struct buffers {
    alignas(detail::cache_line) T carried[components][directions][width];
    alignas(detail::cache_line) T seen[components][directions][width];
  };

  /// The place of what leaves in direction k, in the slots of one component.
  template <stream S>
  [[nodiscard, gnu::always_inline]] std::ptrdiff_t departure(std::size_t k, std::int32_t n,
                                                             const offsets& by) const noexcept {
    const auto stride = static_cast<std::ptrdiff_t>(stride_);
    if constexpr (S == stream::turn) {
      return static_cast<std::ptrdiff_t>(reversed(k)) * stride + n;
    } else if constexpr (S == stream::exchange) {
      return static_cast<std::ptrdiff_t>(k) * stride + n + by[k];
    } else {
      return static_cast<std::ptrdiff_t>(k) * stride + n;
    }
  }
  /// The place of what arrives in direction i.
  template <stream S>
  [[nodiscard, gnu::always_inline]] std::ptrdiff_t arrival(std::size_t i, std::int32_t n,
                                                           const offsets& by) const noexcept {
    if constexpr (S == stream::pull) {
      return static_cast<std::ptrdiff_t>(i * stride_) + n + by[reversed(i)];
    } else {
      return departure<S>(reversed(i), n, by);  // populations change places in pairs
    }
  }
  /// The place of what arrives against what leaves through a gate; gates of a batch may begin before their slot.
  template <stream S>
  [[nodiscard, gnu::always_inline]] std::ptrdiff_t against(std::int32_t gate) const noexcept {
    if constexpr (S == stream::exchange) {
      return gate;
    } else {
      const auto stride = static_cast<std::ptrdiff_t>(stride_);
      const std::ptrdiff_t slot = (gate + static_cast<std::ptrdiff_t>(beyond)) / stride;
      return gate + (static_cast<std::ptrdiff_t>(reversed(static_cast<std::size_t>(slot))) - slot) * stride;
    }
  }

  /// What arrives in one component, with the directions that have exceptions drawn through a buffer.
  template <stream S>
  void receive(const run_of_batches& run, std::size_t c, const T* (&from)[directions], T (&buffer)[directions][width]) {
    const offsets& by = tables_[static_cast<std::size_t>(run.table)];
    const T* f = slots(f_, stride_, c);
    for (std::size_t i = 0; i < directions; ++i) {
      from[i] = f + arrival<S>(i, run.first, by);
    }
    if (S == stream::turn || run.streams == 0) {
      return;
    }
    for (std::uint32_t left = run.streams; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      number::load(from[reversed(k)]).store(buffer[k]);
      from[reversed(k)] = buffer[k];
    }
    for (std::size_t e = run.gates[0]; e < run.gates[1]; ++e) {
      const exception& x = gates_[e];
      T* const row = buffer[x.direction];
      number::select(x.lanes, number::load(f + against<S>(x.place)), number::load(row)).store(row);
    }
  }

  template <stream S>
  void prepare(std::size_t x) {
    const plane& p = planes_[x];
    const Model model = model_;
    buffers b;
    ports at;
    for (std::size_t c = 0; c < components; ++c) {
      T* const psi = this->psi(c);
      for (std::size_t r = p.first_run; r < p.last_run; ++r) {
        const run_of_batches& run = runs_[r];
        receive<S>(run, c, at.from[0], b.carried[0]);
        T* const shown = run.used == all_lanes ? psi + run.first : b.seen[0][0];
        const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(run.batches) * Lanes;
        for (std::ptrdiff_t n = 0; n < end; n += Lanes) {
          number g[directions];
          detail::repeat<count>([&]<int I>(detail::number<I>)
                                    TETRAPORE_INLINE { g[I] = number::load(at.from[0][I] + n); });
          model.potential(model.density_of(g, c)).store(shown + n);
        }
        for (std::size_t lane = 0; run.used != all_lanes && lane < width; ++lane) {
          if ((run.used >> lane & 1U) != 0) {
            psi[static_cast<std::size_t>(run.first) + lane] = shown[lane];
          }
        }
      }
      for (std::size_t h = p.first_held; h < p.last_held; ++h) {
        const T value = static_cast<T>(model.potential(reservoirs_[held_[h].tag][c]));
        for (const std::int32_t node : held_[h].node) {
          psi[node] = value;
        }
      }
    }
  }

  template <stream S>
  void update(std::size_t x) {
    const plane& p = planes_[x];
    const Model model = model_;
    auto& next = S == stream::pull ? next_ : f_;
    buffers b;
    ports at;
    for (std::size_t r = p.first_run; r < p.last_run; ++r) {
      const run_of_batches& run = runs_[r];
      const offsets& by = tables_[static_cast<std::size_t>(run.table)];
      const std::uint32_t kept = leaves_through_buffer<S>(run);
      for (std::size_t c = 0; c < components; ++c) {
        receive<S>(run, c, at.from[c], b.carried[c]);
        const T* const psi = this->psi(c);
        T* const f = slots(next, stride_, c);
        for (std::size_t k = 0; k < directions; ++k) {
          at.seen[c][k] = psi + run.first + by[k];
          at.to[c][k] = (kept >> k & 1U) != 0 ? b.carried[c][k] : f + departure<S>(k, run.first, by);
        }
        if (run.sees != 0) {
          see(run, psi, at.seen[c], b.seen[c]);
        }
      }
      const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(run.batches) * Lanes;
      for (std::ptrdiff_t n = 0; n < end; n += Lanes) {
        model.template collide<number>([&]<int C, int I>(detail::number<C>, detail::number<I>)
                                           TETRAPORE_INLINE { return number::load(at.from[C][I] + n); },
                                       [&]<int C, int I>(detail::number<C>, detail::number<I>)
                                           TETRAPORE_INLINE { return number::load(at.seen[C][I] + n); },
                                       [&]<int C, int I>(detail::number<C>, detail::number<I>, const number& value)
                                           TETRAPORE_INLINE { value.store(at.to[C][I] + n); });
      }
      if (kept != 0) {
        for (std::size_t c = 0; c < components; ++c) {
          send<S>(run, kept, slots(next, stride_, c), b.carried[c]);
        }
      }
    }
    for (std::size_t h = p.first_held; h < p.last_held; ++h) {
      hold<S>(held_[h], next);
    }
  }

  /// A bit for each direction in which not all lanes of a register may be written where they stand.
  template <stream S>
  [[nodiscard]] static std::uint32_t leaves_through_buffer(const run_of_batches& run) noexcept {
    constexpr auto all = static_cast<std::uint32_t>((std::uint64_t{1} << directions) - 1);
    return run.used != all_lanes ? all : S == stream::exchange ? run.streams : 0;
  }

  void see(const run_of_batches& run, const T* psi, const T* (&seen)[directions],
           T (&buffer)[directions][width]) const noexcept {
    for (std::uint32_t left = run.sees; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      number::load(seen[k]).store(buffer[k]);
      seen[k] = buffer[k];
    }
    for (std::size_t e = run.sights[0]; e < run.sights[1]; ++e) {
      const exception& x = sights_[e];
      T* const row = buffer[x.direction];
      const number shown = x.same ? number(psi[x.place]) : number::load(psi + x.place);
      number::select(x.lanes, shown, number::load(row)).store(row);
    }
  }

  /// Buffers go where their lanes belong: first all but the exceptions, then these.
  template <stream S>
  void send(const run_of_batches& run, std::uint32_t kept, T* f, const T (&buffer)[directions][width]) const noexcept {
    const offsets& by = tables_[static_cast<std::size_t>(run.table)];
    std::uint32_t there[directions];
    for (std::size_t k = 0; k < directions; ++k) {
      there[k] = run.used;
    }
    if constexpr (S == stream::exchange) {
      for (std::size_t e = run.gates[0]; e < run.gates[1]; ++e) {
        there[gates_[e].direction] &= ~gates_[e].lanes;
      }
    }
    for (std::uint32_t left = kept; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      T* const to = f + departure<S>(k, run.first, by);
      number::select(there[k], number::load(buffer[k]), number::load(to)).store(to);
    }
    if constexpr (S == stream::exchange) {
      for (std::size_t e = run.gates[0]; e < run.gates[1]; ++e) {
        const exception& x = gates_[e];
        T* const to = f + x.place;
        number::select(x.lanes, number::load(buffer[x.direction]), number::load(to)).store(to);
      }
    }
  }

  /// A batch of reservoir nodes: what leaves them does not depend on their neighbours.
  template <stream S>
  void hold(const held_batch& b, detail::aligned_vector<T>& next) {
    number f[components][directions];
    number rho[components];
    for (std::size_t c = 0; c < components; ++c) {
      const T* const from = slots(f_, stride_, c);
      for (std::size_t i = 0; i < directions; ++i) {
        for (std::size_t lane = 0; lane < width; ++lane) {
          f[c][i].v[lane] = S == stream::turn ? from[i * stride_ + static_cast<std::size_t>(b.node[lane])]
                                              : from[against<S>(b.gate[reversed(i)][lane])];
        }
      }
      rho[c] = number(static_cast<T>(reservoirs_[b.tag][c]));
    }
    model_.hold(f, rho);
    for (std::size_t c = 0; c < components; ++c) {
      T* const to = slots(next, stride_, c);
      for (std::size_t k = 0; k < directions; ++k) {
        for (std::size_t lane = 0; lane < width; ++lane) {
          const std::size_t slot = S == stream::turn ? reversed(k) : k;
          to[S == stream::exchange ? static_cast<std::size_t>(b.gate[k][lane])
                                   : slot * stride_ + static_cast<std::size_t>(b.node[lane])] = f[c][k].v[lane];
        }
      }
    }
  }

  Model model_;
  site_map<lattice_type> map_;
  std::size_t stride_ = 0;
  std::int32_t idle_ = 0;
  std::size_t steps_ = 0;
  detail::aligned_vector<T> f_;  ///< slots of all nodes, one behind the other, component by component
  detail::aligned_vector<T> next_;
  std::array<detail::aligned_vector<T>, components> psi_;
  std::array<densities, tags> walls_;
  std::array<densities, tags> reservoirs_;
  std::vector<offsets> tables_;
  std::vector<run_of_batches> runs_;
  std::vector<exception> gates_;
  std::vector<exception> sights_;
  std::vector<held_batch> held_;
  std::vector<plane> planes_;
  std::vector<image_slots> images_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
