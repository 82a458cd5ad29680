// SPDX-License-Identifier: Apache-2.0
#include "agent/scenario/scenario_run.hpp"

#include <algorithm>
#include <cstdio>

#include "agent/scenario/mission_run.hpp"
#include "agent/scenario/taught_world.hpp"
#include "sim/generate/painting.hpp"

namespace homeward::agent {
namespace {

int count_missions(const wire::ScenarioFile& scenario) {
  int count = 0;
  for (const wire::ScenarioMission& mission : scenario.missions) count += std::max(1, mission.random);
  return count;
}

/// The missions of a scenario, those at random drawn from the destinations.
std::vector<MissionPlan> expanded(const wire::ScenarioFile& scenario, const TaughtWorld& taught) {
  std::vector<std::string> rooms;
  for (const auto& [room, pose] : taught.destination_poses) rooms.push_back(room);
  sim::Random random(static_cast<std::uint64_t>(scenario.seed) * 2'654'435'761ULL + 1);
  std::vector<MissionPlan> plans;
  for (const wire::ScenarioMission& mission : scenario.missions) {
    MissionPlan plan{mission.from,   mission.to, mission.light, mission.people, mission.moved_furniture,
                     mission.faults, 0};
    const int count = std::max(1, mission.random);
    for (int i = 0; i < count; ++i) {
      if (mission.random > 0) {
        const int rooms_count = static_cast<int>(rooms.size());
        const int from = sim::pick(random, rooms_count);
        const int to = (from + 1 + sim::pick(random, rooms_count - 1)) % rooms_count;
        plan.from = rooms[static_cast<std::size_t>(from)];
        plan.to = rooms[static_cast<std::size_t>(to)];
      }
      plan.seed = random();
      plans.push_back(plan);
    }
  }
  return plans;
}

}  // namespace

Status run_scenario(const wire::ScenarioFile& scenario, const std::string& folder, const ScenarioListener& listener,
                    const std::optional<RecordingOptions>& record, const std::set<int>& only) {
  const auto told = [&](const std::string& what) {
    if (listener.told) listener.told(what);
  };
  // Known before the long tour already: only what was generated here says what is furniture.
  const bool from_file = scenario.world.find(':') == std::string::npos;
  if (from_file && std::ranges::any_of(scenario.missions, [](const auto& one) { return one.moved_furniture > 0; })) {
    return fail(ErrorCode::kInvalidInput,
                "Furniture can be moved in generated worlds alone: a mesh does not say which of its triangles are a "
                "piece of furniture.",
                "missions/moved_furniture");
  }
  const int missions = count_missions(scenario);
  if (!only.empty() && (*only.begin() < 1 || *only.rbegin() > missions)) {
    return fail(ErrorCode::kInvalidInput,
                "There is no mission " + std::to_string(*only.begin() < 1 ? *only.begin() : *only.rbegin()) +
                    "; the scenario has " + std::to_string(missions) + ".",
                "missions");
  }
  told("teaching " + scenario.world);
  auto taught = teach(scenario, folder);
  if (!taught) return pass_on(taught);
  if (taught->destination_poses.size() < 2) {
    return fail(ErrorCode::kInvalidInput, "The tour visits fewer than two rooms.", "tour/rooms");
  }
  told(std::to_string(taught->map->images.size()) + " pictures, " + std::to_string(taught->map->places.size()) +
       " places");
  sim::RobotProfile profile = scenario.robot == "chair" ? sim::chair_profile() : sim::disc_profile();
  if (scenario.ranges == "ultrasound") profile.ranges = sim::RangeSensor::kUltrasound;
  int number = 0;
  for (const MissionPlan& plan : expanded(scenario, *taught)) {
    ++number;
    if (!only.empty() && !only.contains(number)) continue;
    told("from " + plan.from + " to " + plan.to);
    std::optional<RecordingOptions> record_one = record;
    if (record_one) {
      char count[16];
      std::snprintf(count, sizeof count, "%03d-", number);
      record_one->name = count + plan.from + "-to-" + plan.to;
      record_one->wait_for_disk = true;
    }
    const auto result = run_mission(*taught, plan, profile, listener, record_one);
    if (!result) return pass_on(result);
    if (listener.done) listener.done(*result);
  }
  return {};
}

}  // namespace homeward::agent
