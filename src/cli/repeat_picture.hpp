// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/image.hpp"
#include "repeat/repeater.hpp"

namespace homeward::cli {

/// What a repeater sees in a picture, drawn: features by their state (tracked, or expected and not seen) over the
/// picture, the way it would steer, and beside it the arc with those around it from above, in the frame of the arc
/// alone and turned so that the robot looks up; nothing of it is common to the path. The picture is RGB, `said` its
/// answer.
Image repeat_picture(const Image& picture, const repeat::Repeater& repeater, const repeat::Repeated& said);

}  // namespace homeward::cli
