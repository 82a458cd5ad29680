// SPDX-License-Identifier: Apache-2.0
#include "matching/match_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "features/columns.hpp"
#include "geometry/planar_solver.hpp"

namespace homeward::matching::match_columns_test {
namespace {

features::FeatureSet empty_set(int count) {
  features::FeatureSet set;
  set.bearings.resize(count, 3);
  set.scales_rad.resize(count);
  set.descriptors.resize(count, features::kColumnCoefficients);
  set.colours.resize(count, 3);
  return set;
}

/// A vertical piece on the floor plan at (x, y) between two heights, seen from the origin; all else from `random`.
void place(features::FeatureSet& set, int i, const Eigen::Vector3d& bottom_m, double top_m) {
  const double distance_m = std::hypot(bottom_m.x(), bottom_m.y());
  const double azimuth_rad = std::atan2(bottom_m.y(), bottom_m.x());
  const double high_rad = std::atan2(top_m, distance_m);
  const double low_rad = std::atan2(bottom_m.z(), distance_m);
  const double middle_rad = 0.5 * (high_rad + low_rad);
  set.bearings.row(i) = Eigen::Vector3d(std::cos(middle_rad) * std::cos(azimuth_rad),
                                        std::cos(middle_rad) * std::sin(azimuth_rad), std::sin(middle_rad))
                            .cast<float>();
  set.scales_rad[i] = static_cast<float>(high_rad - low_rad);
}

/// The same pieces seen from the origin and from 0.7 m ahead, with looks that differ a little.
struct TwoViews {
  features::FeatureSet here;
  features::FeatureSet there;

  explicit TwoViews(int count, int noise = 2, unsigned seed = 1) : here(empty_set(count)), there(empty_set(count)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::uniform_int_distribution<int> look(30, 220);
    std::uniform_int_distribution<int> wobble(-noise, noise);
    for (int i = 0; i < count; ++i) {
      const double azimuth_rad = 6.28 * uniform(random);
      const double distance_m = 1.5 + 3.0 * uniform(random);
      const double bottom_m = -1.0 + 0.7 * uniform(random);
      const double top_m = bottom_m + 0.3 + 0.8 * uniform(random);
      const Eigen::Vector3d at_m(distance_m * std::cos(azimuth_rad), distance_m * std::sin(azimuth_rad), bottom_m);
      place(here, i, at_m, top_m);
      place(there, i, at_m - Eigen::Vector3d(0.7, 0.0, 0.0), top_m);
      for (int k = 0; k < features::kColumnCoefficients; ++k) {
        const int value = look(random);
        here.descriptors(i, k) = static_cast<std::uint8_t>(value);
        there.descriptors(i, k) = static_cast<std::uint8_t>(value + wobble(random));
      }
      for (int k = 0; k < 3; ++k) {
        const int value = look(random) / 2;
        here.colours(i, k) = static_cast<std::int8_t>(value);
        there.colours(i, k) = static_cast<std::int8_t>(value + wobble(random));
      }
    }
  }
};

TEST(MatchColumns, FindsTheSamePieces) {
  const TwoViews views(120);
  const auto matches = match_columns(views.here, views.there, {});
  EXPECT_GE(matches.size(), 110U);
  for (const Match& match : matches) EXPECT_EQ(match.current, match.target);
}

TEST(MatchColumns, SwappedPicturesSwapTheMatches) {
  const TwoViews views(150, 25);
  auto forward = match_columns(views.here, views.there, {});
  auto backward = match_columns(views.there, views.here, {});
  ASSERT_FALSE(forward.empty());
  ASSERT_EQ(forward.size(), backward.size());
  std::ranges::sort(backward, {}, &Match::target);
  for (std::size_t i = 0; i < forward.size(); ++i) {
    EXPECT_EQ(forward[i].current, backward[i].target);
    EXPECT_EQ(forward[i].target, backward[i].current);
    EXPECT_NEAR(forward[i].ratio, backward[i].ratio, 1e-5);
    EXPECT_LT(forward[i].ratio, ColumnMatchConfig{}.ratio);
  }
}

TEST(MatchColumns, TwoThatAreEquallyGoodAreNoMatch) {
  TwoViews views(40);
  for (features::FeatureSet* set : {&views.here, &views.there}) {
    set->descriptors.row(1) = set->descriptors.row(0);
    set->colours.row(1) = set->colours.row(0);
    set->bearings.row(1) = set->bearings.row(0);
    set->scales_rad[1] = set->scales_rad[0];
  }
  for (const Match& match : match_columns(views.here, views.there, {})) EXPECT_GT(match.current, 1);
}

TEST(MatchColumns, ADifferentProportionOfHeightsIsNoMatch) {
  TwoViews views(30);
  ColumnMatchConfig config;
  const auto has_first = [&] {
    const auto matches = match_columns(views.here, views.there, config);
    return !matches.empty() && matches.front().current == 0;
  };
  place(views.here, 0, {2.0, 0.0, -0.8}, -0.2);
  place(views.there, 0, {1.3, 0.0, -0.8}, -0.2);
  EXPECT_TRUE(has_first());
  place(views.there, 0, {1.3, 0.0, 0.1}, 0.5);  // above the horizon now: no motion on a floor does that
  EXPECT_FALSE(has_first());
  place(views.there, 0, {1.3, 0.0, -0.8}, -0.5);
  EXPECT_FALSE(has_first());
  config.max_height_error_rad = 10.0;
  EXPECT_TRUE(has_first());
}

TEST(MatchColumns, ADifferentColourIsNoMatch) {
  TwoViews views(1, 0);
  views.here.colours.row(0) << 100, 100, 100;
  views.there.colours.row(0) << 100, 100, 100;
  ColumnMatchConfig config;
  config.max_distance = 1e3;  // the colour check alone
  EXPECT_EQ(match_columns(views.here, views.there, config).size(), 1U);
  views.there.colours.row(0) << 100, -1, 100;
  EXPECT_EQ(match_columns(views.here, views.there, config).size(), 0U);
}

TEST(MatchColumns, NothingAgainstSomethingIsNothing) {
  const TwoViews views(10);
  EXPECT_TRUE(match_columns(empty_set(0), views.there, {}).empty());
  EXPECT_TRUE(match_columns(views.here, empty_set(0), {}).empty());
  EXPECT_TRUE(match_columns(views.here, features::FeatureSet{}, {}).empty());
  const TwoViews one(1, 0);
  EXPECT_EQ(match_columns(one.here, one.there, {}).size(), 1U);
}

TEST(MatchColumns, TheCorrespondenceOfAMatchFitsTheMotion) {
  const TwoViews views(100);
  const geometry::PlanarMotion ahead{0.0, 0.0};
  const auto matches = match_columns(views.here, views.there, {});
  ASSERT_GE(matches.size(), 80U);
  for (const Match& match : matches) {
    const ColumnBearings seen = bearings_of(views.here, views.there, match);
    EXPECT_NEAR(geometry::epipolar_error_rad(ahead, {seen.current, seen.target}), 0.0, 1e-5);
  }
}

}  // namespace
}  // namespace homeward::matching::match_columns_test
