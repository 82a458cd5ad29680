// SPDX-License-Identifier: Apache-2.0
#include "repeat/landmark_follower.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "repeat/key_view.hpp"
#include "support/short_path.hpp"

namespace homeward::repeat::landmark_follower_test {
namespace {

const testing::ShortPath& short_path() {
  static const testing::ShortPath path(testing::bend(10));
  return path;
}

class Following : public ::testing::Test {
 protected:
  Following() {
    for (const KeyPose& key : around.keys) {
      references.push_back(std::make_shared<const KeyReferences>(
          KeyReferences::make(*taught.path, key.key, *taught.pictures[at(key.key)], *taught.camera, config.tracker)
              .value()));
    }
    follower.renew(around, {}, references);
  }
  [[nodiscard]] tracking::ImagePyramid picture(const Pose2& pose) const {
    return testing::pyramid_at({}, pose, *taught.camera);
  }
  static Eigen::Vector2d same(const Eigen::Vector2d& pixel_px) { return pixel_px; }

  const testing::ShortPath& taught = short_path();
  RepeatConfig config;
  ArcSurroundings around = surroundings_of(*taught.path, 0, 1, 5);
  LandmarkFollower::References references;
  LandmarkFollower follower{taught.camera};
};

TEST_F(Following, FindsLandmarksWhereTheyArePredictedAndFollowsThem) {
  EXPECT_EQ(follower.tracked(), 0);
  const int expected = follower.expected({}, config.least_visible);
  EXPECT_GT(follower.search(picture(taught.poses[0]), {}, config.most_from_predicted_rad, config), 0.9 * expected);
  const int before = follower.tracked();
  follower.follow(picture(taught.poses[1]), {}, same, config);
  EXPECT_GT(follower.tracked(), 0.8 * before);
  EXPECT_EQ(follower.tracked_ones().size(), static_cast<std::size_t>(follower.tracked()));
  // Where they were before they are again, to a fraction of a pixel.
  follower.follow(picture(taught.poses[0]), {}, same, config);
  for (const std::size_t i : follower.tracked_ones()) {
    const geometry::SeenPoint* in_key = follower.in_key(i, 0);
    if (in_key == nullptr) continue;
    const auto pixel_px = taught.camera->pixel(in_key->bearing);
    ASSERT_TRUE(pixel_px);
    EXPECT_LT((*pixel_px - follower.landmarks()[i].pixel_px).norm(), 0.5);
  }
  follower.lose_all();
  EXPECT_EQ(follower.tracked(), 0);
}

TEST_F(Following, ByLittleLightExpectsOnlyWhatStillShowsEnough) {
  Image dim = testing::lens_picture({}, taught.poses[0], *taught.camera);
  for (std::uint8_t& grey : dim.data) grey = static_cast<std::uint8_t>(std::lround(0.25 * grey));
  follower.search(picture(taught.poses[0]), {}, config.most_from_predicted_rad, config);
  const int by_day = follower.expected({}, config.least_visible);
  EXPECT_EQ(by_day, follower.expected({}, 1e9)) << "by day all are expected";
  follower.lose_all();
  follower.search(tracking::ImagePyramid::build(dim).value(), {}, config.most_from_predicted_rad, config);
  ASSERT_GE(follower.tracked(), 8);
  EXPECT_EQ(follower.expected({}, 0.0), by_day);
  const int most = follower.expected({}, 1.0);
  const int fewer = follower.expected({}, 20.0);
  EXPECT_LE(most, by_day);
  EXPECT_LT(fewer, most);
  EXPECT_EQ(follower.expected({}, 1e9), 0);
}

TEST_F(Following, TakesNothingThatIsFarFromItsPrediction) {
  Pose2 turned = taught.poses[0];
  turned.theta_rad += 0.1;  // 17 px
  const int wide = follower.search(picture(turned), {}, 0.2, config);
  follower.lose_all();
  EXPECT_LT(follower.search(picture(turned), {}, 0.02, config), 0.2 * wide);
}

TEST_F(Following, OtherSurroundingsTakeOverWhatBothHave) {
  follower.search(picture(taught.pose_of(1)), {around.key(1).local_from_key, around.key(1).position},
                  config.most_from_predicted_rad, config);
  const LandmarkFollower before = follower;
  const ArcSurroundings alone = surroundings_of(*taught.path, 0, 0, 5);
  follower.renew(alone, {}, {references[0], references[1]});
  EXPECT_LE(follower.landmarks().size(), before.landmarks().size());
  EXPECT_GT(follower.tracked(), 0.8 * std::min<double>(before.tracked(), static_cast<double>(alone.landmarks.size())));
  for (const FollowedLandmark& one : follower.landmarks()) {
    const auto known = std::ranges::find(before.landmarks(), one.landmark.feature,
                                         [](const FollowedLandmark& other) { return other.landmark.feature; });
    ASSERT_NE(known, before.landmarks().end());
    if (one.is_tracked) {
      EXPECT_EQ(one.pixel_px, known->pixel_px);
    }
  }
}

TEST_F(Following, AViewOfAKeyImageTellsThePoseByThePicturesAndItsLengthByTheLandmarks) {
  const Pose2& from = taught.pose_of(0);  // heading along x
  ASSERT_EQ(from.theta_rad, 0.0);
  const Pose2 here{from.x_m + 0.2, from.y_m + 0.2, 0.0};
  const double arc_m = std::hypot(taught.pose_of(1).x_m - from.x_m, taught.pose_of(1).y_m - from.y_m);
  const Eigen::Vector3d truth(0.2 / arc_m, 0.2 / arc_m, 0.0);
  follower.search(picture(here), {Eigen::Matrix3d::Identity(), truth}, 0.2, config);
  const auto view = view_of_key(follower, around, 0, config.geometry, 1);
  ASSERT_TRUE(view);
  EXPECT_TRUE(view->has_baseline);
  EXPECT_TRUE(view->has_length);
  EXPECT_GE(view->agreeing, 20);
  EXPECT_LT((view->pose.position - truth).norm(), 0.15 * truth.norm());
  EXPECT_FALSE(view_of_key(follower, around, 1000, config.geometry, 1));
  follower.lose_all();
  EXPECT_FALSE(view_of_key(follower, around, 0, config.geometry, 1));
}

TEST_F(Following, ReferencesAreOfFeaturesThatAnArcHas) {
  const KeyReferences& first = *references[0];
  EXPECT_EQ(first.key(), 0);
  EXPECT_GT(first.tracker().size(), 30U);
  EXPECT_LE(first.tracker().size(), taught.path->arcs[0].matches.size());
  EXPECT_TRUE(first.reference_of(taught.path->arcs[0].matches.front().feature));
  EXPECT_FALSE(first.reference_of(1'000'000));
}

}  // namespace
}  // namespace homeward::repeat::landmark_follower_test
