// SPDX-License-Identifier: Apache-2.0
#include "server/driving/mission_journal.hpp"

#include <gtest/gtest.h>

#include "support/no_room.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::server::mission_journal_test {
namespace {

using testing::NoRoom;

class MissionJournalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    db::RobotRecord robot;
    robot.name = "chair";
    mission_.robot = store_->add_robot(robot)->id;
    mission_.map = MapId("m");
    mission_.place = PlaceId("p");
    mission_ = store_->add_mission(mission_).value();
  }
  void keep(wire::MissionState state) {
    mission_.state = state;
    kept_.keep(mission_);
    journal_.work_off();
  }
  wire::MissionState stored() { return store_->mission(mission_.id)->state; }

  testing::ScratchFolder folder_;
  std::unique_ptr<db::Store> store_ = std::move(*db::open_sqlite_store(folder_.path() / "data"));
  WorkPool journal_{1, 100};
  MissionJournal kept_{*store_, journal_};
  wire::MissionView mission_;
  SteadyTime now_ = SteadyTime() + std::chrono::hours(1);
};

TEST_F(MissionJournalTest, WhatFoundNoRoomIsWrittenOnceThereIs) {
  {
    const NoRoom full;
    keep(wire::MissionState::kDriving);
    keep(wire::MissionState::kArrived);
  }
  EXPECT_EQ(stored(), wire::MissionState::kAccepted);
  kept_.try_again(now_);
  journal_.work_off();
  EXPECT_EQ(stored(), wire::MissionState::kArrived) << "the newest";
}

TEST_F(MissionJournalTest, ItIsNotTriedWithoutAPause) {
  {
    const NoRoom full;
    keep(wire::MissionState::kArrived);
    kept_.try_again(now_);
    journal_.work_off();
  }
  kept_.try_again(now_ + std::chrono::seconds(4));
  journal_.work_off();
  EXPECT_EQ(stored(), wire::MissionState::kAccepted);
  kept_.try_again(now_ + std::chrono::seconds(5));
  journal_.work_off();
  EXPECT_EQ(stored(), wire::MissionState::kArrived);
}

TEST_F(MissionJournalTest, WhatWasKeptLaterIsNotWrittenOver) {
  {
    const NoRoom full;
    keep(wire::MissionState::kDriving);
  }
  keep(wire::MissionState::kArrived);
  kept_.try_again(now_);
  journal_.work_off();
  EXPECT_EQ(stored(), wire::MissionState::kArrived);
}

}  // namespace
}  // namespace homeward::server::mission_journal_test
