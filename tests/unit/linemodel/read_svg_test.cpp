// SPDX-License-Identifier: Apache-2.0
#include "linemodel/read_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linemodel/extrude_walls.hpp"
#include "linemodel/svg_numbers.hpp"

namespace homeward::linemodel::read_svg_test {
namespace {

using ::testing::HasSubstr;

Result<Plan> read(const std::string& body, const std::string& attributes = "viewBox='0 0 10 10'",
                  std::optional<double> metres_per_unit = 1.0) {
  return read_svg("<svg xmlns='http://www.w3.org/2000/svg' " + attributes + ">\n" + body + "</svg>",
                  {metres_per_unit, 2.5}, "p.svg");
}

/// The feet of the walls, in order.
std::vector<PlanLine> feet_of(const Plan& plan) {
  std::vector<PlanLine> feet;
  for (const PlanLine& line : plan.lines) {
    if (line.from_m.z() == 0.0F && line.to_m.z() == 0.0F) feet.push_back(line);
  }
  return feet;
}

std::size_t uprights_of(const Plan& plan) {
  std::size_t count = 0;
  for (const PlanLine& line : plan.lines) count += line.from_m.head<2>() == line.to_m.head<2>();
  return count;
}

void expect_feet(const std::string& body, const std::vector<std::array<float, 4>>& expected) {
  const auto plan = read(body);
  ASSERT_TRUE(plan) << body << plan.error().message;
  const auto feet = feet_of(*plan);
  ASSERT_EQ(feet.size(), expected.size()) << body;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const auto& [x1, y1, x2, y2] = expected[i];
    const PlanLine there{{x1, y1, 0}, {x2, y2, 0}};
    const bool forwards = (feet[i].from_m - there.from_m).norm() + (feet[i].to_m - there.to_m).norm() < 1e-4F;
    const bool backwards = (feet[i].from_m - there.to_m).norm() + (feet[i].to_m - there.from_m).norm() < 1e-4F;
    EXPECT_TRUE(forwards || backwards) << body << feet[i].from_m.transpose() << " - " << feet[i].to_m.transpose();
  }
}

void expect_error(const std::string& text, ErrorCode code, const std::string& message, const std::string& where,
                  std::optional<double> metres_per_unit = 1.0) {
  const auto plan = read_svg(text, {metres_per_unit, 2.5}, "p.svg");
  ASSERT_FALSE(plan) << text;
  EXPECT_EQ(plan.error().code, code) << plan.error().message;
  EXPECT_THAT(plan.error().message, HasSubstr(message));
  EXPECT_EQ(plan.error().where, where) << plan.error().message;
}

TEST(ExtrudeWalls, StandsUpUprightsWhereWallsEndOrMeet) {
  // Two that go on as one, and one across at their joint's other end.
  const auto plan =
      extrude_walls({{{0, 0}, {1, 0}}, {{1, 0.001}, {2, 0}}, {{2, 0}, {2, 1}}, {{1, 0}, {0, 0}}}, 2.5, "p");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(feet_of(*plan).size(), 3U) << "one of them is there twice";
  EXPECT_EQ(uprights_of(*plan), 3U) << "none where two go on";
  EXPECT_EQ(plan->lines.size(), 9U);
  EXPECT_EQ(plan->triangles.rows(), 6);
  EXPECT_FLOAT_EQ(plan->vertices_m.col(2).maxCoeff(), 2.5F);
}

TEST(ExtrudeWalls, RefusesWhatNoWallIs) {
  for (const double height_m : {0.0, -1.0, 101.0, std::nan("")})
    EXPECT_FALSE(extrude_walls({{{0, 0}, {1, 0}}}, height_m, "p"));
  EXPECT_EQ(extrude_walls({}, 2.5, "p").error().code, ErrorCode::kEmptyInput);
  EXPECT_EQ(extrude_walls({{{0, 0}, {0.001, 0}}}, 2.5, "p").error().code, ErrorCode::kEmptyInput);
  EXPECT_EQ(extrude_walls({{{0, 0}, {2e4, 0}}}, 2.5, "p").error().code, ErrorCode::kInvalidInput);
}

TEST(ReadSvg, ShapesAreWalls) {
  expect_feet("<line x1='1' y1='9' x2='4' y2='10'/>", {{1, 1, 4, 0}});
  expect_feet("<polyline points='0,10 1,10 1 9'/>", {{0, 0, 1, 0}, {1, 0, 1, 1}});
  expect_feet("<polygon points='0,10 1,10 1 9'/>", {{0, 0, 1, 0}, {1, 0, 1, 1}, {1, 1, 0, 0}});
  expect_feet("<rect x='1' y='2' width='3' height='4'/>", {{1, 8, 4, 8}, {4, 8, 4, 4}, {4, 4, 1, 4}, {1, 4, 1, 8}});
}

TEST(ReadSvg, StraightPartsOfPathsAreWallsAndCurvesAreNot) {
  expect_feet("<path d='M1 10h2v-1H1z'/>", {{1, 0, 3, 0}, {3, 0, 3, 1}, {3, 1, 1, 1}, {1, 1, 1, 0}});
  expect_feet("<path d='m1,9 1,0 0,-1'/>", {{1, 1, 2, 1}, {2, 1, 2, 2}});
  expect_feet("<path d='M0 10A1 1 0 0 1 1 9L2 9C3 9 3 8 4 8l1-.5'/>", {{1, 1, 2, 1}, {4, 2, 5, 2.5F}});
  expect_feet("<path d='M0,10 L1,10 M5,10 5,9 Q6 6 7 7 T8 8 L9 8'/>", {{0, 0, 1, 0}, {5, 0, 5, 1}, {8, 2, 9, 2}});
}

TEST(ReadSvg, TransformsMoveThem) {
  const std::string line = "<line x1='0' y1='0' x2='1' y2='0'/>";
  expect_feet("<g transform='translate(2,3) scale(2)'>" + line + "</g>", {{2, 7, 4, 7}});
  expect_feet("<g transform='translate(5 5)'><g transform='rotate(90)'>" + line + "</g></g>", {{5, 5, 5, 4}});
  expect_feet("<g transform='rotate(90, 1 0)'>" + line + "</g>", {{1, 11, 1, 10}});
  expect_feet("<g transform='matrix(1 0 0 1 3 4)'>" + line + "</g>" + line, {{3, 6, 4, 6}, {0, 10, 1, 10}});
}

TEST(ReadSvg, WhatIsNotDrawnHereIsSteppedOver) {
  expect_feet(
      "<defs><line x1='3' x2='4' y1='0' y2='0'/></defs><g display='none'><rect width='1' height='1'/></g>"
      "<g style='fill:red;display:none'><rect width='1' height='1'/></g><rect width='100%' height='100%'/>"
      "<text x='1' y='1'>kitchen</text><circle r='3'/><image href='http://example.org/a.png'/>"
      "<line x1='0' y1='10' x2='1' y2='10'/>",
      {{0, 0, 1, 0}});
}

TEST(ReadSvg, ScaleIsTheCallersOrTheDrawingsOwn) {
  const std::string line = "<line x1='0' y1='0' x2='100' y2='0'/>";
  const auto length_m = [&](const std::string& attributes, std::optional<double> metres_per_unit) {
    const auto plan = read(line, attributes, metres_per_unit);
    if (!plan) return -1.0F;
    return (plan->lines[0].to_m - plan->lines[0].from_m).norm();
  };
  EXPECT_FLOAT_EQ(length_m("", 0.05), 5.0F);
  EXPECT_FLOAT_EQ(length_m("width='20m' viewBox='0 0 200 100'", std::nullopt), 10.0F);
  EXPECT_FLOAT_EQ(length_m("width='2000.0 cm' viewBox='0 0 200 100'", std::nullopt), 10.0F);
  EXPECT_FLOAT_EQ(length_m("width='8000mm' viewBox='-5 -5 200 100'", std::nullopt), 4.0F);
  EXPECT_FLOAT_EQ(length_m("width='8000mm' viewBox='0 0 200 100'", 0.01), 1.0F) << "the caller knows better";
  EXPECT_EQ(length_m("width='800px' viewBox='0 0 200 100'", std::nullopt), -1.0F);
  EXPECT_EQ(length_m("width='8m'", std::nullopt), -1.0F);
  EXPECT_EQ(length_m("", 0.0), -1.0F);
  EXPECT_EQ(length_m("", -1.0), -1.0F);
}

TEST(ReadSvg, ErrorsNameTheLineAndTheReason) {
  const auto wrong = ErrorCode::kInvalidInput;
  const std::string begin = "<svg viewBox='0 0 9 9'>\n";
  expect_error("", wrong, "no element found", "p.svg:1");
  expect_error(begin + "<g>\n", wrong, "no element found", "p.svg:3");
  expect_error(begin + "</g></svg>", wrong, "mismatched tag", "p.svg:2");
  expect_error("<html></html>", ErrorCode::kUnsupportedFormat, "no SVG", "p.svg:1");
  expect_error(begin + "\n<path d='M1 1 L2'/></svg>", wrong, "The path \"M1 1 L2\"", "p.svg:3");
  expect_error(begin + "<path d='L2 2'/></svg>", wrong, "The path", "p.svg:2");
  expect_error(begin + "<path d='M1 1 X 3'/></svg>", wrong, "The path", "p.svg:2");
  expect_error(begin + "<path d='M1 1 Z 3'/></svg>", wrong, "The path", "p.svg:2");
  expect_error(begin + "<path d='M1 1 L inf nan'/></svg>", wrong, "The path", "p.svg:2");
  expect_error(begin + "<line x1='one'/></svg>", wrong, "\"x1\"", "p.svg:2");
  expect_error(begin + "<polyline points='1 2 3'/></svg>", wrong, "no pairs", "p.svg:2");
  expect_error(begin + "<g transform='turn(3)'/></svg>", wrong, "The transform", "p.svg:2");
  expect_error("<svg viewBox='0 0 0 9'/>", wrong, "The viewBox", "p.svg:1");
  expect_error(begin + "<use href='#a'/></svg>", ErrorCode::kUnsupportedFormat, "\"use\"", "p.svg:2");
  expect_error(begin + "<line x2='1e6'/></svg>", wrong, "10 km", "p.svg");
  expect_error(begin + "</svg>", ErrorCode::kEmptyInput, "no straight line", "p.svg");
  expect_error(begin + "<line x2='1'/></svg>", wrong, "scale in metres", "p.svg:1", std::nullopt);
}

TEST(ReadSvg, WhatWouldNeverEndIsRefused) {
  std::string deep = "<svg viewBox='0 0 9 9'>";
  for (int i = 0; i < 100'000; ++i) deep += "<g>";
  expect_error(deep, ErrorCode::kInvalidInput, "1000 deep", "p.svg:1");
  std::string laughs = "<!DOCTYPE svg [<!ENTITY a0 'M0 0'>\n";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "&a" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY a" + std::to_string(i) + " '" + before + before + before + before + "'>\n";
  }
  const auto plan = read_svg(laughs + "]><svg viewBox='0 0 9 9'><path d='&a29;'/></svg>", {1.0, 2.5}, "p.svg");
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(plan.error().message, HasSubstr("amplification"));
}

}  // namespace
}  // namespace homeward::linemodel::read_svg_test
