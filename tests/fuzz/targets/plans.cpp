// SPDX-License-Identifier: Apache-2.0
#include "fuzz/targets/require.hpp"
#include "linemodel/read_svg.hpp"
#include "linemodel/read_vrml.hpp"
#include "linemodel/write_vrml.hpp"

namespace homeward::fuzz {
namespace {

void sound_plan(const linemodel::Plan& plan) {
  require(!plan.lines.empty() || plan.triangles.rows() > 0, "a plan has something in it");
  const auto near = [](const Eigen::Vector3f& point_m) { return (point_m.array().abs() <= 10'000.0F).all(); };
  for (const linemodel::PlanLine& line : plan.lines) {
    require(near(line.from_m) && near(line.to_m), "lines end within 10 km");
    require(line.from_m != line.to_m, "lines have a length");
  }
  for (Eigen::Index i = 0; i < plan.vertices_m.rows(); ++i)
    require(near(plan.vertices_m.row(i).transpose()), "corners lie within 10 km");
  if (plan.triangles.rows() > 0) {
    require(plan.triangles.minCoeff() >= 0 && plan.triangles.maxCoeff() < plan.vertices_m.rows(),
            "triangles have corners that are there");
  }
}

}  // namespace

void drawn_plans(Input input) {
  const Choice choice = choose(input, 3);
  const std::string text = choice.text();
  const auto up = choice.which == 0 ? linemodel::PlanUp::kZ : linemodel::PlanUp::kY;
  const auto plan = choice.which == 2 ? linemodel::read_svg(text, {0.01, 2.5}, "plan.svg")
                                      : linemodel::read_vrml(text, up, "plan.wrl");
  require_value_or_sentence(plan);
  if (!plan) return;
  sound_plan(*plan);
  const auto back = linemodel::read_vrml(linemodel::write_vrml(*plan), linemodel::PlanUp::kZ, "plan.wrl");
  require(back.has_value(), "a plan is read as it is written");
  require(back->lines.size() == plan->lines.size() && back->triangles.rows() == plan->triangles.rows(),
          "and is the same then");
}

}  // namespace homeward::fuzz
