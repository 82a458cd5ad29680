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

bool Repeater::has_joined(int before, int after) const {
  if (before < 0 || after >= static_cast<int>(path_->arcs.size())) return false;
  return arc_of(before).from + 1 == arc_of(after).from;
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
  const int unit_from = arc_of(*other.unit_arc).from - around_->keys.front().key;
  if (unit_from < 0 || unit_from >= static_cast<int>(around_->units.size())) return pose;
  const auto& unit = around_->units[at(unit_from)];
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
  const int first = arc_of(around_->arc).from;
  const int keys = static_cast<int>(around_->keys.size());
  for (int i = 0; i < std::min(config_.keys_tried, keys); ++i) {
    const int number = (lost_for_ * config_.keys_tried + i) % keys;  // 0, 1, -1, 2, -2, ... from the first
    const int key = first + ((number % 2) == 1 ? (number + 1) / 2 : -(number / 2));
    if (!around_->has_key(key)) continue;
    const auto there = pictures_(key);
    const KeyPose& placed = around_->key(key);
    if (there) starts.push_back({turned_by_shift({placed.local_from_key, placed.position}, *there, picture), key});
  }
  const ArcPose before = pose_;
  follower_.lose_all();
  const LandmarkFollower nothing = follower_;
  LandmarkFollower best_follower = nothing;
  Located best;
  for (const Start& start : starts) {
    follower_ = nothing;
    Located located = locate_from(start.pose, start.key, picture);
    if (located.is_lost() || located.agreeing <= best.agreeing) continue;
    best = std::move(located);
    best_follower = std::move(follower_);
  }
  pose_ = before;
  follower_ = std::move(best_follower);
  return best;
}

/// Looks for everything from a pose that may be some way off: widely first, then again from where that says. More has
/// to agree than where a place is expected.
Repeater::Located Repeater::locate_from(const ArcPose& start, int key, const tracking::ImagePyramid& picture) {
  pose_ = start;
  follower_.search(picture, pose_, config_.most_from_start_rad, config_);
  Located located = locate(key);
  if (located.agreeing < config_.fewest_features) return located;
  pose_ = located.pose;
  drop_what_disagrees(located);
  follower_.search(picture, pose_, config_.most_from_predicted_rad, config_);
  located = locate(key);
  const double least =
      std::max<double>(config_.fewest_recovered, config_.least_recovered * follower_.expected(located.pose));
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
  const double least =
      std::max<double>(config_.fewest_features, config_.least_expected * follower_.expected(located.pose));
  if (located.agreeing < least) located.lost = LostReason::kTooFewFeatures;
  if (located.agreeing < config_.least_agreeing * count) located.lost = LostReason::kNoGeometry;
  if (located.error_rad > config_.most_error_rad) located.lost = LostReason::kErrorTooLarge;
  return located;
}

/// Asks the pictures themselves, where the arc's landmarks do not explain what is seen: the geometries towards both key
/// images, each as it is and as a beginning for the landmarks.
Repeater::Located Repeater::locate_by_keys(int from, std::span<const SeenLandmark> seen, Located best) const {
  std::vector<KeyView> views;
  for (const int key : {from, from + 1}) {
    auto view = view_of_key(follower_, *around_, key, config_.geometry,
                            config_.seed + static_cast<std::uint64_t>(2 * pictures_seen_ + key - from));
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
  // The structure explains less than it should. Do the pictures?
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
/// turned a little less, or turn a little sooner.
bool Repeater::has_passed(int arc) const {
  if (!has_joined(arc, arc + 1)) return false;
  const ArcProgress progress = progress_along(*around_, arc_of(arc).from, pose_);
  if (progress.value() >= config_.passed) return true;
  ArcProgress next;
  if (around_->has_key(arc_of(arc).from + 2)) next = progress_along(*around_, arc_of(arc).from + 1, pose_);
  if (!progress.of_turn) {
    return progress.value() >= config_.nearly_passed && next.of_turn && *next.of_turn >= config_.turning;
  }
  if (*progress.of_turn < config_.turned) return false;
  if (progress.of_way) return *progress.of_way >= config_.passed;
  return next.of_way && !next.of_turn && *next.of_way > -config_.back;
}

/// Whether the pose is behind the first key image of an arc, on the one before.
bool Repeater::is_before(int arc) const {
  if (!has_joined(arc - 1, arc) || !around_->has_key(arc_of(arc).from - 1)) return false;
  return progress_along(*around_, arc_of(arc).from, pose_).value() < config_.back && !has_passed(arc - 1);
}

/// Goes on to the arcs that the pose has come to. By how many.
Result<int> Repeater::pass_key_images(const tracking::ImagePyramid& picture, Located& located, int& predicted) {
  int passed = 0;
  for (int i = 0; i < config_.most_transitions; ++i) {
    const int arc = around_->arc;
    int next = has_passed(arc) ? arc + 1 : arc;
    const bool is_behind = next == arc && is_before(arc);
    behind_ = is_behind ? behind_ + (i == 0 ? 1 : 0) : 0;
    if (behind_ >= 2) next = arc - 1;
    if (next == arc) break;
    const ArcPose pose = pose_in(surroundings_of(*path_, next, config_.reach, config_.fewest_scaled));
    if (auto gone = go_to(next, pose); !gone) return pass_on(gone);
    passed += next - arc;
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
  said.to_key = said.from_key + 1;
  if (said.is_lost()) return said;
  said.tracked = follower_.tracked();
  said.expected = follower_.expected(pose_);
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
  said.at_end = said.progress >= config_.passed && !has_joined(said.arc, said.arc + 1);
  return said;
}

}  // namespace homeward::repeat
