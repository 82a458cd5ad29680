// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace homeward::sim {

/// A number in which every bit depends on every bit of `x` (splitmix64's finaliser, Steele, Lea & Flood 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 30U;
  x *= 0xBF58476D1CE4E5B9ULL;
  x ^= x >> 27U;
  x *= 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

}  // namespace homeward::sim
