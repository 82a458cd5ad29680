// SPDX-License-Identifier: Apache-2.0
#include "agent/driving/estimated_position.hpp"

#include <gtest/gtest.h>

#include "support/landmarks.hpp"

namespace homeward::agent {
namespace {

/// Views that are 2.5 m apart, the last two beside the path.
class EstimatedPositionTest : public ::testing::Test {
 protected:
  EstimatedPositionTest() {
    const auto seen = homeward::testing::landmarks_around({{0.0, 0.0, 0.0}}, 60, 3);
    for (int k = 0; k < 4; ++k) {
      path_.views.push_back(seen_from(seen, {2.5 * k, 0.0, 0.0}, 5));
      path_.map_from_view.push_back({2.5 * k, 0.0, 0.0});
      path_.places.emplace_back("p" + std::to_string(k));
    }
    path_.edges.resize(path_.views.size());
    path_.nearby.push_back({PlaceId("p8"), path_.views.back(), {0.0, 20.0, 0.0}});
    path_.nearby.push_back({PlaceId("p9"), path_.views.back(), {5.0, 20.0, 0.0}});
  }
  void stand(const std::vector<std::pair<Pose2, double>>& where) {
    std::vector<PoseHypothesis> all;
    double elsewhere = 1.0;
    for (const auto& [pose, weight] : where) {
      all.push_back({pose, Eigen::Matrix3d::Identity() * 0.01, weight});
      elsewhere -= weight;
    }
    state_.hypotheses = PoseHypotheses(config_.pose, std::move(all), elsewhere, 0.1);
  }

  FollowConfig config_;
  VisualPath path_;
  FollowState state_;
};

TEST_F(EstimatedPositionTest, MayBeWhereItsHypothesesLieThoseOfOnePlaceTogether) {
  stand({{{0.2, 20.1, 0.0}, 0.4}, {{5.2, 0.1, 0.0}, 0.3}, {{5.9, -0.3, 0.0}, 0.2}});
  const auto possible = possible_places(state_, path_);
  ASSERT_EQ(possible.size(), 2U);
  EXPECT_EQ(possible[0].place, PlaceId("p2"));
  EXPECT_NEAR(possible[0].probability, 0.5, 1e-9);
  EXPECT_EQ(possible[1].place, PlaceId("p8"));
  EXPECT_NEAR(possible[1].probability, 0.4, 1e-9);
  EXPECT_FALSE(estimated_place(state_, path_, config_)) << "it is not sure enough to drive by that";
}

TEST_F(EstimatedPositionTest, TellsOfNothingThatIsImprobableOrFarFromAllViews) {
  stand({{{0.0, 0.1, 0.0}, 0.9}, {{60.0, 60.0, 0.0}, 0.09}, {{0.0, 20.0, 0.0}, 0.009}});
  const auto possible = possible_places(state_, path_);
  ASSERT_EQ(possible.size(), 1U);
  EXPECT_EQ(possible[0].place, PlaceId("p0"));
  EXPECT_EQ(estimated_place(state_, path_, config_), PlaceId("p0"));
}

TEST_F(EstimatedPositionTest, TellsOfFourPlacesAtMost) {
  stand({{{0.0, 0.0, 0.0}, 0.3},
         {{2.5, 0.0, 0.0}, 0.2},
         {{5.0, 0.0, 0.0}, 0.15},
         {{7.5, 0.0, 0.0}, 0.1},
         {{0.0, 20.0, 0.0}, 0.05}});
  EXPECT_EQ(possible_places(state_, path_).size(), 4U);
}

TEST_F(EstimatedPositionTest, IsAsFarOffItsPathAsOffTheNearestPieceOfIt) {
  stand({{{1.2, 3.5, 0.0}, 0.95}});
  EXPECT_NEAR(off_path_m(state_, path_, config_).value(), 3.5, 1e-9);
  stand({{{1.2, 3.5, 0.0}, 0.5}});
  EXPECT_FALSE(off_path_m(state_, path_, config_));
}

TEST_F(EstimatedPositionTest, OfAPathOfOneViewItMayBeginAnywhereInThePlace) {
  path_.views.resize(1);
  path_.map_from_view.resize(1);
  path_.places.resize(1);
  path_.edges.resize(1);
  stand({{{2.0, 1.5, 0.0}, 0.95}});
  EXPECT_EQ(off_path_m(state_, path_, config_), 0.0);
  stand({{{0.0, 7.0, 0.0}, 0.95}});
  EXPECT_NEAR(off_path_m(state_, path_, config_).value(), 4.0, 1e-9);
}

TEST_F(EstimatedPositionTest, OfNoPictureYetItTellsOfNoPlace) { EXPECT_TRUE(possible_places(state_, path_).empty()); }

}  // namespace
}  // namespace homeward::agent
