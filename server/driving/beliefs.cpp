// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include "imageio/decode.hpp"
#include "map/lookup.hpp"
#include "planning/retry_policy.hpp"
#include "server/driving/driving.hpp"
#include "server/services/belief_view.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::server {
namespace {

// What is said of where a robot is lets none drive before it has found out by itself: no more than an even chance.
constexpr double kWordAlone = 0.5;

// What forbids saying where it is, with the unit locked.
Status may_be_placed(const RobotUnit& unit) {
  const std::string where = "robots/" + unit.id.str();
  if (!unit.map) return fail(ErrorCode::kConflict, "The robot has no map to be on.", where);
  if (unit.under_way) return fail(ErrorCode::kConflict, "The robot is on its way; stop it first.", where);
  // Until it connects it may be taken anywhere.
  if (!unit.online()) return fail(ErrorCode::kRobotOffline, "The robot is not connected.", where);
  return {};
}

// All places of the label, or the one of that id where there is no label. Errors: kUnknownPlace.
Result<std::vector<PlaceId>> places_said(const map::TopologicalMap& map, const std::string& label, const PlaceId& place,
                                         const MapId& map_id) {
  std::vector<PlaceId> places = map::places_labelled(map, label);
  if (label.empty() && map::find_place(map, place) != nullptr) places.push_back(place);
  if (!places.empty()) return places;
  return fail(
      ErrorCode::kUnknownPlace,
      label.empty() ? "The map has no place " + place.str() + "." : "The map has no place called '" + label + "'.",
      "maps/" + map_id.str());
}

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
  // One that explores drives by what it sees itself; where it is on its map is looked for when it is done.
  if (!unit->map || unit->explores()) {
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
    unit.forget_where();  // what is seen in somebody's hands counts nothing
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

struct Driving::Look {
  SteadyTime began;
  std::shared_ptr<const wire::Frame> frame;
  std::shared_ptr<Tracking> tracking;
  std::optional<MapId> map;
  camera::CameraConfig camera;
  std::shared_ptr<AgentLink> link;
  bool anew = false;  // what was seen before says nothing of where it is
  bool new_odometry = false;
  std::optional<wire::EstimateReport> estimate;
  std::vector<PlaceId> said_places;
  // What comes of it:
  SeenPicture on_plan;
  PlaceId sure;
  double near_share = 0.0;

  [[nodiscard]] bool complete() const { return frame && map && link; }
};

Driving::Look Driving::take_up(RobotUnit& unit) {
  const auto now = clock_.steady();
  Look look;
  look.began = now;
  look.frame = std::move(unit.waiting_frame);
  unit.waiting_frame.reset();
  look.anew = std::exchange(unit.restart_tracking, false);
  if (look.anew) unit.tracking.reset();
  look.tracking = unit.tracking;
  if (unit.under_way) look.on_plan.mission = unit.mission->id;
  look.new_odometry = std::exchange(unit.restart_odometry, false);
  look.map = unit.map;
  look.camera = unit.hello.camera;
  look.link = unit.link;
  look.estimate = unit.driving_estimate(now);
  if (look.complete()) look.said_places = std::exchange(unit.said_places, {});
  return look;
}

Result<wire::BeliefView> Driving::see(Look& look) {
  auto fitting = tracking_for(look.tracking, *look.map, look.camera);
  if (!fitting) return pass_on(fitting);
  look.tracking = *fitting;
  Tracking& tracking = *look.tracking;
  if (look.new_odometry) tracking.tracker.restart_odometry();
  if (!look.said_places.empty()) {
    tracking.tracker.start_at(look.said_places);
    look.on_plan.said = std::exchange(look.said_places, {});
    tracking.by_word_alone = true;
  }
  auto decoded = imageio::decode(look.frame->jpeg, "frame " + std::to_string(look.frame->seq));
  if (!decoded) return pass_on(decoded);
  look.on_plan.picture = std::make_shared<const Image>(std::move(*decoded));
  auto belief = tracking.tracker.update(*look.on_plan.picture, look.frame->odometry);
  if (!belief) return pass_on(belief);
  if (look.estimate) belief = tracking.tracker.apply_estimate(look.estimate->place, look.estimate->probability);
  look.sure = pipeline::sure_place(*belief, {});
  if (!belief->lost) tracking.by_word_alone = false;
  look.near_share = tracking.by_word_alone ? std::min(kWordAlone, belief->near_share) : belief->near_share;
  look.on_plan.belief = *belief;
  wire::BeliefView view = view_of(*belief);
  view.ms = std::chrono::duration<double, std::milli>(clock_.steady() - look.began).count();
  view.t_us = look.frame->t_us;
  return view;
}

void Driving::keep_seen(const Unit& unit, const Look& look, const Result<wire::BeliefView>& seen) {
  if (!seen) {
    unit->belief.reset();
    // What somebody said waits for a look that comes to it.
    if (unit->said_places.empty() && !unit->restart_tracking) unit->said_places = look.said_places;
    return;
  }
  unit->belief = *seen;
  unit->near_share = look.near_share;
  unit->belief_at = clock_.steady();
  if (unit->under_way && unit->sights.due(look.frame->t_us))
    unit->sights.add(look.frame->t_us, look.sure, look.tracking->tracker.seen());
  look.link->send(wire::BeliefReport{look.frame->seq, seen->place, seen->probability.value_or(0.0), seen->lost});
  go_on_after_looking(unit);
}

void Driving::follow_on_plan(const RobotId& robot, Look& look, bool seen) {
  if (!seen) {
    // It would miss that nothing of before counts.
    if (look.anew || look.new_odometry) plans_.forget(robot);
    return;
  }
  SeenPicture& picture = look.on_plan;
  picture.robot = robot;
  picture.map = *look.map;
  picture.camera = look.camera;
  picture.odometry = look.frame->odometry;
  picture.t_us = look.frame->t_us;
  picture.anew = look.anew;
  picture.odometry_anew = look.new_odometry;
  plans_.look(std::move(picture));
}

void Driving::look(const Unit& unit) {
  Look look = [&] {
    const std::scoped_lock lock(unit->mutex);
    return take_up(*unit);
  }();
  const std::string where = "robots/" + unit->id.str();
  Result<wire::BeliefView> seen = fail(ErrorCode::kConflict, "The robot has no map.", where);
  if (look.complete()) {
    try {
      seen = see(look);
    } catch (const std::exception& exception) {
      seen = fail(ErrorCode::kInternal, exception.what(), where);
    }
    if (!seen) spdlog::warn("robot {} cannot be localised: {}", unit->id.str(), seen.error().message);
  }
  follow_on_plan(unit->id, look, seen.has_value());
  const std::scoped_lock lock(unit->mutex);
  unit->looking = false;
  unit->tracking = look.tracking;
  // What was seen through a connection or in a map that is gone, or before somebody said where the robot is, says
  // nothing about now.
  const bool of_now = unit->link == look.link && unit->map == look.map && !unit->restart_tracking;
  if (look.frame && look.link && of_now && unit->said_places.empty()) {
    keep_seen(unit, look, seen);
    tell(*unit);
  }
  begin_looking(unit);
}

Result<wire::RobotView> Driving::set_place(const RobotId& id, const SaidPlace& said) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  std::optional<MapId> map;
  {
    const std::scoped_lock lock(unit.mutex);
    if (const Status status = may_be_placed(unit); !status) return pass_on(status);
    map = unit.map;
  }
  const auto loaded = maps_.load(*map);
  if (!loaded) return pass_on(loaded);
  const auto places = places_said((*loaded)->map, said.label, said.place, *map);
  if (!places) return pass_on(places);
  const std::scoped_lock lock(unit.mutex);
  if (const Status status = may_be_placed(unit); !status) return pass_on(status);
  if (unit.map != map) {
    return fail(ErrorCode::kConflict, "The robot was given another map just now.", "robots/" + id.str());
  }
  unit.said_places = *places;
  unit.belief.reset();  // no mission begins from what was believed before
  spdlog::info("robot {} is at {}, says {}", id.str(), said.label.empty() ? said.place.str() : said.label, said.by);
  tell(unit);
  return view(unit, clock_.steady());
}

}  // namespace homeward::server
