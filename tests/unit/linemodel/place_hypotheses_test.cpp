// SPDX-License-Identifier: Apache-2.0
#include "linemodel/place_hypotheses.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/angles.hpp"

namespace homeward::linemodel {
namespace {

std::vector<Eigen::Vector2d> floor_of_twelve_by_twelve() {
  std::vector<Eigen::Vector2d> points_m;
  for (int i = 0; i < 48; ++i) {
    for (int j = 0; j < 48; ++j) points_m.emplace_back(0.25 * i, 0.25 * j);
  }
  return points_m;
}

/// A robot on a floor that a half turn about its middle makes the same again.
class RobotBetweenTwins : public ::testing::Test {
 protected:
  RobotBetweenTwins() { begin({truth_, twin()}); }

  void begin(const std::vector<Pose2>& poses) { places_.begin(floor_, {}, clusters_at(poses)); }
  void join(const std::vector<Pose2>& poses) { places_.join(floor_, {}, clusters_at(poses)); }
  [[nodiscard]] static std::vector<PoseCluster> clusters_at(const std::vector<Pose2>& poses) {
    std::vector<PoseCluster> clusters;
    for (const Pose2& pose : poses) clusters.push_back({pose, 0.5, 0.1, 0.05});
    return clusters;
  }
  [[nodiscard]] Pose2 twin() const {
    return {12.0 - truth_.x_m, 12.0 - truth_.y_m, wrap_angle(truth_.theta_rad + kPi)};
  }
  /// A pose beside the true one that fits too, by `decoy_` as well.
  [[nodiscard]] Pose2 decoy() const { return truth_ * Pose2{0.0, 0.8, 0.0}; }
  [[nodiscard]] static bool at(const Pose2& pose, const Pose2& where) {
    return (position_m(pose) - position_m(where)).norm() < 0.5;
  }
  /// One step, and a picture that fits both places, of the true one by so much more.
  void step(const Pose2& moved, double more) { step(moved, more, more); }
  void step(const Pose2& moved, double more, double more_built, double explained = -0.3) {
    truth_ = truth_ * moved;
    places_.move(moved);
    const auto fit = [this](const Pose2& pose) {
      const double off_m =
          std::min((position_m(pose) - position_m(truth_)).norm(), (position_m(pose) - position_m(twin())).norm());
      const double off_decoy_m = (position_m(pose) - position_m(decoy())).norm();
      const double score =
          std::max(std::exp(-off_m * off_m / 0.05), decoy_ * std::exp(-off_decoy_m * off_decoy_m / 0.02));
      return MonteCarlo::Fit{score, std::exp(5.0 * score)};
    };
    const auto look = [&](const Pose2& pose) {
      return at(pose, truth_) ? PlaceHypotheses::Evidence{0.7 + more, 0.7 + more_built, explained}
                              : PlaceHypotheses::Evidence{0.7, 0.7, -0.3};
    };
    places_.weigh(fit, look, std::hypot(moved.x_m, moved.y_m));
  }

  Pose2 truth_{2.0, 2.5, 0.0};
  double decoy_ = 0.0;
  MonteCarlo floor_{floor_of_twelve_by_twelve(), 0.25, {}};
  PlaceHypotheses places_{{}};
};

TEST_F(RobotBetweenTwins, IsAtNeitherWhileNothingTellsThemApart) {
  for (int i = 0; i < 30; ++i) {
    step({0.25, 0.0, i < 20 ? 0.0 : 0.15}, 0.0);
    ASSERT_FALSE(places_.decided());
    ASSERT_EQ(places_.places().size(), 2U);
  }
  for (const PlaceHypothesis& place : places_.places()) {
    EXPECT_TRUE(at(place.at.pose, truth_) || at(place.at.pose, twin()));
    EXPECT_NEAR(place.at.share, 0.5, 0.01);
    EXPECT_NEAR(place.evidence, 0.7, 1e-6);
  }
}

TEST_F(RobotBetweenTwins, IsFoundSoonAfterSomethingTellsThemApart) {
  for (int i = 0; i < 12; ++i) step({0.25, 0.0, 0.0}, 0.0);
  for (int i = 0; i < 12; ++i) step({0.25, 0.0, 0.0}, 0.5);
  EXPECT_TRUE(places_.decided());
  EXPECT_TRUE(at(places_.places().front().at.pose, truth_));
  EXPECT_GT(places_.places().front().at.share, 0.9);
}

TEST_F(RobotBetweenTwins, LearnsNothingFromStanding) {
  for (int i = 0; i < 12; ++i) step({0.25, 0.0, 0.0}, 0.0);
  for (int i = 0; i < 50; ++i) step({0.0, 0.0, 0.0}, 1.0);
  EXPECT_FALSE(places_.decided());
  EXPECT_NEAR(places_.places().back().behind, 0.0, 1e-9);
}

TEST_F(RobotBetweenTwins, LearnsWhatOneCornerTellsOnce) {
  // To and fro within one square, where a wrong chair speaks for one of them all the while.
  for (int i = 0; i < 80; ++i) step({i % 8 < 4 ? 0.25 : -0.25, 0.0, 0.0}, 0.3);
  EXPECT_GT(places_.driven_m(), 19.0);
  EXPECT_FALSE(places_.decided());
  EXPECT_NEAR(places_.places().back().behind, 0.3, 0.01);
}

TEST_F(RobotBetweenTwins, IsNotFoundByFurnitureAlone) {
  for (int i = 0; i < 24; ++i) step({0.25, 0.0, 0.0}, 0.2, 0.0);
  EXPECT_FALSE(places_.decided());
  EXPECT_EQ(places_.places().size(), 2U);
}

TEST_F(RobotBetweenTwins, IsNotFoundAgainstWhatFurnitureTells) {
  for (int i = 0; i < 24; ++i) step({0.25, 0.0, 0.0}, -0.1, 0.3);
  EXPECT_FALSE(places_.decided());
  EXPECT_TRUE(at(places_.places().front().at.pose, truth_));
}

TEST_F(RobotBetweenTwins, IsFoundByAllThatIsDrawnAndSeenTogether) {
  for (int i = 0; i < 6; ++i) step({0.25, 0.0, 0.0}, 0.2, 0.0, 0.0);
  EXPECT_FALSE(places_.decided());  // one corner is not enough
  for (int i = 0; i < 30; ++i) step({0.25, 0.0, 0.0}, 0.2, -0.01, 0.0);
  EXPECT_TRUE(places_.decided());
  EXPECT_TRUE(at(places_.places().front().at.pose, truth_));  // hardly behind in what is built
  EXPECT_NEAR(places_.places().front().agreement, 0.9, 1e-6);
}

TEST_F(RobotBetweenTwins, IsNotFoundByThatAgainstWhatIsBuilt) {
  for (int i = 0; i < 30; ++i) step({0.25, 0.0, 0.0}, 0.2, -0.1, 0.0);
  EXPECT_FALSE(places_.decided());
  EXPECT_TRUE(at(places_.places().front().at.pose, twin()));
}

TEST_F(RobotBetweenTwins, IsNotWhereNothingSpeaksForIt) {
  begin({truth_, twin(), {6.0, 9.0, 1.0}});
  for (int i = 0; i < 24; ++i) step({0.25, 0.0, 0.0}, 0.8);
  ASSERT_EQ(places_.places().size(), 1U);  // the others have been given up
  EXPECT_TRUE(at(places_.places().front().at.pose, truth_));
}

TEST_F(RobotBetweenTwins, HasOneHypothesisWhereTwoHaveMet) {
  begin({truth_, truth_ * Pose2{0.3, 0.0, 0.05}, twin()});
  for (int i = 0; i < 6; ++i) step({0.25, 0.0, 0.0}, 0.0);
  EXPECT_EQ(places_.places().size(), 2U);
}

TEST_F(RobotBetweenTwins, IsFoundAtAPlaceThatJoinsLater) {
  begin({twin()});
  for (int i = 0; i < 8; ++i) step({0.25, 0.0, 0.0}, 0.5);
  join({truth_});
  ASSERT_EQ(places_.places().size(), 2U);
  EXPECT_EQ(places_.places().back().followed_m, 0.0);
  EXPECT_EQ(places_.places().back().behind, 0.0);  // nothing is known of it yet
  for (int i = 0; i < 4; ++i) step({0.25, 0.0, 0.0}, 0.5);
  EXPECT_FALSE(places_.decided());  // by what it saw since alone
  for (int i = 0; i < 8; ++i) step({0.25, 0.0, 0.0}, 0.5);
  EXPECT_TRUE(places_.decided());
  const PlaceHypothesis first = places_.places().front();
  EXPECT_TRUE(at(first.at.pose, truth_));
  EXPECT_NEAR(first.followed_m, 3.0, 1e-9);
  EXPECT_NEAR(first.evidence, 1.2, 1e-6);  // over the metres that it was followed
}

TEST_F(RobotBetweenTwins, IsNotTakenUpTwiceWhereItIsFollowedAlready) {
  for (int i = 0; i < 8; ++i) step({0.25, 0.0, 0.0}, 0.0);
  join({truth_ * Pose2{0.3, 0.0, 0.1}, twin() * Pose2{0.0, -0.3, 0.0}, {6.0, 9.0, 1.0}});
  EXPECT_EQ(places_.places().size(), 3U);
  std::size_t anew = 0;
  for (const PlaceHypothesis& place : places_.places()) anew += place.followed_m == 0.0;
  EXPECT_EQ(anew, 1U);
}

TEST_F(RobotBetweenTwins, KeepsTheLongerHistoryWhereTwoHaveMetThoughTheOtherLeads) {
  for (int i = 0; i < 4; ++i) step({0.25, 0.0, 0.0}, -0.3);  // seen by the older one alone
  join({truth_ * Pose2{0.9, 0.0, 0.0}});                     // its particles come to where it fits
  for (int i = 0; i < 24; ++i) step({i % 2 == 0 ? 0.25 : -0.25, 0.0, 0.0}, 0.5);
  ASSERT_EQ(places_.places().size(), 2U);
  for (const PlaceHypothesis& place : places_.places()) EXPECT_NEAR(place.followed_m, 7.0, 1e-9);
}

TEST_F(RobotBetweenTwins, LeavesAPoseNearbyThatFitsSomewhatForTheTrueOne) {
  decoy_ = 0.7;
  PlaceConfig narrow;
  narrow.spread_m = 0.05;
  PlaceConfig narrow_and_held = narrow;
  narrow_and_held.scatter_share = 0.0;
  for (const PlaceConfig& config : {narrow, narrow_and_held}) {
    places_ = PlaceHypotheses(config);
    truth_ = {2.0, 2.5, 0.0};
    places_.begin(floor_, {}, std::vector<PoseCluster>{{decoy(), 1.0, 0.05, 0.02}});
    for (int i = 0; i < 20; ++i) step({0.25, 0.0, 0.0}, 0.0);
    const double off_m = (position_m(places_.places().front().at.pose) - position_m(truth_)).norm();
    const bool scattered = config.scatter_share > 0.0;
    EXPECT_EQ(off_m < 0.15, scattered) << off_m;
  }
}

TEST_F(RobotBetweenTwins, IsScatteredWhileItDrivesAndNotWhileItStands) {
  const auto alike = [](const Pose2&) { return MonteCarlo::Fit{}; };
  const auto look = [](const Pose2&) { return PlaceHypotheses::Evidence{}; };
  const auto moved = [&](double driven_m) {
    const std::vector<Particle> before = places_.particles();
    places_.weigh(alike, look, driven_m);
    std::size_t count = 0;
    for (std::size_t i = 0; i < before.size(); ++i) count += before[i].pose.x_m != places_.particles()[i].pose.x_m;
    return static_cast<double>(count) / static_cast<double>(before.size());
  };
  EXPECT_EQ(moved(0.0), 0.0);
  EXPECT_NEAR(moved(0.15), 0.5 * PlaceConfig{}.scatter_share, 0.03);
  EXPECT_NEAR(moved(0.6), PlaceConfig{}.scatter_share, 0.03);
}

TEST_F(RobotBetweenTwins, HasParticlesAtBothPlaces) {
  step({0.25, 0.0, 0.0}, 0.0);
  double all = 0.0;
  double here = 0.0;
  for (const Particle& one : places_.particles()) {
    all += one.weight;
    if (at(one.pose, truth_)) here += one.weight;
  }
  EXPECT_NEAR(all, 1.0, 1e-9);
  EXPECT_NEAR(here, 0.5, 0.05);
  places_.clear();
  EXPECT_TRUE(places_.empty());
  EXPECT_TRUE(places_.particles().empty());
  EXPECT_FALSE(places_.decided());
}

}  // namespace
}  // namespace homeward::linemodel
