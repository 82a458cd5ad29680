// SPDX-License-Identifier: Apache-2.0
#include "pipeline/picture_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/eye.hpp"
#include "support/painted_tour.hpp"

namespace homeward::pipeline::picture_pair_test {
namespace {

using homeward::testing::painted_corridor;
using homeward::testing::painted_picture;
using homeward::testing::the_camera;

class PicturePairs : public ::testing::Test {
 protected:
  PicturePairs() { map_.feature_config = eye_->feature_config(); }
  features::Appearance from(const Pose2& pose) const {
    return eye_->look(painted_picture(painted_corridor(), pose, the_camera())).value();
  }
  map::PicturePair pair(const features::Appearance& a, const features::Appearance& b) const {
    return picture_pair(map_, {a_, a}, {b_, b});
  }

  Result<Eye> eye_ = Eye::create(the_camera().config(), suited_feature_config(the_camera()));
  map::TopologicalMap map_;
  const ImageId a_ = ImageId("t/a.png");
  const ImageId b_ = ImageId("t/b.png");
};

TEST_F(PicturePairs, OfOneSpotLieBelowEachOtherOnceTheTurnIsTakenOut) {
  const map::PicturePair both = pair(from({0.0, 0.0, 0.0}), from({0.02, 0.0, 0.9}));
  EXPECT_EQ(both.image_a, a_);
  EXPECT_EQ(both.image_b, b_);
  ASSERT_TRUE(both.turn_rad && both.shift && both.distance);
  EXPECT_NEAR(*both.turn_rad, 0.9, 0.05);
  EXPECT_GT(both.similarity, 0.3);
  int agreeing = 0;
  int below_each_other = 0;
  for (const map::PairMatch& match : both.matches) {
    if (!match.agrees) continue;
    ++agreeing;
    const double off = match.b.x - *both.shift - match.a.x;
    const bool below = std::abs(off - std::round(off)) < 0.05 && std::abs(match.a.y - match.b.y) < 0.1;
    below_each_other += below ? 1 : 0;
  }
  EXPECT_GT(agreeing, 20);
  EXPECT_GT(below_each_other, 0.9 * agreeing) << "the floor at the robot's feet moves with it";
}

TEST_F(PicturePairs, TellWhatAgreesFirstAndThenWhatIsDistinctive) {
  const map::PicturePair both = pair(from({0.0, 0.0, 0.0}), from({0.4, 0.1, 0.3}));
  ASSERT_FALSE(both.matches.empty());
  EXPECT_TRUE(std::ranges::is_sorted(both.matches, [](const map::PairMatch& x, const map::PairMatch& y) {
    return x.agrees != y.agrees ? x.agrees : x.distinctiveness > y.distinctiveness;
  }));
  for (const map::PairMatch& match : both.matches) {
    for (const double value : {match.a.x, match.a.y, match.b.x, match.b.y, match.distinctiveness}) {
      EXPECT_GE(value, 0.0);
      EXPECT_LE(value, 1.0);
    }
  }
}

TEST_F(PicturePairs, WithNothingInCommonHaveNoTurn) {
  const features::Appearance here = from({0.0, 0.0, 0.0});
  const map::PicturePair both = pair(here, features::Appearance());
  EXPECT_FALSE(both.turn_rad || both.shift || both.distance);
  EXPECT_EQ(both.similarity, 0.0);
  EXPECT_TRUE(both.matches.empty());
}

}  // namespace
}  // namespace homeward::pipeline::picture_pair_test
