// SPDX-License-Identifier: Apache-2.0
#include "scenario/world_of_day.hpp"

#include <string>
#include <utility>

#include "core/version.hpp"
#include "sim/moved_furniture.hpp"

namespace homeward::scenario {

Result<WorldOfDay> world_of_day(TaughtWorld& taught, const MissionPlan& plan, const sim::RobotProfile& profile,
                                const sim::Light& light) {
  WorldOfDay day;
  day.world = taught.world.get();
  if (plan.moved_furniture <= 0) {
    prepare_light(*day.world, light);
    return day;
  }
  const double half_width_m = profile.outline.radius_m + profile.outline.side_m;
  auto moved = sim::move_furniture(day.world->world(), plan.moved_furniture, half_width_m, plan.seed + 29);
  if (!moved) return pass_on(moved);
  day.moved_furniture = moved->moved;
  day.changed = std::make_unique<sim::LitWorld>(std::move(moved->world));
  day.world = day.changed.get();
  day.world->irradiance(light);  // of this mission alone: not for the cache
  return day;
}

Result<std::unique_ptr<recording::Recorder>> recorder_for(const TaughtWorld& taught,
                                                          const std::optional<recording::RecordingOptions>& record,
                                                          const driving::DrivingConfig& config,
                                                          const ScenarioListener& listener) {
  if (!record) return std::unique_ptr<recording::Recorder>();
  const recording::Recorder::Robot recorded{name_with_version("homeward simulate"), taught.camera,
                                            taught.map->feature_config, config};
  return recording::Recorder::create(*record, recorded, [&listener](const std::string& what) {
    if (listener.log) listener.log(what);
  });
}

}  // namespace homeward::scenario
