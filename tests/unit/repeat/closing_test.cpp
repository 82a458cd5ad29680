// SPDX-License-Identifier: Apache-2.0
#include "repeat/closing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/index.hpp"
#include "repeat/repeater.hpp"
#include "support/short_path.hpp"

namespace homeward::repeat::closing_test {
namespace {

using testing::aside;
using testing::PaintedRoom;
using testing::pyramid_at;

constexpr int kRound = 48;  // pictures

/// Round and round counter-clockwise, from the first picture of a round on.
std::vector<Pose2> circle(int first, int count) {
  std::vector<Pose2> poses;
  for (int i = first; i < first + count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRound;
    poses.push_back({0.6 * std::sin(angle), -0.6 * std::cos(angle), angle});
  }
  return poses;
}

struct Tour : testing::ShortPath {
  explicit Tour(std::vector<Pose2> along) : ShortPath(std::move(along)) { config.most_features = 120; }
  [[nodiscard]] KeyPictures key_pictures() const {
    return [pictures = pictures](int key) { return pictures[at(key)]; };
  }
  [[nodiscard]] std::optional<TaughtPath> closed() const {
    TaughtPath made = *path;
    if (!close_path(made, key_pictures(), camera, config)) return std::nullopt;
    return made;
  }
  TeachConfig config;
};

/// Once round, up to shortly before where it began.
const Tour& once_round() {
  static const Tour tour(circle(0, kRound - 1));
  return tour;
}

TEST(ClosingAPath, JoinsItsEndToWhereItBeganAndChangesNothingElse) {
  const Tour& tour = once_round();
  ASSERT_TRUE(tour.path->cuts.empty());
  const auto path = tour.closed();
  ASSERT_TRUE(path);
  ASSERT_TRUE(path->closing);
  ASSERT_EQ(path->arcs.size(), tour.path->arcs.size() + 1);
  for (std::size_t i = 0; i < tour.path->arcs.size(); ++i) {
    EXPECT_EQ(path->arcs[i].motion.target_in_current, tour.path->arcs[i].motion.target_in_current);
    EXPECT_EQ(path->arcs[i].matches.size(), tour.path->arcs[i].matches.size());
  }
  const Arc& arc = path->arcs.back();
  EXPECT_EQ(arc.from, path->last_key());
  EXPECT_EQ(path->to_key(arc), path->closing->key_image);
  const Pose2& from = tour.pose_of(arc.from);
  const Pose2& to = tour.pose_of(path->closing->key_image);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(to.theta_rad - from.theta_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_LT(Eigen::AngleAxisd(Eigen::Matrix3d(turn.transpose() * arc.motion.current_from_target)).angle(), 0.01);
  EXPECT_GT(arc.motion.target_in_current.x(), 0.5);
  EXPECT_GE(path->key_images.back().common, 10);
  EXPECT_GE(path->closing->common, 10);
  EXPECT_TRUE(path->key_images.back().scale);
  EXPECT_TRUE(path->closing->scale);
}

TEST(ClosingAPath, FeaturesOfTheClosingArcAreInBothItsKeyImages) {
  const auto path = once_round().closed();
  ASSERT_TRUE(path);
  const auto in_key = [&](int key, int feature) {
    const auto& features = path->key_images[at(key)].features;
    const auto found = std::ranges::find(features, feature, &KeyFeature::feature);
    EXPECT_NE(found, features.end());
    return found == features.end() ? Eigen::Vector2d(-1.0, -1.0) : found->pixel_px;
  };
  for (const ArcMatch& match : path->arcs.back().matches) {
    EXPECT_EQ(in_key(path->last_key(), match.feature), match.from_px);
    EXPECT_EQ(in_key(path->closing->key_image, match.feature), match.to_px);
  }
}

TEST(ClosingAPath, APathThatComesByItsBeginningIsClosedAtAKeyImageAhead) {
  // Begins before the circle, and goes on past where it came in.
  std::vector<Pose2> poses;
  for (int i = 4; i > 0; --i) poses.push_back({-0.06 * i, -0.6, 0.0});
  for (const Pose2& pose : circle(0, kRound + 4)) poses.push_back(pose);
  const Tour tour(poses);
  const auto path = tour.closed();
  ASSERT_TRUE(path);
  const Pose2& from = tour.pose_of(path->last_key());
  const Pose2& to = tour.pose_of(path->closing->key_image);
  const double ahead_m =
      (to.x_m - from.x_m) * std::cos(from.theta_rad) + (to.y_m - from.y_m) * std::sin(from.theta_rad);
  EXPECT_GT(ahead_m, -0.01);
}

TEST(ClosingAPath, IsNotDoneWhereItFacesAnotherWayOrIsNowhereNearOrWasOnlyTurned) {
  std::vector<Pose2> back = circle(0, kRound - 1);
  for (int i = 1; i <= 16; ++i) {
    Pose2 turned = back[kRound - 2];
    turned.theta_rad += 0.18 * i;
    back.push_back(turned);
  }
  EXPECT_FALSE(Tour(back).closed());
  EXPECT_FALSE(Tour(circle(0, kRound / 2)).closed());
  std::vector<Pose2> spot;
  for (int i = 0; i < 44; ++i) spot.push_back({-1.0, 0.2, 0.15 * i});
  EXPECT_FALSE(Tour(spot).closed());
}

TEST(ClosingAPath, IsNotDoneWithoutPicturesOrWhereItIsNotWanted) {
  Tour tour = once_round();
  TaughtPath path = *tour.path;
  EXPECT_FALSE(close_path(
      path, [](int) { return nullptr; }, tour.camera, tour.config));
  tour.config.bridging.reset();
  EXPECT_FALSE(tour.closed());
  tour.config = once_round().config;
  tour.config.bridging->fewest_around = 1000;
  EXPECT_FALSE(tour.closed());
}

class RepeatingAClosedPath : public ::testing::Test {
 protected:
  [[nodiscard]] static Repeater repeater() {
    const Tour& tour = once_round();
    static const auto path = std::make_shared<const TaughtPath>(tour.closed().value());
    return Repeater::create({}, path, tour.key_pictures(), tour.camera).value();
  }
  static Repeated step(Repeater& repeater, const Pose2& pose) {
    return repeater.step(std::make_shared<const tracking::ImagePyramid>(pyramid_at({}, pose, *once_round().camera)))
        .value();
  }
  static int arcs() { return static_cast<int>(once_round().path->arcs.size()) + 1; }
};

TEST_F(RepeatingAClosedPath, GoesRoundAndRoundAndNeverComesToAnEnd) {
  Repeater repeater = this->repeater();
  ASSERT_TRUE(repeater.begin(0));
  int transitions = 0;
  for (const Pose2& pose : circle(0, 2 * kRound + 6)) {
    const Repeated said = step(repeater, aside(pose, 0.04));
    ASSERT_FALSE(said.is_lost()) << pose.theta_rad;
    EXPECT_FALSE(said.at_end);
    EXPECT_GE(said.tracked, 30) << pose.theta_rad;
    transitions += said.transitions;
    EXPECT_EQ(transitions % arcs(), said.arc) << pose.theta_rad;
  }
  EXPECT_GE(transitions, 2 * arcs());
}

TEST_F(RepeatingAClosedPath, GoesBackOverWhereItIsClosed) {
  Repeater repeater = this->repeater();
  ASSERT_TRUE(repeater.begin(0));
  std::vector<Pose2> back = circle(-kRound / 3, kRound / 3 + 3);
  std::ranges::reverse(back);
  int transitions = 0;
  for (const Pose2& pose : back) {
    const Repeated said = step(repeater, pose);
    ASSERT_FALSE(said.is_lost()) << pose.theta_rad;
    transitions += said.transitions;
    EXPECT_EQ((transitions + arcs()) % arcs(), said.arc);
  }
  EXPECT_LT(transitions, -1);
}

}  // namespace
}  // namespace homeward::repeat::closing_test
