// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "exploration/open_directions.hpp"
#include "exploration/view_classifier.hpp"
#include "pipeline/eye.hpp"
#include "scenario/exploration_run.hpp"
#include "scenario/leg_drive.hpp"
#include "scenario/thesis_graph.hpp"

namespace homeward::scenario {

/// How the robot homes to a node. The thesis gives the direction (§4.3) and neither how far to follow it nor when to
/// stop: all of this is ours.
struct ThesisHomingConfig {
  double arrived_parallax_rad = 0.03;  // median parallax below which the node is reached
  double step_per_parallax_m = 4.0;    // driven before the next picture, for each radian of median parallax,
  double least_step_m = 0.1;           // at least,
  double most_step_m = 0.5;            // at most
  int most_steps = 40;                 // then it takes itself to be there
  int most_blocked = 2;                // so many blocked steps in succession, the same
};

/// An exploration of the thesis and its two parameters (§5.2.1): `forward_distance_m` and `classifier.hist_threshold`.
struct ThesisPlan {
  double forward_distance_m = 2.0;
  exploration::ViewClassifierConfig classifier;
  exploration::OpenDirectionsConfig directions;
  ThesisHomingConfig homing;
  double limit_m = 2000.0;  // driven; it ends there
  int limit_rows = 300;     // states; it ends there
  double speed_limit_mps = 0.5;
};

/// A node as it was made.
struct ThesisNode {
  Pose2 truth;                         // for judging only
  std::vector<double> directions_rad;  // best first, counter-clockwise from its heading
};

/// A view that was compared with all nodes.
struct ThesisClassification {
  int from = 0;  // the node that the drive began at
  LegEnd drive = LegEnd::kReached;
  std::vector<double> dissimilarities;  // from each node that there was, in their order (table 5.5)
  std::optional<int> known;             // the node that it was taken for; nothing: it was new
  bool wrong = false;                   // by `wrongly_known`
  Pose2 truth;                          // for judging only
};

/// Why a homing ended. Whichever it was, the robot takes itself to be at the node.
enum class ThesisHomingEnd : std::uint8_t {
  kArrived,      // the views coincide
  kNoDirection,  // too few features say where to: at the node as well as far from it
  kBlocked,
  kSteps,
};

struct ThesisHoming {
  int node = 0;
  ThesisHomingEnd end = ThesisHomingEnd::kArrived;
  int steps = 0;
  double began_off_m = 0.0;   // true distance from the node, for judging only
  double off_m = 0.0;         // the same in the end
  double turn_off_rad = 0.0;  // of the compass's turn to the node's heading from the true one, (-pi, pi]
};

struct ThesisExploration {
  std::vector<ThesisNode> nodes;
  ThesisGraph graph;
  std::vector<ThesisRow> rows;
  std::vector<ThesisClassification> classifications;
  std::vector<ThesisHoming> homings;
  ExplorationEnd ended = ExplorationEnd::kComplete;
  std::string reason;  // where it was stopped
  double driven_m = 0.0;
  double duration_s = 0.0;
  int collisions = 0;
};

/// Explores a world in simulated time as the thesis does (Ferdaus 2008, chapters 4 and 5): drive `forward_distance_m`
/// in the best open direction left at the node, compare the view with those of all nodes; a new one becomes a node with
/// an edge, at a known one the robot homes to the node and goes on from there; where no direction is left it homes
/// along the shortest way to the nearest node with one; it ends where there is none. The robot knows where it is by
/// sight alone; odometry serves single legs.
///
/// The turn between the present heading and the node's is that of the visual compass (§4.4). It is the thesis's only
/// means for that; here it is what others fall back on, as matched features tell the turn better.
///
/// What the thesis contradicts itself in, or leaves out:
/// - Best directions: `exploration::OpenDirectionsConfig::most`. None is left out for leading back where the robot came
///   from: the text knows no such rule.
/// - A known view's edge is made "after reaching the node" (§4.1); no homing of the tables fails. Here one may: the
///   robot does not notice, takes itself to be at the node, and the edge is made.
/// - A view like that of the node which the drive began at makes no edge.
/// - Avoidance goes first (§4.7). Its 15 degrees are not followed: the leg goes round what stands in the way to its
///   goal, `forward_distance_m` straight ahead of where it began; blocked, it ends, and the view there is compared.
/// - Table 5.4 has "Exploration 8-6" with an edge to a node that there is, and no dissimilarity: taken for a homing.
///   Table 5.3 ends in a "Path planning" without a drive after it: not followed, planning goes only to nodes with a
///   direction left.
/// - A direction is used up by driving in it, whatever came of that.
/// - Edges have no lengths, and path planning adds none.
///
/// `progress`: called with each new row; may be empty. `recorder`: of the same body and eye; may be null. Errors: those
/// of Eye::unwrap, features::describe, exploration::open_directions, exploration::known_view and
/// homing::visual_compass.
Result<ThesisExploration> explore_as_thesis(SimulatedRobot& robot, const driving::Body& body, const pipeline::Eye& eye,
                                            const ThesisPlan& plan,
                                            const std::function<void(const ThesisRow&)>& progress = {},
                                            recording::Recorder* recorder = nullptr);

}  // namespace homeward::scenario
