// SPDX-License-Identifier: Apache-2.0
#include "geometry/two_view.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/median.hpp"
#include "geometry/error_mixture.hpp"
#include "geometry/turn_alone.hpp"

namespace homeward::geometry {
namespace {

constexpr double kFarOff_px = 1e4;

constexpr double kSureParallax = 3.0;        // spreads: rays that part by more do not meet
constexpr double kMostNearness = 5.0;        // a point is at least a fifth of the baseline away
constexpr double kSameDirection_rad = 0.15;  // motions nearer to each other are no rivals
constexpr int kRounds = 4;                   // of telling right from wrong and fitting again

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

/// The turn about the vertical alone.
Eigen::Matrix3d level_turn(const Eigen::Matrix3d& turn) {
  const double turn_rad = std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
  return Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// Of a motion and the one in the opposite direction the one whose rays meet.
ViewMotion in_front(const ViewMotion& motion, std::span<const PointPair> pairs, double most_px) {
  ViewMotion back = motion;
  back.target_in_current = -motion.target_in_current;
  return cost(back, pairs, most_px) < cost(motion, pairs, most_px) ? back : motion;
}

struct Fit {
  RefinedMotion refined;
  ErrorMixture errors;
};

/// The errors of pairs by size; infinite for those whose rays part.
std::vector<double> sizes_px(const ViewMotion& motion, std::span<const PointPair> pairs, double spread_px) {
  const EpipolarPixels error(motion);
  std::vector<double> sizes;
  for (const PointPair& pair : pairs) {
    const bool meets = meeting(motion, pair, spread_px).has_value();
    sizes.push_back(meets ? std::abs(error(pair)) : std::numeric_limits<double>::infinity());
  }
  return sizes;
}

/// A motion fitted to the pairs that agree with it, and again to those that then do. Wrong pairs are left out and not
/// only weighed down: each would pull the motion towards one of its points, where it agrees with anything.
Fit fitted(const ViewMotion& start, std::span<const PointPair> pairs, const TwoViewConfig& config) {
  Fit fit;
  fit.refined.motion = start;
  fit.errors.spread_px = config.search_error_px;
  for (int round = 0; round < kRounds; ++round) {
    const auto sizes = sizes_px(fit.refined.motion, pairs, fit.errors.spread_px);
    fit.errors = error_mixture(sizes, config.least_spread_px, config.wrong_reach_px);
    const double most_px = config.inlier_spreads * fit.errors.spread_px;
    std::vector<PointPair> agreeing;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (sizes[i] <= most_px) agreeing.push_back(pairs[i]);
    }
    fit.refined = refine(fit.refined.motion, agreeing, most_px, config.driving, fit.errors.spread_px);
  }
  const auto sizes = sizes_px(fit.refined.motion, pairs, fit.errors.spread_px);
  fit.errors = error_mixture(sizes, config.least_spread_px, config.wrong_reach_px);
  return fit;
}

/// What a motion can be near: that of samples, the one expected, and driving straight.
std::vector<ViewMotion> starts_of(std::span<const PointPair> pairs, const TwoViewConfig& config, std::uint64_t seed,
                                  const MotionExpectation& expected, const TurnAlone& turn) {
  std::vector<Correspondence> matches;
  std::vector<double> scales;
  for (const PointPair& pair : pairs) {
    matches.push_back({pair.current.bearing, pair.target.bearing});
    scales.push_back(radians_per_px(pair.current));
  }
  const double most_px = config.search_error_px;
  std::vector<ViewMotion> starts = expected.motions;
  if (config.driving) {
    const ViewMotion ahead{level_turn(turn.current_from_target), Eigen::Vector3d::UnitX()};
    starts.push_back(in_front(ahead, pairs, most_px));
  }
  const FivePointConfig five{config.max_iterations, config.sure_enough, most_px * median(scales)};
  for (const EssentialCandidate& candidate : search_essentials(matches, five, seed)) {
    for (const ViewMotion& motion : motions_of(candidate.essential)) starts.push_back(in_front(motion, pairs, most_px));
  }
  return starts;
}

/// A motion fitted, with how likely it is by pairs and prior, and the best other one.
struct Likeliest {
  Fit fit;
  double log_likelihood = 0.0;
  double lead = std::numeric_limits<double>::infinity();
  double rival_rad = 0.0;  // between the directions
};

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::optional<Likeliest> likeliest(std::span<const ViewMotion> starts, std::span<const PointPair> pairs,
                                   const TwoViewConfig& config, const MotionExpectation& expected) {
  std::vector<Likeliest> fits;
  for (const ViewMotion& start : starts) {
    Likeliest one;
    one.fit = fitted(start, pairs, config);
    one.log_likelihood = one.fit.errors.log_likelihood - 0.5 * unlike_driving(one.fit.refined.motion, config.driving);
    if (expected.log_likelihood) one.log_likelihood += expected.log_likelihood(one.fit.refined.motion);
    fits.push_back(std::move(one));
  }
  if (fits.empty()) return std::nullopt;
  Likeliest best = *std::ranges::max_element(fits, {}, &Likeliest::log_likelihood);
  for (const Likeliest& other : fits) {
    const double apart_rad =
        angle_between(best.fit.refined.motion.target_in_current, other.fit.refined.motion.target_in_current);
    const double lead = best.log_likelihood - other.log_likelihood;
    if (apart_rad < kSameDirection_rad || lead >= best.lead) continue;
    best.lead = lead;
    best.rival_rad = apart_rad;
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
  estimate.spread_px = error_mixture_on_plane(turn.off_px, config.least_spread_px, config.wrong_reach_px).spread_px;
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

/// Whether a turn is the likelier of the two models: wrong pairs agree with some direction as easily as right ones do
/// when there is none, but not with one turn (the choice of models after Torr 1997, by likelihood and Schwarz 1978).
bool is_likelier(const TurnAlone& turn, const ErrorMixture& across_lines, const TwoViewConfig& config) {
  constexpr double kMoreUnknowns = 2.0;
  const double reach_px = config.wrong_reach_px;
  const std::size_t count = turn.off_px.size();
  const double by_turn = error_mixture_on_plane(turn.off_px, config.least_spread_px, reach_px).log_likelihood;
  const double penalty = 0.5 * kMoreUnknowns * std::log(static_cast<double>(count));
  return by_turn > log_likelihood_on_plane(across_lines, count, reach_px) - penalty;
}

/// At most kFarOff_px, as a point over a right angle off, which a wide lens may show, is off by no number of pixels.
double upper_quarter(const std::vector<int>& of, const std::vector<double>& values) {
  std::vector<double> chosen;
  chosen.reserve(of.size());
  for (const int i : of) chosen.push_back(values[static_cast<std::size_t>(i)]);
  if (chosen.empty()) return 0.0;
  const auto at = chosen.begin() + static_cast<std::ptrdiff_t>(3 * chosen.size() / 4);
  std::nth_element(chosen.begin(), at, chosen.end());
  return std::min(*at, kFarOff_px);
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
  expect(config.most_direction_spread_rad > 0.0, "most_direction_spread_rad is not positive");
  expect(config.wrong_reach_px > 2.0 * config.least_spread_px, "wrong_reach_px is less than two least_spread_px");
  const auto& driving = config.driving;
  expect(!driving || (driving->tilt_rad > 0.0 && driving->climb_rad > 0.0 && driving->swerve_rad > 0.0),
         "driving has a spread that is not positive");
  expect(config.least_parallax_px >= 0.0, "least_parallax_px is negative");
  return found;
}

Result<TwoViewEstimate> estimate_two_view(std::span<const PointPair> pairs, const TwoViewConfig& config,
                                          std::uint64_t seed, const MotionExpectation& expected) {
  if (const auto wrong = problems(config); !wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  const auto fewest = static_cast<std::size_t>(config.fewest_pairs);
  if (pairs.size() < fewest) return fail(ErrorCode::kTooLittleSupport, "Too few points are seen in both views.");
  const TurnAlone turn = fit_turn(pairs, config.search_error_px, seed);
  TwoViewEstimate by_turn = judged(turn, pairs, config);
  const auto found = likeliest(starts_of(pairs, config, seed, expected, turn), pairs, config, expected);
  TwoViewEstimate estimate = by_turn;
  if (found) {
    estimate = judged(found->fit.refined, pairs, found->fit.errors.spread_px, config);
    estimate.lead = found->lead;
    // One of two: the likelier one, or with the rest of the probability its rival.
    const double rival_share = 1.0 / (1.0 + std::exp(std::min(found->lead, 100.0)));
    estimate.direction_spread_rad =
        std::hypot(estimate.direction_spread_rad, std::sqrt(rival_share) * found->rival_rad);
    estimate.parallax_px = upper_quarter(estimate.inliers, turn.off_px);
    by_turn.parallax_px = estimate.parallax_px;
    const bool turn_explains = 5 * by_turn.inliers.size() >= 4 * estimate.inliers.size();
    const bool is_blind = estimate.direction_spread_rad > config.most_direction_spread_rad && turn_explains;
    if (estimate.parallax_px < config.least_parallax_px || is_blind || is_likelier(turn, found->fit.errors, config)) {
      estimate = std::move(by_turn);
    }
  }
  if (estimate.inliers.size() < fewest) return fail(ErrorCode::kTooLittleSupport, "Too few points agree on a motion.");
  return estimate;
}

}  // namespace homeward::geometry
