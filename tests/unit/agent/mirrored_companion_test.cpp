// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/mirrored_companion.hpp"

#include <gtest/gtest.h>

#include "support/drawn_walls.hpp"
#include "support/landmarks.hpp"
#include "wire/appearance_blob.hpp"
#include "wire/scans_json.hpp"

namespace homeward::agent::mirrored_companion_test {
namespace {

using exploration::Explorer;
using exploration::ExplorerConfig;

const ExplorationId kTheirs("x2");

/// We and another robot are in two rooms; each begins an odometry and a floor of its own.
class MirroredCompanionTest : public ::testing::Test {
 protected:
  /// Made once: taking pictures is what most of the time goes to.
  MirroredCompanionTest() {
    static const Explorer driven = [this] {
      Explorer explorer{ExplorerConfig{}};
      for (const double x_m : {1.0, 1.8, 2.6, 3.4, 4.2}) {
        const Pose2 pose{x_m, 2.0, 0.2};
        explorer.take(sweep_of(testing::two_rooms(), pose), inverse(kOurs) * pose, seen(pose));
      }
      return explorer;
    }();
    ours_ = driven;
  }

  [[nodiscard]] std::shared_ptr<const features::Appearance> seen(const Pose2& pose) const {
    return std::make_shared<const features::Appearance>(homeward::testing::seen_from(landmarks_, pose, 9));
  }
  /// A picture of the other robot, as it tells it: odometry begins at `from`.
  [[nodiscard]] wire::CompanionView view(std::int64_t index, const Pose2& pose, const Pose2& from) const {
    wire::CompanionView told{kTheirs, index, {}, wire::encode_appearance(*seen(pose))};
    told.view.odometry = inverse(from) * pose;
    told.view.sweep = *wire::sweep_from_json(wire::sweep_to_json(sweep_of(testing::two_rooms(), pose)));
    return told;
  }
  [[nodiscard]] wire::CompanionView view(std::int64_t index, double x_m) const {
    return view(index, {x_m, 1.8, 2.9}, kTheirStart);
  }
  [[nodiscard]] static wire::CompanionState state(std::int64_t pictures, const Pose2& odometry = {}) {
    return {kTheirs, pictures, odometry, Eigen::Vector2d(3.0, 1.0), true, 0, {}};
  }
  /// It drives through both rooms, and tells it at once.
  void tell_all(const std::vector<double>& to_m = {4.3, 3.2, 2.8, 1.4, 1.0}) {
    for (const double x_m : to_m) {
      now_ms_ += 1000;
      theirs_.hear(state(theirs_.has() + 1), now_ms_);
      ASSERT_TRUE(theirs_.hear(view(theirs_.has(), x_m)));
      theirs_.look_from_theirs(ours_, std::nullopt, now_ms_);
    }
  }
  [[nodiscard]] std::optional<Error> refused(const wire::CompanionView& view) {
    const std::int64_t before = theirs_.has();
    const Status status = theirs_.hear(view);
    EXPECT_EQ(theirs_.has(), before);
    return status ? std::nullopt : std::optional(status.error());
  }

  const Pose2 kOurs{1.0, 2.0, 0.2};
  const Pose2 kTheirStart{4.3, 1.8, 2.9};
  homeward::testing::Landmarks landmarks_ =
      homeward::testing::landmarks_around({{1.0, 2.0, 0.0}, {2.5, 2.0, 0.0}, {4.0, 2.0, 0.0}}, 90, 5, 2.0);
  Explorer ours_{ExplorerConfig{}};
  MirroredCompanion theirs_{kTheirs, ExplorerConfig{}};
  std::int64_t now_ms_ = 0;
};

TEST_F(MirroredCompanionTest, WhatItToldIsPutTogetherAsItDidItItself) {
  Explorer itself{ExplorerConfig{}};
  const Pose2 anew{0.5, -1.0, 1.0};  // its odometry begins anew before the fourth picture
  const Pose2 now_from_before = inverse(anew) * kTheirStart;
  int index = 0;
  for (const double x_m : {4.3, 3.2, 2.8, 1.4, 1.0}) {
    wire::CompanionView told = view(index, {x_m, 1.8, 2.9}, index < 3 ? kTheirStart : anew);
    if (index == 3) {
      told.view.odometry_moved = now_from_before;
      itself.move_odometry(now_from_before);
    }
    const auto appearance = wire::decode_appearance(told.appearance, "picture");
    itself.take(told.view.sweep, told.view.odometry, std::make_shared<const features::Appearance>(*appearance));
    const auto decoded = wire::decode_agent_message(wire::encode(wire::AgentMessage(told)));
    ASSERT_TRUE(theirs_.hear(std::get<wire::CompanionView>(*decoded)));
    ++index;
  }
  ASSERT_EQ(theirs_.has(), 5);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(position_m(theirs_.mirror().poses()[i]), position_m(itself.poses()[i])) << i;
    EXPECT_EQ(theirs_.mirror().poses()[i].theta_rad, itself.poses()[i].theta_rad) << i;
  }
}

TEST_F(MirroredCompanionTest, OnceItsFloorIsJoinedOursHearsWhatItHasSeenAndWhereItDrives) {
  EXPECT_FALSE(theirs_.companion(ours_, now_ms_));
  tell_all();
  const auto companion = theirs_.companion(ours_, now_ms_);
  ASSERT_TRUE(companion);
  const Pose2 off = inverse(inverse(kOurs) * kTheirStart) * companion->floor_from_theirs;
  EXPECT_LT(position_m(off).norm(), 0.1);
  EXPECT_TRUE(companion->report.drives);
  EXPECT_EQ(companion->report.target_m, Eigen::Vector2d(3.0, 1.0));
  EXPECT_EQ(companion->report.floor.frame.size(), theirs_.mirror().floor().frame().size());
}

TEST_F(MirroredCompanionTest, OurPicturesJoinTheFloorsAsWell) {
  for (const double x_m : {4.3, 3.2, 2.8, 1.4, 1.0}) ASSERT_TRUE(theirs_.hear(view(theirs_.has(), x_m)));
  EXPECT_FALSE(theirs_.companion(ours_, now_ms_));
  Explorer ours{ExplorerConfig{}};
  for (const double x_m : {1.0, 1.8, 2.6, 3.4, 4.2}) {
    const Pose2 pose{x_m, 2.0, 0.2};
    ours.take(sweep_of(testing::two_rooms(), pose), inverse(kOurs) * pose, seen(pose));
    theirs_.look_from_ours(ours, now_ms_);
  }
  EXPECT_TRUE(theirs_.companion(ours, now_ms_)) << "and where it was then does not matter, as it has not said so";
}

TEST_F(MirroredCompanionTest, WhatTheOtherFoundJoinsOurFloorsAtTheSamePose) {
  tell_all();
  const auto here = theirs_.companion(ours_, now_ms_);
  ASSERT_TRUE(here);
  // As the other one sees it: ours is its companion, and it has not looked at all.
  MirroredCompanion ours{ExplorationId("x1"), ExplorerConfig{}};
  std::int64_t index = 0;
  for (const double x_m : {1.0, 1.8, 2.6, 3.4, 4.2}) {
    wire::CompanionView told = view(index++, {x_m, 2.0, 0.2}, kOurs);
    ASSERT_TRUE(ours.hear(told));
  }
  EXPECT_FALSE(ours.companion(theirs_.mirror(), now_ms_));
  wire::CompanionState told{ExplorationId("x1"), 5, {}, std::nullopt, false, 5, theirs_.agreements()};
  ours.hear(told, now_ms_);
  const auto there = ours.companion(theirs_.mirror(), now_ms_);
  ASSERT_TRUE(there);
  const Pose2 around = here->floor_from_theirs * there->floor_from_theirs;
  EXPECT_LT(position_m(around).norm(), 1e-6) << "there and back";
  EXPECT_NEAR(around.theta_rad, 0.0, 1e-6);
  EXPECT_TRUE(ours.agreements().empty()) << "what was told is not told back";
}

TEST_F(MirroredCompanionTest, WhereItDrivesCountsForFiveSecondsAndWhatItHasSeenForEver) {
  tell_all();
  ASSERT_TRUE(theirs_.companion(ours_, now_ms_ + 5000));
  EXPECT_TRUE(theirs_.companion(ours_, now_ms_ + 5000)->report.drives);
  const auto later = theirs_.companion(ours_, now_ms_ + 5001);
  ASSERT_TRUE(later);
  EXPECT_FALSE(later->report.drives);
  EXPECT_FALSE(later->report.target_m);
  EXPECT_EQ(theirs_.lately_told(now_ms_ + 5001), nullptr);
  theirs_.hear(state(5), now_ms_ + 60'000);
  EXPECT_TRUE(theirs_.companion(ours_, now_ms_ + 60'000)->report.drives);
  wire::CompanionState ended = state(5);
  ended.drives = false;
  theirs_.hear(ended, now_ms_ + 60'500);
  EXPECT_FALSE(theirs_.companion(ours_, now_ms_ + 60'500)->report.drives);
}

TEST_F(MirroredCompanionTest, WhoeverWouldStandInPlainViewUnseenIsElsewhereButOnlyByWhatIsNew) {
  // By this it has us 1 m before it, where its sweeps show nothing.
  const auto stands = [&](double x_m) { return inverse(kOurs) * Pose2{x_m, 1.8, 2.9} * Pose2{1.0, 0.0, 0.0}; };
  MirroredCompanion late{kTheirs, ExplorerConfig{}};
  for (const double x_m : {4.3, 3.0, 2.0, 1.0}) {
    now_ms_ += 1000;
    theirs_.hear(state(theirs_.has() + 1), now_ms_);
    ASSERT_TRUE(theirs_.hear(view(theirs_.has(), x_m)));
    theirs_.look_from_theirs(ours_, stands(x_m), now_ms_);
    late.hear(state(20), now_ms_);  // these are pictures from long ago
    ASSERT_TRUE(late.hear(view(late.has(), x_m)));
    late.look_from_theirs(ours_, stands(x_m), now_ms_);
  }
  EXPECT_FALSE(theirs_.companion(ours_, now_ms_));
  EXPECT_TRUE(late.companion(ours_, now_ms_));
}

TEST_F(MirroredCompanionTest, WhileItIsNotCaughtUpWithNobodyKnowsWhereItIs) {
  tell_all();
  const Pose2 at_last = theirs_.mirror().poses().back();
  theirs_.hear(state(5, {0.3, 0.0, 0.0}), now_ms_);
  const auto now = theirs_.companion(ours_, now_ms_);
  ASSERT_TRUE(now);
  EXPECT_GT(position_m(inverse(at_last) * now->report.floor_from_robot).norm(), 0.5) << "by its odometry";
  theirs_.hear(state(6, {70.0, 0.0, 0.0}), now_ms_);  // of an odometry that began anew with the sixth
  const auto later = theirs_.companion(ours_, now_ms_);
  ASSERT_TRUE(later);
  EXPECT_EQ(position_m(later->report.floor_from_robot), position_m(at_last));
  EXPECT_TRUE(later->report.drives);
}

TEST_F(MirroredCompanionTest, OneThatWasCarriedFarAndKnowsWhereItIsIsFollowed) {
  ASSERT_TRUE(theirs_.hear(view(0, 4.3)));
  wire::CompanionView carried = view(1, 3.2);
  carried.view.odometry_moved = Pose2{-40.0, 0.0, 0.0};
  EXPECT_TRUE(theirs_.hear(carried));
  EXPECT_FALSE(theirs_.takes_no_more());
}

TEST_F(MirroredCompanionTest, WhatWouldBeRefusedAgainNeedNotBeToldAgain) {
  ASSERT_TRUE(theirs_.hear(view(0, 4.3)));
  EXPECT_TRUE(refused(view(2, 3.2)));
  EXPECT_FALSE(theirs_.takes_no_more()) << "that one is the next but one";
  wire::CompanionView far = view(1, 3.2);
  far.view.odometry.x_m = 900.0;
  EXPECT_TRUE(refused(far));
  EXPECT_TRUE(theirs_.takes_no_more());
  ASSERT_TRUE(theirs_.hear(view(1, 3.2)));
  EXPECT_FALSE(theirs_.takes_no_more());
}

TEST_F(MirroredCompanionTest, MoreFeaturesThanItHoldsCountAsNotLookedAt) {
  MirrorLimits limits;
  limits.bytes = view(0, 4.3).appearance.size() * 3 / 2;
  MirroredCompanion theirs(kTheirs, ExplorerConfig{}, limits);
  for (std::int64_t index : {0, 1}) ASSERT_TRUE(theirs.hear(view(index, 4.3 - 0.5 * static_cast<double>(index))));
  EXPECT_NE(theirs.mirror().views()[0].appearance, nullptr);
  EXPECT_EQ(theirs.mirror().views()[1].appearance, nullptr);
}

TEST_F(MirroredCompanionTest, WhatIsNotTheNextPictureIsRefused) {
  EXPECT_EQ(refused(view(1, 4.3))->code, ErrorCode::kConflict);
  ASSERT_TRUE(theirs_.hear(view(0, 4.3)));
  EXPECT_EQ(refused(view(0, 4.3))->code, ErrorCode::kConflict);
  EXPECT_EQ(refused(view(2, 4.3))->code, ErrorCode::kConflict);
  EXPECT_EQ(refused(view(2, 4.3))->where, "picture 2");
  EXPECT_TRUE(theirs_.hear(view(1, 3.2)));
}

TEST_F(MirroredCompanionTest, GarbageIsRefusedAndChangesNothing) {
  wire::CompanionView garbage = view(0, 4.3);
  garbage.appearance = {1, 2, 3};
  EXPECT_TRUE(refused(garbage));
  ASSERT_TRUE(theirs_.hear(view(0, 4.3)));
  garbage = view(1, 3.2);
  garbage.view.odometry.x_m = 900'000.0;
  EXPECT_TRUE(refused(garbage)) << "a floor of that size would fill the memory";
  garbage = view(1, 3.2);
  garbage.view.odometry_moved = Pose2{500.0, 0.0, 0.0};
  EXPECT_TRUE(refused(garbage));
  garbage = view(1, 3.2);
  garbage.view.sweep.range_max_m = 900.0;
  EXPECT_TRUE(refused(garbage));
  garbage = view(1, 3.2);
  garbage.view.sweep.ranges_m.assign(9000, 1.0F);
  EXPECT_TRUE(refused(garbage));
  EXPECT_TRUE(theirs_.hear(view(1, 3.2))) << "and then the right one is taken";
}

TEST_F(MirroredCompanionTest, ItLeadsNobodyFarAwayStepByStepAndFillsNoMemory) {
  MirrorLimits limits;
  limits.between_m = 25.0;
  limits.from_start_m = 60.0;
  limits.pictures = 100;
  MirroredCompanion theirs(kTheirs, ExplorerConfig{}, limits);
  wire::CompanionView far = view(0, 4.3);
  for (int i = 0; i < 20; ++i) {
    far.index = i;
    far.view.odometry = {20.0 * i, 0.0, 0.0};
    if (!theirs.hear(far)) break;
  }
  EXPECT_LE(theirs.has(), 5);
  limits.pictures = 3;
  MirroredCompanion few(kTheirs, ExplorerConfig{}, limits);
  for (int i = 0; i < 5; ++i) {
    const bool taken = few.hear(view(i, 4.3 - 0.1 * i)).has_value();
    EXPECT_EQ(taken, i < 3);
  }
}

TEST_F(MirroredCompanionTest, APictureThatCannotBeComparedStillShowsTheFloor) {
  wire::CompanionView bare = view(0, 4.3);
  bare.appearance.clear();
  ASSERT_TRUE(theirs_.hear(bare));
  EXPECT_EQ(theirs_.mirror().views()[0].appearance, nullptr);
  MirrorLimits limits;
  limits.features = 10;
  MirroredCompanion theirs(kTheirs, ExplorerConfig{}, limits);
  ASSERT_TRUE(theirs.hear(view(0, 4.3)));
  EXPECT_EQ(theirs.mirror().views()[0].appearance, nullptr) << "more features than are compared";
  EXPECT_GT(theirs_.mirror().floor().frame().size(), 0U);
}

TEST_F(MirroredCompanionTest, WhoHasLostPicturesIsPutTogetherAnew) {
  tell_all();
  ASSERT_TRUE(theirs_.companion(ours_, now_ms_));
  theirs_.hear(state(2), now_ms_);
  EXPECT_EQ(theirs_.has(), 0);
  EXPECT_FALSE(theirs_.companion(ours_, now_ms_));
  tell_all();
  EXPECT_TRUE(theirs_.companion(ours_, now_ms_));
}

}  // namespace
}  // namespace homeward::agent::mirrored_companion_test
