// SPDX-License-Identifier: Apache-2.0
#include "driving/mission.hpp"

#include "wire/appearance_blob.hpp"

namespace homeward::driving {
namespace {

/// Where the views of a path lie, and the views around it.
Status place_views(const wire::MissionOrder& order, VisualPath& path) {
  if (!order.surroundings) {
    place_by_edges(path);
    return {};
  }
  const wire::Surroundings& around = *order.surroundings;
  path.map_from_view = around.path;
  path.map_from_view.resize(path.views.size() - 1);
  path.map_from_view.push_back(around.final_pose);
  path.spread_m = around.spread_m;
  path.start_probability = around.start_probability;
  for (const wire::PlacedView& view : around.nearby) {
    auto appearance = wire::decode_appearance(view.appearance, "place " + view.place.str());
    if (!appearance) return pass_on(appearance);
    path.nearby.push_back({view.place, std::move(*appearance), view.map_from_view});
  }
  const auto position_of = [&](int view) -> Eigen::Vector2d {
    const auto number = static_cast<std::size_t>(view);
    const bool on_path = number < around.path.size();
    const Pose2& pose = on_path ? around.path[number] : around.nearby[number - around.path.size()].map_from_view;
    return {pose.x_m, pose.y_m};
  };
  for (const auto& [from, to] : around.ways) path.ways.push_back({position_of(from), position_of(to)});
  if (path.alone()) return {};
  std::vector<const features::Appearance*> views;
  for (int view = 0; view < path.placed(); ++view) views.push_back(&path.appearance(view));
  path.index = std::make_shared<const ViewIndex>(views);
  return {};
}

}  // namespace

Result<Mission> decode_mission(const wire::MissionOrder& order, const DrivingConfig& config) {
  if (order.feature_config_id != config.feature_config_id) {
    return fail(ErrorCode::kFeatureConfigMismatch,
                "The map's features (" + order.feature_config_id + ") are not this robot's (" +
                    config.feature_config_id + "); rebuild the map from the kept images.",
                "mission/feature_config_id");
  }
  Mission mission;
  mission.id = order.mission;
  mission.map = order.map;
  mission.revision = order.revision;
  mission.label = order.label;
  mission.dock = order.dock;
  mission.speed_limit_mps = order.speed_limit_mps;
  for (const wire::PathPlace& place : order.path) {
    auto view = wire::decode_appearance(place.appearance, "place " + place.place.str());
    if (!view) return pass_on(view);
    mission.path.views.push_back(std::move(*view));
    mission.path.edges.push_back(place.next);
    mission.path.places.push_back(place.place);
  }
  auto last = wire::decode_appearance(order.final_appearance, order.final_image.str());
  if (!last) return pass_on(last);
  // The destination's own picture is often its place's prototype; passing it twice would be one view too many.
  if (!order.path.empty() && order.path.back().image == order.final_image) mission.path.views.pop_back();
  mission.path.views.push_back(std::move(*last));
  if (!order.path.empty()) mission.path.places.resize(mission.path.views.size(), order.path.back().place);
  mission.path.edges.resize(mission.path.views.size());
  if (const Status placed = place_views(order, mission.path); !placed) return pass_on(placed);
  return mission;
}

}  // namespace homeward::driving
