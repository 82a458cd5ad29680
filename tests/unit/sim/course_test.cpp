// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/renderer.hpp"
#include "sim/tour_path.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::sim::course_test {
namespace {

class CourseTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { world_ = std::make_unique<World>(generate_course(1)); }
  static void TearDownTestSuite() { world_.reset(); }
  static std::unique_ptr<World> world_;
};
std::unique_ptr<World> CourseTest::world_;

TEST_F(CourseTest, IsARingOf150MetresThatADiscDrivesRoundWithRoomToSpare) {
  EXPECT_EQ(world_->name, "course:1");
  ASSERT_EQ(world_->rooms.size(), 11U);
  constexpr double kRadius_m = 0.35;
  constexpr double kSpare_m = 0.1;
  const FloorGrid floor = drivable_cells(world_->occupied, kRadius_m + kSpare_m, world_->start);
  double round_m = 0.0;
  for (std::size_t i = 0; i < world_->rooms.size(); ++i) {
    const Room& from = world_->rooms[i];
    const Room& to = world_->rooms[(i + 1) % world_->rooms.size()];
    EXPECT_TRUE(is_set(floor, {from.x_m, from.y_m})) << from.name;
    const auto way_m = shortest_way(floor, {from.x_m, from.y_m}, {to.x_m, to.y_m});
    ASSERT_GE(way_m.size(), 2U);
    EXPECT_LE(length_m(way_m), 40.0) << "the other way round";
    round_m += length_m(way_m);
  }
  EXPECT_GE(round_m, 150.0);
  const auto rooms = all_rooms(*world_);
  EXPECT_EQ(rooms.back(), rooms.front());
  EXPECT_EQ(rooms[10], "stretch_11");
}

TEST_F(CourseTest, NothingLeadsOutOfTheRing) {
  for (int row = 0; row < world_->drivable.height; ++row) {
    for (int column = 0; column < world_->drivable.width; ++column) {
      const Eigen::Vector2d point_m = centre_of(world_->drivable, {column, row});
      if (!is_set(world_->drivable, point_m)) continue;
      ASSERT_TRUE(room_at(*world_, point_m)) << point_m.transpose();
    }
  }
}

TEST_F(CourseTest, IsTheSameForTheSameSeedAndNotForAnother) {
  const World again = generate_course(1);
  EXPECT_TRUE(again.scene.vertices_m == world_->scene.vertices_m);
  EXPECT_TRUE(std::ranges::equal(again.scene.textures, world_->scene.textures, {}, &Image::data, &Image::data));
  const World other = generate_course(2);
  EXPECT_FALSE(other.scene.vertices_m.rows() == world_->scene.vertices_m.rows() &&
               other.scene.vertices_m == world_->scene.vertices_m);
}

TEST_F(CourseTest, ShowsASkyThatIsDarkerAboveAndNeverBrightensAsDaylightFails) {
  camera::CameraConfig config = homeward::testing::sphere_camera(96);
  config.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  const auto camera = camera::Camera::create(config).value();
  const LitWorld lit(*world_);
  // Evenly lit ground: what is looked at is the sky.
  auto even = std::make_shared<Irradiance>();
  even->corners.setConstant(lit.fine_scene().vertices_m.rows(), 3, 0.0F);
  double before = -1.0;
  for (const double level : {0.0, 0.05, 0.3, 1.0}) {
    const LightSettings settings = light_settings(Light::of_daylight(level), world_->sky);
    const Image image = Renderer(lit, settings, even, camera).render(world_->start, {}, 1);
    const auto row_mean = [&](int row) {
      double sum = 0.0;
      for (int u = 0; u < image.width_px; ++u) sum += image.at(u, row)[0];
      return sum / image.width_px;
    };
    const double above = row_mean(1);
    EXPECT_GT(above, before) << level;
    before = above;
    if (level < 1.0) continue;
    // Straight up the sky is blue and no ceiling is there.
    const std::uint8_t* up = image.at(image.width_px / 2, 1);
    EXPECT_GT(up[2], up[0] + 20);
    EXPECT_GT(up[2], 150);
  }
}

TEST(SkyLight, TheHorizonIsBrighterThanTheZenithAwayFromTheSun) {
  const SkyLight sky = sky_light(Sky{0.0}, 1.0F);
  const Eigen::Array3f low = radiance(sky, Eigen::Vector3f(-1.0F, 0.0F, 0.05F).normalized());
  const Eigen::Array3f high = radiance(sky, Eigen::Vector3f::UnitZ());
  EXPECT_GT(low.mean(), high.mean());
  const Eigen::Array3f sun = radiance(sky, Eigen::Map<const Eigen::Vector3f>(sky.to_sun.data()));
  EXPECT_GT(sun.mean(), 2.0F * high.mean());
}

TEST(SkyLight, GroundUnderMoreDaylightIsNeverDarkerInAPicture) {
  double before = 0.0;
  for (const double level : {0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.6, 1.0}) {
    const LightSettings settings = light_settings(Light::of_daylight(level), Sky{0.0});
    double sum = 0.0;
    for (const Eigen::Vector3f& direction : {Eigen::Vector3f(0.0F, 0.0F, 1.0F), Eigen::Vector3f(0.6F, 0.0F, 0.8F),
                                             Eigen::Vector3f(-0.6F, 0.0F, 0.8F), Eigen::Vector3f(0.0F, 0.8F, 0.6F)}) {
      sum += static_cast<double>(radiance(*settings.sky, direction).mean() * settings.exposure);
    }
    EXPECT_GT(sum, before) << level;
    before = sum;
  }
}

}  // namespace
}  // namespace homeward::sim::course_test
