// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "repeat/arc_pose.hpp"
#include "repeat/arc_surroundings.hpp"

namespace homeward::repeat {

/// How far along an arc a pose is, 0 at its first key image and 1 at the second.
struct ArcProgress {
  std::optional<double>
      of_way;  // passes 1 where <d, r> becomes negative (Segvic et al. 2007, §2.2.3: d the way between
               // the key images, r that from the camera to the second); none on a turn on the spot
  std::optional<double> of_turn;  // only where nearly all that changes on the arc is by its turn
  double gone_rad = 0.0;  // way made from the first key image in the arc's direction, over the landmarks' distance: by
                          // how much it changes what is seen; 0 on a turn on the spot
  std::optional<double> past_rad;  // of that, beyond the second key image; none where its distance is not known
  /// The turn's where the arc is one; 1 for an arc that leads nowhere.
  [[nodiscard]] double value() const { return of_turn ? *of_turn : of_way.value_or(1.0); }
};
/// Precondition: the surroundings have the key image and the next one.
ArcProgress progress_along(const ArcSurroundings& around, int from_key, const ArcPose& pose);

/// How far to the left of the line between an arc's key images a pose is, over their distance. None without a distance.
/// Precondition: the same.
std::optional<double> lateral_of(const ArcSurroundings& around, int from_key, const ArcPose& pose);

/// Where a key image is from a pose, counter-clockwise from ahead. None where no distance leads there, or it is as good
/// as reached.
std::optional<double> bearing_of_key(const ArcSurroundings& around, int key, const ArcPose& pose);

}  // namespace homeward::repeat
