// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "exploration/explorer.hpp"
#include "exploration/frame_join.hpp"
#include "wire/link_messages.hpp"

namespace homeward::agent {

/// What is taken in of another robot's exploration: whoever sends it must not be able to fill the memory.
struct MirrorLimits {
  std::int64_t pictures = 3000;
  int features = 1500;               // of a picture; one with more counts as not looked at,
  std::size_t bytes = 256UL << 20U;  // and so does what comes once so much was told
  double between_m = 25.0;           // from a picture to the next, unless odometry began anew
  double from_start_m = 150.0;       // from the first one
  double range_max_m = 100.0;        // of a sweep,
  std::size_t rays = 4000;           // and so many
  std::int64_t forgotten_ms = 5000;  // not heard of for so long, where it drives counts no more
  std::int64_t lately_ms = 1500;     // heard of no longer ago, it is about where it said
};

/// The exploration of another robot, its companion, as far as that has told it: put together picture by picture as that
/// robot did it, and joined to ours by what both see. No clock: callers say what time it is, in ms of one steady clock.
class MirroredCompanion {
 public:
  MirroredCompanion(ExplorationId exploration, const exploration::ExplorerConfig& config,
                    const MirrorLimits& limits = {})
      : exploration_(std::move(exploration)), config_(config), limits_(limits), mirror_(config) {}

  /// It told where it is, and what it has found of how both floors lie to each other, which counts as if it had been
  /// found here: both hold the same pictures against each other, but not the same ones at the same time. Where it has
  /// fewer pictures than it told, it has lost some, and all of it is told again.
  void hear(const wire::CompanionState& state, std::int64_t now_ms);
  /// The next picture of it. Errors: kConflict (another one than the next), kInvalidInput (what none of its pictures
  /// can be, or more than is taken in); then nothing has changed.
  Status hear(const wire::CompanionView& view);
  /// It has told a picture, which is held against ours. `ours_drives_at`: where we are on our floor if we drive.
  void look_from_theirs(const exploration::Explorer& ours, const std::optional<Pose2>& ours_drives_at,
                        std::int64_t now_ms);
  /// We have taken a picture, which is held against those of it.
  void look_from_ours(const exploration::Explorer& ours, std::int64_t now_ms);

  [[nodiscard]] const ExplorationId& exploration() const { return exploration_; }
  /// So many of its pictures have arrived, from the first on.
  [[nodiscard]] std::int64_t has() const { return static_cast<std::int64_t>(mirror_.views().size()); }
  [[nodiscard]] const exploration::Explorer& mirror() const { return mirror_; }
  /// A picture was refused that will not become any better: it need not tell more.
  [[nodiscard]] bool takes_no_more() const { return takes_no_more_; }
  /// What it told last; nothing: nothing yet, or too long ago.
  [[nodiscard]] const wire::CompanionState* lately_told(std::int64_t now_ms) const;
  /// How both floors lie to each other at single pictures, as found here: to be told to it, the newest of too many.
  [[nodiscard]] std::vector<wire::CompanionAgreement> agreements() const;
  /// For our survey; nothing: its floor is not joined to ours.
  [[nodiscard]] std::optional<exploration::Companion> companion(const exploration::Explorer& ours,
                                                                std::int64_t now_ms) const;

 private:
  [[nodiscard]] Status acceptable(const wire::CompanionView& view) const;
  /// The features that it told; null where there are none, or more than are compared.
  [[nodiscard]] Result<std::shared_ptr<const features::Appearance>> appearance_of(
      const wire::CompanionView& view) const;
  Status take_in(const wire::CompanionView& view);
  /// Whether what it told last is of the frame that its newest picture here is of.
  [[nodiscard]] bool is_caught_up() const { return state_ && has() >= state_->pictures; }
  /// Where it drives now, on its own floor; nothing: it stands, or has not said so lately.
  [[nodiscard]] std::optional<Pose2> drives_at(std::int64_t now_ms) const;

  ExplorationId exploration_;
  exploration::ExplorerConfig config_;
  MirrorLimits limits_;
  exploration::Explorer mirror_;
  exploration::FrameJoin join_;  // ours is the first
  std::optional<wire::CompanionState> state_;
  std::int64_t told_ms_ = 0;
  std::size_t bytes_ = 0;  // of features that were told
  bool takes_no_more_ = false;
};

}  // namespace homeward::agent
