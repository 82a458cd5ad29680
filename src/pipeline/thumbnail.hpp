// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.hpp"
#include "core/result.hpp"
#include "pipeline/eye.hpp"

namespace homeward::pipeline {

/// A small picture of a place for people: its panorama as a strip, JPEG. Errors: kWrongImageSize.
Result<std::vector<std::uint8_t>> make_thumbnail(const Eye& eye, const Image& picture, int width_px = 560);

}  // namespace homeward::pipeline
