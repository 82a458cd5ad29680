// SPDX-License-Identifier: Apache-2.0
#include "geometry/general_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/relative_pose/methods.hpp>
#include <optional>
#include <random>

#include "geometry/estimate_summary.hpp"
#include "geometry/packed_matches.hpp"
#include "geometry/repetition.hpp"

namespace homeward::geometry {
namespace {

constexpr int kSample = 5;
constexpr int kSolutions = 10;  // of five matches, at most

struct Candidate {
  Eigen::Matrix3d essential;
  float cost;
};

TiltedMotion motion_of(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& direction) {
  return {{std::atan2(direction.y(), direction.x()), std::atan2(rotation(1, 0), rotation(0, 0))},
          std::asin(std::clamp(direction.z(), -1.0, 1.0)),
          std::atan2(rotation(2, 1), rotation(2, 2)),
          -std::asin(std::clamp(rotation(2, 0), -1.0, 1.0))};
}

/// The two motions, each up to the sign of its direction, of an essential matrix (Hartley & Zisserman, 9.6.2).
std::array<TiltedMotion, 2> motions_of(const Eigen::Matrix3d& essential) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d quarter;
  quarter << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  const auto rotation = [&](const Eigen::Matrix3d& w) -> Eigen::Matrix3d {
    const Eigen::Matrix3d r = svd.matrixU() * w * svd.matrixV().transpose();
    return r.determinant() < 0.0 ? Eigen::Matrix3d(-r) : r;
  };
  const Eigen::Vector3d direction = svd.matrixU().col(2);
  return {motion_of(rotation(quarter), direction), motion_of(rotation(quarter.transpose()), direction)};
}

/// The best essential matrices of random samples, best first, few.
std::vector<Candidate> search(std::span<const Correspondence> correspondences, const GeneralConfig& config,
                              std::uint64_t seed) {
  const int count = static_cast<int>(correspondences.size());
  std::vector<int> all(correspondences.size());
  std::iota(all.begin(), all.end(), 0);
  const PackedMatches packed(correspondences, all, std::vector<double>(correspondences.size(), 1.0));
  opengv::bearingVectors_t current;
  opengv::bearingVectors_t target;
  for (const Correspondence& c : correspondences) {
    current.push_back(c.current);
    target.push_back(c.target);
  }
  opengv::relative_pose::CentralRelativeAdapter adapter(current, target);
  std::mt19937_64 random(seed);
  constexpr std::size_t kKept = 4;
  std::vector<Candidate> best;
  int needed = config.max_iterations;
  for (int iteration = 0; iteration < needed; ++iteration) {
    for (int i = 0; i < kSample; ++i) {  // the first five of a shuffle
      const auto other = i + static_cast<int>(random() % static_cast<std::uint64_t>(count - i));
      std::swap(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(other)]);
    }
    const std::vector<int> sample(all.begin(), all.begin() + kSample);
    for (const Eigen::Matrix3d& solution : opengv::relative_pose::fivept_nister(adapter, sample)) {
      if (!solution.allFinite()) continue;
      const Eigen::Matrix3d essential = solution * (std::sqrt(2.0) / std::max(solution.norm(), 1e-12));
      const float enough = best.size() < kKept ? packed.total_weight() : best.back().cost;
      const float cost = packed.cost(essential, static_cast<float>(config.planar.max_error_rad), enough);
      if (!(cost < enough)) continue;
      best.push_back({essential, cost});
      std::ranges::stable_sort(best, {}, &Candidate::cost);
      if (best.size() > kKept) best.pop_back();
      const double share = 1.0 - static_cast<double>(best.front().cost / packed.total_weight());
      const double clean = std::min(std::pow(share, kSample), 1.0 - 1e-9);
      if (clean <= 0.0) continue;
      const double sure = std::ceil(std::log(1.0 - config.sure_enough) / std::log(1.0 - clean));
      needed = std::min(needed, static_cast<int>(std::clamp(sure, 1.0, static_cast<double>(config.max_iterations))));
    }
  }
  return best;
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
  for (const Candidate& candidate : search(correspondences, config, seed)) {
    for (const TiltedMotion& motion : motions_of(candidate.essential)) {
      MotionFit fit = fit_motion(matches, motion, fit_config);
      if (!best || fit.log_likelihood > best->log_likelihood) best = std::move(fit);
    }
  }
  if (!best) return fail(ErrorCode::kTooLittleSupport, "No general motion explains more than five matches.");
  // Five matches fit by construction, and every other five could have been tried.
  const auto size = static_cast<double>(correspondences.size());
  const double tries = std::lgamma(size + 1.0) - std::lgamma(size - kSample + 1.0) - std::lgamma(kSample + 1.0) +
                       std::log(static_cast<double>(kSolutions));
  const SharedView view = shared_view(correspondences, *best);
  const double evidence =
      (1.0 - repetition_probability(view)) * (best->log_likelihood - kSample * best->greatest_gain - tries);
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
