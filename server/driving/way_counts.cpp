// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <algorithm>

#include "server/driving/driving.hpp"
#include "wire/mission_order.hpp"

namespace homeward::server {

void Driving::count_ways(const wire::MissionView& mission, std::int64_t first, std::int64_t last, bool driven) {
  std::vector<db::DrivenWay> ways;
  last = std::min(last, static_cast<std::int64_t>(mission.path.size()) - 1);
  for (std::int64_t i = std::max<std::int64_t>(first, 1); i <= last; ++i) {
    ways.push_back({mission.path[static_cast<std::size_t>(i) - 1], mission.path[static_cast<std::size_t>(i)]});
  }
  if (ways.empty()) return;
  // A count that the disk does not take is lost: it only says how a way was fared on so far.
  const bool queued =
      journal_.try_run([this, map = mission.map, ways = std::move(ways), driven, t_us = clock_.wall_us()] {
        if (const Status counted = store_.count_way_drives(map, ways, driven, t_us); !counted) {
          spdlog::warn("drives on ways of map {} are not counted: {}", map.str(), counted.error().message);
        }
      });
  if (!queued) spdlog::warn("drives on ways of map {} are not counted: the server ends", mission.map.str());
}

void Driving::confirm_ways(const map::TopologicalMap& map, const std::vector<PlaceId>& path, wire::MissionOrder& order,
                           const MapId& id) {
  bool any = false;
  for (std::size_t i = 0; i + 1 < path.size() && !any; ++i) any = wire::drawn_by_a_person(map, path[i], path[i + 1]);
  if (!any) return;
  const auto ways = store_.way_drives(id);
  if (!ways) {
    spdlog::warn("ways of map {} are driven slowly: {}", id.str(), ways.error().message);
    return;
  }
  for (const db::WayDrives& way : *ways) {
    if (way.driven > 0 && wire::drawn_by_a_person(map, way.from, way.to)) wire::confirm_way(way.from, way.to, order);
  }
}

}  // namespace homeward::server
