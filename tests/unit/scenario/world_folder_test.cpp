// SPDX-License-Identifier: Apache-2.0
#include "scenario/world_folder.hpp"

#include <gtest/gtest.h>

namespace homeward::scenario::world_folder_test {
namespace {

TEST(WorldFolder, GeneratesWorldsByTheirNames) {
  for (const std::string name : {"laboratory:3", "offices:2"}) {
    const auto world = load_world(name);
    ASSERT_TRUE(world) << world.error().message;
    EXPECT_EQ(world->name, name);
    EXPECT_FALSE(world->rooms.empty());
  }
}

TEST(WorldFolder, WantsANumberForASeed) {
  for (const std::string name : {"laboratory:", "laboratory:x", "laboratory:1a"}) {
    const auto world = load_world(name);
    ASSERT_FALSE(world) << name;
    EXPECT_EQ(world.error().code, ErrorCode::kInvalidInput);
  }
}

}  // namespace
}  // namespace homeward::scenario::world_folder_test
