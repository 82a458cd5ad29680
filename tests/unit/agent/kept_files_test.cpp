// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/kept_files.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/sample_cameras.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::agent::kept_files_test {
namespace {

const std::vector<std::uint8_t> kJpeg = {1, 2, 3};

wire::KeptExploration kept_as(const std::string& id, TimeUs begun_us = 5) {
  wire::KeptExploration kept;
  kept.id = ExplorationId(id);
  kept.begun_us = begun_us;
  return kept;
}

wire::KeptView view_at(double x_m) {
  wire::KeptView view;
  view.t_us = 7;
  view.odometry = {x_m, 0.5, -0.25};
  view.sweep.ranges_m = {1.5F, 2.25F};
  view.sweep.angle_step_rad = 0.5;
  view.driven_m = x_m;
  return view;
}

class KeptFilesTest : public ::testing::Test {
 protected:
  KeptFiles made(const std::string& id, TimeUs begun_us = 5) {
    return *KeptFiles::create(root_.path(), kept_as(id, begun_us), homeward::testing::sphere_camera());
  }
  homeward::testing::ScratchFolder root_;
};

TEST_F(KeptFilesTest, WhatWasAddedIsThereAgain) {
  KeptFiles files = made("x1");
  ASSERT_TRUE(files.add(kJpeg, view_at(1.0)));
  ASSERT_TRUE(files.add(kJpeg, view_at(2.0)));
  wire::KeptExploration kept = files.kept();
  kept.fences_m = {{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}};
  ASSERT_TRUE(files.keep(kept));
  const auto again = KeptFiles::open(root_.path() / "x1");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->size(), 2U);
  EXPECT_EQ(again->kept().fences_m, kept.fences_m);
  EXPECT_EQ(again->view(1)->odometry.x_m, 2.0);
  EXPECT_EQ(again->view(1)->sweep.ranges_m, view_at(2.0).sweep.ranges_m);
}

TEST_F(KeptFilesTest, APictureWithoutItsViewDoesNotCountAndIsWrittenOver) {
  KeptFiles files = made("x1");
  ASSERT_TRUE(files.add(kJpeg, view_at(1.0)));
  std::ofstream(files.picture(1)) << "half";  // killed before its view
  KeptFiles again = *KeptFiles::open(root_.path() / "x1");
  EXPECT_EQ(again.size(), 1U);
  ASSERT_TRUE(again.add(kJpeg, view_at(2.0)));
  EXPECT_EQ(KeptFiles::open(root_.path() / "x1")->size(), 2U);
  EXPECT_EQ(std::filesystem::file_size(again.picture(1)), kJpeg.size());
}

TEST_F(KeptFilesTest, PlacesThatWereGivenUpAreThereAgainAndAFileOfBeforeHasNone) {
  KeptFiles files = made("x1");
  wire::KeptExploration kept = files.kept();
  kept.given_up = {{0, {0.5, -0.125}}, {3, {0.0, 0.25}}};
  ASSERT_TRUE(files.keep(kept));
  EXPECT_EQ(KeptFiles::open(root_.path() / "x1")->kept().given_up, kept.given_up);
  std::ofstream(root_.path() / "x1" / "exploration.json")
      << R"({"format": "homeward-kept-exploration", "version": 1, "id": "x1", "begun_us": 5, "fences": [],)"
         R"( "ended": false, "reason": null, "tour": null})";
  const auto before = KeptFiles::open(root_.path() / "x1");
  ASSERT_TRUE(before) << before.error().message;
  EXPECT_TRUE(before->kept().given_up.empty());
}

TEST_F(KeptFilesTest, OneIsNotMadeTwice) {
  made("x1");
  EXPECT_EQ(KeptFiles::create(root_.path(), kept_as("x1"), homeward::testing::sphere_camera()).error().code,
            ErrorCode::kConflict);
}

TEST_F(KeptFilesTest, AnIdMustBeAbleToNameAFolder) {
  for (const char* id : {"", "..", "a/b", "a b", "caf\xC3\xA9", "."}) {
    EXPECT_EQ(KeptFiles::create(root_.path(), kept_as(id), homeward::testing::sphere_camera()).error().code,
              ErrorCode::kInvalidInput)
        << id;
  }
}

TEST_F(KeptFilesTest, ThoseThatAreNotOnTheServerComeOldestFirstAndWhatIsBrokenIsNamed) {
  made("b", 20);
  made("c", 10);
  KeptFiles done = made("a", 5);
  wire::KeptExploration kept = done.kept();
  kept.tour = TourId("t1");
  ASSERT_TRUE(done.keep(kept));
  made("broken");
  std::ofstream(root_.path() / "broken" / "exploration.json") << "{\"format\": 1}";
  std::filesystem::create_directories(root_.path() / "something else");
  std::vector<Error> unread;
  const auto found = KeptFiles::not_uploaded(root_.path(), unread);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].kept().id, ExplorationId("c"));
  EXPECT_EQ(found[1].kept().id, ExplorationId("b"));
  ASSERT_EQ(unread.size(), 1U);
  EXPECT_NE(unread[0].where.find("broken/exploration.json"), std::string::npos) << unread[0].where;
}

TEST_F(KeptFilesTest, ABrokenViewNamesItsFile) {
  KeptFiles files = made("x1");
  ASSERT_TRUE(files.add(kJpeg, view_at(1.0)));
  std::ofstream(root_.path() / "x1" / "views" / "00000.json") << "{";
  const auto view = files.view(0);
  ASSERT_FALSE(view);
  EXPECT_NE(view.error().where.find("00000.json"), std::string::npos) << view.error().where;
}

}  // namespace
}  // namespace homeward::agent::kept_files_test
