// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/relative_pose/CentralRelativePoseSacProblem.hpp>

#include "geometry/planar_motion.hpp"
#include "support/planar_scene.hpp"

namespace homeward::geometry::against_opengv_test {
namespace {

using RelativePoseProblem = opengv::sac_problems::relative_pose::CentralRelativePoseSacProblem;

/// Where the target lies and how it is turned, by an independent implementation without the planar constraint.
PlanarMotion by_opengv(const std::vector<Correspondence>& correspondences, RelativePoseProblem::Algorithm algorithm) {
  opengv::bearingVectors_t current;
  opengv::bearingVectors_t target;
  for (const Correspondence& c : correspondences) {
    current.push_back(c.current);
    target.push_back(c.target);
  }
  opengv::relative_pose::CentralRelativeAdapter adapter(current, target);
  constexpr bool kRandomSeed = false;
  opengv::sac::Ransac<RelativePoseProblem> ransac;
  ransac.sac_model_ = std::make_shared<RelativePoseProblem>(adapter, algorithm, kRandomSeed);
  ransac.threshold_ = 2.0 * (1.0 - std::cos(0.006));  // OpenGV sums 1 - cos of both reprojections
  ransac.max_iterations_ = 300;
  if (!ransac.computeModel()) return {kPi, kPi};
  opengv::transformation_t current_from_target;
  ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, current_from_target);
  const Eigen::Vector3d t = current_from_target.col(3);
  return {std::atan2(t.y(), t.x()), std::atan2(current_from_target(1, 0), current_from_target(0, 0))};
}

void agree(RelativePoseProblem::Algorithm algorithm, double outlier_share) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const auto scene = homeward::testing::planar_scene(150, outlier_share, 0.0005, 1.0, 60 + seed);
    const auto ours = estimate_planar_motion(scene.correspondences, {}, seed);
    ASSERT_TRUE(ours);
    const PlanarMotion theirs = by_opengv(scene.correspondences, algorithm);
    EXPECT_LT(std::abs(degrees(wrap_angle(ours->motion.direction_rad - theirs.direction_rad))), 1.5) << seed;
    EXPECT_LT(std::abs(degrees(wrap_angle(ours->motion.turn_rad - theirs.turn_rad))), 0.5) << seed;
  }
}

/// Its own RANSAC, when it succeeds, must agree as well; how often that is.
int right_whatever_opengv_says(double outlier_share, RelativePoseProblem::Algorithm algorithm, int scenes) {
  int theirs_right = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    const auto scene = homeward::testing::planar_scene(200, outlier_share, 0.0005, 1.0, 160 + seed);
    const auto ours = estimate_planar_motion(scene.correspondences, {}, seed);
    EXPECT_TRUE(ours) << outlier_share << " " << seed;
    if (!ours) continue;
    const auto off_deg = [](double a_rad, double b_rad) { return std::abs(degrees(wrap_angle(a_rad - b_rad))); };
    EXPECT_LT(off_deg(ours->motion.direction_rad, scene.truth.direction_rad), 1.0) << outlier_share << " " << seed;
    EXPECT_LT(off_deg(ours->motion.turn_rad, scene.truth.turn_rad), 0.5) << outlier_share << " " << seed;
    const PlanarMotion theirs = by_opengv(scene.correspondences, algorithm);
    if (off_deg(theirs.direction_rad, scene.truth.direction_rad) > 1.5 ||
        off_deg(theirs.turn_rad, scene.truth.turn_rad) > 0.5) {
      continue;
    }
    ++theirs_right;
    EXPECT_LT(off_deg(ours->motion.direction_rad, theirs.direction_rad), 2.0) << outlier_share << " " << seed;
    EXPECT_LT(off_deg(ours->motion.turn_rad, theirs.turn_rad), 1.0) << outlier_share << " " << seed;
  }
  return theirs_right;
}

TEST(AgainstOpenGv, RightWithoutOutliers) {
  EXPECT_GE(right_whatever_opengv_says(0.0, RelativePoseProblem::STEWENIUS, 6), 5);
}
TEST(AgainstOpenGv, RightWithAFifthOfOutliers) {
  EXPECT_GE(right_whatever_opengv_says(0.2, RelativePoseProblem::STEWENIUS, 6), 5);
}
TEST(AgainstOpenGv, RightWithTwoFifthsOfOutliers) {
  EXPECT_GE(right_whatever_opengv_says(0.4, RelativePoseProblem::NISTER, 6), 4);
}
// Five matches without an outlier become rare: from here on the judge may fail, ours may not.
TEST(AgainstOpenGv, RightWithThreeFifthsOfOutliers) { right_whatever_opengv_says(0.6, RelativePoseProblem::NISTER, 6); }
TEST(AgainstOpenGv, RightWithFourFifthsOfOutliers) { right_whatever_opengv_says(0.8, RelativePoseProblem::NISTER, 3); }

TEST(AgainstOpenGv, EightPointFindsTheSameMotion) { agree(RelativePoseProblem::EIGHTPT, 0.1); }
TEST(AgainstOpenGv, SteweniusFivePointFindsTheSameMotion) { agree(RelativePoseProblem::STEWENIUS, 0.25); }
TEST(AgainstOpenGv, NisterFivePointFindsTheSameMotion) { agree(RelativePoseProblem::NISTER, 0.25); }

}  // namespace
}  // namespace homeward::geometry::against_opengv_test
