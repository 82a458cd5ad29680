// SPDX-License-Identifier: Apache-2.0
#include "wire/map_info_json.hpp"

#include "core/enum_names.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

nlohmann::json plan_to_json(const std::optional<MapPlanInfo>& plan) {
  if (!plan) return nullptr;
  return {{"id", plan->plan.str()}, {"version", plan->version}, {"tied_us", plan->tied_us}};
}

constexpr EnumNames<MapState, 3> kMapStates({"building", "ready", "failed"});
constexpr EnumNames<RefineMode, 3> kRefineModes({"off", "ask", "auto"});

}  // namespace

std::string_view refine_mode_name(RefineMode mode) { return kRefineModes.name(mode); }

std::optional<RefineMode> refine_mode(std::string_view name) { return kRefineModes.find(name); }

std::string_view map_state_name(MapState state) { return kMapStates.name(state); }

std::optional<MapState> map_state(std::string_view name) { return kMapStates.find(name); }

nlohmann::json map_info_to_json(const MapInfoView& map) {
  return {{"id", map.id.str()},
          {"name", map.name},
          {"state", map_state_name(map.state)},
          {"revision", map.revision},
          {"places", map.places},
          {"images", map.images},
          {"tours", ids_to_json(map.tours)},
          {"feature_config_id", or_null(map.feature_config_id)},
          {"refine", refine_mode_name(map.refine)},
          {"plan", plan_to_json(map.plan)}};
}

}  // namespace homeward::wire
