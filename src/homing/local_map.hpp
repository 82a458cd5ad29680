// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "homing/local_map_config.hpp"
#include "homing/sighting.hpp"

namespace homeward::homing {

/// A pose of the robot in the frame of the target: where it is when it sees what it sees.
struct LocalPose {
  Pose2 target_from_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  // of x, y, theta in the target's frame
  int inliers = 0;
  int given = 0;
};

/// What is expected of the first pose: the home vector's two angles, and how far the target may be.
struct FirstGuess {
  Pose2 target_from_robot;
  double distance_spread = 0.6;  // of the logarithm of the distance
};

/// The features of one target picture in space, in the target's own robot frame (Goedemé 2007 §7.1.2). Distances come
/// from triangulation between the target picture and the pictures on the way, refined together with the robot's poses
/// on the floor; the scale comes from odometry where there is one, else the first baseline keeps the length it was
/// given. Deterministic; holds no pictures. Copies are independent.
/// That it grows and is refined on the way is ours.
class LocalMap {
 public:
  LocalMap() = default;
  explicit LocalMap(const LocalMapConfig& config) : config_(config) {}

  [[nodiscard]] bool empty() const { return keyframes_.empty(); }
  [[nodiscard]] int features() const { return static_cast<int>(features_.size()); }
  [[nodiscard]] double inlier_rad() const { return config_.inlier_rad; }
  [[nodiscard]] int keyframes() const { return static_cast<int>(keyframes_.size()); }

  /// Starts with two views: the target and the present one. The refined pose of this one; nothing, and an empty map,
  /// where the views cannot be refined.
  std::optional<LocalPose> begin(std::span<const Sighting> sightings, const std::optional<Pose2>& odometry,
                                 const FirstGuess& guess);

  /// The pose from which the sightings look as they do: three-point samples (Kneip 2011, OpenGV) in RANSAC beside the
  /// pose that is expected, the best refined on the floor. Sightings of features whose distance is not known yet are
  /// passed over. Nothing where too few agree. `inliers`, if given, gets the indices of those that agree.
  [[nodiscard]] std::optional<LocalPose> pose_of(std::span<const Sighting> sightings,
                                                 const std::optional<Pose2>& expected, std::uint64_t seed,
                                                 std::vector<int>* inliers = nullptr) const;

  /// Whether the robot has driven far enough since the latest keyframe for another one to say something new.
  [[nodiscard]] bool wants(const Pose2& target_from_robot) const;

  /// One more picture: keeps it, forgets the one that is missed least, and refines features and poses together (Ceres).
  /// Returns the refined pose of this picture with its covariance; nothing when the picture contradicts the map, which
  /// then stays as it was.
  std::optional<LocalPose> add(std::span<const Sighting> sightings, const std::optional<Pose2>& odometry,
                               const Pose2& target_from_robot);

  /// Where the robot is by the latest keyframe and the odometry since; nothing without odometry.
  [[nodiscard]] std::optional<Pose2> expected(const std::optional<Pose2>& odometry) const;

  /// The sightings that are worth learning from a pose: those that agree with the features that are known, and those of
  /// new features whose two rays meet in front of both viewpoints.
  [[nodiscard]] std::vector<Sighting> agreeing(std::span<const Sighting> sightings,
                                               const Pose2& target_from_robot) const;

  /// Of the latest keyframe's pose, with all that the map does not know: what a pose against it has at least.
  [[nodiscard]] const Eigen::Matrix3d& last_covariance() const { return last_covariance_; }

  /// A feature as the robot would see it from a pose, unit; nothing where its distance is not known.
  [[nodiscard]] std::optional<Eigen::Vector3d> bearing_from(int feature, const Pose2& target_from_robot) const;

 private:
  struct Feature {
    Eigen::Vector3d target;     // bearing, unit
    double log_nearness = 0.0;  // logarithm of 1 / distance
    int seen = 0;               // keyframes
  };
  struct Keyframe {
    Pose2 target_from_robot;
    std::optional<Pose2> odometry;
    std::vector<Sighting> sightings;
    bool carried = false;  // odometry does not tell the way from the keyframe before
  };

  [[nodiscard]] bool carried(const Pose2& target_from_robot, const std::optional<Pose2>& odometry) const;
  void learn(const Keyframe& keyframe);
  void drop_one();
  std::optional<LocalPose> refine();

  LocalMapConfig config_;
  std::map<int, Feature> features_;
  std::vector<Keyframe> keyframes_;
  double first_distance_m_ = 1.0;
  double first_spread_ = 0.6;
  Eigen::Matrix3d last_covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace homeward::homing
