// SPDX-License-Identifier: Apache-2.0
// Damaged recordings: each is read to its end or refused with a sentence, and the file is left as it is.
#include <gtest/gtest.h>

#include "db/recording.hpp"
#include "fuzz/mutate.hpp"
#include "support/sample_recording.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::recording_test {
namespace {

using testing::Bytes;
using testing::Mutator;
using testing::ScratchFolder;

TEST(FuzzRecording, IsReadToItsEndOrRefused) {
  const ScratchFolder folder;
  {
    auto writer = db::RecordingWriter::create(folder.path() / "good.hwrec", testing::sample_recording_header(),
                                              testing::sample_recorded_step(1).sweep);
    ASSERT_TRUE(writer);
    std::vector<db::RecordedStep> steps;
    for (int seq = 1; seq <= 12; ++seq) steps.push_back(testing::sample_recorded_step(seq));
    ASSERT_TRUE((*writer)->append(steps));
    ASSERT_TRUE((*writer)->finish({true, "The mission ended."}));
  }
  ASSERT_TRUE(testing::read_whole_recording(folder.path() / "good.hwrec"));
  const std::string text = folder.text("good.hwrec");
  const Bytes good(text.begin(), text.end());
  Mutator mutator(1);
  int refused = 0;
  constexpr int kRounds = 300;
  for (int i = 0; i < kRounds; ++i) {
    const Bytes bytes = mutator.damaged(good);
    const std::string damaged(bytes.begin(), bytes.end());
    const auto file = folder.put("damaged.hwrec", damaged);
    const Status read = testing::read_whole_recording(file);
    EXPECT_EQ(folder.text("damaged.hwrec"), damaged);  // reading changes nothing
    if (read) continue;
    ++refused;
    const Error& error = read.error();
    EXPECT_TRUE(error.code == ErrorCode::kCorruptFile || error.code == ErrorCode::kUnsupportedFormat ||
                error.code == ErrorCode::kIo)
        << static_cast<int>(error.code) << error.message;
    EXPECT_NE(error.where.find("damaged.hwrec"), std::string::npos) << error.where;
    EXPECT_EQ(error.message.find('\n'), std::string::npos);
  }
  EXPECT_GT(refused, kRounds / 4);
  EXPECT_LT(refused, kRounds);
}

}  // namespace
}  // namespace homeward::recording_test
