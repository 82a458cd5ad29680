// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/pose2.hpp"
#include "features/appearance.hpp"

namespace homeward::driving {

/// A picture that was recognised, and where and when it was taken.
struct RecognisedPicture {
  std::shared_ptr<const features::Appearance> appearance;
  Pose2 odometry;
  std::int64_t taken_ms = 0;
};

/// Whether pictures go on from each other. The wheels do not notice that somebody lifts the robot, and at a place that
/// looks alike the views explain what is seen as well as before; but of the features all around only those go on that
/// the two places share.
struct Continuity {
  RecognisedPicture latest;
  std::optional<double> share;  // of the latest picture's features that go on from the one before
  double usual = 0.0;           // of pictures in a row, by a mean that forgets
  int counted = 0;              // pictures that it is of
  bool dips = false;            // the latest share is low, and that before it was not
  bool hidden = false;          // the latest share is lower than usual
};

/// The share of features that agree on one motion from the picture `before` to `now`: the median over twelve sectors of
/// the panorama that show something in both, so that whoever walks by hides some and not the median, and a lens that is
/// half covered says nothing. `turned_rad`: the robot's turn between them, by odometry. Nothing where too few sectors
/// are left.
std::optional<double> continued_share(const features::Appearance& before, const features::Appearance& now,
                                      double turned_rad, std::uint64_t seed);

/// Takes one more picture. True: it does not go on from the one before, which was taken within a second and half a
/// metre by odometry. The method is ours.
bool breaks_off(Continuity& continuity, const RecognisedPicture& now, std::uint64_t seed);

}  // namespace homeward::driving
