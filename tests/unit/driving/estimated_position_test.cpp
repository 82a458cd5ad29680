// SPDX-License-Identifier: Apache-2.0
#include "driving/estimated_position.hpp"

#include <gtest/gtest.h>

#include "support/landmarks.hpp"

namespace homeward::driving::estimated_position_test {
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

  void know_the_map() {
    std::vector<const features::Appearance*> views;
    for (int view = 0; view < path_.placed(); ++view) views.push_back(&path_.appearance(view));
    path_.index = std::make_shared<const ViewIndex>(views);
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

TEST_F(EstimatedPositionTest, ItHasArrivedOnlyWhereThatIsProbableEnough) {
  know_the_map();
  stand({{{7.5, 0.1, 0.0}, 0.98}});
  EXPECT_NEAR(arrival_probability(state_, path_, config_), 0.98, 1e-6);
  EXPECT_TRUE(is_certain_of_arrival(state_, path_, config_));
  stand({{{7.5, 0.1, 0.0}, 0.96}});
  EXPECT_FALSE(is_certain_of_arrival(state_, path_, config_));
  EXPECT_TRUE(stays_certain_of_arrival(state_, path_, config_));
  stand({{{7.5, 0.1, 0.0}, 0.89}});
  EXPECT_FALSE(stays_certain_of_arrival(state_, path_, config_));
  stand({{{6.5, 0.0, 0.0}, 0.99}});
  EXPECT_LT(arrival_probability(state_, path_, config_), 0.01) << "a metre beside it";
}

TEST_F(EstimatedPositionTest, WhereTheBeliefIsSureOfAnotherPlaceItHasNotArrived) {
  know_the_map();
  stand({{{7.5, 0.0, 0.0}, 0.99}});
  state_.belief = BelievedView{2, 0.9};
  EXPECT_TRUE(is_certain_of_arrival(state_, path_, config_))
      << "2.5 m off: the next place, of whose pictures this may be";
  state_.belief = BelievedView{1, 0.9};
  EXPECT_LT(arrival_probability(state_, path_, config_), 0.5);
  EXPECT_FALSE(stays_certain_of_arrival(state_, path_, config_));
  state_.belief = BelievedView{1, 0.7};
  EXPECT_TRUE(is_certain_of_arrival(state_, path_, config_)) << "not sure";
  state_.belief.reset();
  EXPECT_TRUE(is_certain_of_arrival(state_, path_, config_)) << "it says nothing";
  state_.belief_lost = true;
  EXPECT_FALSE(is_certain_of_arrival(state_, path_, config_)) << "it does not know the place in this map";
  EXPECT_TRUE(is_certain_of_arrival(state_, path_, config_, true)) << "and somebody says so";
  EXPECT_TRUE(stays_certain_of_arrival(state_, path_, config_));
  state_.belief_lost = false;
  state_.belief = BelievedView{std::nullopt, 0.9};
  EXPECT_LT(arrival_probability(state_, path_, config_), 0.5) << "a place that is not around the path";
}

TEST_F(EstimatedPositionTest, WithoutAMapNineTenthsAreEnoughToArrive) {
  stand({{{7.5, 0.0, 0.0}, 0.91}});
  EXPECT_TRUE(is_certain_of_arrival(state_, path_, config_));
  stand({{{7.5, 0.0, 0.0}, 0.89}});
  EXPECT_FALSE(is_certain_of_arrival(state_, path_, config_));
}

TEST_F(EstimatedPositionTest, OfNoPictureYetItTellsOfNoPlace) { EXPECT_TRUE(possible_places(state_, path_).empty()); }

}  // namespace
}  // namespace homeward::driving::estimated_position_test
