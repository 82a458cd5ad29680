// SPDX-License-Identifier: Apache-2.0
#include "scenario/simulated_robot.hpp"

#include <cmath>
#include <numbers>

namespace homeward::scenario {

sim::LaserConfig safety_scanner() {
  // Contact is judged from 0.1 to 1.4 m (sim::FloorPlan); a board of furniture is 0.016 m thick or more.
  constexpr double kLowest_m = 0.105;
  constexpr double kHighest_m = 1.395;
  constexpr int kLayers = 87;
  sim::LaserConfig laser;
  laser.heights_m.resize(kLayers);
  for (int i = 0; i < kLayers; ++i) {
    laser.heights_m[static_cast<std::size_t>(i)] = kLowest_m + i * (kHighest_m - kLowest_m) / (kLayers - 1);
  }
  return laser;
}

sim::UltrasoundConfig safety_ring() {
  sim::UltrasoundConfig ring;
  ring.heights_m = safety_scanner().heights_m;
  return ring;
}

namespace {

driving::SonarConfig sonar_of(const sim::UltrasoundConfig& ring) {
  driving::SonarConfig sonar;
  sonar.half_cone_rad = 0.5 * ring.cone_rad;
  sonar.range_min_m = ring.range_min_m;
  sonar.range_max_m = ring.range_max_m;
  return sonar;
}

}  // namespace

Result<SimulatedRobot> SimulatedRobot::create(sim::LitWorld& world, const SimulatedRobotConfig& config,
                                              const Pose2& start) {
  auto camera = camera::Camera::create(config.camera);
  if (!camera) return pass_on(camera);
  return SimulatedRobot(world, config, start, *camera);
}

SimulatedRobot::SimulatedRobot(sim::LitWorld& world, const SimulatedRobotConfig& config, const Pose2& start,
                               const std::shared_ptr<const camera::Camera>& camera)
    : world_(&world),
      config_(config),
      renderer_(world, config.light, camera),
      obstacles_(world.world()),
      walkers_(world.world(), config.people, config.seed + 7, start),
      vehicle_(config.profile, start, config.seed + 13),
      ring_(sim::ultrasound_ring(config.profile.outline, config.ultrasound)),
      sonar_map_(sonar_of(config.ultrasound)) {}

void SimulatedRobot::advance(double seconds) {
  constexpr double kStep_s = 0.02;
  const int steps = std::max(1, static_cast<int>(std::lround(seconds / kStep_s)));
  for (int i = 0; i < steps; ++i) {
    walkers_.advance(seconds / steps, vehicle_.pose(), config_.profile.outline);
    const Pose2 before = vehicle_.odometry();
    vehicle_.advance(seconds / steps, {(1.0 - slip_) * command_.speed_mps, command_.turn_radps}, obstacles_,
                     walkers_.people());
    if (slip_ > 0.0) {
      Pose2 rolled = inverse(before) * vehicle_.odometry();
      rolled.x_m /= 1.0 - slip_;
      rolled.y_m /= 1.0 - slip_;
      lie_ = lie_ * before * rolled * inverse(vehicle_.odometry());
    }
  }
  seconds_ += seconds;
}

void SimulatedRobot::set_boxes(std::vector<sim::Box> boxes) {
  boxes_ = std::move(boxes);
  obstacles_.set_boxes(boxes_);
}

SimulatedRobot::View SimulatedRobot::view() {
  return {vehicle_.pose(), odometry(), walkers_.people(), boxes_, config_.seed * 7'919 + ++readings_};
}

Image SimulatedRobot::render(const View& view) const {
  return renderer_.render(view.pose, view.people, view.noise_seed, view.boxes);
}

driving::Scan SimulatedRobot::sweep() {
  if (config_.profile.ranges == sim::RangeSensor::kUltrasound) {
    const std::vector<float> ranges_m =
        sim::ultrasound(world_->rays(), vehicle_.pose(), ring_, walkers_.people(), config_.ultrasound,
                        config_.seed * 104'729 + ++readings_, boxes_);
    std::vector<driving::SonarReading> readings;
    for (std::size_t i = 0; i < ring_.size(); ++i) readings.push_back({ring_[i], ranges_m[i]});
    return sonar_map_.update(readings, odometry());
  }
  driving::Scan scan;
  scan.ranges_m = sim::scan(world_->rays(), vehicle_.pose(), walkers_.people(), config_.laser,
                            config_.seed * 104'729 + ++readings_, boxes_);
  scan.angle_step_rad = 2.0 * std::numbers::pi / config_.laser.rays;
  scan.range_max_m = config_.laser.range_max_m;
  return scan;
}

sim::Box box_of(const SimulatedRobot& robot) {
  sim::Box box;
  box.pose = robot.vehicle().pose();
  box.foot = robot.vehicle().profile().outline;
  return box;
}

driving::Body body_of(const sim::RobotProfile& profile) {
  driving::Body body;
  body.outline = profile.outline;
  body.max_speed_mps = profile.max_speed_mps;
  body.max_turn_radps = profile.max_turn_radps;
  body.deceleration_mps2 = profile.deceleration_mps2;
  body.turn_deceleration_radps2 = profile.turn_deceleration_radps2;
  body.vague_ranges = profile.ranges == sim::RangeSensor::kUltrasound;
  return body;
}

}  // namespace homeward::scenario
