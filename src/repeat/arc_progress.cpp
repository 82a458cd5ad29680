// SPDX-License-Identifier: Apache-2.0
#include "repeat/arc_progress.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace homeward::repeat {
namespace {

Eigen::Vector3d turn_vector(const Eigen::Matrix3d& turn) {
  const Eigen::AngleAxisd by(turn);
  return by.angle() * by.axis();
}

/// The way from one key image to the next in the frame of the surroundings; zero where it is not known.
Eigen::Vector3d way_along(const KeyPose& from, const KeyPose& to) {
  if (!from.is_placed || !to.is_placed) return Eigen::Vector3d::Zero();
  return to.position - from.position;
}

}  // namespace

ArcProgress progress_along(const ArcSurroundings& around, int from_key, const ArcPose& pose) {
  constexpr double kLeast = 1e-3;     // radians: less leads nowhere
  constexpr double kTurnsFrom = 3.0;  // times as much is seen of the turn as of the way
  const KeyPose& from = around.key(from_key);
  const KeyPose& to = *around.next_key(from_key);
  const Eigen::Vector3d way = way_along(from, to);
  const Eigen::Vector3d turn = turn_vector(from.local_from_key.transpose() * to.local_from_key);
  const double seen_turn = turn.norm();
  const double seen_way = around.nearness * way.norm();
  ArcProgress progress;
  if (seen_way > kLeast) progress.of_way = way.dot(pose.position - from.position) / way.squaredNorm();
  if (from.is_placed) progress.gone_rad = around.nearness * from.ahead.dot(pose.position - from.position);
  if (seen_way > kLeast) progress.past_rad = progress.gone_rad - seen_way;
  if (seen_turn > kTurnsFrom * seen_way && seen_turn > kLeast) {
    const Eigen::Vector3d turned = turn_vector(from.local_from_key.transpose() * pose.local_from_current);
    progress.of_turn = turn.dot(turned) / turn.squaredNorm();
  }
  return progress;
}

std::optional<double> lateral_of(const ArcSurroundings& around, int from_key, const ArcPose& pose) {
  const KeyPose& from = around.key(from_key);
  const Eigen::Vector3d way = way_along(from, *around.next_key(from_key));
  const double length = way.norm();
  if (!(length > 0.0)) return std::nullopt;
  const Eigen::Vector3d up = from.local_from_key.col(2);
  return (pose.position - from.position).dot(up.cross(way)) / (length * length);
}

std::optional<double> bearing_of_key(const ArcSurroundings& around, int key, const ArcPose& pose) {
  constexpr double kLeast = 0.01;  // of the landmarks' distance
  const KeyPose& there = around.key(key);
  if (!there.is_placed || !around.unit_arc) return std::nullopt;
  const Eigen::Vector3d way = pose.local_from_current.transpose() * (there.position - pose.position);
  if (!(way.norm() * around.nearness > kLeast)) return std::nullopt;
  return std::atan2(way.y(), way.x());
}

}  // namespace homeward::repeat
