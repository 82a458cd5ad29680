// SPDX-License-Identifier: Apache-2.0
#include "pipeline/replay_check.hpp"

#include <gtest/gtest.h>

#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "pipeline/eye.hpp"
#include "support/painted_tour.hpp"
#include "support/walled_floor.hpp"

namespace homeward::pipeline::replay_check_test {
namespace {

using homeward::testing::camera_config;
using homeward::testing::MemoryTour;
using homeward::testing::painted_corridor;
using homeward::testing::painted_picture;
using homeward::testing::the_camera;
using map::EditKind;

const MemoryTour& the_tour() {
  static const MemoryTour tour = [] {
    MemoryTour made("tour");
    for (int i = 0; i < 14; ++i) {
      made.add(painted_picture(painted_corridor(), {-3.0 + 0.5 * i, 0.05, 0.0}, the_camera()));
    }
    return made;
  }();
  return tour;
}

/// The corridor with a destination at either end.
const map::TopologicalMap& taught() {
  static const map::TopologicalMap map = [] {
    map::TopologicalMap made = build_map({&the_tour()}, camera_config(), {"house", 2, 1}).value();
    for (const auto& [image, label] : {std::pair(0U, "door"), std::pair(13U, "window")}) {
      map::Destination destination;
      destination.id = DestinationId("d" + std::to_string(made.next_destination_number++));
      destination.image = made.images.at(image).id;
      destination.place = map::find_place_of(made, destination.image)->id;
      destination.label = label;
      made.destinations.push_back(destination);
    }
    return made;
  }();
  return map;
}

map::TopologicalMap edited(EditKind kind, const ImageId& a, const ImageId& b = {}, const std::string& text = {}) {
  map::TopologicalMap map = taught();
  map::Edit edit;
  edit.kind = kind;
  edit.image_a = a;
  edit.image_b = b;
  edit.text = text;
  const Status applied = mapping::apply_edit(map, edit);
  EXPECT_TRUE(applied) << applied.error().message;
  return map;
}

/// The pictures of the tour, looked at once.
const std::vector<KeptPicture>& pictures() {
  static const std::vector<KeptPicture> kept = [] {
    const Eye eye = Eye::create(taught().camera, taught().feature_config).value();
    std::vector<KeptPicture> made;
    for (std::size_t i = 0; i < the_tour().images().size(); ++i) {
      made.push_back({the_tour().images()[i].id, 0, eye.look(the_tour().read(i).value()).value()});
    }
    return made;
  }();
  return kept;
}

ReplayCheck checked(const map::TopologicalMap& after, int threads = 2) {
  return check_by_replay(taught(), after, pictures(), threads).value();
}

const ImageId& image(std::size_t index) { return taught().images.at(index).id; }

TEST(ReplayCheck, FindsNothingAgainstTheMapItselfAndNames) {
  const ReplayCheck same = check_by_replay(taught(), taught(), {&the_tour()}, {}, 2).value();
  EXPECT_TRUE(same.harmless());
  EXPECT_EQ(same.pictures, 14);
  EXPECT_GE(same.right_before, 12);
  EXPECT_EQ(same.right_after, same.right_before);
  EXPECT_EQ(same.routes_before, 2);
  EXPECT_EQ(same.routes_after, 2);
  EXPECT_TRUE(checked(edited(EditKind::kRename, image(3), {}, "hall")).harmless());
}

TEST(ReplayCheck, TellsAMergeOfPlacesThatDoNotLookAlikeWithItsPictures) {
  const ReplayCheck check = checked(edited(EditKind::kMerge, image(0), image(13)));
  const auto unlike = std::ranges::find(check.worse, Worsening::kPictures, &WorseSpot::kind);
  ASSERT_NE(unlike, check.worse.end());
  EXPECT_EQ(unlike->place, map::find_place_of(taught(), image(0))->id);
  EXPECT_NE(std::ranges::find(unlike->images, image(13)), unlike->images.end());
}

TEST(ReplayCheck, TellsDestinationsThatABridgeJoinedAndThePicturesThatNothingShowsAnyMore) {
  const map::Place& middle = *map::find_place_of(taught(), image(7));
  ASSERT_NE(middle.id, map::find_place_of(taught(), image(0))->id);
  ASSERT_NE(middle.id, map::find_place_of(taught(), image(13))->id);
  const ReplayCheck check = checked(edited(EditKind::kDelete, image(7)));
  EXPECT_EQ(check.routes_after, 0);
  const auto route = std::ranges::find(check.worse, Worsening::kRoute, &WorseSpot::kind);
  ASSERT_NE(route, check.worse.end());
  EXPECT_EQ(std::ranges::count(check.worse, Worsening::kRoute, &WorseSpot::kind), 1) << "each pair once";
}

TEST(ReplayCheck, TellsADestinationThatGoesWithItsPlace) {
  const ReplayCheck gone = checked(edited(EditKind::kDelete, image(13)));
  const auto lost = std::ranges::find(gone.worse, Worsening::kDestination, &WorseSpot::kind);
  ASSERT_NE(lost, gone.worse.end());
  EXPECT_EQ(lost->images, std::vector<ImageId>{image(13)});
  EXPECT_EQ(lost->place, map::find_place_of(taught(), image(13))->id);
  EXPECT_TRUE(checked(edited(EditKind::kRemoveDestination, image(13))).harmless()) << "as a person wants it";
}

TEST(ReplayCheck, TellsWhatDrivesSawAndWouldNotBeKnownAnyMore) {
  std::vector<DriveSight> drive;
  for (const KeptPicture& picture : pictures()) {
    drive.push_back({picture.seen, map::find_place_of(taught(), picture.image)->id});
  }
  drive.emplace_back();                            // the belief was not sure
  drive.push_back({drive[0].seen, PlaceId("x")});  // nor is this place there any more
  const ReplayCheck same = check_by_replay(taught(), taught(), {&the_tour()}, {drive, drive}, 2).value();
  EXPECT_EQ(same.pictures, 14);
  EXPECT_EQ(same.sights, 28);
  EXPECT_TRUE(same.harmless());

  map::TopologicalMap muddled = taught();
  std::swap(muddled.places.front().appearances, muddled.places.back().appearances);
  const ReplayCheck check = check_by_replay(taught(), muddled, {&the_tour()}, {drive}, 2).value();
  const auto worse = std::ranges::find(check.worse, Worsening::kDrives, &WorseSpot::kind);
  ASSERT_NE(worse, check.worse.end());
  EXPECT_EQ(worse->images, std::vector<ImageId>{map::find_place(taught(), worse->place)->prototype});
  EXPECT_GE(worse->times, 2);
  EXPECT_LE(worse->times, worse->of);
}

TEST(ReplayCheck, TellsAWayByAPersonThatNoPictureSees) {
  map::TopologicalMap after = taught();
  map::Edge way;
  way.from = map::find_place_of(after, image(0))->id;
  way.to = map::find_place_of(after, image(13))->id;
  way.by = map::Decider::kPerson;
  way.weak = true;
  after.edges.push_back(way);
  std::swap(way.from, way.to);
  after.edges.push_back(way);
  const ReplayCheck check = checked(after);
  ASSERT_EQ(check.worse.size(), 1U);
  EXPECT_EQ(check.worse[0].kind, Worsening::kWay);
  EXPECT_EQ(check.worse[0].images.size(), 2U);
}

constexpr double kFirst_m = -3.0;
constexpr double kStep_m = 0.5;

/// The corridor with the odometry of its tour.
map::TopologicalMap measured() {
  map::TopologicalMap map = taught();
  for (std::size_t i = 0; i < map.images.size(); ++i) {
    map.images[i].odometry = Pose2{kFirst_m + kStep_m * static_cast<double>(i), 0.05, 0.0};
  }
  return map;
}

/// Its pictures, with sweeps that saw these walls and those of the corridor.
std::vector<KeptPicture> swept(std::vector<testing::Wall> walls) {
  for (const testing::Wall& wall : testing::walls_around({-4.0, -0.8}, {4.0, 0.8})) walls.push_back(wall);
  std::vector<KeptPicture> made = pictures();
  for (std::size_t i = 0; i < made.size(); ++i) {
    made[i].sweep = testing::sweep_at({kFirst_m + kStep_m * static_cast<double>(i), 0.05, 0.0}, walls);
  }
  return made;
}

/// Across the corridor between pictures 5 and 6.
const std::vector<testing::Wall> kWall = {{{-0.25, -0.8}, {-0.25, 0.8}}};

bool tells(const ReplayCheck& check, Worsening kind) {
  return std::ranges::find(check.worse, kind, &WorseSpot::kind) != check.worse.end();
}

TEST(ReplayCheck, TellsAWayThroughAWallThatSweepsSawAndNoneThatTheySawFree) {
  const map::TopologicalMap before = measured();
  map::TopologicalMap after = before;
  map::Edge way;
  way.from = map::find_place_of(after, image(1))->id;
  way.to = map::find_place_of(after, image(12))->id;
  way.by = map::Decider::kPerson;
  way.weak = true;
  ASSERT_EQ(map::find_edge(after, way.from, way.to), nullptr);
  after.edges.push_back(way);
  EXPECT_TRUE(tells(check_by_replay(before, after, pictures(), 2).value(), Worsening::kWay)) << "not seen";
  EXPECT_TRUE(check_by_replay(before, after, swept({}), 2).value().harmless());
  EXPECT_TRUE(tells(check_by_replay(before, after, swept(kWall), 2).value(), Worsening::kWay));
}

TEST(ReplayCheck, TellsPlacesAsOneThatAWallParts) {
  const map::TopologicalMap before = measured();
  map::TopologicalMap after = before;
  map::Edit merge;
  merge.kind = EditKind::kMerge;
  merge.image_a = image(3);
  merge.image_b = image(8);
  ASSERT_TRUE(mapping::apply_edit(after, merge));
  EXPECT_FALSE(tells(check_by_replay(before, after, swept({}), 2).value(), Worsening::kPlaces));
  EXPECT_TRUE(tells(check_by_replay(before, after, swept(kWall), 2).value(), Worsening::kPlaces));
}

TEST(ReplayCheck, TellsPicturesThatLookAlikeAndTellAnotherMotionThanTheTour) {
  const map::TopologicalMap before = measured();
  map::TopologicalMap after = before;
  map::Edit merge;
  merge.kind = EditKind::kMerge;
  merge.image_a = image(3);
  merge.image_b = image(7);
  ASSERT_TRUE(mapping::apply_edit(after, merge));
  EXPECT_FALSE(tells(check_by_replay(before, after, pictures(), 2).value(), Worsening::kPictures));
  map::TopologicalMap aside = before;  // the tour turned a corner between them
  for (std::size_t i = 0; i < aside.images.size(); ++i) {
    if (i > 5) aside.images[i].odometry = Pose2{-0.5, kStep_m * static_cast<double>(i - 5), kPi / 2.0};
  }
  map::TopologicalMap merged = aside;
  ASSERT_TRUE(mapping::apply_edit(merged, merge));
  EXPECT_TRUE(tells(check_by_replay(aside, merged, pictures(), 2).value(), Worsening::kPictures));
}

TEST(ReplayCheck, GivesTheSameWithAnyNumberOfThreadsAndCanBeCancelled) {
  const map::TopologicalMap after = edited(EditKind::kDelete, image(7));
  const ReplayCheck one = checked(after, 1);
  const ReplayCheck three = checked(after, 3);
  EXPECT_EQ(one.right_after, three.right_after);
  ASSERT_EQ(one.worse.size(), three.worse.size());
  for (std::size_t i = 0; i < one.worse.size(); ++i) EXPECT_EQ(one.worse[i].images, three.worse[i].images);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(check_by_replay(taught(), after, {&the_tour()}, {}, 1, {}, stop.get_token()).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace homeward::pipeline::replay_check_test
