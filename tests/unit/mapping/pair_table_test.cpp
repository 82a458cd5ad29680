// SPDX-License-Identifier: Apache-2.0
#include "mapping/pair_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace homeward::mapping::pair_table_test {
namespace {

TEST(PairTable, HoldsWhatWasSetInAnyOrder) {
  constexpr int kImages = 30;
  std::mt19937 random(4);
  for (int round = 0; round < 50; ++round) {
    PairTable table(kImages);
    std::map<std::pair<int, int>, int> expected;
    for (int i = 0; i < 8 * round; ++i) {
      const int a = static_cast<int>(random() % kImages);
      const int b = static_cast<int>(random() % kImages);
      if (a >= b) continue;
      PairRelation relation;
      relation.inliers = i + 1;  // set again: the last one counts
      relation.distance = static_cast<float>(i);
      table.set(a, b, relation);
      expected[{a, b}] = i + 1;
    }
    for (int a = 0; a < kImages; ++a) {
      std::vector<int> partners;
      for (int b = 0; b < kImages; ++b) {
        if (a == b) continue;
        const auto known = expected.find(std::minmax(a, b));
        ASSERT_EQ(table.relation(a, b).inliers, known == expected.end() ? 0 : known->second) << a << ", " << b;
        ASSERT_EQ(std::isinf(table.distance(a, b)), known == expected.end());
        if (known != expected.end()) partners.push_back(b);
      }
      ASSERT_EQ(std::vector<int>(table.partners(a).begin(), table.partners(a).end()), partners);
    }
  }
}

TEST(PairTable, ManyImagesTakeNoMemoryUntilPairsAreSet) {
  PairTable table(1'000'000);  // a table of all pairs would be 14 terabytes
  PairRelation relation;
  relation.inliers = 9;
  table.set(3, 999'999, relation);
  EXPECT_TRUE(table.relation(999'999, 3).verified());
  EXPECT_EQ(table.partners(3).front(), 999'999);
  EXPECT_TRUE(table.partners(4).empty());
}

}  // namespace
}  // namespace homeward::mapping::pair_table_test
