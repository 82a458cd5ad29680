// SPDX-License-Identifier: Apache-2.0
#include "homing/visual_homing.hpp"

#include <algorithm>
#include <cmath>

#include "matching/verify.hpp"

namespace homeward::homing {
namespace {

Eigen::Vector3d bearing(const features::FeatureSet& set, int index) {
  return set.bearings.row(index).transpose().cast<double>().normalized();
}

std::vector<Sighting> sightings_of(const features::Appearance& current, const features::Appearance& target,
                                   const std::vector<matching::Match>& matches, bool columns) {
  std::vector<Sighting> result;
  for (const matching::Match& match : matches) {
    if (match.kind == matching::FeatureKind::kSift) {
      result.push_back({match.target, bearing(target.sift, match.target), bearing(current.sift, match.current)});
    } else if (columns) {
      const matching::ColumnBearings ends = matching::bearings_of(current.columns, target.columns, match);
      const int number = target.sift.size() + 2 * match.target + (ends.bottom ? 1 : 0);
      result.push_back({number, ends.target.normalized(), ends.current.normalized()});
    }
  }
  return result;
}

double log_odds(double probability) {
  const double p = std::clamp(probability, 1e-4, 1.0 - 1e-4);
  return std::log(p / (1.0 - p));
}

double probability(double odds_log) { return 1.0 / (1.0 + std::exp(-odds_log)); }

/// The probability that a bearing with this spread is right within 15 degrees.
double within_bound(double spread_rad) {
  constexpr double kBound_rad = 15.0 * kPi / 180.0;
  return std::erf(kBound_rad / (std::sqrt(2.0) * std::max(spread_rad, 1e-3)));
}

}  // namespace

// Rendered houses by day: 0.18 of the features from 1 m, 0.08 from 2 m, 0.05 from 3 m, 0.025 from 6 m (medians).
double usual_distance_m(double share) {
  constexpr double kMetres = 0.14;
  constexpr double kFarthest_m = 8.0;
  return std::min(kFarthest_m, kMetres / std::max(share, 1e-3));
}

double shared_share(const features::Appearance& current, const features::Appearance& target, int inliers) {
  return static_cast<double>(inliers) / std::max(1, std::min(current.size(), target.size()));
}

TargetSeen VisualHoming::answer(const LocalPose& pose, const HomeVector* fresh, int matches) const {
  TargetSeen seen;
  const Pose2 target = inverse(pose.target_from_robot);
  seen.target_m = Eigen::Vector2d(target.x_m, target.y_m);
  // p = -R(-theta) t: its covariance is that of t, turned, and what the heading's doubt adds across.
  const double c = std::cos(pose.target_from_robot.theta_rad);
  const double s = std::sin(pose.target_from_robot.theta_rad);
  Eigen::Matrix<double, 2, 3> moved;
  moved << -c, -s, target.y_m, s, -c, -target.x_m;
  seen.covariance_m2 = moved * pose.covariance * moved.transpose();
  seen.known = map_.features();
  seen.vector.bearing_rad = std::atan2(target.y_m, target.x_m);
  seen.vector.turn_rad = target.theta_rad;
  const double distance_m = seen.target_m->norm();
  seen.vector.nearness = distance_m / first_distance_;
  seen.vector.matches = matches;
  seen.vector.inliers = pose.inliers;
  seen.vector.median_parallax_rad =
      fresh != nullptr ? fresh->median_parallax_rad : distance_m / config_.metres_per_parallax;
  const Eigen::Vector2d across(-std::sin(seen.vector.bearing_rad), std::cos(seen.vector.bearing_rad));
  const double spread_rad = std::sqrt(across.dot(seen.covariance_m2 * across)) / std::max(distance_m, 1e-3);
  seen.map_confidence = probability(log_odds_);
  seen.vector.confidence = seen.map_confidence * within_bound(spread_rad);
  return seen;
}

std::optional<Pose2> VisualHoming::expected(const std::optional<Pose2>& odometry) const {
  if (!latest_) return std::nullopt;
  if (!odometry || !latest_odometry_) return latest_->target_from_robot;
  return latest_->target_from_robot * (inverse(*latest_odometry_) * *odometry);
}

void VisualHoming::keep(const LocalPose& pose, const std::optional<Pose2>& odometry) {
  latest_ = pose;
  latest_odometry_ = odometry;
}

Result<TargetSeen> VisualHoming::track(const tracking::TrackingFrame& frame, const std::optional<Pose2>& odometry,
                                       std::uint64_t seed) {
  const auto guess = expected(odometry);
  if (!guess || map_.empty()) {
    wants_features_ = true;
    return fail(ErrorCode::kTooLittleSupport, "The target is not known yet.");
  }
  const std::vector<Sighting> found = tracks_.follow(frame, map_, *guess);
  const auto pose = map_.pose_of(found, guess, seed);
  ++tracked_for_;
  if (!pose) {
    wants_features_ = true;
    return fail(ErrorCode::kTooLittleSupport, "Too few of the target's features can be tracked.");
  }
  const std::vector<Sighting> held = tracks_.settle(map_, pose->target_from_robot);
  LocalPose best = *pose;
  best.covariance += map_.last_covariance();
  best.inliers = static_cast<int>(held.size());
  keep(best, odometry);
  wants_features_ =
      tracked_for_ + 1 >= config_.recognise_every || static_cast<int>(held.size()) < config_.fewest_tracked;
  TargetSeen seen = answer(best, nullptr, static_cast<int>(found.size()));
  seen.tracks = tracks_.counts();
  return seen;
}

Result<TargetSeen> VisualHoming::update(const features::Appearance& current, const features::Appearance& target,
                                        const std::optional<Pose2>& odometry, const std::optional<DistancePrior>& prior,
                                        const tracking::TrackingFrame& frame, std::uint64_t seed) {
  auto seen = recognise(current, target, odometry, prior, frame, seed);
  tracked_for_ = 0;
  wants_features_ = !seen || !seen->target_m || config_.recognise_every <= 1;
  return seen;
}

TargetSeen VisualHoming::seen_by_map(const LocalPose& pose, const std::vector<Sighting>& all,
                                     const std::vector<int>& inliers, const std::optional<Pose2>& odometry,
                                     const tracking::TrackingFrame& frame) {
  misses_ = 0;
  LocalPose best = pose;
  if (map_.wants(pose.target_from_robot)) {
    const std::vector<Sighting> agreeing = map_.agreeing(all, pose.target_from_robot);
    if (const auto refined = map_.add(agreeing, odometry, pose.target_from_robot)) {
      best = *refined;
      constexpr double kOddsOfAgreeing = 0.7;  // natural logarithm
      constexpr double kMostOdds = 5.0;
      log_odds_ = std::min(kMostOdds, log_odds_ + kOddsOfAgreeing);
    }
  } else {
    best.covariance += map_.last_covariance();
  }
  std::vector<Sighting> agreeing;
  agreeing.reserve(inliers.size());
  for (const int inlier : inliers) agreeing.push_back(all[static_cast<std::size_t>(inlier)]);
  if (frame.has_value()) tracks_.anchor(frame, agreeing);
  keep(best, odometry);
  TargetSeen seen = answer(best, nullptr, static_cast<int>(all.size()));
  seen.tracks = tracks_.counts();
  return seen;
}

Result<TargetSeen> VisualHoming::recognise(const features::Appearance& current, const features::Appearance& target,
                                           const std::optional<Pose2>& odometry,
                                           const std::optional<DistancePrior>& prior,
                                           const tracking::TrackingFrame& frame, std::uint64_t seed) {
  matching::VerifyConfig verify_config;
  verify_config.min_inliers = config_.first.min_inliers;
  std::vector<Sighting> all;
  if (!map_.empty()) {
    // The map first: it knows more than two views do, above all close to the target, where these say nothing.
    all = sightings_of(current, target,
                       matching::match_both_kinds(current, target, verify_config.match, verify_config.columns),
                       config_.columns);
    std::vector<int> inliers;
    const auto pose = map_.pose_of(all, expected(odometry), seed, &inliers);
    if (pose) return seen_by_map(*pose, all, inliers, odometry, frame);
    if (++misses_ < config_.patience) {
      return fail(ErrorCode::kTooLittleSupport,
                  "The picture does not agree with what is known of the target's features.");
    }
    map_ = LocalMap(config_.map);
    tracks_ = FeatureTracks(config_.tracks);
    latest_.reset();
  }
  const auto verified = matching::verify(current, target, verify_config, seed);
  if (!verified) return pass_on(verified);
  HomeVector vector = vector_of(*verified);
  log_odds_ = log_odds(verified->pose.confidence) + std::log(config_.prior_odds);
  vector.confidence = probability(log_odds_);
  TargetSeen seen;
  seen.vector = vector;
  if (vector.confidence < config_.begin_confidence) return seen;
  const double share = shared_share(current, target, vector.inliers);
  if (share < kLeastShare && !(prior && prior->mapped)) return seen;
  std::vector<matching::Match> inliers;
  for (const int inlier : verified->pose.inliers)
    inliers.push_back(verified->matches[static_cast<std::size_t>(inlier)]);
  const std::vector<Sighting> sightings = sightings_of(current, target, inliers, config_.columns);
  const double guess_m = std::max(std::clamp(config_.metres_per_parallax * vector.median_parallax_rad, 0.05, 6.0),
                                  share < kLeastShare ? usual_distance_m(share) : 0.0);
  const DistancePrior distance = prior.value_or(DistancePrior{guess_m, 0.7});
  first_distance_ = distance.distance_m;
  const Pose2 target_in_robot{distance.distance_m * std::cos(vector.bearing_rad),
                              distance.distance_m * std::sin(vector.bearing_rad), vector.turn_rad};
  if (static_cast<int>(sightings.size()) < config_.map.fewest) return seen;
  const auto pose = map_.begin(sightings, odometry, {inverse(target_in_robot), distance.spread});
  misses_ = 0;
  if (!pose) return seen;
  if (frame.has_value()) tracks_.anchor(frame, sightings);
  keep(*pose, odometry);
  TargetSeen first = answer(*pose, &vector, vector.matches);
  // What two views say is calibrated; the map says nothing more yet.
  first.vector.confidence = vector.confidence;
  first.vector.inliers = vector.inliers;
  first.tracks = tracks_.counts();
  first.began = true;
  return first;
}

}  // namespace homeward::homing
