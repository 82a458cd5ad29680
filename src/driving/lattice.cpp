// SPDX-License-Identifier: Apache-2.0
#include "driving/lattice.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

#include "core/angles.hpp"
#include "driving/distance_field.hpp"
#include "driving/floor_distance.hpp"
#include "driving/footprint.hpp"

namespace homeward::driving {
namespace {

constexpr double kFieldCell_m = 0.03;
constexpr int kFieldHalfCells = 110;  // 3.3 m to each side
constexpr double kReach_m = 2.5;      // how far from the robot its turning point is planned
constexpr float kSpare_m = 0.06F;     // beside the body; more than the safety margin
constexpr float kComfort_m = 0.25F;   // beyond that nothing costs extra
constexpr double kThere_m = 0.12;     // from the goal
constexpr int kMostExpanded = 4000;
constexpr float kEager = 1.2F;  // ways may be so much dearer than the cheapest, if they are found sooner

// One pose stands for all that are as near to it as this.
constexpr float kCell_m = 0.08F;
constexpr int kHalfCells = 34;
constexpr int kSide = 2 * kHalfCells + 1;
constexpr int kBins = 48;  // headings that count as different

constexpr int kHeadings = 192;  // turns are multiples of one of these
constexpr float kHeading_rad = static_cast<float>(2.0 * kPi / kHeadings);

constexpr float kArc_m = 0.15F;
constexpr float kReverseCost = 2.5F;  // as dear as so many metres forward
constexpr float kTurnCost_m = 0.4F;   // for each radian in place
constexpr float kBendCost_m = 0.1F;   // for each radian along an arc
constexpr float kCrowdCost = 2.5F;    // right beside things
constexpr float kGearCost_m = 0.15F;  // for stopping to move in another way

struct Move {
  Gear gear;
  float length_m;  // along its arc, negative backwards
  int turn;        // in steps of heading, an even number
};
constexpr std::array<Move, 12> kMoves = {{{Gear::kForward, kArc_m, 0},
                                          {Gear::kForward, kArc_m, 2},
                                          {Gear::kForward, kArc_m, -2},
                                          {Gear::kForward, kArc_m, 6},
                                          {Gear::kForward, kArc_m, -6},
                                          {Gear::kForward, kArc_m, 14},
                                          {Gear::kForward, kArc_m, -14},
                                          {Gear::kTurn, 0.0F, 8},
                                          {Gear::kTurn, 0.0F, -8},
                                          {Gear::kReverse, -kArc_m, 0},
                                          {Gear::kReverse, -kArc_m, 6},
                                          {Gear::kReverse, -kArc_m, -6}}};

struct Pose {
  float x_m = 0.0F;
  float y_m = 0.0F;
  int heading = 0;  // from the first one on
};

struct Node {
  Pose pose;
  float cost_m = 0.0F;
  float clear_m = 0.0F;
  int parent = -1;
  int move = -1;
};

class Search {
 public:
  Search(const Outline& outline, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
         double heading_rad)
      : heading_rad_(static_cast<float>(heading_rad)),
        footprint_(outline, heading_rad, kHeadings),
        field_(points_m, kFieldCell_m, kFieldHalfCells, footprint_.reach_m() + double{kSpare_m + kComfort_m}),
        floor_(field_, Eigen::Vector2d::Zero(), goal_m, room_for(outline), kReach_m),
        cheapest_m_(static_cast<std::size_t>(kSide) * kSide * kBins, std::numeric_limits<float>::infinity()) {
    for (int heading = 0; heading < kHeadings; ++heading) {
      directions_.emplace_back(std::cos(angle_rad(heading)), std::sin(angle_rad(heading)));
    }
  }

  /// The index of the last pose of the way; nothing when none is nearer to the goal than the first.
  std::optional<std::size_t> run() {
    const Pose start;
    add({start, 0.0F, clearance_m(start, -1.0F), -1, -1});
    std::size_t best = 0;
    const float first_left_m = floor_.left_m(0.0F, 0.0F);
    float best_m = first_left_m - 0.1F;
    while (!open_.empty() && expanded_ < kMostExpanded) {
      const auto index = static_cast<std::size_t>(open_.top().second);
      open_.pop();
      const Node node = nodes_[index];
      if (node.cost_m > cheapest_m_[slot(node.pose)]) continue;
      ++expanded_;
      const double apart_m =
          std::hypot(double{node.pose.x_m} - floor_.target_m().x(), double{node.pose.y_m} - floor_.target_m().y());
      if (apart_m < kThere_m) {
        there_ = true;
        return index;
      }
      const float left_m = floor_.left_m(node.pose.x_m, node.pose.y_m) + 0.05F * node.cost_m;
      if (left_m < best_m) {
        best_m = left_m;
        best = index;
      }
      for (std::size_t move = 0; move < kMoves.size(); ++move) go_on(node, index, move);
    }
    if (best == 0) return std::nullopt;
    return best;
  }

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] int expanded() const { return expanded_; }
  [[nodiscard]] bool reaches_goal() const { return there_ && floor_.reaches_goal(); }

  /// Exact from `least_m` to where nothing costs extra.
  [[nodiscard]] float clearance_m(const Pose& pose, float least_m) const {
    return footprint_.clearance_m(field_, pose.x_m, pose.y_m, pose.heading, least_m, kSpare_m + kComfort_m);
  }

  /// Where an arc leads that turns by an even number of steps.
  [[nodiscard]] Pose along(const Pose& from, float length_m, int turn) const {
    const float half_rad = 0.5F * static_cast<float>(turn) * kHeading_rad;
    const float chord_m = turn == 0 ? length_m : length_m * std::sin(half_rad) / half_rad;
    const Eigen::Vector2f& direction = directions_[static_cast<std::size_t>(wrapped(from.heading + turn / 2))];
    return {from.x_m + chord_m * direction.x(), from.y_m + chord_m * direction.y(), wrapped(from.heading + turn)};
  }

  [[nodiscard]] float angle_rad(int heading) const { return heading_rad_ + static_cast<float>(heading) * kHeading_rad; }

 private:
  /// Its turning point cannot be nearer to things than its outline is to that; driving along, its sides decide.
  static FloorRoom room_for(const Outline& outline) {
    const double inner_m = std::min({outline.back_m, outline.front_m, outline.side_m}) + outline.radius_m;
    const double beside_m = outline.side_m + outline.radius_m + double{kSpare_m};
    return {inner_m, beside_m, beside_m + double{kComfort_m}, double{kCrowdCost}};
  }

  static std::size_t slot(const Pose& pose) {
    const auto cell = [](float value_m) {
      return static_cast<std::size_t>(
          std::clamp(static_cast<int>(std::lround(value_m / kCell_m)) + kHalfCells, 0, kSide - 1));
    };
    constexpr int kPerBin = kHeadings / kBins;
    return (cell(pose.y_m) * kSide + cell(pose.x_m)) * kBins + static_cast<std::size_t>(pose.heading / kPerBin);
  }

  static int wrapped(int heading) { return ((heading % kHeadings) + kHeadings) % kHeadings; }

  void add(const Node& node) {
    float& cheapest_m = cheapest_m_[slot(node.pose)];
    if (node.cost_m >= cheapest_m) return;
    const float left_m = floor_.left_m(node.pose.x_m, node.pose.y_m);
    if (!std::isfinite(left_m)) return;
    cheapest_m = node.cost_m;
    // It has to turn to where its way leads, or to drive that backwards.
    const float off_rad = floor_.heading_off_rad(node.pose.x_m, node.pose.y_m, angle_rad(node.pose.heading));
    const float turning_m = std::min(kTurnCost_m * off_rad, (kReverseCost - 1.0F) * left_m);
    open_.emplace(node.cost_m + kEager * (left_m + turning_m), static_cast<int>(nodes_.size()));
    nodes_.push_back(node);
  }

  /// A body that is too near already may go on to where it is no nearer.
  void go_on(const Node& node, std::size_t index, std::size_t number) {
    const Move& move = kMoves[number];
    const Pose end = along(node.pose, move.length_m, move.turn);
    if (std::max(std::abs(end.x_m), std::abs(end.y_m)) > static_cast<float>(kReach_m)) return;
    float cost_m = node.cost_m;
    if (node.move >= 0 && kMoves[static_cast<std::size_t>(node.move)].gear != move.gear) cost_m += kGearCost_m;
    if (cost_m >= cheapest_m_[slot(end)]) return;
    const float least_m = std::min(kSpare_m, node.clear_m - 0.002F);
    float middle_m = kSpare_m + kComfort_m;
    if (std::abs(move.turn) > 2) {  // its front swings by more than half of its width
      const int half = 2 * (move.turn / 4);
      middle_m = clearance_m(along(node.pose, 0.5F * move.length_m, half), least_m);
      if (middle_m < least_m) return;
    }
    const float end_m = clearance_m(end, least_m);
    if (end_m < least_m) return;
    const float crowding =
        std::clamp(1.0F - (std::min(middle_m, end_m) - kSpare_m) / kComfort_m, 0.0F, 1.0F) * kCrowdCost;
    switch (move.gear) {
      case Gear::kForward:
        cost_m += kArc_m * (1.0F + crowding) + kBendCost_m * std::abs(static_cast<float>(move.turn)) * kHeading_rad;
        break;
      case Gear::kTurn:
        cost_m += std::abs(static_cast<float>(move.turn)) * kHeading_rad * kTurnCost_m * (1.0F + 0.5F * crowding);
        break;
      case Gear::kReverse:
        cost_m += kArc_m * (kReverseCost + crowding);
        break;
    }
    add({end, cost_m, end_m, static_cast<int>(index), static_cast<int>(number)});
  }

  float heading_rad_;
  Footprint footprint_;
  DistanceField field_;
  FloorDistance floor_;
  std::vector<Eigen::Vector2f> directions_;  // of each heading
  std::vector<float> cheapest_m_;
  std::vector<Node> nodes_;
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  int expanded_ = 0;
  bool there_ = false;
};

}  // namespace

std::optional<LongWay> long_way(const Outline& outline, std::span<const Eigen::Vector2d> points_m,
                                const Eigen::Vector2d& goal_m, double heading_rad) {
  // The axes keep their direction while the robot turns: what is free must not change by turning, or it would dither.
  const Eigen::Rotation2Dd from_robot(heading_rad);
  std::vector<Eigen::Vector2d> turned;
  turned.reserve(points_m.size());
  for (const Eigen::Vector2d& point : points_m) turned.emplace_back(from_robot * point);
  Eigen::Vector2d goal = from_robot * goal_m;
  const double limit_m = kReach_m - 0.1;  // a goal farther away is drawn to the border
  const double largest_m = goal.cwiseAbs().maxCoeff();
  if (largest_m > limit_m) goal *= limit_m / largest_m;

  Search search(outline, turned, goal, heading_rad);
  const auto last = search.run();
  if (!last) return std::nullopt;
  LongWay way;
  way.reaches_goal = search.reaches_goal();
  way.expanded = search.expanded();
  for (int i = static_cast<int>(*last); i >= 0; i = search.nodes()[static_cast<std::size_t>(i)].parent) {
    const Node& node = search.nodes()[static_cast<std::size_t>(i)];
    const Pose2 pose{double{node.pose.x_m}, double{node.pose.y_m}, double{search.angle_rad(node.pose.heading)}};
    const Gear gear = node.move < 0 ? Gear::kForward : kMoves[static_cast<std::size_t>(node.move)].gear;
    way.poses.push_back({Pose2{0.0, 0.0, -heading_rad} * pose, gear, double{node.cost_m}, double{node.clear_m}});
  }
  std::reverse(way.poses.begin(), way.poses.end());
  return way;
}

}  // namespace homeward::driving
