// SPDX-License-Identifier: Apache-2.0
#include "scenario/exploration_loop.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "driving/exploration_over.hpp"
#include "driving/step.hpp"
#include "imageio/decode.hpp"
#include "recording/survey_rows.hpp"
#include "scenario/drive_loop.hpp"
#include "scenario/order_to_explore.hpp"
#include "wire/lease_durations.hpp"
#include "wire/reason.hpp"

namespace homeward::scenario {
namespace {

constexpr int kQuality = 92;
constexpr double kLegShare = 0.6;  // of the distance at which the survey calls a place reached: the leg goes on to that

ExplorationEnd end_of(exploration::SurveyEnd end) {
  switch (end) {
    case exploration::SurveyEnd::kAllSeen:
      return ExplorationEnd::kComplete;
    case exploration::SurveyEnd::kBack:
      return ExplorationEnd::kBack;
    case exploration::SurveyEnd::kStuck:
      return ExplorationEnd::kStuck;
    case exploration::SurveyEnd::kLimit:
      return ExplorationEnd::kLimit;
  }
  return ExplorationEnd::kStopped;
}

}  // namespace

ExplorationLoop::ExplorationLoop(SimulatedRobot& robot, const driving::Body& body, const pipeline::Eye& eye,
                                 const ExplorationPlan& plan, const std::function<double()>& clock_ms,
                                 recording::Recorder* recorder)
    : robot_(robot),
      eye_(eye),
      plan_(plan),
      clock_ms_(clock_ms),
      recorder_(recorder),
      survey_(plan.explorer, plan.survey),
      config_(exploring_config(body, features::feature_config_id(eye.feature_config()))) {
  if (plan.back_after_s) survey_.be_back_by(static_cast<std::int64_t>(1000.0 * *plan.back_after_s));
  survey_.set_fences(plan.fences_m);
}

Result<bool> ExplorationLoop::cycle() {
  driving::Inputs inputs = sense();
  const double began_ms = clock();
  const exploration::SurveyStep next = survey_.go_on(inputs.scan->scan, inputs.odometry, state_.leg.blocked, now_ms_);
  if (next.takes_picture) {
    const double rendering_ms = render_picture(inputs.scan->scan);
    if (const Status looked = look(inputs); !looked) return pass_on(looked);
    result_.step_ms.push_back(clock() - began_ms - rendering_ms);
  }
  if (next.goal_m) inputs.leg = driving::Leg{*next.goal_m, kLegShare * plan_.survey.there_m};
  if (next.ended) inputs.exploration_over = driving::exploration_over(*next.ended, survey_.explorer().put_off());
  drive(inputs);
  if (next.ended) {
    result_.ended = end_of(*next.ended);
    return false;
  }
  move();
  if (state_.drive != wire::DriveState::kDriving) {
    result_.ended = ExplorationEnd::kStopped;
    result_.reason = state_.reason ? wire::english(*state_.reason) : "";
    return false;
  }
  if (robot_.vehicle().path_m() >= plan_.limit_m || now_s() >= plan_.limit_s) survey_.end_at_limit(robot_.odometry());
  return true;
}

ExplorationResult ExplorationLoop::finish() {
  result_.poses = survey_.explorer().poses();
  result_.known_again = survey_.explorer().known_again();
  result_.unreached = survey_.explorer().put_off();
  result_.driven_m = robot_.vehicle().path_m();
  result_.duration_s = now_s();
  result_.collisions = robot_.vehicle().collisions();
  result_.min_clearance_m = robot_.vehicle().min_clearance_m();
  return std::move(result_);
}

driving::Inputs ExplorationLoop::sense() {
  driving::Inputs inputs;
  inputs.odometry = robot_.odometry();
  inputs.link_up = true;
  inputs.scan = {now_ms_, robot_.sweep()};
  // What the camera shows on the way is of no use before it is a picture of the tour: it is not rendered.
  inputs.picture = driving::SeenPicture{now_ms_, nullptr, {}, inputs.odometry};
  if (!std::exchange(begun_, true)) inputs.messages.emplace_back(order_to_explore(plan_.speed_limit_mps));
  inputs.messages.emplace_back(wire::Permit{MissionId("exploration"), {1, ++permit_}, wire::kPermitValid_ms});
  return inputs;
}

void ExplorationLoop::drive(const driving::Inputs& inputs) {
  std::vector<wire::StateRow> rows = recording::to_recorded(survey_.take_rows());
  const driving::Outputs outputs = recorder_ != nullptr
                                       ? recorder_->step(state_, inputs, nullptr, now_ms_, std::move(rows))
                                       : driving::step(state_, inputs, config_, now_ms_);
  robot_.command(outputs.motion);
}

/// How long that took: a camera takes its pictures for nothing.
double ExplorationLoop::render_picture(const RangeSweep& sweep) {
  const double began_ms = clock();
  ExploredPicture picture;
  picture.jpeg = imageio::encode_jpeg(robot_.picture(), kQuality);
  picture.sweep = sweep;
  picture.t_s = now_s();
  picture.truth = robot_.vehicle().pose();
  result_.pictures.push_back(std::move(picture));
  return clock() - began_ms;
}

Status ExplorationLoop::look(const driving::Inputs& inputs) {
  auto picture = imageio::decode(result_.pictures.back().jpeg, "picture");
  if (!picture) return pass_on(picture);
  auto appearance = eye_.look(*picture);
  if (!appearance) return pass_on(appearance);
  survey_.take(inputs.scan->scan, inputs.odometry,
               std::make_shared<const features::Appearance>(std::move(*appearance)));
  return {};
}

void ExplorationLoop::move() {
  constexpr int kParts = 5;
  for (int part = 0; part < kParts; ++part) robot_.advance(kScenarioCycle_s / kParts);
  now_ms_ += static_cast<driving::Milliseconds>(1000.0 * kScenarioCycle_s);
  result_.trail_m.push_back(position_m(robot_.vehicle().pose()));
}

}  // namespace homeward::scenario
