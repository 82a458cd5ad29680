// SPDX-License-Identifier: Apache-2.0
#include "repeat/repeater.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/index.hpp"
#include "repeat/arc_progress.hpp"
#include "repeat/picture_shift.hpp"
#include "repeat/turned_pixels.hpp"

namespace homeward::repeat {

Repeater::Repeater(const RepeatConfig& config, std::shared_ptr<const TaughtPath> path, KeyPictures pictures,
                   std::shared_ptr<const camera::Camera> camera)
    : config_(config),
      path_(std::move(path)),
      pictures_(std::move(pictures)),
      camera_(std::move(camera)),
      follower_(camera_) {}

Result<Repeater> Repeater::create(const RepeatConfig& config, std::shared_ptr<const TaughtPath> path,
                                  KeyPictures pictures, std::shared_ptr<const camera::Camera> camera) {
  if (const auto wrong = problems(config); !wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  if (!path || path->arcs.empty()) return fail(ErrorCode::kInvalidInput, "There is no arc to follow.");
  if (!camera) return fail(ErrorCode::kInvalidInput, "There is no camera.");
  if (!pictures) return fail(ErrorCode::kInvalidInput, "There are no pictures of the key images.");
  Repeater made(config, std::move(path), std::move(pictures), std::move(camera));
  if (!config.recognition) return made;
  KeyGallery gallery;
  for (int key = 0; key < static_cast<int>(made.path_->key_images.size()); ++key) {
    const auto picture = made.pictures_(key);
    if (!picture) return fail(ErrorCode::kNotFound, "A key image has no picture.", std::to_string(key));
    gallery.add(describe(*picture, *made.camera_, *config.recognition));
  }
  made.gallery_ = std::make_shared<const KeyGallery>(std::move(gallery));
  return made;
}

Result<LandmarkFollower::References> Repeater::references_for(const ArcSurroundings& around) const {
  LandmarkFollower::References found;
  for (const KeyPose& key : around.keys) {
    const auto known = std::ranges::find_if(references_, [&](const auto& one) { return one->key() == key.key; });
    if (known != references_.end()) {
      found.push_back(*known);
      continue;
    }
    const auto picture = pictures_(key.key);
    if (!picture) return fail(ErrorCode::kNotFound, "A key image has no picture.", std::to_string(key.key));
    auto made = KeyReferences::make(*path_, key.key, *picture, *camera_, config_.tracker);
    if (!made) return pass_on(made);
    found.push_back(std::make_shared<const KeyReferences>(*std::move(made)));
  }
  return found;
}

/// The actual arc becomes another one, seen from a pose in its surroundings.
Status Repeater::go_to(int arc, const ArcPose& pose) {
  ArcSurroundings around = surroundings_of(*path_, arc, config_.reach, config_.fewest_scaled);
  auto references = references_for(around);
  if (!references) return pass_on(references);
  references_ = *std::move(references);
  around_ = std::move(around);
  pose_ = pose;
  behind_ = 0;
  turned_most_ = 0.0;
  follower_.renew(*around_, pose_, references_);
  return {};
}

Status Repeater::begin(int arc) {
  if (arc < 0 || arc >= static_cast<int>(path_->arcs.size())) {
    return fail(ErrorCode::kNotFound, "The path has no such arc.", std::to_string(arc));
  }
  auto gone = go_to(arc, {});
  if (!gone) return gone;
  follower_.lose_all();
  latest_ = pictures_(arc_of(arc).from);
  return {};
}

/// The last pose in the frame and unit of other surroundings. Where their units are not joined, the position is that of
/// their first key image.
ArcPose Repeater::pose_in(const ArcSurroundings& other) const {
  const int first = path_->arcs[at(other.arc)].from;
  ArcPose pose;
  if (!around_->has_key(first)) return pose;
  const KeyPose& key = around_->key(first);
  pose.local_from_current = key.local_from_key.transpose() * pose_.local_from_current;
  if (!key.is_placed || !other.unit_arc) return pose;
  const auto unit_arc = std::ranges::find(around_->arcs, *other.unit_arc);
  if (unit_arc == around_->arcs.end()) return pose;
  const auto& unit = around_->units[static_cast<std::size_t>(unit_arc - around_->arcs.begin())];
  if (unit) pose.position = key.local_from_key.transpose() * (pose_.position - key.position) / *unit;
  return pose;
}

/// What is tracked is looked for where it was; where much of it is lost, by the shift of the whole picture.
void Repeater::follow(const tracking::ImagePyramid& picture) {
  const int before = follower_.tracked();
  if (before == 0) return;
  LandmarkFollower still = follower_;
  still.follow(
      picture, pose_, [](const Eigen::Vector2d& pixel_px) { return pixel_px; }, config_);
  if (still.tracked() < config_.retry_share * before && latest_) {
    const auto shift_px = picture_shift(*latest_, picture);
    if (shift_px && !shift_px->isZero()) {
      const TurnedPixels turned(*camera_, *shift_px);
      LandmarkFollower shifted = follower_;
      shifted.follow(picture, pose_, turned, config_);
      if (shifted.tracked() > still.tracked()) {
        follower_ = std::move(shifted);
        if (turned.after_from_before()) {
          pose_.local_from_current =
              pose_.local_from_current * turned.after_from_before()->inverse().toRotationMatrix();
        }
        return;
      }
    }
  }
  follower_ = std::move(still);
}

void Repeater::drop_what_disagrees(const Located& located) {
  for (std::size_t i = 0; i < located.landmarks.size(); ++i) {
    if (!located.agrees[i]) follower_.lose(located.landmarks[i]);
  }
}

/// Takes what was located, and looks for what is not tracked where it should be. How many were found.
int Repeater::predict(const tracking::ImagePyramid& picture, Located& located) {
  pose_ = located.pose;
  drop_what_disagrees(located);
  if (!located.structure_agrees) return 0;
  const int before = follower_.tracked();
  if (follower_.search(picture, pose_, config_.most_from_predicted_rad, config_) == 0) return 0;
  Located again = locate(arc_of(around_->arc).from);
  if (again.lost != LostReason::kNone) return 0;
  located = std::move(again);
  pose_ = located.pose;
  drop_what_disagrees(located);
  return std::max(0, follower_.tracked() - before);
}

/// Whether the second key image of an arc is passed, and the path goes on there. On a turn that is also where half of
/// the turn is made and the way is behind, and before a turn where it is made already: whoever repeats a path may be
/// turned a little less, or turn a little sooner. A turn that was made and is undone since, on the way after it, is
/// made: there, and wherever a way is clearly made, the way tells more than the turn. `turned_most`: the most of the
/// arc's turn that was seen.
bool Repeater::has_passed(int arc, double turned_most) const {
  if (!path_->arc_after(arc)) return false;
  const ArcProgress progress = progress_along(*around_, arc_of(arc).from, pose_);
  if (progress.value() >= config_.passed) return true;
  ArcProgress next;
  if (around_->next_key(to_key(arc)) != nullptr) next = progress_along(*around_, to_key(arc), pose_);
  if (!progress.of_turn) {
    return progress.value() >= config_.nearly_passed && next.of_turn && *next.of_turn >= config_.turning;
  }
  if (progress.past_rad && *progress.past_rad >= config_.clear_way_rad) return true;
  if (!progress.of_way && turned_most >= config_.turned && next.gone_rad >= config_.clear_way_rad) return true;
  if (*progress.of_turn < config_.turned) return false;
  if (progress.of_way) return *progress.of_way >= config_.passed;
  return next.of_way && !next.of_turn && *next.of_way > -config_.back;
}

/// Whether the pose is behind the first key image of an arc, on the one before.
bool Repeater::is_before(int arc) const {
  const auto before = path_->arc_before(arc);
  const KeyPose* after = before ? around_->next_key(arc_of(*before).from) : nullptr;
  if (after == nullptr || after->key != arc_of(arc).from) return false;
  const ArcProgress progress = progress_along(*around_, arc_of(arc).from, pose_);
  if (progress.of_turn && progress.gone_rad >= config_.clear_way_rad) return false;
  return progress.value() < config_.back && !has_passed(*before, 0.0);
}

/// Goes on to the arcs that the pose has come to. By how many.
Result<int> Repeater::pass_key_images(const tracking::ImagePyramid& picture, Located& located, int& predicted) {
  int passed = 0;
  for (int i = 0; i < config_.most_transitions; ++i) {
    const int arc = around_->arc;
    turned_most_ = std::max(turned_most_, progress_along(*around_, arc_of(arc).from, pose_).of_turn.value_or(0.0));
    const bool goes_on = has_passed(arc, turned_most_);
    const bool is_behind = !goes_on && is_before(arc);
    behind_ = is_behind ? behind_ + (i == 0 ? 1 : 0) : 0;
    if (!goes_on && behind_ < 2) break;
    const int next = goes_on ? *path_->arc_after(arc) : *path_->arc_before(arc);
    const ArcPose pose = pose_in(surroundings_of(*path_, next, config_.reach, config_.fewest_scaled));
    if (auto gone = go_to(next, pose); !gone) return pass_on(gone);
    passed += goes_on ? 1 : -1;
    Located there = locate(arc_of(next).from);
    if (there.lost != LostReason::kNone) break;
    located = std::move(there);
    predicted += predict(picture, located);
  }
  return passed;
}

Result<Repeated> Repeater::step(std::shared_ptr<const tracking::ImagePyramid> picture) {
  const camera::CameraConfig& camera = camera_->config();
  if (!picture || picture->width_px() != camera.width_px || picture->height_px() != camera.height_px) {
    return fail(ErrorCode::kWrongImageSize, "The picture does not have the size of the camera's.");
  }
  if (!around_ && !gallery_) return Repeated{};
  ++pictures_seen_;
  Located located;
  int recovered = 0;
  if (around_) located = locate_from_before(*picture);
  if (located.is_lost() && gallery_ && recognise(*picture, located)) recovered = follower_.tracked();
  if (located.is_lost()) {
    ++lost_for_;
    follower_.lose_all();
    return answer(located);
  }
  lost_for_ = 0;
  int predicted = predict(*picture, located);
  const auto passed = pass_key_images(*picture, located, predicted);
  if (!passed) return pass_on(passed);
  latest_ = std::move(picture);
  Repeated said = answer(located);
  said.predicted = predicted;
  said.recovered = recovered;
  said.transitions = *passed;
  return said;
}

/// Where the picture was taken, if near to where the one before was; the pose is that one's where it is not known.
Repeater::Located Repeater::locate_from_before(const tracking::ImagePyramid& picture) {
  const ArcPose before = pose_;
  follow(picture);
  Located located = locate(arc_of(around_->arc).from);
  if (!located.is_lost()) return located;
  pose_ = before;
  return look_around(picture);
}

Repeated Repeater::answer(const Located& located) const {
  Repeated said;
  said.lost = located.lost;
  if (!around_) return said;
  said.arc = around_->arc;
  said.from_key = arc_of(said.arc).from;
  said.to_key = to_key(said.arc);
  if (said.is_lost()) return said;
  said.tracked = follower_.tracked();
  said.expected = follower_.expected(pose_, config_.least_visible);
  said.error_px = located.error_px;
  said.structure_agrees = located.structure_agrees && located.error_rad <= config_.doubtful_error_rad;
  said.progress = progress_along(*around_, said.from_key, pose_).value();
  said.lateral = lateral_of(*around_, said.from_key, pose_).value_or(0.0);
  if (arc_of(said.arc).has_baseline) said.bearing_to_next_rad = bearing_of_key(*around_, said.to_key, pose_);
  double sum = 0.0;
  int common = 0;
  for (const std::size_t i : follower_.tracked_ones()) {
    const geometry::SeenPoint* there = follower_.in_key(i, said.to_key);
    if (there == nullptr) continue;
    const Eigen::Vector3d& here = follower_.landmarks()[i].seen.bearing;
    sum += std::atan2(here.y(), here.x()) - std::atan2(there->bearing.y(), there->bearing.x());
    ++common;
  }
  if (common > 0) said.steering_rad = config_.steering_gain * sum / common;
  const double share = located.landmarks.empty()
                           ? 0.0
                           : static_cast<double>(located.agreeing) / static_cast<double>(located.landmarks.size());
  const double off = located.error_rad / config_.most_error_rad;
  said.confidence = share * std::max(0.0, 1.0 - off) * std::min(1.0, said.tracked / (3.0 * config_.fewest_features));
  said.at_end = said.progress >= config_.passed && !path_->arc_after(said.arc);
  return said;
}

}  // namespace homeward::repeat
