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
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

/// \file
/// What the nodes of a mixture see of each other, of walls, reservoirs and mirrors: ψ of every cell.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

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

/// The part that all storages share. `Turned` as in row_layout.
template <class Model, std::floating_point T, int Lanes, bool Turned>
class surroundings {
 public:
  using lattice_type = typename Model::lattice_type;
  static constexpr std::size_t components = Model::components;
  static constexpr std::size_t directions = Model::directions;
  using densities = std::array<double, components>;

  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] const site_map<lattice_type>& sites() const noexcept { return map_; }

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

 protected:
  static constexpr std::size_t tags = 256;
  static constexpr std::int32_t none = site_map<lattice_type>::none;
  static constexpr std::size_t width = static_cast<std::size_t>(Lanes);
  static constexpr std::size_t per_line = cache_line / sizeof(T);
  static constexpr std::size_t beyond = std::max<std::size_t>(width, per_line);
  static_assert(Lanes >= 1 && Lanes <= 32, "a bit of 32 for each node of a batch");
  using layout_type = row_layout<lattice_type, Turned>;
  using run_type = typename layout_type::run;

  /// ψ of a point beyond a mirror, from nodes and walls.
  struct image_cells {
    std::int32_t from[8];
    T weight[8];
    std::size_t count;
    std::int32_t cell;
  };
  /// The images that a plane is the first to see.
  struct image_range {
    std::size_t first, last;
    std::size_t needs;  ///< how many planes must show their ψ before this one is updated
  };

  surroundings(const Model& model, site_map<lattice_type> map, std::size_t aligned)
      : model_(model), map_(std::move(map)), rows_(map_, width, per_line, aligned) {
    for (const auto& c : model_.collisions) {
      if (!(c.tau > 0.5)) {
        throw parameter_error("collision", "tau = " + short_number(c.tau), "more than 0.5");
      }
    }
    lay_psi(0);
    walls_.fill(model_.reference);
    reservoirs_.fill(model_.reference);
    make_images();
  }

  /// ψ of all cells, and of so many that belong to no place, as at the reference densities.
  void lay_psi(std::size_t more) {
    psi_step_ = apart(static_cast<std::size_t>(first_free_cell()) + more + beyond);
    psi_.resize(beyond + components * psi_step_);
    for (std::size_t c = 0; c < components; ++c) {
      std::fill_n(psi(c), psi_step_, static_cast<T>(model_.potential(model_.reference[c])));
    }
  }

  /// Equilibria of all nodes: `of(place, rho, u)` says of which density and velocity, `put(component, node, f)` takes
  /// the populations.
  template <class Of, class Put>
  void lay_equilibria(Of& of, const Put& put) const {
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
        put(c, n, f);
      }
    }
  }

  [[nodiscard]] T* psi(std::size_t c) noexcept { return psi_.data() + beyond + c * psi_step_; }
  /// Numbers between ψ of two components.
  [[nodiscard]] std::size_t psi_step() const noexcept { return psi_step_; }
  /// At least so many numbers between arrays that are worked on together; they do not share a set of the cache.
  [[nodiscard]] static constexpr std::size_t apart(std::size_t count) noexcept {
    const std::size_t lines = count / per_line + 1;
    return (lines + (27 + 64 - lines % 64) % 64) * per_line;
  }
  /// Where ψ of walls of a tag is kept.
  [[nodiscard]] std::int32_t cell_of_wall(std::uint8_t tag) const noexcept {
    return rows_.face() + static_cast<std::int32_t>(rows_.longest() + width) + tag;
  }
  /// Behind all cells that show something.
  [[nodiscard]] std::int32_t first_free_cell() const noexcept {
    return cell_of_wall(0) + static_cast<std::int32_t>(tags);
  }
  /// The lanes of a batch whose nodes belong to a run.
  [[nodiscard]] static constexpr std::uint32_t lanes_of(std::ptrdiff_t left) noexcept {
    return static_cast<std::uint32_t>((std::uint64_t{1} << static_cast<std::size_t>(left)) - 1);
  }

  void show_images(std::size_t first, std::size_t last) noexcept {
    for (std::size_t k = first; k < last; ++k) {
      const auto& image = images_[k];
      std::array<T, components> sum{};
      for (std::size_t s = 0; s < image.count; ++s) {
        for (std::size_t c = 0; c < components; ++c) {
          sum[c] += image.weight[s] * psi(c)[image.from[s]];
        }
      }
      for (std::size_t c = 0; c < components; ++c) {
        psi(c)[image.cell] = sum[c];
      }
    }
  }
  void show_copies(std::size_t c, std::size_t first, std::size_t last) noexcept {
    for (std::size_t k = first; k < last; ++k) {
      psi(c)[rows_.copies()[k].to] = psi(c)[rows_.copies()[k].from];
    }
  }

  /// ψ of what a node sees; `density(component, node)`.
  template <class Density>
  [[nodiscard]] double psi_of(std::size_t c, const typename site_map<lattice_type>::sight& s, Density density) const {
    if (s.image == none) {
      double rho = walls_[s.wall][c];
      if (s.node != none) {
        const site what = map_.at(static_cast<std::size_t>(s.node));
        rho =
            what.kind == site_kind::reservoir ? reservoirs_[what.tag][c] : density(c, static_cast<std::size_t>(s.node));
      }
      return model_.potential(rho);
    }
    const auto& image = map_.images()[static_cast<std::size_t>(s.image)];
    double sum = 0;
    for (std::size_t k = 0; k < image.count; ++k) {
      sum += image.from[k].weight * psi_of(c, {image.from[k].node, none, image.from[k].wall}, density);
    }
    return sum;
  }

  /// The mass of a component: what `excess(node, add)` adds for each node that is no reservoir, and its reference.
  template <class Excess>
  [[nodiscard]] double mass_of(std::size_t c, Excess excess) const {
    double total = 0;
    double lost = 0;  // Kahan's correction
    std::size_t nodes = 0;
    for (std::size_t n = 0; n < map_.size(); ++n) {
      if (map_.at(n).kind == site_kind::reservoir) {
        continue;
      }
      ++nodes;
      excess(n, [&](double more) {
        const double x = more - lost;
        const double sum = total + x;
        lost = (sum - total) - x;
        total = sum;
      });
    }
    return total + model_.reference[c] * static_cast<double>(nodes);
  }

  Model model_;
  site_map<lattice_type> map_;
  layout_type rows_;
  std::array<densities, tags> walls_;
  std::array<densities, tags> reservoirs_;
  std::vector<image_cells> images_;
  std::vector<image_range> image_ranges_;  ///< for each plane

 private:
  aligned_vector<T> psi_;
  std::size_t psi_step_ = 0;

  /// Images in the order of the first plane that sees them.
  void make_images() {
    std::size_t needs = 0;
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      image_range r{images_.size(), 0, std::min(x + 2, map_.plane_count())};
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
      r.last = images_.size();
      r.needs = std::max(r.needs, needs);
      image_ranges_.push_back(r);
    }
  }
};

}  // namespace detail

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
