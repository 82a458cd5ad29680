// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/ids.hpp"
#include "driving/follow_config.hpp"
#include "driving/follow_state.hpp"
#include "driving/visual_path.hpp"

namespace homeward::driving {

/// Where a robot was by its estimate when it drove last, for the next mission of the same map.
struct KeptEstimate {
  MapId map;
  std::int64_t revision = 0;
  PoseHypotheses hypotheses;
  Pose2 odometry;
  std::int64_t at_ms = 0;
};

/// What is kept of a drive: the estimate, where the map knows where its places lie.
std::optional<KeptEstimate> keep_estimate(const FollowState& follow, const VisualPath& path, const MapId& map,
                                          std::int64_t revision, std::int64_t now_ms);

/// How the next mission begins: with the kept estimate, where that is of the same map and at most `lives_ms` old; that
/// the path begins elsewhere is by somebody who has seen the same pictures. Else with nothing known.
/// Ours, because orders that follow each other are one drive.
FollowState begun_from(const std::optional<KeptEstimate>& kept, const VisualPath& path, const MapId& map,
                       std::int64_t revision, const FollowConfig& config, std::int64_t now_ms, std::int64_t lives_ms);

}  // namespace homeward::driving
