// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "map/tour_warning.hpp"
#include "mapping/pair_table.hpp"

namespace homeward::pipeline {

/// Fewer pictures make no map.
inline constexpr std::size_t kFewestImages = 3;

/// Zero by zero: the picture could not be read.
struct PictureSize {
  int width_px = 0;
  int height_px = 0;
};

/// That all pictures that could be read have the camera's size. Error: kWrongImageSize, naming the first that has not
/// and how many others there are.
Status check_sizes(std::span<const map::MapImage> images, std::span<const PictureSize> sizes,
                   const camera::CameraConfig& camera);

/// That enough pictures are left after those that cannot be read. Errors: the first one's when there is none left,
/// kTooFewImages.
Status check_left(std::span<const Error> skipped, std::size_t left);

/// That the camera moved: not every picture shows what the first one shows from where it shows it. Error:
/// kTooFewImages.
Status check_motion(std::span<const map::MapImage> images, std::span<const features::Appearance> appearances,
                    std::uint64_t seed);

/// What the order of the pictures says against what they show.
///
/// A step from one picture to the next is a *jump* when the two have little or nothing in common while both have
/// closer relatives elsewhere in their tour, apart from each other. A tour that was cut (a lift, a break) has no such
/// relatives; one that passes a way twice has them side by side; pictures out of order have them anywhere.
/// Error: kInvalidInput when most steps are jumps. Else one warning for each tour with jumps, or with times that do
/// not rise.
/// Ours: docs/experiments/tours_out_of_order.md.
Result<std::vector<map::TourWarning>> check_order(std::span<const map::MapImage> images, std::span<const int> tour_of,
                                                  const mapping::PairTable& pairs);

}  // namespace homeward::pipeline
