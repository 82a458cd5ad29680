// SPDX-License-Identifier: Apache-2.0
#include "wire/rosbridge_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/sample_rosbridge.hpp"

namespace homeward::wire::rosbridge_json_test {
namespace {

using homeward::testing::sample_ring;
using homeward::testing::sample_rosbridge;
using nlohmann::json;

TEST(RosbridgeFile, IsWrittenAsTheOldestVersionThatCanSayIt) {
  RosbridgeFile file = sample_rosbridge();
  EXPECT_EQ(rosbridge_to_json(file)["version"], 1);
  EXPECT_FALSE(rosbridge_to_json(file).contains("ranges"));
  file.ranges = sample_ring(2);
  EXPECT_EQ(rosbridge_to_json(file)["version"], 2);
  file.scan.reset();
  const json alone = rosbridge_to_json(file);
  EXPECT_EQ(alone["version"], 2);
  EXPECT_FALSE(alone.contains("scan"));
  const auto again = rosbridge_from_json(alone);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_FALSE(again->scan);
  ASSERT_EQ(again->ranges.size(), 2U);
  EXPECT_EQ(again->ranges[1].topic.topic, "/sonar/1");
  EXPECT_EQ(again->ranges[1].robot_from_sensor.theta_rad, file.ranges[1].robot_from_sensor.theta_rad);
  EXPECT_EQ(again->ranges[1].range_max_m, 3.0);
}

TEST(RosbridgeFile, IsReadInBothVersions) {
  json file = rosbridge_to_json(sample_rosbridge());
  EXPECT_TRUE(rosbridge_from_json(file));
  file["version"] = 2;
  EXPECT_TRUE(rosbridge_from_json(file));
  file["version"] = 3;
  const auto newer = rosbridge_from_json(file);
  ASSERT_FALSE(newer);
  EXPECT_EQ(newer.error().code, ErrorCode::kUnsupportedFormat);
  EXPECT_NE(newer.error().message.find("versions 1 to 2"), std::string::npos) << newer.error().message;
}

TEST(RosbridgeFile, EachSensorOfARingHasATopicOfItsOwn) {
  RosbridgeFile file = sample_rosbridge();
  file.ranges = sample_ring(3);
  file.ranges[2].topic = file.ranges[0].topic;
  const auto read = rosbridge_from_json(rosbridge_to_json(file));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where, "rosbridge/ranges/2/topic");
}

}  // namespace
}  // namespace homeward::wire::rosbridge_json_test
