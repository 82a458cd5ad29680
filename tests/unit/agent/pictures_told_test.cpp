// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/pictures_told.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace homeward::agent::pictures_told_test {
namespace {

/// What goes out within a time, asked every 50 ms.
std::vector<std::int64_t> told(PicturesTold& told, std::int64_t pictures, std::int64_t from_ms, std::int64_t to_ms) {
  std::vector<std::int64_t> all;
  for (std::int64_t now_ms = from_ms; now_ms < to_ms; now_ms += 50)
    if (const auto index = told.next(pictures, now_ms)) all.push_back(*index);
  return all;
}

using Pictures = std::vector<std::int64_t>;

TEST(PicturesTold, NothingGoesOutToWhoHasNotSaidWhatItHas) {
  PicturesTold pictures;
  EXPECT_TRUE(told(pictures, 10, 0, 10'000).empty());
}

TEST(PicturesTold, FewAreUnderWayAtATimeAndTheyLeaveSomeWhileApart) {
  PicturesTold pictures;
  pictures.heard(0, 0);
  EXPECT_EQ(told(pictures, 10, 0, 500), (Pictures{0, 1}));
  EXPECT_EQ(told(pictures, 10, 500, 2900), (Pictures{2, 3}));
  pictures.heard(3, 2900);
  EXPECT_EQ(told(pictures, 10, 2900, 5000), (Pictures{4, 5, 6}));
}

TEST(PicturesTold, WhatTheOtherHasIsNotToldAndWhatThereIsNotNeither) {
  PicturesTold pictures;
  pictures.heard(7, 0);
  EXPECT_EQ(told(pictures, 9, 0, 2000), (Pictures{7, 8}));
  pictures.heard(9, 2000);
  EXPECT_TRUE(told(pictures, 9, 2000, 20'000).empty());
  EXPECT_EQ(told(pictures, 10, 20'000, 21'000), Pictures{9});
}

TEST(PicturesTold, WhatWasLostIsToldAgainFromWhereTheOtherHasGotTo) {
  PicturesTold pictures;
  pictures.heard(0, 0);
  EXPECT_EQ(told(pictures, 4, 0, 1000), (Pictures{0, 1, 2, 3}));
  pictures.heard(2, 1000);  // the third was lost
  pictures.heard(2, 1500);
  pictures.heard(2, 2000);
  EXPECT_TRUE(told(pictures, 4, 2000, 4000).empty()) << "it may still be under way";
  EXPECT_EQ(told(pictures, 4, 4000, 6000), (Pictures{2, 3}));
}

TEST(PicturesTold, ToWhoBeginsAnewAllIsToldAtOnce) {
  PicturesTold pictures;
  pictures.heard(6, 0);
  EXPECT_EQ(told(pictures, 8, 0, 1000), (Pictures{6, 7}));
  pictures.heard(0, 1000);
  EXPECT_EQ(told(pictures, 8, 1000, 2000), (Pictures{0, 1, 2, 3}));
}

TEST(PicturesTold, WhoSaysThatItHasMoreThanThereIsIsToldNothing) {
  PicturesTold pictures;
  pictures.heard(90'000, 0);
  EXPECT_TRUE(told(pictures, 8, 0, 10'000).empty());
}

}  // namespace
}  // namespace homeward::agent::pictures_told_test
