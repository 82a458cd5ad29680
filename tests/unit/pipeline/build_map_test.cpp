// SPDX-License-Identifier: Apache-2.0
#include "pipeline/build_map.hpp"

#include <gtest/gtest.h>

#include <set>

#include "features/appearance.hpp"
#include "support/painted_tour.hpp"

namespace homeward::pipeline::build_map_test {
namespace {

using homeward::testing::camera_config;
using homeward::testing::drive;
using homeward::testing::MemoryTour;
using homeward::testing::the_camera;

/// Six pictures forth and six back.
const MemoryTour& sample_tour() {
  static const MemoryTour tour = [] {
    MemoryTour made("forth_and_back");
    drive(made, the_camera(), 6, 0.6);
    drive(made, the_camera(), 6, 0.6, true);
    made.mark("1003.png", "bed");
    return made;
  }();
  return tour;
}

BuildOptions options(int threads) { return {"house", threads, 1}; }

const map::TopologicalMap& sample_map() {
  static const map::TopologicalMap map = build_map({&sample_tour()}, camera_config(), options(2)).value();
  return map;
}

TEST(BuildMap, MakesAMapOfATour) {
  const map::TopologicalMap& map = sample_map();
  EXPECT_EQ(map.name, "house");
  EXPECT_EQ(map.images.size(), 12U);
  EXPECT_EQ(map.feature_config_id, features::feature_config_id(map.feature_config));
  EXPECT_EQ(map.camera.width_px, 512);
  EXPECT_EQ(map.revision, 1);
  EXPECT_GE(map.places.size(), 3U);
  EXPECT_LE(map.places.size(), 12U);
  EXPECT_FALSE(map.edges.empty());
  std::set<ImageId> held;
  for (const map::Place& place : map.places) {
    held.insert(place.members.begin(), place.members.end());
    EXPECT_GT(place.appearances.at(0).size(), 100);
  }
  EXPECT_EQ(held.size(), 12U);
  ASSERT_EQ(map.destinations.size(), 1U);
  EXPECT_EQ(map.destinations[0].label, "bed");
  EXPECT_EQ(map.destinations[0].image.str(), "forth_and_back/1003.png");
}

TEST(BuildMap, EdgesOfAStraightDriveLeadAheadOrBehind) {
  int checked = 0;
  for (const map::Edge& edge : sample_map().edges) {
    if (!edge.bearing_rad || edge.confidence < 0.8) continue;
    ++checked;
    EXPECT_LT(std::min(std::abs(*edge.bearing_rad), kPi - std::abs(*edge.bearing_rad)), 0.3);
  }
  EXPECT_GE(checked, 3);
}

TEST(BuildMap, IsTheSameWithOneThread) {
  const auto one = build_map({&sample_tour()}, camera_config(), options(1));
  ASSERT_TRUE(one);
  const map::TopologicalMap& two = sample_map();
  ASSERT_EQ(one->places.size(), two.places.size());
  for (std::size_t i = 0; i < two.places.size(); ++i) {
    EXPECT_EQ(one->places[i].id, two.places[i].id);
    EXPECT_EQ(one->places[i].members, two.places[i].members);
    EXPECT_EQ(one->places[i].appearances[0].sift.descriptors, two.places[i].appearances[0].sift.descriptors);
  }
  ASSERT_EQ(one->edges.size(), two.edges.size());
  for (std::size_t i = 0; i < two.edges.size(); ++i) {
    EXPECT_EQ(one->edges[i].from, two.edges[i].from);
    EXPECT_EQ(one->edges[i].bearing_rad, two.edges[i].bearing_rad);
    EXPECT_EQ(one->edges[i].length_m, two.edges[i].length_m);
  }
}

TEST(BuildMap, TellsItsProgress) {
  MemoryTour tour("short");
  drive(tour, the_camera(), 4, 0.6);
  double last = 0.0;
  std::set<std::string> stages;
  ASSERT_TRUE(build_map({&tour}, camera_config(), options(1), nullptr, [&](const BuildProgress& progress) {
    EXPECT_GE(progress.share, last);
    last = progress.share;
    stages.insert(progress.stage);
  }));
  EXPECT_DOUBLE_EQ(last, 1.0);
  EXPECT_EQ(stages, (std::set<std::string>{"features", "compare", "cluster", "places"}));
}

TEST(BuildMap, CanBeCancelledBeforeAndAmidst) {
  std::stop_source before;
  before.request_stop();
  const auto none = build_map({&sample_tour()}, camera_config(), options(1), nullptr, {}, before.get_token());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kCancelled);
  std::stop_source amidst;
  double last = 0.0;
  const auto cut = build_map(
      {&sample_tour()}, camera_config(), options(1), nullptr,
      [&](const BuildProgress& progress) {
        last = progress.share;
        if (progress.share > 0.1) amidst.request_stop();
      },
      amidst.get_token());
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::kCancelled);
  EXPECT_LT(last, 0.5);
}

ErrorCode code_of(const std::vector<const TourSource*>& tours, const camera::CameraConfig& camera = camera_config()) {
  const auto map = build_map(tours, camera, options(1));
  EXPECT_FALSE(map);
  return map ? ErrorCode::kInternal : map.error().code;
}

TEST(BuildMap, TooLittleToWorkOnIsSaid) {
  EXPECT_EQ(code_of({}), ErrorCode::kEmptyInput);
  const MemoryTour empty("empty");
  EXPECT_EQ(code_of({&empty}), ErrorCode::kEmptyInput);
  MemoryTour two("two");
  drive(two, the_camera(), 2, 0.5);
  const auto map = build_map({&two}, camera_config(), options(1));
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kTooFewImages);
  EXPECT_NE(map.error().message.find("2 pictures"), std::string::npos) << map.error().message;
}

TEST(BuildMap, BlackPicturesAreNamed) {
  MemoryTour black("black");
  drive(black, the_camera(), 1, 0.5);
  for (int i = 0; i < 4; ++i) black.add(Image(512, 256, 3));
  const auto map = build_map({&black}, camera_config(), options(1));
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kTooFewFeatures);
  EXPECT_EQ(map.error().where, "black/1001.png");
  EXPECT_NE(map.error().message.find("80 %"), std::string::npos) << map.error().message;
}

TEST(BuildMap, PicturesOfAnotherSizeAreNamed) {
  MemoryTour size("size");
  drive(size, the_camera(), 3, 0.5);
  size.add(Image(100, 50, 3));
  const auto wrong = build_map({&size}, camera_config(), options(2));
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::kWrongImageSize);
  EXPECT_EQ(wrong.error().where, "size/1003.png");
  EXPECT_NE(wrong.error().message.find("1 of 4"), std::string::npos) << wrong.error().message;
  size.add(Image(100, 50, 3));
  const auto from_there = build_map({&size}, camera_config(), options(2));
  ASSERT_FALSE(from_there);
  EXPECT_EQ(from_there.error().message.rfind("From this picture on", 0), 0U) << from_there.error().message;
  EXPECT_EQ(from_there.error().where, "size/1003.png");
}

TEST(BuildMap, WhatCannotBeReadIsLeftOutAndNoted) {
  MemoryTour tour("broken");
  MemoryTour good("broken");
  drive(good, the_camera(), 6, 0.6);
  for (std::size_t i = 0; i < 6; ++i) {
    tour.add_broken(i % 2 == 0 ? ErrorCode::kTruncatedImage : ErrorCode::kIo);
    tour.add(*good.read(i));
  }
  tour.mark("1002.png", "bath");  // cannot be read
  tour.mark("1003.png", "bed");
  const auto built = build_noted_map({&tour}, camera_config(), options(2));
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_EQ(built->map.images.size(), 6U);
  EXPECT_EQ(built->map.images[1].id.str(), "broken/1003.png");
  ASSERT_EQ(built->map.destinations.size(), 1U);
  EXPECT_EQ(built->map.destinations[0].image.str(), "broken/1003.png");
  ASSERT_EQ(built->notes.skipped.size(), 6U);
  EXPECT_EQ(built->notes.skipped[1].where, "broken/1002.png");
  EXPECT_EQ(built->notes.skipped[1].code, ErrorCode::kIo);
  EXPECT_NE(built->notes.skipped[1].message.find("bath"), std::string::npos) << built->notes.skipped[1].message;
  EXPECT_TRUE(built->notes.warnings.empty());
  // The map is that of the pictures that are left.
  MemoryTour left("broken");
  for (std::size_t i = 0; i < 6; ++i) left.add(*good.read(i));
  left.mark("1001.png", "bed");
  const auto alone = build_map({&left}, camera_config(), options(1));
  ASSERT_TRUE(alone);
  ASSERT_EQ(alone->places.size(), built->map.places.size());
  for (std::size_t i = 0; i < alone->places.size(); ++i) {
    EXPECT_EQ(alone->places[i].members.size(), built->map.places[i].members.size());
  }
  ASSERT_EQ(alone->edges.size(), built->map.edges.size());
  for (std::size_t i = 0; i < alone->edges.size(); ++i) {
    EXPECT_EQ(alone->edges[i].bearing_rad, built->map.edges[i].bearing_rad);
  }
}

TEST(BuildMap, TooFewThatCanBeReadAreNoTour) {
  MemoryTour tour("broken");
  drive(tour, the_camera(), 2, 0.5);
  tour.add_broken(ErrorCode::kTruncatedImage);
  tour.add_broken(ErrorCode::kIo);
  const auto two = build_map({&tour}, camera_config(), options(2));
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().code, ErrorCode::kTooFewImages);
  EXPECT_EQ(two.error().where, "broken/1002.png");
  MemoryTour none("none");
  for (int i = 0; i < 4; ++i) none.add_broken(i == 0 ? ErrorCode::kUnsupportedImage : ErrorCode::kIo);
  const auto nothing = build_map({&none}, camera_config(), options(2));
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::kUnsupportedImage);
  EXPECT_EQ(nothing.error().where, "none/1000.png");
  EXPECT_NE(nothing.error().message.find("None of the 4"), std::string::npos) << nothing.error().message;
}

TEST(BuildMap, ACameraThatStandsStillMakesNoMap) {
  MemoryTour still("still");
  const Image picture = homeward::testing::painted_picture(homeward::testing::painted_corridor(), {}, the_camera());
  for (int i = 0; i < 5; ++i) {
    Image noisy = picture;
    for (std::size_t k = static_cast<std::size_t>(i); k < noisy.data.size(); k += 7) noisy.data[k] ^= 3;
    still.add(std::move(noisy));
  }
  const auto map = build_map({&still}, camera_config(), options(1));
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kTooFewImages);
  EXPECT_NE(map.error().message.find("stood still"), std::string::npos) << map.error().message;
  // Standing for a while is no harm.
  drive(still, the_camera(), 4, 0.6);
  EXPECT_TRUE(build_map({&still}, camera_config(), options(1)));
}

TEST(BuildMap, WrongMarksDoubleImagesAndBadCamerasAreRefused) {
  MemoryTour tour("tour");
  for (int i = 0; i < 3; ++i) tour.add(Image(512, 256, 3));
  EXPECT_EQ(code_of({&tour, &tour}), ErrorCode::kInvalidInput);
  camera::CameraConfig bad = camera_config();
  bad.robot_from_camera_rotation.coeffs() *= 2.0;
  EXPECT_EQ(code_of({&tour}, bad), ErrorCode::kInvalidInput);
  tour.mark("7777.png", "bed");
  const auto marked = build_map({&tour}, camera_config(), options(1));
  ASSERT_FALSE(marked);
  EXPECT_EQ(marked.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(marked.error().where, "7777.png");
}

}  // namespace
}  // namespace homeward::pipeline::build_map_test
