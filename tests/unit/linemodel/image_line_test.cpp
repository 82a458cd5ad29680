// SPDX-License-Identifier: Apache-2.0
#include "linemodel/image_line.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/shaded_room.hpp"

namespace homeward::linemodel {
namespace {

/// How far the nearest detected line's plane is from a straight edge of the room, as an angle; large where none is.
double off_rad(const std::vector<ImageLine>& lines, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d normal = from.cross(to).normalized();
  double least = kPi;
  for (const ImageLine& line : lines) {
    least = std::min(least, std::acos(std::min(1.0, std::abs(line.normal.dot(normal)))));
  }
  return least;
}

class EdgesOfARoom : public ::testing::TestWithParam<camera::CameraConfig> {};

TEST_P(EdgesOfARoom, AreFoundWhereTheyAre) {
  const Plan plan = two_rooms();
  const raycast::RayScene rays(plan.vertices_m, plan.triangles);
  const auto camera = camera::Camera::create(GetParam()).value();
  const Pose2 robot{1.0, 2.2, 0.0};
  const auto lines = detect_lines(shaded_picture(plan, rays, *camera, robot), LineViews(*camera), {}).value();
  ASSERT_GT(lines.size(), 5U);
  const Eigen::Vector3d eye_m = Eigen::Vector3d(1.0, 2.2, 0.0) + GetParam().robot_from_camera_translation_m;
  const auto seen = [&](double x, double y, double z) { return Eigen::Vector3d(Eigen::Vector3d(x, y, z) - eye_m); };
  EXPECT_LT(off_rad(lines, seen(6.0, 2.6, 0.3), seen(6.0, 2.6, 2.0)), radians(1.5)) << "a side of the doorway";
  EXPECT_LT(off_rad(lines, seen(6.0, 0.9, 0.0), seen(6.0, 2.5, 0.0)), radians(1.5)) << "the foot of the wall ahead";
  EXPECT_LT(off_rad(lines, seen(3.1, 0.7, 0.8), seen(4.7, 0.7, 0.8)), radians(1.5)) << "the edge of the table";
}

INSTANTIATE_TEST_SUITE_P(Cameras, EdgesOfARoom, ::testing::Values(small_pinhole(), small_panorama()));

TEST(DetectLines, FindsNoneInAPictureOfOneColour) {
  const auto camera = camera::Camera::create(small_pinhole()).value();
  Image grey(320, 240, 1);
  std::fill(grey.data.begin(), grey.data.end(), std::uint8_t{90});
  EXPECT_TRUE(detect_lines(grey, LineViews(*camera), {})->empty());
}

TEST(DetectLines, TakesTheRimOfAMirrorForNoEdge) {
  camera::CameraConfig config;
  config.width_px = 640;
  config.height_px = 480;
  config.model = camera::HyperbolicMirror{{598.4579, 598.4579, 319.5, 239.5}, 28.095, 23.4125, 43.05, 231.0};
  config.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  config.robot_from_camera_rotation = Eigen::Quaterniond(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  const auto camera = camera::Camera::create(config).value();
  Image white(640, 480, 1);  // the mirror shows white, the rest of the picture is black
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      *white.at(u, v) = camera->bearing(Eigen::Vector2d(u, v)) ? 255 : 0;
    }
  }
  EXPECT_TRUE(detect_lines(white, LineViews(*camera), {})->empty());
}

TEST(DetectLines, RefusesAPictureOfAnotherCamera) {
  const auto camera = camera::Camera::create(small_pinhole()).value();
  const LineViews views(*camera);
  EXPECT_EQ(detect_lines(Image(640, 480, 3), views, {}).error().code, ErrorCode::kWrongImageSize);
  EXPECT_EQ(detect_lines(Image(), views, {}).error().code, ErrorCode::kEmptyInput);
}

}  // namespace
}  // namespace homeward::linemodel
