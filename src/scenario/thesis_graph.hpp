// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace homeward::scenario {

/// What the exploration of the thesis knows of how its nodes hang together (Ferdaus 2008, §4.1, §4.5): edges without
/// direction or length, and of each node the directions that were not driven in yet. Nodes are numbered as they come.
class ThesisGraph {
 public:
  /// `directions_rad`: best first, counter-clockwise from the heading that the node was made with. Gives its number.
  int add_node(std::vector<double> directions_rad);
  /// An edge between two nodes, unless there is one or they are the same.
  void join(int a, int b);
  /// The best direction that is left at a node, which is not left any more; nothing where none was.
  std::optional<double> take_direction(int node);
  /// The nodes on the shortest way to the nearest node with a direction left, `from` first, by Dijkstra's algorithm
  /// with equal edges (§4.5), which is a breadth-first search. Of several as near the one made first, where the thesis
  /// does not say which. Only `from` where it has one left itself; nothing where none can be got to.
  [[nodiscard]] std::optional<std::vector<int>> way_to_open(int from) const;

  [[nodiscard]] int nodes() const { return static_cast<int>(left_rad_.size()); }
  /// Each once, the smaller number first.
  [[nodiscard]] const std::set<std::pair<int, int>>& edges() const { return edges_; }
  [[nodiscard]] std::span<const double> left_rad(int node) const { return left_rad_[static_cast<std::size_t>(node)]; }

 private:
  /// Of every node the one before it on the shortest way from `from`, and how many edges that way has; -1: no way.
  struct Tree {
    std::vector<int> before;
    std::vector<int> edges;
  };
  [[nodiscard]] Tree tree_from(int from) const;

  std::vector<std::vector<double>> left_rad_;  // best first
  std::set<std::pair<int, int>> edges_;
};

/// The states that the thesis's tables 5.1 to 5.6 tell apart.
enum class ThesisState { kExploration, kHoming, kPathPlanning, kDone };

/// A row of those tables.
struct ThesisRow {
  ThesisState state = ThesisState::kExploration;
  std::vector<int> nodes;                    // from, to; a whole way where it is planned
  std::optional<double> dissimilarity;       // from the node that the view was taken for; nothing where it was new
  std::optional<double> direction_rad = {};  // that was driven in, of those of the first node
  std::vector<double> left_rad = {};         // of that node: those left then, best first
};

/// "Exploration", "Exploration(Homing)", "Path planning", "EXPLORATION DONE".
std::string_view state_name(ThesisState state);
/// "3-4"; "-" without nodes.
std::string nodes_text(std::span<const int> nodes);
/// The rows as a table of comma-separated values: state,nodes,dissimilarity.
std::string states_csv(std::span<const ThesisRow> rows);

/// Whether a view was taken for a node that it does not show, as node 3 was for node 7 in the thesis's last run
/// (§5.2.3): the node is more than 3 m away, or another is nearer by 1 m or more (both ours). `view_m`, `nodes_m`:
/// where they truly are.
bool wrongly_known(const Eigen::Vector2d& view_m, std::span<const Eigen::Vector2d> nodes_m, int named);

}  // namespace homeward::scenario
