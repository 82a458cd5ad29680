// SPDX-License-Identifier: Apache-2.0
#include "linemodel/read_vrml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace homeward::linemodel::read_vrml_test {
namespace {

using ::testing::HasSubstr;

const std::string kHeader = "#VRML V2.0 utf8\n";
const std::string kLine =
    "Shape { geometry IndexedLineSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 2 0 ] } coordIndex [ 0 1 2 -1 ] } }";

Result<Plan> read(const std::string& body, PlanUp up = PlanUp::kZ) { return read_vrml(kHeader + body, up, "p.wrl"); }

void expect_line(const Plan& plan, std::size_t index, const Eigen::Vector3f& from_m, const Eigen::Vector3f& to_m) {
  ASSERT_LT(index, plan.lines.size());
  EXPECT_TRUE(plan.lines[index].from_m.isApprox(from_m, 1e-5F) || (plan.lines[index].from_m - from_m).norm() < 1e-5F)
      << plan.lines[index].from_m.transpose();
  EXPECT_TRUE((plan.lines[index].to_m - to_m).norm() < 1e-5F) << plan.lines[index].to_m.transpose();
}

void expect_error(const std::string& body, ErrorCode code, const std::string& message, const std::string& where) {
  const auto plan = read(body);
  ASSERT_FALSE(plan) << body.substr(0, 200);
  EXPECT_EQ(plan.error().code, code) << plan.error().message;
  EXPECT_THAT(plan.error().message, HasSubstr(message));
  EXPECT_EQ(plan.error().where, where) << plan.error().message;
}

TEST(ReadVrml, LinesOfPolylines) {
  const auto plan = read(kLine);
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_EQ(plan->lines.size(), 2U);
  expect_line(*plan, 0, {0, 0, 0}, {1, 0, 0});
  expect_line(*plan, 1, {1, 0, 0}, {1, 2, 0});
  EXPECT_EQ(plan->triangles.rows(), 0);
}

TEST(ReadVrml, FacesAsTriangles) {
  const auto plan = read(
      "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }\n"
      "coordIndex [ 0, 1, 2, 3, -1, 0, 1, 2 ] } }");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_TRUE(plan->lines.empty());
  EXPECT_EQ(plan->triangles.rows(), 3);
  EXPECT_EQ(plan->vertices_m.rows(), 4) << "the same corner is kept once";
}

TEST(ReadVrml, YUpIsStoodUpright) {
  const auto plan =
      read("Shape { geometry IndexedLineSet { coord Coordinate { point [ 1 2 3, 1 0 3 ] } coordIndex [ 0 1 ] } }",
           PlanUp::kY);
  ASSERT_TRUE(plan);
  expect_line(*plan, 0, {1, -3, 2}, {1, -3, 0});
}

TEST(ReadVrml, TransformsAreAppliedInTheStandardsOrder) {
  // 6.52: scaled about the centre first, then turned about it, then moved.
  const auto plan = read("Transform { center 1 0 0 scale 2 2 2 rotation 0 0 1 1.5707963 translation 0 0 5 children [ " +
                         kLine + " ] }");
  ASSERT_TRUE(plan) << plan.error().message;
  expect_line(*plan, 0, {1, -2, 5}, {1, 0, 5});
  expect_line(*plan, 1, {1, 0, 5}, {-3, 0, 5});
  const auto nested =
      read("Transform { translation 1 0 0 children Transform { scale 1 3 1 children [ " + kLine + " ] } }");
  ASSERT_TRUE(nested);
  expect_line(*nested, 1, {2, 0, 0}, {2, 6, 0});
  // Stretched along the diagonal alone.
  const auto slanted = read("Transform { scaleOrientation 0 0 1 0.78539816 scale 2 1 1 children [ " + kLine + " ] }");
  ASSERT_TRUE(slanted);
  expect_line(*slanted, 0, {0, 0, 0}, {1.5F, 0.5F, 0});
}

TEST(ReadVrml, WhatIsDefinedIsUsedAgain) {
  const auto plan =
      read("DEF G Group { children [ " + kLine +
           " ] }\nTransform { translation 0 0 2.5 children USE G }\nDEF T Transform { children [ USE G ] }");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->lines.size(), 6U);
  expect_line(*plan, 2, {0, 0, 2.5F}, {1, 0, 2.5F});
}

TEST(ReadVrml, SwitchesShowTheirChoiceAndLodsTheirFinestLevel) {
  const std::string other =
      "Shape { geometry IndexedLineSet { coord Coordinate { point [ 5 5 5 6 6 6 ] } coordIndex [0 1] } }";
  const auto chosen = read("Switch { whichChoice 1 choice [ " + kLine + " " + other + " ] }");
  ASSERT_TRUE(chosen) << chosen.error().message;
  ASSERT_EQ(chosen->lines.size(), 1U);
  expect_line(*chosen, 0, {5, 5, 5}, {6, 6, 6});
  expect_error("Switch { choice [ " + kLine + " ] }", ErrorCode::kEmptyInput, "neither a line nor a face", "p.wrl");
  const auto level = read("LOD { range [ 5 ] level [ " + other + " " + kLine + " ] }");
  ASSERT_TRUE(level);
  EXPECT_EQ(level->lines.size(), 1U);
}

TEST(ReadVrml, BoxesHaveEdgesAndFaces) {
  const auto plan = read("Transform { translation 0 0 1 children Shape { geometry Box { size 4 3 2 } } }");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->lines.size(), 12U);
  EXPECT_EQ(plan->triangles.rows(), 12);
  EXPECT_EQ(plan->vertices_m.rows(), 8);
  float length_m = 0.0F;
  for (const PlanLine& line : plan->lines) length_m += (line.to_m - line.from_m).norm();
  EXPECT_FLOAT_EQ(length_m, 4.0F * (4.0F + 3.0F + 2.0F));
  EXPECT_FLOAT_EQ(plan->vertices_m.col(2).minCoeff(), 0.0F);
}

TEST(ReadVrml, WhatHasNoEdgesIsSteppedOver) {
  const auto plan = read(
      "# a comment { [ \"\nWorldInfo { title \"a \\\"house\\\" # with ]\" info [ \"x\", \"y\" ] }\n"
      "PROTO Lamp [ field SFFloat power 1.0 eventIn SFBool on ] { Group { children [ ] } }\n"
      "EXTERNPROTO Chair [ ] [ \"http://example.org/chair.wrl\" ]\n"
      "DEF V Viewpoint { position 0 0 10 description \"from above\" }\nDEF S TimeSensor { loop TRUE cycleInterval 2 }\n"
      "Script { url \"javascript: function f() { }\" eventIn SFBool go field SFFloat a 0 directOutput TRUE }\n"
      "ROUTE S.fraction_changed TO V.set_position\n"
      "Shape { appearance Appearance { texture PixelTexture { image 1 1 3 0xFF8000 } material Material { } }\n"
      "geometry Text { string [ \"kitchen\" ] } }\n" +
      kLine);
  ASSERT_TRUE(plan) << plan.error().message << plan.error().where;
  EXPECT_EQ(plan->lines.size(), 2U);
}

TEST(ReadVrml, NothingIsFetchedAndNothingIsLeftOutInSilence) {
  expect_error(kLine + "\nInline { url \"rest.wrl\" }", ErrorCode::kUnsupportedFormat, "\"Inline\" is not read",
               "p.wrl:3");
  expect_error("\nPROTO Wall [ ] { " + kLine + " }\nWall { }", ErrorCode::kUnsupportedFormat, "\"Wall\" is not read",
               "p.wrl:4");
  expect_error("Shape { geometry Sphere { radius 2 } }", ErrorCode::kUnsupportedFormat, "\"Sphere\"", "p.wrl:2");
}

TEST(ReadVrml, OtherFormatsAreRefused) {
  for (const char* text :
       {"", "#VRML V1.0 ascii\nSeparator { }", "#Inventor V2.1 ascii\n", "\x1f\x8b\x08", "solid a"}) {
    const auto plan = read_vrml(text, PlanUp::kZ, "p.wrl");
    ASSERT_FALSE(plan) << text;
    EXPECT_EQ(plan.error().code, ErrorCode::kUnsupportedFormat);
    EXPECT_EQ(plan.error().where, "p.wrl");
  }
}

TEST(ReadVrml, ErrorsNameTheLineAndTheReason) {
  const auto set = [](const std::string& points, const std::string& indices) {
    return "\nShape { geometry\nIndexedLineSet { coord Coordinate {\npoint [ " + points + " ] }\ncoordIndex [ " +
           indices + " ] } }";
  };
  const auto wrong = ErrorCode::kInvalidInput;
  expect_error(set("0 0 0 1 0 0", "0 2 -1"), wrong, "entry 1 of 3; there are 2 points", "p.wrl:4");
  expect_error(set("0 0 0 1 0 0", "0 -2"), wrong, "names a point that is not there", "p.wrl:4");
  expect_error(set("0 0 0 1 0 0", "0 0.5"), wrong, "names a point that is not there", "p.wrl:4");
  expect_error(set("0 0 0 1 0 0", "0 1e300"), wrong, "names a point that is not there", "p.wrl:4");
  expect_error(set("0 0 0 1 0", "0 -1"), wrong, "three numbers a point", "p.wrl:4");
  expect_error(set("0 0 0 1 0 10001", "0 1"), wrong, "10 km", "p.wrl:4");
  expect_error(set("0 0 0 1 0 1e39", "0 1"), wrong, "10 km", "p.wrl:4");
  expect_error(set("0 0 0 1 0 1e999", "0 1"), wrong, "\"1e999\" is not a number", "p.wrl:5");
  expect_error(set("0 0 0 1 0 1.5.2", "0 1"), wrong, "\"1.5.2\" is not a number", "p.wrl:5");
  expect_error(set("0 0 0 nan 0 0", "0 1"), wrong, "in place of \"0\"", "p.wrl:5");
  expect_error("Group { children [ " + kLine, wrong, "in place of \"the end of the file\"", "p.wrl:2");
  expect_error("Group { children [ ] \n] }", wrong, "The name of a field", "p.wrl:3");
  expect_error("\n\nWorldInfo { title \"no end\n\n }", wrong, "does not end", "p.wrl:4");
  expect_error("Transform { scale 1 2 children [ ] }", wrong, "\"scale\" has to have 3 numbers", "p.wrl:2");
  expect_error("Group { children\n\\ }", wrong, "has no meaning", "p.wrl:3");
}

TEST(ReadVrml, WhatWouldNeverEndIsRefused) {
  expect_error("DEF A Group { children [ USE A ] }", ErrorCode::kInvalidInput, "No node before here is named \"A\"",
               "p.wrl:2");
  std::string deep;
  for (int i = 0; i < 200'000; ++i) deep += "Group{children[";
  expect_error(deep, ErrorCode::kInvalidInput, "more than 64 deep", "p.wrl:2");
  std::string doubling = "DEF A0 Group { children [ ] }\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "USE A" + std::to_string(i - 1);
    doubling += "DEF A" + std::to_string(i) + " Group { children [ " + before + " " + before + " ] }\n";
  }
  const auto plan = read(doubling);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::kTooLarge) << plan.error().message;
}

TEST(ReadVrml, TooManyLinesAreRefused) {
  std::string many = "DEF A " + kLine + "\n";
  std::string uses;
  for (int i = 0; i < 1000; ++i) uses += "USE A ";
  many += "DEF B Group { children [ " + uses + " ] }\nGroup { children [ ";
  for (int i = 0; i < 1001; ++i) many += "USE B ";
  const auto plan = read(many + "] }");
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::kTooLarge);
  EXPECT_THAT(plan.error().message, HasSubstr("2,000,000 lines"));
  const auto large = read_vrml(kHeader + std::string(kMostPlanBytes, ' '), PlanUp::kZ, "p.wrl");
  ASSERT_FALSE(large);
  EXPECT_EQ(large.error().code, ErrorCode::kTooLarge);
}

}  // namespace
}  // namespace homeward::linemodel::read_vrml_test
