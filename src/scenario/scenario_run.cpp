// SPDX-License-Identifier: Apache-2.0
#include "scenario/scenario_run.hpp"

#include <cstdio>
#include <utility>

#include "scenario/check_scenario.hpp"
#include "scenario/mission_run.hpp"
#include "scenario/repeat_run.hpp"
#include "scenario/scenario_robot.hpp"
#include "scenario/taught_world.hpp"
#include "scenario/true_ways.hpp"
#include "sim/tour_path.hpp"

namespace homeward::scenario {
namespace {

/// How many shortcuts were accepted, and how many of them a disc cannot drive in the world as it is.
std::string shortcuts_in_words(const TaughtWorld& taught) {
  const sim::Obstacles obstacles(taught.world->world());
  int accepted = 0;
  int touching = 0;
  for (const map::Shortcut& one : taught.map->shortcuts) {
    ++accepted;
    const Pose2& a = taught.picture_poses.at(one.image_a);
    const Pose2& b = taught.picture_poses.at(one.image_b);
    touching += clearance_along_m(obstacles, sim::disc_profile(), a, b) <= 0.0 ? 1 : 0;
  }
  return std::to_string(accepted) + " shortcuts accepted, " + std::to_string(touching) + " of them lead into something";
}

}  // namespace

Status run_scenario(wire::ScenarioFile scenario, const std::string& folder, const ScenarioListener& listener,
                    const std::optional<recording::RecordingOptions>& record, const std::set<int>& only) {
  const auto report = [&](const std::string& what) {
    if (listener.log) listener.log(what);
  };
  const int missions = count_missions(scenario);
  if (!only.empty() && (*only.begin() < 1 || *only.rbegin() > missions)) {
    return fail(ErrorCode::kInvalidInput,
                "There is no mission " + std::to_string(*only.begin() < 1 ? *only.begin() : *only.rbegin()) +
                    "; the scenario has " + std::to_string(missions) + ".",
                "missions");
  }
  auto world = world_of(scenario, folder);
  if (!world) return pass_on(world);
  if (scenario.tours_all_rooms) scenario.tour_rooms = sim::all_rooms(*world);
  // All that can be known is said before the long tour.
  if (const auto problems = check_scenario(scenario, *world); !problems.empty())
    return tl::unexpected<Error>(error_of(problems));
  report("teaching " + scenario.world);
  auto taught = teach(scenario, folder, std::move(*world));
  if (!taught) return pass_on(taught);
  report(std::to_string(taught->map->images.size()) + " pictures, " + std::to_string(taught->map->places.size()) +
         " places");
  if (scenario.tour_shortcuts) report(shortcuts_in_words(*taught));
  const sim::RobotProfile profile = profile_of(scenario);
  std::vector<std::string> destinations;
  for (const auto& [room, pose] : taught->destination_poses) destinations.push_back(room);
  int number = 0;
  for (const MissionPlan& plan : plan_missions(scenario, destinations)) {
    ++number;
    if (!only.empty() && !only.contains(number)) continue;
    report("from " + plan.from + " to " + plan.to);
    std::optional<recording::RecordingOptions> record_one = record;
    if (record_one) {
      char count[16];
      std::snprintf(count, sizeof count, "%03d-", number);
      record_one->name = count + plan.from + "-to-" + plan.to;
      record_one->wait_for_disk = true;
    }
    const bool repeats = scenario.mode == wire::ScenarioMode::kRepeat;
    const auto result = repeats ? run_repeat(*taught, plan, profile, listener, record_one)
                                : run_mission(*taught, plan, profile, listener, record_one);
    if (!result) return pass_on(result);
    if (listener.done) listener.done(*result);
  }
  return {};
}

}  // namespace homeward::scenario
