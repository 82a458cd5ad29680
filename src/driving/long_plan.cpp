// SPDX-License-Identifier: Apache-2.0
#include "driving/long_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

constexpr int kCompareEvery = 5;        // calls
constexpr double kCheaper_m = 0.5;      // by so much another way has to be
constexpr int kStillFor = 8;            // calls without getting on, after which another way is looked for
constexpr double kAstray_m = 0.12;      // from the way,
constexpr double kAstray_rad = 0.35;    // then it is another one
constexpr double kThere_rad = 0.05;     // from the heading that a turn in place is for
constexpr double kLeastClear_m = 0.05;  // room that has to be left along the way,
constexpr double kLess_m = 0.03;        // or as much less as was planned
constexpr double kLook_m = 0.35;        // along the way, to where it is driven next

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// The last pose of the stretch that is driven in the same gear as the one after `from`.
std::size_t end_of_stretch(const LongPlan& plan, std::size_t from) {
  std::size_t end = from + 1;
  while (end + 1 < plan.poses.size() && plan.poses[end + 1].gear == plan.poses[from + 1].gear) ++end;
  return end;
}

/// Goes on to the pose where the robot is by now. False: it is nowhere on its way.
bool advance(LongPlan& plan, const Pose2& odometry) {
  while (plan.done + 1 < plan.poses.size()) {
    const std::size_t end = end_of_stretch(plan, plan.done);
    const Pose2 to_end = inverse(odometry) * plan.poses[end].pose;
    if (plan.poses[end].gear == Gear::kTurn) {
      if (apart_m(odometry, plan.poses[end].pose) > kAstray_m) return false;
      if (std::abs(to_end.theta_rad) > kThere_rad) return true;
      plan.done = end;
      continue;
    }
    std::size_t nearest = plan.done;
    for (std::size_t i = plan.done; i <= end; ++i) {
      if (apart_m(odometry, plan.poses[i].pose) < apart_m(odometry, plan.poses[nearest].pose)) nearest = i;
    }
    if (apart_m(odometry, plan.poses[nearest].pose) > kAstray_m) return false;
    if (std::abs(wrap_angle(odometry.theta_rad - plan.poses[nearest].pose.theta_rad)) > kAstray_rad) return false;
    const bool forward = plan.poses[end].gear == Gear::kForward;
    constexpr double kPast_m = 0.03;
    if (nearest < end || (forward ? to_end.x_m : -to_end.x_m) > kPast_m) {
      plan.done = std::min(nearest, end - 1);
      return true;
    }
    plan.done = end;
  }
  return false;  // it is at its end
}

/// Whether things that were not seen before stand in the way.
bool is_free(const LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m, const Pose2& odometry) {
  std::vector<Eigen::Vector2d> seen(points_m.size());
  const Pose2 from_odometry = inverse(odometry);
  for (std::size_t i = plan.done + 1; i < plan.poses.size(); ++i) {
    const Pose2 to = inverse(from_odometry * plan.poses[i].pose);
    const double c = std::cos(to.theta_rad);
    const double s = std::sin(to.theta_rad);
    std::ranges::transform(points_m, seen.begin(), [&](const Eigen::Vector2d& p) {
      return Eigen::Vector2d(to.x_m + c * p.x() - s * p.y(), to.y_m + s * p.x() + c * p.y());
    });
    if (clearance_m(body, seen) < std::min(kLeastClear_m, plan.poses[i].clear_m - kLess_m)) return false;
  }
  return true;
}

void take(LongPlan& plan, const LongWay& way, const Pose2& odometry) {
  plan.poses = way.poses;
  for (WayPose& pose : plan.poses) pose.pose = odometry * pose.pose;
  plan.done = 0;
}

/// Keeps the plan or makes another.
void renew(LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
           const Pose2& odometry) {
  constexpr double kOn_m = 0.02;
  constexpr double kOn_rad = 0.03;
  const bool gets_on = apart_m(odometry, plan.still_since) > kOn_m ||
                       std::abs(wrap_angle(odometry.theta_rad - plan.still_since.theta_rad)) > kOn_rad;
  if (gets_on) plan.still_since = odometry;
  plan.still = gets_on ? 0 : plan.still + 1;
  const bool stands = plan.still > kStillFor;
  if (stands) plan.still = 0;
  const bool good =
      !plan.poses.empty() && !stands && advance(plan, odometry) && is_free(plan, body, points_m, odometry);
  if (good && ++plan.age < kCompareEvery) return;
  plan.age = 0;
  const auto way = long_way(body.outline, points_m, goal_m, odometry.theta_rad);
  if (!way || way->poses.size() < 2) {
    if (!good || !way) plan.poses.clear();
    return;
  }
  if (good) {
    // What is left of the old one, and from its end on to where the new one ends.
    const double left_m = plan.poses.back().cost_m - plan.poses[plan.done].cost_m +
                          1.2 * apart_m(plan.poses.back().pose, odometry * way->poses.back().pose);
    if (way->poses.back().cost_m > left_m - kCheaper_m) return;
  }
  take(plan, *way, odometry);
}

}  // namespace

Motion steer_long(LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m,
                  const Eigen::Vector2d& goal_m, const Pose2& odometry, double speed_mps, double turn_gain) {
  renew(plan, body, points_m, goal_m, odometry);
  if (plan.poses.size() < 2 || plan.done + 1 >= plan.poses.size()) return {};
  const std::size_t end = end_of_stretch(plan, plan.done);
  const Gear gear = plan.poses[end].gear;
  const Pose2 to_end = inverse(odometry) * plan.poses[end].pose;
  if (gear == Gear::kTurn) {
    constexpr double kLeast_radps = 0.12;
    const double turn_radps = std::max(kLeast_radps, turn_gain * std::abs(to_end.theta_rad));
    return {0.0, std::copysign(std::min(turn_radps, 0.6 * body.max_turn_radps), to_end.theta_rad)};
  }
  // Along the arc that begins as the body heads and leads to where the way goes on (Coulter, "Implementation of the
  // pure pursuit path tracking algorithm", CMU-RI-TR-92-01, 1992).
  std::size_t look = plan.done + 1;
  while (look < end && apart_m(odometry, plan.poses[look].pose) < kLook_m) ++look;
  const Pose2 aim = inverse(odometry) * plan.poses[look].pose;
  constexpr double kSharpest_per_m = 3.5;
  constexpr double kNearest_m = 0.12;  // nearer than that, which way it lies says little
  const double squared = std::max(kNearest_m * kNearest_m, aim.x_m * aim.x_m + aim.y_m * aim.y_m);
  const double bend_per_m = std::clamp(2.0 * aim.y_m / squared, -kSharpest_per_m, kSharpest_per_m);
  // It comes to rest where it is to move in another way.
  double along_mps = speed_mps;
  if (end + 1 < plan.poses.size()) along_mps = std::min(along_mps, 0.08 + 0.8 * std::abs(to_end.x_m));
  if (gear == Gear::kReverse) {
    constexpr double kReverse_mps = 0.2;
    const double backwards_mps = -std::min(along_mps, kReverse_mps);
    return {backwards_mps, backwards_mps * bend_per_m};
  }
  // Its front swings wide: no faster in a bend than the front may move sideways.
  constexpr double kSideways_mps = 0.4;
  const double front_m = std::max(0.3, body.outline.front_m + body.outline.radius_m);
  const double bend = std::max(1e-3, std::abs(bend_per_m));
  along_mps = std::min({along_mps, kSideways_mps / (bend * front_m), body.max_turn_radps / bend});
  return {along_mps, along_mps * bend_per_m};
}

}  // namespace homeward::driving
