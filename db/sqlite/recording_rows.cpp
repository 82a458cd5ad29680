// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/recording_rows.hpp"

#include <array>

#include "core/bytes.hpp"

namespace homeward::db {
namespace {

constexpr std::uint8_t kHasVector = 1;
constexpr std::uint8_t kHasMinRange = 2;
constexpr std::uint8_t kHasNearness = 4;
constexpr std::uint8_t kHasRider = 8;
constexpr std::uint8_t kRobotLinkDown = 16;
constexpr std::uint8_t kHasLeg = 32;
constexpr std::uint8_t kExplorationOver = 64;
constexpr std::uint8_t kRepeats = 128;  // what a path says follows at the end
// Of those.
constexpr std::uint8_t kHasPathSight = 1;
constexpr std::uint8_t kLost = 2;
constexpr std::uint8_t kEnds = 4;
constexpr std::uint8_t kLeadsElsewhere = 8;
constexpr std::uint8_t kPathUnusable = 16;
constexpr std::uint32_t kMostPoses = 100'000;

bool get_rider(ByteReader& reader, RecordedRider& rider) {
  std::uint8_t deflected = 0;
  if (!reader.get(&rider.said_ms) || !reader.get(&deflected) || deflected > 1 || !reader.get(&rider.speed_mps) ||
      !reader.get(&rider.turn_radps)) {
    return false;
  }
  rider.deflected = deflected == 1;
  return true;
}

bool get_leg(ByteReader& reader, RecordedLeg& leg) {
  return reader.get(&leg.goal_x_m) && reader.get(&leg.goal_y_m) && reader.get(&leg.within_m);
}

void put_pose(ByteWriter& writer, const Pose2& pose) {
  writer.put(pose.x_m);
  writer.put(pose.y_m);
  writer.put(pose.theta_rad);
}

bool get_pose(ByteReader& reader, Pose2& pose) {
  return reader.get(&pose.x_m) && reader.get(&pose.y_m) && reader.get(&pose.theta_rad);
}

void put_path(ByteWriter& writer, const RecordedStep& step) {
  const RecordedPathSight sight = step.path_sight.value_or(RecordedPathSight{});
  writer.put(static_cast<std::uint8_t>((step.path_sight ? kHasPathSight : 0) | (sight.lost ? kLost : 0) |
                                       (sight.ends ? kEnds : 0) | (sight.leads_elsewhere ? kLeadsElsewhere : 0) |
                                       (step.path_unusable ? kPathUnusable : 0)));
  if (!step.path_sight) return;
  writer.put(sight.taken_ms);
  put_pose(writer, sight.odometry);
  writer.put(sight.arc);
  writer.put(sight.tracked);
  writer.put(sight.confidence);
  writer.put(sight.steering_rad);
  writer.put(static_cast<std::uint32_t>(sight.way.size()));
  for (const Pose2& pose : sight.way) put_pose(writer, pose);
}

bool get_path(ByteReader& reader, RecordedStep& step) {
  std::uint8_t flags = 0;
  if (!reader.get(&flags)) return false;
  step.path_unusable = (flags & kPathUnusable) != 0;
  if ((flags & kHasPathSight) == 0) return true;
  RecordedPathSight& sight = step.path_sight.emplace();
  sight.lost = (flags & kLost) != 0;
  sight.ends = (flags & kEnds) != 0;
  sight.leads_elsewhere = (flags & kLeadsElsewhere) != 0;
  std::uint32_t poses = 0;
  if (!reader.get(&sight.taken_ms) || !get_pose(reader, sight.odometry) || !reader.get(&sight.arc) ||
      !reader.get(&sight.tracked) || !reader.get(&sight.confidence) || !reader.get(&sight.steering_rad) ||
      !reader.get(&poses) || poses > kMostPoses) {
    return false;
  }
  for (std::uint32_t i = 0; i < poses; ++i) {
    if (!get_pose(reader, sight.way.emplace_back())) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> pack_step(const RecordedStep& step) {
  const RecordedVector vector = step.vector.value_or(RecordedVector{});
  const std::array<double, 11> numbers = {step.odometry.x_m,
                                          step.odometry.y_m,
                                          step.odometry.theta_rad,
                                          step.speed_mps,
                                          step.turn_radps,
                                          vector.bearing_rad,
                                          vector.turn_rad,
                                          vector.confidence,
                                          vector.parallax_rad,
                                          vector.nearness.value_or(0.0),
                                          step.min_range_m.value_or(0.0)};
  ByteWriter writer;
  writer.put(static_cast<std::uint8_t>(
      (step.vector ? kHasVector : 0) | (step.min_range_m ? kHasMinRange : 0) | (vector.nearness ? kHasNearness : 0) |
      (step.rider ? kHasRider : 0) | (step.robot_link_up ? 0 : kRobotLinkDown) | (step.leg ? kHasLeg : 0) |
      (step.exploration_over ? kExplorationOver : 0) | (step.path_sight || step.path_unusable ? kRepeats : 0)));
  writer.put(numbers.data(), numbers.size());
  writer.put(vector.matches);
  writer.put(vector.inliers);
  if (step.rider) {
    writer.put(step.rider->said_ms);
    writer.put(static_cast<std::uint8_t>(step.rider->deflected ? 1 : 0));
    writer.put(step.rider->speed_mps);
    writer.put(step.rider->turn_radps);
  }
  if (step.leg) {
    writer.put(step.leg->goal_x_m);
    writer.put(step.leg->goal_y_m);
    writer.put(step.leg->within_m);
  }
  if (step.path_sight || step.path_unusable) put_path(writer, step);
  return writer.take();
}

bool unpack_step(std::span<const std::uint8_t> bytes, RecordedStep& step) {
  ByteReader reader(bytes);
  std::uint8_t flags = 0;
  std::array<double, 11> n{};
  RecordedVector vector;
  RecordedRider rider;
  if (!reader.get(&flags) || !reader.get(n.data(), n.size()) || !reader.get(&vector.matches) ||
      !reader.get(&vector.inliers)) {
    return false;
  }
  if ((flags & kHasRider) != 0) {
    if (!get_rider(reader, rider)) return false;
    step.rider = rider;
  }
  if ((flags & kHasLeg) != 0 && !get_leg(reader, step.leg.emplace())) return false;
  step.exploration_over = (flags & kExplorationOver) != 0;
  if ((flags & kRepeats) != 0 && !get_path(reader, step)) return false;
  if (reader.left() != 0) return false;
  step.odometry = {n[0], n[1], n[2]};
  step.speed_mps = n[3];
  step.turn_radps = n[4];
  vector.bearing_rad = n[5];
  vector.turn_rad = n[6];
  vector.confidence = n[7];
  vector.parallax_rad = n[8];
  if ((flags & kHasNearness) != 0) vector.nearness = n[9];
  if ((flags & kHasVector) != 0) step.vector = vector;
  if ((flags & kHasMinRange) != 0) step.min_range_m = n[10];
  step.robot_link_up = (flags & kRobotLinkDown) == 0;
  return true;
}

std::vector<std::uint8_t> pack_pose(const Pose2& pose) {
  ByteWriter writer;
  put_pose(writer, pose);
  return writer.take();
}

bool unpack_pose(std::span<const std::uint8_t> bytes, Pose2& pose) {
  ByteReader reader(bytes);
  return get_pose(reader, pose) && reader.left() == 0;
}

std::vector<std::uint8_t> pack_sweep(const RecordedSweep& sweep) {
  ByteWriter writer;
  writer.put(sweep.angle_min_rad);
  writer.put(sweep.angle_step_rad);
  writer.put(sweep.range_max_m);
  put_pose(writer, sweep.robot_from_scan);
  writer.put(sweep.ranges_m.data(), sweep.ranges_m.size());
  return writer.take();
}

bool unpack_sweep(std::span<const std::uint8_t> bytes, RecordedSweep& sweep) {
  ByteReader reader(bytes);
  if (!reader.get(&sweep.angle_min_rad) || !reader.get(&sweep.angle_step_rad) || !reader.get(&sweep.range_max_m) ||
      !get_pose(reader, sweep.robot_from_scan)) {
    return false;
  }
  if (reader.left() % sizeof(float) != 0) return false;
  sweep.ranges_m.resize(reader.left() / sizeof(float));
  return reader.get(sweep.ranges_m.data(), sweep.ranges_m.size());
}

std::string_view message_type(const wire::ServerMessage& message) {
  constexpr std::array<std::string_view, 14> kNames = {
      "welcome", "mission", "permit", "stop",      "belief",         "answer",          "explore",
      "repeat",  "fences",  "finish", "companion", "companion_view", "companion_state", "error"};
  static_assert(std::variant_size_v<wire::ServerMessage> == kNames.size());
  return kNames[message.index()];
}

std::string_view message_type(const wire::AgentMessage& message) {
  constexpr std::array<std::string_view, 8> kNames = {
      "hello", "frame", "status", "stopped", "mission_refused", "explored", "companion_view", "companion_state"};
  static_assert(std::variant_size_v<wire::AgentMessage> == kNames.size());
  return kNames[message.index()];
}

}  // namespace homeward::db
