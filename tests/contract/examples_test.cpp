// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "contract/codecs.hpp"
#include "contract/schema_library.hpp"
#include "support/folders.hpp"

namespace homeward::testing::examples_test {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

class EverySchema : public ::testing::TestWithParam<std::string> {};

TEST_P(EverySchema, HasExamplesOfBothKinds) {
  EXPECT_GE(SchemaLibrary::examples(GetParam(), "valid").size(), 2U);
  EXPECT_GE(SchemaLibrary::examples(GetParam(), "invalid").size(), 3U);
}

TEST_P(EverySchema, AcceptsItsValidExamples) {
  for (const Example& example : SchemaLibrary::examples(GetParam(), "valid")) {
    EXPECT_THAT(schemas().problems(GetParam(), example.value), IsEmpty()) << example.name;
  }
}

TEST_P(EverySchema, RefusesItsInvalidExamples) {
  for (const Example& example : SchemaLibrary::examples(GetParam(), "invalid")) {
    EXPECT_THAT(schemas().problems(GetParam(), example.value), Not(IsEmpty())) << example.name;
  }
}

TEST_P(EverySchema, SaysForEachObjectThatOtherKeysAreWrong) {
  // An object that lists properties but lets others through would hide misspelt keys.
  const std::function<void(const nlohmann::json&, const std::string&)> check = [&](const nlohmann::json& part,
                                                                                   const std::string& path) {
    if (part.is_object() && part.contains("properties") && part["properties"].is_object()) {
      EXPECT_EQ(part.value("additionalProperties", true), false) << GetParam() << path;
    }
    if (!part.is_structured()) return;
    for (const auto& [key, inner] : part.items()) check(inner, path + "/" + key);
  };
  check(schemas().document(GetParam()), "");
}

INSTANTIATE_TEST_SUITE_P(Proto, EverySchema, ::testing::ValuesIn(schemas().names()),
                         [](const auto& instance) { return instance.param; });

class EveryCodec : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryCodec, GivesBackItsValidExamples) {
  for (const Example& example : SchemaLibrary::examples(GetParam(), "valid")) {
    const Result<nlohmann::json> once = codecs().at(GetParam())(example.value);
    ASSERT_TRUE(once) << example.name << ": " << once.error().message << " at " << once.error().where;
    EXPECT_TRUE(covers(*once, example.value)) << example.name << " became " << once->dump();
    EXPECT_THAT(schemas().problems(GetParam(), *once), IsEmpty()) << example.name;
    const Result<nlohmann::json> twice = codecs().at(GetParam())(*once);
    ASSERT_TRUE(twice) << example.name << ": " << twice.error().message;
    EXPECT_EQ(*twice, *once) << example.name;
  }
}

TEST_P(EveryCodec, RefusesInvalidExamplesAndSaysWhere) {
  for (const Example& example : SchemaLibrary::examples(GetParam(), "invalid")) {
    const Result<nlohmann::json> read = codecs().at(GetParam())(example.value);
    ASSERT_FALSE(read) << example.name << " was read as " << read->dump();
    EXPECT_THAT(read.error().where, Not(IsEmpty())) << example.name;
    EXPECT_THAT(read.error().message, Not(IsEmpty())) << example.name;
  }
}

std::vector<std::string> codec_names() {
  std::vector<std::string> names;
  for (const auto& [name, recode] : codecs()) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Wire, EveryCodec, ::testing::ValuesIn(codec_names()),
                         [](const auto& instance) { return instance.param; });

TEST(SharedData, FitsTheSchemas) {
  const std::filesystem::path data = shared_folder() / "data";
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << data << " is not there";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    const std::string name = entry.path().filename().string();
    if (name != "camera.json" && name != "world.json" && name != "tour.json") continue;
    std::ifstream stream(entry.path());
    const nlohmann::json value = nlohmann::json::parse(stream);
    const std::string schema = entry.path().stem().string();
    EXPECT_THAT(schemas().problems(schema, value), IsEmpty()) << entry.path();
    EXPECT_TRUE(codecs().at(schema)(value)) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

TEST(SchemaLibrary, NoticesAnExampleThatBreaksItsSchema) {
  nlohmann::json belief = SchemaLibrary::examples("belief", "valid").front().value;
  belief["probability"] = "high";
  EXPECT_THAT(schemas().problems("belief", belief), Not(IsEmpty()));
}

}  // namespace
}  // namespace homeward::testing::examples_test
