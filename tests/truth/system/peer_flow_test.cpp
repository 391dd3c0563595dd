// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include "support/flow_scenes.hpp"
#include "support/gzip.hpp"
#include "support/shared_data.hpp"
#include "tetrapore/network/make_network.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

// Yade's flow through open_200 and open_1000: pressure, permeability and the force on each grain, from its own cells
// and conductances; and what our conductances change, class by class of facets. Yade's walls are spheres of 5·10⁴ box
// lengths, ours are planes: a grain beside a wall can agree to 1e-5 only.

using namespace tetrapore;
using namespace flow_scenes;

namespace {

std::vector<std::vector<double>> rows_of(const std::filesystem::path& path) {
  std::istringstream in(read_gzip(path));
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream words(line);
    auto& r = rows.emplace_back();
    for (std::string w; std::getline(words, w, ',');) {
      r.push_back(std::strtod(w.c_str(), nullptr));
    }
  }
  return rows;
}

struct peer_flow {
  network net;
  std::vector<double> conductances;  ///< per throat
  std::vector<double> pressure;      ///< per pore
  std::vector<vec3<double>> force;   ///< per grain
  double mean_radius = 0;
};

std::optional<peer_flow> read_peer(const std::string& name) {
  const auto cells = shared_file("data/peer_yade/" + name + "_cells.csv.gz");
  const auto facets = shared_file("data/peer_yade/" + name + "_facets.csv.gz");
  const auto forces = shared_file("data/peer_yade/" + name + "_forces.csv.gz");
  if (!cells || !facets || !forces) {
    return std::nullopt;
  }
  peer_flow out;
  std::vector<sphere<double>> grains;
  for (const auto& r : rows_of(*forces)) {
    if (r[0] >= 0) {
      grains.push_back({{r[1], r[2], r[3]}, r[4]});
      out.force.push_back({r[5], r[6], r[7]});
      out.mean_radius += r[4];
    }
  }
  out.mean_radius /= static_cast<double>(grains.size());
  const domain region = walled({{0, 0, 0}, {1, 1, 1}});
  const auto rows = rows_of(*cells);
  std::vector<cell> made;
  std::vector<vec3<double>> centres;
  for (const auto& r : rows) {
    cell c;
    std::array<vec3<double>, 4> at;
    for (std::size_t k = 0; k < 4; ++k) {
      const int v = static_cast<int>(r[1 + k]);
      c.vertices[k] = v < 0 ? vertex(static_cast<face>(v + 6)) : vertex(grain_id(static_cast<std::size_t>(v)));
      at[k] = v < 0 ? region.wall(static_cast<face>(v + 6)).normal * -1e6 : grains[static_cast<std::size_t>(v)].centre;
      c.neighbours[k] = r[5 + k] < 0 ? cell::outside : static_cast<std::uint32_t>(r[5 + k]);
    }
    if (triple(at[1] - at[0], at[2] - at[0], at[3] - at[0]) < 0) {
      std::swap(c.vertices[2], c.vertices[3]);
      std::swap(c.neighbours[2], c.neighbours[3]);
    }
    made.push_back(c);
    centres.push_back({r[9], r[10], r[11]});
    out.pressure.push_back(r[12]);
  }
  out.net = make_network(region, std::move(grains), std::move(made));
  out.net.mutable_arrays().power_centres = std::move(centres);
  out.conductances.assign(out.net.throat_count(), -1.0);
  for (const auto& r : rows_of(*facets)) {
    if (r[2] < 0) {
      continue;
    }
    const pore_id a(static_cast<std::size_t>(r[0]));
    const pore_id b(static_cast<std::size_t>(r[2]));
    // the vertex opposite to the facet names the throat, also where two cells share two facets
    const double opposite_vertex = rows[a.index()][1 + static_cast<std::size_t>(r[1])];
    const int v = static_cast<int>(opposite_vertex);
    const vertex ahead = v < 0 ? vertex(static_cast<face>(v + 6)) : vertex(grain_id(static_cast<std::size_t>(v)));
    for (std::size_t k = 0; k < 4; ++k) {
      if (out.net.vertices(a)[k] == ahead) {
        const throat_id t = out.net.throats(a)[k];
        CHECK(out.net.across(a, t) == b);
        out.conductances[t.index()] = r[3];
      }
    }
  }
  return out;
}

/// The peer's sharing between three grains: whole sectors, unsigned angles, the fluid area without segments.
struct peer_sharing {
  facet_load operator()(const throat<double>& t) const noexcept {
    if (t.grain_count != 3) {
      return share_by_wetted_area{}(t);
    }
    facet_load load;
    std::array<double, 3> wetted{};
    double fluid = norm(t.area_vector);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [c, r] = t.grains[k];
      const vec3<double> a = t.grains[(k + 1) % 3].centre - c;
      const vec3<double> b = t.grains[(k + 2) % 3].centre - c;
      wetted[k] = r * r *
                  (std::abs(solid_angle(a, t.nodes[0] - c, t.nodes[1] - c)) +
                   std::abs(solid_angle(b, t.nodes[0] - c, t.nodes[1] - c)));
      load.pressure[k] = r * r * std::atan2(norm(cross(a, b)), dot(a, b)) / 2;
      fluid -= load.pressure[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      load.viscous[k] = fluid * wetted[k] / (wetted[0] + wetted[1] + wetted[2]);
    }
    return load;
  }
};

/// Grains none of whose facets touches a wall.
std::vector<bool> interior_grains(const network& net) {
  std::vector<bool> inner(net.grain_count(), true);
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    if (net.touches_wall(pore_id(i))) {
      for (const vertex v : net.vertices(pore_id(i))) {
        if (!v.is_wall()) {
          inner[v.grain().index()] = false;
        }
      }
    }
  }
  return inner;
}

struct peer_case {
  const char* name;
  double permeability;  ///< over the square of the mean radius, as its README gives it
  wall_condition wall;
  /// Facets between three grains where both formulas are alike; where the axis between the two pores misses the facet
  /// (unsigned angles) or a disc is cut by the opposite edge (no segments); on one wall; on two.
  std::array<std::size_t, 4> facets;
};
constexpr std::array<std::size_t, 4> facets_of_200{1421, 181, 453, 69};
constexpr std::array<std::size_t, 4> facets_of_1000{8841, 911, 1478, 110};
constexpr peer_case peer_cases[] = {{"open_200_s0c0", .00638650, wall_condition::no_slip, facets_of_200},
                                    {"open_200_s1c0", .0111361, wall_condition::slip, facets_of_200},
                                    {"open_1000_s0c0", .00453353, wall_condition::no_slip, facets_of_1000},
                                    {"open_1000_s1c0", .00653726, wall_condition::slip, facets_of_1000}};
/// What our formula changes of the permeability in each class, at most.
constexpr std::array<double, 4> largest_change{1e-8, 0.0097, 4e-4, 2e-6};

}  // namespace

TEST_CASE("the peer's conductances give the peer's pressure, permeability and grain forces") {
  for (const peer_case& c : peer_cases) {
    CAPTURE(std::string(c.name));
    const auto peer = read_peer(c.name);
    if (!peer) {
      return;
    }
    auto flow = flow_of(peer->net, water(), between(face::y_min, 1, face::y_max, 0));
    flow.set_conductances(peer->conductances);
    CHECK(flow.solve().ok());
    double worst_pressure = 0;
    for (std::size_t i = 0; i < peer->pressure.size(); ++i) {
      worst_pressure = std::max(worst_pressure, std::abs(flow.pressure()[pore_id(i)] - peer->pressure[i]));
    }
    CHECK(worst_pressure < 1e-8);
    const double k = box_permeability(flow, face::y_min, face::y_max, 1.0) / (peer->mean_radius * peer->mean_radius);
    CHECK(k == doctest::Approx(c.permeability).epsilon(1e-5));  // the digits of its README

    const fluid_forces f = forces_on_grains(flow, peer_sharing{});
    const std::vector<bool> inner = interior_grains(peer->net);
    double largest = 0;
    double worst_inner = 0;
    std::size_t compared = 0;
    for (std::size_t g = 0; g < inner.size(); ++g) {
      const double error = norm(f.on(grain_id(g)) - peer->force[g]);
      largest = std::max(largest, norm(peer->force[g]));
      compared += inner[g] ? 1U : 0U;
      worst_inner = inner[g] ? std::max(worst_inner, error / norm(peer->force[g])) : worst_inner;
    }
    CHECK(compared > 10);
    CHECK(worst_inner < 1e-8);
    MESSAGE(std::string(c.name) << ": pressures within " << worst_pressure << ", forces on " << compared
                                << " grains within " << worst_inner << ", permeability off by "
                                << k / c.permeability - 1);
  }
}

TEST_CASE("our conductances give the peer's permeability within 3 %; which facets make the difference") {
  for (const peer_case& c : peer_cases) {
    CAPTURE(std::string(c.name));
    const auto peer = read_peer(c.name);
    if (!peer) {
      return;
    }
    hydraulic_radius law = water();
    law.wall = c.wall;
    auto flow = flow_of(peer->net, law, between(face::y_min, 1, face::y_max, 0));
    std::vector<double> ours = flow.conductances().values;
    for (std::size_t i = 0; c.wall == wall_condition::slip && i < ours.size(); ++i) {
      // the peer's convention: a throat loses a factor √2 for each slip wall (ours keeps the whole conductance, which
      // is what a mirror plane asks for)
      const throat_id t(i);
      const int walls = 3 - static_cast<int>(flow.system().nodes().throat_between(peer->net, t).grain_count);
      ours[i] *= std::pow(2.0, -0.5 * walls);
    }
    CHECK(flow.conductances().counts.refused() == 0);
    const auto class_of = [&](throat_id t) {
      const throat<double> seen = flow.system().nodes().throat_between(peer->net, t);
      if (seen.grain_count < 3) {
        return 4 - static_cast<int>(seen.grain_count);
      }
      return std::abs(ours[t.index()] / peer->conductances[t.index()] - 1) > 1e-6 ? 1 : 0;
    };
    std::array<std::size_t, 4> counts{};
    std::vector<double> mixed = peer->conductances;
    const auto permeability = [&] {
      flow.set_conductances(mixed);
      CHECK(flow.solve().ok());
      return box_permeability(flow, face::y_min, face::y_max, 1.0) / (peer->mean_radius * peer->mean_radius);
    };
    std::string text;
    double before = permeability();
    double after = before;
    for (int kind = 0; kind < 4; ++kind) {
      for (std::size_t i = 0; i < mixed.size(); ++i) {
        if (!peer->net.is_boundary(throat_id(i)) && class_of(throat_id(i)) == kind) {
          mixed[i] = ours[i];
          ++counts[static_cast<std::size_t>(kind)];
        }
      }
      after = permeability();
      CHECK(counts[static_cast<std::size_t>(kind)] == c.facets[static_cast<std::size_t>(kind)]);
      CHECK(std::abs(after / before - 1) < largest_change[static_cast<std::size_t>(kind)]);
      text += std::to_string(counts[static_cast<std::size_t>(kind)]) + " facets of class " + std::to_string(kind) +
              " change it by " + std::to_string(100 * (after / before - 1)) + " %; ";
      before = after;
    }
    MESSAGE(std::string(c.name) << ": k/r² " << after << ", peer " << c.permeability << ", "
                                << 100 * (after / c.permeability - 1) << " %: " << text);
    CHECK(std::abs(after / c.permeability - 1) < 0.03);
  }
}
