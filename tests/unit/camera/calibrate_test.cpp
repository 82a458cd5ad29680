// SPDX-License-Identifier: Apache-2.0
#include "camera/calibrate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/board_scene.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::camera::calibrate_test {
namespace {

using homeward::testing::add_noise;
using homeward::testing::corners_of;
using homeward::testing::HungBoard;
using homeward::testing::pose_of;
using ::testing::HasSubstr;

const BoardGeometry kBoard{8, 6, 0.04};
constexpr double kNoise_px = 0.1;

std::shared_ptr<const Camera> make(const CameraConfig& config) {
  const auto camera = Camera::create(config);
  EXPECT_TRUE(camera) << (camera ? "" : camera.error().message);
  return *camera;
}

/// Boards hung at random within these ranges, those that the camera sees whole.
std::vector<BoardView> views_of(const Camera& camera, int count, double azimuth_max_rad, double elevation_from_rad,
                                double elevation_to_rad, double tilt_max_rad, double noise_px = kNoise_px) {
  std::mt19937_64 random(3);
  const auto between = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  std::vector<BoardView> views;
  for (int tries = 0; tries < 1000 && static_cast<int>(views.size()) < count; ++tries) {
    HungBoard hung;
    hung.azimuth_rad = between(-azimuth_max_rad, azimuth_max_rad);
    hung.elevation_rad = between(elevation_from_rad, elevation_to_rad);
    hung.distance_m = between(0.3, 0.7);
    hung.tilt_about_x_rad = between(-tilt_max_rad, tilt_max_rad);
    hung.tilt_about_y_rad = between(-tilt_max_rad, tilt_max_rad);
    hung.roll_rad = between(-1.0, 1.0);
    auto corners = corners_of(camera, kBoard, pose_of(hung, kBoard));
    if (!corners) continue;
    add_noise(*corners, noise_px, random);
    views.push_back({"view " + std::to_string(views.size()), *corners});
  }
  EXPECT_EQ(static_cast<int>(views.size()), count);
  return views;
}

CalibrationInput input_for(const CameraConfig& truth, CalibratedModel model) {
  CalibrationInput input;
  input.model = model;
  input.board = kBoard;
  input.camera.width_px = truth.width_px;
  input.camera.height_px = truth.height_px;
  input.camera.robot_from_camera_rotation = truth.robot_from_camera_rotation;
  input.camera.robot_from_camera_translation_m = truth.robot_from_camera_translation_m;
  return input;
}

/// The typical (RMS) angle between the bearings of the two cameras, over the pixels of the corners seen.
double bearings_apart_deg(const Camera& truth, const Camera& found, const std::vector<BoardView>& views) {
  double sum_rad2 = 0.0;
  int count = 0;
  for (const BoardView& view : views) {
    for (const Eigen::Vector2d& pixel_px : view.corners_px) {
      const auto is = truth.bearing(pixel_px);
      const auto seems = found.bearing(pixel_px);
      if (!is) continue;
      if (!seems) return 180.0;
      sum_rad2 += std::pow(std::atan2(is->cross(*seems).norm(), is->dot(*seems)), 2);
      ++count;
    }
  }
  return degrees(std::sqrt(sum_rad2 / count));
}

/// What every good calibration shows: residuals of the noise's size, bearings as they are, and honest deviations.
void expect_recovered(const CameraConfig& truth, const CalibrationInput& input, const std::vector<BoardView>& views,
                      const Eigen::VectorXd& parameters) {
  const auto result = calibrate(input, views);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(result->rms_px, std::sqrt(2.0) * kNoise_px, 0.02);
  EXPECT_EQ(result->used.size(), views.size());
  EXPECT_TRUE(result->left_out.empty());
  EXPECT_THAT(result->warnings, ::testing::IsEmpty());
  EXPECT_LT(bearings_apart_deg(*make(truth), *make(result->config), views), 0.2);
  ASSERT_EQ(result->parameters.size(), static_cast<std::size_t>(parameters.size()));
  for (Eigen::Index k = 0; k < parameters.size(); ++k) {
    const ParameterDeviation& one = result->parameters[static_cast<std::size_t>(k)];
    EXPECT_GT(one.deviation, 0.0) << one.name;
    EXPECT_NEAR(one.value, parameters[k], 4.0 * one.deviation) << one.name;
  }
}

TEST(Calibrate, FindsAPinholeCamera) {
  const CameraConfig truth = homeward::testing::pinhole_camera();
  const auto views = views_of(*make(truth), 12, 0.4, -0.3, 0.3, 0.6);
  const auto& pinhole = std::get<Pinhole>(truth.model);
  const auto& d = pinhole.distortion;
  Eigen::VectorXd parameters(9);
  parameters << pinhole.intrinsics.fx_px, pinhole.intrinsics.fy_px, pinhole.intrinsics.cx_px, pinhole.intrinsics.cy_px,
      d[0], d[1], d[2], d[3], d[4];
  expect_recovered(truth, input_for(truth, CalibratedModel::kPinhole), views, parameters);
}

TEST(Calibrate, FindsAFisheyeBeyondARightAngle) {
  const CameraConfig truth = homeward::testing::fisheye_camera();
  const auto views = views_of(*make(truth), 14, 1.5, -1.0, 1.0, 0.6);
  const auto& fisheye = std::get<Fisheye>(truth.model);
  const auto& d = fisheye.distortion;
  Eigen::VectorXd parameters(8);
  parameters << fisheye.intrinsics.fx_px, fisheye.intrinsics.fy_px, fisheye.intrinsics.cx_px, fisheye.intrinsics.cy_px,
      d[0], d[1], d[2], d[3];
  expect_recovered(truth, input_for(truth, CalibratedModel::kFisheye), views, parameters);
}

TEST(Calibrate, FindsAHyperbolicMirrorAsAUnifiedModel) {
  // The unified model describes this mirror exactly, and turned over: a lens's picture of the same bearings would have
  // up and down exchanged.
  const CameraConfig truth = homeward::testing::mirror_camera();
  const auto views = views_of(*make(truth), 16, 3.1, -0.8, 0.2, 0.6);
  CalibrationInput input = input_for(truth, CalibratedModel::kMei);
  input.mirror = true;
  // x in the picture stays, y points up in it and z down.
  input.camera.robot_from_camera_rotation =
      truth.robot_from_camera_rotation * Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  const auto result = calibrate(input, views);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(result->rms_px, std::sqrt(2.0) * kNoise_px, 0.02);
  EXPECT_LT(std::get<Mei>(result->config.model).intrinsics.fy_px, 0.0);
  EXPECT_LT(bearings_apart_deg(*make(truth), *make(result->config), views), 0.4);
  input.mirror = false;
  const auto as_lens = calibrate(input, views);
  ASSERT_TRUE(as_lens);
  EXPECT_GT(bearings_apart_deg(*make(truth), *make(as_lens->config), views), 20.0);
}

TEST(Calibrate, LeavesAViewWithWrongCornersOutAndNamesIt) {
  const CameraConfig truth = homeward::testing::mei_camera();
  auto views = views_of(*make(truth), 12, 1.0, -0.7, 0.7, 0.6);
  std::mt19937_64 random(5);
  add_noise(views[4].corners_px, 6.0, random);
  const auto result = calibrate(input_for(truth, CalibratedModel::kMei), views);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->left_out.size(), 1U);
  EXPECT_EQ(result->left_out[0].view, 4U);
  EXPECT_THAT(result->left_out[0].reason, HasSubstr("px off"));
  EXPECT_EQ(result->used.size(), 11U);
  EXPECT_NEAR(result->rms_px, std::sqrt(2.0) * kNoise_px, 0.02);
}

TEST(Calibrate, WarnsWhenAllBoardsAreParallel) {
  const CameraConfig truth = homeward::testing::pinhole_camera();
  std::vector<BoardView> views;
  std::mt19937_64 random(9);
  for (const double distance_m : {0.5, 0.6, 0.7, 0.8}) {
    auto corners = corners_of(*make(truth), kBoard, pose_of(HungBoard{0, 0, distance_m, 0, 0, 0.3}, kBoard));
    ASSERT_TRUE(corners);
    add_noise(*corners, kNoise_px, random);
    views.push_back({std::to_string(distance_m), *corners});
  }
  const auto result = calibrate(input_for(truth, CalibratedModel::kPinhole), views);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_THAT(result->warnings, ::testing::Contains(HasSubstr("nearly parallel")));
  EXPECT_THAT(result->warnings, ::testing::Contains(HasSubstr("focal length")));
}

TEST(Calibrate, WarnsWhenTheCornersCoverLittleOfThePicture) {
  const CameraConfig truth = homeward::testing::pinhole_camera();
  std::vector<BoardView> views;
  for (const double tilt_rad : {-0.7, -0.3, 0.3, 0.7}) {
    const auto corners =
        corners_of(*make(truth), kBoard, pose_of(HungBoard{0, 0, 1.5, tilt_rad, 0.5 - tilt_rad, 0}, kBoard));
    ASSERT_TRUE(corners);
    views.push_back({std::to_string(tilt_rad), *corners});
  }
  const auto result = calibrate(input_for(truth, CalibratedModel::kPinhole), views);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_THAT(result->warnings, ::testing::Contains(HasSubstr("cover only")));
}

TEST(Calibrate, RefusesWhatCannotBeCalibrated) {
  const CameraConfig truth = homeward::testing::mei_camera();
  const auto views = views_of(*make(truth), 3, 1.0, -0.7, 0.7, 0.6);
  const CalibrationInput good = input_for(truth, CalibratedModel::kMei);
  const auto refused = [](const CalibrationInput& input, const std::vector<BoardView>& some, const char* what) {
    const auto result = calibrate(input, some);
    ASSERT_FALSE(result) << what;
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidInput);
    EXPECT_THAT(result.error().message, HasSubstr(what));
  };
  refused(good, {}, "Only 0 views");
  refused(good, {views[0], views[1]}, "at least 3");
  std::vector<BoardView> short_one = views;
  short_one[1].corners_px.pop_back();
  refused(good, short_one, "one finite pixel");
  short_one = views;
  short_one[2].corners_px[3].x() = std::nan("");
  refused(good, short_one, "one finite pixel");
  CalibrationInput wrong = good;
  wrong.board.square_m = 0.0;
  refused(wrong, views, "square");
  wrong = good;
  wrong.camera.width_px = 0;
  refused(wrong, views, "size");
  wrong = input_for(truth, CalibratedModel::kPinhole);
  wrong.mirror = true;
  refused(wrong, views, "mei");
  // All corners in one pixel.
  std::vector<BoardView> points = views;
  for (BoardView& view : points) {
    for (Eigen::Vector2d& at_px : view.corners_px) at_px = {300.0, 200.0};
  }
  refused(good, points, "apart");
}

}  // namespace
}  // namespace homeward::camera::calibrate_test
