// SPDX-License-Identifier: Apache-2.0
#include "planning/detour.hpp"

#include <algorithm>

namespace homeward::planning {
namespace {

constexpr int kMostDetours = 3;  // of one mission

}  // namespace

std::vector<Way> failed_ways(const FailedDrive& failed) {
  std::vector<Way> ways;
  const auto size = static_cast<std::int64_t>(failed.path.size());
  const auto close = [&](std::int64_t before) {
    const PlaceId& from = failed.path[static_cast<std::size_t>(before)];
    const PlaceId& to = failed.path[static_cast<std::size_t>(before) + 1];
    ways.push_back({from, to});
    ways.push_back({to, from});
  };
  if (failed.index > 0 && failed.index < size) close(failed.index - 1);
  const auto at = std::ranges::find(failed.path, failed.here) - failed.path.begin();
  if (at >= failed.index && at + 1 < size) close(at);
  return ways;
}

std::optional<std::vector<Way>> detour_after(const FailedDrive& failed) {
  if (failed.detours >= kMostDetours || failed.here == failed.destination) return std::nullopt;
  auto ways = failed_ways(failed);
  if (ways.empty()) return std::nullopt;
  return ways;
}

}  // namespace homeward::planning
