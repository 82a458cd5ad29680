// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "linemodel/particle.hpp"
#include "linemodel/resample.hpp"

namespace homeward::linemodel {

/// How far odometry may be wrong (Thrun, Burgard & Fox 2005, section 5.4, in shares of what it says).
struct OdometryNoise {
  double length_share = 0.10;     // of the way, along it
  double turn_share = 0.10;       // of the turn
  double turn_rad_per_m = 0.035;  // that the heading drifts
  double least_m = 0.01;          // a step, however short
  double least_rad = 0.005;
};

struct MonteCarloConfig {
  OdometryNoise odometry;
  KldConfig kld;
  std::size_t first_particles = 60'000;  // of a start anywhere
  std::size_t start_particles = 2'000;   // of a start somewhere
  double slow_share = 0.02;  // by which the averages follow whose quotient says that the robot was carried away
  double fast_share = 0.2;   // (Thrun, Burgard & Fox 2005, table 8.3)
  double usual_dip = 0.85;   // no more than this below the usual mean: nobody carried it
  double most_injected = 0.3;
  std::uint64_t seed = 1;
};

/// One of the places where a robot may be.
struct PoseCluster {
  Pose2 pose;             // mean
  double share = 0.0;     // of all weights
  double spread_m = 0.0;  // root mean square of the distance from the mean
  double spread_rad = 0.0;
};

/// Where a robot on a floor is, as particles: moved by odometry, weighed by what it senses, resampled (Dellaert et al.
/// 1999; Thrun, Burgard & Fox 2005, chapter 8), as many as the spread of the belief needs (Fox 2003), some thrown
/// anywhere new when what is sensed fits worse than it did. Deterministic by the seed.
class MonteCarlo {
 public:
  /// How well what is sensed fits a pose, 0 to 1, and the weight that this gives.
  struct Fit {
    double score = 0.0;
    double weight = 1.0;
  };
  using Weigh = std::function<Fit(const Pose2&)>;

  /// The robot can be within half of `spacing_m` of any of the points. Precondition: not empty.
  MonteCarlo(std::vector<Eigen::Vector2d> points_m, double spacing_m, const MonteCarloConfig& config);

  /// Another one without particles on the same floor.
  [[nodiscard]] MonteCarlo sibling(const MonteCarloConfig& config) const;

  /// Nothing is known: anywhere, with any heading.
  void start_anywhere();
  void start_at(const Pose2& pose, double spread_m, double spread_rad);

  /// The robot has moved by `moved` (its new pose in the frame of its old one).
  void move(const Pose2& moved);
  /// It has moved somehow, by about so much, and turned anyhow a little.
  void spread(double spread_m);
  /// This share of the particles, drawn by chance, is moved by about so much, so that a better pose nearby is found
  /// though none of them is there.
  void scatter(double share, double spread_m, double spread_rad);
  /// What is sensed now weighs the particles, and draws new ones where their weights have become uneven.
  void weigh(const Weigh& weigh);

  /// Where it may be, most probable first: particles within `reach_m` and `reach_rad` of the heaviest, then of the
  /// heaviest left, at most `most` of them.
  [[nodiscard]] std::vector<PoseCluster> clusters(double reach_m, double reach_rad, std::size_t most) const;
  [[nodiscard]] const std::vector<Particle>& particles() const { return particles_; }

 private:
  MonteCarlo(std::shared_ptr<const std::vector<Eigen::Vector2d>> points_m, double spacing_m,
             const MonteCarloConfig& config);
  [[nodiscard]] Pose2 anywhere();
  double gaussian(double spread);
  double uniform();
  void follow_scores(double mean_score);
  void inject(const Weigh& weigh);

  std::shared_ptr<const std::vector<Eigen::Vector2d>> points_m_;
  double spacing_m_;
  MonteCarloConfig config_;
  std::mt19937_64 random_;
  std::vector<Particle> particles_;
  double slow_score_ = 0.0;
  double fast_score_ = 0.0;
};

}  // namespace homeward::linemodel
