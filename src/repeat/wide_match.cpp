// SPDX-License-Identifier: Apache-2.0
#include "repeat/wide_match.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/index.hpp"

namespace homeward::repeat {
namespace {

/// A matched pixel of the first picture, and how it lies in the second.
struct Anchor {
  Eigen::Vector2d first_px;
  Eigen::Vector2d shift_px;  // by more than the turn
  double scale = 1.0;        // size in the second picture over that in the first
};

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

/// Not a number where it is turned out of the picture.
Eigen::Vector2d turned_px(const camera::Camera& camera, const Eigen::Matrix3d& turn, const Eigen::Vector2d& pixel_px) {
  const auto bearing = camera.bearing(pixel_px);
  if (!bearing) return {kNowhere, kNowhere};
  return camera.pixel(turn * *bearing).value_or(Eigen::Vector2d(kNowhere, kNowhere));
}

std::vector<Anchor> anchors_of(const WideMatch& match, const camera::Camera& camera, const Eigen::Matrix3d& turn) {
  constexpr double kMostScale = 2.0;
  std::vector<Anchor> anchors;
  for (std::size_t i = 0; i < match.first_px.size(); ++i) {
    Anchor anchor;
    anchor.first_px = match.first_px[i];
    anchor.shift_px = match.second_px[i] - turned_px(camera, turn, match.first_px[i]);
    if (!anchor.shift_px.allFinite()) continue;
    const geometry::MeetingRays& rays = match.estimate.rays[i];
    if (match.estimate.has_baseline && rays.nearness > 0.0 && rays.from_target > 0.0) {
      anchor.scale = std::clamp(rays.from_target / rays.nearness, 1.0 / kMostScale, kMostScale);
    }
    anchors.push_back(anchor);
  }
  return anchors;
}

/// Squared distance of each feature of a picture to the one that is most like it there.
std::vector<std::int32_t> to_most_alike(const DescribedPicture& picture) {
  return matching::find_nearest(picture.descriptors, picture.descriptors).second_distance;
}

/// Matches of features that are less like any other one of their own picture than like each other: what repeats, as a
/// wallpaper does, looks the same in another place, too, and shifted by its period.
std::vector<DescribedMatch> distinct_matches(const DescribedPicture& first, const DescribedPicture& second,
                                             double ratio) {
  std::vector<DescribedMatch> matches = matches_of(first, second, ratio);
  if (matches.empty()) return matches;
  const auto in_first = to_most_alike(first);
  const auto in_second = to_most_alike(second);
  std::erase_if(matches, [&](const DescribedMatch& match) {
    const double least = std::min(in_first[at(match.first)], in_second[at(match.second)]);
    return match.distance >= ratio * ratio * least;
  });
  return matches;
}

}  // namespace

std::optional<WideMatch> wide_match(const DescribedPicture& first, const DescribedPicture& second,
                                    const camera::Camera& camera, const RecognitionConfig& config,
                                    const geometry::TwoViewConfig& geometry, std::uint64_t seed) {
  const std::vector<DescribedMatch> matches = distinct_matches(first, second, config.ratio);
  std::vector<geometry::PointPair> pairs;
  pairs.reserve(matches.size());
  for (const DescribedMatch& match : matches) {
    pairs.push_back({first.seen[at(match.first)], second.seen[at(match.second)]});
  }
  if (pairs.size() < at(config.fewest_agreeing)) return std::nullopt;
  auto estimate = geometry::estimate_two_view(pairs, geometry, seed);
  const double least =
      std::max<double>(config.fewest_agreeing, config.least_agreeing * static_cast<double>(pairs.size()));
  if (!estimate || static_cast<double>(estimate->inliers.size()) < least) return std::nullopt;
  WideMatch found;
  for (const int inlier : estimate->inliers) {
    const geometry::PointPair& pair = pairs[at(inlier)];
    const auto first_px = camera.pixel(pair.current.bearing);
    const auto second_px = camera.pixel(pair.target.bearing);
    if (!first_px || !second_px) return std::nullopt;  // a camera that does not see what it saw
    found.first_px.push_back(*first_px);
    found.second_px.push_back(*second_px);
  }
  found.compared = static_cast<int>(pairs.size());
  found.estimate = *std::move(estimate);
  return found;
}

WideMatch reversed(const WideMatch& match) {
  WideMatch back = match;
  std::swap(back.first_px, back.second_px);
  geometry::ViewMotion& motion = back.estimate.motion;
  motion.current_from_target = match.estimate.motion.current_from_target.transpose();
  motion.target_in_current = -(motion.current_from_target * match.estimate.motion.target_in_current);
  for (geometry::MeetingRays& rays : back.estimate.rays) {
    std::swap(rays.current, rays.target);
    std::swap(rays.nearness, rays.from_target);
  }
  return back;
}

GuessPlace guess_by(const WideMatch& match, const camera::Camera& camera) {
  const Eigen::Matrix3d turn = match.estimate.motion.current_from_target.transpose();
  return [anchors = anchors_of(match, camera, turn), turn, &camera](const Eigen::Vector2d& pixel_px, double scale) {
    constexpr double kNear_px = 4.0;  // nearer anchors count no more
    Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
    double log_scale = 0.0;
    double weights = 0.0;
    for (const Anchor& anchor : anchors) {
      // The nearest few decide: the weight falls with the fourth power of the distance.
      const double weight = 1.0 / std::pow((anchor.first_px - pixel_px).squaredNorm() + kNear_px * kNear_px, 2.0);
      shift_px += weight * anchor.shift_px;
      log_scale += weight * std::log(anchor.scale);
      weights += weight;
    }
    return PlaceGuess{turned_px(camera, turn, pixel_px) + shift_px / weights, scale * std::exp(log_scale / weights)};
  };
}

double turn_between_rad(const geometry::ViewMotion& one, const geometry::ViewMotion& other) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(one.current_from_target.transpose() * other.current_from_target)).angle();
}

}  // namespace homeward::repeat
