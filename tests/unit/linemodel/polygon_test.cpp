// SPDX-License-Identifier: Apache-2.0
#include "linemodel/polygon.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace homeward::linemodel::polygon_test {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

double area_of(const Corners& corners, const std::vector<std::array<std::size_t, 3>>& triangles) {
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) area += 0.5 * (corners[b] - corners[a]).cross(corners[c] - corners[a]).norm();
  return area;
}

/// A comb: a bar with teeth, 2 * teeth + 2 corners, along a slope.
Corners comb(int teeth) {
  Corners corners = {{0.0, 0.0, 0.0}};
  for (int tooth = 0; tooth < teeth; ++tooth) {
    corners.emplace_back(tooth + 0.5, 2.0, tooth + 0.5);
    corners.emplace_back(tooth + 1.0, 1.0, tooth + 1.0);
  }
  corners.emplace_back(teeth + 0.5, 0.0, teeth + 0.5);
  return corners;
}

TEST(Polygon, ConvexOneIsAFan) {
  Corners ring;
  for (int i = 0; i < 300; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / 300.0;
    ring.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 3.0);
  }
  const auto triangles = triangles_of_polygon(ring);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), 298U);
  EXPECT_NEAR(area_of(ring, *triangles), std::numbers::pi, 1e-3);
}

TEST(Polygon, ConcaveOneIsCoveredAndNoMore) {
  const Corners ell = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  // From either side and from any corner on.
  for (std::size_t begin = 0; begin < ell.size(); ++begin) {
    Corners turned = ell;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(begin), turned.end());
    for (int side = 0; side < 2; ++side, std::reverse(turned.begin(), turned.end())) {
      const auto triangles = triangles_of_polygon(turned);
      ASSERT_TRUE(triangles);
      EXPECT_EQ(triangles->size(), 4U);
      EXPECT_NEAR(area_of(turned, *triangles), 3.0, 1e-9) << begin << " " << side;
    }
  }
  const Corners toothed = comb(40);
  const auto triangles = triangles_of_polygon(toothed);
  ASSERT_TRUE(triangles);
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < toothed.size(); ++i) twice += toothed[i].cross(toothed[i + 1]);
  EXPECT_NEAR(area_of(toothed, *triangles), 0.5 * twice.norm(), 1e-6);
}

TEST(Polygon, WithoutAreaIsNothing) {
  EXPECT_TRUE(triangles_of_polygon({})->empty());
  EXPECT_TRUE(triangles_of_polygon(Corners{{0, 0, 0}, {1, 0, 0}})->empty());
  EXPECT_TRUE(triangles_of_polygon(Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}})->empty());
}

TEST(Polygon, ConcaveOneOfTooManyCornersIsRefused) { EXPECT_FALSE(triangles_of_polygon(comb(60))); }

TEST(Polygon, ThatCrossesItselfEndsAllTheSame) {
  const Corners bow = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 3, 0}};
  const auto triangles = triangles_of_polygon(bow);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), 2U);
}

}  // namespace
}  // namespace homeward::linemodel::polygon_test
