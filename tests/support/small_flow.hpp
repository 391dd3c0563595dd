// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/gather.hpp"
#include "tetrapore/packing/lattice.hpp"
#include "tetrapore/simplex/throat_hydraulics.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

/// \file
/// The pressure in a small periodic network under a mean gradient, without any cleverness: what a conductance law gives
/// for a permeability and for the forces on the grains.

/// Lattice of spheres of radius 1 that do not touch: a block of `cells`³ cells, periodic, of the given solid fraction.
[[nodiscard]] inline tetrapore::packing open_lattice(tetrapore::lattice_kind kind, double solid_fraction,
                                                     std::size_t cells) {
  using namespace tetrapore;
  packing p = lattice(kind, {cells, cells, cells}, 1.0, {true, true, true});
  const double touching = static_cast<double>(p.grains.size()) * 4.0 / 3.0 * pi<double> / p.bounds->volume();
  const double stretch = std::cbrt(touching / solid_fraction);
  for (auto& g : p.grains) {
    g.centre *= stretch;
  }
  p.bounds->lo *= stretch;
  p.bounds->hi *= stretch;
  return p;
}

/// A throat of the pressure system: between two different nodes.
struct small_throat {
  tetrapore::throat<double> shape;
  std::array<std::size_t, 2> node;
  std::array<tetrapore::vertex, 3> vertices;
};

/// A periodic network reduced to nodes: pores whose centres coincide are one, and a cell too flat to have a centre of
/// its own takes that of a neighbour.
class small_flow {
 public:
  explicit small_flow(const tetrapore::network& net) : grains_(net.grain_count()) {
    using namespace tetrapore;
    const std::size_t n = net.pore_count();
    // flat cells hand over to a neighbour, wave by wave
    std::vector<vec3<double>> centre(n);
    std::vector<char> known(n);
    for (std::size_t i = 0; i < n; ++i) {
      centre[i] = net.power_centre(pore_id(i));
      const auto body = pore_body_at(net, pore_id(i));
      double longest = 0;
      for (std::size_t a = 0; a < body.grain_count; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          longest = std::max(longest, norm(body.grains[a].centre - body.grains[b].centre));
        }
      }
      known[i] = std::abs(net.volume(pore_id(i))) > 1e-6 * longest * longest * longest;
    }
    for (bool waiting = true; waiting;) {
      waiting = false;
      auto next = known;
      for (std::size_t t = 0; t < net.throat_count(); ++t) {
        if (net.is_boundary(throat_id(t))) {
          continue;
        }
        const std::size_t i = net.pores(throat_id(t))[0].index();
        const std::size_t j = net.pores(throat_id(t))[1].index();
        const vec3<double> shift = net.region().shift(net.shift(throat_id(t)));
        if (known[i] != 0 && next[j] == 0) {
          centre[j] = centre[i] - shift;
          next[j] = 1;
        } else if (known[j] != 0 && next[i] == 0) {
          centre[i] = centre[j] + shift;
          next[i] = 1;
        }
      }
      if (next != known) {
        waiting = true;
        known = next;
      }
    }
    std::vector<std::size_t> root(n);
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
      while (root[i] != i) {
        i = root[i] = root[root[i]];
      }
      return i;
    };
    std::vector<small_throat> all;
    for (std::size_t t = 0; t < net.throat_count(); ++t) {
      const throat_id id(t);
      if (net.is_boundary(id)) {
        continue;
      }
      small_throat s{throat_at(net, id), {net.pores(id)[0].index(), net.pores(id)[1].index()}, {}};
      s.shape.nodes = {centre[s.node[0]], centre[s.node[1]] + net.region().shift(net.shift(id))};
      const auto slots = facet_slots(net, net.pores(id)[0], net.slot(id, 0));
      for (std::size_t k = 0; k < 3; ++k) {
        s.vertices[k] = net.vertices(net.pores(id)[0])[slots[k]];
      }
      if (norm(s.shape.nodes[1] - s.shape.nodes[0]) < 1e-6 * std::sqrt(norm(s.shape.area_vector))) {
        root[find(s.node[0])] = find(s.node[1]);
      } else {
        all.push_back(s);
      }
    }
    for (small_throat& s : all) {
      s.node = {find(s.node[0]), find(s.node[1])};
    }
    throats_ = std::move(all);
    size_ = n;
    volume_ = net.region().bounds.volume();
  }

  [[nodiscard]] const std::vector<small_throat>& throats() const { return throats_; }

  /// Conductance per throat; what is absent is 0, what is refused is counted.
  template <class Law>
  [[nodiscard]] std::vector<double> conductances(const Law& law, std::size_t* refused = nullptr) const {
    std::vector<double> k(throats_.size());
    for (std::size_t t = 0; t < k.size(); ++t) {
      const auto answer = law.conductance(throats_[t].shape);
      if (answer.kind() == tetrapore::verdict::refused) {
        if (refused == nullptr) {
          throw std::runtime_error(describe(answer.reason));
        }
        ++*refused;
      } else {
        k[t] = answer.value;
      }
    }
    return k;
  }

  struct solution {
    tetrapore::vec3<double> mean_flux;  ///< per mean gradient: a row of the permeability over the viscosity
    std::vector<double> drop;           ///< pressure difference per throat
  };

  /// Mean pressure gradient -1 along an axis.
  [[nodiscard]] solution solve(const std::vector<double>& conductance, std::size_t axis) const {
    using tetrapore::vec3;
    const std::size_t m = throats_.size();
    std::vector<double> imposed(m);
    std::vector<double> diagonal(size_, 0.0);
    std::vector<double> rest(size_, 0.0);
    double scale = 0;  // of what may cancel to nothing, as it does in a lattice
    for (std::size_t t = 0; t < m; ++t) {
      const small_throat& s = throats_[t];
      imposed[t] = (s.shape.nodes[1] - s.shape.nodes[0])[axis];
      if (s.node[0] != s.node[1]) {
        scale += conductance[t] * imposed[t] * imposed[t];
        diagonal[s.node[0]] += conductance[t];
        diagonal[s.node[1]] += conductance[t];
        rest[s.node[0]] -= conductance[t] * imposed[t];
        rest[s.node[1]] += conductance[t] * imposed[t];
      }
    }
    std::vector<double> p(size_, 0.0);
    std::vector<double> z(size_);
    std::vector<double> d(size_, 0.0);
    std::vector<double> ad(size_);
    double old = 0;
    for (std::size_t it = 0; it < 20 * size_; ++it) {
      double rz = 0;
      for (std::size_t i = 0; i < size_; ++i) {
        z[i] = diagonal[i] > 0 ? rest[i] / diagonal[i] : 0;
        rz += rest[i] * z[i];
      }
      if (!(rz > 1e-28 * scale)) {
        break;
      }
      for (std::size_t i = 0; i < size_; ++i) {
        d[i] = z[i] + (it == 0 ? 0 : rz / old) * d[i];
        ad[i] = 0;
      }
      for (std::size_t t = 0; t < m; ++t) {
        const auto [a, b] = throats_[t].node;
        const double q = conductance[t] * (d[a] - d[b]);
        ad[a] += q;
        ad[b] -= q;
      }
      const double alpha = rz / std::inner_product(d.begin(), d.end(), ad.begin(), 0.0);
      for (std::size_t i = 0; i < size_; ++i) {
        p[i] += alpha * d[i];
        rest[i] -= alpha * ad[i];
      }
      old = rz;
    }
    solution a{{}, std::vector<double>(m)};
    for (std::size_t t = 0; t < m; ++t) {
      const small_throat& s = throats_[t];
      a.drop[t] = p[s.node[0]] - p[s.node[1]] + imposed[t];
      a.mean_flux += (s.shape.nodes[1] - s.shape.nodes[0]) * (conductance[t] * a.drop[t] / volume_);
    }
    return a;
  }

  /// Permeability along an axis [m²] for a viscosity of 1.
  template <class Law>
  [[nodiscard]] double permeability(const Law& law, std::size_t axis = 0) const {
    return solve(conductances(law), axis).mean_flux[axis];
  }

  /// Force of the fluid on each grain: the pressure on its disc in each facet, and its share of the shear.
  [[nodiscard]] std::vector<tetrapore::vec3<double>> forces(const solution& a) const {
    using namespace tetrapore;
    std::vector<vec3<double>> f(grains_);
    for (std::size_t t = 0; t < throats_.size(); ++t) {
      const auto h = hydraulics_of(throats_[t].shape).value;
      const vec3<double> push = throats_[t].shape.area_vector * (a.drop[t] / h.facet_area);
      const double per_wetted = h.fluid_area / h.sheared_area(wall_condition::slip);
      for (std::size_t k = 0; k < h.grain_count; ++k) {
        f[throats_[t].vertices[k].grain().index()] += push * (h.disc_area[k] + per_wetted * h.wetted_area[k]);
      }
    }
    return f;
  }

 private:
  std::vector<small_throat> throats_;
  std::size_t size_ = 0;
  std::size_t grains_;
  double volume_ = 1;
};
