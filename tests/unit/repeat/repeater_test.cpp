// SPDX-License-Identifier: Apache-2.0
#include "repeat/repeater.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/index.hpp"
#include "support/short_path.hpp"

namespace homeward::repeat::repeater_test {
namespace {

using testing::aside;
using testing::bend;
using testing::PaintedRoom;

std::shared_ptr<const camera::Camera> lens() {
  static const auto camera = camera::Camera::create(testing::small_lens_camera()).value();
  return camera;
}

std::shared_ptr<const tracking::ImagePyramid> seen_from(const Pose2& pose, const PaintedRoom& room = {}) {
  return std::make_shared<const tracking::ImagePyramid>(testing::pyramid_at(room, pose, *lens()));
}

std::shared_ptr<const tracking::ImagePyramid> plain() {
  Image picture(lens()->config().width_px, lens()->config().height_px, 1);
  std::ranges::fill(picture.data, std::uint8_t{90});
  return std::make_shared<const tracking::ImagePyramid>(tracking::ImagePyramid::build(picture).value());
}

/// A path that was taught, and what repeats it.
struct Taught : testing::ShortPath {
  using testing::ShortPath::ShortPath;
  [[nodiscard]] Repeater repeater(const RepeatConfig& config = {}) const {
    return Repeater::create(
               config, path, [pictures = pictures](int key) { return pictures[at(key)]; }, lens())
        .value();
  }
  /// Whether a taught picture lies on an arc, a picture's step more or less.
  [[nodiscard]] bool is_on(int arc, int picture) const {
    const int from = path->arcs[at(arc)].from;
    return picture >= path->key_images[at(from)].picture - 1 && picture <= path->key_images[at(from) + 1].picture + 1;
  }
};

const Taught& taught_bend() {
  static const Taught taught(bend(24));
  return taught;
}

TEST(Repeating, FollowsThePathBesideItFromArcToArc) {
  const Taught& taught = taught_bend();
  ASSERT_GE(taught.path->arcs.size(), 2U);
  Repeater repeater = taught.repeater();
  ASSERT_TRUE(repeater.begin(0));
  int transitions = 0;
  Repeated said;
  for (int i = 0; i < 24; ++i) {
    said = repeater.step(seen_from(aside(taught.poses[at(i)], 0.1))).value();
    ASSERT_FALSE(said.is_lost()) << i;
    EXPECT_TRUE(taught.is_on(said.arc, i)) << i << " on " << said.arc;
    EXPECT_EQ(said.to_key, said.from_key + 1);
    EXPECT_GE(said.tracked, 40) << i;
    EXPECT_LT(said.error_px, 1.0);
    EXPECT_TRUE(said.structure_agrees);
    EXPECT_GT(said.confidence, 0.7);
    EXPECT_GT(said.lateral, 0.0);  // left of the path
    transitions += said.transitions;
  }
  EXPECT_EQ(transitions, said.arc);
  EXPECT_EQ(said.arc, static_cast<int>(taught.path->arcs.size()) - 1);
  EXPECT_GT(said.progress, 0.9);
}

TEST(Repeating, SaysHowFarAsideAndAlongItIsAndWhereToSteer) {
  const Taught& taught = taught_bend();
  const KeyImage& to = taught.path->key_images[1];
  const double way_m = std::hypot(taught.poses[at(to.picture)].x_m - taught.poses[0].x_m,
                                  taught.poses[at(to.picture)].y_m - taught.poses[0].y_m);
  for (const double left_m : {-0.12, 0.12}) {
    Repeater repeater = taught.repeater();
    ASSERT_TRUE(repeater.begin(0));
    const Repeated said = repeater.step(seen_from(aside(taught.poses[0], left_m))).value();
    ASSERT_FALSE(said.is_lost());
    EXPECT_NEAR(said.lateral, left_m / way_m, 0.15 * std::abs(left_m) / way_m);
    EXPECT_NEAR(said.progress, 0.0, 0.15);
    ASSERT_TRUE(said.bearing_to_next_rad);
    EXPECT_LT(*said.bearing_to_next_rad * left_m, 0.0);  // back towards the path
  }
  // Turned away to the left, one has to turn right by as much.
  const auto steering_rad = [&](double turned_rad) {
    Repeater repeater = taught.repeater();
    EXPECT_TRUE(repeater.begin(0));
    Pose2 pose = taught.poses[0];
    pose.theta_rad += turned_rad;
    return repeater.step(seen_from(pose)).value().steering_rad;
  };
  EXPECT_NEAR(steering_rad(0.08) - steering_rad(0.0), -0.08, 0.025);
}

TEST(Repeating, GoesBackWhereItIsDrivenBackwards) {
  const Taught& taught = taught_bend();
  Repeater repeater = taught.repeater();
  const int last = static_cast<int>(taught.path->arcs.size()) - 1;
  ASSERT_TRUE(repeater.begin(last));
  Repeated said;
  const int from = taught.path->key_images[at(taught.path->arcs[at(last)].from)].picture;
  for (int i = from; i >= 0; --i) {
    said = repeater.step(seen_from(taught.poses[at(i)])).value();
    ASSERT_FALSE(said.is_lost()) << i;
  }
  EXPECT_EQ(said.arc, 0);
}

TEST(Repeating, ResumesWhatWasCoveredWherePredicted) {
  const Taught& taught = taught_bend();
  Repeater repeater = taught.repeater();
  ASSERT_TRUE(repeater.begin(0));
  int before = 0;
  for (int i = 0; i < 10; ++i) {
    const bool covered = i >= 3 && i < 8;
    Image picture = testing::lens_picture({}, aside(taught.poses[at(i)], 0.05), *lens());
    for (int v = 0; covered && v < picture.height_px; ++v)
      std::fill_n(picture.at(0, v), picture.width_px / 3, std::uint8_t{90});
    const Repeated said =
        repeater.step(std::make_shared<const tracking::ImagePyramid>(tracking::ImagePyramid::build(picture).value()))
            .value();
    ASSERT_FALSE(said.is_lost()) << i;
    if (i == 2) before = said.tracked;
    if (i == 4) {
      EXPECT_LT(said.tracked, 0.85 * before);
    }
    if (i == 8) {
      EXPECT_GT(said.predicted, 10);
    }
    if (i == 9) {
      EXPECT_GT(said.tracked, 0.8 * before);
    }
  }
}

TEST(Repeating, IsLostWhileTheLensIsCoveredAndThenRecovers) {
  const Taught& taught = taught_bend();
  Repeater repeater = taught.repeater();
  ASSERT_TRUE(repeater.begin(0));
  ASSERT_FALSE(repeater.step(seen_from(taught.poses[0])).value().is_lost());
  for (int i = 0; i < 4; ++i) {
    const Repeated said = repeater.step(plain()).value();
    EXPECT_EQ(said.lost, LostReason::kTooFewFeatures);
    EXPECT_EQ(said.tracked, 0);
  }
  EXPECT_FALSE(repeater.step(seen_from(taught.poses[1])).value().is_lost());
}

TEST(Repeating, IsLostInAnotherRoomAndNeverGuesses) {
  const Taught& taught = taught_bend();
  Repeater begun = taught.repeater();
  ASSERT_TRUE(begun.begin(0));
  Repeater anywhere = taught.repeater();
  for (int i = 0; i < 5; ++i) {
    const auto picture = seen_from(taught.poses[at(i)], PaintedRoom{.seed = 5});
    EXPECT_TRUE(begun.step(picture).value().is_lost()) << i;
    EXPECT_TRUE(anywhere.step(picture).value().is_lost()) << i;
  }
}

TEST(Repeating, BeginsAnywhereByRecognition) {
  const Taught& taught = taught_bend();
  Repeater repeater = taught.repeater();
  const Repeated said = repeater.step(seen_from(aside(taught.poses[15], 0.05))).value();
  ASSERT_FALSE(said.is_lost());
  EXPECT_GT(said.recovered, 15);
  EXPECT_TRUE(taught.is_on(said.arc, 15)) << said.arc;
  RepeatConfig without;
  without.recognition.reset();
  Repeater unbegun = taught.repeater(without);
  EXPECT_EQ(unbegun.step(seen_from(taught.poses[15])).value().lost, LostReason::kNotBegun);
}

TEST(Repeating, WhatIsRecognisedMakesUpForLandmarksThatAreNotFound) {
  const Taught& taught = taught_bend();
  Image half = testing::lens_picture({}, taught.poses[15], *lens());
  std::fill(half.data.begin(), half.data.begin() + static_cast<std::ptrdiff_t>(half.data.size() / 2), std::uint8_t{90});
  const auto picture = std::make_shared<const tracking::ImagePyramid>(tracking::ImagePyramid::build(half).value());
  RepeatConfig strict;
  strict.least_recovered = 0.9;  // of the landmarks: half of them are hidden
  EXPECT_FALSE(taught.repeater(strict).step(picture).value().is_lost());
  strict.recognition->vouching = 10'000;
  EXPECT_TRUE(taught.repeater(strict).step(picture).value().is_lost());
}

TEST(Repeating, FollowsATurnOnTheSpot) {
  std::vector<Pose2> poses;
  for (int i = 0; i < 9; ++i) poses.push_back({-1.0, 0.2, 0.09 * i});
  const Taught taught(poses);
  Repeater repeater = taught.repeater();
  ASSERT_TRUE(repeater.begin(0));
  double before = -1.0;
  Repeated said;
  for (int i = 0; i < 9; ++i) {
    Pose2 pose = poses[at(i)];
    pose.x_m += 0.02;
    said = repeater.step(seen_from(pose)).value();
    ASSERT_FALSE(said.is_lost()) << i;
    EXPECT_FALSE(said.bearing_to_next_rad);
    EXPECT_EQ(said.lateral, 0.0);
    EXPECT_GT(said.arc + said.progress, before);
    before = said.arc + said.progress;
  }
  EXPECT_EQ(said.arc, static_cast<int>(taught.path->arcs.size()) - 1);
}
/// A tour that turns on the spot by 57 degrees, and by half of that back again while it drives on.
std::vector<Pose2> swing() {
  std::vector<Pose2> poses;
  for (int i = 0; i < 5; ++i) poses.push_back({-2.2 + 0.1 * i, -0.5, 0.0});
  const Pose2 corner = poses.back();
  for (const double turned_rad : {0.5, 1.0}) poses.push_back(corner * Pose2{0.0, 0.0, turned_rad});
  const Pose2 way = corner * Pose2{0.0, 0.0, 0.5};
  for (int i = 1; i <= 4; ++i) poses.push_back(way * Pose2{0.05 * i, 0.0, 0.5 - 0.125 * i});
  for (int i = 1; i <= 8; ++i) poses.push_back(way * Pose2{0.2 + 0.08 * i, 0.0, 0.0});
  return poses;
}

TEST(Repeating, LeavesATurnThatTheWayAfterItUndoes) {
  const Taught taught(swing());
  Repeater repeater = taught.repeater();
  ASSERT_TRUE(repeater.begin(0));
  Repeated said;
  for (int i = 0; i < static_cast<int>(taught.poses.size()); ++i) {
    said = repeater.step(seen_from(taught.poses[at(i)])).value();
    ASSERT_FALSE(said.is_lost()) << i;
    EXPECT_TRUE(taught.is_on(said.arc, i)) << i << " on " << said.arc;
  }
  EXPECT_EQ(said.arc, static_cast<int>(taught.path->arcs.size()) - 1);
  EXPECT_NEAR(said.progress, 1.0, 0.05);
}

TEST(Repeating, IsTheSameForTheSamePicturesAndCopiesAreIndependent) {
  const Taught& taught = taught_bend();
  Repeater first = taught.repeater();
  ASSERT_TRUE(first.begin(0));
  ASSERT_TRUE(first.step(seen_from(taught.poses[0])));
  Repeater copy = first;
  ASSERT_TRUE(first.step(plain()));
  const Repeated a = copy.step(seen_from(taught.poses[1])).value();
  Repeater again = taught.repeater();
  ASSERT_TRUE(again.begin(0));
  ASSERT_TRUE(again.step(seen_from(taught.poses[0])));
  const Repeated b = again.step(seen_from(taught.poses[1])).value();
  EXPECT_EQ(a.tracked, b.tracked);
  EXPECT_EQ(a.progress, b.progress);
  EXPECT_EQ(a.lateral, b.lateral);
}

TEST(Repeating, RefusesWhatItCannotRepeatWith) {
  const Taught& taught = taught_bend();
  const auto pictures = [&](int key) { return taught.pictures[at(key)]; };
  const auto code = [](const Result<Repeater>& made) { return made.error().code; };
  EXPECT_EQ(code(Repeater::create({}, nullptr, pictures, lens())), ErrorCode::kInvalidInput);
  EXPECT_EQ(code(Repeater::create({}, std::make_shared<TaughtPath>(), pictures, lens())), ErrorCode::kInvalidInput);
  EXPECT_EQ(code(Repeater::create({}, taught.path, pictures, nullptr)), ErrorCode::kInvalidInput);
  EXPECT_EQ(code(Repeater::create({}, taught.path, nullptr, lens())), ErrorCode::kInvalidInput);
  const auto none = [](int) { return std::shared_ptr<const tracking::ImagePyramid>{}; };
  EXPECT_EQ(code(Repeater::create({}, taught.path, none, lens())), ErrorCode::kNotFound);
  RepeatConfig bad;
  bad.most_error_rad = 0.0;
  EXPECT_EQ(code(Repeater::create(bad, taught.path, pictures, lens())), ErrorCode::kInvalidInput);
  Repeater repeater = taught.repeater();
  EXPECT_EQ(repeater.begin(-1).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(repeater.begin(1000).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(repeater.step(nullptr).error().code, ErrorCode::kWrongImageSize);
  const auto small =
      std::make_shared<const tracking::ImagePyramid>(tracking::ImagePyramid::build(Image(64, 48, 1)).value());
  EXPECT_EQ(repeater.step(small).error().code, ErrorCode::kWrongImageSize);
}

TEST(RepeatConfig, NamesItsProblems) {
  EXPECT_TRUE(problems(RepeatConfig{}).empty());
  RepeatConfig bad;
  bad.reach = -1;
  bad.fewest_features = 3;
  bad.least_visible = -1.0;
  bad.back = 0.1;
  bad.clear_way_rad = 0.0;
  bad.pose.agree_rad = 0.0;
  bad.tracker.window_px = 8;
  bad.recognition->most_compared = 0;
  EXPECT_EQ(problems(bad).size(), 8U);
}

}  // namespace
}  // namespace homeward::repeat::repeater_test
