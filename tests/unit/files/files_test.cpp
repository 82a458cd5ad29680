// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "files/csv.hpp"
#include "files/grey_map.hpp"
#include "files/read_file.hpp"
#include "files/write_file.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::files::files_test {
namespace {

using homeward::testing::ScratchFolder;

TEST(ReadCsv, TrimsFieldsAndSkipsEmptyLines) {
  const ScratchFolder folder;
  const auto table = read_csv(folder.put("a.csv", "one, two ,three\r\n\r\n1,,3\r\n 4 ,5,6"));
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->columns, (std::vector<std::string>{"one", "two", "three"}));
  ASSERT_EQ(table->rows.size(), 2U);
  EXPECT_EQ(table->rows[0], (std::vector<std::string>{"1", "", "3"}));
  EXPECT_EQ(table->rows[1], (std::vector<std::string>{"4", "5", "6"}));
  EXPECT_EQ(table->column("three"), 2U);
  EXPECT_FALSE(table->column("four"));
}

TEST(ReadCsv, NamesTheLineThatDoesNotFit) {
  const ScratchFolder folder;
  const auto table = read_csv(folder.put("a.csv", "one,two\n1,2\n\n1,2,3\n"));
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, ErrorCode::kInvalidInput);
  EXPECT_TRUE(table.error().where.ends_with("a.csv:4")) << table.error().where;
  EXPECT_EQ(read_csv(folder.put("b.csv", "\n \n")).error().code, ErrorCode::kEmptyInput);
  EXPECT_EQ(read_csv(folder.path() / "c.csv").error().code, ErrorCode::kNotFound);
}

TEST(ReadGreyMap, ReadsPixelsBehindCommentsAndSpace) {
  const ScratchFolder folder;
  const auto image = read_grey_map(folder.put("m.pgm", std::string("P5 # made by hand\n3\t2\n#x\n255\n") + "abc\n f"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width_px, 3);
  EXPECT_EQ(image->height_px, 2);
  EXPECT_EQ(image->channels, 1);
  EXPECT_EQ(std::string(image->data.begin(), image->data.end()), "abc\n f");
}

TEST(ReadGreyMap, RefusesWhatIsNoSuchPicture) {
  const ScratchFolder folder;
  const auto code = [&](const std::string& bytes) {
    const auto image = read_grey_map(folder.put("m.pgm", bytes));
    if (image) return ErrorCode::kInternal;
    EXPECT_TRUE(image.error().where.ends_with("m.pgm"));
    return image.error().code;
  };
  EXPECT_EQ(code("P2 1 1 255 7"), ErrorCode::kInvalidInput);
  EXPECT_EQ(code("P5 0 1 255 "), ErrorCode::kInvalidInput);
  EXPECT_EQ(code("P5 1 1 65535 ab"), ErrorCode::kInvalidInput);
  EXPECT_EQ(code("P5 2"), ErrorCode::kInvalidInput);
  EXPECT_EQ(code("P5 2 2 255 abc"), ErrorCode::kTruncatedImage);
  EXPECT_EQ(code("P5 20000 20000 255 abc"), ErrorCode::kTruncatedImage);
  EXPECT_EQ(code("P5 90000 2 255 abc"), ErrorCode::kImageTooLarge);
  EXPECT_EQ(read_grey_map(folder.path()).error().code, ErrorCode::kNotFound);
}

TEST(WriteFile, WritesWholeFilesOverOlderOnes) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder.path() / "a.txt", "first and longer"));
  ASSERT_TRUE(write_file(folder.path() / "a.txt", std::string_view("second\0.", 8)));
  EXPECT_EQ(folder.text("a.txt"), std::string("second\0.", 8));
  EXPECT_EQ(folder.count(), 1);  // nothing unfinished lies about
}

TEST(WriteFile, TakesOverWhatAKilledProgramLeft) {
  const ScratchFolder folder;
  folder.put("a.txt.unfinished", std::string(100, 'x'));
  ASSERT_TRUE(write_file(folder.path() / "a.txt", "new"));
  EXPECT_EQ(folder.text("a.txt"), "new");
  EXPECT_EQ(folder.count(), 1);
}

TEST(WriteFile, LeavesNothingHalfWrittenWhenTheDiskIsFull) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder.path() / "a.txt", "old"));
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status written = write_file(folder.path() / "a.txt", std::string(5000, 'x'));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kIo);
  EXPECT_TRUE(written.error().where.ends_with("a.txt"));
  EXPECT_EQ(folder.text("a.txt"), "old");
  EXPECT_EQ(folder.count(), 1);
}

TEST(WriteFile, SaysWhereItCannotWrite) {
  const ScratchFolder folder;
  const auto file = folder.path() / "none" / "a.txt";
  const Status written = write_file(file, "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().where, file.string());
  EXPECT_TRUE(make_folder(file.parent_path()));
  EXPECT_TRUE(make_folder(file.parent_path()));  // again is fine
  EXPECT_TRUE(write_file(file, "x"));
  EXPECT_EQ(make_folder(file).error().code, ErrorCode::kIo);  // a file stands there
}

TEST(ReadText, ReadsBytesAsTheyAre) {
  const ScratchFolder folder;
  const std::string bytes("a\0\r\n\xff", 5);
  EXPECT_EQ(read_text(folder.put("a", bytes)).value(), bytes);
  EXPECT_EQ(read_text(folder.put("b", "")).value(), "");
  EXPECT_EQ(read_text(folder.path()).error().code, ErrorCode::kNotFound);
}

TEST(ReadPicture, NamesTheFile) {
  const ScratchFolder folder;
  const auto picture = read_picture(folder.put("note.jpg", "this is a text"));
  ASSERT_FALSE(picture);
  EXPECT_EQ(picture.error().code, ErrorCode::kUnsupportedImage);
  EXPECT_TRUE(picture.error().where.ends_with("note.jpg"));
}

}  // namespace
}  // namespace homeward::files::files_test
