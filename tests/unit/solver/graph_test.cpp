// SPDX-License-Identifier: BSD-3-Clause
#include "support/errors.hpp"
#include "tetrapore/solver/graph.hpp"
#include "tetrapore/solver/rows.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace tetrapore;

TEST_CASE("a graph lists the neighbours and edges of each node") {
  const network_graph graph(4, {{0, 1}, {2, 1}, {1, 0}});
  CHECK(graph.node_count() == 4);
  CHECK(graph.edge_count() == 3);
  CHECK(graph.degree(1) == 3);
  CHECK(graph.degree(3) == 0);
  const auto near = graph.neighbours(1);
  const auto edges = graph.incident_edges(1);
  CHECK(std::vector<std::uint32_t>(near.begin(), near.end()) == std::vector<std::uint32_t>{0, 2, 0});
  CHECK(std::vector<std::uint32_t>(edges.begin(), edges.end()) == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(network_graph().node_count() == 0);
}

TEST_CASE("copies of a graph share its arrays") {
  network_graph copy;
  {
    const network_graph graph(2, {{0, 1}});
    copy = graph;
    CHECK(copy.same_as(graph));
    copy = network_graph(graph);
    CHECK(copy.same_as(graph));
    CHECK(!copy.same_as(network_graph(2, {{0, 1}})));
  }
  CHECK(copy.edge_count() == 1);
}

TEST_CASE("edges that leave the graph or end where they begin are named") {
  CHECK_THROWS_WITH_AS(network_graph(3, {{0, 1}, {1, 3}}), "edge 1: found node 3, expected a node below 3",
                       network_error);
  CHECK_THROWS_WITH_AS(network_graph(3, {{2, 2}}), "edge 0: found node 2 at both ends, expected two nodes",
                       network_error);
}

TEST_CASE("rows of a symmetric matrix become edges, parallel ones too") {
  const std::vector<std::size_t> offsets{0, 2, 5, 6};
  const std::vector<std::uint32_t> columns{1, 1, 0, 2, 0, 1};
  const std::vector<double> weights{2, 3, 2, 5, 3, 5};
  const weighted_graph made = graph_of_rows(offsets, columns, weights);
  CHECK(made.graph.node_count() == 3);
  REQUIRE(made.graph.edge_count() == 3);
  CHECK(made.weights == std::vector<double>{2, 3, 5});
  CHECK(made.graph.edges()[2] == network_graph::edge{1, 2});
}

TEST_CASE("rows that are not symmetric are refused by the name of the row") {
  const std::vector<std::size_t> offsets{0, 1, 2};
  const std::vector<std::uint32_t> columns{1, 0};
  const auto message = [&](std::vector<double> weights) {
    return message_of<network_error>([&] { return graph_of_rows(offsets, columns, weights); });
  };
  CHECK(message({1, 1}).empty());
  CHECK(message({1, 2}) == "row 0: found 1 for row 1, whose own differs by 1, expected a symmetric matrix");
  CHECK(contains(message({1, 1 + 0x1p-30}), "found 1 for row 1, whose own differs by 9.31323e-10"));
  CHECK(message({1, std::numeric_limits<double>::quiet_NaN()}).starts_with("row 0"));
  const std::vector<std::size_t> one_way{0, 1, 1};
  CHECK_THROWS_AS(static_cast<void>(graph_of_rows(one_way, std::vector<std::uint32_t>{1}, std::vector<double>{1})),
                  network_error);
  CHECK_THROWS_AS(
      static_cast<void>(graph_of_rows(offsets, std::vector<std::uint32_t>{0, 0}, std::vector<double>{1, 1})),
      network_error);
  CHECK_THROWS_AS(
      static_cast<void>(graph_of_rows(offsets, std::vector<std::uint32_t>{2, 0}, std::vector<double>{1, 1})),
      network_error);
  CHECK_THROWS_AS(static_cast<void>(graph_of_rows(offsets, columns, std::vector<double>{1})), network_error);
}
