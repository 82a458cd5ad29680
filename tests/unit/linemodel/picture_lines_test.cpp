// SPDX-License-Identifier: Apache-2.0
#include "linemodel/picture_lines.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/shaded_room.hpp"

namespace homeward::linemodel {
namespace {

/// A room seen from `robot_`, and what its plan lets expect from anywhere.
class LinesOfAPicture : public ::testing::TestWithParam<LineMeasure> {
 protected:
  static camera::CameraConfig config() { return small_panorama(); }

  [[nodiscard]] ExpectedView expected(const Pose2& pose) {
    ExpectedView view;
    expectation_.expect(pose, visible_.around(expectation_.eye_m(pose).head<2>()), view);
    return view;
  }
  [[nodiscard]] PictureLines picture_lines(LineMeasure measure) const {
    const auto lines = detect_lines(shaded_picture(plan_, rays_, *camera_, robot_), LineViews(*camera_), {}).value();
    MeasureConfig measuring;
    measuring.measure = measure;
    return {lines, expectation_.space(), measuring};
  }

  Plan plan_ = two_rooms();
  raycast::RayScene rays_{plan_.vertices_m, plan_.triangles};
  std::shared_ptr<const camera::Camera> camera_ = camera::Camera::create(config()).value();
  Expectation expectation_{*camera_};
  VisibleLines visible_{plan_, 1.2, {}};
  Pose2 robot_{2.2, 2.1, 0.4};
};

TEST_P(LinesOfAPicture, FitBestWhereThePictureWasTaken) {
  const PictureLines lines = picture_lines(GetParam());
  const double here = lines.score(expected(robot_));
  for (const Pose2& other : {Pose2{3.1, 2.1, 0.4}, Pose2{2.2, 2.9, 0.4}, Pose2{2.2, 2.1, 0.6}, Pose2{8.0, 2.0, 0.4},
                             Pose2{2.2, 2.1, 0.4 + kPi}}) {
    EXPECT_GT(here, lines.score(expected(other)) + 0.02) << other.x_m << " " << other.y_m << " " << other.theta_rad;
  }
}

TEST_P(LinesOfAPicture, ExpectNothingWhereNothingIsToBeSeen) {
  EXPECT_EQ(picture_lines(GetParam()).score(ExpectedView()), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Measures, LinesOfAPicture,
                         ::testing::Values(LineMeasure::kCentredMatchCount, LineMeasure::kGridLengthMatch,
                                           LineMeasure::kDistanceTransform, LineMeasure::kMatchOdds));

TEST_F(LinesOfAPicture, ConfirmWithinTheRectangleAndNotOutsideIt) {
  const HoughSpace space(config());
  ImageLine upright;
  upright.from = Eigen::Vector3d(1.0, 0.0, -0.4).normalized();
  upright.to = Eigen::Vector3d(1.0, 0.0, 0.4).normalized();
  upright.normal = upright.from.cross(upright.to).normalized();
  upright.length_rad = 0.7;
  MeasureConfig measuring;
  measuring.tolerance_rad = 0.05;
  const PictureLines lines(std::vector<ImageLine>{upright}, space, measuring);
  const auto turned = [&](double turn_rad) {
    const Eigen::Vector3d normal = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()) * upright.normal;
    return ExpectedLine{*space.point(normal.cast<float>()), 0.7F, 0, 0, 0};
  };
  for (const double off : {-0.04, 0.0, 0.04}) EXPECT_TRUE(lines.confirmed(turned(off))) << off;
  for (const double off : {-0.07, 0.07, 0.5}) EXPECT_FALSE(lines.confirmed(turned(off))) << off;
}

TEST_F(LinesOfAPicture, CountALineByHowUnlikelyItIsByChance) {
  const HoughSpace space(config());
  std::vector<ImageLine> fan;  // many uprights beside one another, and one alone
  for (int i = 0; i < 30; ++i) {
    ImageLine line;
    line.normal = Eigen::AngleAxisd(0.02 * i, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d::UnitX();
    fan.push_back(line);
  }
  ImageLine alone;
  alone.normal = Eigen::AngleAxisd(1.8, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d::UnitX();
  fan.push_back(alone);
  const PictureLines lines(fan, space, {});
  const auto view_of = [&](const Eigen::Vector3d& normal) {
    ExpectedView view;
    view.lines.push_back({*space.point(normal.cast<float>()), 0.5F, 0, 0, 0});
    return view;
  };
  EXPECT_GT(lines.log_odds(view_of(alone.normal)), lines.log_odds(view_of(fan[15].normal)) + 0.3);
  EXPECT_LT(lines.log_odds(view_of(Eigen::Vector3d(0.3, 0.3, 0.8).normalized())), 0.0);
}

TEST_F(LinesOfAPicture, OfPointsAloneConfirmTheSame) {
  const auto lines = detect_lines(shaded_picture(plan_, rays_, *camera_, robot_), LineViews(*camera_), {}).value();
  const std::vector<HoughPoint> points = hough_points(lines, expectation_.space());
  ASSERT_EQ(points.size(), lines.size());
  const ExpectedView view = expected(robot_);
  MeasureConfig by_length;  // which points have not
  by_length.measure = LineMeasure::kGridLengthMatch;
  const PictureLines of_points(points, expectation_.space(), by_length);
  const PictureLines of_lines = picture_lines(LineMeasure::kCentredMatchCount);
  EXPECT_EQ(of_points.score(view), of_lines.score(view));
  EXPECT_EQ(of_points.log_odds(view), of_lines.log_odds(view));
  std::vector<HoughPoint> drawn;
  for (const ExpectedLine& line : view.lines) drawn.push_back(line.point);
  EXPECT_EQ(of_lines.log_odds(drawn), of_lines.log_odds(view));
  EXPECT_EQ(of_lines.log_odds(std::vector<HoughPoint>()), 0.0);
}

}  // namespace
}  // namespace homeward::linemodel
