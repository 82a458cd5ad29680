// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/relative_pose/CentralRelativePoseSacProblem.hpp>

#include "geometry/planar_motion.hpp"
#include "support/planar_scene.hpp"

namespace homeward::geometry {
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
  EXPECT_TRUE(ransac.computeModel());
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

TEST(AgainstOpenGv, EightPointFindsTheSameMotion) { agree(RelativePoseProblem::EIGHTPT, 0.1); }
TEST(AgainstOpenGv, SteweniusFivePointFindsTheSameMotion) { agree(RelativePoseProblem::STEWENIUS, 0.25); }
TEST(AgainstOpenGv, NisterFivePointFindsTheSameMotion) { agree(RelativePoseProblem::NISTER, 0.25); }

}  // namespace
}  // namespace homeward::geometry
