// SPDX-License-Identifier: Apache-2.0
#include "matching/visual_distance.hpp"

#include <gtest/gtest.h>

#include "features/extract.hpp"
#include "support/painted_room.hpp"
#include "support/planar_scene.hpp"
#include "support/sample_map.hpp"

namespace homeward::matching::visual_distance_test {
namespace {

using homeward::testing::painted_panorama;
using homeward::testing::PaintedRoom;

/// Two appearances of random points, of which the first `common` are seen by both views.
struct TwoViews {
  features::Appearance a;
  features::Appearance b;
};

TwoViews two_views(int common, int only_in_a, int only_in_b, const Pose2& a_from_b, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto points = homeward::testing::room_points(common, random);
  TwoViews views{homeward::testing::random_appearance(common + only_in_a, static_cast<unsigned>(seed)),
                 homeward::testing::random_appearance(common + only_in_b, static_cast<unsigned>(seed) + 1000)};
  for (int i = 0; i < common; ++i) {
    const auto& point = points[static_cast<std::size_t>(i)];
    views.a.sift.bearings.row(i) = homeward::testing::bearing_from({}, point).cast<float>().transpose();
    views.b.sift.bearings.row(i) = homeward::testing::bearing_from(a_from_b, point).cast<float>().transpose();
    views.b.sift.descriptors.row(i) = views.a.sift.descriptors.row(i);
    views.b.sift.colours.row(i) = views.a.sift.colours.row(i);
  }
  return views;
}

TEST(Verify, FindsTheMotionAndItsInliers) {
  const Pose2 a_from_b{0.6, 0.3, 0.7};
  const TwoViews views = two_views(60, 30, 10, a_from_b, 4);
  const auto verified = verify(views.a, views.b, {}, 1);
  ASSERT_TRUE(verified) << verified.error().message;
  EXPECT_EQ(verified->matches.size(), 60U);
  EXPECT_EQ(verified->pose.correspondences, 60);
  EXPECT_GE(verified->pose.inliers.size(), 59U);
  EXPECT_NEAR(verified->pose.motion.direction_rad, std::atan2(0.3, 0.6), 0.01);
  EXPECT_NEAR(verified->pose.motion.turn_rad, 0.7, 0.005);
  EXPECT_GT(verified->pose.confidence, 0.9);
  EXPECT_LE(verified->pose.confidence, 1.0);
}

TEST(Verify, PicturesOfDifferentRoomsAreNotConfirmed) {
  PaintedRoom here;
  PaintedRoom elsewhere;
  elsewhere.seed = 2;
  const auto a = features::extract(painted_panorama(here, {0.2, 0.1, 0.4}), {});
  const auto b = features::extract(painted_panorama(elsewhere, {0.2, 0.1, 0.4}), {});
  ASSERT_GT(a.size(), 100);
  VerifyConfig strict;
  strict.min_inliers = 12;
  const auto verified = verify(a, b, strict, 1);
  ASSERT_FALSE(verified);
  EXPECT_EQ(verified.error().code, ErrorCode::kTooLittleSupport);
}

TEST(Verify, RandomFeaturesAreNotConfirmed) {
  const auto verified =
      verify(homeward::testing::random_appearance(200, 1), homeward::testing::random_appearance(200, 2), {}, 1);
  ASSERT_FALSE(verified);
  EXPECT_EQ(verified.error().code, ErrorCode::kTooLittleSupport);
}

TEST(Verify, APictureWithoutTextureIsNamedAsSuch) {
  const auto rich = homeward::testing::random_appearance(50, 1);
  const auto poor = homeward::testing::random_appearance(7, 2);
  for (const auto& verified : {verify(rich, poor, {}, 1), verify(poor, rich, {}, 1)}) {
    ASSERT_FALSE(verified);
    EXPECT_EQ(verified.error().code, ErrorCode::kTooFewFeatures);
    EXPECT_NE(verified.error().message.find('7'), std::string::npos);
  }
}

TEST(VisualDistance, IsTheFormulaOfThePaper) {
  const Pose2 a_from_b{0.5, -0.2, -1.1};
  const TwoViews views = two_views(40, 25, 15, a_from_b, 6);
  const PairComparison pair = compare(views.a, views.b, {}, 1);
  ASSERT_TRUE(pair.pose);
  ASSERT_EQ(pair.matches, 40);
  ASSERT_EQ(pair.verified, static_cast<int>(pair.pose->inliers.size()));
  // All azimuth differences, and their common turn by brute force over the differences themselves.
  std::vector<double> turns_rad;
  for (const int i : pair.pose->inliers) {  // match i joins feature i to feature i
    const auto azimuth_rad = [i](const features::Appearance& seen) { return features::azimuth_rad(seen.sift, i); };
    turns_rad.push_back(azimuth_rad(views.b) - azimuth_rad(views.a));
  }
  double least_rad = 1e9;
  for (const double turn_rad : turns_rad) {
    double sum_rad = 0.0;
    for (const double other_rad : turns_rad) sum_rad += std::abs(wrap_angle(other_rad - turn_rad));
    least_rad = std::min(least_rad, sum_rad);
  }
  const double n = pair.verified;
  const double expected = (1.0 / n) * ((65.0 + 55.0) / 2.0) * (least_rad / n);
  EXPECT_GT(expected, 0.05);
  EXPECT_NEAR(pair.distance, expected, 1e-9);
}

TEST(VisualDistance, IsInfiniteBelowEightMatches) {
  const Pose2 a_from_b{0.5, 0.0, 0.2};
  const PairComparison seven = compare(two_views(7, 20, 20, a_from_b, 3).a, two_views(7, 20, 20, a_from_b, 3).b, {}, 1);
  EXPECT_TRUE(std::isinf(seven.distance));
  const TwoViews views = two_views(8, 20, 20, a_from_b, 3);
  const PairComparison eight = compare(views.a, views.b, {}, 1);
  EXPECT_TRUE(std::isfinite(eight.distance));
  EXPECT_EQ(eight.verified, 8);
  EXPECT_TRUE(std::isinf(compare({}, {}, {}, 1).distance));
}

TEST(VisualDistance, OfAPictureToItselfIsZero) {
  const auto a = features::extract(painted_panorama({}, {0.2, 0.1, 0.4}), {});
  const PairComparison pair = compare(a, a, {}, 1);
  EXPECT_LT(pair.distance, 1e-6);
  EXPECT_GT(pair.verified, 250);
}

TEST(VisualDistance, GrowsWithTheWayAndHardlyWithATurn) {
  const PaintedRoom room;
  const auto at = [&](double x_m, double theta_rad) {
    return features::extract(painted_panorama(room, {x_m, 0.4, theta_rad}), {});
  };
  const auto start = at(-0.8, 0.0);
  const double near = compare(start, at(-0.6, 0.0), {}, 1).distance;
  const double far = compare(start, at(0.2, 0.0), {}, 1).distance;
  const double turned = compare(start, at(-0.8, 1.3), {}, 1).distance;
  EXPECT_LT(turned, near);
  EXPECT_LT(2.0 * near, far);
}

TEST(VisualDistance, IsNearlySymmetricAndTheSameForTheSameSeed) {
  const auto a = features::extract(painted_panorama({}, {0.2, 0.1, 0.4}), {});
  const auto b = features::extract(painted_panorama({}, {0.6, 0.3, -0.4}), {});
  const PairComparison forth = compare(a, b, {}, 1);
  const PairComparison back = compare(b, a, {}, 1);
  EXPECT_NEAR(forth.distance, back.distance, 0.35 * forth.distance);
  EXPECT_EQ(compare(a, b, {}, 1).distance, forth.distance);
}

}  // namespace
}  // namespace homeward::matching::visual_distance_test
