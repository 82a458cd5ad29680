// SPDX-License-Identifier: Apache-2.0
#include "db/recording.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "support/sample_recording.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::db::recording_test {
namespace {

using ::testing::HasSubstr;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

class RecordingFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "mission.hwrec"; }
  void change(const std::string& sql) const { SQLite::Database(file().string(), SQLite::OPEN_READWRITE).exec(sql); }

  /// Three steps, the last of which stops.
  void record(const RecordingEnd& end = {true, "The mission ended."}) const {
    auto writer = RecordingWriter::create(file(), homeward::testing::sample_recording_header(), std::nullopt);
    ASSERT_TRUE(writer) << writer.error().message;
    std::vector<RecordedStep> steps;
    for (int seq = 1; seq <= 3; ++seq) steps.push_back(homeward::testing::sample_recorded_step(seq));
    steps.back().state = wire::DriveState::kStopped;
    steps.back().reason = wire::Reason{wire::ReasonCode::kServerSilent};
    steps.back().link_up = false;
    steps.back().robot_link_up = false;
    steps.back().picture.reset();
    steps.back().received.clear();
    ASSERT_TRUE((*writer)->append(steps));
    ASSERT_TRUE((*writer)->finish(end));
  }

  /// The error of opening it and reading it to its end.
  [[nodiscard]] Error trouble() const {
    auto reader = RecordingReader::open(file());
    if (!reader) return reader.error();
    while (true) {
      const auto step = (*reader)->next();
      if (!step) return step.error();
      if (!*step) break;
    }
    return {ErrorCode::kInternal, "There is no trouble.", ""};
  }

  homeward::testing::ScratchFolder folder_;
};

TEST_F(RecordingFile, GivesEveryNumberBackBitForBit) {
  record();
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ((*reader)->header().label, "kitchen");
  EXPECT_EQ((*reader)->header().started_us, 1'700'000'000'000'000);
  EXPECT_EQ((*reader)->step_count(), 3);
  ASSERT_TRUE((*reader)->end());
  EXPECT_TRUE((*reader)->end()->whole);
  const auto read = (*reader)->next();
  ASSERT_TRUE(read && *read);
  const RecordedStep& step = **read;
  const RecordedStep expected = homeward::testing::sample_recorded_step(1);
  EXPECT_EQ(step.now_ms, expected.now_ms);
  EXPECT_EQ(step.sensors_ms, expected.sensors_ms);
  EXPECT_TRUE(step.robot_link_up);
  EXPECT_EQ(bits(step.odometry.x_m), bits(-0.0));
  EXPECT_EQ(bits(step.odometry.y_m), bits(1.0 / 3.0));
  EXPECT_EQ(bits(step.odometry.theta_rad), bits(5e-324));
  EXPECT_EQ(bits(step.speed_mps), bits(expected.speed_mps));
  EXPECT_EQ(bits(step.turn_radps), bits(-0.0));
  ASSERT_TRUE(step.vector);
  EXPECT_EQ(bits(step.vector->bearing_rad), bits(-0.0));
  EXPECT_EQ(step.vector->inliers, 40);
  EXPECT_EQ(step.vector->matches, 80);
  EXPECT_FALSE(step.vector->nearness);
  EXPECT_EQ(step.tracks, (RecordedTracks{60, 3, 12}));
  ASSERT_TRUE(step.rider);
  EXPECT_EQ(step.rider->said_ms, expected.rider->said_ms);
  EXPECT_TRUE(step.rider->deflected);
  EXPECT_EQ(bits(step.rider->speed_mps), bits(-0.0));
  EXPECT_EQ(bits(step.rider->turn_radps), bits(expected.rider->turn_radps));
  ASSERT_TRUE(step.leg);
  EXPECT_EQ(bits(step.leg->goal_x_m), bits(-0.0));
  EXPECT_EQ(bits(step.leg->goal_y_m), bits(1.0 / 7.0));
  EXPECT_EQ(bits(step.leg->within_m), bits(0.1));
  EXPECT_TRUE(step.exploration_over);
  ASSERT_TRUE(step.path_sight);
  EXPECT_EQ(step.path_sight->taken_ms, expected.path_sight->taken_ms);
  EXPECT_EQ(bits(step.path_sight->odometry.x_m), bits(-0.0));
  EXPECT_FALSE(step.path_sight->lost);
  EXPECT_EQ(step.path_sight->arc, 7);
  EXPECT_EQ(step.path_sight->tracked, 120);
  EXPECT_EQ(bits(step.path_sight->confidence), bits(expected.path_sight->confidence));
  EXPECT_EQ(bits(step.path_sight->steering_rad), bits(-0.0));
  ASSERT_EQ(step.path_sight->way.size(), 2U);
  EXPECT_EQ(bits(step.path_sight->way[0].y_m), bits(-0.0));
  EXPECT_TRUE(step.path_sight->ends);
  EXPECT_FALSE(step.path_sight->leads_elsewhere);
  EXPECT_FALSE(step.path_unusable);
  ASSERT_TRUE(step.sweep);
  EXPECT_EQ(bits(step.sweep->angle_min_rad), bits(-0.0));
  EXPECT_TRUE(std::isinf(step.sweep->ranges_m[1]));
  EXPECT_TRUE(std::signbit(step.sweep->ranges_m[2]));
  ASSERT_TRUE(step.picture && step.picture->bytes);
  EXPECT_EQ(*step.picture->bytes, *expected.picture->bytes);
  EXPECT_EQ(bits(step.picture->odometry.y_m), bits(-0.0));
  EXPECT_TRUE(step.picture->looked_at);
  ASSERT_EQ(step.received.size(), 1U);
  EXPECT_EQ(wire::encode(step.received[0]), wire::encode(expected.received[0]));
  ASSERT_EQ(step.sent.size(), 1U);
  EXPECT_EQ(wire::encode(step.sent[0]), wire::encode(expected.sent[0]));
}

TEST_F(RecordingFile, GivesRowsOfTheTableOfStatesBackInTheirOrder) {
  record();
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  const auto read = (*reader)->next();
  ASSERT_TRUE(read && *read);
  const RecordedStep expected = homeward::testing::sample_recorded_step(1);
  ASSERT_EQ((*read)->rows.size(), expected.rows.size());
  for (std::size_t i = 0; i < expected.rows.size(); ++i)
    EXPECT_EQ(wire::state_row_to_json((*read)->rows[i]), wire::state_row_to_json(expected.rows[i])) << i;
  const auto& known = std::get<wire::SurveyRow>((*read)->rows[0]);
  EXPECT_EQ(known.state, wire::SurveyState::kKnownAgain);
  EXPECT_EQ(known.known, 12);
  EXPECT_EQ(bits(known.pose.x_m), bits(1.0 / 3.0));
  const auto& next = std::get<wire::SurveyRow>((*read)->rows[1]);
  EXPECT_EQ(next.cost_m, 1.0 / 7.0);
  EXPECT_FALSE(next.known);
  EXPECT_EQ(std::get<wire::ThesisRow>((*read)->rows[2]).nodes, (std::vector<std::int64_t>{3, 1}));
  // What a person types into sqlite3.
  SQLite::Database database(file().string());
  SQLite::Statement states(database, "SELECT state FROM states WHERE step = 2 ORDER BY position");
  for (const char* state : {"known_again", "next_place", "exploration_homing"}) {
    ASSERT_TRUE(states.executeStep());
    EXPECT_EQ(states.getColumn(0).getString(), state);
  }
  EXPECT_FALSE(states.executeStep());
}

TEST_F(RecordingFile, OfTheVersionBeforeTablesOfStatesIsRead) {
  record();
  change("PRAGMA user_version = 5; DROP TABLE states; ALTER TABLE pictures DROP COLUMN looked_at");
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  const auto step = (*reader)->next();
  ASSERT_TRUE(step) << step.error().message << " " << step.error().where;
  ASSERT_TRUE(*step);
  EXPECT_TRUE((*step)->rows.empty());
  EXPECT_TRUE((*step)->picture->looked_at);
  EXPECT_TRUE((*step)->leg);
}

TEST_F(RecordingFile, KeepsWhetherTheRobotWasReached) {
  record();
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  for (const bool reached : {true, true, false}) {
    const auto step = (*reader)->next();
    ASSERT_TRUE(step && *step);
    EXPECT_EQ((*step)->robot_link_up, reached);
  }
}

TEST_F(RecordingFile, IsOneFileOnceItEnded) {
  record();
  EXPECT_EQ(folder_.count(), 1);
}

TEST_F(RecordingFile, IsForTheEyesOfItsUserAlone) {
  auto writer = RecordingWriter::create(file(), homeward::testing::sample_recording_header(), std::nullopt);
  ASSERT_TRUE(writer);
  const RecordedStep first[] = {homeward::testing::sample_recorded_step(1)};
  ASSERT_TRUE((*writer)->append(first));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_EQ(entry.status().permissions(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_write)
        << entry.path();
  }
  EXPECT_GE(folder_.count(), 2) << "there is no journal to look at";
}

TEST_F(RecordingFile, IsNotWrittenOverAnother) {
  record();
  const auto again = RecordingWriter::create(file(), homeward::testing::sample_recording_header(), std::nullopt);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kConflict);
}

TEST_F(RecordingFile, SaysWhyTheRobotStoppedInOneQuery) {
  record();
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader);
  const auto why = (*reader)->why_stopped();
  ASSERT_TRUE(why && *why) << (why ? "" : why.error().message);
  EXPECT_EQ((*why)->step, 3);
  EXPECT_DOUBLE_EQ((*why)->after_s, 0.08);
  EXPECT_EQ((*why)->state, "stopped");
  EXPECT_EQ((*why)->reason, wire::Reason{wire::ReasonCode::kServerSilent});
  EXPECT_FALSE((*why)->link_up);
  EXPECT_DOUBLE_EQ((*why)->since_message_s.value(), 0.04);  // heard last in step 2
  EXPECT_DOUBLE_EQ((*why)->since_picture_s.value(), 0.09);  // that of step 2
  EXPECT_DOUBLE_EQ((*why)->since_sweep_s.value(), 0.01);
  EXPECT_DOUBLE_EQ((*why)->since_vector_s.value(), 0.04);
  EXPECT_DOUBLE_EQ((*why)->last_confidence.value(), 0.9);
  // What a person types into sqlite3.
  SQLite::Database database(file().string());
  SQLite::Statement view(database, "SELECT step, reason FROM why_did_it_stop");
  ASSERT_TRUE(view.executeStep());
  EXPECT_EQ(view.getColumn(0).getInt(), 3);
  EXPECT_THAT(view.getColumn(1).getString(), HasSubstr("server_silent"));
  EXPECT_FALSE(view.executeStep());
}

TEST_F(RecordingFile, KeepsWhatWasAppendedWhenItsProgramIsKilled) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto writer = RecordingWriter::create(file(), homeward::testing::sample_recording_header(), std::nullopt);
    const RecordedStep steps[] = {homeward::testing::sample_recorded_step(1),
                                  homeward::testing::sample_recorded_step(2)};
    if (!writer || !(*writer)->append(steps)) ::_exit(1);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ((*reader)->step_count(), 2);
  EXPECT_FALSE((*reader)->end());
  const auto why = (*reader)->why_stopped();
  ASSERT_TRUE(why && *why);
  EXPECT_EQ((*why)->state, "driving");
  EXPECT_EQ((*why)->reason, wire::Reason{wire::ReasonCode::kRecordingCutOff});
}

TEST_F(RecordingFile, CanBeReadWhileItIsWritten) {
  auto writer = RecordingWriter::create(file(), homeward::testing::sample_recording_header(), std::nullopt);
  ASSERT_TRUE(writer);
  const RecordedStep first[] = {homeward::testing::sample_recorded_step(1)};
  ASSERT_TRUE((*writer)->append(first));
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  const RecordedStep second[] = {homeward::testing::sample_recorded_step(2)};
  ASSERT_TRUE((*writer)->append(second));
  EXPECT_EQ((*reader)->step_count(), 1);
  ASSERT_TRUE((*reader)->next().value());
  EXPECT_FALSE((*reader)->next().value()) << "what came later is not of the moment at which it was opened";
}

TEST_F(RecordingFile, ThatIsNotThere) { EXPECT_EQ(trouble().code, ErrorCode::kNotFound); }

TEST_F(RecordingFile, ThatIsNoDatabase) {
  folder_.put("mission.hwrec", "t_us,x_m,y_m,theta_rad\n");
  EXPECT_EQ(trouble().code, ErrorCode::kCorruptFile);
  EXPECT_THAT(trouble().message, HasSubstr("not a recording"));
  folder_.put("mission.hwrec", "");
  EXPECT_EQ(trouble().code, ErrorCode::kCorruptFile);
}

TEST_F(RecordingFile, ThatIsAnotherSqliteFile) {
  SQLite::Database(file().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec("CREATE TABLE meta (a)");
  EXPECT_EQ(trouble().code, ErrorCode::kCorruptFile);
  EXPECT_THAT(trouble().message, HasSubstr("SQLite file is not a recording"));
}

TEST_F(RecordingFile, OfANewerVersion) {
  record();
  change("PRAGMA user_version = 8");
  EXPECT_EQ(trouble().code, ErrorCode::kUnsupportedFormat);
  EXPECT_THAT(trouble().message, HasSubstr("version 8"));
  EXPECT_THAT(trouble().message, HasSubstr("versions 1 to 7"));
}

TEST_F(RecordingFile, OfTheVersionBeforeJoysticksIsRead) {
  record();
  // What version 1 wrote: steps without columns of the rider, and nothing of one among their exact numbers.
  change(
      "PRAGMA user_version = 1; ALTER TABLE steps DROP COLUMN rider_deflected;"
      "ALTER TABLE steps DROP COLUMN rider_speed_mps; ALTER TABLE steps DROP COLUMN rider_turn_radps;"
      "ALTER TABLE steps DROP COLUMN tracked; ALTER TABLE steps DROP COLUMN recovered;"
      "ALTER TABLE steps DROP COLUMN lost;"
      "UPDATE steps SET exact = CAST(X'01' || substr(exact, 2, 104) AS BLOB)");
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  const auto step = (*reader)->next();
  ASSERT_TRUE(step) << step.error().message << " " << step.error().where;
  ASSERT_TRUE(*step);
  EXPECT_FALSE((*step)->rider);
  EXPECT_EQ((*step)->vector->inliers, 40);
}

TEST_F(RecordingFile, OfTheVersionBeforeTracksIsRead) {
  record();
  change(
      "PRAGMA user_version = 2; ALTER TABLE steps DROP COLUMN tracked; ALTER TABLE steps DROP COLUMN recovered;"
      "ALTER TABLE steps DROP COLUMN lost");
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  const auto step = (*reader)->next();
  ASSERT_TRUE(step) << step.error().message << " " << step.error().where;
  ASSERT_TRUE(*step);
  EXPECT_FALSE((*step)->tracks);
  EXPECT_TRUE((*step)->rider);
}

TEST_F(RecordingFile, OfTheVersionBeforeReasonsKeepsItsWords) {
  record();
  change("PRAGMA user_version = 3; UPDATE steps SET reason = 'The house has fallen silent.' WHERE seq = 3");
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader) << reader.error().message;
  const auto why = (*reader)->why_stopped();
  ASSERT_TRUE(why && *why);
  EXPECT_EQ((*why)->reason, wire::in_words("The house has fallen silent."));
}

TEST_F(RecordingFile, WithHalfOfTheCountsOfItsTracks) {
  record();
  change("UPDATE steps SET lost = NULL WHERE seq = 2");
  EXPECT_EQ(trouble().code, ErrorCode::kCorruptFile);
  EXPECT_THAT(trouble().message, HasSubstr("counts of tracked features"));
  EXPECT_THAT(trouble().where, HasSubstr("step 2"));
}

TEST_F(RecordingFile, ThatWasCutShort) {
  record();
  const std::string whole = folder_.text("mission.hwrec");
  for (const std::size_t bytes : {std::size_t{60}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    folder_.put("mission.hwrec", std::string_view(whole).substr(0, bytes));
    EXPECT_EQ(trouble().code, ErrorCode::kCorruptFile) << bytes;
    EXPECT_THAT(trouble().message, HasSubstr("ends early")) << bytes;
  }
}

TEST_F(RecordingFile, ThatLacksWhatAStepWasGiven) {
  record();
  change("DELETE FROM pictures WHERE step = 2");
  EXPECT_EQ(trouble().code, ErrorCode::kCorruptFile);
  EXPECT_THAT(trouble().message, HasSubstr("lacks a picture"));
  EXPECT_THAT(trouble().where, HasSubstr("step 2"));
  change("DELETE FROM steps WHERE seq = 2");
  EXPECT_THAT(trouble().message, HasSubstr("order of its steps"));
  change("DELETE FROM sweeps");
  EXPECT_THAT(trouble().message, HasSubstr("lacks a sweep"));
  change("DELETE FROM messages");
  EXPECT_EQ(trouble().code, ErrorCode::kCorruptFile);
  change("DELETE FROM meta WHERE key = 'driving'");
  EXPECT_THAT(trouble().message, HasSubstr("'driving'"));
}

TEST_F(RecordingFile, ThatHoldsWhatCannotBe) {
  for (const char* sql :
       {"UPDATE steps SET exact = x'00' WHERE seq = 2", "UPDATE steps SET state = 'dancing' WHERE seq = 2",
        "UPDATE sweeps SET exact = x'0102' WHERE step = 2", "UPDATE messages SET cbor = x'ff' WHERE step = 2",
        "UPDATE messages SET sender = 'nobody' WHERE step = 2", "UPDATE states SET row = '{}' WHERE step = 2",
        "UPDATE states SET row = 'known_again' WHERE step = 2", "UPDATE pictures SET exact = x'' WHERE step = 2"}) {
    std::filesystem::remove(file());
    record();
    change(sql);
    EXPECT_EQ(trouble().code, ErrorCode::kCorruptFile) << sql;
    EXPECT_THAT(trouble().where, HasSubstr("step 2")) << sql;
  }
}

TEST_F(RecordingFile, TellsAPictureThatWasLeftOutFromOneThatLacks) {
  record();
  change("UPDATE pictures SET bytes = NULL WHERE step = 2");
  auto reader = RecordingReader::open(file());
  ASSERT_TRUE(reader);
  (void)(*reader)->next();
  const auto step = (*reader)->next();
  ASSERT_TRUE(step && *step);
  ASSERT_TRUE((*step)->picture);
  EXPECT_FALSE((*step)->picture->bytes);
}

}  // namespace
}  // namespace homeward::db::recording_test
