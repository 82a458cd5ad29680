// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "driving/body.hpp"
#include "driving/scan.hpp"
#include "wire/rosbridge_json.hpp"

namespace homeward::agent {

/// What the rosbridge protocol (version 2, "ROSBRIDGE_PROTOCOL.md" of RobotWebTools/rosbridge_suite) carries between a
/// robot and the agent. Stamps are microseconds by the robot's clock; nothing when the header's stamp is zero.
using RosStamp = std::optional<std::int64_t>;

struct RosSweep {
  RosStamp stamp_us;
  driving::Scan scan;         // returns nearer than `range_min` count where they lie outside of the robot's body
  double blind_beyond_m = 0;  // so far beyond the body reaches what is nearer than `range_min`
};
struct RosOdometry {
  RosStamp stamp_us;
  Pose2 pose;
  double speed_mps = 0.0;
};
struct RosPicture {
  RosStamp stamp_us;
  std::vector<std::uint8_t> bytes;  // a JPEG or PNG, not looked at
};
struct RosRange {
  RosStamp stamp_us;
  std::size_t sensor = 0;    // in the file's `ranges`
  float range_m = 0.0F;      // of the nearest thing, `range_min_m` where it is nearer; infinite: none within reach
  float range_min_m = 0.0F;  // that it can measure
};
struct RosTwist {  // of the rider's joystick
  RosStamp stamp_us;
  driving::Motion motion;
};
struct RosEcho {  // of what was published for the wheels, by the agent or somebody else
  driving::Motion motion;
};
struct RosStatus {
  std::string level;  // "error", "warning", "info" or "none"
  std::string text;
};
struct RosOther {};  // a message that the agent has no use for
using RosMessage = std::variant<RosOther, RosSweep, RosRange, RosOdometry, RosPicture, RosTwist, RosEcho, RosStatus>;

inline constexpr std::size_t kMaxRosMessageBytes = 16UL * 1024 * 1024;
inline constexpr std::size_t kMaxRosRanges = 20'000;

/// A text from the bridge. Of a sweep, a range that is null, not finite or below the sensor's least saw nothing. The
/// range of a single sensor must be a number: a bridge writes null for minus infinity too, which REP 117 says of what
/// is too near. Errors: kInvalidInput, kTooLarge; each names the field.
Result<RosMessage> decode_ros_message(std::string_view text, const wire::RosbridgeFile& robot);

/// Whether messages of this type bear a header.
bool is_stamped(const std::string& type);

/// The robot's body, its outline as it is.
driving::Body body_of(const wire::RosBody& outline);

}  // namespace homeward::agent
