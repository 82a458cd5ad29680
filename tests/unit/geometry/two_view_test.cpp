// SPDX-License-Identifier: Apache-2.0
#include "geometry/two_view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/angles.hpp"
#include "core/median.hpp"
#include "geometry/epipolar_px.hpp"
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
