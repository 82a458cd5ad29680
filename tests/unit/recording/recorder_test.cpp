// SPDX-License-Identifier: Apache-2.0
#include "recording/recorder.hpp"

#include <gmock/gmock.h>

#include "recording/recording_folder.hpp"
#include "recording/replay.hpp"
#include "unit/recording/recorded_drive.hpp"

namespace homeward::recording::recorder_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class RecorderTest : public RecordedDrive {
 protected:
  /// How a recording ends, and its steps.
  struct Kept {
    std::optional<db::RecordingEnd> end;
    std::vector<db::RecordedStep> steps;
  };
  static Kept read(const std::filesystem::path& file) {
    auto reader = db::RecordingReader::open(file);
    EXPECT_TRUE(reader) << reader.error().message;
    Kept kept{(*reader)->end(), {}};
    while (auto step = (*reader)->next().value()) kept.steps.push_back(std::move(*step));
    return kept;
  }
};

TEST_F(RecorderTest, KeepsOneFileForEachMission) {
  open_recorder();
  pictures_ = false;
  tick();
  EXPECT_EQ(recordings().size(), 0U);
  drive(3);
  tick();  // after the mission
  tick({mission("m2", 50)});
  tick({mission("m3", 60)});
  close_recorder();
  const auto files = recordings();
  ASSERT_EQ(files.size(), 3U);
  EXPECT_THAT(files[0].filename().string(), HasSubstr("Z-m1.hwrec"));
  const Kept first = read(files[0]);
  EXPECT_EQ(first.steps.size(), 4U);
  EXPECT_EQ(first.end->note, "The mission ended.");
  EXPECT_TRUE(first.end->whole);
  const Kept second = read(files[1]);
  EXPECT_EQ(second.steps.size(), 1U);
  EXPECT_EQ(second.end->note, "Another mission was sent.");
  const Kept third = read(files[2]);
  EXPECT_EQ(third.steps.size(), 1U);
  EXPECT_FALSE(third.end->whole);
  EXPECT_THAT(third.end->note, HasSubstr("program ended"));
}

TEST_F(RecorderTest, AnExplorationAfterAMissionIsAFileOfItsOwn) {
  open_recorder();
  tick({mission("m1", 1)});
  tick({wire::ExploreOrder{MissionId("m2"), {1, 50}, 1500, 0.4, ExplorationId("x1"), false, {}, {}, {}}});
  tick();
  close_recorder();
  const auto files = recordings();
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(read(files[0]).end->note, "Another mission was sent.");
  EXPECT_EQ(read(files[1]).steps.size(), 2U);
}

TEST_F(RecorderTest, DoesNotRecordAMissionThatIsRefused) {
  open_recorder();
  wire::MissionOrder order = mission("m1", 1);
  order.feature_config_id = "hw9-other";
  tick({order});
  close_recorder();
  EXPECT_TRUE(recordings().empty());
}

TEST_F(RecorderTest, GoesOnWithoutPicturesWhenItIsFull) {
  options_.limit_bytes = 1 << 20;
  open_recorder();
  tick({mission("m1", 1)});
  const auto size = static_cast<std::int64_t>(picture(pose_).bytes->size());
  const int enough = static_cast<int>((1 << 20) / size) + 10;
  driving::Inputs inputs;
  inputs.link_up = true;
  const CameraPicture sent = picture(pose_);
  for (int i = 0; i < enough; ++i) {
    now_ms_ += 10;
    inputs.messages = {wire::Permit{MissionId("m1"), {1, ++seq_}, 1500}};
    inputs.picture = driving::SeenPicture{now_ms_, std::make_shared<const features::Appearance>(), {}, pose_};
    inputs.scan = driving::SeenScan{now_ms_, {std::vector<float>(60, 3.0F), 0.0, kPi / 30.0, 3.0, {}}};
    recorder_->step(state_, inputs, sent.bytes, now_ms_);
  }
  ASSERT_EQ(state_.drive, wire::DriveState::kDriving) << state_.reason;
  tick({wire::StopOrder{"s1", 1, wire::Reason{wire::ReasonCode::kStoppedByHand}, "test"}});
  close_recorder();
  const Kept kept = read(recording());
  ASSERT_EQ(kept.steps.size(), static_cast<std::size_t>(enough) + 2);
  EXPECT_TRUE(kept.steps[3].picture->bytes);
  EXPECT_FALSE(kept.steps.back().picture->bytes);
  EXPECT_EQ(kept.steps.back().reason, wire::Reason{wire::ReasonCode::kStoppedByHand});
  EXPECT_FALSE(kept.end->whole);
  EXPECT_THAT(kept.end->note, HasSubstr("no pictures after step"));
  EXPECT_LE(std::filesystem::file_size(recording()), 1U << 20);
  EXPECT_THAT(log(), HasSubstr("without pictures"));
}

TEST_F(RecorderTest, DrivesOnWhenTheDiskIsTooSlow) {
  options_.wait_for_disk = false;
  options_.most_waiting_bytes = 1000;  // less than one step with a mission and a picture
  open_recorder();
  tick({mission("m1", 1)});
  double speed_mps = 0.0;
  for (int i = 0; i < 6; ++i) speed_mps = tick().motion.speed_mps;
  EXPECT_GT(speed_mps, 0.05) << state_.reason;
  close_recorder();
  const Kept kept = read(recording());
  EXPECT_TRUE(kept.steps.empty());
  ASSERT_TRUE(kept.end);
  EXPECT_FALSE(kept.end->whole);
  EXPECT_THAT(kept.end->note, HasSubstr("too slow"));
}

TEST_F(RecorderTest, DrivesOnWhenNothingCanBeWritten) {
  open_recorder();
  std::filesystem::remove_all(options_.folder);
  tick({mission("m1", 1)});
  double speed_mps = 0.0;
  for (int i = 0; i < 6; ++i) speed_mps = tick().motion.speed_mps;
  EXPECT_GT(speed_mps, 0.05) << state_.reason;
  close_recorder();
  EXPECT_THAT(log(), HasSubstr("The mission goes on without recording."));
}

TEST_F(RecorderTest, RecordsTheNextMissionAfterOneThatCouldNotBeWritten) {
  open_recorder();
  std::filesystem::remove_all(options_.folder);
  pictures_ = false;
  drive(3);
  close_recorder();  // so that the first one is done with
  open_recorder();
  drive(1);
  tick({mission("m2", 80)});
  close_recorder();
  EXPECT_EQ(recordings().size(), 1U);
}

TEST_F(RecorderTest, MakesRoomByRemovingTheOldest) {
  std::filesystem::create_directories(options_.folder);
  const std::string content(600'000, 'x');
  for (const char* name : {"b.hwrec", "a.hwrec", "c.hwrec", "notes.txt"}) {
    folder_.put(std::string("recordings/") + name, content);
  }
  folder_.put("recordings/b.hwrec-wal", content);
  const auto now = std::filesystem::file_time_type::clock::now();
  std::filesystem::last_write_time(options_.folder / "b.hwrec", now - std::chrono::hours(3));
  std::filesystem::last_write_time(options_.folder / "a.hwrec", now - std::chrono::hours(2));
  std::string log;
  make_room(options_.folder, 1'300'000, [&](const std::string& what) { log += what; });
  EXPECT_THAT(log, HasSubstr("b.hwrec"));
  EXPECT_THAT(log, Not(HasSubstr("a.hwrec")));
  EXPECT_FALSE(std::filesystem::exists(options_.folder / "b.hwrec"));
  EXPECT_FALSE(std::filesystem::exists(options_.folder / "b.hwrec-wal"));
  EXPECT_TRUE(std::filesystem::exists(options_.folder / "a.hwrec"));
  EXPECT_TRUE(std::filesystem::exists(options_.folder / "notes.txt"));
  make_room(options_.folder, 0, [](const std::string&) {});
  EXPECT_EQ(recordings().size(), 1U) << "what is no recording stays";
}

TEST_F(RecorderTest, NamesFilesSoThatTheyCanBe) {
  db::RecordingHeader header;
  header.started_us = 1'700'000'000'000'000;
  header.mission = "../up/and away";
  EXPECT_EQ(new_recording_file(folder_.path(), "", header), folder_.path() / "20231114T221320Z-___up_and_away.hwrec");
  folder_.put("tour.hwrec", "");
  EXPECT_EQ(new_recording_file(folder_.path(), "tour", header), folder_.path() / "tour-2.hwrec");
}

TEST_F(RecorderTest, RefusesLimitsThatCannotBe) {
  options_.folder_limit_bytes = options_.limit_bytes - 1;
  const auto created = Recorder::create(options_, robot_, [](const std::string&) {});
  ASSERT_FALSE(created);
  EXPECT_EQ(created.error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::recording::recorder_test
