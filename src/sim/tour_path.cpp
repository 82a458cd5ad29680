// SPDX-License-Identifier: Apache-2.0
#include "sim/tour_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "sim/floor.hpp"

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

/// Points every `step_m` along the way, its two ends included.
std::vector<Eigen::Vector2d> resampled(const std::vector<Eigen::Vector2d>& way_m, double step_m) {
  const double total_m = length_m(way_m);
  const int count = std::max(1, static_cast<int>(std::lround(total_m / step_m)));
  std::vector<Eigen::Vector2d> points = {way_m.front()};
  double gone_m = 0.0;
  for (std::size_t i = 1; i < way_m.size(); ++i) {
    const double piece_m = (way_m[i] - way_m[i - 1]).norm();
    while (static_cast<int>(points.size()) < count) {
      const double wanted_m = total_m * static_cast<double>(points.size()) / count;
      if (wanted_m > gone_m + piece_m) break;
      points.emplace_back(way_m[i - 1] + (way_m[i] - way_m[i - 1]) * ((wanted_m - gone_m) / std::max(1e-12, piece_m)));
    }
    gone_m += piece_m;
  }
  points.push_back(way_m.back());
  return points;
}

double heading_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

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

Result<std::vector<TourStop>> plan_tour(const World& world, const std::vector<std::string>& rooms, double step_m) {
  if (rooms.size() < 2) return fail(ErrorCode::kTooFewImages, "A tour goes through at least two rooms.", world.name);
  if (!(step_m >= 0.05 && step_m <= 5.0)) {
    return fail(ErrorCode::kInvalidInput, "The step of a tour must lie between 0.05 m and 5 m.", world.name);
  }
  std::vector<TourStop> stops;
  std::vector<std::string> visited;
  const auto add = [&](const Eigen::Vector2d& at, double theta_rad) {
    // A turn on the spot is shown in between.
    if (!stops.empty()) {
      const double turn_rad = wrap_angle(theta_rad - stops.back().pose.theta_rad);
      const int extra = static_cast<int>(std::abs(turn_rad) / kTurnStep_rad);
      const Pose2 before = stops.back().pose;
      for (int i = 1; i <= extra; ++i) {
        const Pose2 turned{before.x_m, before.y_m, wrap_angle(before.theta_rad + turn_rad * i / (extra + 1))};
        stops.push_back({turned, room_at(world, {turned.x_m, turned.y_m}), std::nullopt});
      }
    }
    stops.push_back({{at.x(), at.y(), theta_rad}, room_at(world, at), std::nullopt});
  };
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
    const auto points_m = resampled(smoothed(world.drivable, way_m), step_m);
    for (std::size_t k = 0; k < points_m.size(); ++k) {
      if (k == 0 && i > 0) continue;  // the end of the way before
      const Eigen::Vector2d& ahead = points_m[std::min(k + 1, points_m.size() - 1)];
      const Eigen::Vector2d& behind = points_m[k == 0 ? 0 : k - 1];
      add(points_m[k], heading_rad(behind, ahead));
      const std::string& room = k == 0 ? rooms[i] : rooms[i + 1];
      const bool is_room_point = k + 1 == points_m.size() || (k == 0 && i == 0);
      if (is_room_point && std::find(visited.begin(), visited.end(), room) == visited.end()) {
        stops.back().arrived = room;
        visited.push_back(room);
      }
    }
  }
  return stops;
}

}  // namespace homeward::sim
