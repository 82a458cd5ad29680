// SPDX-License-Identifier: Apache-2.0
#include "scenario/exploration_run.hpp"

#include "scenario/exploration_loop.hpp"
#include "sim/floor.hpp"
#include "sim/tour_path.hpp"

namespace homeward::scenario {

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
