// SPDX-License-Identifier: Apache-2.0
#include "repeat/bridge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "support/taught_room.hpp"

namespace homeward::repeat::bridge_test {
namespace {

using testing::PaintedRoom;
using testing::pyramid_at;

class ABridge : public ::testing::Test {
 protected:
  ABridge() { config.most_features = 120; }
  [[nodiscard]] Subrange from(const Pose2& pose) const {
    return Subrange::begin({0, pyramid_at({}, pose, *camera)}, {}, 0, camera, config).value();
  }
  [[nodiscard]] std::optional<Bridge> bridged(const Pose2& begin, const Pose2& end,
                                              const PaintedRoom& room = {}) const {
    return bridge_to({1, pyramid_at(room, end, *camera)}, from(begin), *camera, config);
  }
  std::shared_ptr<const camera::Camera> camera = camera::Camera::create(testing::small_lens_camera()).value();
  TeachConfig config;
};

TEST_F(ABridge, LeadsAcrossAWayAndATurnThatNothingIsTrackedAcross) {
  const Pose2 begin{-2.0, -0.4, 0.1};
  const Pose2 end{-1.4, -0.3, 0.65};
  const auto bridge = bridged(begin, end);
  ASSERT_TRUE(bridge);
  EXPECT_GE(bridge->matched, config.bridging->matching.fewest_agreeing);
  ASSERT_TRUE(bridge->view.geometry);
  EXPECT_GE(bridge->view.agreeing(), config.fewest_features);
  const geometry::ViewMotion& motion = bridge->view.geometry->motion;
  EXPECT_NEAR(std::atan2(motion.current_from_target(1, 0), motion.current_from_target(0, 0)), 0.55, 0.01);
  ASSERT_TRUE(bridge->view.geometry->has_baseline);
  EXPECT_NEAR(std::atan2(motion.target_in_current.y(), motion.target_in_current.x()), std::atan2(0.1, 0.6) - 0.1, 0.1);
}

TEST_F(ABridge, KeepsTheFeaturesThereAndAddsWhatWasMatchedBesideThem) {
  const Subrange before = from({-2.0, -0.4, 0.1});
  const auto bridge = bridged({-2.0, -0.4, 0.1}, {-1.8, -0.4, 0.1});
  ASSERT_TRUE(bridge);
  const auto& features = bridge->from.features();
  ASSERT_GT(features.size(), before.features().size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (i < before.features().size()) {
      EXPECT_EQ(features[i].feature, before.features()[i].feature);
      continue;
    }
    EXPECT_GE(features[i].feature, before.next_feature());
    EXPECT_LT(features[i].feature, bridge->from.next_feature());
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((features[i].pixel_px - features[j].pixel_px).norm(), config.corners.spacing_px);
    }
  }
}

TEST_F(ABridge, NeverLeadsIntoAnotherRoomNorToAnotherWall) {
  for (int seed = 5; seed < 15; ++seed) {
    EXPECT_FALSE(bridged({-2.0, -0.4, 0.1}, {-1.9, -0.4, 0.1}, {.seed = static_cast<std::uint64_t>(seed)})) << seed;
  }
  for (const double heading_rad : {1.6, 2.4, 3.2, -2.4, -1.6}) {
    EXPECT_FALSE(bridged({-2.0, -0.4, 0.1}, {-1.9, -0.4, heading_rad})) << heading_rad;
  }
}

TEST_F(ABridge, IsNotTakenWhereTheMatchesAndTheTrackedFeaturesDisagreeOrItIsNotWanted) {
  const Pose2 begin{-2.0, -0.4, 0.1};
  const Pose2 end{-1.8, -0.4, 0.3};
  ASSERT_TRUE(bridged(begin, end));
  const double turn_off_rad = std::exchange(config.bridging->most_turn_off_rad, 1e-9);
  EXPECT_FALSE(bridged(begin, end));
  config.bridging->most_turn_off_rad = turn_off_rad;
  config.bridging->least_lead = 1e9;
  EXPECT_FALSE(bridged(begin, end)) << "another way explains the pictures nearly as well";
  config.bridging->least_lead = 0.0;
  EXPECT_TRUE(bridged(begin, end));
  config.bridging.reset();
  EXPECT_FALSE(bridged(begin, end));
}

TEST(BridgingConfig, NamesAllItsProblems) {
  EXPECT_TRUE(problems(BridgingConfig{}).empty());
  BridgingConfig bad;
  bad.matching.ratio = 0.0;
  bad.most_ahead = 0;
  bad.most_turn_off_rad = 0.0;
  bad.least_lead = -1.0;
  bad.fewest_around = 0;
  bad.most_aside_rad = 0.0;
  EXPECT_EQ(problems(bad).size(), 6U);
  TeachConfig config;
  config.bridging = bad;
  EXPECT_EQ(problems(config).size(), 6U);
}

}  // namespace
}  // namespace homeward::repeat::bridge_test
