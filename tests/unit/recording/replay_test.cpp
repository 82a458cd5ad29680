// SPDX-License-Identifier: Apache-2.0
#include "recording/replay.hpp"

#include <gmock/gmock.h>

#include "recording/export.hpp"
#include "unit/recording/recorded_drive.hpp"

namespace homeward::recording::replay_test {
namespace {

using ::testing::HasSubstr;

class Replay : public RecordedDrive {
 protected:
  void record(int ticks = 8) {
    open_recorder();
    drive(ticks);
    close_recorder();
  }
  [[nodiscard]] Result<ReplayResult> result() const {
    return replay(recording(), [](double) {});
  }
};

TEST_F(Replay, ReproducesEveryVectorDecisionAndCommand) {
  open_recorder();
  pictures_ = false;
  for (int i = 0; i < 3; ++i) tick();  // what it did before a mission is no part of it
  pictures_ = true;
  state_.pictures = 12'345;  // but the count of its pictures is: it is the seed of what is random
  drive(15);
  EXPECT_GT(pose_.x_m, 0.2) << "it stood: " << state_.reason;
  close_recorder();
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message << " " << replayed.error().where;
  EXPECT_EQ(replayed->steps, 16);
  EXPECT_EQ(replayed->compared, 16);
  EXPECT_EQ(replayed->pictures, 16);
  EXPECT_GE(replayed->vectors, 8);
  EXPECT_TRUE(replayed->same()) << replayed->differing.front().what;
  EXPECT_TRUE(replayed->complete);
  ASSERT_TRUE(replayed->why);
  EXPECT_EQ(replayed->why->state, "stopped");
  EXPECT_EQ(replayed->why->reason, wire::Reason{wire::ReasonCode::kStoppedByHand});
  EXPECT_EQ(replayed->header.label, "end of the corridor");
}

TEST_F(Replay, ReproducesARiderWhoTakesOver) {
  open_recorder();
  hand_ = driving::JoystickReading{};  // a joystick is there, at rest
  tick({mission("m1", 1)});
  for (int i = 0; i < 5; ++i) tick();
  ASSERT_EQ(state_.drive, wire::DriveState::kDriving) << state_.reason;
  hand_ = driving::JoystickReading{0, true, {1.0 / 7.0, -0.1}};
  EXPECT_DOUBLE_EQ(tick().motion.speed_mps, 1.0 / 7.0);
  close_recorder();
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message << " " << replayed.error().where;
  EXPECT_TRUE(replayed->same()) << replayed->differing.front().what;
  EXPECT_TRUE(replayed->complete);
  EXPECT_EQ(replayed->compared, 7);
  EXPECT_EQ(replayed->why->state, "stopped");
  EXPECT_EQ(replayed->why->reason, wire::Reason{wire::ReasonCode::kRiderTookOver});
  SQLite::Database database(recording().string());
  const SQLite::Column deflected = database.execAndGet("SELECT sum(rider_deflected) FROM steps");
  EXPECT_EQ(deflected.getInt(), 1);
}

TEST_F(Replay, ReproducesAPathThatIsRepeatedAndWhyItEnds) {
  open_recorder();
  tick({wire::RepeatOrder{MissionId("m1"), {1, 1}, MapId("k1"), 1, 1500, 0.4, "kitchen", ImageId("t/1.jpg"), 0}});
  driving::PathSight sight;
  sight.lost = false;
  sight.arc = 3;
  sight.confidence = 0.9;
  for (int i = 0; i < 20; ++i) sight.way.push_back({0.1 * i + 1.0 / 30.0, 0.01, 0.0});
  path_sight_ = sight;
  for (int i = 0; i < 8; ++i) tick();
  EXPECT_GT(pose_.x_m, 0.05) << "it stood: " << state_.reason;
  path_sight_ = driving::PathSight{};
  tick();
  path_sight_.reset();
  why_not_repeating_ = wire::Reason{wire::ReasonCode::kDoesNotRepeat};
  tick();
  close_recorder();
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message << " " << replayed.error().where;
  EXPECT_TRUE(replayed->same()) << replayed->differing.front().what;
  EXPECT_TRUE(replayed->complete);
  EXPECT_EQ(replayed->compared, 11);
  EXPECT_EQ(replayed->why->state, "failed");
  EXPECT_EQ(replayed->why->reason,
            wire::reason_with(wire::ReasonCode::kPathUnusable, "because", {wire::ReasonCode::kDoesNotRepeat}));
  EXPECT_EQ(replayed->why->path_index, 3);
}

TEST_F(Replay, ReproducesAnExploration) {
  open_recorder();
  tick({wire::ExploreOrder{MissionId("m1"), {1, 1}, 1500, 0.4, ExplorationId("x1"), false, {}, {}, {}}});
  leg_ = driving::Leg{{1.0 / 3.0, 0.05}, 0.1};
  for (int i = 0; i < 12; ++i) tick();
  EXPECT_GT(pose_.x_m, 0.1) << "it stood: " << state_.reason;
  leg_.reset();
  tick();
  over_ = driving::ExplorationOver{true, wire::Reason{wire::ReasonCode::kExplorationStuck}};
  tick();
  close_recorder();
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message << " " << replayed.error().where;
  EXPECT_TRUE(replayed->same()) << replayed->differing.front().what;
  EXPECT_TRUE(replayed->complete);
  EXPECT_EQ(replayed->compared, 15);
  EXPECT_EQ(replayed->why->state, "failed");
  EXPECT_EQ(replayed->why->reason, wire::Reason{wire::ReasonCode::kExplorationStuck});
}

TEST_F(Replay, ReproducesAnExplorationWhosePicturesWereNotLookedAt) {
  open_recorder();
  looks_ = false;
  leg_ = driving::Leg{{1.0, 0.05}, 0.1};
  rows_ = {wire::ThesisRow{wire::ThesisState::kExploration, {0, 1}, {}, 0.5, {}}};
  tick({wire::ExploreOrder{MissionId("m1"), {1, 1}, 1500, 0.4, ExplorationId("x1"), false, {}, {}, {}}});
  for (int i = 0; i < 12; ++i) tick();
  EXPECT_GT(pose_.x_m, 0.1) << "it stood: " << state_.reason;
  over_ = driving::ExplorationOver{};
  tick();
  close_recorder();
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message << " " << replayed.error().where;
  EXPECT_TRUE(replayed->same()) << replayed->differing.front().what;
  EXPECT_TRUE(replayed->complete) << replayed->note;
  EXPECT_EQ(replayed->compared, 14);
  EXPECT_EQ(replayed->pictures, 0);
  auto reader = db::RecordingReader::open(recording());
  ASSERT_TRUE(reader);
  const auto step = (*reader)->next();
  ASSERT_TRUE(step && *step && (*step)->picture);
  EXPECT_FALSE((*step)->picture->looked_at);
  ASSERT_EQ((*step)->rows.size(), 1U) << "what was decided before the step";
}

TEST_F(Replay, ReproducesThatAnOrderToExploreIsRefused) {
  open_recorder();
  tick({mission("m1", 1)});
  for (int i = 0; i < 3; ++i) tick();
  why_not_exploring_ = wire::Reason{wire::ReasonCode::kExplorationUnknown};
  tick({wire::ExploreOrder{MissionId("m2"), {1, 50}, 1500, 0.4, ExplorationId("x1"), true, {}, {}, {}}});
  EXPECT_EQ(state_.drive, wire::DriveState::kStopped);
  close_recorder();
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message << " " << replayed.error().where;
  EXPECT_TRUE(replayed->same()) << replayed->differing.front().what;
  EXPECT_EQ(replayed->compared, 5);
}

TEST_F(Replay, ReproducesARobotThatIsNotReached) {
  open_recorder();
  tick({mission("m1", 1)});
  for (int i = 0; i < 5; ++i) tick();
  ASSERT_EQ(state_.drive, wire::DriveState::kDriving) << state_.reason;
  robot_link_up_ = false;
  for (int i = 0; i < 10; ++i) tick();
  close_recorder();
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message << " " << replayed.error().where;
  EXPECT_TRUE(replayed->same()) << replayed->differing.front().what;
  EXPECT_EQ(replayed->why->reason, wire::Reason{wire::ReasonCode::kRobotLinkLost});
}

TEST_F(Replay, TellsFeaturesThatWereTrackedOtherwise) {
  record();
  change(
      "UPDATE steps SET tracked = tracked + 1, lost = lost + 2 WHERE seq = (SELECT max(seq) FROM steps WHERE tracked "
      ">= 0)");
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message;
  ASSERT_EQ(replayed->differences, 2);
  EXPECT_EQ(replayed->differing[0].what, "tracks/tracked");
  EXPECT_EQ(replayed->differing[1].what, "tracks/lost");
}

TEST_F(Replay, OfARecordingBeforeTracksWereKeptComparesWhatItHas) {
  record();
  change(
      "PRAGMA user_version = 2; ALTER TABLE steps DROP COLUMN tracked; ALTER TABLE steps DROP COLUMN recovered;"
      "ALTER TABLE steps DROP COLUMN lost");
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_TRUE(replayed->same());
  EXPECT_GE(replayed->vectors, 8);
}

TEST_F(Replay, TellsWhatCameOutOtherwise) {
  record();
  change("UPDATE steps SET path_index = 7, reason = 'Nothing.' WHERE seq = 3");
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_FALSE(replayed->same());
  EXPECT_EQ(replayed->differences, 2);
  ASSERT_EQ(replayed->differing.size(), 2U);
  EXPECT_EQ(replayed->differing[0].step, 3);
  EXPECT_EQ(replayed->differing[0].what, "reason");
  EXPECT_EQ(replayed->differing[0].recorded, "Nothing.");
  EXPECT_EQ(replayed->differing[1].what, "path_index");
  EXPECT_EQ(replayed->differing[1].recorded, "7");
}

TEST_F(Replay, NoticesAnotherPicture) {
  record();
  const CameraPicture other = picture({0.3, 0.4, 0.7});
  {
    SQLite::Database database(recording().string(), SQLite::OPEN_READWRITE);
    SQLite::Statement update(database, "UPDATE pictures SET bytes = ? WHERE step = 5");
    update.bind(1, other.bytes->data(), static_cast<int>(other.bytes->size()));
    ASSERT_EQ(update.exec(), 1);
  }
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message;
  ASSERT_FALSE(replayed->same());
  EXPECT_EQ(replayed->differing[0].step, 5);
  EXPECT_LE(replayed->differing.size(), 10U);
}

TEST_F(Replay, EndsWherePicturesWereLeftOut) {
  record();
  change("UPDATE pictures SET bytes = NULL WHERE step > 4");
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_TRUE(replayed->same());
  EXPECT_FALSE(replayed->complete);
  EXPECT_EQ(replayed->compared, 4);
  EXPECT_EQ(replayed->steps, 9);
  EXPECT_THAT(replayed->note, HasSubstr("up to step 4"));
  EXPECT_EQ(replayed->why->reason, wire::Reason{wire::ReasonCode::kStoppedByHand}) << "that is known without pictures";
}

TEST_F(Replay, SaysThatARecordingWasCutOff) {
  record();
  change("DELETE FROM meta WHERE key IN ('whole', 'end'); DELETE FROM steps WHERE seq > 5");
  const auto replayed = result();
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_TRUE(replayed->same());
  EXPECT_FALSE(replayed->complete);
  EXPECT_THAT(replayed->note, HasSubstr("cut off after step 5"));
  EXPECT_EQ(replayed->why->state, "driving");
}

TEST_F(Replay, RefusesFeaturesOfAnotherProgram) {
  record(2);
  change("UPDATE meta SET value = 'hw9-other' WHERE key = 'feature_config_id'");
  const auto replayed = result();
  ASSERT_FALSE(replayed);
  EXPECT_EQ(replayed.error().code, ErrorCode::kFeatureConfigMismatch);
  EXPECT_THAT(replayed.error().message, HasSubstr("hw9-other"));
  EXPECT_THAT(replayed.error().where, HasSubstr(recording().string()));
}

TEST_F(Replay, RefusesSettingsThatItDoesNotKnow) {
  record(2);
  change(R"(UPDATE meta SET value = replace(value, '"turn_gain"', '"whirl_gain"') WHERE key = 'driving')");
  const auto replayed = result();
  ASSERT_FALSE(replayed);
  EXPECT_EQ(replayed.error().code, ErrorCode::kUnsupportedFormat);
  EXPECT_THAT(replayed.error().message, HasSubstr("whirl_gain"));
}

TEST_F(Replay, RefusesWhatCannotBe) {
  record(3);
  for (const char* key : {"camera", "features", "driving", "before"}) {
    const std::string quoted = std::string("'") + key + "'";
    change("UPDATE meta SET value = '{' || value WHERE key = " + quoted);
    const auto replayed = result();
    ASSERT_FALSE(replayed) << key;
    change("UPDATE meta SET value = substr(value, 2) WHERE key = " + quoted);
  }
  ASSERT_TRUE(result());
  change("UPDATE pictures SET bytes = substr(bytes, 1, 900) WHERE step = 2");
  const auto replayed = result();
  ASSERT_FALSE(replayed);
  EXPECT_EQ(replayed.error().code, ErrorCode::kTruncatedImage);
  EXPECT_THAT(replayed.error().where, HasSubstr(recording().string()));
}

TEST_F(Replay, RefusesARecordingWithoutSteps) {
  record(2);
  change("DELETE FROM steps");
  ASSERT_FALSE(result());
  EXPECT_EQ(result().error().code, ErrorCode::kEmptyInput);
}

TEST_F(Replay, WritesARecordingOutAsATour) {
  record(3);
  const auto out = folder_.path() / "tour";
  const Status exported = export_recording(recording(), out);
  ASSERT_TRUE(exported) << exported.error().message;
  EXPECT_EQ(folder_.text("tour/00000.jpg").substr(0, 2), "\xFF\xD8");
  EXPECT_TRUE(std::filesystem::exists(out / "00003.jpg"));
  EXPECT_THAT(folder_.text("tour/times.csv"), HasSubstr("filename,t_us\n00000.jpg,"));
  EXPECT_THAT(folder_.text("tour/odometry.csv"), HasSubstr(",0.000000,0.000000,0.000000\n"));
  EXPECT_THAT(folder_.text("tour/scans.csv"), HasSubstr("00000.jpg,3.000,3.000"));
  EXPECT_THAT(folder_.text("tour/scans.json"), HasSubstr("homeward-scans"));
  EXPECT_THAT(folder_.text("tour/camera.json"), HasSubstr("homeward-camera"));
  EXPECT_EQ(export_recording(recording(), out).error().code, ErrorCode::kConflict);
}

}  // namespace
}  // namespace homeward::recording::replay_test
