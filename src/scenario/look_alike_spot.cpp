// SPDX-License-Identifier: Apache-2.0
#include "scenario/look_alike_spot.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/angles.hpp"
#include "localisation/candidates.hpp"
#include "matching/verify.hpp"
#include "sim/floor.hpp"

namespace homeward::scenario {
namespace {

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

struct Spot {
  Pose2 pose;
  double share = 0.0;  // of the features that one motion explains; 0: none does
  bool other_room = false;

  [[nodiscard]] auto rank() const { return std::tuple(share > 0.0, other_room, share); }
};

/// What the robot's heading is to that of the tour where it passed nearest.
double heading_to_tour_rad(const TaughtWorld& taught, const Pose2& here) {
  const auto nearest = std::ranges::min_element(taught.picture_poses, {},
                                                [&](const auto& picture) { return apart_m(picture.second, here); });
  return nearest == taught.picture_poses.end() ? 0.0 : wrap_angle(here.theta_rad - nearest->second.theta_rad);
}

bool is_other_room(const sim::World& world, const Pose2& here, const Pose2& there) {
  const auto room = sim::room_at(world, {here.x_m, here.y_m});
  const auto other = sim::room_at(world, {there.x_m, there.y_m});
  return room && other && *room != *other;
}

}  // namespace

std::optional<Pose2> look_alike_spot(const TaughtWorld& taught, const Pose2& here, const features::Appearance& seen,
                                     const std::function<double(const Pose2&)>& clearance_m) {
  constexpr std::size_t kCompared = 24;  // feature by feature, of those that look most like it as a whole
  constexpr std::uint64_t kSeed = 1;
  std::vector<int> without;
  const std::vector<map::Place>& places = taught.map->places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto pose = taught.picture_poses.find(places[i].prototype);
    const bool is_near = pose == taught.picture_poses.end() || apart_m(pose->second, here) < kLeastLift_m;
    if (is_near || places[i].appearances.empty()) without.push_back(static_cast<int>(i));
  }
  std::optional<Spot> best;
  for (const int number : localisation::CandidateFinder(*taught.map).find(seen, kCompared, without)) {
    const map::Place& place = places[static_cast<std::size_t>(number)];
    const features::Appearance& shown = place.appearances.front();
    Spot spot;
    spot.pose = taught.picture_poses.at(place.prototype);
    spot.other_room = is_other_room(taught.world->world(), here, spot.pose);
    if (const auto verified = matching::verify(seen, shown, {}, kSeed)) {
      spot.share = static_cast<double>(verified->pose.inliers.size()) / std::min(seen.size(), shown.size());
      spot.pose.theta_rad = wrap_angle(spot.pose.theta_rad - verified->pose.motion.turn_rad);
    } else {
      spot.pose.theta_rad = wrap_angle(spot.pose.theta_rad + heading_to_tour_rad(taught, here));
    }
    if (best && best->rank() >= spot.rank()) continue;
    if (clearance_m(spot.pose) >= kLiftClearance_m) best = spot;
  }
  return best ? std::optional(best->pose) : std::nullopt;
}

Result<std::optional<Pose2>> look_alike_spot(const TaughtWorld& taught, SimulatedRobot& robot,
                                             const pipeline::Eye& eye) {
  const auto seen = eye.look(robot.picture());
  if (!seen) return pass_on(seen);
  return look_alike_spot(taught, robot.vehicle().pose(), *seen,
                         [&](const Pose2& pose) { return robot.clearance_m(pose); });
}

}  // namespace homeward::scenario
