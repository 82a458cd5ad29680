// SPDX-License-Identifier: Apache-2.0
#include "features/azimuth_spread.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace homeward::features {

std::vector<int> spread_over_azimuth(std::span<const RankedFeature> found, int budget) {
  std::vector<int> order(found.size());
  std::iota(order.begin(), order.end(), 0);
  const auto feature = [&](int i) -> const RankedFeature& { return found[static_cast<std::size_t>(i)]; };
  std::ranges::stable_sort(order, std::greater<>(), [&](int i) { return feature(i).strength; });
  std::array<std::vector<int>, kAzimuthSectors> sectors;
  for (const int i : order) {
    sectors[static_cast<std::size_t>(std::clamp(feature(i).sector, 0, kAzimuthSectors - 1))].push_back(i);
  }
  std::vector<int> kept;
  for (std::size_t round = 0; static_cast<int>(kept.size()) < budget; ++round) {
    const std::size_t before = kept.size();
    for (const std::vector<int>& sector : sectors) {
      if (round < sector.size() && static_cast<int>(kept.size()) < budget) kept.push_back(sector[round]);
    }
    if (kept.size() == before) break;
  }
  return kept;
}

}  // namespace homeward::features
