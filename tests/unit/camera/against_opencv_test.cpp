// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/ccalib/omnidir.hpp>
#include <random>

#include "camera/models.hpp"

namespace homeward::camera::against_opencv_test {
namespace {

constexpr int kDirections = 2000;
constexpr double kTolerance_px = 1e-6;
const Intrinsics kIntrinsics{410.0, 402.0, 331.5, 243.25};
const cv::Vec3d kNoTurn(0, 0, 0);
const cv::Vec3d kNoShift(0, 0, 0);

cv::Matx33d matrix_of(const Intrinsics& intrinsics) {
  return {intrinsics.fx_px, 0.0, intrinsics.cx_px, 0.0, intrinsics.fy_px, intrinsics.cy_px, 0.0, 0.0, 1.0};
}

/// Directions up to `angle_max_rad` off the axis, spread evenly over that angle.
std::vector<Eigen::Vector3d> directions(double angle_max_rad) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Eigen::Vector3d> drawn;
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = angle_max_rad * unit(random);
    const double around_rad = 2.0 * M_PI * unit(random);
    drawn.emplace_back(std::sin(angle_rad) * std::cos(around_rad), std::sin(angle_rad) * std::sin(around_rad),
                       std::cos(angle_rad));
  }
  return drawn;
}

std::vector<cv::Point3d> points_of(const std::vector<Eigen::Vector3d>& rays) {
  std::vector<cv::Point3d> points;
  for (const Eigen::Vector3d& ray : rays) points.emplace_back(3.0 * ray.x(), 3.0 * ray.y(), 3.0 * ray.z());
  return points;
}

/// The largest distance between our pixels and OpenCV's; every direction must have a pixel, and lead back from it.
template <class Model>
void expect_same(const Model& model, const std::vector<Eigen::Vector3d>& rays, const std::vector<cv::Point2d>& theirs) {
  ASSERT_EQ(rays.size(), theirs.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto ours_px = pixel_from_direction(model, rays[i]);
    ASSERT_TRUE(ours_px) << rays[i].transpose();
    const Eigen::Vector2d theirs_px(theirs[i].x, theirs[i].y);
    EXPECT_LT((*ours_px - theirs_px).norm(), kTolerance_px) << rays[i].transpose();
    const auto back = direction_from_pixel(model, theirs_px);
    ASSERT_TRUE(back) << theirs_px.transpose();
    EXPECT_LT((*back - rays[i]).norm(), 1e-7) << rays[i].transpose();
  }
}

TEST(AgainstOpenCv, PinholeWithBrownDistortionProjectsTheSame) {
  const Pinhole pinhole{kIntrinsics, {-0.21, 0.07, 0.0011, -0.0008, -0.009}};
  const std::vector<Eigen::Vector3d> rays = directions(0.6);
  std::vector<cv::Point2d> theirs;
  cv::projectPoints(points_of(rays), kNoTurn, kNoShift, matrix_of(kIntrinsics), pinhole.distortion, theirs);
  expect_same(pinhole, rays, theirs);
}

TEST(AgainstOpenCv, FisheyeProjectsTheSame) {
  const Fisheye fisheye{kIntrinsics, {-0.03, 0.006, -0.004, 0.0007}, {}};
  const std::vector<Eigen::Vector3d> rays = directions(1.5);  // OpenCV's fisheye ends below a right angle
  std::vector<cv::Point2d> theirs;
  cv::fisheye::projectPoints(points_of(rays), theirs, kNoTurn, kNoShift, matrix_of(kIntrinsics), fisheye.distortion);
  expect_same(fisheye, rays, theirs);
}

TEST(AgainstOpenCv, UnifiedModelProjectsTheSame) {
  for (const double xi : {0.8, 1.0, 1.4}) {
    const Mei mei{kIntrinsics, xi, {-0.05, 0.004, 0.0009, -0.0013}, {}};
    const std::vector<Eigen::Vector3d> rays = directions(1.9);
    std::vector<cv::Point2d> theirs;
    cv::omnidir::projectPoints(points_of(rays), theirs, kNoTurn, kNoShift, matrix_of(kIntrinsics), xi, mei.distortion);
    expect_same(mei, rays, theirs);
  }
}

}  // namespace
}  // namespace homeward::camera::against_opencv_test
