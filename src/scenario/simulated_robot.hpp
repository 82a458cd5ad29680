// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "core/result.hpp"
#include "driving/body.hpp"
#include "driving/scan.hpp"
#include "driving/sonar_map.hpp"
#include "sim/box.hpp"
#include "sim/laser.hpp"
#include "sim/motion.hpp"
#include "sim/people.hpp"
#include "sim/renderer.hpp"
#include "sim/ultrasound.hpp"

namespace homeward::scenario {

/// The simulated chair's range sensor: the nearest thing in each direction between the floor and head height, like
/// depth cameras whose pictures are flattened to a sweep. Its layers lie 0.015 m apart, so that no board of furniture
/// fits between two of them: a single plane at 0.3 m sees the legs of a table and not its top, and nine planes missed
/// tops by up to 0.25 m.
sim::LaserConfig safety_scanner();
/// A ring of ultrasound sensors that measures as high up.
sim::UltrasoundConfig safety_ring();

struct SimulatedRobotConfig {
  camera::CameraConfig camera;
  sim::Light light = sim::LightPreset::kDay;
  sim::RobotProfile profile = sim::disc_profile();
  sim::LaserConfig laser = safety_scanner();
  sim::UltrasoundConfig ultrasound = safety_ring();  // where the profile has it in place of the laser
  int people = 0;
  std::uint64_t seed = 1;
};

/// A robot in a simulated world: time passes when `advance` says so. Not for use from several threads.
class SimulatedRobot {
 public:
  /// `world` must outlive the robot; its light is computed on first use. Errors: kInvalidInput (camera).
  static Result<SimulatedRobot> create(sim::LitWorld& world, const SimulatedRobotConfig& config, const Pose2& start);

  void command(const driving::Motion& motion) { command_ = {motion.speed_mps, motion.turn_radps}; }
  void advance(double seconds);
  /// What a picture taken now depends on; rendering it takes long and may be done elsewhere meanwhile.
  struct View {
    Pose2 pose;
    Pose2 odometry;
    std::vector<sim::Person> people;
    std::vector<sim::Box> boxes;
    std::uint64_t noise_seed = 0;
  };
  [[nodiscard]] View view();
  [[nodiscard]] Image render(const View& view) const;
  [[nodiscard]] Image picture() { return render(view()); }
  /// Of the laser; or, with ultrasound, of what its readings up to now say.
  [[nodiscard]] driving::Scan sweep();

  [[nodiscard]] const sim::Vehicle& vehicle() const { return vehicle_; }
  /// What the wheels say.
  [[nodiscard]] Pose2 odometry() const { return lie_ * vehicle_.odometry(); }
  /// From now on this share of the way that the wheels roll is not made, 0 to 0.95.
  void slip(double share) { slip_ = share; }
  /// These boxes, and no others, stand about from now on.
  void set_boxes(std::vector<sim::Box> boxes);
  [[nodiscard]] const std::vector<sim::Person>& people() const { return walkers_.people(); }
  [[nodiscard]] double seconds() const { return seconds_; }
  /// From its body, were it at a pose, to the nearest thing or person; negative when they overlap.
  [[nodiscard]] double clearance_m(const Pose2& pose) const {
    return obstacles_.clearance_m(config_.profile, pose, walkers_.people());
  }
  /// Lifts it and puts it down elsewhere; its odometry does not notice.
  void carry_to(const Pose2& pose) { vehicle_.carry_to(pose); }
  void reset_counts() { vehicle_.reset_counts(); }

 private:
  SimulatedRobot(sim::LitWorld& world, const SimulatedRobotConfig& config, const Pose2& start,
                 const std::shared_ptr<const camera::Camera>& camera);

  sim::LitWorld* world_;
  SimulatedRobotConfig config_;
  sim::Renderer renderer_;
  sim::Obstacles obstacles_;
  sim::Walkers walkers_;
  sim::Vehicle vehicle_;
  std::vector<Pose2> ring_;
  driving::SonarMap sonar_map_;
  sim::MotionCommand command_;
  std::vector<sim::Box> boxes_;
  double slip_ = 0.0;
  Pose2 lie_;  // what slipping wheels have added to the odometry, in its frame
  double seconds_ = 0.0;
  std::uint64_t readings_ = 0;
};

/// What a robot is to another one: no smaller than its body, however it is turned to its heading.
sim::Box box_of(const SimulatedRobot& robot);

/// The body of a simulated robot as the agent knows it.
driving::Body body_of(const sim::RobotProfile& profile);

}  // namespace homeward::scenario
