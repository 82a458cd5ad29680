// SPDX-License-Identifier: Apache-2.0
#include "scenario/drive_loop.hpp"

#include <algorithm>
#include <cmath>

#include "driving/estimated_position.hpp"
#include "driving/follow.hpp"
#include "driving/stated.hpp"
#include "imageio/decode.hpp"
#include "recording/recorder.hpp"
#include "wire/lease_durations.hpp"

namespace homeward::scenario {
namespace {

using wire::FaultKind;

constexpr double kLongest_s = 600.0;
constexpr double kLongestRound_s = 1800.0;  // of a path that was taught
constexpr double kHeardWithin_s = wire::kHeardWithin_ms / 1000.0;
constexpr double kCommandLife_s = 0.1;  // the base's own watch over its commands, as of the simulator's driver

bool moves(const SimulatedRobot& robot) {
  constexpr double kAtRest = 1e-3;
  const sim::MotionCommand& motion = robot.vehicle().motion();
  return std::abs(motion.speed_mps) > kAtRest || std::abs(motion.turn_radps) > kAtRest;
}

}  // namespace

DriveLoop::DriveLoop(SimulatedRobot& robot, const pipeline::Eye& eye, FaultSchedule faults,
                     const driving::DrivingConfig& config, const ScenarioListener& listener,
                     recording::Recorder* recorder)
    : robot_(robot),
      eye_(eye),
      faults_(std::move(faults)),
      config_(config),
      listener_(listener),
      recorder_(recorder),
      box_done_(faults_.all().size(), false),
      lift_done_(faults_.all().size(), false) {}

Status DriveLoop::run(wire::MissionOrder order, std::vector<Pose2> way) {
  mission_ = order.mission;
  number_ = order.order;
  views_.clear();
  for (const wire::PathPlace& place : order.path) views_.push_back(place.image.str());
  if (views_.empty() || views_.back() != order.final_image.str()) views_.push_back(order.final_image.str());
  way_ = std::move(way);
  sees_path_ = {};
  longest_s_ = kLongest_s;
  messages_.emplace_back(std::move(order));
  return drive();
}

Status DriveLoop::run(wire::RepeatOrder order, SeesPath sees) {
  mission_ = order.mission;
  number_ = order.order;
  views_ = {order.image.str()};
  way_.clear();
  sees_path_ = std::move(sees);
  longest_s_ = kLongestRound_s * static_cast<double>(order.rounds + 1);
  messages_.emplace_back(std::move(order));
  return drive();
}

Status DriveLoop::drive() {
  halted_ = false;
  const double began_s = elapsed_s();
  while (elapsed_s() < longest_s_ && !is_ended_) {
    if (elapsed_s() > began_s) receive_from_server(!on(FaultKind::kLinkLost));
    if (const Status cycled = cycle(); !cycled) return cycled;
    if (state_.drive != wire::DriveState::kDriving && !moves(robot_)) break;
  }
  if (state_.drive == wire::DriveState::kDriving && !is_ended_)
    stops_.push_back({elapsed_s(), {wire::ReasonCode::kTooLong}, {}});
  close_stop();
  return {};
}

Status DriveLoop::watch() {
  constexpr double kWatch_s = 2.0;
  constexpr double kLongestWatch_s = 8.0;
  const double now_s = elapsed_s();
  const double until_s = std::max(now_s + kWatch_s, std::min(faults_.ends_s(now_s) + 1.0, now_s + kLongestWatch_s));
  while (elapsed_s() < until_s) {
    receive_from_server(!on(FaultKind::kLinkLost));
    if (const Status cycled = cycle(); !cycled) return cycled;
  }
  close_stop();
  return {};
}

Result<std::optional<DrivenPicture>> DriveLoop::look_again() {
  constexpr int kCycles = 3;
  newest_.reset();
  for (int cycle_number = 0; cycle_number < kCycles; ++cycle_number) {
    receive_from_server(!on(FaultKind::kLinkLost));
    if (const Status cycled = cycle(); !cycled) return pass_on(cycled);
  }
  return newest_;
}

/// What the server says in one cycle. It goes on permitting a mission that has ended: no permit may revive one.
void DriveLoop::receive_from_server(bool link_up) {
  if (!link_up) return;
  if (elapsed_s() - last_received_s_ <= kHeardWithin_s)
    messages_.emplace_back(wire::Permit{mission_, {number_.epoch, ++number_.seq}, wire::kPermitValid_ms});
  answer_question();
  if (!on(FaultKind::kStop)) return;
  messages_.emplace_back(wire::StopOrder{"s1", number_.epoch, wire::Reason{wire::ReasonCode::kStoppedByHand}, "test"});
  stopped_by_hand_ = true;
}

/// Somebody has heard the question and looked about.
void DriveLoop::answer_question() {
  constexpr driving::Milliseconds kAfter_ms = 2000;
  const driving::Asking& asking = state_.asking;
  if (!answers_ || !asking.since_ms || asking.number == answered_ || now_ms_ - *asking.since_ms < kAfter_ms) return;
  answered_ = asking.number;
  if (const auto here = answers_(robot_.vehicle().pose()))
    messages_.emplace_back(wire::Answer{mission_, asking.number, *here});
}

Status DriveLoop::cycle() {
  const bool frozen = on(FaultKind::kAgentFrozen);
  const bool link_up = !on(FaultKind::kLinkLost);
  place_boxes();
  if (const Status kidnapped = kidnap(); !kidnapped) return kidnapped;
  robot_.slip(faults_.share(FaultKind::kWheelSlip, elapsed_s()));
  if (!frozen) {
    const bool was_driving = state_.drive == wire::DriveState::kDriving;
    const auto outputs = step_once(link_up);
    if (!outputs) return pass_on(outputs);
    const bool ended = was_driving && state_.drive != wire::DriveState::kDriving;
    if (ended && state_.reason) stops_.push_back({elapsed_s(), *state_.reason, {}});
    listen_for_doubt();
    compare_with_belief();
    if (state_.drive != wire::DriveState::kDriving && state_.drive != wire::DriveState::kArrived && !moves(robot_))
      halted_ = true;
    if (listener_.cycled) listener_.cycled(trace(*outputs));
    if (ended_ && ended_(trace(*outputs))) is_ended_ = true;
    robot_.command(outputs->motion);
    commanded_s_ = elapsed_s();
    if (link_up) last_received_s_ = elapsed_s();
  }
  move(frozen);
  return {};
}

/// The camera's picture, as it is sent, and what it says.
Status DriveLoop::look(driving::Inputs& inputs, recording::PictureBytes& bytes) {
  constexpr driving::Milliseconds kKeepEvery_ms = 1000;
  constexpr std::size_t kKept = 6;
  Image picture = robot_.picture();
  if (on(FaultKind::kCameraOccluded)) occlude(picture, faults_.share(FaultKind::kCameraOccluded, elapsed_s()));
  newest_ = DrivenPicture{picture, inputs.odometry};
  if (now_ms_ % kKeepEvery_ms == 0) pictures_.push_back(*newest_);
  if (pictures_.size() > kKept) pictures_.pop_front();
  recording::CameraPicture sent = recording::as_sent({now_ms_, std::move(picture), inputs.odometry});
  sent.recognised = !sees_path_ && driving::wants_features(state_.follow);
  auto seen = recording::look(sent, eye_);
  if (!seen) return pass_on(seen);
  inputs.picture = std::move(*seen);
  bytes = sent.bytes;
  if (!sees_path_ || (state_.mission && state_.drive != wire::DriveState::kDriving)) return {};
  const auto received = imageio::decode(*bytes, "picture");
  if (!received) return pass_on(received);
  auto sight = sees_path_(*received, now_ms_, inputs.odometry);
  if (!sight) return pass_on(sight);
  inputs.path_sight = std::move(*sight);
  return {};
}

Result<driving::Outputs> DriveLoop::step_once(bool link_up) {
  driving::Inputs inputs;
  inputs.odometry = robot_.odometry();
  inputs.link_up = link_up;
  inputs.messages = std::exchange(messages_, {});
  recording::PictureBytes bytes;
  if (!on(FaultKind::kCameraFrozen)) {
    if (const Status looked = look(inputs, bytes); !looked) return pass_on(looked);
  }
  constexpr driving::Milliseconds kAskEvery_ms = 500;
  if (believes_ && link_up && inputs.picture && inputs.picture->appearance && now_ms_ - believed_ms_ >= kAskEvery_ms) {
    believed_ms_ = now_ms_;
    const bool drives = state_.drive == wire::DriveState::kDriving;
    messages_.emplace_back(believes_(*inputs.picture->appearance, inputs.odometry,
                                     drives ? driving::stated_estimate(state_, config_) : std::nullopt));
  }
  if (!on(FaultKind::kScanLost)) inputs.scan = {now_ms_, robot_.sweep()};
  const bool looks = inputs.picture.has_value() && state_.drive == wire::DriveState::kDriving;
  driving::Outputs outputs = recorder_ != nullptr ? recorder_->step(state_, inputs, bytes, now_ms_)
                                                  : driving::step(state_, inputs, config_, now_ms_);
  if (state_.seen.answered && looks) ++vectors_;
  return outputs;
}

void DriveLoop::place_boxes() {
  const std::vector<wire::ScenarioFault>& all = faults_.all();
  const double t_s = elapsed_s();
  const std::size_t before = boxes_.size();
  std::erase_if(boxes_, [&](const auto& box) { return t_s >= all[box.first].at_s + all[box.first].for_s; });
  bool changed = boxes_.size() != before;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].kind != FaultKind::kObstacle || box_done_[i] || t_s < all[i].at_s) continue;
    box_done_[i] = true;
    std::vector<Eigen::Vector2d> ahead_m;
    for (auto next = static_cast<std::size_t>(state_.follow.index); next < way_.size(); ++next) {
      ahead_m.emplace_back(way_[next].x_m, way_[next].y_m);
    }
    const auto box = box_ahead(robot_.vehicle().pose(), ahead_m);
    if (box) boxes_.emplace_back(i, *box);
    if (!box && listener_.log) listener_.log("no box: the way ends within 1.5 m");
    changed = changed || box;
  }
  if (!changed) return;
  std::vector<sim::Box> standing;
  for (const auto& [number, box] : boxes_) standing.push_back(box);
  robot_.set_boxes(std::move(standing));
}

/// Lifts the robot and puts it down elsewhere, once it is under way.
Status DriveLoop::kidnap() {
  const std::vector<wire::ScenarioFault>& all = faults_.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_due = all[i].kind == FaultKind::kKidnapped && !lift_done_[i] && elapsed_s() >= all[i].at_s;
    if (!is_due || !elsewhere_ || state_.drive != wire::DriveState::kDriving) continue;
    lift_done_[i] = true;
    const auto spot = elsewhere_();
    if (!spot) return pass_on(spot);
    if (!*spot && listener_.log) listener_.log("not kidnapped: there is no other spot with room for the robot");
    if (!*spot) continue;
    robot_.carry_to(**spot);
    kidnapped_at_s_ = elapsed_s();
    said_when_lifted_ = state_.reason;
    noticed_after_s_.reset();
  }
  return {};
}

/// Whoever takes itself to have arrived has no doubt, whatever else it says.
void DriveLoop::listen_for_doubt() {
  if (!kidnapped_at_s_ || noticed_after_s_ || state_.drive == wire::DriveState::kArrived) return;
  // What it said before says nothing of the lift.
  if (state_.reason != said_when_lifted_) said_when_lifted_.reset();
  if (state_.drive != wire::DriveState::kDriving || (state_.reason && !said_when_lifted_))
    noticed_after_s_ = elapsed_s() - *kidnapped_at_s_;
}

void DriveLoop::compare_with_belief() {
  constexpr double kApart_m = 2.0;
  std::optional<double> off_m;
  if (state_.drive == wire::DriveState::kDriving && state_.mission->homes())
    off_m = driving::off_belief_m(state_.follow, state_.mission->path, config_.follow);
  if (!off_m || *off_m <= kApart_m) {
    apart_since_s_.reset();
    return;
  }
  apart_since_s_ = apart_since_s_.value_or(elapsed_s());
  belief_apart_s_ = std::max(belief_apart_s_, elapsed_s() - *apart_since_s_);
}

void DriveLoop::move(bool frozen) {
  constexpr int kParts = 5;
  const bool must_rest = halted_;
  bool moved = false;
  for (int part = 0; part < kParts; ++part) {
    const double at_s = elapsed_s() + kScenarioCycle_s * part / kParts;
    if (frozen && at_s - commanded_s_ >= kCommandLife_s) robot_.command({});
    robot_.advance(kScenarioCycle_s / kParts);
    if (!moves(robot_)) continue;
    moved = true;
    stands_since_s_ = at_s + kScenarioCycle_s / kParts;
  }
  if (must_rest && moved) ++moved_after_stop_;
  // The base has stopped by itself: that, too, only an order may end.
  if (frozen && !moved && elapsed_s() - commanded_s_ >= kCommandLife_s) halted_ = true;
  now_ms_ += static_cast<driving::Milliseconds>(1000.0 * kScenarioCycle_s);
}

/// How long after the fault the wheels stood, for the latest stop.
void DriveLoop::close_stop() {
  if (stops_.empty()) return;
  StopEvent& stop = stops_.back();
  const auto fault_s = faults_.began_s(stop.t_s);
  if (fault_s && !stop.stand_after_s) stop.stand_after_s = std::max(0.0, stands_since_s_ - *fault_s);
}

/// How far the robot truly is from where its estimate puts it, beside the view of its path that is nearest by it.
std::optional<double> DriveLoop::estimate_error_m() const {
  const driving::PoseHypothesis* best = state_.follow.hypotheses.best();
  if (best == nullptr || !state_.mission || way_.size() != state_.mission->path.views.size()) return std::nullopt;
  const driving::VisualPath& path = state_.mission->path;
  double nearest_m = 1e9;
  double error_m = 0.0;
  for (int view = 0; view < path.size(); ++view) {
    const Pose2 believed = inverse(path.pose(view)) * best->map_from_robot;
    const Pose2 truly = inverse(way_[static_cast<std::size_t>(view)]) * robot_.vehicle().pose();
    const double distance_m = std::hypot(believed.x_m, believed.y_m);
    if (distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    error_m = std::hypot(believed.x_m - truly.x_m, believed.y_m - truly.y_m);
  }
  return error_m;
}

CycleTrace DriveLoop::trace(const driving::Outputs& outputs) const {
  CycleTrace now;
  now.t_s = elapsed_s();
  now.pose = robot_.vehicle().pose();
  now.index = state_.follow.index;
  now.views = state_.mission ? static_cast<int>(state_.mission->path.views.size()) : 0;
  const auto index = static_cast<std::size_t>(now.index);
  now.view = views_[std::min(index, views_.size() - 1)];
  if (state_.repeat.known) now.index = state_.repeat.known->arc;
  now.answered = state_.seen.answered;
  now.continuity = state_.continuity.share;
  now.contradiction = state_.going_on.contradiction;
  if (state_.mission && state_.follow.begun) {
    now.position_probability = driving::position_probability(state_.follow, state_.mission->path);
    now.arrival_probability = driving::arrival_probability(state_.follow, state_.mission->path, config_.follow);
    now.off_belief_m = driving::off_belief_m(state_.follow, state_.mission->path, config_.follow);
    now.elsewhere = state_.follow.hypotheses.elsewhere();
    now.measured = state_.follow.measured;
  }
  now.estimate_error_m = estimate_error_m();
  if (state_.seen.vector) {
    now.parallax_rad = state_.seen.vector->median_parallax_rad;
    now.bearing_rad = state_.seen.vector->bearing_rad;
    now.confidence = state_.seen.vector->confidence;
    now.inliers = state_.seen.vector->inliers;
  }
  if (const auto goal_m = driving::goal(state_.follow, robot_.odometry(), config_.follow)) {
    now.goal_x_m = goal_m->x();
    now.goal_y_m = goal_m->y();
  }
  now.speed_mps = outputs.motion.speed_mps;
  now.turn_radps = outputs.motion.turn_radps;
  now.min_range_m = state_.min_range_m.value_or(0.0);
  now.clearance_m = robot_.vehicle().min_clearance_m();
  for (const sim::Person& person : robot_.people()) now.people_m.emplace_back(person.x_m, person.y_m);
  now.state = wire::drive_state_name(state_.drive);
  return now;
}

}  // namespace homeward::scenario
