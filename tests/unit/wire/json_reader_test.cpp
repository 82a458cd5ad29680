// SPDX-License-Identifier: Apache-2.0
#include "wire/json_reader.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace homeward::wire::json_reader_test {
namespace {

using nlohmann::json;

/// Reads one key in one way and expects the error to name it.
void refused(const json& value, const std::function<void(ObjectReader&)>& read, const std::string& where,
             ErrorCode code = ErrorCode::kInvalidInput) {
  ObjectReader reader(value, "body");
  read(reader);
  const Status status = reader.finish();
  ASSERT_FALSE(status) << value.dump();
  EXPECT_EQ(status.error().where, where);
  EXPECT_EQ(status.error().code, code);
  EXPECT_FALSE(status.error().message.empty());
}

TEST(JsonReader, ReadsEveryKind) {
  const json value = {{"format", "homeward-x"},
                      {"version", 3},
                      {"n", 1.5},
                      {"i", -7},
                      {"b", true},
                      {"t", "text"},
                      {"c", "red"},
                      {"v", {1, 2.5}},
                      {"a", {json::object()}},
                      {"o", nullptr},
                      {"big", 9007199254740993LL}};
  ObjectReader reader(value, "body");
  reader.format("homeward-x", 3);
  EXPECT_EQ(reader.number("n"), 1.5);
  EXPECT_EQ(reader.integer("i", -10, 10), -7);
  EXPECT_TRUE(reader.boolean("b"));
  EXPECT_EQ(reader.text("t"), "text");
  EXPECT_EQ(reader.choice("c", {"blue", "red"}), "red");
  EXPECT_EQ(reader.numbers("v", 2), (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(reader.array("a").size(), 1U);
  EXPECT_FALSE(reader.has("o"));
  EXPECT_FALSE(reader.has("absent"));
  EXPECT_FALSE(reader.optional_number("absent"));
  EXPECT_FALSE(reader.optional_text("o"));
  EXPECT_EQ(reader.optional_number("n"), 1.5);
  EXPECT_EQ(reader.integer("big", 0, INT64_MAX), 9007199254740993LL);  // no detour by floating point
  EXPECT_TRUE(reader.finish());
}

TEST(JsonReader, WrongKindsAreNamed) {
  const std::vector<std::pair<std::string, std::function<void(ObjectReader&)>>> readers = {
      {"number", [](ObjectReader& r) { r.number("k"); }},
      {"integer", [](ObjectReader& r) { r.integer("k", 0, 10); }},
      {"boolean", [](ObjectReader& r) { r.boolean("k"); }},
      {"text", [](ObjectReader& r) { r.text("k"); }},
      {"choice", [](ObjectReader& r) { r.choice("k", {"x"}); }},
      {"numbers", [](ObjectReader& r) { r.numbers("k", 2); }},
      {"array", [](ObjectReader& r) { r.array("k", 2); }},
  };
  const std::vector<std::pair<json, std::string>> values = {
      {5, "number integer"}, {true, "boolean"}, {"x", "text choice"}, {json::array({1, 2}), "numbers array"},
      {json::object(), ""},  {nullptr, ""}};
  for (const auto& [kind, read] : readers) {
    refused(json::object(), read, "body/k");  // missing
    for (const auto& [value, fits] : values) {
      if ((" " + fits + " ").find(" " + kind + " ") == std::string::npos) refused({{"k", value}}, read, "body/k");
    }
  }
}

TEST(JsonReader, LimitsHold) {
  refused(
      {{"k", 11}}, [](auto& r) { r.integer("k", 0, 10); }, "body/k");
  refused(
      {{"k", -1}}, [](auto& r) { r.integer("k", 0, 10); }, "body/k");
  refused(
      {{"k", 1.0}}, [](auto& r) { r.integer("k", 0, 10); }, "body/k");
  refused(
      {{"k", UINT64_MAX}}, [](auto& r) { r.integer("k", INT64_MIN, INT64_MAX); }, "body/k");
  refused(
      {{"k", 1.01}}, [](auto& r) { r.number("k", 0.0, 1.0); }, "body/k");
  refused(
      {{"k", std::numeric_limits<double>::infinity()}}, [](auto& r) { r.number("k"); }, "body/k");
  refused(
      {{"k", std::numeric_limits<double>::quiet_NaN()}}, [](auto& r) { r.number("k", 0.0, 1.0); }, "body/k");
  refused(
      {{"k", "four"}}, [](auto& r) { r.text("k", 3); }, "body/k");
  refused(
      {{"k", "green"}},
      [](auto& r) {
        r.choice("k", {"blue", "red"});
      },
      "body/k");
  refused(
      {{"k", {1, 2, 3}}}, [](auto& r) { r.numbers("k", 2); }, "body/k");
  refused(
      {{"k", {1, "2"}}}, [](auto& r) { r.numbers("k", 2); }, "body/k/1");
  refused(
      {{"k", {1, 2, 3}}}, [](auto& r) { r.array("k", 2); }, "body/k");
  refused(
      {{"k", "text"}}, [](auto& r) { r.optional_number("k"); }, "body/k");
  refused(
      {{"k", 1}}, [](auto& r) { r.optional_text("k"); }, "body/k");
}

TEST(JsonReader, UnknownKeysAndOtherThingsThanObjectsAreRefused) {
  refused(
      {{"known", 1}, {"typo", 2}}, [](auto& r) { r.number("known"); }, "body/typo");
  for (const json& value : {json(1), json("x"), json::array(), json(nullptr)}) {
    refused(
        value, [](auto& r) { r.number("k"); }, "body");
  }
}

TEST(JsonReader, TheFirstProblemIsTheOneTold) {
  refused(
      {{"surplus", 1}},
      [](auto& r) {
        r.number("first");
        r.number("second");
      },
      "body/first");
  refused(
      {{"k", 1}},
      [](auto& r) {
        r.number("k");
        r.problem("k", "Too little.", ErrorCode::kConflict);
        r.problem("j", "Too much.");
      },
      "body/k", ErrorCode::kConflict);
}

TEST(JsonReader, TakesOverTheErrorOfAPart) {
  refused(
      {{"k", 1}},
      [](auto& r) {
        r.number("k");
        EXPECT_EQ(r.take(Result<int>(5)), 5);
        EXPECT_EQ(r.take(Result<int>(fail(ErrorCode::kNotFound, "Gone.", "body/k/part"))), 0);
      },
      "body/k/part", ErrorCode::kNotFound);
}

TEST(JsonReader, FormatAndVersionMustFit) {
  const auto read = [](ObjectReader& r) { r.format("homeward-map", 1); };
  refused({{"format", "homeward-tour"}, {"version", 1}}, read, "body/format", ErrorCode::kUnsupportedFormat);
  refused({{"format", "homeward-map"}, {"version", 2}}, read, "body/version", ErrorCode::kUnsupportedFormat);
  refused({{"format", "homeward-map"}, {"version", "1"}}, read, "body/version", ErrorCode::kUnsupportedFormat);
}

TEST(ParseJson, SizeAndDepthAreLimited) {
  EXPECT_TRUE(parse_json("[[1]]", "body", 5, 2));
  EXPECT_EQ(parse_json("[[1]]", "body", 4).error().code, ErrorCode::kTooLarge);
  EXPECT_EQ(parse_json("[[[[1]]]]", "body", 100, 2).error().code, ErrorCode::kInvalidInput);
  const std::string deep(100000, '[');
  EXPECT_EQ(parse_json(deep, "body").error().where, "body");
  EXPECT_FALSE(parse_json("{\"a\":1}x", "body"));
}

}  // namespace
}  // namespace homeward::wire::json_reader_test
