// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <fstream>

#include "db/map_file.hpp"
#include "db/sqlite/map_file_contents.hpp"
#include "db/sqlite/map_graph_part.hpp"
#include "support/sample_map.hpp"
#include "support/sample_path.hpp"
#include "support/scratch_folder.hpp"
#include "wire/path_blob.hpp"

namespace homeward::db::map_path_test {
namespace {

using homeward::testing::closed_sample_path;
using homeward::testing::sample_map;
using homeward::testing::sample_path;

class MapPathFile : public ::testing::Test {
 protected:
  void SetUp() override {
    map_ = sample_map();
    map_.path = std::make_shared<const map::MapPath>(sample_path());
    ASSERT_TRUE(save_map(file(), map_, {}));
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "path.hwmap"; }
  /// As a program wrote it that thinks so: with its checksum.
  void change(const std::string& sql) const {
    SQLite::Database database(file().string(), SQLite::OPEN_READWRITE);
    database.exec(sql);
    try {
      const std::string checksum = read_contents(database).checksum;
      SQLite::Statement update(database, "UPDATE meta SET value = ? WHERE key = 'checksum'");
      update.bind(1, checksum);
      update.exec();
    } catch (const std::exception&) {  // it is refused for another reason
    }
  }
  [[nodiscard]] std::string content() const {
    std::ifstream stream(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  homeward::testing::ScratchFolder folder_;
  map::TopologicalMap map_;
};

TEST_F(MapPathFile, GivesBackThePathToTheBit) {
  const auto loaded = load_map(file());
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(loaded->map.path);
  const map::MapPath& path = *loaded->map.path;
  const map::MapPath& before = *map_.path;
  EXPECT_EQ(path.images, before.images);
  EXPECT_EQ(path.pictures, before.pictures);
  ASSERT_EQ(path.taught.key_images.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const map::KeyImage& key = path.taught.key_images[i];
    EXPECT_EQ(key.picture, before.taught.key_images[i].picture);
    EXPECT_EQ(key.common, before.taught.key_images[i].common);
    EXPECT_EQ(wire::encode_key_features(key.features), wire::encode_key_features(before.taught.key_images[i].features));
    EXPECT_EQ(key.scale.has_value(), i == 1);
  }
  EXPECT_EQ(path.taught.key_images[1].scale->ratio, 1.0 / 3.0);
  EXPECT_EQ(path.taught.key_images[1].scale->common, 9);
  EXPECT_EQ(path.taught.key_images[1].scale->spread, 0.0625);
  ASSERT_EQ(path.taught.arcs.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(path.taught.arcs[i].from, static_cast<int>(i));
    EXPECT_EQ(wire::encode_arc(path.taught.arcs[i]), wire::encode_arc(before.taught.arcs[i]));
  }
  ASSERT_EQ(path.taught.cuts.size(), 2U);
  EXPECT_FALSE(path.taught.cuts[0].next_picture);
  EXPECT_EQ(path.taught.cuts[1].next_picture, 1);
  EXPECT_EQ(path.taught.cuts[1].why, map::CutReason::kErrorTooLarge);
  EXPECT_EQ(path.taught.skipped_pictures, before.taught.skipped_pictures);
  ASSERT_EQ(path.taught.bridges.size(), 1U);
  EXPECT_EQ(path.taught.bridges[0].last_picture, 0);
  EXPECT_EQ(path.taught.bridges[0].next_picture, 1);
  EXPECT_EQ(path.taught.bridges[0].matched, 37);
  EXPECT_FALSE(path.taught.closing);
  const std::string first = content();
  ASSERT_TRUE(save_map(file(), loaded->map, {}));
  EXPECT_EQ(content(), first);
}

TEST_F(MapPathFile, AClosedPathStaysClosed) {
  map_.path = std::make_shared<const map::MapPath>(closed_sample_path());
  ASSERT_TRUE(save_map(file(), map_, {}));
  const auto loaded = load_map(file());
  ASSERT_TRUE(loaded) << loaded.error().message;
  const map::TaughtPath& taught = loaded->map.path->taught;
  ASSERT_TRUE(taught.closing);
  EXPECT_EQ(taught.closing->key_image, 0);
  EXPECT_EQ(taught.closing->common, 11);
  ASSERT_TRUE(taught.closing->scale);
  EXPECT_EQ(taught.closing->scale->ratio, 1.25);
  EXPECT_EQ(taught.closing->scale->common, 8);
  EXPECT_EQ(taught.closing->scale->spread, 0.03125);
  ASSERT_EQ(taught.arcs.size(), 3U);
  EXPECT_EQ(taught.arcs.back().from, 2);
  EXPECT_EQ(taught.to_key(taught.arcs.back()), 0);
}

TEST_F(MapPathFile, FilesOfVersionEightAreReadAndAreOpen) {
  change("DROP TABLE path_bridges; DROP TABLE path_closing; PRAGMA user_version = 8");
  const auto loaded = load_map(file());
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(loaded->map.path);
  EXPECT_EQ(loaded->map.path->taught.arcs.size(), 2U);
  EXPECT_EQ(loaded->map.path->taught.cuts.size(), 2U);
  EXPECT_TRUE(loaded->map.path->taught.bridges.empty());
  EXPECT_FALSE(loaded->map.path->taught.closing);
}

TEST_F(MapPathFile, AClosingThatLeadsNowhereIsRefused) {
  map_.path = std::make_shared<const map::MapPath>(closed_sample_path());
  for (const char* sql : {"UPDATE path_closing SET key_image = 2", "DELETE FROM path_arcs WHERE position = 1",
                          "DELETE FROM path_arcs WHERE position = 2", "UPDATE path_closing SET scale_ratio = -1.0",
                          "DELETE FROM path_closing", "UPDATE path_closing SET common = -1"}) {
    ASSERT_TRUE(save_map(file(), map_, {}));
    change(sql);
    const auto refused = load_map(file());
    ASSERT_FALSE(refused) << sql;
    EXPECT_NE(refused.error().where.find("path/"), std::string::npos) << sql << ": " << refused.error().where;
  }
}

TEST_F(MapPathFile, AMapThatWasNotTaughtSoHasNone) {
  map_.path = nullptr;
  ASSERT_TRUE(save_map(file(), map_, {}));
  const auto loaded = load_map(file());
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->map.path, nullptr);
}

TEST_F(MapPathFile, FilesOfVersionSevenAreReadAndHaveNone) {
  change(
      "DROP TABLE path_bridges; DROP TABLE path_closing; DROP TABLE path_key_images; DROP TABLE path_arcs; DROP TABLE "
      "path_cuts; DROP TABLE path_skipped;"
      "PRAGMA user_version = 7");
  const auto loaded = load_map(file());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->map.path, nullptr);
  EXPECT_EQ(loaded->map.places.size(), map_.places.size());
}

TEST_F(MapPathFile, EditsThatAreKeptApartLeaveThePath) {
  auto stored = load_map(file()).value();
  map::TopologicalMap edited = stored.map;
  edited.places.front().label = "kitchen";
  put_graph_part(graph_part_of(edited), stored.map);
  EXPECT_EQ(stored.map.places.front().label, "kitchen");
  ASSERT_TRUE(stored.map.path);
  EXPECT_EQ(stored.map.path->pictures, map_.path->pictures);
}

TEST_F(MapPathFile, APathThatDoesNotHoldTogetherIsRefusedAndNamed) {
  struct Damage {
    const char* sql;
    const char* where;
  };
  for (const Damage& damage :
       {Damage{"PRAGMA foreign_keys = OFF; UPDATE path_key_images SET image = 'other.jpg' WHERE position = 1",
               "path/1"},
        Damage{"UPDATE path_key_images SET shown = 0 WHERE position = 2", "path/2"},
        Damage{"UPDATE path_key_images SET shown = -1 WHERE position = 0", "path/0"},
        Damage{"UPDATE path_key_images SET picture = x'' WHERE position = 0", "path/0"},
        Damage{"UPDATE path_key_images SET features = x'00' WHERE position = 2", "path/2"},
        Damage{"UPDATE path_key_images SET scale_ratio = 0.0 WHERE position = 1", "path/1"},
        Damage{"UPDATE path_arcs SET from_key_image = 2 WHERE position = 1", "path/arcs/1"},
        Damage{"UPDATE path_arcs SET arc = x'4857' WHERE position = 0", "path/arcs/0"},
        Damage{"UPDATE path_cuts SET why = 9 WHERE position = 0", "path/cuts/0"},
        Damage{"UPDATE path_cuts SET last_shown = 3 WHERE position = 1", "path/cuts/1"},
        Damage{"UPDATE path_key_images SET shown = 3 WHERE position = 2", "path/2"},
        Damage{"UPDATE path_bridges SET next_shown = 0 WHERE position = 0", "path/bridges/0"},
        Damage{"UPDATE path_bridges SET last_shown = 9 WHERE position = 0", "path/bridges/0"},
        Damage{"UPDATE path_skipped SET shown = 5000000000 WHERE position = 0", "path/skipped"},
        Damage{"PRAGMA foreign_keys = OFF; DELETE FROM path_arcs; DELETE FROM path_key_images", "path"}}) {
    ASSERT_TRUE(save_map(file(), map_, {}));
    change(damage.sql);
    const auto refused = load_map(file());
    ASSERT_FALSE(refused) << damage.sql;
    EXPECT_NE(refused.error().where.find(damage.where), std::string::npos)
        << damage.sql << ": " << refused.error().where;
  }
}

TEST_F(MapPathFile, AChangedPictureIsADamageThatTheChecksumSees) {
  {
    SQLite::Database database(file().string(), SQLite::OPEN_READWRITE);
    database.exec("UPDATE path_key_images SET picture = x'FFD9' WHERE position = 1");
  }
  const auto refused = load_map(file());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("checksum"), std::string::npos);
}

}  // namespace
}  // namespace homeward::db::map_path_test
