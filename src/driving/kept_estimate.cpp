// SPDX-License-Identifier: Apache-2.0
#include "driving/kept_estimate.hpp"

namespace homeward::driving {

std::optional<KeptEstimate> keep_estimate(const FollowState& follow, const VisualPath& path, const MapId& map,
                                          std::int64_t revision, std::int64_t now_ms) {
  if (!follow.begun || path.alone() || path.index == nullptr || follow.hypotheses.empty()) return std::nullopt;
  return KeptEstimate{map, revision, follow.hypotheses, follow.odometry, now_ms};
}

FollowState begun_from(const std::optional<KeptEstimate>& kept, const VisualPath& path, const MapId& map,
                       std::int64_t revision, const FollowConfig& config, std::int64_t now_ms, std::int64_t lives_ms) {
  constexpr double kOdds = 3.0;
  constexpr double kWithin_m = 2.0;
  if (!kept || path.alone() || path.index == nullptr) return {};
  if (kept->map != map || kept->revision != revision || now_ms - kept->at_ms > lives_ms) return {};
  FollowState follow;
  const PoseHypotheses& known = kept->hypotheses;
  follow.hypotheses = PoseHypotheses(config.pose, known.all(), known.elsewhere(), known.unweighed_m());
  const Pose2& begins = path.pose(0);
  follow.hypotheses.apply_odds(Eigen::Vector2d(begins.x_m, begins.y_m), kWithin_m, kOdds,
                               std::min(kMostByOthers, path.start_probability));
  follow.odometry = kept->odometry;
  follow.ways_seen_from = kept->odometry;  // what stands on them has been weighed
  follow.begun = true;
  return follow;
}

}  // namespace homeward::driving
