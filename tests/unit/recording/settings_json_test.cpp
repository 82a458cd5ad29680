// SPDX-License-Identifier: Apache-2.0
#include "recording/settings_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>

namespace homeward::recording::settings_json_test {
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

TEST(SettingsJson, LeaveTheProgramsValueWhereAnOlderRecordingLacksIt) {
  const auto config = driving_from_json(R"({"turn_gain": 1.5})");
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->turn_gain, 1.5);
  const driving::DrivingConfig usual;
  EXPECT_EQ(config->give_way.patience_ms, usual.give_way.patience_ms);
  EXPECT_EQ(config->safety.margin_m, usual.safety.margin_m);
  EXPECT_EQ(config->steering.long_plan.cheaper_m, usual.steering.long_plan.cheaper_m);
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
}  // namespace homeward::recording::settings_json_test
