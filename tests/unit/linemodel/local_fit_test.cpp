// SPDX-License-Identifier: Apache-2.0
#include "linemodel/local_fit.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/angles.hpp"
#include "support/shaded_room.hpp"

namespace homeward::linemodel::local_fit_test {
namespace {

/// A tracker whose last picture was taken at `kRobot`.
class FitOfOnePicture : public ::testing::Test {
 protected:
  static constexpr Pose2 kRobot{4.3, 2.4, 0.8};

  FitOfOnePicture() {
    PlanTrackerConfig config;
    config.monte_carlo.start_particles = 100;
    tracker_ = std::make_unique<PlanTracker>(PlanTracker::create(two_rooms(), small_panorama(), config).value());
    tracker_->start_at(kRobot, 0.1, 0.1);
    const Plan world = two_rooms();
    const raycast::RayScene rays{world.vertices_m, world.triangles};
    const auto camera = camera::Camera::create(small_panorama()).value();
    EXPECT_TRUE(tracker_->update(shaded_picture(world, rays, *camera, kRobot), std::nullopt, std::nullopt));
  }

  std::unique_ptr<PlanTracker> tracker_;
};

TEST_F(FitOfOnePicture, IsBestWhereItWasTakenWhateverTheHeading) {
  const LocalFit fit = best_fit_near(*tracker_, {3.5, 2.0, -2.5}, 1.5, kPi);
  EXPECT_LT((position_m(fit.pose) - position_m(kRobot)).norm(), 0.15);
  EXPECT_LT(std::abs(wrap_angle(fit.pose.theta_rad - kRobot.theta_rad)), 0.05);
}

TEST_F(FitOfOnePicture, IsWorseInAnotherRoom) {
  const LocalFit here = best_fit_near(*tracker_, kRobot, 0.5, 0.2);
  const LocalFit there = best_fit_near(*tracker_, {9.0, 2.0, 0.0}, 1.5, kPi);
  EXPECT_GT(here.log_odds, there.log_odds + 0.1);
  EXPECT_GT(here.explained, there.explained + 0.1);
  EXPECT_EQ(here.agreement(), here.log_odds + here.explained);
  EXPECT_LT((position_m(there.pose) - Eigen::Vector2d(9.0, 2.0)).norm(), 2.5);
}

TEST_F(FitOfOnePicture, IsNothingOffTheFloor) {
  const LocalFit fit = best_fit_near(*tracker_, {40.0, 40.0, 1.0}, 1.0, kPi);
  EXPECT_EQ(fit.pose.x_m, 40.0);
  EXPECT_EQ(fit.log_odds, 0.0);
}

}  // namespace
}  // namespace homeward::linemodel::local_fit_test
