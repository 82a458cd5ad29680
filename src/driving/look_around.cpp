// SPDX-License-Identifier: Apache-2.0
#include "driving/look_around.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "driving/footprint.hpp"

namespace homeward::driving {
namespace {

using Vector2 = Eigen::Vector2d;

Vector2 in_odometry(const Pose2& odometry, const Vector2& robot_m) {
  const Pose2 point = odometry * Pose2{robot_m.x(), robot_m.y(), 0.0};
  return {point.x_m, point.y_m};
}

/// How far nothing lies in a strip as wide as the body, in this direction.
double free_m(const Body& body, std::span<const Vector2> points_m, double direction_rad,
              const LookAroundConfig& config) {
  const double half_width_m = body.outline.radius_m + body.outline.side_m + config.room_m;
  const Vector2 along(std::cos(direction_rad), std::sin(direction_rad));
  double least_m = config.farthest_m;
  for (const Vector2& point : points_m) {
    const double ahead_m = point.dot(along);
    const double aside_m = std::abs(point.x() * along.y() - point.y() * along.x());
    if (ahead_m > 0.0 && aside_m < half_width_m) least_m = std::min(least_m, ahead_m);
  }
  return least_m;
}

}  // namespace

std::optional<Vector2> look_around(LookAround& state, const Body& body, std::span<const Vector2> points_m,
                                   const Pose2& odometry, const LookAroundConfig& config) {
  if (!state.been_m.empty()) {
    state.driven_m += std::hypot(odometry.x_m - state.odometry.x_m, odometry.y_m - state.odometry.y_m);
  }
  state.odometry = odometry;
  const Vector2 here_m(odometry.x_m, odometry.y_m);
  if (state.been_m.empty() || (state.been_m.back() - here_m).norm() > config.trail_m) state.been_m.push_back(here_m);
  if (state.driven_m > config.most_m) return std::nullopt;
  if (state.aim_m && (*state.aim_m - here_m).norm() < config.reached_m) state.aim_m.reset();
  if (!state.aim_m) {
    double best = 0.0;
    for (int k = 0; k < config.directions; ++k) {
      const double direction_rad = wrap_angle(2.0 * kPi * k / config.directions);
      const double way_m = std::min(config.step_m, free_m(body, points_m, direction_rad, config) - config.keeps_off_m);
      if (way_m < config.least_way_m) continue;
      const Vector2 to_m = in_odometry(odometry, way_m * Vector2(std::cos(direction_rad), std::sin(direction_rad)));
      double new_m = 1e9;  // from where it was already
      for (const Vector2& been : state.been_m) new_m = std::min(new_m, (been - to_m).norm());
      const double worth = std::min(new_m, config.step_m) - config.turn_cost_m * std::abs(direction_rad) / kPi;
      if (worth <= best) continue;
      best = worth;
      state.aim_m = to_m;
    }
  }
  if (!state.aim_m) return std::nullopt;
  const Pose2 aim = inverse(odometry) * Pose2{state.aim_m->x(), state.aim_m->y(), 0.0};
  return Vector2(aim.x_m, aim.y_m);
}

}  // namespace homeward::driving
