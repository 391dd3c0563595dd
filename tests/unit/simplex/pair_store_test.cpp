// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/simplex/pair_store.hpp"

#include <doctest/doctest.h>

#include <map>
#include <memory>
#include <random>

using namespace tetrapore;

namespace {

grain_id grain(std::size_t i) { return grain_id(i); }

pair_key any_pair(std::mt19937& random) {
  const auto small = [&](std::uint32_t n) { return random() % n; };
  if (small(5) == 0) {
    return pair_of(grain(small(12)), static_cast<face>(small(6)));
  }
  const auto lap = [&] { return static_cast<std::int8_t>(static_cast<int>(small(3)) - 1); };
  return pair_of(grain(small(12)), grain(small(12)), {lap(), lap(), lap()});
}

/// The store says what the map says.
bool agrees(const pair_store<int>& store, const std::map<pair_key, int>& truth) {
  bool same = store.size() == truth.size();
  for (const auto& [key, value] : truth) {
    const int* found = store.find(key);
    same = same && found != nullptr && *found == value;
  }
  for (std::size_t i = 0; i < store.size(); ++i) {
    const auto at = truth.find(store.keys()[i]);
    same = same && at != truth.end() && at->second == store.states()[i];
  }
  return same;
}

}  // namespace

TEST_CASE("a pair has one name from whichever end it is seen") {
  CHECK(pair_of(grain(3), grain(7)) == pair_of(grain(7), grain(3)));
  CHECK(pair_of(grain(3), grain(7), {1, 0, -1}) == pair_of(grain(7), grain(3), {-1, 0, 1}));
  CHECK(pair_of(grain(3), grain(7), {1, 0, -1}) != pair_of(grain(7), grain(3), {1, 0, -1}));
  CHECK(pair_of(grain(3), grain(3), {-1, 0, 1}) == pair_of(grain(3), grain(3), {1, 0, -1}));
  CHECK(pair_of(grain(3), face::y_min) != pair_of(grain(3), face::y_max));
  CHECK(pair_of(grain(7), grain(3)).a == grain(3));
}

TEST_CASE("after 200,000 random changes a store agrees with a map, and iterates in the order of its history") {
  std::mt19937 random(1);
  pair_store<int> store;
  pair_store<int> twin;
  std::map<pair_key, int> truth;
  bool right = true;
  for (int step = 0; step < 200000; ++step) {
    const pair_key k = any_pair(random);
    const bool comes = random() % 9 < (step / 20000 % 2 == 0 ? 5U : 4U);
    if (comes) {
      const auto [state, is_new] = store.insert(k, step);
      twin.insert(k, step);
      const auto [at, was_new] = truth.emplace(k, step);
      right = right && is_new == was_new && state == at->second;
    } else {
      twin.erase(k);
      const bool gone = store.erase(k);
      right = right && gone == (truth.erase(k) == 1);
    }
    if (step % 1000 == 0) {
      right = right && agrees(store, truth);
    }
  }
  CHECK(right);
  CHECK(agrees(store, truth));
  CHECK(std::equal(store.keys().begin(), store.keys().end(), twin.keys().begin(), twin.keys().end()));
}

TEST_CASE("an empty store finds nothing and forgets nothing") {
  pair_store<int> store;
  CHECK(store.find(pair_of(grain(0), grain(1))) == nullptr);
  CHECK_FALSE(store.erase(pair_of(grain(0), grain(1))));
  CHECK(store.erase_if([](const pair_key&, int) { return true; }) == 0);
  store.insert(pair_of(grain(0), grain(1)), 4);
  store.clear();
  CHECK(store.empty());
  CHECK(store.find(pair_of(grain(0), grain(1))) == nullptr);
}

TEST_CASE("a pair that is there keeps its state when it is inserted again") {
  pair_store<int> store;
  store.insert(pair_of(grain(0), grain(1)), 4);
  const auto [state, is_new] = store.insert(pair_of(grain(1), grain(0)), 5);
  CHECK_FALSE(is_new);
  CHECK(state == 4);
}

TEST_CASE("erase_if keeps the order of the pairs that stay, and finds them") {
  pair_store<std::size_t> store;
  for (std::size_t i = 0; i < 1000; ++i) {
    store.insert(pair_of(grain(i), grain(i + 1)), i);
  }
  CHECK(store.erase_if([](const pair_key& k, std::size_t) { return k.a.index() % 3 != 0; }) == 666);
  REQUIRE(store.size() == 334);
  bool right = true;
  for (std::size_t i = 0; i < store.size(); ++i) {
    right = right && store.states()[i] == 3 * i && *store.find(store.keys()[i]) == 3 * i;
  }
  CHECK(right);
  CHECK(store.find(pair_of(grain(1), grain(2))) == nullptr);
}

TEST_CASE("states need not be copied") {
  pair_store<std::unique_ptr<int>> store;
  for (std::size_t i = 0; i < 100; ++i) {
    store.insert(pair_of(grain(i), face::x_min), std::make_unique<int>(static_cast<int>(i)));
  }
  store.erase(pair_of(grain(0), face::x_min));
  CHECK(**store.find(pair_of(grain(99), face::x_min)) == 99);
}

TEST_CASE("grains that are wrapped across a periodic face keep the states of their pairs") {
  // the centres of grains 0 and 1 lie beside the face x = 1: in the box, and just outside it
  pair_store<int> store;
  store.insert(pair_of(grain(0), grain(1)), 1);
  store.insert(pair_of(grain(1), grain(2), {1, 0, 0}), 2);
  store.insert(pair_of(grain(1), face::y_min), 3);
  store.insert(pair_of(grain(1), grain(1), {0, 0, 1}), 4);
  const std::vector<image> laps{{}, {-1, 0, 0}, {}};  // grain 1 comes back into the box on the left
  store.wrap(laps);
  REQUIRE(store.size() == 4);
  CHECK(*store.find(pair_of(grain(0), grain(1), {1, 0, 0})) == 1);  // its image on the right is the one beside grain 0
  CHECK(*store.find(pair_of(grain(1), grain(2))) == 2);
  CHECK(*store.find(pair_of(grain(1), face::y_min)) == 3);
  CHECK(*store.find(pair_of(grain(1), grain(1), {0, 0, 1})) == 4);
}

TEST_CASE("grains that are numbered anew keep the states of their pairs; pairs of a grain that went are forgotten") {
  pair_store<int> store;
  store.insert(pair_of(grain(0), grain(1)), 1);
  store.insert(pair_of(grain(1), grain(2), {0, 1, 0}), 2);
  store.insert(pair_of(grain(2), face::z_max), 3);
  // grain 0 goes, and 2 becomes 0
  store.rename([](const pair_key& k) -> std::optional<pair_key> {
    const auto renamed = [](grain_id g) { return g == grain(2) ? grain(0) : g; };
    if (k.a == grain(0)) {
      return std::nullopt;
    }
    return k.b.is_wall() ? pair_of(renamed(k.a), k.b.wall()) : pair_of(renamed(k.a), renamed(k.b.grain()), k.shift);
  });
  REQUIRE(store.size() == 2);
  CHECK(*store.find(pair_of(grain(1), grain(0), {0, 1, 0})) == 2);
  CHECK(*store.find(pair_of(grain(0), face::z_max)) == 3);
}
