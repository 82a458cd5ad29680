// SPDX-License-Identifier: Apache-2.0
#include "linemodel/monte_carlo.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"

namespace homeward::linemodel {
namespace {

std::vector<Eigen::Vector2d> floor_of_ten_by_ten() {
  std::vector<Eigen::Vector2d> points_m;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) points_m.emplace_back(0.25 * i, 0.25 * j);
  }
  return points_m;
}

/// A sensor that tells how far three posts are, and which way they lie.
MonteCarlo::Fit fit_of_posts(const Pose2& pose, const Pose2& truth) {
  const std::array<Eigen::Vector2d, 3> posts_m{{{1.0, 2.0}, {9.0, 1.0}, {4.0, 8.5}}};
  double score = 0.0;
  for (const Eigen::Vector2d& post_m : posts_m) {
    const auto seen = [&](const Pose2& from) {
      const Eigen::Vector2d off = post_m - position_m(from);
      return Eigen::Vector2d(off.norm(), wrap_angle(std::atan2(off.y(), off.x()) - from.theta_rad));
    };
    const Eigen::Vector2d expected = seen(pose);
    const Eigen::Vector2d measured = seen(truth);
    const double off_m = expected.x() - measured.x();
    const double off_rad = wrap_angle(expected.y() - measured.y());
    score += std::exp(-0.5 * (off_m * off_m / 0.25 + off_rad * off_rad / 0.04)) / 3.0;
  }
  return {score, std::exp(8.0 * score)};
}

MonteCarloConfig small_config() {
  MonteCarloConfig config;
  config.first_particles = 20'000;
  return config;
}

class RobotAmongPosts : public ::testing::Test {
 protected:
  /// Drives a circle.
  PoseCluster drive(int steps) {
    for (int i = 0; i < steps; ++i) {
      const Pose2 step{0.2, 0.0, 0.08};
      truth_ = truth_ * step;
      filter_.move(step);
      filter_.weigh([this](const Pose2& pose) { return fit_of_posts(pose, truth_); });
    }
    return filter_.clusters(0.5, 0.35, 3).front();
  }
  [[nodiscard]] double off_m(const PoseCluster& said) const {
    return (position_m(said.pose) - position_m(truth_)).norm();
  }

  Pose2 truth_{5.0, 3.0, 0.7};
  MonteCarlo filter_{floor_of_ten_by_ten(), 0.25, small_config()};
};

TEST_F(RobotAmongPosts, IsFoundFromAnywhereAndTakesFewerParticlesThen) {
  filter_.start_anywhere();
  const PoseCluster said = drive(30);
  EXPECT_LT(off_m(said), 0.15);
  EXPECT_LT(std::abs(wrap_angle(said.pose.theta_rad - truth_.theta_rad)), 0.06);
  EXPECT_GT(said.share, 0.9);
  EXPECT_LT(filter_.particles().size(), 4000U);
}

TEST_F(RobotAmongPosts, IsFoundAgainAfterItWasCarriedAway) {
  filter_.start_at(truth_, 0.2, 0.1);
  ASSERT_LT(off_m(drive(20)), 0.2);
  truth_ = {2.0, 6.0, -2.5};
  EXPECT_LT(off_m(drive(60)), 0.2);
}

TEST_F(RobotAmongPosts, IsScatteredInTheShareThatIsAskedAndNoFurther) {
  filter_.start_at(truth_, 0.0, 0.0);
  filter_.scatter(0.2, 0.3, 0.1);
  double moved = 0.0;
  double square_m2 = 0.0;
  for (const Particle& one : filter_.particles()) {
    const double off_m = (position_m(one.pose) - position_m(truth_)).norm();
    moved += off_m > 0.0;
    square_m2 += off_m * off_m;
    EXPECT_EQ(one.weight, filter_.particles().front().weight);
  }
  EXPECT_NEAR(moved / static_cast<double>(filter_.particles().size()), 0.2, 0.03);
  EXPECT_NEAR(std::sqrt(square_m2 / moved), 0.3 * std::sqrt(2.0), 0.04);
}

TEST_F(RobotAmongPosts, IsHeldToOneSeedBitForBit) {
  MonteCarlo twin(floor_of_ten_by_ten(), 0.25, small_config());
  for (MonteCarlo* one : {&filter_, &twin}) {
    one->start_anywhere();
    for (int i = 0; i < 3; ++i) {
      one->move({0.2, 0.0, 0.1});
      one->weigh([this](const Pose2& pose) { return fit_of_posts(pose, truth_); });
    }
  }
  ASSERT_EQ(filter_.particles().size(), twin.particles().size());
  for (std::size_t i = 0; i < twin.particles().size(); ++i) {
    ASSERT_EQ(filter_.particles()[i].pose.x_m, twin.particles()[i].pose.x_m);
    ASSERT_EQ(filter_.particles()[i].pose.theta_rad, twin.particles()[i].pose.theta_rad);
  }
}

TEST_F(RobotAmongPosts, SpreadsAsFarAsOdometryMayBeWrong) {
  filter_.start_at({5.0, 5.0, 0.0}, 0.0, 0.0);
  for (int i = 0; i < 10; ++i) filter_.move({0.3, 0.0, 0.0});
  const PoseCluster said = filter_.clusters(3.0, 1.0, 1).front();
  EXPECT_NEAR(said.pose.x_m, 8.0, 0.05);
  EXPECT_NEAR(said.pose.y_m, 5.0, 0.05);
  EXPECT_GT(said.spread_m, 0.05);
  EXPECT_LT(said.spread_m, 0.5);
}

TEST_F(RobotAmongPosts, StaysWhereItIsBelievedToBeWhenNothingFits) {
  filter_.start_at(truth_, 0.1, 0.05);
  filter_.weigh([](const Pose2&) { return MonteCarlo::Fit{0.0, 0.0}; });
  EXPECT_LT(off_m(filter_.clusters(0.5, 0.35, 1).front()), 0.1);
}

TEST_F(RobotAmongPosts, HasSiblingsOnTheSameFloorWithoutParticles) {
  filter_.start_at(truth_, 0.1, 0.05);
  MonteCarloConfig config = small_config();
  config.first_particles = 500;
  MonteCarlo sibling = filter_.sibling(config);
  EXPECT_TRUE(sibling.particles().empty());
  sibling.start_anywhere();
  ASSERT_EQ(sibling.particles().size(), 500U);
  for (const Particle& one : sibling.particles()) {
    ASSERT_GE(one.pose.x_m, -0.125);
    ASSERT_LE(one.pose.x_m, 9.875);
  }
}

TEST(Clusters, ComeMostProbableFirst) {
  MonteCarlo filter(floor_of_ten_by_ten(), 0.25, small_config());
  filter.start_anywhere();
  // Two poses fit, one better than the other.
  filter.weigh([](const Pose2& pose) {
    const double here = (position_m(pose) - Eigen::Vector2d(2.0, 2.0)).norm() < 0.3 ? 3.0 : 0.0;
    const double there = (position_m(pose) - Eigen::Vector2d(8.0, 8.0)).norm() < 0.3 ? 1.0 : 0.0;
    const bool ahead = std::abs(pose.theta_rad) < 0.3;
    return MonteCarlo::Fit{here + there, ahead ? here + there : 0.0};
  });
  const auto places = filter.clusters(0.5, 0.35, 4);
  ASSERT_EQ(places.size(), 2U);
  EXPECT_LT((position_m(places[0].pose) - Eigen::Vector2d(2.0, 2.0)).norm(), 0.2);
  EXPECT_LT((position_m(places[1].pose) - Eigen::Vector2d(8.0, 8.0)).norm(), 0.2);
  EXPECT_GT(places[0].share, 0.6);
}

}  // namespace
}  // namespace homeward::linemodel
