// SPDX-License-Identifier: Apache-2.0
#include "pipeline/path_repeater.hpp"

#include <gtest/gtest.h>

#include "core/index.hpp"
#include "imageio/decode.hpp"
#include "pipeline/teach_path.hpp"
#include "support/taught_room.hpp"

namespace homeward::pipeline::path_repeater_test {
namespace {

using homeward::testing::bend;
using homeward::testing::PaintedRoom;

constexpr int kPictures = 14;

class DrawnTour final : public TourSource {
 public:
  explicit DrawnTour(std::vector<Image> pictures) : pictures_(std::move(pictures)) {
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      images_.push_back({ImageId("room/" + std::to_string(100 + i) + ".png"), std::nullopt, std::nullopt});
    }
  }
  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t index) const override { return pictures_[index]; }

 private:
  std::vector<Image> pictures_;
  std::vector<TourImage> images_;
  std::vector<TourMark> marks_;
};

class PathRepeating : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto camera = camera::Camera::create(homeward::testing::small_lens_camera()).value();
    std::vector<Image> pictures;
    for (const Pose2& pose : bend(kPictures)) {
      const Image grey = homeward::testing::lens_picture(PaintedRoom{}, pose, *camera);
      Image& rgb = pictures.emplace_back(grey.width_px, grey.height_px, 3);
      for (std::size_t i = 0; i < rgb.data.size(); ++i) rgb.data[i] = grey.data[i / 3];
    }
    const DrawnTour tour(pictures);
    repeat::TeachConfig config;
    config.most_features = 100;
    config.least_features = 60;
    const auto bytes = [&](std::size_t i) -> Result<std::vector<std::uint8_t>> {
      return imageio::encode_png(pictures[i]);
    };
    auto made = teach_path(tour, homeward::testing::small_lens_camera(), "room", config, bytes);
    ASSERT_TRUE(made) << made.error().message;
    map_ = std::make_shared<const map::TopologicalMap>(std::move(made->map));
    pictures_ = std::move(pictures);
  }
  static void TearDownTestSuite() { map_ = nullptr; }
  [[nodiscard]] static map::TopologicalMap with_pictures(std::vector<std::uint8_t> bytes) {
    map::TopologicalMap map = *map_;
    map::MapPath path = *map_->path;
    path.pictures.back() = std::move(bytes);
    map.path = std::make_shared<const map::MapPath>(std::move(path));
    return map;
  }
  static Result<PathRepeater> repeater(map::TopologicalMap map) {
    return PathRepeater::create(std::make_shared<const map::TopologicalMap>(std::move(map)),
                                homeward::testing::small_lens_camera());
  }

  static inline std::shared_ptr<const map::TopologicalMap> map_;
  static inline std::vector<Image> pictures_;
};

TEST_F(PathRepeating, ThePicturesItWasTaughtWithLieBetweenTheirKeyImages) {
  auto repeating = repeater(*map_);
  ASSERT_TRUE(repeating) << repeating.error().message;
  ASSERT_TRUE(repeating->begin(0));
  const auto& keys = repeating->path().taught.key_images;
  for (int i = 0; i < kPictures; ++i) {
    const auto said = repeating->step(pictures_[at(i)]);
    ASSERT_TRUE(said) << said.error().message;
    ASSERT_FALSE(said->is_lost()) << i;
    EXPECT_LE(keys[at(said->from_key)].picture - 1, i);
    EXPECT_GE(keys[at(said->to_key)].picture + 1, i);
  }
}

TEST_F(PathRepeating, AMapWithoutAPathIsRefused) {
  map::TopologicalMap map = *map_;
  map.path = nullptr;
  const auto refused = repeater(std::move(map));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("homeward teach"), std::string::npos);
}

TEST_F(PathRepeating, AnotherCameraIsRefused) {
  camera::CameraConfig wider = homeward::testing::small_lens_camera();
  wider.model = camera::Pinhole{{150.0, 150.0, 119.5, 89.5}, {}};
  EXPECT_FALSE(PathRepeater::create(map_, wider));
  camera::CameraConfig askew = homeward::testing::small_lens_camera();
  askew.robot_from_camera_rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitZ())) * askew.robot_from_camera_rotation;
  EXPECT_FALSE(PathRepeater::create(map_, askew));
  camera::CameraConfig higher = homeward::testing::small_lens_camera();
  higher.height_px += 2;
  EXPECT_FALSE(PathRepeater::create(map_, higher));
}

TEST_F(PathRepeating, AKeyImageThatCannotBeSeenIsNamedBeforeAnybodyDrives) {
  const auto broken = repeater(with_pictures({1, 2, 3}));
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().where, map_->path->images.back().str());
  const auto small = repeater(with_pictures(imageio::encode_png(Image(40, 30, 3))));
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().code, ErrorCode::kWrongImageSize);
  EXPECT_EQ(small.error().where, map_->path->images.back().str());
}

TEST_F(PathRepeating, APictureOfAnotherSizeIsAnErrorAndAPlainOneIsLost) {
  auto repeating = repeater(*map_);
  ASSERT_TRUE(repeating);
  ASSERT_TRUE(repeating->begin(0));
  EXPECT_EQ(repeating->step(Image(60, 40, 3)).error().code, ErrorCode::kWrongImageSize);
  ASSERT_FALSE(repeating->step(pictures_[0])->is_lost());
  Image plain(pictures_[0].width_px, pictures_[0].height_px, 3);
  EXPECT_TRUE(repeating->step(plain)->is_lost());
}

}  // namespace
}  // namespace homeward::pipeline::path_repeater_test
