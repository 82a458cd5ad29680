// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/ids.hpp"

namespace homeward::map {

/// Two pictures that have something in common.
struct AlikePair {
  std::uint32_t a = 0;  // indices of images, a < b
  std::uint32_t b = 0;
  std::uint8_t likeness = 0;  // s = 1/(1 + D/D0) of the visual distance D, in units of 1/255

  bool operator==(const AlikePair&) const = default;
};

/// How alike all pictures of a map are, as a build compared them. Pairs that are not here have nothing in common.
struct SimilarityMatrix {
  std::vector<ImageId> images;   // tour order
  std::vector<AlikePair> pairs;  // by b, then by a

  bool operator==(const SimilarityMatrix&) const = default;
};

}  // namespace homeward::map
