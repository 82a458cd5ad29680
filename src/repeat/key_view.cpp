// SPDX-License-Identifier: Apache-2.0
#include "repeat/key_view.hpp"

#include <cmath>

#include "core/index.hpp"
#include "core/median.hpp"

namespace homeward::repeat {
namespace {

/// The way from the key image to the current picture in units of the surroundings: the median over common landmarks.
std::optional<double> length_of(const geometry::TwoViewEstimate& estimate, const KeyView& view,
                                const LandmarkFollower& follower, const KeyPose& key) {
  constexpr std::size_t kFewest = 3;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < estimate.inliers.size(); ++i) {
    const Landmark& landmark = follower.landmarks()[view.landmarks[at(estimate.inliers[i])]].landmark;
    const double nearness = estimate.rays[i].from_target;
    if (!landmark.has_distance || !(nearness > 0.0) || !(landmark.nearness > 2.0 * landmark.nearness_spread)) continue;
    lengths.push_back(nearness * (landmark.bearing - landmark.nearness * key.position).norm() / landmark.nearness);
  }
  if (lengths.size() < kFewest) return std::nullopt;
  return median(std::move(lengths));
}

}  // namespace

std::optional<KeyView> view_of_key(const LandmarkFollower& follower, const ArcSurroundings& around, int key,
                                   const geometry::TwoViewConfig& config, std::uint64_t seed) {
  if (!around.has_key(key)) return std::nullopt;
  KeyView view;
  view.key = key;
  std::vector<geometry::PointPair> pairs;
  for (const std::size_t i : follower.tracked_ones()) {
    const geometry::SeenPoint* in_key = follower.in_key(i, key);
    if (in_key == nullptr) continue;
    view.landmarks.push_back(i);
    pairs.push_back({follower.landmarks()[i].seen, *in_key});
  }
  const auto estimate = geometry::estimate_two_view(pairs, config, seed);
  if (!estimate) return std::nullopt;
  const KeyPose& there = around.key(key);
  const geometry::ViewMotion& motion = estimate->motion;
  view.pose.local_from_current = there.local_from_key * motion.current_from_target.transpose();
  view.pose.position = there.position;
  view.has_baseline = estimate->has_baseline;
  view.error_px = estimate->error_px;
  view.agreeing = static_cast<int>(estimate->inliers.size());
  view.agrees.resize(pairs.size());
  for (const int inlier : estimate->inliers) view.agrees[at(inlier)] = true;
  if (!view.has_baseline) return view;
  const auto length = length_of(*estimate, view, follower, there);
  view.has_length = length.has_value();
  if (length) view.pose.position -= *length * (view.pose.local_from_current * motion.target_in_current);
  return view;
}

}  // namespace homeward::repeat
