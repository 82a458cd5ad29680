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
  profile.outline = {0.0, 0.25, 0.85, 0.325};
  return profile;
}

Obstacles::Obstacles(const World& world)
    : grid_(world.occupied), distance_m_(clearance(world.occupied)), world_(world.scene), boxes_(Scene()) {}

void Obstacles::set_boxes(const std::vector<Box>& boxes) {
  boxes_ = FloorPlan(Scene());
  for (const Box& box : boxes) boxes_.add(box);
}

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

double Obstacles::clearance_of_box_m(const Outline& outline, const Pose2& pose) const {
  for (const double x_m : {-outline.back_m, outline.front_m}) {
    for (const double y_m : {-outline.side_m, outline.side_m}) {
      const Pose2 corner = pose * Pose2{x_m, y_m, 0.0};
      if (!distance_at({corner.x_m, corner.y_m})) return -1.0;
    }
  }
  const Pose2 middle = pose * Pose2{0.5 * (outline.front_m - outline.back_m), 0.0, 0.0};
  const auto from_middle_m = distance_at({middle.x_m, middle.y_m});
  if (!from_middle_m) return -1.0;
  // The cell nearest to the middle bounds how far from it the cell nearest to the outline can be.
  const double half_length_m = 0.5 * (outline.front_m + outline.back_m);
  const double reach_m = *from_middle_m + grid_.resolution_m - std::min(half_length_m, outline.side_m) +
                         std::hypot(half_length_m, outline.side_m);
  const Eigen::Vector2i centre = cell_of(grid_, {middle.x_m, middle.y_m});
  const int reach = static_cast<int>(std::ceil(reach_m / grid_.resolution_m));
  const Pose2 from_world = inverse(pose);
  const double c = std::cos(from_world.theta_rad);
  const double s = std::sin(from_world.theta_rad);
  double nearest_m = 1e9;
  for (int row = std::max(0, centre.y() - reach); row <= std::min(grid_.height - 1, centre.y() + reach); ++row) {
    for (int column = std::max(0, centre.x() - reach); column <= std::min(grid_.width - 1, centre.x() + reach);
         ++column) {
      const auto slot = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.width);
      if (grid_.cells[slot + static_cast<std::size_t>(column)] == 0) continue;
      const Eigen::Vector2d at_m = centre_of(grid_, {column, row});
      const Eigen::Vector2d seen_m(from_world.x_m + c * at_m.x() - s * at_m.y(),
                                   from_world.y_m + s * at_m.x() + c * at_m.y());
      nearest_m = std::min(nearest_m, distance_m(outline, seen_m));
    }
  }
  return nearest_m;
}

double Obstacles::clearance_of_cells_m(const RobotProfile& robot, const Pose2& pose) const {
  double thing_m = -1.0;
  if (is_round(robot.outline)) {
    const auto distance = distance_at({pose.x_m, pose.y_m});
    if (!distance) return -1.0;
    thing_m = *distance - robot.outline.radius_m;
  } else {
    thing_m = clearance_of_box_m(robot.outline, pose);
    if (thing_m == -1.0) return thing_m;
  }
  return thing_m - 0.5 * grid_.resolution_m;
}

double Obstacles::clearance_m(const RobotProfile& robot, const Pose2& pose, const std::vector<Person>& people) const {
  const double cells_m = clearance_of_cells_m(robot, pose);
  if (cells_m == -1.0) return cells_m;
  // Somewhere on the nearest cell something stands.
  const double far_m = cells_m + 2.0 * grid_.resolution_m;
  double nearest_m = boxes_.clearance_m(robot.outline, pose, world_.clearance_m(robot.outline, pose, far_m));
  for (const Person& person : people) {
    const Pose2 seen = inverse(pose) * Pose2{person.x_m, person.y_m, 0.0};
    nearest_m = std::min(nearest_m, distance_m(robot.outline, {seen.x_m, seen.y_m}) - kPersonRadius_m);
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
  const double clearance_m = obstacles.clearance_m(profile_, next, people);
  min_clearance_m_ = std::min(min_clearance_m_, clearance_m);
  if (clearance_m <= 0.0 && clearance_m < obstacles.clearance_m(profile_, pose_, people)) {
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
  touching_ = false;
}

void Vehicle::reset_counts() {
  collisions_ = 0;
  path_m_ = 0.0;
  min_clearance_m_ = 1e9;
}

}  // namespace homeward::sim
