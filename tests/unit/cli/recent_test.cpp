// SPDX-License-Identifier: Apache-2.0
#include "cli/recent.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace homeward::cli::recent_test {
namespace {

/// Makes texts of file names and notes each time it does.
struct Maker {
  std::vector<std::string> made;

  Result<std::string> operator()(const std::filesystem::path& file) {
    if (file == "broken") return fail(ErrorCode::kCorruptFile, "It is broken.", file.string());
    made.push_back(file.string());
    return "made of " + file.string();
  }
};

TEST(Recent, MakesOfEachFileOnceAsLongAsItIsKept) {
  Recent<std::string> recent(2);
  Maker maker;
  for (const char* file : {"a", "b", "a", "b", "a"}) {
    const auto made = recent.get(file, [&](const auto& path) { return maker(path); });
    ASSERT_TRUE(made);
    EXPECT_EQ(**made, "made of " + std::string(file));
  }
  EXPECT_EQ(maker.made, (std::vector<std::string>{"a", "b"}));
}

TEST(Recent, ForgetsWhatWasNotAskedForLongest) {
  Recent<std::string> recent(2);
  Maker maker;
  for (const char* file : {"a", "b", "a", "c", "a", "b"})
    ASSERT_TRUE(recent.get(file, [&](const auto& path) { return maker(path); }));
  // c took the place of b, then b that of c; a was asked for between them.
  EXPECT_EQ(maker.made, (std::vector<std::string>{"a", "b", "c", "b"}));
}

TEST(Recent, WhatIsForgottenLivesAsLongAsSomebodyHoldsIt) {
  Recent<std::string> recent(1);
  Maker maker;
  const auto first = recent.get("a", [&](const auto& path) { return maker(path); });
  ASSERT_TRUE(recent.get("b", [&](const auto& path) { return maker(path); }));
  EXPECT_EQ(**first, "made of a");
}

TEST(Recent, WhatCannotBeMadeIsToldAndNotKept) {
  Recent<std::string> recent(2);
  Maker maker;
  for (int time = 0; time < 2; ++time) {
    const auto none = recent.get("broken", [&](const auto& path) { return maker(path); });
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::kCorruptFile);
  }
  ASSERT_TRUE(recent.get("a", [&](const auto& path) { return maker(path); }));
  EXPECT_EQ(maker.made, std::vector<std::string>{"a"});
}

}  // namespace
}  // namespace homeward::cli::recent_test
