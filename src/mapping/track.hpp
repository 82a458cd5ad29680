// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "map/topological_map.hpp"
#include "mapping/pair_table.hpp"

namespace homeward::mapping {

struct TrackConfig {
  int fewest_inliers = 15;                    // a turn between two images on fewer is not believed
  double least_turn_sigma_rad = 4e-3;         // of one step, however well the tour's own turns agree
  double odometry_turn_sigma_rad = 0.05;      // of one step whose turn only odometry knows
  double most_turn_conflict_rad = 0.35;       // between picture and odometry; beyond, the robot was carried or moved
  double odometry_length_sigma = 0.1;         // of one step, as a share of its length
  double picture_length_sigma = 0.35;         // the same where lengths are only known from parallax, at most
  double least_length_sigma = 0.1;            // and at least, however well the tour's own loops fit
  double least_typical_parallax_rad = 0.005;  // between tour neighbours; below, parallax does not tell lengths
  double sure_sigmas = 3.0;
  double least_turn_margin_rad = 0.17;  // a verified turn may miss the prediction by so much and 3 sigma
};

/// What the way driven says about "images a and b were taken at one place".
enum class TrackVerdict { kUnknown, kAgrees, kContradicts };

/// A verdict and, for agreement, how sharply the way could tell another place from this one: near 1 where prediction
/// and uncertainty are small beside a place, towards 0 where they are large.
struct WayEvidence {
  TrackVerdict verdict = TrackVerdict::kUnknown;
  double sharpness = 0.0;
};

/// Where the way between two images of a tour leads.
struct TrackPrediction {
  bool known = false;
  double distance = 0.0;        // from one to the other
  double distance_sigma = 0.0;  // its standard deviation
  double x = 0.0;               // where the second lies in the frame of the first
  double y = 0.0;
  double turn_rad = 0.0;  // second heading minus first
  double turn_sigma_rad = 0.0;
};

/// The way of each tour, step by step: turns from the pictures (a visual compass has no drift of its own), lengths from
/// odometry; without odometry in typical steps, a step with little parallax counting as short. First-order uncertainty:
/// a wrong turn in step k moves all that follows by its lever arm. A step that neither tells breaks the way.
/// Compounding of uncertain steps: Smith & Cheeseman, On the representation and estimation of spatial uncertainty
/// (1986); to judge loops by it is ours.
class TourTrack {
 public:
  /// `place_extent`: how large a place is, metres with odometry (`metric`), else typical steps.
  TourTrack(std::span<const map::MapImage> images, std::span<const int> tour_of, const PairTable& pairs, bool metric,
            double place_extent, const TrackConfig& config);

  /// Image `b` seen from image `a`, whichever comes first.
  [[nodiscard]] TrackPrediction predict(int a, int b) const;

  /// Whether the way allows that a and b are one place, given the verified turn between them where there is one.
  [[nodiscard]] WayEvidence judge(int a, int b) const { return judge(a, b, predict(a, b)); }

  /// The same by a prediction that knows more than the way alone.
  [[nodiscard]] WayEvidence judge(int a, int b, const TrackPrediction& predicted) const;

  [[nodiscard]] int images() const { return static_cast<int>(points_.size()); }
  /// Where image i lies on the way reckoned; only differences between joined images mean something.
  [[nodiscard]] const Pose2& pose(int i) const { return points_[static_cast<std::size_t>(i)].pose; }
  /// Whether the way between two images is known without a break.
  [[nodiscard]] bool joined(int a, int b) const;
  /// What the lengths of the steps between two images contribute to the variance of their distance, what their turns
  /// do, and the variance of the turn itself.
  [[nodiscard]] double length_variance(int a, int b) const;
  [[nodiscard]] double lever_variance(int a, int b) const;
  [[nodiscard]] double turn_variance(int a, int b) const;

  /// Distance in the way's own unit of two images that differ by this D: between tour neighbours both are known.
  [[nodiscard]] double apart(double visual_distance) const { return visual_distance / distance_per_unit_; }

  /// Standard deviation of one verified turn, measured on the tours: turns of two steps against those of both.
  [[nodiscard]] double turn_sigma_rad() const { return turn_sigma_rad_; }

  /// Standard deviation of the length of one step where lengths are only known from pictures, as a share of it:
  /// measured on the tour's own short loops.
  [[nodiscard]] double length_sigma() const { return length_sigma_; }

  [[nodiscard]] double sure_sigmas() const { return config_.sure_sigmas; }

  /// How large a place is, in the way's own unit.
  [[nodiscard]] double place_extent() const { return place_extent_; }

 private:
  struct Step {
    Pose2 motion;
    double length_variance = 0.0;
    double turn_variance = 0.0;
    bool broken = false;
  };
  /// A point of the way with sums over all steps up to it.
  struct Point {
    Pose2 pose;
    int breaks = 0;
    double length_variance = 0.0;
    double turn_variance = 0.0;    // sum v
    double turn_variance_x = 0.0;  // sum v x, with x where the step ends
    double turn_variance_y = 0.0;
    double turn_variance_r2 = 0.0;  // sum v (x^2 + y^2)
  };
  void measure_distances(std::span<const int> tour_of);
  void measure_lengths(std::span<const int> tour_of);
  [[nodiscard]] Step step(std::span<const map::MapImage> images, int i, double typical_parallax_rad) const;

  const PairTable& pairs_;
  bool metric_;
  double place_extent_;
  TrackConfig config_;
  double turn_sigma_rad_ = 0.0;
  double length_sigma_ = 0.0;
  double distance_per_unit_ = 1.0;  // D
  std::vector<Point> points_;
};

}  // namespace homeward::mapping
