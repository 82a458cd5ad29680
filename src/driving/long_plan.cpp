// SPDX-License-Identifier: Apache-2.0
#include "driving/long_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// The last pose of the stretch that is driven in the same gear as the one after `from`.
std::size_t end_of_stretch(const LongPlan& plan, std::size_t from) {
  std::size_t end = from + 1;
  while (end + 1 < plan.poses.size() && plan.poses[end + 1].gear == plan.poses[from + 1].gear) ++end;
  return end;
}

/// Goes on to the pose where the robot is by now. False: it is nowhere on its way.
bool advance(LongPlan& plan, const Pose2& odometry, const LongPlanConfig& config) {
  while (plan.done + 1 < plan.poses.size()) {
    const std::size_t end = end_of_stretch(plan, plan.done);
    const Pose2 to_end = inverse(odometry) * plan.poses[end].pose;
    if (plan.poses[end].gear == Gear::kTurn) {
      if (apart_m(odometry, plan.poses[end].pose) > config.astray_m) return false;
      if (std::abs(to_end.theta_rad) > config.there_rad) return true;
      plan.done = end;
      continue;
    }
    std::size_t nearest = plan.done;
    for (std::size_t i = plan.done; i <= end; ++i) {
      if (apart_m(odometry, plan.poses[i].pose) < apart_m(odometry, plan.poses[nearest].pose)) nearest = i;
    }
    if (apart_m(odometry, plan.poses[nearest].pose) > config.astray_m) return false;
    if (std::abs(wrap_angle(odometry.theta_rad - plan.poses[nearest].pose.theta_rad)) > config.astray_rad) return false;
    const bool forward = plan.poses[end].gear == Gear::kForward;
    if (nearest < end || (forward ? to_end.x_m : -to_end.x_m) > config.past_m) {
      plan.done = std::min(nearest, end - 1);
      return true;
    }
    plan.done = end;
  }
  return false;  // it is at its end
}

/// Whether things that were not seen before stand in the way.
bool is_free(const LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m, const Pose2& odometry,
             const LongPlanConfig& config) {
  std::vector<Eigen::Vector2d> seen(points_m.size());
  const Pose2 from_odometry = inverse(odometry);
  for (std::size_t i = plan.done + 1; i < plan.poses.size(); ++i) {
    const Pose2 to = inverse(from_odometry * plan.poses[i].pose);
    const double c = std::cos(to.theta_rad);
    const double s = std::sin(to.theta_rad);
    std::ranges::transform(points_m, seen.begin(), [&](const Eigen::Vector2d& p) {
      return Eigen::Vector2d(to.x_m + c * p.x() - s * p.y(), to.y_m + s * p.x() + c * p.y());
    });
    if (clearance_m(body, seen) < std::min(config.least_clear_m, plan.poses[i].clear_m - config.less_clear_m))
      return false;
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
           const Pose2& odometry, const LongPlanConfig& config) {
  const bool gets_on = apart_m(odometry, plan.still_since) > config.on_m ||
                       std::abs(wrap_angle(odometry.theta_rad - plan.still_since.theta_rad)) > config.on_rad;
  if (gets_on) plan.still_since = odometry;
  plan.still = gets_on ? 0 : plan.still + 1;
  const bool stands = plan.still > config.still_for;
  if (stands) plan.still = 0;
  const bool good = !plan.poses.empty() && !stands && advance(plan, odometry, config) &&
                    is_free(plan, body, points_m, odometry, config);
  if (good && ++plan.age < config.compare_every) return;
  plan.age = 0;
  const auto way = long_way(body.outline, points_m, goal_m, odometry.theta_rad);
  if (!way || way->poses.size() < 2) {
    if (!good || !way) plan.poses.clear();
    return;
  }
  if (good) {
    // What is left of the old one, and from its end on to where the new one ends.
    const double left_m = plan.poses.back().cost_m - plan.poses[plan.done].cost_m +
                          config.apart_cost * apart_m(plan.poses.back().pose, odometry * way->poses.back().pose);
    if (way->poses.back().cost_m > left_m - config.cheaper_m) return;
  }
  take(plan, *way, odometry);
}

}  // namespace

Motion steer_long(LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m,
                  const Eigen::Vector2d& goal_m, const Pose2& odometry, double speed_mps, double turn_gain,
                  const LongPlanConfig& config) {
  renew(plan, body, points_m, goal_m, odometry, config);
  if (plan.poses.size() < 2 || plan.done + 1 >= plan.poses.size()) return {};
  const std::size_t end = end_of_stretch(plan, plan.done);
  const Gear gear = plan.poses[end].gear;
  const Pose2 to_end = inverse(odometry) * plan.poses[end].pose;
  if (gear == Gear::kTurn) {
    const double turn_radps = std::max(config.least_turn_radps, turn_gain * std::abs(to_end.theta_rad));
    return {0.0, std::copysign(std::min(turn_radps, config.turn_share * body.max_turn_radps), to_end.theta_rad)};
  }
  // Along the arc that begins as the body heads and leads to where the way goes on (Coulter, "Implementation of the
  // pure pursuit path tracking algorithm", CMU-RI-TR-92-01, 1992).
  std::size_t look = plan.done + 1;
  while (look < end && apart_m(odometry, plan.poses[look].pose) < config.look_m) ++look;
  const Pose2 aim = inverse(odometry) * plan.poses[look].pose;
  const double squared = std::max(config.nearest_m * config.nearest_m, aim.x_m * aim.x_m + aim.y_m * aim.y_m);
  const double bend_per_m = std::clamp(2.0 * aim.y_m / squared, -config.sharpest_per_m, config.sharpest_per_m);
  // It comes to rest where it is to move in another way.
  double along_mps = speed_mps;
  if (end + 1 < plan.poses.size())
    along_mps = std::min(along_mps, config.ending_mps + config.ending_gain_per_s * std::abs(to_end.x_m));
  if (gear == Gear::kReverse) {
    const double backwards_mps = -std::min(along_mps, config.backward_mps);
    return {backwards_mps, backwards_mps * bend_per_m};
  }
  // Its front swings wide: no faster in a bend than the front may move sideways.
  const double front_m = std::max(config.least_front_m, body.outline.front_m + body.outline.radius_m);
  const double bend = std::max(1e-3, std::abs(bend_per_m));
  along_mps = std::min({along_mps, config.sideways_mps / (bend * front_m), body.max_turn_radps / bend});
  return {along_mps, along_mps * bend_per_m};
}

}  // namespace homeward::driving
