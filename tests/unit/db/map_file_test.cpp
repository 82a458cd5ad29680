// SPDX-License-Identifier: Apache-2.0
#include "db/map_file.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <random>
#include <thread>

#include "db/sqlite/map_file_contents.hpp"
#include "map/state.hpp"
#include "support/same_state.hpp"
#include "support/sample_map.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::db::map_file_test {
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
  void change(const std::string& sql) const { SQLite::Database(file().string(), SQLite::OPEN_READWRITE).exec(sql); }
  /// Turns the file into one of version 6: its edits keep nothing beside themselves, each place has its own
  /// appearances.
  void make_version_six() const {
    change(R"sql(
      ALTER TABLE place_appearances RENAME TO shared;
      CREATE TABLE place_appearances (place TEXT NOT NULL, position INTEGER NOT NULL, appearance BLOB NOT NULL,
                                      PRIMARY KEY (place, position)) STRICT;
      INSERT INTO place_appearances SELECT place, position, appearances.appearance
        FROM shared JOIN appearances ON number = shared.appearance;
      DROP TABLE shared; DROP TABLE unedited_place_appearances; DROP TABLE edit_appearances; DROP TABLE appearances;
      DROP TABLE unedited_place_members; DROP TABLE unedited_edges; DROP TABLE unedited_shortcuts;
      DROP TABLE unedited_hypotheses; DROP TABLE unedited_destinations; DROP TABLE unedited_places;
      ALTER TABLE destinations DROP COLUMN pictogram;
      ALTER TABLE edits DROP COLUMN lost; ALTER TABLE edits DROP COLUMN found_json;
      DELETE FROM meta WHERE key IN ('settled_edits', 'has_unedited');
      DROP TABLE path_bridges; DROP TABLE path_closing; DROP TABLE path_key_images; DROP TABLE path_arcs; DROP TABLE path_cuts; DROP TABLE path_skipped;
      PRAGMA user_version = 6)sql");
  }
  /// Turns the file into one of the version before checksums, so that its rows may be changed.
  void forget_checksum() const {
    if (version() > 6) make_version_six();
    change("PRAGMA user_version = 2; DELETE FROM meta WHERE key = 'checksum'");
  }
  [[nodiscard]] int version() const {
    return SQLite::Database(file().string()).execAndGet("PRAGMA user_version").getInt();
  }
  [[nodiscard]] std::string content() const {
    std::ifstream stream(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  void put(const std::string& bytes) const { std::ofstream(file(), std::ios::binary) << bytes; }

 private:
  std::filesystem::path folder_;
};

/// Everything that a file says, as the bytes of a file that is made of it.
std::string said_by(const StoredMap& stored, const std::filesystem::path& scratch) {
  EXPECT_TRUE(save_map(scratch, stored.map, stored.thumbnails));
  std::ifstream stream(scratch, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST_F(MapFile, GivesBackWhatWasSaved) {
  map::TopologicalMap before = sample_map();
  before.feature_config.sift_windows = 2;
  before.calibration = {0.25, 0.75};
  before.edges[1].shortcut = true;
  before.edits[0].kind = map::EditKind::kDecideShortcut;
  before.edits[0].change = 7;
  before.edits[0].undone = before.edits[0].redoable = true;
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
  EXPECT_FALSE(after.edges[0].shortcut);
  EXPECT_TRUE(after.edges[1].shortcut);
  ASSERT_EQ(after.shortcuts.size(), 1U);
  const map::Shortcut& shortcut = after.shortcuts[0];
  EXPECT_EQ(shortcut.image_a, before.images[0].id);
  EXPECT_EQ(shortcut.image_b, before.images[2].id);
  EXPECT_EQ(shortcut.bearing_rad, 0.5);
  EXPECT_EQ(shortcut.turn_rad, -0.25);
  EXPECT_EQ(shortcut.back_bearing_rad, -2.5);
  EXPECT_EQ(shortcut.length_m, 2.5);
  EXPECT_EQ(shortcut.way_m, 9.75);
  EXPECT_EQ(shortcut.clear_m, 1.25);
  EXPECT_EQ(shortcut.confidence, 0.875);
  EXPECT_EQ(shortcut.inliers, 48);
  EXPECT_EQ(shortcut.state, map::ShortcutState::kRejected);
  EXPECT_EQ(shortcut.by, "anna");
  EXPECT_EQ(after.edits[0].kind, map::EditKind::kDecideShortcut);
  ASSERT_EQ(after.hypotheses.size(), 1U);
  EXPECT_EQ(after.hypotheses[0].decision, map::Decision::kRejected);
  EXPECT_DOUBLE_EQ(after.hypotheses[0].masses_after.is_false, 0.8);
  ASSERT_EQ(after.destinations.size(), 1U);
  EXPECT_EQ(after.destinations[0].appearance.size(), 15);
  ASSERT_EQ(after.edits.size(), 1U);
  EXPECT_EQ(after.edits, before.edits) << "with nothing found out";
  EXPECT_EQ(after.next_place_number, 3);
  EXPECT_EQ(stored->thumbnails, thumbnails);
  EXPECT_GT(stored->bytes, 0);
}

TEST_F(MapFile, KeepsHowTheMapWasWithoutEditsAndWhatTheseFoundOut) {
  map::TopologicalMap before = sample_map();
  before.unedited = map::state_of(before);
  before.settled_edits = 0;
  before.places[0].label = "porch";
  before.places[0].appearances.push_back(homeward::testing::random_appearance(7, 3), before.images[1].id);
  before.destinations[0].pictogram = "kitchen";
  map::EditFindings& found = before.edits[0].found;
  found.made = "p7";
  found.prototypes = {before.images[1].id};
  found.appearances.push_back(before.places[0].appearances.entries()[1]);
  found.learnt.push_back(homeward::testing::random_appearance(9, 4));
  found.ways = {{before.images[0].id, before.images[2].id, 0.1, -0.3, 0.7, 12},
                {before.images[2].id, before.images[0].id, std::nullopt, 0.0, 0.0, 0}};
  before.edits[0].lost = "Place p9 is not there.";
  ASSERT_TRUE(save_map(file(), before, {}));
  before = load_map(file())->map;  // bearings are kept with a few digits less
  EXPECT_EQ(before.places[0].appearances.at(1).size(), 7);
  EXPECT_EQ(before.places[0].label, "porch");
  EXPECT_EQ(before.unedited->places[0].label, "");
  EXPECT_EQ(before.destinations[0].pictogram, "kitchen");
  EXPECT_EQ(before.unedited->destinations[0].pictogram, "");
  ASSERT_TRUE(save_map(file(), before, {}));
  const auto stored = load_map(file());
  ASSERT_TRUE(stored) << stored.error().message << stored.error().where;
  const map::TopologicalMap& after = stored->map;
  EXPECT_TRUE(homeward::testing::same_state(after, before));
  ASSERT_TRUE(after.unedited);
  EXPECT_TRUE(homeward::testing::same_state(*after.unedited, *before.unedited));
  EXPECT_EQ(after.edits[0].lost, before.edits[0].lost);
  EXPECT_EQ(after.edits[0].found.made, "p7");
  EXPECT_EQ(after.edits[0].found.prototypes, found.prototypes);
  EXPECT_EQ(after.edits[0].found.ways, found.ways);
  ASSERT_EQ(after.edits[0].found.appearances.size(), 1U);
  EXPECT_EQ(after.edits[0].found.appearances.entries()[0], after.places[0].appearances.entries()[1]) << "shared";
  EXPECT_EQ(after.places[1].appearances, after.unedited->places[1].appearances) << "shared";
  EXPECT_EQ(after.edits[0].found.learnt.at(0).size(), 9);
  EXPECT_EQ(said_by(*stored, file()), content());
}

TEST_F(MapFile, OfFilesOfBeforeEditsAreSettled) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  forget_checksum();
  change("ALTER TABLE edges DROP COLUMN inliers; ALTER TABLE edges DROP COLUMN length_from");
  const auto old = load_map(file());
  ASSERT_TRUE(old) << old.error().message;
  EXPECT_EQ(old->map.settled_edits, 1U);
  EXPECT_FALSE(old->map.unedited);
  EXPECT_EQ(old->map.places[0].appearances.entries()[0].image, old->map.places[0].prototype);
}

TEST_F(MapFile, RefusesAppearancesThatAreNotThere) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  change("PRAGMA foreign_keys = OFF; UPDATE place_appearances SET appearance = 99");
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("no appearance 99"));
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
  const auto make_old = [&] {
    forget_checksum();
    change("ALTER TABLE edges DROP COLUMN inliers; ALTER TABLE edges DROP COLUMN length_from");
  };
  make_old();
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
  make_old();
  EXPECT_EQ(load_map(file())->map.edges[0].length_from, map::LengthSource::kOdometry);
  ASSERT_TRUE(save_map(file(), old->map, {}));
  EXPECT_EQ(load_map(file())->map.edges[0].length_from, map::LengthSource::kTourImages);
}

TEST_F(MapFile, OpensFilesFromBeforeShortcuts) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  forget_checksum();
  change("PRAGMA user_version = 2; DROP TABLE shortcuts; ALTER TABLE edges DROP COLUMN shortcut");
  change("ALTER TABLE edges DROP COLUMN inliers; ALTER TABLE edges DROP COLUMN length_from");
  ASSERT_TRUE(load_map(file())) << load_map(file()).error().message;
  EXPECT_TRUE(load_map(file())->map.shortcuts.empty());
  // Version 4 with its own checksum, as a program of before wrote it.
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  make_version_six();
  change("DROP TABLE shortcuts; ALTER TABLE edges DROP COLUMN shortcut; PRAGMA user_version = 4");
  change("DELETE FROM meta WHERE key = 'checksum'");
  {
    SQLite::Database database(file().string(), SQLite::OPEN_READWRITE);
    const std::string checksum = read_contents(database).checksum;
    database.exec("INSERT INTO meta(key, value) VALUES ('checksum', '" + checksum + "')");
  }
  const auto old = load_map(file());
  ASSERT_TRUE(old) << old.error().message;
  EXPECT_TRUE(old->map.shortcuts.empty());
  EXPECT_FALSE(old->map.edges[1].shortcut);
  EXPECT_EQ(old->map.edges[0].inliers, 64);
}

TEST_F(MapFile, InFilesFromBeforeChangesEachEditIsOne) {
  map::TopologicalMap map = sample_map();
  map.edits.push_back(map.edits[0]);  // of the same change
  map.edits[1].undone = map.edits[1].redoable = true;
  ASSERT_TRUE(save_map(file(), map, {}));
  make_version_six();
  change("ALTER TABLE edits DROP COLUMN change; ALTER TABLE edits DROP COLUMN redoable; PRAGMA user_version = 5");
  change("DELETE FROM meta WHERE key = 'checksum'");
  {
    SQLite::Database database(file().string(), SQLite::OPEN_READWRITE);
    const std::string checksum = read_contents(database).checksum;
    database.exec("INSERT INTO meta(key, value) VALUES ('checksum', '" + checksum + "')");
  }
  const auto old = load_map(file());
  ASSERT_TRUE(old) << old.error().message;
  ASSERT_EQ(old->map.edits.size(), 2U);
  EXPECT_EQ(old->map.edits[0].change, 1);
  EXPECT_EQ(old->map.edits[1].change, 2);
  EXPECT_TRUE(old->map.edits[1].undone);
  EXPECT_FALSE(old->map.edits[1].redoable) << "nobody wrote down whether";
  forget_checksum();
  change("PRAGMA user_version = 6; ALTER TABLE edits ADD COLUMN change INTEGER; UPDATE edits SET change = 0");
  change("ALTER TABLE edits ADD COLUMN redoable INTEGER");
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("belongs to no change"));
}

TEST_F(MapFile, RefusesShortcutsThatCannotBe) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  forget_checksum();
  change("PRAGMA user_version = 5; UPDATE shortcuts SET state = 3");
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("unknown state"));
  change("PRAGMA foreign_keys = OFF; UPDATE shortcuts SET state = 0, image_b = 'tour/absent.jpg'");
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("A shortcut names an image"));
}

TEST_F(MapFile, RefusesOtherDatabasesNewerVersionsAndDanglingReferences) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  change("UPDATE edges SET length_from = 9");
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("unknown source"));
  forget_checksum();
  for (const auto& [version, what] :
       {std::pair("1", "Rebuild the map"), std::pair("10", "A newer Homeward wrote it")}) {
    change(std::string("PRAGMA user_version = ") + version);
    const auto refused = load_map(file());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnsupportedFormat);
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr(what));
  }
  change("PRAGMA user_version = 2; PRAGMA application_id = 1");
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kCorruptFile);
  change("PRAGMA application_id = 1213680976; DELETE FROM place_members WHERE place = 'p1'");
  EXPECT_THAT(load_map(file()).error().where, ::testing::HasSubstr("places/p1"));
}

TEST_F(MapFile, ReadsFilesFromBeforeBeliefsWereCalibrated) {
  map::TopologicalMap map = sample_map();
  map.calibration = {0.25, 0.75};
  ASSERT_TRUE(save_map(file(), map, {}));
  forget_checksum();
  change("UPDATE meta SET value = '{\"offset\": 0, \"slope\": -1}' WHERE key = 'calibration'");
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kCorruptFile);
  change("DELETE FROM meta WHERE key = 'calibration'");
  const auto stored = load_map(file());
  ASSERT_TRUE(stored) << stored.error().message;
  EXPECT_EQ(stored->map.calibration.offset, map::BeliefCalibration{}.offset);
  EXPECT_EQ(stored->map.calibration.slope, map::BeliefCalibration{}.slope);
}

TEST_F(MapFile, TheSameMapIsTheSameFileByteForByte) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  const std::string first = content();
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  EXPECT_EQ(content(), first);
  EXPECT_EQ(said_by(*load_map(file()), file()), first);
}

TEST_F(MapFile, ReadsFilesFromBeforeChecksumsButNoneThatLostIt) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  change("DELETE FROM meta WHERE key = 'checksum'");
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("checksum"));
  forget_checksum();
  EXPECT_TRUE(load_map(file()));
}

TEST_F(MapFile, RefusesContentThatWasChanged) {
  for (const char* sql : {"UPDATE places SET label = 'cellar' WHERE id = 'p2'", "UPDATE edges SET bearing_rad = 0.6",
                          "DELETE FROM hypotheses", "UPDATE meta SET value = '7' WHERE key = 'revision'",
                          "INSERT INTO thumbnails VALUES ('tour/00002.jpg', x'FFD8')"}) {
    ASSERT_TRUE(save_map(file(), sample_map(), {}));
    change(sql);
    const auto refused = load_map(file());
    ASSERT_FALSE(refused) << sql;
    EXPECT_EQ(refused.error().code, ErrorCode::kCorruptFile);
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("checksum")) << sql;
    EXPECT_EQ(refused.error().where, file().string());
  }
}

TEST_F(MapFile, AFlippedBitIsRefusedOrChangesNothingThatIsRead) {
  ASSERT_TRUE(save_map(file(), sample_map(), {{sample_map().images[0].id, {1, 2, 3}}}));
  const std::string good = content();
  std::mt19937_64 random(5);
  int refused = 0;
  constexpr int kFlips = 2000;
  for (int i = 0; i < kFlips; ++i) {
    std::string bytes = good;
    const std::size_t at = random() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random() % 8)));
    put(bytes);
    const auto loaded = load_map(file());
    if (loaded) {
      EXPECT_EQ(said_by(*loaded, file().parent_path() / "again"), good) << "byte " << at;
      continue;
    }
    ++refused;
    EXPECT_TRUE(loaded.error().code == ErrorCode::kCorruptFile || loaded.error().code == ErrorCode::kUnsupportedFormat)
        << "byte " << at << ": " << loaded.error().message;
    EXPECT_THAT(loaded.error().where, ::testing::HasSubstr(file().string()));
  }
  EXPECT_GT(refused, kFlips / 4);  // the rest fell on what no reader looks at: the unused ends of pages
}

TEST_F(MapFile, RefusesAFileThatWasCutShortAtAnyLength) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  const std::string good = content();
  for (std::size_t length = 0; length < good.size(); length += length < 200 || good.size() - length < 200 ? 1 : 97) {
    put(good.substr(0, length));
    const auto refused = load_map(file());
    ASSERT_FALSE(refused) << length;
    EXPECT_EQ(refused.error().code, ErrorCode::kCorruptFile) << length;
    EXPECT_EQ(refused.error().where, file().string());
  }
}

TEST_F(MapFile, FoldersAndFilesThatMayNotBeReadAreNamedAsSuch) {
  std::filesystem::create_directory(file());
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("folder"));
  EXPECT_EQ(load_map("/dev/null").error().code, ErrorCode::kInvalidInput);
  std::filesystem::remove(file());
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  std::filesystem::permissions(file(), std::filesystem::perms::none);
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  EXPECT_EQ(load_map(file()).error().code, ErrorCode::kIo);
  EXPECT_THAT(load_map(file()).error().message, ::testing::HasSubstr("Permission denied"));
}

TEST_F(MapFile, ReadingLooksAtNothingBesideTheFile) {
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  const std::string good = content();
  std::ofstream(file().string() + "-journal") << "left by some other program";
  std::ofstream(file().string() + "-wal") << "left by some other program";
  EXPECT_TRUE(load_map(file()));
  EXPECT_EQ(content(), good);
}

TEST_F(MapFile, WhatAKilledProgramLeftIsTakenOverAndNotAddedTo) {
  std::ofstream(file().string() + ".part") << std::string(1 << 20, 'x');
  ASSERT_TRUE(save_map(file(), sample_map(), {}));
  EXPECT_TRUE(load_map(file()));
  const auto entries = std::filesystem::directory_iterator(file().parent_path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST_F(MapFile, ManyWritersAtOnceLeaveOneWholeMap) {
  std::vector<std::jthread> writers;
  writers.reserve(4);
  std::atomic<int> failed = 0;
  for (int writer = 0; writer < 4; ++writer) {
    writers.emplace_back([&, writer] {
      map::TopologicalMap map = sample_map();
      map.revision = 10 + writer;
      for (int i = 0; i < 10; ++i) failed += save_map(file(), map, {}) ? 0 : 1;
    });
  }
  writers.clear();
  EXPECT_EQ(failed, 0);
  EXPECT_GE(load_map(file())->map.revision, 10);
  const auto entries = std::filesystem::directory_iterator(file().parent_path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

}  // namespace
}  // namespace homeward::db::map_file_test
