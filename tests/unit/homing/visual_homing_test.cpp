// SPDX-License-Identifier: Apache-2.0
#include "homing/visual_homing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "features/extract.hpp"
#include "support/painted_room.hpp"

namespace homeward::homing::visual_homing_test {
namespace {

struct Seen {
  features::Appearance appearance;
  tracking::TrackingFrame frame;
};

Seen see(const Pose2& pose, double covered_share = 0.0) {
  camera::Panorama panorama = testing::painted_panorama({}, pose);
  for (int v = 0; v < panorama.rgb.height_px; ++v) {
    const int columns = static_cast<int>(covered_share * panorama.rgb.width_px);
    std::fill_n(panorama.rgb.at(0, v), columns * 3, std::uint8_t{12});
  }
  return {features::extract(panorama, {}), tracking::TrackingFrame(panorama)};
}

double off_m(const TargetSeen& seen, const Pose2& robot, const Pose2& target) {
  const Pose2 truth = inverse(robot) * target;
  return (*seen.target_m - Eigen::Vector2d(truth.x_m, truth.y_m)).norm();
}

/// Towards the target in steps, one picture each; the room's origin is odometry's.
struct Way {
  Pose2 target{1.2, 0.4, 0.7};
  Pose2 start{-1.2, -0.3, 0.2};
  Seen home = see(target);
  VisualHoming homing;

  [[nodiscard]] Pose2 at(double share) const {
    return {start.x_m + share * (target.x_m - start.x_m), start.y_m + share * (target.y_m - start.y_m),
            start.theta_rad};
  }
  Result<TargetSeen> recognise(const Pose2& pose) {
    const Seen now = see(pose);
    return homing.update(now.appearance, home.appearance, pose, std::nullopt, now.frame, 1);
  }
  Result<TargetSeen> track(const Pose2& pose, double covered_share = 0.0) {
    return homing.track(see(pose, covered_share).frame, pose, 1);
  }
};

TEST(VisualHoming, MeasuresTheWayHomeByOdometry) {
  Way way;
  EXPECT_TRUE(way.homing.wants_features());
  const auto first = way.recognise(way.at(0.0));
  ASSERT_TRUE(first) << first.error().message;
  ASSERT_TRUE(first->target_m);
  EXPECT_TRUE(first->began);
  EXPECT_FALSE(way.homing.wants_features());
  for (int i = 1; i <= 12; ++i) {
    const Pose2 pose = way.at(i / 13.0);
    const auto seen = i % 3 == 0 ? way.recognise(pose) : way.track(pose);
    ASSERT_TRUE(seen) << i << ": " << seen.error().message;
    ASSERT_TRUE(seen->target_m);
    EXPECT_LT(off_m(*seen, pose, way.target), i >= 6 ? 0.12 : 1.5) << i;
    if (i == 12) {
      EXPECT_LT(off_m(*seen, pose, way.target), 0.015);
      EXPECT_LT(std::abs(wrap_angle(seen->vector.turn_rad - (way.target.theta_rad - pose.theta_rad))), 0.01);
      EXPECT_LT(seen->vector.nearness.value_or(1.0), 0.3);
      EXPECT_GT(seen->vector.confidence, 0.9);
    }
  }
}

/// Drives the way with some setting; how far off the target is thought to be at its end, and of how many features.
std::pair<double, int> end_of_way(const VisualHomingConfig& config) {
  Way way;
  way.homing = VisualHoming(config);
  double end_m = 1e9;
  int known = 0;
  for (int i = 0; i <= 12; ++i) {
    const Pose2 pose = way.at(i / 13.0);
    const auto seen = i % 3 == 0 ? way.recognise(pose) : way.track(pose);
    EXPECT_TRUE(seen) << i << ": " << (seen ? "" : seen.error().message);
    if (!seen || !seen->target_m) continue;
    end_m = off_m(*seen, pose, way.target);
    known = seen->known;
  }
  return {end_m, known};
}

TEST(VisualHoming, TracksFeaturesByCornersBesideThem) {
  VisualHomingConfig config;
  config.tracks.neighbour_px = 5;
  EXPECT_LT(end_of_way(config).first, 0.05);
}

TEST(VisualHoming, TakesColumnSegmentsIntoItsMapWhereAskedTo) {
  VisualHomingConfig config;
  const auto without = end_of_way(config);
  config.columns = true;
  const auto with = end_of_way(config);
  EXPECT_GT(with.second, without.second);
  EXPECT_LT(with.first, 0.05);
}

TEST(VisualHoming, TracksBetweenRecognitionsAndSaysWhenItShouldRecognise) {
  Way way;
  ASSERT_TRUE(way.recognise(way.at(0.1)));
  const auto tracked = way.track(way.at(0.12));
  ASSERT_TRUE(tracked) << tracked.error().message;
  EXPECT_GE(tracked->tracks.tracked, 12);
  EXPECT_EQ(tracked->vector.inliers, tracked->tracks.tracked);
  EXPECT_FALSE(way.homing.wants_features());
  ASSERT_TRUE(way.track(way.at(0.14)));
  EXPECT_TRUE(way.homing.wants_features());
}

TEST(VisualHoming, FeaturesBehindACoverAreLostAndTakenUpAgain) {
  Way way;
  ASSERT_TRUE(way.recognise(way.at(0.6)));
  const auto before = way.track(way.at(0.61));
  ASSERT_TRUE(before);
  const auto covered = way.track(way.at(0.62), 0.33);
  ASSERT_TRUE(covered) << covered.error().message;
  EXPECT_LT(covered->tracks.tracked, before->tracks.tracked);
  EXPECT_GT(covered->tracks.lost, before->tracks.lost);
  EXPECT_LT(std::abs(wrap_angle(covered->vector.bearing_rad - before->vector.bearing_rad)), 0.1);
  const auto after = way.track(way.at(0.63));
  ASSERT_TRUE(after);
  EXPECT_GT(after->tracks.recovered, 5);
  EXPECT_GT(after->tracks.tracked, covered->tracks.tracked);
}

TEST(VisualHoming, ABlackPictureIsNoAnswerAndTheNextOneIs) {
  Way way;
  ASSERT_TRUE(way.recognise(way.at(0.3)));
  EXPECT_FALSE(way.track(way.at(0.32), 1.0));
  EXPECT_TRUE(way.homing.wants_features());
  const auto again = way.recognise(way.at(0.34));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_FALSE(again->began);
}

TEST(VisualHoming, NothingIsTrackedBeforeTheTargetWasSeen) {
  Way way;
  const auto tracked = way.track(way.at(0.0));
  ASSERT_FALSE(tracked);
  EXPECT_EQ(tracked.error().code, ErrorCode::kTooLittleSupport);
  EXPECT_TRUE(way.homing.wants_features());
}

TEST(VisualHoming, AnotherRoomIsNoWayHome) {
  Way way;
  testing::PaintedRoom elsewhere;
  elsewhere.seed = 9;
  const camera::Panorama panorama = testing::painted_panorama(elsewhere, {});
  const auto seen = way.homing.update(features::extract(panorama, {}), way.home.appearance, Pose2{}, std::nullopt,
                                      tracking::TrackingFrame(panorama), 1);
  EXPECT_FALSE(seen);
}

TEST(VisualHoming, CarriedElsewhereItBeginsAnew) {
  Way way;
  ASSERT_TRUE(way.recognise(way.at(0.2)));
  ASSERT_TRUE(way.recognise(way.at(0.3)));
  // Odometry goes on as if nothing had happened.
  const Pose2 carried{1.5, -1.6, -2.0};
  const Seen now = see(carried);
  bool right = false;
  for (int i = 0; i < 6 && !right; ++i) {
    const auto seen = way.homing.update(now.appearance, way.home.appearance, way.at(0.3), std::nullopt, now.frame, 1);
    if (!seen) continue;
    const Pose2 truth = inverse(carried) * way.target;
    right = std::abs(wrap_angle(seen->vector.bearing_rad - std::atan2(truth.y_m, truth.x_m))) < 0.2;
  }
  EXPECT_TRUE(right);
}

TEST(VisualHoming, CopiesGoTheirOwnWays) {
  Way way;
  ASSERT_TRUE(way.recognise(way.at(0.2)));
  VisualHoming copy = way.homing;
  const Seen now = see(way.at(0.25));
  const auto a = way.homing.track(now.frame, way.at(0.25), 1);
  const auto b = copy.track(now.frame, way.at(0.25), 1);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->vector.bearing_rad, b->vector.bearing_rad);
  EXPECT_EQ(a->target_m->x(), b->target_m->x());
}

}  // namespace
}  // namespace homeward::homing::visual_homing_test
