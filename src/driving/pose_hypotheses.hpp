// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/pose2.hpp"
#include "driving/pose_hypotheses_config.hpp"
#include "driving/pose_hypothesis.hpp"
#include "driving/twin_evidence.hpp"
#include "driving/view_sighting.hpp"

namespace homeward::driving {

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
  void apply_odds(const std::optional<Eigen::Vector2d>& point_m, double radius_m, double odds, double most);

  /// What a local map says between two pictures that are recognised: moves the hypotheses, weighs nothing.
  void refine(const ViewSighting& sighting);

  /// Somebody says that the robot is within `radius_m` of a point of the map, or that it is not: `odds` multiplies the
  /// odds of what lies there against all else, being elsewhere included. Where that makes it likely that it is there,
  /// the word is a measurement of the position as well.
  void weigh_within(const Eigen::Vector2d& point_m, double radius_m, double odds);

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
