// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "wire/json_reader.hpp"
#include "wire/problem_json.hpp"
#include "wire/tour_json.hpp"

namespace homeward::wire::json_text_test {
namespace {

/// Whether the error can go out as a problem document: all its text must be UTF-8.
void expect_tellable(const Error& error) { EXPECT_NO_THROW(problem_to_json(error).dump()) << error.message; }

TEST(JsonText, AnErrorAboutBrokenTextCanBeTold) {
  for (const char* text :
       {"\"\xFF\"", "{\"a\xE2\x82\":1}", "{\"a\":\"\xED\xA0\x80\"}", "\xFE\xFE", "[1,", "{\"\x01\":1}"}) {
    const auto parsed = parse_json(text, "body");
    ASSERT_FALSE(parsed);
    expect_tellable(parsed.error());
  }
}

TEST(JsonText, AnUnknownKeyIsShownShortAndWhole) {
  std::string key = std::string(63, 'k') + "\xE2\x82\xAC and more";  // a character across the cut
  const auto marks = marks_from_json(nlohmann::json{{"marks", nlohmann::json::array()}, {key, 1}});
  ASSERT_FALSE(marks);
  EXPECT_LT(marks.error().message.size(), 100U);
  expect_tellable(marks.error());
}

TEST(JsonText, AFormatOfAnotherKindIsShown) {
  const nlohmann::json value{{"format", "homeward-\xE2\x82\xAC"}, {"version", nlohmann::json::array({1, 2})}};
  ObjectReader reader(value, "file");
  reader.format("homeward-map", 1);
  const Status status = reader.finish();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kUnsupportedFormat);
  expect_tellable(status.error());
}

TEST(JsonText, KnowsUtf8) {
  for (const char* right :
       {"", "plain", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\xA6\xBD", "\xEF\xBF\xBD", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(is_utf8(right)) << right;
  }
  for (const char* wrong : {"\x80", "\xC3", "\xC1\x81", "\xE0\x80\x80", "\xED\xBF\xBF", "\xF0\x80\x80\x80",
                            "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "ok\xE2\x82", "\xE2\x28\xA1"}) {
    EXPECT_FALSE(is_utf8(wrong)) << wrong;
  }
}

TEST(Marks, RefuseTheSamePictureTwiceAndEmptyLabels) {
  const auto where = [](const char* text) { return parse_marks(text, "tour.json").error().where; };
  EXPECT_EQ(where(R"({"marks":[{"image":"a.jpg","label":"x"},{"image":"a.jpg","label":"y"}]})"),
            "tour.json/marks/1/image");
  EXPECT_EQ(where(R"({"marks":[{"image":"a.jpg","label":""}]})"), "tour.json/marks/0/label");
  EXPECT_EQ(where(R"({"marks":[{"label":"x"}]})"), "tour.json/marks/0/image");
  const auto marks = parse_marks(R"({"marks":[{"image":"a.jpg","label":"x"}]})", "tour.json");
  ASSERT_TRUE(marks);
  EXPECT_EQ(marks->front().label, "x");
}

}  // namespace
}  // namespace homeward::wire::json_text_test
