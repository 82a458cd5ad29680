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
struct OrderHandler {
  DrivingState& state;
  bool rider_steers;
  const DrivingConfig& config;
  Milliseconds now_ms;
  Outputs& outputs;

  void operator()(const wire::Welcome& welcome) const {
    // A new connection: nothing of an older epoch moves the robot any more.
    state.least_epoch = std::max(state.least_epoch, welcome.epoch);
    if (state.drive == wire::DriveState::kDriving && state.newest.epoch < welcome.epoch) {
      end_mission(state, wire::DriveState::kStopped, wire::Reason{wire::ReasonCode::kLinkMadeAnew});
    }
  }

  void operator()(const wire::MissionOrder& order) const {
    if (order.order <= state.newest || order.order.epoch < state.least_epoch) return;
    state.newest = order.order;
    if (rider_steers || now_ms < state.refuses_until_ms) {
      outputs.messages.emplace_back(wire::MissionRefused{
          order.mission, order.order,
          wire::Reason{rider_steers ? wire::ReasonCode::kRiderSteers : wire::ReasonCode::kWasHeldUp}});
      return;
    }
    auto mission = decode_mission(order, config);
    if (!mission) {
      if (state.drive == wire::DriveState::kDriving) {
        end_mission(state, wire::DriveState::kStopped, wire::Reason{wire::ReasonCode::kUndrivableOrder});
      }
      outputs.messages.emplace_back(
          wire::MissionRefused{order.mission, order.order, why_refused(order, config, mission.error())});
      return;
    }
    state.belief_changes_ms = now_ms;
    state.follow = begun_from(state.kept, mission->path, mission->map, mission->revision, config.follow, now_ms,
                              config.estimate_lives_ms);
    state.mission = std::make_shared<const Mission>(std::move(*mission));
    state.permit_ends_ms = now_ms + order.valid_for_ms;
    state.drive = wire::DriveState::kDriving;
    state.reason.reset();
    state.at_odds = false;
    state.astray = false;
    state.looking = {};
    state.continuity = {};
    withdraw(state.asking);
    state.off_path_since_ms.reset();
    state.off_belief_since_ms.reset();
    state.seen = {};
    state.docking = false;
    state.near_since_ms.reset();
    state.covered = false;
    state.pictured = false;
    state.last_message_ms = now_ms;
  }

  void operator()(const wire::Permit& permit) const {
    if (state.drive != wire::DriveState::kDriving || permit.mission != state.mission->id) return;
    if (permit.order <= state.newest || permit.order.epoch != state.newest.epoch) return;
    state.newest = permit.order;
    state.permit_ends_ms = now_ms + permit.valid_for_ms;
  }

  void operator()(const wire::StopOrder& stop) const {
    // A stop is obeyed whatever its age: stopping once too often harms nobody. What it overtook comes too late.
    state.newest = std::max(state.newest, wire::Order{stop.epoch, stop.seq});
    if (state.drive == wire::DriveState::kDriving) {
      end_mission(state, wire::DriveState::kStopped,
                  stop.reason.value_or(wire::Reason{wire::ReasonCode::kStoppedBy, {{"by", stop.by}}}));
    }
    outputs.messages.emplace_back(wire::Stopped{stop.stop_id, 0});
  }

  void operator()(const wire::BeliefReport& belief) const {
    state.follow.belief.reset();
    if (belief.lost == state.follow.belief_lost) state.belief_changes_ms = now_ms;
    // One report in between is none: whoever walks by may hide everything for a moment.
    if (now_ms - state.belief_changes_ms >= config.belief_lasts_ms) state.follow.belief_lost = belief.lost;
    state.belief_ms = now_ms;
    if (!state.mission || state.mission->explores || belief.lost || !belief.place) return;
    state.follow.belief = BelievedView{state.mission->path.view_of(*belief.place), belief.probability};
  }

  void operator()(const wire::Answer& answer) const {
    if (state.drive != wire::DriveState::kDriving || state.mission->explores) return;
    if (answer.mission != state.mission->id) return;
    if (!take_answer(state.asking, answer.question, answer.here)) return;
    const VisualPath& path = state.mission->path;
    const Pose2& there = path.pose(path.size() - 1);
    state.follow.hypotheses.weigh_within({there.x_m, there.y_m}, config.follow.arrived_within_m,
                                         answer.here ? kAnswerOdds : 1.0 / kAnswerOdds);
  }
  void operator()(const wire::LinkError&) const {}
};

}  // namespace

void obey(DrivingState& state, const std::vector<wire::ServerMessage>& messages, bool rider_steers,
          const DrivingConfig& config, Milliseconds now_ms, Outputs& outputs) {
  for (const wire::ServerMessage& message : messages) {
    state.last_message_ms = now_ms;
    std::visit(OrderHandler{state, rider_steers, config, now_ms, outputs}, message);
  }
}

}  // namespace homeward::driving
