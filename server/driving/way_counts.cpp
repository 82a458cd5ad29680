// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <algorithm>
#include <unordered_set>

#include "map/lookup.hpp"
#include "server/driving/driving.hpp"
#include "wire/mission_order.hpp"

namespace homeward::server {
namespace {

/// When somebody last changed one of two places, or the ways at them.
TimeUs changed_us(const map::TopologicalMap& map, const PlaceId& from, const PlaceId& to) {
  std::unordered_set<ImageId> images;
  for (const PlaceId& id : {from, to}) {
    const map::Place* place = map::find_place(map, id);
    if (place != nullptr) images.insert(place->members.begin(), place->members.end());
  }
  TimeUs latest_us = 0;
  for (const map::Edit& edit : map.edits) {
    const bool only_names = edit.kind == map::EditKind::kRename || edit.kind >= map::EditKind::kAddDestination;
    if (only_names) continue;
    const bool here = images.contains(edit.image_a) || images.contains(edit.image_b) ||
                      std::ranges::any_of(edit.images, [&](const ImageId& image) { return images.contains(image); });
    if (here) latest_us = std::max(latest_us, edit.t_us);
  }
  return latest_us;
}

}  // namespace

void Driving::count_driven(RobotUnit& unit, std::int64_t index, wire::DriveState state) {
  const wire::MissionView& mission = *unit.mission;
  const std::int64_t before = mission.path_index;
  const bool from_the_one_before = before == 1 || before == unit.stepped_to;
  if (index != before) unit.stepped_to = index == before + 1 ? index : 0;
  if (mission.state != wire::MissionState::kDriving || !from_the_one_before) return;
  const bool next = state == wire::DriveState::kDriving && index == before + 1;
  const bool arrived = state == wire::DriveState::kArrived && index == before &&
                       index + 1 == static_cast<std::int64_t>(mission.path.size());
  if (!(next || arrived) || before <= unit.counted_to) return;
  unit.counted_to = before;
  count_way(mission, before, true);
}

void Driving::count_way(const wire::MissionView& mission, std::int64_t index, bool driven) {
  if (index < 1 || index >= static_cast<std::int64_t>(mission.path.size())) return;
  const auto at = static_cast<std::size_t>(index);
  const db::DrivenWay way{mission.path[at - 1], mission.path[at]};
  // A count that the disk does not take is lost: what is not counted stays slow.
  const bool queued = journal_.try_run([this, map = mission.map, way, driven, t_us = clock_.wall_us()] {
    if (const Status counted = store_.count_way_drives(map, {way}, driven, t_us); !counted) {
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
    const bool held = way.driven > 0 && way.last_driven_us >= way.last_failed_us;
    if (!held || !wire::drawn_by_a_person(map, way.from, way.to)) continue;
    // What was driven before somebody changed these places may have been another way.
    if (way.last_driven_us > changed_us(map, way.from, way.to)) wire::confirm_way(way.from, way.to, order);
  }
}

}  // namespace homeward::server
