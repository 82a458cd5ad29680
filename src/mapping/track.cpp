// SPDX-License-Identifier: Apache-2.0
#include "mapping/track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.hpp"
#include "core/index.hpp"

namespace homeward::mapping {
namespace {

double quantile(std::vector<double>& values, double q) {
  if (values.empty()) return 0.0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// Images of one place lie at most so many place extents apart.
constexpr double kFarthestExtents = 1.5;

double square(double x) { return x * x; }

/// How far a loop is from closing.
struct LoopMiss {
  double squared = 0.0;
  double variance = 0.0;  // that is expected, in both directions together
  double reach = 0.0;     // as far as the way between could lead, roughly
};

/// By how much the expected standard deviations are to be multiplied, 1/16 to 1, so that the misses are most likely:
/// each comes from a loop, with a normal distribution, or from two places that look alike, somewhere within reach. The
/// share of loops is estimated with it, so that most pairs may be look-alikes.
double scale_of_misses(const std::vector<LoopMiss>& misses) {
  constexpr int kScales = 13;
  constexpr int kRounds = 12;
  double best_scale = 1.0;
  double best = -std::numeric_limits<double>::infinity();
  for (int s = 0; s < kScales; ++s) {
    const double scale = std::pow(2.0, -s / 3.0);
    double loops = 0.5;
    double likelihood = 0.0;
    for (int round = 0; round < kRounds; ++round) {
      likelihood = 0.0;
      double expected = 0.0;
      for (const LoopMiss& miss : misses) {
        const double variance = square(scale) * miss.variance;
        const double closes = loops * std::exp(-miss.squared / variance) / (kPi * variance);
        const double elsewhere = (1.0 - loops) / (kPi * miss.reach * miss.reach);
        likelihood += std::log(closes + elsewhere);
        expected += closes / (closes + elsewhere);
      }
      loops = std::clamp(expected / static_cast<double>(misses.size()), 0.01, 0.99);
    }
    if (likelihood > best) {
      best = likelihood;
      best_scale = scale;
    }
  }
  return best_scale;
}

}  // namespace

TourTrack::TourTrack(std::span<const map::MapImage> images, std::span<const int> tour_of, const PairTable& pairs,
                     bool metric, double place_extent, const TrackConfig& config)
    : pairs_(pairs), metric_(metric), place_extent_(place_extent), config_(config), points_(images.size()) {
  const int count = static_cast<int>(images.size());
  std::vector<double> misses;
  std::vector<double> parallaxes;
  for (int i = 0; i + 1 < count; ++i) {
    const PairRelation first = pairs.relation(i, i + 1);
    if (tour_of[at(i)] != tour_of[at(i + 1)] || first.inliers < config.fewest_inliers) continue;
    parallaxes.push_back(static_cast<double>(first.parallax_rad));
    if (i + 2 >= count || tour_of[at(i)] != tour_of[at(i + 2)]) continue;
    const PairRelation second = pairs.relation(i + 1, i + 2);
    const PairRelation both = pairs.relation(i, i + 2);
    if (second.inliers < config.fewest_inliers || both.inliers < config.fewest_inliers) continue;
    misses.push_back(std::abs(wrap_angle(static_cast<double>(first.turn_rad) + static_cast<double>(second.turn_rad) -
                                         static_cast<double>(both.turn_rad))));
  }
  turn_sigma_rad_ = std::max(config.least_turn_sigma_rad, quantile(misses, 0.9));
  length_sigma_ = metric ? config.odometry_length_sigma : config.picture_length_sigma;
  const double typical_parallax_rad = quantile(parallaxes, 0.5);
  for (int i = 0; i + 1 < count; ++i) {
    const Point& from = points_[at(i)];
    Point& to = points_[at(i + 1)];
    to = from;
    const Step taken = tour_of[at(i)] == tour_of[at(i + 1)] ? step(images, i, typical_parallax_rad)
                                                            : Step{.motion = {}, .broken = true};
    to.pose = from.pose * taken.motion;
    to.breaks += taken.broken ? 1 : 0;
    to.length_variance += taken.length_variance;
    to.turn_variance += taken.turn_variance;
    to.turn_variance_x += taken.turn_variance * to.pose.x_m;
    to.turn_variance_y += taken.turn_variance * to.pose.y_m;
    to.turn_variance_r2 += taken.turn_variance * (square(to.pose.x_m) + square(to.pose.y_m));
  }
  measure_distances(tour_of);
  if (!metric) measure_lengths(tour_of);
}

void TourTrack::measure_distances(std::span<const int> tour_of) {
  constexpr double kShortest = 0.1;  // of a place extent: turning on the spot tells nothing
  std::vector<double> per_unit;
  for (int i = 0; i + 1 < images(); ++i) {
    if (tour_of[at(i)] != tour_of[at(i + 1)] || pairs_.relation(i, i + 1).inliers < config_.fewest_inliers) continue;
    const double length = predict(i, i + 1).distance;
    if (length > kShortest * place_extent_) per_unit.push_back(static_cast<double>(pairs_.distance(i, i + 1)) / length);
  }
  distance_per_unit_ = per_unit.empty() ? 1.0 : std::max(1e-6, quantile(per_unit, 0.5));
}

void TourTrack::measure_lengths(std::span<const int> tour_of) {
  // Images a short loop apart that look like one spot: how far the way reckoned between them is from closing.
  constexpr int kNeighbours = 12;
  constexpr int kShortLoop = 40;
  constexpr std::size_t kFewest = 20;
  const int count = static_cast<int>(points_.size());
  std::vector<LoopMiss> misses;
  for (int a = 0; a < count; ++a) {
    for (const int b : pairs_.partners(a)) {
      if (b <= a + kNeighbours || b > a + kShortLoop || tour_of[at(a)] != tour_of[at(b)]) continue;
      const PairRelation seen = pairs_.relation(a, b);
      if (seen.inliers < config_.fewest_inliers || apart(static_cast<double>(seen.distance)) > 1.0) continue;
      const double variance = points_[at(b)].length_variance - points_[at(a)].length_variance;
      if (!predict(a, b).known || !(variance > 0.0)) continue;
      // Where b lies by the way and where it is seen.
      const Pose2 reckoned = inverse(points_[at(a)].pose) * points_[at(b)].pose;
      const double seen_steps = apart(static_cast<double>(seen.distance));
      const double direction_rad = static_cast<double>(seen.direction_rad);
      const double squared = square(reckoned.x_m - seen_steps * std::cos(direction_rad)) +
                             square(reckoned.y_m - seen_steps * std::sin(direction_rad));
      misses.push_back({squared, variance, variance / square(length_sigma_)});
    }
  }
  if (misses.size() < kFewest) return;
  // Short loops fit better than long ones: some reserve.
  constexpr double kReserve = 1.5;
  const double share = kReserve * scale_of_misses(misses);
  const double measured = std::clamp(share * length_sigma_, config_.least_length_sigma, length_sigma_);
  const double factor = square(measured / length_sigma_);
  for (Point& point : points_) point.length_variance *= factor;
  length_sigma_ = measured;
}

TourTrack::Step TourTrack::step(std::span<const map::MapImage> images, int i, double typical_parallax_rad) const {
  const PairRelation seen = pairs_.relation(i, i + 1);
  const bool turn_seen = seen.inliers >= config_.fewest_inliers;
  const double seen_turn_rad = static_cast<double>(seen.turn_rad);
  Step result;
  if (metric_) {
    const Pose2 driven = inverse(*images[at(i)].odometry) * *images[at(i + 1)].odometry;
    const double conflict_rad = wrap_angle(seen_turn_rad - driven.theta_rad);
    result.broken = turn_seen && std::abs(conflict_rad) > config_.most_turn_conflict_rad;
    const bool by_picture = turn_seen && turn_sigma_rad_ < config_.odometry_turn_sigma_rad;
    const double turn_rad = by_picture ? seen_turn_rad : driven.theta_rad;
    // Half of the correction of the turn has happened by the middle of the step.
    const Pose2 turned{0.0, 0.0, by_picture ? conflict_rad / 2.0 : 0.0};
    result.motion = turned * Pose2{driven.x_m, driven.y_m, 0.0};
    result.motion.theta_rad = turn_rad;
    result.length_variance = square(length_sigma_ * std::hypot(driven.x_m, driven.y_m));
    result.turn_variance = square(by_picture ? turn_sigma_rad_ : config_.odometry_turn_sigma_rad);
    return result;
  }
  result.broken = !turn_seen || typical_parallax_rad < config_.least_typical_parallax_rad;
  if (result.broken) return result;
  const double length = std::min(1.0, 2.0 * static_cast<double>(seen.parallax_rad) / typical_parallax_rad);
  const double direction_rad = static_cast<double>(seen.direction_rad);
  result.motion = {length * std::cos(direction_rad), length * std::sin(direction_rad), seen_turn_rad};
  result.length_variance = square(length_sigma_ * length);
  result.turn_variance = square(turn_sigma_rad_);
  return result;
}

bool TourTrack::joined(int a, int b) const { return points_[at(a)].breaks == points_[at(b)].breaks; }

double TourTrack::length_variance(int a, int b) const {
  return std::abs(points_[at(b)].length_variance - points_[at(a)].length_variance);
}

double TourTrack::turn_variance(int a, int b) const {
  return std::abs(points_[at(b)].turn_variance - points_[at(a)].turn_variance);
}

double TourTrack::lever_variance(int a, int b) const {
  const Point& from = points_[at(std::min(a, b))];
  const Point& to = points_[at(std::max(a, b))];
  const double lever = (square(to.pose.x_m) + square(to.pose.y_m)) * (to.turn_variance - from.turn_variance) -
                       2.0 * to.pose.x_m * (to.turn_variance_x - from.turn_variance_x) -
                       2.0 * to.pose.y_m * (to.turn_variance_y - from.turn_variance_y) +
                       (to.turn_variance_r2 - from.turn_variance_r2);
  return std::max(0.0, lever);
}

TrackPrediction TourTrack::predict(int a, int b) const {
  TrackPrediction result;
  if (!joined(a, b)) return result;
  const Pose2& from = pose(a);
  const Pose2& to = pose(b);
  result.known = true;
  result.distance = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  result.distance_sigma = std::sqrt(lever_variance(a, b) + length_variance(a, b));
  const Pose2 between = inverse(from) * to;
  result.x = between.x_m;
  result.y = between.y_m;
  result.turn_rad = wrap_angle(to.theta_rad - from.theta_rad);
  result.turn_sigma_rad = std::sqrt(turn_variance(a, b));
  return result;
}

WayEvidence TourTrack::judge(int a, int b, const TrackPrediction& predicted) const {
  if (a == b) return {TrackVerdict::kAgrees, 1.0};
  if (!predicted.known) return {};
  const double beyond = predicted.distance - kFarthestExtents * place_extent_;
  if (beyond > config_.sure_sigmas * predicted.distance_sigma) return {TrackVerdict::kContradicts, 0.0};
  const PairRelation seen = pairs_.relation(a, b);
  if (seen.inliers >= config_.fewest_inliers) {
    const double miss_rad = std::abs(wrap_angle(static_cast<double>(seen.turn_rad) - predicted.turn_rad));
    if (miss_rad > config_.least_turn_margin_rad + config_.sure_sigmas * predicted.turn_sigma_rad) {
      return {TrackVerdict::kContradicts, 0.0};
    }
  }
  // Agreement is only worth something where the way could have told another place from this one.
  if (beyond > predicted.distance_sigma || predicted.distance_sigma > place_extent_) return {};
  const double place = square(kFarthestExtents * place_extent_);
  const double elsewhere = square(predicted.distance) + square(predicted.distance_sigma);
  return {TrackVerdict::kAgrees, std::exp(-0.5 * elsewhere / place)};
}

}  // namespace homeward::mapping
