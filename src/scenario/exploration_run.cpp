// SPDX-License-Identifier: Apache-2.0
#include "scenario/exploration_run.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "driving/exploration_over.hpp"
#include "driving/step.hpp"
#include "imageio/decode.hpp"
#include "recording/survey_rows.hpp"
#include "scenario/drive_loop.hpp"
#include "scenario/order_to_explore.hpp"
#include "sim/floor.hpp"
#include "sim/tour_path.hpp"
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

/// The loop of one exploration: world, sensors, survey and driving step, cycle by cycle.
class ExplorationLoop {
 public:
  ExplorationLoop(SimulatedRobot& robot, const driving::Body& body, const pipeline::Eye& eye,
                  const ExplorationPlan& plan, const std::function<double()>& clock_ms, recording::Recorder* recorder)
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

  /// False: it has ended.
  Result<bool> cycle() {
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

  ExplorationResult finish() {
    result_.poses = survey_.explorer().poses();
    result_.known_again = survey_.explorer().known_again();
    result_.unreached = survey_.explorer().put_off();
    result_.driven_m = robot_.vehicle().path_m();
    result_.duration_s = now_s();
    result_.collisions = robot_.vehicle().collisions();
    result_.min_clearance_m = robot_.vehicle().min_clearance_m();
    return std::move(result_);
  }

  [[nodiscard]] const exploration::Survey& survey() const { return survey_; }
  [[nodiscard]] const ExplorationResult& so_far() const { return result_; }

 private:
  [[nodiscard]] double clock() const { return clock_ms_ ? clock_ms_() : 0.0; }
  [[nodiscard]] double now_s() const { return 0.001 * static_cast<double>(now_ms_); }

  driving::Inputs sense() {
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

  void drive(const driving::Inputs& inputs) {
    std::vector<wire::StateRow> rows = recording::to_recorded(survey_.take_rows());
    const driving::Outputs outputs = recorder_ != nullptr
                                         ? recorder_->step(state_, inputs, nullptr, now_ms_, std::move(rows))
                                         : driving::step(state_, inputs, config_, now_ms_);
    robot_.command(outputs.motion);
  }

  /// How long that took: a camera takes its pictures for nothing.
  double render_picture(const RangeSweep& sweep) {
    const double began_ms = clock();
    ExploredPicture picture;
    picture.jpeg = imageio::encode_jpeg(robot_.picture(), kQuality);
    picture.sweep = sweep;
    picture.t_s = now_s();
    picture.truth = robot_.vehicle().pose();
    result_.pictures.push_back(std::move(picture));
    return clock() - began_ms;
  }

  Status look(const driving::Inputs& inputs) {
    auto picture = imageio::decode(result_.pictures.back().jpeg, "picture");
    if (!picture) return pass_on(picture);
    auto appearance = eye_.look(*picture);
    if (!appearance) return pass_on(appearance);
    survey_.take(inputs.scan->scan, inputs.odometry,
                 std::make_shared<const features::Appearance>(std::move(*appearance)));
    return {};
  }

  void move() {
    constexpr int kParts = 5;
    for (int part = 0; part < kParts; ++part) robot_.advance(kScenarioCycle_s / kParts);
    now_ms_ += static_cast<driving::Milliseconds>(1000.0 * kScenarioCycle_s);
    result_.trail_m.push_back(position_m(robot_.vehicle().pose()));
  }

  SimulatedRobot& robot_;
  const pipeline::Eye& eye_;
  const ExplorationPlan& plan_;
  const std::function<double()>& clock_ms_;
  recording::Recorder* recorder_;
  exploration::Survey survey_;
  driving::DrivingConfig config_;
  driving::DrivingState state_;
  ExplorationResult result_;
  driving::Milliseconds now_ms_ = 0;
  std::int64_t permit_ = 1;
  bool begun_ = false;
};

}  // namespace

Result<ExplorationResult> explore(SimulatedRobot& robot, const driving::Body& body, const pipeline::Eye& eye,
                                  const ExplorationPlan& plan, const ExplorationProgress& progress,
                                  const std::function<double()>& clock_ms, recording::Recorder* recorder) {
  ExplorationLoop loop(robot, body, eye, plan, clock_ms, recorder);
  for (;;) {
    const std::size_t before = loop.so_far().pictures.size();
    const auto goes_on = loop.cycle();
    if (!goes_on) return pass_on(goes_on);
    if (progress && loop.so_far().pictures.size() > before) progress(loop.survey(), loop.so_far());
    if (!*goes_on) return loop.finish();
  }
}

ExplorationPlan exploration_plan_for(const sim::RobotProfile& profile) {
  ExplorationPlan plan;
  plan.explorer.reach.radius_m = profile.outline.radius_m + profile.outline.side_m;
  return plan;
}

Result<ExplorationResult> explore_world(sim::LitWorld& world, const SimulatedRobotConfig& config, const Pose2& start,
                                        const ExplorationPlan& plan, const ExplorationProgress& progress,
                                        const std::function<double()>& clock_ms) {
  auto robot = SimulatedRobot::create(world, config, start);
  if (!robot) return pass_on(robot);
  const auto camera = camera::Camera::create(config.camera);
  if (!camera) return pass_on(camera);
  const auto eye = pipeline::Eye::create(config.camera, pipeline::suited_feature_config(**camera));
  if (!eye) return pass_on(eye);
  return explore(*robot, body_of(config.profile), *eye, plan, progress, clock_ms);
}

std::optional<std::size_t> picture_of_room(const sim::World& world, const std::string& room,
                                           const ExplorationResult& explored) {
  constexpr double kWithin_m = 1.5;
  const auto point_m = sim::room_point(world, room);
  if (!point_m) return std::nullopt;
  std::optional<std::size_t> best;
  double least_m = kWithin_m;
  for (std::size_t i = 0; i < explored.pictures.size(); ++i) {
    const Eigen::Vector2d at_m = position_m(explored.pictures[i].truth);
    const auto in = sim::room_at(world, at_m);
    if ((at_m - *point_m).norm() >= least_m || (in && *in != room)) continue;
    least_m = (at_m - *point_m).norm();
    best = i;
  }
  return best;
}

}  // namespace homeward::scenario
