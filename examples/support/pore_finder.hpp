// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/gather.hpp"

#include <optional>
#include <vector>

/// \file
/// Which pore of a network holds a point.

namespace support {

/// Finds the pore that holds a point, walking from the last one found: neighbouring pixels are neighbouring pores.
class pore_finder {
 public:
  explicit pore_finder(const tetrapore::network& net) : net_(net) {
    facets_.reserve(net.throat_count());
    for (std::size_t t = 0; t < net.throat_count(); ++t) {
      const auto facet = tetrapore::throat_at(net, tetrapore::throat_id(t));
      facets_.push_back({facet.grains[0].centre, facet.area_vector});
    }
  }

  /// The pore, or none where the point lies outside the network.
  [[nodiscard]] std::optional<tetrapore::pore_id> at(const tetrapore::vec3<double>& point) {
    for (std::size_t steps = 0; steps < net_.pore_count() + 64; ++steps) {
      const auto next = step(point - net_.region().shift(image_));
      if (next == walk::here) {
        return pore_;
      }
      if (next == walk::outside) {
        return std::nullopt;
      }
    }
    return std::nullopt;  // round-off on a flat cell can let the walk turn in a circle: that pixel stays empty
  }
  /// Image of that pore: what to take off the point's coordinates.
  [[nodiscard]] tetrapore::image image_of_last() const { return image_; }

 private:
  struct plane {
    tetrapore::vec3<double> point;
    tetrapore::vec3<double> normal;
  };
  enum class walk { here, on, outside };

  walk step(const tetrapore::vec3<double>& p) {
    for (const tetrapore::throat_id t : net_.throats(pore_)) {
      if (!t.valid()) {
        continue;
      }
      const auto& pores = net_.pores(t);
      const auto cross = [&](bool from_first) {
        const tetrapore::vec3<double> local = from_first ? p : p + net_.region().shift(net_.shift(t));
        const double side = dot(local - facets_[t.index()].point, facets_[t.index()].normal);
        return from_first ? side > 0 : side < 0;
      };
      const bool first = pores[0] == pore_ && cross(true);
      const bool second = !first && pores[1] == pore_ && cross(false);
      if (first || second) {
        if (net_.is_boundary(t)) {
          return walk::outside;
        }
        pore_ = pores[first ? 1 : 0];
        const auto shift = net_.shift(t);
        image_ = first ? image_ + shift : image_ - shift;
        return walk::on;
      }
    }
    return walk::here;
  }

  const tetrapore::network& net_;
  std::vector<plane> facets_;
  tetrapore::pore_id pore_{std::size_t{0}};
  tetrapore::image image_;
};

}  // namespace support
