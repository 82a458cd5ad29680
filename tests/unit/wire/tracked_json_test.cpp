// SPDX-License-Identifier: Apache-2.0
#include "wire/tracked_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace homeward::wire::tracked_json_test {
namespace {

using nlohmann::json;

TEST(TrackedJson, APoseComesBackAsItWasWritten) {
  TrackedView view;
  view.image = "00012.jpg";
  view.pose = {1.25, -3.5, 0.75};
  view.spread_m = 0.04;
  const auto known = tracked_pose_from_json(tracked_to_json(view), "file: line 1");
  ASSERT_TRUE(known) << known.error().message;
  EXPECT_EQ(known->image, "00012.jpg");
  ASSERT_TRUE(known->pose);
  EXPECT_EQ(known->pose->x_m, 1.25);
  EXPECT_EQ(known->pose->y_m, -3.5);
  EXPECT_EQ(known->pose->theta_rad, 0.75);
  EXPECT_EQ(known->spread_m, 0.04);
}

TEST(TrackedJson, WhatIsLostHasNoPose) {
  TrackedView view;
  view.image = "00012.jpg";
  view.lost = "searching";
  const auto lost = tracked_pose_from_json(tracked_to_json(view), "file: line 1");
  ASSERT_TRUE(lost) << lost.error().message;
  EXPECT_FALSE(lost->pose);
}

TEST(TrackedJson, ALineThatIsNoneSaysWhere) {
  const json good = {{"image", "a.jpg"}, {"lost", false},    {"x_m", 1.0},
                     {"y_m", 2.0},       {"theta_rad", 0.0}, {"spread_m", 0.1}};
  ASSERT_TRUE(tracked_pose_from_json(good, "at"));
  for (const char* key : {"image", "lost", "x_m", "theta_rad", "spread_m"}) {
    json without = good;
    without.erase(key);
    const auto refused = tracked_pose_from_json(without, "at");
    ASSERT_FALSE(refused) << key;
    EXPECT_EQ(refused.error().where, "at/" + std::string(key));
  }
  json wide = good;
  wide["spread_m"] = -1.0;
  EXPECT_FALSE(tracked_pose_from_json(wide, "at"));
  EXPECT_EQ(tracked_pose_from_json(json::array(), "at").error().where, "at");
}

}  // namespace
}  // namespace homeward::wire::tracked_json_test
