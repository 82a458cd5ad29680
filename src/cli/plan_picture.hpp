// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/camera.hpp"
#include "core/image.hpp"
#include "linemodel/plan_tracker.hpp"

namespace homeward::cli {

/// What a tracker makes of its last picture, drawn: over the picture, its edges and the lines that the plan lets expect
/// from where it believes to be, confirmed or not; beside it the plan from above with all particles and the robot. The
/// picture is RGB, `said` the tracker's answer.
Image plan_picture(const Image& picture, const camera::Camera& camera, const linemodel::Plan& plan,
                   linemodel::PlanTracker& tracker, const linemodel::PlanEstimate& said);

}  // namespace homeward::cli
