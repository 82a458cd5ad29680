// SPDX-License-Identifier: Apache-2.0
#include "tracking/feature_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/wavy_picture.hpp"

namespace homeward::tracking::feature_tracker_test {
namespace {

using testing::picture_of;
using testing::Seen;
using testing::WavyTexture;

class FeatureTrackerOfATexture : public ::testing::Test {
 protected:
  FeatureTrackerOfATexture() {
    for (int v = 60; v <= 180; v += 30) {
      for (int u = 80; u <= 240; u += 40) points_px.emplace_back(u, v);
    }
    const auto states = tracker.add(pyramid({}), points_px);
    EXPECT_EQ(std::count(states.begin(), states.end(), ReferenceState::kTaken),
              static_cast<std::ptrdiff_t>(points_px.size()));
  }
  [[nodiscard]] ImagePyramid pyramid(const Seen& seen) const {
    return ImagePyramid::build(picture_of(texture, seen)).value();
  }
  [[nodiscard]] std::vector<FeatureGuess> guesses(double scale = 1.0) const {
    std::vector<FeatureGuess> all;
    for (std::size_t i = 0; i < points_px.size(); ++i) all.push_back({i, points_px[i], scale});
    return all;
  }
  /// The root of the mean square error, of a picture in which all are found.
  [[nodiscard]] double error_px(const std::vector<TrackedFeature>& found, const Seen& seen) const {
    double squares = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].state, FeatureState::kTracked) << i;
      squares += (found[i].pixel_px - seen.pixel(points_px[i])).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(found.size()));
  }

  WavyTexture texture{7};
  FeatureTracker tracker = FeatureTracker::create({}).value();
  std::vector<Eigen::Vector2d> points_px;
};

TEST_F(FeatureTrackerOfATexture, FindsATranslationToHundredthsOfAPixel) {
  for (const Eigen::Vector2d& moved_px : {Eigen::Vector2d(0.37, -0.81), {3.6, 2.3}, {-7.2, 6.4}}) {
    const Seen seen{.moved_px = moved_px};
    EXPECT_LT(error_px(tracker.track(pyramid(seen), guesses()), seen), 0.03) << moved_px.transpose();
  }
}

TEST_F(FeatureTrackerOfATexture, FollowsAScaleThroughPictures) {
  for (const double factor : {1.03, 0.97}) {
    std::vector<FeatureGuess> next = guesses();
    Seen seen;
    while (seen.scale < 1.5 && seen.scale > 0.7) {
      seen.scale *= factor;
      const auto found = tracker.track(pyramid(seen), next);
      // From a scale of the root of 2 on the next coarser level is compared, whose pixels are twice as large.
      EXPECT_LT(error_px(found, seen), seen.scale < 1.4 ? 0.1 : 0.2) << seen.scale;
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].scale / seen.scale, 1.0, 0.03);
        next[i] = {i, found[i].pixel_px, found[i].scale};
      }
    }
  }
}

TEST_F(FeatureTrackerOfATexture, WithoutScaleAnotherSizeIsLostByItsResidual) {
  FeatureTrackerConfig config;
  config.changes.scale = false;
  auto unscaled = FeatureTracker::create(config).value();
  unscaled.add(pyramid({}), points_px);
  const auto found = unscaled.track(pyramid({.scale = 1.5}), guesses());
  EXPECT_GT(std::count_if(found.begin(), found.end(), [](const auto& f) { return f.state != FeatureState::kTracked; }),
            static_cast<std::ptrdiff_t>(points_px.size() / 2));
}

TEST_F(FeatureTrackerOfATexture, CompensatesContrastAndSaysWhichItIs) {
  const Seen seen{.moved_px = {1.4, -2.2}, .gain = 0.7, .offset = 50.0};
  const auto found = tracker.track(pyramid(seen), guesses());
  EXPECT_LT(error_px(found, seen), 0.03);
  for (const TrackedFeature& feature : found) {
    EXPECT_NEAR(feature.gain, 0.7, 0.02);
    EXPECT_NEAR(feature.offset, 50.0, 3.0);
    EXPECT_LT(feature.residual, 1.0);
  }
}

TEST_F(FeatureTrackerOfATexture, WithoutCompensationOtherContrastIsLost) {
  FeatureTrackerConfig config;
  config.changes.contrast = false;
  auto plain = FeatureTracker::create(config).value();
  plain.add(pyramid({}), points_px);
  for (const TrackedFeature& feature : plain.track(pyramid({.gain = 0.7}), guesses())) {
    EXPECT_NE(feature.state, FeatureState::kTracked);
  }
}

TEST_F(FeatureTrackerOfATexture, ContrastOutOfItsBoundsIsLostByContrast) {
  for (const TrackedFeature& feature : tracker.track(pyramid({.gain = 0.25, .offset = 90.0}), guesses())) {
    EXPECT_EQ(feature.state, FeatureState::kLostContrast);
  }
}

TEST_F(FeatureTrackerOfATexture, ADarkPictureWithNoiseIsTrackedWhereItsOwnGreyLevelsAreJudged) {
  Image dark = picture_of(texture, {.gain = 0.25, .offset = 20.0});
  for (std::size_t i = 0; i < dark.data.size(); ++i) {
    // Of 3 grey levels, root mean square: 12 of the reference.
    dark.data[i] = static_cast<std::uint8_t>(std::clamp(dark.data[i] + (i * 2654435761U >> 7U & 1U ? 3 : -3), 0, 255));
  }
  const ImagePyramid picture = ImagePyramid::build(dark, {.smoothing_px = 0.0}).value();
  const ImagePyramid sharp = ImagePyramid::build(picture_of(texture, {}), {.smoothing_px = 0.0}).value();
  const auto tracked = [&](bool darker_residual) {
    FeatureTrackerConfig config;
    config.least_gain = 0.15;
    config.darker_residual = darker_residual;
    auto by = FeatureTracker::create(config).value();
    by.add(sharp, points_px);
    const auto found = by.track(picture, guesses());
    return std::ranges::count(found, FeatureState::kTracked, &TrackedFeature::state);
  };
  EXPECT_GE(tracked(true), static_cast<std::ptrdiff_t>(9 * points_px.size() / 10));
  EXPECT_LE(tracked(false), static_cast<std::ptrdiff_t>(points_px.size() / 10));
}

TEST_F(FeatureTrackerOfATexture, WhatIsHiddenIsLostAndTheRestIsNot) {
  Image picture = picture_of(texture, {});
  const WavyTexture other(99);
  const Image in_front = picture_of(other, {});
  for (int v = 0; v < 240; ++v) std::copy_n(in_front.at(0, v), 160, picture.at(0, v));
  const auto found = tracker.track(ImagePyramid::build(picture).value(), guesses());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (points_px[i].x() < 150.0) {
      EXPECT_NE(found[i].state, FeatureState::kTracked) << i;
    }
    if (points_px[i].x() > 170.0) {
      EXPECT_EQ(found[i].state, FeatureState::kTracked) << i;
    }
  }
}

TEST_F(FeatureTrackerOfATexture, WhatIsPaintedOverInItsPlaceIsLostByItsResidual) {
  Image picture = picture_of(texture, {});
  for (const Eigen::Vector2d& point_px : points_px) {
    // Squares of 3 px, light and dark by turns: far from the reference, and with nothing in them that moves it.
    for (int v = -7; v <= 7; ++v) {
      for (int u = -7; u <= 7; ++u) {
        std::uint8_t* at = picture.at(static_cast<int>(point_px.x()) + u, static_cast<int>(point_px.y()) + v);
        *at = static_cast<std::uint8_t>(std::clamp(*at + (((u + 7) / 3 + (v + 7) / 3) % 2 == 0 ? 25 : -25), 0, 255));
      }
    }
  }
  const auto found = tracker.track(ImagePyramid::build(picture).value(), guesses());
  std::size_t by_residual = 0;
  for (const TrackedFeature& feature : found) {
    EXPECT_NE(feature.state, FeatureState::kTracked);
    by_residual += feature.state == FeatureState::kLostResidual ? 1U : 0U;
  }
  EXPECT_GT(by_residual, found.size() / 2);
}

TEST_F(FeatureTrackerOfATexture, WhatLeavesThePictureIsLostOffIt) {
  const Seen seen{.moved_px = {-76.0, 0.0}};  // the first column of points then lies at 4 px, less than half a window
  std::vector<FeatureGuess> near = guesses();
  for (FeatureGuess& guess : near) guess.pixel_px = seen.pixel(guess.pixel_px) + Eigen::Vector2d(0.5, -0.5);
  const auto found = tracker.track(pyramid(seen), near);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].state, points_px[i].x() < 81.0 ? FeatureState::kLostOffPicture : FeatureState::kTracked) << i;
  }
}

TEST_F(FeatureTrackerOfATexture, APlainPictureShowsNone) {
  const auto plain = ImagePyramid::build(Image(320, 240, 1)).value();
  for (const TrackedFeature& feature : tracker.track(plain, guesses())) {
    EXPECT_NE(feature.state, FeatureState::kTracked);
  }
}

TEST_F(FeatureTrackerOfATexture, BadGuessesAreNamedAndHarmNoOther) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<FeatureGuess> asked{{0, {nan, 3.0}},         {0, {infinite, 3.0}},    {0, points_px[0], nan},
                                        {0, points_px[0], -1.0}, {9999, points_px[0]},    {0, {-500.0, 20.0}},
                                        {0, {1e300, 1e300}},     {1, points_px[1], 50.0}, {1, points_px[1]}};
  using enum FeatureState;
  const std::vector<FeatureState> wanted{kBadGuess,       kBadGuess,       kBadGuess,     kBadGuess, kBadGuess,
                                         kLostOffPicture, kLostOffPicture, kLostDiverged, kTracked};
  const auto found = tracker.track(pyramid({}), asked);
  ASSERT_EQ(found.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) EXPECT_EQ(found[i].state, wanted[i]) << i;
}

TEST_F(FeatureTrackerOfATexture, ResultsDoNotDependOnWhatElseIsAskedFor) {
  const auto picture = pyramid({.moved_px = {2.5, 1.5}, .scale = 1.1});
  const auto together = tracker.track(picture, guesses());
  for (std::size_t i = 0; i < points_px.size(); ++i) {
    const FeatureGuess guess{i, points_px[i]};
    const auto alone = tracker.track(picture, {&guess, 1}).front();
    EXPECT_EQ(alone.pixel_px, together[i].pixel_px);
    EXPECT_EQ(alone.scale, together[i].scale);
    EXPECT_EQ(alone.residual, together[i].residual);
    EXPECT_EQ(alone.state, together[i].state);
  }
  EXPECT_TRUE(tracker.track(picture, {}).empty());
}

TEST_F(FeatureTrackerOfATexture, TextureGrowsAsTheSquareOfTheContrast) {
  FeatureTracker by_day = FeatureTracker::create({}).value();
  FeatureTracker dimmed = FeatureTracker::create({}).value();
  const std::vector<Eigen::Vector2d> pixels_px{{80.0, 60.0}};
  ASSERT_EQ(by_day.add(pyramid({}), pixels_px).front(), ReferenceState::kTaken);
  ASSERT_EQ(dimmed.add(pyramid({.gain = 0.5, .offset = 60.0}), pixels_px).front(), ReferenceState::kTaken);
  EXPECT_NEAR(dimmed.texture(0) / by_day.texture(0), 0.25, 0.02);
}

TEST(FeatureTracker, TakesNoReferenceWithoutTextureOrOffThePicture) {
  auto tracker = FeatureTracker::create({}).value();
  Image edge(120, 100, 1);  // an edge alone does not say where along it
  for (int v = 0; v < 100; ++v) std::fill_n(edge.at(60, v), 60, std::uint8_t{200});
  const auto picture = ImagePyramid::build(edge).value();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Eigen::Vector2d> points_px{{60.0, 50.0}, {30.0, 50.0}, {2.0, 50.0}, {nan, 50.0}, {400.0, -7.0}};
  using enum ReferenceState;
  EXPECT_EQ(tracker.add(picture, points_px),
            (std::vector{kNoTexture, kNoTexture, kOffPicture, kOffPicture, kOffPicture}));
  EXPECT_EQ(tracker.size(), 0U);
}

TEST(FeatureTracker, RefusesABadConfiguration) {
  EXPECT_TRUE(problems(FeatureTrackerConfig{}).empty());
  EXPECT_EQ(FeatureTracker::create({.window_px = 14}).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(FeatureTracker::create({.window_px = 17}).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(FeatureTracker::create({.most_residual = std::nan("")}).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(problems({.iterations = 0, .least_gain = 0.0}).size(), 2U);
}

}  // namespace
}  // namespace homeward::tracking::feature_tracker_test
