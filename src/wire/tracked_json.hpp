// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"

namespace homeward::wire {

/// A pose on a plan that is believed.
struct BelievedPose {
  Pose2 pose;
  double probability = 0.0;
};

/// One line of what `homeward track` prints (proto/schemas/tracked.schema.json).
struct TrackedView {
  std::string image;
  Pose2 pose;
  double spread_m = 0.0;
  int particles = 0;
  int lines_seen = 0;
  int lines_expected = 0;
  int lines_confirmed = 0;
  double evidence = 0.0;
  std::string lost;  // why; empty: it is not
  std::vector<BelievedPose> may_be;
  double ms = 0.0;
};

nlohmann::json tracked_to_json(const TrackedView& view);

/// What such a line says of where its picture was taken.
struct TrackedPose {
  std::string image;
  std::optional<Pose2> pose;  // nothing: lost
  double spread_m = 0.0;      // means nothing while lost
};

/// Errors: kInvalidInput, with the path of the field below `path`; other fields of a line are not looked at.
Result<TrackedPose> tracked_pose_from_json(const nlohmann::json& value, const std::string& path);

}  // namespace homeward::wire
