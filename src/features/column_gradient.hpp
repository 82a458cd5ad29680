// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "camera/panorama.hpp"
#include "features/column_segment.hpp"

namespace homeward::features {

inline constexpr double kGreyLevel = 256.0;  // what one grey level is in a prepared picture
inline constexpr int kGradientReach_px = 5;  // how far the vertical gradient looks

/// The pixels all of whose neighbours that the gradient looks at are seen by the camera, not 0; columns of the panorama
/// are rows here. Kept for this thread's last camera.
const cv::Mat& known_trusted_pixels(const camera::Panorama& panorama);

/// The value with `n` smaller or equal ones before it when all are put in order. None is below 0 or NaN; `n` is smaller
/// than their number.
float nth_smallest(const std::vector<float>& values, std::size_t n);

/// Neighbouring maxima of the vertical gradient of each column, with no pixel between them that is not `trusted`,
/// columns ascending and then rows. `grey`: 16 bits, in parts of kGreyLevel; columns of the panorama are rows in both.
/// Goedemé et al. 2007, §3.
std::vector<ColumnSegment> segments_between_maxima(const cv::Mat& grey, const cv::Mat& trusted, double min_length_px);

}  // namespace homeward::features
