// SPDX-License-Identifier: Apache-2.0
#include "repeat/subrange.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/taught_room.hpp"

namespace homeward::repeat::subrange_test {
namespace {

using testing::bend;
using testing::PaintedRoom;
using testing::pyramid_at;

class SubrangeOfARoom : public ::testing::Test {
 protected:
  [[nodiscard]] NumberedPicture picture(int number) const {
    return {number, pyramid_at(PaintedRoom{}, poses[static_cast<std::size_t>(number)], *camera)};
  }

  std::shared_ptr<const camera::Camera> camera = camera::Camera::create(testing::small_lens_camera()).value();
  std::vector<Pose2> poses = bend(12);
  TeachConfig config;
};

TEST_F(SubrangeOfARoom, KeepsCarriedFeaturesAndAddsCornersBesideThem) {
  const auto first = Subrange::begin(picture(0), {}, 7, camera, config).value();
  ASSERT_GT(first.features().size(), 60U);
  EXPECT_EQ(first.carried(), 0);
  EXPECT_EQ(first.features().front().feature, 7);
  const std::vector<KeyFeature> carried(first.features().begin(), first.features().begin() + 20);
  const auto second = Subrange::begin(picture(0), carried, first.next_feature(), camera, config).value();
  EXPECT_EQ(second.carried(), 20);
  std::set<int> numbers;
  for (const KeyFeature& feature : second.features()) {
    numbers.insert(feature.feature);
    const bool is_carried = feature.feature < first.next_feature();
    for (const KeyFeature& other : carried) {
      if (!is_carried) {
        EXPECT_GE((feature.pixel_px - other.pixel_px).norm(), config.corners.spacing_px);
      }
    }
  }
  EXPECT_EQ(numbers.size(), second.features().size());
}

TEST_F(SubrangeOfARoom, TakesNoMoreFeaturesThanItMay) {
  config.most_features = 50;
  EXPECT_EQ(Subrange::begin(picture(0), {}, 0, camera, config)->features().size(), 50U);
}

TEST_F(SubrangeOfARoom, LooksWithoutChangingAndKeepsWhatItIsTold) {
  auto subrange = Subrange::begin(picture(0), {}, 0, camera, config).value();
  const SubrangeView near = subrange.look(picture(2), config);
  EXPECT_FALSE(subrange.latest());
  ASSERT_TRUE(near.geometry);
  EXPECT_TRUE(near.geometry->has_baseline);
  EXPECT_GE(near.tracked, near.agreeing());
  EXPECT_GT(near.agreeing(), 50);
  subrange.keep(near);
  const Arc arc = subrange.arc(3, ArcEnd::kErrorTooLarge);
  EXPECT_EQ(arc.from, 3);
  EXPECT_EQ(arc.ended_by, ArcEnd::kErrorTooLarge);
  EXPECT_EQ(static_cast<int>(arc.matches.size()), near.agreeing());
  EXPECT_EQ(subrange.agreeing_in_latest().size(), arc.matches.size());
  for (const ArcMatch& match : arc.matches) {
    // The point, from the second key image: what its bearing and nearness there say.
    if (match.from_nearness < 0.02) continue;
    const Eigen::Vector3d point = match.from_bearing / match.from_nearness - arc.motion.target_in_current;
    const Eigen::Vector3d from_second = arc.motion.current_from_target.transpose() * point;
    EXPECT_LT((from_second.normalized() - match.to_bearing).norm(), 1e-6);
    EXPECT_NEAR(1.0 / from_second.norm(), match.to_nearness, 1e-6 + 1e-6 * match.to_nearness);
  }
}

TEST_F(SubrangeOfARoom, TwoViewsFromItTellTheMotionFromOneToTheOther) {
  const auto subrange = Subrange::begin(picture(0), {}, 0, camera, config).value();
  const auto motion = motion_between(subrange.look(picture(3), config), subrange.look(picture(5), config));
  ASSERT_TRUE(motion);
  const Pose2 truth = inverse(poses[3]) * poses[5];
  const Eigen::Matrix3d& turn = motion->current_from_target;
  EXPECT_NEAR(std::atan2(turn(1, 0), turn(0, 0)), truth.theta_rad, 0.005);
  const Eigen::Vector3d& way = motion->target_in_current;
  EXPECT_NEAR(std::atan2(way.y(), way.x()), std::atan2(truth.y_m, truth.x_m), 0.1);
  EXPECT_FALSE(motion_between(subrange.look(picture(3), config), SubrangeView{}));
}

TEST_F(SubrangeOfARoom, WhatIsLostStaysLost) {
  auto subrange = Subrange::begin(picture(0), {}, 0, camera, config).value();
  subrange.keep(subrange.look(picture(9), config));
  const int far = subrange.latest()->tracked;
  EXPECT_LT(far, static_cast<int>(subrange.features().size()));
  EXPECT_LE(subrange.look(picture(1), config).tracked, far);
}

TEST_F(SubrangeOfARoom, AnotherPlaceHasNoGeometryOfManyFeatures) {
  const auto subrange = Subrange::begin(picture(0), {}, 0, camera, config).value();
  const SubrangeView view = subrange.look({1, pyramid_at(PaintedRoom{.seed = 9}, poses[0], *camera)}, config);
  EXPECT_LT(view.agreeing(), config.fewest_features);
}

}  // namespace
}  // namespace homeward::repeat::subrange_test
