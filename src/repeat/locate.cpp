// SPDX-License-Identifier: Apache-2.0
// The part of Repeater that tells where a picture was taken, and looks around where that is not known.
#include <algorithm>
#include <utility>

#include "core/index.hpp"
#include "repeat/picture_shift.hpp"
#include "repeat/repeater.hpp"
#include "repeat/turned_pixels.hpp"

namespace homeward::repeat {

/// A pose turned by what shifts the whole of a picture against another one that was taken from it.
ArcPose Repeater::turned_by_shift(ArcPose pose, const tracking::ImagePyramid& there,
                                  const tracking::ImagePyramid& picture) const {
  const auto shift_px = picture_shift(there, picture);
  if (!shift_px) return pose;
  const TurnedPixels turned(*camera_, *shift_px);
  if (!turned.after_from_before()) return pose;
  pose.local_from_current = pose.local_from_current * turned.after_from_before()->inverse().toRotationMatrix();
  return pose;
}

/// Everything is looked for from the last pose, from it turned by what shifts the whole picture, and from key images
/// around, in turn, the nearest first, turned likewise. What most agrees with is taken.
Repeater::Located Repeater::look_around(const tracking::ImagePyramid& picture) {
  struct Start {
    ArcPose pose;
    int key;
  };
  std::vector<Start> starts{{pose_, arc_of(around_->arc).from}};
  if (latest_) starts.push_back({turned_by_shift(pose_, *latest_, picture), starts.front().key});
  const int first = *around_->position_of(starts.front().key);
  const int keys = static_cast<int>(around_->keys.size());
  for (int i = 0; i < std::min(config_.keys_tried, keys); ++i) {
    const int number = (lost_for_ * config_.keys_tried + i) % keys;  // 0, 1, -1, 2, -2, ... from the first
    const int position = first + ((number % 2) == 1 ? (number + 1) / 2 : -(number / 2));
    if (position < 0 || position >= keys) continue;
    const KeyPose& placed = around_->keys[at(position)];
    const auto there = pictures_(placed.key);
    if (!there) continue;
    starts.push_back({turned_by_shift({placed.local_from_key, placed.position}, *there, picture), placed.key});
  }
  const ArcPose before = pose_;
  follower_.lose_all();
  const LandmarkFollower nothing = follower_;
  LandmarkFollower best_follower = nothing;
  Located best;
  for (const Start& start : starts) {
    follower_ = nothing;
    Located located = locate_from(start.pose, start.key, 0, picture);
    if (located.is_lost() || located.agreeing <= best.agreeing) continue;
    best = std::move(located);
    best_follower = std::move(follower_);
  }
  pose_ = before;
  follower_ = std::move(best_follower);
  return best;
}

/// Looks for everything from a pose that may be some way off: widely first, then again from where that says. More has
/// to agree than where a place is expected, which other features that one motion explains make up for: by little light
/// few landmarks are found of those that are there.
Repeater::Located Repeater::locate_from(const ArcPose& start, int key, int others_agreeing,
                                        const tracking::ImagePyramid& picture) {
  pose_ = start;
  follower_.search(picture, pose_, config_.most_from_start_rad, config_);
  Located located = locate(key);
  if (located.agreeing < config_.fewest_features) return located;
  pose_ = located.pose;
  drop_what_disagrees(located);
  follower_.search(picture, pose_, config_.most_from_predicted_rad, config_);
  located = locate(key);
  const double least = std::max<double>(
      config_.fewest_recovered,
      config_.least_recovered * follower_.expected(located.pose, config_.least_visible) - others_agreeing);
  if (!located.is_lost() && located.agreeing < least) located.lost = LostReason::kTooFewFeatures;
  return located;
}

/// Where the tracked features say that the picture was taken. `key`: the first of the two key images that are asked
/// where the landmarks explain too little.
Repeater::Located Repeater::locate(int key) const {
  Located located;
  located.pose = pose_;
  located.landmarks = follower_.tracked_ones();
  if (static_cast<int>(located.landmarks.size()) < config_.fewest_features) return located;
  std::vector<SeenLandmark> seen;
  for (const std::size_t i : located.landmarks) {
    seen.push_back({follower_.landmarks()[i].landmark, follower_.landmarks()[i].seen});
  }
  const PoseFit fit = fit_pose(seen, *around_, pose_, config_.pose);
  located.pose = fit.pose;
  located.agrees = fit.agrees;
  located.agreeing = fit.agreeing;
  located.error_px = fit.error_px;
  located.error_rad = fit.error_rad;
  const double count = static_cast<double>(seen.size());
  if (fit.agreeing < config_.enough_agreeing * count) located = locate_by_keys(key, seen, std::move(located));
  located.lost = LostReason::kNone;
  const double least = std::max<double>(
      config_.fewest_features, config_.least_expected * follower_.expected(located.pose, config_.least_visible));
  if (located.agreeing < least) located.lost = LostReason::kTooFewFeatures;
  if (located.agreeing < config_.least_agreeing * count) located.lost = LostReason::kNoGeometry;
  if (located.error_rad > config_.most_error_rad) located.lost = LostReason::kErrorTooLarge;
  return located;
}

/// Asks the pictures themselves, where the arc's landmarks do not explain what is seen: the geometries towards both key
/// images, each as it is and as a beginning for the landmarks.
Repeater::Located Repeater::locate_by_keys(int from, std::span<const SeenLandmark> seen, Located best) const {
  std::vector<int> keys{from};
  if (const KeyPose* next = around_->next_key(from); next != nullptr) keys.push_back(next->key);
  std::vector<KeyView> views;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    auto view = view_of_key(follower_, *around_, keys[i], config_.geometry,
                            config_.seed + 2 * static_cast<std::uint64_t>(pictures_seen_) + i);
    if (!view) continue;
    const PoseFit fit = fit_pose(seen, *around_, view->pose, config_.pose);
    if (fit.agreeing > best.agreeing) {
      best.pose = fit.pose;
      best.agrees = fit.agrees;
      best.agreeing = fit.agreeing;
      best.error_px = fit.error_px;
      best.error_rad = fit.error_rad;
    }
    views.push_back(*std::move(view));
  }
  const double count = static_cast<double>(seen.size());
  if (best.agreeing >= config_.enough_agreeing * count) return best;
  // The structure explains less than it should. Do the pictures? What it alone vouches for is dropped then.
  std::vector<bool> agrees(seen.size(), false);
  const KeyView* most = nullptr;
  for (const KeyView& view : views) {
    if (view.agreeing < config_.enough_agreeing * static_cast<double>(view.landmarks.size())) continue;
    if (most == nullptr || view.agreeing > most->agreeing) most = &view;
    for (std::size_t i = 0; i < view.landmarks.size(); ++i) {
      const auto found = std::ranges::lower_bound(best.landmarks, view.landmarks[i]);
      if (view.agrees[i]) agrees[static_cast<std::size_t>(found - best.landmarks.begin())] = true;
    }
  }
  const auto agreeing = static_cast<int>(std::ranges::count(agrees, true));
  if (most == nullptr || agreeing <= best.agreeing) return best;
  best.structure_agrees = false;
  best.pose = most->pose;
  best.error_rad *= most->error_px / std::max(1e-9, best.error_px);
  best.error_px = most->error_px;
  best.agrees = std::move(agrees);
  best.agreeing = agreeing;
  return best;
}

}  // namespace homeward::repeat
