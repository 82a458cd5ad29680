// SPDX-License-Identifier: Apache-2.0
#include "agent/scenario/house.hpp"

#include "planning/detour.hpp"

namespace homeward::agent {
namespace {

constexpr double kSpeedLimit_mps = 0.45;
constexpr Milliseconds kPermit_ms = 1500;
constexpr std::int64_t kOrderStep = 1'000'000;  // permits count on from their order

std::optional<PlaceId> place_of(const localisation::Belief& belief) {
  return belief.lost || belief.top.empty() ? std::nullopt : std::optional(belief.top.front().place);
}

}  // namespace

Result<House> House::create(const TaughtWorld& taught, const map::Destination& destination) {
  auto tracker = pipeline::BeliefTracker::create(taught.map, taught.camera);
  if (!tracker) return pass_on(tracker);
  return House(taught, destination, std::move(*tracker));
}

Result<std::optional<PlaceId>> House::find_place(SimulatedRobot& robot) {
  constexpr int kLooks = 3;
  tracker_.restart();
  std::optional<PlaceId> place;
  for (int look = 0; look < kLooks; ++look) {
    const auto belief = tracker_.update(robot.picture());
    if (!belief) return pass_on(belief);
    place = place_of(*belief);
  }
  return place;
}

Result<wire::MissionOrder> House::order_from(const PlaceId& place) {
  planning::RouteRequest request;
  request.from = place;
  request.to = destination_->place;
  request.closed = closed_;
  const auto route = planning::plan_route(*taught_->map, request);
  if (!route) return pass_on(route);
  path_ = route->places;
  wire::MissionOrder order = wire::order_for_route(*taught_->map, route->places, *destination_);
  order.mission = MissionId("simulated");
  order.order = {1, ++orders_ * kOrderStep};
  order.map = MapId("taught");
  order.valid_for_ms = kPermit_ms;
  order.speed_limit_mps = kSpeedLimit_mps;
  return order;
}

Result<std::optional<wire::MissionOrder>> House::order_after(SimulatedRobot& robot, const DriveLoop& drive,
                                                             std::string& why) {
  // The last seconds' pictures say more than the last place alone; where they do not, as at the beginning.
  tracker_.restart();
  std::optional<PlaceId> here;
  for (const DrivenPicture& driven : drive.pictures()) {
    const auto belief = tracker_.update(driven.picture, driven.odometry);
    if (!belief) return pass_on(belief);
    here = place_of(*belief);
  }
  if (!here) {
    const auto found = find_place(robot);
    if (!found) return pass_on(found);
    here = *found;
  }
  if (!here) {
    why = "I do not know where I am.";
    return std::nullopt;
  }
  const auto ways = planning::detour_after({path_, drive.state().follow.index, *here, destination_->place, detours_});
  if (!ways) return std::nullopt;
  closed_.insert(closed_.end(), ways->begin(), ways->end());
  auto order = order_from(*here);
  if (!order) {
    why = order.error().message;
    return std::nullopt;
  }
  ++detours_;
  return std::optional(std::move(*order));
}

std::vector<Eigen::Vector2d> House::way_of(const wire::MissionOrder& order) const {
  std::vector<Eigen::Vector2d> way_m;
  const auto add = [&](const ImageId& image) {
    const auto pose = taught_->picture_poses.find(image);
    if (pose != taught_->picture_poses.end()) way_m.emplace_back(pose->second.x_m, pose->second.y_m);
  };
  for (const wire::PathPlace& place : order.path) {
    if (place.image != order.final_image) add(place.image);
  }
  add(order.final_image);
  return way_m;
}

}  // namespace homeward::agent
