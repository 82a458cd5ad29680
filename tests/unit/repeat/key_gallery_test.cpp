// SPDX-License-Identifier: Apache-2.0
#include "repeat/key_gallery.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "repeat/repeat_config.hpp"
#include "support/taught_room.hpp"

namespace homeward::repeat::key_gallery_test {
namespace {

using testing::PaintedRoom;

class AGallery : public ::testing::Test {
 protected:
  AGallery() {
    for (const Pose2& pose : poses) gallery.add(described({}, pose));
  }
  [[nodiscard]] DescribedPicture described(const PaintedRoom& room, const Pose2& pose) const {
    return describe(testing::pyramid_at(room, pose, *camera), *camera, config);
  }
  [[nodiscard]] std::vector<RecognisedKey> recognised(const DescribedPicture& picture) const {
    const std::array<int, 3> keys{0, 1, 2};
    return gallery.recognise(picture, keys, config, repeat_geometry(), 1);
  }

  std::shared_ptr<const camera::Camera> camera = camera::Camera::create(testing::small_lens_camera()).value();
  RecognitionConfig config;
  std::vector<Pose2> poses{{-2.0, -0.5, 0.0}, {-1.0, 0.3, 1.6}, {0.5, 0.5, -2.5}};
  KeyGallery gallery;
};

TEST_F(AGallery, RecognisesWhichKeyImageIsNearAndHowItStands) {
  const Pose2 here{-0.9, 0.15, 1.7};
  const auto found = recognised(described({}, here));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().key, 1);
  EXPECT_GE(static_cast<int>(found.front().estimate.inliers.size()), config.fewest_agreeing);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.6 - 1.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d off = turn.transpose() * found.front().estimate.motion.current_from_target;
  EXPECT_LT(Eigen::AngleAxisd(off).angle(), 0.02);
}

TEST_F(AGallery, RecognisesNothingInAnotherRoomNorInAPlainPicture) {
  for (const Pose2& pose : poses) EXPECT_TRUE(recognised(described({.seed = 9}, pose)).empty());
  Image plain(240, 180, 1);
  std::ranges::fill(plain.data, std::uint8_t{90});
  const DescribedPicture nothing = describe(tracking::ImagePyramid::build(plain).value(), *camera, config);
  EXPECT_TRUE(nothing.seen.empty());
  EXPECT_TRUE(recognised(nothing).empty());
}

TEST_F(AGallery, KeepsNoMoreFeaturesThanAsked) {
  config.most_features = 25;
  const DescribedPicture few = described({}, poses.front());
  EXPECT_EQ(few.seen.size(), 25U);
  EXPECT_EQ(few.descriptors.rows(), 25);
}

TEST(RecognitionConfig, NamesAllItsProblems) {
  EXPECT_TRUE(problems(RecognitionConfig{}).empty());
  EXPECT_EQ(problems(RecognitionConfig{0, 0.0, 1.5, 0, 0, 4, 1.2, 3}).size(), 8U);
}

}  // namespace
}  // namespace homeward::repeat::key_gallery_test
