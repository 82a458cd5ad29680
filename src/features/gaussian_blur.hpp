// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace homeward::features {

/// A picture of 32-bit floating point numbers, blurred: what cv::GaussianBlur gives with its own choice of kernel and
/// border, sooner where the processor has fused multiply-add (blur_strips.hpp), where it differs in the last places.
/// `to` keeps its memory if that fits; it is not `from`.
/// The filter of the scale space: Lowe 2004, §3.
void gaussian_blur(const cv::Mat& from, cv::Mat& to, double sigma_px);

}  // namespace homeward::features
