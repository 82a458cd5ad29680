// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace homeward::map {

/// The pictures by which a destination can be known to those who do not read (Destination::pictogram).
inline constexpr std::array<std::string_view, 14> kPictograms = {"bath",    "bed",     "desk",      "dining",    "door",
                                                                 "garden",  "kitchen", "lift",      "reception", "seat",
                                                                 "therapy", "toilet",  "treatment", "wardrobe"};

inline bool is_pictogram(std::string_view name) { return std::ranges::find(kPictograms, name) != kPictograms.end(); }

}  // namespace homeward::map
