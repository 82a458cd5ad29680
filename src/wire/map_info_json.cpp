// SPDX-License-Identifier: Apache-2.0
#include "wire/map_info_json.hpp"

#include <algorithm>
#include <array>

#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

constexpr std::array<std::string_view, 3> kMapStates = {"building", "ready", "failed"};
constexpr std::array<std::string_view, 3> kRefineModes = {"off", "ask", "auto"};

}  // namespace

std::string_view refine_mode_name(RefineMode mode) { return kRefineModes[static_cast<std::size_t>(mode)]; }

std::optional<RefineMode> refine_mode(std::string_view name) {
  const auto found = std::find(kRefineModes.begin(), kRefineModes.end(), name);
  if (found == kRefineModes.end()) return std::nullopt;
  return static_cast<RefineMode>(found - kRefineModes.begin());
}

std::string_view map_state_name(MapState state) { return kMapStates[static_cast<std::size_t>(state)]; }

std::optional<MapState> map_state(std::string_view name) {
  const auto found = std::find(kMapStates.begin(), kMapStates.end(), name);
  if (found == kMapStates.end()) return std::nullopt;
  return static_cast<MapState>(found - kMapStates.begin());
}

nlohmann::json map_info_to_json(const MapInfoView& map) {
  return {{"id", map.id.str()},
          {"name", map.name},
          {"state", map_state_name(map.state)},
          {"revision", map.revision},
          {"places", map.places},
          {"images", map.images},
          {"tours", ids_to_json(map.tours)},
          {"feature_config_id", or_null(map.feature_config_id)},
          {"refine", refine_mode_name(map.refine)}};
}

}  // namespace homeward::wire
