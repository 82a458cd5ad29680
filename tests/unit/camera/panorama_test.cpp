// SPDX-License-Identifier: Apache-2.0
#include "camera/panorama.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::camera::panorama_test {
namespace {

using homeward::testing::mirror_camera;
using homeward::testing::sphere_camera;

std::shared_ptr<const Camera> make(const CameraConfig& config) { return Camera::create(config).value(); }

/// A smooth world: colour depends on the direction alone, seen from a robot that has turned.
std::array<std::uint8_t, 3> colour_of(const Eigen::Vector3d& bearing, double heading_rad) {
  const double azimuth_rad = std::atan2(bearing.y(), bearing.x()) + heading_rad;
  const auto wave = [&](double phase_rad) {
    return static_cast<std::uint8_t>(std::lround(127.5 + 60.0 * std::cos(azimuth_rad - phase_rad) +
                                                 40.0 * std::cos(3.0 * azimuth_rad + phase_rad) + 25.0 * bearing.z()));
  };
  return {wave(0.0), wave(2.1), wave(4.2)};
}

Image picture_of(const Camera& camera, double heading_rad) {
  Image picture(camera.config().width_px, camera.config().height_px, 3);
  for (int v = 0; v < picture.height_px; ++v) {
    for (int u = 0; u < picture.width_px; ++u) {
      const auto bearing = camera.bearing({u, v});
      if (!bearing) continue;
      const auto colour = colour_of(*bearing, heading_rad);
      std::copy(colour.begin(), colour.end(), picture.at(u, v));
    }
  }
  return picture;
}

PanoramaGeometry geometry_of(int width_px) {
  PanoramaGeometry geometry;
  geometry.width_px = width_px;
  return geometry;
}

TEST(PanoramaGeometry, ForwardIsInTheCentreAndLeftOnTheLeft) {
  const PanoramaGeometry geometry = geometry_of(1024);
  EXPECT_NEAR(geometry.pixel({1.0, 0.0, 0.0}).x(), 511.5, 1e-9);
  EXPECT_NEAR(geometry.pixel({0.0, 1.0, 0.0}).x(), 255.5, 1e-9);
  EXPECT_NEAR(geometry.pixel({0.0, -1.0, 0.0}).x(), 767.5, 1e-9);
  EXPECT_NEAR(geometry.pixel({-1.0, 1e-9, 0.0}).x(), -0.5, 1e-5);
  EXPECT_EQ(geometry.height_px(), 210);  // square pixels
  EXPECT_GT(geometry.bearing({10.0, 0.0}).z(), geometry.bearing({10.0, 1.0}).z());
  EXPECT_NEAR(geometry.bearing({10.0, -0.5}).z(), std::sin(0.34), 1e-12);
}

TEST(PanoramaGeometry, PixelsGoThereAndBackAndWrap) {
  const PanoramaGeometry geometry = geometry_of(360);
  for (double u = -0.5; u < 359.5; u += 12.7) {
    const Eigen::Vector2d pixel_px(u, 20.3);
    EXPECT_LT((geometry.pixel(geometry.bearing(pixel_px)) - pixel_px).norm(), 1e-9) << u;
    EXPECT_LT((geometry.bearing(pixel_px) - geometry.bearing({u + 360.0, 20.3})).norm(), 1e-12) << u;
  }
}

TEST(PanoramaUnwrapper, EachPixelShowsTheWorldOfItsBearing) {
  for (const CameraConfig& config : {mirror_camera(), sphere_camera(1024)}) {
    const auto camera = make(config);
    const auto panorama = PanoramaUnwrapper(*camera, geometry_of(512)).unwrap(picture_of(*camera, 0.0));
    ASSERT_TRUE(panorama);
    ASSERT_EQ(panorama->valid.size(), 512U * static_cast<unsigned>(panorama->geometry.height_px()));
    int wrong = 0;
    int seen = 0;
    for (int v = 3; v < panorama->rgb.height_px - 3; v += 3) {
      for (int u = 0; u < 512; ++u) {  // the seam too
        if (panorama->valid[static_cast<std::size_t>(v * 512 + u)] == 0) continue;
        const Eigen::Vector3d bearing = panorama->geometry.bearing({u, v});
        if (bearing.z() > 0.3 || bearing.z() < -0.75) continue;  // the ring's rims blend with what is not seen
        ++seen;
        const auto expected = colour_of(bearing, 0.0);
        const std::uint8_t* shown = panorama->rgb.at(u, v);
        for (int band = 0; band < 3; ++band) {
          if (std::abs(shown[band] - expected[static_cast<std::size_t>(band)]) > 3) ++wrong;
        }
      }
    }
    EXPECT_GT(seen, 512 * 20);
    EXPECT_EQ(wrong, 0) << "of " << seen;
  }
}

TEST(PanoramaUnwrapper, ATurnIsAShiftOfColumns) {
  constexpr int kShiftPx = 64;  // an eighth of 512 columns: 45 degrees
  for (const CameraConfig& config : {mirror_camera(), sphere_camera(1024)}) {
    const auto camera = make(config);
    const PanoramaUnwrapper unwrapper(*camera, geometry_of(512));
    const Panorama before = unwrapper.unwrap(picture_of(*camera, 0.0)).value();
    const Panorama after = unwrapper.unwrap(picture_of(*camera, radians(45.0))).value();
    // Turned to the left, the world moves to the right.
    int largest = 0;
    for (int v = 10; v < 80; v += 5) {
      for (int u = 0; u < 512; ++u) {
        for (int band = 0; band < 3; ++band) {
          largest =
              std::max(largest, std::abs(before.rgb.at(u, v)[band] - after.rgb.at((u + kShiftPx) % 512, v)[band]));
        }
      }
    }
    EXPECT_LE(largest, 3);
  }
}

TEST(PanoramaUnwrapper, MarksWhatTheCameraDoesNotSee) {
  const auto camera = make(mirror_camera(150.0));  // sees little below the horizon
  const Panorama panorama = PanoramaUnwrapper(*camera, geometry_of(256)).unwrap(picture_of(*camera, 0.0)).value();
  const int bottom = (panorama.rgb.height_px - 1) * 256 + 30;
  EXPECT_EQ(panorama.valid[static_cast<std::size_t>(bottom)], 0);
  EXPECT_EQ(panorama.valid[static_cast<std::size_t>(12 * 256 + 30)], 1);
  EXPECT_EQ(static_cast<int>(panorama.rgb.at(30, panorama.rgb.height_px - 1)[0]), 0);
}

TEST(PanoramaUnwrapper, RefusesPicturesOfAnotherSize) {
  const auto camera = make(sphere_camera(512));
  const PanoramaUnwrapper unwrapper(*camera, geometry_of(256));
  for (const Image& picture : {Image(511, 256, 3), Image(256, 512, 3)}) {
    const auto panorama = unwrapper.unwrap(picture);
    ASSERT_FALSE(panorama);
    EXPECT_EQ(panorama.error().code, ErrorCode::kWrongImageSize);
  }
  const auto empty = unwrapper.unwrap(Image());
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::kEmptyInput);
  const auto four_bands = unwrapper.unwrap(Image(512, 256, 4));
  ASSERT_FALSE(four_bands);
  EXPECT_EQ(four_bands.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(unwrapper.unwrap(Image(511, 256, 3)).error().message.find("511 x 256"), std::string::npos);
}

TEST(PanoramaUnwrapper, AGreyPictureGivesThreeEqualBands) {
  const auto camera = make(sphere_camera(512));
  const PanoramaUnwrapper unwrapper(*camera, geometry_of(256));
  Image grey(512, 256, 1);
  for (std::size_t i = 0; i < grey.data.size(); ++i) grey.data[i] = static_cast<std::uint8_t>(i / 512);
  Image colour(512, 256, 3);
  for (std::size_t i = 0; i < colour.data.size(); ++i) colour.data[i] = grey.data[i / 3];
  EXPECT_EQ(unwrapper.unwrap(grey).value().rgb.data, unwrapper.unwrap(colour).value().rgb.data);
}

}  // namespace
}  // namespace homeward::camera::panorama_test
