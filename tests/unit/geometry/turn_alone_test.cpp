// SPDX-License-Identifier: Apache-2.0
#include "geometry/turn_alone.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/median.hpp"
#include "support/pinhole_scene.hpp"

namespace homeward::geometry::turn_alone_test {
namespace {

using homeward::testing::pinhole_scene;

ViewMotion turned() {
  ViewMotion motion;
  motion.current_from_target = Eigen::AngleAxisd(0.25, Eigen::Vector3d(0.1, 0.2, 0.9).normalized()).toRotationMatrix();
  return motion;
}

double off_rad(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.transpose() * b)).angle();
}

TEST(TurnAlone, IsFoundAmongPairsOfWhichFourInTenAreWrong) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto scene = pinhole_scene(turned(), {.wrong_share = 0.4, .baseline = 0.0, .seed = seed});
    const TurnAlone turn = fit_turn(scene.pairs, 2.0, seed);
    // 0.2 px each way on 72 pairs: 0.28 / 229 / sqrt(72) = 0.00015 about two of the axes, some more along the view.
    EXPECT_LT(off_rad(turn.current_from_target, turned().current_from_target), 0.001) << seed;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      if (!scene.is_wrong[i]) {
        EXPECT_LT(turn.off_px[i], 1.6);
      }
    }
  }
}

TEST(TurnAlone, MissesNearPointsOnceTheViewpointMoves) {
  ViewMotion sideways = turned();
  sideways.target_in_current = Eigen::Vector3d::UnitY();
  const auto scene = pinhole_scene(sideways, {.baseline = 0.5});
  EXPECT_GT(median(fit_turn(scene.pairs, 2.0, 1).off_px), 4.0);
}

TEST(TurnAlone, OfOnePairIsNone) {
  const auto scene = pinhole_scene(turned(), {.count = 1, .baseline = 0.0});
  EXPECT_TRUE(fit_turn(scene.pairs, 2.0, 1).current_from_target.isIdentity());
}

}  // namespace
}  // namespace homeward::geometry::turn_alone_test
