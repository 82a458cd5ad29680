// SPDX-License-Identifier: Apache-2.0
#include "repeat/landmark_follower.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/median.hpp"
#include "repeat/seen.hpp"

namespace homeward::repeat {
namespace {

constexpr double kSpreads = 2.5;

/// The size of a landmark against a reference, from where it is `distance` away.
double size_against(const FollowedLandmark::Reference& reference, double distance) {
  return distance > 1e-9 ? reference.distance / distance : 1.0;
}

bool is_inside(const camera::Camera& camera, const Eigen::Vector2d& pixel_px) {
  constexpr double kMargin_px = 8.0;  // half a tracker's window
  const camera::CameraConfig& config = camera.config();
  return pixel_px.x() >= kMargin_px && pixel_px.y() >= kMargin_px && pixel_px.x() <= config.width_px - 1 - kMargin_px &&
         pixel_px.y() <= config.height_px - 1 - kMargin_px;
}

}  // namespace

void LandmarkFollower::renew(const ArcSurroundings& around, const ArcPose& pose, References references) {
  const std::vector<FollowedLandmark> before = std::exchange(landmarks_, {});
  const References references_before = std::exchange(references_, std::move(references));
  for (const Landmark& landmark : around.landmarks) {
    FollowedLandmark one;
    one.landmark = landmark;
    for (std::size_t slot = 0; slot < references_.size(); ++slot) {
      const auto reference = references_[slot]->reference_of(landmark.feature);
      if (!reference) continue;
      const Eigen::Vector3d& from = around.key(references_[slot]->key()).position;
      one.references.push_back({slot, *reference, (landmark.bearing - landmark.nearness * from).norm()});
    }
    if (one.references.empty()) continue;
    const auto known = std::ranges::lower_bound(before, landmark.feature, {},
                                                [](const FollowedLandmark& other) { return other.landmark.feature; });
    if (known != before.end() && known->landmark.feature == landmark.feature && known->is_tracked) {
      const FollowedLandmark::Reference& old = known->references[known->by];
      one.is_tracked = true;
      one.pixel_px = known->pixel_px;
      one.seen = known->seen;
      one.scale = known->scale;
      one.gain = known->gain;
      const auto same = std::ranges::find_if(one.references, [&](const FollowedLandmark::Reference& reference) {
        return references_[reference.slot]->key() == references_before[old.slot]->key();
      });
      if (same != one.references.end()) {
        one.by = static_cast<std::size_t>(same - one.references.begin());
      } else {
        choose_reference(one, pose, 1.0);
        one.scale = size_against(one.references[one.by], expected_at(pose, landmark).distance);
      }
    }
    landmarks_.push_back(std::move(one));
  }
}

void LandmarkFollower::choose_reference(FollowedLandmark& one, const ArcPose& pose, double turn_from) const {
  const double distance = expected_at(pose, one.landmark).distance;
  const auto unlike = [&](std::size_t i) { return std::abs(std::log(size_against(one.references[i], distance))); };
  std::size_t best = one.by;
  for (std::size_t i = 0; i < one.references.size(); ++i) {
    if (unlike(i) < unlike(best)) best = i;
  }
  if (best == one.by || unlike(one.by) - unlike(best) < std::log(turn_from)) return;
  one.scale *= one.references[best].distance / one.references[one.by].distance;
  one.by = best;
}

bool LandmarkFollower::track(FollowedLandmark& one, const tracking::ImagePyramid& picture,
                             const Eigen::Vector2d& at_px) {
  const FollowedLandmark::Reference& reference = one.references[one.by];
  const tracking::FeatureGuess guess{reference.reference, at_px, one.scale};
  const auto found = references_[reference.slot]->tracker().track(picture, std::span(&guess, 1)).front();
  one.is_tracked = false;
  if (found.state != tracking::FeatureState::kTracked) return false;
  const auto seen = seen_at(*camera_, found.pixel_px);
  if (!seen) return false;
  one.is_tracked = true;
  one.pixel_px = found.pixel_px;
  one.scale = found.scale;
  one.gain = found.gain;
  one.seen = *seen;
  return true;
}

void LandmarkFollower::follow(const tracking::ImagePyramid& picture, const ArcPose& pose, const PixelGuess& guess,
                              const RepeatConfig& config) {
  for (FollowedLandmark& one : landmarks_) {
    if (!one.is_tracked) continue;
    choose_reference(one, pose, config.turn_from_scale);
    track(one, picture, guess(one.pixel_px));
  }
}

int LandmarkFollower::search(const tracking::ImagePyramid& picture, const ArcPose& pose, double most_off_rad,
                             const RepeatConfig& config) {
  int found = 0;
  int tried = 0;
  for (std::size_t i = 0; i < landmarks_.size() && tried < config.most_predicted; ++i) {
    const std::size_t index = (search_from_ + i) % landmarks_.size();
    FollowedLandmark& one = landmarks_[index];
    if (one.is_tracked) continue;
    const Expected expected = expected_at(pose, one.landmark);
    const auto at_px = camera_->pixel(expected.bearing);
    if (!at_px || !is_inside(*camera_, *at_px)) continue;
    const auto there = seen_at(*camera_, *at_px);
    if (!there) continue;
    choose_reference(one, pose, 1.0);
    one.scale = size_against(one.references[one.by], expected.distance);
    ++tried;
    if (!track(one, picture, *at_px)) continue;
    const double radians_per_px = there->bearing_per_px.norm() / std::sqrt(2.0);
    one.is_tracked = (one.pixel_px - *at_px).norm() * radians_per_px <= most_off_rad + kSpreads * expected.spread_rad;
    found += one.is_tracked ? 1 : 0;
  }
  if (!landmarks_.empty() && tried == config.most_predicted) search_from_ = (search_from_ + 37) % landmarks_.size();
  return found;
}

void LandmarkFollower::lose_all() {
  for (FollowedLandmark& one : landmarks_) one.is_tracked = false;
}

int LandmarkFollower::tracked() const {
  return static_cast<int>(std::ranges::count_if(landmarks_, &FollowedLandmark::is_tracked));
}

std::vector<std::size_t> LandmarkFollower::tracked_ones() const {
  std::vector<std::size_t> ones;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (landmarks_[i].is_tracked) ones.push_back(i);
  }
  return ones;
}

/// Of what is tracked, against its references: 1 where that is about as much, or where too few say so.
double LandmarkFollower::contrast() const {
  constexpr std::size_t kFewest = 8;
  std::vector<double> gains;
  for (const FollowedLandmark& one : landmarks_) {
    if (one.is_tracked) gains.push_back(one.gain);
  }
  const double gain = gains.size() < kFewest ? 1.0 : median(std::move(gains));
  return gain < tracking::kDarkGain ? gain : 1.0;
}

int LandmarkFollower::expected(const ArcPose& pose, double least_visible) const {
  const double gain = contrast();
  int count = 0;
  for (const FollowedLandmark& one : landmarks_) {
    const FollowedLandmark::Reference& reference = one.references[one.by];
    const double texture = references_[reference.slot]->tracker().texture(reference.reference);
    if (gain < 1.0 && texture * gain * gain < least_visible) continue;
    const auto at_px = camera_->pixel(expected_at(pose, one.landmark).bearing);
    count += at_px && is_inside(*camera_, *at_px) ? 1 : 0;
  }
  return count;
}

const geometry::SeenPoint* LandmarkFollower::in_key(std::size_t landmark, int key) const {
  for (const FollowedLandmark::Reference& reference : landmarks_[landmark].references) {
    const KeyReferences& references = *references_[reference.slot];
    if (references.key() == key) return &references.seen(reference.reference);
  }
  return nullptr;
}

}  // namespace homeward::repeat
