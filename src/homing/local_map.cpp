// SPDX-License-Identifier: Apache-2.0
#include "homing/local_map.hpp"

#include <algorithm>
#include <cmath>

#include "homing/floor_pose.hpp"
#include "homing/local_refinement.hpp"

namespace homeward::homing {
namespace {

constexpr double kNearest_m = 0.25;
constexpr double kFarthest_m = 40.0;

Eigen::Vector3d turned(const Pose2& pose, const Eigen::Vector3d& here) {
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  return {c * here.x() - s * here.y(), s * here.x() + c * here.y(), here.z()};
}

/// A point of the target's frame as the robot sees it, unit.
Eigen::Vector3d seen_from(const Pose2& pose, const Eigen::Vector3d& point) {
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  const double dx = point.x() - pose.x_m;
  const double dy = point.y() - pose.y_m;
  return Eigen::Vector3d(c * dx + s * dy, -s * dx + c * dy, point.z()).normalized();
}

/// Distance from the target at which two rays come nearest to each other; nothing for rays that never do.
std::optional<double> triangulated_m(const Eigen::Vector3d& target, const Pose2& pose, const Eigen::Vector3d& here) {
  const Eigen::Vector3d other = turned(pose, here);
  const Eigen::Vector3d from(pose.x_m, pose.y_m, 0.0);
  const double cosine = target.dot(other);
  const double sine_squared = 1.0 - cosine * cosine;
  constexpr double kParallel = 1e-5;
  if (sine_squared < kParallel) return std::nullopt;
  const double along = (target.dot(from) - cosine * other.dot(from)) / sine_squared;
  const double other_along = (cosine * target.dot(from) - other.dot(from)) / sine_squared;
  if (along <= 0.0 || other_along <= 0.0) return std::nullopt;
  return std::clamp(along, kNearest_m, kFarthest_m);
}

double log_nearness_of(const LocalMapConfig& config, const Sighting& sighting, const Pose2& pose) {
  return -std::log(triangulated_m(sighting.target, pose, sighting.here).value_or(config.usual_distance_m));
}

}  // namespace

void LocalMap::learn(const Keyframe& keyframe) {
  for (const Sighting& sighting : keyframe.sightings) {
    const auto [entry, added] = features_.try_emplace(sighting.feature);
    if (added) {
      entry->second.target = sighting.target;
      entry->second.log_nearness = log_nearness_of(config_, sighting, keyframe.target_from_robot);
    }
    ++entry->second.seen;
  }
}

std::optional<LocalPose> LocalMap::begin(std::span<const Sighting> sightings, const std::optional<Pose2>& odometry,
                                         const FirstGuess& guess) {
  features_.clear();
  keyframes_.clear();
  first_distance_m_ = std::max(0.05, std::hypot(guess.target_from_robot.x_m, guess.target_from_robot.y_m));
  first_spread_ = guess.distance_spread;
  Keyframe keyframe{guess.target_from_robot, odometry, {sightings.begin(), sightings.end()}, false};
  learn(keyframe);
  keyframes_.push_back(std::move(keyframe));
  auto pose = refine();
  if (!pose) *this = LocalMap(config_);
  return pose;
}

std::optional<LocalPose> LocalMap::pose_of(std::span<const Sighting> sightings, const std::optional<Pose2>& expected,
                                           std::uint64_t seed, std::vector<int>* inliers) const {
  std::vector<PointSighting> points;
  std::vector<int> index;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const auto known = features_.find(sightings[i].feature);
    if (known == features_.end()) continue;
    points.push_back({known->second.target * std::exp(-known->second.log_nearness), sightings[i].here});
    index.push_back(static_cast<int>(i));
  }
  const int needed =
      std::max(config_.fewest, static_cast<int>(std::ceil(config_.fewest_share * static_cast<double>(points.size()))));
  if (static_cast<int>(points.size()) < config_.fewest) return std::nullopt;
  const auto pose =
      floor_pose(points, expected, {config_.bearing_spread_rad, config_.inlier_rad, config_.ransac_rounds}, seed);
  if (!pose || static_cast<int>(pose->inliers.size()) < needed) return std::nullopt;
  if (inliers != nullptr) {
    inliers->clear();
    for (const int inlier : pose->inliers) inliers->push_back(index[static_cast<std::size_t>(inlier)]);
  }
  return LocalPose{pose->map_from_robot, pose->covariance, static_cast<int>(pose->inliers.size()),
                   static_cast<int>(points.size())};
}

std::vector<Sighting> LocalMap::agreeing(std::span<const Sighting> sightings, const Pose2& target_from_robot) const {
  constexpr double kVisibleParallax_rad = 0.03;
  std::vector<Sighting> result;
  for (const Sighting& sighting : sightings) {
    std::optional<Eigen::Vector3d> seen = bearing_from(sighting.feature, target_from_robot);
    if (!seen) {
      const Eigen::Vector3d other = turned(target_from_robot, sighting.here);
      if (std::acos(std::clamp(sighting.target.dot(other), -1.0, 1.0)) < kVisibleParallax_rad) continue;
      const auto distance_m = triangulated_m(sighting.target, target_from_robot, sighting.here);
      if (!distance_m) continue;
      seen = seen_from(target_from_robot, sighting.target * *distance_m);
    }
    if (seen->cross(sighting.here).norm() < config_.inlier_rad && seen->dot(sighting.here) > 0.0) {
      result.push_back(sighting);
    }
  }
  return result;
}

bool LocalMap::wants(const Pose2& target_from_robot) const {
  if (keyframes_.empty()) return true;
  const Pose2 moved = inverse(keyframes_.back().target_from_robot) * target_from_robot;
  return std::hypot(moved.x_m, moved.y_m) >= config_.keyframe_m;
}

std::optional<Pose2> LocalMap::expected(const std::optional<Pose2>& odometry) const {
  if (keyframes_.empty() || !odometry || !keyframes_.back().odometry) return std::nullopt;
  return keyframes_.back().target_from_robot * (inverse(*keyframes_.back().odometry) * *odometry);
}

bool LocalMap::carried(const Pose2& target_from_robot, const std::optional<Pose2>& odometry) const {
  if (keyframes_.empty() || !odometry || !keyframes_.back().odometry) return false;
  // The map's scale may still be off by a factor, so only what no factor explains counts.
  constexpr double kFactor = 3.0;
  constexpr double kLeast_m = 0.3;
  constexpr double kTurn_rad = 0.35;
  const Pose2 seen = inverse(keyframes_.back().target_from_robot) * target_from_robot;
  const Pose2 driven = inverse(*keyframes_.back().odometry) * *odometry;
  return std::hypot(seen.x_m, seen.y_m) > kFactor * std::hypot(driven.x_m, driven.y_m) + kLeast_m ||
         std::abs(wrap_angle(seen.theta_rad - driven.theta_rad)) > kTurn_rad;
}

std::optional<LocalPose> LocalMap::add(std::span<const Sighting> sightings, const std::optional<Pose2>& odometry,
                                       const Pose2& target_from_robot) {
  LocalMap tried = *this;
  Keyframe keyframe{
      target_from_robot, odometry, {sightings.begin(), sightings.end()}, carried(target_from_robot, odometry)};
  tried.learn(keyframe);
  tried.keyframes_.push_back(std::move(keyframe));
  if (tried.keyframes() > config_.keyframes) tried.drop_one();
  auto pose = tried.refine();
  if (pose) *this = std::move(tried);
  return pose;
}

void LocalMap::drop_one() {
  // Never the first two thirds of the baseline's ends: the oldest and the newest stay, and of those between the one
  // whose neighbours are nearest to each other goes.
  std::size_t least = 1;
  double least_m = 1e9;
  for (std::size_t i = 1; i + 1 < keyframes_.size(); ++i) {
    const Pose2 gap = inverse(keyframes_[i - 1].target_from_robot) * keyframes_[i + 1].target_from_robot;
    const double gap_m = std::hypot(gap.x_m, gap.y_m);
    if (gap_m >= least_m) continue;
    least_m = gap_m;
    least = i;
  }
  for (const Sighting& sighting : keyframes_[least].sightings) {
    const auto known = features_.find(sighting.feature);
    if (known != features_.end() && --known->second.seen == 0) features_.erase(known);
  }
  keyframes_[least + 1].carried = keyframes_[least + 1].carried || keyframes_[least].carried;
  keyframes_.erase(keyframes_.begin() + static_cast<std::ptrdiff_t>(least));
}

std::optional<LocalPose> LocalMap::refine() {
  RefinementProblem problem;
  problem.config = config_;
  problem.first_distance_m = first_distance_m_;
  problem.first_spread = first_spread_;
  std::map<int, int> index;
  for (const auto& [number, feature] : features_) {
    index.emplace(number, static_cast<int>(problem.features.size()));
    problem.features.push_back({feature.target, feature.log_nearness});
  }
  for (const Keyframe& keyframe : keyframes_) {
    RefinementView view{keyframe.target_from_robot, keyframe.odometry, keyframe.carried, {}};
    for (const Sighting& sighting : keyframe.sightings) {
      view.sightings.push_back({index.at(sighting.feature), sighting.here});
    }
    problem.views.push_back(std::move(view));
  }
  const auto refined = refine_local_map(problem);
  if (!refined) return std::nullopt;
  for (auto& [number, feature] : features_) {
    feature.log_nearness = problem.features[static_cast<std::size_t>(index.at(number))].log_nearness;
  }
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    keyframes_[i].target_from_robot = problem.views[i].target_from_robot;
  }
  LocalPose pose;
  pose.target_from_robot = keyframes_.back().target_from_robot;
  pose.covariance = last_covariance_ = refined->covariance;
  pose.inliers = refined->inliers;
  pose.given = static_cast<int>(keyframes_.back().sightings.size());
  return pose;
}

std::optional<Eigen::Vector3d> LocalMap::bearing_from(int feature, const Pose2& target_from_robot) const {
  const auto known = features_.find(feature);
  if (known == features_.end()) return std::nullopt;
  return seen_from(target_from_robot, known->second.target * std::exp(-known->second.log_nearness));
}

}  // namespace homeward::homing
