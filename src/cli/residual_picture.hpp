// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "camera/calibrate.hpp"
#include "core/image.hpp"

namespace homeward::cli {

/// All corners of the views used over a darkened picture of the camera, each with an arrow towards where the calibrated
/// camera predicts it, enlarged so that a typical arrow can be seen; the enlargement is written in the corner. Each
/// view has its colour.
Image residual_picture(const Image& picture, const std::vector<camera::BoardView>& views,
                       const camera::CalibrationResult& result);

}  // namespace homeward::cli
