// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstring>
#include <fstream>
#include <random>

#include "support/sample_map.hpp"
#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_damage_test {
namespace {

using ::testing::HasSubstr;

class StoreDamage : public StoreTest {
 protected:
  void fill() {
    const User anna = store().add_user(person("anna", wire::Role::kAdmin)).value();
    ASSERT_TRUE(store().add_user(person("ben", wire::Role::kRider)));
    ASSERT_TRUE(store().add_session({"a hash", anna.id, 5, 500}));
    ASSERT_TRUE(store().set_setup_hash("first"));
    ASSERT_TRUE(store().set_setup_hash("second"));
    for (int i = 0; i < 20; ++i) {
      RobotRecord robot;
      robot.name = "chair " + std::to_string(i);
      const RobotId id = store().add_robot(robot)->id;
      ASSERT_TRUE(store().next_epoch(id));
      if (i % 5 == 0) {
        ASSERT_TRUE(store().remove_robot(id));
        continue;
      }
      wire::MissionView mission;
      mission.robot = id;
      mission.map = MapId("m");
      mission.place = PlaceId("p" + std::to_string(i));
      mission = store().add_mission(mission).value();
      mission.arrival_probability = i % 2 == 0 ? 1.0 : 0.25;
      mission.state = wire::MissionState::kArrived;
      ASSERT_TRUE(store().update_mission(mission));
      wire::PlanPoseView said;
      said.plan = wire::PlanId("drawn");
      ASSERT_TRUE(store().add_plan_poses(mission.id, {said}));
    }
    Tour tour;
    tour.id = TourId("t");
    tour.camera = "{}";
    ASSERT_TRUE(store().add_tour(tour));
    for (int i = 0; i < 30; ++i) {
      TourImage image;
      image.number = i;
      image.odometry = Pose2{0.5 * i, 1.0, 0.0};
      ASSERT_TRUE(store().put_image(tour.id, image, std::vector<std::uint8_t>(40, 7)));
      ASSERT_TRUE(store().put_sweep(tour.id, {i, "", {}}));
    }
    MapRecord map;
    map.id = MapId("m");
    map.tours = {tour.id};
    ASSERT_TRUE(store().add_map(map));
    AlongWithContents along;
    along.build = MapBuild{std::string(6000, 'r'), std::vector<std::uint8_t>(3000, 5)};
    ASSERT_TRUE(store().save_map_contents(map.id, testing::sample_map(), {}, 0, along));
    wire::PlanView plan;
    plan.versions.resize(1);
    const wire::PlanId drawn = store().add_plan(plan, std::vector<std::uint8_t>(3000, 9))->id;
    ASSERT_TRUE(store().tie_map({map.id, drawn, 1, 5, "anna", {{ImageId("t/1.jpg"), {1.0, 2.0}, 0.5}}}));
    for (int i = 0; i < 10; ++i) {
      const Drive drive{MissionId("d" + std::to_string(i % 3)), map.id, "c", i, {{PlaceId("p"), {1, 2}}, {{}, {}}}};
      ASSERT_TRUE(store().add_drive(drive));
    }
    ASSERT_TRUE(store().keep_answer({"anna", "POST /", "k"}, {200, "{}"}, 5));
  }
  [[nodiscard]] std::string file() const { return (folder() / "homeward.db").string(); }
  [[nodiscard]] std::string bytes() const {
    std::ifstream stream(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void put(const std::string& bytes) const {
    for (const char* beside : {"-wal", "-shm"}) std::filesystem::remove(file() + beside);
    std::ofstream(file(), std::ios::binary | std::ios::trunc) << bytes;
  }
  /// All that the tables hold, but for the sums.
  [[nodiscard]] std::string held() const {
    SQLite::Database database(file(), SQLite::OPEN_READWRITE);
    std::string all;
    SQLite::Statement table(
        database, "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite%' ORDER BY name");
    while (table.executeStep()) {
      const std::string name = table.getColumn(0).getString();
      SQLite::Statement row(database, "SELECT * FROM " + name);
      while (row.executeStep()) {
        all += name;
        for (int i = 0; i < row.getColumnCount(); ++i) all += "|" + row.getColumn(i).getString();
        all += "\n";
      }
    }
    return all;
  }
};

TEST_F(StoreDamage, WhatWasWrittenHasItsChecksums) {
  fill();
  for (int i = 0; i < 3; ++i) open();
  ASSERT_TRUE(store().remove_map(MapId("m")));  // takes drives and the tours' list along
  ASSERT_TRUE(store().remove_tour(TourId("t")));
  const auto refused = store().remove_robot(RobotId("nobody"));
  EXPECT_FALSE(refused) << "what is undone does not count";
  open();
  EXPECT_EQ(store().tours()->size(), 0U);
}

TEST_F(StoreDamage, AChangeOfAnotherProgramIsNoticedAndNamed) {
  fill();
  close();
  const std::string whole = bytes();
  for (const auto& [change, table] : std::vector<std::pair<std::string, std::string>>{
           {"UPDATE robots SET epoch = epoch - 1 WHERE name = 'chair 3'", "robots"},
           {"DELETE FROM sessions", "sessions"},
           {"UPDATE tour_images SET sha256 = 'x' WHERE number = 3", "tour_images"},
           {"UPDATE users SET role = 'admin' WHERE name = 'ben'", "users"},
           {"UPDATE missions SET arrival_probability = 0.5 WHERE arrival_probability = 0.25", "missions"},
           {"CREATE TABLE extra (a TEXT)", "extra"},
           {"DROP TABLE answers", "sqlite_schema"},
           {"DELETE FROM table_sums WHERE name = 'maps'", "maps"}}) {
    SQLite::Database(file(), SQLite::OPEN_READWRITE).exec(change);
    const auto opened = open_sqlite_store(folder());
    ASSERT_FALSE(opened) << change;
    EXPECT_EQ(opened.error().code, ErrorCode::kCorruptFile) << change;
    EXPECT_THAT(opened.error().message, HasSubstr("damaged")) << change;
    EXPECT_THAT(opened.error().where, HasSubstr(table)) << change;
    put(whole);
  }
  open();
}

TEST_F(StoreDamage, AFlippedByteIsNoticedOrChangesNothing) {
  fill();
  close();
  const std::string whole = bytes();
  const std::string before = held();
  std::mt19937 random(20);
  int noticed = 0;
  constexpr int kFlips = 250;
  for (int i = 0; i < kFlips; ++i) {
    std::string damaged = whole;
    const std::size_t at = random() % damaged.size();
    damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1 + random() % 255));
    put(damaged);
    auto opened = open_sqlite_store(folder());
    if (!opened) {
      ++noticed;
      EXPECT_THAT(opened.error().where + opened.error().message, HasSubstr("atabase")) << "byte " << at;
      continue;
    }
    opened->reset();
    EXPECT_EQ(held(), before) << "byte " << at;
  }
  EXPECT_GT(noticed, kFlips / 10) << "most pages are half empty, but not all";
}

TEST_F(StoreDamage, ADamagedLogOfAKilledProcessLosesNothingInSilence) {
  constexpr int kRobots = 12;
  const std::string log_file = file() + "-wal";
  close();
  // Without destructors: all that is new is in the log.
  const pid_t child = ::fork();
  if (child == 0) {
    auto opened = open_sqlite_store(folder());
    for (int i = 0; opened && i < kRobots; ++i) {
      if (i + 1 == kRobots) std::filesystem::copy_file(log_file, folder() / "before_last");
      RobotRecord robot;
      robot.name = "chair " + std::to_string(i);
      if (!(*opened)->add_robot(robot)) ::_exit(1);
    }
    ::_exit(opened ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  const auto read = [](const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::string database = bytes();
  const std::string log = read(log_file);
  const std::size_t acknowledged = read(folder() / "before_last").size();
  ASSERT_GT(acknowledged, 20'000U);
  ASSERT_LT(acknowledged, log.size());
  std::mt19937 random(21);
  int noticed = 0;
  for (int i = 0; i < 200; ++i) {
    put(database);
    std::string damaged = log;
    // Heads of log and frames more often than their share.
    const std::size_t at = i < 32 ? static_cast<std::size_t>(i) : random() % acknowledged;
    damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1 + random() % 255));
    std::ofstream(log_file, std::ios::binary | std::ios::trunc) << damaged;
    const auto opened = open_sqlite_store(folder());
    if (!opened) {
      ++noticed;
      EXPECT_EQ(opened.error().code, ErrorCode::kCorruptFile) << "byte " << at;
      continue;
    }
    EXPECT_EQ((*opened)->robots()->size(), static_cast<std::size_t>(kRobots)) << "byte " << at;
  }
  EXPECT_GT(noticed, 150);
  // A log that SQLite was about to begin anew, with all of it in the database: a new head before old frames.
  put(database);
  std::string anew = log;
  anew[16] = static_cast<char>(anew[16] + 1);  // the salt
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, anew.data() + at, sizeof value);
    return (anew[3] & 1) != 0 ? __builtin_bswap32(value) : value;
  };
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  for (std::size_t at = 0; at < 24; at += 8) {
    first += word(at) + second;
    second += word(at + 4) + first;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    anew[24 + i] = static_cast<char>(first >> (24 - 8 * i));
    anew[28 + i] = static_cast<char>(second >> (24 - 8 * i));
  }
  std::ofstream(log_file, std::ios::binary | std::ios::trunc) << anew;
  open();
  close();
  put(database);
  std::ofstream(log_file, std::ios::binary | std::ios::trunc) << log.substr(0, log.size() - 100);
  open();
  EXPECT_EQ(store().robots()->size(), static_cast<std::size_t>(kRobots - 1)) << "a transaction that was cut off";
}

TEST_F(StoreDamage, ACopyThatSqliteMadeIsWhole) {
  fill();
  close();
  const std::string copy = (folder() / "copy.db").string();
  {
    SQLite::Database from(file(), SQLite::OPEN_READWRITE);
    SQLite::Database to(copy, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    SQLite::Backup backup(to, from);
    backup.executeStep();
  }
  std::ifstream stream(copy, std::ios::binary);
  put({std::istreambuf_iterator<char>(stream), {}});
  open();
  EXPECT_EQ(store().robots()->size(), 16U);
}

}  // namespace
}  // namespace homeward::db::store_damage_test
