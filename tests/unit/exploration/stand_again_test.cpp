// SPDX-License-Identifier: Apache-2.0
#include "exploration/stand_again.hpp"

#include <gtest/gtest.h>

#include "support/drawn_walls.hpp"
#include "support/landmarks.hpp"

namespace homeward::exploration::stand_again_test {
namespace {

/// An explorer that has taken three pictures in a square room, which looks the same to a scanner from four sides.
class StandAgainTest : public ::testing::Test {
 protected:
  StandAgainTest() : landmarks_(homeward::testing::landmarks_around({{0.0, 0.0, 0.0}}, 150, 5, 2.0)) {
    add_box(walls_, -2.0, -2.0, 2.0, 2.0);
    for (int i = 0; i < 3; ++i) {
      const Pose2 pose{0.4 * i, 0.0, 0.0};
      explorer_.take(sweep_of(walls_, pose), pose, picture(pose));
    }
  }
  [[nodiscard]] std::shared_ptr<const features::Appearance> picture(const Pose2& pose) const {
    return std::make_shared<const features::Appearance>(homeward::testing::seen_from(landmarks_, pose, 9));
  }
  [[nodiscard]] std::optional<Pose2> found(const Pose2& stands) const {
    return stand_again(explorer_, sweep_of(walls_, stands), *picture(stands));
  }

  std::vector<testing::DrawnWall> walls_;
  homeward::testing::Landmarks landmarks_;
  Explorer explorer_{ExplorerConfig{}};
};

TEST_F(StandAgainTest, HoweverItWasTurnedItIsFoundAndPicturesTellTheSidesApart) {
  for (const Pose2& stands :
       std::vector<Pose2>{{0.8, 0.0, 0.0}, {0.5, 0.3, 1.7}, {1.0, -0.4, 3.1}, {0.3, 0.2, -1.4}, {-0.2, 0.1, 2.4}}) {
    const auto pose = found(stands);
    ASSERT_TRUE(pose) << stands.x_m << " " << stands.theta_rad;
    EXPECT_LT(position_m(inverse(stands) * *pose).norm(), 0.05) << stands.theta_rad;
    EXPECT_LT(std::abs((inverse(stands) * *pose).theta_rad), 0.03) << stands.theta_rad;
  }
}

TEST_F(StandAgainTest, InAnotherRoomItIsNotFound) {
  std::vector<testing::DrawnWall> walls;
  add_box(walls, -1.0, -3.5, 1.5, 2.5);
  EXPECT_FALSE(stand_again(explorer_, sweep_of(walls, {0.5, 0.0, 0.3}), *picture({0.5, 0.0, 0.3})));
}

TEST_F(StandAgainTest, InARoomOfTheSameShapeThatLooksOtherwiseItIsNotFound) {
  const auto other = homeward::testing::landmarks_around({{0.0, 0.0, 0.0}}, 150, 77, 2.0);
  const Pose2 stands{0.5, 0.2, 0.3};
  EXPECT_FALSE(stand_again(explorer_, sweep_of(walls_, stands), homeward::testing::seen_from(other, stands, 9)));
}

TEST_F(StandAgainTest, WithoutAnythingExploredItIsNowhere) {
  EXPECT_FALSE(stand_again(Explorer{ExplorerConfig{}}, sweep_of(walls_, {}), *picture({})));
}

}  // namespace
}  // namespace homeward::exploration::stand_again_test
