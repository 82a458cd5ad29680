// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "tracking/image_pyramid.hpp"

namespace homeward::repeat {

/// The picture of a key image, made ready as those that the path was taught with. Asked for when it is needed; null
/// where there is none any more.
using KeyPictures = std::function<std::shared_ptr<const tracking::ImagePyramid>(int key)>;

}  // namespace homeward::repeat
