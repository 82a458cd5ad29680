// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/mirrored_companion.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "wire/appearance_blob.hpp"

namespace homeward::agent {

Result<std::shared_ptr<const features::Appearance>> MirroredCompanion::appearance_of(
    const wire::CompanionView& view) const {
  if (view.appearance.empty() || bytes_ + view.appearance.size() > limits_.bytes)
    return std::shared_ptr<const features::Appearance>();
  auto appearance = wire::decode_appearance(view.appearance, "picture " + std::to_string(view.index));
  if (!appearance) return pass_on(appearance);
  if (appearance->size() > limits_.features) return std::shared_ptr<const features::Appearance>();
  return std::make_shared<const features::Appearance>(std::move(*appearance));
}

void MirroredCompanion::hear(const wire::CompanionState& state, std::int64_t now_ms) {
  if (state.pictures < has()) {
    mirror_ = exploration::Explorer(config_);
    join_ = exploration::FrameJoin();
    bytes_ = 0;
    takes_no_more_ = false;
  }
  std::vector<exploration::JoinAgreement> told;  // ours is the first
  for (const wire::CompanionAgreement& one : state.agreements)
    told.push_back({static_cast<std::size_t>(one.others), static_cast<std::size_t>(one.own),
                    inverse(one.own_from_others), !one.own_looked});
  join_.set_told(told);
  state_ = state;
  told_ms_ = now_ms;
}

std::vector<wire::CompanionAgreement> MirroredCompanion::agreements() const {
  const std::span<const exploration::JoinAgreement> found = join_.found();
  std::vector<wire::CompanionAgreement> told;
  for (const exploration::JoinAgreement& one : found.last(std::min(found.size(), wire::kMostCompanionAgreements)))
    told.push_back({static_cast<std::int64_t>(one.first), static_cast<std::int64_t>(one.second), one.first_from_second,
                    one.first_looked});
  return told;
}

Status MirroredCompanion::acceptable(const wire::CompanionView& view) const {
  const std::string where = "picture " + std::to_string(view.index);
  if (view.index != has()) {
    return fail(ErrorCode::kConflict, "The picture that comes next has the number " + std::to_string(has()) + ".",
                where);
  }
  if (view.index >= limits_.pictures)
    return fail(ErrorCode::kInvalidInput, "No more pictures of a companion are taken in.", where);
  if (view.view.sweep.range_max_m > limits_.range_max_m || view.view.sweep.ranges_m.size() > limits_.rays)
    return fail(ErrorCode::kInvalidInput, "The sweep has too many rays, or reaches too far.", where);
  if (mirror_.views().empty()) return {};
  Pose2 before = mirror_.views().back().odometry;
  if (view.view.odometry_moved) before = *view.view.odometry_moved * before;
  const Pose2 moved = inverse(before) * view.view.odometry;
  const Pose2 about = mirror_.poses().back() * moved;
  // Carried, it may know far away where it is.
  if (!view.view.odometry_moved && !(position_m(moved).norm() <= limits_.between_m))
    return fail(ErrorCode::kInvalidInput, "The picture lies too far from the one before.", where);
  if (!(position_m(about).norm() <= limits_.from_start_m))
    return fail(ErrorCode::kInvalidInput, "The picture lies too far from the first one.", where);
  return {};
}

Status MirroredCompanion::hear(const wire::CompanionView& view) {
  Status taken = take_in(view);
  // Told once more it would be refused once more.
  if (taken || taken.error().code != ErrorCode::kConflict) takes_no_more_ = !taken;
  return taken;
}

Status MirroredCompanion::take_in(const wire::CompanionView& view) {
  if (Status fits = acceptable(view); !fits) return fits;
  auto appearance = appearance_of(view);
  if (!appearance) return pass_on(appearance);
  if (*appearance) bytes_ += view.appearance.size();
  // As KeptSurvey::restore does it, so that the poses come out as on the other robot.
  if (view.view.odometry_moved) mirror_.move_odometry(*view.view.odometry_moved);
  mirror_.take(view.view.sweep, view.view.odometry, std::move(*appearance));
  return {};
}

std::optional<Pose2> MirroredCompanion::drives_at(std::int64_t now_ms) const {
  if (!is_caught_up() || !state_->drives || now_ms - told_ms_ > limits_.lately_ms) return std::nullopt;
  return mirror_.floor_from_robot(state_->odometry);
}

void MirroredCompanion::look_from_theirs(const exploration::Explorer& ours, const std::optional<Pose2>& ours_drives_at,
                                         std::int64_t now_ms) {
  // One that is told belatedly was taken when we were elsewhere.
  const bool is_newest = is_caught_up() && now_ms - told_ms_ <= limits_.lately_ms;
  join_.second_looks(ours, mirror_, is_newest ? ours_drives_at : std::nullopt);
}

void MirroredCompanion::look_from_ours(const exploration::Explorer& ours, std::int64_t now_ms) {
  join_.first_looks(ours, mirror_, drives_at(now_ms));
}

const wire::CompanionState* MirroredCompanion::lately_told(std::int64_t now_ms) const {
  return state_ && now_ms - told_ms_ <= limits_.forgotten_ms ? &*state_ : nullptr;
}

std::optional<exploration::Companion> MirroredCompanion::companion(const exploration::Explorer& ours,
                                                                   std::int64_t now_ms) const {
  const auto joined = join_.first_from_second(ours, mirror_);
  if (!joined) return std::nullopt;
  exploration::Companion companion;
  companion.floor_from_theirs = *joined;
  companion.report.floor = exploration::shared_floor(mirror_.floor(), mirror_.coverage());
  companion.report.floor_from_robot =
      is_caught_up() ? mirror_.floor_from_robot(state_->odometry) : mirror_.poses().back();
  const wire::CompanionState* told = lately_told(now_ms);
  companion.report.drives = told != nullptr && told->drives;
  if (companion.report.drives) companion.report.target_m = told->target_m;
  return companion;
}

}  // namespace homeward::agent
