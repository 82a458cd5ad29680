// SPDX-License-Identifier: Apache-2.0
#include "scenario/check_scenario.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "scenario/bystander.hpp"
#include "scenario/look_alike_spot.hpp"
#include "scenario/mission_plan.hpp"
#include "scenario/scenario_robot.hpp"
#include "scenario/starting_pose.hpp"
#include "scenario/world_folder.hpp"
#include "sim/floor.hpp"
#include "sim/tour_path.hpp"

namespace homeward::scenario {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

class Checker {
 public:
  Checker(const wire::ScenarioFile& scenario, const sim::World& world) : scenario_(scenario), world_(world) {
    for (const sim::Room& room : world.rooms) rooms_.emplace(room.name, Eigen::Vector2d(room.x_m, room.y_m));
    for (const std::string& room : scenario.tour_rooms) {
      const bool known = std::ranges::find(visited_, room) != visited_.end();
      if (rooms_.contains(room) && !known) visited_.push_back(room);
    }
  }

  std::vector<ScenarioProblem> run() {
    check_tour();
    for (std::size_t i = 0; i < scenario_.missions.size(); ++i) check_mission(i);
    if (repeats()) {
      check_repeats();
    } else {
      check_starts();
    }
    return std::move(problems_);
  }

 private:
  static std::string entry(std::size_t index) { return "missions[" + std::to_string(index) + "]"; }

  void add(std::string where, std::string message) { problems_.push_back({std::move(where), std::move(message)}); }

  [[nodiscard]] std::string no_room(const std::string& room) const {
    std::vector<std::string> names;
    for (const sim::Room& known : world_.rooms) names.push_back(known.name);
    return "there is no room '" + room + "' in this world; " +
           (names.empty() ? "it has none" : "its rooms are " + listed(names));
  }

  void check_tour() {
    const std::vector<std::string>& tour = scenario_.tour_rooms;
    if (tour.size() < 2) add("tour.rooms", "a tour goes through at least two rooms");
    for (std::size_t i = 0; i < tour.size(); ++i) {
      const std::string where = "tour.rooms[" + std::to_string(i) + "]";
      if (!rooms_.contains(tour[i])) {
        add(where, no_room(tour[i]));
      } else if (i > 0 && tour[i] == tour[i - 1]) {
        add(where, "'" + tour[i] + "' follows upon itself; a tour goes from one room to another");
      } else if (i > 0 && rooms_.contains(tour[i - 1]) && !is_joined(tour[i - 1], tour[i])) {
        add(where, "no way that is wide enough leads here from '" + tour[i - 1] + "'");
      }
    }
    check_light("tour.light", scenario_.tour_light);
    if (scenario_.tour_explored && scenario_.ranges == "ultrasound")
      add("tour.rooms", "exploring takes a laser: arcs of ultrasound are no surfaces to find one's way by");
  }

  /// A way begins and ends at the floor nearest to the rooms' points, which may be that of another room.
  bool is_joined(const std::string& from, const std::string& to) {
    constexpr double kWithin_m = 1.0;
    const auto [known, is_new] = joined_.try_emplace({from, to}, false);
    if (!is_new) return known->second;
    const auto way_m = sim::shortest_way(world_.drivable, rooms_.at(from), rooms_.at(to));
    known->second = way_m.size() >= 2 && (way_m.front() - rooms_.at(from)).norm() <= kWithin_m &&
                    (way_m.back() - rooms_.at(to)).norm() <= kWithin_m;
    return known->second;
  }

  void check_light(const std::string& where, const std::string& name) {
    const auto light = light_named(name);
    if (!light) {
      add(where, "there is no light '" + name + "'; there are day, night, half and daylight:0 to daylight:1");
    } else if (*light != sim::Light(sim::LightPreset::kDay) && world_.lamps.empty()) {
      add(where, "'" + name + "' is the light of lamps, and this world has none; there is day");
    }
  }

  void check_mission(std::size_t index) {
    const wire::ScenarioMission& mission = scenario_.missions[index];
    if (mission.random > 0) {
      if (visited_.size() < 2)
        add(entry(index) + ".random", "the tour visits fewer than two rooms of this world to drive between");
    } else {
      if (!rooms_.contains(mission.from)) add(entry(index) + ".from", no_room(mission.from));
      if (std::ranges::find(visited_, mission.to) == visited_.end())
        add(entry(index) + ".to", "the tour does not visit '" + mission.to + "'; it visits " +
                                      (visited_.empty() ? "no room of this world" : listed(visited_)));
    }
    check_light(entry(index) + ".light", mission.light);
    if (!answers_named(mission.answers, {}))
      add(entry(index) + ".answers", "nobody answers '" + mission.answers + "'; there are nobody, right and yes");
    if (mission.moved_furniture > 0 && world_.furniture.empty())
      add(entry(index) + ".moved_furniture",
          "furniture can be moved in generated worlds alone: a mesh does not say which of its triangles are a piece of "
          "furniture");
    check_kidnapping(entry(index), mission.faults);
  }

  [[nodiscard]] bool repeats() const { return scenario_.mode == wire::ScenarioMode::kRepeat; }

  /// A path that was taught begins where the tour was, and has no other place that looks alike.
  void check_repeats() {
    if (scenario_.tour_explored) add("tour.rooms", "a path is taught by a tour that somebody leads");
    for (std::size_t i = 0; i < scenario_.missions.size(); ++i) {
      const wire::ScenarioMission& mission = scenario_.missions[i];
      if (std::ranges::find(visited_, mission.from) == visited_.end() && rooms_.contains(mission.from))
        add(entry(i) + ".from", "the tour does not visit '" + mission.from + "', and a path begins where it was");
      for (const wire::ScenarioFault& fault : mission.faults) {
        if (fault.kind == wire::FaultKind::kKidnapped)
          add(entry(i) + ".faults", "a robot that repeats a path is not kidnapped here");
      }
    }
  }

  /// Where the robot will be is not known; that there is no spot far enough from any other may be.
  void check_kidnapping(const std::string& where, const std::vector<wire::ScenarioFault>& faults) {
    for (std::size_t i = 0; i < faults.size(); ++i) {
      if (faults[i].kind == wire::FaultKind::kKidnapped && is_tour_small())
        add(where + ".faults[" + std::to_string(i) + "]",
            "the tour goes nowhere that is 4 m from all else to put a kidnapped robot");
    }
  }

  [[nodiscard]] bool is_tour_small() {
    if (is_tour_small_) return *is_tour_small_;
    is_tour_small_ = false;  // of a tour that cannot be made, other things are said
    if (const auto stops = sim::plan_tour(world_, scenario_.tour_rooms, scenario_.tour_step_m)) {
      Eigen::Array2d least_m = Eigen::Array2d::Constant(1e9);
      Eigen::Array2d most_m = -least_m;
      for (const sim::TourStop& stop : *stops) {
        least_m = least_m.min(Eigen::Array2d(stop.pose.x_m, stop.pose.y_m));
        most_m = most_m.max(Eigen::Array2d(stop.pose.x_m, stop.pose.y_m));
      }
      is_tour_small_ = (most_m - least_m).matrix().norm() < kLeastLift_m;
    }
    return *is_tour_small_;
  }

  /// Each mission by its own seed, so that none is refused here that would find a start.
  void check_starts() {
    const bool draws = std::ranges::any_of(scenario_.missions, [](const auto& one) { return one.random > 0; });
    if (draws && visited_.size() < 2) return;
    const sim::RobotProfile robot = profile_of(scenario_);
    const sim::Obstacles obstacles(world_);
    std::set<std::pair<std::size_t, std::string>> reported;
    for (const MissionPlan& plan : plan_missions(scenario_, visited_)) {
      const auto room = rooms_.find(plan.from);
      if (room == rooms_.end() || plan.moved_furniture > 0) continue;
      const auto start = starting_pose(world_, obstacles, room->second, robot, plan.seed);
      if (start || !reported.emplace(plan.entry, plan.from).second) continue;
      const bool random = scenario_.missions[plan.entry].random > 0;
      add(entry(plan.entry) + (random ? ".random" : ".from"), "the " + robot.name + " does not fit in at '" +
                                                                  plan.from +
                                                                  "': no pose within 1 m of the room's point leaves it "
                                                                  "0.05 m of room to start from");
    }
  }

  const wire::ScenarioFile& scenario_;
  const sim::World& world_;
  std::map<std::string, Eigen::Vector2d> rooms_;  // their points, metres
  std::vector<std::string> visited_;              // rooms of the world that the tour visits, each once
  std::map<std::pair<std::string, std::string>, bool> joined_;
  std::optional<bool> is_tour_small_;
  std::vector<ScenarioProblem> problems_;
};

}  // namespace

std::vector<ScenarioProblem> check_scenario(const wire::ScenarioFile& scenario, const sim::World& world) {
  return Checker(scenario, world).run();
}

Error error_of(const std::vector<ScenarioProblem>& problems) {
  constexpr std::size_t kMost = 20;  // a scenario may have 10,000 missions
  std::string message;
  if (problems.size() > 1) message = "The scenario has " + std::to_string(problems.size()) + " problems. ";
  for (std::size_t i = 0; i < std::min(kMost, problems.size()); ++i)
    message += (i > 0 ? " " : "") + problems[i].where + ": " + problems[i].message + ".";
  if (problems.size() > kMost) message += " And " + std::to_string(problems.size() - kMost) + " more.";
  return {ErrorCode::kInvalidInput, message, {}};
}

}  // namespace homeward::scenario
