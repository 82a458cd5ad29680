// SPDX-License-Identifier: Apache-2.0
#include "geometry/two_view.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/median.hpp"
#include "geometry/epipolar_px.hpp"
#include "geometry/turn_alone.hpp"

namespace homeward::geometry {
namespace {

constexpr double kSpreadOfMedian = 1.4826;  // standard deviation of normal errors over the median of their sizes
constexpr double kSureParallax = 3.0;       // spreads: rays that part by more do not meet
constexpr double kMostNearness = 5.0;       // a point is at least a fifth of the baseline away
constexpr int kRounds = 4;                  // of telling right from wrong and fitting again

double radians_per_px(const SeenPoint& seen) {
  return std::sqrt(std::sqrt(std::max((seen.bearing_per_px.transpose() * seen.bearing_per_px).determinant(), 0.0)));
}

/// The rays of a pair under a motion; nothing where they part by more than what `spread_px` explains, or meet next to
/// a viewpoint: wrong pairs can be made to agree with any motion towards one of their points.
std::optional<MeetingRays> meeting(const ViewMotion& motion, const PointPair& pair, double spread_px) {
  MeetingRays rays = triangulate(motion, pair.current.bearing, pair.target.bearing);
  if (std::max(rays.nearness, rays.from_target) > kMostNearness) return std::nullopt;
  if (rays.nearness > 0.0 && rays.from_target > 0.0) return rays;
  if (rays.parallax_rad > kSureParallax * spread_px * radians_per_px(pair.current)) return std::nullopt;
  rays.nearness = 0.0;
  rays.from_target = 0.0;
  rays.parallax_rad = 0.0;
  return rays;
}

/// Truncated squares, of those as well whose rays part.
double cost(const ViewMotion& motion, std::span<const PointPair> pairs, double most_px) {
  const EpipolarPixels error(motion);
  double sum = 0.0;
  for (const PointPair& pair : pairs) {
    const double off = std::abs(error(pair));
    const bool fits = off < most_px && meeting(motion, pair, 0.25 * most_px).has_value();
    sum += fits ? off * off : most_px * most_px;
  }
  return sum;
}

/// Of a motion and the one in the opposite direction the one whose rays meet.
ViewMotion in_front(ViewMotion motion, std::span<const PointPair> pairs, double most_px) {
  ViewMotion back = motion;
  back.target_in_current = -motion.target_in_current;
  return cost(back, pairs, most_px) < cost(motion, pairs, most_px) ? back : motion;
}

double spread_of(std::vector<double> sizes_px, const TwoViewConfig& config) {
  const auto count = static_cast<double>(sizes_px.size());
  const double few = 1.0 + 5.0 / std::max(count - 5.0, 1.0);  // Rousseeuw & Leroy 1987, ch. 5
  return std::max(kSpreadOfMedian * few * median(std::move(sizes_px)), config.least_spread_px);
}

struct Fit {
  RefinedMotion refined;
  double spread_px = 0.0;
};

/// A motion fitted to the pairs that agree with it, and again to those that then do. Wrong pairs are left out and not
/// only weighed down: each would pull the motion towards one of its points, where it agrees with anything.
Fit fitted(const ViewMotion& start, std::span<const PointPair> pairs, const TwoViewConfig& config) {
  Fit fit;
  fit.refined.motion = start;
  for (int round = 0; round < kRounds; ++round) {
    const EpipolarPixels error(fit.refined.motion);
    std::vector<double> sizes_px;
    for (const PointPair& pair : pairs) sizes_px.push_back(std::abs(error(pair)));
    fit.spread_px = spread_of(sizes_px, config);
    const double most_px = config.inlier_spreads * fit.spread_px;
    std::vector<PointPair> agreeing;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (sizes_px[i] <= most_px && meeting(fit.refined.motion, pairs[i], fit.spread_px)) agreeing.push_back(pairs[i]);
    }
    fit.refined = refine(fit.refined.motion, agreeing, most_px);
  }
  return fit;
}

std::optional<Fit> search(std::span<const PointPair> pairs, const TwoViewConfig& config, std::uint64_t seed,
                          const std::optional<ViewMotion>& expected) {
  std::vector<Correspondence> matches;
  std::vector<double> scales;
  for (const PointPair& pair : pairs) {
    matches.push_back({pair.current.bearing, pair.target.bearing});
    scales.push_back(radians_per_px(pair.current));
  }
  const double most_px = config.search_error_px;
  std::vector<ViewMotion> starts;
  if (expected) starts.push_back(*expected);
  const FivePointConfig five{config.max_iterations, config.sure_enough, most_px * median(scales)};
  for (const EssentialCandidate& candidate : search_essentials(matches, five, seed)) {
    for (const ViewMotion& motion : motions_of(candidate.essential)) starts.push_back(in_front(motion, pairs, most_px));
  }
  std::optional<Fit> best;
  double least = 0.0;
  for (const ViewMotion& start : starts) {
    Fit fit = fitted(start, pairs, config);
    const double now = cost(fit.refined.motion, pairs, most_px);
    if (best && now >= least) continue;
    least = now;
    best = std::move(fit);
  }
  return best;
}

double direction_spread_rad(const RefinedMotion& refined, double spread_px) {
  const Eigen::FullPivLU<Eigen::Matrix<double, 5, 5>> information(refined.information);
  constexpr double kUnknown = 1.6;  // a right angle: anywhere
  if (!information.isInvertible()) return kUnknown;
  const Eigen::Matrix2d covariance = information.inverse().bottomRightCorner<2, 2>();
  const double middle = 0.5 * covariance.trace();
  const double apart = std::hypot(0.5 * (covariance(0, 0) - covariance(1, 1)), covariance(0, 1));
  return std::min(spread_px * std::sqrt(std::max(middle + apart, 0.0)), kUnknown);
}

/// The inliers of a motion with a baseline, with their points and errors.
TwoViewEstimate judged(const RefinedMotion& refined, std::span<const PointPair> pairs, double spread_px,
                       const TwoViewConfig& config) {
  TwoViewEstimate estimate;
  estimate.motion = refined.motion;
  estimate.has_baseline = true;
  estimate.spread_px = spread_px;
  const EpipolarPixels error(refined.motion);
  double sum_px2 = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!(std::abs(error(pairs[i])) <= config.inlier_spreads * spread_px)) continue;
    const auto rays = meeting(refined.motion, pairs[i], spread_px);
    if (!rays) continue;
    estimate.inliers.push_back(static_cast<int>(i));
    estimate.rays.push_back(*rays);
    sum_px2 += reprojection_px2(pairs[i], *rays);
  }
  const auto count = static_cast<double>(std::max<std::size_t>(estimate.inliers.size(), 1));
  estimate.error_px = std::sqrt(sum_px2 / (2.0 * count));
  estimate.direction_spread_rad = direction_spread_rad(refined, spread_px);
  return estimate;
}

/// What a turn alone explains.
TwoViewEstimate judged(const TurnAlone& turn, std::span<const PointPair> pairs, const TwoViewConfig& config) {
  TwoViewEstimate estimate;
  estimate.motion.current_from_target = turn.current_from_target;
  // Of two coordinates: the median of their length is 1.177 standard deviations, that of one coordinate's size 0.6745.
  estimate.spread_px = spread_of(turn.off_px, config);
  double sum_px2 = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!(turn.off_px[i] <= std::max(config.inlier_spreads * estimate.spread_px, config.least_parallax_px))) continue;
    MeetingRays rays;
    rays.current = pairs[i].current.bearing;
    rays.target = turn.current_from_target.transpose() * rays.current;
    estimate.inliers.push_back(static_cast<int>(i));
    estimate.rays.push_back(rays);
    sum_px2 += 0.5 * turn.off_px[i] * turn.off_px[i];  // half of the way in each picture
  }
  const auto count = static_cast<double>(std::max<std::size_t>(estimate.inliers.size(), 1));
  estimate.error_px = std::sqrt(sum_px2 / (2.0 * count));
  estimate.direction_spread_rad = 1.6;
  return estimate;
}

double upper_quarter(const std::vector<int>& of, const std::vector<double>& values) {
  std::vector<double> chosen;
  for (const int i : of) chosen.push_back(values[static_cast<std::size_t>(i)]);
  if (chosen.empty()) return 0.0;
  const auto at = chosen.begin() + static_cast<std::ptrdiff_t>(3 * chosen.size() / 4);
  std::nth_element(chosen.begin(), at, chosen.end());
  return *at;
}

}  // namespace

std::vector<std::string> problems(const TwoViewConfig& config) {
  std::vector<std::string> found;
  const auto expect = [&](bool holds, const char* problem) {
    if (!holds) found.emplace_back(problem);
  };
  expect(config.fewest_pairs >= 6, "fewest_pairs is less than 6");
  expect(config.max_iterations >= 1, "max_iterations is not positive");
  expect(config.sure_enough > 0.0 && config.sure_enough < 1.0, "sure_enough is not between 0 and 1");
  expect(config.search_error_px > 0.0, "search_error_px is not positive");
  expect(config.least_spread_px > 0.0, "least_spread_px is not positive");
  expect(config.inlier_spreads > 0.0, "inlier_spreads is not positive");
  expect(config.least_parallax_px >= 0.0, "least_parallax_px is negative");
  return found;
}

Result<TwoViewEstimate> estimate_two_view(std::span<const PointPair> pairs, const TwoViewConfig& config,
                                          std::uint64_t seed, const std::optional<ViewMotion>& expected) {
  if (const auto wrong = problems(config); !wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  const auto fewest = static_cast<std::size_t>(config.fewest_pairs);
  if (pairs.size() < fewest) return fail(ErrorCode::kTooLittleSupport, "Too few points are seen in both views.");
  const TurnAlone turn = fit_turn(pairs, config.search_error_px, seed);
  TwoViewEstimate by_turn = judged(turn, pairs, config);
  const auto found = search(pairs, config, seed, expected);
  TwoViewEstimate estimate = by_turn;
  if (found) {
    estimate = judged(found->refined, pairs, found->spread_px, config);
    estimate.parallax_px = upper_quarter(estimate.inliers, turn.off_px);
    by_turn.parallax_px = estimate.parallax_px;
    if (estimate.parallax_px < config.least_parallax_px) estimate = std::move(by_turn);
  }
  if (estimate.inliers.size() < fewest) return fail(ErrorCode::kTooLittleSupport, "Too few points agree on a motion.");
  return estimate;
}

}  // namespace homeward::geometry
