// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "camera/camera.hpp"
#include "camera/models.hpp"
#include "core/angles.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::camera::models_test {
namespace {

using homeward::testing::fisheye_camera;
using homeward::testing::mei_camera;
using homeward::testing::mirror_camera;
using homeward::testing::pinhole_camera;
using homeward::testing::sphere_camera;

Eigen::Vector3d towards(double azimuth_deg, double elevation_deg) {
  const double azimuth_rad = radians(azimuth_deg);
  const double elevation_rad = radians(elevation_deg);
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

std::shared_ptr<const Camera> make(const CameraConfig& config) {
  const auto camera = Camera::create(config);
  EXPECT_TRUE(camera) << (camera ? "" : camera.error().message);
  return *camera;
}

/// Every 7th pixel there and back; gives how many saw the world.
int round_trip(const CameraConfig& config) {
  const auto camera = make(config);
  int seen = 0;
  for (int v = 0; v < config.height_px; v += 7) {
    for (int u = 0; u < config.width_px; u += 7) {
      const Eigen::Vector2d pixel_px(u + 0.25, v + 0.125);
      const auto bearing = camera->bearing(pixel_px);
      if (!bearing) continue;
      ++seen;
      EXPECT_NEAR(bearing->norm(), 1.0, 1e-12);
      const auto back_px = camera->pixel(*bearing);
      if (!back_px) {
        ADD_FAILURE() << "the bearing of pixel " << u << " " << v << " has no pixel";
        continue;
      }
      EXPECT_LT((*back_px - pixel_px).norm(), 1e-8) << u << " " << v;
      const auto again = camera->bearing(*back_px);
      EXPECT_TRUE(again && (*again - *bearing).norm() < 1e-9) << u << " " << v;
    }
  }
  return seen;
}

/// The same picture, turned over as a mirror's is.
CameraConfig turned_over_mei() {
  CameraConfig config = mei_camera();
  auto& mei = std::get<Mei>(config.model);
  mei.intrinsics.fy_px = -mei.intrinsics.fy_px;
  mei.distortion[2] = -mei.distortion[2];
  return config;
}

TEST(CameraModels, ANegativeFocalLengthTurnsTheMirrorsPictureOver) {
  EXPECT_EQ(round_trip(turned_over_mei()), round_trip(mei_camera()));
  const Eigen::Vector2d pixel_px(400.0, 320.0);
  const auto lens = std::get<Mei>(mei_camera().model);
  const auto mirror = std::get<Mei>(turned_over_mei().model);
  const auto through_lens = direction_from_pixel(lens, pixel_px);
  const auto in_mirror = direction_from_pixel(mirror, pixel_px);
  ASSERT_TRUE(through_lens && in_mirror);
  const Eigen::Vector3d flipped(through_lens->x(), -through_lens->y(), through_lens->z());
  EXPECT_LT((*in_mirror - flipped).norm(), 1e-9);
  CameraConfig none = mei_camera();
  std::get<Mei>(none.model).intrinsics.fy_px = 0.0;
  EXPECT_FALSE(problems(none).empty());
}

TEST(CameraModels, PixelsGoThereAndBackInEveryModel) {
  EXPECT_GT(round_trip(mirror_camera()), 3000);
  EXPECT_GT(round_trip(sphere_camera()), 2500);
  EXPECT_GT(round_trip(pinhole_camera()), 6000);
  EXPECT_GT(round_trip(fisheye_camera()), 3400);
  for (const double xi : {0.0, 0.5, 0.96, 1.0, 1.4}) EXPECT_GT(round_trip(mei_camera(xi)), 3000) << xi;
}

TEST(CameraModels, BearingsGoThereAndBack) {
  const auto mirror = make(mirror_camera());
  const auto sphere = make(sphere_camera());
  int seen = 0;
  for (double azimuth_deg = -179.0; azimuth_deg < 180.0; azimuth_deg += 11.0) {
    for (double elevation_deg = -85.0; elevation_deg < 86.0; elevation_deg += 5.0) {
      const Eigen::Vector3d bearing = towards(azimuth_deg, elevation_deg);
      const auto on_sphere = sphere->pixel(bearing);
      ASSERT_TRUE(on_sphere);
      EXPECT_LT((*sphere->bearing(*on_sphere) - bearing).norm(), 1e-9);
      const auto on_mirror = mirror->pixel(bearing);
      if (!on_mirror) continue;
      ++seen;
      EXPECT_LT((*mirror->bearing(*on_mirror) - bearing).norm(), 1e-9) << azimuth_deg << " " << elevation_deg;
    }
  }
  EXPECT_GT(seen, 33 * 14);  // -60 to 15 degrees at least, whatever the azimuth
}

TEST(MirrorCamera, ForwardIsAtTheTopAndLeftAtTheRight) {
  const auto camera = make(mirror_camera());
  const Eigen::Vector2d ahead = *camera->pixel(towards(0.0, 0.0));
  EXPECT_NEAR(ahead.x(), 319.5, 1e-4);
  EXPECT_NEAR(ahead.y(), 239.5 - 159.6, 0.05);
  const Eigen::Vector2d left = *camera->pixel(towards(90.0, 0.0));
  EXPECT_NEAR(left.x(), 319.5 + 159.6, 0.05);
  EXPECT_NEAR(left.y(), 239.5, 1e-4);
}

TEST(MirrorCamera, RadiusOfAnElevationIsTheDesigns) {
  const auto camera = make(mirror_camera());
  const Eigen::Vector2d centre(319.5, 239.5);
  for (const double azimuth_deg : {0.0, 37.0, -120.0}) {
    EXPECT_NEAR((*camera->pixel(towards(azimuth_deg, 0.0)) - centre).norm(), 159.6, 0.05);
    EXPECT_NEAR((*camera->pixel(towards(azimuth_deg, -60.0)) - centre).norm(), 42.1, 0.05);
  }
  // Radius grows with elevation up to the rim, and nothing is seen above it or within the camera's own picture.
  EXPECT_LT((*camera->pixel(towards(10.0, -20.0)) - centre).norm(),
            (*camera->pixel(towards(10.0, 5.0)) - centre).norm());
  EXPECT_FALSE(camera->pixel(towards(10.0, 45.0)));
  EXPECT_FALSE(camera->pixel(towards(10.0, -85.0)));
  EXPECT_FALSE(camera->bearing(centre));
  EXPECT_FALSE(camera->bearing({5.0, 5.0}));
}

TEST(SphereCamera, ForwardIsInTheCentreAndColumnsMeetBehind) {
  const auto camera = make(sphere_camera(512));
  EXPECT_LT((*camera->pixel(towards(0.0, 0.0)) - Eigen::Vector2d(255.5, 127.5)).norm(), 1e-9);
  EXPECT_NEAR(camera->pixel(towards(90.0, 0.0))->x(), 127.5, 1e-9);
  EXPECT_NEAR(camera->pixel(towards(0.0, 45.0))->y(), 63.5, 1e-9);
  const double just_left_of_behind = camera->pixel(towards(179.9, 0.0))->x();
  const double just_right_of_behind = camera->pixel(towards(-179.9, 0.0))->x();
  EXPECT_LT(just_left_of_behind, 0.0);
  EXPECT_GT(just_right_of_behind, 511.0);
}

TEST(PinholeCamera, SeesWhatIsAheadOnly) {
  CameraConfig config = pinhole_camera();
  std::get<Pinhole>(config.model).distortion = {};
  const auto camera = make(config);
  EXPECT_LT((*camera->pixel(towards(0.0, 0.0)) - Eigen::Vector2d(319.5, 239.5)).norm(), 1e-9);
  const double tangent = std::tan(radians(20.0));
  EXPECT_NEAR(camera->pixel(towards(20.0, 0.0))->x(), 319.5 - 457.0 * tangent, 1e-9);  // left on the left
  EXPECT_NEAR(camera->pixel(towards(0.0, 20.0))->y(), 239.5 - 455.0 * tangent, 1e-9);
  EXPECT_FALSE(camera->pixel(towards(180.0, 0.0)));
  EXPECT_FALSE(camera->pixel(towards(60.0, 0.0)));  // outside the picture
  EXPECT_FALSE(camera->bearing({-1.0, 20.0}));
  EXPECT_FALSE(camera->bearing({20.0, 480.0}));
}

TEST(FisheyeCamera, IsEquidistantWithoutDistortionAndSeesBehindItsPlane) {
  CameraConfig config = fisheye_camera();
  std::get<Fisheye>(config.model) = {{150.0, 150.0, 320.0, 240.0}, {}, {}};
  const auto camera = make(config);
  // It looks up: the horizon is a quarter turn off its axis. Forward is at the top, left at the right.
  EXPECT_LT((*camera->pixel(towards(0.0, 0.0)) - Eigen::Vector2d(320.0, 240.0 - 150.0 * kPi / 2)).norm(), 1e-9);
  EXPECT_LT((*camera->pixel(towards(90.0, 30.0)) - Eigen::Vector2d(320.0 + 50.0 * kPi, 240.0)).norm(), 1e-9);
  EXPECT_LT((*camera->pixel(towards(90.0, -10.0)) - Eigen::Vector2d(320.0 + 150.0 * radians(100.0), 240.0)).norm(),
            1e-9);
  EXPECT_LT((*camera->bearing({320.0, 240.0}) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(FisheyeCamera, SeesNothingWhereItsDistortionFoldsOver) {
  CameraConfig config = fisheye_camera();
  std::get<Fisheye>(config.model) = {{300.0, 300.0, 319.5, 239.5}, {-0.3, 0.0, 0.0, 0.0}, {}};
  const auto camera = make(config);  // the radius turns back at 1 / sqrt(0.9) radians
  EXPECT_TRUE(camera->pixel(towards(90.0, 90.0 - degrees(1.0))));
  EXPECT_FALSE(camera->pixel(towards(90.0, 90.0 - degrees(1.1))));
  EXPECT_FALSE(camera->bearing({319.5 + 300.0 * 0.75, 239.5}));
}

TEST(MeiCamera, IsAPinholeAtXiZeroAndTheParabolicMirrorAtXiOne) {
  CameraConfig config = mei_camera();
  std::get<Mei>(config.model) = {{200.0, 200.0, 319.5, 239.5}, 0.0, {}, {}};
  const auto pinhole = make(config);
  EXPECT_NEAR((*pinhole->pixel(towards(0.0, 50.0)) - Eigen::Vector2d(319.5, 239.5)).norm(),
              200.0 * std::tan(radians(40.0)), 1e-9);
  EXPECT_FALSE(pinhole->pixel(towards(0.0, -1.0)));
  std::get<Mei>(config.model).xi = 1.0;  // r = f tan(t / 2)
  const auto parabola = make(config);
  EXPECT_NEAR((*parabola->pixel(towards(0.0, 0.0)) - Eigen::Vector2d(319.5, 239.5)).norm(), 200.0, 1e-9);
  EXPECT_NEAR((*parabola->pixel(towards(0.0, -5.0)) - Eigen::Vector2d(319.5, 239.5)).norm(),
              200.0 * std::tan(radians(95.0 / 2)), 1e-9);
}

TEST(MeiCamera, BeyondTheContourNothingIsSeen) {
  CameraConfig config = mei_camera();
  std::get<Mei>(config.model) = {{300.0, 300.0, 319.5, 239.5}, 2.0, {}, {}};
  const auto camera = make(config);  // contour at z = -1/2: 120 degrees off the axis
  EXPECT_TRUE(camera->pixel(towards(0.0, -29.9)));
  EXPECT_FALSE(camera->pixel(towards(0.0, -30.1)));
  EXPECT_FALSE(camera->bearing({319.5 + 300.0 / std::sqrt(3.0) + 1.0, 239.5}));
}

TEST(BearingTable, HoldsTheBearingOfEachPixel) {
  const auto camera = make(mirror_camera());
  const BearingTable table = bearing_table(*camera);
  ASSERT_EQ(table.valid.size(), 640U * 480U);
  int valid = 0;
  for (int v = 0; v < 480; v += 11) {
    for (int u = 0; u < 640; u += 11) {
      const auto expected = camera->bearing({u, v});
      const int row = v * 640 + u;
      ASSERT_EQ(table.valid[static_cast<std::size_t>(row)] == 1, expected.has_value());
      if (!expected) continue;
      ++valid;
      EXPECT_LT((table.bearings.row(row).transpose() - expected->cast<float>()).norm(), 1e-6F);
    }
  }
  EXPECT_GT(valid, 1000);
}

TEST(CameraProblems, EachIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const CameraConfig& config, const std::string& word) {
    const auto camera = Camera::create(config);
    ASSERT_FALSE(camera) << word;
    EXPECT_EQ(camera.error().code, ErrorCode::kInvalidInput);
    EXPECT_NE(camera.error().message.find(word), std::string::npos) << camera.error().message;
  };
  EXPECT_TRUE(problems(mirror_camera()).empty());
  EXPECT_TRUE(problems(sphere_camera()).empty());
  EXPECT_TRUE(problems(pinhole_camera()).empty());
  EXPECT_TRUE(problems(fisheye_camera()).empty());
  EXPECT_TRUE(problems(mei_camera()).empty());

  CameraConfig config = mirror_camera();
  config.width_px = -640;
  refused(config, "width_px");
  config.width_px = 1 << 20;
  refused(config, "width_px");
  config = mirror_camera();
  config.robot_from_camera_rotation.coeffs() *= 1.1;
  refused(config, "rotation_wxyz");
  config.robot_from_camera_rotation.w() = nan;
  refused(config, "rotation_wxyz");
  config = mirror_camera();
  config.robot_from_camera_translation_m.y() = nan;
  refused(config, "translation_m");
  config = mirror_camera();
  std::get<HyperbolicMirror>(config.model).a_mm = -1.0;
  refused(config, "a_mm");
  std::get<HyperbolicMirror>(config.model).a_mm = nan;
  refused(config, "a_mm");
  config = mirror_camera(300.0);
  refused(config, "valid_radius_px");
  config = pinhole_camera();
  std::get<Pinhole>(config.model).intrinsics.fx_px = 0.0;
  refused(config, "fx_px");
  std::get<Pinhole>(config.model).intrinsics = {400.0, 400.0, nan, 0.0};
  refused(config, "cx_px");
  config = pinhole_camera();
  std::get<Pinhole>(config.model).distortion[2] = nan;
  refused(config, "distortion");
  config = fisheye_camera();
  std::get<Fisheye>(config.model).distortion[3] = nan;
  refused(config, "distortion");
  config = fisheye_camera();
  std::get<Fisheye>(config.model).valid = {90.0, 80.0};
  refused(config, "valid_radius_px");
  refused(mei_camera(-0.1), "xi");
  refused(mei_camera(nan), "xi");
}

TEST(CameraProblems, AllAreToldAtOnce) {
  CameraConfig config = pinhole_camera();
  config.height_px = 0;
  config.robot_from_camera_rotation.coeffs() *= 2.0;
  std::get<Pinhole>(config.model).intrinsics.fy_px = -1.0;
  EXPECT_EQ(problems(config).size(), 3U);
}

}  // namespace
}  // namespace homeward::camera::models_test
