// SPDX-License-Identifier: Apache-2.0
#include "linemodel/write_vrml.hpp"

#include <gtest/gtest.h>

#include "linemodel/feature_edges.hpp"
#include "linemodel/read_vrml.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::linemodel::write_vrml_test {
namespace {

void expect_same(const Plan& plan) {
  const auto back = read_vrml(write_vrml(plan), PlanUp::kZ, "p.wrl");
  ASSERT_TRUE(back) << back.error().message << back.error().where;
  ASSERT_EQ(back->lines.size(), plan.lines.size());
  for (std::size_t i = 0; i < plan.lines.size(); ++i) {
    EXPECT_EQ(back->lines[i].from_m, plan.lines[i].from_m) << i;
    EXPECT_EQ(back->lines[i].to_m, plan.lines[i].to_m) << i;
  }
  ASSERT_EQ(back->triangles.rows(), plan.triangles.rows());
  for (Eigen::Index i = 0; i < plan.triangles.rows(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      EXPECT_EQ(back->vertices_m.row(back->triangles(i, k)), plan.vertices_m.row(plan.triangles(i, k))) << i;
    }
  }
}

TEST(WriteVrml, IsReadAsItWasToTheLastBit) {
  Plan plan;
  plan.lines = {{{0.1F, -1.0F / 3.0F, 1e-7F}, {9999.5F, 16.777217F, -0.0F}}, {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}}};
  expect_same(plan);
  plan.vertices_m.resize(4, 3);
  plan.vertices_m << 0.1F, 0.2F, 0.3F, 1.1F, 0.2F, 0.3F, 0.1F, 1.2F, 0.3F, 7.0F, 7.0F, 7.7F;
  plan.triangles.resize(2, 3);
  plan.triangles << 0, 1, 2, 3, 2, 1;
  expect_same(plan);
  plan.lines.clear();
  expect_same(plan);
}

TEST(WriteVrml, OfAWholeHouseIsReadAsItWas) {
  const sim::World house = sim::generate_house(1);
  expect_same(plan_of_mesh(house.scene.vertices_m, house.scene.triangles));
}

TEST(WriteVrml, OfNothingIsReadAsNothing) {
  const auto back = read_vrml(write_vrml({}), PlanUp::kZ, "p.wrl");
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, ErrorCode::kEmptyInput);
}

}  // namespace
}  // namespace homeward::linemodel::write_vrml_test
