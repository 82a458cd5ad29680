// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "driving/driver.hpp"
#include "driving/inputs.hpp"
#include "pipeline/eye.hpp"

namespace homeward::recording {

/// The bytes of a JPEG or PNG: what is looked at, sent and recorded is one and the same.
using PictureBytes = std::shared_ptr<const std::vector<std::uint8_t>>;

/// A picture as a camera sends it.
struct CameraPicture {
  driving::Milliseconds taken_ms = 0;
  std::optional<Pose2> odometry;
  PictureBytes bytes;
  bool recognised = true;  // its features are looked for; else it is only made ready for tracking
};

/// A driver's picture as bytes: as they came, or as JPEG where the driver has pixels only.
CameraPicture as_sent(driving::TakenPicture taken);

/// What the driving step is given of a picture: the one way from bytes to what is seen, on a robot, in a scenario and
/// in a replay. Errors: those of imageio::decode and of Eye::look.
Result<driving::SeenPicture> look(const CameraPicture& picture, const pipeline::Eye& eye);

}  // namespace homeward::recording
