// SPDX-License-Identifier: Apache-2.0
#include "repeat/wide_match.hpp"

#include <gtest/gtest.h>

#include "repeat/teach_config.hpp"
#include "support/taught_room.hpp"

namespace homeward::repeat::wide_match_test {
namespace {

using testing::PaintedRoom;

class AWideMatch : public ::testing::Test {
 protected:
  [[nodiscard]] DescribedPicture seen_from(const Pose2& pose, const PaintedRoom& room = {}) const {
    return describe(testing::pyramid_at(room, pose, *camera), *camera, config);
  }
  [[nodiscard]] std::optional<WideMatch> matched(const Pose2& begin, const Pose2& end,
                                                 const PaintedRoom& room = {}) const {
    return wide_match(seen_from(begin), seen_from(end, room), *camera, config, driving_geometry(), 1);
  }
  std::shared_ptr<const camera::Camera> camera = camera::Camera::create(testing::small_lens_camera()).value();
  RecognitionConfig config;
  Pose2 from{-2.0, -0.4, 0.1};
  Pose2 to{-1.6, -0.35, 0.5};
};

TEST_F(AWideMatch, SaysWherePixelsLieInTheOtherPictureAndBack) {
  const auto match = matched(from, to);
  ASSERT_TRUE(match);
  ASSERT_EQ(match->first_px.size(), match->second_px.size());
  ASSERT_EQ(match->first_px.size(), match->estimate.rays.size());
  const WideMatch back = reversed(*match);
  EXPECT_LT(turn_between_rad(reversed(back).estimate.motion, match->estimate.motion), 1e-9);
  EXPECT_LT((reversed(back).estimate.motion.target_in_current - match->estimate.motion.target_in_current).norm(), 1e-9);
  const GuessPlace on = guess_by(*match, *camera);
  const GuessPlace home = guess_by(back, *camera);
  std::size_t at_home = 0;
  for (std::size_t i = 0; i < match->first_px.size(); ++i) {
    EXPECT_LT((on(match->first_px[i], 1.0).pixel_px - match->second_px[i]).norm(), 4.0);
    const Eigen::Vector2d home_px = home(match->second_px[i], 1.0).pixel_px;
    if (!home_px.allFinite()) continue;  // the turn alone would move it out of the picture
    EXPECT_LT((home_px - match->first_px[i]).norm(), 4.0);
    ++at_home;
    EXPECT_GT(on(match->first_px[i], 1.0).scale, 0.5);
    EXPECT_DOUBLE_EQ(on(match->first_px[i], 2.0).scale, 2.0 * on(match->first_px[i], 1.0).scale);
  }
  EXPECT_GT(at_home, match->first_px.size() / 2);
}

TEST_F(AWideMatch, WhatIsTurnedOutOfThePictureLiesNowhere) {
  const auto match = matched(from, to);
  ASSERT_TRUE(match);
  // Turned to the left: what was at the right edge is no longer seen.
  EXPECT_FALSE(guess_by(*match, *camera)({235.0, 90.0}, 1.0).pixel_px.allFinite());
}

TEST_F(AWideMatch, ThereIsNoneInAnotherRoomNorWhereMoreIsAsked) {
  EXPECT_FALSE(matched(from, to, {.seed = 9}));
  config.fewest_agreeing = 290;
  EXPECT_FALSE(matched(from, to));
}

}  // namespace
}  // namespace homeward::repeat::wide_match_test
