// SPDX-License-Identifier: Apache-2.0
#include "sim/motion.hpp"

#include <algorithm>
#include <cmath>

#include "sim/floor.hpp"

namespace homeward::sim {
namespace {

double towards(double now, double wanted, double rise, double fall) {
  const bool slows = std::abs(wanted) < std::abs(now) || now * wanted < 0.0;
  const double step = slows ? fall : rise;
  return now + std::clamp(wanted - now, -step, step);
}

double centred(std::mt19937_64& random) {  // uniform in [-1, 1)
  return 2.0 * static_cast<double>(random() >> 11U) * 0x1.0p-53 - 1.0;
}

/// Where constant speed and turn rate lead to within dt.
Pose2 along_arc(const Pose2& pose, double length_m, double turn_rad) {
  const double middle_rad = 0.5 * turn_rad;
  const double chord_m = std::abs(middle_rad) < 1e-9 ? length_m : length_m * std::sin(middle_rad) / middle_rad;
  return pose * Pose2{chord_m * std::cos(middle_rad), chord_m * std::sin(middle_rad), turn_rad};
}

}  // namespace

RobotProfile disc_profile() {
  RobotProfile profile;
  profile.name = "disc";
  return profile;
}

RobotProfile chair_profile() {
  RobotProfile profile;
  profile.name = "chair";
  profile.radius_m = 0.34;
  profile.disc_x_m = {0.075, 0.2, 0.35, 0.525};
  return profile;
}

Obstacles::Obstacles(const World& world) : grid_(world.occupied), distance_m_(clearance(world.occupied)) {}

std::optional<double> Obstacles::distance_at(const Eigen::Vector2d& point_m) const {
  const Eigen::Vector2d first_m = centre_of(grid_, {0, 0});
  const Eigen::Vector2d step_m = centre_of(grid_, {1, 1}) - first_m;  // rows may run down
  const Eigen::Array2d cells = (point_m - first_m).array() / step_m.array();
  const Eigen::Array2i low = cells.floor().cast<int>();
  if ((low < 0).any() || low.x() + 1 >= grid_.width || low.y() + 1 >= grid_.height) return std::nullopt;
  const Eigen::Array2d share = cells - low.cast<double>();
  const auto at = [&](int right, int up) {
    const auto row = static_cast<std::size_t>(low.y() + up) * static_cast<std::size_t>(grid_.width);
    return static_cast<double>(distance_m_[row + static_cast<std::size_t>(low.x() + right)]);
  };
  return (1.0 - share.y()) * ((1.0 - share.x()) * at(0, 0) + share.x() * at(1, 0)) +
         share.y() * ((1.0 - share.x()) * at(0, 1) + share.x() * at(1, 1));
}

double Obstacles::clearance_m(const RobotProfile& robot, const Pose2& pose, const std::vector<Person>& people) const {
  double nearest_m = 1e9;
  for (const double x_m : robot.disc_x_m) {
    const Pose2 disc = pose * Pose2{x_m, 0.0, 0.0};
    const auto distance_m = distance_at({disc.x_m, disc.y_m});
    if (!distance_m) return -1.0;
    // Things are known to half a cell.
    nearest_m = std::min(nearest_m, *distance_m - 0.5 * grid_.resolution_m - robot.radius_m);
    for (const Person& person : people) {
      const double apart_m = std::hypot(person.x_m - disc.x_m, person.y_m - disc.y_m);
      nearest_m = std::min(nearest_m, apart_m - kPersonRadius_m - robot.radius_m);
    }
  }
  return nearest_m;
}

WheelOdometry::WheelOdometry(std::uint64_t seed) : random_(seed) {
  slip_ = 1.0 + 0.01 * centred(random_);
  drift_rad_per_m_ = 0.008 * centred(random_);
}

void WheelOdometry::follow(const Pose2& from, const Pose2& to) {
  const Pose2 step = inverse(from) * to;
  const double length_m = std::hypot(step.x_m, step.y_m);
  const double scale = slip_ * (1.0 + 0.02 * centred(random_));
  const double error_rad =
      length_m * (drift_rad_per_m_ + 0.02 * centred(random_)) + step.theta_rad * 0.01 * centred(random_);
  reading_ = reading_ * Pose2{scale * step.x_m, scale * step.y_m, step.theta_rad + error_rad};
}

Vehicle::Vehicle(RobotProfile profile, const Pose2& start, std::uint64_t odometry_seed)
    : profile_(std::move(profile)), pose_(start), odometry_(odometry_seed) {}

void Vehicle::advance(double dt_s, const MotionCommand& command, const Obstacles& obstacles,
                      const std::vector<Person>& people) {
  const double speed = std::clamp(command.speed_mps, -0.3 * profile_.max_speed_mps, profile_.max_speed_mps);
  const double turn = std::clamp(command.turn_radps, -profile_.max_turn_radps, profile_.max_turn_radps);
  motion_.speed_mps =
      towards(motion_.speed_mps, speed, profile_.acceleration_mps2 * dt_s, profile_.deceleration_mps2 * dt_s);
  motion_.turn_radps = towards(motion_.turn_radps, turn, profile_.turn_acceleration_radps2 * dt_s,
                               profile_.turn_deceleration_radps2 * dt_s);
  const double length_m = motion_.speed_mps * dt_s;
  const double turned_rad = motion_.turn_radps * dt_s;
  if (length_m == 0.0 && turned_rad == 0.0) {
    touching_ = false;
    return;
  }
  const Pose2 next = along_arc(pose_, length_m, turned_rad);
  const double before_m = obstacles.clearance_m(profile_, pose_, people);
  const double clearance_m = obstacles.clearance_m(profile_, next, people);
  min_clearance_m_ = std::min(min_clearance_m_, clearance_m);
  if (clearance_m <= 0.0 && clearance_m < before_m) {
    if (!touching_) ++collisions_;
    touching_ = true;
    motion_ = {};
    return;
  }
  // Coming to rest against a thing in ever smaller steps is one collision.
  constexpr double kApart_m = 0.05;
  touching_ = touching_ && clearance_m < kApart_m;
  odometry_.follow(pose_, next);
  pose_ = next;
  path_m_ += std::abs(length_m);
}

void Vehicle::carry_to(const Pose2& pose) {
  pose_ = pose;
  motion_ = {};
}

void Vehicle::reset_counts() {
  collisions_ = 0;
  path_m_ = 0.0;
  min_clearance_m_ = 1e9;
}

}  // namespace homeward::sim
