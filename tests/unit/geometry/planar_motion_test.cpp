// SPDX-License-Identifier: Apache-2.0
#include "geometry/planar_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "geometry/planar_solver.hpp"
#include "support/planar_scene.hpp"

namespace homeward::geometry::planar_motion_test {
namespace {

using homeward::testing::direction_error_deg;
using homeward::testing::planar_scene;
using homeward::testing::PlanarScene;

double turn_error_deg(const PlanarMotion& found, const PlanarMotion& truth) {
  return std::abs(degrees(wrap_angle(found.turn_rad - truth.turn_rad)));
}

TEST(PlanarMinimalSolver, TheTruthIsAmongItsAnswersUpToTheSign) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const PlanarScene scene = planar_scene(2, 0.0, 0.0, 0.8, seed);
    const auto motions = solve_planar_motion({scene.correspondences[0], scene.correspondences[1]});
    ASSERT_GE(motions.size(), 1U) << seed;
    ASSERT_LE(motions.size(), 2U) << seed;
    double nearest_deg = 180.0;
    for (const PlanarMotion& motion : motions) {
      const double direction_deg = direction_error_deg(motion, scene.truth);
      nearest_deg = std::min(
          nearest_deg, std::max(std::min(direction_deg, 180.0 - direction_deg), turn_error_deg(motion, scene.truth)));
      for (const Correspondence& c : scene.correspondences) EXPECT_LT(epipolar_error_rad(motion, c), 1e-6) << seed;
    }
    EXPECT_LT(nearest_deg, 1e-4) << seed;
  }
}

TEST(PlanarMinimalSolver, TwiceTheSameCorrespondenceSolvesNothing) {
  const PlanarScene scene = planar_scene(1, 0.0, 0.0, 0.8, 5);
  EXPECT_TRUE(solve_planar_motion({scene.correspondences[0], scene.correspondences[0]}).empty());
}

TEST(EpipolarError, IsTheAngleByWhichABearingIsOff) {
  // Target 1 m ahead, no turn; a point at the left, seen by the target view. Moving the current bearing up by a small
  // angle, across its epipolar plane, splits the error between both views: 1/sqrt(2) of it.
  const Eigen::Vector3d point(0.5, 3.0, 0.0);
  const Correspondence exact{point.normalized(), (point - Eigen::Vector3d(1, 0, 0)).normalized()};
  const PlanarMotion motion{0.0, 0.0};
  EXPECT_NEAR(epipolar_error_rad(motion, exact), 0.0, 1e-12);
  constexpr double kOffRad = 0.01;
  const Eigen::Vector3d up = std::cos(kOffRad) * exact.current + std::sin(kOffRad) * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(epipolar_error_rad(motion, {up, exact.target}), kOffRad / std::sqrt(2.0), 2e-4);
}

TEST(PlanarEstimate, DirectionAndTurnAreRightWhateverTheOutliers) {
  for (const double outlier_share : {0.0, 0.2, 0.4, 0.6}) {
    std::vector<double> errors_deg;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const PlanarScene scene = planar_scene(120, outlier_share, 0.001, 0.8, 1000 + seed);
      const auto estimate = estimate_planar_motion(scene.correspondences, {}, seed);
      ASSERT_TRUE(estimate) << outlier_share << " " << seed;
      EXPECT_LT(direction_error_deg(estimate->motion, scene.truth), 4.0) << outlier_share << " " << seed;
      EXPECT_LT(turn_error_deg(estimate->motion, scene.truth), 1.0) << outlier_share << " " << seed;
      errors_deg.push_back(direction_error_deg(estimate->motion, scene.truth));
      EXPECT_TRUE(std::is_sorted(estimate->inliers.begin(), estimate->inliers.end()));
      int right = 0;
      for (const int inlier : estimate->inliers) right += scene.outlier[static_cast<std::size_t>(inlier)] ? 0 : 1;
      EXPECT_GT(right, 0.9 * (1.0 - outlier_share) * 120) << outlier_share << " " << seed;
      EXPECT_GT(right, 0.7 * static_cast<double>(estimate->inliers.size())) << outlier_share << " " << seed;
      EXPECT_GT(estimate->forward_share, 0.8) << outlier_share << " " << seed;
      EXPECT_LT(estimate->direction_spread_rad, radians(5.0)) << outlier_share << " " << seed;
    }
    std::nth_element(errors_deg.begin(), errors_deg.begin() + 20, errors_deg.end());
    EXPECT_LT(errors_deg[20], 0.6) << outlier_share;
  }
}

TEST(PlanarEstimate, ParallaxTellsNearFromFar) {
  const auto near = planar_scene(100, 0.0, 0.0005, 0.05, 3);
  const auto far = planar_scene(100, 0.0, 0.0005, 1.5, 3);
  const auto of_near = estimate_planar_motion(near.correspondences, {}, 1);
  const auto of_far = estimate_planar_motion(far.correspondences, {}, 1);
  ASSERT_TRUE(of_near && of_far);
  EXPECT_LT(of_near->median_parallax_rad, 0.03);
  EXPECT_GT(of_far->median_parallax_rad, 0.15);
  EXPECT_GT(of_near->direction_spread_rad, of_far->direction_spread_rad);
}

TEST(PlanarEstimate, TheSameViewHasATurnAndNoParallax) {
  const PlanarScene scene = planar_scene(80, 0.0, 0.0, 0.0, 9);
  const auto estimate = estimate_planar_motion(scene.correspondences, {}, 1);
  ASSERT_TRUE(estimate);
  EXPECT_LT(turn_error_deg(estimate->motion, scene.truth), 0.01);
  EXPECT_LT(estimate->median_parallax_rad, 1e-4);
}

TEST(PlanarEstimate, IsTheSameForTheSameSeed) {
  const PlanarScene scene = planar_scene(90, 0.5, 0.002, 0.7, 21);
  const auto once = estimate_planar_motion(scene.correspondences, {}, 77);
  const auto twice = estimate_planar_motion(scene.correspondences, {}, 77);
  ASSERT_TRUE(once && twice);
  EXPECT_EQ(once->motion.direction_rad, twice->motion.direction_rad);
  EXPECT_EQ(once->motion.turn_rad, twice->motion.turn_rad);
  EXPECT_EQ(once->inliers, twice->inliers);
}

TEST(PlanarEstimate, TooFewMatchesAreAnError) {
  for (const int count : {0, 1, 2}) {
    const PlanarScene scene = planar_scene(count, 0.0, 0.0, 0.7, 2);
    const auto estimate = estimate_planar_motion(scene.correspondences, {}, 1);
    ASSERT_FALSE(estimate) << count;
    EXPECT_EQ(estimate.error().code, ErrorCode::kTooLittleSupport);
  }
}

TEST(PlanarEstimate, OneMatchRepeatedIsAnErrorAndNotAGuess) {
  const PlanarScene scene = planar_scene(1, 0.0, 0.0, 0.7, 2);
  const std::vector<Correspondence> repeated(30, scene.correspondences[0]);
  const auto estimate = estimate_planar_motion(repeated, {}, 1);
  ASSERT_FALSE(estimate);
  EXPECT_EQ(estimate.error().code, ErrorCode::kTooLittleSupport);
}

TEST(PlanarEstimate, BearingsThatAreNoNumbersAreNoSupport) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Correspondence> broken(12, {{nan, nan, nan}, {1.0, 0.0, 0.0}});
  const auto estimate = estimate_planar_motion(broken, {}, 1);
  ASSERT_FALSE(estimate);
  EXPECT_EQ(estimate.error().code, ErrorCode::kTooLittleSupport);
}

TEST(PlanarEstimate, RandomMatchesFindFewInliers) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const PlanarScene scene = planar_scene(60, 1.0, 0.0, 0.7, 400 + seed);
    const auto estimate = estimate_planar_motion(scene.correspondences, {}, seed);
    if (estimate) {
      EXPECT_LT(estimate->inliers.size(), 15U) << seed;
    } else {
      EXPECT_EQ(estimate.error().code, ErrorCode::kTooLittleSupport);
    }
  }
}

TEST(PlanarEstimate, SwappingTheViewsGivesTheMotionBack) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const PlanarScene scene = planar_scene(120, 0.4, 0.001, 0.8, 500 + seed);
    std::vector<Correspondence> swapped;
    for (const Correspondence& c : scene.correspondences) swapped.push_back({c.target, c.current});
    const auto there = estimate_planar_motion(scene.correspondences, {}, seed);
    const auto back = estimate_planar_motion(swapped, {}, seed);
    ASSERT_TRUE(there && back) << seed;
    // Seen from the target the current viewpoint lies the other way, in a frame that is turned.
    const PlanarMotion expected{wrap_angle(there->motion.direction_rad + kPi - there->motion.turn_rad),
                                -there->motion.turn_rad};
    EXPECT_LT(direction_error_deg(back->motion, expected), 0.3) << seed;
    EXPECT_LT(turn_error_deg(back->motion, expected), 0.1) << seed;
    EXPECT_NEAR(back->evidence, there->evidence, 0.1 * there->evidence) << seed;
  }
}

TEST(PlanarEstimate, TurningTheRobotChangesNothingButTheTurn) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const PlanarScene scene = planar_scene(120, 0.4, 0.001, 0.8, 600 + seed);
    const double by_rad = 0.5 * static_cast<double>(seed) - 2.9;
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(-by_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    std::vector<Correspondence> target_turned;
    for (const Correspondence& c : scene.correspondences) target_turned.push_back({c.current, turned * c.target});
    const auto before = estimate_planar_motion(scene.correspondences, {}, seed);
    const auto after = estimate_planar_motion(target_turned, {}, seed);
    ASSERT_TRUE(before && after) << seed;
    EXPECT_LT(direction_error_deg(after->motion, before->motion), 0.3) << seed;
    EXPECT_LT(turn_error_deg(after->motion, {0.0, wrap_angle(before->motion.turn_rad + by_rad)}), 0.1) << seed;
    EXPECT_NEAR(after->evidence, before->evidence, 0.1 * before->evidence) << seed;
  }
}

TEST(PlanarEstimate, EvidenceTellsRightMotionsFromChance) {
  double greatest_by_chance = -1e9;
  double least_right = 1e9;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto chance = estimate_planar_motion(planar_scene(80, 1.0, 0.001, 0.8, 700 + seed).correspondences, {}, seed);
    if (chance) greatest_by_chance = std::max(greatest_by_chance, chance->evidence);
    const auto right = estimate_planar_motion(planar_scene(80, 0.5, 0.001, 0.8, 800 + seed).correspondences, {}, seed);
    ASSERT_TRUE(right);
    least_right = std::min(least_right, right->evidence);
  }
  EXPECT_LT(greatest_by_chance, 3.0);
  EXPECT_GT(least_right, 20.0);
}

/// Every match at the height of the camera: any motion explains all of them.
TEST(PlanarEstimate, MatchesAtTheHorizonAreNoEvidence) {
  PlanarScene scene = planar_scene(60, 0.0, 0.0005, 0.8, 31);
  for (Correspondence& c : scene.correspondences) {
    c.current = Eigen::Vector3d(c.current.x(), c.current.y(), 0.0).normalized();
    c.target = Eigen::Vector3d(c.target.x(), c.target.y(), 0.0).normalized();
  }
  EXPECT_FALSE(estimate_planar_motion(scene.correspondences, {}, 1));
  // Beside them, a few matches that can tell decide and are all the evidence there is.
  const PlanarScene telling = planar_scene(20, 0.0, 0.0005, 0.8, 32);
  const auto alone = estimate_planar_motion(telling.correspondences, {}, 1);
  auto both = telling.correspondences;
  both.insert(both.end(), scene.correspondences.begin(), scene.correspondences.end());
  const auto among = estimate_planar_motion(both, {}, 1);
  ASSERT_TRUE(alone && among);
  EXPECT_LT(direction_error_deg(among->motion, telling.truth), 5.0);
  EXPECT_LT(among->evidence, alone->evidence + 60.0 * 0.7);  // log 2 each, for lying in front
}

TEST(PlanarEstimate, TheSignIsRightAndTheMoreSureTheMoreMatches) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto few = planar_scene(20, 0.3, 0.001, 0.8, 900 + seed);
    const auto many = planar_scene(200, 0.3, 0.001, 0.8, 900 + seed);
    const auto of_few = estimate_planar_motion(few.correspondences, {}, seed);
    const auto of_many = estimate_planar_motion(many.correspondences, {}, seed);
    ASSERT_TRUE(of_few && of_many);
    EXPECT_LT(direction_error_deg(of_many->motion, many.truth), 5.0) << seed;
    EXPECT_GT(of_many->sign_log_odds, of_few->sign_log_odds) << seed;
    EXPECT_GE(of_few->sign_log_odds, 0.0) << seed;
  }
}

TEST(PlanarEstimate, BrokenBearingsAmongGoodOnesAreLeftOut) {
  const PlanarScene scene = planar_scene(60, 0.2, 0.001, 0.8, 41);
  auto broken = scene.correspondences;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 20; i < 30; ++i) broken[i].target = {nan, 0.0, 0.0};
  const auto estimate = estimate_planar_motion(broken, {}, 1);
  ASSERT_TRUE(estimate);
  EXPECT_LT(direction_error_deg(estimate->motion, scene.truth), 4.0);
  for (const int inlier : estimate->inliers) EXPECT_TRUE(inlier < 20 || inlier >= 30) << inlier;
  EXPECT_TRUE(std::isfinite(estimate->evidence));
}

TEST(PlanarEstimate, ListensToWhatLooksMoreLikelyRight) {
  // Of 120 matches some 10 are right. Where looks say nothing these are often lost.
  int blind = 0;
  int right = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    PlanarScene scene = planar_scene(120, 0.92, 0.002, 2.0, 500 + seed);
    const auto without = estimate_planar_motion(scene.correspondences, {}, seed);
    blind += without && direction_error_deg(without->motion, scene.truth) < 10.0 ? 1 : 0;
    // Three of four right ones look unique, and every eighth wrong one.
    for (std::size_t i = 0; i < scene.correspondences.size(); ++i) {
      const bool unique = scene.outlier[i] ? i % 8 == 0 : i % 4 != 0;
      scene.correspondences[i].odds = unique ? 6.0 : 0.3;
    }
    const auto with = estimate_planar_motion(scene.correspondences, {}, seed);
    right += with && direction_error_deg(with->motion, scene.truth) < 10.0 ? 1 : 0;
  }
  EXPECT_GE(right, 26);
  EXPECT_LE(blind, right - 4);
}

TEST(PlanarEstimate, LooksAloneAreNoEvidence) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    PlanarScene scene = planar_scene(100, 1.0, 0.001, 0.8, 700 + seed);
    for (std::size_t i = 0; i < scene.correspondences.size(); i += 2) scene.correspondences[i].odds = 7.0;
    const auto estimate = estimate_planar_motion(scene.correspondences, {}, seed);
    if (estimate) {
      EXPECT_LT(estimate->evidence, 3.0) << seed;
    }
  }
}

TEST(PlanarEstimate, EqualLooksChangeNothing) {
  PlanarScene scene = planar_scene(100, 0.4, 0.001, 0.8, 801);
  const auto plain = estimate_planar_motion(scene.correspondences, {}, 1);
  for (Correspondence& c : scene.correspondences) c.odds = 3.0;
  const auto equal = estimate_planar_motion(scene.correspondences, {}, 1);
  ASSERT_TRUE(plain && equal);
  EXPECT_LT(direction_error_deg(equal->motion, plain->motion), 0.2);
  EXPECT_NEAR(equal->evidence, plain->evidence, 0.05 * plain->evidence);
}

}  // namespace
}  // namespace homeward::geometry::planar_motion_test
