// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include "imageio/decode.hpp"
#include "planning/detour.hpp"
#include "server/driving/driving.hpp"
#include "server/services/belief_view.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::server {
namespace {

// An edit of names or blocked ways leaves the places as they are; the belief then goes on.
bool same_places(const map::TopologicalMap& a, const map::TopologicalMap& b) {
  if (a.places.size() != b.places.size() || a.edges.size() != b.edges.size()) return false;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    if (a.places[i].id != b.places[i].id || a.places[i].prototype != b.places[i].prototype ||
        a.places[i].members.size() != b.places[i].members.size()) {
      return false;
    }
  }
  return true;
}

}  // namespace

void Driving::begin_looking(const Unit& unit) {
  if (unit->looking || !unit->waiting_frame) return;
  if (!unit->map) {
    unit->waiting_frame.reset();
    return;
  }
  // When the pool is full this picture is left out; the next one comes soon.
  unit->looking = heavy_.try_run([this, unit] { look(unit); });
}

Result<std::shared_ptr<Tracking>> Driving::tracking_for(std::shared_ptr<Tracking> present, const MapId& map,
                                                        const camera::CameraConfig& camera) {
  const auto loaded = maps_.load(map);
  if (!loaded) return pass_on(loaded);
  if (present && present->map_id == map && same_places(present->tracker.map(), (*loaded)->map)) return present;
  auto tracker = pipeline::BeliefTracker::create(contents_of(*loaded), camera);
  if (!tracker) return pass_on(tracker);
  return std::make_shared<Tracking>(Tracking{map, std::move(*tracker)});
}

void Driving::go_on_after_looking(const Unit& found) {
  constexpr int kLooks = 4;
  RobotUnit& unit = *found;
  if (!unit.under_way || !unit.looks_since) return;
  const auto now = clock_.steady();
  const std::chrono::duration<double> stands_for = now - *unit.looks_since;
  if (unit.lifted && stands_for.count() < planning::kStandsAfterLift_s) {
    unit.restart_tracking = true;  // what is seen in somebody's hands counts nothing
    return;
  }
  if (++unit.looks < kLooks || (!unit.lifted && !unit.known_start(now))) return;
  unit.looks_since.reset();
  const wire::Reason reason = unit.failed_because;
  if (!begin_detour(found, reason)) end_mission(unit, wire::MissionState::kFailed, reason);
}

void Driving::hand_over_sights(RobotUnit& unit) {
  auto sights = std::make_shared<const std::vector<pipeline::DriveSight>>(unit.sights.take());
  spdlog::debug("robot {} hands over {} sights", unit.id.str(), sights->size());
  if (sights->empty() || !keep_drive_ || !unit.tracking || unit.tracking->map_id != unit.mission->map) return;
  db::Drive drive{
      unit.mission->id, unit.mission->map, unit.tracking->tracker.map().feature_config_id, clock_.wall_us(), {}};
  // Left out when the journal is full: another drive will come.
  static_cast<void>(journal_.try_run([this, drive = std::move(drive), sights]() mutable {
    for (const pipeline::DriveSight& sight : *sights) {
      drive.sights.push_back(
          {sight.place, sight.place.empty() ? std::vector<std::uint8_t>() : wire::encode_appearance(sight.seen)});
    }
    keep_drive_(drive);
  }));
}

void Driving::look(const Unit& unit) {
  const auto began = clock_.steady();
  std::shared_ptr<const wire::Frame> frame;
  std::shared_ptr<Tracking> tracking;
  std::optional<MapId> map;
  camera::CameraConfig camera;
  std::shared_ptr<AgentLink> link;
  bool new_odometry = false;
  std::optional<wire::EstimateReport> estimate;
  {
    const std::scoped_lock lock(unit->mutex);
    frame = std::move(unit->waiting_frame);
    unit->waiting_frame.reset();
    if (unit->restart_tracking) unit->tracking.reset();
    unit->restart_tracking = false;
    tracking = unit->tracking;
    new_odometry = std::exchange(unit->restart_odometry, false);
    map = unit->map;
    camera = unit->hello.camera;
    link = unit->link;
    estimate = unit->driving_estimate(began);
  }
  PlaceId sure;
  double near_share = 0.0;
  Result<wire::BeliefView> seen = fail(ErrorCode::kConflict, "The robot has no map.", "robots/" + unit->id.str());
  if (frame && map && link) {
    const auto look_once = [&]() -> Result<wire::BeliefView> {
      auto fitting = tracking_for(tracking, *map, camera);
      if (!fitting) return pass_on(fitting);
      tracking = *fitting;
      if (new_odometry) tracking->tracker.restart_odometry();
      const auto picture = imageio::decode(frame->jpeg, "frame " + std::to_string(frame->seq));
      if (!picture) return pass_on(picture);
      auto belief = tracking->tracker.update(*picture, frame->odometry);
      if (!belief) return pass_on(belief);
      if (estimate) belief = tracking->tracker.hear(estimate->place, estimate->probability);
      sure = pipeline::sure_place(*belief, {});
      near_share = belief->near_share;
      wire::BeliefView view = view_of(*belief);
      view.ms = std::chrono::duration<double, std::milli>(clock_.steady() - began).count();
      view.t_us = frame->t_us;
      return view;
    };
    try {
      seen = look_once();
    } catch (const std::exception& exception) {
      seen = fail(ErrorCode::kInternal, exception.what(), "robots/" + unit->id.str());
    }
    if (!seen) spdlog::warn("robot {} cannot be localised: {}", unit->id.str(), seen.error().message);
  }
  const std::scoped_lock lock(unit->mutex);
  unit->looking = false;
  unit->tracking = tracking;
  // What was seen through a connection or in a map that is gone says nothing about now.
  if (frame && unit->link == link && link && unit->map == map && !unit->restart_tracking) {
    if (seen) {
      unit->belief = *seen;
      unit->near_share = near_share;
      unit->belief_at = clock_.steady();
      if (unit->under_way && unit->sights.due(frame->t_us))
        unit->sights.add(frame->t_us, sure, tracking->tracker.seen());
      link->send(wire::BeliefReport{frame->seq, seen->place, seen->probability.value_or(0.0), seen->lost});
      go_on_after_looking(unit);
    } else {
      unit->belief.reset();
    }
    tell(*unit);
  }
  begin_looking(unit);
}

}  // namespace homeward::server
