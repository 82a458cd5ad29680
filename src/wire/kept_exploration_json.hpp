// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "wire/exploration_json.hpp"

namespace homeward::wire {

/// A place that was given up, beside a picture (exploration::Explorer::Spot).
struct KeptSpot {
  std::int64_t view = 0;
  Eigen::Vector2d seen_from_view_m = Eigen::Vector2d::Zero();  // frame of the robot at that picture
  friend bool operator==(const KeptSpot&, const KeptSpot&) = default;
};

/// What a robot keeps of an exploration beside its views (proto/schemas/kept_exploration.schema.json).
struct KeptExploration {
  ExplorationId id;  // can_name_folder
  TimeUs begun_us = 0;
  std::vector<Fence> fences_m;
  std::vector<KeptSpot> given_up;  // in the order in which they were
  bool ended = false;
  std::optional<Reason> reason;                 // why it ended
  std::optional<TourId> tour;                   // that its pictures are on the server
  std::optional<ExplorationId> companion = {};  // of another robot, with which it is shared
};

/// What it keeps of one picture of it (proto/schemas/kept_view.schema.json).
struct KeptView {
  TimeUs t_us = 0;
  Pose2 odometry;
  std::optional<Pose2> odometry_moved;  // exploration::Explorer::move_odometry, since the picture before
  RangeSweep sweep;
  double driven_m = 0.0;
  double explored_s = 0.0;
};

/// Letters, digits, "_" and "-" alone: an id from elsewhere must not lead out of a folder.
bool can_name_folder(const ExplorationId& id);

nlohmann::json kept_exploration_to_json(const KeptExploration& kept);
nlohmann::json kept_view_to_json(const KeptView& view);

/// Strict. Errors: kInvalidInput, kUnsupportedFormat.
Result<KeptExploration> kept_exploration_from_json(const nlohmann::json& value,
                                                   const std::string& path = "exploration");
Result<KeptView> kept_view_from_json(const nlohmann::json& value, const std::string& path = "view");

}  // namespace homeward::wire
