// SPDX-License-Identifier: Apache-2.0
#include "linemodel/read_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace homeward::linemodel::read_plan_test {
namespace {

using ::testing::HasSubstr;

/// A box of 4 by 3 by 2 with its foot at the origin, its faces alone.
const std::string kObjBox =
    "mtllib elsewhere.mtl\nv 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2\nv 4 0 2\nv 4 3 2\nv 0 3 2\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

float highest_m(const Plan& plan) {
  float most_m = -1e9F;
  for (const PlanLine& line : plan.lines) most_m = std::max({most_m, line.from_m.z(), line.to_m.z()});
  return most_m;
}

TEST(ReadPlan, MeshesGetTheirEdges) {
  const auto plan = read_plan(kObjBox, "obj", {}, "box.obj");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->lines.size(), 12U);
  EXPECT_EQ(plan->triangles.rows(), 12);
  EXPECT_FLOAT_EQ(highest_m(*plan), 2.0F);
}

TEST(ReadPlan, ScaleAndUpAreTheCallers) {
  const auto plan = read_plan(kObjBox, ".OBJ", {PlanUp::kY, 0.5, 2.5}, "box.obj");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_FLOAT_EQ(highest_m(*plan), 1.5F);
  for (const PlanLine& line : plan->lines) EXPECT_LE(line.from_m.y(), 0.0F);
}

TEST(ReadPlan, WireFramesAreAsTheyAreAndFacesGetTheirEdges) {
  const std::string points = "coord Coordinate { point [ 0 0 0 2 0 0 2 1 0 0 1 0 ] } ";
  const auto lines = read_plan(
      "#VRML V2.0 utf8\nShape { geometry IndexedLineSet { " + points + "coordIndex [ 0 2 ] } }", "wrl", {}, "p.wrl");
  ASSERT_TRUE(lines) << lines.error().message;
  EXPECT_EQ(lines->lines.size(), 1U);
  const std::string faces =
      "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { " + points + "coordIndex [ 0 1 2 3 -1 ] } }";
  const auto edges = read_plan(faces, "wrl", {std::nullopt, 2.0, 2.5}, "p.wrl");
  ASSERT_TRUE(edges) << edges.error().message;
  EXPECT_EQ(edges->lines.size(), 4U);
  EXPECT_FLOAT_EQ(edges->vertices_m.col(0).maxCoeff(), 4.0F);
}

TEST(ReadPlan, FloorPlansAreStoodUp) {
  const auto plan = read_plan("<svg viewBox='0 0 9 9'><line x1='1' y1='8' x2='5' y2='8'/></svg>", "svg",
                              {std::nullopt, 0.5, 3.0}, "p.svg");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->lines.size(), 4U);
  EXPECT_FLOAT_EQ(highest_m(*plan), 3.0F);
}

TEST(ReadPlan, WhatIsNoPlanIsRefused) {
  const auto expect = [](const std::string& bytes, const std::string& extension, const ReadPlanConfig& config,
                         ErrorCode code, const std::string& message) {
    const auto plan = read_plan(bytes, extension, config, "p");
    ASSERT_FALSE(plan) << extension;
    EXPECT_EQ(plan.error().code, code) << plan.error().message;
    EXPECT_THAT(plan.error().message, HasSubstr(message));
    EXPECT_THAT(plan.error().where, ::testing::StartsWith("p"));
  };
  expect(kObjBox, "dxf", {}, ErrorCode::kUnsupportedFormat, "\"dxf\" are not read");
  expect(kObjBox, "", {}, ErrorCode::kUnsupportedFormat, "are not read");
  expect("what is this", "glb", {}, ErrorCode::kUnsupportedFormat, "cannot be read");
  expect("", "obj", {}, ErrorCode::kUnsupportedFormat, "cannot be read");
  expect(kObjBox, "obj", {std::nullopt, -1.0, 2.5}, ErrorCode::kInvalidInput, "above zero");
  expect(kObjBox, "obj", {std::nullopt, 1e5, 2.5}, ErrorCode::kInvalidInput, "10 km");
  expect(kObjBox, "obj", {std::nullopt, 1e-3, 2.5}, ErrorCode::kEmptyInput, "no straight edge");
  expect(
      "#VRML V2.0 utf8\nShape { geometry IndexedLineSet { coord Coordinate { point [ 0 0 0 9 0 0 ] } coordIndex [ 0 1 "
      "] } }",
      "wrl", {std::nullopt, 1e4, 2.5}, ErrorCode::kInvalidInput, "10 km");
  expect(std::string(kMostPlanBytes + 1, ' '), "glb", {}, ErrorCode::kTooLarge, "64 MiB");
}

}  // namespace
}  // namespace homeward::linemodel::read_plan_test
