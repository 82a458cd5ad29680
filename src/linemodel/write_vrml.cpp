// SPDX-License-Identifier: Apache-2.0
#include "linemodel/write_vrml.hpp"

#include <array>
#include <charconv>

namespace homeward::linemodel {
namespace {

template <class Number>
void append_number(std::string& text, Number number) {
  std::array<char, 32> digits;
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  text.append(digits.data(), written.ptr);
}

void append_point(std::string& text, const Eigen::Vector3f& point_m) {
  for (int axis = 0; axis < 3; ++axis) {
    append_number(text, point_m(axis) + 0.0F);  // no negative zeros
    text += axis < 2 ? " " : ",\n";
  }
}

void append_lines(std::string& text, const std::vector<PlanLine>& lines) {
  text += "Shape {\n  geometry IndexedLineSet {\n    coord Coordinate { point [\n";
  for (const PlanLine& line : lines) {
    append_point(text, line.from_m);
    append_point(text, line.to_m);
  }
  text += "    ] }\n    coordIndex [\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    append_number(text, 2 * i);
    text += ' ';
    append_number(text, 2 * i + 1);
    text += " -1\n";
  }
  text += "    ]\n  }\n}\n";
}

void append_triangles(std::string& text, const Plan& plan) {
  text += "Shape {\n  geometry IndexedFaceSet {\n    solid FALSE\n    coord Coordinate { point [\n";
  for (Eigen::Index i = 0; i < plan.vertices_m.rows(); ++i) append_point(text, plan.vertices_m.row(i).transpose());
  text += "    ] }\n    coordIndex [\n";
  for (Eigen::Index i = 0; i < plan.triangles.rows(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      append_number(text, plan.triangles(i, k));
      text += ' ';
    }
    text += "-1\n";
  }
  text += "    ]\n  }\n}\n";
}

}  // namespace

std::string write_vrml(const Plan& plan) {
  std::string text = "#VRML V2.0 utf8\n# A plan of lines and of what hides them: metres, z up.\n";
  if (!plan.lines.empty()) append_lines(text, plan.lines);
  if (plan.triangles.rows() > 0) append_triangles(text, plan);
  return text;
}

}  // namespace homeward::linemodel
