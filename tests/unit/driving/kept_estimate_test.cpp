// SPDX-License-Identifier: Apache-2.0
#include "driving/kept_estimate.hpp"

#include <gtest/gtest.h>

#include "support/landmarks.hpp"

namespace homeward::driving::kept_estimate_test {
namespace {

constexpr std::int64_t kLives_ms = 10'000;

/// A drive over views that are a metre apart, and the next mission of the same map.
class KeptEstimateTest : public ::testing::Test {
 protected:
  KeptEstimateTest() {
    const auto seen = homeward::testing::landmarks_around({{0.0, 0.0, 0.0}}, 60, 3);
    for (int k = 0; k < 4; ++k) {
      path_.views.push_back(seen_from(seen, {1.0 * k, 0.0, 0.0}, 5));
      path_.map_from_view.push_back({1.0 * k, 0.0, 0.0});
      path_.places.emplace_back("p" + std::to_string(k));
    }
    path_.edges.resize(path_.views.size());
    std::vector<const features::Appearance*> views;
    for (const auto& view : path_.views) views.push_back(&view);
    path_.index = std::make_shared<const ViewIndex>(views);
    path_.start_probability = 0.5;
    drive_.begun = true;
    drive_.odometry = {5.0, 6.0, 0.5};
    stand({1.2, 0.1, 0.2}, 0.97);
  }
  void stand(const Pose2& here, double weight) {
    drive_.hypotheses =
        PoseHypotheses(config_.pose, {{here, Eigen::Matrix3d::Identity() * 0.01, weight}}, 1.0 - weight, 0.1);
  }
  [[nodiscard]] auto keep() const { return keep_estimate(drive_, path_, MapId("m"), 3, 1000); }
  [[nodiscard]] FollowState next(std::int64_t revision = 3, std::int64_t now_ms = 2000) const {
    return begun_from(keep(), path_, MapId("m"), revision, config_, now_ms, kLives_ms);
  }

  FollowConfig config_;
  VisualPath path_;
  FollowState drive_;
};

TEST_F(KeptEstimateTest, TheNextMissionBeginsWhereTheRobotKnowsToBe) {
  const FollowState begun = next();
  ASSERT_TRUE(begun.begun);
  EXPECT_EQ(begun.odometry.x_m, 5.0);
  EXPECT_EQ(begun.hypotheses.best()->map_from_robot.x_m, 1.2);
  EXPECT_NEAR(begun.hypotheses.best_probability(), 0.97, 1e-9);
  EXPECT_EQ(begun.hypotheses.unweighed_m(), 0.1);
  EXPECT_EQ(begun.index, 0);
  ASSERT_TRUE(begun.ways_seen_from);
  EXPECT_EQ(begun.ways_seen_from->x_m, 5.0) << "a wall that was seen there says nothing new";
  EXPECT_FALSE(begun.belief);
}

TEST_F(KeptEstimateTest, WhoIsNotSureKeepsItsDoubt) {
  stand({1.2, 0.1, 0.2}, 0.4);
  path_.start_probability = 0.3;
  EXPECT_NEAR(next().hypotheses.elsewhere(), 0.6, 1e-9);
}

TEST_F(KeptEstimateTest, WhoHasSeenNothingYetKeepsNothing) {
  drive_ = {};
  EXPECT_FALSE(keep());
}

TEST_F(KeptEstimateTest, AnotherMapOrRevisionOrALongTimeBeginsAnew) {
  EXPECT_FALSE(next(4).begun);
  EXPECT_TRUE(next(3, 11'000).begun);
  EXPECT_FALSE(next(3, 11'001).begun);
  EXPECT_FALSE(begun_from(keep(), path_, MapId("other"), 3, config_, 2000, kLives_ms).begun);
}

TEST_F(KeptEstimateTest, WhereItIsSentFromIsAWordOfSomebody) {
  const Pose2 far{8.0, 0.0, 0.0};
  drive_.hypotheses = PoseHypotheses(
      config_.pose, {{far, Eigen::Matrix3d::Identity() * 0.01, 0.6}, {{}, Eigen::Matrix3d::Identity() * 0.01, 0.4}},
      0.0, 0.1);
  path_.start_probability = 0.95;
  EXPECT_NEAR(next().hypotheses.probability_within({0.0, 0.0}, 2.0), 3.0 * 0.4 / (3.0 * 0.4 + 0.6), 1e-6);
  path_.start_probability = 0.3;
  EXPECT_NEAR(next().hypotheses.probability_within({0.0, 0.0}, 2.0), 0.4, 1e-6) << "no surer than he is";
}

TEST_F(KeptEstimateTest, OneViewWithoutAMapKeepsNothing) {
  path_.views.resize(1);
  EXPECT_FALSE(keep());
  path_.index = nullptr;
  EXPECT_FALSE(next().begun);
}

}  // namespace
}  // namespace homeward::driving::kept_estimate_test
