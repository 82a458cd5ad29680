// SPDX-License-Identifier: Apache-2.0
#include "scenario/shared_world.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "support/scratch_folder.hpp"

namespace homeward::scenario::shared_world_test {
namespace {

class SharedWorldTest : public ::testing::Test {
 protected:
  homeward::testing::ScratchFolder folder_;
  const sim::Box first_{{1.5, -2.25, 0.5}, {0.1, 0.2, 0.8, 0.3}, 1.25};
  const sim::Box second_{{-4.0, 0.125, 3.0}, Outline{}, 0.9};
};

TEST_F(SharedWorldTest, EachSeesTheOthersWhereTheyStandAndNotItself) {
  auto first = *SharedWorld::join(folder_.path() / "world");
  auto second = *SharedWorld::join(folder_.path() / "world");
  EXPECT_TRUE(first.exchange(first_).empty());
  const auto seen = second.exchange(second_);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(position_m(seen[0].pose), position_m(first_.pose));
  EXPECT_EQ(seen[0].pose.theta_rad, first_.pose.theta_rad);
  EXPECT_EQ(seen[0].foot, first_.foot);
  EXPECT_EQ(seen[0].height_m, first_.height_m);
  sim::Box moved = second_;
  moved.pose.x_m = -3.5;
  second.exchange(moved);
  ASSERT_EQ(first.exchange(first_).size(), 1U);
  EXPECT_EQ(position_m(first.exchange(first_)[0].pose), position_m(moved.pose));
}

TEST_F(SharedWorldTest, WhoEndsIsThereNoMoreAndWhoWasKilledNotForLong) {
  auto first = *SharedWorld::join(folder_.path());
  {
    auto second = *SharedWorld::join(folder_.path());
    second.exchange(second_);
    EXPECT_EQ(first.exchange(first_).size(), 1U);
  }
  EXPECT_TRUE(first.exchange(first_).empty());
  const auto killed = folder_.path() / "killed.robot";
  std::ofstream(killed) << "2 1 2 0 0.35 0 0 0 0.9\n";
  EXPECT_EQ(first.exchange(first_).size(), 1U);
  std::filesystem::last_write_time(killed, std::filesystem::file_time_type::clock::now() - std::chrono::seconds(3));
  EXPECT_TRUE(first.exchange(first_).empty());
}

TEST_F(SharedWorldTest, WhatIsNoRobotIsPassedOver) {
  auto first = *SharedWorld::join(folder_.path());
  std::ofstream(folder_.path() / "half.robot") << "2 1.0 2.0";
  std::ofstream(folder_.path() / "huge.robot") << "2 1 2 0 0.35 0 500 0 0.9\n";
  std::ofstream(folder_.path() / "words.robot") << "nan here\n";
  std::ofstream(folder_.path() / "nothing.robot") << "2 1 2 0 0 0 0 0 0.9\n";
  std::ofstream(folder_.path() / "thin_air.robot") << "2 1 2 0 -0.35 0 0 0 0.9\n";
  std::ofstream(folder_.path() / "older.robot") << "1 2 0 0.5 0.9\n";
  std::ofstream(folder_.path() / "newer.robot") << "3 1 2 0 0.35 0 0 0 0.9\n";
  std::ofstream(folder_.path() / "other.txt") << "2 1 2 0 0.35 0 0 0 0.9\n";
  EXPECT_TRUE(first.exchange(first_).empty());
}

TEST_F(SharedWorldTest, AFolderThatCannotBeMadeIsAnError) {
  std::ofstream(folder_.path() / "file") << "x";
  EXPECT_FALSE(SharedWorld::join(folder_.path() / "file" / "world"));
}

}  // namespace
}  // namespace homeward::scenario::shared_world_test
