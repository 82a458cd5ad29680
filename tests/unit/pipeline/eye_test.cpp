// SPDX-License-Identifier: Apache-2.0
#include "pipeline/eye.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/angles.hpp"
#include "features/colour.hpp"
#include "features/global.hpp"
#include "imageio/decode.hpp"
#include "matching/visual_distance.hpp"
#include "support/painted_room.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::pipeline::eye_test {
namespace {

Eye eye_of(const camera::CameraConfig& config) {
  return std::move(*Eye::create(config, suited_feature_config(**camera::Camera::create(config))));
}

Image grey_of(const Image& picture) {
  Image grey(picture.width_px, picture.height_px, 1);
  for (std::size_t i = 0; i < grey.data.size(); ++i) {
    const std::uint8_t* rgb = picture.data.data() + 3 * i;
    grey.data[i] = static_cast<std::uint8_t>((rgb[0] + 2 * rgb[1] + rgb[2]) / 4);
  }
  return grey;
}

class MirrorEye : public ::testing::Test {
 protected:
  [[nodiscard]] Image picture(const Pose2& pose) const {
    return homeward::testing::painted_picture({}, pose, eye_.camera());
  }
  [[nodiscard]] features::Appearance look(const Image& picture) const {
    auto seen = eye_.look(picture);
    EXPECT_TRUE(seen) << seen.error().message;
    return std::move(*seen);
  }
  [[nodiscard]] features::GlobalDescriptor describe(const Image& picture) const {
    return *features::describe(*eye_.unwrap(picture));
  }

  Eye eye_ = eye_of(homeward::testing::mirror_camera(43.05));
};

/// The picture after a quarter turn of the robot: its pixels turned about the mirror's centre, (319.5, 239.5).
Image quarter_turned(const Image& picture) {
  Image result(picture.width_px, picture.height_px, 3);
  for (int v = 0; v < result.height_px; ++v) {
    for (int u = 0; u < result.width_px; ++u) {
      const int from_u = 559 - v;
      const int from_v = u - 80;
      if (from_u < 0 || from_u >= picture.width_px || from_v < 0 || from_v >= picture.height_px) continue;
      std::copy_n(picture.at(from_u, from_v), 3, result.at(u, v));
    }
  }
  return result;
}

TEST_F(MirrorEye, AQuarterTurnLeavesEveryMeasureAsItIs) {
  const Image here = picture({0.5, 0.2, 0.0});
  const auto before = describe(here);
  const auto after = describe(quarter_turned(here));
  const auto elsewhere = describe(picture({1.1, 0.2, 0.0}));
  for (const features::GlobalMeasure measure : features::kGlobalMeasures) {
    const double moved = features::dissimilarity(measure, before, elsewhere);
    EXPECT_LT(features::dissimilarity(measure, before, after), 0.02 * moved)
        << features::global_measure_name(measure) << ", of what 0.6 m make";
  }
}

TEST_F(MirrorEye, AQuarterTurnIsSeenAsAQuarterTurnByFeatures) {
  const Image here = picture({0.5, 0.2, 0.0});
  const auto before = look(here);
  const auto after = look(quarter_turned(here));
  EXPECT_NEAR(after.size(), before.size(), 0.03 * before.size());
  const auto compared = matching::compare(before, after, {}, 1);
  EXPECT_GT(compared.verified, 0.9 * before.size());
  ASSERT_TRUE(compared.pose);
  EXPECT_NEAR(std::abs(compared.pose->motion.turn_rad), kPi / 2.0, radians(0.2));
  EXPECT_LT(compared.distance, 0.01);
}

TEST_F(MirrorEye, AGreyPictureIsTakenAsItIsAndAsPngAndJpeg) {
  const Image grey = grey_of(picture({0.5, 0.2, 0.0}));
  const auto direct = look(grey);
  ASSERT_GT(direct.size(), 50);
  EXPECT_TRUE((direct.sift.colours.array() == features::kNoColour).all());
  const auto png = imageio::decode(imageio::encode_png(grey), "grey.png");
  const auto jpeg = imageio::decode(imageio::encode_jpeg(grey, 95), "grey.jpg");
  ASSERT_TRUE(png && jpeg);
  EXPECT_EQ(look(*png).sift.descriptors, direct.sift.descriptors);
  EXPECT_TRUE((look(*jpeg).sift.colours.array() == features::kNoColour).all());
}

TEST_F(MirrorEye, AMonochromeCameraMatchesWithoutColour) {
  const Image near = picture({0.5, 0.2, 0.0});
  const Image far = picture({1.0, 0.4, 0.7});
  const auto colour = matching::compare(look(near), look(far), {}, 1);
  const auto grey = matching::compare(look(grey_of(near)), look(grey_of(far)), {}, 1);
  const auto mixed = matching::compare(look(near), look(grey_of(far)), {}, 1);
  ASSERT_GE(colour.verified, 20);
  EXPECT_GE(grey.verified, 0.7 * colour.verified);
  EXPECT_GE(mixed.verified, 0.7 * colour.verified);
}

TEST_F(MirrorEye, PicturesThatShowNothingGiveNoFeaturesAndNoDistance) {
  const auto seen = look(picture({0.5, 0.2, 0.0}));
  for (const int level : {0, 128, 255}) {
    Image flat(640, 480, 3);
    std::ranges::fill(flat.data, static_cast<std::uint8_t>(level));
    const auto nothing = look(flat);
    EXPECT_EQ(nothing.size(), 0) << level;
    const auto compared = matching::compare(seen, nothing, {}, 1);
    EXPECT_FALSE(std::isfinite(compared.distance)) << level;
    EXPECT_FALSE(compared.pose) << level;
    EXPECT_FALSE(features::describe(*eye_.unwrap(flat))) << level;
  }
}

TEST_F(MirrorEye, EmptyTinyAndBrokenPicturesAreNamed) {
  const auto code = [&](const Image& picture) {
    const auto seen = eye_.look(picture);
    return seen ? ErrorCode::kInternal : seen.error().code;
  };
  EXPECT_EQ(code(Image()), ErrorCode::kEmptyInput);
  EXPECT_EQ(code(Image(8, 8, 3)), ErrorCode::kWrongImageSize);
  EXPECT_EQ(code(Image(640, 480, 4)), ErrorCode::kInvalidInput);
  Image broken(640, 480, 3);
  broken.data.resize(1000);
  EXPECT_EQ(code(broken), ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::pipeline::eye_test
