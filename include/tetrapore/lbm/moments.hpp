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
/// middle one. Only moments are read from and written to memory. Where planes are large a step goes through the box
/// strip by strip, each of so few rows that its planes fit in the cache; what leaves the rows beside a strip is worked
/// out twice.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

template <class Model, std::floating_point T, int Lanes>
class simulation<Model, T, storage::moments, Lanes> : public detail::surroundings<Model, T, Lanes, false> {
  static_assert(
      requires { requires Model::collision_type::equilibrium_at_one; } && !Model::forcing_type::carries_source,
      "storage::moments takes bgk or regularised with tau = 1 and velocity_shift: other nodes send more than density "
      "and momentum tell");
  using base = detail::surroundings<Model, T, Lanes, false>;

 public:
  using base::components;
  using base::directions;
  using typename base::densities;
  using typename base::lattice_type;

  /// All nodes at the mixture's reference densities, at rest; walls and reservoirs show them too.
  /// \param in_cache  bytes that what leaves the planes in use may take: a share of the last cache
  /// \throw parameter_error  a collision with another τ than 1; 2^32 populations or more
  simulation(const Model& model, site_map<lattice_type> map, std::size_t in_cache = std::size_t{3} << 20U)
      : base(model, std::move(map), width) {
    for (const auto& c : model_.collisions) {
      if (c.tau != 1) {
        throw parameter_error("collision", "tau = " + short_number(c.tau), "1 where moments alone are kept");
      }
    }
    place_nodes();
    cut_strips(in_cache);
  }

  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

  void set_wall(std::uint8_t tag, const densities& rho) {
    base::set_wall(tag, rho);
    stale_ = true;
  }
  void set_reservoir(std::uint8_t tag, const densities& rho) {
    base::set_reservoir(tag, rho);
    stale_ = true;
  }

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
    if (stale_) {
      show();
      stale_ = false;
    }
    for (std::size_t c = 0; c < components; ++c) {
      this->show_copies(c, 0, rows_.copies().size());
    }
    this->show_images(0, this->images_.size());
    for (std::size_t k = 0; k < strips_.size(); ++k) {
      sweep(strips_[k]);
      if (k > 0) {
        catch_up(strips_[k - 1].late);
      }
    }
    catch_up(early_);
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
    return state_[place_of(component, node, k)];
  }
  [[nodiscard]] const T& moment(std::size_t component, std::size_t node, std::size_t k) const noexcept {
    return state_[place_of(component, node, k)];
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
  using base::apart;
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
  static constexpr std::size_t numbers = components * moments;
  using number = pack<T, Lanes>;
  /// Nodes at the end of a run that half a register of 64 bytes holds are worked out in one: a core that takes two
  /// steps for the whole gains by it.
  static constexpr int half_lanes = Lanes * sizeof(T) == 64 ? Lanes / 2 : 0;
  using half_number = pack<T, half_lanes == 0 ? Lanes : half_lanes>;

  /// Planes of which that is kept that leaves forward in x, and the rest.
  static constexpr std::size_t forward_planes = 3;
  static constexpr std::size_t other_planes = 2;

  /// A run whose nodes send.
  struct departure {
    std::uint32_t batch;  ///< the first
    std::int32_t nodes;
    std::uint32_t to;                               ///< less the beginnings of slot and plane
    std::array<std::int32_t, directions - 1> seen;  ///< the cells that its first node sees
  };
  /// The same of a reservoir.
  struct held_departure {
    std::uint32_t batch;
    std::int32_t nodes;
    std::uint32_t to;
    std::uint8_t tag;
  };
  /// A run whose nodes receive, and where what arrives at its first node in each direction has left. Late ones have
  /// cells and batches that belong to no place.
  struct arrival {
    std::uint32_t batch;  ///< the first
    std::int32_t nodes;
    std::int32_t cell;  ///< of the first node
    std::array<std::uint32_t, directions> from;
  };
  /// Cells that show a reservoir.
  struct held_cells {
    std::int32_t cell, nodes;
    std::uint8_t tag;
  };
  /// What arrives from a cell that is no node, and where it has left.
  struct link {
    std::uint32_t cell;
    std::uint32_t from;
  };
  /// What of all lists belongs to one plane of a strip.
  struct strip_plane {
    std::size_t first_departure, last_departure;
    std::size_t first_held_departure, last_held_departure;
    std::size_t first_arrival, last_arrival;
    std::size_t first_held_cells, last_held_cells;
    std::size_t first_link, last_link;
  };
  /// Nodes that get their new numbers when another strip has been swept that still needs the old ones.
  struct late_run {
    std::int32_t cell, nodes;
    std::uint32_t batch;
    std::int32_t from_cell;
    std::uint32_t from_batch;
  };
  /// Rows that are swept together through all planes.
  struct strip {
    std::vector<strip_plane> planes;
    std::vector<late_run> late;  ///< until the next strip has been swept
  };

  /// So many batches ahead what is not in the cache is asked for.
  static constexpr std::size_t soon = 8;
  static constexpr std::size_t farthest = static_cast<std::size_t>(direction_of<lattice_type>(1, 1, 0));
  /// What a record of a run says is read for each batch: runs are short, and to keep it all in registers costs more.
  template <class Record>
  [[gnu::always_inline]] static void forget(const Record*& record) noexcept {
    asm volatile("" : "+r"(record));
  }
  [[gnu::always_inline]] static void prefetch(const T* p) noexcept { __builtin_prefetch(p, 0, 2); }

  [[nodiscard]] std::size_t place_of(std::size_t component, std::size_t node, std::size_t k) const noexcept {
    const std::size_t at = batch_lane_[node];
    return (at / width * numbers + component * moments + k) * width + at % width;
  }
  [[nodiscard]] bool wraps(std::size_t axis) const noexcept { return map_.box().low[axis] == face_kind::periodic; }
  [[nodiscard]] static constexpr std::size_t batches_of(std::int32_t nodes) noexcept {
    return (static_cast<std::size_t>(nodes) + width - 1) / width;
  }

  /// The moments of a batch lie together, batches in the order of runs.
  void place_nodes() {
    std::vector<std::uint32_t> lane_of_cell(rows_.cells());
    for (const run_type& run : rows_.runs()) {
      batch_of_run_.push_back(static_cast<std::uint32_t>(batches_));
      for (std::int32_t k = 0; k < run.nodes; ++k) {
        lane_of_cell[static_cast<std::size_t>(run.cell + k)] =
            static_cast<std::uint32_t>(batches_ * width) + static_cast<std::uint32_t>(k);
      }
      batches_ += batches_of(run.nodes);
    }
    batch_lane_.resize(map_.size());
    for (std::size_t n = 0; n < map_.size(); ++n) {
      batch_lane_[n] = lane_of_cell[static_cast<std::size_t>(rows_.cell(n))];
    }
  }

  /// The rows that the nodes of some rows of a plane receive from, in their order.
  [[nodiscard]] std::vector<std::size_t> sending(std::size_t first, std::size_t last) const {
    const auto count = static_cast<int>(rows_.rows_of_plane());
    const bool around = wraps(rows_.across());
    std::vector<std::size_t> rows;
    for (int a = static_cast<int>(first) - 1; a <= static_cast<int>(last); ++a) {
      if (around || (a >= 0 && a < count)) {
        rows.push_back(static_cast<std::size_t>((a + count) % count));
      }
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  }
  [[nodiscard]] const typename layout_type::row_range& row(std::size_t x, std::size_t a) const noexcept {
    return rows_.rows()[x * rows_.rows_of_plane() + a];
  }
  /// Where the cells of a plane's rows lie in the order of `rows`, less the cells; the last one: how many there are.
  [[nodiscard]] std::vector<std::ptrdiff_t> shifts(std::size_t x, const std::vector<std::size_t>& rows) const {
    std::vector<std::ptrdiff_t> by;
    std::ptrdiff_t next = 0;
    for (const std::size_t a : rows) {
      const auto& r = row(x, a);
      next += (r.first_cell - next) & static_cast<std::ptrdiff_t>(width - 1);  // as cells lie: to a multiple
      by.push_back(next - r.first_cell);
      next += r.last_cell - r.first_cell;
    }
    by.push_back(next);
    return by;
  }
  [[nodiscard]] std::size_t most_cells(const std::vector<std::size_t>& rows) const {
    std::ptrdiff_t most = 0;
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      most = std::max(most, shifts(x, rows).back());
    }
    return static_cast<std::size_t>(most);
  }

  void cut_strips(std::size_t in_cache) {
    static_assert((width & (width - 1)) == 0, "a batch is a power of two");
    constexpr std::size_t per_cell =
        sizeof(T) * components * (directions * other_planes + directions / 3 * (forward_planes - other_planes));
    const std::size_t rows = rows_.rows_of_plane();
    std::size_t count = 0;
    std::size_t most = 0;
    do {
      ++count;
      most = 0;
      for (std::size_t k = 0; k < count; ++k) {
        most = std::max(most, most_cells(sending(rows * k / count, rows * (k + 1) / count)));
      }
    } while (2 * (count + 1) <= rows && most * per_cell > in_cache);
    sent_step_ = apart(most + beyond);
    plane_step_ = components * directions * sent_step_;
    sent_.assign((forward_planes + (wraps(0) ? 1 : 0)) * plane_step_ + beyond, T(0));
    std::vector<std::uint32_t> row_of_cell(rows_.cells());
    for (std::size_t r = 0; r < rows_.rows().size(); ++r) {
      const auto& of = rows_.rows()[r];
      std::fill(row_of_cell.begin() + of.first_cell, row_of_cell.begin() + of.last_cell, static_cast<std::uint32_t>(r));
    }
    std::size_t most_late = 0;  // of strips that wait for the next one: two at a time
    for (std::size_t k = 1; k < count; ++k) {
      most_late = std::max(most_late, batches_of_rows(rows * k / count - 2, rows * k / count));
    }
    for (std::size_t k = 0; k < count; ++k) {
      cut(rows * k / count, rows * (k + 1) / count, row_of_cell, k % 2 * most_late, 2 * most_late);
    }
    const std::size_t late = 2 * most_late + (count > 1 ? batches_of_rows(0, 2) : 0);
    state_.assign((batches_ + late + soon) * numbers * width, T(0));
    this->lay_psi((late + soon) * width);
  }
  [[nodiscard]] std::size_t batches_of_rows(std::size_t first, std::size_t last) const noexcept {
    std::size_t batches = 0;
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      for (std::size_t r = row(x, first).first_run; r < row(x, last - 1).last_run; ++r) {
        batches += batches_of(rows_.runs()[r].nodes);
      }
    }
    return batches;
  }
  /// Rows first … last − 1. The last two are needed as they were by the next strip, the first two of all by the last
  /// one of a box that is periodic there.
  void cut(std::size_t first, std::size_t last, const std::vector<std::uint32_t>& row_of_cell, std::size_t late_at,
           std::size_t early_at) {
    const std::size_t rows = rows_.rows_of_plane();
    const std::vector<std::size_t> from = sending(first, last);
    std::vector<std::ptrdiff_t> shift(rows_.rows().size());
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      const auto by = shifts(x, from);
      for (std::size_t a = 0; a < from.size(); ++a) {
        shift[x * rows + from[a]] = by[a];
      }
    }
    const auto place_from = [&](std::size_t place) {  // what the layout stores there has left against it
      const auto slot = static_cast<std::size_t>(opposite(static_cast<int>(place / rows_.stride())));
      const std::size_t cell = place % rows_.stride();
      const std::size_t r = row_of_cell[cell];
      return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(slot * sent_step_ + plane_of(slot, r / rows)) +
                                        static_cast<std::ptrdiff_t>(cell) + shift[r]);
    };
    strip s;
    for (std::size_t x = 0; x < map_.plane_count(); ++x) {
      strip_plane p{departures_.size(), 0, held_departures_.size(), 0, arrivals_.size(), 0,
                    held_cells_.size(), 0, links_.size(),           0};
      for (const std::size_t a : from) {
        for (std::size_t r = row(x, a).first_run; r < row(x, a).last_run; ++r) {
          add_departures(r, static_cast<std::uint32_t>(rows_.runs()[r].cell + shift[x * rows + a]));
        }
      }
      for (std::size_t a = first; a < last; ++a) {
        const bool early = first == 0 && a < 2 && last < rows && wraps(rows_.across());
        const bool late = last < rows && a + 2 >= last;
        for (std::size_t r = row(x, a).first_run; r < row(x, a).last_run; ++r) {
          const run_type& run = rows_.runs()[r];
          const auto& by = rows_.tables()[static_cast<std::size_t>(run.table)];
          arrival to{batch_of_run_[r], run.nodes, run.cell, {}};
          if (early || late) {
            std::size_t& at = early ? early_at : late_at;
            to.batch = static_cast<std::uint32_t>(batches_ + at);
            to.cell = this->first_free_cell() + static_cast<std::int32_t>(at * width);
            (early ? early_ : s.late).push_back({run.cell, run.nodes, batch_of_run_[r], to.cell, to.batch});
            at += batches_of(run.nodes);
          }
          if (run.what.kind == site_kind::reservoir) {
            held_cells_.push_back({to.cell, run.nodes, run.what.tag});
          }
          for (std::size_t k = 0; k < directions; ++k) {
            to.from[static_cast<std::size_t>(opposite(static_cast<int>(k)))] =
                place_from(static_cast<std::size_t>(by.to[k] + static_cast<std::int64_t>(rows_.place(run.cell, 0))));
          }
          arrivals_.push_back(to);
        }
        for (std::size_t l = row(x, a).first_link; l < row(x, a).last_link; ++l) {
          links_.push_back({place_from(rows_.links()[l].cell), place_from(rows_.links()[l].gate)});
        }
      }
      p.last_departure = departures_.size();
      p.last_held_departure = held_departures_.size();
      p.last_held_cells = held_cells_.size();
      p.last_arrival = arrivals_.size();
      p.last_link = links_.size();
      s.planes.push_back(p);
    }
    strips_.push_back(std::move(s));
  }
  void add_departures(std::size_t r, std::uint32_t to) {
    const run_type& run = rows_.runs()[r];
    const auto& by = rows_.tables()[static_cast<std::size_t>(run.table)];
    if (run.what.kind == site_kind::reservoir) {
      held_departures_.push_back({batch_of_run_[r], run.nodes, to, run.what.tag});
      return;
    }
    departure d{batch_of_run_[r], run.nodes, to, {}};
    for (std::size_t k = 1; k < directions; ++k) {
      d.seen[k - 1] = run.cell + by.seen[k];
    }
    departures_.push_back(d);
  }
  /// Where what leaves a plane lies in a slot. A periodic box needs its first and last plane at both ends of a sweep.
  [[nodiscard]] std::size_t plane_of(std::size_t slot, std::size_t x) const noexcept {
    const int ahead = lattice_type::velocity[slot][0];
    std::size_t order = ahead > 0 ? x % forward_planes : x % other_planes;
    if (wraps(0) && x + 1 == map_.plane_count()) {
      order = forward_planes;
    } else if (wraps(0) && x == 0 && ahead < 0) {
      order = other_planes;
    }
    return order * plane_step_;
  }

  void sweep(const strip& s) {
    const std::size_t planes = s.planes.size();
    if (wraps(0)) {
      send(s.planes[planes - 1], planes - 1);
    }
    std::size_t sent = 0;
    for (std::size_t x = 0; x < planes; ++x) {
      for (; sent < std::min(x + 2, planes); ++sent) {
        if (!(wraps(0) && sent + 1 == planes)) {
          send(s.planes[sent], sent);
        }
      }
      receive(s.planes[x]);
    }
  }
  /// New numbers that had to wait.
  void catch_up(const std::vector<late_run>& runs) {
    for (const late_run& run : runs) {
      std::copy_n(batch(run.from_batch), batches_of(run.nodes) * numbers * width, batch(run.batch));
      for (std::size_t c = 0; c < components; ++c) {
        std::copy_n(this->psi(c) + run.from_cell, run.nodes, this->psi(c) + run.cell);
      }
    }
  }
  [[nodiscard, gnu::always_inline]] T* batch(std::uint32_t b) noexcept {
    return state_.data() + static_cast<std::size_t>(b) * (numbers * width);
  }

  /// What leaves the nodes of a plane. Numbers beyond the end of a run are nobody's or written later; reservoirs, which
  /// come last, write none.
  void send(const strip_plane& p, std::size_t x) {
    const Model model = model_;
    const std::size_t sent_step = sent_step_;
    const std::size_t psi_step = this->psi_step();
    const T* const psi = this->psi(0);
    T* const planes[3] = {sent_.data() + plane_of(2, x), sent_.data() + plane_of(0, x), sent_.data() + plane_of(1, x)};
    const auto moment_of = []<class Number>(const T* from, std::type_identity<Number>) TETRAPORE_INLINE {
      return [from]<int C, int K>(detail::number<C>, detail::number<K>)
                 TETRAPORE_INLINE { return Number::load(from + (C * moments + K) * width); };
    };
    const auto place_of_sent = [&]<int C, int I>(detail::number<C>, detail::number<I>) TETRAPORE_INLINE {
      return planes[1 + lattice_type::velocity[I][0]] + (static_cast<std::size_t>(C) * directions + I) * sent_step;
    };
    for (std::size_t k = p.first_departure; k < p.last_departure; ++k) {
      const departure* d = &departures_[k];
      std::int32_t left = d->nodes;
      const T* from = batch(d->batch);
      const T* shown = psi;
      std::uint32_t to = d->to;
      const auto depart = [&]<class Number>(std::type_identity<Number> of) TETRAPORE_INLINE {
        for (std::size_t j = 0; j < numbers; ++j) {
          prefetch(from + (soon * numbers + j) * width);
        }
        for (std::size_t c = 0; c < components; ++c) {
          prefetch(shown + c * psi_step + d->seen[farthest - 1] + soon * width);
        }
        model.template depart<Number>(
            moment_of(from, of),
            [&]<int C, int I>(detail::number<C>, detail::number<I>)
                TETRAPORE_INLINE { return Number::load(shown + d->seen[I - 1] + C * psi_step); },
            [&]<int C, int I>(detail::number<C> c, detail::number<I> i, const Number& value)
                TETRAPORE_INLINE { value.store(place_of_sent(c, i) + to); });
      };
      for (; left > half_lanes; left -= Lanes) {
        depart(std::type_identity<number>{});
        from += numbers * width;
        shown += width;
        to += static_cast<std::uint32_t>(width);
        forget(d);
      }
      if constexpr (half_lanes > 0) {
        if (left > 0) {
          depart(std::type_identity<half_number>{});
        }
      }
    }
    for (std::size_t k = p.first_held_departure; k < p.last_held_departure; ++k) {
      const held_departure& d = held_departures_[k];
      number rho[components];
      for (std::size_t c = 0; c < components; ++c) {
        rho[c] = number(static_cast<T>(reservoirs_[d.tag][c]));
      }
      const T* from = batch(d.batch);
      for (std::int32_t n = 0; n < d.nodes; n += Lanes, from += numbers * width) {
        const std::uint32_t lanes = base::lanes_of(std::min(d.nodes - n, Lanes));
        model.template depart_held<number>(
            rho, moment_of(from, std::type_identity<number>{}),
            [&]<int C, int I>(detail::number<C> c, detail::number<I> i, const number& value) TETRAPORE_INLINE {
              T* const to = place_of_sent(c, i) + d.to + n;
              number::select(lanes, value, number::load(to)).store(to);
            });
      }
    }
  }

  /// The moments of what arrives in a plane, and ψ.
  void receive(const strip_plane& p) {
    const Model model = model_;
    const std::size_t component_step = directions * sent_step_;
    T* const sent = sent_.data();
    for (std::size_t k = p.first_link; k < p.last_link; ++k) {
      const link l = links_[k];
      for (std::size_t c = 0; c < components; ++c) {
        sent[l.cell + c * component_step] = sent[l.from + c * component_step];
      }
    }
    const std::size_t psi_step = this->psi_step();
    T* const psi = this->psi(0);
    for (std::size_t k = p.first_arrival; k < p.last_arrival; ++k) {
      const arrival* a = &arrivals_[k];
      const T* from = sent;
      T* to = batch(a->batch);
      T* shown = psi + a->cell;
      std::int32_t left = a->nodes;
      const auto arrive = [&]<class Number>(std::type_identity<Number>, int most) TETRAPORE_INLINE {
        const std::uint32_t lanes = base::lanes_of(std::min(left, most));
        Model::template arrive<Number>(
            [&]<int C, int I>(detail::number<C>, detail::number<I>)
                TETRAPORE_INLINE { return Number::load(from + a->from[I] + C * component_step); },
            [&]<int C, int K>(detail::number<C>, detail::number<K>, const Number& value) TETRAPORE_INLINE {
              value.store(to + (C * moments + K) * width);
              if constexpr (K == 0) {
                T* const now = shown + C * psi_step;
                Number::select(lanes, model.potential(Number(static_cast<T>(model.reference[C])) + value),
                               Number::load(now))
                    .store(now);
              }
            });
      };
      for (; left > half_lanes; left -= Lanes) {
        arrive(std::type_identity<number>{}, Lanes);
        from += width;
        to += numbers * width;
        shown += width;
        forget(a);
      }
      if constexpr (half_lanes > 0) {
        if (left > 0) {
          arrive(std::type_identity<half_number>{}, half_lanes);
        }
      }
    }
    for (std::size_t k = p.first_held_cells; k < p.last_held_cells; ++k) {
      const held_cells& h = held_cells_[k];
      for (std::size_t c = 0; c < components; ++c) {
        std::fill_n(psi + c * psi_step + h.cell, h.nodes, shown_by(h.tag, c));
      }
    }
  }
  /// ψ of a reservoir.
  [[nodiscard]] T shown_by(std::uint8_t tag, std::size_t c) const noexcept {
    return static_cast<T>(model_.potential(reservoirs_[tag][c]));
  }

  /// ψ of all nodes from their moments, and that of walls.
  void show() {
    for (std::size_t c = 0; c < components; ++c) {
      for (std::size_t r = 0; r < rows_.runs().size(); ++r) {
        const run_type& run = rows_.runs()[r];
        for (std::int32_t n = 0; n < run.nodes; ++n) {
          const std::size_t at = batch_of_run_[r] * width + static_cast<std::size_t>(n);
          const T excess = state_[(at / width * numbers + c * moments) * width + at % width];
          this->psi(c)[run.cell + n] = run.what.kind == site_kind::reservoir
                                           ? shown_by(run.what.tag, c)
                                           : model_.potential(static_cast<T>(model_.reference[c]) + excess);
        }
      }
    }
  }

  std::size_t steps_ = 0;
  bool stale_ = true;  ///< whether ψ has to be worked out from moments, walls and reservoirs
  std::size_t plane_step_ = 0;
  std::size_t sent_step_ = 0;
  detail::aligned_vector<T> state_;  ///< the moments of a batch side by side
  std::size_t batches_ = 0;
  std::vector<std::uint32_t> batch_of_run_;  ///< its first
  std::vector<std::uint32_t> batch_lane_;    ///< of each node: width × its batch and its lane there
  detail::aligned_vector<T> sent_;           ///< populations that have left the planes in use, slot by slot
  std::vector<strip> strips_;
  std::vector<late_run> early_;  ///< what waits until the last strip has been swept
  std::vector<departure> departures_;
  std::vector<held_departure> held_departures_;
  std::vector<arrival> arrivals_;
  std::vector<held_cells> held_cells_;
  std::vector<link> links_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
