// SPDX-License-Identifier: Apache-2.0
#include "linemodel/rim_edges.hpp"

#include <gtest/gtest.h>

#include "support/mesh_of_boxes.hpp"

namespace homeward::linemodel::rim_edges_test {
namespace {

constexpr float kCrease_rad = 0.6F;

std::vector<RimEdge> edges_of(const MeshOfBoxes& mesh) {
  return rim_edges(weld(mesh.vertices_m(), mesh.triangles(), 0.001F), kCrease_rad);
}

TEST(Weld, CornersNearOneAnotherAreOne) {
  MeshOfBoxes mesh;
  mesh.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  mesh.quad({1.0004F, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0.9997F, 1, 0});
  const WeldedMesh welded = weld(mesh.vertices_m(), mesh.triangles(), 0.001F);
  EXPECT_EQ(welded.points_m.size(), 6U);
  EXPECT_EQ(welded.triangles.size(), 4U);
  EXPECT_EQ(weld(mesh.vertices_m(), mesh.triangles(), 0.0001F).points_m.size(), 8U);
}

TEST(Weld, TrianglesWithoutAreaAreLeftOut) {
  MeshOfBoxes mesh;
  mesh.quad({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0});
  mesh.quad({0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(weld(mesh.vertices_m(), mesh.triangles(), 0.001F).triangles.empty());
}

TEST(RimEdges, OfABoxAreItsTwelve) {
  MeshOfBoxes mesh;
  mesh.box({0, 0, 0}, {1, 2, 3});
  const auto edges = edges_of(mesh);
  EXPECT_EQ(edges.size(), 12U);
  for (const RimEdge& edge : edges) EXPECT_EQ(edge.faces.size(), 2U);
}

TEST(RimEdges, OfPanelsBesidePanelsAreTheirOutline) {
  // One panel beside two, which meet its side at a T-junction.
  MeshOfBoxes mesh;
  mesh.quad({0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2});
  mesh.quad({1, 0, 0}, {2, 0, 0}, {2, 0, 0.7F}, {1, 0, 0.7F});
  mesh.quad({1, 0, 0.7F}, {2, 0, 0.7F}, {2, 0, 2}, {1, 0, 2});
  float length_m = 0.0F;
  const WeldedMesh welded = weld(mesh.vertices_m(), mesh.triangles(), 0.001F);
  for (const RimEdge& edge : rim_edges(welded, kCrease_rad)) {
    EXPECT_EQ(edge.faces.size(), 1U);
    length_m +=
        (welded.points_m[static_cast<std::size_t>(edge.to)] - welded.points_m[static_cast<std::size_t>(edge.from)])
            .norm();
  }
  EXPECT_FLOAT_EQ(length_m, 8.0F) << "once round, no seam";
}

TEST(RimEdges, AreWhereASurfaceBendsByMoreThanTheCrease) {
  for (const float height_m : {0.5F, 0.8F}) {  // 27 and 39 degrees, from the floor
    MeshOfBoxes mesh;
    mesh.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    mesh.quad({1, 0, 0}, {2, 0, height_m}, {2, 1, height_m}, {1, 1, 0});
    EXPECT_EQ(edges_of(mesh).size(), height_m < 0.6F ? 6U : 7U);
  }
}

}  // namespace
}  // namespace homeward::linemodel::rim_edges_test
