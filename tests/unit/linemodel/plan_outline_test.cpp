// SPDX-License-Identifier: Apache-2.0
#include "linemodel/plan_outline.hpp"

#include <gtest/gtest.h>

namespace homeward::linemodel::plan_outline_test {
namespace {

constexpr std::size_t kMany = 100;

PlanLine line(const Eigen::Vector3f& from_m, const Eigen::Vector3f& to_m) { return {from_m, to_m}; }

/// The twelve edges of a block, such as a wall with its thickness.
std::vector<PlanLine> block(const Eigen::Vector3f& least_m, const Eigen::Vector3f& most_m) {
  const auto corner = [&](int i) {
    return Eigen::Vector3f((i & 1) != 0 ? most_m.x() : least_m.x(), (i & 2) != 0 ? most_m.y() : least_m.y(),
                           (i & 4) != 0 ? most_m.z() : least_m.z());
  };
  std::vector<PlanLine> edges;
  for (int i = 0; i < 8; ++i) {
    for (const int axis : {1, 2, 4}) {
      if ((i & axis) == 0) edges.push_back(line(corner(i), corner(i | axis)));
    }
  }
  return edges;
}

TEST(Outline, ShowsTheFootprintOfAWallOnce) {
  const auto edges = block({0, 0, 0}, {4, 0.2F, 2.5F});
  ASSERT_EQ(edges.size(), 12U);
  const PlanOutline seen = outline(edges, {}, kMany);
  EXPECT_EQ(seen.total, 4U);
  ASSERT_EQ(seen.segments.size(), 4U);
  EXPECT_EQ(seen.segments[0].from_m, Eigen::Vector2f(0, 0));
  EXPECT_EQ(seen.segments[0].to_m, Eigen::Vector2f(4, 0));
}

TEST(Outline, TakesLinesDrawnTheOtherWayForTheSame) {
  const PlanOutline seen = outline(
      {line({0, 0, 0}, {3, 0, 0}), line({3, 0, 2}, {0, 0, 2}), line({0.001F, 0, 0}, {3, 0.001F, 0})}, {}, kMany);
  EXPECT_EQ(seen.segments.size(), 1U);
}

TEST(Outline, LeavesOutWhatStandsUpright) {
  EXPECT_EQ(outline({line({1, 1, 0}, {1, 1, 2.5F}), line({1, 1, 0}, {1.001F, 1, 2})}, {}, kMany).total, 0U);
}

TEST(Outline, ShowsAStoreyAlone) {
  auto edges = block({0, 0, 0}, {4, 4, 2.5F});
  const auto above = block({10, 0, 3}, {14, 4, 5.5F});
  edges.insert(edges.end(), above.begin(), above.end());
  const PlanOutline lower = outline(edges, {0.0F, 2.0F}, kMany);
  ASSERT_EQ(lower.segments.size(), 4U);
  for (const FlatSegment& segment : lower.segments) EXPECT_LT(segment.to_m.x(), 5.0F);
  EXPECT_EQ(outline(edges, {3.5F, 4.0F}, kMany).total, 0U) << "only upright edges pass there";
  EXPECT_EQ(outline(edges, {}, kMany).total, 8U);
}

TEST(Outline, KeepsTheLongestInTheirOrder) {
  const std::vector<PlanLine> lines = {line({0, 0, 0}, {1, 0, 0}), line({0, 1, 0}, {5, 1, 0}),
                                       line({0, 2, 0}, {2, 2, 0}), line({0, 3, 0}, {4, 3, 0})};
  const PlanOutline seen = outline(lines, {}, 2);
  EXPECT_EQ(seen.total, 4U);
  ASSERT_EQ(seen.segments.size(), 2U);
  EXPECT_EQ(seen.segments[0].to_m.x(), 5.0F);
  EXPECT_EQ(seen.segments[1].to_m.x(), 4.0F);
  EXPECT_EQ(outline({}, {}, 2).total, 0U);
}

}  // namespace
}  // namespace homeward::linemodel::plan_outline_test
