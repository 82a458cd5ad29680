// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/time.hpp"

namespace homeward::wire {

enum class MapState { kBuilding, kReady, kFailed };

/// "building", "ready", "failed".
std::string_view map_state_name(MapState state);
std::optional<MapState> map_state(std::string_view name);

/// What becomes of what drives saw of a map's places.
enum class RefineMode { kOff, kAsk, kAuto };

/// "off", "ask", "auto".
std::string_view refine_mode_name(RefineMode mode);
std::optional<RefineMode> refine_mode(std::string_view name);

using PlanId = Id<struct PlanTag>;  // of a drawn plan of a building

/// The drawn plan that a map is tied to.
struct MapPlanInfo {
  PlanId plan;
  std::int64_t version = 1;  // of the plan
  TimeUs tied_us = 0;
};

/// A map in a list of maps (proto/schemas/map_info.schema.json).
struct MapInfoView {
  MapId id;
  std::string name;
  MapState state = MapState::kBuilding;
  std::int64_t revision = 0;  // 0 until the first build is done
  std::int64_t places = 0;
  std::int64_t images = 0;
  std::vector<TourId> tours;                     // it was built from
  std::optional<std::string> feature_config_id;  // nothing until the first build is done
  RefineMode refine = RefineMode::kAsk;
  std::optional<MapPlanInfo> plan = {};  // nothing: tied to none
};

nlohmann::json map_info_to_json(const MapInfoView& map);

}  // namespace homeward::wire
