// SPDX-License-Identifier: Apache-2.0
#include "pipeline/grow_map.hpp"

#include <gtest/gtest.h>

#include "map/parts.hpp"
#include "pipeline/refine_map.hpp"
#include "support/painted_tour.hpp"

namespace homeward::pipeline::grow_map_test {
namespace {

using homeward::testing::camera_config;
using homeward::testing::drive;
using homeward::testing::MemoryTour;
using homeward::testing::painted_corridor;
using homeward::testing::painted_picture;
using homeward::testing::the_camera;

/// Pictures from `from_m` on along the painted corridor.
MemoryTour tour_from(const std::string& name, double from_m, int count) {
  MemoryTour tour(name);
  for (int i = 0; i < count; ++i) {
    tour.add(painted_picture(painted_corridor(), {from_m + 0.5 * i, 0.05, 0.0}, the_camera()));
  }
  return tour;
}

const map::TopologicalMap& old_map() {
  static const map::TopologicalMap map = [] {
    const MemoryTour tour = tour_from("old", -3.0, 8);
    return build_map({&tour}, camera_config(), {"house", 2, 1}).value();
  }();
  return map;
}

TEST(AddTours, JoinWhatTheyPassAndGoOn) {
  const MemoryTour tour = tour_from("new", -2.9, 12);
  const auto added = add_tours(old_map(), {&tour}, {}, {"", 2, 1});
  ASSERT_TRUE(added) << added.error().message;
  const map::TopologicalMap& map = added->grown.map;
  EXPECT_EQ(map.images.size(), 20U);
  EXPECT_GE(added->grown.added.joined_images, 4);
  EXPECT_GE(added->grown.added.places, 1);
  EXPECT_EQ(map::parts(map).size(), 1U);
  EXPECT_EQ(map.name, "house");
  EXPECT_NE(map.calibration.slope, old_map().calibration.slope);  // the new pictures have been asked
  EXPECT_GT(map.calibration.slope, 0.5);
  EXPECT_TRUE(added->skipped.empty());
}

TEST(AddTours, GiveTheSameMapWithAnyNumberOfThreads) {
  const MemoryTour tour = tour_from("new", -2.9, 12);
  const auto one = add_tours(old_map(), {&tour}, {}, {"", 1, 1});
  const auto three = add_tours(old_map(), {&tour}, {}, {"", 3, 1});
  ASSERT_TRUE(one);
  ASSERT_TRUE(three);
  const map::TopologicalMap& a = one->grown.map;
  const map::TopologicalMap& b = three->grown.map;
  ASSERT_EQ(a.places.size(), b.places.size());
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    EXPECT_EQ(a.places[i].id, b.places[i].id);
    EXPECT_EQ(a.places[i].members, b.places[i].members);
    EXPECT_EQ(a.places[i].appearances[0].sift.descriptors, b.places[i].appearances[0].sift.descriptors);
  }
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    EXPECT_EQ(a.edges[i].bearing_rad, b.edges[i].bearing_rad);
    EXPECT_EQ(a.edges[i].length_m, b.edges[i].length_m);
  }
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  for (std::size_t i = 0; i < a.hypotheses.size(); ++i) EXPECT_EQ(a.hypotheses[i].support, b.hypotheses[i].support);
  EXPECT_EQ(a.motion.distance_scale, b.motion.distance_scale);
  EXPECT_EQ(a.calibration.offset, b.calibration.offset);
  EXPECT_EQ(a.calibration.slope, b.calibration.slope);
}

TEST(AddTours, AnotherKindOfCameraOrAnotherProgramsMapIsRefused) {
  const MemoryTour tour = tour_from("new", -2.9, 3);
  const auto camera = add_tours(old_map(), {&tour}, homeward::testing::mirror_camera(), {"", 1, 1});
  ASSERT_FALSE(camera);
  EXPECT_EQ(camera.error().code, ErrorCode::kFeatureConfigMismatch);
  EXPECT_NE(camera.error().message.find("another kind of camera"), std::string::npos) << camera.error().message;
  map::TopologicalMap older = old_map();
  older.feature_config_id = "hw1-w1024";
  const auto map = add_tours(older, {&tour}, {}, {"", 1, 1});
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kFeatureConfigMismatch);
  EXPECT_NE(map.error().message.find("hw1-w1024"), std::string::npos) << map.error().message;
}

TEST(AddTours, UnreadablePicturesAreLeftOutAndTold) {
  MemoryTour tour = tour_from("new", -2.9, 4);
  tour.add_broken(ErrorCode::kTruncatedImage);
  const auto added = add_tours(old_map(), {&tour}, {}, {"", 2, 1});
  ASSERT_TRUE(added) << added.error().message;
  EXPECT_EQ(added->grown.added.images, 4);
  ASSERT_EQ(added->skipped.size(), 1U);
  EXPECT_EQ(added->skipped[0].where, "new/1004.png");
  tour.mark("1004.png", "bed");
  const auto marked = add_tours(old_map(), {&tour}, {}, {"", 2, 1});
  ASSERT_FALSE(marked);
  EXPECT_NE(marked.error().message.find("cannot be read"), std::string::npos) << marked.error().message;
}

TEST(AddTours, TooLittleToWorkOnIsSaid) {
  const auto code_of = [](const std::vector<const TourSource*>& tours) {
    const auto added = add_tours(old_map(), tours, {}, {"", 1, 1});
    return added ? ErrorCode::kInternal : added.error().code;
  };
  EXPECT_EQ(code_of({}), ErrorCode::kEmptyInput);
  const MemoryTour two = tour_from("two", 0.0, 2);
  EXPECT_EQ(code_of({&two}), ErrorCode::kTooFewImages);
  MemoryTour black("black");
  for (int i = 0; i < 3; ++i) black.add(Image(512, 256, 3));
  EXPECT_EQ(code_of({&black}), ErrorCode::kTooFewFeatures);
  const MemoryTour again = tour_from("old", -3.0, 3);
  EXPECT_EQ(code_of({&again}), ErrorCode::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  const MemoryTour tour = tour_from("new", 0.0, 3);
  const auto cut = add_tours(old_map(), {&tour}, {}, {"", 1, 1}, {}, stop.get_token());
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::kCancelled);
}

TEST(RefineMap, ADriveInTheSameLightTeachesNothing) {
  const MemoryTour tour = tour_from("old", -3.0, 8);
  RefineOptions options;
  options.least_updates = 1;
  options.least_probability = 0.5;
  options.spare_bytes = 1'000'000;
  const auto refined = refine_map(old_map(), tour, {}, options);
  ASSERT_TRUE(refined) << refined.error().message;
  EXPECT_EQ(refined->images.size(), 8U);
  ASSERT_EQ(refined->sure.size(), 8U);
  EXPECT_GE(std::ranges::count_if(refined->sure, [](const PlaceId& place) { return !place.empty(); }), 2);
  EXPECT_TRUE(refined->sure.back().empty());  // nothing comes after it that would bear it out
  EXPECT_TRUE(refined->refinement.gained.empty());
  EXPECT_EQ(refined->map.revision, old_map().revision);
}

TEST(RefineMap, SightsOfADriveSpeakOnlyWhereTheNextOneAgreesAndThePlaceIsKnown) {
  const map::Place& place = old_map().places[2];
  const DriveSight here{place.appearances.front(), place.id};
  const DriveSight gone{place.appearances.front(), PlaceId("p999")};
  const std::vector<DriveSight> sights = {here, here, DriveSight{}, here, gone, gone, here, here};
  RefineOptions options;
  options.spare_bytes = 1'000'000;
  const auto refined = refine_by_sights(old_map(), sights, options);
  ASSERT_TRUE(refined) << refined.error().message;
  const std::vector<PlaceId> expected = {place.id, {}, {}, {}, {}, {}, place.id, {}};
  EXPECT_EQ(refined->sure, expected);
  EXPECT_TRUE(refined->refinement.gained.empty()) << "the prototype itself says nothing new";
  EXPECT_EQ(refined->map.revision, old_map().revision);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(refine_by_sights(old_map(), sights, options, stop.get_token()).error().code, ErrorCode::kCancelled);
  localisation::Belief belief{3, {{place.id, 0.9}}, 0.99, 0.96, false};
  EXPECT_EQ(sure_place(belief, options), place.id);
  belief.updates = 2;
  EXPECT_TRUE(sure_place(belief, options).empty());
  belief.updates = 3;
  belief.near_probability = 0.94;
  EXPECT_TRUE(sure_place(belief, options).empty());
  belief.near_probability = 0.96;
  belief.lost = true;
  EXPECT_TRUE(sure_place(belief, options).empty());
}

TEST(RefineMap, NothingIsLearntFromElsewhere) {
  MemoryTour tour("elsewhere");
  homeward::testing::PaintedRoom other = painted_corridor();
  other.seed += 77;
  for (int i = 0; i < 6; ++i) tour.add(painted_picture(other, {-1.0 + 0.4 * i, 0.0, 0.0}, the_camera()));
  RefineOptions options;
  options.spare_bytes = 1'000'000;
  const auto refined = refine_map(old_map(), tour, {}, options);
  ASSERT_TRUE(refined) << refined.error().message;
  EXPECT_EQ(std::ranges::count_if(refined->sure, [](const PlaceId& place) { return !place.empty(); }), 0);
  EXPECT_TRUE(refined->refinement.gained.empty());
}

}  // namespace
}  // namespace homeward::pipeline::grow_map_test
