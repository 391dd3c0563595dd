// SPDX-License-Identifier: BSD-3-Clause
#include "support/graph_network.hpp"

#include "tetrapore/two_phase/drainage.hpp"
#include "tetrapore/two_phase/state_file.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace {

using namespace tetrapore;

/// One number per throat, whatever the state.
struct given_rule {
  static constexpr bool depends_on_state = false;
  std::vector<double> thresholds;

  [[nodiscard]] threshold_outcome threshold(const network&, const two_phase_state&, throat_id t) const {
    const double p = thresholds[t.index()];
    return {bracket<double>::exactly(p), std::isinf(p) ? entry_status::closed : entry_status::ok};
  }
  void settle(const network&, const two_phase_state&, std::span<const throat_id>) const {}
  void touched_by(const network&, const two_phase_state&, pore_id, std::vector<throat_id>&) const {}
};

/// A chain 0 - 1 - … - 5 from y_max to y_min; pores 2 and 4 touch x_min.
network chain(std::uint64_t epoch = 0) {
  return graph_network({{1, {face::y_max}}, {1}, {2, {face::x_min}}, {3}, {4, {face::x_min}}, {1, {face::y_min}}},
                       {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}}, epoch);
}

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a saturated state holds the void volume of every pore") {
  const network net = chain();
  const two_phase_state s(net);
  CHECK(s.liquid()[pore_id(3)] == 3);
  CHECK(s.is_wet(pore_id(3)));
  CHECK(s.is_drainable(pore_id(3)));
  CHECK(std::isnan(s.invasion_pressure(pore_id(3))));
  CHECK(s.level() == 0);
  CHECK(s.clusters().empty());
}

TEST_CASE("from liquid volumes, a pore is gas when less than half of its void is liquid, and keeps what it has") {
  const network net = chain();
  volume_field liquid(net, 0.9);
  const two_phase_state s(net, liquid, 5.0);
  CHECK(s.is_wet(pore_id(1)));  // 0.9 of 1
  CHECK(s.is_gas(pore_id(2)));  // 0.9 of 2
  CHECK(s.liquid()[pore_id(2)] == 0.9);
  CHECK(s.invasion_pressure(pore_id(2)) == 5.0);
}

TEST_CASE("liquid volumes of another epoch are refused with both epochs") {
  const network net = chain(3);
  const volume_field other(std::vector<double>(6, 1.0), 2);
  const std::string text = message_of([&] { two_phase_state(net, other); });
  CHECK(contains(text, "epoch 2"));
  CHECK(contains(text, "epoch 3"));
}

TEST_CASE("a chain drains link by link, in bursts below the running maximum") {
  const network net = chain();
  given_rule rule{{3, 1, 2, 5, 4}};
  drainage invasion(net, rule);
  CHECK(invasion.next_pressure() == 3);
  CHECK(invasion.step_level() == 3);  // 1 and 2 follow in the burst that 3 opened
  CHECK(invasion.state().pressure() == 3);
  CHECK(invasion.saturation() == doctest::Approx(0.4));
  CHECK(interior_saturation(net, invasion.state()) == doctest::Approx(0.0));
  CHECK(invasion.next_pressure() == 5);
  CHECK(invasion.step());
  CHECK(!invasion.step());  // the outlet is never entered
  CHECK(invasion.next_pressure() == infinity<double>);
  CHECK(invasion.saturation() == doctest::Approx(0.0));
  CHECK(invasion.events().back().level == 2);
  CHECK(invasion.events().back().reason == entry_status::ok);
}

TEST_CASE("drainage stops before a pressure, and at a saturation") {
  const network net = chain();
  given_rule rule{{3, 1, 2, 5, 4}};
  drainage by_pressure(net, rule);
  by_pressure.run_to_pressure(4.9);
  CHECK(by_pressure.events().size() == 3);
  drainage by_saturation(net, rule);
  by_saturation.run_to_saturation(0.75);
  CHECK(by_saturation.events().size() == 2);
}

TEST_CASE("a closed throat stops both phases; liquid passes it only when asked to") {
  // A side pore 3 hangs on a closed throat: it never had a way out.
  const network net = graph_network({{1, {face::y_max}}, {1}, {1, {face::y_min}}, {1}}, {{0, 1}, {1, 2}, {1, 3}});
  given_rule rule{{1, 1, infinity<double>}};
  drainage sealed(net, rule);
  sealed.run();
  CHECK(sealed.state().is_trapped(pore_id(3)));
  CHECK(sealed.state().clusters()[0].pressure == 0);
  drainage films(net, rule, {.liquid_passes_closed_throats = true});
  CHECK(!films.state().is_trapped(pore_id(3)));
  films.run();
  CHECK(films.state().is_trapped(pore_id(3)));
  CHECK(films.state().clusters()[0].pressure == 1);
}

TEST_CASE("gas that is not connected to the inlet joins when the front reaches it") {
  // The chain, with two ways around the gas in pore 3 so that nothing is cut off.
  const network net = graph_network({{1, {face::y_max}}, {1}, {2}, {3}, {4}, {1, {face::y_min}}},
                                    {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {1, 5}, {2, 5}});
  volume_field liquid(net);
  for (std::size_t i = 0; i < 6; ++i) {
    liquid[pore_id(i)] = net.void_volume(pore_id(i));
  }
  liquid[pore_id(3)] = 0.5;  // gas, cut off from the inlet, with a ring left
  given_rule rule{{3, 1, 2, 0.5, 4, 9, 9}};
  for (const trapping_method method : {trapping_method::two_passes, trapping_method::live}) {
    drainage invasion(net, rule, two_phase_state(net, liquid), {.method = method});
    CHECK(invasion.next_pressure() == 3);  // the throat of 0.5 behind the old gas is nobody's front yet
    CHECK(!invasion.state().is_fed(pore_id(3)));
    invasion.run();
    REQUIRE(invasion.events().size() == 3);
    CHECK(invasion.events()[0].pore == pore_id(1));
    CHECK(invasion.events()[1].pore == pore_id(2));
    CHECK(invasion.events()[2].pore == pore_id(4));
    CHECK(invasion.events()[2].throat == throat_id(3));
    CHECK(invasion.state().liquid()[pore_id(3)] == 0.5);
    CHECK(invasion.state().is_fed(pore_id(3)));
  }
}

TEST_CASE("set-up errors name the parameter, the value and what was expected") {
  const network net = chain();
  given_rule rule{{3, 1, 2, 5, 4}};
  const auto error = [&](const drainage_options& o) { return message_of([&] { drainage<given_rule>(net, rule, o); }); };
  CHECK(error({.inlet = face_set{}}) == "inlet: found no face, expected at least one face");
  CHECK(error({.outlet = face_set{}}) == "outlet: found no face, expected at least one face, or no trapping");
  CHECK(error({.inlet = face::y_min}) == "inlet and outlet: found both contain {y_min}, expected different faces");
  CHECK(contains(error({.inlet = face::z_max}), "z_max, which no pore touches"));
  CHECK(contains(error({.level_margin = -1}), "level_margin"));
  CHECK(contains(error({.trap = trapping::per_level, .method = trapping_method::two_passes, .level_margin = 0.1}),
                 "trapping method"));
  const network both = graph_network({{1, {face::y_max}}, {1, {face::y_max, face::y_min}}, {1}}, {{0, 1}, {1, 2}});
  CHECK(contains(message_of([&] { drainage<given_rule>(both, rule, {}); }),
                 "pore 1: found a pore that touches inlet and outlet"));
  const network nothing = graph_network({{1, {face::y_max}}, {1, {face::y_min}}}, {{0, 1}});
  CHECK(contains(message_of([&] { drainage<given_rule>(nothing, rule, {}); }), "no void between inlet and outlet"));
  CHECK(contains(message_of([&] { drainage<given_rule>(net, rule, two_phase_state(chain(4)), {}); }), "epoch 0"));
}

TEST_CASE("a state saved and loaded goes on with the same events") {
  const network net = chain(9);
  given_rule rule{{3, 4, 2, 5, 4}};
  drainage whole(net, rule);
  whole.run();
  drainage first(net, rule);
  first.step();
  const auto bytes = to_bytes(net, first.state());
  drainage second(net, rule, state_from_bytes(net, bytes));
  second.run();
  CHECK(to_bytes(net, whole.state()) == to_bytes(net, second.state()));
  CHECK(second.events() == std::vector(whole.events().begin() + 1, whole.events().end()));
}

TEST_CASE("a state that is foreign, cut short or damaged is refused") {
  const network net = chain(9);
  const auto bytes = to_bytes(net, two_phase_state(net));
  const auto error = [](const network& n, std::vector<std::byte> b) {
    return message_of([&] { static_cast<void>(state_from_bytes(n, b, "state.bin")); });
  };
  CHECK(error(net, bytes).empty());
  CHECK(contains(error(chain(8), bytes), "another network"));
  const network other = graph_network({{1, {face::y_max}}, {1}, {2}, {3}, {4}, {1, {face::y_min}}},
                                      {{0, 1}, {1, 3}, {2, 3}, {3, 4}, {4, 5}}, 9);
  CHECK(contains(error(other, bytes), "another network"));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    CHECK(contains(error(net, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}), "state.bin"));
  }
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    auto damaged = bytes;
    damaged[k] ^= std::byte{0x10};
    CHECK(contains(error(net, damaged), "state.bin"));
  }
  auto longer = bytes;
  longer.push_back(std::byte{0});
  CHECK(contains(error(net, longer), "as its header says"));
}
