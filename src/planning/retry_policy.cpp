// SPDX-License-Identifier: Apache-2.0
#include "planning/retry_policy.hpp"

#include <algorithm>

namespace homeward::planning {
namespace {

constexpr int kMostDetours = 3;    // of one mission
constexpr int kMostRestarts = 20;  // each looks anew at where the robot is; in the end it has driven on and knows
constexpr int kMostUnsureRestarts = 3;

}  // namespace

double longest_mission_s(double length_m) {
  constexpr double kLeast_s = 600.0;
  constexpr double kSlowest_mps = 0.06;
  return std::max(kLeast_s, length_m / kSlowest_mps);
}

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
  if (failed.unsure && failed.unsure_restarts >= kMostUnsureRestarts) return std::nullopt;
  if (failed.astray || failed.unsure) {
    return failed.restarts < kMostRestarts ? std::optional(std::vector<Way>()) : std::nullopt;
  }
  if (failed.here == failed.destination) return std::nullopt;
  if (failed.detours >= kMostDetours) return std::nullopt;
  auto ways = failed_ways(failed);
  // At no place of its path before it drove any of it: it was sent from elsewhere than it stood, and no edge is to
  // blame.
  const bool elsewhere = failed.index == 0 && std::ranges::find(failed.path, failed.here) == failed.path.end();
  if (ways.empty() && !elsewhere) return std::nullopt;
  return ways;
}

bool fails_again(std::span<const Way> closed, std::span<const Way> failed) {
  return !failed.empty() &&
         std::ranges::all_of(failed, [&](const Way& way) { return std::ranges::find(closed, way) != closed.end(); });
}

Result<Detour> plan_detour(const map::TopologicalMap& map, const RouteRequest& request, bool may_try_again) {
  auto route = plan_route(map, request);
  if (route) return Detour{std::move(*route), false};
  if (!may_try_again || request.closed.empty() || route.error().code != ErrorCode::kNoRoute) return pass_on(route);
  RouteRequest open = request;
  open.closed.clear();
  auto again = plan_route(map, open);
  if (!again) return pass_on(route);
  return Detour{std::move(*again), true};
}

}  // namespace homeward::planning
