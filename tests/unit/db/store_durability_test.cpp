// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <fstream>
#include <sstream>

#include "support/folders.hpp"
#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_durability_test {
namespace {

class StoreDurability : public StoreTest {
 protected:
  /// Runs `body` on the store in a process that then ends at once, without destructors. Its result is the exit status.
  template <class Body>
  int in_another_process(Body body) {
    const pid_t child = ::fork();
    if (child == 0) {
      auto opened = open_sqlite_store(folder());
      ::_exit(body(opened));
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  RobotId new_robot() {
    RobotRecord robot;
    robot.name = "chair";
    return store().add_robot(robot)->id;
  }
};

TEST_F(StoreDurability, WhatWasAcknowledgedSurvivesAnAbruptEnd) {
  const RobotId robot = new_robot();
  close();
  const std::vector<std::uint8_t> bytes(100'000, 42);
  const int status = in_another_process([&](Result<std::unique_ptr<Store>>& opened) {
    if (!opened) return 1;
    Tour tour;
    tour.id = TourId("t1");
    if (!(*opened)->add_tour(tour)) return 2;
    if ((*opened)->put_image(tour.id, {}, bytes) != PutImage::kNew) return 3;
    return (*opened)->next_epoch(robot) == 1 ? 0 : 4;
  });
  ASSERT_EQ(status, 0);
  open();
  EXPECT_EQ(store().image_bytes(TourId("t1"), 0).value(), bytes);
  EXPECT_GT(store().next_epoch(robot).value(), 1);
}

TEST_F(StoreDurability, ASecondProcessIsRefused) {
  EXPECT_EQ(in_another_process([](Result<std::unique_ptr<Store>>& opened) {
              return !opened && opened.error().code == ErrorCode::kConflict ? 0 : 1;
            }),
            0);
  EXPECT_EQ(open_sqlite_store(folder()).error().code, ErrorCode::kConflict);
}

TEST_F(StoreDurability, AnExplorationComesBackAsItWentIn) {
  wire::MissionView mission;
  mission.robot = new_robot();
  mission.kind = wire::MissionKind::kExplore;
  mission.exploration = ExplorationId("e1");
  mission.created_us = 1;
  mission.by = "ines";
  mission = store().add_mission(mission).value();
  mission.state = wire::MissionState::kFailed;
  mission.reason = wire::Reason{wire::ReasonCode::kExplorationStuck};
  mission.ended_us = 9;
  ASSERT_TRUE(store().update_mission(mission));
  open();
  const wire::MissionView found = store().mission(mission.id).value();
  EXPECT_EQ(wire::mission_to_json(found), wire::mission_to_json(mission));
  EXPECT_EQ(found.kind, wire::MissionKind::kExplore);
  EXPECT_EQ(found.exploration, ExplorationId("e1"));
  EXPECT_TRUE(found.map.empty());
  EXPECT_TRUE(found.place.empty());
  EXPECT_EQ(store().missions(mission.robot)->front().exploration, ExplorationId("e1"));
}

TEST_F(StoreDurability, MissionsUnderWayAreStoppedByARestart) {
  wire::MissionView mission;
  mission.robot = new_robot();
  mission.map = MapId("m");
  mission.place = PlaceId("p2");
  mission.path = {PlaceId("p1"), PlaceId("p2")};
  mission.created_us = 1;
  const MissionId driving = store().add_mission(mission)->id;
  mission.created_us = 2;
  wire::MissionView arrived = *store().add_mission(mission);
  arrived.state = wire::MissionState::kArrived;
  arrived.path_index = 1;
  arrived.arrival_probability = 0.96875;
  arrived.ended_us = 7;
  ASSERT_TRUE(store().update_mission(arrived));
  open();
  const wire::MissionView stopped = store().mission(driving).value();
  EXPECT_EQ(stopped.state, wire::MissionState::kStopped);
  EXPECT_EQ(stopped.reason, wire::Reason{wire::ReasonCode::kServerRestarted});
  EXPECT_EQ(stopped.path, mission.path);
  const auto all = store().missions(mission.robot).value();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].state, wire::MissionState::kArrived);
  EXPECT_EQ(all[0].path_index, 1);
  EXPECT_EQ(all[0].arrival_probability, 0.96875);
  EXPECT_EQ(all[0].ended_us, 7);
  EXPECT_EQ(stopped.ended_us, std::nullopt) << "nobody knows when";
  EXPECT_EQ(all[1].arrival_probability, std::nullopt) << "it was never known";
}

TEST_F(StoreDurability, AnEmptyFileBecomesADatabaseAndANewerOneIsRefused) {
  close();
  std::filesystem::remove_all(folder());
  std::filesystem::create_directories(folder());
  const std::filesystem::path file = folder() / "homeward.db";
  std::ofstream(file).flush();
  open();
  EXPECT_TRUE(store().users());
  close();
  {
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    EXPECT_EQ(database.execAndGet("PRAGMA user_version").getInt(), 16);
    EXPECT_EQ(database.execAndGet("PRAGMA journal_mode").getString(), "wal");
    database.exec("PRAGMA user_version = 999");
  }
  const auto newer = open_sqlite_store(folder());
  ASSERT_FALSE(newer);
  EXPECT_EQ(newer.error().code, ErrorCode::kUnsupportedFormat);
  EXPECT_THAT(newer.error().message, ::testing::HasSubstr("999"));
}

TEST_F(StoreDurability, AnOlderDatabaseKeepsItsMapsAndJobs) {
  close();
  std::filesystem::remove_all(folder());
  std::filesystem::create_directories(folder());
  {
    SQLite::Database database((folder() / "homeward.db").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    for (const char* file : {"0001_first.sql", "0002_job_notes.sql"}) {
      std::ostringstream sql;
      sql << std::ifstream(testing::project_folder() / "db/migrations" / file).rdbuf();
      database.exec(sql.str());
    }
    database.exec(
        "INSERT INTO maps (id, name, state, created_us) VALUES ('m', 'house', 'building', 1);"
        "INSERT INTO jobs VALUES ('done', 'build', 'm', 'failed', 'features', 0.5, 'too_few_images', 'two', 'tours/1', "
        "5,"
        " 2, '[\"A note.\"]');"
        "INSERT INTO jobs VALUES ('open', 'build', 'm', 'running', '', 0, NULL, NULL, NULL, 6, 0, '[]');");
    database.exec("PRAGMA application_id = " + std::to_string(0x48575354));
    database.exec("PRAGMA user_version = 2");
  }
  open();
  EXPECT_EQ(store().map(MapId("m"))->refine, wire::RefineMode::kAsk);
  ASSERT_EQ(store().jobs()->size(), 2U);
  const wire::JobView job = store().job(JobId("done")).value();
  EXPECT_EQ(job.state, wire::JobState::kFailed);
  EXPECT_EQ(job.error->message, "two");
  EXPECT_EQ(job.skipped, 2);
  EXPECT_EQ(job.notes, std::vector<wire::Reason>{wire::in_words("A note.")}) << "in the words of before";
  EXPECT_EQ(job.gained, 0);
  EXPECT_EQ(store().unfinished_jobs()->at(0).id.str(), "open");
}

TEST_F(StoreDurability, AnOlderDatabaseKeepsItsMissionsAndToursAndKnowsNotHowSureArrivalsWere) {
  close();
  std::filesystem::remove_all(folder());
  std::filesystem::create_directories(folder());
  {
    SQLite::Database database((folder() / "homeward.db").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    for (const char* file : {"0001_first.sql", "0002_job_notes.sql", "0003_learning.sql"}) {
      std::ostringstream sql;
      sql << std::ifstream(testing::project_folder() / "db/migrations" / file).rdbuf();
      database.exec(sql.str());
    }
    database.exec(
        "INSERT INTO tours VALUES ('t', 'morning', '{}', 0, 1);"
        "INSERT INTO tour_images VALUES ('t', 4, '000004.jpg', 'jpg', NULL, NULL, NULL, NULL, 'aa', 1);"
        "INSERT INTO robots (id, name, created_us) VALUES ('r', 'chair', 1);"
        "INSERT INTO missions VALUES ('x', 'r', 'm', 3, NULL, 'p2', 'arrived', NULL, 1, 2, '[\"p1\",\"p2\"]', 1, 7, "
        "'anna');"
        "INSERT INTO missions VALUES ('y', 'r', 'm', 3, NULL, 'p2', 'failed', 'The way is \"blocked\".', 1, 2, '[]', "
        "0, "
        "6, 'anna');");
    database.exec("PRAGMA application_id = " + std::to_string(0x48575354));
    database.exec("PRAGMA user_version = 3");
  }
  open();
  wire::MissionView mission = store().mission(MissionId("x")).value();
  EXPECT_EQ(mission.state, wire::MissionState::kArrived);
  EXPECT_EQ(mission.by, "anna");
  EXPECT_EQ(mission.arrival_probability, std::nullopt);
  EXPECT_EQ(mission.kind, wire::MissionKind::kDrive);
  EXPECT_EQ(mission.exploration, std::nullopt);
  mission.arrival_probability = 0.5;
  ASSERT_TRUE(store().update_mission(mission));
  EXPECT_EQ(store().mission(MissionId("x"))->arrival_probability, 0.5);
  EXPECT_EQ(store().mission(MissionId("x"))->reason, std::nullopt);
  EXPECT_EQ(store().mission(MissionId("y"))->reason, wire::in_words("The way is \"blocked\"."));
  TourSweep sweep{4, "000004.jpg", {}};
  sweep.sweep.ranges_m = {1.0F};
  sweep.sweep.angle_step_rad = 0.01;
  EXPECT_TRUE(store().sweeps(TourId("t")).value().empty());
  EXPECT_EQ(store().put_sweep(TourId("t"), sweep).value(), PutImage::kNew) << "a tour that is still open takes them";
}

TEST_F(StoreDurability, AFileThatIsNoDatabaseIsNamed) {
  close();
  const std::filesystem::path file = folder() / "homeward.db";
  std::filesystem::remove(folder() / "homeward.db-wal");
  std::ofstream(file, std::ios::trunc) << std::string(8192, 'x');
  const auto opened = open_sqlite_store(folder());
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kCorruptFile);
  EXPECT_THAT(opened.error().where, ::testing::HasSubstr("homeward.db"));
}

TEST_F(StoreDurability, SomebodyElsesDatabaseIsLeftAlone) {
  close();
  const std::filesystem::path file = folder() / "homeward.db";
  std::filesystem::remove(file);
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE recipes (name TEXT)");
  const auto opened = open_sqlite_store(folder());
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kCorruptFile);
}

TEST_F(StoreDurability, EpochsOfARobotThatIsNotThere) {
  EXPECT_EQ(store().next_epoch(RobotId("none")).error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace homeward::db::store_durability_test
