// SPDX-License-Identifier: Apache-2.0
#include "sim/tour_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "sim/floor.hpp"
#include "sim/way_beside.hpp"

namespace homeward::sim {
namespace {

constexpr double kTurnStep_rad = 0.7;  // at most so far between two pictures on the spot

/// Takes the corners of grid steps out; every point stays on the floor.
std::vector<Eigen::Vector2d> smoothed(const FloorGrid& drivable, const std::vector<Eigen::Vector2d>& way_m) {
  std::vector<Eigen::Vector2d> result = way_m;
  constexpr int kRounds = 25;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 1; i + 1 < result.size(); ++i) {
      const Eigen::Vector2d moved = 0.5 * result[i] + 0.25 * (result[i - 1] + result[i + 1]);
      if (is_set(drivable, moved)) result[i] = moved;
    }
  }
  return result;
}

double heading_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

using Way = std::vector<Eigen::Vector2d>;

/// Smooth ways from each room's point to the next one's.
Result<std::vector<Way>> legs_of(const World& world, const std::vector<std::string>& rooms) {
  std::vector<Way> legs;
  for (std::size_t i = 0; i + 1 < rooms.size(); ++i) {
    const auto from = room_point(world, rooms[i]);
    if (!from) return pass_on(from);
    const auto to = room_point(world, rooms[i + 1]);
    if (!to) return pass_on(to);
    const auto way_m = shortest_way(world.drivable, *from, *to);
    if (way_m.size() < 2) {
      return fail(ErrorCode::kNoRoute,
                  "No way that is wide enough leads from " + rooms[i] + " to " + rooms[i + 1] + ".", world.name);
    }
    legs.push_back(smoothed(world.drivable, way_m));
  }
  return legs;
}

/// Puts the stops of a tour together.
class TourBuilder {
 public:
  explicit TourBuilder(const World& world) : world_(world) {}

  /// Goes through these points, looking where it goes. `goes_on`: the first of them is where it is already.
  void drive(const Way& points_m, bool goes_on = false) {
    for (std::size_t k = goes_on ? 1 : 0; k < points_m.size(); ++k) {
      const Eigen::Vector2d& ahead = points_m[std::min(k + 1, points_m.size() - 1)];
      const Eigen::Vector2d& behind = points_m[k == 0 ? 0 : k - 1];
      add(points_m[k], heading_rad(behind, ahead));
    }
  }
  void mark_first(const std::string& room) { mark(stops_.front(), room); }
  void mark_last(const std::string& room) { mark(stops_.back(), room); }
  /// Marks where it is nearest to each of these rooms' points.
  void mark_nearest(const std::vector<std::string>& rooms) {
    for (const std::string& room : rooms) {
      const auto point_m = room_point(world_, room);
      if (!point_m || stops_.empty()) continue;
      mark(*std::ranges::min_element(
               stops_, {},
               [&](const TourStop& stop) { return (Eigen::Vector2d(stop.pose.x_m, stop.pose.y_m) - *point_m).norm(); }),
           room);
    }
  }
  std::vector<TourStop> take() && { return std::move(stops_); }

 private:
  void mark(TourStop& stop, const std::string& room) {
    if (std::ranges::find(visited_, room) != visited_.end()) return;
    stop.arrived = room;
    visited_.push_back(room);
  }

  void add(const Eigen::Vector2d& at, double theta_rad) {
    // A turn on the spot is shown in between.
    if (!stops_.empty()) {
      const double turn_rad = wrap_angle(theta_rad - stops_.back().pose.theta_rad);
      const int extra = static_cast<int>(std::abs(turn_rad) / kTurnStep_rad);
      const Pose2 before = stops_.back().pose;
      for (int i = 1; i <= extra; ++i) {
        const Pose2 turned{before.x_m, before.y_m, wrap_angle(before.theta_rad + turn_rad * i / (extra + 1))};
        stops_.push_back({turned, room_at(world_, {turned.x_m, turned.y_m}), std::nullopt});
      }
    }
    stops_.push_back({{at.x(), at.y(), theta_rad}, room_at(world_, at), std::nullopt});
  }

  const World& world_;
  std::vector<TourStop> stops_;
  std::vector<std::string> visited_;
};

}  // namespace

Result<Eigen::Vector2d> room_point(const World& world, const std::string& room) {
  std::string known;
  for (const Room& candidate : world.rooms) {
    if (candidate.name == room) return Eigen::Vector2d(candidate.x_m, candidate.y_m);
    known += (known.empty() ? "" : ", ") + candidate.name;
  }
  return fail(ErrorCode::kNotFound, "There is no room '" + room + "' in this world; its rooms are " + known + ".",
              world.name);
}

std::vector<std::string> all_rooms(const World& world) {
  std::vector<const Room*> left;
  for (const Room& room : world.rooms) left.push_back(&room);
  std::vector<std::string> tour;
  for (std::size_t next = 0; !left.empty();) {
    const Room& here = *left[next];
    tour.push_back(here.name);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
    if (world.round) {
      next = 0;
      continue;
    }
    const auto nearest = std::ranges::min_element(
        left, {}, [&](const Room* room) { return std::hypot(room->x_m - here.x_m, room->y_m - here.y_m); });
    next = static_cast<std::size_t>(nearest - left.begin());
  }
  if (tour.size() > 1) tour.push_back(tour.front());
  return tour;
}

Result<std::vector<TourStop>> plan_tour(const World& world, const std::vector<std::string>& rooms, double step_m,
                                        double beside_m) {
  if (rooms.size() < 2) return fail(ErrorCode::kTooFewImages, "A tour goes through at least two rooms.", world.name);
  if (!(step_m >= 0.05 && step_m <= 5.0)) {
    return fail(ErrorCode::kInvalidInput, "The step of a tour must lie between 0.05 m and 5 m.", world.name);
  }
  if (!(std::abs(beside_m) <= 5.0)) {
    return fail(ErrorCode::kInvalidInput, "A tour goes at most 5 m beside the usual way.", world.name);
  }
  const auto legs = legs_of(world, rooms);
  if (!legs) return pass_on(legs);
  TourBuilder tour(world);
  if (beside_m != 0.0) {
    Way whole_m;
    for (const Way& leg_m : *legs) whole_m.insert(whole_m.end(), leg_m.begin(), leg_m.end());
    tour.drive(resampled(way_beside(world.drivable, whole_m, beside_m), step_m));
    tour.mark_nearest(rooms);
    return std::move(tour).take();
  }
  for (std::size_t i = 0; i < legs->size(); ++i) {
    const Way points_m = resampled((*legs)[i], step_m);
    tour.drive(points_m, i > 0);
    if (i == 0) tour.mark_first(rooms.front());
    tour.mark_last(rooms[i + 1]);
  }
  return std::move(tour).take();
}

}  // namespace homeward::sim
