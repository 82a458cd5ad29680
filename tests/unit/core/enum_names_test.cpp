// SPDX-License-Identifier: Apache-2.0
#include "core/enum_names.hpp"

#include <gtest/gtest.h>

namespace homeward::enum_names_test {
namespace {

enum class Colour { kRed, kGreen };

constexpr EnumNames<Colour, 2> kColours({"red", "green"});

TEST(EnumNames, LeadBothWays) {
  for (const Colour colour : {Colour::kRed, Colour::kGreen}) {
    EXPECT_EQ(kColours.find(kColours.name(colour)), colour);
  }
  EXPECT_EQ(kColours.name(Colour::kGreen), "green");
  EXPECT_EQ(kColours.all().size(), 2U);
}

TEST(EnumNames, KnowNoOtherTexts) {
  for (const char* text : {"", "Red", "red ", "blue"}) EXPECT_FALSE(kColours.find(text)) << text;
}

}  // namespace
}  // namespace homeward::enum_names_test
