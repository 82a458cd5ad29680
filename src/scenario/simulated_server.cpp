// SPDX-License-Identifier: Apache-2.0
#include "scenario/simulated_server.hpp"

#include <algorithm>

#include "driving/estimated_position.hpp"
#include "planning/no_route.hpp"
#include "planning/retry_policy.hpp"
#include "planning/second_look.hpp"
#include "planning/surroundings.hpp"
#include "wire/lease_durations.hpp"
#include "wire/map_reasons.hpp"

namespace homeward::scenario {
namespace {

constexpr std::int64_t kOrderStep = 1'000'000;  // permits count on from their order

std::optional<PlaceId> place_of(const localisation::Belief& belief) {
  return belief.lost || belief.top.empty() ? std::nullopt : std::optional(belief.top.front().place);
}

}  // namespace

Result<SimulatedServer> SimulatedServer::create(const TaughtWorld& taught, const map::Destination& destination,
                                                double speed_limit_mps) {
  auto tracker = pipeline::BeliefTracker::create(taught.map, taught.camera);
  if (!tracker) return pass_on(tracker);
  return SimulatedServer(taught, destination, speed_limit_mps, std::move(*tracker));
}

Result<std::optional<PlaceId>> SimulatedServer::find_place(SimulatedRobot& robot) {
  constexpr int kLooks = 3;
  tracker_.restart();
  for (int look = 0; look < kLooks; ++look) {
    const auto belief = tracker_.update(robot.picture(), robot.odometry());
    if (!belief) return pass_on(belief);
    belief_ = *belief;
  }
  if (belief_.top.empty()) return std::nullopt;
  // Where it is not sure, the robot begins at the likeliest place, finds out for itself, and is sent anew from there.
  begin_by_belief();
  return belief_.top.front().place;
}

void SimulatedServer::begin_by_belief() {
  likely_.clear();
  for (const auto& [place, probability] : belief_.top) likely_.push_back(place);
  start_probability_ = belief_.lost ? belief_.near_share : belief_.near_probability;
}

Result<wire::MissionOrder> SimulatedServer::order_from(const PlaceId& place, bool second_look) {
  planning::RouteRequest request;
  request.from = place;
  request.to = destination_->place;
  request.closed = closed_;
  if (second_look) {
    auto route = planning::plan_second_look(*taught_->map, request, planning::second_look_m(unsure_restarts_));
    if (!route) return pass_on(route);
    path_ = std::move(route->places);
  } else {
    auto detour = planning::plan_detour(*taught_->map, request, !fails_again_);
    if (!detour) return pass_on(detour);
    path_ = std::move(detour->route.places);
  }
  wire::MissionOrder order = wire::order_for_route(*taught_->map, path_, *destination_);
  wire::add_surroundings(*taught_->map, taught_->layout,
                         planning::surroundings(*taught_->map, path_, likely_, taught_->layout), order);
  for (const planning::Way& way : closed_) wire::leave_out_way(way.from, way.to, order);
  if (order.surroundings) order.surroundings->start_probability = start_probability_;
  order.mission = MissionId("simulated");
  order.order = {1, ++orders_ * kOrderStep};
  order.map = MapId("taught");
  order.valid_for_ms = wire::kPermitValid_ms;
  order.speed_limit_mps = speed_limit_mps_;
  return order;
}

wire::Reason SimulatedServer::why_no_order(const PlaceId& place, const Error& error) const {
  planning::RouteRequest request;
  request.from = place;
  request.to = destination_->place;
  request.closed = closed_;
  // A second look needs more than a way.
  if (error.code != ErrorCode::kNoRoute || planning::plan_route(*taught_->map, request)) return wire::reason_of(error);
  return wire::reason_of(planning::explain_no_route(*taught_->map, request), *taught_->map);
}

/// Where the robot stands that was lifted: by what it sees now alone. Where that says little, the likeliest place.
Result<std::optional<PlaceId>> SimulatedServer::look_anew(DriveLoop& drive) {
  constexpr int kLooks = 4;
  const double lifted_s = drive.elapsed_s();
  while (drive.elapsed_s() - lifted_s < planning::kStandsAfterLift_s) {
    if (const auto seen = drive.look_again(); !seen) return pass_on(seen);
  }
  tracker_.restart();
  belief_ = {};
  for (int look = 0; look < kLooks; ++look) {
    const auto seen = drive.look_again();
    if (!seen) return pass_on(seen);
    if (!*seen) continue;
    const auto belief = tracker_.update((*seen)->picture, (*seen)->odometry);
    if (!belief) return pass_on(belief);
    belief_ = *belief;
  }
  if (belief_.top.empty()) return std::nullopt;
  begin_by_belief();
  return belief_.top.front().place;
}

/// Where the robot stands after a failed drive: by the last seconds' pictures and some more, which look first beside
/// the places that it has just passed; where that says nothing, anew among all places.
Result<std::optional<PlaceId>> SimulatedServer::find_again(DriveLoop& drive) {
  constexpr int kLeastLooks = 3;
  constexpr int kMostLooks = 16;
  constexpr int kAnewAfter = 8;
  tracker_.restart();
  for (const DrivenPicture& driven : drive.pictures()) {
    if (const auto belief = tracker_.update(driven.picture, driven.odometry); !belief) return pass_on(belief);
  }
  std::optional<PlaceId> here;
  belief_ = {};
  for (int look = 0; look < kMostLooks && !(here && look >= kLeastLooks); ++look) {
    const auto seen = drive.look_again();
    if (!seen) return pass_on(seen);
    if (look == kAnewAfter) tracker_.restart();
    if (!*seen) continue;
    const auto belief = tracker_.update((*seen)->picture, (*seen)->odometry);
    if (!belief) return pass_on(belief);
    belief_ = *belief;
    here = place_of(belief_);
  }
  begin_by_belief();
  if (here) start_probability_ = 1.0;
  return here;
}

/// Where the robot is to begin, and how probable that is; `unsure` where nobody is sure of it. The belief is of the
/// whole map and of all pictures of the drive; where it is lost, the robot's own estimate. Of a covered camera neither
/// says anything, nor of a robot that was lifted.
std::optional<PlaceId> SimulatedServer::believed_start(const driving::DrivingState& robot, bool sees, bool& unsure) {
  constexpr double kBothMayBeRight = 0.5;
  constexpr double kApart_m = 2.0;
  begin_by_belief();
  if (!sees) return std::nullopt;
  const auto believed = place_of(belief_);
  const auto estimated = driving::estimated_place(robot.follow, robot.mission->path, driving::FollowConfig{});
  const auto possible = driving::possible_places(robot.follow, robot.mission->path);
  for (const driving::PossiblePlace& one : possible) likely_.push_back(one.place);
  if (estimated && !robot.at_odds) {
    start_probability_ = driving::position_probability(robot.follow, robot.mission->path);
    return estimated;
  }
  if (!believed && !estimated && !possible.empty()) {
    start_probability_ = possible.front().probability;
    unsure = true;
    return possible.front().place;
  }
  const auto off_m = driving::off_belief_m(robot.follow, robot.mission->path, driving::FollowConfig{});
  if (!believed || (off_m && *off_m > kApart_m)) start_probability_ = std::min(start_probability_, kBothMayBeRight);
  return believed ? believed : estimated;
}

Result<std::optional<wire::MissionOrder>> SimulatedServer::order_after(DriveLoop& drive,
                                                                       std::optional<wire::Reason>& why) {
  const driving::DrivingState& robot = drive.state();
  // The destination's own view comes after that of its place.
  const std::int64_t index = std::min<std::int64_t>(robot.follow.index, static_cast<std::int64_t>(path_.size()) - 1);
  const bool displaced = robot.displaced > displaced_;
  displaced_ = robot.displaced;
  bool unsure = false;
  Result<std::optional<PlaceId>> here = believed_start(robot, robot.mission && !robot.covered && !displaced, unsure);
  if (displaced) {
    here = look_anew(drive);
    unsure = belief_.lost;
  } else if (!*here) {
    here = find_again(drive);
    // Where that says nothing either, it begins at the likeliest place, finds out for itself, and is sent anew.
    if (here && !*here && !robot.covered && !belief_.top.empty()) {
      here = belief_.top.front().place;
      unsure = true;
    }
  }
  if (!here) return pass_on(here);
  if (drive.stopped_by_hand()) return std::nullopt;
  if (!*here) {
    why = wire::Reason{wire::ReasonCode::kPlaceUnknown};
    return std::nullopt;
  }
  const bool homed_to_it = index + 1 == static_cast<std::int64_t>(path_.size());
  const bool second_look = robot.astray && !displaced && **here == destination_->place && homed_to_it;
  unsure = unsure || second_look;
  const auto ways = planning::detour_after(
      {path_, index, **here, destination_->place, detours_, restarts_, robot.astray, unsure, unsure_restarts_});
  if (!ways) return std::nullopt;
  fails_again_ = planning::fails_again(closed_, *ways);
  closed_.insert(closed_.end(), ways->begin(), ways->end());
  auto order = order_from(**here, second_look);
  if (!order) {
    why = why_no_order(**here, order.error());
    return std::nullopt;
  }
  ++(robot.astray || unsure ? restarts_ : detours_);
  if (unsure) ++unsure_restarts_;
  return std::optional(std::move(*order));
}

wire::BeliefReport SimulatedServer::believe(const features::Appearance& seen, const Pose2& odometry,
                                            const std::optional<wire::EstimateReport>& estimate) {
  belief_ = tracker_.update(seen, odometry);
  if (estimate) belief_ = tracker_.apply_estimate(estimate->place, estimate->probability);
  wire::BeliefReport report;
  report.lost = belief_.lost;
  report.place = place_of(belief_);
  report.probability = belief_.near_probability;
  return report;
}

std::vector<Pose2> SimulatedServer::way_of(const wire::MissionOrder& order) const {
  std::vector<Pose2> way;
  const auto add = [&](const ImageId& image) {
    const auto pose = taught_->picture_poses.find(image);
    if (pose != taught_->picture_poses.end()) way.push_back(pose->second);
  };
  for (const wire::PathPlace& place : order.path) {
    if (place.image != order.final_image) add(place.image);
  }
  add(order.final_image);
  return way;
}

}  // namespace homeward::scenario
