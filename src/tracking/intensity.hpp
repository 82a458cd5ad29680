// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace homeward::tracking {

/// How the grey values of a patch are spread: shares that sum to 1.
using IntensityHistogram = std::array<float, 16>;

IntensityHistogram intensity_histogram(std::span<const std::uint8_t> patch);

/// What two histograms have in common, 0 to 1 (intersection: Swain and Ballard 1991).
double in_common(const IntensityHistogram& a, const IntensityHistogram& b);

}  // namespace homeward::tracking
