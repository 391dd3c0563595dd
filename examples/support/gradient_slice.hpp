// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/png.hpp"
#include "support/pore_finder.hpp"

#include "tetrapore/one_phase/nodes.hpp"
#include "tetrapore/simplex/throat_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

/// \file
/// Where the pressure changes: a slice through a packing, coloured by the magnitude of the pressure gradient.

namespace support {

/// How the pressure falls on the way through a throat. The network knows the drop between two nodes; along the way
/// between them it is shared out as in a tube of slowly varying section (Hagen-Poiseuille: dp/ds ∝ 1/A²), where A(s) is
/// the fluid's section at distance s from the facet, in the column over the facet: it is narrowest in the facet, and
/// widens as the grains recede.
class throat_profile {
 public:
  /// \param nodes  where the two nodes stand
  explicit throat_profile(const tetrapore::throat<double>& t) : facet_(t), normal_(t.area_vector) {
    normal_ = normal_ / norm(t.area_vector);
    begin_ = dot(t.nodes[0] - t.grains[0].centre, normal_);
    end_ = dot(t.nodes[1] - t.grains[0].centre, normal_);
    constexpr std::size_t points = 32;
    for (std::size_t i = 0; i < points; ++i) {
      const double s = begin_ + (end_ - begin_) * (static_cast<double>(i) + 0.5) / points;
      total_ += resistance(s) * std::abs(end_ - begin_) / points;
    }
  }

  /// Signed distance of a point from the facet [m].
  [[nodiscard]] double distance(const tetrapore::vec3<double>& point) const {
    return dot(point - facet_.grains[0].centre, normal_);
  }
  /// Share of the drop per metre at a signed distance from the facet [1/m]; 0 beyond the nodes.
  [[nodiscard]] double density(double s) const {
    return s < std::min(begin_, end_) || s > std::max(begin_, end_) || !(total_ > 0) ? 0 : resistance(s) / total_;
  }
  /// Share of the drop that lies within a distance from the facet.
  [[nodiscard]] double within(double distance) const {
    constexpr std::size_t points = 64;
    double share = 0;
    for (std::size_t i = 0; i < points; ++i) {
      share += density(distance * (2 * (static_cast<double>(i) + 0.5) / points - 1)) * 2 * distance / points;
    }
    return share;
  }
  [[nodiscard]] double length() const { return std::abs(end_ - begin_); }

 private:
  /// 1/A² at a distance from the facet.
  [[nodiscard]] double resistance(double s) const {
    tetrapore::throat<double> section = facet_;
    for (std::size_t k = 0; k < facet_.grain_count; ++k) {
      const double r = facet_.grains[k].radius;
      section.grains[k].radius = std::sqrt(std::max(0.0, (r - s) * (r + s)));
    }
    const double a = tetrapore::fluid_area(section).value;
    return a > 0 ? 1 / (a * a) : 0;
  }

  tetrapore::throat<double> facet_;
  tetrapore::vec3<double> normal_;
  double begin_ = 0;
  double end_ = 0;
  double total_ = 0;
};

/// The pressure gradient at points of the fluid. A point of a pore belongs to the throat whose facet is nearest in
/// barycentric measure.
class gradient_map {
 public:
  using vec = tetrapore::vec3<double>;

  /// \param drops  pressure of the node of pore 0 less that of pore 1, per throat [Pa]
  gradient_map(const tetrapore::network& net, const tetrapore::flow_nodes& nodes, std::span<const double> drops)
      : net_(net), nodes_(nodes), drops_(drops), finder_(net), profiles_(net.throat_count()) {}

  /// Magnitude of the gradient [Pa/m]; none in a grain or outside the network.
  [[nodiscard]] std::optional<double> at(const vec& point) {
    const auto found = finder_.at(point);
    if (!found) {
      return std::nullopt;
    }
    const tetrapore::pore_id p = *found;
    const vec local = point - net_.region().shift(finder_.image_of_last());
    const std::size_t grains = net_.grain_vertices(p);
    vec middle{};
    for (std::size_t k = 0; k < grains; ++k) {
      const auto g = net_.grain_sphere(p, k);
      if (norm2(local - g.centre) < g.radius * g.radius) {
        return std::nullopt;
      }
      middle += g.centre / static_cast<double>(grains);
    }
    for (std::size_t k = grains; k < 4; ++k) {
      const auto wall = net_.region().wall(net_.vertices(p)[k].wall());
      middle -= wall.normal * (0.5 * wall.distance(middle));
    }
    std::optional<std::size_t> nearest;
    double least = 0;
    for (const tetrapore::throat_id t : net_.throats(p)) {
      if (!t.valid()) {
        continue;
      }
      const bool first = net_.pores(t)[0] == p;
      const auto facet = tetrapore::throat_at(net_, t);
      const vec shift = first ? vec{} : net_.region().shift(net_.shift(t));
      const auto height = [&](const vec& x) { return dot(x + shift - facet.grains[0].centre, facet.area_vector); };
      const double share = height(local) / height(middle);
      if (!nearest || share < least) {
        nearest = t.index();
        least = share;
      }
    }
    if (!nearest) {
      return 0.0;
    }
    const tetrapore::throat_id t(*nearest);
    if (net_.is_boundary(t) || nodes_.inside(net_, t)) {
      return 0.0;
    }
    if (!profiles_[*nearest]) {
      profiles_[*nearest].emplace(nodes_.throat_between(net_, t));
    }
    const vec shift = net_.pores(t)[0] == p ? vec{} : net_.region().shift(net_.shift(t));
    const throat_profile& profile = *profiles_[*nearest];
    return std::abs(drops_[*nearest]) * profile.density(profile.distance(local + shift));
  }

  /// Of what the flow dissipates in the throats seen so far, the share that is spent nearer to the facet than a quarter
  /// of the way between the nodes. An even gradient would spend one half there.
  [[nodiscard]] double spent_at_throats(std::span<const double> conductances) const {
    double near = 0;
    double all = 0;
    for (std::size_t t = 0; t < profiles_.size(); ++t) {
      if (profiles_[t]) {
        const double power = conductances[t] * drops_[t] * drops_[t];
        all += power;
        near += power * profiles_[t]->within(0.25 * profiles_[t]->length());
      }
    }
    return near / all;
  }

 private:
  const tetrapore::network& net_;
  const tetrapore::flow_nodes& nodes_;
  std::span<const double> drops_;
  pore_finder finder_;
  std::vector<std::optional<throat_profile>> profiles_;
};

/// From dark blue over white to red, as the value goes from 0 to 1; what is above stays red.
[[nodiscard]] inline rgb heat(double x) {
  constexpr std::array<std::array<double, 3>, 5> stops{
      {{0.12, 0.16, 0.45}, {0.16, 0.50, 0.73}, {0.75, 0.89, 0.80}, {0.99, 0.72, 0.35}, {0.80, 0.08, 0.10}}};
  const double at = std::clamp(x, 0.0, 1.0) * (stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double f = at - static_cast<double>(k);
  const auto channel = [&](std::size_t c) {
    return static_cast<std::uint8_t>(std::lround(255 * (stops[k][c] + f * (stops[k + 1][c] - stops[k][c]))));
  };
  return {channel(0), channel(1), channel(2)};
}

/// A slice through the middle of the box that holds the direction of the flow: grains grey, the fluid by the gradient
/// over the mean gradient; 3 and more is red, as in the figure it stands beside.
/// \par Source  Chareyre et al. 2017, Fig. 3
inline void draw_gradient(const std::filesystem::path& path, gradient_map& map, const tetrapore::box& region,
                          std::size_t flow_axis, double mean_gradient) {
  constexpr double red_at = 3;
  constexpr std::uint32_t height = 900;
  const std::size_t across = flow_axis == 0 ? 1 : 0;
  const std::size_t out = 3 - flow_axis - across;
  const tetrapore::vec3<double> size = region.hi - region.lo;
  const auto width = static_cast<std::uint32_t>(std::clamp(height * size[across] / size[flow_axis], 100.0, 4000.0));
  picture image(width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      tetrapore::vec3<double> point;
      point[across] = region.lo[across] + size[across] * (x + 0.5) / width;
      point[flow_axis] = region.hi[flow_axis] - size[flow_axis] * (y + 0.5) / height;
      point[out] = region.lo[out] + 0.5 * size[out];
      const auto gradient = map.at(point);
      image.at(x, y) = gradient ? heat(*gradient / (red_at * mean_gradient)) : rgb{225, 222, 217};
    }
  }
  write_png(path, image);
}

}  // namespace support
