// SPDX-License-Identifier: Apache-2.0
#include "agent/recording/settings_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace homeward::agent {
namespace {

using ::testing::HasSubstr;

TEST(SettingsJson, GiveEveryNumberOfDrivingBack) {
  // Each number another one than the program's own, so that a member that is not written shows.
  nlohmann::json changed = nlohmann::json::parse(driving_to_json({}));
  for (auto& [key, value] : changed.items()) {
    if (value.is_number_integer()) value = value.get<std::int64_t>() + 1;
    if (value.is_number_float()) value = value.get<double>() * 1.1 + 1e-9;
    if (value.is_string()) value = "hw2-other";
  }
  const auto config = driving_from_json(changed.dump());
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(nlohmann::json::parse(driving_to_json(*config)), changed);
  EXPECT_DOUBLE_EQ(config->body.outline.radius_m, 0.35 * 1.1 + 1e-9);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(config->turn_gain), std::bit_cast<std::uint64_t>(1.8 * 1.1 + 1e-9));
  EXPECT_EQ(config->stuck_ms, 20'001);
}

TEST(SettingsJson, KeepTheIdOfFeatures) {
  features::FeatureConfig config;
  config.panorama_width_px = 512;
  config.elevation_max_rad = 1.0 / 3.0;
  config.sift_windows = 2;
  const auto read = features_from_json(features_to_json(config));
  ASSERT_TRUE(read);
  EXPECT_EQ(features::feature_config_id(*read), features::feature_config_id(config));
  EXPECT_EQ(read->elevation_max_rad, config.elevation_max_rad);
}

TEST(SettingsJson, KeepWhatOutlivesTheBeginningOfAMission) {
  DrivingState before;
  before.newest = {7, 12};
  before.least_epoch = 6;
  before.pictures = 1'000'000'000'000;
  before.covered = true;
  before.asking.number = 7;
  before.drive = wire::DriveState::kDriving;
  const auto read = memory_from_json(memory_to_json(before));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->newest, before.newest);
  EXPECT_EQ(read->least_epoch, 6);
  EXPECT_EQ(read->pictures, before.pictures);
  EXPECT_TRUE(read->covered);
  EXPECT_EQ(read->asking.number, 7) << "an answer names the question that was asked";
  EXPECT_EQ(read->drive, wire::DriveState::kIdle) << "there is no mission before the first step";
}

TEST(SettingsJson, KeepTheWayBackAndWhoStirredToTheLastBit) {
  constexpr float kNothing_m = std::numeric_limits<float>::infinity();
  DrivingState before;
  before.refuses_until_ms = 4711;
  before.give_way.trail_m = {{0.1, 1.0 / 3.0}, {-2.0, 1e-17}};
  before.give_way.blocked_at_m = {1.1, -0.7};
  before.give_way.times = 2;
  before.stirring.before =
      Scan{{0.1F, kNothing_m, std::numeric_limits<float>::quiet_NaN(), 3.3F}, -0.5, 0.1, 11.0, {0.2, -0.1, 3.0}};
  before.stirring.before_from = {1.0 / 7.0, 2.0, -3.0};
  before.stirring.before_ms = 123'456'789'012;
  before.stirring.seen_ms = 7;
  const auto read = memory_from_json(memory_to_json(before));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->refuses_until_ms, 4711);
  EXPECT_EQ(read->give_way.trail_m, before.give_way.trail_m);
  EXPECT_EQ(read->give_way.blocked_at_m, before.give_way.blocked_at_m);
  EXPECT_EQ(read->give_way.times, 2);
  const Scan& scan = read->stirring.before.value();
  ASSERT_EQ(scan.ranges_m.size(), 4U);
  EXPECT_EQ(scan.ranges_m[0], 0.1F);
  EXPECT_EQ(scan.ranges_m[1], kNothing_m);
  EXPECT_TRUE(std::isnan(scan.ranges_m[2]));
  EXPECT_EQ(scan.ranges_m[3], 3.3F);
  EXPECT_EQ(scan.angle_min_rad, -0.5);
  EXPECT_EQ(scan.angle_step_rad, 0.1);
  EXPECT_EQ(scan.range_max_m, 11.0);
  EXPECT_EQ(scan.robot_from_scan.theta_rad, 3.0);
  EXPECT_EQ(read->stirring.before_from.x_m, 1.0 / 7.0);
  EXPECT_EQ(read->stirring.before_ms, 123'456'789'012);
  EXPECT_EQ(read->stirring.seen_ms, 7);
  for (const char* damaged : {R"({"give_way": {}})", R"({"stirring": 3})", R"({"give_way": {"trail_m": [[1]]}})"}) {
    EXPECT_FALSE(memory_from_json(damaged)) << damaged;
  }
}

TEST(SettingsJson, RefuseWhatTheyDoNotKnow) {
  const auto unknown = driving_from_json(R"({"turn_gain": 1.5, "whirl_gain": 2})");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kUnsupportedFormat);
  EXPECT_THAT(unknown.error().message, HasSubstr("whirl_gain"));
  for (const char* text : {"", "[]", "{", R"({"turn_gain": "fast"})", R"({"body_side_m": [3]})"}) {
    const auto damaged = driving_from_json(text);
    ASSERT_FALSE(damaged) << text;
    EXPECT_EQ(damaged.error().code, ErrorCode::kCorruptFile) << text;
  }
}

}  // namespace
}  // namespace homeward::agent
