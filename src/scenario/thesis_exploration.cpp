// SPDX-License-Identifier: Apache-2.0
#include "scenario/thesis_exploration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"
#include "driving/exploration_over.hpp"
#include "features/global.hpp"
#include "homing/scale_space.hpp"
#include "homing/visual_compass.hpp"

namespace homeward::scenario {
namespace {

/// A picture with all that the thesis makes of it.
struct View {
  camera::Panorama panorama;
  features::Appearance appearance;
};

wire::ThesisState recorded_state(ThesisState state) {
  switch (state) {
    case ThesisState::kExploration:
      return wire::ThesisState::kExploration;
    case ThesisState::kHoming:
      return wire::ThesisState::kHoming;
    case ThesisState::kPathPlanning:
      return wire::ThesisState::kPathPlanning;
    case ThesisState::kDone:
      break;
  }
  return wire::ThesisState::kDone;
}

/// The robot of the thesis: it drives, looks, and takes itself to be at one of its nodes.
class Explorer {
 public:
  Explorer(SimulatedRobot& robot, const driving::Body& body, const pipeline::Eye& eye, const ThesisPlan& plan,
           const std::function<void(const ThesisRow&)>& progress, recording::Recorder* recorder)
      : robot_(robot),
        eye_(eye),
        plan_(plan),
        progress_(progress),
        drive_(robot, body, features::feature_config_id(eye.feature_config()), plan.speed_limit_mps, plan.limit_m,
               recorder) {}

  Result<ThesisExploration> run() {
    auto first = look();
    if (!first) return pass_on(first);
    auto whole = features::describe(first->panorama);
    if (!whole) return pass_on(whole);
    if (const Status made = add_node(std::move(*first), std::move(*whole)); !made) return pass_on(made);
    while (!over_) {
      if (const Status done = next(); !done) return pass_on(done);
    }
    drive_.end(driving::exploration_over(
        result_.ended == ExplorationEnd::kLimit ? exploration::SurveyEnd::kLimit : exploration::SurveyEnd::kAllSeen,
        0));
    result_.reason = drive_.reason();
    result_.driven_m = robot_.vehicle().path_m();
    result_.duration_s = drive_.seconds();
    result_.collisions = robot_.vehicle().collisions();
    return std::move(result_);
  }

 private:
  /// One drive of exploration, or of path planning.
  Status next() {
    if (static_cast<int>(result_.rows.size()) >= plan_.limit_rows) {
      end(ExplorationEnd::kLimit);
      return {};
    }
    if (const auto direction_rad = result_.graph.take_direction(at_)) return explore(*direction_rad);
    const auto way = result_.graph.way_to_open(at_);
    if (!way) {
      add_row({ThesisState::kDone, {}, {}, {}, {}});
      end(ExplorationEnd::kComplete);
      return {};
    }
    add_row({ThesisState::kPathPlanning, *way, {}, {}, {}});
    for (std::size_t i = 1; i < way->size() && !over_; ++i) {
      if (const Status homed = home((*way)[i]); !homed) return homed;
    }
    return {};
  }

  Status explore(double direction_rad) {
    const double bearing_rad = direction_rad + turn_to_node_rad_;
    const LegEnd leg = drive(plan_.forward_distance_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad)));
    if (over_) return {};
    auto view = look();
    if (!view) return pass_on(view);
    auto whole = features::describe(view->panorama);
    if (!whole) return pass_on(whole);
    const auto known = exploration::known_view(*whole, wholes_, plan_.classifier);
    if (!known) return pass_on(known);
    if (const Status noted = note(*whole, leg, *known); !noted) return noted;
    const int from = at_;
    const auto left_rad = result_.graph.left_rad(from);
    ThesisRow row{ThesisState::kExploration, {from}, {}, direction_rad, {left_rad.begin(), left_rad.end()}};
    if (!*known) {
      if (const Status made = add_node(std::move(*view), std::move(*whole)); !made) return made;
      result_.graph.join(from, at_);
      row.nodes.push_back(at_);
      add_row(std::move(row));
      return {};
    }
    row.state = ThesisState::kHoming;
    row.nodes.push_back((*known)->node);
    row.dissimilarity = (*known)->dissimilarity;
    add_row(std::move(row));
    if (const Status homed = home((*known)->node); !homed) return homed;
    if (!over_) result_.graph.join(from, at_);
    return {};
  }

  /// Keeps how the present view was judged, and how right that is.
  Status note(const features::GlobalDescriptor& whole, LegEnd leg, const std::optional<exploration::KnownView>& known) {
    auto dissimilarities = exploration::view_dissimilarities(whole, wholes_, plan_.classifier.measure);
    if (!dissimilarities) return pass_on(dissimilarities);
    ThesisClassification judged;
    judged.from = at_;
    judged.drive = leg;
    judged.dissimilarities = std::move(*dissimilarities);
    judged.truth = robot_.vehicle().pose();
    if (known) {
      std::vector<Eigen::Vector2d> nodes_m;
      for (const ThesisNode& node : result_.nodes) nodes_m.push_back(position_m(node.truth));
      judged.known = known->node;
      judged.wrong = wrongly_known(position_m(judged.truth), nodes_m, known->node);
    }
    result_.classifications.push_back(std::move(judged));
    return {};
  }

  /// Homes by sight, then reads the turn to the node's heading.
  Status home(int node) {
    ThesisHoming homing;
    homing.node = node;
    homing.began_off_m = off_m(node);
    int blocked = 0;
    for (;;) {
      auto view = look();
      if (!view) return pass_on(view);
      const auto goal_m = homing_step(view->appearance, node, homing.end);
      const bool gives_up = homing.steps >= plan_.homing.most_steps || blocked >= plan_.homing.most_blocked;
      if (goal_m && !gives_up) {
        const LegEnd leg = drive(*goal_m);
        if (over_) return {};
        ++homing.steps;
        blocked = leg == LegEnd::kBlocked ? blocked + 1 : 0;
        continue;
      }
      if (goal_m) homing.end = blocked > 0 ? ThesisHomingEnd::kBlocked : ThesisHomingEnd::kSteps;
      const auto turn = homing::visual_compass(view->panorama, views_[static_cast<std::size_t>(node)].panorama);
      if (!turn) return pass_on(turn);
      turn_to_node_rad_ = turn->turn_rad;
      break;
    }
    at_ = node;
    homing.off_m = off_m(node);
    homing.turn_off_rad = wrap_angle(robot_.vehicle().pose().theta_rad + turn_to_node_rad_ -
                                     result_.nodes[static_cast<std::size_t>(node)].truth.theta_rad);
    result_.homings.push_back(homing);
    return {};
  }

  /// Where to drive next on the way to a node, robot frame; nothing where homing ends, with why in `end`.
  std::optional<Eigen::Vector2d> homing_step(const features::Appearance& here, int node, ThesisHomingEnd& end) const {
    homing::ScaleSpaceConfig config;
    config.sum = homing::ScaleSpaceSum::kGroupSizes;
    const auto vector = homing::scale_space_vector(here, views_[static_cast<std::size_t>(node)].appearance, config);
    if (!vector) {
      end = ThesisHomingEnd::kNoDirection;
      return std::nullopt;
    }
    if (vector->median_parallax_rad <= plan_.homing.arrived_parallax_rad) {
      end = ThesisHomingEnd::kArrived;
      return std::nullopt;
    }
    const double step_m = std::clamp(plan_.homing.step_per_parallax_m * vector->median_parallax_rad,
                                     plan_.homing.least_step_m, plan_.homing.most_step_m);
    return step_m * Eigen::Vector2d(std::cos(vector->bearing_rad), std::sin(vector->bearing_rad));
  }

  /// The robot takes itself to be at the node that it makes.
  Status add_node(View view, features::GlobalDescriptor whole) {
    const auto open = exploration::open_directions(robot_.sweep(), plan_.directions);
    if (!open) return pass_on(open);
    ThesisNode node;
    node.truth = robot_.vehicle().pose();
    for (const exploration::OpenDirection& direction : *open) node.directions_rad.push_back(direction.bearing_rad);
    at_ = result_.graph.add_node(node.directions_rad);
    result_.nodes.push_back(std::move(node));
    views_.push_back(std::move(view));
    wholes_.push_back(std::move(whole));
    turn_to_node_rad_ = 0.0;
    return {};
  }

  Result<View> look() {
    auto panorama = eye_.unwrap(robot_.picture());
    if (!panorama) return pass_on(panorama);
    features::Appearance appearance = eye_.look(*panorama);
    return View{std::move(*panorama), std::move(appearance)};
  }

  LegEnd drive(const Eigen::Vector2d& goal_m) {
    const double within_m = std::min(0.1, 0.3 * goal_m.norm());  // a short step has to be a step
    const LegEnd leg = drive_.drive(goal_m, within_m);
    if (leg == LegEnd::kStopped) end(ExplorationEnd::kStopped);
    if (leg == LegEnd::kLimit) end(ExplorationEnd::kLimit);
    return leg;
  }

  void end(ExplorationEnd why) {
    result_.ended = why;
    over_ = true;
  }

  void add_row(ThesisRow row) {
    drive_.note(wire::ThesisRow{recorded_state(row.state),
                                {row.nodes.begin(), row.nodes.end()},
                                row.dissimilarity,
                                row.direction_rad,
                                row.left_rad});
    result_.rows.push_back(std::move(row));
    if (progress_) progress_(result_.rows.back());
  }

  [[nodiscard]] double off_m(int node) const {
    const Eigen::Vector2d node_m = position_m(result_.nodes[static_cast<std::size_t>(node)].truth);
    return (position_m(robot_.vehicle().pose()) - node_m).norm();
  }

  SimulatedRobot& robot_;
  const pipeline::Eye& eye_;
  const ThesisPlan& plan_;
  const std::function<void(const ThesisRow&)>& progress_;
  LegDrive drive_;
  std::vector<View> views_;                         // of the nodes
  std::vector<features::GlobalDescriptor> wholes_;  // of the nodes
  int at_ = 0;                                      // the node that the robot takes itself to be at,
  double turn_to_node_rad_ = 0.0;                   // and the turn from its heading to that of the node
  bool over_ = false;
  ThesisExploration result_;
};

}  // namespace

Result<ThesisExploration> explore_as_thesis(SimulatedRobot& robot, const driving::Body& body, const pipeline::Eye& eye,
                                            const ThesisPlan& plan,
                                            const std::function<void(const ThesisRow&)>& progress,
                                            recording::Recorder* recorder) {
  return Explorer(robot, body, eye, plan, progress, recorder).run();
}

}  // namespace homeward::scenario
