// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "wire/reason.hpp"

namespace homeward::wire {

/// "waiting" (it reads what it has explored before), "exploring", "paused", "ended" (its pictures go to the server),
/// "uploaded".
enum class ExplorationPhase : std::uint8_t { kWaiting, kExploring, kPaused, kEnded, kUploaded };

/// Corners of a polygon, metres of the exploration's frame.
using Fence = std::vector<Eigen::Vector2d>;
inline constexpr std::size_t kMostFences = 100;
inline constexpr std::size_t kMostFenceCorners = 100;

/// What is known of a cell of the floor.
enum class FloorKind : std::uint8_t { kUnknown, kFree, kOccupied, kCovered };

/// The floor that was seen, as a grid of cells: columns * rows of them, row by row from the least y on.
struct FloorReport {
  double cell_m = 0.1;
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  // lower left corner
  int columns = 0;
  int rows = 0;
  std::vector<FloorKind> cells;
};

/// Another robot's exploration with which one is shared.
struct SharedExploration {
  ExplorationId exploration;
  bool joined = false;        // how its floor lies is known
  std::int64_t pictures = 0;  // of it that have arrived
};

/// How far a robot is that explores (proto/schemas/exploration.schema.json). Metres of the exploration's own frame: the
/// robot began at the origin, looking along x.
struct ExplorationReport {
  ExplorationId id;
  ExplorationPhase phase = ExplorationPhase::kWaiting;
  std::optional<Reason> reason;  // why it was paused or has ended, or what is wrong
  std::int64_t pictures = 0;
  double driven_m = 0.0;
  double explored_s = 0.0;
  std::int64_t unreached = 0;  // places that blocked ways lead to
  std::optional<Pose2> pose;   // of the robot
  std::optional<Eigen::Vector2d> target_m;
  std::vector<Eigen::Vector2d> nodes_m;   // where pictures were taken
  std::vector<std::array<int, 2>> loops;  // nodes that are one place: the later, the earlier
  std::optional<FloorReport> floor;
  std::vector<Fence> fences_m;
  double uploaded = 0.0;  // share of the pictures
  std::optional<TourId> tour;
  std::optional<SharedExploration> companion;  // nothing: it is shared with none
};

nlohmann::json exploration_to_json(const ExplorationReport& report);
/// Strict. Errors: kInvalidInput.
Result<ExplorationReport> exploration_from_json(const nlohmann::json& value, const std::string& path = "exploration");

nlohmann::json fences_to_json(const std::vector<Fence>& fences_m);
/// An array of polygons of 3 to 100 corners, at most 100. Errors: kInvalidInput.
Result<std::vector<Fence>> fences_from_json(const nlohmann::json& value, const std::string& path = "fences");

}  // namespace homeward::wire
