// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/gather.hpp"
#include "tetrapore/one_phase/cell_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Pores as nodes of a pressure system.

namespace tetrapore::inline TETRAPORE_ABI {

/// When two pores are one node.
struct node_rule {
  /// Two power centres closer than this share of the square root of their facet's area coincide: the throat between
  /// them has a conductance without bound.
  double coincidence = 1e-6;
  /// A cell of less volume than this share of the cube of its longest edge is flat: its power centre is rounding.
  double flatness = 1e-6;
};

/// The nodes of a pressure system: pores, of which some are merged.
///
/// The rule: (1) two cells that are not flat and whose power centres coincide are one node; (2) a flat cell joins the
/// neighbour behind its largest facet, flat ones only where no other is left; (3) a node stands at the power centre of
/// its largest cell. Regular lattices need both: their cells share power centres, and 8 to 24 % of the cells are flat.
/// What passes a throat inside a node is no unknown; a throat between two nodes sees their positions, also where it
/// bounds a flat cell.
/// \par Accuracy  a merged throat would have taken less than about coincidence/6 of the pressure that its neighbours
///                take; which facet of a flat cell is the largest can depend on rounding where two are alike
class flow_nodes {
 public:
  flow_nodes() = default;

  /// The network must have been measured.
  /// \throw network_error  naming the pore, where a node would reach round a periodic box
  explicit flow_nodes(const network& net, const node_rule& rule = {}) { number(net, links_of(net, rule)); }

  [[nodiscard]] std::size_t size() const noexcept { return largest_.size(); }
  [[nodiscard]] std::size_t pore_count() const noexcept { return node_.size(); }
  [[nodiscard]] std::size_t operator[](pore_id p) const noexcept { return node_[p.index()]; }
  /// The pore at whose power centre a node stands.
  [[nodiscard]] pore_id pore(std::size_t node) const noexcept { return largest_[node]; }
  /// Image by which that pore must be moved to lie beside pore p.
  [[nodiscard]] image offset(pore_id p) const noexcept { return offset_.empty() ? image{} : offset_[p.index()]; }
  /// Where the node of pore p stands, beside pore p [m].
  [[nodiscard]] vec3<double> position(const network& net, pore_id p) const noexcept {
    const vec3<double>& centre = net.power_centre(largest_[node_[p.index()]]);
    return offset_.empty() ? centre : centre + net.region().shift(offset_[p.index()]);
  }
  /// Image by which the node of pore 1 of a throat is moved, counted from that of pore 0.
  [[nodiscard]] image step(const network& net, throat_id t) const noexcept {
    const auto& [a, b] = net.pores(t);
    return net.shift(t) + offset(b) - offset(a);
  }
  /// Whether a throat lies inside a node.
  [[nodiscard]] bool inside(const network& net, throat_id t) const noexcept {
    const auto& [a, b] = net.pores(t);
    return b.valid() && node_[a.index()] == node_[b.index()] && step(net, t) == image{};
  }
  /// The throat with the positions of the nodes: what a conductance law is asked about.
  [[nodiscard]] throat<double> throat_between(const network& net, throat_id t) const noexcept {
    throat<double> out = detail::facet_at(net, t);
    const auto& [a, b] = net.pores(t);
    out.nodes[0] = position(net, a);
    out.nodes[1] = b.valid() ? position(net, b) + net.region().shift(net.shift(t)) : out.nodes[0];
    return out;
  }

  /// Cells that joined a neighbour because they are flat.
  [[nodiscard]] std::size_t flat_pores() const noexcept { return flat_; }
  /// Throats whose two power centres coincide.
  [[nodiscard]] std::size_t coincident_throats() const noexcept { return coincident_; }
  /// Whether two sets of nodes group the pores alike.
  [[nodiscard]] bool same_groups(const flow_nodes& other) const noexcept {
    return node_ == other.node_ && offset_ == other.offset_;
  }

 private:
  /// Two pores that are one node; pore b is moved by `at` to lie beside pore a.
  struct link {
    pore_id a;
    pore_id b;
    image at;
  };

  [[nodiscard]] std::vector<link> links_of(const network& net, const node_rule& rule) {
    const std::size_t n = net.pore_count();
    std::vector<link> links;
    std::vector<double> longest2(n);
    std::vector<bool> loose(n, false);
    std::vector<pore_id> flat;
    for (std::size_t i = 0; i < n; ++i) {
      longest2[i] = longest_edge2(pore_body_at(net, pore_id(i)));
      if (!(std::abs(net.volume(pore_id(i))) > rule.flatness * longest2[i] * std::sqrt(longest2[i]))) {
        loose[i] = true;
        flat.emplace_back(i);
      }
    }
    const double share2 = rule.coincidence * rule.coincidence;
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      const throat_id t(i);
      const auto& [a, b] = net.pores(t);
      if (!b.valid() || loose[a.index()] || loose[b.index()]) {
        continue;
      }
      const vec3<double> apart = net.power_centre(b) + net.region().shift(net.shift(t)) - net.power_centre(a);
      const double d2 = norm2(apart);
      if (d2 <= share2 * longest2[a.index()] && d2 <= share2 * norm(detail::facet_at(net, t).area_vector)) {
        links.push_back({a, b, net.shift(t)});
        ++coincident_;
      }
    }
    flat_ = flat.size();
    while (!flat.empty()) {
      std::vector<link> found;
      std::vector<pore_id> rest;
      for (const pore_id p : flat) {
        if (const link l = largest_way_out(net, p, loose); l.b.valid()) {
          found.push_back(l);
        } else {
          rest.push_back(p);
        }
      }
      if (found.empty()) {
        flat_ -= rest.size();  // flat cells among themselves: each keeps its node
        break;
      }
      for (const link& l : found) {
        loose[l.a.index()] = false;
      }
      links.insert(links.end(), found.begin(), found.end());
      flat = std::move(rest);
    }
    return links;
  }

  /// From a flat cell through its largest facet behind which lies a cell that is settled.
  [[nodiscard]] static link largest_way_out(const network& net, pore_id p, const std::vector<bool>& loose) noexcept {
    link best{p, {}, {}};
    double widest = -1;
    for (std::size_t slot = 0; slot < 4; ++slot) {
      const throat_id t = net.throats(p)[slot];
      if (!t.valid() || net.is_boundary(t)) {
        continue;
      }
      const bool first = net.pores(t)[0] == p && net.slot(t, 0) == slot;
      const pore_id other = net.pores(t)[first ? 1 : 0];
      const double area = norm(detail::facet_at(net, t).area_vector);
      if (!loose[other.index()] && area > widest * (1 + 1e-9)) {
        widest = area;
        best = {p, other, first ? net.shift(t) : image{} - net.shift(t)};
      }
    }
    return best;
  }

  void number(const network& net, std::vector<link> links) {
    const std::size_t n = net.pore_count();
    constexpr std::uint32_t unset = 0xffffffffU;
    node_.assign(n, unset);
    offset_.assign(net.periodic() ? n : 0, image{});
    const std::size_t one_way = links.size();
    for (std::size_t i = 0; i < one_way; ++i) {
      links.push_back({links[i].b, links[i].a, image{} - links[i].at});
    }
    std::sort(links.begin(), links.end(), [](const link& x, const link& y) {
      return std::pair{x.a, x.b} < std::pair{y.a, y.b};
    });
    std::vector<pore_id> members;
    for (std::size_t i = 0; i < n; ++i) {
      if (node_[i] != unset) {
        continue;
      }
      const auto node = static_cast<std::uint32_t>(largest_.size());
      node_[i] = node;
      members.assign(1, pore_id(i));
      pore_id largest(i);
      for (std::size_t m = 0; m < members.size() && !links.empty(); ++m) {
        const pore_id from = members[m];
        auto l = std::lower_bound(links.begin(), links.end(), from, [](const link& x, pore_id p) { return x.a < p; });
        for (; l != links.end() && l->a == from; ++l) {
          const image at = offset(from) + l->at;
          if (node_[l->b.index()] == unset) {
            node_[l->b.index()] = node;
            if (net.periodic()) {
              offset_[l->b.index()] = at;
            }
            members.push_back(l->b);
            largest = net.volume(l->b) > net.volume(largest) ? l->b : largest;
          } else if (offset(l->b) != at) {
            throw network_error("pore " + std::to_string(from.index()),
                                "pores with one node that reach round the periodic box",
                                "power centres apart somewhere along each way round");
          }
        }
      }
      largest_.push_back(largest);
      if (net.periodic()) {  // offset(p) counts so far how p lies beside the first member
        const image origin = offset(largest);
        for (const pore_id p : members) {
          offset_[p.index()] = origin - offset_[p.index()];
        }
      }
    }
  }

  std::vector<std::uint32_t> node_;  ///< per pore
  std::vector<image> offset_;        ///< per pore; empty when no axis is periodic
  std::vector<pore_id> largest_;     ///< per node
  std::size_t flat_ = 0;
  std::size_t coincident_ = 0;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
