// SPDX-License-Identifier: Apache-2.0
#include "tracking/intensity.hpp"

#include <algorithm>
#include <cstddef>

namespace homeward::tracking {

IntensityHistogram intensity_histogram(std::span<const std::uint8_t> patch) {
  IntensityHistogram shares{};
  if (patch.empty()) return shares;
  // Each value is shared out between the two bins whose centres it lies between.
  constexpr float kBin = 256.0F / static_cast<float>(std::tuple_size_v<IntensityHistogram>);
  const auto last = static_cast<float>(shares.size() - 1);
  const float each = 1.0F / static_cast<float>(patch.size());
  for (const std::uint8_t value : patch) {
    const float at = std::clamp((static_cast<float>(value) + 0.5F) / kBin - 0.5F, 0.0F, last);
    const auto low = static_cast<std::size_t>(at);
    const float rest = at - static_cast<float>(low);
    shares[low] += each * (1.0F - rest);
    if (rest > 0.0F) shares[low + 1] += each * rest;
  }
  return shares;
}

double in_common(const IntensityHistogram& a, const IntensityHistogram& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(std::min(a[i], b[i]));
  return sum;
}

}  // namespace homeward::tracking
