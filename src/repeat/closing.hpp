// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "camera/camera.hpp"
#include "repeat/key_pictures.hpp"
#include "repeat/taught_path.hpp"
#include "repeat/teach_config.hpp"

namespace homeward::repeat {

/// Joins the last key image of a path to an earlier one of the same piece that shows the same place from where the way
/// goes on, if there is one: by matching without any expectation, as a gap is bridged, with the features of both key
/// images tracked into the other one. Nothing else of the path is changed: arcs all round it may disagree in scale
/// (Segvic et al. 2007, §2.1). Whether it is closed now. It is left open where too few features agree, where the place
/// lies behind or it was left by a turn alone, where the last key image faces another way, without `bridging` in the
/// configuration, and where a picture is missing. Precondition: it was taught with this configuration, and is open.
bool close_path(TaughtPath& path, const KeyPictures& pictures, const std::shared_ptr<const camera::Camera>& camera,
                const TeachConfig& config);

}  // namespace homeward::repeat
