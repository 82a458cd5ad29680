// SPDX-License-Identifier: Apache-2.0
#include "scenario/thesis_graph.hpp"

#include <algorithm>
#include <cstdio>
#include <deque>

namespace homeward::scenario {

int ThesisGraph::add_node(std::vector<double> directions_rad) {
  left_rad_.push_back(std::move(directions_rad));
  return nodes() - 1;
}

void ThesisGraph::join(int a, int b) {
  if (a != b) edges_.emplace(std::min(a, b), std::max(a, b));
}

std::optional<double> ThesisGraph::take_direction(int node) {
  std::vector<double>& left_rad = left_rad_[static_cast<std::size_t>(node)];
  if (left_rad.empty()) return std::nullopt;
  const double best_rad = left_rad.front();
  left_rad.erase(left_rad.begin());
  return best_rad;
}

ThesisGraph::Tree ThesisGraph::tree_from(int from) const {
  Tree tree{std::vector<int>(left_rad_.size(), -1), std::vector<int>(left_rad_.size(), -1)};
  tree.edges[static_cast<std::size_t>(from)] = 0;
  std::deque<int> reached = {from};
  while (!reached.empty()) {
    const int here = reached.front();
    reached.pop_front();
    for (const auto& [a, b] : edges_) {
      if (a != here && b != here) continue;
      const int there = a == here ? b : a;
      const auto index = static_cast<std::size_t>(there);
      if (tree.edges[index] >= 0) continue;
      tree.edges[index] = tree.edges[static_cast<std::size_t>(here)] + 1;
      tree.before[index] = here;
      reached.push_back(there);
    }
  }
  return tree;
}

std::optional<std::vector<int>> ThesisGraph::way_to_open(int from) const {
  const Tree tree = tree_from(from);
  std::optional<int> nearest;
  for (int node = 0; node < nodes(); ++node) {
    const int edges = tree.edges[static_cast<std::size_t>(node)];
    if (edges < 0 || left_rad(node).empty()) continue;
    if (!nearest || edges < tree.edges[static_cast<std::size_t>(*nearest)]) nearest = node;
  }
  if (!nearest) return std::nullopt;
  std::vector<int> way;
  for (int node = *nearest; node >= 0; node = tree.before[static_cast<std::size_t>(node)]) way.push_back(node);
  std::ranges::reverse(way);
  return way;
}

std::string_view state_name(ThesisState state) {
  switch (state) {
    case ThesisState::kExploration:
      return "Exploration";
    case ThesisState::kHoming:
      return "Exploration(Homing)";
    case ThesisState::kPathPlanning:
      return "Path planning";
    case ThesisState::kDone:
      return "EXPLORATION DONE";
  }
  return "";
}

std::string nodes_text(std::span<const int> nodes) {
  std::string text;
  for (const int node : nodes) text += (text.empty() ? "" : "-") + std::to_string(node);
  return text.empty() ? "-" : text;
}

std::string states_csv(std::span<const ThesisRow> rows) {
  std::string table = "state,nodes,dissimilarity\n";
  for (const ThesisRow& row : rows) {
    char number[32] = "";
    if (row.dissimilarity) std::snprintf(number, sizeof number, "%.3f", *row.dissimilarity);
    table += std::string(state_name(row.state)) + "," + nodes_text(row.nodes) + "," + number + "\n";
  }
  return table;
}

bool wrongly_known(const Eigen::Vector2d& view_m, std::span<const Eigen::Vector2d> nodes_m, int named) {
  constexpr double kFar_m = 3.0;
  constexpr double kNearer_m = 1.0;
  const double distance_m = (nodes_m[static_cast<std::size_t>(named)] - view_m).norm();
  return distance_m > kFar_m || std::ranges::any_of(nodes_m, [&](const Eigen::Vector2d& node_m) {
           return (node_m - view_m).norm() <= distance_m - kNearer_m;
         });
}

}  // namespace homeward::scenario
