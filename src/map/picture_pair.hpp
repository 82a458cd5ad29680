// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/ids.hpp"

namespace homeward::map {

/// Where something is in a picture, in shares of its width and height from its upper left corner.
struct PicturePoint {
  double x = 0.0;
  double y = 0.0;
};

/// What both of two pictures see.
struct PairMatch {
  PicturePoint a;
  PicturePoint b;
  double distinctiveness = 0.0;  // 1: nothing else in the other picture looks nearly as like
  bool agrees = false;           // with the common turn
};

/// Two pictures of a map beside each other.
struct PicturePair {
  ImageId image_a;
  ImageId image_b;
  std::optional<double> distance;  // D; nothing: too little is common
  double similarity = 0.0;         // of D, in [0,1]
  std::optional<double> turn_rad;  // heading of b minus that of a
  std::optional<double> shift;     // share of its width by which b is moved to the left to lie below a
  std::vector<PairMatch> matches;
};

}  // namespace homeward::map
