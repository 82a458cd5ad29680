// SPDX-License-Identifier: Apache-2.0
#include "files/folder_lock.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/scratch_folder.hpp"

namespace homeward::files {
namespace {

TEST(FolderLock, ASecondOneIsRefusedWithTheFoldersName) {
  const homeward::testing::ScratchFolder folder;
  const auto first = FolderLock::take(folder.path(), "folder of explorations");
  ASSERT_TRUE(first);
  const auto second = FolderLock::take(folder.path(), "folder of explorations");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kConflict);
  EXPECT_EQ(second.error().where, folder.path().string());
  EXPECT_NE(second.error().message.find("folder of explorations"), std::string::npos);
}

TEST(FolderLock, WhoGivesItBackLeavesItToTheNext) {
  const homeward::testing::ScratchFolder folder;
  {
    auto first = FolderLock::take(folder.path(), "folder");
    const FolderLock moved = std::move(*first);
    EXPECT_FALSE(FolderLock::take(folder.path(), "folder")) << "it moves with its owner";
  }
  EXPECT_TRUE(FolderLock::take(folder.path(), "folder"));
}

TEST(FolderLock, AKilledProgramHoldsNothing) {
  const homeward::testing::ScratchFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto lock = FolderLock::take(folder.path(), "folder");
    const char taken = lock ? 1 : 0;
    if (::write(ready[1], &taken, 1) == 1) ::pause();
    ::_exit(0);
  }
  char taken = 0;
  ASSERT_EQ(::read(ready[0], &taken, 1), 1);
  ASSERT_EQ(taken, 1);
  EXPECT_FALSE(FolderLock::take(folder.path(), "folder"));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(FolderLock::take(folder.path(), "folder"));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(FolderLock, AFolderThatIsNotThereIsNamed) {
  const auto lock = FolderLock::take("/nowhere/at/all", "folder");
  ASSERT_FALSE(lock);
  EXPECT_EQ(lock.error().code, ErrorCode::kIo);
  EXPECT_EQ(lock.error().where, "/nowhere/at/all/homeward.lock");
}

}  // namespace
}  // namespace homeward::files
