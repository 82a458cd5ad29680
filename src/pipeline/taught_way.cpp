// SPDX-License-Identifier: Apache-2.0
#include "pipeline/taught_way.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"
#include "core/index.hpp"

namespace homeward::pipeline {
namespace {

constexpr double kAhead_m = 2.5;

/// A pose between two, at a share of the way from one to the other.
Pose2 between(const Pose2& a, const Pose2& b, double share) {
  return {a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
          wrap_angle(a.theta_rad + share * wrap_angle(b.theta_rad - a.theta_rad))};
}

}  // namespace

Result<TaughtWay> TaughtWay::create(std::shared_ptr<const map::TopologicalMap> map, const ImageId& end) {
  if (!map || !map->path) {
    return fail(ErrorCode::kInvalidInput, "This map was not taught as a path (homeward teach): it has no key images.");
  }
  const auto found = std::ranges::find(map->images, end, &map::MapImage::id);
  if (found == map->images.end()) {
    return fail(ErrorCode::kNotFound, "The path was not taught with such a picture.", end.str());
  }
  const auto number = static_cast<int>(found - map->images.begin());
  return TaughtWay(std::move(map), number);
}

const std::optional<Pose2>& TaughtWay::shown_at(int picture) const { return map_->images[at(picture)].odometry; }

/// By the odometry between the key images whose arcs have a length.
std::optional<double> TaughtWay::metres_per_unit(const repeat::ArcSurroundings& around) const {
  const auto& keys = map_->path->taught.key_images;
  double metres = 0.0;
  double units = 0.0;
  for (std::size_t i = 0; i < around.units.size(); ++i) {
    const int key = around.keys[i].key;
    const auto& from = shown_at(keys[at(key)].picture);
    const auto& to = shown_at(keys[at(key) + 1].picture);
    if (!around.units[i] || !from || !to) continue;
    metres += (position_m(*to) - position_m(*from)).norm();
    units += *around.units[i];
  }
  return units > 0.0 && metres > 0.0 ? std::optional(metres / units) : std::nullopt;
}

/// Where the robot is in odometry's frame of the tour, as one key image tells it.
std::optional<Pose2> TaughtWay::robot_by_key(const repeat::Repeater& repeater, int key, double metres) const {
  const repeat::ArcSurroundings& around = *repeater.surroundings();
  if (!around.has_key(key) || !around.key(key).is_placed) return std::nullopt;
  const auto& shown = shown_at(map_->path->taught.key_images[at(key)].picture);
  if (!shown) return std::nullopt;
  const repeat::KeyPose& placed = around.key(key);
  const Eigen::Matrix3d turn = placed.local_from_key.transpose() * repeater.pose().local_from_current;
  const Eigen::Vector3d way_m =
      metres * (placed.local_from_key.transpose() * (repeater.pose().position - placed.position));
  const Eigen::Vector3d eye_m = map_->camera.robot_from_camera_translation_m;
  const Eigen::Vector3d robot_m = way_m + eye_m - turn * eye_m;
  return *shown * Pose2{robot_m.x(), robot_m.y(), std::atan2(turn(1, 0), turn(0, 0))};
}

/// By both key images of the arc, the nearer one more.
std::optional<Pose2> TaughtWay::robot_on_tour(const repeat::Repeater& repeater, const repeat::Repeated& said) const {
  const auto metres = metres_per_unit(*repeater.surroundings());
  if (!metres) return std::nullopt;
  const auto from = robot_by_key(repeater, said.from_key, *metres);
  const auto to = robot_by_key(repeater, said.to_key, *metres);
  if (!from || !to) return from ? from : to;
  return between(*from, *to, std::clamp(said.progress, 0.0, 1.0));
}

int TaughtWay::nearest_picture(const Pose2& robot, int from_key, int to_key) const {
  constexpr int kBeyond = 15;  // pictures
  constexpr double kMetresPerRad = 0.5;
  const auto& keys = map_->path->taught.key_images;
  const int first = std::max(0, keys[at(from_key)].picture - kBeyond);
  const int last = std::min(static_cast<int>(map_->images.size()) - 1, keys[at(to_key)].picture + kBeyond);
  int nearest = keys[at(from_key)].picture;
  double least = 1e9;
  for (int picture = first; picture <= last; ++picture) {
    if (!shown_at(picture)) continue;
    const Pose2 there = inverse(robot) * *shown_at(picture);
    const double off = std::hypot(there.x_m, there.y_m, kMetresPerRad * there.theta_rad);
    if (off >= least) continue;
    least = off;
    nearest = picture;
  }
  return nearest;
}

/// Of the piece of the path that a key image is in.
int TaughtWay::last_picture_of_piece(int key) const {
  const map::TaughtPath& taught = map_->path->taught;
  int last = key;
  for (const map::PathArc& arc : taught.arcs) {
    if (arc.from == last) ++last;
  }
  return taught.key_images[at(last)].picture;
}

/// By the numbers of pictures alone.
WayAhead TaughtWay::without_metres(const repeat::Repeated& said, bool leads_there) const {
  const auto& keys = map_->path->taught.key_images;
  const double from = keys[at(said.from_key)].picture;
  const double here = from + said.progress * (keys[at(said.to_key)].picture - from);
  WayAhead ahead;
  ahead.ends = leads_there && here >= end_;
  const bool is_behind = at(said.from_key) > 0 && keys[at(said.from_key) - 1].picture > end_;
  ahead.leads_elsewhere = !leads_there || is_behind;
  return ahead;
}

WayAhead TaughtWay::ahead(const repeat::Repeater& repeater, const repeat::Repeated& said) const {
  constexpr double kBehind_m = 0.5;  // so far back it is driven backwards
  const int last_of_piece = last_picture_of_piece(said.from_key);
  const auto robot = robot_on_tour(repeater, said);
  if (!robot) return without_metres(said, end_ <= last_of_piece);
  const int nearest = nearest_picture(*robot, said.from_key, said.to_key);
  const Pose2 robot_from_tour = inverse(*robot);
  WayAhead ahead;
  const auto& shown = shown_at(nearest);
  if (shown) ahead.beside_m = inverse(robot_from_tour * *shown).y_m;
  const auto& end = shown_at(end_);
  const bool is_behind =
      end_ < nearest && !(end && position_m(robot_from_tour * *end).norm() <= kBehind_m && nearest - end_ < 30);
  ahead.leads_elsewhere = end_ > last_of_piece || is_behind;
  if (ahead.leads_elsewhere) return ahead;
  double length_m = 0.0;
  for (int picture = std::min(nearest, end_); picture <= end_ && length_m <= kAhead_m; ++picture) {
    if (!shown_at(picture)) continue;
    const Pose2 there = robot_from_tour * *shown_at(picture);
    if (!ahead.way.empty()) length_m += (position_m(there) - position_m(ahead.way.back())).norm();
    ahead.way.push_back(there);
    ahead.ends = picture == end_;
  }
  return ahead;
}

}  // namespace homeward::pipeline
