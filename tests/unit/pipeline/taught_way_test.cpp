// SPDX-License-Identifier: Apache-2.0
#include "pipeline/taught_way.hpp"

#include <gtest/gtest.h>

#include "core/index.hpp"
#include "imageio/decode.hpp"
#include "pipeline/path_repeater.hpp"
#include "pipeline/teach_path.hpp"
#include "support/taught_room.hpp"

namespace homeward::pipeline::taught_way_test {
namespace {

using homeward::testing::bend;
using homeward::testing::PaintedRoom;

constexpr int kPictures = 14;

/// In the drift-free frame of a tour's odometry, which is not that of the room.
Pose2 shown_at(int picture) { return Pose2{3.0, -1.0, 0.7} * bend(kPictures)[at(picture)]; }
ImageId image_of(int picture) { return ImageId("room/" + std::to_string(100 + picture) + ".png"); }

Image colour_picture(const Pose2& pose, const camera::Camera& camera) {
  const Image grey = homeward::testing::lens_picture(PaintedRoom{}, pose, camera);
  Image rgb(grey.width_px, grey.height_px, 3);
  for (std::size_t i = 0; i < rgb.data.size(); ++i) rgb.data[i] = grey.data[i / 3];
  return rgb;
}

class DrawnTour final : public TourSource {
 public:
  explicit DrawnTour(bool measured) : camera_(camera::Camera::create(homeward::testing::small_lens_camera()).value()) {
    for (int i = 0; i < kPictures; ++i) {
      pictures_.push_back(colour_picture(bend(kPictures)[at(i)], *camera_));
      images_.push_back({image_of(i), std::nullopt, measured ? std::optional(shown_at(i)) : std::nullopt});
    }
  }
  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t index) const override { return pictures_[index]; }

 private:
  std::shared_ptr<const camera::Camera> camera_;
  std::vector<Image> pictures_;
  std::vector<TourImage> images_;
  std::vector<TourMark> marks_;
};

class TaughtWayTest : public ::testing::Test {
 protected:
  static std::shared_ptr<const map::TopologicalMap> taught(bool measured) {
    const DrawnTour tour(measured);
    repeat::TeachConfig config;
    config.most_features = 100;
    config.least_features = 60;
    auto made = teach_path(
        tour, homeward::testing::small_lens_camera(), "room", config,
        [&](std::size_t i) -> Result<std::vector<std::uint8_t>> { return imageio::encode_png(*tour.read(i)); });
    return std::make_shared<const map::TopologicalMap>(std::move(made->map));
  }
  static void SetUpTestSuite() {
    measured_ = taught(true);
    unmeasured_ = taught(false);
  }
  static void TearDownTestSuite() { measured_ = unmeasured_ = nullptr; }

  /// The way on from beside where a picture was shown, to where another one was.
  static WayAhead ahead(const std::shared_ptr<const map::TopologicalMap>& map, int from, double left_m,
                        double turned_rad, int to, bool stops = true) {
    const auto camera = camera::Camera::create(homeward::testing::small_lens_camera()).value();
    auto repeater = PathRepeater::create(map, homeward::testing::small_lens_camera());
    EXPECT_TRUE(repeater);
    EXPECT_TRUE(repeater->begin(0));
    repeat::Repeated said;
    for (int i = 0; i <= from; ++i) {
      const double share = static_cast<double>(i + 1) / (from + 1);
      const Pose2 pose = bend(kPictures)[at(i)] * Pose2{0.0, share * left_m, share * turned_rad};
      said = *repeater->step(colour_picture(pose, *camera));
      EXPECT_FALSE(said.is_lost()) << i;
    }
    const auto way = TaughtWay::create(map, image_of(to));
    EXPECT_TRUE(way);
    return way->ahead(repeater->repeater(), said, stops);
  }

  static inline std::shared_ptr<const map::TopologicalMap> measured_;
  static inline std::shared_ptr<const map::TopologicalMap> unmeasured_;
};

TEST_F(TaughtWayTest, LiesWhereTheRobotWasWhenItWasShownThePath) {
  const Pose2 beside{0.0, 0.1, 0.05};
  const WayAhead on = ahead(measured_, 6, beside.y_m, beside.theta_rad, kPictures - 1);
  EXPECT_EQ(on.picture, 6);
  EXPECT_TRUE(on.ends);
  EXPECT_FALSE(on.leads_elsewhere);
  ASSERT_EQ(on.way.size(), 8U);
  for (int i = 0; i < 8; ++i) {
    const Pose2 expected = inverse(shown_at(6) * beside) * shown_at(6 + i);
    EXPECT_NEAR(on.way[at(i)].x_m, expected.x_m, 0.03) << i;
    EXPECT_NEAR(on.way[at(i)].y_m, expected.y_m, 0.03) << i;
    EXPECT_NEAR(on.way[at(i)].theta_rad, expected.theta_rad, 0.03) << i;
  }
  ASSERT_TRUE(on.beside_m);
  EXPECT_NEAR(*on.beside_m, 0.1, 0.03);
}

TEST_F(TaughtWayTest, EndsWhereItIsToStopOrGoesOnPastIt) {
  const WayAhead stopping = ahead(measured_, 4, 0.0, 0.0, 7);
  EXPECT_TRUE(stopping.ends);
  EXPECT_EQ(stopping.way.size(), 4U);
  const WayAhead passing = ahead(measured_, 4, 0.0, 0.0, 7, false);
  EXPECT_FALSE(passing.ends);
  EXPECT_EQ(passing.way.size(), 10U);
}

TEST_F(TaughtWayTest, LeadsElsewhereFromFarPastWhereItIsToStop) {
  EXPECT_TRUE(ahead(measured_, 12, 0.0, 0.0, 2).leads_elsewhere);
  EXPECT_FALSE(ahead(measured_, 4, 0.0, 0.0, 2).leads_elsewhere) << "that near behind it is driven back to";
}

TEST_F(TaughtWayTest, WithoutOdometryItKnowsNoWayInMetresButWhenItIsThere) {
  const WayAhead on = ahead(unmeasured_, 4, 0.0, 0.0, 10);
  EXPECT_TRUE(on.way.empty());
  EXPECT_FALSE(on.beside_m);
  EXPECT_FALSE(on.ends);
  EXPECT_FALSE(on.leads_elsewhere);
  EXPECT_TRUE(ahead(unmeasured_, 11, 0.0, 0.0, 10).ends);
}

TEST_F(TaughtWayTest, SaysWhereNoPathOrPictureIs) {
  const auto no_picture = TaughtWay::create(measured_, ImageId("room/999.png"));
  ASSERT_FALSE(no_picture);
  EXPECT_EQ(no_picture.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(no_picture.error().where, "room/999.png");
  const auto no_path = TaughtWay::create(std::make_shared<const map::TopologicalMap>(), image_of(1));
  ASSERT_FALSE(no_path);
  EXPECT_EQ(no_path.error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::pipeline::taught_way_test
