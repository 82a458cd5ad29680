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
constexpr int kJustBehind = 30;  // pictures

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
  const auto& keys = taught().key_images;
  double metres = 0.0;
  double units = 0.0;
  for (std::size_t i = 0; i < around.units.size(); ++i) {
    // Where the path is closed, odometry has drifted all round it.
    if (!around.units[i] || taught().is_closing(taught().arcs[at(around.arcs[i])])) continue;
    const auto& from = shown_at(keys[at(around.keys[i].key)].picture);
    const auto& to = shown_at(keys[at(around.keys[i + 1].key)].picture);
    if (!from || !to) continue;
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
  if (taught().is_closing(taught().arcs[at(said.arc)])) return from;
  const auto to = robot_by_key(repeater, said.to_key, *metres);
  if (!from || !to) return from ? from : to;
  return between(*from, *to, std::clamp(said.progress, 0.0, 1.0));
}

int TaughtWay::nearest_picture(const Pose2& robot, int from_key, int to_key) const {
  constexpr int kBeyond = 15;  // pictures
  constexpr double kMetresPerRad = 0.5;
  const auto& keys = map_->path->taught.key_images;
  const int first = std::max(0, keys[at(from_key)].picture - kBeyond);
  const int pictures = static_cast<int>(map_->images.size());
  const bool closes = to_key <= from_key;
  const int last = closes ? keys[at(from_key)].picture : std::min(pictures - 1, keys[at(to_key)].picture + kBeyond);
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
  int last = key;
  for (const map::PathArc& arc : taught().arcs) {
    if (arc.from == last && !taught().is_closing(arc)) ++last;
  }
  return taught().key_images[at(last)].picture;
}

/// The picture of the key image that a closed path goes on from.
std::optional<int> TaughtWay::closes_at() const {
  if (!taught().closing) return std::nullopt;
  return taught().key_images[at(taught().closing->key_image)].picture;
}

bool TaughtWay::leads_there(int here, int last_of_piece) const {
  if (end_ >= here && end_ <= last_of_piece) return true;
  const bool goes_round = closes_at() && last_of_piece == taught().key_images.back().picture;
  return goes_round && end_ >= *closes_at() && end_ <= last_of_piece;
}

bool TaughtWay::has_come_by(int before, int now) const {
  constexpr int kFar = 60;  // pictures: farther on is no way that was driven between two of the robot's
  if (now >= before) return before < end_ && end_ <= now && now - before < kFar;
  if (!closes_at() || before - now < kFar) return false;
  return end_ > before || end_ <= now;
}

bool TaughtWay::is_far_from_end(int picture) const { return std::abs(picture - end_) > kJustBehind; }

/// By the numbers of pictures alone.
WayAhead TaughtWay::without_metres(const repeat::Repeated& said, bool leads_there, bool stops) const {
  const auto& keys = taught().key_images;
  const double from = keys[at(said.from_key)].picture;
  const double to = said.to_key > said.from_key ? keys[at(said.to_key)].picture : from;
  WayAhead ahead;
  ahead.picture = static_cast<int>(from + said.progress * (to - from));
  // A key image may be passed before a picture shows that the one before it was.
  const bool just_behind = end_ <= ahead.picture && ahead.picture - end_ < kJustBehind;
  ahead.ends = stops && just_behind;
  ahead.leads_elsewhere = !leads_there && !just_behind;
  return ahead;
}

/// Up to the last picture, as far as odometry tells of all of them. Whether it does.
bool TaughtWay::add_way(const Pose2& robot_from_tour, int first, int last, WayAhead& ahead, double& length_m) const {
  constexpr double kMostStep_m = 1.0;  // farther apart odometry has begun anew between two pictures
  constexpr double kStep_m = 0.1;
  constexpr double kStood_m = 0.01;
  constexpr double kStood_rad = 0.02;
  for (int picture = first; picture <= last && length_m <= kAhead_m; ++picture) {
    if (!shown_at(picture)) return false;
    const Pose2 there = robot_from_tour * *shown_at(picture);
    if (!ahead.way.empty()) {
      const Pose2 before = ahead.way.back();
      const double step_m = (position_m(there) - position_m(before)).norm();
      if (step_m > kMostStep_m) return false;
      const bool stood = step_m < kStood_m && std::abs(wrap_angle(there.theta_rad - before.theta_rad)) < kStood_rad;
      if (stood && picture != last) continue;
      const int parts = std::max(1, static_cast<int>(std::ceil(step_m / kStep_m)));
      for (int part = 1; part < parts; ++part)
        ahead.way.push_back(between(before, there, static_cast<double>(part) / parts));
      length_m += step_m;
    }
    ahead.way.push_back(there);
  }
  return length_m <= kAhead_m;
}

WayAhead TaughtWay::ahead(const repeat::Repeater& repeater, const repeat::Repeated& said, bool stops) const {
  constexpr double kBehind_m = 0.5;  // so far back it is driven backwards
  const int last_of_piece = last_picture_of_piece(said.from_key);
  const auto robot = robot_on_tour(repeater, said);
  if (!robot)
    return without_metres(said, leads_there(taught().key_images[at(said.from_key)].picture, last_of_piece), stops);
  WayAhead ahead;
  ahead.picture = nearest_picture(*robot, said.from_key, said.to_key);
  const Pose2 robot_from_tour = inverse(*robot);
  const auto& shown = shown_at(ahead.picture);
  if (shown) ahead.beside_m = inverse(robot_from_tour * *shown).y_m;
  const auto& end = shown_at(end_);
  const bool just_behind = end_ < ahead.picture && ahead.picture - end_ < kJustBehind && end &&
                           position_m(robot_from_tour * *end).norm() <= kBehind_m;
  ahead.leads_elsewhere = !just_behind && !leads_there(ahead.picture, last_of_piece);
  if (ahead.leads_elsewhere) return ahead;
  double length_m = 0.0;
  const bool ends_here = stops && (just_behind || (end_ >= ahead.picture && end_ <= last_of_piece));
  const int last = ends_here ? end_ : last_of_piece;
  const bool whole = add_way(robot_from_tour, std::min(ahead.picture, last), last, ahead, length_m);
  ahead.ends = ends_here && whole;
  if (ends_here || !whole || !closes_at()) return ahead;
  // Round the path, as the key image tells that it goes on from.
  const auto metres = metres_per_unit(*repeater.surroundings());
  const auto again = metres ? robot_by_key(repeater, taught().closing->key_image, *metres) : std::nullopt;
  if (!again) return ahead;
  const bool ends_then = stops && end_ >= *closes_at();
  const bool whole_round = add_way(inverse(*again), *closes_at(), ends_then ? end_ : last_of_piece, ahead, length_m);
  ahead.ends = ends_then && whole_round;
  return ahead;
}

}  // namespace homeward::pipeline
