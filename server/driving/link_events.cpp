// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "core/version.hpp"
#include "server/driving/driving.hpp"
#include "wire/camera_json.hpp"
#include "wire/lease_durations.hpp"

namespace homeward::server {
namespace {

using wire::ReasonCode;

constexpr std::chrono::seconds kHelloWithin{5};
constexpr std::chrono::seconds kTrackingKept{60};  // a robot that was gone for longer may have been carried anywhere

wire::Reason why_failed(const wire::AgentStatus& status) {
  return status.reason.value_or(wire::Reason{ReasonCode::kRobotCannotGoOn});
}

}  // namespace

std::shared_ptr<SocketHandler> Driving::open_link(const RobotId& id) {
  auto link = std::make_shared<AgentLink>(*this, id, clock_);
  const std::scoped_lock lock(mutex_);
  not_greeted_.push_back(link);
  return link;
}

void Driving::close_silent_links(SteadyTime now) {
  std::vector<std::shared_ptr<AgentLink>> silent;
  {
    const std::scoped_lock lock(mutex_);
    std::erase_if(not_greeted_, [&](const std::weak_ptr<AgentLink>& weak) {
      const auto link = weak.lock();
      if (!link || link->greeted()) return true;
      if (now - link->last_heard() <= kHelloWithin) return false;
      silent.push_back(link);
      return true;
    });
  }
  for (const auto& link : silent) link->close(kClosePolicy, "no hello came");
}

void Driving::received(const std::shared_ptr<AgentLink>& link, wire::AgentMessage message) {
  const auto found = find(link->robot());
  if (!found) return link->close(kClosePolicy, "this robot was removed");
  if (auto* hello = std::get_if<wire::Hello>(&message)) return received_hello(*found, link, std::move(*hello));
  if (const auto* view = std::get_if<wire::CompanionView>(&message)) {
    if (const auto to = link_of_companion(*found, link, view->exploration)) to->relay(*view);
    return;
  }
  if (const auto* state = std::get_if<wire::CompanionState>(&message)) {
    if (const auto to = link_of_companion(*found, link, state->exploration)) to->relay(*state);
    return;
  }
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  if (unit.link != link) return;  // an older connection, on its way out
  if (auto* frame = std::get_if<wire::Frame>(&message)) {
    unit.frame = std::make_shared<const wire::Frame>(std::move(*frame));
    unit.waiting_frame = unit.frame;
    begin_looking(*found);
  } else if (auto* status = std::get_if<wire::AgentStatus>(&message)) {
    received_status(*found, std::move(*status));
  } else if (auto* refusal = std::get_if<wire::MissionRefused>(&message)) {
    received_refusal(unit, *refusal);
  } else if (auto* explored = std::get_if<wire::Explored>(&message)) {
    received_explored(unit, std::move(explored->exploration));
  } else if (auto* stopped = std::get_if<wire::Stopped>(&message)) {
    spdlog::info("robot {} has stopped for stop {}", unit.id.str(), stopped->stop_id);
  }
}

void Driving::received_explored(RobotUnit& unit, wire::ExplorationReport report) {
  const auto with = [](const wire::ExplorationReport& one) {
    return one.companion ? std::optional(one.companion->exploration) : std::nullopt;
  };
  // What still waits for it is of an exploration that it has nothing to do with any more.
  if (unit.exploration && with(*unit.exploration) != with(report)) unit.link->forget_relayed();
  unit.exploration = std::make_shared<const wire::ExplorationReport>(std::move(report));
  events_.publish(wire::ExplorationView{unit.id, unit.exploration});
}

void Driving::received_hello(const Unit& unit, const std::shared_ptr<AgentLink>& link, wire::Hello hello) {
  {
    const std::scoped_lock lock(unit->mutex);
    if (unit->under_way) stop_robot(*unit, "", {ReasonCode::kRobotConnectedAnew}, "server");
    if (unit->link) unit->link->close(kClosePolicy, "the robot connected anew");
    spdlog::info("robot {} connected: {}", unit->id.str(), hello.agent);
    // A robot that soon comes back with the same camera goes on from where it was; a program that was started anew
    // counts its odometry from somewhere else.
    const bool soon = unit->gone_at && clock_.steady() - *unit->gone_at < kTrackingKept;
    const bool same_camera = wire::camera_to_json(unit->hello.camera) == wire::camera_to_json(hello.camera);
    if (!(unit->link || soon) || !same_camera) unit->forget_where();
    if (unit->hello.session != hello.session) {
      unit->restart_odometry = true;
      unit->displaced = 0;  // another program counts anew; the same one must not be taken for lifted again
    }
    unit->link = link;
    unit->welcomed = false;
    unit->hello = std::move(hello);
    unit->status.reset();
    unit->exploration.reset();
    unit->belief.reset();
    unit->waiting_frame.reset();
  }
  // The new epoch is written to disk, which the socket thread must not wait for.
  if (!journal_.try_run([this, unit, link] { welcome(unit, link); })) link->close(kCloseGoingAway, "the server ends");
}

void Driving::welcome(const Unit& unit, const std::shared_ptr<AgentLink>& link) {
  const auto epoch = store_.next_epoch(unit->id);
  if (!epoch) {
    spdlog::error("robot {} gets no epoch: {}", unit->id.str(), epoch.error().message);
    return link->close(kCloseTryLater, "the server cannot write to its disk");
  }
  const std::scoped_lock lock(unit->mutex);
  if (unit->link != link) return;
  if (*epoch > unit->epoch) {
    unit->epoch = *epoch;
    unit->seq = 0;
  }
  unit->welcomed = true;
  link->send(wire::Welcome{name_with_version("homeward-server"), unit->id, unit->epoch, wire::kFrameEvery_ms});
  tell(*unit);
}

void Driving::received_status(const Unit& found, wire::AgentStatus status) {
  RobotUnit& unit = *found;
  unit.status_at = clock_.steady();
  unit.status = std::move(status);
  const wire::AgentStatus& now = *unit.status;
  const bool lifted = now.displaced > unit.displaced;
  if (lifted) {
    spdlog::info("robot {} was moved without its wheels", unit.id.str());
    unit.forget_where();
    unit.belief.reset();
    // It was not put down yet: what was seen in somebody's hands says nothing of where it will stand.
    if (unit.under_way && (unit.looks_since || unit.looking_for_detour)) {
      unit.lifted = true;
      if (unit.looking_for_detour) unit.failed_because = why_failed(now);
      unit.looks_since = unit.status_at;
      unit.looking_for_detour = false;  // that way begins where it was
    }
    unit.looks = 0;
  }
  unit.displaced = now.displaced;
  // Until the robot takes up another way it goes on telling of the one that failed.
  const bool of_failed_way =
      now.state != wire::DriveState::kStopped &&  // by the rider's hand
      (unit.looking_for_detour || unit.looks_since ||
       (unit.detours + unit.restarts > 0 && unit.mission->state == wire::MissionState::kAccepted &&
        now.state == wire::DriveState::kFailed));
  if (unit.under_way && now.mission == unit.mission->id && !of_failed_way) {
    wire::MissionView& mission = *unit.mission;
    const std::int64_t last = static_cast<std::int64_t>(mission.path.size()) - 1;
    const std::int64_t index =
        std::clamp<std::int64_t>(now.path_index - unit.first_arc.value_or(0), 0, std::max<std::int64_t>(0, last));
    const bool moved_on = index != mission.path_index;
    count_driven(unit, index, now.state);
    mission.path_index = index;
    mission.arrival_probability = now.arrival_probability;
    switch (now.state) {
      case wire::DriveState::kArrived:
        mission.reason = now.reason;  // what is left to say; that of a detour is over
        end_mission(unit, wire::MissionState::kArrived, std::nullopt);
        break;
      case wire::DriveState::kFailed:
        received_failure(found, why_failed(now), lifted);
        break;
      case wire::DriveState::kStopped:
        end_mission(unit, wire::MissionState::kStopped, now.reason.value_or(wire::Reason{ReasonCode::kRobotStopped}));
        break;
      case wire::DriveState::kDriving: {
        // Its own estimate is sure enough to drive by.
        unit.lifted = false;
        const bool found_itself = now.estimate && wire::says(mission.reason, ReasonCode::kLooksAroundFirst);
        if (found_itself) mission.reason.reset();
        if (mission.state != wire::MissionState::kDriving || moved_on || found_itself) {
          mission.state = wire::MissionState::kDriving;
          keep(mission);
        }
        break;
      }
      case wire::DriveState::kIdle:
        break;
    }
  }
  tell(unit);
}

void Driving::received_failure(const Unit& found, const wire::Reason& why, bool lifted) {
  RobotUnit& unit = *found;
  wire::MissionView& mission = *unit.mission;
  // One that explores chooses its ways by itself, and has tried all that it knows.
  if (unit.explores()) return end_mission(unit, wire::MissionState::kFailed, why);
  // Along a path that was taught there is one way alone.
  if (unit.first_arc) return end_mission(unit, wire::MissionState::kFailed, why);
  if (lifted && unit.online() && unit.lease) {
    unit.lifted = true;
    unit.looks_since = unit.status_at;
    unit.failed_because = why;
    mission.reason = unit.status->reason;
    keep(mission);
    return;
  }
  count_way(mission, mission.path_index, false);
  if (begin_detour(found, why)) return;
  if (unit.online() && unit.lease && !unit.known_start(*unit.status_at)) {
    unit.looks_since = unit.status_at;  // whoever stands before the camera may go on
    unit.looks = 0;
    unit.failed_because = why;
    mission.reason = wire::reason_with(ReasonCode::kPlaceLookedFor, "because", unit.failed_because);
    keep(mission);
  } else {
    end_mission(unit, wire::MissionState::kFailed, why);
  }
}

void Driving::received_refusal(RobotUnit& unit, const wire::MissionRefused& refusal) {
  if (!unit.under_way || unit.mission->id != refusal.mission) return;
  end_mission(unit, wire::MissionState::kRefused, refusal.reason);
  tell(unit);
}

void Driving::closed(const std::shared_ptr<AgentLink>& link) {
  const auto found = find(link->robot());
  if (!found) return;
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  if (unit.link != link) return;
  spdlog::info("robot {} is gone", unit.id.str());
  unit.link.reset();
  unit.welcomed = false;
  if (unit.under_way) end_mission(unit, wire::MissionState::kStopped, wire::Reason{ReasonCode::kRobotGone});
  unit.status.reset();
  unit.exploration.reset();
  unit.belief.reset();
  unit.waiting_frame.reset();
  unit.gone_at = clock_.steady();
  tell(unit);
}

}  // namespace homeward::server
