// SPDX-License-Identifier: Apache-2.0
#include "matching/nearest_columns.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/vector_targets.hpp"

namespace homeward::matching::nearest_columns_test {
namespace {

using testing::for_each_vector_target;

struct Columns {
  ScaledColumns scaled;
  ColumnHeights heights;

  Columns(int count, unsigned seed) : scaled(features::kColumnInvariants, count) {
    std::mt19937 random(seed);
    const auto number = [&](unsigned levels) { return static_cast<float>(random() % levels) / 8.0F; };
    heights = {Eigen::ArrayXf(count), Eigen::ArrayXf(count), {}};
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < features::kColumnInvariants; ++k) scaled(k, i) = number(8);
      heights.bottom[i] = number(16) - 1.0F;
      heights.top[i] = heights.bottom[i] + number(16);
    }
    heights.norm2 = heights.top.square() + heights.bottom.square();
  }
  [[nodiscard]] AskedColumn ask(int i) const {
    return {i, scaled.col(i), heights.top[i], heights.bottom[i], heights.norm2[i]};
  }
};

float distance2(const AskedColumn& asked, const Columns& targets, int j, float slack2) {
  const float top = targets.heights.top[j];
  const float bottom = targets.heights.bottom[j];
  const float across = asked.top * bottom - asked.bottom * top;
  const bool fits = across * across <= slack2 * (asked.norm2 + targets.heights.norm2[j]) &&
                    asked.top * top + asked.bottom * bottom >= 0.0F;
  if (!fits) return NearestColumn::kNone;
  float sum = 0.0F;
  for (int k = 0; k < features::kColumnInvariants; ++k) {
    const float difference = targets.scaled(k, j) - asked.scaled[k];
    sum += difference * difference;
  }
  return sum;
}

void take(NearestColumn& nearest, int index, float distance) {
  if (distance < nearest.best) {
    nearest.second = nearest.best;
    nearest.best = distance;
    nearest.index = index;
  } else {
    nearest.second = std::min(nearest.second, distance);
  }
}

void agree(const Columns& current, const Columns& target, float slack2) {
  const auto count = static_cast<int>(target.scaled.cols());
  TargetColumns targets(target.scaled, target.heights);
  std::vector<NearestColumn> of_target(static_cast<std::size_t>(count));
  for (int i = 0; i < current.scaled.cols(); ++i) {
    const AskedColumn asked = current.ask(i);
    NearestColumn expected;
    for (int j = 0; j < count; ++j) {
      const float distance = distance2(asked, target, j, slack2);
      take(expected, j, distance);
      take(of_target[static_cast<std::size_t>(j)], i, distance);
    }
    constexpr float kBound2 = 1e6F;
    const NearestColumn found = targets.compare(asked, slack2, kBound2);
    EXPECT_EQ(found.index, expected.index);
    EXPECT_EQ(found.best, expected.best);
    EXPECT_EQ(found.second, expected.second);
  }
  for (int j = 0; j < count; ++j) {
    EXPECT_EQ(targets.nearest_to(j), of_target[static_cast<std::size_t>(j)].index);
    EXPECT_EQ(targets.second_to(j), of_target[static_cast<std::size_t>(j)].second);
  }
}

TEST(NearestColumns, AreThoseOfPlainLoopsOnEveryProcessor) {
  for (const int current : {1, 5, 30}) {
    for (const int target : {1, 2, 7, 8, 9, 16, 33, 100}) {
      for (const float slack2 : {0.0F, 0.001F, 0.1F, 100.0F}) {
        for_each_vector_target([&] {
          SCOPED_TRACE(::testing::Message() << current << " with " << target << ", slack " << slack2);
          agree(Columns(current, 1), Columns(target, 2), slack2);
        });
      }
    }
  }
}

TEST(NearestColumns, FartherThanTheBoundIsNone) {
  const Columns columns(20, 3);
  TargetColumns targets(columns.scaled, columns.heights);
  AskedColumn asked = columns.ask(4);
  asked.scaled.array() += 10.0F;
  const float bound2 = targets.compare(asked, 1e3F, 1e6F).best;
  EXPECT_NE(targets.compare(asked, 1e3F, bound2).index, -1);
  EXPECT_EQ(targets.compare(asked, 1e3F, 0.99F * bound2).index, -1);
}

}  // namespace
}  // namespace homeward::matching::nearest_columns_test
