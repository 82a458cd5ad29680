// SPDX-License-Identifier: Apache-2.0
#include "repeat/arc_pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "repeat/seen.hpp"
#include "support/lens_room.hpp"
#include "support/straight_path.hpp"

namespace homeward::repeat::arc_pose_test {
namespace {

class FittingAPose : public ::testing::Test {
 protected:
  /// All landmarks that the camera sees from a pose, exactly.
  [[nodiscard]] std::vector<SeenLandmark> seen_from(const ArcPose& pose) const {
    std::vector<SeenLandmark> seen;
    for (const Landmark& landmark : around.landmarks) {
      const auto pixel_px = camera->pixel(expected_at(pose, landmark).bearing);
      if (!pixel_px) continue;
      if (const auto point = seen_at(*camera, *pixel_px)) seen.push_back({landmark, *point});
    }
    return seen;
  }

  std::shared_ptr<const camera::Camera> camera = camera::Camera::create(testing::small_lens_camera()).value();
  testing::StraightPath straight{{0.0, 1.0, 2.0}};
  ArcSurroundings around = surroundings_of(straight.path, 0, 1, 3);
  PoseFitConfig config;
  ArcPose truth{Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {0.4, 0.2, 0.0}};
};

TEST_F(FittingAPose, FindsWhereLandmarksAreSeenFrom) {
  const auto seen = seen_from(truth);
  ASSERT_GT(seen.size(), 20U);
  const PoseFit fit = fit_pose(seen, around, {}, config);
  EXPECT_LT((fit.pose.position - truth.position).norm(), 0.01);
  EXPECT_LT(
      Eigen::AngleAxisd(Eigen::Matrix3d(truth.local_from_current.transpose() * fit.pose.local_from_current)).angle(),
      1e-3);
  EXPECT_EQ(fit.agreeing, static_cast<int>(seen.size()));
  EXPECT_LT(fit.error_px, 0.1);
}

TEST_F(FittingAPose, AThirdOfWrongLandmarksIsNamedAndDoesNotMoveIt) {
  auto seen = seen_from(truth);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < seen.size(); i += 3, ++wrong) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    seen[i].seen = *seen_at(*camera, {60.0 + 5.0 * static_cast<double>(i), 90.0 + 40.0 * side});
  }
  const PoseFit fit = fit_pose(seen, around, truth, config);
  EXPECT_LT((fit.pose.position - truth.position).norm(), 0.05);
  EXPECT_LE(fit.agreeing, static_cast<int>(seen.size() - wrong + 1));
  EXPECT_GE(fit.agreeing, static_cast<int>(seen.size() - wrong));
}

TEST_F(FittingAPose, WithoutDistancesOnlyTheTurnIsFound) {
  testing::StraightPath spot({0.0, 0.0});
  spot.turn_at(0, 0.3);
  around = surroundings_of(spot.path, 0, 0, 3);
  truth.position.setZero();
  const PoseFit fit = fit_pose(seen_from(truth), around, {}, config);
  EXPECT_EQ(fit.pose.position.norm(), 0.0);
  EXPECT_LT(
      Eigen::AngleAxisd(Eigen::Matrix3d(truth.local_from_current.transpose() * fit.pose.local_from_current)).angle(),
      1e-3);
}

TEST_F(FittingAPose, ALandmarkAsFarAsTheSkyDoesNotMoveWithTheCamera) {
  Landmark sky;
  sky.bearing = Eigen::Vector3d(1.0, 0.2, 0.1).normalized();
  const Expected expected = expected_at({Eigen::Matrix3d::Identity(), {3.0, 1.0, 0.0}}, sky);
  EXPECT_LT((expected.bearing - sky.bearing).norm(), 1e-12);
  EXPECT_NEAR(expected.distance, 1.0, 1e-12);
  EXPECT_EQ(expected.spread_rad, 0.0);
}

TEST_F(FittingAPose, ADriverKeepsTheHeightAndStaysUpright) {
  config.driving = geometry::DrivingPrior{};
  auto seen = seen_from(truth);
  // Tracked a pixel too low everywhere.
  for (SeenLandmark& one : seen)
    one.seen = *seen_at(*camera, *camera->pixel(one.seen.bearing) + Eigen::Vector2d(0.0, 1.0));
  const PoseFit fit = fit_pose(seen, around, truth, config);
  EXPECT_LT(std::abs(fit.pose.position.z()), 0.02);
  EXPECT_LT(fit.pose.local_from_current.col(2).head<2>().norm(), 0.01);
}

}  // namespace
}  // namespace homeward::repeat::arc_pose_test
