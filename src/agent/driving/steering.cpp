// SPDX-License-Identifier: Apache-2.0
#include "agent/driving/steering.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "agent/driving/lattice.hpp"
#include "agent/driving/local_path.hpp"
#include "core/angles.hpp"

namespace homeward::agent {
namespace {

constexpr double kClose_m = 0.1;      // with less room the way out is looked for first
constexpr double kEnough_m = 0.08;    // so much room it wants before it minds nothing but its way
constexpr double kOutwards = 0.3;     // room gained for each metre, up to that
constexpr double kLook_m = 0.16;      // so far ahead
constexpr double kHeading_rad = 0.1;  // from one heading tried to the next

/// How much room is wanting on the way straight ahead after turning by an angle; 0: none.
double shortfall_m(const Body& body, std::span<const Eigen::Vector2d> near_m, double angle_rad, double now_m) {
  const Eigen::Rotation2Dd turned(-angle_rad);
  double worst_m = 0.0;
  std::vector<Eigen::Vector2d> then(near_m.size());
  for (double along_m = 0.25 * kLook_m; along_m <= kLook_m + 1e-9; along_m += 0.25 * kLook_m) {
    std::ranges::transform(near_m, then.begin(), [&](const Eigen::Vector2d& point) -> Eigen::Vector2d {
      return turned * point - Eigen::Vector2d(along_m, 0.0);
    });
    const double wanted_m = std::min(kEnough_m, now_m + kOutwards * along_m);
    worst_m = std::max(worst_m, wanted_m - clearance_m(body, then));
  }
  return worst_m;
}

/// The heading nearest to the wanted one along which there will be more room; the least bad where there is none.
double heading_with_room(const Body& body, std::span<const Eigen::Vector2d> points_m, double wanted_rad) {
  constexpr double kNear_m = 1.5;
  std::vector<Eigen::Vector2d> near;
  std::ranges::copy_if(points_m, std::back_inserter(near),
                       [&](const Eigen::Vector2d& point) { return point.norm() < kNear_m; });
  const double now_m = clearance_m(body, near);
  if (now_m >= kClose_m) return wanted_rad;
  double best_rad = wanted_rad;
  double least_m = shortfall_m(body, near, wanted_rad, now_m);
  for (double off_rad = kHeading_rad; off_rad < kPi && least_m > 0.0; off_rad += kHeading_rad) {
    for (const double angle_rad : {wanted_rad + off_rad, wanted_rad - off_rad}) {
      const double wanting_m = shortfall_m(body, near, angle_rad, now_m);
      if (wanting_m >= least_m) continue;
      least_m = wanting_m;
      best_rad = angle_rad;
    }
  }
  return wrap_angle(best_rad);
}

/// Along the arc that begins as the body heads and leads to where the way goes on.
Motion steer_long(const Body& body, const LongWay& way, double speed_mps, double turn_gain) {
  if (way.gear == Gear::kTurn) {
    constexpr double kLeast_radps = 0.15;
    const double turn_radps = std::max(kLeast_radps, turn_gain * std::abs(way.turn_rad));
    return {0.0, std::copysign(std::min(turn_radps, 0.6 * body.max_turn_radps), way.turn_rad)};
  }
  constexpr double kSharpest_per_m = 3.5;
  const double squared = std::max(1e-4, way.aim_m.squaredNorm());
  const double bend_per_m = std::clamp(2.0 * way.aim_m.y() / squared, -kSharpest_per_m, kSharpest_per_m);
  if (way.gear == Gear::kReverse) {
    constexpr double kReverse_mps = 0.15;
    const double backwards_mps = -std::min(speed_mps, kReverse_mps);
    return {backwards_mps, backwards_mps * bend_per_m};
  }
  // Its front swings wide: no faster in a bend than the front may move sideways.
  constexpr double kSideways_mps = 0.35;
  const double front_m = std::max(0.3, body.outline.front_m + body.outline.radius_m);
  const double bent_mps = kSideways_mps / std::max(1e-3, std::abs(bend_per_m) * front_m);
  const double forward_mps =
      std::min({speed_mps, bent_mps, body.max_turn_radps / std::max(1e-3, std::abs(bend_per_m))});
  return {forward_mps, forward_mps * bend_per_m};
}

}  // namespace

Motion steer_round(const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
                   double heading_rad, double speed_mps, double turn_gain) {
  if (!is_round(body.outline)) {
    const auto way = long_way(body.outline, points_m, goal_m, heading_rad);
    return way ? steer_long(body, *way, speed_mps, turn_gain) : Motion{};
  }
  const auto way = local_way(body, points_m, goal_m, heading_rad);
  if (!way) return {};
  const double angle_rad = heading_with_room(body, points_m, std::atan2(way->carrot_m.y(), way->carrot_m.x()));
  const double turn_radps = std::clamp(turn_gain * angle_rad, -body.max_turn_radps, body.max_turn_radps);
  constexpr double kTurnFirst_rad = 0.9;
  if (std::abs(angle_rad) > kTurnFirst_rad) return {0.0, turn_radps};
  const double straightness = std::cos(angle_rad * 1.57 / kTurnFirst_rad);
  return {speed_mps * std::max(0.15, straightness), turn_radps};
}

}  // namespace homeward::agent
