// SPDX-License-Identifier: Apache-2.0
#include "linemodel/visible_lines.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/shaded_room.hpp"

namespace homeward::linemodel {
namespace {

TEST(VisibleLines, HideNothingThatRaysReachAndShowNothingBehindWalls) {
  const Plan plan = two_rooms();
  const raycast::RayScene rays(plan.vertices_m, plan.triangles);
  VisibleLines visible(plan, 1.2, {});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> across(0.7, 3.3);
  std::uniform_real_distribution<double> along(1.0, 5.6);
  int shown = 0;
  int hidden = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d point_m(along(random) + (i % 2 == 0 ? 0.0 : 6.2), across(random));
    const Eigen::Vector3f eye_m(static_cast<float>(point_m.x()), static_cast<float>(point_m.y()), 1.2F);
    for (const PlanLine& line : visible.around(point_m)) {
      const Eigen::Vector3f middle_m = 0.5F * (line.from_m + line.to_m);
      const Eigen::Vector3f short_m = eye_m + 0.98F * (middle_m - eye_m);
      // A part of a line, its middle hidden by a thing between two parts, may still be joined over it: few are.
      rays.blocked(eye_m, short_m) ? ++hidden : ++shown;
    }
  }
  EXPECT_GT(shown, 3000);
  EXPECT_LT(hidden, shown / 100);
}

TEST(VisibleLines, NeverShowARoomThroughItsWall) {
  const Plan plan = two_rooms();
  VisibleLines visible(plan, 1.2, {});
  // From the corner of the first room the doorway at y = 2.6 to 3.6 shows a strip of the second at most.
  for (const PlanLine& line : visible.around({0.9, 3.5})) {
    const bool in_second = line.from_m.x() > 6.5F && line.to_m.x() > 6.5F;
    EXPECT_FALSE(in_second && line.from_m.y() < 0.6F && line.to_m.y() < 0.6F && line.from_m.x() < 9.6F)
        << line.from_m.transpose() << " to " << line.to_m.transpose();
  }
  for (const PlanLine& line : visible.around({3.0, 1.5})) {
    EXPECT_FALSE(line.from_m.x() > 10.0F && line.from_m.y() < 2.4F && line.to_m.y() < 2.4F) << "the far corner";
  }
}

TEST(VisibleLines, ShowAPlanOfLinesAloneAsIfItWereGlass) {
  Plan plan = two_rooms();
  plan.vertices_m.resize(0, 3);
  plan.triangles.resize(0, 3);
  VisibleLines visible(plan, 1.2, {});
  bool beyond = false;
  for (const PlanLine& line : visible.around({3.0, 1.5})) beyond = beyond || line.from_m.x() > 10.0F;
  EXPECT_TRUE(beyond);
}

TEST(VisibleLines, AreTheSameWhenLittleOfThemIsKept) {
  const Plan plan = two_rooms();
  VisibleLines all(plan, 1.2, {});
  VisibilityConfig config;
  config.most_kept_bytes = 1;
  VisibleLines few(plan, 1.2, config);
  std::size_t shown = 0;
  for (int again = 0; again < 2; ++again) {
    for (double x_m = 0.9; x_m < 12.0; x_m += 0.7) {
      const std::span<const PlanLine> a = all.around({x_m, 2.9});
      const std::span<const PlanLine> b = few.around({x_m, 2.9});
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_TRUE(a[i].from_m == b[i].from_m && a[i].to_m == b[i].to_m);
      }
      shown += a.size();
    }
  }
  EXPECT_GT(shown, 500U);
}

}  // namespace
}  // namespace homeward::linemodel
