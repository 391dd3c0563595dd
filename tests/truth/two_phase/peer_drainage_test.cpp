// SPDX-License-Identifier: BSD-3-Clause
#include "support/graph_network.hpp"
#include "support/gzip.hpp"
#include "support/shared_data.hpp"

#include "tetrapore/two_phase/drainage.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace {

using namespace tetrapore;

struct table {
  std::map<std::string, std::size_t> column;
  std::vector<std::vector<double>> rows;

  [[nodiscard]] double operator()(std::size_t row, const std::string& name) const {
    return rows.at(row).at(column.at(name));
  }
};

table parse(std::istream&& in) {
  table t;
  std::string line;
  std::getline(in, line);
  std::string cell;
  for (std::istringstream header(line); std::getline(header, cell, ',');) {
    t.column.emplace(cell, t.column.size());
  }
  while (std::getline(in, line)) {
    t.rows.emplace_back();
    for (std::istringstream row(line); std::getline(row, cell, ',');) {
      t.rows.back().push_back(std::stod(cell));
    }
  }
  return t;
}

/// Yade's own network and thresholds: the step from pore i into j needs the larger of σ/rt and σ/(inscribed radius of
/// j). Neighbours that are not in the file lie outside.
struct peer_network {
  network net;
  std::vector<double> throat_radius;  // 0: closed
  std::vector<double> body_radius;
};

peer_network load_peer(const std::filesystem::path& path) {
  const table t = parse(std::istringstream(read_gzip(path)));
  std::map<long, std::size_t> pore_of;
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    pore_of.emplace(std::lround(t(r, "cell")), r);
  }
  peer_network peer;
  std::vector<graph_pore> pores;
  std::vector<std::pair<std::size_t, std::size_t>> links;
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    graph_pore p{t(r, "void_volume"), {}};
    for (const char* v : {"v0", "v1", "v2", "v3"}) {
      const long id = std::lround(t(r, v));
      if (id < 0) {
        p.walls.push_back(static_cast<face>(id + 6));
      }
    }
    pores.push_back(p);
    peer.body_radius.push_back(t(r, "r_inscribed_sphere"));
    for (int k = 0; k < 4; ++k) {
      const auto other = pore_of.find(std::lround(t(r, "n" + std::to_string(k))));
      if (other != pore_of.end() && other->second > r) {
        links.emplace_back(r, other->second);
        peer.throat_radius.push_back(t(r, "rt" + std::to_string(k)));
      }
    }
  }
  peer.net = graph_network(pores, links);
  return peer;
}

/// The rule of the peer, as a user would write it: directional, and it looks beyond the throat.
struct peer_rule {
  static constexpr bool depends_on_state = false;
  const peer_network* peer;

  [[nodiscard]] threshold_outcome threshold(const network& net, const two_phase_state& state, throat_id t) const {
    const double radius = peer->throat_radius[t.index()];
    if (radius == 0) {
      return {bracket<double>::exactly(infinity<double>), entry_status::closed};
    }
    const auto& [a, b] = net.pores(t);
    const pore_id into = state.is_gas(a) ? b : a;
    return {bracket<double>::exactly(std::max(1 / radius, 1 / peer->body_radius[into.index()])), entry_status::ok};
  }
  void settle(const network&, const two_phase_state&, std::span<const throat_id>) const {}
  void touched_by(const network&, const two_phase_state&, pore_id, std::vector<throat_id>&) const {}
};
static_assert(entry_rule<peer_rule>);

void compare(const std::string& name, trapping trap) {
  const auto cells = shared_file("data/peer_yade/" + name + "_tpfcells.csv.gz");
  const auto curve =
      shared_file("data/peer_yade/" + name + "_drainage_pore" + (trap == trapping::none ? "_notrap.csv" : ".csv"));
  if (!cells || !curve) {
    return;
  }
  const peer_network peer = load_peer(*cells);
  const table expected = parse(std::ifstream(*curve));
  REQUIRE(expected.rows.size() > 100);
  peer_rule rule{&peer};
  drainage invasion(peer.net, rule, {.inlet = face::y_max, .outlet = face::y_min, .trap = trap, .level_margin = 1e-9});
  double worst_saturation = 0;
  double worst_pressure = 0;
  std::size_t steps = 0;
  for (; invasion.step_level() > 0; ++steps) {
    REQUIRE(steps < expected.rows.size());
    const auto differ = [&](double ours, const std::string& column) {
      return std::abs(ours - expected(steps, column));
    };
    const two_phase_state& s = invasion.state();
    worst_saturation = std::max({worst_saturation, differ(saturation(peer.net, s), "Sw_all"),
                                 differ(interior_saturation(peer.net, s), "Sw_interior"),
                                 std::abs(invasion.saturation() - saturation(peer.net, s))});
    worst_pressure = std::max(worst_pressure, differ(s.pressure(), "pc") / expected(steps, "pc"));
  }
  CHECK(steps == expected.rows.size());
  // The file has 12 digits of each number.
  CHECK(worst_saturation < 1e-11);
  CHECK(worst_pressure < 1e-11);
  MESSAGE(name << ": " << steps << " steps, worst difference of saturation " << worst_saturation << ", of p_c "
               << worst_pressure << " relative");
}

}  // namespace

TEST_CASE("the peer's network and rule give the peer's curve, step by step, with trapping after each step") {
  compare("open_200", trapping::per_level);
  compare("open_1000", trapping::per_level);
}

TEST_CASE("the peer's network and rule give the peer's curve, step by step, without trapping") {
  compare("open_200", trapping::none);
  compare("open_1000", trapping::none);
}
