// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/outline.hpp"
#include "core/pose2.hpp"
#include "sim/box.hpp"
#include "sim/floor_plan.hpp"
#include "sim/people.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

enum class RangeSensor { kLaser, kUltrasound };

/// What a robot is like: what it covers of the floor, how it measures ranges, and how it moves.
struct RobotProfile {
  std::string name;
  Outline outline;
  RangeSensor ranges = RangeSensor::kLaser;
  double max_speed_mps = 0.8;
  double max_turn_radps = 1.2;
  double acceleration_mps2 = 0.5;
  double deceleration_mps2 = 1.0;
  double turn_acceleration_radps2 = 2.5;
  double turn_deceleration_radps2 = 5.0;
};
/// A disc of 0.35 m radius.
RobotProfile disc_profile();
/// A wheelchair of 1.10 m x 0.65 m that turns about its rear axle, 0.25 m before its back.
RobotProfile chair_profile();

struct MotionCommand {
  double speed_mps = 0.0;
  double turn_radps = 0.0;
};

/// Distances to what stands in a world, for bodies that drive there.
class Obstacles {
 public:
  explicit Obstacles(const World& world);
  /// These boxes, and no others, stand about besides.
  void set_boxes(const std::vector<Box>& boxes);
  /// From the body's outline to the nearest thing or person, metres; negative when they overlap.
  [[nodiscard]] double clearance_m(const RobotProfile& robot, const Pose2& pose,
                                   const std::vector<Person>& people) const;
  /// To the nearest cell of the floor on which something of the world stands, for what should keep clear of things: up
  /// to 0.07 m less than there is, at most 0.01 m more.
  [[nodiscard]] double clearance_of_cells_m(const RobotProfile& robot, const Pose2& pose) const;

 private:
  /// To the nearest occupied cell's centre, between the cells' centres interpolated; nothing outside the grid.
  [[nodiscard]] std::optional<double> distance_at(const Eigen::Vector2d& point_m) const;
  /// From an outline that is not round to the nearest thing.
  [[nodiscard]] double clearance_of_box_m(const Outline& outline, const Pose2& pose) const;

  FloorGrid grid_;
  std::vector<float> distance_m_;
  FloorPlan world_;
  FloorPlan boxes_;
};

/// What wheels say about the way: starts at zero, drifts with slip of about 1 % in length and 1 degree a metre in
/// heading.
class WheelOdometry {
 public:
  explicit WheelOdometry(std::uint64_t seed);
  /// The robot went from one pose to a near one.
  void follow(const Pose2& from, const Pose2& to);
  [[nodiscard]] const Pose2& reading() const { return reading_; }

 private:
  std::mt19937_64 random_;
  double slip_;
  double drift_rad_per_m_;
  Pose2 reading_;
};

/// A differential drive with bounded acceleration. It cannot drive through things: contact ends the motion, and contact
/// while it moves by itself is a collision.
class Vehicle {
 public:
  Vehicle(RobotProfile profile, const Pose2& start, std::uint64_t odometry_seed);

  void advance(double dt_s, const MotionCommand& command, const Obstacles& obstacles,
               const std::vector<Person>& people);

  [[nodiscard]] const Pose2& pose() const { return pose_; }
  [[nodiscard]] const Pose2& odometry() const { return odometry_.reading(); }
  [[nodiscard]] const MotionCommand& motion() const { return motion_; }
  [[nodiscard]] int collisions() const { return collisions_; }
  [[nodiscard]] double path_m() const { return path_m_; }
  [[nodiscard]] double min_clearance_m() const { return min_clearance_m_; }
  [[nodiscard]] const RobotProfile& profile() const { return profile_; }
  /// Puts it down somewhere else, at rest; odometry goes on as if nothing had happened, and neither way nor contact is
  /// counted.
  void carry_to(const Pose2& pose);
  /// Counts collisions, way and clearance from nothing again.
  void reset_counts();

 private:
  RobotProfile profile_;
  Pose2 pose_;
  WheelOdometry odometry_;
  MotionCommand motion_;
  bool touching_ = false;
  int collisions_ = 0;
  double path_m_ = 0.0;
  double min_clearance_m_ = 1e9;
};

}  // namespace homeward::sim
