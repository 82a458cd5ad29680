// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/ids.hpp"

namespace homeward::map {

/// A step of a tour between two pictures that do not follow on each other, by the names of their files.
struct TourJump {
  std::string from;
  std::string to;
};

/// What is odd about a tour and yet no reason to refuse it.
struct TourWarning {
  enum class Kind {
    kJumps,         // pictures that do not resemble the one before, but others
    kPictureOlder,  // a picture that is older than the one before
  };
  Kind kind = Kind::kJumps;
  ImageId image;                     // the first picture that it is about
  std::size_t jumps = 0;             // of kJumps, as all that follows
  std::size_t steps = 0;             // of the tour
  std::vector<TourJump> first = {};  // the first of the jumps
  bool against_times = false;        // the times say another order than the names, too
};

}  // namespace homeward::map
