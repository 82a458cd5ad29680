// SPDX-License-Identifier: Apache-2.0
#include "server/driving/driving.hpp"

namespace homeward::server {
namespace {

std::int64_t milliseconds_between(SteadyTime from, SteadyTime to) {
  return std::max<std::int64_t>(0, std::chrono::duration_cast<std::chrono::milliseconds>(to - from).count());
}

}  // namespace

Status Driving::load() {
  const auto robots = store_.robots();
  if (!robots) return pass_on(robots);
  for (const db::RobotRecord& record : *robots) {
    auto unit = std::make_shared<RobotUnit>(record.id);
    unit->name = record.name;
    unit->map = record.map;
    unit->epoch = record.epoch;
    const auto missions = store_.missions(record.id, 1);
    if (!missions) return pass_on(missions);
    if (!missions->empty()) unit->mission = missions->front();
    // Where the store could not say so at its start, its disk being full.
    if (unit->mission && (unit->mission->state == wire::MissionState::kAccepted ||
                          unit->mission->state == wire::MissionState::kDriving)) {
      unit->mission->state = wire::MissionState::kStopped;
      unit->mission->reason = wire::Reason{wire::ReasonCode::kServerRestarted};
      mission_journal_.keep(*unit->mission);
    }
    const std::scoped_lock lock(mutex_);
    units_[record.id] = unit;
  }
  return {};
}

Result<Driving::Unit> Driving::find(const RobotId& id) {
  const std::scoped_lock lock(mutex_);
  const auto found = units_.find(id);
  if (found == units_.end()) {
    return fail(ErrorCode::kNotFound, "There is no robot " + id.str() + ".", "robots/" + id.str());
  }
  return found->second;
}

std::vector<Driving::Unit> Driving::units() {
  const std::scoped_lock lock(mutex_);
  std::vector<Unit> all;
  for (const auto& [id, unit] : units_) all.push_back(unit);
  return all;
}

wire::RobotView Driving::view(const RobotUnit& unit, SteadyTime now) const {
  wire::RobotView view;
  view.id = unit.id;
  view.name = unit.name;
  view.online = unit.online();
  view.map = unit.map;
  if (unit.status) {
    view.state = unit.status->state;
    view.reason = unit.status->reason;
    view.speed_mps = unit.status->speed_mps;
    view.home = unit.status->home;
    view.min_range_m = unit.status->min_range_m;
  }
  view.belief = unit.belief;
  view.mission = unit.mission;
  view.question = unit.open_question();
  if (lease_lives(unit, now)) {
    view.lease = lease_view(unit, now);
    view.lease->id.reset();  // the holder's secret
  }
  if (unit.status_at) view.status_age_ms = milliseconds_between(*unit.status_at, now);
  return view;
}

wire::LeaseView Driving::lease_view(const RobotUnit& unit, SteadyTime now) const {
  return {unit.lease->id, unit.lease->holder, unit.epoch, milliseconds_between(now, unit.lease->expires)};
}

void Driving::tell(const RobotUnit& unit) { events_.publish(view(unit, clock_.steady())); }

Result<wire::RobotView> Driving::add(const std::string& name) {
  db::RobotRecord record;
  record.name = name;
  record.created_us = clock_.wall_us();
  const auto added = store_.add_robot(record);
  if (!added) return pass_on(added);
  auto unit = std::make_shared<RobotUnit>(added->id);
  unit->name = added->name;
  unit->epoch = added->epoch;
  {
    const std::scoped_lock lock(mutex_);
    units_[added->id] = unit;
  }
  const std::scoped_lock lock(unit->mutex);
  tell(*unit);
  return view(*unit, clock_.steady());
}

Status Driving::remove(const RobotId& id) {
  const auto unit = find(id);
  if (!unit) return pass_on(unit);
  {
    const std::scoped_lock lock((*unit)->mutex);
    if ((*unit)->under_way) {
      return fail(ErrorCode::kConflict, "The robot is on its way; stop it first.", "robots/" + id.str());
    }
  }
  if (const Status removed = store_.remove_robot(id); !removed) return removed;
  {
    const std::scoped_lock lock(mutex_);
    units_.erase(id);
  }
  plans_.forget(id);
  const std::scoped_lock lock((*unit)->mutex);
  (*unit)->exploration.reset();
  if ((*unit)->under_way) stop_robot(**unit, "", {wire::ReasonCode::kRobotGone}, "server");  // it was sent off just now
  if ((*unit)->link) (*unit)->link->close(kClosePolicy, "this robot was removed");
  return {};
}

std::vector<wire::RobotView> Driving::list() {
  std::vector<wire::RobotView> views;
  for (const Unit& unit : units()) {
    const std::scoped_lock lock(unit->mutex);
    views.push_back(view(*unit, clock_.steady()));
  }
  return views;
}

Result<wire::RobotView> Driving::get(const RobotId& id) {
  const auto unit = find(id);
  if (!unit) return pass_on(unit);
  const std::scoped_lock lock((*unit)->mutex);
  return view(**unit, clock_.steady());
}

Result<wire::RobotView> Driving::set_map(const RobotId& id, const std::optional<MapId>& map) {
  const auto unit = find(id);
  if (!unit) return pass_on(unit);
  RobotUnit& robot = **unit;
  {
    const std::scoped_lock lock(robot.mutex);
    if (robot.under_way && robot.map != map) {
      return fail(ErrorCode::kConflict, "The robot is on its way; stop it first.", "robots/" + id.str());
    }
  }
  if (const Status status = store_.set_robot_map(id, map); !status) return pass_on(status);
  const std::scoped_lock lock(robot.mutex);
  if (robot.map != map) {
    if (robot.under_way) stop_robot(robot, "", {wire::ReasonCode::kAnotherMap}, "server");
    robot.map = map;
    robot.belief.reset();
    robot.forget_where();
    plans_.forget(id);
  }
  tell(robot);
  return view(robot, clock_.steady());
}

Result<std::vector<std::uint8_t>> Driving::frame(const RobotId& id) {
  const auto unit = find(id);
  if (!unit) return pass_on(unit);
  std::shared_ptr<const wire::Frame> frame;
  {
    const std::scoped_lock lock((*unit)->mutex);
    frame = (*unit)->frame;
  }
  if (!frame) return fail(ErrorCode::kNotFound, "The robot has sent no picture yet.", "robots/" + id.str() + "/frame");
  return frame->jpeg;
}

std::size_t Driving::online() {
  std::size_t count = 0;
  for (const Unit& unit : units()) {
    const std::scoped_lock lock(unit->mutex);
    count += unit->online() ? 1 : 0;
  }
  return count;
}

void Driving::keep(const wire::MissionView& mission) {
  events_.publish(mission);
  mission_journal_.keep(mission);
}

}  // namespace homeward::server
