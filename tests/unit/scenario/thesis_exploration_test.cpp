// SPDX-License-Identifier: Apache-2.0
#include "scenario/thesis_exploration.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>
#include <vector>

namespace homeward::scenario::thesis_exploration_test {
namespace {

using Way = std::vector<int>;
using Edges = std::set<std::pair<int, int>>;

/// 0 - 1 - 2 - 4
/// |       |
/// 3 ------+
ThesisGraph drawing(std::vector<std::vector<double>> directions_rad) {
  ThesisGraph graph;
  for (auto& of_node : directions_rad) graph.add_node(std::move(of_node));
  graph.join(0, 1);
  graph.join(1, 2);
  graph.join(0, 3);
  graph.join(3, 2);
  graph.join(2, 4);
  return graph;
}

TEST(ThesisGraph, TakesTheBestDirectionFirstAndEachOnce) {
  ThesisGraph graph;
  EXPECT_EQ(graph.add_node({0.5, -1.0}), 0);
  EXPECT_EQ(graph.add_node({2.0}), 1);
  EXPECT_EQ(graph.take_direction(0), 0.5);
  EXPECT_EQ(graph.take_direction(0), -1.0);
  EXPECT_EQ(graph.take_direction(0), std::nullopt);
  EXPECT_EQ(graph.left_rad(1).size(), 1U) << "another node's directions stay";
}

TEST(ThesisGraph, JoinsTwoNodesOnceAndNoneWithItself) {
  ThesisGraph graph = drawing({{}, {}, {}, {}, {}});
  const Edges before = graph.edges();
  EXPECT_EQ(before, (Edges{{0, 1}, {0, 3}, {1, 2}, {2, 3}, {2, 4}}));
  graph.join(1, 0);
  graph.join(0, 1);
  graph.join(2, 2);
  EXPECT_EQ(graph.edges(), before);
}

TEST(ThesisGraph, StaysWhereADirectionIsLeft) { EXPECT_EQ(drawing({{1.0}, {1.0}, {}, {}, {}}).way_to_open(0), Way{0}); }

TEST(ThesisGraph, GoesToTheNearestNodeWithADirectionLeft) {
  EXPECT_EQ(drawing({{}, {}, {}, {}, {1.0}}).way_to_open(0), (Way{0, 1, 2, 4}));
  EXPECT_EQ(drawing({{}, {}, {}, {0.1}, {1.0}}).way_to_open(0), (Way{0, 3}));
  EXPECT_EQ(drawing({{0.1}, {}, {}, {}, {1.0}}).way_to_open(2), (Way{2, 4}));
}

TEST(ThesisGraph, GoesToTheNodeMadeFirstOfTwoAsNear) {
  EXPECT_EQ(drawing({{}, {0.1}, {}, {0.1}, {}}).way_to_open(2), (Way{2, 1}));
}

TEST(ThesisGraph, IsDoneWhereNoDirectionCanBeGotTo) {
  EXPECT_EQ(drawing({{}, {}, {}, {}, {}}).way_to_open(2), std::nullopt);
  ThesisGraph apart;
  apart.add_node({});
  apart.add_node({0.3});
  EXPECT_EQ(apart.way_to_open(0), std::nullopt);
}

/// The states that table 5.1 begins and ends with.
TEST(ThesisRow, ReadsAsInTheTables) {
  const std::array<ThesisRow, 4> rows = {{{ThesisState::kExploration, {0, 1}, std::nullopt},
                                          {ThesisState::kHoming, {4, 3}, 218.215},
                                          {ThesisState::kPathPlanning, {0, 1, 8}, std::nullopt},
                                          {ThesisState::kDone, {}, std::nullopt}}};
  EXPECT_EQ(states_csv(rows),
            "state,nodes,dissimilarity\n"
            "Exploration,0-1,\n"
            "Exploration(Homing),4-3,218.215\n"
            "Path planning,0-1-8,\n"
            "EXPLORATION DONE,-,\n");
}

/// Table 5.1's own states make the 13 edges that are printed for it.
TEST(ThesisGraph, CountsTheEdgesOfTheThesisFirstRun) {
  constexpr std::array<std::array<int, 2>, 22> kStates = {
      {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 3}, {3, 5}, {5, 3}, {3, 6}, {6, 3}, {3, 5}, {5, 6},
       {6, 7}, {7, 1}, {1, 0}, {0, 7}, {7, 6}, {3, 2}, {2, 8}, {8, 1}, {1, 0}, {8, 2}, {4, 2}}};
  ThesisGraph graph;
  for (int node = 0; node < 9; ++node) graph.add_node({});
  for (const auto& [from, to] : kStates) graph.join(from, to);
  EXPECT_EQ(graph.edges().size(), 13U);
}

TEST(WronglyKnown, IsANodeThatIsFarOrNotTheNearest) {
  const std::vector<Eigen::Vector2d> nodes_m = {{0.0, 0.0}, {2.0, 0.0}, {9.0, 0.0}};
  EXPECT_FALSE(wrongly_known({0.5, 0.0}, nodes_m, 0));
  EXPECT_FALSE(wrongly_known({1.4, 0.0}, nodes_m, 0)) << "the other is nearer by 0.8 m";
  EXPECT_TRUE(wrongly_known({1.6, 0.0}, nodes_m, 0)) << "the other is nearer by 1.2 m";
  EXPECT_FALSE(wrongly_known({6.2, 0.0}, nodes_m, 2));
  EXPECT_TRUE(wrongly_known({5.6, 0.0}, nodes_m, 2)) << "3.4 m off";
}

}  // namespace
}  // namespace homeward::scenario::thesis_exploration_test
