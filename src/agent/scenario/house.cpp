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
  const auto detour = planning::plan_detour(*taught_->map, request, !fails_again_);
  if (!detour) return pass_on(detour);
  path_ = detour->route.places;
  wire::MissionOrder order = wire::order_for_route(*taught_->map, path_, *destination_);
  order.mission = MissionId("simulated");
  order.order = {1, ++orders_ * kOrderStep};
  order.map = MapId("taught");
  order.valid_for_ms = kPermit_ms;
  order.speed_limit_mps = kSpeedLimit_mps;
  return order;
}

/// Where the robot stands after a failed drive: by the last seconds' pictures and some more, which look first beside
/// the places that it has just passed; where that says nothing, anew among all places.
Result<std::optional<PlaceId>> House::find_again(DriveLoop& drive) {
  constexpr int kLeastLooks = 3;
  constexpr int kMostLooks = 16;
  constexpr int kAnewAfter = 8;
  tracker_.restart();
  for (const DrivenPicture& driven : drive.pictures()) {
    if (const auto belief = tracker_.update(driven.picture, driven.odometry); !belief) return pass_on(belief);
  }
  std::optional<PlaceId> here;
  for (int look = 0; look < kMostLooks && !(here && look >= kLeastLooks); ++look) {
    const auto seen = drive.look_again();
    if (!seen) return pass_on(seen);
    if (look == kAnewAfter) tracker_.restart();
    if (!*seen) continue;
    const auto belief = tracker_.update((*seen)->picture, (*seen)->odometry);
    if (!belief) return pass_on(belief);
    here = place_of(*belief);
  }
  return here;
}

Result<std::optional<wire::MissionOrder>> House::order_after(DriveLoop& drive, std::string& why) {
  const std::int64_t index = drive.state().follow.index;
  const auto here = find_again(drive);
  if (!here) return pass_on(here);
  if (drive.stopped_by_hand()) return std::nullopt;
  if (!*here) {
    why = "I do not know where I am.";
    return std::nullopt;
  }
  const auto ways = planning::detour_after({path_, index, **here, destination_->place, detours_});
  if (!ways) return std::nullopt;
  fails_again_ = planning::fails_again(closed_, *ways);
  closed_.insert(closed_.end(), ways->begin(), ways->end());
  auto order = order_from(**here);
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
