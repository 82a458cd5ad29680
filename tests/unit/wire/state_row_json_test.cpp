// SPDX-License-Identifier: Apache-2.0
#include "wire/state_row_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace homeward::wire {
namespace {

using nlohmann::json;

json next_place() {
  SurveyRow row;
  row.state = SurveyState::kNextPlace;
  row.picture = 71;
  row.pose = {1.0 / 3.0, -2.0, 0.5};
  row.place_m = {3.5, 1.0 / 7.0};
  row.gain_m2 = 1.25;
  row.cost_m = 0.1;
  return state_row_to_json(row);
}

/// What is wrong, and where, with a row in which one value is another.
Error trouble(json row, const char* key, const json& value) {
  row[key] = value;
  const auto read = state_row_from_json(row, "row");
  return read ? Error{ErrorCode::kInternal, "There is no trouble.", ""} : read.error();
}

TEST(StateRowJson, GivesNumbersBackAsTheyWere) {
  const auto read = state_row_from_json(json::parse(next_place().dump()));
  ASSERT_TRUE(read) << read.error().message;
  const auto& row = std::get<SurveyRow>(*read);
  EXPECT_EQ(row.pose.x_m, 1.0 / 3.0);
  EXPECT_EQ(row.place_m->y(), 1.0 / 7.0);
  EXPECT_EQ(row.cost_m, 0.1);
  EXPECT_FALSE(row.known);
  EXPECT_EQ(state_name(*read), "next_place");
}

TEST(StateRowJson, NamesWhatCannotBe) {
  for (const auto& [key, value] : {std::pair<const char*, json>{"state", "exploration"},
                                   {"picture", -1},
                                   {"picture", 0.5},
                                   {"gain_m2", "much"},
                                   {"end", "tired"},
                                   {"place", json::array({1, 2})}}) {
    const Error error = trouble(next_place(), key, value);
    EXPECT_EQ(error.code, ErrorCode::kInvalidInput) << key << " " << value;
    EXPECT_THAT(error.where, ::testing::HasSubstr(key)) << value;
  }
  const json thesis = state_row_to_json(ThesisRow{ThesisState::kHoming, {3, 1}, 271.613, -1.5, {0.25}});
  EXPECT_EQ(trouble(thesis, "nodes", {1, "two"}).where, "row/nodes");
  EXPECT_EQ(trouble(thesis, "left_rad", {90.0}).where, "row/left_rad");
  EXPECT_EQ(trouble(thesis, "method", "luck").where, "row/method");
  EXPECT_FALSE(state_row_from_json(json::array()));
}

TEST(StateRowJson, WhatIsNoNumberIsNotKnown) {
  SurveyRow row;
  row.cost_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(state_row_to_json(row)["cost_m"].is_null());
}

}  // namespace
}  // namespace homeward::wire
