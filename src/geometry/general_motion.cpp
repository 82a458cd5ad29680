// SPDX-License-Identifier: Apache-2.0
#include "geometry/general_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/estimate_summary.hpp"
#include "geometry/five_point.hpp"
#include "geometry/repetition.hpp"

namespace homeward::geometry {
namespace {

/// The same motion by its angles.
TiltedMotion tilted(const ViewMotion& motion) {
  const Eigen::Matrix3d& rotation = motion.current_from_target;
  const Eigen::Vector3d& direction = motion.target_in_current;
  return {{std::atan2(direction.y(), direction.x()), std::atan2(rotation(1, 0), rotation(0, 0))},
          std::asin(std::clamp(direction.z(), -1.0, 1.0)),
          std::atan2(rotation(2, 1), rotation(2, 2)),
          -std::asin(std::clamp(rotation(2, 0), -1.0, 1.0))};
}

/// The likeliest general motion with its evidence.
Result<PlanarEstimate> estimate_general(std::span<const Correspondence> correspondences, const GeneralConfig& config,
                                        std::uint64_t seed) {
  FitConfig fit_config;
  fit_config.start_spread_rad = 0.5 * config.planar.max_error_rad;
  fit_config.most_spread_rad = 0.75 * config.planar.max_error_rad;
  fit_config.tilt = config.tilt;
  const MatchRows matches(correspondences);
  std::optional<MotionFit> best;
  const FivePointConfig search{config.max_iterations, config.sure_enough, config.planar.max_error_rad};
  for (const EssentialCandidate& candidate : search_essentials(correspondences, search, seed)) {
    for (const ViewMotion& motion : motions_of(candidate.essential)) {
      MotionFit fit = fit_motion(matches, tilted(motion), fit_config);
      if (!best || fit.log_likelihood > best->log_likelihood) best = std::move(fit);
    }
  }
  if (!best) return fail(ErrorCode::kTooLittleSupport, "No general motion explains more than five matches.");
  // Five matches fit by construction, and every other five could have been tried.
  const auto size = static_cast<double>(correspondences.size());
  const double tries = std::lgamma(size + 1.0) - std::lgamma(size - kFivePointSample + 1.0) -
                       std::lgamma(kFivePointSample + 1.0) + std::log(static_cast<double>(kFivePointSolutions));
  const SharedView view = shared_view(correspondences, *best);
  const double evidence =
      (1.0 - repetition_probability(view)) * (best->log_likelihood - kFivePointSample * best->greatest_gain - tries);
  auto estimate = summarise(correspondences, std::move(*best), config.planar.max_error_rad);
  if (!estimate) return estimate;
  estimate->evidence = evidence;
  estimate->height = view.height;
  estimate->agreeing = view.agreeing;
  estimate->general = true;
  return estimate;
}

Result<PlanarEstimate> estimate_of_finite(std::span<const Correspondence> correspondences, const GeneralConfig& config,
                                          std::uint64_t seed) {
  auto planar = estimate_planar_motion(correspondences, config.planar, seed);
  const auto count = static_cast<double>(correspondences.size());
  const bool weak = !planar || planar->evidence < config.weak_evidence ||
                    static_cast<double>(planar->inliers.size()) < config.weak_share * count;
  if (!weak || static_cast<int>(correspondences.size()) < config.fewest_matches) return planar;
  auto general = estimate_general(correspondences, config, seed);
  if (!general) return planar;
  const double to_beat = planar ? std::max(0.0, planar->evidence) : 0.0;
  if (general->evidence < to_beat + config.least_gain) return planar;
  // The planar motion is a rival like any other.
  general->lead = general->evidence - to_beat;
  return general;
}

}  // namespace

Result<PlanarEstimate> estimate_motion(std::span<const Correspondence> correspondences, const GeneralConfig& config,
                                       std::uint64_t seed) {
  return with_finite_only(correspondences, [&](std::span<const Correspondence> finite) {
    return estimate_of_finite(finite, config, seed);
  });
}

}  // namespace homeward::geometry
