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

TEST(WorldFolder, KnowsLightsByNameAndByLevel) {
  EXPECT_EQ(light_named("half").value(), sim::Light(sim::LightPreset::kHalf));
  EXPECT_EQ(light_named("daylight:1").value(), sim::Light(sim::LightPreset::kDay));
  EXPECT_EQ(light_named("daylight:0").value(), sim::Light(sim::LightPreset::kNight));
  EXPECT_EQ(light_named("daylight:0.15").value().level(), 0.15);
}

TEST(WorldFolder, RefusesOtherLightsByName) {
  for (const std::string name : {"dusk", "", "daylight", "daylight:", "daylight:1.5", "daylight:-0.1", "daylight:nan",
                                 "daylight:0.5x", "daylight:.5", "daylight:1e-1"}) {
    const auto light = light_named(name);
    ASSERT_FALSE(light) << name;
    EXPECT_EQ(light.error().code, ErrorCode::kInvalidInput);
    const std::string value = name.starts_with("daylight:") ? name.substr(9) : name;
    EXPECT_NE(light.error().message.find("'" + value + "'"), std::string::npos) << light.error().message;
  }
}

}  // namespace
}  // namespace homeward::scenario::world_folder_test
