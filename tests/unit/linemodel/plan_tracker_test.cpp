// SPDX-License-Identifier: Apache-2.0
#include "linemodel/plan_tracker.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "core/angles.hpp"
#include "support/shaded_room.hpp"

namespace homeward::linemodel {
namespace {

/// From the first room through the doorway into the second.
std::vector<Pose2> way_through() {
  std::vector<Pose2> poses;
  for (int i = 0; i < 14; ++i) poses.push_back({1.2 + 0.3 * i, 2.2 + 0.065 * i, 0.2});
  for (int i = 0; i < 12; ++i) poses.push_back({5.4 + 0.3 * i, 3.05 - 0.08 * i, -0.25});
  return poses;
}

/// Another building: one room with pillars.
Plan hall() {
  MeshOfBoxes other;
  other.box({0.0F, 0.0F, -0.1F}, {15.0F, 9.0F, 0.0F});
  other.box({0.0F, -0.2F, 0.0F}, {15.0F, 0.0F, 3.6F});
  other.box({0.0F, 9.0F, 0.0F}, {15.0F, 9.2F, 3.6F});
  other.box({-0.2F, 0.0F, 0.0F}, {0.0F, 9.0F, 3.6F});
  other.box({15.0F, 0.0F, 0.0F}, {15.2F, 9.0F, 3.6F});
  for (int i = 0; i < 6; ++i) {
    const float x = 2.0F + 2.2F * static_cast<float>(i);
    other.box({x, 4.2F, 0.0F}, {x + 0.4F, 4.6F, 3.6F});
  }
  return plan_of_mesh(other.vertices_m(), other.triangles());
}

class DriveThroughTwoRooms : public ::testing::Test {
 protected:
  explicit DriveThroughTwoRooms(const camera::CameraConfig& config = small_panorama(), Plan world = two_rooms())
      : world_(std::move(world)), config_(config), camera_(camera::Camera::create(config).value()) {
    tracking_.monte_carlo.first_particles = 5'000;
    tracking_.monte_carlo.kld.least = 300;
    tracking_.most_places = 20;
  }

  [[nodiscard]] Image picture(const Pose2& robot) const { return shaded_picture(world_, rays_, *camera_, robot); }
  [[nodiscard]] static double off_m(const PlanEstimate& said, const Pose2& truth) {
    return (position_m(said.pose) - position_m(truth)).norm();
  }

  Plan world_;
  raycast::RayScene rays_{world_.vertices_m, world_.triangles};
  camera::CameraConfig config_;
  std::shared_ptr<const camera::Camera> camera_;
  PlanTrackerConfig tracking_;
};

TEST_F(DriveThroughTwoRooms, IsFollowedFromAStartThatSomebodySays) {
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  tracker.start_at({way[0].x_m + 0.2, way[0].y_m - 0.1, way[0].theta_rad + 0.1}, 0.3, 0.15);
  std::vector<double> off;
  for (const Pose2& robot : way) {
    const Pose2 odometry{1.05 * robot.x_m, robot.y_m, wrap_angle(robot.theta_rad + 1.0)};  // 5 % too long, turned
    const Pose2 turned = Pose2{0.0, 0.0, 1.0} * Pose2{odometry.x_m, odometry.y_m, robot.theta_rad};
    const PlanEstimate said = tracker.update(picture(robot), turned, std::nullopt).value();
    EXPECT_EQ(said.lost, PlanLost::kNo);
    EXPECT_LE(said.lines_confirmed, said.lines_expected);
    off.push_back(off_m(said, robot));
  }
  EXPECT_LT(*std::max_element(off.begin() + 5, off.end()), 0.25);
}

TEST_F(DriveThroughTwoRooms, IsFoundFromAnywhere) {
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  PlanEstimate said;
  for (const Pose2& robot : way_through()) said = tracker.update(picture(robot), robot, std::nullopt).value();
  EXPECT_EQ(said.lost, PlanLost::kNo);
  EXPECT_LT(off_m(said, way_through().back()), 0.25);
}

TEST_F(DriveThroughTwoRooms, IsNotOnThePlanOfAnotherBuilding) {
  PlanTracker tracker = PlanTracker::create(hall(), config_, tracking_).value();
  for (const Pose2& robot : way_through()) {
    EXPECT_NE(tracker.update(picture(robot), robot, std::nullopt)->lost, PlanLost::kNo);
  }
}

TEST_F(DriveThroughTwoRooms, IsSearchedForBeforeItIsSaidNotToBeOnThePlan) {
  PlanTracker here = PlanTracker::create(two_rooms(), config_, tracking_).value();
  PlanTracker elsewhere = PlanTracker::create(hall(), config_, tracking_).value();
  std::vector<Pose2> way = way_through();
  for (int i = 0; i < 12; ++i) way.push_back({8.7 - 0.25 * i, 2.2 + 0.06 * i, 2.9});
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Image seen = picture(way[i]);
    const PlanLost lost = elsewhere.update(seen, way[i], std::nullopt)->lost;
    EXPECT_NE(lost, PlanLost::kNo);
    if (i < 5) {
      EXPECT_EQ(lost, PlanLost::kSearching);
    }
    if (i + 5 > way.size()) {
      EXPECT_EQ(lost, PlanLost::kNotInPlan);
    }
    EXPECT_NE(here.update(seen, way[i], std::nullopt)->lost, PlanLost::kNotInPlan);
  }
}

TEST_F(DriveThroughTwoRooms, IsSearchedForBesideThePlacesWhileNoneAgreesAndStaysOffThePlanMeanwhile) {
  PlanTracker elsewhere = PlanTracker::create(hall(), config_, tracking_).value();
  std::vector<Pose2> way = way_through();
  for (int i = 0; i < 24; ++i) way.push_back({8.7 - 0.25 * i, 2.2 + 0.06 * i, 2.9});
  bool said = false;
  std::size_t followed = 0;
  bool joined = false;
  for (const Pose2& robot : way) {
    const PlanLost lost = elsewhere.update(picture(robot), robot, std::nullopt)->lost;
    if (said) {
      EXPECT_EQ(lost, PlanLost::kNotInPlan);
    }
    said = said || lost == PlanLost::kNotInPlan;
    const std::size_t now = elsewhere.places().places().size();
    joined = joined || (followed > 0 && now > followed);  // otherwise they only become fewer
    if (followed > 0) {
      EXPECT_GT(now, 0U);  // none is given up for nothing
    }
    followed = now;
  }
  EXPECT_TRUE(said);
  EXPECT_TRUE(joined);
}

TEST_F(DriveThroughTwoRooms, IsSaidToBeOnThePlanAgainOnlyByAPlaceThatWasFollowedForLong) {
  tracking_.still_at_places = 10.0;  // more than there ever is, so that it is said to be another plan at first
  tracking_.least_at_places = 0.3;
  tracking_.least_at_place = 10.0;  // and never to be at a place
  tracking_.monte_carlo.first_particles = 1'000;
  tracking_.most_places = 5;
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  std::vector<Pose2> way = way_through();
  for (int i = 0; i < 24; ++i) way.push_back({8.7 - 0.25 * i, 2.2 + 0.06 * i, 2.9});
  bool said = false;
  bool again = false;
  for (const Pose2& robot : way) {
    const PlanLost lost = tracker.update(picture(robot), robot, std::nullopt)->lost;
    ASSERT_NE(lost, PlanLost::kNo);
    double followed_m = 0.0;
    for (const PlaceHypothesis& place : tracker.places().places()) followed_m = std::max(followed_m, place.followed_m);
    if (said && lost != PlanLost::kNotInPlan) {
      again = true;
      EXPECT_GE(followed_m, tracking_.least_again_m);
    }
    said = said || lost == PlanLost::kNotInPlan;
  }
  EXPECT_TRUE(said);
  EXPECT_TRUE(again);
}

TEST_F(DriveThroughTwoRooms, IsFollowedAtNoMorePlacesThanAreAskedFor) {
  tracking_.most_places = 3;
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  std::size_t most = 0;
  for (const Pose2& robot : way_through()) {
    ASSERT_TRUE(tracker.update(picture(robot), robot, std::nullopt));
    if (tracker.places().empty()) continue;
    most = tracker.places().places().size();
    break;
  }
  EXPECT_EQ(most, 3U);
}

TEST_F(DriveThroughTwoRooms, IsExplainedByThePlanWhereItIsAndNotByAnother) {
  const Pose2 robot = way_through()[6];
  PlanTracker here = PlanTracker::create(two_rooms(), config_, tracking_).value();
  here.start_at(robot, 0.1, 0.05);
  const PlanEstimate said = here.update(picture(robot), robot, std::nullopt).value();
  EXPECT_EQ(said.explained, here.explained(said.pose));
  EXPECT_GT(here.explained(robot), 0.3);
  EXPECT_LT(here.explained({9.0, 2.2, 0.2}), here.explained(robot) - 0.3);
  PlanTracker elsewhere = PlanTracker::create(hall(), config_, tracking_).value();
  elsewhere.start_at({7.0, 2.2, 0.2}, 0.1, 0.05);
  ASSERT_TRUE(elsewhere.update(picture(robot), robot, std::nullopt));
  EXPECT_LT(elsewhere.explained({7.0, 2.2, 0.2}), 0.0);
}

TEST_F(DriveThroughTwoRooms, IsFollowedFromAStartThatIsFarOffAsItsSpreadSays) {
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  tracker.start_at({way[0].x_m + 1.7, way[0].y_m, way[0].theta_rad}, 1.2, 0.3);
  PlanEstimate said;
  for (std::size_t i = 0; i < 12; ++i) said = tracker.update(picture(way[i]), way[i], std::nullopt).value();
  EXPECT_EQ(said.lost, PlanLost::kNo);
  EXPECT_LT(off_m(said, way[11]), 0.25);
  EXPECT_TRUE(tracker.places().empty());  // nobody looked elsewhere
}

TEST_F(DriveThroughTwoRooms, IsOffThePlanBelowOneLimitAndOnItAgainAboveAHigherOne) {
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  tracker.start_at(way[0], 0.3, 0.15);
  bool dark = true;  // until that is taken for another building
  double last = 1.0;
  PlanEstimate said;
  for (const Pose2& robot : way) {
    said = tracker.update(dark ? Image(config_.width_px, config_.height_px, 3) : picture(robot), robot, std::nullopt)
               .value();
    if (dark && said.lost == PlanLost::kNotInPlan) {
      EXPECT_LT(said.evidence, tracking_.still_evidence);
      EXPECT_GE(last, tracking_.still_evidence);
      dark = false;
    } else if (!dark) {
      EXPECT_EQ(said.lost == PlanLost::kNotInPlan, said.evidence < tracking_.least_evidence);
    }
    last = said.evidence;
  }
  EXPECT_FALSE(dark);
  EXPECT_EQ(said.lost, PlanLost::kNo);
}

TEST_F(DriveThroughTwoRooms, IsOnThePlanWhileWhatIsSeenIsDrawnThoughLittleThatIsDrawnIsSeen) {
  tracking_.still_evidence = 10.0;  // more than there ever is
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  tracking_.still_agreement = 10.0;
  PlanTracker doubter = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  for (PlanTracker* one : {&tracker, &doubter}) one->start_at(way[0], 0.3, 0.15);
  for (std::size_t i = 0; i < 8; ++i) {
    const Image seen = picture(way[i]);
    EXPECT_NE(tracker.update(seen, way[i], std::nullopt)->lost, PlanLost::kNotInPlan);
    if (i == 0) {
      EXPECT_EQ(doubter.update(seen, way[i], std::nullopt)->lost, PlanLost::kNotInPlan);
    }
  }
}

TEST_F(DriveThroughTwoRooms, IsLookedForAnewWhenItWasCarriedAway) {
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  tracker.start_at(way[0], 0.3, 0.15);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(tracker.update(picture(way[i]), way[i], std::nullopt)->lost, PlanLost::kNo);
  }
  PlanEstimate said;
  int wrong = 0;
  for (int i = 0; i < 60; ++i) {  // around in the other room, of which odometry does not know how it got there
    const double turn = 0.2 * i;
    const Pose2 robot{8.8 + 1.4 * std::cos(turn), 2.0 + std::sin(turn), wrap_angle(turn + 0.5 * kPi)};
    const Pose2 odometry = way[4] * (inverse(Pose2{10.2, 2.0, 0.5 * kPi}) * robot);
    said = tracker.update(picture(robot), odometry, std::nullopt).value();
    if (said.lost == PlanLost::kNo && off_m(said, robot) > 0.5) ++wrong;
  }
  EXPECT_LT(wrong, 8);  // until it is noticed
  EXPECT_EQ(said.lost, PlanLost::kNo);
}

TEST_F(DriveThroughTwoRooms, IsLostInTheDark) {
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  for (const Pose2& robot : {way[0], way[1], way[2], way[3]}) {
    const Image dark(config_.width_px, config_.height_px, 3);
    EXPECT_NE(tracker.update(dark, robot, std::nullopt)->lost, PlanLost::kNo);
  }
}

TEST_F(DriveThroughTwoRooms, GivesTheSameForTheSameSeed) {
  PlanTracker one = PlanTracker::create(two_rooms(), config_, tracking_).value();
  PlanTracker twin = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  for (std::size_t i = 0; i < 4; ++i) {
    const PlanEstimate a = one.update(picture(way[i]), way[i], std::nullopt).value();
    const PlanEstimate b = twin.update(picture(way[i]), way[i], std::nullopt).value();
    EXPECT_EQ(a.pose.x_m, b.pose.x_m);
    EXPECT_EQ(a.particles, b.particles);
  }
}

class LensThroughTwoRooms : public DriveThroughTwoRooms {
 protected:
  LensThroughTwoRooms() : DriveThroughTwoRooms(small_pinhole()) {}
};

TEST_F(LensThroughTwoRooms, IsFollowedByOneOrdinaryCameraAndARangeSensor) {
  PlanTracker tracker = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  tracker.start_at(way[0], 0.3, 0.15);
  for (const Pose2& robot : way) {
    RangeSweep sweep;
    sweep.angle_step_rad = 2.0 * kPi / 180.0;
    for (int i = 0; i < 180; ++i) {
      const double turn = robot.theta_rad + i * sweep.angle_step_rad;
      const auto hit = rays_.first_hit(
          Eigen::Vector3f(static_cast<float>(robot.x_m), static_cast<float>(robot.y_m), 0.3F),
          Eigen::Vector3f(static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)), 0.0F), 12.0F);
      sweep.ranges_m.push_back(hit ? hit->distance_m : 12.0F);
    }
    const PlanEstimate said = tracker.update(picture(robot), robot, sweep).value();
    EXPECT_EQ(said.lost, PlanLost::kNo);
    EXPECT_LT(off_m(said, robot), 0.2);
  }
}

TEST_F(DriveThroughTwoRooms, IsNotDrawnOutOfThePlanByRaysThatEndBeyondIt) {
  PlanTracker with_sweeps = PlanTracker::create(two_rooms(), config_, tracking_).value();
  PlanTracker without = PlanTracker::create(two_rooms(), config_, tracking_).value();
  const std::vector<Pose2> way = way_through();
  for (PlanTracker* one : {&with_sweeps, &without}) one->start_at(way[0], 0.3, 0.15);
  RangeSweep beyond;  // every ray is as long as the plan is wide: to them one pose in the plan is as good as another
  beyond.range_max_m = 40.0;
  beyond.angle_step_rad = 2.0 * kPi / 60.0;
  beyond.ranges_m.assign(60, 30.0F);
  for (std::size_t i = 0; i < 4; ++i) {
    const PlanEstimate a = with_sweeps.update(picture(way[i]), way[i], beyond).value();
    const PlanEstimate b = without.update(picture(way[i]), way[i], std::nullopt).value();
    EXPECT_NEAR(a.pose.x_m, b.pose.x_m, 0.01);
    EXPECT_NEAR(a.pose.y_m, b.pose.y_m, 0.01);
  }
}

class DriveThroughTwinRooms : public DriveThroughTwoRooms {
 protected:
  DriveThroughTwinRooms() : DriveThroughTwoRooms(small_panorama(), twin_rooms()) {}
};

TEST_F(DriveThroughTwinRooms, IsKnownOnceSomethingTellsTheEndsApartAndNotBefore) {
  PlanTracker tracker = PlanTracker::create(twin_rooms(), config_, tracking_).value();
  std::vector<Pose2> way;
  for (int i = 0; i < 28; ++i) way.push_back({5.8 + 0.28 * i, 2.0, 0.0});
  const std::size_t alike = way.size();
  for (int i = 0; i < 20; ++i) way.push_back({13.5 + 0.2 * i, 2.0 + std::min(0.9, 0.15 * i), 0.1});
  PlanEstimate said;
  for (std::size_t i = 0; i < way.size(); ++i) {
    said = tracker.update(picture(way[i]), way[i], std::nullopt).value();
    if (i < alike) {
      ASSERT_NE(said.lost, PlanLost::kNo) << "at " << way[i].x_m << " m";
    }
    if (said.lost == PlanLost::kNo) {
      ASSERT_LT(off_m(said, way[i]), 0.3);
    }
    if (i + 1 == alike) {
      EXPECT_EQ(said.lost, PlanLost::kAmbiguous);
      ASSERT_FALSE(said.others.empty());
      const Pose2 twin{18.6 - way[i].x_m, 4.0 - way[i].y_m, kPi};
      const auto far_m = [&](const Pose2& pose) { return (position_m(pose) - position_m(twin)).norm(); };
      EXPECT_LT(std::min(far_m(said.pose), far_m(said.others.front().pose)), 0.3);
    }
  }
  EXPECT_EQ(said.lost, PlanLost::kNo);
}

TEST(PlanTracker, NamesWhatIsWrongWithAPlan) {
  Plan no_lines = two_rooms();
  no_lines.lines.clear();
  EXPECT_EQ(PlanTracker::create(no_lines, small_panorama(), {}).error().code, ErrorCode::kEmptyInput);
  Plan in_millimetres = two_rooms();
  in_millimetres.vertices_m *= 1000.0F;
  EXPECT_EQ(PlanTracker::create(in_millimetres, small_panorama(), {}).error().code, ErrorCode::kInvalidInput);
  camera::CameraConfig on_the_floor = small_panorama();
  on_the_floor.robot_from_camera_translation_m.z() = 0.0;
  const auto too_low = PlanTracker::create(two_rooms(), on_the_floor, {});
  ASSERT_FALSE(too_low);
  EXPECT_EQ(too_low.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(too_low.error().where, "robot_from_camera/translation_m");
  camera::CameraConfig blind = small_panorama();
  blind.width_px = 0;
  EXPECT_EQ(PlanTracker::create(two_rooms(), blind, {}).error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::linemodel
