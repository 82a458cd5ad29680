// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "driving/driving_config.hpp"
#include "driving/visual_path.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// One mission that was permitted.
struct Mission {
  MissionId id;
  MapId map;
  std::int64_t revision = 0;
  std::string label;
  VisualPath path;
  bool dock = false;
  double speed_limit_mps = 0.0;
  bool explores = false;  // drives to the legs that it is given (leg.hpp); it has no path and no map
  bool repeats = false;   // follows what its inputs say of a path that was taught (repeat_path.hpp); it has no views
  /// Whether it homes from view to view of a map.
  [[nodiscard]] bool homes() const { return !explores && !repeats; }
};

/// A mission as `step` needs it, its views decoded. Errors: kFeatureConfigMismatch, kCorruptFile,
/// kUnsupportedFormat.
Result<Mission> decode_mission(const wire::MissionOrder& order, const DrivingConfig& config);

}  // namespace homeward::driving
