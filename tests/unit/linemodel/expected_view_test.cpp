// SPDX-License-Identifier: Apache-2.0
#include "linemodel/expected_view.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/shaded_room.hpp"

namespace homeward::linemodel {
namespace {

/// Its picture ends 40 degrees above the horizon and 50 below.
camera::CameraConfig cut_panorama() {
  camera::CameraConfig config = small_panorama();
  config.height_px = 180;
  return config;
}

class ExpectedOf : public ::testing::TestWithParam<camera::CameraConfig> {};

TEST_P(ExpectedOf, IsTheSameWithoutCells) {
  const auto camera = camera::Camera::create(GetParam()).value();
  const Plan plan = two_rooms();
  VisibleLines visible(plan, GetParam().robot_from_camera_translation_m.z(), {});
  const Expectation expectation(*camera);
  std::size_t lines = 0;
  std::size_t differing = 0;
  for (const Pose2& robot :
       {Pose2{1.5, 2.0, 0.3}, Pose2{4.0, 2.5, -2.0}, Pose2{8.0, 2.0, 1.5}, Pose2{11.0, 1.0, 3.0}}) {
    const auto around = visible.around(expectation.eye_m(robot).head<2>());
    ExpectedView with;
    ExpectedView without;
    expectation.expect(robot, around, with, true);
    expectation.expect(robot, around, without, false);
    EXPECT_TRUE(without.cells.empty());
    EXPECT_EQ(with.cells.empty(), with.lines.empty());
    ASSERT_EQ(with.lines.size(), without.lines.size());
    for (std::size_t i = 0; i < with.lines.size(); ++i) {
      EXPECT_EQ(with.lines[i].index, without.lines[i].index);
      EXPECT_EQ(with.lines[i].point.angle_rad, without.lines[i].point.angle_rad);
      EXPECT_NEAR(with.lines[i].count, without.lines[i].count, 1);
      differing += with.lines[i].count == without.lines[i].count ? 0 : 1;
    }
    lines += with.lines.size();
  }
  EXPECT_GT(lines, 15U);
  EXPECT_LE(20 * differing, lines);  // a direction at the very edge of what is seen may be counted or not
}

INSTANTIATE_TEST_SUITE_P(Cameras, ExpectedOf, ::testing::Values(small_panorama(), cut_panorama(), small_pinhole()));

TEST(SightMap, CountsWhatACameraSeesOfALineBetweenTwoDirections) {
  for (const camera::CameraConfig& config : {small_panorama(), small_pinhole()}) {
    const SightMap sights(*camera::Camera::create(config).value());
    std::mt19937 random(3);
    const auto direction = [&] {
      std::uniform_real_distribution<float> share(-1.0F, 1.0F);
      return Eigen::Vector3f(share(random), share(random), share(random)).normalized();
    };
    int off = 0;
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3f from = direction();
      const Eigen::Vector3f to = (from + 0.5F * direction()).normalized();
      const int samples = 2 + i % (SightMap::kMostSamples - 1);
      int each = 0;
      for (int k = 0; k < samples; ++k) {
        const float share = (static_cast<float>(k) + 0.5F) / static_cast<float>(samples);
        if (sights.cell((1.0F - share) * from + share * to) != SightMap::kNowhere) ++each;
      }
      off += std::abs(each - sights.count_seen(from, to, samples));
    }
    EXPECT_LE(off, 3);
  }
}

}  // namespace
}  // namespace homeward::linemodel
