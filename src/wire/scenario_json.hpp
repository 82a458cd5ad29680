// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/enum_names.hpp"
#include "core/result.hpp"
#include "wire/speed_limit.hpp"

namespace homeward::wire {

/// What can go wrong during a mission.
enum class FaultKind {
  kCameraOccluded,
  kCameraFrozen,
  kScanLost,
  kLinkLost,
  kStop,
  kAgentFrozen,
  kWheelSlip,
  kObstacle,
  kKidnapped,
};

inline constexpr EnumNames<FaultKind, 9> kFaultKindNames({"camera_occluded", "camera_frozen", "scan_lost", "link_lost",
                                                          "stop", "agent_frozen", "wheel_slip", "obstacle",
                                                          "kidnapped"});

/// Something that goes wrong during a mission, for a while.
struct ScenarioFault {
  FaultKind kind = FaultKind::kCameraOccluded;
  double at_s = 0.0;
  double for_s = std::numeric_limits<double>::infinity();
  double share = 1.0;  // of the picture that is covered, of the way that is not made
};

/// How the robot finds its way: from view to view of a map, or along a path that was taught (Segvic et al. 2007).
enum class ScenarioMode { kHome, kRepeat };
inline constexpr EnumNames<ScenarioMode, 2> kScenarioModeNames({"home", "repeat"});

/// What a path is repeated by: the way that was taught, features that move to where the next key image has them, or
/// headings alone.
enum class RepeatSteering { kWay, kFeatures, kHeading };
inline constexpr EnumNames<RepeatSteering, 3> kRepeatSteeringNames({"way", "features", "heading"});

/// One entry of "missions": from room to room, or `random` of them.
struct ScenarioMission {
  std::string from;
  std::string to;
  int random = 0;  // > 0: so many missions between rooms drawn at random
  std::string light = "day";
  int people = 0;
  int moved_furniture = 0;  // pieces in each room
  /// What somebody says when the robot asks whether it is at its destination: "nobody", "right" (the truth) or "yes".
  std::string answers = "nobody";
  std::vector<ScenarioFault> faults;
  // Of the mode "repeat": so often, each time begun so far, at most, beside where the tour was at `from`, and turned.
  int times = 1;
  double start_beside_m = 0.0;
  double start_turned_rad = 0.0;
  RepeatSteering steering = RepeatSteering::kWay;
  int rounds = 0;  // where the path is closed: so often it passes `to` first
};

/// A closed-loop scenario (proto/schemas/scenario.schema.json), format "homeward-scenario", version 1.
struct ScenarioFile {
  std::string world;  // as load_world takes it; a world.json is relative to the scenario
  std::int64_t seed = 1;
  ScenarioMode mode = ScenarioMode::kHome;
  std::string camera_model;                    // the usual camera of this model ...
  std::optional<camera::CameraConfig> camera;  // ... or a whole camera ...
  std::string camera_file;                     // ... or a camera.json relative to the scenario
  std::string robot = "disc";                  // "disc" or "chair"
  std::string ranges = "laser";                // or "ultrasound"
  double speed_limit_mps = kSpeedLimit_mps;    // of its missions
  std::vector<std::string> tour_rooms;
  bool tours_all_rooms = false;  // in place of `tour_rooms`: every room of the world, the next always the nearest one
  bool tour_explored = false;    // nobody leads: the robot explores by itself, and every room is a destination
  std::string tour_light = "day";
  double tour_step_m = 0.4;
  bool tour_shortcuts = false;  // all that are proposed after the tour are accepted
  std::vector<ScenarioMission> missions;
};

/// LEVEL of the light "daylight:LEVEL", from 0 to 1 in plain decimals; nothing of any other text.
std::optional<double> daylight_of(const std::string& light);

/// Strict. Errors: kInvalidInput, kUnsupportedFormat; each names the field.
Result<ScenarioFile> scenario_from_json(const nlohmann::json& value, const std::string& path = "scenario");
Result<ScenarioFile> parse_scenario(const std::string& text, const std::string& where);

}  // namespace homeward::wire
