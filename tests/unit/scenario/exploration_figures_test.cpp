// SPDX-License-Identifier: Apache-2.0
#include "scenario/exploration_figures.hpp"

#include <gtest/gtest.h>

#include "scenario/exploration_run.hpp"
#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/tour_path.hpp"

namespace homeward::scenario::exploration_figures_test {
namespace {

const sim::World& offices() {
  static const sim::World world = sim::generate_offices(1);
  return world;
}

/// A map whose places are single pictures, taken where the test says.
class TrueMap {
 public:
  void add_place(const std::string& id, const std::vector<Eigen::Vector2d>& pictures_m) {
    map::Place place;
    place.id = PlaceId(id);
    for (std::size_t i = 0; i < pictures_m.size(); ++i) {
      place.members.emplace_back("tour/" + id + "_" + std::to_string(i) + ".jpg");
      taken.emplace(place.members.back(), Pose2{pictures_m[i].x(), pictures_m[i].y(), 0.0});
    }
    place.prototype = place.members.front();
    map.places.push_back(std::move(place));
  }
  void join(const std::string& from, const std::string& to) {
    map::Edge edge;
    edge.from = PlaceId(from);
    edge.to = PlaceId(to);
    map.edges.push_back(edge);
  }
  [[nodiscard]] ExplorationFigures figures() const { return exploration_figures(offices(), map, taken); }

  map::TopologicalMap map;
  std::unordered_map<ImageId, Pose2> taken;
};

Eigen::Vector2d room_m(const std::string& room) { return *sim::room_point(offices(), room); }

TEST(ExplorationFiguresTest, APlaceCoversWhatIsNearAndInSight) {
  const Eigen::Vector2d at_m = room_m("office_1");
  EXPECT_TRUE(is_covered(offices(), {at_m}, at_m));
  EXPECT_FALSE(is_covered(offices(), {}, at_m));
  EXPECT_FALSE(is_covered(offices(), {room_m("office_2")}, at_m)) << "behind a wall";
}

TEST(ExplorationFiguresTest, MorePlacesCoverMore) {
  TrueMap little;
  EXPECT_EQ(little.figures().covered, 0.0);
  little.add_place("p1", {room_m("office_1")});
  const ExplorationFigures one = little.figures();
  EXPECT_GT(one.covered, 0.0);
  EXPECT_LT(one.covered, 0.5);
  EXPECT_GT(one.reachable_m2, 40.0);
  little.add_place("p2", {room_m("office_2")});
  EXPECT_GT(little.figures().covered, one.covered);
}

TEST(ExplorationFiguresTest, WaysBetweenPlacesFarApartAreWrong) {
  TrueMap far;
  far.add_place("p1", {room_m("office_1")});
  far.add_place("p2", {room_m("office_1") + Eigen::Vector2d(0.3, 0.0)});
  far.add_place("p3", {room_m("office_7")});
  far.join("p1", "p2");
  EXPECT_EQ(far.figures().wrong_edges, 0);
  ASSERT_GT((room_m("office_1") - room_m("office_7")).norm(), 6.0);
  far.join("p1", "p3");
  EXPECT_EQ(far.figures().wrong_edges, 1);
}

TEST(ExplorationFiguresTest, APlaceOfTwoRoomsIsMixed) {
  TrueMap mixed;
  mixed.add_place("p1", {room_m("office_1"), room_m("office_1") + Eigen::Vector2d(0.2, 0.0)});
  EXPECT_EQ(mixed.figures().mixed_places, 0);
  mixed.add_place("p2", {room_m("office_1"), room_m("office_2")});
  EXPECT_EQ(mixed.figures().mixed_places, 1);
}

TEST(ExplorationRunTest, ARoomsPictureIsTheNearestOneInIt) {
  ExplorationResult explored;
  EXPECT_FALSE(picture_of_room(offices(), "office_1", explored));
  const Eigen::Vector2d at_m = room_m("office_1");
  for (const double off_m : {3.0, 0.4, 0.1}) {
    ExploredPicture picture;
    picture.truth = {at_m.x() + off_m, at_m.y(), 0.0};
    explored.pictures.push_back(picture);
  }
  EXPECT_EQ(picture_of_room(offices(), "office_1", explored), std::optional<std::size_t>(2));
  EXPECT_FALSE(picture_of_room(offices(), "office_7", explored)) << "no picture near";
  EXPECT_FALSE(picture_of_room(offices(), "cellar", explored));
}

TEST(ExplorationRunTest, ABodyWantsItsHalfWidthToEachSide) {
  EXPECT_DOUBLE_EQ(exploration_plan_for(sim::disc_profile()).explorer.reach.radius_m, 0.35);
  EXPECT_NEAR(exploration_plan_for(sim::chair_profile()).explorer.reach.radius_m, 0.325, 1e-9);
}

}  // namespace
}  // namespace homeward::scenario::exploration_figures_test
