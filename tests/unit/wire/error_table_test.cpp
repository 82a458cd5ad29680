// SPDX-License-Identifier: Apache-2.0
#include "wire/error_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "wire/json_reader.hpp"
#include "wire/problem_json.hpp"

namespace homeward::wire::error_table_test {
namespace {

using ::testing::MatchesRegex;

TEST(ErrorTable, HasOneRowForEachCodeInOrder) {
  ASSERT_EQ(error_table().size(), static_cast<std::size_t>(ErrorCode::kInternal) + 1);
  for (std::size_t i = 0; i < error_table().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(error_table()[i].code), i);
    EXPECT_EQ(&error_row(static_cast<ErrorCode>(i)), &error_table()[i]);
  }
}

TEST(ErrorTable, NamesAreDifferentAndInSnakeCase) {
  std::set<std::string_view> names;
  std::set<std::string_view> titles;
  for (const ErrorRow& row : error_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(titles.insert(row.title).second) << row.title;
    EXPECT_THAT(std::string(row.name), MatchesRegex("[a-z]+(_[a-z]+)*"));
    EXPECT_FALSE(row.title.empty()) << row.name;
  }
}

TEST(ErrorTable, StatusesAndExitCodesAreThoseOfFailures) {
  for (const ErrorRow& row : error_table()) {
    EXPECT_GE(row.http_status, 400) << row.name;
    EXPECT_LE(row.http_status, 507) << row.name;
    EXPECT_NE(row.exit_code, 0) << row.name;
    EXPECT_LE(row.exit_code, 130) << row.name;
  }
  EXPECT_EQ(http_status(ErrorCode::kUnknownPlace), 404);
  EXPECT_EQ(http_status(ErrorCode::kStaleRevision), 412);
  EXPECT_EQ(exit_code(ErrorCode::kCancelled), 130);
}

TEST(ErrorTable, FindsARowByItsName) {
  for (const ErrorRow& row : error_table()) EXPECT_EQ(error_row(row.name), &row);
  EXPECT_EQ(error_row(std::string_view("tired")), nullptr);
  EXPECT_EQ(error_row(std::string_view("")), nullptr);
}

TEST(Problem, KeepsCodeMessageAndPlaceOfAnError) {
  for (const ErrorRow& row : error_table()) {
    const auto again = problem_from_json(problem_to_json(Error{row.code, "There is no place p9.", "maps/house"}));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->code, row.code);
    EXPECT_EQ(again->message, "There is no place p9.");
    EXPECT_EQ(again->where, "maps/house");
  }
}

TEST(Problem, MustNameOneErrorOnly) {
  auto value = problem_to_json(Error{ErrorCode::kLost, "Lost.", ""});
  value["type"] = "urn:homeward:problem:no_route";
  EXPECT_EQ(problem_from_json(value).error().where, "problem/type");
}

}  // namespace
}  // namespace homeward::wire::error_table_test
