// SPDX-License-Identifier: Apache-2.0
#include "driving/orders.hpp"

#include <algorithm>

#include "driving/end_mission.hpp"
#include "driving/mission.hpp"

namespace homeward::driving {
namespace {

wire::Reason why_refused(const wire::MissionOrder& order, const DrivingConfig& config, const Error& error) {
  if (error.code != ErrorCode::kFeatureConfigMismatch) return wire::reason_of(error);
  return {wire::ReasonCode::kFeaturesDiffer,
          {{"map_features", order.feature_config_id}, {"robot_features", config.feature_config_id}}};
}

/// Obeys one message after the other.
class OrderHandler {
 public:
  OrderHandler(DrivingState& to, const Inputs& with, bool by_rider, const DrivingConfig& settings, Milliseconds now,
               Outputs& out)
      : state_(to), inputs_(with), rider_steers_(by_rider), config_(settings), now_ms_(now), outputs_(out) {}

  void operator()(const wire::Welcome& welcome) const {
    // A new connection: nothing of an older epoch moves the robot any more.
    state_.least_epoch = std::max(state_.least_epoch, welcome.epoch);
    if (state_.drive == wire::DriveState::kDriving && state_.newest.epoch < welcome.epoch) {
      end_mission(state_, wire::DriveState::kStopped, wire::Reason{wire::ReasonCode::kLinkMadeAnew});
    }
  }

  void operator()(const wire::MissionOrder& order) const {
    if (!is_newest(order.order)) return;
    if (const auto why = why_not_now()) return refuse(order.mission, order.order, *why);
    auto mission = decode_mission(order, config_);
    if (!mission) {
      end_undrivable();
      return refuse(order.mission, order.order, why_refused(order, config_, mission.error()));
    }
    state_.follow = begun_from(state_.kept, mission->path, mission->map, mission->revision, config_.follow, now_ms_,
                               config_.estimate_lives_ms);
    take_up(std::move(*mission), order.valid_for_ms);
  }

  void operator()(const wire::ExploreOrder& order) const {
    if (!is_newest(order.order)) return;
    if (const auto why = why_not_now()) return refuse(order.mission, order.order, *why);
    if (inputs_.why_not_exploring) {
      end_undrivable();
      return refuse(order.mission, order.order, *inputs_.why_not_exploring);
    }
    Mission mission;
    mission.id = order.mission;
    mission.speed_limit_mps = order.speed_limit_mps;
    mission.explores = true;
    // What it knew of where it is was of a map.
    state_.follow = {};
    state_.kept.reset();
    take_up(std::move(mission), order.valid_for_ms);
  }

  void operator()(const wire::RepeatOrder& order) const {
    if (!is_newest(order.order)) return;
    if (const auto why = why_not_now()) return refuse(order.mission, order.order, *why);
    if (inputs_.why_not_repeating) {
      end_undrivable();
      return refuse(order.mission, order.order, *inputs_.why_not_repeating);
    }
    Mission mission;
    mission.id = order.mission;
    mission.map = order.map;
    mission.revision = order.revision;
    mission.label = order.label;
    mission.speed_limit_mps = order.speed_limit_mps;
    mission.dock = true;
    mission.repeats = true;
    state_.follow = {};
    state_.kept.reset();
    take_up(std::move(mission), order.valid_for_ms);
  }

  void operator()(const wire::Permit& permit) const {
    if (state_.drive != wire::DriveState::kDriving || permit.mission != state_.mission->id) return;
    if (permit.order <= state_.newest || permit.order.epoch != state_.newest.epoch) return;
    state_.newest = permit.order;
    state_.permit_ends_ms = now_ms_ + permit.valid_for_ms;
  }

  void operator()(const wire::StopOrder& stop) const {
    // A stop is obeyed whatever its age: stopping once too often harms nobody. What it overtook comes too late.
    state_.newest = std::max(state_.newest, wire::Order{stop.epoch, stop.seq});
    if (state_.drive == wire::DriveState::kDriving) {
      end_mission(state_, wire::DriveState::kStopped,
                  stop.reason.value_or(wire::Reason{wire::ReasonCode::kStoppedBy, {{"by", stop.by}}}));
    }
    outputs_.messages.emplace_back(wire::Stopped{stop.stop_id, 0});
  }

  void operator()(const wire::BeliefReport& belief) const {
    state_.follow.belief.reset();
    if (belief.lost == state_.follow.belief_lost) state_.belief_changes_ms = now_ms_;
    // One report in between is none: whoever walks by may hide everything for a moment.
    if (now_ms_ - state_.belief_changes_ms >= config_.belief_lasts_ms) state_.follow.belief_lost = belief.lost;
    state_.belief_ms = now_ms_;
    if (!state_.mission || !state_.mission->homes() || belief.lost || !belief.place) return;
    state_.follow.belief = BelievedView{state_.mission->path.view_of(*belief.place), belief.probability};
  }

  void operator()(const wire::Answer& answer) const {
    if (state_.drive != wire::DriveState::kDriving || !state_.mission->homes()) return;
    if (answer.mission != state_.mission->id) return;
    if (!take_answer(state_.asking, answer.question, answer.here)) return;
    const VisualPath& path = state_.mission->path;
    const Pose2& there = path.pose(path.size() - 1);
    state_.follow.hypotheses.weigh_within({there.x_m, there.y_m}, config_.follow.arrived_within_m,
                                          answer.here ? kAnswerOdds : 1.0 / kAnswerOdds);
  }
  // Of an exploration; whoever leads it takes them.
  void operator()(const wire::Fences&) const {}
  void operator()(const wire::Finish&) const {}
  void operator()(const wire::Companion&) const {}
  void operator()(const wire::CompanionView&) const {}
  void operator()(const wire::CompanionState&) const {}
  void operator()(const wire::LinkError&) const {}

 private:
  /// Whether nothing as new was obeyed; then this is the newest.
  [[nodiscard]] bool is_newest(const wire::Order& order) const {
    if (order <= state_.newest || order.epoch < state_.least_epoch) return false;
    state_.newest = order;
    return true;
  }

  [[nodiscard]] std::optional<wire::Reason> why_not_now() const {
    if (rider_steers_) return wire::Reason{wire::ReasonCode::kRiderSteers};
    if (now_ms_ < state_.refuses_until_ms) return wire::Reason{wire::ReasonCode::kWasHeldUp};
    return std::nullopt;
  }

  void refuse(const MissionId& mission, const wire::Order& order, const wire::Reason& why) const {
    outputs_.messages.emplace_back(wire::MissionRefused{mission, order, why});
  }

  /// The server takes what it drove until now for over.
  void end_undrivable() const {
    if (state_.drive != wire::DriveState::kDriving) return;
    end_mission(state_, wire::DriveState::kStopped, wire::Reason{wire::ReasonCode::kUndrivableOrder});
  }

  void take_up(Mission mission, Milliseconds valid_for_ms) const {
    state_.belief_changes_ms = now_ms_;
    state_.mission = std::make_shared<const Mission>(std::move(mission));
    state_.permit_ends_ms = now_ms_ + valid_for_ms;
    state_.drive = wire::DriveState::kDriving;
    state_.reason.reset();
    state_.at_odds = false;
    state_.astray = false;
    state_.looking = {};
    state_.continuity = {};
    withdraw(state_.asking);
    state_.off_path_since_ms.reset();
    state_.off_belief_since_ms.reset();
    state_.seen = {};
    state_.docking = false;
    state_.near_since_ms.reset();
    state_.covered = false;
    state_.pictured = false;
    state_.last_message_ms = now_ms_;
  }

  DrivingState& state_;
  const Inputs& inputs_;
  bool rider_steers_;
  const DrivingConfig& config_;
  Milliseconds now_ms_;
  Outputs& outputs_;
};

}  // namespace

void obey(DrivingState& state, const Inputs& inputs, bool rider_steers, const DrivingConfig& config,
          Milliseconds now_ms, Outputs& outputs) {
  const OrderHandler handler(state, inputs, rider_steers, config, now_ms, outputs);
  for (const wire::ServerMessage& message : inputs.messages) {
    state.last_message_ms = now_ms;
    std::visit(handler, message);
  }
}

}  // namespace homeward::driving
