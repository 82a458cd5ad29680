// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/pose2.hpp"
#include "driving/twin_evidence.hpp"

namespace homeward::driving {

/// A robot's pose in the frame of a map, as one Gaussian.
struct PoseHypothesis {
  Pose2 map_from_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  // of x, y (map frame, m) and heading (rad)
  double weight = 0.0;                                       // probability
  RecognitionRecord record = {};                             // of the pictures since it was begun
};

/// Where a view lies by the matches of one picture.
struct SightedDirection {
  double bearing_rad = 0.0;  // of the view, robot frame
  double turn_rad = 0.0;     // from the robot's heading to the view's
  double confidence = 0.0;   // probability that both are right, given that the robot is near the view
  double distance_m = 1.0;   // what the share of features recognised says; known to a factor of two
};

/// Where a view lies by a local map of its features (homing::LocalMap).
struct SightedPose {
  Pose2 robot_from_view;
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();  // of the position, robot frame
};

/// One view of the map that the latest picture was compared with.
struct ViewSighting {
  Pose2 map_from_view;
  double spread_m = 0.15;     // standard deviation of where the view lies among those around it
  double share = 0.0;         // of the features of picture and view, those that one motion explains,
  int agreeing = 0;           // and how many those are
  double prior_share = 1e-3;  // of the probability: that the robot is at this view although no hypothesis said so
  std::optional<SightedDirection> direction;
  std::optional<SightedPose> pose;
};

struct PoseHypothesesConfig {
  double odometry_m_per_sqrt_m = 0.04;  // standard deviations after a metre; they grow with the root of the way
  double odometry_rad_per_sqrt_m = 0.03;
  double odometry_rad_per_sqrt_rad = 0.03;  // and after a radian
  double least_position_m = 0.04;           // nothing is known better
  double least_heading_rad = 0.02;
  double bearing_rad = 0.06;  // standard deviations of a right direction
  double turn_rad = 0.05;
  double most_confidence = 0.9;     // of a direction: another place may look alike, however clear it is
  double near_view_m = 2.0;         // a view so near should have been recognised,
  double far_view_m = 8.0;          // and one so near may have been
  double gate = 4.0;                // standard deviations beyond which a sighting does not move a hypothesis
  double elsewhere_share = 0.03;    // of features recognised at views of other places than the robot's
  double shrinks_over_m = 2.0;      // from a view d away the share recognised is (1 + d / this)^-2 of that at it
  double elsewhere_evidence = 1.5;  // a picture speaks against being elsewhere by this power of the share
  TwinEvidenceConfig twins;
  double leave_probability = 0.002;  // for each independent picture
  double cluster_m = 1.0;            // hypotheses so near are one answer to where the robot is
  double independent_m = 0.4;        // pictures so far from each other say something new each
};

/// Where the robot may be on a map, as a few Gaussians with weights and the weight of being elsewhere: multi-hypothesis
/// localisation (Jensfelt & Kristensen 2001) on the views of a topological map. A picture weighs each
/// hypothesis against the best by how much is recognised of the views near them, summed over the way
/// (twin_evidence.hpp), and moves each by what it says of those views. What no hypothesis explains begins another one
/// with little weight, so that one picture never moves the estimate past what the way driven allows. Deterministic;
/// copies are independent.
class PoseHypotheses {
 public:
  PoseHypotheses() = default;
  explicit PoseHypotheses(const PoseHypothesesConfig& config) : config_(config) {}
  /// As they were: `all`, `elsewhere` and `unweighed_m` of others.
  PoseHypotheses(const PoseHypothesesConfig& config, std::vector<PoseHypothesis> all, double elsewhere,
                 double unweighed_m)
      : config_(config), hypotheses_(std::move(all)), elsewhere_(elsewhere), driven_m_(unweighed_m) {}

  /// Nothing is known of where the robot is.
  [[nodiscard]] bool empty() const { return hypotheses_.empty(); }

  /// The robot drove, by odometry.
  void predict(const Pose2& before_from_now);

  /// One picture. `sightings`: the views that it was compared with; those near to the hypotheses must be among them.
  void weigh(std::span<const ViewSighting> sightings);

  /// What is no picture says something of each hypothesis of all(): the logarithm by which its odds against being
  /// elsewhere change. Precondition: as many as there are.
  void weigh(std::span<const double> log_odds);

  /// Somebody else says that the robot is within `radius_m` of a point of the map, or, without one, at a place that is
  /// none of those that were compared. `odds`: how many times more probable that makes it, but no more probable than
  /// `most`: who says so has seen the same pictures, and is as sure as that.
  void hear(const std::optional<Eigen::Vector2d>& point_m, double radius_m, double odds, double most);

  /// What a local map says between two pictures that are recognised: moves the hypotheses, weighs nothing.
  void refine(const ViewSighting& sighting);

  /// Somebody says that the robot is within `radius_m` of a point of the map, or that it is not: `odds` multiplies the
  /// odds of what lies there against all else, being elsewhere included. Where that makes it likely that it is there,
  /// the word is a measurement of the position as well.
  void told(const Eigen::Vector2d& point_m, double radius_m, double odds);

  /// The most probable one, or null.
  [[nodiscard]] const PoseHypothesis* best() const;
  /// Probability that the robot is where the best one says, within cluster_m.
  [[nodiscard]] double best_probability() const;
  /// Probability that the robot is within `radius_m` of a point of the map.
  [[nodiscard]] double probability_within(const Eigen::Vector2d& point_m, double radius_m) const;
  /// Whether a sighting agrees with the best hypothesis.
  [[nodiscard]] bool agrees(const ViewSighting& sighting) const;
  [[nodiscard]] double elsewhere() const { return elsewhere_; }
  /// The way since the last picture that was weighed.
  [[nodiscard]] double unweighed_m() const { return driven_m_; }
  /// Most probable first.
  [[nodiscard]] const std::vector<PoseHypothesis>& all() const { return hypotheses_; }

 private:
  [[nodiscard]] std::optional<Recognition> recognised(const PoseHypothesis& hypothesis,
                                                      std::span<const ViewSighting> sightings) const;
  void move(PoseHypothesis& hypothesis, const ViewSighting& sighting, double independent) const;
  [[nodiscard]] std::vector<PoseHypothesis> begun_by(std::span<const ViewSighting> sightings, double independent) const;
  double weigh_by_recognition(std::span<const ViewSighting> sightings, double news);
  void weigh_by_agreement(std::span<const std::optional<Recognition>> seen, double news);
  void settle();

  PoseHypothesesConfig config_;
  std::vector<PoseHypothesis> hypotheses_;
  double elsewhere_ = 1.0;
  double driven_m_ = 1e9;  // since the last picture, for how much it says that is new
};

}  // namespace homeward::driving
