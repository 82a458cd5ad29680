// SPDX-License-Identifier: Apache-2.0
#include "linemodel/feature_edges.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/generate/worlds.hpp"
#include "support/mesh_of_boxes.hpp"

namespace homeward::linemodel::feature_edges_test {
namespace {

std::vector<PlanLine> lines_of(const MeshOfBoxes& mesh, const FeatureEdgesConfig& config = {}) {
  return feature_edges(mesh.vertices_m(), mesh.triangles(), config);
}

float length_m(const std::vector<PlanLine>& lines) {
  float sum_m = 0.0F;
  for (const PlanLine& line : lines) sum_m += (line.to_m - line.from_m).norm();
  return sum_m;
}

/// How much of the stretch from `a` to `b` is drawn.
float drawn_share(const std::vector<PlanLine>& lines, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  constexpr int kPoints = 50;
  int drawn = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3f point_m = a + (b - a) * ((static_cast<float>(i) + 0.5F) / kPoints);
    for (const PlanLine& line : lines) {
      const Eigen::Vector3f way_m = line.to_m - line.from_m;
      const float share = std::clamp((point_m - line.from_m).dot(way_m) / way_m.squaredNorm(), 0.0F, 1.0F);
      if ((line.from_m + share * way_m - point_m).norm() < 0.035F) {
        ++drawn;
        break;
      }
    }
  }
  return static_cast<float>(drawn) / kPoints;
}

TEST(FeatureEdges, OfABoxAreItsTwelve) {
  MeshOfBoxes mesh;
  mesh.box({0, 0, 0}, {1, 2, 3});
  const auto lines = lines_of(mesh);
  EXPECT_EQ(lines.size(), 12U);
  EXPECT_NEAR(length_m(lines), 24.0F, 1e-4F);
}

TEST(FeatureEdges, OfNothingAreNone) { EXPECT_TRUE(lines_of({}).empty()); }

TEST(FeatureEdges, OfBoxesSideBySideHaveNoSeam) {
  MeshOfBoxes mesh;
  mesh.box({0, 0, 0}, {1, 1, 2});
  mesh.box({1, 0, 0}, {2.5F, 1, 2});
  const auto lines = lines_of(mesh);
  EXPECT_EQ(lines.size(), 12U) << "those of one box";
  EXPECT_NEAR(length_m(lines), 4.0F * (2.5F + 1.0F + 2.0F), 1e-3F);
}

TEST(FeatureEdges, OfALowBoxBesideAHighOneShowTheStep) {
  MeshOfBoxes mesh;
  mesh.box({0, 0, 0}, {1, 1, 2});
  mesh.box({1, 0, 0}, {2, 1, 1});
  const auto lines = lines_of(mesh);
  EXPECT_GT(drawn_share(lines, {1, 0, 1}, {1, 1, 1}), 0.95F) << "where the low one's top meets the high one";
  EXPECT_GT(drawn_share(lines, {1, 0, 1}, {1, 0, 2}), 0.95F) << "above it";
  EXPECT_LT(drawn_share(lines, {1, 0, 0.05F}, {1, 0, 0.95F}), 0.05F) << "the seam below";
}

TEST(FeatureEdges, InsideOfSolidsAreLeftOut) {
  MeshOfBoxes mesh;
  mesh.box({0, 0, 0}, {4, 0.3F, 2.5F});
  mesh.box({1, -1, 0.5F}, {2, 0.2F, 1});  // a board whose end is in the wall
  const auto lines = lines_of(mesh);
  EXPECT_LT(drawn_share(lines, {1, 0.2F, 0.5F}, {2, 0.2F, 0.5F}), 0.01F);
  EXPECT_GT(drawn_share(lines, {1, -1, 0.5F}, {2, -1, 0.5F}), 0.95F);
  EXPECT_GT(drawn_share(lines, {1, -1, 1}, {1, 0, 1}), 0.95F);
}

TEST(FeatureEdges, AreAlsoWhereSurfacesGoThroughOneAnother) {
  MeshOfBoxes mesh;
  mesh.quad({0, 0, 2.5F}, {5, 0, 2.5F}, {5, 4, 2.5F}, {0, 4, 2.5F});  // a ceiling, and a wall that goes on above it
  mesh.quad({1, 3, 0}, {4, 3, 0}, {4, 3, 2.8F}, {1, 3, 2.8F});
  const auto lines = lines_of(mesh);
  EXPECT_GT(drawn_share(lines, {1, 3, 2.5F}, {4, 3, 2.5F}), 0.99F);
  EXPECT_EQ(lines.size(), 9U);
  MeshOfBoxes touching;
  touching.quad({0, 0, 2.5F}, {5, 0, 2.5F}, {5, 4, 2.5F}, {0, 4, 2.5F});
  touching.quad({1, 3, 0}, {4, 3, 0}, {4, 3, 2.5F}, {1, 3, 2.5F});
  EXPECT_EQ(lines_of(touching).size(), 8U) << "the wall's top is an edge of its own";
}

TEST(FeatureEdges, OfARoundColumnAreNotItsSides) {
  MeshOfBoxes mesh;
  constexpr int kSides = 12;
  const auto at = [](int side, float z) {
    const float angle_rad = 2.0F * std::numbers::pi_v<float> * static_cast<float>(side) / kSides;
    return Eigen::Vector3f(std::cos(angle_rad), std::sin(angle_rad), z);
  };
  for (int side = 0; side < kSides; ++side) mesh.quad(at(side, 0), at(side + 1, 0), at(side + 1, 2), at(side, 2));
  for (const PlanLine& line : lines_of(mesh)) EXPECT_EQ(line.from_m.z(), line.to_m.z());
}

TEST(FeatureEdges, ShorterThanTheLeastAreLeftOut) {
  MeshOfBoxes mesh;
  mesh.box({0, 0, 0}, {0.2F, 1, 1});
  EXPECT_EQ(lines_of(mesh).size(), 8U);
  FeatureEdgesConfig config;
  config.min_length_m = 0.1F;
  EXPECT_EQ(lines_of(mesh, config).size(), 12U);
}

TEST(FeatureEdges, ThatRunAlongALongerOneAreDrawnOnce) {
  MeshOfBoxes mesh;
  mesh.box({0, 0, 0}, {4, 0.2F, 2.5F});
  mesh.box({1, -0.02F, 0}, {2, 0, 0.1F});  // a skirting of two centimetres
  const auto lines = lines_of(mesh);
  std::vector<PlanLine> low;  // along the wall's foot
  for (const PlanLine& line : lines) {
    const bool along = std::abs(line.from_m.x() - line.to_m.x()) > 0.5F;
    if (along && line.from_m.y() < 0.1F && std::max(line.from_m.z(), line.to_m.z()) < 0.01F) low.push_back(line);
  }
  EXPECT_NEAR(length_m(low), 4.0F, 1e-3F);
}

TEST(FeatureEdges, OfAGeneratedHouseAreThoseOfItsRooms) {
  const sim::World house = sim::generate_house(1);
  const auto lines = feature_edges(house.scene.vertices_m, house.scene.triangles);
  EXPECT_GT(lines.size(), 500U);
  EXPECT_LT(lines.size(), 4000U);
  constexpr float kHalfWall_m = 0.06F;
  for (const sim::Room& room : house.rooms) {
    for (std::size_t i = 0; i < room.outline_m.size(); ++i) {
      const Eigen::Vector2d middle_m = 0.5 * (room.outline_m[0] + room.outline_m[2]);
      const auto corner = [&](std::size_t k, float z) {
        const Eigen::Vector2d at_m = room.outline_m[k % 4];
        const Eigen::Vector2d inwards = (middle_m - at_m).cwiseSign();
        const Eigen::Vector2f inside_m = at_m.cast<float>() + kHalfWall_m * inwards.cast<float>();
        return Eigen::Vector3f(inside_m.x(), inside_m.y(), z);
      };
      EXPECT_GT(drawn_share(lines, corner(i, 2.6F), corner(i + 1, 2.6F)), 0.6F) << room.name << " below its ceiling";
    }
  }
}

TEST(FeatureEdges, OfTheSameMeshAreTheSame) {
  const sim::World offices = sim::generate_offices(1);
  const auto once = feature_edges(offices.scene.vertices_m, offices.scene.triangles);
  const auto again = feature_edges(offices.scene.vertices_m, offices.scene.triangles);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].from_m, again[i].from_m);
    EXPECT_EQ(once[i].to_m, again[i].to_m);
  }
}

}  // namespace
}  // namespace homeward::linemodel::feature_edges_test
