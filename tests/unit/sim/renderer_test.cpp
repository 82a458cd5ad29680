// SPDX-License-Identifier: Apache-2.0
#include "sim/renderer.hpp"

#include <gtest/gtest.h>

#include "sim/generate/worlds.hpp"
#include "sim/scene_rays.hpp"
#include "sim/tessellate.hpp"
#include "support/box_world.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::sim::renderer_test {
namespace {

std::shared_ptr<const camera::Camera> made(const camera::CameraConfig& config) {
  auto camera = camera::Camera::create(config);
  EXPECT_TRUE(camera) << camera.error().message;
  return *camera;
}

camera::CameraConfig small_pinhole() {
  camera::CameraConfig config;
  config.width_px = 64;
  config.height_px = 48;
  config.model = camera::Pinhole{{46.0, 46.0, 31.5, 23.5}, {}};
  config.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  config.robot_from_camera_rotation = homeward::testing::looking_forward();
  return config;
}

camera::CameraConfig small_sphere() {
  camera::CameraConfig config = homeward::testing::sphere_camera(96);
  config.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  return config;
}

/// The usual mirror camera in a quarter of its size.
camera::CameraConfig small_mirror() {
  camera::CameraConfig config = homeward::testing::mirror_camera();
  config.width_px = 160;
  config.height_px = 120;
  config.model = camera::HyperbolicMirror{{149.6, 149.6, 79.5, 59.5}, 28.095, 23.4125, 11.0, 57.5};
  return config;
}

struct Colour {
  int r = 0;
  int g = 0;
  int b = 0;
};

Colour at(const Image& image, const Eigen::Vector2d& pixel_px) {
  const std::uint8_t* rgb =
      image.at(static_cast<int>(std::lround(pixel_px.x())), static_cast<int>(std::lround(pixel_px.y())));
  return {rgb[0], rgb[1], rgb[2]};
}

class RendererTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { world_ = new LitWorld(homeward::testing::box_world()); }
  static void TearDownTestSuite() {
    delete world_;
    world_ = nullptr;
  }
  static Image picture(const camera::CameraConfig& config, const Pose2& pose, const Light& light = LightPreset::kDay,
                       const std::vector<Person>& people = {}, std::uint64_t seed = 1) {
    return Renderer(*world_, light, made(config)).render(pose, people, seed);
  }
  static LitWorld* world_;
};
LitWorld* RendererTest::world_ = nullptr;

TEST_F(RendererTest, SeesTheColourOfTheWallAhead) {
  const auto middle = [&](double theta_rad) { return at(picture(small_pinhole(), {0.0, 0.0, theta_rad}), {32, 24}); };
  const Colour red = middle(0.0);
  EXPECT_GT(red.r, 2 * red.g);
  EXPECT_GT(red.r, 2 * red.b);
  const Colour green = middle(kPi / 2.0);
  EXPECT_GT(green.g, 2 * green.r);
  const Colour blue = middle(kPi);
  EXPECT_GT(blue.b, 2 * blue.r);
  const Colour yellow = middle(-kPi / 2.0);
  EXPECT_GT(yellow.r, 2 * yellow.b);
  EXPECT_GT(yellow.g, 2 * yellow.b);
}

TEST_F(RendererTest, LeftIsLeftInThePicture) {
  // From the middle of the room the camera sees the corner of red and green at its left.
  camera::CameraConfig wide = small_pinhole();
  wide.model = camera::Pinhole{{20.0, 20.0, 31.5, 23.5}, {}};
  const Image image = picture(wide, {0.0, 0.0, 0.0});
  const Colour left = at(image, {1, 24});
  EXPECT_GT(left.g, 2 * left.r);
  const Colour right = at(image, {62, 24});
  EXPECT_GT(right.r, 2 * right.b);
  EXPECT_GT(right.g, 2 * right.b);
}

TEST_F(RendererTest, WhoStandsSeesWhatAFreshLookSees) {
  const Renderer standing(*world_, LightPreset::kDay, made(small_sphere()));
  const Pose2 pose{0.3, 0.2, 0.5};
  const std::vector<std::vector<Person>> crowds = {{}, {{1.0, 0.4, 5}}, {}, {{0.9, -0.4, 6}, {1.0, 0.4, 5}}, {}};
  std::uint64_t seed = 1;
  for (const Pose2& at : {pose, Pose2{0.3, 0.2, 0.6}, pose}) {
    for (const std::vector<Person>& people : crowds) {
      const std::vector<Box> boxes = seed % 2 == 0 ? std::vector<Box>{} : std::vector<Box>{{{-1.0, 0.2, 0.3}}};
      const Renderer fresh(*world_, LightPreset::kDay, made(small_sphere()));
      EXPECT_EQ(standing.render(at, people, seed, boxes).data, fresh.render(at, people, seed, boxes).data) << seed;
      ++seed;
    }
  }
}

TEST_F(RendererTest, SameCallSameBytes) {
  const Renderer renderer(*world_, LightPreset::kDay, made(small_sphere()));
  const Pose2 pose{0.3, 0.2, 0.5};
  const std::vector<Person> people = {{1.0, 0.4, 5}};
  EXPECT_EQ(renderer.render(pose, people, 7).data, renderer.render(pose, people, 7).data);
  EXPECT_EQ(renderer.render(pose, people, 7).data, picture(small_sphere(), pose, LightPreset::kDay, people, 7).data);
  EXPECT_NE(renderer.render(pose, people, 7).data, renderer.render(pose, people, 8).data);  // other noise
}

TEST_F(RendererTest, AllCamerasSeeTheSameWorld) {
  const Pose2 pose{0.4, -0.3, 0.6};
  const auto mirror = made(small_mirror());
  const auto sphere = made(small_sphere());
  const Image in_mirror = picture(small_mirror(), pose);
  const Image in_sphere = picture(small_sphere(), pose);
  int compared = 0;
  for (int azimuth_deg = -180; azimuth_deg < 180; azimuth_deg += 15) {
    for (const int elevation_deg : {-35, -20, -5, 10}) {
      const double azimuth_rad = radians(azimuth_deg);
      const double elevation_rad = radians(elevation_deg);
      const Eigen::Vector3d bearing(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                    std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad));
      const auto one = mirror->pixel(bearing);
      const auto two = sphere->pixel(bearing);
      if (!one || !two) continue;
      const Colour a = at(in_mirror, *one);
      const Colour b = at(in_sphere, *two);
      // Pixels on an edge between two walls may show either.
      const int apart = std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
      compared += apart < 25 ? 1 : 0;
    }
  }
  EXPECT_GE(compared, 86);  // of 96
}

TEST_F(RendererTest, ATurnOfTheRobotShiftsTheColumnsOfASphere) {
  const Image ahead = picture(small_sphere(), {0.2, 0.1, 0.0});
  const Image turned = picture(small_sphere(), {0.2, 0.1, 2.0 * kPi * 8.0 / 96.0});
  int same = 0;
  for (int u = 0; u < 96; ++u) {
    // Eight columns to the left is what was ahead before.
    const Colour a = at(ahead, {u, 24});
    const Colour b = at(turned, {(u + 8) % 96, 24});
    same += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) < 20 ? 1 : 0;
  }
  EXPECT_GE(same, 92);
}

TEST_F(RendererTest, PeopleStandInTheWay) {
  const Image without = picture(small_pinhole(), {});
  const Image with = picture(small_pinhole(), {}, LightPreset::kDay, {{1.0, 0.0, 12}});
  const Colour before = at(without, {32, 24});
  const Colour after = at(with, {32, 24});
  EXPECT_GT(std::abs(before.r - after.r) + std::abs(before.g - after.g) + std::abs(before.b - after.b), 60);
  const Colour beside_before = at(without, {2, 24});
  const Colour beside = at(with, {2, 24});
  EXPECT_LT(std::abs(beside_before.r - beside.r), 10);
}

TEST_F(RendererTest, NightDiffersFromDay) {
  const auto mean = [](const Image& image) {
    double sum = 0.0;
    for (const std::uint8_t value : image.data) sum += value;
    return sum / static_cast<double>(image.data.size());
  };
  const double day = mean(picture(small_sphere(), {}));
  const double night = mean(picture(small_sphere(), {}, LightPreset::kNight));
  EXPECT_GT(day, 20.0);
  EXPECT_LT(day, 235.0);
  EXPECT_GT(std::abs(day - night), 3.0);
  EXPECT_GT(night, 10.0);  // a lamp burns
}

TEST_F(RendererTest, MoreDaylightIsNeverDarkerAndEndsAtNightAndDay) {
  EXPECT_EQ(picture(small_sphere(), {}, Light::of_daylight(1.0)).data, picture(small_sphere(), {}).data);
  EXPECT_EQ(picture(small_sphere(), {}, Light::of_daylight(0.0)).data,
            picture(small_sphere(), {}, LightPreset::kNight).data);
  const World house = generate_house(1);
  const raycast::RayScene rays = rays_of(house.scene);
  const auto brightness = [&](double level) {
    LightSettings settings = light_settings(Light::of_daylight(level));
    settings.gather_rays = 6;  // coarse, and quick
    return compute_irradiance(house.scene, rays, house.lamps, settings).corners.mean() * settings.exposure;
  };
  double before = 0.0;
  for (const double level : {0.0, 0.1, 0.5, 1.0}) {
    const double now = brightness(level);
    EXPECT_GT(now, before) << level;
    before = now;
  }
}

TEST_F(RendererTest, LightThatWasKeptFits) {
  Irradiance light = world_->irradiance(LightPreset::kDay);
  Irradiance wrong;
  wrong.corners.setZero(3, 3);
  EXPECT_FALSE(world_->set_irradiance(LightPreset::kDay, wrong));
  EXPECT_TRUE(world_->set_irradiance(LightPreset::kDay, light));
  EXPECT_NE(world_->light_key(LightPreset::kDay), world_->light_key(LightPreset::kNight));
  LitWorld other(homeward::testing::box_world(true));
  EXPECT_NE(world_->light_key(LightPreset::kDay), other.light_key(LightPreset::kDay));
}

TEST(Tessellate, KeepsTheSurfaceInSmallerPieces) {
  const Scene scene = homeward::testing::box_world().scene;
  const Scene fine = tessellate(scene, 0.5F);
  const auto area_m2 = [](const Scene& of) {
    double sum = 0.0;
    for (Eigen::Index t = 0; t < of.triangles.rows(); ++t) {
      const Eigen::Vector3f a = of.vertices_m.row(of.triangles(t, 0));
      const Eigen::Vector3f b = of.vertices_m.row(of.triangles(t, 1));
      const Eigen::Vector3f c = of.vertices_m.row(of.triangles(t, 2));
      sum += 0.5 * static_cast<double>((b - a).cross(c - a).norm());
    }
    return sum;
  };
  EXPECT_NEAR(area_m2(fine), area_m2(scene), 1e-2);
  EXPECT_NEAR(area_m2(scene), 2.0 * (4.0 * 3.0 + 4.0 * 2.5 + 3.0 * 2.5), 1e-3);
  for (Eigen::Index t = 0; t < fine.triangles.rows(); ++t) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Vector3f a = fine.vertices_m.row(fine.triangles(t, k));
      const Eigen::Vector3f b = fine.vertices_m.row(fine.triangles(t, (k + 1) % 3));
      EXPECT_LE((b - a).norm(), 0.5F + 1e-5F);
    }
  }
}

}  // namespace
}  // namespace homeward::sim::renderer_test
