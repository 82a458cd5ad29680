// SPDX-License-Identifier: Apache-2.0
#include "geometry/two_view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/angles.hpp"
#include "core/median.hpp"
#include "geometry/epipolar_px.hpp"
#include "geometry/error_mixture.hpp"
#include "support/pinhole_scene.hpp"

namespace homeward::geometry::two_view_test {
namespace {

using homeward::testing::pinhole_scene;
using homeward::testing::PinholeScene;

ViewMotion motion_of(const Eigen::Vector3d& direction, double turn_rad) {
  ViewMotion motion;
  motion.current_from_target =
      Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(0.05, 0.1, 1.0).normalized()).toRotationMatrix();
  motion.target_in_current = direction.normalized();
  return motion;
}

double turn_off_deg(const ViewMotion& a, const ViewMotion& b) {
  return degrees(Eigen::AngleAxisd(Eigen::Matrix3d(a.current_from_target.transpose() * b.current_from_target)).angle());
}

double direction_off_deg(const ViewMotion& a, const ViewMotion& b) {
  return degrees(
      std::atan2(a.target_in_current.cross(b.target_in_current).norm(), a.target_in_current.dot(b.target_in_current)));
}

TEST(TwoView, FindsMotionAndPointsAmongThreeInTenWrong) {
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(0.7, 0.7, 0.1), Eigen::Vector3d(0.0, -1.0, 0.0)}) {
    for (const double turn_rad : {0.0, 0.15}) {
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const ViewMotion truth = motion_of(direction, turn_rad);
        const PinholeScene scene = pinhole_scene(truth, {.wrong_share = 0.3, .seed = seed});
        const auto found = estimate_two_view(scene.pairs, {}, seed);
        ASSERT_TRUE(found);
        ASSERT_TRUE(found->has_baseline);
        EXPECT_LT(turn_off_deg(found->motion, truth), 0.4);
        // A wrong pair next to the epipole agrees with it; leaving it out is not always possible.
        EXPECT_LT(direction_off_deg(found->motion, truth), 2.5);
        EXPECT_NEAR(found->error_px, 0.2 / std::sqrt(2.0), 0.05);  // one of four coordinates is at odds with the motion
        std::vector<double> off;
        int wrong = 0;
        for (std::size_t i = 0; i < found->inliers.size(); ++i) {
          const auto of = static_cast<std::size_t>(found->inliers[i]);
          wrong += scene.is_wrong[of] ? 1 : 0;
          if (!scene.is_wrong[of])
            off.push_back(std::abs(found->rays[i].nearness * scene.points[of].norm() / 0.4 - 1.0));
        }
        EXPECT_LE(wrong, 3);  // of 36: a pixel on either side of lines that are 240 or more apart is right by chance
        EXPECT_GT(off.size(), 78U);
        EXPECT_LT(median(off), 0.06);  // of the distances
      }
    }
  }
}

TEST(TwoView, KnowsHowWellItKnowsTheDirection) {
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(0.0, -1.0, 0.0)}) {
    std::vector<double> ratios;
    for (std::uint64_t seed = 0; seed < 9; ++seed) {
      const ViewMotion truth = motion_of(direction, 0.1);
      const auto found = estimate_two_view(pinhole_scene(truth, {.seed = seed}).pairs, {}, seed);
      ASSERT_TRUE(found && found->has_baseline);
      ratios.push_back(direction_off_deg(found->motion, truth) / degrees(found->direction_spread_rad));
    }
    EXPECT_GT(median(ratios), 0.3);
    EXPECT_LT(median(ratios), 2.0);
    EXPECT_LT(*std::max_element(ratios.begin(), ratios.end()), 4.0);
  }
}

/// A lens that sees all around among points so near that the way between the views takes it past many of them.
std::vector<PointPair> pairs_passed_by(const ViewMotion& motion, double baseline_m) {
  const auto seen = [](const Eigen::Vector3d& point) {
    constexpr double kPixels_per_rad = 110.0;
    SeenPoint one;
    one.bearing = point.normalized();
    one.bearing_per_px.col(0) = one.bearing.unitOrthogonal() / kPixels_per_rad;
    one.bearing_per_px.col(1) = one.bearing.cross(one.bearing.unitOrthogonal()) / kPixels_per_rad;
    return one;
  };
  std::vector<PointPair> pairs;
  for (int i = 0; i < 150; ++i) {  // a spiral over the sphere, at three distances
    const double up = 1.0 - 2.0 * (i + 0.5) / 150.0;
    const double level = std::sqrt(1.0 - up * up);
    const Eigen::Vector3d point =
        (0.12 + 0.06 * (i % 3)) * Eigen::Vector3d(level * std::cos(2.4 * i), level * std::sin(2.4 * i), up);
    const Eigen::Vector3d here = motion.current_from_target * point + baseline_m * motion.target_in_current;
    pairs.push_back({seen(here), seen(point)});
  }
  return pairs;
}

TEST(TwoView, SaysTheParallaxOfPointsThatWerePassedAsANumber) {
  const ViewMotion truth = motion_of({1.0, 0.2, 0.0}, 0.1);
  const auto found = estimate_two_view(pairs_passed_by(truth, 0.4), {}, 1);
  ASSERT_TRUE(found);
  ASSERT_TRUE(found->has_baseline);
  EXPECT_LT(direction_off_deg(found->motion, truth), 1.0);
  EXPECT_TRUE(std::isfinite(found->parallax_px)) << "no map file takes another one";
  EXPECT_GT(found->parallax_px, 50.0);
}

TEST(TwoView, ATurnIsNoBaseline) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const ViewMotion truth = motion_of(Eigen::Vector3d::UnitX(), 0.2);
    const PinholeScene scene = pinhole_scene(truth, {.wrong_share = 0.2, .baseline = 0.0, .seed = seed});
    const auto found = estimate_two_view(scene.pairs, {}, seed);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->has_baseline);
    EXPECT_LT(turn_off_deg(found->motion, truth), 0.1);
    EXPECT_GE(found->inliers.size(), 90U);
    EXPECT_LT(found->error_px, 0.4);
    for (const MeetingRays& rays : found->rays) EXPECT_EQ(rays.nearness, 0.0);
  }
}

/// Wrong pairs agree with some direction as easily as right ones do where there is none.
TEST(TwoView, WrongPairsDoNotMakeATurnAWay) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ViewMotion truth = motion_of(Eigen::Vector3d::UnitX(), 0.3);
    const auto scene = pinhole_scene(truth, {.count = 40, .wrong_share = 0.4, .baseline = 0.0, .seed = seed});
    const auto found = estimate_two_view(scene.pairs, {}, seed);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->has_baseline) << seed;
    EXPECT_LT(turn_off_deg(found->motion, truth), 0.2) << seed;
  }
}

TEST(TwoView, TheErrorGrowsWithTheNoise) {
  const ViewMotion truth = motion_of({1.0, 0.4, 0.0}, 0.1);
  double before = 0.0;
  for (const double noise_px : {0.2, 0.5, 1.0, 2.0}) {
    const auto found = estimate_two_view(pinhole_scene(truth, {.noise_px = noise_px, .baseline = 0.8}).pairs, {}, 1);
    ASSERT_TRUE(found);
    EXPECT_GT(found->error_px, 1.3 * before);
    EXPECT_NEAR(found->error_px, noise_px / std::sqrt(2.0), 0.25 * noise_px);
    before = found->error_px;
  }
}

TEST(TwoView, AFarPointHasNoNearnessButBelongs) {
  const ViewMotion truth = motion_of(Eigen::Vector3d::UnitY(), 0.0);
  const PinholeScene near = pinhole_scene(truth, {.count = 60});
  const PinholeScene far = pinhole_scene(truth, {.count = 40, .nearest = 1e5, .farthest = 2e5, .seed = 2});
  std::vector<PointPair> pairs = near.pairs;
  pairs.insert(pairs.end(), far.pairs.begin(), far.pairs.end());
  const auto found = estimate_two_view(pairs, {}, 1);
  ASSERT_TRUE(found && found->has_baseline);
  int belonging = 0;
  for (std::size_t i = 0; i < found->inliers.size(); ++i) {
    if (found->inliers[i] < 60) continue;
    ++belonging;
    EXPECT_LT(found->rays[i].nearness, 0.02);
    EXPECT_GE(found->rays[i].nearness, 0.0);
  }
  EXPECT_GE(belonging, 36);
}

TEST(TwoView, RefinementComesToRestAtTheTruthOfExactPairs) {
  const ViewMotion truth = motion_of({0.9, 0.2, 0.1}, 0.1);
  const PinholeScene scene = pinhole_scene(truth, {.noise_px = 0.0});
  const ViewMotion start = motion_of({0.9, 0.3, 0.0}, 0.12);
  const RefinedMotion refined = refine(start, scene.pairs, 100.0);
  EXPECT_LT(turn_off_deg(refined.motion, truth), 1e-4);
  EXPECT_LT(direction_off_deg(refined.motion, truth), 1e-3);
}

/// Of a plane there are two motions that show it so, and wrong pairs decide between them.
TEST(TwoView, WhatIsLikeDrivingDecidesWhereAPlaneDoesNot) {
  const ViewMotion truth = motion_of({1.0, 0.05, 0.0}, 0.02);
  ViewMotion level = truth;
  level.current_from_target = Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  int right_with = 0;
  int right_without = 0;
  constexpr int kScenes = 20;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    PinholeScene scene = pinhole_scene(level, {.count = 400, .noise_px = 0.1, .baseline = 0.2, .seed = seed});
    // Those near a wall that is seen at a slant, moved onto it.
    const Eigen::Vector3d normal = Eigen::Vector3d(-0.8, 0.6, 0.0);
    std::vector<PointPair> pairs;
    for (std::size_t i = 0; i < scene.points.size() && pairs.size() < 40; ++i) {
      const double along = -1.6 / normal.dot(scene.points[i].normalized());
      if (!(along > 1.0) || along > 6.0) continue;
      const Eigen::Vector3d onto = along * scene.points[i].normalized();
      const Eigen::Vector3d moved = level.current_from_target.transpose() * (onto - 0.2 * level.target_in_current);
      const Eigen::Vector2d off(0.05 * std::sin(7.0 * static_cast<double>(i)),
                                0.05 * std::cos(5.0 * static_cast<double>(i)));
      pairs.push_back({testing::pinhole_point(testing::pinhole_pixel(onto)),
                       testing::pinhole_point(testing::pinhole_pixel(moved) + off)});
    }
    TwoViewConfig config;
    const auto without = estimate_two_view(pairs, config, seed);
    config.driving = DrivingPrior{};
    const auto with = estimate_two_view(pairs, config, seed);
    ASSERT_TRUE(with && without);
    right_with += with->has_baseline && direction_off_deg(with->motion, level) < 5.0 ? 1 : 0;
    right_without += without->has_baseline && direction_off_deg(without->motion, level) < 5.0 ? 1 : 0;
  }
  EXPECT_EQ(right_with, kScenes);
  EXPECT_LT(right_without, kScenes);
}

TEST(TwoView, AMotionUnlikeDrivingIsFoundWhereThePairsSaySo) {
  ViewMotion aside = motion_of({0.0, 1.0, 0.3}, 0.0);
  aside.current_from_target = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  TwoViewConfig config;
  config.driving = DrivingPrior{};
  const auto found = estimate_two_view(pinhole_scene(aside, {.wrong_share = 0.2}).pairs, config, 1);
  ASSERT_TRUE(found && found->has_baseline);
  EXPECT_LT(direction_off_deg(found->motion, aside), 2.0);
  EXPECT_LT(turn_off_deg(found->motion, aside), 0.4);
}

TEST(EpipolarPixels, SlopesAreThoseOfDifferences) {
  const ViewMotion motion = motion_of({1.0, 0.3, 0.1}, 0.15);
  const EpipolarPixels error(motion);
  constexpr double kStep = 1e-6;
  const DrivingPrior driving;
  Eigen::Matrix<double, 4, 5> prior_slope;
  EXPECT_TRUE(error.unlike_driving(driving, prior_slope).allFinite());
  for (int k = 0; k < 5; ++k) {
    const EpipolarPixels after(error.moved(kStep * MotionStep::Unit(k)));
    const EpipolarPixels before(error.moved(-kStep * MotionStep::Unit(k)));
    for (const PointPair& pair : pinhole_scene(motion, {.count = 20, .noise_px = 2.0}).pairs) {
      MotionStep slope;
      EXPECT_NEAR(error(pair, slope), error(pair), 1e-12);
      EXPECT_NEAR(slope[k], (after(pair) - before(pair)) / (2.0 * kStep), 1e-5 * (1.0 + std::abs(slope[k])));
    }
    Eigen::Matrix<double, 4, 5> ignored;
    const Eigen::Vector4d change =
        (after.unlike_driving(driving, ignored) - before.unlike_driving(driving, ignored)) / (2.0 * kStep);
    EXPECT_LT((change - prior_slope.col(k)).norm(), 1e-5 * (1.0 + change.norm()));
  }
}

TEST(ErrorMixture, FindsTheSpreadAndShareOfRightPairs) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> right(0.0, 0.2);
  std::uniform_real_distribution<double> wrong(0.0, 10.0);
  std::vector<double> sizes;
  for (int i = 0; i < 200; ++i) sizes.push_back(std::abs(right(random)));
  for (int i = 0; i < 80; ++i) sizes.push_back(wrong(random));
  for (int i = 0; i < 20; ++i) sizes.push_back(std::numeric_limits<double>::infinity());
  const ErrorMixture mixture = error_mixture(sizes, 0.05, 10.0);
  EXPECT_NEAR(mixture.spread_px, 0.2, 0.03);
  EXPECT_NEAR(mixture.right_share, 2.0 / 3.0, 0.06);
  EXPECT_EQ(error_mixture(std::vector<double>(10, 0.0), 0.05, 10.0).spread_px, 0.05);
}

TEST(ErrorMixture, OnThePlaneExactPointsAreLikelierThanExactLines) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> off(0.0, 0.2);
  std::vector<double> distances;
  std::vector<double> across;
  for (int i = 0; i < 100; ++i) {
    across.push_back(std::abs(off(random)));
    distances.push_back(std::hypot(across.back(), off(random)));
  }
  const ErrorMixture plane = error_mixture_on_plane(distances, 0.05, 10.0);
  EXPECT_NEAR(plane.spread_px, 0.2, 0.03);
  const ErrorMixture line = error_mixture(across, 0.05, 10.0);
  EXPECT_GT(plane.log_likelihood, log_likelihood_on_plane(line, across.size(), 10.0) + 100.0);
  for (double& distance : distances) distance += 5.0;  // along the lines
  const ErrorMixture moved = error_mixture_on_plane(distances, 0.05, 10.0);
  EXPECT_LT(moved.log_likelihood, log_likelihood_on_plane(line, across.size(), 10.0) - 100.0);
}

TEST(TwoView, NamesWhatItCannotDo) {
  const ViewMotion truth = motion_of(Eigen::Vector3d::UnitX(), 0.0);
  const auto few = estimate_two_view(pinhole_scene(truth, {.count = 7}).pairs, {}, 1);
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().code, ErrorCode::kTooLittleSupport);
  const auto none = estimate_two_view(std::vector<PointPair>{}, {}, 1);
  ASSERT_FALSE(none);
  TwoViewConfig config;
  config.fewest_pairs = 3;
  config.search_error_px = 0.0;
  EXPECT_EQ(problems(config).size(), 2U);
  const auto bad = estimate_two_view(pinhole_scene(truth, {}).pairs, config, 1);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::kInvalidInput);
}

TEST(TwoView, IsTheSameForTheSameSeed) {
  const PinholeScene scene = pinhole_scene(motion_of({1.0, 0.2, 0.0}, 0.1), {.wrong_share = 0.4});
  const auto once = estimate_two_view(scene.pairs, {}, 5);
  const auto twice = estimate_two_view(scene.pairs, {}, 5);
  ASSERT_TRUE(once && twice);
  EXPECT_EQ(once->motion.current_from_target, twice->motion.current_from_target);
  EXPECT_EQ(once->motion.target_in_current, twice->motion.target_in_current);
  EXPECT_EQ(once->inliers, twice->inliers);
}

}  // namespace
}  // namespace homeward::geometry::two_view_test
