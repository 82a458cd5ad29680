// SPDX-License-Identifier: Apache-2.0
#include "db/map_file.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "support/sample_map.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::db {
namespace {

using homeward::testing::sample_map;

class MapFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("homeward-map-file-" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "house.hwmap"; }

 private:
  std::filesystem::path folder_;
};

TEST_F(MapFile, GivesBackWhatWasSaved) {
  map::TopologicalMap before = sample_map();
  before.feature_config.sift_windows = 2;
  before.calibration = {0.25, 0.75};
  const Thumbnails thumbnails = {{before.images[0].id, {1, 2, 3}}};
  ASSERT_TRUE(save_map(file(), before, thumbnails));
  const auto stored = load_map(file());
  ASSERT_TRUE(stored) << stored.error().message << stored.error().where;
  const map::TopologicalMap& after = stored->map;
  EXPECT_EQ(after.name, before.name);
  EXPECT_EQ(after.revision, before.revision);
  EXPECT_EQ(after.feature_config_id, before.feature_config_id);
  EXPECT_EQ(after.feature_config.sift_windows, 2);
  EXPECT_EQ(after.calibration.offset, 0.25);
  EXPECT_EQ(after.calibration.slope, 0.75);
  EXPECT_EQ(after.camera.width_px, before.camera.width_px);
  EXPECT_TRUE(after.camera.robot_from_camera_rotation.isApprox(before.camera.robot_from_camera_rotation));
  ASSERT_EQ(after.images.size(), 3U);
  EXPECT_EQ(after.images[2].t_us, before.images[2].t_us);
  EXPECT_DOUBLE_EQ(after.images[1].odometry->theta_rad, before.images[1].odometry->theta_rad);
  EXPECT_FALSE(after.images[2].odometry);
  ASSERT_EQ(after.places.size(), 2U);
  EXPECT_EQ(after.places[0].members, before.places[0].members);
  EXPECT_EQ(after.places[1].label, "kitchen");
  EXPECT_EQ(wire::encode_appearance(after.places[0].appearances.at(0)),
            wire::encode_appearance(before.places[0].appearances.at(0)));
  ASSERT_EQ(after.edges.size(), 2U);
  EXPECT_DOUBLE_EQ(*after.edges[0].bearing_rad, 0.5);
  EXPECT_FALSE(after.edges[1].bearing_rad);
  EXPECT_TRUE(after.edges[1].weak && after.edges[1].blocked);
  EXPECT_EQ(after.edges[0].length_from, map::LengthSource::kOdometry);
  EXPECT_EQ(after.edges[1].length_from, map::LengthSource::kUnknown);
  EXPECT_EQ(after.edges[0].inliers, 64);
  ASSERT_EQ(after.hypotheses.size(), 1U);
  EXPECT_EQ(after.hypotheses[0].decision, map::Decision::kRejected);
  EXPECT_DOUBLE_EQ(after.hypotheses[0].masses_after.is_false, 0.8);
  ASSERT_EQ(after.destinations.size(), 1U);
  EXPECT_EQ(after.destinations[0].appearance.size(), 15);
  ASSERT_EQ(after.edits.size(), 1U);
  EXPECT_EQ(after.edits[0].images, before.edits[0].images);
  EXPECT_EQ(after.next_place_number, 3);
  EXPECT_EQ(stored->thumbnails, thumbnails);
  EXPECT_GT(stored->bytes, 0);
}

TEST_F(MapFile, ReplacesAnOlderFileAndLeavesNoPartsBehind) {
  map::TopologicalMap map = sample_map();
  ASSERT_TRUE(save_map(file(), map, {}));
  map.revision = 5;
  ASSERT_TRUE(save_map(file(), map, {}));
  EXPECT_EQ(load_map(file())->map.revision, 5);
  const auto entries = std::filesystem::directory_iterator(file().parent_path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST_F(MapFile, AFailedSaveKeepsTheOldFile) {
  map::TopologicalMap map = sample_map();
  ASSERT_TRUE(save_map(file(), map, {}));
  map.revision = 6;
  map.places[0].members.emplace_back("tour/absent.jpg");  // breaks a foreign key
  const Status status = save_map(file(), map, {});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
  EXPECT_EQ(load_map(file())->map.revision, 4);
}

TEST_F(MapFile, NamesWhatIsWrongWithAFile) {
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kNotFound);
  std::ofstream(file()) << "a text, long enough to be taken for a header of something, but no map at all";
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kCorruptFile);
}

TEST_F(MapFile, OpensFilesOfVersionTwo) {
  map::TopologicalMap map = sample_map();
  ASSERT_TRUE(save_map(file(), map, {}));
  const auto change = [&](const char* sql) { SQLite::Database(file().string(), SQLite::OPEN_READWRITE).exec(sql); };
  change("ALTER TABLE edges DROP COLUMN inliers; ALTER TABLE edges DROP COLUMN length_from; PRAGMA user_version = 2");
  const auto old = load_map(file());
  ASSERT_TRUE(old) << old.error().message;
  ASSERT_EQ(old->map.edges.size(), 2U);
  EXPECT_DOUBLE_EQ(old->map.edges[0].length_m, 1.5);
  // One of its pictures has no odometry: its lengths counted pictures.
  EXPECT_EQ(old->map.edges[0].length_from, map::LengthSource::kTourImages);
  EXPECT_EQ(old->map.edges[1].length_from, map::LengthSource::kUnknown);  // drawn by a person
  EXPECT_EQ(old->map.edges[0].inliers, 0);
  for (map::MapImage& image : map.images) image.odometry = Pose2{};
  ASSERT_TRUE(save_map(file(), map, {}));
  change("ALTER TABLE edges DROP COLUMN inliers; ALTER TABLE edges DROP COLUMN length_from; PRAGMA user_version = 2");
  EXPECT_EQ(load_map(file())->map.edges[0].length_from, map::LengthSource::kOdometry);
  ASSERT_TRUE(save_map(file(), old->map, {}));
  EXPECT_EQ(load_map(file())->map.edges[0].length_from, map::LengthSource::kTourImages);
}

TEST_F(MapFile, RefusesOtherDatabasesNewerVersionsAndDanglingReferences) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  const auto change = [&](const char* sql) { SQLite::Database(file().string(), SQLite::OPEN_READWRITE).exec(sql); };
  change("PRAGMA user_version = 1");
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kUnsupportedFormat);
  change("PRAGMA user_version = 4");
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("version 4"));
  change("PRAGMA user_version = 3; UPDATE edges SET length_from = 9");
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kCorruptFile);
  change("UPDATE edges SET length_from = 1; PRAGMA application_id = 1");
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kCorruptFile);
  change("PRAGMA application_id = 1213680976; DELETE FROM place_members WHERE place = 'p1'");
  EXPECT_THAT(load_map(file()).error().where, ::testing::HasSubstr("places/p1"));
}

TEST_F(MapFile, ReadsFilesFromBeforeBeliefsWereCalibrated) {
  map::TopologicalMap map = sample_map();
  map.calibration = {0.25, 0.75};
  ASSERT_TRUE(save_map(file(), map, {}));
  const auto change = [&](const char* sql) { SQLite::Database(file().string(), SQLite::OPEN_READWRITE).exec(sql); };
  change("UPDATE meta SET value = '{\"offset\": 0, \"slope\": -1}' WHERE key = 'calibration'");
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kCorruptFile);
  change("DELETE FROM meta WHERE key = 'calibration'");
  const auto stored = load_map(file());
  ASSERT_TRUE(stored) << stored.error().message;
  EXPECT_EQ(stored->map.calibration.offset, map::BeliefCalibration{}.offset);
  EXPECT_EQ(stored->map.calibration.slope, map::BeliefCalibration{}.slope);
}

TEST_F(MapFile, RefusesATruncatedFile) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  std::filesystem::resize_file(file(), std::filesystem::file_size(file()) / 2);
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kCorruptFile);
}

}  // namespace
}  // namespace homeward::db
