// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "tracking/image_pyramid.hpp"

namespace homeward::repeat {

/// By how much the whole of a picture seems shifted against another one, in pixels of their finest level: a point of
/// `first` lies at itself plus the shift in `second`. The best normalised correlation of coarse pictures over up to
/// three fifths of the width and an eighth of the height. It bridges a turn that was too quick to track (a visual
/// compass: Zeil, Hofmann & Chahl 2003). Nothing where the pictures are not of one size, or plain.
std::optional<Eigen::Vector2d> picture_shift(const tracking::ImagePyramid& first, const tracking::ImagePyramid& second);

}  // namespace homeward::repeat
