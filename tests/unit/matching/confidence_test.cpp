// SPDX-License-Identifier: Apache-2.0
#include "matching/confidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "core/angles.hpp"

namespace homeward::matching::confidence_test {
namespace {

using geometry::Correspondence;
using geometry::PlanarEstimate;

/// Matches of points around two views a metre apart along x; those of number `wrong` and above lie anywhere.
struct Scene {
  std::vector<Match> matches;
  std::vector<Correspondence> correspondences;
  PlanarEstimate estimate;

  Scene(int count, int wrong, double arc_rad, float ratio_of_wrong, double turned_rad = 0.0) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    const auto from_z = [](double angle_rad) { return Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()); };
    estimate.motion.direction_rad = turned_rad;
    estimate.lead = 50.0;
    estimate.median_parallax_rad = 0.2;
    for (int i = 0; i < count; ++i) {
      const double azimuth_rad = arc_rad * uniform(random);
      const Eigen::Vector3d at_m(3.0 * std::cos(azimuth_rad), 3.0 * std::sin(azimuth_rad), 2.0 * uniform(random));
      Correspondence c;
      c.current = from_z(turned_rad) * at_m.normalized();
      c.target = from_z(turned_rad) * (at_m - Eigen::Vector3d::UnitX()).normalized();
      if (i < wrong) {
        c.target = from_z(turned_rad) * Eigen::Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
      } else {
        estimate.inliers.push_back(i);
      }
      correspondences.push_back(c);
      matches.push_back({i, i, FeatureKind::kSift, i < wrong ? ratio_of_wrong : 0.6F});
    }
  }

  [[nodiscard]] ConfidenceSigns signs() const { return signs_of(estimate, matches, correspondences); }
};

constexpr double kCircle = 2.0 * std::numbers::pi;

TEST(Confidence, SeesAroundWhichShareOfTheCircleMatchesAgree) {
  EXPECT_GT(Scene(400, 0, kCircle, 0.6F).signs().around, 0.9);
  EXPECT_NEAR(Scene(400, 0, kCircle / 4.0, 0.6F).signs().around, 0.25, 0.08);
  EXPECT_LT(Scene(400, 0, kCircle / 100.0, 0.6F).signs().around, 0.07);
}

TEST(Confidence, MatchesOfOneSpotAreNearEachOtherAcrossTheSeamToo) {
  const double ahead = Scene(60, 0, 0.1, 0.6F, 0.0).signs().around;
  const double behind = Scene(60, 0, 0.1, 0.6F, std::numbers::pi).signs().around;
  EXPECT_NEAR(ahead, behind, 1e-9);
}

TEST(Confidence, TurningTheViewsChangesNothing) {
  const ConfidenceSigns level = Scene(120, 30, 3.0, 0.5F).signs();
  for (const double turned_rad : {0.1, 1.0, 2.5, -2.9}) {
    const ConfidenceSigns turned = Scene(120, 30, 3.0, 0.5F, turned_rad).signs();
    EXPECT_NEAR(turned.around, level.around, 1e-9);
    EXPECT_NEAR(turned.disagreeing, level.disagreeing, 1e-9);
    EXPECT_NEAR(confidence(turned), confidence(level), 1e-9);
  }
}

TEST(Confidence, ClearMatchesThatDisagreeCountAndAmbiguousOnesDoNot) {
  EXPECT_EQ(Scene(100, 0, kCircle, 0.6F).signs().disagreeing, 0.0);
  EXPECT_NEAR(Scene(100, 40, kCircle, 0.9F).signs().disagreeing, 0.0, 1e-5);
  const double half = Scene(100, 40, kCircle, 0.7F).signs().disagreeing;
  const double full = Scene(100, 40, kCircle, 0.4F).signs().disagreeing;
  EXPECT_GT(half, 10.0);
  EXPECT_NEAR(full, 2.0 * half, 1e-3);
  EXPECT_LE(full, 40.0);
}

TEST(Confidence, ColumnsThatDisagreeSayNothing) {
  Scene scene(100, 40, kCircle, 0.4F);
  for (Match& match : scene.matches) match.kind = FeatureKind::kColumn;
  EXPECT_EQ(scene.signs().disagreeing, 0.0);
}

TEST(Confidence, AgreementAllAroundIsTrustedAndTheSameNumberOnOneSideIsNot) {
  EXPECT_GT(confidence(Scene(150, 30, kCircle, 0.6F).signs()), 0.95);
  EXPECT_LT(confidence(Scene(150, 30, 0.5, 0.6F).signs()), 0.6);
}

TEST(Confidence, AFewMatchesOfOneSpotAreNotTrustedForWantOfOthers) {
  Scene scene(8, 0, 0.1, 0.6F);
  scene.estimate.lead = 5.0;
  EXPECT_LT(confidence(scene.signs()), 0.8);
}

TEST(Confidence, FallsWithWhatDisagrees) {
  double before = 1.0;
  for (const int wrong : {10, 30, 60}) {
    const double now = confidence(Scene(150, wrong, kCircle / 3.0, 0.5F).signs());
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST(Confidence, IsAProbabilityWhateverTheSigns) {
  for (const double lead : {-5.0, 0.0, 1e6}) {
    for (const double around : {0.0, 1.0}) {
      for (const double disagreeing : {0.0, 1e4}) {
        for (const double parallax_rad : {0.0, 3.0}) {
          const double p = confidence({lead, around, disagreeing, parallax_rad});
          EXPECT_GE(p, 0.0);
          EXPECT_LE(p, 1.0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace homeward::matching::confidence_test
