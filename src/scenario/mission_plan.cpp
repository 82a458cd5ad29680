// SPDX-License-Identifier: Apache-2.0
#include "scenario/mission_plan.hpp"

#include <algorithm>

#include "sim/random.hpp"

namespace homeward::scenario {

int count_missions(const wire::ScenarioFile& scenario) {
  int count = 0;
  for (const wire::ScenarioMission& mission : scenario.missions) count += std::max(mission.times, mission.random);
  return count;
}

std::vector<MissionPlan> plan_missions(const wire::ScenarioFile& scenario, std::vector<std::string> destinations) {
  std::ranges::sort(destinations);
  sim::Random random(static_cast<std::uint64_t>(scenario.seed) * 2'654'435'761ULL + 1);
  std::vector<MissionPlan> plans;
  for (std::size_t entry = 0; entry < scenario.missions.size(); ++entry) {
    const wire::ScenarioMission& mission = scenario.missions[entry];
    MissionPlan plan{mission.from,
                     mission.to,
                     mission.light,
                     mission.people,
                     mission.moved_furniture,
                     mission.faults,
                     0,
                     entry,
                     mission.answers,
                     scenario.speed_limit_mps,
                     mission.start_beside_m,
                     mission.start_turned_rad,
                     mission.steering,
                     mission.rounds};
    const int count = std::max(mission.times, mission.random);
    for (int i = 0; i < count; ++i) {
      if (mission.random > 0) {
        const int rooms_count = static_cast<int>(destinations.size());
        const int from = sim::pick(random, rooms_count);
        const int to = (from + 1 + sim::pick(random, rooms_count - 1)) % rooms_count;
        plan.from = destinations[static_cast<std::size_t>(from)];
        plan.to = destinations[static_cast<std::size_t>(to)];
      }
      plan.seed = random();
      plans.push_back(plan);
    }
  }
  return plans;
}

}  // namespace homeward::scenario
