// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tour_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "pipeline/picture_frame.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::pipeline::tour_check_test {
namespace {

using ::testing::HasSubstr;

/// Pictures at these positions along a line, or a ring of this length: near ones look alike, far ones have nothing in
/// common.
struct Line {
  explicit Line(const std::vector<int>& at, int ring = 1 << 20)
      : pairs(static_cast<int>(at.size())), tour_of(at.size(), 0) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      images.push_back({ImageId("tour/" + std::to_string(1000 + i) + ".jpg"), std::nullopt, std::nullopt});
      for (std::size_t j = 0; j < i; ++j) {
        const int along = std::abs(at[i] - at[j]);
        const int apart = std::min(along, ring - along);
        if (apart > 6) continue;
        mapping::PairRelation relation;
        relation.inliers = 100;
        relation.distance = 0.01F * static_cast<float>(std::max(1, apart * apart * apart));
        pairs.set(static_cast<int>(j), static_cast<int>(i), relation);
      }
    }
  }
  [[nodiscard]] Result<std::vector<map::TourWarning>> check() const { return check_order(images, tour_of, pairs); }

  std::vector<map::MapImage> images;
  mapping::PairTable pairs;
  std::vector<int> tour_of;
};

std::vector<int> ordered(int count) {
  std::vector<int> at(static_cast<std::size_t>(count));
  std::iota(at.begin(), at.end(), 0);
  return at;
}

bool names_jump(const map::TourWarning& warning, const std::string& from, const std::string& to) {
  return std::ranges::any_of(warning.first,
                             [&](const map::TourJump& jump) { return jump.from == from && jump.to == to; });
}

TEST(TourOrder, NothingIsSaidOfToursThatAreInOrder) {
  std::vector<int> at = ordered(60);
  EXPECT_TRUE(Line(at).check()->empty());
  std::vector<int> back = at;
  back.insert(back.end(), at.rbegin(), at.rend());
  EXPECT_TRUE(Line(back).check()->empty()) << "there and back";
  std::vector<int> twice = at;
  twice.insert(twice.end(), at.begin(), at.end());
  EXPECT_TRUE(Line(twice, 60).check()->empty()) << "two laps";
  at.erase(at.begin() + 20, at.begin() + 40);
  EXPECT_TRUE(Line(at).check()->empty()) << "a cut in the middle";
}

TEST(TourOrder, NothingIsSaidOfADriveIntoARoomAndBackAfterTurningThere) {
  // Along a way in steps as wide as pictures know each other, five times at its end, and back.
  const std::vector<int> at = {0, 3, 6, 9, 12, 15, 18, 18, 18, 18, 18, 15, 12, 9, 6, 3, 0};
  for (const int nearest : {8, 9, 10}) {  // chance says which picture of the turn is nearest to the first
    Line line(at);
    mapping::PairRelation relation;
    relation.inliers = 100;
    relation.distance = 0.009F;
    line.pairs.set(6, nearest, relation);
    const auto checked = line.check();
    ASSERT_TRUE(checked);
    EXPECT_TRUE(checked->empty()) << nearest;
  }
  std::vector<int> stranger = at;
  stranger.insert(stranger.begin() + 3, 15);
  EXPECT_FALSE(Line(stranger).check()->empty()) << "a picture of the way there in its middle";
}

TEST(TourOrder, AShuffledTourIsRefused) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::vector<int> at = ordered(80);
    std::shuffle(at.begin(), at.end(), std::mt19937(seed));
    const auto checked = Line(at).check();
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().code, ErrorCode::kInvalidInput);
    EXPECT_THAT(checked.error().message, HasSubstr("out of order"));
    EXPECT_THAT(checked.error().where, HasSubstr("tour/1"));
  }
}

TEST(TourOrder, OneMisplacedPictureIsNamed) {
  std::vector<int> at = ordered(60);
  std::rotate(at.begin() + 10, at.begin() + 40, at.begin() + 41);  // what was 40th comes tenth
  const auto checked = Line(at).check();
  ASSERT_TRUE(checked);
  ASSERT_EQ(checked->size(), 1U);
  EXPECT_EQ(checked->front().image.str(), "tour/1010.jpg");
  EXPECT_EQ(checked->front().kind, map::TourWarning::Kind::kJumps);
  const std::vector<map::TourJump>& first = checked->front().first;
  ASSERT_GE(first.size(), 2U);
  EXPECT_EQ(first[0].from + " " + first[0].to, "1009.jpg 1010.jpg");
  EXPECT_EQ(first[1].from + " " + first[1].to, "1010.jpg 1011.jpg");
}

TEST(TourOrder, NamesWithoutLeadingZerosAreNoticed) {
  std::vector<int> at = ordered(60);
  std::ranges::sort(at, {}, [](int number) { return std::to_string(number); });
  const auto checked = Line(at).check();
  ASSERT_TRUE(checked);
  ASSERT_EQ(checked->size(), 1U);
  EXPECT_TRUE(names_jump(checked->front(), "1011.jpg", "1012.jpg"));  // 19 to 2
}

TEST(TourOrder, TimesThatRunBackwardsAreSaid) {
  Line line(ordered(12));
  for (std::size_t i = 0; i < line.images.size(); ++i) line.images[i].t_us = static_cast<TimeUs>(1000 * i);
  EXPECT_TRUE(line.check()->empty());
  line.images[7].t_us = 3500;
  const auto checked = line.check();
  ASSERT_TRUE(checked);
  ASSERT_EQ(checked->size(), 1U);
  EXPECT_EQ(checked->front().image.str(), "tour/1007.jpg");
}

TEST(TourOrder, EachTourIsLookedAtForItself) {
  Line line([] {
    std::vector<int> at = ordered(30);
    for (int i = 100; i < 130; ++i) at.push_back(i);
    return at;
  }());
  std::fill(line.tour_of.begin() + 30, line.tour_of.end(), 1);
  EXPECT_TRUE(line.check()->empty());
}

// -- two cameras ----------------------------------------------------------------------------------------------------

camera::CameraConfig mirror() {
  camera::CameraConfig config = testing::sphere_camera(512);
  config.width_px = 640;
  config.height_px = 480;
  config.model = camera::HyperbolicMirror{{598.4579, 598.4579, 319.5, 239.5}, 28.095, 23.4125, 43.05, 231.0};
  return config;
}

camera::CameraConfig window() {
  camera::CameraConfig config = mirror();
  config.model = camera::Pinhole{{457.0, 457.0, 319.5, 239.5}, {}};
  return config;
}

/// Blotches all over, or within a ring on black.
Image picture(unsigned seed, bool ring) {
  std::mt19937 random(seed);
  Image made(640, 480, 3);
  std::vector<std::uint8_t> blotches(40 * 30);
  for (auto& blotch : blotches) blotch = static_cast<std::uint8_t>(80 + random() % 150);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const bool seen = !ring || std::hypot(u - 319.5, v - 239.5) < 231.0;
      const auto value = seen ? blotches[static_cast<std::size_t>((v / 16) * 40 + u / 16)] : std::uint8_t{4};
      std::fill_n(made.at(u, v), 3, value);
    }
  }
  return made;
}

Status check_pictures(const camera::CameraConfig& config, const std::vector<bool>& ring) {
  const FrameSampler sampler(*camera::Camera::create(config).value());
  std::vector<map::MapImage> images;
  std::vector<PictureFrame> frames;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    images.push_back({ImageId("tour/" + std::to_string(i) + ".jpg"), std::nullopt, std::nullopt});
    frames.push_back(sampler.sample(picture(static_cast<unsigned>(i), ring[i])));
  }
  return check_one_camera(images, frames);
}

TEST(OneCamera, ItsOwnPicturesPass) {
  EXPECT_TRUE(check_pictures(mirror(), std::vector<bool>(8, true)));
  EXPECT_TRUE(check_pictures(window(), std::vector<bool>(8, false)));
}

TEST(OneCamera, TheFirstPictureOfAnotherIsNamed) {
  for (const camera::CameraConfig& config : {mirror(), window()}) {
    for (const bool first : {true, false}) {
      std::vector<bool> ring(10, first);
      std::fill(ring.begin() + 6, ring.end(), !first);
      const Status checked = check_pictures(config, ring);
      ASSERT_FALSE(checked);
      EXPECT_EQ(checked.error().code, ErrorCode::kInvalidInput);
      EXPECT_EQ(checked.error().where, "tour/6.jpg");
      EXPECT_THAT(checked.error().message, HasSubstr("From this picture on"));
      EXPECT_THAT(checked.error().message, HasSubstr("4 of 10"));
    }
  }
}

TEST(OneCamera, OneStrayPictureOfAMirrorsTourIsNamed) {
  std::vector<bool> ring(10, true);
  ring[4] = false;
  const Status checked = check_pictures(mirror(), ring);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().where, "tour/4.jpg");
  EXPECT_THAT(checked.error().message, HasSubstr("This picture is"));
}

TEST(OneCamera, ADarkRoomIsNoOtherCamera) {
  const FrameSampler sampler(*camera::Camera::create(window()).value());
  std::vector<map::MapImage> images;
  std::vector<PictureFrame> frames;
  for (int i = 0; i < 10; ++i) {
    images.push_back({ImageId("tour/" + std::to_string(i) + ".jpg"), std::nullopt, std::nullopt});
    Image made = picture(static_cast<unsigned>(i), false);
    if (i >= 5) {
      for (auto& value : made.data) value /= 30;
    }
    frames.push_back(sampler.sample(made));
  }
  EXPECT_TRUE(check_one_camera(images, frames));
}

}  // namespace
}  // namespace homeward::pipeline::tour_check_test
