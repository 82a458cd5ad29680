// SPDX-License-Identifier: Apache-2.0
#include "scenario/check_scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenario/mission_plan.hpp"
#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "support/box_world.hpp"

namespace homeward::scenario::check_scenario_test {
namespace {

using homeward::testing::box_world;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

wire::ScenarioMission mission(const std::string& from, const std::string& to) {
  wire::ScenarioMission mission;
  mission.from = from;
  mission.to = to;
  return mission;
}

wire::ScenarioMission random_missions(int count) {
  wire::ScenarioMission mission;
  mission.random = count;
  return mission;
}

/// There and back in a box of two rooms, "west" and "east".
wire::ScenarioFile there_and_back() {
  wire::ScenarioFile scenario;
  scenario.world = "world.json";
  scenario.camera_model = "hyperbolic_mirror";
  scenario.tour_rooms = {"west", "east", "west"};
  scenario.missions = {mission("west", "east"), random_missions(3)};
  return scenario;
}

/// The problems as lines.
std::vector<std::string> problems(const wire::ScenarioFile& scenario, const sim::World& world = box_world()) {
  std::vector<std::string> lines;
  for (const ScenarioProblem& problem : check_scenario(scenario, world))
    lines.push_back(problem.where + ": " + problem.message);
  return lines;
}

template <class Change>
std::vector<std::string> problems_when(const Change& change) {
  wire::ScenarioFile scenario = there_and_back();
  change(scenario);
  return problems(scenario);
}

/// Something stands on every cell of this part of the floor.
void fill(sim::World& world, double from_x_m, double to_x_m) {
  sim::FloorGrid& grid = world.occupied;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const double x_m = sim::centre_of(grid, {column, row}).x();
      if (x_m < from_x_m || x_m > to_x_m) continue;
      grid.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                 static_cast<std::size_t>(column)] = 255;
    }
  }
}

TEST(CheckScenario, FindsNothingWhereAllIsWell) {
  EXPECT_THAT(problems(there_and_back()), IsEmpty());
  wire::ScenarioFile house = there_and_back();
  house.robot = "chair";
  house.tour_rooms = {"hall", "kitchen", "hall"};
  house.tour_light = "night";
  house.missions = {mission("living_room", "kitchen"), random_missions(20)};
  house.missions[0].moved_furniture = 2;
  house.missions[0].light = "half";
  EXPECT_THAT(problems(house, sim::generate_house(1)), IsEmpty());
  house.missions.clear();
  EXPECT_THAT(problems(house, sim::generate_house(1)), IsEmpty());
}

TEST(CheckScenario, NamesAnAnswerThatThereIsNot) {
  EXPECT_THAT(problems_when([](auto& scenario) { scenario.missions[0].answers = "wrong"; }),
              ElementsAre("missions[0].answers: nobody answers 'wrong'; there are nobody, right and yes"));
  for (const char* name : {"nobody", "right", "yes"}) {
    EXPECT_THAT(problems_when([&](auto& scenario) { scenario.missions[0].answers = name; }), IsEmpty()) << name;
  }
}

TEST(CheckScenario, NamesADestinationThatTheTourDoesNotVisit) {
  wire::ScenarioFile house = there_and_back();
  house.tour_rooms = {"hall", "kitchen", "hall"};
  house.missions = {random_missions(2), mission("hall", "kitchen"), mission("hall", "bathroom"),
                    mission("hall", "pantry")};
  EXPECT_THAT(problems(house, sim::generate_house(1)),
              ElementsAre("missions[2].to: the tour does not visit 'bathroom'; it visits hall, kitchen",
                          "missions[3].to: the tour does not visit 'pantry'; it visits hall, kitchen"));
}

TEST(CheckScenario, NamesRoomsThatThereAreNot) {
  EXPECT_THAT(problems_when([](auto& scenario) {
                scenario.tour_rooms.emplace_back("cellar");
                scenario.missions[0].from = "attic";
              }),
              ElementsAre("tour.rooms[3]: there is no room 'cellar' in this world; its rooms are west, east",
                          "missions[0].from: there is no room 'attic' in this world; its rooms are west, east"));
  sim::World without_rooms = box_world();
  without_rooms.rooms.clear();
  EXPECT_THAT(problems(there_and_back(), without_rooms),
              ElementsAre(HasSubstr("tour.rooms[0]: there is no room 'west' in this world; it has none"),
                          HasSubstr("tour.rooms[1]"), HasSubstr("tour.rooms[2]"), HasSubstr("missions[0].from"),
                          "missions[0].to: the tour does not visit 'east'; it visits no room of this world",
                          HasSubstr("missions[1].random: the tour visits fewer than two rooms")));
}

TEST(CheckScenario, WantsATourFromRoomToRoom) {
  EXPECT_THAT(problems_when([](auto& scenario) {
                scenario.tour_rooms = {"west", "west", "east"};
              }),
              ElementsAre(HasSubstr("tour.rooms[1]: 'west' follows upon itself")));
  EXPECT_THAT(problems_when([](auto& scenario) {
                scenario.tour_rooms = {"east"};
                scenario.missions.pop_back();
              }),
              ElementsAre("tour.rooms: a tour goes through at least two rooms"));
}

TEST(CheckScenario, DrawsMissionsBetweenTwoRoomsAtLeast) {
  EXPECT_THAT(problems_when([](auto& scenario) {
                scenario.tour_rooms = {"east", "cellar"};
              }),
              ElementsAre(HasSubstr("tour.rooms[1]"),
                          "missions[1].random: the tour visits fewer than two rooms of this world to drive between"));
}

TEST(CheckScenario, NamesAWayThatIsNotWideEnough) {
  sim::World parted = box_world(true);
  parted.drivable = sim::drivable_cells(parted.occupied, 0.8, parted.start);  // the passage is 1.5 m wide
  EXPECT_THAT(problems(there_and_back(), parted),
              ElementsAre("tour.rooms[1]: no way that is wide enough leads here from 'west'",
                          "tour.rooms[2]: no way that is wide enough leads here from 'east'",
                          HasSubstr("missions[1].random: the disc does not fit in at 'east'")));
}

TEST(CheckScenario, NamesLightThatThereIsNot) {
  EXPECT_THAT(
      problems_when([](auto& scenario) { scenario.missions[1].light = "dusk"; }),
      ElementsAre(
          "missions[1].light: there is no light 'dusk'; there are day, night, half and daylight:0 to daylight:1"));
  sim::World dark = box_world();
  dark.lamps.clear();
  wire::ScenarioFile scenario = there_and_back();
  EXPECT_THAT(problems(scenario, dark), IsEmpty()) << "by day there are windows";
  scenario.tour_light = "half";
  scenario.missions[0].light = "night";
  EXPECT_THAT(problems(scenario, dark),
              ElementsAre("tour.light: 'half' is the light of lamps, and this world has none; there is day",
                          HasSubstr("missions[0].light: 'night' is the light of lamps")));
}

TEST(CheckScenario, KnowsThatFurnitureOfAMeshCannotBeMoved) {
  EXPECT_THAT(problems_when([](auto& scenario) { scenario.missions[0].moved_furniture = 1; }),
              ElementsAre(HasSubstr("missions[0].moved_furniture: furniture can be moved in generated worlds alone")));
}

TEST(CheckScenario, KnowsThatASmallTourHasNoOtherSpotForAKidnappedRobot) {
  EXPECT_THAT(problems_when([](auto& scenario) {
                scenario.missions[0].faults = {{wire::FaultKind::kStop, 9.0}, {wire::FaultKind::kKidnapped, 5.0}};
              }),
              ElementsAre(HasSubstr("missions[0].faults[1]: the tour goes nowhere")));
  wire::ScenarioFile house = there_and_back();
  house.tour_rooms = {"hall", "kitchen"};
  house.missions = {random_missions(1)};
  house.missions[0].faults = {{wire::FaultKind::kKidnapped, 5.0}};
  EXPECT_THAT(problems(house, sim::generate_house(1)), IsEmpty());
}

TEST(CheckScenario, NamesARobotThatDoesNotFit) {
  sim::World narrow = box_world();
  fill(narrow, 0.1, 2.0);
  wire::ScenarioFile scenario = there_and_back();
  scenario.robot = "chair";
  scenario.missions = {mission("west", "east"), mission("east", "west"), random_missions(20)};
  EXPECT_THAT(problems(scenario, narrow),
              ElementsAre(HasSubstr("missions[1].from: the chair does not fit in at 'east'"),
                          HasSubstr("missions[2].random: the chair does not fit in at 'east'")));
  scenario.missions = {mission("east", "west")};
  scenario.missions[0].moved_furniture = 1;
  narrow.furniture.emplace_back();
  EXPECT_THAT(problems(scenario, narrow), IsEmpty()) << "not known before it has been moved";
}

TEST(CheckScenario, TellsAllProblemsInOneError) {
  EXPECT_EQ(error_of({{"missions[3].to", "the tour does not visit 'pantry'"}}).message,
            "missions[3].to: the tour does not visit 'pantry'.");
  const Error two = error_of({{"tour.light", "dark"}, {"missions[0].to", "far"}});
  EXPECT_EQ(two.message, "The scenario has 2 problems. tour.light: dark. missions[0].to: far.");
  EXPECT_EQ(two.code, ErrorCode::kInvalidInput);
  const Error many = error_of(std::vector<ScenarioProblem>(5000, {"missions[0].to", "far"}));
  EXPECT_LT(many.message.size(), 1000U);
  EXPECT_THAT(many.message, HasSubstr("5000 problems"));
  EXPECT_THAT(many.message, HasSubstr("And 4980 more."));
}

TEST(MissionPlans, AreDrawnFromTheDestinationsInAnyOrder) {
  const wire::ScenarioFile scenario = there_and_back();
  EXPECT_EQ(count_missions(scenario), 4);
  const auto plans = plan_missions(scenario, {"west", "east", "attic"});
  const auto again = plan_missions(scenario, {"attic", "west", "east"});
  ASSERT_EQ(plans.size(), 4U);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    EXPECT_NE(plans[i].from, plans[i].to);
    EXPECT_EQ(plans[i].entry, i == 0 ? 0U : 1U);
    EXPECT_EQ(plans[i].from + plans[i].to, again[i].from + again[i].to);
    EXPECT_EQ(plans[i].seed, again[i].seed);
  }
}

}  // namespace
}  // namespace homeward::scenario::check_scenario_test
