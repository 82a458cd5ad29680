// SPDX-License-Identifier: Apache-2.0
#include "repeat/teach.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "repeat/bridge.hpp"
#include "repeat/node_scale.hpp"
#include "repeat/picture_shift.hpp"

namespace homeward::repeat {
namespace {

/// Why the geometry of a view will not do for an arc with at least `fewest` features; nothing where it does.
std::optional<ArcEnd> against(const SubrangeView& view, int fewest, const TeachConfig& config) {
  if (view.tracked < fewest) return ArcEnd::kTooFewFeatures;
  if (!view.geometry) return ArcEnd::kNoGeometry;
  if (view.agreeing() < fewest) return ArcEnd::kTooFewFeatures;
  if (view.agreeing() < config.least_agreeing * view.tracked) return ArcEnd::kNoGeometry;
  if (view.geometry->error_px > config.most_error_px) return ArcEnd::kErrorTooLarge;
  return std::nullopt;
}

CutReason cut_reason(ArcEnd why) {
  switch (why) {
    case ArcEnd::kNoGeometry:
      return CutReason::kNoGeometry;
    case ArcEnd::kErrorTooLarge:
      return CutReason::kErrorTooLarge;
    default:
      return CutReason::kTooFewFeatures;
  }
}

bool is_lens(const camera::CameraModel& model) {
  return !std::holds_alternative<camera::HyperbolicMirror>(model) &&
         !std::holds_alternative<camera::Equirectangular>(model);
}

KeyImage key_image_of(const Subrange& subrange) { return {subrange.key().number, subrange.features(), 0, {}}; }

}  // namespace

Result<Teacher> Teacher::create(const TeachConfig& config, std::shared_ptr<const camera::Camera> camera) {
  if (const auto wrong = problems(config); !wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  if (!camera) return fail(ErrorCode::kInvalidInput, "There is no camera.");
  if (!is_lens(camera->config().model)) {
    return fail(ErrorCode::kInvalidInput,
                "A path is taught with the pictures of a lens, not of a mirror or a panorama.", "model");
  }
  if (camera->config().nominal) {
    return fail(ErrorCode::kInvalidInput, "The camera is a guess: a path needs one that was calibrated.", "nominal");
  }
  return Teacher(config, std::move(camera));
}

Result<TaughtPicture> Teacher::add(tracking::ImagePyramid picture) {
  const camera::CameraConfig& camera = camera_->config();
  if (picture.width_px() != camera.width_px || picture.height_px() != camera.height_px) {
    return fail(ErrorCode::kWrongImageSize, "The picture does not have the size of the camera's.",
                std::to_string(shown_));
  }
  return take({shown_++, std::move(picture)});
}

/// The picture from the key image; where much less agrees than before, the better one of that and of looking where the
/// shift of the whole picture says.
SubrangeView Teacher::look(const NumberedPicture& picture) const {
  SubrangeView view = subrange_->look(picture, config_);
  const int before = latest_ ? subrange_->latest()->agreeing() : static_cast<int>(subrange_->features().size());
  if (view.agreeing() >= config_.retry_share * before) return view;
  const auto shift_px = picture_shift((latest_ ? *latest_ : subrange_->key()).pyramid, picture.pyramid);
  if (!shift_px || shift_px->isZero()) return view;
  SubrangeView shifted = subrange_->look(picture, config_, *shift_px);
  return shifted.agreeing() > view.agreeing() ? shifted : view;
}

TaughtPicture Teacher::take(NumberedPicture picture) {
  if (!subrange_) return begin_piece(std::move(picture));
  SubrangeView view = look(picture);
  PictureFate fate = PictureFate::kFollowed;
  if (latest_) {
    auto why = against(view, least_features(), config_);
    const bool may_end = subrange_->carried() >= config_.least_common;
    if (!why && may_end && view.common < config_.least_common) why = ArcEnd::kTooFewCommon;
    if (!why) return keep(std::move(picture), std::move(view), fate);
    const auto on = motion_between(*subrange_->latest(), view);
    close_arc(*why);
    subrange_->expect(on);
    view = look(picture);
    fate = PictureFate::kAfterKey;
  }
  const int kept = static_cast<int>(std::ceil(config_.least_kept * static_cast<double>(subrange_->features().size())));
  const auto why = against(view, std::max(config_.fewest_features, kept), config_);
  const bool is_near = static_cast<int>(waiting_.size()) <= config_.most_skipped;
  if (!why && is_near) return keep(std::move(picture), std::move(view), fate);
  return bridge_wait_or_cut(std::move(picture), why.value_or(why_waiting_));
}

/// n, or where the arc began with little, a share of that: else each picture of a plain wall would be a key image.
int Teacher::least_features() const {
  const int share = static_cast<int>(std::ceil(config_.least_share * first_agreeing_));
  return std::max(std::min(config_.least_features, share), config_.fewest_features);
}

TaughtPicture Teacher::begin_piece(NumberedPicture picture) {
  TaughtPicture taught;
  taught.key_picture = picture.number;
  auto begun = Subrange::begin(std::move(picture), {}, next_feature_, camera_, config_);
  if (!begun || static_cast<int>(begun->features().size()) < config_.fewest_features) return taught;
  taught.fate = PictureFate::kBegins;
  next_feature_ = begun->next_feature();
  subrange_ = *std::move(begun);
  is_key_in_path_ = false;
  return taught;
}

TaughtPicture Teacher::keep(NumberedPicture picture, SubrangeView view, PictureFate fate) {
  TaughtPicture taught;
  taught.fate = fate;
  taught.key_picture = subrange_->key().number;
  taught.tracked = view.tracked;
  taught.agreeing = view.agreeing();
  taught.common = view.common;
  taught.error_px = view.geometry->error_px;
  taught.parallax_px = view.geometry->parallax_px;
  taught.has_baseline = view.geometry->has_baseline;
  for (const NumberedPicture& skipped : waiting_) path_.skipped_pictures.push_back(skipped.number);
  waiting_.clear();
  if (!latest_) first_agreeing_ = view.agreeing();
  latest_ = std::move(picture);
  subrange_->keep(std::move(view));
  return taught;
}

TaughtPicture Teacher::bridge_wait_or_cut(NumberedPicture picture, ArcEnd why) {
  if (auto bridge = bridge_to(picture, *subrange_, *camera_, config_)) {
    subrange_ = std::move(bridge->from);
    next_feature_ = subrange_->next_feature();
    if (is_key_in_path_) path_.key_images.back().features = subrange_->features();
    path_.bridges.push_back({subrange_->key().number, picture.number, bridge->matched});
    return keep(std::move(picture), std::move(bridge->view), PictureFate::kBridged);
  }
  TaughtPicture taught;
  taught.fate = PictureFate::kWaits;
  taught.key_picture = subrange_->key().number;
  if (waiting_.empty()) why_waiting_ = why;
  waiting_.push_back(std::move(picture));
  const int most = std::max(config_.most_skipped, config_.bridging ? config_.bridging->most_ahead - 1 : 0);
  if (static_cast<int>(waiting_.size()) <= most) return taught;
  taught = cut();
  taught.fate = PictureFate::kAfterCut;
  return taught;
}

/// The latest view becomes a key image, and the next subrange begins there.
void Teacher::close_arc(ArcEnd why) {
  if (!is_key_in_path_) {
    path_.key_images.push_back(key_image_of(*subrange_));
    if (!path_.cuts.empty() && !path_.cuts.back().next_picture)
      path_.cuts.back().next_picture = subrange_->key().number;
  }
  const int from = static_cast<int>(path_.key_images.size()) - 1;
  Arc arc = subrange_->arc(from, why);
  if (is_key_in_path_) {
    path_.key_images.back().common = common_features(path_.arcs.back(), arc);
    path_.key_images.back().scale = node_scale(path_.arcs.back(), arc, config_.fewest_scaled);
  }
  path_.arcs.push_back(std::move(arc));
  const auto carried = subrange_->agreeing_in_latest();
  // Cannot fail: the configuration was checked, and it is all that can be wrong.
  subrange_ = Subrange::begin(*std::exchange(latest_, std::nullopt), carried, next_feature_, camera_, config_).value();
  subrange_->know(path_.arcs.back());
  next_feature_ = subrange_->next_feature();
  path_.key_images.push_back(key_image_of(*subrange_));
  is_key_in_path_ = true;
}

/// Ends the piece and begins again with the pictures that wait. What became of the last one of them.
TaughtPicture Teacher::cut() {
  const bool goes_on = !path_.cuts.empty() && !path_.cuts.back().next_picture && !is_key_in_path_;
  if (!goes_on) path_.cuts.push_back({subrange_->key().number, std::nullopt, cut_reason(why_waiting_)});
  subrange_.reset();
  is_key_in_path_ = false;
  TaughtPicture last;
  for (NumberedPicture& picture : std::exchange(waiting_, {})) last = take(std::move(picture));
  return last;
}

Result<TaughtPath> Teacher::path() const {
  if (shown_ < 2) return fail(ErrorCode::kTooFewImages, "A path is made of two pictures and more.");
  Teacher ended = *this;
  while (!ended.waiting_.empty()) ended.cut();
  if (ended.latest_) ended.close_arc(ArcEnd::kPathEnd);
  if (ended.path_.arcs.empty()) {
    return fail(ErrorCode::kTooLittleSupport, "Nothing could be followed from any picture into the next ones.");
  }
  return std::move(ended.path_);
}

}  // namespace homeward::repeat
