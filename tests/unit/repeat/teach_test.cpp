// SPDX-License-Identifier: Apache-2.0
#include "repeat/teach.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/angles.hpp"
#include "core/index.hpp"
#include "support/taught_room.hpp"

namespace homeward::repeat::teach_test {
namespace {

using testing::bend;
using testing::PaintedRoom;

/// A picture that is shown: from a pose in a room, or a plain one where there is no room.
struct Shown {
  Pose2 pose;
  std::optional<PaintedRoom> room = PaintedRoom{};
};

std::vector<Shown> all_in(const PaintedRoom& room, const std::vector<Pose2>& poses) {
  std::vector<Shown> shown;
  for (const Pose2& pose : poses) shown.push_back({pose, room});
  return shown;
}

class Teaching : public ::testing::Test {
 protected:
  Teaching() { config.most_features = 120; }  // the room has texture everywhere
  [[nodiscard]] tracking::ImagePyramid picture(const Shown& shown) const {
    if (shown.room) return testing::pyramid_at(*shown.room, shown.pose, *camera);
    Image plain(camera->config().width_px, camera->config().height_px, 1);
    std::fill(plain.data.begin(), plain.data.end(), std::uint8_t{90});
    return tracking::ImagePyramid::build(plain).value();
  }
  [[nodiscard]] Teacher teacher() const { return Teacher::create(config, camera).value(); }
  [[nodiscard]] Teacher shown(const std::vector<Shown>& pictures) const {
    Teacher teaching = teacher();
    for (const Shown& one : pictures) EXPECT_TRUE(teaching.add(picture(one)));
    return teaching;
  }
  static void expect_sound(const TaughtPath& path) {
    for (const Arc& arc : path.arcs) {
      ASSERT_LT(at(arc.from) + 1, path.key_images.size());
      EXPECT_LT(path.key_images[at(arc.from)].picture, path.key_images[at(arc.from) + 1].picture);
      EXPECT_FALSE(arc.matches.empty());
    }
  }

  std::shared_ptr<const camera::Camera> camera = camera::Camera::create(testing::small_lens_camera()).value();
  TeachConfig config;
};

double turn_off_deg(const Arc& arc, const Pose2& from, const Pose2& to) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(to.theta_rad - from.theta_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return degrees(Eigen::AngleAxisd(Eigen::Matrix3d(turn.transpose() * arc.motion.current_from_target)).angle());
}

double direction_off_deg(const Arc& arc, const Pose2& from, const Pose2& to) {
  const Eigen::Vector3d moved(to.x_m - from.x_m, to.y_m - from.y_m, 0.0);
  const Eigen::Vector3d truth = Eigen::AngleAxisd(-from.theta_rad, Eigen::Vector3d::UnitZ()) * moved.normalized();
  return degrees(std::atan2(truth.cross(arc.motion.target_in_current).norm(), truth.dot(arc.motion.target_in_current)));
}

TEST_F(Teaching, ABendBecomesArcsWithTheirTurnsDirectionsPointsAndScales) {
  const PaintedRoom room;
  const auto poses = bend(40);
  config.least_features = 80;
  const auto path = shown(all_in(room, poses)).path();
  ASSERT_TRUE(path);
  expect_sound(*path);
  EXPECT_TRUE(path->cuts.empty());
  EXPECT_TRUE(path->skipped_pictures.empty());
  ASSERT_GE(path->arcs.size(), 3U);
  EXPECT_LE(path->arcs.size(), 20U);
  EXPECT_EQ(path->arcs.size() + 1, path->key_images.size());
  EXPECT_EQ(path->key_images.front().picture, 0);
  EXPECT_EQ(path->key_images.back().picture, 39);
  double before_m = 0.0;
  for (const Arc& arc : path->arcs) {
    const KeyImage& node = path->key_images[at(arc.from)];
    const Pose2& from = poses[at(node.picture)];
    const Pose2& to = poses[at(path->key_images[at(arc.from) + 1].picture)];
    const double way_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    ASSERT_TRUE(arc.has_baseline);
    EXPECT_LT(turn_off_deg(arc, from, to), 0.6);
    EXPECT_LT(direction_off_deg(arc, from, to), 2.5);
    EXPECT_LT(arc.error_px, 0.5);
    EXPECT_GE(static_cast<int>(arc.matches.size()), config.fewest_features);
    // Points lie on walls, floor and ceiling; the median of how far they are is what the room says.
    std::vector<double> off;
    for (const ArcMatch& match : arc.matches) {
      if (!(match.from_nearness > 0.0)) continue;
      const Eigen::Vector3d point = testing::in_world(from, way_m * match.from_bearing / match.from_nearness);
      const std::array<double, 4> walls = {room.half_length_m - std::abs(point.x() + from.x_m),
                                           room.half_width_m - std::abs(point.y() + from.y_m),
                                           room.ceiling_m - point.z(), point.z() - room.floor_m};
      off.push_back(std::abs(*std::ranges::min_element(walls, {}, [](double d) { return std::abs(d); })));
    }
    std::ranges::nth_element(off, off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2));
    EXPECT_LT(off[off.size() / 2], 0.15);
    if (arc.from > 0) {
      ASSERT_TRUE(node.scale);
      EXPECT_NEAR(node.scale->ratio, way_m / before_m, 0.06 * way_m / before_m);
      EXPECT_GE(node.common, config.fewest_scaled);
    } else {
      EXPECT_FALSE(node.scale);
    }
    before_m = way_m;
  }
  EXPECT_EQ(path->arcs.back().ended_by, ArcEnd::kPathEnd);
}

TEST_F(Teaching, ATurnOnTheSpotIsAnArcWithoutPoints) {
  std::vector<Pose2> poses;
  for (int i = 0; i < 10; ++i) poses.push_back({-1.0, 0.2, 0.08 * i});
  const auto path = shown(all_in({}, poses)).path();
  ASSERT_TRUE(path);
  expect_sound(*path);
  EXPECT_TRUE(path->cuts.empty());
  for (const Arc& arc : path->arcs) {
    EXPECT_FALSE(arc.has_baseline);
    EXPECT_LT(turn_off_deg(arc, poses[at(path->key_images[at(arc.from)].picture)],
                           poses[at(path->key_images[at(arc.from) + 1].picture)]),
              0.2);
    for (const ArcMatch& match : arc.matches) EXPECT_EQ(match.from_nearness, 0.0);
  }
  for (const KeyImage& key : path->key_images) EXPECT_FALSE(key.scale);
}

TEST_F(Teaching, StandingStillMakesNoKeyImages) {
  const auto path = shown(all_in({}, std::vector<Pose2>(8, Pose2{-1.0, 0.2, 0.3}))).path();
  ASSERT_TRUE(path);
  ASSERT_EQ(path->arcs.size(), 1U);
  EXPECT_FALSE(path->arcs.front().has_baseline);
  EXPECT_EQ(path->key_images.back().picture, 7);
}

TEST_F(Teaching, AQuickTurnIsFollowed) {
  std::vector<Pose2> poses = bend(6);
  Pose2 turned = poses.back();
  for (int i = 0; i < 5; ++i) {
    turned.theta_rad += 0.1 + 0.08 * i;  // at last by 24 degrees of 70
    poses.push_back(turned);
  }
  const auto path = shown(all_in({}, poses)).path();
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->cuts.empty());
  EXPECT_TRUE(path->skipped_pictures.empty());
  EXPECT_EQ(path->key_images.back().picture, 10);
  for (const Arc& arc : path->arcs) {
    EXPECT_LT(turn_off_deg(arc, poses[at(path->key_images[at(arc.from)].picture)],
                           poses[at(path->key_images[at(arc.from) + 1].picture)]),
              0.5);
  }
}

TEST_F(Teaching, AnotherPlaceCutsThePathAndIsNeverJoined) {
  auto pictures = all_in({}, bend(8));
  for (const Shown& other : all_in({.seed = 5}, bend(8))) pictures.push_back(other);
  const auto path = shown(pictures).path();
  ASSERT_TRUE(path);
  expect_sound(*path);
  EXPECT_TRUE(path->bridges.empty());
  ASSERT_EQ(path->cuts.size(), 1U);
  EXPECT_EQ(path->cuts.front().last_picture, 7);
  EXPECT_EQ(path->cuts.front().next_picture, 8);
  EXPECT_EQ(path->cuts.front().why, CutReason::kTooFewFeatures);
  for (const Arc& arc : path->arcs) {
    EXPECT_EQ(path->key_images[at(arc.from)].picture < 8, path->key_images[at(arc.from) + 1].picture < 8);
  }
  EXPECT_EQ(path->key_images.back().picture, 15);
  const auto begins = std::ranges::find(path->key_images, 8, &KeyImage::picture);
  ASSERT_NE(begins, path->key_images.end());
  EXPECT_FALSE(begins->scale);
  EXPECT_EQ(begins->common, 0);
}

TEST_F(Teaching, APictureOfAnotherPlaceIsPassedOver) {
  auto pictures = all_in({}, bend(12));
  pictures[5].room = PaintedRoom{.seed = 5};
  const auto path = shown(pictures).path();
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->cuts.empty());
  EXPECT_EQ(path->skipped_pictures, std::vector<int>{5});
  EXPECT_EQ(path->key_images.back().picture, 11);
  for (const KeyImage& key : path->key_images) EXPECT_NE(key.picture, 5);
}

TEST_F(Teaching, AGapIsBridgedByMatchingAndTheArcGoesOnBehindIt) {
  const auto poses = bend(20, 0.06);
  auto pictures = all_in({}, poses);
  for (std::size_t i = 6; i < 14; ++i) pictures[i].room.reset();  // the lens is covered
  const auto path = shown(pictures).path();
  ASSERT_TRUE(path);
  expect_sound(*path);
  EXPECT_TRUE(path->cuts.empty());
  ASSERT_EQ(path->bridges.size(), 1U);
  EXPECT_EQ(path->bridges.front().last_picture, 5);
  EXPECT_EQ(path->bridges.front().next_picture, 14);
  EXPECT_GE(path->bridges.front().matched, 15);
  EXPECT_EQ(path->skipped_pictures, (std::vector<int>{6, 7, 8, 9, 10, 11, 12, 13}));
  EXPECT_EQ(path->key_images.back().picture, 19);
  bool crossed = false;
  for (const Arc& arc : path->arcs) {
    const KeyImage& from = path->key_images[at(arc.from)];
    const KeyImage& to = path->key_images[at(arc.from) + 1];
    EXPECT_LT(turn_off_deg(arc, poses[at(from.picture)], poses[at(to.picture)]), 0.6);
    EXPECT_LT(direction_off_deg(arc, poses[at(from.picture)], poses[at(to.picture)]), 3.0);
    if (from.picture != 5) continue;
    crossed = true;
    EXPECT_GE(to.picture, 14);
    for (const ArcMatch& match : arc.matches) {
      EXPECT_NE(std::ranges::find(from.features, match.feature, &KeyFeature::feature), from.features.end());
      EXPECT_NE(std::ranges::find(to.features, match.feature, &KeyFeature::feature), to.features.end());
    }
  }
  EXPECT_TRUE(crossed);
}

TEST_F(Teaching, ACoveredLensCutsThePathUntilItSeesAgain) {
  auto pictures = all_in({}, bend(20, 0.06));
  for (std::size_t i = 6; i < 14; ++i) pictures[i].room.reset();
  config.bridging.reset();
  const auto path = shown(pictures).path();
  ASSERT_TRUE(path);
  expect_sound(*path);
  ASSERT_EQ(path->cuts.size(), 1U);
  EXPECT_EQ(path->cuts.front().last_picture, 5);
  EXPECT_EQ(path->cuts.front().next_picture, 14);
}

TEST_F(Teaching, AnEndThatNothingFollowsIsNamed) {
  auto pictures = all_in({}, bend(8));
  pictures[7].room.reset();
  const auto path = shown(pictures).path();
  ASSERT_TRUE(path);
  ASSERT_EQ(path->cuts.size(), 1U);
  EXPECT_EQ(path->cuts.front().last_picture, 6);
  EXPECT_FALSE(path->cuts.front().next_picture);
}

TEST_F(Teaching, ArcsEndWhileEnoughOfThoseBeforeAreLeft) {
  config.least_common = 45;
  const auto path = shown(all_in({}, bend(40))).path();
  ASSERT_TRUE(path);
  int by_common = 0;
  for (const Arc& arc : path->arcs) {
    by_common += arc.ended_by == ArcEnd::kTooFewCommon ? 1 : 0;
    if (arc.from > 0) {
      EXPECT_GE(path->key_images[at(arc.from)].common, 45);
    }
  }
  EXPECT_GT(by_common, 0);
}

TEST_F(Teaching, ASmallerErrorOrMoreFeaturesMakeMoreArcs) {
  const auto pictures = all_in({}, bend(30));
  const std::size_t usual = shown(pictures).path()->arcs.size();
  config.least_features = 90;
  config.least_share = 1.0;
  EXPECT_GT(shown(pictures).path()->arcs.size(), usual);
  config.least_features = 50;
  config.most_error_px = 0.027;  // pixels of drawn pictures are exact
  const auto exact = shown(pictures).path();
  ASSERT_TRUE(exact);
  EXPECT_GT(exact->arcs.size(), usual);
  EXPECT_TRUE(std::ranges::any_of(exact->arcs, [](const Arc& arc) { return arc.ended_by == ArcEnd::kErrorTooLarge; }));
  for (const Arc& arc : exact->arcs) EXPECT_LE(arc.error_px, 0.027);
}

TEST_F(Teaching, WithNothingToSeeThereIsNoPath) {
  Teacher teaching = teacher();
  EXPECT_EQ(teaching.path().error().code, ErrorCode::kTooFewImages);
  for (int i = 0; i < 3; ++i) {
    const auto plain = teaching.add(picture({{}, std::nullopt}));
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->fate, PictureFate::kNothingToSee);
  }
  EXPECT_EQ(teaching.path().error().code, ErrorCode::kTooLittleSupport);
}

TEST_F(Teaching, TellsWhatBecameOfEachPicture) {
  Teacher teaching = teacher();
  auto pictures = all_in({}, bend(5));
  EXPECT_EQ(teaching.add(picture(pictures[0]))->fate, PictureFate::kBegins);
  const auto second = teaching.add(picture(pictures[1])).value();
  EXPECT_EQ(second.fate, PictureFate::kFollowed);
  EXPECT_EQ(second.key_picture, 0);
  EXPECT_GE(second.tracked, second.agreeing);
  EXPECT_GT(second.agreeing, 60);
  const int waits = config.bridging->most_ahead - 1;
  for (int i = 0; i <= waits; ++i) {
    const auto other = teaching.add(picture({pictures[1].pose, PaintedRoom{.seed = 5}})).value();
    EXPECT_EQ(other.fate, i < waits ? PictureFate::kWaits : PictureFate::kAfterCut) << i;
  }
}

TEST_F(Teaching, IsTheSameForTheSamePicturesAndCopiesAreIndependent) {
  const auto pictures = all_in({}, bend(16));
  Teacher first = shown(pictures);
  const Teacher copy = first;
  const auto once = copy.path().value();
  ASSERT_TRUE(first.add(picture({pictures.back().pose, PaintedRoom{.seed = 5}})));
  const auto twice = shown(pictures).path().value();
  for (const TaughtPath& other : {copy.path().value(), twice}) {
    ASSERT_EQ(other.arcs.size(), once.arcs.size());
    for (std::size_t i = 0; i < once.arcs.size(); ++i) {
      EXPECT_EQ(other.arcs[i].motion.current_from_target, once.arcs[i].motion.current_from_target);
      EXPECT_EQ(other.arcs[i].motion.target_in_current, once.arcs[i].motion.target_in_current);
      EXPECT_EQ(other.arcs[i].error_px, once.arcs[i].error_px);
      EXPECT_EQ(other.arcs[i].matches.size(), once.arcs[i].matches.size());
    }
  }
}

TEST_F(Teaching, RefusesWhatItCannotTeachWith) {
  TeachConfig bad = config;
  bad.least_features = 5;
  bad.most_error_px = 0.0;
  bad.tracker.window_px = 8;
  bad.corners.window_px = 4;
  bad.geometry.search_error_px = -1.0;
  EXPECT_GE(problems(bad).size(), 5U);
  EXPECT_TRUE(problems(config).empty());
  EXPECT_EQ(Teacher::create(bad, camera).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(Teacher::create(config, nullptr).error().code, ErrorCode::kInvalidInput);
  auto nominal = testing::small_lens_camera();
  nominal.nominal = true;
  EXPECT_EQ(Teacher::create(config, camera::Camera::create(nominal).value()).error().where, "nominal");
  for (const auto& round : {testing::mirror_camera(), testing::sphere_camera()}) {
    EXPECT_EQ(Teacher::create(config, camera::Camera::create(round).value()).error().where, "model");
  }
  Teacher teaching = teacher();
  const auto large = tracking::ImagePyramid::build(Image(320, 240, 1)).value();
  EXPECT_EQ(teaching.add(large).error().code, ErrorCode::kWrongImageSize);
  EXPECT_EQ(teaching.add(picture({}))->key_picture, 0);
}

}  // namespace
}  // namespace homeward::repeat::teach_test
