// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "linemodel/monte_carlo.hpp"

namespace homeward::linemodel {

struct PlaceConfig {
  std::size_t particles = 800;        // of a place when it is taken up ...
  std::size_t least_particles = 200;  // ... and later
  double spread_m = 0.25;             // of them, at least, when it is taken up
  double spread_rad = 0.10;
  double scatter_share = 0.15;  // of its particles are moved ...
  double scatter_each_m = 0.3;  // ... each time so much is driven, by about ...
  double scatter_m = 0.3;       // ... so much, as furniture that was moved holds them at a wrong pose nearby
  double scatter_rad = 0.1;
  double same_m = 0.4;  // two places nearer than this, whose headings are alike, are one
  double same_rad = 0.25;
  double square_m = 3.0;    // side of the squares of the way driven: what is seen in one counts once, ...
  double whole_m = 3.0;     // ... in full after so much driving in it, ...
  double most_lead = 0.8;   // ... and puts one place before another by no more than this
  double lead = 0.35;       // before every other place by so much: the robot is there
  double drop_lead = 0.70;  // behind the first by so much, or by
  double drop_all = 1.20;   // so much of what all lines tell: given up
  double least_m = 2.0;     // driven before anything is decided
  double both_lead = 0.9;   // before every other place by so much of what all lines tell both ways: the robot is there
  double built_behind = 0.1;  // all the same, if it is no more than this behind in what is built
};

/// A place where the robot may be.
struct PlaceHypothesis {
  PoseCluster at;           // its share is what the leads make of it
  double evidence = 0.0;    // of all lines, mean over the way
  double agreement = 0.0;   // of plan and pictures both ways, the same
  double behind = 0.0;      // the first, in evidence of what is built, summed over the squares of the way
  double followed_m = 0.0;  // so far, since it was taken up
};

/// Several places that look alike, each followed by particles of its own so that none dies out by chance (clustered
/// particle filtering; Milstein, Sanchez & Williamson 2002), and what the way driven tells of which it is. Within a
/// place particles are weighed sharply. Between places what is built tells alone, as furniture that is not where it is
/// drawn speaks for a wrong one; and evidence is summed over the floor that the robot has seen, not over pictures, as
/// the same error is in view for long (ours). Deterministic by the seed.
class PlaceHypotheses {
 public:
  /// How much likelier what is seen is from a pose than by chance, as a logarithm.
  struct Evidence {
    double all = 0.0;        // lines that are drawn, of being seen
    double built = 0.0;      // those of what cannot be moved
    double explained = 0.0;  // lines that are seen, of being drawn
  };
  using Look = std::function<Evidence(const Pose2&)>;

  explicit PlaceHypotheses(const PlaceConfig& config) : config_(config) {}

  /// Takes these places up, and forgets all others. `floor`: whose siblings their particles are.
  void begin(const MonteCarlo& floor, const MonteCarloConfig& particles, std::span<const PoseCluster> places);
  /// Takes further places up, but for those that are followed already. They are compared where they are from now on.
  void join(const MonteCarlo& floor, const MonteCarloConfig& particles, std::span<const PoseCluster> places);
  void clear();
  [[nodiscard]] bool empty() const { return places_.empty(); }

  /// The robot has moved by `moved` (its new pose in the frame of its old one).
  void move(const Pose2& moved);
  /// It has moved somehow, by about so much.
  void spread(double spread_m);
  /// What is seen after driving `driven_m`. When it stood, particles are weighed, but nothing is told of places.
  void weigh(const MonteCarlo::Weigh& weigh, const Look& look, double driven_m);

  /// Most probable first.
  [[nodiscard]] std::vector<PlaceHypothesis> places() const;
  /// Whether the first is so far before all others in what is built that the robot is there, and furniture does not
  /// speak against it; or so far before them in all that is drawn and seen.
  [[nodiscard]] bool decided() const;
  [[nodiscard]] double driven_m() const { return driven_m_; }
  /// Those of all places, as probable as these are.
  [[nodiscard]] const std::vector<Particle>& particles() const { return particles_; }

 private:
  struct Square {
    double all_m = 0.0;    // evidence summed over metres driven
    double built_m = 0.0;  // the same
    double both_m = 0.0;   // the same of all lines, both ways
    double driven_m = 0.0;
  };
  struct Place {
    MonteCarlo monte_carlo;
    PoseCluster at;
    std::map<std::array<int, 2>, Square> squares;
  };

  [[nodiscard]] static double followed_m(const Place& place);
  /// Of one place over another, by one of the sums of their squares.
  [[nodiscard]] double lead(const Place& one, const Place& other, double Square::*sum) const;
  [[nodiscard]] double least_lead(const Place& one, double Square::*sum) const;
  /// Whether one is so far before all others in all that is drawn and seen, and hardly behind them in what is built.
  [[nodiscard]] bool agrees_alone(const Place& one) const;
  void take_up(const MonteCarlo& floor, const MonteCarloConfig& particles, const PoseCluster& place);
  void sort_out();
  void gather_particles();

  PlaceConfig config_;
  std::vector<Place> places_;  // most probable first
  Pose2 way_;                  // since they were taken up, by odometry
  double driven_m_ = 0.0;
  std::size_t taken_up_ = 0;
  std::vector<Particle> particles_;
};

}  // namespace homeward::linemodel
